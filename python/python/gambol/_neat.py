"""NEAT by ask and tell: genomes are nets of any graph."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from gambol._build import json_text, seed_of, whole
from gambol._champion import Controller
from gambol._drawn_net import drawn
from gambol._gambol import Genes, NeatSearch
from gambol._resumable import Resumable, one_for_each


class NodeGene(NamedTuple):
    """The gene of a neuron. Inputs and the bias node have none."""

    #: Its number, the same in all genomes of a search.
    id: int
    #: Its activation, such as ``"tanh"``.
    activation: str
    #: Its bias; 0 and without effect unless the setting ``bias`` is ``"per-neuron"``.
    bias: float


class ConnectionGene(NamedTuple):
    """The gene of a connection."""

    #: The number of the invention it comes from.
    innovation: int
    #: The node it comes from: first the inputs, from 0, then the bias node if there is one, then the outputs.
    source: int
    #: The neuron it leads to.
    target: int
    #: Its weight.
    weight: float
    #: Whether it is expressed.
    enabled: bool


class NeatGenome:
    """A genome: genes of neurons and connections. It does not change, pickles, and is equal to one of the same genes."""

    def __init__(self, genes: Genes) -> None:
        """Wraps the native genome."""
        self._genes = genes
        #: How many inputs and outputs its net has.
        self.inputs, self.outputs, self._sources = genes.layout()

    @property
    def nodes(self) -> list[NodeGene]:
        """The genes of its neurons, outputs first, in order of their numbers."""
        return [NodeGene(*gene) for gene in self._genes.nodes()]

    @property
    def connections(self) -> list[ConnectionGene]:
        """The genes of its connections, in order of their innovation numbers."""
        return [ConnectionGene(*gene) for gene in self._genes.connections()]

    def activate(self, observations: npt.ArrayLike) -> npt.NDArray[np.float32]:
        """The outputs ``float32[outputs]`` for ``float32[inputs]``; ``[n, outputs]`` for ``[n, inputs]``, by a net that begins anew.

        To step a recurrent net, keep one :meth:`controller`.
        """
        return self.controller()(observations)

    def controller(self) -> Controller:
        """Its net, which remembers if it is recurrent."""
        return Controller(self._genes.net())

    def to_dot(self, inputs: Sequence[str] = (), outputs: Sequence[str] = ()) -> str:
        """The genome in the language of Graphviz, with these names for inputs and outputs."""
        return self._genes.dot(list(inputs), list(outputs))

    def __eq__(self, other: object) -> bool:
        """Whether all genes are the same."""
        return isinstance(other, NeatGenome) and self._genes == other._genes

    def __hash__(self) -> int:
        """By its genes."""
        return hash(self._genes.text())

    def __getstate__(self) -> str:
        """Its genes, as JSON."""
        return self._genes.text()

    def __setstate__(self, state: str) -> None:
        """The same genome."""
        NeatGenome.__init__(self, Genes.of_text(state))

    def __repr__(self) -> str:
        """Its size."""
        expressed = sum(gene.enabled for gene in self.connections)
        hidden = len(self.nodes) - self.outputs
        return f"NeatGenome(inputs={self.inputs}, outputs={self.outputs}, hidden={hidden}, connections={expressed})"

    def _repr_svg_(self) -> str:
        """A drawing of its net, for notebooks: inputs on the left, orange for positive weights, blue for negative ones."""
        edges = [(gene.source, gene.target, gene.weight) for gene in self.connections if gene.enabled]
        outputs = range(self._sources, self._sources + self.outputs)
        return drawn(range(self._sources), outputs, [node.id for node in self.nodes], edges)


@dataclass(frozen=True)
class Species:
    """A species of the generation last told."""

    #: Its number: species are numbered as they begin, from 1.
    id: int
    #: How many individuals it has.
    size: int
    #: The best fitness among them; ``None`` if every evaluation failed.
    best: float | None


@dataclass(frozen=True)
class BestGenome:
    """The best individual a search has found: of equals the first."""

    #: Its genome.
    genome: NeatGenome
    #: What it was told to be worth.
    fitness: float
    #: The generation it was asked in, from 1.
    generation: int


class Neat(Resumable):
    """NeuroEvolution of Augmenting Topologies: nets whose neurons and connections evolve with their weights.

    :meth:`ask` for a generation, evaluate it, :meth:`tell` the fitnesses. Fitness is to be **maximised**; NaN is an evaluation
    that failed. A search is a function of its settings, its seed and what it is told: the same bits on every machine, and those
    that a run of the program with this seed gets. It pickles, also between ask and tell, and goes on from there to the bit.

    Args:
        inputs: of the net, from 1 to 4,096.
        outputs: of the net, from 1 to 4,096.
        seed: from 0 to 2⁶⁴ − 1.
        **settings: as in ``strategy.neat`` of a configuration, such as ``population=150``, ``recurrent=True`` or
            ``speciation={"threshold": 3.0}``; what is left out has its default. See docs/strategies.md.

    Raises:
        ValueError: if a setting is unknown or out of range; the message says which, and what is allowed.
    """

    name = "neat"
    _search: NeatSearch

    def __init__(self, inputs: int, outputs: int, *, seed: int = 1, **settings: Any) -> None:
        """Builds the search; nothing is asked yet."""
        given = {field: value for field, value in settings.items() if value is not None}
        sizes = whole("inputs", inputs, 0, 2**32), whole("outputs", outputs, 0, 2**32)
        self._search = NeatSearch(*sizes, seed_of(seed), json_text(self.name, given))

    def ask(self) -> list[NeatGenome]:
        """The next generation. Until it is told, the same again."""
        return [NeatGenome(genes) for genes in self._search.ask()]

    def tell(self, fitness: npt.ArrayLike) -> None:
        """The fitnesses ``float64[population]`` of the generation last asked, in its order; NaN for an evaluation that failed.

        Raises:
            RuntimeError: if no generation waits for its results.
            ValueError: if there is not one fitness for each individual.
        """
        self._search.tell(one_for_each(fitness))

    @property
    def best(self) -> BestGenome | None:
        """The best individual so far; ``None`` while every evaluation has failed."""
        best = self._search.best()
        return None if best is None else BestGenome(NeatGenome(best[0]), best[1], best[2])

    @property
    def species(self) -> list[Species]:
        """The species of the generation last told, in order of their numbers."""
        return [Species(*species) for species in self._search.species()]

    @property
    def memberships(self) -> npt.NDArray[np.uint64]:
        """The number of the species of each individual of the generation last told, ``uint64[population]``."""
        return np.array(self._search.memberships(), np.uint64)

    def __setstate__(self, state: bytes) -> None:
        """Goes on from a state."""
        self._search = NeatSearch.restore(state)

    def __repr__(self) -> str:
        """How far it is."""
        return f"Neat(generation={self.generation}, species={len(self.species)})"
