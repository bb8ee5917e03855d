"""Handing out tasks that know nothing of each other, whatever they are handed to."""

from __future__ import annotations

import statistics
from collections import Counter, deque
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Generic, Protocol, TypeVar

Result = TypeVar("Result")

#: Tasks that a processor has: the next is there when one ends.
IN_FLIGHT = 2

#: A task whose worker has died so often is given up.
MOST_TRIES = 20

#: A task that takes so many times as long as others is begun on a second machine, once there is nothing else to do.
SLOW = 2.0

#: Seconds between two looks at which machines there are.
LOOK = 2.0

#: Seconds without any machine after which the work is broken off.
PATIENCE = 60.0


class DifferentBits(RuntimeError):
    """A machine computes other bits than the others. Nothing that it found was kept."""

    def __init__(self, node: str, task: str) -> None:
        """Names the machine and the task."""
        super().__init__(f"the machine {node} computes other bits than others ({task}): take it out and begin the same again")
        #: The machine.
        self.node = node
        #: What the task is called.
        self.task = task


class Lost(RuntimeError):
    """A worker, a machine or a result was lost before the task was done."""


@dataclass(frozen=True)
class Done(Generic[Result]):
    """What came of a task."""

    #: The result; ``None`` if it was lost.
    result: Result | None
    #: The machine; if it was lost, why.
    node: str


class Workers(Protocol[Result]):
    """Machines that do tasks."""

    def nodes(self) -> Mapping[str, int]:
        """The machines there are, and how many tasks each can do at the same time."""

    def submit(self, arguments: tuple[Any, ...], node: str) -> int:
        """Begins a task on a machine, or on another if it is gone, and gives it a number."""

    def wait(self, seconds: float) -> tuple[int, Done[Result]] | None:
        """Waits until a task has ended, but no longer than this."""

    def now(self) -> float:
        """Seconds on a clock that goes forward."""

    def cancel(self) -> None:
        """Ends what is under way."""


class Work(Protocol[Result]):
    """Tasks that know nothing of each other: done twice, each has the same result."""

    def name(self, task: int) -> str:
        """What a task is called in messages."""

    def arguments(self, task: int) -> tuple[Any, ...]:
        """What a worker needs to know."""

    def carry_out(self, task: int) -> Result:
        """Does a task here."""

    def agree(self, one: Result, other: Result) -> bool:
        """Whether two results are those of the same task."""

    def place(self, task: int, result: Result) -> None:
        """Keeps a result."""

    def remove(self, task: int) -> None:
        """Removes a result that was kept."""


@dataclass
class _Flight(Generic[Result]):
    """A task that was handed to a machine."""

    task: int
    #: The result it is to be compared with.
    first: Done[Result] | None
    node: str
    since: float
    #: Whether it was begun on a second machine, or is that second.
    doubled: bool = False


class Dispatcher(Generic[Result]):
    """Hands out work, one after the other, and remembers which machines it may trust."""

    def __init__(self, workers: Workers[Result], check: float) -> None:
        """``check``: the share of tasks that is done on two machines and compared, from 0.001 to 1.

        Raises:
            ValueError: if it is not.
        """
        if not 0.001 <= check <= 1:
            raise ValueError(f"check = {check}: must be from 0.001 to 1")
        self._workers = workers
        self._every = round(1 / check)
        self._count = 0
        #: Machines whose first result another machine has found too.
        self._trusted: set[str] = set()
        self._nodes: Mapping[str, int] = {}
        self._looked = float("-inf")
        #: Each machine as often as it can take a task.
        self._free: deque[str] = deque()
        #: Tasks whose result is there from elsewhere, and the machine each occupies.
        self._late: dict[int, str] = {}

    def do(self, work: Work[Result], tasks: Iterable[int]) -> Iterator[int]:
        """Does tasks; yields each when its result is placed.

        Raises:
            DifferentBits: if a machine computes other bits.
            Lost: if a task's worker dies again and again, or there is no machine.
        """
        yield from _Doing(self, work, tasks).run()

    def look(self, *, now: bool) -> None:
        """Looks which machines there are, if it is time or asked for."""
        if not now and self._workers.now() - self._looked < LOOK:
            return
        self._looked = self._workers.now()
        before, self._nodes = self._nodes, dict(self._workers.nodes())
        self._free = deque(node for node in self._free if node in self._nodes)
        new = {node: slots for node, slots in self._nodes.items() if node not in before}
        for turn in range(IN_FLIGHT * max(new.values(), default=0)):
            self._free.extend(node for node, slots in new.items() if turn < IN_FLIGHT * slots)

    def take(self, avoid: str | None) -> str | None:
        """A machine that can take a task, and is not this one unless there is no other."""
        only = avoid is None or not any(node != avoid for node in self._nodes)
        for _ in range(len(self._free)):
            node = self._free.popleft()
            if only or node != avoid:
                return node
            self._free.append(node)
        return None

    def give_back(self, node: str) -> None:
        """The machine can take another task."""
        if node in self._nodes:
            self._free.append(node)


