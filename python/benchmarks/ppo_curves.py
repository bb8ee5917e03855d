"""The curves of ppo.py as a picture.

pip install matplotlib; python benchmarks/ppo_curves.py ppo.csv ppo.svg
"""

import csv
import sys
from collections import defaultdict

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams.update({"svg.hashsalt": "gambol", "font.size": 9, "axes.spines.top": False, "axes.spines.right": False})

from matplotlib import pyplot  # noqa: E402

COLOURS = {"cma_es": "#c4522f", "ppo": "#2f6f9e"}
NAMES = {"cma_es": "CMA-ES", "ppo": "PPO"}


def main():
    """Two panels: by steps, by seconds."""
    table, picture = sys.argv[1:3]
    curves = defaultdict(list)
    with open(table, newline="") as file:
        for row in csv.DictReader(file):
            curves[row["learner"], row["seed"]].append((float(row["steps"]), float(row["seconds"]), float(row["fitness"])))
    figure, panels = pyplot.subplots(1, 2, figsize=(8, 3.2), sharey=True, layout="constrained")
    for panel, column, label in zip(panels, (0, 1), ("steps of one creature", "seconds"), strict=True):
        named = set()
        for (learner, _), points in curves.items():
            label_once = None if learner in named else NAMES[learner]
            named.add(learner)
            kept = [point for point in points if point[column] > 0]
            panel.plot([point[column] for point in kept], [point[2] for point in kept], color=COLOURS[learner], label=label_once, lw=1.2)
        panel.set_xscale("log")
        panel.set_xlabel(label)
        panel.grid(alpha=0.25)
    panels[0].set_ylabel("distance in an episode, m")
    panels[0].legend(frameon=False)
    figure.savefig(picture, metadata={"Date": None})


if __name__ == "__main__":
    main()
