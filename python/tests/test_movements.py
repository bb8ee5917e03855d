"""Movements written in Python."""

import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import gambol


class Distance:
    """Running, once more: how far the torso gets forwards."""

    def begin(self, start):
        """From here."""
        self.start = self.here = float(start.parts[0, 0])

    def observe(self, now):
        """To there."""
        self.here = float(now.parts[0, 0])

    def value(self):
        """The way."""
        return self.here - self.start


class Lazy(Distance):
    """Ends after half a second."""

    def observe(self, now):
        """By the clock."""
        super().observe(now)
        return now.time > 0.5


class Broken(Distance):
    """Fails in its tenth step."""

    steps = 0

    def observe(self, now):
        """So far."""
        self.steps += 1
        if self.steps == 10:
            raise LookupError("the tenth step")


@pytest.fixture(scope="module", autouse=True)
def registered():
    """They are known from then on."""
    gambol.register_movement("far", Distance, steps=120, description="distance, in Python")
    gambol.register_movement("far-for-a-while", Lazy, steps=120)
    gambol.register_movement("broken", Broken, steps=120)


def step_all(envs, steps, seed=0):
    """Rewards of random actions."""
    envs.reset(seed=1)
    envs.action_space.seed(seed)
    return np.array([envs.step(envs.action_space.sample())[1] for _ in range(steps)])


def test_it_is_what_the_same_in_rust_is():
    """But for what Rust's running does beside."""
    mine = gambol.make_vec("biped-1", "far", num_envs=20, threads=2)
    other = gambol.make_vec("biped-1", "running", num_envs=20, max_episode_steps=120)
    assert np.allclose(step_all(mine, 100), step_all(other, 100), atol=1e-6)
    assert mine.unit == "m" and mine.max_episode_steps == 120
    assert "far" in gambol.movement_names()


def test_it_may_end_an_episode():
    """As it says."""
    env = gambol.CreatureEnv("biped-1", "far-for-a-while")
    env.reset(seed=1)
    steps = 1
    while not env.step(np.zeros(2))[2]:
        steps += 1
    assert 24 <= steps <= 27


def test_it_is_trained_for(tmp_path):
    """Twice to the same champion."""
    runs = [
        gambol.train("biped-1", "far", out=tmp_path / name, preset="plain", generations=5, population=16, threads=threads)
        for name, threads in (("one", 1), ("two", 2))
    ]
    assert runs[0].log["best"][-1] == runs[1].log["best"][-1] > 0
    assert runs[0].champion.verify()
    assert runs[0].champion.data["movement"]["name"] == "far"


def test_what_it_raises_is_raised(tmp_path):
    """By environments and by training."""
    env = gambol.CreatureEnv("biped-1", "broken")
    env.reset(seed=1)
    with pytest.raises(LookupError, match="the tenth step"):
        for _ in range(20):
            env.step(np.zeros(2))
    with pytest.raises(LookupError, match="the tenth step"):
        gambol.train("biped-1", "broken", out=tmp_path / "run", preset="plain", generations=5, population=4)
    with pytest.raises(LookupError, match="the tenth step"):
        gambol.train("biped-1", "broken", out=tmp_path / "last", preset="plain", generations=1, population=4)


def test_what_a_term_raises_is_raised(tmp_path):
    """It is a movement as any other."""
    settings = {"movement.terms": [{"term": "broken", "weight": 1}]}
    envs = gambol.make_vec("biped-1", "running", settings=settings)
    envs.reset(seed=1)
    with pytest.raises(LookupError, match="the tenth step"):
        for _ in range(20):
            envs.step(np.zeros((1, 2)))
    with pytest.raises(LookupError, match="the tenth step"):
        gambol.train("biped-1", "running", out=tmp_path / "run", preset="plain", generations=2, population=4, settings=settings)
    well = gambol.make_vec("biped-1", "running")
    well.reset(seed=1)
    well.step(np.zeros((1, 2)))


class Unready(Distance):
    """Cannot begin."""

    def begin(self, start):
        """Never."""
        raise KeyError("no beginning")


