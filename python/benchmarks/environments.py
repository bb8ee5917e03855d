"""Steps a second of vector environments with random actions, on one core and on all.

python benchmarks/environments.py
"""

import os
import time

import numpy as np

import gambol

NUM_ENVS = 1024
STEPS = 200
ROUNDS = 7


def steps_per_second(creature, threads, copy):
    """Of whole rounds the best, and of single steps the median: whatever else the machine does slows the others."""
    envs = gambol.make_vec(creature, "running", num_envs=NUM_ENVS, threads=threads, copy=copy)
    envs.reset(seed=1)
    random = np.random.default_rng(1)
    actions = random.uniform(-1, 1, (50, *envs.action_space.shape)).astype(np.float32)
    seconds = np.zeros((ROUNDS, STEPS))
    for taken in seconds:
        for step in range(STEPS):
            start = time.perf_counter()
            envs.step(actions[step % len(actions)])
            taken[step] = time.perf_counter() - start
    return NUM_ENVS * STEPS / seconds.sum(axis=1).min(), NUM_ENVS / np.median(seconds), envs.stepped_by


def main():
    """Prints a table."""
    load = ", ".join(f"{load:.1f}" for load in os.getloadavg())
    print(f"{NUM_ENVS} environments, random actions, {ROUNDS} rounds of {STEPS} steps; load of the machine: {load}")
    print(f"{'creature':<12} {'threads':>7} {'copies':>7} {'steps/s, best':>14} {'median':>12}")
    for creature in ("biped-1", "tetrapod-2"):
        for threads in (1, 0):
            for copy in (True, False):
                best, median, stepped_by = steps_per_second(creature, threads, copy)
                print(f"{creature:<12} {threads or os.cpu_count():>7} {copy!s:>7} {best:>14,.0f} {median:>12,.0f}  ({stepped_by})")


if __name__ == "__main__":
    main()
