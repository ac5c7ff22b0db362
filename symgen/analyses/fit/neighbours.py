"""Residuals that follow each other: what a fit leaves is not noise, so that its intervals are too small."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Correlations of independent residuals are larger than this many of their deviations once in 30,000 times.
BEYOND = 4.0
#: Residuals below this part of the deviation of the data are errors of integration, which do follow each other.
INTEGRATED = 1e-6


def correlation_of_neighbours(parts: Sequence[Array]) -> tuple[float, float]:
    """Return the correlation of each residual with the next one, and its deviation where they are independent.

    Parameters
    ----------
    parts : sequence of Array
        Residuals of one quantity in the order of time, of each run.
    """
    size = sum(float(part @ part) for part in parts)
    pairs = sum(len(part) - 1 for part in parts if len(part))
    if size == 0.0 or pairs < 1:
        return 0.0, math.inf
    return sum(float(part[1:] @ part[:-1]) for part in parts) / size, 1.0 / math.sqrt(pairs)


def notes_on_neighbours(residuals: Mapping[str, Sequence[Array]], spread: Mapping[str, float]) -> list[str]:
    """Return a sentence for each quantity whose residuals follow each other.

    Parameters
    ----------
    residuals : mapping of str to sequence of Array
        Quantity -> residuals of each run, in its unit.
    spread : mapping of str to float
        Quantity -> standard deviation of the data, in its unit.
    """
    notes = list[str]()
    for name, parts in residuals.items():
        size = math.sqrt(float(np.mean(np.concatenate(parts) ** 2)))
        correlation, deviation = correlation_of_neighbours(parts)
        if size > INTEGRATED * spread[name] and correlation > BEYOND * deviation:
            notes.append(
                f"residuals of {name} follow each other (correlation {correlation:.2f} from one to the next): "
                "the model lacks something that the data have, and errors and intervals are too small"
            )
    return notes
