"""CMA-ES by ask and tell: ours against pycma, 188 weights, population 50.

pip install cma; python benchmarks/cma_es.py
"""

import os

# One core for both.
os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
import statistics  # noqa: E402
import time

import cma
import numpy as np

import gambol

WEIGHTS = 188
POPULATION = 50
GENERATIONS = 200
ROUNDS = 9


def fitness(genomes):
    """A sphere whose axes differ."""
    return -np.sum(np.linspace(1, 100, WEIGHTS) * (np.asarray(genomes) - 0.3) ** 2, axis=1)


def ours(covariance):
    """Seconds a generation takes, evaluation left out."""
    search = gambol.CmaEs(WEIGHTS, seed=1, population=POPULATION, covariance=covariance)
    spent = 0.0
    for _ in range(GENERATIONS):
        start = time.perf_counter()
        genomes = search.ask()
        spent += time.perf_counter() - start
        values = fitness(genomes)
        start = time.perf_counter()
        search.tell(values)
        spent += time.perf_counter() - start
    return spent / GENERATIONS


def theirs(diagonal):
    """The same of pycma."""
    options = {"popsize": POPULATION, "seed": 1, "verbose": -9, "CMA_diagonal": diagonal}
    search = cma.CMAEvolutionStrategy(np.zeros(WEIGHTS), 0.5, options)
    spent = 0.0
    for _ in range(GENERATIONS):
        start = time.perf_counter()
        genomes = search.ask()
        spent += time.perf_counter() - start
        values = -fitness(genomes)
        start = time.perf_counter()
        search.tell(genomes, values)
        spent += time.perf_counter() - start
    return spent / GENERATIONS


def main():
    """Prints a table."""
    load = ", ".join(f"{load:.1f}" for load in os.getloadavg())
    print(f"{WEIGHTS} weights, population {POPULATION}, {GENERATIONS} generations, medians of {ROUNDS} rounds; load: {load}")
    print(f"{'covariance':<12} {'gambol, µs':>12} {'pycma, µs':>12} {'faster':>8} {'of a round':>16}")
    for covariance, diagonal in (("separable", True), ("full", False)):
        # In turns, so that both have the same machine.
        rounds = [(ours(covariance), theirs(diagonal)) for _ in range(ROUNDS)]
        mine, other = (statistics.median(of_one) for of_one in zip(*rounds, strict=True))
        ratios = sorted(other / mine for mine, other in rounds)
        spread = f"{ratios[0]:.1f}× to {ratios[-1]:.1f}×"
        print(f"{covariance:<12} {1e6 * mine:>12,.0f} {1e6 * other:>12,.0f} {statistics.median(ratios):>7.1f}× {spread:>16}")


if __name__ == "__main__":
    main()
