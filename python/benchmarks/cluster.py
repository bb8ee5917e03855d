"""A comparison of 1,400 runs on Ray, with one, two and four processes: seconds, and whether the results are the same.

pip install ray; python benchmarks/cluster.py
"""

import os
import tempfile
import time
from pathlib import Path

import ray

from gambol import cluster

CREATURES = ["apod", "biped-1", "biped-2", "tetrapod-1"]
STRATEGIES = ["ga", "cma-es", "open-es", "ars", "random-search"]
SEEDS = 70


def seconds(workers, folder):
    """How long the comparison takes; processes are started before."""
    ray.init(num_cpus=workers, include_dashboard=False, log_to_driver=False)
    cluster.compare(STRATEGIES, ["apod"], out=folder / "warm", seeds=range(1, 3), evaluations=64, cluster=ray)
    start = time.perf_counter()
    cluster.compare(STRATEGIES, CREATURES, out=folder / "c", seeds=range(1, SEEDS + 1), evaluations=64, cluster=ray)
    spent = time.perf_counter() - start
    ray.shutdown()
    return spent, (folder / "c" / "medians.csv").read_bytes()


def main():
    """Prints a table."""
    print(f"{len(STRATEGIES) * len(CREATURES) * SEEDS} runs; {os.cpu_count()} cores; load {os.getloadavg()[0]:.1f}")
    first = None
    for workers in (1, 2, 4):
        with tempfile.TemporaryDirectory() as folder:
            spent, medians = seconds(workers, Path(folder))
        first = first or (spent, medians)
        same = "same medians" if medians == first[1] else "OTHER MEDIANS"
        print(f"{workers} processes: {spent:6.1f} s, {first[0] / spent:.2f}×, {same}", flush=True)


if __name__ == "__main__":
    main()
