"""What well-kept libraries expect of environments and strategies; each test is skipped where its library is not installed."""

import numpy as np
import pytest

import gambol


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("creature", ["biped-1", "bipedal-walker"])
def test_the_checker_of_stable_baselines_finds_nothing(creature):
    """Spaces, types, shapes, seeds."""
    checker = pytest.importorskip("stable_baselines3.common.env_checker", reason="Stable-Baselines3 is not installed")
    checker.check_env(gambol.CreatureEnv(creature, "running"), warn=True)


@pytest.mark.filterwarnings("ignore")
def test_ppo_of_stable_baselines_learns_a_little():
    """It trains on an environment as it is, and on what Gymnasium makes."""
    stable_baselines3 = pytest.importorskip("stable_baselines3", reason="Stable-Baselines3 is not installed")
    env = gambol.CreatureEnv("biped-1", "running", max_episode_steps=100)
    model = stable_baselines3.PPO("MlpPolicy", env, n_steps=256, seed=1, device="cpu").learn(512)
    action, _ = model.predict(env.reset(seed=1)[0], deterministic=True)
    assert action.shape == env.action_space.shape


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("kind", [gambol.CmaEs, gambol.OpenEs, gambol.Ars])
def test_a_strategy_is_an_optimiser_of_pycma(kind):
    """Its loop of ask and tell, which minimises, drives ours."""
    interfaces = pytest.importorskip("cma.interfaces", reason="pycma is not installed")

    class Ours(interfaces.OOOptimizer):
        def __init__(self, x0):
            self.xcurrent, self.countiter = x0, 0
            self.search = kind(len(x0), seed=1)

        def ask(self):
            return list(self.search.ask().astype(np.float64))

        def tell(self, solutions, function_values):
            assert len(solutions) == len(function_values)
            self.countiter += 1
            self.search.tell(-np.asarray(function_values))

        def stop(self):
            return {"iterations": self.countiter} if self.countiter >= 300 else {}

        @property
        def result(self):
            return self.search.best.weights, -self.search.best.fitness

    def far(x):
        return float(np.sum((x - 0.3) ** 2))

    found = Ours(np.zeros(6)).optimize(far).result
    assert found[1] < 0.05
