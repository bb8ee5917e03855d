"""Movements written in Python."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from gambol import _gambol
from gambol._build import whole
from gambol._gambol import Snapshot


class Movement(Protocol):
    """What a creature shall do, and how good it is at it: one object watches one creature, episode after episode."""

    def begin(self, start: Snapshot) -> None:
        """An episode begins with the creature in this state."""

    def observe(self, now: Snapshot) -> bool | None:
        """A step has passed. ``True`` ends the episode."""

    def value(self) -> float:
        """What the episode so far is worth, to be maximised."""


def register_movement(
    name: str, make: Callable[[], Movement], *, unit: str = "m", steps: int | None = 1000, description: str = ""
) -> None:
    """Adds a movement written in Python: from then on its name is a movement's, in this process.

    Environments and training know it, and so do terms. Python is called in every step of every creature, one after the other: some
    hundred times slower than a movement in Rust (docs/own-movement.md). Replays of champions need it registered, and the machines
    of a cluster do not know it.

    Args:
        name: of lower-case letters, digits and hyphens; none that the library has. One that was registered before is replaced.
        make: makes a movement, for each creature one; a class without arguments is fine.
        unit: of the value, such as ``"m"``, ``"s"`` or ``"1"``.
        steps: how long an episode lasts, from 1 to 1,000,000; ``None`` for what makes sense only as a term.
        description: a sentence.

    Raises:
        ValueError: if the name or the number is not allowed.
    """
    length = None if steps is None else whole("steps", steps, 1, 1_000_000)
    _gambol.register_movement(name, unit, length, description, make)
