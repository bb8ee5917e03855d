"""Machines for tests of handing out, on a clock of their own."""

import heapq
import random
from collections import Counter

from gambol.cluster import _work


class Machines:
    """Machines in this process, on a clock of their own: some lose tasks, are slow, or compute other bits."""

    def __init__(self, function, names=("a", "b", "c"), lose=0.0, wrong=None, wrong_from=0, spoil=None, slow=None, seed=7):
        """``function``: what a task does; ``lose``: the share of tasks that is lost; ``wrong``: the machine whose results
        ``spoil`` changes from its task ``wrong_from`` on; ``slow``: the machine that takes a hundred times as long as others."""
        self.function = function
        self.names = names
        self.lose = lose
        self.wrong, self.wrong_from, self.spoil, self.slow = wrong, wrong_from, spoil, slow
        self.random = random.Random(seed)
        self.clock = 0.0
        self.flying = []
        self.submitted = 0
        #: How many each machine was handed.
        self.tasks_of = Counter()
        self.done = 0

    def nodes(self):
        """Each does one at a time."""
        return dict.fromkeys(self.names, 1)

    def now(self):
        """The clock."""
        return self.clock

    def submit(self, arguments, node):
        """In some order."""
        self.submitted += 1
        self.tasks_of[node] += 1
        takes = self.random.uniform(0.5, 1.5) * (100 if node == self.slow else 1)
        heapq.heappush(self.flying, (self.clock + takes, self.submitted, arguments, node))
        return self.submitted

    def wait(self, seconds):
        """Does the next task, or loses it."""
        if not self.flying or self.flying[0][0] > self.clock + seconds:
            self.clock += seconds
            return None
        self.clock, number, arguments, node = heapq.heappop(self.flying)
        if self.random.random() < self.lose:
            return number, _work.Done(None, "lost")
        result = self.function(*arguments)
        if node == self.wrong:
            self.done += 1
            if self.done > self.wrong_from:
                result = self.spoil(result)
        return number, _work.Done(result, node)

    def withdraw(self, number):
        """All that was handed out is done."""

    def cancel(self):
        """Nothing is under way any more."""
        self.flying.clear()
