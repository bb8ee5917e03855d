"""Gambol: neuroevolution for 2D creatures.

- :func:`make_vec`: many environments of a creature and a movement at once, a ``gymnasium.vector.VectorEnv``.
- ``gymnasium.make("gambol/Biped1Running-v0")``: one of them; registered for every shipped creature and movement.
- ``gymnasium.make("gambol/BipedalWalker-v0")``: a body with the observations and actions of Gymnasium's BipedalWalker.
- :class:`CmaEs` and other strategies by ask and tell on NumPy arrays; :class:`Neat` with genomes as objects.
- :func:`train`: a whole run, from a creature and a movement to a :class:`Champion` in a folder.
- :func:`register_movement`: a movement written in Python.
- :mod:`gambol.cluster`: runs and experiments on a Ray cluster; imported by itself.
"""

from gambol._champion import Champion, Controller
from gambol._environment import CreatureEnv
from gambol._gambol import Snapshot, creature_names, movement_names, strategy_names, terrain_names, variation_names
from gambol._movement import Movement, register_movement
from gambol._neat import BestGenome, ConnectionGene, Neat, NeatGenome, NodeGene, Species
from gambol._registration import environment_id, register_environments
from gambol._runs import Run, train
from gambol._strategies import (
    Ars,
    Best,
    CmaEs,
    Conventional,
    Cosyne,
    Front,
    HillClimbing,
    Nsga2,
    OpenEs,
    RandomSearch,
    Strategy,
)
from gambol._vector import VectorEnv, make_vec

__all__ = [
    "Ars",
    "Best",
    "BestGenome",
    "Champion",
    "CmaEs",
    "ConnectionGene",
    "Controller",
    "Conventional",
    "Cosyne",
    "CreatureEnv",
    "Front",
    "HillClimbing",
    "Movement",
    "Neat",
    "NeatGenome",
    "NodeGene",
    "Nsga2",
    "OpenEs",
    "RandomSearch",
    "Run",
    "Snapshot",
    "Species",
    "Strategy",
    "VectorEnv",
    "creature_names",
    "environment_id",
    "make_vec",
    "movement_names",
    "register_movement",
    "strategy_names",
    "terrain_names",
    "train",
    "variation_names",
]

register_environments()
