"""The native environments of a caller's words."""

from __future__ import annotations

import json
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
        os.fspath(_bipedal_walker.FILE if is_walker else creature),
        movement,
        num_envs,
        preset=preset,
        terrain=terrain,
        variation=variation,
        engine=engine,
        steps=max_episode_steps,
        settings=assignments(settings),
        autoreset=autoreset,
        threads=threads,
        layout=_bipedal_walker.LAYOUT if is_walker else None,
    )


def assignments(settings: Mapping[str, Any] | None) -> list[str]:
    """Settings as a configuration takes them: ``{"physics.gravity": 5}`` is ``physics.gravity=5``."""
    return [f"{path}={json.dumps(value)}" for path, value in (settings or {}).items()]


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
