"""The native part of the package: built from python/src."""

from collections.abc import Callable
from pathlib import Path
from typing import final

import numpy as np
import numpy.typing as npt

__all__ = [
    "Batch",
    "BatchEvaluator",
    "Environments",
    "Experiment",
    "Genes",
    "NeatSearch",
    "Net",
    "Search",
    "Snapshot",
    "champion_robustness",
    "creature_names",
    "default_time_step",
    "episode_facts",
    "export_champion",
    "judge_gait",
    "movement_names",
    "read_champion",
    "read_config",
    "read_log",
    "register_movement",
    "resume",
    "strategy_names",
    "terrain_names",
    "train",
    "variation_names",
    "verify",
    "write_replay",
]

@final
class Environments:
    def __new__(
        cls,
        creature: str,
        movement: str,
        count: int,
        *,
        preset: str | None,
        terrain: str | None,
        variation: str | None,
        engine: str | None,
        steps: int | None,
        settings: list[str],
        autoreset: str,
        threads: int,
        layout: list[tuple[str, float, float]] | None,
    ) -> Environments: ...
    def reset(
        self,
        seeds: list[int | None],
        mask: npt.NDArray[np.bool_] | None,
        observations: npt.NDArray[np.float32],
    ) -> None: ...
    def step(
        self,
        actions: npt.NDArray[np.float32],
        observations: npt.NDArray[np.float32],
        last_observations: npt.NDArray[np.float32],
        rewards: npt.NDArray[np.float64],
        terminated: npt.NDArray[np.bool_],
        truncated: npt.NDArray[np.bool_],
    ) -> list[tuple[int, float, str | None]]: ...
    def value(self, environment: int) -> float: ...
    def parts(self, environment: int) -> npt.NDArray[np.float32]: ...
    def frame(self, environment: int, width: int, height: int) -> npt.NDArray[np.uint8]: ...
    @property
    def shape(self) -> tuple[int, int]: ...
    @property
    def input_range(self) -> float: ...
    @property
    def episode_steps(self) -> int: ...
    @property
    def time_step(self) -> float: ...
    @property
    def unit(self) -> str: ...
    @property
    def stepped_by(self) -> str: ...
    @property
    def threads(self) -> int: ...
    @property
    def config(self) -> str: ...
    @property
    def channels(self) -> list[list[tuple[str, str]]]: ...

def creature_names() -> list[str]: ...
def default_time_step() -> float: ...
def episode_facts(creature: str) -> tuple[float, list[tuple[str, int, float]]]: ...
def movement_names() -> list[str]: ...
def terrain_names() -> list[str]: ...
def variation_names() -> list[str]: ...
def strategy_names() -> list[str]: ...

@final
class Search:
    def __new__(
        cls, name: str, dimension: int | None, layers: list[int] | None, seed: int, settings: str
    ) -> Search: ...
    def ask(self) -> npt.NDArray[np.float32]: ...
    def tell(self, fitness: npt.NDArray[np.float64], objectives: npt.NDArray[np.float64] | None) -> None: ...
    def best(self) -> tuple[npt.NDArray[np.float32], float, int] | None: ...
    def front(self) -> list[tuple[list[float], list[float]]] | None: ...
    def statistics(self) -> list[tuple[str, float]]: ...
    def save(self) -> bytes: ...
    @staticmethod
    def restore(name: str, saved: bytes) -> Search: ...
    @property
    def generations(self) -> int: ...
    @property
    def dimension(self) -> int: ...
    @property
    def name(self) -> str: ...

@final
class Batch:
    def __len__(self) -> int: ...
    def piece(self, start: int, stop: int) -> bytes: ...

@final
class BatchEvaluator:
    def __new__(cls, config: str) -> BatchEvaluator: ...
    def evaluate(self, piece: bytes) -> bytes: ...

_Elsewhere = Callable[[str, Batch], list[bytes] | None]

def train(
    creature: str | None,
    movement: str | None,
    folder: Path,
    *,
    preset: str | None,
    strategy: str | None,
    terrain: str | None,
    variation: str | None,
    engine: str | None,
    seed: int | None,
    generations: int | None,
    population: int | None,
    config: Path | None,
    settings: list[str],
    threads: int,
    callback: Callable[[str], bool] | None,
    elsewhere: _Elsewhere | None,
) -> tuple[str, int, int, int]: ...
def resume(
    folder: Path,
    generations: int | None,
    threads: int,
    callback: Callable[[str], bool] | None,
    elsewhere: _Elsewhere | None,
) -> tuple[str, int, int, int]: ...
def read_log(folder: Path) -> list[str]: ...
def read_config(folder: Path) -> str: ...
def read_champion(path: Path) -> str: ...
def verify(path: Path) -> tuple[bool, float | None, int | None]: ...
def judge_gait(path: Path) -> str: ...

