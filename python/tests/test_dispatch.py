"""Handing out tasks: on machines that are slow, lose tasks, or compute other bits; and when it is worth it."""

import re

import pytest
from machines import Machines

from gambol.cluster import DifferentBits, _dispatch
from gambol.cluster._plan import Plan


def square(task):
    """What a task does."""
    return task * task


class Squares:
    """Tasks whose result is known."""

    def __init__(self):
        """Nothing is done yet."""
        self.placed = {}

    def name(self, task):
        """Its number."""
        return f"square {task}"

    def arguments(self, task):
        """Its number."""
        return (task,)

    def carry_out(self, task):
        """The square."""
        return square(task)

    def agree(self, one, other):
        """Whether they are equal."""
        return one == other

    def place(self, task, result):
        """Once."""
        assert task not in self.placed
        self.placed[task] = result

    def remove(self, task):
        """It was there."""
        del self.placed[task]


def squares(work, machines, count, check=0.01):
    """Does so many; how long it took on the machines' clock."""
    start = machines.now()
    done = list(_dispatch.Dispatcher(machines, check).do(work, range(count)))
    assert sorted(done) == list(range(count))
    assert work.placed == {task: task * task for task in range(count)}
    return machines.now() - start


@pytest.mark.parametrize("seed", range(20))
def test_every_result_is_placed_once(seed):
    """On slow machines, and on those that lose a third of all."""
    work = Squares()
    machines = Machines(square, names=tuple("abcde"), lose=0.3, slow="c", seed=seed)
    dispatcher = _dispatch.Dispatcher(machines, 0.05)
    # Several in a row, since a slow machine is then still at the one before.
    for first in (0, 100, 200):
        assert sorted(dispatcher.do(work, range(first, first + 100))) == list(range(first, first + 100))
    assert work.placed == {task: task * task for task in range(300)}


def test_a_slow_machine_delays_little():
    """What it has not done is done by others."""
    seconds = {
        slow: squares(work, Machines(square, names=tuple("abcdefgh"), slow=slow), 400) for slow in (None, "c") if (work := Squares())
    }
    assert seconds["c"] < 1.5 * seconds[None] + 5, seconds


def test_a_machine_with_other_bits_is_found_by_its_first_task():
    """Nothing of it is kept."""
    work = Squares()
    machines = Machines(square, names=tuple("abcd"), wrong="b", spoil=lambda result: result + 1)
    with pytest.raises(DifferentBits, match=r"the machine b computes other bits than others \(square \d+\)"):
        squares(work, machines, 400)
    assert all(result == task * task for task, result in work.placed.items())


def test_a_machine_that_comes_later_is_used_and_one_that_goes_is_not_missed():
    """While the tasks are done."""
    work = Squares()
    machines = Machines(square, names=("a", "b"))
    dispatcher = _dispatch.Dispatcher(machines, 0.01)
    done_on = []
    for place, task in enumerate(dispatcher.do(work, range(100))):
        done_on.append(task)
        if place == 20:
            machines.names = ("b", "c")
    assert sorted(done_on) == list(range(100))
    assert machines.tasks_of["c"] > 20
    assert machines.tasks_of["a"] < 30


def test_one_machine_is_enough():
    """Though it is no witness of itself."""
    work = Squares()
    squares(work, Machines(square, names=("a",)), 30, check=1.0)


def test_the_plan_says_what_is_worth_a_cluster():
    """In a sentence, by its model."""
    small = Plan(individuals=64, each=100e-6, processors=8, here=2, overhead=1e-3)
    assert not small.worth
    assert re.fullmatch(
        r"64 individuals take 3\.2 ms here, [\d.]+ ms on 8 processors: not worth a cluster; [\d,]+ are", str(small)
    )
    least = small.least()
    assert least is not None and least > 64
    large = Plan(individuals=least, each=100e-6, processors=8, here=2, overhead=1e-3)
    assert large.worth and large.piece % 16 == 0
    assert f"worth a cluster, in pieces of {large.piece:,}" in str(large)
    never = Plan(individuals=100_000, each=1e-3, processors=2, here=2, overhead=1e-3)
    assert str(never).endswith("not worth a cluster; no population is")
    assert str(Plan(1, 1e-3, 1, 1, 1e-3)).startswith("1 individual take")


@pytest.mark.parametrize("individuals", [1, 15, 16, 17, 1000, 100_000])
@pytest.mark.parametrize("processors", [1, 3, 1000])
@pytest.mark.parametrize("each", [1e-6, 1e-3, 1.0])
def test_pieces_cover_a_population(individuals, processors, each):
    """None is empty."""
    plan = Plan(individuals, each, processors, 2, 1e-4)
    assert 1 <= plan.piece <= individuals
    assert plan.remote > 0
