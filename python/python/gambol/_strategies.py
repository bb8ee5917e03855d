"""Strategies by ask and tell on NumPy arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from gambol._build import json_text, seed_of, whole
from gambol._gambol import Search
from gambol._resumable import Resumable, one_for_each


@dataclass(frozen=True)
class Best:
    """The best individual a search has found: of equals the first."""

    #: Its genome, ``float32[dimension]``.
    weights: npt.NDArray[np.float32]
    #: What it was told to be worth.
    fitness: float
    #: The generation it was asked in, from 1.
    generation: int


class Strategy(Resumable):
    """A search for numbers: :meth:`ask` for a generation, evaluate it, :meth:`tell` the results, again and again.

    Fitness is to be **maximised**; NaN is an evaluation that failed, which ranks below every fitness. A search is a function
    of its settings, its seed and what it is told: the same bits on every machine, and those that a run of the program with
    this seed gets. It pickles, also between ask and tell, and goes on from there to the bit.

    Args:
        dimension: how many numbers are searched for, all alike.
        layers: in place of the dimension the layers of a dense net, inputs first, such as ``(7, 10, 4)``: the genome is its
            weights, neuron by neuron, each neuron's bias behind the weights of its inputs. Operators that know of neurons then
            cross whole neurons.
        seed: from 0 to 2⁶⁴ − 1.
        **settings: those of the strategy, as in ``strategy.NAME`` of a configuration; what is left out has its default. See
            docs/strategies.md.

    Raises:
        ValueError: if a setting is unknown or out of range; the message says which, and what is allowed.
    """

    #: The name in configurations.
    name: ClassVar[str] = ""
    _search: Search

    def __init__(
        self,
        dimension: int | None = None,
        *,
        layers: Sequence[int] | None = None,
        seed: int = 1,
        **settings: Any,
    ) -> None:
        """Builds the search; nothing is asked yet."""
        given = {field: value for field, value in settings.items() if value is not None}
        size = None if dimension is None else whole("dimension", dimension, 0, 2**32)
        sizes = None if layers is None else [whole(f"layers[{i}]", width, 0, 2**32) for i, width in enumerate(layers)]
        self._search = Search(self.name, size, sizes, seed_of(seed), json_text(self.name, given))

    def ask(self) -> npt.NDArray[np.float32]:
        """The next generation, ``float32[population, dimension]``. Until it is told, the same again."""
        return self._search.ask()

    def tell(self, fitness: npt.ArrayLike, objectives: npt.ArrayLike | None = None) -> None:
        """The results of the generation last asked, in its order.

        Args:
            fitness: ``float64[population]``, to be maximised; what is not finite is an evaluation that failed.
            objectives: ``float64[population, objectives]``, to be maximised, for strategies that search for several.

        Raises:
            RuntimeError: if no generation waits for its results.
            ValueError: if there is not one result for each individual.
        """
        values = one_for_each(fitness)
        several = None if objectives is None else np.ascontiguousarray(objectives, np.float64)
        if several is not None and several.ndim != 2:
            raise ValueError(f"objectives must be of two dimensions, found {several.ndim}")
        self._search.tell(values, several)

    @property
    def best(self) -> Best | None:
        """The best individual so far; ``None`` while every evaluation has failed."""
        best = self._search.best()
        return None if best is None else Best(*best)

    @property
    def dimension(self) -> int:
        """How many numbers a genome has."""
        return self._search.dimension

    def __setstate__(self, state: bytes) -> None:
        """Goes on from a state."""
        self._search = Search.restore(self.name, state)

    def __repr__(self) -> str:
        """Its kind, its dimension and how far it is."""
        return f"{type(self).__name__}(dimension={self.dimension}, generation={self.generation})"


class CmaEs(Strategy):
    """The evolution strategy with covariance matrix adaptation.

    Settings: ``population`` (4 + ⌊3 ln n⌋), ``step_size`` (0.5), ``covariance`` ("separable" or "full"), ``restart``, ….
    """

    name = "cma-es"


class Conventional(Strategy):
    """Conventional neuroevolution: a genetic algorithm over weights."""

    name = "conventional"


class OpenEs(Strategy):
    """OpenAI's evolution strategy: gradient steps estimated from mirrored perturbations."""

    name = "open-es"


class Cosyne(Strategy):
    """Cooperative synapse neuroevolution: the weights of each place coevolve."""

    name = "cosyne"


@dataclass(frozen=True)
class Front:
    """Compromises: none is worse than another in every objective."""

    #: Their genomes, ``float32[points, dimension]``.
    weights: npt.NDArray[np.float32]
    #: What each came to, ``float64[points, objectives]``, all to be maximised.
    objectives: npt.NDArray[np.float64]


class Nsga2(Strategy):
    """NSGA-II: a front of compromises between several objectives, which :meth:`Strategy.tell` takes."""

    name = "nsga2"

    @property
    def front(self) -> Front:
        """The front of the individuals that are kept; of no points before the first generation is told."""
        points = self._search.front() or []
        several = len(points[0][1]) if points else 0
        weights = np.array([weights for weights, _ in points], np.float32).reshape(len(points), self.dimension)
        return Front(weights, np.array([objectives for _, objectives in points], np.float64).reshape(len(points), several))


class Ars(Strategy):
    """Augmented random search, V1-t: steps along the best of random directions; a baseline."""

    name = "ars"


class HillClimbing(Strategy):
    """Hill climbing: one parent and its noisy copies, the best goes on; a baseline."""

    name = "hill-climbing"


class RandomSearch(Strategy):
    """Random search: every genome is drawn anew, nothing is learnt; a baseline."""

    name = "random-search"