@final
class Experiment:
    @staticmethod
    def compare(
        strategies: list[str],
        creatures: list[str],
        movements: list[str],
        seeds: list[int],
        *,
        evaluations: int | None,
        steps: int | None,
        preset: str | None,
        engine: str | None,
        variation: str | None,
        settings: list[str],
    ) -> Experiment: ...
    @staticmethod
    def tune(
        strategy: str,
        creatures: list[str],
        movements: list[str],
        seeds: list[int],
        evaluations: int,
        *,
        trials: int,
        spread: float,
        draw_seed: int,
        preset: str,
        settings: list[str],
    ) -> Experiment: ...
    @staticmethod
    def reproduce(
        creatures: list[str], movements: list[str], presets: list[str], runs: int, generations: int
    ) -> Experiment: ...
    @staticmethod
    def gaits(
        creatures: list[str],
        movements: list[str],
        seeds: list[int],
        steps: int,
        *,
        preset: str | None,
        strategy: str | None,
        variation: str | None,
        settings: list[str],
        whole: bool,
        robust: bool,
    ) -> Experiment: ...
    @property
    def runs(self) -> int: ...
    @property
    def digest(self) -> str: ...
    def name(self, run: int) -> str: ...
    def begin(self, folder: Path) -> None: ...
    def missing(self, folder: Path) -> list[int]: ...
    def carry_out(self, run: int) -> str: ...
    def place(self, folder: Path, run: int, result: str) -> Path: ...
    def agree(self, one: str, other: str) -> bool: ...
    def conclude(self, folder: Path) -> list[Path]: ...

def champion_robustness(path: Path, worlds: int, seed: int, variation: str | None) -> str: ...
def export_champion(
    path: Path,
    format: str,
    out: Path | None,
    *,
    seconds: float | None,
    size: int | None,
    rate: float | None,
    ground: bool,
    overwrite: bool,
) -> list[Path]: ...
def write_replay(path: Path, page: Path, seconds: float | None) -> None: ...

@final
class Net:
    @staticmethod
    def of_champion(path: Path) -> Net: ...
    @staticmethod
    def of_text(text: str) -> Net: ...
    def text(self) -> str: ...
    @property
    def shape(self) -> tuple[int, int]: ...
    def activate(self, inputs: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]: ...
    def reset(self) -> None: ...

@final
class Genes:
    def nodes(self) -> list[tuple[int, str, float]]: ...
    def connections(self) -> list[tuple[int, int, int, float, bool]]: ...
    def layout(self) -> tuple[int, int, int]: ...
    def net(self) -> Net: ...
    def dot(self, inputs: list[str], outputs: list[str]) -> str: ...
    def text(self) -> str: ...
    @staticmethod
    def of_text(text: str) -> Genes: ...

@final
class NeatSearch:
    def __new__(cls, inputs: int, outputs: int, seed: int, settings: str) -> NeatSearch: ...
    def ask(self) -> list[Genes]: ...
    def tell(self, fitness: npt.NDArray[np.float64]) -> None: ...
    def best(self) -> tuple[Genes, float, int] | None: ...
    def species(self) -> list[tuple[int, int, float | None]]: ...
    def memberships(self) -> list[int]: ...
    def statistics(self) -> list[tuple[str, float]]: ...
    def save(self) -> bytes: ...
    @staticmethod
    def restore(saved: bytes) -> NeatSearch: ...
    @property
    def generations(self) -> int: ...

@final
class Snapshot:
    """What a movement sees."""

    @property
    def time(self) -> float:
        """Seconds since the episode began."""
    @property
    def motor_work(self) -> float:
        """Work of all motors so far, J."""
    @property
    def parts(self) -> npt.NDArray[np.float32]:
        """A row for each part, the torso first: x, y, cosine, sine, vx, vy, spin, and 1 where it touches the ground."""

def register_movement(
    name: str, unit: str, steps: int | None, description: str, make: Callable[[], object]
) -> None: ...
