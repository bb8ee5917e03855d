"""Numbers that are out of their range, and those of NumPy."""

import numpy as np
import pytest

import gambol


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"num_envs": -1}, "num_envs = -1: must be from 1 to 1048576"),
        ({"num_envs": 2**24}, "num_envs = 16777216: must be from 1 to 1048576"),
        ({"max_episode_steps": -5}, "max_episode_steps = -5: must be from 1 to 1000000"),
        ({"threads": 2000}, "threads = 2000: must be from 0 to 1024"),
        ({"settings": {"physics.gravity": float("nan")}}, "physics.gravity = nan: must be of finite numbers"),
    ],
)
def test_an_argument_of_environments_is_named(arguments, message):
    """Whichever way it is wrong."""
    with pytest.raises(ValueError, match=message):
        gambol.make_vec("biped-1", "running", **arguments)


@pytest.mark.parametrize("seed", [-1, 2**64 - 1, [0, -1], [2**64, 1]])
def test_seeds_are_checked(seed):
    """Those of all environments."""
    envs = gambol.make_vec("biped-1", "running", num_envs=2)
    with pytest.raises(ValueError, match="seed = .*: must be from 0 to"):
        envs.reset(seed=seed)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"seed": -1}, "seed = -1: must be from 0 to 18446744073709551615"),
        ({"generations": 0}, "generations = 0: must be from 1 to"),
        ({"population": -3}, "population = -3: must be from 1 to"),
        ({"threads": -1}, "threads = -1: must be from 0 to 1024"),
    ],
)
def test_an_argument_of_training_is_named(tmp_path, arguments, message):
    """Nothing is written."""
    with pytest.raises(ValueError, match=message):
        gambol.train("biped-1", "running", out=tmp_path / "run", **arguments)
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: gambol.CmaEs(3, seed=-1), "seed = -1: must be from 0"),
        (lambda: gambol.CmaEs(-3), "dimension = -3: must be from 0"),
        (lambda: gambol.CmaEs(layers=(3, -2)), r"layers\[1\] = -2: must be from 0"),
        (lambda: gambol.CmaEs(3, step_size=float("nan")), "must be of finite numbers"),
        (lambda: gambol.Neat(-1, 1), "inputs = -1: must be from 0"),
    ],
)
def test_an_argument_of_a_strategy_is_named(make, message):
    """None overflows."""
    with pytest.raises(ValueError, match=message):
        make()


def test_layers_are_whole_numbers():
    """Not what begins as one."""
    with pytest.raises(TypeError, match=r"layers\[1\] must be a whole number"):
        gambol.CmaEs(layers=(3, 2.7))
    assert gambol.CmaEs(3, population=np.int64(9), step_size=np.float32(0.5)).ask().shape == (9, 3)


def test_numbers_of_numpy_are_numbers(tmp_path):
    """In arguments and in settings."""
    settings = {"physics.gravity": np.float32(5.0), "movement.steps": np.int64(40), "controller.hidden": np.array([3, 3])}
    run = gambol.train(
        "biped-1", "running", out=tmp_path / "run", preset="plain", generations=np.int32(1), population=np.uint8(4), settings=settings
    )
    assert run.config["physics"]["gravity"] == 5.0
    envs = gambol.make_vec("biped-1", "running", num_envs=np.int64(2), settings=settings)
    observations, _ = envs.reset(seed=np.int64(3), options={"reset_mask": np.ones(4, bool)[::2]})
    assert observations.shape[0] == 2
