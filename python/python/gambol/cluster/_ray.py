"""Ray as workers."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from gambol.cluster._dispatch import Done
from gambol.cluster._experiments import Recipe, carry_out


def _on_node(of: Recipe, digest: str, run: int) -> tuple[str, str]:
    """A run, and the machine it was done on."""
    ray = import_module("ray")
    return carry_out(of, digest, run), ray.get_runtime_context().get_node_id()


class RayWorkers:
    """The nodes of a Ray cluster; ``ray`` is the module, which is initialised if it is not yet."""

    def __init__(self, ray: Any, of: Recipe, digest: str) -> None:
        """Connects to the cluster."""
        self._ray = ray
        if not ray.is_initialized():
            ray.init()
        # A task that is repeated does no harm: Ray does so itself when a worker or a node dies.
        self._task = ray.remote(num_cpus=1, max_retries=-1)(_on_node)
        self._of, self._digest = of, digest
        self._flying: dict[Any, int] = {}
        self._numbers = 0

    def _alive(self) -> list[str]:
        return [node["NodeID"] for node in self._ray.nodes() if node["Alive"] and node["Resources"].get("CPU", 0) >= 1]

    def submit(self, run: int, avoid: str | None) -> int:
        """Begins a run."""
        chosen: Any = "SPREAD"
        others = [node for node in self._alive() if node != avoid] if avoid else []
        if others:
            strategies = import_module("ray.util.scheduling_strategies")
            # Soft: the node may be gone by then.
            chosen = strategies.NodeAffinitySchedulingStrategy(others[run % len(others)], soft=True)
        self._numbers += 1
        task = self._task.options(scheduling_strategy=chosen)
        self._flying[task.remote(self._of, self._digest, run)] = self._numbers
        return self._numbers

    def wait(self) -> tuple[int, Done]:
        """Waits for a run."""
        errors = import_module("ray.exceptions")
        [ready], _ = self._ray.wait(list(self._flying), num_returns=1)
        number = self._flying.pop(ready)
        try:
            text, node = self._ray.get(ready)
        except errors.RayTaskError as error:
            # What the run itself raises, in its own type.
            raise error.as_instanceof_cause() from None
        except errors.RayError as error:
            return number, Done(None, type(error).__name__)
        return number, Done(text, node)

    def count(self) -> int:
        """The processors of the cluster."""
        return int(self._ray.cluster_resources().get("CPU", 1))

    def nodes(self) -> int:
        """The machines of the cluster."""
        return len(self._alive())

    def cancel(self) -> None:
        """Ends what is under way."""
        for flying in self._flying:
            self._ray.cancel(flying, force=True)
