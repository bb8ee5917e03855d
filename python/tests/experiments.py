"""An experiment that is done again and again, and what its folder must hold."""

from pathlib import Path

from gambol.cluster import _experiments

COMPARISON = _experiments.recipe(
    "compare",
    strategies=["ga", "cma-es"],
    creatures=["biped-1"],
    movements=["running"],
    seeds=list(range(1, 13)),
    evaluations=200,
    steps=None,
    preset=None,
    engine=None,
    variation=None,
    settings=[],
)


def files(folder):
    """All results of a folder, and what came of them, by their paths."""
    return {
        str(path.relative_to(folder)): path.read_text()
        for path in sorted(Path(folder).rglob("*"))
        if path.is_file() and "runs" not in path.relative_to(folder).parts
    }


def timeless(table):
    """The rows of a table without the last column, the seconds."""
    return [row.rpartition(",")[0] for row in table.splitlines()]


def same(experiment, one, other):
    """Checks that two folders have the same results, but for seconds."""
    one, other = files(one), files(other)
    assert one.keys() == other.keys()
    for path, text in one.items():
        if path.endswith(("medians.csv", "settings.csv", "comparison.json")):
            assert text == other[path], path
        elif path == "scores.csv":
            assert timeless(text) == timeless(other[path])
        elif path.startswith("results/"):
            assert experiment.agree(text, other[path]), path
