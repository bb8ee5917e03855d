"""One creature in its world."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium.error import ResetNeeded

from gambol._build import build, single_spaces
from gambol._drawing import RENDER_FPS, RENDER_SIZE, Frame, Window, check_drawing, warn_of_no_mode

Floats = npt.NDArray[np.float32]


class CreatureEnv(gymnasium.Env[Floats, Floats]):
    """A creature and a movement: what :class:`gambol.VectorEnv` has many of, with the same spaces, rewards and ends.

    Observations are ``float32[inputs]``, actions ``float32[motors]`` from −1 to 1, rewards in the movement's unit.
    ``infos["fitness"]`` is there when an episode ends, ``infos["failure"]`` where it failed. A ``TimeLimit``, which
    ``gymnasium.make(..., max_episode_steps=...)`` puts around it, says nothing of the fitness: :attr:`value` does.

    With ``render_mode="rgb_array"`` :meth:`render` gives a picture; with ``"human"`` each reset and step is shown in a window
    of pygame, at the speed of the physics.

    For training use :func:`gambol.make_vec`: it is some hundred times faster.
    """

    metadata = {"render_modes": ["human", "rgb_array"], "render_fps": RENDER_FPS}

    def __init__(
        self,
        creature: str | os.PathLike[str],
        movement: str = "running",
        *,
        terrain: str | None = None,
        variation: str | None = None,
        max_episode_steps: int | None = None,
        preset: str | None = "plain",
        settings: Mapping[str, Any] | None = None,
        engine: str | None = None,
        render_mode: str | None = None,
        render_size: tuple[int, int] = RENDER_SIZE,
    ) -> None:
        """Builds the environment.

        Args:
            render_mode: ``None``, ``"rgb_array"`` or ``"human"``.
            render_size: width and height of the picture, each from 16 to 4096 px.

        The others are those of :func:`gambol.make_vec`.

        Raises:
            ValueError: if a name or a setting is wrong; the message says which, and what is allowed.
            gymnasium.error.DependencyNotInstalled: if a window is wanted and there is no pygame.
        """
        check_drawing(render_mode, CreatureEnv.metadata["render_modes"], render_size)
        self.render_mode = render_mode
        self._render_size = render_size
        self._native = build(
            creature,
            movement,
            1,
            preset=preset,
            terrain=terrain,
            variation=variation,
            engine=engine,
            max_episode_steps=max_episode_steps,
            settings=settings,
            autoreset="Disabled",
            threads=1,
        )
        self.observation_space, self.action_space = single_spaces(self._native, creature)
        self._row: Floats = np.zeros((1, self._native.shape[0]), np.float32)
        self._reward = np.zeros(1, np.float64)
        self._ends = np.zeros((2, 1), np.bool_)
        self._is_reset = False
        fps = round(1 / self._native.time_step)
        self.metadata = {**CreatureEnv.metadata, "render_fps": fps}
        title = f"{os.fspath(creature)}, {movement}"
        self._window = Window(title, fps) if render_mode == "human" else None

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Floats, dict[str, Any]]:
        """Begins the episode of a seed, or without one the next episode of the seed there is."""
        super().reset(seed=seed)
        if seed is None and not self._is_reset:
            seed = int(self.np_random.integers(0, 2**63))
        self._native.reset([seed], None, self._row)
        self._is_reset = True
        self._ends[:] = False
        self._show()
        return self._row[0].copy(), {}

    def step(self, action: npt.ArrayLike) -> tuple[Floats, float, bool, bool, dict[str, Any]]:
        """A time step: observation, reward, terminated, truncated, infos."""
        if not self._is_reset:
            raise ResetNeeded("call reset before step")
        if self._ends.any():
            raise ResetNeeded("the episode has ended: call reset")
        taken = np.ascontiguousarray(action, np.float32).reshape(1, -1)
        if taken.shape[1] != self._native.shape[1]:
            raise ValueError(f"an action must be of shape {self.action_space.shape}, found {np.shape(action)}")
        ended = self._native.step(taken, self._row, self._row.copy(), self._reward, self._ends[0], self._ends[1])
        infos: dict[str, Any] = {}
        for _, fitness, failure in ended:
            infos["fitness"] = fitness
            if failure is not None:
                infos["failure"] = failure
        self._show()
        return self._row[0].copy(), float(self._reward[0]), bool(self._ends[0, 0]), bool(self._ends[1, 0]), infos

    def render(self) -> Frame | None:
        """A picture of the creature where it is, ``uint8[height, width, 3]``, by a camera that follows it.

        It depends on nothing but where the creature is and on its ground. With ``render_mode="human"`` the window shows it, and
        ``None`` is returned.
        """
        if self.render_mode is None:
            warn_of_no_mode()
            return None
        if not self._is_reset:
            raise ResetNeeded("call reset before render")
        frame = self._native.frame(0, *self._render_size)
        if self._window is None:
            return frame
        self._window.show(frame)
        return None

    def _show(self) -> None:
        if self._window is not None:
            self.render()

    def close(self) -> None:
        """Closes the window, if there is one."""
        if self._window is not None:
            self._window.close()

    @property
    def value(self) -> float:
        """What the movement is worth so far, in :attr:`unit`: the sum of the rewards, and at the end the fitness."""
        return self._native.value(0)

    @property
    def unit(self) -> str:
        """The unit of rewards and fitness, such as m."""
        return self._native.unit

    @property
    def max_episode_steps(self) -> int:
        """The longest an episode lasts, in steps."""
        return self._native.episode_steps

    def parts(self) -> Floats:
        """Where the parts of the creature are, ``float32[parts, 3]``: x and y of the centre in m, and the angle in rad."""
        return self._native.parts(0)
