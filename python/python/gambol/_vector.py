"""Many environments of one creature and one movement at once."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium.error import ResetNeeded
from gymnasium.vector import AutoresetMode
from gymnasium.vector import VectorEnv as GymnasiumVectorEnv
from gymnasium.vector.utils import batch_space

from gambol._build import MOST_SEED, build, seed_of, single_spaces, whole
from gambol._drawing import RENDER_FPS, RENDER_SIZE, Frame, check_drawing, warn_of_no_mode

Floats = npt.NDArray[np.float32]
Rewards = npt.NDArray[np.float64]
Bools = npt.NDArray[np.bool_]

_NATIVE_MODES = {
    AutoresetMode.NEXT_STEP: "NextStep",
    AutoresetMode.SAME_STEP: "SameStep",
    AutoresetMode.DISABLED: "Disabled",
}


class VectorEnv(GymnasiumVectorEnv[Floats, Floats, npt.NDArray[Any]]):
    """Environments of one creature and one movement, stepped sixteen at a time in SIMD lanes, on all cores.

    Observations are ``float32[num_envs, inputs]``: what the creature senses, scaled to within ± the input range (3 unless
    set); :attr:`observation_names` says what each is. Actions are ``float32[num_envs, motors]`` from −1 to 1: full speed
    backwards to full speed forwards, or with ``controller.actuation`` set to an angle the target angle of the joint. What is
    beyond is clamped; what is no finite number ends the episode as a failure.

    Rewards are ``float64[num_envs]`` in :attr:`unit` (metres for running). They are by how much the movement's value has
    grown in the step, so that the rewards of an episode sum to the fitness that training gives it, but for rounding. Where a
    movement is no sum over steps (the greatest height of a jump, say) the reward is what the step has changed of the fitness
    so far, which may be below 0.

    An episode is truncated after ``max_episode_steps`` steps. It is terminated where the movement ends it, and where it
    fails (an exploding body, an action that is no number); a failed episode has no fitness, its last reward is 0, and
    ``infos["failure"]`` says why. ``infos["fitness"]`` has the fitness of episodes that have ended, NaN where they failed.

    Equal seeds and actions give equal bits, on any number of threads, with any instructions of the processor, and the bits
    of rapier (``engine="rapier"``), the reference, which steps one creature at a time.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": RENDER_FPS}

    def __init__(
        self,
        creature: str | os.PathLike[str],
        movement: str = "running",
        num_envs: int = 1,
        *,
        terrain: str | None = None,
        variation: str | None = None,
        max_episode_steps: int | None = None,
        preset: str | None = "plain",
        settings: Mapping[str, Any] | None = None,
        engine: str | None = None,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        threads: int = 0,
        copy: bool = True,
        render_mode: str | None = None,
        render_size: tuple[int, int] = RENDER_SIZE,
    ) -> None:
        """Builds the environments; see :func:`make_vec`."""
        check_drawing(render_mode, VectorEnv.metadata["render_modes"], render_size)
        mode = AutoresetMode(autoreset_mode)
        self._native = build(
            creature,
            movement,
            num_envs,
            preset=preset,
            terrain=terrain,
            variation=variation,
            engine=engine,
            max_episode_steps=max_episode_steps,
            settings=settings,
            autoreset=_NATIVE_MODES[mode],
            threads=threads,
        )
        self.num_envs = int(num_envs)
        fps = round(1 / self._native.time_step)
        self.metadata = {**VectorEnv.metadata, "render_fps": fps, "autoreset_mode": mode}
        self.render_mode = render_mode
        self._render_size = render_size
        self.single_observation_space, self.single_action_space = single_spaces(self._native, creature)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._copy = copy
        self._same_step = mode is AutoresetMode.SAME_STEP
        self._is_reset = False
        self._observations, self._rewards, self._terminated, self._truncated = self._arrays()
        self._last_observations: Floats = np.zeros_like(self._observations)

    def _arrays(self) -> tuple[Floats, Rewards, Bools, Bools]:
        observations = np.zeros((self.num_envs, self._native.shape[0]), np.float32)
        flags = np.zeros((2, self.num_envs), np.bool_)
        return observations, np.zeros(self.num_envs, np.float64), flags[0], flags[1]

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Floats, dict[str, Any]]:
        """Begins an episode in every environment.

        Args:
            seed: from 0 to 2⁶⁴ − 1. An ``int`` gives environment i the seed ``seed + i``; a sequence has one for each. The
                episode of a fresh seed is that of trial 0 of a training run with this seed; those that follow are its trials
                1, 2, …. ``None``, the default, begins the next episode of the seeds there are, at first with random ones.
            options: ``{"reset_mask": bool[num_envs]}`` resets those environments alone.

        Returns:
            The observations, ``float32[num_envs, inputs]``, and an empty dictionary.
        """
        mask = None if options is None else options.get("reset_mask")
        if mask is not None:
            if not isinstance(mask, np.ndarray) or mask.dtype != np.bool_ or mask.shape != (self.num_envs,):
                raise ValueError(f"options['reset_mask'] must be an array bool[{self.num_envs}]")
            if not self._is_reset and not mask.all():
                raise ValueError("the first reset is one of all environments")
            mask = np.ascontiguousarray(mask)
        if self._copy:
            self._observations = np.empty_like(self._observations)
        self._native.reset(self._seeds(seed), mask, self._observations)
        self._is_reset = True
        return self._observations, {}

    def _seeds(self, seed: int | Sequence[int | None] | None) -> list[int | None]:
        if isinstance(seed, (int, np.integer)):
            first = whole("seed", seed, 0, MOST_SEED + 1 - self.num_envs)
            self._np_random_seed = first
            self._np_random = np.random.default_rng(first)
            return [first + index for index in range(self.num_envs)]
        if seed is None:
            if self._is_reset:
                return [None] * self.num_envs
            return [int(one) for one in self.np_random.integers(0, 2**63, self.num_envs)]
        seeds = list(seed)
        if len(seeds) != self.num_envs:
            raise ValueError(f"seed must be of length {self.num_envs}, one for each environment, found {len(seeds)}")
        if not self._is_reset:
            drawn = self.np_random.integers(0, 2**63, self.num_envs)
            return [int(other) if one is None else seed_of(one) for one, other in zip(seeds, drawn, strict=True)]
        return [None if one is None else seed_of(one) for one in seeds]

    def step(self, actions: npt.ArrayLike) -> tuple[Floats, Rewards, Bools, Bools, dict[str, Any]]:
        """A time step of every environment.

        Args:
            actions: ``float32[num_envs, motors]``; other types and layouts are converted.

        Returns:
            Observations ``float32[num_envs, inputs]``, rewards ``float64[num_envs]``, terminated and truncated
            ``bool[num_envs]``, and infos. With ``copy=False`` the arrays are those of the step before, overwritten.
        """
        if not self._is_reset:
            raise RuntimeError("call reset before step")
        taken = np.ascontiguousarray(actions, np.float32)
        if np.may_share_memory(taken, self._observations) or np.may_share_memory(taken, self._rewards):
            taken = taken.copy()
        if taken.shape != self.action_space.shape:
            raise ValueError(f"actions must be of shape {self.action_space.shape}, found {taken.shape}")
        if self._copy:
            self._observations, self._rewards, self._terminated, self._truncated = self._arrays()
        ended = self._native.step(
            taken,
            self._observations,
            self._last_observations,
            self._rewards,
            self._terminated,
            self._truncated,
        )
        infos = self._ended_infos(ended) if ended else {}
        return self._observations, self._rewards, self._terminated, self._truncated, infos

    def _ended_infos(self, ended: list[tuple[int, float, str | None]]) -> dict[str, Any]:
        """What there is to say of episodes that have ended; of a same-step reset it is in ``final_info``."""
        mask = np.zeros(self.num_envs, np.bool_)
        fitness = np.full(self.num_envs, np.nan)
        failures = np.full(self.num_envs, None, dtype=object)
        failed = np.zeros(self.num_envs, np.bool_)
        for index, value, failure in ended:
            mask[index] = True
            fitness[index] = value
            if failure is not None:
                failures[index] = failure
                failed[index] = True
        infos: dict[str, Any] = {"fitness": fitness, "_fitness": mask}
        if failed.any():
            infos |= {"failure": failures, "_failure": failed}
        if not self._same_step:
            return infos
        last = np.full(self.num_envs, None, dtype=object)
        for index, _, _ in ended:
            last[index] = self._last_observations[index].copy()
        return {"final_obs": last, "_final_obs": mask.copy(), "final_info": infos, "_final_info": mask.copy()}

    def render(self) -> tuple[Frame, ...] | None:
        """A picture of each creature, ``num_envs`` of ``uint8[height, width, 3]``.

        Each takes some milliseconds and is drawn in this call, one after the other: of many environments this is slow.
        """
        if self.render_mode is None:
            warn_of_no_mode()
            return None
        if not self._is_reset:
            raise ResetNeeded("call reset before render")
        return tuple(self._native.frame(index, *self._render_size) for index in range(self.num_envs))

    @property
    def values(self) -> Rewards:
        """The movement's value so far of every environment, ``float64[num_envs]``, in :attr:`unit`; 0 before the first step."""
        return np.array([self._native.value(index) for index in range(self.num_envs)])

    def parts(self, index: int) -> Floats:
        """Where the parts of a creature are, ``float32[parts, 3]``: x and y of the centre in m, and the angle in rad."""
        return self._native.parts(index)

    @property
    def unit(self) -> str:
        """The unit of fitness and rewards, such as m."""
        return self._native.unit

    @property
    def max_episode_steps(self) -> int:
        """The longest an episode lasts, in steps."""
        return self._native.episode_steps

    @property
    def time_step(self) -> float:
        """Seconds a step lasts; a variation may change it from episode to episode."""
        return self._native.time_step

    @property
    def observation_names(self) -> list[str]:
        """What each observation is."""
        return [name for name, _ in self._native.channels[0]]

    @property
    def action_names(self) -> list[str]:
        """What each action moves."""
        return [name for name, _ in self._native.channels[1]]

    @property
    def stepped_by(self) -> str:
        """The instructions that step the environments (``baseline``, ``avx2``, ``avx-512``), or ``rapier``."""
        return self._native.stepped_by

    @property
    def threads(self) -> int:
        """How many threads step them."""
        return self._native.threads

    @property
    def config(self) -> dict[str, Any]:
        """The whole configuration, as a run with these settings has it."""
        config: dict[str, Any] = json.loads(self._native.config)
        return config


