"""On a real Ray cluster of several nodes on this machine: whatever is killed, the results are those of one process."""

import os
import random
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest
from experiments import COMPARISON, same
from trained import RUNS, files, train_on

import gambol
from gambol.cluster import _experiments, _populations, _training
from gambol.cluster._ray import RayWorkers

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


def compare_on(ray, folder, on_run=None):
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


@pytest.mark.filterwarnings("ignore")
def test_a_worker_that_stands_still_holds_nothing_up(ray, alone, tmp_path):
    """What it has begun is done by others."""
    stopped = []

    def stop(name, done, runs):
        if not stopped:
            stopped.extend(list(worker_processes())[:1])
            os.kill(stopped[0], signal.SIGSTOP)

    try:
        compare_on(ray, tmp_path / "c", stop)
        assert Path(f"/proc/{stopped[0]}/stat").read_text().rpartition(")")[2].split()[0] == "T"
    finally:
        for process in stopped:
            os.kill(process, signal.SIGCONT)
    same(_experiments.experiment(COMPARISON), alone, tmp_path / "c")


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("name", RUNS)
def test_a_run_on_a_cluster_has_the_bytes_of_one_machine(ray, tmp_path, name):
    """Though workers are killed at random moments."""
    gambol.train(movement="running", out=tmp_path / "here", **RUNS[name])
    over = threading.Event()

    def kill():
        random_ = random.Random(5)
        for _ in range(5):
            if over.wait(random_.uniform(0.05, 0.5)):
                return
            for process in list(worker_processes())[:1]:
                os.kill(process, signal.SIGKILL)

    killer = threading.Thread(target=kill)
    killer.start()
    try:
        train_on(RayWorkers(ray, _populations.evaluate), tmp_path / "there", **RUNS[name])
    finally:
        over.set()
        killer.join()
    assert files(tmp_path / "here") == files(tmp_path / "there")


@pytest.mark.filterwarnings("ignore")
def test_runs_at_the_same_time_have_the_bytes_of_each_alone(ray, tmp_path):
    """Whether the cluster is worth it or not."""
    runs = [{"movement": "running", "out": tmp_path / f"{name}-there", **RUNS[name]} for name in RUNS]
    with _populations.on_ray(ray) as shared:
        shared._overhead = 1e-9
        _training.train_on(shared, runs)
    for name, arguments in RUNS.items():
        gambol.train(movement="running", out=tmp_path / f"{name}-here", **arguments)
        assert files(tmp_path / f"{name}-here") == files(tmp_path / f"{name}-there")


@pytest.mark.filterwarnings("ignore")
def test_a_cluster_that_is_not_worth_it_is_not_used(ray, tmp_path, caplog):
    """By what was measured: this machine has as many processors as the cluster has."""
    gambol.train(movement="running", out=tmp_path / "here", **RUNS["cma-es"])
    gambol.train(movement="running", out=tmp_path / "there", cluster=ray, **RUNS["cma-es"])
    assert files(tmp_path / "here") == files(tmp_path / "there")
    assert "64 individuals take " in caplog.messages[0]


@pytest.mark.filterwarnings("ignore")
def test_a_full_object_store_changes_nothing(ray, tmp_path):
    """Ray moves what does not fit to the disk."""
    import numpy

    size = int(ray.cluster_resources()["object_store_memory"])
    kept = [ray.put(numpy.zeros(size // 40, numpy.uint8)) for _ in range(36)]
    gambol.train(movement="running", out=tmp_path / "here", **RUNS["cma-es"])
    train_on(RayWorkers(ray, _populations.evaluate), tmp_path / "there", **RUNS["cma-es"])
    assert files(tmp_path / "here") == files(tmp_path / "there")
    del kept


#: A program that trains on the cluster at an address, and says of each generation that it is done.
PROGRAM = """
import sys
sys.path.insert(0, sys.argv[3])
import ray
import trained
from gambol.cluster import _populations
from gambol.cluster._ray import RayWorkers

ray.init(address=sys.argv[1], log_to_driver=False)
arguments = {**trained.RUNS["cma-es"], "generations": 1_000_000}
say = lambda line: print("a generation", flush=True)
trained.train_on(RayWorkers(ray, _populations.evaluate), sys.argv[2], on_generation=say, **arguments)
"""


def test_a_run_goes_on_after_its_head_was_killed(tmp_path):
    """The program ends with an error by itself; what it had saved goes on, to the same bytes."""
    pytest.importorskip("ray", reason="Ray is not installed")
    from ray.cluster_utils import Cluster

    cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 1})
    environment = {**os.environ, "RAY_gcs_rpc_server_reconnect_timeout_s": "5"}
    program = subprocess.Popen(
        [sys.executable, "-c", PROGRAM, cluster.address, str(tmp_path / "there"), str(Path(__file__).parent)],
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        for _ in range(20):
            assert program.stdout is not None and program.stdout.readline() == "a generation\n"
        cluster.head_node.kill_gcs_server()
        cluster.head_node.kill_raylet()
        _, said = program.communicate(timeout=120)
    finally:
        program.kill()
        cluster.shutdown()
    assert program.returncode != 0
    assert said, "it says why"
    run = gambol.Run(tmp_path / "there")
    done = len(run.log["generation"])
    assert done >= 19
    run.resume(generations=done + 5)
    gambol.train(movement="running", out=tmp_path / "here", **{**RUNS["cma-es"], "generations": done + 5})
    there, here = files(run.folder), files(tmp_path / "here")
    assert there["champion.json"] == here["champion.json"]
    assert there["log.jsonl"] == here["log.jsonl"]
