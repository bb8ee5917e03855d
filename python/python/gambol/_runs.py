"""Whole runs: training, and what it leaves in a folder."""

from __future__ import annotations

import html
import json
import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from gambol import _gambol
from gambol._build import MOST_SEED, assignments, creature_text, seed_of, whole
from gambol._champion import Champion
from gambol._progress import Callback, shown

#: The columns of every log.
_ALWAYS = (
    *("generation", "evaluations", "steps", "best_so_far", "failures", "population"),
    *("best", "mean", "median", "worst", "q10", "q25", "q75", "q90"),
)


class Run:
    """A run folder, whether this program made it or the command line did."""

    def __init__(self, folder: str | os.PathLike[str], reason: str | None = None) -> None:
        """Nothing is read yet."""
        #: The folder.
        self.folder = Path(folder)
        #: Why the run ended, if it was carried out here.
        self.reason = reason

    @property
    def log(self) -> dict[str, npt.NDArray[Any]]:
        """The log as columns, a row for each generation: ``pandas.DataFrame(run.log)`` is a table.

        ``generation``, ``evaluations``, ``steps``, ``best_so_far``, ``failures``, ``population``; of the generation's
        fitnesses ``best``, ``mean``, ``median``, ``worst`` and quantiles (``q10`` to ``q90``); and what the strategy says of
        itself. NaN where there is nothing to tell. ``best_so_far`` is the champion's fitness in one whole episode, NaN until one is
        chosen. A run with stages has a log for each: see :attr:`stages`.
        """
        rows = [_flat(json.loads(line)) for line in _gambol.read_log(self.folder)]
        names = list(dict.fromkeys([*_ALWAYS, *(name for row in rows for name in row)]))
        counts = {"generation", "evaluations", "steps", "failures", "population", "tier"}
        return {
            name: np.array([row.get(name, 0) for row in rows], np.int64)
            if name in counts
            else np.array([row.get(name, np.nan) for row in rows], np.float64)
            for name in names
        }

    @property
    def stages(self) -> list[Run]:
        """The stages that have begun, in order, each a run of its own; none if it has none."""
        folders = (self.folder / "stages").glob("[0-9]*-*")
        return [Run(folder) for folder in sorted(folders) if (folder / "config.json").is_file()]

    @property
    def champion(self) -> Champion | None:
        """The best so far; ``None`` while none was chosen, or if none could be played to its end."""
        path = self.folder / "champion.json"
        return Champion(path) if path.is_file() else None

    @property
    def config(self) -> dict[str, Any]:
        """The configuration: everything that determines the run."""
        config: dict[str, Any] = json.loads(_gambol.read_config(self.folder))
        return config

    def resume(
        self,
        *,
        generations: int | None = None,
        threads: int = 0,
        callback: Callback | None = None,
        progress: bool | None = None,
        cluster: Any = None,
    ) -> Run:
        """Goes on from the last checkpoint, to the bytes of a run that was never stopped.

        Args:
            generations: the generation to go on to, in place of the planned one.
            threads: as of :func:`train`.
            callback: as of :func:`train`.
            progress: as of :func:`train`.
            cluster: as of :func:`train`.
        """
        planned = self._planned if generations is None else lambda: generations
        with _evaluating_on(cluster) as elsewhere, shown(progress, callback, planned) as told:
            until = None if generations is None else whole("generations", generations, 1, MOST_SEED)
            ended = _gambol.resume(self.folder, until, whole("threads", threads, 0, 1024), _told(told), elsewhere)
        return Run(self.folder, ended[0])

    def _planned(self) -> int | None:
        """How many generations it is to have."""
        stop: dict[str, Any] = self.config.get("stop", {})
        return stop.get("generations")

    def __repr__(self) -> str:
        """Where it is."""
        return f"Run({str(self.folder)!r})"

    def _repr_html_(self) -> str:
        """Where it is, how far it came, and its champion's replay: for notebooks."""
        champion = self.champion
        done = sum(len(_gambol.read_log(run.folder)) for run in self.stages or [self])
        line = f"<p>{html.escape(str(self.folder))}, {done} generations</p>"
        return line + (champion._repr_html_() if champion is not None else "")