def make_vec(
    creature: str | os.PathLike[str],
    movement: str = "running",
    num_envs: int = 1,
    *,
    terrain: str | None = None,
    variation: str | None = None,
    max_episode_steps: int | None = None,
    preset: str | None = "plain",
    settings: Mapping[str, Any] | None = None,
    engine: str | None = None,
    autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
    threads: int = 0,
    copy: bool = True,
    render_mode: str | None = None,
    render_size: tuple[int, int] = RENDER_SIZE,
) -> VectorEnv:
    """Environments of a creature and a movement, stepped together.

    Args:
        creature: the name of a shipped creature (:func:`gambol.creature_names`), the path of a creature file, or
            ``"bipedal-walker"``, which has the observations and actions of Gymnasium's BipedalWalker.
        movement: what is rewarded (:func:`gambol.movement_names`).
        num_envs: how many; a multiple of 16 wastes nothing.
        terrain: ``"NAME"`` or ``"NAME:DIFFICULTY"`` (:func:`gambol.terrain_names`), such as ``"hurdles:0.5"``; flat by default.
        variation: how worlds differ from episode to episode (:func:`gambol.variation_names`); by default as the preset has it, which with
            ``"plain"`` is not at all.
        max_episode_steps: the longest an episode lasts, in steps; by default the length of the preset.
        preset: where settings begin. ``"plain"``: the movement alone, and the senses of the creature's file. ``"default"``:
            what the program trains with, reward shaping, clocks, target angles and the variation of the movement included.
        settings: single settings by their path, such as ``{"physics.gravity": 5.0}``; see docs/configuration.md.
        engine: ``"lanes"``, or ``"rapier"``, the reference, some thirty times slower; by default lanes, and for movements in
            water rapier.
        autoreset_mode: when an environment whose episode has ended begins the next, one of Gymnasium's ``AutoresetMode``
            (``"NextStep"``, ``"SameStep"``, ``"Disabled"``).
        threads: how many step the environments; 0, the default: one for each core. No result depends on it.
        copy: whether each step returns arrays of its own. Without, they are overwritten by the next step.
        render_mode: ``"rgb_array"``: :meth:`VectorEnv.render` draws; by default it does not.
        render_size: width and height of a picture, each from 16 to 4096 px.

    Raises:
        ValueError: if a name or a setting is wrong; the message says which, and what is allowed.

    Example:
        >>> envs = make_vec("biped-1", "running", num_envs=1024)
        >>> observations, infos = envs.reset(seed=1)
        >>> observations, rewards, terminated, truncated, infos = envs.step(envs.action_space.sample())
        >>> rewards.shape
        (1024,)
    """
    return VectorEnv(
        creature,
        movement,
        num_envs,
        terrain=terrain,
        variation=variation,
        max_episode_steps=max_episode_steps,
        preset=preset,
        settings=settings,
        engine=engine,
        autoreset_mode=autoreset_mode,
        threads=threads,
        copy=copy,
        render_mode=render_mode,
        render_size=render_size,
    )
