"""Strategies ask for the genomes that they ask for in Rust: ``gambol-runs/tests/asked.json``, which a test there compares too."""

import json
from pathlib import Path

import numpy as np
import pytest

import gambol

FILE = json.loads((Path(__file__).parents[2] / "gambol-runs" / "tests" / "asked.json").read_text())
KINDS = [
    gambol.Ars,
    gambol.CmaEs,
    gambol.Conventional,
    gambol.Cosyne,
    gambol.HillClimbing,
    gambol.Neat,
    gambol.Nsga2,
    gambol.OpenEs,
    gambol.RandomSearch,
]


def asked_last(search, generations):
    """The last generation, where the fitness of an individual depends on its place alone."""
    for _ in range(generations):
        genomes = search.ask()
        count = len(genomes)
        fitness = np.array([(7 * place + 3) % count for place in range(count)], np.float64)
        if isinstance(search, gambol.Nsga2):
            search.tell(fitness, np.stack([fitness, -fitness], axis=1))
        else:
            search.tell(fitness)
    return genomes


def test_all_strategies_are_compared():
    """Each that the file has."""
    assert sorted(kind.name for kind in KINDS) == sorted(FILE["asked_last"])


@pytest.mark.parametrize("kind", KINDS)
def test_a_strategy_has_the_bits_that_it_has_in_rust(kind):
    """After several generations, every genome."""
    arguments = {"seed": FILE["seed"], "population": FILE["population"]}
    expected = FILE["asked_last"][kind.name]
    if kind is gambol.Neat:
        genomes = asked_last(kind(FILE["layers"][0], FILE["layers"][-1], **arguments), FILE["generations"])
        found = [json.loads(genome.__getstate__()) for genome in genomes]
        assert found == expected
    else:
        genomes = asked_last(kind(layers=FILE["layers"], **arguments), FILE["generations"])
        assert genomes.tobytes() == np.array(expected, np.float32).tobytes()
