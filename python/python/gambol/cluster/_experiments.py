"""Experiments as recipes: what a node needs to know to do a run."""

from __future__ import annotations

import functools
import json
from typing import Any

from gambol._gambol import Experiment

#: How an experiment is made: the name of a constructor of ``Experiment``, and its arguments as JSON.
Recipe = tuple[str, str]


def recipe(kind: str, **arguments: Any) -> Recipe:
    """The recipe of an experiment."""
    return kind, json.dumps(arguments, sort_keys=True)


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
        raise RuntimeError(
            f"this machine makes another experiment of the same words ({mine.digest}, not {digest}): "
            "it has another version of gambol, or other creature or configuration files"
        )
    return mine.carry_out(run)
