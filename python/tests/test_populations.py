"""A run whose evaluations are done elsewhere has the bytes of one that was done here."""

import logging

import pytest
from machines import Machines
from trained import RUNS, files, train_on

import gambol
from gambol.cluster import DifferentBits, Lost, _populations, _training
from gambol.cluster._plan import Plan


@pytest.mark.parametrize("name", RUNS)
@pytest.mark.parametrize("lose", [0.0, 0.3])
def test_the_bytes_are_those_of_one_machine(tmp_path, name, lose):
    """Whatever is lost."""
    arguments = RUNS[name]
    gambol.train(movement="running", out=tmp_path / "here", **arguments)
    machines = Machines(_populations.evaluate, lose=lose)
    told = train_on(machines, tmp_path / "there", **arguments)
    assert len(told) == arguments["generations"]
    assert machines.submitted > 2 * arguments["generations"]
    assert files(tmp_path / "here") == files(tmp_path / "there")


def test_a_machine_with_other_bits_ends_the_run_before_it_is_wrong(tmp_path):
    """What was saved is that of one machine."""
    changed = _populations.evaluate

    def spoil(result):
        # Another number in the place of the last.
        return result[:-1] + bytes([result[-1] ^ 1])

    machines = Machines(changed, wrong="b", spoil=spoil)
    with pytest.raises(DifferentBits, match=r"the machine b computes other bits than others \(individuals \d+ to \d+"):
        train_on(machines, tmp_path / "there", **RUNS["cma-es"])
    run = gambol.Run(tmp_path / "there").resume()
    gambol.train(movement="running", out=tmp_path / "here", **RUNS["cma-es"])
    assert files(tmp_path / "here") == files(run.folder)


def test_a_run_whose_machines_are_lost_goes_on_later(tmp_path):
    """To the same bytes."""

    class Failing(Machines):
        def wait(self, seconds):
            self.lose = 1.0 if self.submitted > 20 else 0.0
            return super().wait(seconds)

    with pytest.raises(Lost, match="its worker was lost 20 times"):
        train_on(Failing(_populations.evaluate), tmp_path / "there", **RUNS["cma-es"])
    run = gambol.Run(tmp_path / "there")
    assert 0 < len(run.log["generation"]) < 6
    run.resume()
    gambol.train(movement="running", out=tmp_path / "here", **RUNS["cma-es"])
    assert files(tmp_path / "here") == files(run.folder)


def test_several_runs_share_machines(tmp_path):
    """Each has the bytes that it has alone, though a third of all is lost."""
    machines = Machines(_populations.evaluate, lose=0.3)
    runs = [{"movement": "running", "out": tmp_path / f"{name}-there", **arguments} for name, arguments in RUNS.items()]
    # Handing out costs nothing, and the cluster seems large: all is worth it.
    machines.nodes = lambda: dict.fromkeys("abc", 1000)
    with _populations.Cluster(machines, overhead=1e-9) as shared:
        done = _training.train_on(shared, runs)
    assert [run.folder for run in done] == [run["out"] for run in runs]
    assert machines.submitted > 12
    for name, arguments in RUNS.items():
        gambol.train(movement="running", out=tmp_path / f"{name}-here", **arguments)
        assert files(tmp_path / f"{name}-here") == files(tmp_path / f"{name}-there")


def test_an_error_of_one_run_ends_the_others(tmp_path):
    """After the generation under way; what there is stays."""
    machines = Machines(_populations.evaluate)
    good = {"movement": "running", "out": tmp_path / "good", **RUNS["cma-es"], "generations": 1_000_000}
    with _populations.Cluster(machines) as shared:
        with pytest.raises(ValueError, match="slowly"):
            _training.train_on(shared, [good, {"creature": "biped-1", "movement": "slowly", "out": tmp_path / "bad"}])
        with pytest.raises(ValueError, match="out: two runs have the same folder"):
            _training.train_on(shared, [good, good])
    assert gambol.Run(tmp_path / "good").log["generation"].size >= 1


def test_what_is_not_worth_it_is_done_here(tmp_path, caplog):
    """And says so, once."""
    machines = Machines(_populations.evaluate)
    plan = Plan(individuals=1, each=1e-4, processors=4, here=2, overhead=1e-2)
    with caplog.at_level(logging.WARNING, "gambol.cluster"):
        train_on(machines, tmp_path / "there", plan=plan, **RUNS["cma-es"])
    assert machines.submitted == 0
    [line] = caplog.messages
    assert line.startswith("64 individuals take 3.2 ms here, ") and "not worth a cluster; " in line
    gambol.train(movement="running", out=tmp_path / "here", **RUNS["cma-es"])
    assert files(tmp_path / "here") == files(tmp_path / "there")


def test_what_is_measured_makes_a_plan(tmp_path, caplog):
    """On machines whose clock costs nothing, handing out costs something."""
    machines = Machines(_populations.evaluate)
    with caplog.at_level(logging.WARNING, "gambol.cluster"):
        train_on(machines, tmp_path / "there", plan=None, **RUNS["cma-es"])
    assert machines.submitted >= 12
    assert caplog.messages[0].startswith("64 individuals take ")


def test_pieces_that_are_none_are_refused():
    """With what is wrong."""
    with pytest.raises(ValueError, match="line 1"):
        _populations.evaluate("{", b"")
    with pytest.raises(ValueError, match="missing field"):
        _populations.evaluate("{}", b"")
