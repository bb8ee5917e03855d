"""The evaluations of a run on a cluster."""

from __future__ import annotations

import functools
import logging
import math
import os
import threading
import time
from dataclasses import replace
from types import TracebackType
from typing import Any

from gambol._gambol import Batch, BatchEvaluator
from gambol.cluster._dispatch import Dispatcher
from gambol.cluster._plan import LANES, Plan
from gambol.cluster._ray import RayWorkers
from gambol.cluster._work import Workers

_log = logging.getLogger("gambol.cluster")

#: The share of pieces that is done on two machines and compared.
CHECK = 0.01

#: Generations after which it is measured again what an individual takes: creatures that learn live longer.
MEASURE = 20

#: Individuals that are measured.
SAMPLE = 4 * LANES


@functools.lru_cache(maxsize=4)
def _evaluator(config: str) -> BatchEvaluator:
    return BatchEvaluator(config)


def evaluate(config: str, piece: bytes) -> bytes:
    """The evaluations of a piece: the same bytes wherever and however often it is done."""
    return _evaluator(config).evaluate(piece)


class Pieces:
    """A generation as work, or those of it that have come to a rung."""

    def __init__(self, config: str, batch: Batch, size: int) -> None:
        """``size``: individuals of a piece."""
        self._config, self._batch, self._size = config, batch, size
        self.results: list[bytes] = [b""] * math.ceil(len(batch) / size)

    def name(self, task: int) -> str:
        """Which individuals."""
        start = task * self._size
        return f"individuals {start + 1} to {min(start + self._size, len(self._batch))} of a generation"

    def arguments(self, task: int) -> tuple[Any, ...]:
        """Those of :func:`evaluate`."""
        start = task * self._size
        return self._config, self._batch.piece(start, min(start + self._size, len(self._batch)))

    def carry_out(self, task: int) -> bytes:
        """Evaluates a piece here."""
        return evaluate(*self.arguments(task))

    def agree(self, one: bytes, other: bytes) -> bool:
        """Whether they are the same bytes."""
        return one == other

    def place(self, task: int, result: bytes) -> None:
        """Puts it in its place."""
        self.results[task] = result

    def remove(self, task: int) -> None:
        """The generation ends without it."""
        self.results[task] = b""


class Cluster:
    """Workers that several runs share. Leaving its context ends what is under way."""

    def __init__(self, workers: Workers[bytes], overhead: float | None = None) -> None:
        """``workers``: do :func:`evaluate`; ``overhead``: seconds that handing out a task takes, else it is measured."""
        self.workers = workers
        self.dispatcher = Dispatcher(workers, CHECK)
        self._overhead = overhead
        self._measuring = threading.Lock()

    def __enter__(self) -> Cluster:
        """Itself."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Ends what is under way."""
        self.workers.cancel()

    def processors(self) -> int:
        """How many there are, from 1."""
        return max(1, sum(self.workers.nodes().values()))

    def overhead(self, config: str, batch: Batch) -> float:
        """Seconds that handing out a task takes. Nothing is handed out before it is known."""
        with self._measuring:
            if self._overhead is None:
                # The second time every worker has begun.
                self._overhead = min(self._handing_out((config, batch.piece(0, 0))) for _ in range(2))
            return self._overhead

    def _handing_out(self, nothing: tuple[str, bytes]) -> float:
        start = self.workers.now()
        nodes = self.workers.nodes()
        tasks = [self.workers.submit(nothing, node) for node, processors in nodes.items() for _ in range(2 * processors)]
        for _ in tasks:
            while self.workers.wait(1.0) is None:
                pass
        return (self.workers.now() - start) / max(1, len(tasks))


class Populations:
    """Evaluates the batches of a run on a cluster, if that is worth it."""

    def __init__(self, cluster: Cluster, plan: Plan | None = None) -> None:
        """``plan``: what is known before, else it is measured."""
        self._cluster = cluster
        self._plan = plan
        self._measures = plan is None
        self._said: bool | None = None
        self._batches = 0

    def __call__(self, config: str, batch: Batch) -> list[bytes] | None:
        """The evaluations of the batch, piece by piece; ``None`` if the cluster is not worth it."""
        plan = self._planned(config, batch)
        if plan.worth is not self._said:
            self._said = plan.worth
            _log.warning("%s", plan)
        if not plan.worth:
            return None
        pieces = Pieces(config, batch, plan.piece)
        for _ in self._cluster.dispatcher.do(pieces, range(len(pieces.results))):
            pass
        return pieces.results

    def _planned(self, config: str, batch: Batch) -> Plan:
        if self._plan is None or (self._measures and self._batches % MEASURE == 0):
            self._plan = self._measured(config, batch)
        self._batches += 1
        return replace(self._plan, individuals=len(batch))

    def _measured(self, config: str, batch: Batch) -> Plan:
        overhead = self._cluster.overhead(config, batch)
        sample = min(SAMPLE, len(batch))
        _evaluator(config)
        start = time.perf_counter()
        piece = batch.piece(0, sample)
        sent = time.perf_counter()
        evaluate(config, piece)
        each = (time.perf_counter() - sent) / sample
        sending = (sent - start) / sample
        return Plan(len(batch), each, self._cluster.processors(), os.cpu_count() or 1, overhead, sending)


def on_ray(ray: Any) -> Cluster:
    """A Ray cluster; ``ray`` is the module, which is initialised if it is not yet."""
    workers: RayWorkers[bytes] = RayWorkers(ray, evaluate)
    return Cluster(workers)
