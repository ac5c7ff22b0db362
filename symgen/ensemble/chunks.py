"""What the rows of a chunk give: arrays while they are written, and when they are complete."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Chunk:
    """What the rows of a chunk gave.

    Attributes
    ----------
    values : Array, shape (k, quantities, times)
        Quantities at the output times; nan where a run did not get there.
    summary : Array, shape (k, N_SUMMARY + width)
        See `symgen.runtime.ensemble_abi`.
    complete : bool
        Whether all rows were run.
    """

    values: Array
    summary: Array
    complete: bool = True


@dataclass(frozen=True)
class Results:
    """What the rows of a chunk give, to be written.

    Attributes
    ----------
    values : Array, shape (k, columns, times)
        What loops leave at the output times.
    summary : Array, shape (k, N_SUMMARY)
        See `symgen.runtime.ensemble_abi`.
    events : Array, shape (k, width)
        What happened; see there.
    behind : Array, shape (k, quantities, times)
        What is worked out behind the loops.
    """

    values: Array
    summary: Array
    events: Array
    behind: Array
