"""Tasks that know nothing of each other, and the machines that do them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Generic, Protocol, TypeVar

Result = TypeVar("Result")


class DifferentBits(RuntimeError):
    """A machine computes other bits than the others. Nothing that it found was kept."""

    def __init__(self, node: str, task: str) -> None:
        """Names the machine and the task."""
        super().__init__(f"the machine {node} computes other bits than others ({task}): take it out and begin the same again")
        #: The machine.
        self.node = node
        #: What the task is called.
        self.task = task

    def __reduce__(self) -> tuple[type[DifferentBits], tuple[str, str]]:
        """It pickles."""
        return type(self), (self.node, self.task)


class Lost(RuntimeError):
    """A worker, a machine or a result was lost before the task was done."""


@dataclass(frozen=True)
class Done(Generic[Result]):
    """What came of a task."""

    #: The result; ``None`` if it was lost.
    result: Result | None
    #: The machine; if it was lost, why.
    node: str
    #: What the task itself raised.
    error: Exception | None = None


class Workers(Protocol[Result]):
    """Machines that do tasks."""

    def nodes(self) -> Mapping[str, int]:
        """The machines there are, and how many tasks each can do at the same time."""

    def submit(self, arguments: tuple[Any, ...], node: str) -> int:
        """Begins a task on a machine, or on another if it is gone, and gives it a number."""

    def wait(self, seconds: float) -> tuple[int, Done[Result]] | None:
        """Waits until a task has ended, but no longer than this."""

    def withdraw(self, number: int) -> None:
        """Nothing asks for this task any more: if it has not begun, it ends as if it were lost."""

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
