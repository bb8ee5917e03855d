"""Experiments on machines that share no files: whatever is lost, the results are those of one process."""

import os
import random
import signal
import threading
import time
from collections import deque
from pathlib import Path

import pytest

from gambol.cluster import DifferentBits, Lost, _dispatch, _experiments

COMPARISON = _experiments.recipe(
    "compare",
    strategies=["ga", "cma-es"],
    creatures=["biped-1"],
    movements=["running"],
    seeds=list(range(1, 13)),
    evaluations=200,
    steps=None,
    preset=None,
    engine=None,
    variation=None,
    settings=[],
)
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


class Machines:
    """Machines in this process, some of which lose runs or compute other bits."""

    def __init__(self, experiment, names=("a", "b", "c"), lose=0.0, wrong=None, wrong_from=0):
        """``lose``: the share of runs that is lost; ``wrong``: the machine whose bits differ from its run ``wrong_from`` on."""
        self.experiment = experiment
        self.names = names
        self.lose = lose
        self.wrong, self.wrong_from = wrong, wrong_from
        self.random = random.Random(7)
        self.flying = deque()
        self.submitted = 0
        self.done = 0

    def submit(self, run, avoid):
        """Any machine but the one to avoid."""
        self.submitted += 1
        node = self.random.choice([name for name in self.names if name != avoid] or self.names)
        self.flying.append((self.submitted, run, node))
        self.random.shuffle(self.flying)
        return self.submitted

    def wait(self):
        """Does the next run, or loses it."""
        number, run, node = self.flying.popleft()
        if self.random.random() < self.lose:
            return number, _dispatch.Done(None, node)
        text = self.experiment.carry_out(run)
        if node == self.wrong:
            self.done += 1
            if self.done > self.wrong_from:
                text = spoiled(self.experiment, run)
        return number, _dispatch.Done(text, node)

    def count(self):
        """Two for each machine."""
        return 2 * len(self.names)

    def nodes(self):
        """How many machines there are."""
        return len(self.names)


def spoiled(experiment, run):
    """A result that is whole, of the right seed, and wrong: that of a run with another budget."""
    kind, arguments = COMPARISON
    other = _experiments.experiment((kind, arguments.replace('"evaluations": 200', '"evaluations": 100')))
    return other.carry_out(run)


def silent(name, done, runs):
    """Nothing is told."""


def files(folder):
    """All results of a folder, and what came of them, by their paths."""
    return {
        str(path.relative_to(folder)): path.read_text()
        for path in sorted(Path(folder).rglob("*"))
        if path.is_file() and "runs" not in path.relative_to(folder).parts
    }


def timeless(table):
    """The rows of a table without the last column, the seconds."""
    return [row.rpartition(",")[0] for row in table.splitlines()]


def same(experiment, one, other):
    """Checks that two folders have the same results, but for seconds."""
    one, other = files(one), files(other)
    assert one.keys() == other.keys()
    for path, text in one.items():
        if path.endswith(("medians.csv", "settings.csv", "comparison.json")):
            assert text == other[path], path
        elif path == "scores.csv":
            assert timeless(text) == timeless(other[path])
        elif path.startswith("results/"):
            assert experiment.agree(text, other[path]), path


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    """The comparison by one process, one run after the other."""
    experiment = _experiments.experiment(COMPARISON)
    folder = tmp_path_factory.mktemp("alone") / "comparison"
    experiment.begin(folder)
    for run in range(experiment.runs):
        experiment.place(folder, run, experiment.carry_out(run))
    experiment.conclude(folder)
    return folder


@pytest.mark.parametrize("lose", [0.0, 0.3])
def test_lost_runs_are_done_again_to_the_same_results(alone, tmp_path, lose):
    """In any order, on any machine."""
    experiment = _experiments.experiment(COMPARISON)
    told = []
    machines = Machines(experiment, lose=lose)
    _dispatch.dispatch(experiment, tmp_path / "c", machines, check=0.1, on_run=lambda *line: told.append(line))
    experiment.conclude(tmp_path / "c")
    same(experiment, alone, tmp_path / "c")
    assert [there for _, there, _ in told] == list(range(1, experiment.runs + 1))
    assert machines.submitted >= experiment.runs + 2


@pytest.mark.parametrize("of", [REPRODUCTION, GAITS])
def test_other_experiments_are_distributed(tmp_path, of):
    """Twice, in other orders."""
    experiment = _experiments.experiment(of)
    for name in ("one", "other"):
        machines = Machines(experiment, names=(name, "third"))
        _dispatch.dispatch(experiment, tmp_path / name, machines, check=1.0, on_run=silent)
        assert all(path.is_file() for path in experiment.conclude(tmp_path / name))
    assert len(files(tmp_path / "one")) >= experiment.runs
    if of is REPRODUCTION:
        same(experiment, tmp_path / "one", tmp_path / "other")


