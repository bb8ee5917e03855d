"""Experiments on a Ray cluster: each run is a task, and what comes of it is the same wherever it is done.

Files of runs are not sent, only results: the folder is then what ``gambol merge`` makes of parts. A call that was broken
off goes on when it is made again.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

from gambol._build import assignments, creature_text
from gambol.cluster._dispatch import Dispatcher
from gambol.cluster._experiments import Recipe, Runs, carry_out, recipe
from gambol.cluster._ray import RayWorkers
from gambol.cluster._training import train
from gambol.cluster._work import DifferentBits, Lost

__all__ = ["DifferentBits", "Lost", "compare", "gaits", "reproduce", "train", "tune"]

OnRun = Callable[[str, int, int], None]
Names = Sequence[str | os.PathLike[str]]


def _names(names: Names | str | None) -> list[str]:
    if isinstance(names, str):
        return [names]
    return [creature_text(name) for name in names or ()]


def _do(of: Recipe, out: str | os.PathLike[str], cluster: Any, check: float, on_run: OnRun | None) -> list[Path]:
    folder = Path(out)
    workers: RayWorkers[str] = RayWorkers(cluster or import_module("ray"), carry_out)
    dispatcher = Dispatcher(workers, check)
    work = Runs(of, folder)
    missing, runs = work.experiment.missing(folder), work.experiment.runs
    try:
        for there, run in enumerate(dispatcher.do(work, missing), runs - len(missing) + 1):
            if on_run is not None:
                on_run(work.name(run), there, runs)
    finally:
        workers.cancel()
    return work.experiment.conclude(folder)


def compare(
    strategies: Sequence[str],
    creatures: Names,
    movements: Sequence[str] = ("running",),
    *,
    out: str | os.PathLike[str],
    seeds: Sequence[int] = range(1, 11),
    evaluations: int | None = None,
    steps: int | None = None,
    preset: str | None = None,
    engine: str | None = None,
    variation: str | None = None,
    settings: Mapping[str, Any] | None = None,
    cluster: Any = None,
    check: float = 0.01,
    on_run: OnRun | None = None,
) -> list[Path]:
    """Compares strategies, as the program's command ``gambol compare`` does: same plan, same results, same page.

    Args:
        strategies: their names, presets, or ``NAME=CONFIG-FILE``.
        creatures: names, or files that are on every machine at this path.
        movements: their names.
        out: the folder of the comparison, new or one in which the same was begun.
        seeds: of each strategy on each creature and movement.
        evaluations: what a run may use up.
        steps: what a run may use up, in physics steps.
        preset: one for all strategies, by name.
        engine: ``"lanes"`` or ``"rapier"``.
        variation: how worlds vary, by name.
        settings: single settings for all runs, as of :func:`gambol.train`.
        cluster: the module ``ray``, initialised as you like; by default it is imported, and this machine is the cluster.
        check: the share of runs that is done on two machines and compared, from 0.001 to 1; of every machine the first is.
        on_run: called when a result is there, with the name of the run, how many are there, and how many there are.

    Returns:
        The files that say what came of it.

    Raises:
        ValueError: if a name or a setting is wrong.
        DifferentBits: if a machine computes other bits than others; what it found was not kept.
        RuntimeError: if a run cannot be done, or the folder holds something else.
    """
    of = recipe(
        "compare",
        strategies=_names(strategies),
        creatures=_names(creatures),
        movements=_names(movements),
        seeds=list(seeds),
        evaluations=evaluations,
        steps=steps,
        preset=preset,
        engine=engine,
        variation=variation,
        settings=assignments(settings),
    )
    return _do(of, out, cluster, check, on_run)


def tune(
    strategy: str,
    creatures: Names,
    movements: Sequence[str] = ("running",),
    *,
    out: str | os.PathLike[str],
    evaluations: int,
    trials: int = 20,
    spread: float = 4.0,
    seeds: Sequence[int] = range(900_001, 900_004),
    preset: str = "plain",
    settings: Mapping[str, Any] | None = None,
    cluster: Any = None,
    check: float = 0.01,
    on_run: OnRun | None = None,
) -> list[Path]:
    """Tunes a strategy's numbers, as the program's command ``gambol tune`` does, to the same best settings.

    ``trials``: how many settings are tried, from 1 to 1,000, the defaults among them; ``spread``: numbers are multiplied with a
    factor from 1/``spread`` to ``spread``, above 1 and at most 1,000, drawn from the first of the ``seeds``, which should not be
    those compared on. The other arguments are those of :func:`compare`.

    Returns:
        ``tuned.json``, the best settings as a configuration file, and the files of the comparison of the trials.
    """
    chosen = list(seeds)
    of = recipe(
        "tune",
        strategy=strategy,
        creatures=_names(creatures),
        movements=_names(movements),
        seeds=chosen,
        evaluations=evaluations,
        trials=trials,
        spread=spread,
        draw_seed=chosen[0] if chosen else 0,
        preset=preset,
        settings=assignments(settings),
    )
    return _do(of, out, cluster, check, on_run)


def reproduce(
    *,
    out: str | os.PathLike[str],
    creatures: Sequence[str] | None = None,
    movements: Sequence[str] | None = None,
    presets: Sequence[str] | None = None,
    runs: int = 10,
    generations: int = 300,
    cluster: Any = None,
    check: float = 0.01,
    on_run: OnRun | None = None,
) -> list[Path]:
    """Does the experiments of the thesis again, as ``gambol reproduce thesis`` does, without timed runs.

    ``None`` stands for all creatures and movements, and for the presets ``thesis`` and ``default``; the other arguments are
    those of :func:`compare`.
    """
    of = recipe(
        "reproduce",
        creatures=_names(creatures),
        movements=_names(movements),
        presets=_names(presets),
        runs=runs,
        generations=generations,
    )
    return _do(of, out, cluster, check, on_run)


def gaits(
    creatures: Names,
    movements: Sequence[str] = ("running", "jumping"),
    *,
    out: str | os.PathLike[str],
    steps: int,
    seeds: Sequence[int] = range(1, 11),
    preset: str | None = None,
    strategy: str | None = None,
    variation: str | None = None,
    settings: Mapping[str, Any] | None = None,
    whole: bool = False,
    robust: bool = False,
    cluster: Any = None,
    check: float = 0.01,
    on_run: OnRun | None = None,
) -> list[Path]:
    """How many gaits are usable, and how soon, as ``gambol bench gaits --steps`` measures it.

    ``steps``: what a run may use up; ``whole``: whether it goes on when its gait is usable; ``robust``: whether champions are
    replayed in 100 perturbed worlds. The other arguments are those of :func:`compare`.
    """
    of = recipe(
        "gaits",
        creatures=_names(creatures),
        movements=_names(movements),
        seeds=list(seeds),
        steps=steps,
        preset=preset,
        strategy=strategy,
        variation=variation,
        settings=assignments(settings),
        whole=whole,
        robust=robust,
    )
    return _do(of, out, cluster, check, on_run)
