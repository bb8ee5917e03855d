"""Steps a second of vector environments with random actions, on one core and on all; on one core beside them the
BipedalWalker of Gymnasium and of EnvPool, where they are installed.

pip install "gymnasium[box2d]" envpool; python benchmarks/environments.py
"""

import importlib.util
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


def gymnasium_walker():
    """Steps a second of Gymnasium's BipedalWalker, whose episodes begin anew as they end."""
    import gymnasium

    env = gymnasium.make("BipedalWalker-v3")
    env.reset(seed=1)
    env.action_space.seed(1)
    actions = [env.action_space.sample() for _ in range(50)]

    def step(number):
        _, _, terminated, truncated, _ = env.step(actions[number % len(actions)])
        if terminated or truncated:
            env.reset()

    return best_rate(step, steps=2000, envs=1)


def envpool_walker():
    """Steps a second of EnvPool's BipedalWalker in batches, on one thread."""
    import envpool

    count = 64
    envs = envpool.make("BipedalWalker-v3", env_type="gymnasium", num_envs=count, num_threads=1, seed=1)
    envs.reset()
    random = np.random.default_rng(1)
    actions = random.uniform(-1, 1, (50, count, 4)).astype(np.float32)
    return best_rate(lambda number: envs.step(actions[number % len(actions)]), steps=200, envs=count)


def best_rate(step, steps, envs):
    """The best of the rounds, in steps of one creature."""
    best = 0.0
    for _ in range(ROUNDS):
        start = time.perf_counter()
        for number in range(steps):
            step(number)
        best = max(best, steps * envs / (time.perf_counter() - start))
    return best


def main():
    """Prints a table."""
    load = ", ".join(f"{load:.1f}" for load in os.getloadavg())
    print(f"{NUM_ENVS} environments, random actions, {ROUNDS} rounds of {STEPS} steps; load of the machine: {load}")
    peers = {"Box2D": ("Gymnasium's BipedalWalker", gymnasium_walker), "envpool": ("EnvPool's BipedalWalker", envpool_walker)}
    rates = {}
    for package, (name, measured) in peers.items():
        if importlib.util.find_spec(package):
            rates[name] = measured()
            print(f"{name}, one core: {rates[name]:,.0f} steps/s")
        else:
            print(f"{name}: not measured, {package} is not installed")
    print(f"{'creature':<12} {'threads':>7} {'copies':>7} {'steps/s, best':>14} {'median':>12}")
    for creature in ("biped-1", "tetrapod-2"):
        for threads in (1, 0):
            for copy in (True, False):
                best, median, stepped_by = steps_per_second(creature, threads, copy)
                print(f"{creature:<12} {threads or os.cpu_count():>7} {copy!s:>7} {best:>14,.0f} {median:>12,.0f}  ({stepped_by})")
                if creature == "biped-1" and threads == 1 and copy:
                    for name, rate in rates.items():
                        print(f"{'':<12} {best / rate:,.0f} times {name}")


if __name__ == "__main__":
    main()