@pytest.mark.parametrize("wrong_from", [0, 3])
def test_a_machine_with_other_bits_is_named_and_nothing_of_it_is_kept(tmp_path, wrong_from):
    """Whether from its first run on, or later."""
    experiment = _experiments.experiment(COMPARISON)
    machines = Machines(experiment, wrong="b", wrong_from=wrong_from)
    with pytest.raises(DifferentBits, match="the machine b computes other bits than others") as raised:
        _dispatch.dispatch(experiment, tmp_path / "c", machines, check=0.5, on_run=silent)
    assert raised.value.node == "b"
    for run in set(range(experiment.runs)) - set(experiment.missing(tmp_path / "c")):
        seed = experiment.name(run).rsplit(" ", 1)[1]
        method = experiment.name(run).split(",")[0]
        [kept] = (tmp_path / "c" / "results" / method).rglob(f"seed-{seed}.json")
        assert experiment.agree(kept.read_text(), experiment.carry_out(run))
    # Without it the same call goes on.
    _dispatch.dispatch(experiment, tmp_path / "c", Machines(experiment, names=("a", "c")), check=0.5, on_run=silent)
    assert experiment.missing(tmp_path / "c") == []


def test_what_is_lost_again_and_again_is_given_up(tmp_path):
    """And says which run it was."""
    experiment = _experiments.experiment(COMPARISON)
    with pytest.raises(Lost, match=r"seed \d+: its worker was lost 20 times"):
        _dispatch.dispatch(experiment, tmp_path / "c", Machines(experiment, lose=1.0), check=0.01, on_run=silent)


def test_errors_are_told(tmp_path):
    """In the library's words."""
    experiment = _experiments.experiment(COMPARISON)
    with pytest.raises(ValueError, match=r"check = 0: must be from 0\.001 to 1"):
        _dispatch.dispatch(experiment, tmp_path, Machines(experiment), check=0, on_run=silent)
    with pytest.raises(RuntimeError, match="it has another version of gambol, or other creature"):
        _experiments.carry_out(COMPARISON, "0000000000000000", 0)
    experiment.begin(tmp_path / "c")
    with pytest.raises(RuntimeError, match="is the result of another run"):
        experiment.place(tmp_path / "c", 1, experiment.carry_out(0))
    with pytest.raises(RuntimeError, match="there is no run 24"):
        experiment.carry_out(24)
    with pytest.raises(ValueError, match="there is no strategy or preset"):
        _experiments.experiment((COMPARISON[0], COMPARISON[1].replace('"ga"', '"gaa"')))


# On a real cluster.


@pytest.fixture(scope="module")
def ray():
    """Ray, with two nodes of two processors on this machine beside its head."""
    ray = pytest.importorskip("ray", reason="Ray is not installed")
    from ray.cluster_utils import Cluster

    cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 1})
    ray.cluster = cluster
    ray.others = [cluster.add_node(num_cpus=1) for _ in range(2)]
    ray.init(address=cluster.address, log_to_driver=False)
    yield ray
    ray.shutdown()
    cluster.shutdown()


def worker_processes():
    """The processes of Ray that do tasks of ours."""
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            if b"ray::_on_node" in path.read_bytes():
                yield int(path.parent.name)
        except OSError:
            pass


def compare_on(ray, folder, on_run=silent):
    """The comparison, on the cluster."""
    from gambol import cluster

    return cluster.compare(
        ["ga", "cma-es"], ["biped-1"], out=folder, seeds=range(1, 13), evaluations=200, cluster=ray, on_run=on_run
    )


@pytest.mark.filterwarnings("ignore")
def test_a_ray_cluster_gives_the_results_of_one_process(ray, alone, tmp_path):
    """Several nodes."""
    written = compare_on(ray, tmp_path / "c")
    assert [path.name for path in written][:2] == ["comparison.html", "medians.csv"]
    same(_experiments.experiment(COMPARISON), alone, tmp_path / "c")


@pytest.mark.filterwarnings("ignore")
def test_killed_workers_and_nodes_change_nothing(ray, alone, tmp_path):
    """Workers are killed at random moments, a node dies, another comes."""
    over = threading.Event()
    killed, replaced = 0, []

    def kill():
        nonlocal killed
        random_ = random.Random(3)
        # So many and no more: a worker that is killed each time before it is ready never gets anything done.
        while killed < 20 and not over.wait(random_.uniform(0.02, 0.2)):
            for process in list(worker_processes())[:1]:
                os.kill(process, signal.SIGKILL)
                killed += 1

    def replace_a_node(name, done, runs):
        if killed >= 5 and not replaced:
            replaced.append(ray.others.pop())
            ray.cluster.remove_node(replaced[0], allow_graceful=False)
            ray.others.append(ray.cluster.add_node(num_cpus=1))

    killer = threading.Thread(target=kill)
    killer.start()
    experiment = _experiments.experiment(COMPARISON)
    try:
        until, round_ = time.monotonic() + 90, 0
        while killed < 20 and time.monotonic() < until:
            round_ += 1
            compare_on(ray, tmp_path / f"c{round_}", replace_a_node)
            same(experiment, alone, tmp_path / f"c{round_}")
    finally:
        over.set()
        killer.join()
    assert killed >= 20 and replaced
