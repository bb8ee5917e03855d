"""Runs whose evaluations are done by whatever workers."""

import gambol
from gambol import _gambol
from gambol.cluster import _populations
from gambol.cluster._plan import Plan

#: Pieces of sixteen.
SMALL_PIECES = Plan(individuals=1, each=1.0, processors=16, here=1, overhead=1e-6)

RUNS = {
    "cma-es": {"creature": "biped-1", "population": 64, "generations": 6},
    "neat": {"creature": "tetrapod-1", "strategy": "neat", "population": 40, "generations": 4, "variation": "near"},
    "rungs": {
        "creature": "biped-1",
        "population": 64,
        "generations": 4,
        "settings": {"rungs": [{"steps": 60, "share": 0.5}, {"trials": 1, "share": 0.5}]},
    },
}


def files(folder):
    """All files of a run and their bytes, but for how long it took."""
    found = (path for path in sorted(folder.rglob("*")) if path.is_file() and path.name != "timing.jsonl")
    return {str(path.relative_to(folder)): path.read_bytes() for path in found}


def train_on(workers, out, *, plan=SMALL_PIECES, on_generation=None, **arguments):
    """As ``gambol.train(..., cluster=...)`` does, on other workers than Ray's."""
    told = []
    with _populations.Cluster(workers) as cluster:
        creature = arguments.pop("creature")
        defaults = dict.fromkeys(("preset", "strategy", "terrain", "variation", "engine", "seed", "population", "config"))
        settings = gambol._build.assignments(arguments.pop("settings", None))
        _gambol.train(
            creature,
            "running",
            out,
            **{**defaults, **arguments},
            settings=settings,
            threads=1,
            callback=lambda line: (on_generation or told.append)(line) is not None,
            elsewhere=_populations.Populations(cluster, plan),
        )
    return told
