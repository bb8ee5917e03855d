"""What all searches by ask and tell have in common."""

from __future__ import annotations

from typing import Any, Self

import numpy as np
import numpy.typing as npt

from gambol._gambol import NeatSearch, Search


class Resumable:
    """A search whose native part has its whole state: it tells of it, pickles and copies itself."""

    _search: Search | NeatSearch

    @property
    def generation(self) -> int:
        """How many generations have been told."""
        return self._search.generations

    @property
    def statistics(self) -> dict[str, float]:
        """What the strategy says of its own state, such as its step size."""
        return dict(self._search.statistics())

    def __getstate__(self) -> bytes:
        """The whole state."""
        return self._search.save()

    def __setstate__(self, state: bytes) -> None:
        """Goes on from a state."""
        raise NotImplementedError

    def __copy__(self) -> Self:
        """An independent search in the same state."""
        copy = object.__new__(type(self))
        copy.__setstate__(self.__getstate__())
        return copy

    def __deepcopy__(self, memo: dict[int, Any]) -> Self:
        """An independent search in the same state."""
        return self.__copy__()


def one_for_each(fitness: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Fitnesses as ``float64[population]``.

    Raises:
        ValueError: if they are of more dimensions.
    """
    values = np.ascontiguousarray(fitness, np.float64)
    if values.ndim != 1:
        raise ValueError(f"fitness must be of one dimension, found {values.ndim}")
    return values
