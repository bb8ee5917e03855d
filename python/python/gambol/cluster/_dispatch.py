"""Handing out the runs of an experiment, whatever they are handed to."""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from gambol._gambol import Experiment

#: Runs in flight for each worker: the next is there when one ends.
IN_FLIGHT = 2

#: A run whose worker has died so often is given up.
MOST_TRIES = 20


class DifferentBits(RuntimeError):
    """A machine computes other bits than the others. Nothing that it found was kept."""

    def __init__(self, node: str, run: str) -> None:
        """Names the machine and the run."""
        super().__init__(f"the machine {node} computes other bits than others ({run}): take it out and begin the same again")
        #: The machine.
        self.node = node
        #: What the run is called.
        self.run = run


class Lost(RuntimeError):
    """A worker, a machine or a result was lost before the run was done."""


@dataclass(frozen=True)
class Done:
    """What came of a run."""

    #: The result; ``None`` if it was lost.
    text: str | None
    #: The machine.
    node: str


class Workers(Protocol):
    """Machines that do runs."""

    def submit(self, run: int, avoid: str | None) -> int:
        """Begins a run, if it can be on another machine than this, and gives it a number."""

    def wait(self) -> tuple[int, Done]:
        """Waits until a run has ended."""

    def count(self) -> int:
        """How many runs can be done at the same time."""

    def nodes(self) -> int:
        """How many machines there are."""


class _Dispatch:
    """The runs of an experiment while they are done."""

    def __init__(self, experiment: Experiment, folder: Path, workers: Workers, every: int) -> None:
        self.experiment = experiment
        self.folder = folder
        self.workers = workers
        self.every = every
        #: What is in flight: the run, and the result it is to be compared with.
        self.flying: dict[int, tuple[int, Done | None]] = {}
        self.tries: Counter[int] = Counter()
        #: Machines whose first result another machine has found too.
        self.trusted: set[str] = set()
        #: Results of machines that are not trusted yet.
        self.held: dict[str, list[tuple[int, str]]] = {}
        #: The files that a machine's results were written to.
        self.placed: dict[str, list[Path]] = {}
        self.count = 0

    def submit(self, run: int, first: Done | None) -> None:
        self.flying[self.workers.submit(run, first.node if first else None)] = (run, first)

    def ended(self, number: int, done: Done) -> Iterator[int]:
        """Takes in what came; yields the runs that are placed now."""
        run, first = self.flying.pop(number)
        if done.text is None:
            self.tries[run] += 1
            if self.tries[run] == MOST_TRIES:
                raise Lost(f"{self.experiment.name(run)}: its worker was lost {MOST_TRIES} times ({done.node})")
            self.submit(run, first)
        elif first is not None and first.node == done.node and self.workers.nodes() > 1:
            # A machine is no witness of itself, where there is another.
            self.submit(run, first)
        elif first is not None:
            self.compare(run, first, done)
            for node in (first.node, done.node):
                self.trusted.add(node)
                for held, text in self.held.pop(node, []):
                    yield from self.place(held, text, node)
        else:
            # Of every machine the first, and of all results a share, are done again elsewhere.
            new = done.node not in self.trusted and done.node not in self.held
            self.count += 1
            if new or self.count % self.every == 0:
                self.submit(run, done)
            if done.node in self.trusted:
                yield from self.place(run, done.text, done.node)
            else:
                self.held.setdefault(done.node, []).append((run, done.text))

    def place(self, run: int, text: str, node: str) -> Iterator[int]:
        self.placed.setdefault(node, []).append(self.experiment.place(self.folder, run, text))
        yield run

    def compare(self, run: int, first: Done, second: Done) -> None:
        assert first.text is not None and second.text is not None
        if self.experiment.agree(first.text, second.text):
            return
        # The third, which decides, is this machine.
        mine = self.experiment.carry_out(run)
        wrong = second if self.experiment.agree(first.text, mine) else first
        for path in self.placed.get(wrong.node, []):
            path.unlink(missing_ok=True)
        raise DifferentBits(wrong.node, self.experiment.name(run))


def dispatch(
    experiment: Experiment, folder: Path, workers: Workers, *, check: float, on_run: Callable[[str, int, int], None]
) -> None:
    """Does the runs that are missing in the folder.

    Args:
        experiment: whose runs.
        folder: where results are placed.
        workers: who does them.
        check: the share of runs that is done on two machines and compared, from 0.001 to 1.
        on_run: called when a run's result is there, with its name, how many are there, and how many there are.

    Raises:
        DifferentBits: if a machine computes other bits.
        Lost: if a run's worker dies again and again.
    """
    if not 0.001 <= check <= 1:
        raise ValueError(f"check = {check}: must be from 0.001 to 1")
    experiment.begin(folder)
    missing = deque(experiment.missing(folder))
    there = experiment.runs - len(missing)
    work = _Dispatch(experiment, folder, workers, round(1 / check))
    while missing or work.flying:
        while missing and len(work.flying) < IN_FLIGHT * max(1, workers.count()):
            work.submit(missing.popleft(), None)
        for run in work.ended(*workers.wait()):
            there += 1
            on_run(experiment.name(run), there, experiment.runs)
