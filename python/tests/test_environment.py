"""Single environments, by Gymnasium's own checks."""

import warnings
from pathlib import Path

import gymnasium
import numpy as np
import pytest
from gymnasium.error import ResetNeeded
from gymnasium.utils.env_checker import check_env

import gambol
from gambol._gambol import episode_facts
from gambol._registration import USABLE_SPEED


@pytest.mark.parametrize("movement", ["running", "jumping", "swimming", "playing"])
def test_check_env(movement):
    env = gambol.CreatureEnv("tetrapod-2", movement)
    with warnings.catch_warnings():
        # It has no spec unless it is made by its id.
        warnings.simplefilter("ignore")
        check_env(env, skip_render_check=True)


@pytest.mark.parametrize("name", ["gambol/Tetrapod2Running-v0", "gambol/ApodSwimming-v0", "gambol/BipedalWalker-v0"])
def test_check_env_with_every_render_mode(name, monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        pytest.importorskip("pygame")
        check_env(gymnasium.make(name, render_mode="rgb_array").unwrapped)


def test_every_shipped_creature_and_movement_is_registered_and_can_be_made():
    ids = [gambol.environment_id(creature, movement) for creature in gambol.creature_names() for movement in gambol.movement_names()]
    assert "gambol/Biped1Running-v0" in ids
    ids.append("gambol/BipedalWalker-v0")
    assert set(ids) == {name for name in gymnasium.registry if name.startswith("gambol/")}
    for name in ids:
        env = gymnasium.make(name, disable_env_checker=True)
        observation, _ = env.reset(seed=1)
        assert observation in env.observation_space, name
        env.action_space.seed(1)
        observation, reward, terminated, truncated, infos = env.step(env.action_space.sample())
        assert observation in env.observation_space and isinstance(reward, float), name


def test_one_is_an_environment_of_the_vector():
    env = gymnasium.make("gambol/Biped1Running-v0", variation="strong", max_episode_steps=50)
    envs = gambol.make_vec("biped-1", num_envs=3, variation="strong", max_episode_steps=50)
    one, _ = env.reset(seed=8)
    many, _ = envs.reset(seed=[7, 8, 9])
    assert one.tobytes() == many[1].tobytes()
    total = 0.0
    for _ in range(50):
        action = np.full(2, 0.5, np.float32)
        one, reward, terminated, truncated, infos = env.step(action)
        many, rewards, *_ = envs.step(np.tile(action, (3, 1)))
        total += reward
        assert one.tobytes() == many[1].tobytes() and reward == rewards[1]
    assert truncated and not terminated and env.unwrapped.value == pytest.approx(total, abs=1e-10)
    assert env.unwrapped.value == envs.values[1]


def test_the_length_is_that_of_the_registration_or_of_the_caller():
    env = gymnasium.make("gambol/Biped1Jumping-v0", max_episode_steps=3)
    env.reset(seed=1)
    for step in range(3):
        *_, truncated, _ = env.step(np.zeros(2, np.float32))
        assert truncated == (step == 2)
    env = gambol.CreatureEnv("biped-1", "jumping", max_episode_steps=3)
    env.reset(seed=1)
    for step in range(3):
        *_, truncated, infos = env.step(np.zeros(2, np.float32))
        assert truncated == (step == 2) == ("fitness" in infos)
    with pytest.raises(ResetNeeded, match="the episode has ended"):
        env.step(np.zeros(2, np.float32))
    with pytest.raises(ResetNeeded, match="before step"):
        gambol.CreatureEnv("biped-1", "jumping").step(np.zeros(2, np.float32))


def test_a_spec_says_how_long_an_episode_is_and_how_far_a_usable_one_gets():
    for creature in gambol.creature_names():
        for movement in gambol.movement_names():
            spec = gymnasium.spec(gambol.environment_id(creature, movement))
            assert spec.max_episode_steps == gambol.CreatureEnv(creature, movement).max_episode_steps
            assert (spec.reward_threshold is None) == (movement not in ("running", "backwards", "swimming"))
    # 0.5 body lengths/s for 20 s.
    spec = gymnasium.spec("gambol/Biped1Running-v0")
    assert spec.max_episode_steps == 1000
    assert spec.reward_threshold == pytest.approx(0.5 * 20 * episode_facts("biped-1")[0], rel=1e-6)
    envs = gymnasium.make_vec("gambol/Biped1Running-v0", num_envs=2)
    assert envs.max_episode_steps == 1000 and envs.spec.reward_threshold == spec.reward_threshold


def test_a_limit_of_the_registration_changes_no_end():
    env = gymnasium.make("gambol/Biped1Jumping-v0")
    env.reset(seed=1)
    for step in range(250):
        *_, truncated, infos = env.step(np.zeros(2, np.float32))
        assert truncated == (step == 249) == ("fitness" in infos)


def test_the_usable_speed_is_that_of_the_judge():
    page = Path(__file__).parents[2] / "docs"
    speed = f"{USABLE_SPEED} body lengths/s"
    assert f"the mean forward speed is at least **{speed}**" in (page / "gaits.md").read_text("utf-8")
    assert f"gets ahead at {speed} or more" in (page / "movements.md").read_text("utf-8")
