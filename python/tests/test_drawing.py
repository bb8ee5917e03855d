"""Pictures of creatures, and the window that shows them."""

import sys
import time
import warnings

import gymnasium
import numpy as np
import pytest
from gymnasium.error import DependencyNotInstalled, ResetNeeded

import gambol


@pytest.fixture
def no_display(monkeypatch):
    """pygame, drawing into memory."""
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    with warnings.catch_warnings():
        # Its own imports are old.
        warnings.simplefilter("ignore")
        return pytest.importorskip("pygame")


def drawn(creature="biped-1", movement="running", **options):
    env = gambol.CreatureEnv(creature, movement, render_mode="rgb_array", **options)
    env.reset(seed=1)
    return env


def act(env, steps, seed=1):
    env.action_space.seed(seed)
    for _ in range(steps):
        env.step(env.action_space.sample())


@pytest.mark.parametrize("creature, movement", [("biped-1", "running"), ("apod", "swimming"), ("bipedal-walker", "running")])
def test_a_picture_is_an_array_of_its_size(creature, movement):
    frame = drawn(creature, movement).render()
    assert frame.shape == (400, 600, 3) and frame.dtype == np.uint8
    assert len(np.unique(frame.reshape(-1, 3), axis=0)) > 5
    assert drawn(creature, movement, render_size=(320, 64)).render().shape == (64, 320, 3)


def test_equal_states_are_drawn_alike_and_others_are_not():
    one, other = drawn(), drawn()
    assert one.render().tobytes() == one.render().tobytes() == other.render().tobytes()
    start = one.render()
    act(one, 20)
    assert one.render().tobytes() != start.tobytes()
    act(other, 20)
    assert one.render().tobytes() == other.render().tobytes()


def test_drawing_changes_no_bit_of_an_episode():
    plain, seen = gambol.CreatureEnv("biped-1"), drawn()
    plain.reset(seed=1)
    for _ in range(30):
        action = plain.action_space.sample()
        expected, found = plain.step(action), seen.step(action)
        seen.render()
        assert expected[0].tobytes() == found[0].tobytes() and expected[1:] == found[1:]


def test_the_camera_follows_and_marks_stay():
    env = drawn("tetrapod-2", variation="none")
    for _ in range(200):
        env.step(np.ones(env.action_space.shape, np.float32))
        frame = env.render()
        coloured = (frame.max(axis=2) - frame.min(axis=2) > 60) | (frame.max(axis=2) < 80)
        columns = np.flatnonzero(coloured[:300].any(axis=0))
        assert columns.min() > 0 and columns.max() < 599, "the creature is seen whole"


def test_the_ground_is_that_of_the_episode():
    pictures = {terrain: drawn(terrain=terrain, settings={"terrain.run_up": 0.3}).render() for terrain in ("flat", "stairs-up")}
    assert (pictures["flat"] != pictures["stairs-up"]).any()


def test_a_vector_draws_each_environment():
    envs = gambol.make_vec("biped-1", num_envs=18, render_mode="rgb_array", render_size=(120, 80))
    with pytest.raises(ResetNeeded):
        envs.render()
    envs.reset(seed=1)
    frames = envs.render()
    assert isinstance(frames, tuple) and len(frames) == 18
    assert all(frame.shape == (80, 120, 3) and frame.dtype == np.uint8 for frame in frames)
    actions = np.zeros((18, 2), np.float32)
    actions[3] = 1
    for _ in range(20):
        envs.step(actions)
    frames = envs.render()
    assert frames[0].tobytes() == frames[17].tobytes() != frames[3].tobytes()
    alone = drawn(render_size=(120, 80))
    for _ in range(20):
        alone.step(actions[0])
    assert alone.render().tobytes() == frames[0].tobytes()


def test_what_cannot_be_drawn_is_refused():
    with pytest.raises(ValueError, match="render_mode = 'ansi': must be None or 'human' or 'rgb_array'"):
        gambol.CreatureEnv("biped-1", render_mode="ansi")
    with pytest.raises(ValueError, match="render_mode = 'human': must be None or 'rgb_array'"):
        gambol.make_vec("biped-1", render_mode="human")
    for size in [(15, 400), (600, 4097), (600,), (600.5, 400)]:
        with pytest.raises(ValueError, match="render_size = .*from 16 to 4096 px"):
            gambol.make_vec("biped-1", render_mode="rgb_array", render_size=size)
    env = gambol.CreatureEnv("biped-1", render_mode="rgb_array")
    with pytest.raises(ResetNeeded):
        env.render()


def test_without_a_mode_nothing_is_drawn():
    env = gambol.CreatureEnv("biped-1")
    env.reset(seed=1)
    with pytest.warns(UserWarning, match="render_mode"):
        assert env.render() is None


def test_gymnasium_makes_environments_that_draw():
    env = gymnasium.make("gambol/Biped1Running-v0", render_mode="rgb_array")
    env.reset(seed=1)
    assert env.render().shape == (400, 600, 3)
    assert env.metadata["render_modes"] == ["human", "rgb_array"] and env.metadata["render_fps"] == 50
    envs = gymnasium.make_vec("gambol/Biped1Running-v0", num_envs=2, render_mode="rgb_array")
    envs.reset(seed=1)
    assert len(envs.render()) == 2 and envs.metadata["render_modes"] == ["rgb_array"]


def test_the_frames_a_second_are_the_steps_a_second():
    env = gambol.CreatureEnv("biped-1", render_mode="rgb_array", settings={"physics.time_step": 0.01})
    assert env.metadata["render_fps"] == 100 and gambol.CreatureEnv.metadata["render_fps"] == 50


def test_a_window_shows_each_step_at_the_speed_of_the_physics(no_display):
    env = gymnasium.make("gambol/Biped1Running-v0", render_mode="human")
    env.reset(seed=1)
    shown = no_display.display.get_surface()
    assert shown.get_size() == (600, 400)
    before = no_display.surfarray.array3d(shown)
    start = time.monotonic()
    act(env, 25)
    assert time.monotonic() - start > 0.4
    after = no_display.surfarray.array3d(shown)
    assert (before != after).any() and env.render() is None
    twin = drawn()
    act(twin, 25)
    assert (after == twin.render().swapaxes(0, 1)).all()
    env.close()
    assert not no_display.display.get_init()
    env.close()


def test_without_pygame_a_window_says_how_to_get_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "pygame", None)
    with pytest.raises(DependencyNotInstalled, match="pip install pygame"):
        gambol.CreatureEnv("biped-1", render_mode="human")