def test_what_it_raised_once_is_not_raised_again(tmp_path):
    """Also when it was raised as an episode began, and when the champion was played at the end."""
    gambol.register_movement("mended", Unready, steps=120)
    with pytest.raises(KeyError, match="no beginning"):
        gambol.train("biped-1", "mended", out=tmp_path / "badly", preset="plain", generations=2, population=4)
    gambol.register_movement("mended", Distance, steps=120)
    gambol.CreatureEnv("biped-1", "mended").reset(seed=1)
    gambol.train("biped-1", "mended", out=tmp_path / "well", preset="plain", generations=2, population=4)


def test_an_episode_that_could_not_begin_says_nothing_of_the_next():
    """The first of all is broken off, as Ctrl-C would."""
    begun = []

    class Interrupted(Distance):
        def begin(self, start):
            begun.append(self)
            if len(begun) == 1:
                raise KeyboardInterrupt
            super().begin(start)

    gambol.register_movement("interrupted", Interrupted, steps=5)
    envs = gambol.make_vec("biped-1", "interrupted", num_envs=1)
    with pytest.raises(KeyboardInterrupt):
        envs.reset(seed=1)
    envs.reset(seed=1)
    for _ in range(5):
        *_, infos = envs.step(np.zeros((1, 2), np.float32))
    assert "failure" not in infos
    assert np.isfinite(infos["fitness"][0])


def test_what_it_raises_is_raised_where_champions_are_played(tmp_path):
    """And nowhere else."""
    gambol.register_movement("fragile", Distance, steps=20)
    run = gambol.train("biped-1", "fragile", out=tmp_path / "run", generations=1, population=8, settings={"variation": "none"})
    assert run.champion.verify()
    gambol.register_movement("fragile", Broken, steps=20)
    for play in (run.champion.verify, lambda: run.champion.replay(tmp_path / "page.html")):
        with pytest.raises(LookupError, match="the tenth step"):
            play()
    gambol.register_movement("fragile", Distance, steps=20)
    gambol.make_vec("biped-1", "fragile", num_envs=1).reset(seed=1)
    assert run.champion.verify()


def test_movements_are_registered_by_several_threads_and_by_each_other():
    """None waits for ever."""

    def slow(name):
        def make():
            time.sleep(0.05)
            return Distance()

        gambol.register_movement(name, make, steps=120)

    def nested():
        gambol.register_movement("within", Distance, steps=120)
        return Distance()

    with ThreadPoolExecutor() as threads:
        list(threads.map(slow, ["one-of-two", "two-of-two"]))
    gambol.register_movement("around", nested, steps=120)
    assert {"one-of-two", "two-of-two", "within", "around"} <= set(gambol.movement_names())


def test_each_of_two_trainings_raises_what_is_its_own(tmp_path):
    """In threads: of another movement's error the one that goes well hears nothing."""

    def train(movement, steps):
        return gambol.train("biped-1", movement, out=tmp_path / movement, preset="plain", generations=steps, population=4)

    with ThreadPoolExecutor() as threads:
        well, badly = threads.submit(train, "far", 20), threads.submit(train, "broken", 20)
        with pytest.raises(LookupError, match="the tenth step"):
            badly.result()
        assert len(well.result().log["best"]) == 20


def test_names_and_numbers_are_checked():
    """As they are registered."""
    with pytest.raises(ValueError, match='name = "running": the library has a movement of that name'):
        gambol.register_movement("running", Distance)
    with pytest.raises(ValueError, match='name = "High Kick": must be of lower-case letters, digits and hyphens'):
        gambol.register_movement("High Kick", Distance)
    with pytest.raises(ValueError, match="steps = 0: must be from 1 to 1000000"):
        gambol.register_movement("none", Distance, steps=0)
    with pytest.raises(TypeError):
        gambol.register_movement("none", lambda needed: Distance())
    # Again, with another length.
    gambol.register_movement("far-for-a-while", Lazy, steps=60)
    assert gambol.make_vec("biped-1", "far-for-a-while", num_envs=1).max_episode_steps == 60