def train(
    creature: str | os.PathLike[str] | None,
    movement: str | None = None,
    *,
    out: str | os.PathLike[str],
    seed: int | None = None,
    generations: int | None = None,
    population: int | None = None,
    strategy: str | None = None,
    preset: str | None = None,
    terrain: str | None = None,
    variation: str | None = None,
    engine: str | None = None,
    config: str | os.PathLike[str] | None = None,
    settings: Mapping[str, Any] | None = None,
    threads: int = 0,
    callback: Callback | None = None,
    progress: bool | None = None,
    cluster: Any = None,
) -> Run:
    """Trains a creature, as the program's command ``gambol train`` does, to the same bytes.

    Args:
        creature: the name of a shipped creature or the path of a creature file; ``None`` if ``config`` says it.
        movement: the movement's name; ``None`` if ``config`` says it.
        out: the run folder, which must be new or empty.
        seed: from 0 to 2⁶⁴ − 1; 1 by default.
        generations: how many; 300 by default.
        population: individuals of a generation; by default the strategy's.
        strategy: its name (:func:`gambol.strategy_names`); by default the preset's.
        preset: where settings begin; by default what was found to work best.
        terrain: ``"NAME"`` or ``"NAME:DIFFICULTY"``.
        variation: how worlds differ from trial to trial.
        engine: what steps the creatures, ``"lanes"`` or ``"rapier"``.
        config: a configuration file, laid over the preset.
        settings: single settings by their path, such as ``{"strategy.cma-es.step_size": 1.0}``; see docs/configuration.md.
        threads: 0, the default: one for each core. No byte depends on it.
        callback: called after each generation with its line of the log as a dictionary. The run ends if it returns
            ``True``. What it raises ends the run too, once what there is has been saved.
        progress: whether a bar shows how far it is, which needs tqdm; by default if that is installed and there is a terminal or
            a notebook.
        cluster: the module ``ray``, whose cluster evaluates each generation that is worth it, to the same bytes; the logger
            ``gambol.cluster`` says what is worth it and why. See docs/scale.md.

    Returns:
        The run. Ctrl-C ends it after the generation under way and saves; ``reason`` is then ``"it was interrupted"``, and
        :meth:`Run.resume` goes on.

    Raises:
        ValueError: if a name or a setting is wrong.
        OSError: if the folder cannot be used.
        gambol.cluster.DifferentBits: if a machine of the cluster computes other bits than others.
        gambol.cluster.Lost: if the cluster loses an evaluation again and again. What there was is saved.
    """
    with _evaluating_on(cluster) as elsewhere, shown(progress, callback, Run(out)._planned) as told:
        ended = _gambol.train(
            None if creature is None else creature_text(creature),
            movement,
            Path(out),
            preset=preset,
            strategy=strategy,
            terrain=terrain,
            variation=variation,
            engine=engine,
            seed=None if seed is None else seed_of(seed),
            generations=None if generations is None else whole("generations", generations, 1, MOST_SEED),
            population=None if population is None else whole("population", population, 1, MOST_SEED),
            config=None if config is None else Path(config),
            settings=assignments(settings),
            threads=whole("threads", threads, 0, 1024),
            callback=_told(told),
            elsewhere=elsewhere,
        )
    return Run(out, ended[0])


@contextmanager
def _evaluating_on(cluster: Any) -> Iterator[_gambol._Elsewhere | None]:
    if cluster is None:
        yield None
        return
    # Without a cluster nothing of it is imported.
    from gambol.cluster import _populations

    if isinstance(cluster, _populations.Cluster):
        # It is shared with other runs.
        yield _populations.Populations(cluster)
        return
    with _populations.on_ray(cluster) as alone:
        yield _populations.Populations(alone)


def _told(callback: Callback | None) -> Callable[[str], bool] | None:
    return None if callback is None else lambda line: bool(callback(json.loads(line)))


def _flat(line: dict[str, Any]) -> dict[str, float]:
    """A line of the log as names and numbers; NaN where there is none."""
    numbers = ((name, np.nan if value is None else value) for name, value in line.items() if name not in ("fitness", "strategy"))
    flat = {name: value for name, value in numbers if isinstance(value, (int, float))}
    flat |= line.get("fitness") or {}
    flat |= {statistic["name"]: statistic["value"] for statistic in line.get("strategy", [])}
    return flat
