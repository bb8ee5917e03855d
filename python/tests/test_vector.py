"""Vector environments: Gymnasium's contract, rapier's bits, rewards that sum to the fitness."""

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import data_equivalence
from gymnasium.vector import AutoresetMode, SyncVectorEnv

import gambol


def actions_of(envs, steps, seed=0):
    """The same actions each time: float32[steps, num_envs, motors]."""
    shape = (steps, *envs.action_space.shape)
    return np.random.default_rng(seed).uniform(-1, 1, shape).astype(np.float32)


def play(envs, actions, seed=5):
    """All that an episode shows, as bytes."""
    observations, _ = envs.reset(seed=seed)
    shown = [observations.tobytes()]
    for action in actions:
        observations, rewards, terminated, truncated, infos = envs.step(action)
        shown += [observations.tobytes(), rewards.tobytes(), terminated.tobytes(), truncated.tobytes()]
        shown += [infos["fitness"].tobytes()] if "fitness" in infos else []
    return shown


def test_spaces_and_types():
    envs = gambol.make_vec("biped-1", "running", num_envs=20)
    assert envs.observation_space.shape == (20, 3)
    assert envs.action_space.shape == (20, 2)
    assert envs.single_observation_space == gymnasium.spaces.Box(-3, 3, (3,), np.float32)
    assert envs.single_action_space == gymnasium.spaces.Box(-1, 1, (2,), np.float32)
    assert envs.metadata["autoreset_mode"] is AutoresetMode.NEXT_STEP
    assert envs.observation_names == ["rotation of torso", "angle of left leg", "angle of right leg"]
    assert len(envs.action_names) == 2 and envs.unit == "m"
    assert envs.config["creature"]["name"] == "biped-1"
    observations, infos = envs.reset(seed=1)
    assert infos == {} and observations in envs.observation_space
    envs.action_space.seed(1)
    observations, rewards, terminated, truncated, infos = envs.step(envs.action_space.sample())
    assert observations in envs.observation_space and infos == {}
    assert rewards.dtype == np.float64 and terminated.dtype == truncated.dtype == np.bool_
    assert rewards.shape == terminated.shape == truncated.shape == (20,)
    assert envs.parts(0).shape == (3, 3)
    envs.close()


@pytest.mark.parametrize("movement", ["running", "jumping", "walking", "hopping"])
@pytest.mark.parametrize("creature", ["biped-1", "tetrapod-2"])
def test_rewards_sum_to_the_fitness(creature, movement):
    envs = gambol.make_vec(creature, movement, num_envs=17, max_episode_steps=120)
    envs.reset(seed=3)
    sums = np.zeros(17)
    for step, action in enumerate(actions_of(envs, 120)):
        _, rewards, terminated, truncated, infos = envs.step(action)
        sums += rewards
        np.testing.assert_allclose(envs.values, sums, rtol=0, atol=1e-10)
    assert truncated.all() and not terminated.any() and infos["_fitness"].all()
    np.testing.assert_allclose(infos["fitness"], sums, rtol=0, atol=1e-10)


@pytest.mark.parametrize("variation", [None, "strong"])
@pytest.mark.parametrize("terrain", [None, "hurdles:0.3"])
def test_lanes_have_the_bits_of_rapier(variation, terrain):
    settings = {"terrain": terrain, "variation": variation, "max_episode_steps": 40}
    lanes = gambol.make_vec("biped-2", "running", num_envs=18, **settings)
    rapier = gambol.make_vec("biped-2", "running", num_envs=18, engine="rapier", **settings)
    assert rapier.stepped_by == "rapier" != lanes.stepped_by
    actions = actions_of(lanes, 90)
    assert play(lanes, actions) == play(rapier, actions)


@pytest.mark.parametrize("mode", list(AutoresetMode)[:2])
def test_no_bit_depends_on_threads_or_on_neighbours(mode):
    def envs(count, threads):
        return gambol.make_vec(
            "tetrapod-1", num_envs=count, threads=threads, variation="light", max_episode_steps=30, autoreset_mode=mode
        )

    actions = actions_of(envs(100, 1), 70)
    alone = play(envs(100, 1), actions)
    assert envs(100, 4).threads == 4
    assert alone == play(envs(100, 4), actions)
    assert alone == play(envs(100, 0), actions)
    # Environment 40 alone, with its seed and its actions.
    single, many = envs(1, 1), envs(100, 1)
    single.reset(seed=5 + 40)
    many.reset(seed=5)
    for action in actions:
        ours, theirs = single.step(action[40:41]), many.step(action)
        for one, all_of_them in zip(ours[:4], theirs[:4], strict=True):
            assert one[0].tobytes() == all_of_them[40].tobytes()


def as_numbers(results):
    return [np.asarray(result) for result in results[:4]]


