"""What environments draw, and the window that shows it."""

from __future__ import annotations

import importlib
from collections.abc import Sequence
from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium.error import DependencyNotInstalled

from gambol._gambol import default_time_step

#: A picture, ``uint8[height, width, 3]``.
Frame = npt.NDArray[np.uint8]

#: Frames a second, where a step lasts as long as it does unless the settings say otherwise.
RENDER_FPS = round(1 / default_time_step())

#: Width and height of a picture, px.
RENDER_SIZE = (600, 400)

_SMALLEST, _LARGEST = 16, 4096


def check_drawing(render_mode: str | None, allowed: Sequence[str], render_size: tuple[int, int]) -> None:
    """Refuses a mode that there is not, and a picture that is too small or too large."""
    if render_mode is not None and render_mode not in allowed:
        names = " or ".join(repr(mode) for mode in allowed)
        raise ValueError(f"render_mode = {render_mode!r}: must be None or {names}")
    is_side = [isinstance(side, (int, np.integer)) and _SMALLEST <= side <= _LARGEST for side in render_size]
    if is_side != [True, True]:
        wanted = f"must be width and height, each a whole number from {_SMALLEST} to {_LARGEST} px"
        raise ValueError(f"render_size = {render_size!r}: {wanted}")


def warn_of_no_mode() -> None:
    """Says that nothing is drawn, as Gymnasium's environments do."""
    gymnasium.logger.warn('render draws nothing without a render_mode, such as render_mode="rgb_array"')


class Window:
    """A window of pygame, which opens with the first frame."""

    def __init__(self, title: str, fps: int) -> None:
        """``fps``: no more frames a second are shown."""
        try:
            self._pygame: Any = importlib.import_module("pygame")
        except ImportError as error:
            raise DependencyNotInstalled('render_mode="human" needs pygame: pip install pygame') from error
        self._title = title
        self._fps = fps
        self._surface: Any = None
        self._clock: Any = None

    def show(self, frame: Frame) -> None:
        """Shows a frame, and waits until it is time for the next."""
        pygame = self._pygame
        if self._surface is None:
            pygame.display.init()
            pygame.display.set_caption(self._title)
            self._surface = pygame.display.set_mode((frame.shape[1], frame.shape[0]))
            self._clock = pygame.time.Clock()
        pygame.surfarray.blit_array(self._surface, frame.swapaxes(0, 1))
        # Without it, systems take the window for one that hangs.
        pygame.event.pump()
        pygame.display.flip()
        self._clock.tick(self._fps)

    def close(self) -> None:
        """Closes the window, if one is open."""
        if self._surface is not None:
            self._pygame.display.quit()
            self._surface = None
