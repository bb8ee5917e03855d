"""CMA-ES by ask and tell: ours against pycma, 188 weights, population 50.

pip install cma; python benchmarks/cma_es.py
"""

import os
import time

import cma
import numpy as np

import gambol

WEIGHTS = 188
POPULATION = 50
GENERATIONS = 200
ROUNDS = 3


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
    print(f"{WEIGHTS} weights, population {POPULATION}, {GENERATIONS} generations, the best of {ROUNDS}; load: {load}")
    print(f"{'covariance':<12} {'gambol, µs':>12} {'pycma, µs':>12} {'faster':>8}")
    for covariance, diagonal in (("separable", True), ("full", False)):
        mine = min(ours(covariance) for _ in range(ROUNDS))
        other = min(theirs(diagonal) for _ in range(ROUNDS))
        print(f"{covariance:<12} {1e6 * mine:>12,.0f} {1e6 * other:>12,.0f} {other / mine:>7.1f}×")


if __name__ == "__main__":
    main()
