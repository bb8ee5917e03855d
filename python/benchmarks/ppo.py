"""PPO of Stable-Baselines3 beside CMA-ES on the same creatures: by ask and tell for a small net in the same environments, and as
the program trains by itself. All are judged in the same worlds: fitness by steps and by seconds.

pip install stable-baselines3; python benchmarks/ppo.py --out ppo.csv [--creatures tetrapod-2 biped-1] [--seeds 1 2 3]
    [--steps 5000000]
"""

import argparse
import csv
import tempfile
import time
from pathlib import Path

import numpy as np
from stable_baselines3 import PPO
from stable_baselines3.common.callbacks import BaseCallback
from stable_baselines3.common.vec_env import VecEnv, VecNormalize

import gambol

MOVEMENT = "running"
#: The senses that the program trains with, which have speeds and a clock, and the distance alone as fitness.
TASK = {"preset": "default", "settings": {"movement.terms": []}}
#: A learner is judged in as many worlds.
WORLDS = 16
#: How many nets a generation of CMA-ES has, and how many hidden neurons a net.
POPULATION, HIDDEN = 64, 16


class Lanes(VecEnv):
    """Gambol's vector environment as Stable-Baselines3 wants one."""

    def __init__(self, envs, seed):
        """``envs``: with same-step autoreset."""
        super().__init__(envs.num_envs, envs.single_observation_space, envs.single_action_space)
        self.envs, self._seed = envs, seed
        self.render_mode = None
        self.finished = []

    def reset(self):
        """All begin."""
        return self.envs.reset(seed=self._seed)[0]

    def step_async(self, actions):
        """The step is done in one call."""
        self._actions = actions

    def step_wait(self):
        """A step of all."""
        observations, rewards, terminated, truncated, infos = self.envs.step(self._actions)
        dones = terminated | truncated
        told = [{}] * self.num_envs
        if dones.any():
            last = infos["final_obs"]
            fitness = infos["final_info"]["fitness"]
            for index in np.flatnonzero(dones):
                told[index] = {
                    "terminal_observation": np.asarray(last[index], np.float32),
                    "TimeLimit.truncated": bool(truncated[index] and not terminated[index]),
                }
                self.finished.append(float(fitness[index]))
        return observations, rewards.astype(np.float32), dones, told

    def close(self):
        """Ends it."""
        self.envs.close()

    def get_attr(self, attr_name, indices=None):
        """One of all."""
        return [getattr(self.envs, attr_name, None)] * self.num_envs

    def set_attr(self, attr_name, value, indices=None):
        """Nothing can be set."""
        raise NotImplementedError

    def env_method(self, method_name, *arguments, indices=None, **keywords):
        """Nothing can be called."""
        raise NotImplementedError

    def env_is_wrapped(self, wrapper_class, indices=None):
        """Nothing is wrapped."""
        return [False] * self.num_envs


class Judge:
    """Plays policies in worlds that are the same for all."""

    def __init__(self, creature):
        """``creature``: whose."""
        self.worlds = gambol.make_vec(creature, MOVEMENT, num_envs=WORLDS, **TASK)

    def __call__(self, act):
        """The median fitness of an episode; ``act``: observations to actions."""
        observations, _ = self.worlds.reset(seed=1)
        fitness = np.full(WORLDS, np.nan)
        running = np.ones(WORLDS, bool)
        while running.any():
            observations, _, _, _, infos = self.worlds.step(np.clip(act(observations), -1, 1))
            ended = running & infos.get("_fitness", False)
            fitness[ended] = infos["fitness"][ended] if ended.any() else np.nan
            running &= ~ended
        return float(np.nanmedian(fitness))


class Curve(BaseCallback):
    """Writes down how good the policy is without noise, before each collection of experience."""

    def __init__(self, judge, write, begun):
        """``write``: is called with steps, seconds and fitness."""
        super().__init__()
        self.judge, self.write, self.begun = judge, write, begun
        self.judging = 0.0

    def _on_step(self):
        return True

    def _on_rollout_start(self):
        start = time.perf_counter()
        fitness = self.judge(self.act)
        self.judging += time.perf_counter() - start
        self.write(self.num_timesteps, time.perf_counter() - self.begun - self.judging, fitness)

    def act(self, observations):
        """What the policy does without noise."""
        normalised = self.model.get_vec_normalize_env().normalize_obs(observations)
        return self.model.predict(normalised, deterministic=True)[0]


