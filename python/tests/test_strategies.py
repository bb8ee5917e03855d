"""Strategies by ask and tell."""

import copy
import hashlib
import pickle

import numpy as np
import pytest

import gambol

ALL = [
    gambol.Ars,
    gambol.CmaEs,
    gambol.Conventional,
    gambol.Cosyne,
    gambol.HillClimbing,
    gambol.Nsga2,
    gambol.OpenEs,
    gambol.RandomSearch,
]


def fitness(genomes):
    """The higher the nearer to 0.3, with no two alike."""
    return -np.sum((genomes.astype(np.float64) - 0.3) ** 2, axis=1)


def run(search, generations):
    digest = hashlib.sha256()
    for _ in range(generations):
        genomes = search.ask()
        digest.update(genomes.tobytes())
        search.tell(fitness(genomes))
    return digest.hexdigest()


@pytest.mark.parametrize("kind", ALL)
@pytest.mark.parametrize("shape", [{"dimension": 12}, {"layers": (3, 4, 2)}])
def test_a_search_goes_on_to_the_bit_wherever_it_was_pickled(kind, shape):
    search, other = kind(seed=3, **shape), kind(seed=3, **shape)
    genomes = search.ask()
    assert genomes.dtype == np.float32 and genomes.shape == (len(genomes), search.dimension)
    assert genomes.tobytes() == search.ask().tobytes() == other.ask().tobytes()
    # Between ask and tell.
    search = pickle.loads(pickle.dumps(search))
    assert genomes.tobytes() == search.ask().tobytes()
    assert run(search, 5) == run(other, 5)
    # Between two generations.
    search = copy.deepcopy(search)
    assert run(search, 5) == run(other, 5)
    assert search.generation == 10 and search.statistics == other.statistics
    assert search.best.fitness == other.best.fitness
    assert search.best.fitness == fitness(search.best.weights[None])[0]
    assert kind(seed=4, **shape).ask().tobytes() != kind(seed=3, **shape).ask().tobytes()


@pytest.mark.parametrize("kind", [gambol.CmaEs, gambol.OpenEs, gambol.Conventional, gambol.Ars])
def test_they_find_what_they_search(kind):
    search = kind(8, seed=1)
    first = fitness(search.ask()).max()
    run(search, 200)
    assert search.best.fitness > 0.2 * first


def test_cma_es_finds_it_exactly():
    search = gambol.CmaEs(20, seed=1, population=20, step_size=0.5)
    assert search.ask().shape == (20, 20)
    run(search, 400)
    assert search.best.fitness > -1e-6
    assert search.statistics["population"] == 20.0


def test_several_objectives():
    search = gambol.Nsga2(4, seed=1)
    for _ in range(5):
        genomes = search.ask()
        search.tell(fitness(genomes), np.stack([genomes[:, 0], -genomes[:, 0]], axis=1))
    with pytest.raises(ValueError, match="rows"):
        search.ask()
        search.tell(fitness(genomes), np.zeros((1, 2)))


def test_failures_rank_below_every_fitness():
    search = gambol.CmaEs(3, seed=1)
    count = len(search.ask())
    search.tell(np.full(count, np.nan))
    assert search.best is None
    genomes = search.ask()
    values = np.full(count, np.nan)
    values[2] = -1e9
    search.tell(values)
    assert search.best.fitness == -1e9 and search.best.generation == 2
    assert (search.best.weights == genomes[2]).all()


def test_any_dimension():
    for dimension in (1, 2, 4097):
        assert gambol.CmaEs(dimension, seed=1).ask().shape[1] == dimension


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: gambol.CmaEs(3, population=1), "population = 1"),
        (lambda: gambol.CmaEs(3, step_sise=1), "step_size"),
        (lambda: gambol.CmaEs(0), "dimension = 0"),
        (lambda: gambol.CmaEs(), "either"),
        (lambda: gambol.CmaEs(layers=(3,)), "layers"),
        (lambda: gambol.CmaEs(layers=(3, 0, 1)), r"layers.hidden\[0\] = 0"),
        (lambda: gambol.CmaEs(5000, covariance="full"), "separable"),
    ],
)
def test_what_is_wrong_is_said(make, message):
    with pytest.raises(ValueError, match=message):
        make()


def test_ask_and_tell_take_turns():
    search = gambol.CmaEs(3)
    with pytest.raises(RuntimeError, match="ask before tell"):
        search.tell([1.0])
    search.ask()
    with pytest.raises(ValueError, match="length"):
        search.tell([1.0])


def test_a_front_is_of_compromises():
    """None is worse than another in both objectives."""
    search = gambol.Nsga2(6, seed=2, population=40)
    assert search.front.weights.shape == (0, 6)
    for _ in range(30):
        genomes = search.ask().astype(np.float64)
        objectives = np.stack([-np.sum((genomes - 0.5) ** 2, axis=1), -np.sum((genomes + 0.5) ** 2, axis=1)], axis=1)
        search.tell(objectives.sum(axis=1), objectives)
    front = search.front
    assert front.weights.dtype == np.float32 and front.objectives.shape == (len(front.weights), 2) and len(front.weights) > 5
    for one in front.objectives:
        assert not np.any(np.all(front.objectives > one, axis=1))
    again = -np.sum((front.weights.astype(np.float64) - 0.5) ** 2, axis=1)
    assert np.array_equal(again, front.objectives[:, 0])


def test_objectives_stay_as_many():
    """From the first generation told on, also after pickling."""
    search = gambol.Nsga2(3, population=8)
    search.ask()
    search.tell(np.arange(8.0), np.zeros((8, 2)))
    search = pickle.loads(pickle.dumps(search))
    search.ask()
    with pytest.raises(ValueError, match="objectives must have 2 columns as before, found 3"):
        search.tell(np.arange(8.0), np.zeros((8, 3)))
    with pytest.raises(ValueError, match="objectives must have 2 columns as before, found none"):
        search.tell(np.arange(8.0))
    search.tell(np.arange(8.0), np.zeros((8, 2)))


def test_a_setting_within_a_setting_leaves_the_others():
    """As in a configuration."""
    neat = gambol.Neat(2, 1, speciation={"threshold": 0.5}, population=30)
    neat.tell(np.arange(float(len(neat.ask()))))
    neat.ask()
    assert neat.statistics["compatibility_threshold"] < 3.0
    with pytest.raises(ValueError, match=r"strategy\.neat\.speciation\.limit: unknown field `limit`"):
        gambol.Neat(2, 1, speciation={"limit": 0.5})


@pytest.mark.parametrize("search", [gambol.CmaEs(3, seed=1), gambol.Neat(2, 1, seed=1)])
def test_a_state_of_another_size_is_no_search(search):
    """Of a generation that waits for its results there is one more than it says."""
    count = len(search.ask())
    state = search.__getstate__().replace(f'"asked":{count}'.encode(), f'"asked":{count + 1}'.encode())
    assert state != search.__getstate__()
    with pytest.raises(ValueError, match="the generation that waits for its results is not of the size that is said"):
        object.__new__(type(search)).__setstate__(state)
