"""Experiments on machines that share no files: whatever is lost, the results are those of one process."""

import json
from pathlib import Path

import pytest
from experiments import COMPARISON, files, same
from machines import Machines

from gambol.cluster import DifferentBits, Lost, _dispatch, _experiments

REPRODUCTION = _experiments.recipe(
    "reproduce", creatures=["biped-1"], movements=["running"], presets=["thesis"], runs=3, generations=2
)
GAITS = _experiments.recipe(
    "gaits",
    creatures=["tetrapod-1"],
    movements=["running"],
    seeds=[1, 2, 3],
    steps=20_000,
    preset=None,
    strategy=None,
    variation=None,
    settings=[],
    whole=False,
    robust=False,
)

TUNING = _experiments.recipe(
    "tune",
    strategy="cma-es",
    creatures=["apod"],
    movements=["running"],
    seeds=[1, 2],
    evaluations=200,
    trials=3,
    spread=4.0,
    draw_seed=1,
    preset="plain",
    settings=["movement.steps=60"],
)


def do(work, machines, check=0.01):
    """All that is missing."""
    folder, experiment = work._folder, work.experiment
    return list(_dispatch.Dispatcher(machines, check).do(work, experiment.missing(folder)))


def spoiled(result):
    """A result that is whole, of the right seed, and wrong: that of a run with another budget."""
    kind, arguments = COMPARISON
    other = _experiments.experiment((kind, arguments.replace('"evaluations": 200', '"evaluations": 100')))
    return other.carry_out(0)


@pytest.mark.parametrize("lose", [0.0, 0.3])
def test_lost_runs_are_done_again_to_the_same_results(alone, tmp_path, lose):
    """In any order, on any machine."""
    work = _experiments.Runs(COMPARISON, tmp_path / "c")
    machines = Machines(_experiments.carry_out, lose=lose)
    done = do(work, machines, check=0.1)
    work.experiment.conclude(tmp_path / "c")
    same(work.experiment, alone, tmp_path / "c")
    assert sorted(done) == list(range(work.experiment.runs))
    assert machines.submitted >= work.experiment.runs + 2


@pytest.mark.parametrize("of", [REPRODUCTION, GAITS, TUNING])
def test_other_experiments_are_distributed(tmp_path, of):
    """Twice, in other orders."""
    for name in ("one", "other"):
        work = _experiments.Runs(of, tmp_path / name)
        do(work, Machines(_experiments.carry_out, names=(name, "third")), check=1.0)
        assert all(path.is_file() for path in work.experiment.conclude(tmp_path / name))
    assert len(files(tmp_path / "one")) >= work.experiment.runs
    if of is REPRODUCTION:
        same(work.experiment, tmp_path / "one", tmp_path / "other")


@pytest.mark.parametrize("wrong_from", [0, 3])
def test_a_machine_with_other_bits_is_named_and_nothing_of_it_is_kept(tmp_path, wrong_from):
    """Whether from its first run on, or later."""
    work = _experiments.Runs(COMPARISON, tmp_path / "c")
    experiment = work.experiment
    machines = Machines(_experiments.carry_out, wrong="b", wrong_from=wrong_from, spoil=spoiled)
    with pytest.raises(DifferentBits, match="the machine b computes other bits than others") as raised:
        do(work, machines, check=0.5)
    assert raised.value.node == "b"
    for run in set(range(experiment.runs)) - set(experiment.missing(tmp_path / "c")):
        seed = experiment.name(run).rsplit(" ", 1)[1]
        method = experiment.name(run).split(",")[0]
        [kept] = (tmp_path / "c" / "results" / method).rglob(f"seed-{seed}.json")
        assert experiment.agree(kept.read_text(), experiment.carry_out(run))
    # Without it the same call goes on.
    do(work, Machines(_experiments.carry_out, names=("a", "c")), check=0.5)
    assert experiment.missing(tmp_path / "c") == []


def test_what_is_lost_again_and_again_is_given_up(tmp_path):
    """And says which run it was."""
    work = _experiments.Runs(COMPARISON, tmp_path / "c")
    with pytest.raises(Lost, match=r"seed \d+: its worker was lost 20 times"):
        do(work, Machines(_experiments.carry_out, lose=1.0))


def test_without_machines_it_is_told(tmp_path):
    """After some time, since there may be some soon."""
    work = _experiments.Runs(COMPARISON, tmp_path / "c")
    with pytest.raises(Lost, match=r"there was no machine for 60 s; the same call goes on"):
        do(work, Machines(_experiments.carry_out, names=()))


def test_errors_are_told(tmp_path):
    """In the library's words."""
    experiment = _experiments.experiment(COMPARISON)
    with pytest.raises(ValueError, match=r"check = 0: must be from 0\.001 to 1"):
        _dispatch.Dispatcher(Machines(_experiments.carry_out), 0)
    with pytest.raises(RuntimeError, match="it has another version of gambol, or other creature"):
        _experiments.carry_out(COMPARISON, "0000000000000000", 0)
    experiment.begin(tmp_path / "c")
    with pytest.raises(RuntimeError, match="is the result of another run"):
        experiment.place(tmp_path / "c", 1, experiment.carry_out(0))
    with pytest.raises(RuntimeError, match="there is no run 24"):
        experiment.carry_out(24)
    with pytest.raises(ValueError, match="there is no strategy or preset"):
        _experiments.experiment((COMPARISON[0], COMPARISON[1].replace('"ga"', '"gaa"')))


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"trials": 0}, "trials = 0: must be from 1 to 1000"),
        ({"spread": 1.0}, "spread = 1: must be above 1 and at most 1000"),
        ({"strategy": "cmaes2"}, "cmaes2"),
    ],
)
def test_a_tuning_is_checked(wrong, message):
    """Before anything is handed out."""
    kind, arguments = TUNING
    with pytest.raises(ValueError, match=message):
        _experiments.experiment(_experiments.recipe(kind, **{**json.loads(arguments), **wrong}))