def ppo(creature, seed, steps, write):
    """PPO with 1,024 environments."""
    envs = gambol.make_vec(creature, MOVEMENT, num_envs=1024, **TASK, autoreset_mode="SameStep")
    lanes = VecNormalize(Lanes(envs, seed), clip_reward=np.inf)
    begun = time.perf_counter()
    model = PPO(
        "MlpPolicy", lanes, n_steps=32, batch_size=8192, n_epochs=5, gamma=0.99, learning_rate=3e-4, seed=seed,
        policy_kwargs={"log_std_init": -0.5}, device="cpu",
    )
    model.learn(steps, callback=Curve(Judge(creature), write, begun))


class Nets:
    """Nets of one hidden layer whose weights are rows of a matrix; each has observations of its own."""

    def __init__(self, weights, inputs, outputs):
        """``weights``: ``[nets, (inputs + 1) * HIDDEN + (HIDDEN + 1) * outputs]``."""
        first = (inputs + 1) * HIDDEN
        self.first = weights[:, :first].reshape(-1, inputs + 1, HIDDEN)
        self.second = weights[:, first:].reshape(-1, HIDDEN + 1, outputs)

    def __call__(self, observations):
        """The actions, ``[nets, outputs]``."""
        hidden = np.tanh(np.matmul(observations[:, None], self.first[:, :-1])[:, 0] + self.first[:, -1])
        return np.tanh(np.matmul(hidden[:, None], self.second[:, :-1])[:, 0] + self.second[:, -1])


def cma_es(creature, seed, steps, write):
    """CMA-ES by ask and tell: a population's episodes begin alike, in other worlds each generation. The best is judged."""
    envs = gambol.make_vec(creature, MOVEMENT, num_envs=POPULATION, **TASK)
    inputs, outputs = envs.single_observation_space.shape[0], envs.single_action_space.shape[0]
    search = gambol.CmaEs((inputs + 1) * HIDDEN + (HIDDEN + 1) * outputs, seed=seed, population=POPULATION)
    judge, begun, judging = Judge(creature), time.perf_counter(), 0.0
    taken, generation, next_judged = 0, 0, 1
    while taken < steps:
        weights = search.ask()
        nets = Nets(weights, inputs, outputs)
        observations, _ = envs.reset(seed=[1_000 * seed + generation] * POPULATION)
        fitness, running = np.zeros(POPULATION), np.ones(POPULATION, bool)
        while running.any():
            observations, rewards, terminated, truncated, _ = envs.step(nets(observations))
            fitness += rewards * running
            taken += int(running.sum())
            running &= ~(terminated | truncated)
        search.tell(fitness)
        generation += 1
        if generation == next_judged or taken >= steps:
            start = time.perf_counter()
            best = np.repeat(weights[[np.argmax(fitness)]], WORLDS, axis=0)
            median = judge(Nets(best, inputs, outputs))
            judging += time.perf_counter() - start
            write(taken, time.perf_counter() - begun - judging, median)
            next_judged = max(generation + 1, int(generation * 1.3))


def program(creature, seed, steps, write):
    """The program's own training, ended after 1, 2, 4, … generations. Its champion is the best of those whose gait is usable."""
    judge, generations, taken = Judge(creature), 1, 0
    while taken < steps:
        with tempfile.TemporaryDirectory() as folder:
            begun = time.perf_counter()
            run = gambol.train(
                creature, MOVEMENT, out=Path(folder) / "run", seed=seed, generations=generations
            )
            seconds, taken = time.perf_counter() - begun, run.log["steps"][-1]
            write(taken, seconds, judge(run.champion.controller()))
        generations *= 2


def main():
    """Writes a table and prints the ends."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--creatures", nargs="+", default=["tetrapod-2", "biped-1"])
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--steps", type=int, default=5_000_000)
    given = parser.parse_args()
    with given.out.open("w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["creature", "learner", "seed", "steps", "seconds", "fitness"])
        for creature in given.creatures:
            for learner in (cma_es, ppo, program):
                for seed in given.seeds:
                    last = None

                    def write(steps, seconds, fitness):
                        nonlocal last
                        last = steps, seconds, fitness
                        table.writerow([creature, learner.__name__, seed, steps, f"{seconds:.3f}", f"{fitness:.4f}"])

                    learner(creature, seed, given.steps, write)
                    file.flush()
                    print(
                        f"{creature}, {learner.__name__}, seed {seed}: {last[0]:,} steps, {last[1]:.1f} s, {last[2]:.2f} m",
                        flush=True,
                    )


if __name__ == "__main__":
    main()
