"""What many tests compare with."""

import pytest
from experiments import COMPARISON

from gambol.cluster import _experiments


@pytest.fixture(scope="session")
def alone(tmp_path_factory):
    """The comparison by one process, one run after the other."""
    experiment = _experiments.experiment(COMPARISON)
    folder = tmp_path_factory.mktemp("alone") / "comparison"
    experiment.begin(folder)
    for run in range(experiment.runs):
        experiment.place(folder, run, experiment.carry_out(run))
    experiment.conclude(folder)
    return folder
