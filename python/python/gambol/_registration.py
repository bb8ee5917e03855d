"""The names under which ``gymnasium.make`` finds the environments."""

from __future__ import annotations

import gymnasium

from gambol._gambol import creature_names, movement_names

#: The version of the ids: another one has other rewards, observations or ends.
VERSION = 0


def _camel_case(name: str) -> str:
    return "".join(word.capitalize() for word in name.split("-"))


def environment_id(creature: str, movement: str) -> str:
    """The id of a shipped creature and a movement, such as ``gambol/Biped1Running-v0`` of biped-1 and running."""
    return f"gambol/{_camel_case(creature)}{_camel_case(movement)}-v{VERSION}"


def register_environments() -> None:
    """Registers every shipped creature with every movement. Nothing is built before it is made."""
    for creature in creature_names():
        for movement in movement_names():
            gymnasium.register(
                environment_id(creature, movement),
                entry_point="gambol._environment:CreatureEnv",
                vector_entry_point="gambol._vector:VectorEnv",
                kwargs={"creature": creature, "movement": movement},
            )
