"""Experiments as recipes: what a node needs to know to do a run, and where its result is kept."""

from __future__ import annotations

import functools
import json
from pathlib import Path
from typing import Any

from gambol._build import json_text
from gambol._gambol import Experiment

#: How an experiment is made: the name of a constructor of ``Experiment``, and its arguments as JSON.
Recipe = tuple[str, str]

#: Arguments that are whole numbers.
_WHOLE = ("seeds", "evaluations", "steps", "runs", "generations", "trials")


def recipe(kind: str, **arguments: Any) -> Recipe:
    """The recipe of an experiment."""
    for name, value in arguments.items():
        numbers = value if name == "seeds" else [value]
        if name in _WHOLE and any(number is not None and number < 0 for number in numbers):
            raise ValueError(f"{name} = {value}: must not be below 0")
    return kind, json_text(kind, dict(sorted(arguments.items())))


@functools.lru_cache(maxsize=8)
def experiment(of: Recipe) -> Experiment:
    """The experiment; a process makes each once."""
    kind, arguments = of
    made: Experiment = getattr(Experiment, kind)(**json.loads(arguments))
    return made


def carry_out(of: Recipe, digest: str, run: int) -> str:
    """Does a run: the same text wherever and however often it is done, but for seconds.

    Raises:
        RuntimeError: if this machine would do another experiment: it has another version of Gambol or other files.
    """
    mine = experiment(of)
    if mine.digest != digest:
        # Files may have changed since it was made.
        experiment.cache_clear()
        mine = experiment(of)
    if mine.digest != digest:
        raise RuntimeError(
            f"this machine makes another experiment of the same words ({mine.digest}, not {digest}): "
            "it has another version of gambol, or other creature or configuration files"
        )
    return mine.carry_out(run)


class Runs:
    """The runs of an experiment as work, of which each result is a file of a folder."""

    def __init__(self, of: Recipe, folder: Path) -> None:
        """Begins or goes on in the folder."""
        # Of the files as they are now.
        experiment.cache_clear()
        self.experiment = experiment(of)
        self._of, self._folder = of, folder
        self._files: dict[int, Path] = {}
        self.experiment.begin(folder)

    def name(self, task: int) -> str:
        """What a run is called."""
        return self.experiment.name(task)

    def arguments(self, task: int) -> tuple[Any, ...]:
        """Those of :func:`carry_out`."""
        return self._of, self.experiment.digest, task

    def carry_out(self, task: int) -> str:
        """Does a run here."""
        return self.experiment.carry_out(task)

    def agree(self, one: str, other: str) -> bool:
        """Whether they are the same but for seconds."""
        return self.experiment.agree(one, other)

    def place(self, task: int, result: str) -> None:
        """Writes the file."""
        self._files[task] = self.experiment.place(self._folder, task, result)

    def remove(self, task: int) -> None:
        """Removes the file."""
        self._files[task].unlink(missing_ok=True)
