"""Whole runs, and that strategies and environments have the bits of the runs of Rust."""

import json
import sys

import numpy as np
import pytest

import gambol

PLAIN = {"preset": "plain", "settings": {"movement.steps": 60, "record.populations_at": [1, 2, 3, 4, 5]}}


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    seen = []
    folder = tmp_path_factory.mktemp("runs") / "run"
    run = gambol.train("biped-1", "running", out=folder, seed=7, generations=5, callback=seen.append, **PLAIN)
    assert [line["generation"] for line in seen] == [1, 2, 3, 4, 5]
    return run


def test_a_run_has_a_log_and_a_champion(run):
    assert run.reason == "the generations were done"
    log = run.log
    assert log["generation"].tolist() == [1, 2, 3, 4, 5]
    assert log["generation"].dtype == np.int64 and log["mean"].dtype == np.float64
    assert (np.diff(log["best_so_far"]) >= 0).all() and "step_size" in log
    champion = run.champion
    assert champion.verify()
    assert champion.fitness == log["best_so_far"][-1]
    assert champion.gait()["judged_as"] == "running"
    assert run.config["seed"] == 7 and "biped-1" in json.dumps(run.config)


def populations(run):
    """The weights and the fitnesses of each generation, as the run has kept them."""
    lines = [json.loads(line) for line in (run.folder / "gallery.jsonl").read_text().splitlines()]
    for line in lines:
        if line["kind"] == "population":
            yield line["members"]


def weights_of(member):
    """All weights of a net, in their order."""

    def find(value):
        if isinstance(value, dict):
            if "weights" in value:
                return value["weights"]
            return next((found for found in map(find, value.values()) if found is not None), None)
        return None

    return np.array(find(member["network"]), np.float32)


def test_a_strategy_has_the_bits_of_the_run_of_rust(run):
    search = gambol.CmaEs(layers=(3, 10, 2), seed=7)
    seen = 0
    for members in populations(run):
        genomes = search.ask()
        theirs = np.stack([weights_of(member) for member in members])
        assert genomes.tobytes() == theirs.tobytes()
        search.tell([np.nan if member["fitness"] is None else member["fitness"] for member in members])
        seen += 1
    assert seen == 5
    assert search.best.fitness == run.champion.fitness


def test_ctrl_c_and_callbacks_stop_a_run_which_goes_on_to_the_same_bytes(run, tmp_path):
    def interrupt(line):
        if line["generation"] == 2:
            raise KeyboardInterrupt

    stopped = gambol.train("biped-1", "running", out=tmp_path / "a", seed=7, generations=5, callback=interrupt, **PLAIN)
    assert stopped.reason == "it was interrupted" and len(stopped.log["generation"]) == 2
    resumed = stopped.resume(threads=1)
    assert resumed.reason == "the generations were done"
    for name in ("log.jsonl", "gallery.jsonl", "champion.json"):
        assert (resumed.folder / name).read_bytes() == (run.folder / name).read_bytes()
    done = gambol.train("biped-1", "running", out=tmp_path / "b", callback=lambda line: True, **PLAIN)
    assert len(done.log["generation"]) == 1

    def fail(line):
        raise LookupError("mine")

    with pytest.raises(LookupError, match="mine"):
        gambol.train("biped-1", "running", out=tmp_path / "c", callback=fail, **PLAIN)
    assert gambol.Run(tmp_path / "c").champion is not None


def test_what_is_wrong_is_said(run, tmp_path):
    with pytest.raises(ValueError, match="biped"):
        gambol.train("biped-9", "running", out=tmp_path / "x")
    with pytest.raises(ValueError, match="population"):
        gambol.train("biped-1", "running", out=tmp_path / "x", population=1)
    assert not (tmp_path / "x").exists()
    with pytest.raises(OSError, match="empty|already"):
        gambol.train("biped-1", "running", out=run.folder)
    with pytest.raises(OSError, match="config"):
        _ = gambol.Run(tmp_path / "nothing").log
    (tmp_path / "champion.json").write_text("{}")
    with pytest.raises(OSError, match="champion.json"):
        gambol.Champion(tmp_path / "champion.json")


def test_a_run_with_stages_has_a_log_for_each(tmp_path):
    """Playing is learned in stages."""
    run = gambol.train("biped-1", "playing", out=tmp_path / "run", generations=2, population=8)
    assert len(run.log["best"]) == 0
    assert [stage.folder.name for stage in run.stages] == ["01-move"]
    assert list(run.stages[0].log["generation"]) == [1, 2]
    assert ", 2 generations" in run._repr_html_()


def test_a_bar_shows_how_far_it_is(tmp_path, capfd):
    """If it is asked for; nothing is printed else."""
    pytest.importorskip("tqdm", reason="tqdm is not installed")
    gambol.train("biped-1", "running", out=tmp_path / "quiet", generations=3, population=8)
    assert capfd.readouterr() == ("", "")
    run = gambol.train("biped-1", "running", out=tmp_path / "told", generations=3, population=8, progress=True)
    said = capfd.readouterr().err
    assert "3/3" in said and ("best " in said) == np.isfinite(run.log["best_so_far"][-1])
    run.resume(generations=5, progress=True)
    assert "5/5" in capfd.readouterr().err


def test_a_bar_without_tqdm_is_refused(tmp_path, monkeypatch):
    """With what to install."""
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    with pytest.raises(ImportError, match="progress=True needs tqdm: pip install tqdm"):
        gambol.train("biped-1", "running", out=tmp_path / "run", generations=1, progress=True)
    assert not (tmp_path / "run").exists()
