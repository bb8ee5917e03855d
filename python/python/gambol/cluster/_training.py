"""Several runs at the same time on one cluster."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from concurrent.futures import FIRST_EXCEPTION, ThreadPoolExecutor, wait
from importlib import import_module
from typing import Any

import gambol._runs
from gambol._runs import Run
from gambol.cluster import _populations


def train(runs: Sequence[Mapping[str, Any]], *, cluster: Any = None) -> list[Run]:
    """Trains several runs at the same time: while one waits for the last of a generation, workers do the others' individuals.

    For populations of many thousands. Where a run is small, :func:`compare` and :func:`gaits` send whole runs.

    Args:
        runs: of each the arguments of :func:`gambol.train` by name, ``out`` among them, but for ``cluster``.
        cluster: the module ``ray``, initialised as you like; by default it is imported, and this machine is the cluster.

    Returns:
        The runs, in their order. Ctrl-C ends all after the generation under way and is raised again; what there was is saved, and
        :meth:`gambol.Run.resume` goes on.

    Raises:
        ValueError: if an argument is wrong.
        DifferentBits: if a machine computes other bits than others.
        Lost: if the cluster loses an evaluation again and again. What there was is saved.
    """
    with _populations.on_ray(cluster or import_module("ray")) as shared:
        return train_on(shared, runs)


def train_on(shared: _populations.Cluster, runs: Sequence[Mapping[str, Any]]) -> list[Run]:
    """As :func:`train`, on workers that are there."""
    folders = [os.path.abspath(run["out"]) for run in runs]
    if len(set(folders)) < len(folders):
        raise ValueError("out: two runs have the same folder")
    stops = False

    def one(run: Mapping[str, Any]) -> Run:
        callback = run.get("callback")

        def told(line: dict[str, Any]) -> bool:
            return bool(callback and callback(line)) or stops

        return gambol._runs.train(**{**run, "callback": told, "cluster": shared})

    with ThreadPoolExecutor(max(1, len(runs))) as threads:
        done = [threads.submit(one, run) for run in runs]
        try:
            wait(done, return_when=FIRST_EXCEPTION)
        finally:
            # If one has failed, or at Ctrl-C: the others end after the generation under way.
            stops = not all(future.done() for future in done)
        return [future.result() for future in done]
