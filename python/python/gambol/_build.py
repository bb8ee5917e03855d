"""The native environments of a caller's words."""

from __future__ import annotations

import json
import operator
import os
from collections.abc import Mapping
from typing import Any

import numpy as np
from gymnasium import spaces

from gambol import _bipedal_walker
from gambol._gambol import Environments


def build(
    creature: str | os.PathLike[str],
    movement: str,
    num_envs: int,
    *,
    preset: str | None,
    terrain: str | None,
    variation: str | None,
    engine: str | None,
    max_episode_steps: int | None,
    settings: Mapping[str, Any] | None,
    autoreset: str,
    threads: int,
) -> Environments:
    """Builds them; what is wrong is a ``ValueError`` in the library's own words."""
    is_walker = creature == _bipedal_walker.NAME
    return Environments(
        os.fspath(_bipedal_walker.FILE) if is_walker else creature_text(creature),
        movement,
        whole("num_envs", num_envs, 1, 2**20),
        preset=preset,
        terrain=terrain,
        variation=variation,
        engine=engine,
        steps=None if max_episode_steps is None else whole("max_episode_steps", max_episode_steps, 1, 1_000_000),
        settings=assignments(settings),
        autoreset=autoreset,
        threads=whole("threads", threads, 0, 1024),
        layout=_bipedal_walker.LAYOUT if is_walker else None,
    )


#: The largest seed.
MOST_SEED = 2**64 - 1


def creature_text(creature: str | os.PathLike[str]) -> str:
    """A creature as the program takes it: a text may be a name, and a path is always one of a file."""
    path = os.fspath(creature)
    return path if isinstance(creature, str) else os.path.join(os.curdir, path)


def assignments(settings: Mapping[str, Any] | None) -> list[str]:
    """Settings as a configuration takes them: ``{"physics.gravity": 5}`` is ``physics.gravity=5``.

    Raises:
        TypeError: if they are no mapping.
    """
    if settings is not None and not isinstance(settings, Mapping):
        raise TypeError(f"settings must be a mapping from paths to values, found {settings!r}")
    return [f"{path}={json_text(path, value)}" for path, value in (settings or {}).items()]


def json_text(path: str, value: Any) -> str:
    """A value as JSON, NumPy's too; ``path`` names it where it has none."""
    try:
        return json.dumps(value, allow_nan=False, default=_plain)
    except ValueError as error:
        raise ValueError(f"{path} = {value}: must be of finite numbers") from error


def _plain(value: Any) -> Any:
    """What NumPy has as Python has it."""
    if isinstance(value, (np.generic, np.ndarray)):
        return value.tolist()
    raise TypeError(f"a value cannot be of type {type(value).__name__}")


def seed_of(value: Any) -> int:
    """A seed."""
    return whole("seed", value, 0, MOST_SEED)


def whole(name: str, value: Any, least: int, most: int) -> int:
    """A whole number, NumPy's too.

    Raises:
        ValueError: if it is out of its range; the error names the argument.
        TypeError: if it is no whole number.
    """
    try:
        number = operator.index(value)
    except TypeError as error:
        raise TypeError(f"{name} must be a whole number, found {value!r}") from error
    if not least <= number <= most:
        raise ValueError(f"{name} = {number}: must be from {least} to {most}")
    return number


def single_spaces(
    native: Environments, creature: str | os.PathLike[str]
) -> tuple[spaces.Space[Any], spaces.Space[Any]]:
    """What one environment shows, float32[inputs] within ± the input range; and takes, float32[motors] within ±1."""
    inputs, motors = native.shape
    limit = native.input_range
    observation: spaces.Space[Any] = spaces.Box(-limit, limit, (inputs,), np.float32)
    if creature == _bipedal_walker.NAME:
        observation = _bipedal_walker.observation_space()
    return observation, spaces.Box(-1.0, 1.0, (motors,), np.float32)
