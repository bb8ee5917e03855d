"""The curves of ppo.py as a picture.

pip install matplotlib; python benchmarks/ppo_curves.py ppo.csv ppo.svg
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


def main():
    """A row for each creature, by steps and by seconds."""
    table, picture = sys.argv[1:3]
    curves = defaultdict(list)
    with open(table, newline="") as file:
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


if __name__ == "__main__":
    main()
