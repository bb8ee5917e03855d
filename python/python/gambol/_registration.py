"""The names under which ``gymnasium.make`` finds the environments."""

from __future__ import annotations

import os

import gymnasium

from gambol import _bipedal_walker
from gambol._gambol import creature_names, episode_facts

#: The version of the ids: another one has other rewards, observations or ends.
VERSION = 0

#: What is slower is not usable, body lengths/s: see docs/gaits.md.
USABLE_SPEED = 0.5

#: The movements whose fitness is a distance that a usable speed tells.
_DISTANCES = ("running", "backwards", "swimming")


def _camel_case(name: str) -> str:
    return "".join(word.capitalize() for word in name.split("-"))


def environment_id(creature: str, movement: str) -> str:
    """The id of a shipped creature and a movement, such as ``gambol/Biped1Running-v0`` of biped-1 and running."""
    return f"gambol/{_camel_case(creature)}{_camel_case(movement)}-v{VERSION}"


def register_environments() -> None:
    """Registers every shipped creature with every movement, and the BipedalWalker. Nothing is built before it is made."""
    for creature in creature_names():
        length, movements = episode_facts(creature)
        for movement, steps, seconds in movements:
            _register(environment_id(creature, movement), creature, movement, steps, length * seconds)
    walker = _bipedal_walker.NAME
    length, movements = episode_facts(os.fspath(_bipedal_walker.FILE))
    for movement, steps, seconds in movements:
        if movement == "running":
            _register(f"gambol/{_camel_case(walker)}-v{VERSION}", walker, movement, steps, length * seconds)


def _register(name: str, creature: str, movement: str, steps: int, scale: float) -> None:
    """``scale``: what a body length/s is in metres a step."""
    # Gymnasium finds them by itself, and importing gambol must not bring them a second time.
    if name in gymnasium.registry:
        return
    gymnasium.register(
        name,
        entry_point="gambol._environment:CreatureEnv",
        vector_entry_point="gambol._vector:VectorEnv",
        max_episode_steps=steps,
        reward_threshold=USABLE_SPEED * scale * steps if movement in _DISTANCES else None,
        kwargs={"creature": creature, "movement": movement},
    )