class _Doing(Generic[Result]):
    """One piece of work while it is done."""

    def __init__(self, dispatcher: Dispatcher[Result], work: Work[Result], tasks: Iterable[int]) -> None:
        self.dispatcher, self.work = dispatcher, work
        self.workers = dispatcher._workers
        self.waiting = deque(tasks)
        #: What is to be done before these: lost tasks, and those that are compared.
        self.again: deque[tuple[int, Done[Result] | None]] = deque()
        #: In the order in which they were handed out.
        self.flying: dict[int, _Flight[Result]] = {}
        self.tries: Counter[int] = Counter()
        #: Results of machines that are not trusted yet.
        self.held: dict[str, list[tuple[int, Result]]] = {}
        #: Which tasks' results came from a machine.
        self.placed: dict[str, list[int]] = {}
        self.seconds: list[float] = []

    def run(self) -> Iterator[int]:
        alone_since = self.workers.now()
        while self.waiting or self.again or self.flying:
            self.dispatcher.look(now=not self.dispatcher._nodes)
            self.hand_out()
            ended = self.workers.wait(min(LOOK, self.hand_out_late()))
            if self.flying or ended is not None:
                alone_since = self.workers.now()
            elif self.workers.now() - alone_since > PATIENCE:
                raise Lost(f"there was no machine for {PATIENCE:.0f} s; the same call goes on when there is one")
            if ended is not None:
                yield from self.ended(*ended)

    def hand_out(self) -> None:
        for _ in range(len(self.again)):
            task, first = self.again.popleft()
            node = self.dispatcher.take(first.node if first else None)
            if node is None:
                self.again.append((task, first))
            else:
                self.submit(task, first, node)
        while self.waiting and (node := self.dispatcher.take(None)) is not None:
            self.submit(self.waiting.popleft(), None, node)

    def hand_out_late(self) -> float:
        """Begins on a second machine what takes long; returns in how many seconds there may be more."""
        if self.waiting or self.again or len(self.seconds) < 3:
            return LOOK
        now, limit = self.workers.now(), SLOW * statistics.median(self.seconds)
        for flight in list(self.flying.values()):
            if flight.doubled:
                continue
            if now - flight.since < limit:
                return max(0.001, flight.since + limit - now)
            node = self.dispatcher.take(flight.node)
            if node is None:
                return LOOK
            if node == flight.node:
                self.dispatcher.give_back(node)
                return LOOK
            flight.doubled = True
            self.submit(flight.task, flight.first, node, doubled=True)
        return LOOK

    def submit(self, task: int, first: Done[Result] | None, node: str, *, doubled: bool = False) -> None:
        number = self.workers.submit(self.work.arguments(task), node)
        self.flying[number] = _Flight(task, first, node, self.workers.now(), doubled)

    def ended(self, number: int, done: Done[Result]) -> Iterator[int]:
        """Takes in what came; yields the tasks that are placed now."""
        flight = self.flying.pop(number, None)
        if flight is None:
            # Its result is known, or nothing asks for it any more.
            self.dispatcher.give_back(self.dispatcher._late.pop(number, ""))
            return
        self.dispatcher.give_back(flight.node)
        if done.result is None:
            self.dispatcher.look(now=True)
            self.lost(flight, done)
            return
        self.seconds.append(self.workers.now() - flight.since)
        for other in self.others(flight):
            self.dispatcher._late[other] = self.flying.pop(other).node
        yield from self.take_in(flight.task, flight.first, done, done.result)

    def lost(self, flight: _Flight[Result], done: Done[Result]) -> None:
        self.tries[flight.task] += 1
        if self.tries[flight.task] == MOST_TRIES:
            raise Lost(f"{self.work.name(flight.task)}: its worker was lost {MOST_TRIES} times ({done.node})")
        others = self.others(flight)
        for other in others:
            self.flying[other].doubled = False
        if not others:
            self.again.append((flight.task, flight.first))

    def others(self, one: _Flight[Result]) -> list[int]:
        """The same on other machines."""
        if not one.doubled:
            return []
        same = one.task, one.first is None
        return [number for number, flight in self.flying.items() if (flight.task, flight.first is None) == same]

    def take_in(self, task: int, first: Done[Result] | None, done: Done[Result], result: Result) -> Iterator[int]:
        trusted = self.dispatcher._trusted
        if first is not None and first.node == done.node and len(self.dispatcher._nodes) > 1:
            # A machine is no witness of itself, where there is another.
            self.again.append((task, first))
        elif first is not None:
            self.compare(task, first, done, result)
            for node in (first.node, done.node):
                trusted.add(node)
                for held, kept in self.held.pop(node, []):
                    yield from self.place(held, kept, node)
        else:
            # Of every machine the first, and of all results a share, are done again elsewhere.
            new = done.node not in trusted and done.node not in self.held
            self.dispatcher._count += 1
            if new or self.dispatcher._count % self.dispatcher._every == 0:
                self.again.append((task, done))
            if done.node in trusted:
                yield from self.place(task, result, done.node)
            else:
                self.held.setdefault(done.node, []).append((task, result))

    def place(self, task: int, result: Result, node: str) -> Iterator[int]:
        self.work.place(task, result)
        self.placed.setdefault(node, []).append(task)
        yield task

    def compare(self, task: int, first: Done[Result], second: Done[Result], result: Result) -> None:
        assert first.result is not None
        if self.work.agree(first.result, result):
            return
        # The third, which decides, is this machine.
        wrong = second if self.work.agree(first.result, self.work.carry_out(task)) else first
        for other in self.placed.get(wrong.node, []):
            self.work.remove(other)
        raise DifferentBits(wrong.node, self.work.name(task))
