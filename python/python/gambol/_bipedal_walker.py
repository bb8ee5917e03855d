"""The body that shows and takes what Gymnasium's BipedalWalker-v3 does.

The layout is that of ``gymnasium/envs/box2d/bipedal_walker.py`` in Gymnasium 1.4: 24 observations, 4 actions, their order, their
scale and their spaces. The physics, the reward and the meaning of an action are Gambol's.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from gymnasium import spaces

#: The name that environments know the body by.
NAME = "bipedal-walker"

#: Its creature file.
FILE = Path(__file__).parent / "bodies" / f"{NAME}.json"

# Gymnasium's frames a second, the size of its picture in m, and the top speeds of its motors in rad/s.
_FPS = 50
_VIEW = (600 / 30, 400 / 30)
_HIP_SPEED, _KNEE_SPEED = 4.0, 6.0

# The reach of the rangefinder, m, and where its rays look, degrees: they are 0.15 rad apart, and the first looks straight down.
_REACH = 5.3333
_RAYS = ("-90", "-81.4056", "-72.8113", "-64.2169", "-55.6225", "-47.0282", "-38.4338", "-29.8394", "-21.2451", "-12.6507")

# How hips and knees are turned in the start pose, degrees. Gambol measures angles from there, Gymnasium from the straight leg.
_START = ((4.0, -8.0), (-4.0, -6.0))


def _leg(number: int, hip: float, knee: float) -> list[tuple[str, float, float]]:
    return [
        (f"angle of thigh {number}", 1.0, math.radians(hip)),
        (f"speed of thigh {number}", 1.0 / _HIP_SPEED, 0.0),
        (f"angle of shank {number}", 1.0, math.radians(knee) + 1.0),
        (f"speed of shank {number}", 1.0 / _KNEE_SPEED, 0.0),
        (f"contact of shank {number}", 1.0, 0.0),
    ]


#: Each observation: the sense of the creature, and what its value in its own unit is multiplied with and then added to.
LAYOUT = [
    ("rotation of hull", 1.0, 0.0),
    ("spin of hull", 2.0 / _FPS, 0.0),
    ("forward velocity of hull", 0.3 * _VIEW[0] / _FPS, 0.0),
    ("upward velocity of hull", 0.3 * _VIEW[1] / _FPS, 0.0),
    *_leg(1, *_START[0]),
    *_leg(2, *_START[1]),
    *((f"distance at {angle}°", 1.0 / _REACH, 0.0) for angle in _RAYS),
]


def observation_space() -> spaces.Box:
    """The space that BipedalWalker-v3 has, ``float32[24]``."""
    leg = [math.pi, 5.0, math.pi, 5.0, 5.0]
    high = np.array([math.pi, 5.0, 5.0, 5.0, *leg, *leg, *[1.0] * len(_RAYS)], np.float32)
    low = -high
    low[[8, 13]] = 0.0
    return spaces.Box(low, high)
