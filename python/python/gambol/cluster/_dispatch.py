"""Handing out tasks that know nothing of each other, whatever they are handed to."""

from __future__ import annotations

import bisect
import threading
from collections import Counter, deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Generic

from gambol.cluster._machines import Machines
from gambol.cluster._work import DifferentBits, Done, Lost, Result, Work, Workers

#: A task whose worker has died so often is given up.
MOST_TRIES = 20

#: A task that takes so many times as long as the median is begun on a second machine, once there is nothing else to do.
SLOW = 1.5

#: Tasks that must have ended before their median says something.
ENOUGH = 3

#: Seconds between two looks at which machines there are.
LOOK = 2.0

#: Seconds without any machine after which work is broken off.
PATIENCE = 60.0


class Dispatcher(Generic[Result]):
    """Hands out several pieces of work at a time, and remembers which machines it may trust. Threads may share one."""

    def __init__(self, workers: Workers[Result], check: float) -> None:
        """``check``: the share of tasks that is done on two machines and compared, from 0.001 to 1.

        Raises:
            ValueError: if it is not.
        """
        if not 0.001 <= check <= 1:
            raise ValueError(f"check = {check}: must be from 0.001 to 1")
        self._workers = workers
        self._every = round(1 / check)
        self._machines = Machines()
        self._doings: deque[Doing[Result]] = deque()
        self._flights: dict[int, _Flight[Result]] = {}
        #: Machines whose first result another machine has found too.
        self._trusted: set[str] = set()
        self._count = 0
        self._looked = float("-inf")
        self._alone_since: float | None = None
        self._changed = threading.Condition()
        self._is_led = False

    def do(self, work: Work[Result], tasks: Iterable[int]) -> Iterator[int]:
        """Does tasks; yields each when its result is placed.

        Raises:
            DifferentBits: if a machine computes other bits.
            Lost: if a task's worker dies again and again, or there is no machine.
        """
        doing = self.begin(work, tasks)
        try:
            while True:
                with self._changed:
                    placed, over = list(doing.news), doing.is_over
                    doing.news.clear()
                yield from placed
                if over:
                    break
                self._lead_or_wait(doing)
        finally:
            self.end(doing)

    def begin(self, work: Work[Result], tasks: Iterable[int]) -> Doing[Result]:
        """The work while it is done, turn by turn."""
        doing = Doing(work, tasks)
        with self._changed:
            self._doings.append(doing)
        return doing

    def end(self, doing: Doing[Result]) -> None:
        """Forgets it.

        Raises:
            DifferentBits, Lost: if that was its end.
        """
        with self._changed:
            for number in doing.flying:
                # What is under way is done to its end, or ended by force: a worker that was asked to stop cannot be.
                if number in doing.queued:
                    self._forget(number)
                else:
                    self._flights[number].doing = None
            self._doings.remove(doing)
        if doing.error is not None:
            raise doing.error

    def turn(self) -> None:
        """Hands out what can be, and takes in the next that ends."""
        with self._changed:
            seconds = self._hand_out()
        ended = self._workers.wait(seconds)
        with self._changed:
            if ended is not None:
                self._take_in(*ended)
            self._changed.notify_all()

    def _lead_or_wait(self, doing: Doing[Result]) -> None:
        """One thread does turns for all."""
        with self._changed:
            if self._is_led:
                self._changed.wait_for(lambda: doing.news or doing.is_over or not self._is_led)
                return
            self._is_led = True
        try:
            self.turn()
        finally:
            with self._changed:
                self._is_led = False
                self._changed.notify_all()

    def _look(self) -> None:
        now = self._workers.now()
        if now - self._looked >= LOOK or not self._machines:
            self._looked = now
            self._machines.set(self._workers.nodes())
        if self._machines or self._flights:
            self._alone_since = None
        elif self._alone_since is None:
            self._alone_since = now
        elif now - self._alone_since > PATIENCE:
            for doing in self._doings:
                doing.error = Lost(f"there was no machine for {PATIENCE:.0f} s; the same call goes on when there is one")

    def _hand_out(self) -> float:
        """Hands out what there is; returns for how many seconds nothing is to be done."""
        self._look()
        doings = [doing for doing in self._doings if doing.error is None]
        # The works take turns.
        self._doings.rotate(-1)
        for doing in doings:
            for _ in range(len(doing.again)):
                task, first = doing.again.popleft()
                node = self._machines.take(avoid=first.node if first else None)
                if node is None:
                    doing.again.append((task, first))
                else:
                    self._submit(doing, task, first, node)
        soonest = min((self._hand_out_again(doing) for doing in doings if not doing.waiting), default=LOOK)
        waiting = deque(doing for doing in doings if doing.waiting)
        while waiting and (node := self._machines.take()) is not None:
            self._submit(waiting[0], waiting[0].waiting.popleft(), None, node)
            waiting.rotate(-1)
            if not waiting[-1].waiting:
                waiting.pop()
        return soonest

    def _hand_out_again(self, doing: Doing[Result]) -> float:
        """Begins on other machines what takes long, and on idle ones what has not begun; returns when there may be more."""
        median = doing.median
        if median is None:
            return LOOK
        now = self._workers.now()
        soonest = LOOK
        for number in list(doing.running):
            flight = self._flights[number]
            if flight.is_doubled:
                continue
            assert flight.since is not None
            late_in = flight.since + SLOW * median - now
            if late_in > 0:
                # Those that follow began later.
                soonest = min(soonest, late_in)
                break
            if not self._double(doing, flight, at_once=False):
                break
        for number in list(doing.queued):
            flight = self._flights[number]
            if not flight.is_doubled and not self._double(doing, flight, at_once=True):
                break
        return max(0.001, soonest)

    def _double(self, doing: Doing[Result], flight: _Flight[Result], *, at_once: bool) -> bool:
        """Begins a task on another machine too, if there is one."""
        node = self._machines.take(avoid=flight.node, at_once=at_once)
        if node is None:
            return False
        if node == flight.node:
            self._machines.put_back(node)
            return False
        flight.is_doubled = flight.has_others = True
        self._submit(doing, flight.task, flight.first, node).has_others = True
        return True

    def _submit(self, doing: Doing[Result], task: int, first: Done[Result] | None, node: str) -> _Flight[Result]:
        number = self._workers.submit(doing.work.arguments(task), node)
        begins = self._machines.hand(node, number)
        flight = _Flight(doing, task, first, node, self._workers.now() if begins else None)
        self._flights[number] = flight
        (doing.running if begins else doing.queued)[number] = None
        return flight

    def _forget(self, number: int) -> None:
        """Its result is known, or nothing asks for it; the machine has it until it ends."""
        self._flights[number].doing = None
        self._workers.withdraw(number)

    def _take_in(self, number: int, done: Done[Result]) -> None:
        flight = self._flights.pop(number)
        begun = self._machines.ended(flight.node, number)
        if begun is not None:
            self._begins(begun)
        doing = flight.doing
        if doing is None:
            return
        doing.drop(number)
        if done.error is not None:
            doing.error = done.error
        elif done.result is None:
            self._looked = float("-inf")
            self._lost(doing, flight, done)
        else:
            if flight.since is not None:
                bisect.insort(doing.seconds, self._workers.now() - flight.since)
            for other in self._others(flight):
                doing.drop(other)
                self._forget(other)
            self._witness(doing, flight, done, done.result)

    def _begins(self, number: int) -> None:
        flight = self._flights[number]
        flight.since = self._workers.now()
        if flight.doing is not None:
            del flight.doing.queued[number]
            flight.doing.running[number] = None

    def _lost(self, doing: Doing[Result], flight: _Flight[Result], done: Done[Result]) -> None:
        doing.tries[flight.task] += 1
        if doing.tries[flight.task] == MOST_TRIES:
            doing.error = Lost(f"{doing.work.name(flight.task)}: its worker was lost {MOST_TRIES} times ({done.node})")
        others = self._others(flight)
        for other in others:
            self._flights[other].is_doubled = False
        if not others:
            doing.again.append((flight.task, flight.first))

    def _others(self, one: _Flight[Result]) -> list[int]:
        """The same on other machines."""
        if not one.has_others or one.doing is None:
            return []
        same = one.task, one.first is None
        flying = ((number, self._flights[number]) for number in one.doing.flying)
        return [number for number, flight in flying if (flight.task, flight.first is None) == same]

    def _witness(self, doing: Doing[Result], flight: _Flight[Result], done: Done[Result], result: Result) -> None:
        """Keeps the result, or has it found by another machine too: of every machine the first, and of all a share."""
        first = flight.first
        if first is None:
            is_new = done.node not in self._trusted and done.node not in doing.held
            self._count += 1
            if is_new or self._count % self._every == 0:
                doing.again.append((flight.task, done))
            if done.node in self._trusted:
                doing.place(flight.task, result, done.node)
            else:
                doing.held.setdefault(done.node, []).append((flight.task, result))
        elif first.node == done.node and len(self._machines) > 1:
            # A machine is no witness of itself, where there is another.
            doing.again.append((flight.task, first))
        elif (wrong := doing.disagree(flight.task, first, done)) is not None:
            for other in self._doings:
                other.remove_from(wrong)
                other.error = DifferentBits(wrong, doing.work.name(flight.task))
        else:
            for node in (first.node, done.node):
                self._trusted.add(node)
                for other in self._doings:
                    for held, kept in other.held.pop(node, []):
                        other.place(held, kept, node)


