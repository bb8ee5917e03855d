"""Whether a generation is worth a cluster, and in which pieces it is sent."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

#: A piece takes so many times as long as handing it out.
LEAST = 10

#: Handing out is done in this share of the time that all processors need for what was handed out.
HANDING = 0.8

#: Creatures that the lanes step at the same time.
LANES = 16

#: A cluster is worth it if a generation takes no more than this share of the time.
WORTH = 0.8


@dataclass(frozen=True)
class Plan:
    """What a generation takes here and on a cluster, from measured times. ``str`` of it says what is worth it.

    The model: tasks are handed out one after the other, each takes ``overhead`` and ``sending`` for every individual; a processor
    works on one at a time.
    """

    #: Individuals to evaluate.
    individuals: int
    #: Seconds that evaluating one takes, on one processor.
    each: float
    #: Processors of the cluster, from 1.
    processors: int
    #: Processors of this machine, from 1.
    here: int
    #: Seconds that handing out a task takes.
    overhead: float
    #: Seconds that sending one individual takes.
    sending: float = 0.0

    @property
    def piece(self) -> int:
        """Individuals of a task: as few as handing out allows, a multiple of the lanes unless there are fewer.

        The smaller the pieces, the sooner the last of them is done.
        """
        least = max(LEAST, self.processors / HANDING) * self.overhead / self.each
        piece = min(least, self.individuals / self.processors)
        return min(self.individuals, math.ceil(piece / LANES) * LANES)

    @property
    def local(self) -> float:
        """Seconds here."""
        return math.ceil(self.individuals / self.here) * self.each

    @property
    def remote(self) -> float:
        """Seconds on the cluster."""
        piece = self.piece
        pieces = math.ceil(self.individuals / piece)
        handing = self.overhead + piece * self.sending
        last_handed = pieces * handing + piece * self.each
        all_done = math.ceil(pieces / self.processors) * piece * self.each + min(pieces, self.processors) * handing
        return max(last_handed, all_done)

    @property
    def worth(self) -> bool:
        """Whether the cluster is worth it."""
        return self.remote <= WORTH * self.local

    def least(self) -> int | None:
        """The smallest power of two of individuals that is worth it; ``None`` if none is below 2³⁰."""
        sizes = (2**power for power in range(31))
        return next((size for size in sizes if replace(self, individuals=size).worth), None)

    def __str__(self) -> str:
        """In a sentence."""
        times = f"{_count(self.individuals)} take {_time(self.local)} here, {_time(self.remote)} on {_processors(self.processors)}"
        if self.worth:
            return f"{times}: worth a cluster, in pieces of {self.piece:,}"
        least = self.least()
        return f"{times}: not worth a cluster; " + (f"{least:,} are" if least else "no population is")


def _count(individuals: int) -> str:
    return "1 individual" if individuals == 1 else f"{individuals:,} individuals"


def _processors(count: int) -> str:
    return "1 processor" if count == 1 else f"{count:,} processors"


def _time(seconds: float) -> str:
    return f"{seconds * 1e3:.3g} ms" if seconds < 1 else f"{seconds:.3g} s"
