"""A bar that shows how far a run is, in a terminal or a notebook."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

Callback = Callable[[dict[str, Any]], bool | None]


@contextmanager
def shown(
    progress: bool | None, callback: Callback | None, generations: Callable[[], int | None]
) -> Iterator[Callback | None]:
    """The callback that shows a bar as well, if there is to be one.

    Args:
        progress: ``None``: if tqdm is installed, and there is a terminal or a notebook.
        callback: what else is called after each generation.
        generations: how many there will be, if that is known; asked once the run has begun.

    Raises:
        ImportError: if a bar is asked for and tqdm is not installed.
    """
    bars = _tqdm(progress)
    if bars is None:
        yield callback
        return
    with bars(unit="generation", leave=True) as bar:
        is_begun = False

        def told(line: dict[str, Any]) -> bool | None:
            nonlocal is_begun
            # A run that ends after so many steps has no number of generations either then.
            if not is_begun:
                bar.reset(total=generations())
            is_begun = True
            bar.set_postfix_str(_best(line), refresh=False)
            # A run that goes on begins where it was.
            bar.update(line["generation"] - bar.n)
            return callback(line) if callback is not None else None

        yield told


def _best(line: dict[str, Any]) -> str:
    best = line.get("best_so_far")
    return "" if best is None else f"best {best:.3g}"


def _tqdm(progress: bool | None) -> Any:
    if progress is False or (progress is None and not (sys.stderr.isatty() or _in_notebook())):
        return None
    try:
        return importlib.import_module("tqdm.auto").tqdm
    except ImportError:
        if progress:
            raise ImportError("progress=True needs tqdm: pip install tqdm") from None
        return None


def _in_notebook() -> bool:
    """Whether this is the kernel of a notebook, without importing what is not there."""
    shell = sys.modules.get("IPython")
    running = shell.get_ipython() if shell is not None else None
    return running is not None and type(running).__name__ == "ZMQInteractiveShell"
