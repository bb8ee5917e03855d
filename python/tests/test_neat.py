"""NEAT by ask and tell."""

import copy
import pickle
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

import gambol

CASES = np.array([(-1, -1), (-1, 1), (1, -1), (1, 1)], np.float32)
#: Exclusive or.
ANSWERS = -CASES[:, 0] * CASES[:, 1]


def exclusive_or(genome):
    """At most 16."""
    return 16.0 - float(np.sum((genome.activate(CASES)[:, 0] - ANSWERS) ** 2))


def solve(seed, generations=150):
    """A search until it has solved it."""
    search = gambol.Neat(2, 1, seed=seed)
    for _ in range(generations):
        search.tell([exclusive_or(genome) for genome in search.ask()])
        if search.best.fitness > 15.5:
            break
    return search


@pytest.fixture(scope="module")
def solved():
    """A search that has solved it."""
    return solve(1)


@pytest.mark.parametrize("seed", range(1, 11))
def test_exclusive_or_is_solved(seed):
    """By nets that have grown."""
    search = solve(seed)
    best = search.best
    assert best.fitness > 15.5
    assert len(best.genome.nodes) > 1, "hidden neurons"
    assert np.array_equal(np.sign(best.genome.activate(CASES)[:, 0]), ANSWERS)
    assert best.generation == search.generation


def test_a_search_goes_on_to_the_bit_wherever_it_was_pickled():
    """Between ask and tell, and between two generations."""

    def on(search, generations):
        for _ in range(generations):
            search.tell([exclusive_or(genome) for genome in search.ask()])
        return search.ask()

    one, other = gambol.Neat(2, 1, seed=3, population=40), gambol.Neat(2, 1, seed=3, population=40)
    one.ask()
    one = pickle.loads(pickle.dumps(one))
    assert on(one, 5) == on(other, 5)
    one = copy.deepcopy(one)
    assert on(one, 5) == on(other, 5)
    assert one.statistics == other.statistics and one.species == other.species
    assert one.best == other.best and one.generation == 10
    assert gambol.Neat(2, 1, seed=4).ask() != gambol.Neat(2, 1, seed=3).ask()


def test_species_have_members(solved):
    """Each individual is of one."""
    sizes = {species.id: species.size for species in solved.species}
    numbers, counts = np.unique(solved.memberships, return_counts=True)
    assert sizes == dict(zip(numbers.tolist(), counts.tolist(), strict=True))
    assert max(species.best for species in solved.species) == solved.best.fitness
    assert solved.statistics["species"] == len(sizes)


def test_genes_are_those_of_the_net(solved):
    """Connections lead from nodes to neurons."""
    genome = solved.best.genome
    neurons = [node.id for node in genome.nodes]
    innovations = [gene.innovation for gene in genome.connections]
    assert innovations == sorted(set(innovations))
    assert all(gene.target in neurons for gene in genome.connections)
    assert repr(genome).startswith("NeatGenome(inputs=2, outputs=1, hidden=")
    assert "digraph" in genome.to_dot(["a", "b"], ["either"]) and "either" in genome.to_dot(["a", "b"], ["either"])
    again = pickle.loads(pickle.dumps(genome))
    assert again == genome and hash(again) == hash(genome)


def test_a_drawing_has_every_node_and_connection(solved):
    """As an SVG image."""
    genome = solved.best.genome
    image = ElementTree.fromstring(genome._repr_svg_())
    tags = [child.tag.rpartition("}")[2] for child in image]
    assert tags.count("path") == sum(gene.enabled for gene in genome.connections)
    assert tags.count("circle") == genome.inputs + len(genome.nodes)


def test_a_recurrent_net_is_drawn_and_remembers():
    """Until it is reset."""
    search = gambol.Neat(1, 1, seed=2, population=60, recurrent=True)
    for _ in range(15):
        search.tell([float(len(genome.connections)) for genome in search.ask()])
    ElementTree.fromstring(search.best.genome._repr_svg_())
    remembering = 0
    for genome in search.ask():
        controller = genome.controller()
        first, second = controller([1.0]), controller([1.0])
        remembering += not np.array_equal(first, second)
        controller.reset()
        assert np.array_equal(controller([1.0]), first)
    assert remembering > 0


def test_errors_name_what_is_wrong():
    """In the library's words."""
    search = gambol.Neat(2, 1, population=10)
    with pytest.raises(RuntimeError, match="ask before tell"):
        search.tell([0.0] * 10)
    search.ask()
    with pytest.raises(ValueError, match="fitness must be of length 10, found 3"):
        search.tell([0.0] * 3)
    with pytest.raises(ValueError, match="fitness must be of one dimension, found 2"):
        search.tell([[0.0] * 10])
    with pytest.raises(ValueError, match="population"):
        gambol.Neat(2, 1, population=0)
    with pytest.raises(ValueError, match="inputs"):
        gambol.Neat(0, 1)
    with pytest.raises(ValueError, match="speed"):
        gambol.Neat(2, 1, speed=3)
    search.tell([float("nan")] * 10)
    assert search.best is None
