"""Champion files: the best that a run has found."""

from __future__ import annotations

import html
import json
import os
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from gambol import _gambol
from gambol._build import seed_of, whole


class Champion:
    """The best that a run has found: a champion file.

    Raises:
        OSError: if the file cannot be read or is damaged.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        """Reads the file."""
        #: The file.
        self.path = Path(path)
        #: All that the file says, as docs/files.md has it.
        self.data: dict[str, Any] = json.loads(_gambol.read_champion(self.path))

    @property
    def fitness(self) -> float:
        """The fitness, in the movement's unit, of one episode in rapier."""
        return float(self.data["fitness"])

    @property
    def generation(self) -> int:
        """The generation it was found in, from 1."""
        return int(self.data["generation"])

    def verify(self) -> bool:
        """Replays it in rapier: whether every step has the bits that the file records."""
        return _gambol.verify(self.path)[0]

    def gait(self) -> dict[str, Any]:
        """Its gait, measured and judged: travel, stride, cheats, and the verdict. See docs/gaits.md.

        Raises:
            ValueError: if there is nothing to measure.
        """
        report: dict[str, Any] = json.loads(_gambol.judge_gait(self.path))
        return report

    def robustness(self, worlds: int = 100, *, seed: int = 1, variation: str | None = None) -> dict[str, Any]:
        """What is left of its gait in worlds that are not quite the one it learned in, as ``gambol robust --json`` says it.

        Args:
            worlds: how many, from 1 to 100,000. Causes take turns: bumps, pushes, friction and mass, physics, all together.
            seed: what the worlds, and commands, are drawn from.
            variation: draws worlds as this variation does for training, in place of the causes.

        Returns:
            ``usable_share``, from 0 to 1; ``fitness_kept``; ``causes``; ``reasons``; every world in ``trials``; and more.

        Raises:
            ValueError: if a number is out of its range, or there is no such variation.
        """
        count = whole("worlds", worlds, 1, 100_000)
        found: dict[str, Any] = json.loads(_gambol.champion_robustness(self.path, count, seed_of(seed), variation))
        return found

    def export(
        self,
        format: str,
        out: str | os.PathLike[str] | None = None,
        *,
        seconds: float | None = None,
        size: int | None = None,
        rate: float | None = None,
        ground: bool = False,
        overwrite: bool = False,
    ) -> list[Path]:
        """Writes it in another format, as ``gambol export --to`` does. See docs/exports.md.

        Args:
            format: ``"player"``, ``"trace"``, ``"csv"``, ``"gif"``, ``"apng"``, ``"svg"``, ``"sprites"``, ``"gltf"``,
                ``"dragonbones"`` or ``"onnx"``.
            out: the file; others that belong to it stand beside it. By default CREATURE-MOVEMENT in the current folder.
            seconds: how long it is played, for traces and trajectories; by default as long as its movement is judged.
            size: the longer side of a frame in pixels, from 16 to 2,048; 256 by default.
            rate: frames a second, from 1 to 60; 25 by default.
            ground: whether pictures have sky and ground.
            overwrite: whether files that are there may be overwritten.

        Returns:
            The files.

        Raises:
            ValueError: if there is no such format, a number is out of its range, or the format cannot hold it.
            FileExistsError: if a file is there.
        """
        return _gambol.export_champion(
            self.path,
            format,
            None if out is None else Path(out),
            seconds=seconds,
            size=None if size is None else whole("size", size, 16, 2048),
            rate=rate,
            ground=ground,
            overwrite=overwrite,
        )

    def replay(self, page: str | os.PathLike[str], *, seconds: float | None = None) -> Path:
        """Writes a page that replays it and needs nothing else, as ``gambol replay --html`` does.

        Args:
            page: the file; one that is there is overwritten, but for the champion itself.
            seconds: how long it is played; by default as long as its movement is judged.

        Returns:
            The file.
        """
        _gambol.write_replay(self.path, Path(page), seconds)
        return Path(page)

    def controller(self) -> Controller:
        """Its net."""
        return Controller(_gambol.Net.of_champion(self.path))

    def __repr__(self) -> str:
        """Its fitness and where it is."""
        return f"Champion(fitness={self.fitness:.6g}, path={str(self.path)!r})"

    def _repr_html_(self) -> str:
        """Its replay, for notebooks."""
        with tempfile.TemporaryDirectory() as folder:
            page = self.replay(Path(folder) / "replay.html").read_text(encoding="utf-8")
        # The page knows its own script by its bytes, whatever a notebook is saved as.
        source = html.escape(page).encode("ascii", "xmlcharrefreplace").decode("ascii")
        return (
            f'<iframe srcdoc="{source}" sandbox="allow-scripts" title="{html.escape(repr(self))}" '
            'style="width: 100%; height: 640px; border: 0"></iframe>'
        )


class Controller:
    """A champion's net: observations in, actions out. It pickles, without what it remembers."""

    def __init__(self, net: _gambol.Net) -> None:
        """Wraps the native net."""
        self._net = net
        #: How many observations it takes, and how many actions it gives.
        self.inputs, self.outputs = net.shape

    def __call__(self, observations: npt.ArrayLike) -> npt.NDArray[np.float32]:
        """The actions ``float32[outputs]`` for observations ``float32[inputs]``; ``[n, outputs]`` for ``[n, inputs]``.

        A recurrent net remembers what it was given before, the rows of one call one after the other: each of several environments
        needs a controller of its own. :meth:`reset` begins anew.

        Raises:
            ValueError: if there are more or fewer observations than inputs.
        """
        given = np.asarray(observations, np.float32)
        if given.ndim not in (1, 2) or given.shape[-1] != self.inputs:
            raise ValueError(f"observations must be of shape ({self.inputs},) or (n, {self.inputs}), found {given.shape}")
        actions = self._net.activate(np.ascontiguousarray(np.atleast_2d(given)))
        return actions[0] if given.ndim == 1 else actions

    def reset(self) -> None:
        """Forgets all observations before."""
        self._net.reset()

    def __getstate__(self) -> str:
        """The net, as JSON."""
        return self._net.text()

    def __setstate__(self, state: str) -> None:
        """The same net."""
        Controller.__init__(self, _gambol.Net.of_text(state))

    def __repr__(self) -> str:
        """Its shape."""
        return f"Controller(inputs={self.inputs}, outputs={self.outputs})"
