"""PPO of Stable-Baselines3 and the CMA-ES of Gambol on the same creature: fitness by steps and by seconds.

pip install stable-baselines3; python benchmarks/ppo.py --out ppo.csv [--seeds 1 2 3] [--steps 5000000]
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

CREATURE, MOVEMENT = "biped-1", "running"
#: The senses that the program trains with, which have speeds and a clock, and the distance alone as fitness.
TASK = {"preset": "default", "settings": {"movement.terms": []}}


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


class Curve(BaseCallback):
    """Writes down how good the deterministic policy is after each update."""

    def __init__(self, lanes, write, begun):
        """``write``: is called with steps, seconds and fitness."""
        super().__init__()
        self.lanes, self.write, self.begun = lanes, write, begun
        self.judging = 0.0
        self.test = gambol.make_vec(CREATURE, MOVEMENT, num_envs=16, **TASK)

    def _on_step(self):
        return True

    def _on_rollout_start(self):
        start = time.perf_counter()
        fitness = self.judge()
        self.judging += time.perf_counter() - start
        self.write(self.num_timesteps, time.perf_counter() - self.begun - self.judging, fitness)

    def judge(self):
        """The median fitness of an episode without noise, in 16 worlds."""
        normalised = self.model.get_vec_normalize_env()
        observations, _ = self.test.reset(seed=1)
        fitness = np.full(self.test.num_envs, np.nan)
        running = np.ones(self.test.num_envs, bool)
        while running.any():
            actions, _ = self.model.predict(normalised.normalize_obs(observations), deterministic=True)
            observations, _, _, _, infos = self.test.step(np.clip(actions, -1, 1))
            ended = running & infos.get("_fitness", False)
            fitness[ended] = infos["fitness"][ended] if ended.any() else np.nan
            running &= ~ended
        return float(np.nanmedian(fitness))


def ppo(seed, steps, write):
    """PPO with 1,024 environments."""
    envs = gambol.make_vec(CREATURE, MOVEMENT, num_envs=1024, **TASK, autoreset_mode="SameStep")
    lanes = VecNormalize(Lanes(envs, seed), clip_reward=np.inf)
    begun = time.perf_counter()
    model = PPO(
        "MlpPolicy", lanes, n_steps=64, batch_size=4096, n_epochs=5, gamma=0.99, learning_rate=5e-4, seed=seed,
        use_sde=True, sde_sample_freq=8, policy_kwargs={"log_std_init": -0.5}, device="cpu",
    )
    model.learn(steps, callback=Curve(lanes, write, begun))
    return envs


def cma_es(seed, steps, write):
    """The program's own training: of its champion one episode in rapier, where PPO has the median of 16 worlds."""
    with tempfile.TemporaryDirectory() as folder:
        begun = time.perf_counter()

        def told(line):
            write(line["steps"], time.perf_counter() - begun, line["best_so_far"])
            return line["steps"] >= steps

        gambol.train(
            CREATURE, MOVEMENT, out=Path(folder) / "run", **TASK, strategy="cma-es", seed=seed, generations=10**6, callback=told
        )


def main():
    """Writes a table and prints the ends."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--steps", type=int, default=5_000_000)
    given = parser.parse_args()
    with given.out.open("w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["learner", "seed", "steps", "seconds", "fitness"])
        for learner in (cma_es, ppo):
            for seed in given.seeds:
                last = None

                def write(steps, seconds, fitness):
                    nonlocal last
                    if fitness is None:
                        # Nothing has been judged yet.
                        return
                    last = steps, seconds, fitness
                    table.writerow([learner.__name__, seed, steps, f"{seconds:.3f}", f"{fitness:.4f}"])

                learner(seed, given.steps, write)
                file.flush()
                print(f"{learner.__name__}, seed {seed}: {last[0]:,} steps, {last[1]:.1f} s, fitness {last[2]:.2f}", flush=True)


if __name__ == "__main__":
    main()
