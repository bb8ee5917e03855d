"""How busy a thousand workers are with a run of 100,000 individuals: the dispatcher of gambol.cluster on simulated machines.

The dispatcher and the plan are those that hand out work on Ray; only the machines are made up. docs/scale.md has the model.

python benchmarks/simulated_cluster.py [--workers 1000] [--population 100000] [--generations 10] [--runs 1 4] [--each 10]
"""

import argparse
import heapq
import random
from collections import deque

from gambol.cluster._dispatch import Dispatcher
from gambol.cluster._plan import Plan
from gambol.cluster._work import Done

#: Seconds that the head needs for a task: 9,607 tasks a second (Ray 2.8.0, release logs, single_client_tasks_async).
HANDING = 1 / 9_607

#: Seconds that a task is on its way, there and back: 1,200 tasks a second, one after the other (the same, single_client_tasks_sync).
ROUND_TRIP = 1 / 1_200

#: Seconds that sending an individual takes: 1.1 kB over 10 Gbit/s, and 2 µs to write it.
SENDING = 1_100 * 8 / 10e9 + 2e-6

#: The share of tasks that take longer than others, and how much (Ananthanarayanan et al., OSDI 2010, section 3: of the outliers
#: 80 % take 1.5 to 2.5 times the median, 10 % more than 10 times).
OUTLIERS = 0.1
HOW_MUCH = [(0.8, 1.5, 2.5), (0.1, 2.5, 10.0), (0.1, 10.0, 20.0)]

#: Deaths of a worker, each second: 1.2 in a job of 157 workers and 634 s (Dean and Ghemawat, OSDI 2004, table 1).
DEATHS = 1.2 / (157 * 634)

#: Seconds until another takes its place.
REPLACED = 30.0


class Machine:
    """A machine of one processor: the task it does, since when, and those that wait."""

    def __init__(self):
        """It does nothing."""
        self.task, self.since = None, 0.0
        self.waiting = deque()


class SimulatedWorkers:
    """Machines on a clock of their own. Equal seeds give equal delays and deaths."""

    def __init__(self, count, seed):
        """So many."""
        self.random = random.Random(seed)
        self.clock = 0.0
        self.numbers = 0
        #: What happens: when, in which order, what, and what about.
        self.events = []
        self.machines = {}
        self.withdrawn = set()
        #: Seconds in which machines worked on tasks, and on those of them whose results were used.
        self.busy = self.used = 0.0
        self.deaths = 0
        for index in range(count):
            self._begins_to_live(f"machine-{index}")

    def nodes(self):
        """All that live."""
        return dict.fromkeys(self.machines, 1)

    def now(self):
        """The clock of the head."""
        return self.clock

    def submit(self, arguments, node):
        """The head is busy with it for a while; then it is on its way."""
        name, takes, sending = arguments
        self.clock += HANDING + sending
        self.numbers += 1
        number = self.numbers
        self._later(ROUND_TRIP / 2, self._arrives, (number, name, takes * self._slower()), node)
        return number

    def wait(self, seconds):
        """Until the next task has ended."""
        until = self.clock + seconds
        while self.events and self.events[0][0] <= until:
            at, _, happens, about = heapq.heappop(self.events)
            # The head may have been busy when it happened.
            self.at, self.clock = at, max(self.clock, at)
            if (told := happens(*about)) is not None:
                return told
        self.clock = max(self.clock, until)
        return None

    def withdraw(self, number):
        """It is told to the machine."""
        self.withdrawn.add(number)

    def cancel(self):
        """Nothing is cancelled."""

    def _later(self, seconds, happens, *about, since=None):
        self.numbers += 1
        heapq.heappush(self.events, ((self.clock if since is None else since) + seconds, self.numbers, happens, about))

    def _slower(self):
        share = self.random.random() / OUTLIERS
        for part, least, most in HOW_MUCH:
            if share < part:
                return self.random.uniform(least, most)
            share -= part
        return 1.0

    def _begins_to_live(self, node):
        self.machines[node] = Machine()
        self._later(self.random.expovariate(DEATHS), self._dies, node, since=getattr(self, "at", 0.0))

    def _dies(self, node):
        self.deaths += 1
        machine = self.machines.pop(node)
        if machine.task is not None:
            self.busy += self.at - machine.since
            machine.waiting.appendleft(machine.task)
        for number, _, _ in machine.waiting:
            self._later(ROUND_TRIP / 2, self._is_told, number, Done(None, "died"), since=self.at)
        self._later(REPLACED, self._begins_to_live, f"{node}+", since=self.at)

    def _arrives(self, task, node):
        if node not in self.machines:
            # As Ray's soft affinity has it.
            node = self.random.choice(list(self.machines))
        self.machines[node].waiting.append(task)
        self._begins_next(node)

    def _begins_next(self, node):
        machine = self.machines[node]
        while machine.task is None and machine.waiting:
            task = machine.waiting.popleft()
            if task[0] in self.withdrawn:
                self._later(ROUND_TRIP / 2, self._is_told, task[0], Done(None, "withdrawn"), since=self.at)
            else:
                machine.task, machine.since = task, self.at
                self._later(task[2], self._ends, task[0], node, since=self.at)

    def _ends(self, number, node):
        machine = self.machines.get(node)
        if machine is None or machine.task is None or machine.task[0] != number:
            return
        self.busy += self.at - machine.since
        if number not in self.withdrawn:
            self.used += self.at - machine.since
        result = Done(machine.task[1], node)
        machine.task = None
        self._later(ROUND_TRIP / 2, self._is_told, number, result, since=self.at)
        self._begins_next(node)

    def _is_told(self, number, done):
        self.withdrawn.discard(number)
        return number, done


