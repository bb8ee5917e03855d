"""Which machine is handed the next task."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping

#: Tasks that a processor has: the next is there when one ends.
IN_FLIGHT = 2


class _Machine:
    """A machine and the numbers of what it was handed, in that order: as many as it has processors are under way."""

    def __init__(self, processors: int) -> None:
        self.processors = processors
        self.tasks: list[int] = []

    @property
    def turn(self) -> int:
        """0 if a task would begin at once, 1 if it would be the next of a processor, and so on."""
        return len(self.tasks) // self.processors


class Machines:
    """The machines of a cluster, by how soon each begins a task."""

    def __init__(self) -> None:
        """None is known."""
        self._machines: dict[str, _Machine] = {}
        self._ready: list[deque[str]] = [deque() for _ in range(IN_FLIGHT)]

    def __len__(self) -> int:
        """How many there are."""
        return len(self._machines)

    def set(self, nodes: Mapping[str, int]) -> None:
        """Those that there are now, with their processors."""
        for node in self._machines.keys() - nodes.keys():
            del self._machines[node]
        for node in nodes:
            if node not in self._machines:
                self._machines[node] = _Machine(nodes[node])
                self._is_ready(node)

    def take(self, *, avoid: str | None = None, at_once: bool = False) -> str | None:
        """The machine that begins a task soonest, and is not this one unless there is no other; ``at_once``: or none."""
        avoid = avoid if len(self._machines) > 1 else None
        for turn, ready in enumerate(self._ready[:1] if at_once else self._ready):
            for _ in range(len(ready)):
                node = ready.popleft()
                machine = self._machines.get(node)
                # It was put here before it was handed more, or there were two of it.
                if machine is None or machine.turn != turn:
                    continue
                if node != avoid:
                    return node
                ready.append(node)
        return None

    def put_back(self, node: str) -> None:
        """The machine was taken for nothing."""
        self._is_ready(node)

    def hand(self, node: str, number: int) -> bool:
        """The machine, which was taken, has this task; whether that begins at once."""
        machine = self._machines[node]
        machine.tasks.append(number)
        self._is_ready(node)
        return len(machine.tasks) <= machine.processors

    def ended(self, node: str, number: int) -> int | None:
        """The task has ended; the number of the one that begins now, if there is one."""
        machine = self._machines.get(node)
        if machine is None or number not in machine.tasks:
            return None
        place = machine.tasks.index(number)
        del machine.tasks[place]
        self._is_ready(node)
        begins = place < machine.processors <= len(machine.tasks)
        return machine.tasks[machine.processors - 1] if begins else None

    def _is_ready(self, node: str) -> None:
        turn = self._machines[node].turn
        if turn < IN_FLIGHT:
            self._ready[turn].append(node)
