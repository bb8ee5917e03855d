"""Threads and other processes: those that are forked from one that has used threads, and those that begin anew."""

import multiprocessing
import pickle
import threading
from pathlib import Path

import numpy as np
import pytest

import gambol

USABLE = Path(__file__).parents[2] / "gambol-exports/tests/champions/tetrapod-2-running-neat.json"


def everything(folder, answers):
    """Uses what computes, in threads where there are some, and answers with what came of it."""
    envs = gambol.make_vec("biped-1", "running", num_envs=32, threads=2)
    envs.reset(seed=1)
    rewards = [envs.step(np.zeros((32, 2), np.float32))[1] for _ in range(20)]
    search = gambol.CmaEs(20, seed=1)
    genomes = search.ask()
    run = gambol.train("biped-1", "running", out=folder, preset="plain", generations=2, population=8, threads=2)
    # A usable one is played in near worlds, on threads.
    assert gambol.Champion(USABLE).gait()["verdict"]["usable"]
    share = run.champion.robustness(8)["usable_share"]
    answers.put(pickle.dumps((np.array(rewards), genomes, run.log["best"], share)))


class Here:
    """Answers in this process."""

    def put(self, answer):
        """Keeps it."""
        self.answer = answer


@pytest.mark.filterwarnings("ignore:This process .* is multi-threaded:DeprecationWarning")
@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_another_process_computes_the_same(tmp_path, method):
    """Though this one has used threads before."""
    here = Here()
    everything(tmp_path / "here", here)
    context = multiprocessing.get_context(method)
    answers = context.Queue()
    process = context.Process(target=everything, args=(tmp_path / "there", answers))
    process.start()
    try:
        answer = answers.get(timeout=60)
        process.join(60)
        assert process.exitcode == 0
    finally:
        process.kill()
    for one, other in zip(pickle.loads(here.answer), pickle.loads(answer), strict=True):
        assert np.array_equal(one, other)


def rewards_of(seed, found):
    """The rewards of environments of one's own."""
    envs = gambol.make_vec("biped-1", "running", num_envs=32, threads=1)
    envs.reset(seed=seed)
    found[seed] = np.array([envs.step(np.full((32, 2), 0.3, np.float32))[1] for _ in range(50)])


def test_threads_that_share_nothing_compute_the_same():
    """Four at the same time."""
    alone, together = {}, {}
    for seed in range(4):
        rewards_of(seed, alone)
    threads = [threading.Thread(target=rewards_of, args=(seed, together)) for seed in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(alone[seed], together[seed]) for seed in range(4))


def test_threads_that_share_a_search_are_told_so_and_break_nothing():
    """It is asked in one thread while another one asks it: an error, or the same generation again."""
    search, errors = gambol.CmaEs(500, seed=1), []

    def ask():
        for _ in range(200):
            try:
                search.tell(-np.square(search.ask()).sum(axis=1))
            except RuntimeError as error:
                errors.append(str(error))

    threads = [threading.Thread(target=ask) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all("borrowed" in error or "waits" in error for error in errors), set(errors)
    assert np.isfinite(search.ask()).all()
