"""Ray as workers."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any, Generic, TypeVar

from gambol.cluster._work import Done

Result = TypeVar("Result")


def _on_node(function: Callable[..., Result], *arguments: Any) -> tuple[Result, str]:
    """A task, and the machine it was done on."""
    ray = import_module("ray")
    return function(*arguments), ray.get_runtime_context().get_node_id()


class RayWorkers(Generic[Result]):
    """The nodes of a Ray cluster; ``ray`` is the module, which is initialised if it is not yet."""

    def __init__(self, ray: Any, function: Callable[..., Result]) -> None:
        """Connects to the cluster. ``function``: what a task does; a worker imports it by its name."""
        self._ray = ray
        if not ray.is_initialized():
            ray.init()
        self._errors = import_module("ray.exceptions")
        # What is lost is handed out again by the dispatcher, which counts how often.
        self._task = ray.remote(num_cpus=1, max_retries=0)(_on_node)
        self._function = function
        self._tasks: dict[str, Any] = {}
        self._flying: dict[Any, int] = {}
        self._of_number: dict[int, Any] = {}
        self._ready: deque[Any] = deque()
        self._numbers = 0

    def nodes(self) -> Mapping[str, int]:
        """The nodes with processors."""
        found = ((node["NodeID"], int(node["Resources"].get("CPU", 0))) for node in self._ray.nodes() if node["Alive"])
        return {node: processors for node, processors in found if processors >= 1}

    def submit(self, arguments: tuple[Any, ...], node: str) -> int:
        """Begins a task."""
        if node not in self._tasks:
            strategies = import_module("ray.util.scheduling_strategies")
            # Soft: the node may be gone by then.
            chosen = strategies.NodeAffinitySchedulingStrategy(node, soft=True)
            self._tasks[node] = self._task.options(scheduling_strategy=chosen)
        self._numbers += 1
        task = self._tasks[node].remote(self._function, *arguments)
        self._flying[task] = self._numbers
        self._of_number[self._numbers] = task
        return self._numbers

    def wait(self, seconds: float) -> tuple[int, Done[Result]] | None:
        """Waits for a task."""
        if not self._ready:
            if not self._flying:
                time.sleep(seconds)
                return None
            flying = list(self._flying)
            found, _ = self._ray.wait(flying, num_returns=1, timeout=seconds)
            if found:
                # What else has ended, in one question.
                found, _ = self._ray.wait(flying, num_returns=len(flying), timeout=0)
            self._ready.extend(found)
        if not self._ready:
            return None
        ready = self._ready.popleft()
        number = self._flying.pop(ready)
        del self._of_number[number]
        try:
            result, node = self._ray.get(ready)
        except self._errors.RayTaskError as error:
            # In its own type.
            return number, Done(None, "", error.as_instanceof_cause())
        except self._errors.RayError as error:
            return number, Done(None, type(error).__name__)
        return number, Done(result, node)

    def withdraw(self, number: int) -> None:
        """Cancels a task; one that is under way is done to its end."""
        task = self._of_number.get(number)
        if task is not None:
            self._ray.cancel(task, force=False)

    def now(self) -> float:
        """The monotonic clock."""
        return time.monotonic()

    def cancel(self) -> None:
        """Ends what is under way."""
        for flying in self._flying:
            self._ray.cancel(flying, force=True)
