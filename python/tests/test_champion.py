"""Champions: judged, replayed in other worlds, exported, shown, played."""

import html
import json
import os
import pickle
import re
import signal
import threading

import numpy as np
import pytest

import gambol


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """A run whose champion has a rhythm."""
    out = tmp_path_factory.mktemp("champion") / "run"
    return gambol.train("biped-1", "running", out=out, generations=60, seed=2)


@pytest.fixture(scope="module")
def champion(run):
    """Its champion."""
    return run.champion


def test_robustness_can_be_interrupted(champion):
    """As Ctrl-C does it, while worlds are replayed that would take minutes."""
    threading.Timer(0.5, os.kill, [os.getpid(), signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        champion.robustness(100_000)


def test_robustness_tells_of_every_world(champion):
    """The same for the same seed."""
    one = champion.robustness(20, seed=3)
    assert one == champion.robustness(20, seed=3) != champion.robustness(20, seed=4)
    assert len(one["trials"]) == 20 and 0 <= one["usable_share"] <= 1
    usable = sum(trial["usable"] for trial in one["trials"]) if "usable" in one["trials"][0] else None
    assert usable is None or usable == round(20 * one["usable_share"])
    with pytest.raises(ValueError, match=r"must be from 1 to 100,?000"):
        champion.robustness(0)
    with pytest.raises(ValueError, match='there is no variation "moon"'):
        champion.robustness(5, variation="moon")


@pytest.mark.parametrize(
    ("format", "begins"),
    [("player", b""), ("trace", b""), ("csv", b""), ("gif", b"GIF89a"), ("apng", b"\x89PNG"), ("svg", b"<svg"), ("onnx", b"")],
)
def test_exports_are_files(champion, tmp_path, format, begins):
    """Of each format one."""
    [path] = champion.export(format, tmp_path / "gait")
    assert path == tmp_path / "gait"
    assert path.read_bytes().startswith(begins)
    with pytest.raises(FileExistsError, match="gait is there: overwrite=True overwrites it"):
        champion.export(format, path)
    assert champion.export(format, path, overwrite=True) == [path]


def test_files_that_belong_together_name_each_other(champion, tmp_path, monkeypatch):
    """And are called after the creature and the movement by default."""
    monkeypatch.chdir(tmp_path)
    paths = champion.export("sprites", size=64, rate=10)
    assert [str(path) for path in paths] == ["biped-1-running.json", "biped-1-running.png"]
    assert "biped-1-running.png" in paths[0].read_text()
    with pytest.raises(ValueError, match="must not be called like the file beside it"):
        champion.export("sprites", "walk.png", overwrite=True)


def test_what_cannot_be_exported_is_told(champion, tmp_path):
    """By the field."""
    with pytest.raises(ValueError, match=r'there is no format "mp4" \(there are: player, trace, '):
        champion.export("mp4", tmp_path / "gait")
    with pytest.raises(ValueError, match=r"size"):
        champion.export("gif", tmp_path / "gait", size=5)
    with pytest.raises(ValueError, match="seconds = 0: must be from 1 to 1000000 steps of the physics"):
        champion.export("trace", tmp_path / "gait", seconds=0.0)


def test_a_champion_is_not_written_over(champion):
    """Even where files may be."""
    before = champion.path.read_bytes()
    for write in (
        lambda: champion.replay(champion.path),
        lambda: champion.export("csv", champion.path, overwrite=True),
    ):
        with pytest.raises(ValueError, match="is the champion itself"):
            write()
    assert champion.path.read_bytes() == before


def test_a_notebook_shows_the_replay(run, champion, tmp_path):
    """In a frame that can do nothing but play."""
    page = champion.replay(tmp_path / "replay.html").read_text()
    shown = champion._repr_html_()
    [frame] = re.findall(r'srcdoc="([^"]*)"', shown)
    assert html.unescape(frame) == page
    assert 'sandbox="allow-scripts"' in shown
    assert str(run.folder) in run._repr_html_() and "60 generations" in run._repr_html_()


def test_a_controller_acts_as_its_net(champion):
    """The trace that the program exports has what it senses and commands."""
    controller = champion.controller()
    observations = np.linspace(-1, 1, 5 * controller.inputs, dtype=np.float32).reshape(5, -1)
    actions = controller(observations)
    assert actions.shape == (5, controller.outputs) and actions.dtype == np.float32
    assert np.array_equal(controller(observations[2]), actions[2])
    again = pickle.loads(pickle.dumps(controller))
    assert np.array_equal(again(observations), actions)
    assert repr(controller) == f"Controller(inputs={controller.inputs}, outputs={controller.outputs})"
    with pytest.raises(ValueError, match=rf"observations must be of shape \({controller.inputs},\) or .*, found \(3,\)"):
        controller([1.0, 2.0, 3.0])


def test_a_controller_drives_an_environment(champion):
    """As far as it came in training."""
    env = gambol.CreatureEnv("biped-1", "running", preset="default")
    controller = champion.controller()
    observation, _ = env.reset(seed=2)
    total, ended = 0.0, False
    while not ended:
        observation, reward, terminated, truncated, _ = env.step(controller(observation))
        total += reward
        ended = terminated or truncated
    assert total > 1.0, "it runs"
    assert total == pytest.approx(json.loads(json.dumps(champion.fitness)), rel=0.5)