@pytest.mark.parametrize("mode", list(AutoresetMode))
def test_autoreset_is_that_of_gymnasium(mode):
    """Step for step what SyncVectorEnv does with single environments."""

    def single():
        return gambol.CreatureEnv("biped-1", max_episode_steps=7, variation="strong")

    ours = gambol.make_vec("biped-1", num_envs=3, max_episode_steps=7, variation="strong", autoreset_mode=mode)
    theirs = SyncVectorEnv([single] * 3, autoreset_mode=mode)
    first, second = ours.reset(seed=11), theirs.reset(seed=11)
    assert first[0].tobytes() == second[0].tobytes()
    for action in actions_of(ours, 40):
        first, second = ours.step(action), theirs.step(action)
        for mine, other in zip(as_numbers(first), as_numbers(second), strict=True):
            assert mine.dtype == other.dtype and mine.tobytes() == other.tobytes()
        assert data_equivalence(first[4], second[4]), (first[4], second[4])
        over = np.logical_or(first[2], first[3])
        if mode is AutoresetMode.DISABLED and over.any():
            with pytest.raises(ValueError, match="reset_mask"):
                ours.step(action)
            mask = {"reset_mask": over}
            first, second = ours.reset(options=dict(mask)), theirs.reset(options=dict(mask))
            assert first[0].tobytes() == second[0].tobytes()


def test_a_mask_and_seeds_reset_what_they_name():
    envs = gambol.make_vec("biped-1", num_envs=4, variation="strong", autoreset_mode="Disabled")
    start, _ = envs.reset(seed=[3, 4, 5, 6])
    envs.step(np.ones((4, 2), np.float32))
    mask = np.array([True, False, False, True])
    after, _ = envs.reset(seed=[3, None, None, 9], options={"reset_mask": mask})
    assert (after[0] == start[0]).all() and (after[3] != start[3]).any() and (after[1] != start[1]).any()
    with pytest.raises(ValueError, match=r"bool\[4\]"):
        envs.reset(options={"reset_mask": np.ones(3, np.bool_)})
    with pytest.raises(ValueError, match="length 4"):
        envs.reset(seed=[1, 2])


def test_an_action_that_is_no_number_fails_its_environment_alone():
    envs = gambol.make_vec("biped-1", num_envs=3)
    envs.reset(seed=1)
    actions = np.zeros((3, 2), np.float32)
    actions[1, 1] = np.nan
    observations, rewards, terminated, truncated, infos = envs.step(actions)
    assert terminated.tolist() == [False, True, False] and not truncated.any()
    assert infos["failure"].tolist() == [None, "output 1 is not finite", None]
    assert np.isnan(infos["fitness"][1]) and rewards[1] == 0.0 and np.isfinite(observations).all()
    # It begins anew in the next step.
    _, _, terminated, _, infos = envs.step(np.zeros((3, 2), np.float32))
    assert not terminated.any() and infos == {}


def test_without_copies_the_arrays_are_the_same():
    envs = gambol.make_vec("apod", num_envs=2, copy=False)
    first, _ = envs.reset(seed=1)
    second = envs.step(np.ones(envs.action_space.shape))[0]
    third = envs.step(np.ones(envs.action_space.shape))[0]
    assert first is second is third
    envs = gambol.make_vec("apod", num_envs=2)
    envs.reset(seed=1)
    second = envs.step(np.ones(envs.action_space.shape))
    kept = [array.copy() for array in second[:4]]
    envs.step(np.ones(envs.action_space.shape))
    for array, copy in zip(second[:4], kept, strict=True):
        assert array.tobytes() == copy.tobytes()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"creature": "biped-3"}, "biped-"),
        ({"movement": "runing"}, 'did you mean "running"'),
        ({"terrain": "hurdle"}, "hurdles"),
        ({"variation": "much"}, "variation"),
        ({"num_envs": 0}, "num_envs"),
        ({"settings": {"physics.gravitation": 1}}, "gravit"),
        ({"settings": {"physics.time_step": 3}}, "time_step"),
        ({"max_episode_steps": 0}, "steps"),
        ({"movement": "swimming", "engine": "lanes"}, "rapier"),
    ],
)
def test_what_is_wrong_is_said(arguments, message):
    with pytest.raises(ValueError, match=message):
        gambol.make_vec(**({"creature": "biped-1", "num_envs": 1} | arguments))


def test_wrong_actions_and_a_step_before_the_reset():
    envs = gambol.make_vec("biped-1", num_envs=2)
    with pytest.raises(RuntimeError, match="reset"):
        envs.step(np.zeros((2, 2), np.float32))
    envs.reset()
    with pytest.raises(ValueError, match=r"\(2, 2\)"):
        envs.step(np.zeros((2, 3), np.float32))


def test_gymnasium_makes_them_by_name():
    envs = gymnasium.make_vec("gambol/Tetrapod2Jumping-v0", num_envs=5, max_episode_steps=9, autoreset_mode="SameStep")
    assert isinstance(envs, gambol.VectorEnv) and envs.max_episode_steps == 9
    assert envs.spec is not None and envs.spec.id == "gambol/Tetrapod2Jumping-v0"
    envs.reset(seed=1)
    for _ in range(9):
        *_, truncated, infos = envs.step(np.zeros(envs.action_space.shape, np.float32))
    assert truncated.all() and set(infos) == {"final_obs", "_final_obs", "final_info", "_final_info"}


def test_the_wrappers_of_gymnasium_take_them():
    envs = gambol.make_vec("biped-1", num_envs=4, max_episode_steps=5)
    envs = gymnasium.wrappers.vector.RecordEpisodeStatistics(envs)
    envs.reset(seed=1)
    for _ in range(5):
        *_, infos = envs.step(np.ones((4, 2), np.float32))
    np.testing.assert_allclose(infos["episode"]["r"], infos["fitness"], atol=1e-6)
    assert infos["episode"]["l"].tolist() == [5] * 4