@dataclass
class _Flight(Generic[Result]):
    """A task that was handed to a machine."""

    #: What it is for; ``None`` if its result is known or nothing asks for it.
    doing: Doing[Result] | None
    task: int
    #: The result it is to be compared with.
    first: Done[Result] | None
    node: str
    #: When it began, as far as is known.
    since: float | None
    #: Whether it was begun on another machine after this.
    is_doubled: bool = False
    #: Whether it was ever on several.
    has_others: bool = False


class Doing(Generic[Result]):
    """A piece of work while it is done."""

    def __init__(self, work: Work[Result], tasks: Iterable[int]) -> None:
        """Nothing is handed out yet."""
        self.work = work
        #: Tasks that are placed and were not told yet.
        self.news: deque[int] = deque()
        #: Why it broke off.
        self.error: BaseException | None = None
        self.waiting = deque(tasks)
        #: What is to be done before these: lost tasks, and those that are compared.
        self.again: deque[tuple[int, Done[Result] | None]] = deque()
        #: The numbers of what is under way, in the order in which it began.
        self.running: dict[int, None] = {}
        #: The numbers of what was handed out and waits at its machine.
        self.queued: dict[int, None] = {}
        self.tries: Counter[int] = Counter()
        #: Results of machines that are not trusted yet.
        self.held: dict[str, list[tuple[int, Result]]] = {}
        #: How long tasks took, in order of size.
        self.seconds: list[float] = []
        #: Which tasks' results came from a machine.
        self._placed: dict[str, list[int]] = {}

    @property
    def is_over(self) -> bool:
        """Whether all is placed, or an error ended it."""
        return self.error is not None or not (self.waiting or self.again or self.running or self.queued)

    @property
    def flying(self) -> list[int]:
        """The numbers of all that was handed out."""
        return [*self.running, *self.queued]

    def drop(self, number: int) -> None:
        """It ended, or nothing asks for it."""
        self.running.pop(number, None)
        self.queued.pop(number, None)

    @property
    def median(self) -> float | None:
        """How long a task takes, once some have ended."""
        return self.seconds[len(self.seconds) // 2] if len(self.seconds) >= ENOUGH else None

    def place(self, task: int, result: Result, node: str) -> None:
        """Keeps a result."""
        self.work.place(task, result)
        self._placed.setdefault(node, []).append(task)
        self.news.append(task)

    def disagree(self, task: int, first: Done[Result], second: Done[Result]) -> str | None:
        """The machine whose result is wrong, if they differ: the third, which decides, is this one."""
        assert first.result is not None and second.result is not None
        if self.work.agree(first.result, second.result):
            return None
        return second.node if self.work.agree(first.result, self.work.carry_out(task)) else first.node

    def remove_from(self, node: str) -> None:
        """Removes what a machine has found."""
        for task in self._placed.pop(node, []):
            self.work.remove(task)
