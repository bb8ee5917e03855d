"""The body with the layout of Gymnasium's BipedalWalker-v3."""

import math

import gymnasium
import numpy as np
import pytest

import gambol

#: Of each action the joint's angle and speed among the observations.
JOINTS = [(4, 5), (6, 7), (9, 10), (11, 12)]


@pytest.fixture
def env():
    return gambol.CreatureEnv("bipedal-walker")


def test_spaces_are_those_of_gymnasium():
    env = gymnasium.make("gambol/BipedalWalker-v0")
    leg = [math.pi, 5, math.pi, 5, 5]
    high = np.array([math.pi, 5, 5, 5, *leg, *leg, *[1] * 10], np.float32)
    assert env.observation_space.shape == (24,) and env.observation_space.dtype == np.float32
    assert (env.observation_space.high == high).all()
    assert (env.observation_space.low == np.where(np.isin(np.arange(24), [8, 13]), 0, -high)).all()
    assert env.action_space == gymnasium.spaces.Box(-1, 1, (4,), np.float32)


def test_names_are_in_order():
    envs = gambol.make_vec("bipedal-walker")
    legs = [
        name
        for leg in "12"
        for name in (f"angle of thigh {leg}", f"speed of thigh {leg}", f"angle of shank {leg}", f"speed of shank {leg}", f"contact of shank {leg}")
    ]
    hull = ["rotation of hull", "spin of hull", "forward velocity of hull", "upward velocity of hull"]
    assert envs.observation_names[:14] == hull + legs
    assert all(name.startswith("distance at") for name in envs.observation_names[14:])
    assert [name.split()[-2:] for name in envs.action_names] == [["thigh", "1"], ["shank", "1"], ["thigh", "2"], ["shank", "2"]]


def test_it_stands_at_the_start(env):
    observation, _ = env.reset(seed=1)
    assert observation in env.observation_space
    assert abs(observation[0]) < 0.1 and np.abs(observation[1:4]).max() < 0.05
    assert observation[8] == observation[13] == 1
    assert np.abs(observation[[5, 7, 10, 12]]).max() < 0.1
    # Bent as its file draws it, but for what it has sunk while it settled.
    assert observation[[4, 9]] == pytest.approx([math.radians(4), math.radians(-4)], abs=0.05)
    assert observation[[6, 11]] == pytest.approx([1 - math.radians(8), 1 - math.radians(6)], abs=0.2)


def test_lidar_sees_level_ground_as_fractions_of_its_reach(env):
    observation, _ = env.reset(seed=1)
    height = env.parts()[0, 1]
    expected = [min(1.0, height / math.cos(0.15 * ray) / (160 / 30)) for ray in range(10)]
    assert observation[14:] == pytest.approx(expected, abs=1e-3)
    assert (np.diff(observation[14:22]) > 0).all() and observation[23] == 1


@pytest.mark.parametrize("joint", range(4))
@pytest.mark.parametrize("direction", [-1, 1])
def test_an_action_moves_its_joint_alone(joint, direction):
    # Nothing pulls, so that what is not moved stays.
    env = gambol.CreatureEnv("bipedal-walker", settings={"physics.gravity": 0.0, "physics.settle_time": 0.0})
    before, _ = env.reset(seed=1)
    action = np.zeros(4, np.float32)
    action[joint] = direction
    angles = [angle for angle, _ in JOINTS]
    for _ in range(4):
        after, *_ = env.step(action)
    moved = (after - before)[angles]
    is_at_limit = joint in (1, 3) and direction == 1
    assert np.abs(moved).argmax() == joint or is_at_limit
    assert np.abs(np.delete(moved, joint)).max() < max(0.03, 0.5 * abs(moved[joint]))
    if not is_at_limit:
        assert direction * moved[joint] > 0.1
        assert direction * after[JOINTS[joint][1]] > 0.2


def test_rotations_and_velocities_have_gymnasiums_scale(env):
    env.reset(seed=1)
    env.action_space.seed(1)
    x, y, angle = env.parts()[0]
    for _ in range(40):
        observation, *_ = env.step(env.action_space.sample())
        parts = env.parts()
        hull, thighs, shanks = parts[0], parts[[1, 3]], parts[[2, 4]]
        assert observation[0] == pytest.approx(hull[2], abs=1e-4)
        assert observation[[4, 9]] == pytest.approx(thighs[:, 2] - hull[2], abs=1e-4)
        assert observation[[6, 11]] == pytest.approx(shanks[:, 2] - thighs[:, 2] + 1, abs=1e-4)
        # A step lasts 1/50 s.
        assert observation[1] == pytest.approx(2 * (hull[2] - angle), abs=0.02)
        assert observation[2] == pytest.approx(0.3 * 20 * (hull[0] - x), abs=0.02)
        assert observation[3] == pytest.approx(0.3 * 40 / 3 * (hull[1] - y), abs=0.02)
        x, y, angle = hull


def test_all_that_it_shows_is_in_its_space():
    envs = gambol.make_vec("bipedal-walker", num_envs=32, terrain="hurdles:0.5", max_episode_steps=300, autoreset_mode="SameStep")
    one = gambol.CreatureEnv("bipedal-walker", terrain="hurdles:0.5", max_episode_steps=300)
    observations, _ = envs.reset(seed=1)
    single, _ = one.reset(seed=1)
    envs.action_space.seed(1)
    for _ in range(300):
        assert observations in envs.observation_space
        assert observations[0].tobytes() == single.tobytes()
        actions = envs.action_space.sample()
        observations, _, _, truncated, infos = envs.step(actions)
        single, *_ = one.step(actions[0])
    assert truncated.all() and infos["final_obs"][0].tobytes() == single.tobytes()


def test_the_layout_needs_its_senses():
    with pytest.raises(ValueError, match="sensors: the layout needs \"rotation of hull\", and there are spin of hull"):
        gambol.make_vec("bipedal-walker", settings={"sensors": ["torso-spin"]})
