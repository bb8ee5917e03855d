"""The curves of ppo.py as a picture and as a table.

pip install matplotlib; python benchmarks/ppo_curves.py curves.csv picture.svg table.csv
"""

import csv
import sys
from collections import defaultdict

import gymnasium
import matplotlib

matplotlib.use("svg")
matplotlib.rcParams.update({"svg.hashsalt": "gambol", "font.size": 9, "axes.spines.top": False, "axes.spines.right": False})

from matplotlib import pyplot  # noqa: E402

import gambol  # noqa: E402, F401

LEARNERS = {
    "program": ("gambol train", "#3f7d4e"),
    "cma_es": ("CMA-ES, ask and tell", "#c4522f"),
    "ppo": ("PPO", "#2f6f9e"),
}


def one_body_length_a_second(creature):
    """The distance of an episode at this speed, m: twice the threshold of the registered environment."""
    name = "".join(part.capitalize() for part in creature.split("-"))
    return 2 * gymnasium.spec(f"gambol/{name}Running-v0").reward_threshold


def span(values, digits):
    """The least and the greatest value."""
    texts = list(dict.fromkeys(f"{value:,.{digits}f}" for value in sorted(values)))
    return " to ".join(dict.fromkeys((texts[0], texts[-1])))


def write_table(path, curves):
    """Of each creature and learner when it first runs one body length a second, and what it comes to."""
    with open(path, "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["creature", "learner", "first at 1 body length/s", "in the end", "taken for it"])
        for creature in dict.fromkeys(creature for creature, _, _ in curves):
            for learner, (name, _) in LEARNERS.items():
                of_seeds = [points for (of, by, _), points in curves.items() if (of, by) == (creature, learner)]
                wanted = one_body_length_a_second(creature)
                firsts = [next((point for point in points if point[2] >= wanted), None) for points in of_seeds]
                reached = [first for first in firsts if first is not None]
                when = "never"
                if reached:
                    when = f"{span((x[0] / 1e6 for x in reached), 2)} million steps, {span((x[1] for x in reached), 1)} s"
                if 0 < len(reached) < len(firsts):
                    when += f", {len(reached)} of {len(firsts)} seeds"
                ends = [points[-1] for points in of_seeds]
                taken = f"{span((x[0] / 1e6 for x in ends), 1)} million steps, {span((x[1] for x in ends), 0)} s"
                table.writerow([creature, name, when, f"{span((x[2] for x in ends), 0)} m", taken])


def main():
    """A row for each creature, by steps and by seconds."""
    curves_file, picture, table = sys.argv[1:4]
    curves = defaultdict(list)
    with open(curves_file, newline="") as file:
        for row in csv.DictReader(file):
            point = float(row["steps"]), float(row["seconds"]), float(row["fitness"])
            curves[row["creature"], row["learner"], row["seed"]].append(point)
    creatures = list(dict.fromkeys(creature for creature, _, _ in curves))
    figure, rows = pyplot.subplots(
        len(creatures), 2, figsize=(8, 3 * len(creatures)), sharey="row", sharex="col", layout="constrained", squeeze=False
    )
    for creature, panels in zip(creatures, rows, strict=True):
        for panel, column in zip(panels, (0, 1), strict=True):
            panel.axhline(one_body_length_a_second(creature), color="#888888", lw=0.8, ls="--")
            for learner, (name, colour) in LEARNERS.items():
                for (of, by, seed), points in curves.items():
                    if (of, by) == (creature, learner):
                        kept = [point for point in points if point[column] > 0]
                        places, heights = [point[column] for point in kept], [point[2] for point in kept]
                        panel.plot(places, heights, color=colour, lw=1.1, label=name if seed == "1" else None)
            panel.set_xscale("log")
            panel.grid(alpha=0.25)
        panels[0].set_ylabel(f"{creature}: distance, m")
    for panel, label in zip(rows[-1], ("steps of one creature", "seconds"), strict=True):
        panel.set_xlabel(label)
    rows[0][0].legend(frameon=False)
    figure.savefig(picture, metadata={"Date": None})
    write_table(table, curves)


if __name__ == "__main__":
    main()