class Generation:
    """A generation in pieces; the result of a piece is its number."""

    def __init__(self, plan):
        """As it is planned."""
        self.piece, self.each = plan.piece, plan.each
        self.sizes = [min(plan.piece, plan.individuals - start) for start in range(0, plan.individuals, plan.piece)]

    def name(self, task):
        """Its number."""
        return f"piece {task}"

    def arguments(self, task):
        """Its number, how long it takes, and how long it takes to send."""
        return task, self.sizes[task] * self.each, self.sizes[task] * SENDING

    def carry_out(self, task):
        """Its number."""
        return task

    def agree(self, one, other):
        """Whether they are the same."""
        return one == other

    def place(self, task, result):
        """Nothing is kept."""

    def remove(self, task):
        """Nothing was kept."""


def simulate(workers_count, population, each, generations, runs, seed):
    """What comes of runs at the same time.

    Returns the plan; seconds of all; the shares of the workers' time in which they did tasks, in which they did those whose
    results were used, and that these would have taken without delays; and how many workers died.
    """
    workers = SimulatedWorkers(workers_count, seed)
    dispatcher = Dispatcher(workers, 0.01)
    plan = Plan(population, each, workers_count, 8, HANDING, SENDING)
    going = []
    begun = done = 0
    while True:
        while len(going) < runs and begun < runs * generations:
            begun += 1
            work = Generation(plan)
            going.append(dispatcher.begin(work, range(len(work.sizes))))
        over = [doing for doing in going if doing.is_over]
        for doing in over:
            dispatcher.end(doing)
            going.remove(doing)
            done += 1
        if done == runs * generations:
            break
        if not over:
            dispatcher.turn()
    seconds = workers.now()
    shares = (share / (workers_count * seconds) for share in (workers.busy, workers.used, runs * generations * population * each))
    return plan, seconds, *shares, workers.deaths


def main():
    """Prints a table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--workers", type=int, default=1000)
    parser.add_argument("--population", type=int, default=100_000)
    parser.add_argument("--generations", type=int, default=10)
    parser.add_argument("--runs", type=int, nargs="+", default=[1, 2, 4, 8], help="at the same time")
    parser.add_argument("--each", type=float, nargs="+", default=[1.0, 3.0, 10.0, 30.0, 100.0], help="ms of an individual")
    given = parser.parse_args()
    print("ms each  runs  individuals a piece  s a generation  busy  used  needed  deaths")
    for runs in given.runs:
        for each in (milliseconds / 1e3 for milliseconds in given.each):
            plan, seconds, busy, used, needed, deaths = simulate(given.workers, given.population, each, given.generations, runs, 1)
            print(
                f"{each * 1e3:7.0f}  {runs:4d}  {plan.piece:19d}  {seconds / given.generations / runs:14.2f}  {busy:4.0%}"
                f"  {used:4.0%}  {needed:6.0%}  {deaths:6d}",
                flush=True,
            )


if __name__ == "__main__":
    main()
