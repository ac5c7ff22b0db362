"""Numbers that data cannot tell apart, in words: null directions of derivatives."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from symgen.result.unmoved import unmoved_sentence

Array = NDArray[np.float64]

#: A direction is none below this part of the largest singular value, or beyond a gap of this size.
NONE, GAP = 1e-10, 1e-8
#: Exponents in words have at most this denominator, and are right to this.
_DENOMINATOR, _NEAR = 6, 1e-3


def null_directions(slopes: Array, sizes: Array, labels: Sequence[str]) -> tuple[str, ...]:
    """Return sentences on changes of numbers that leave the data as they are.

    Parameters
    ----------
    slopes : Array, shape (k, n)
        Derivatives of the residuals.
    sizes : Array, shape (n,)
        What a change of each number is measured by.
    labels : sequence of str
        Their names.
    """
    _, singular, rows = np.linalg.svd(slopes * sizes, full_matrices=True)
    values = np.zeros(len(labels))
    values[: len(singular)] = singular
    largest = values[0]
    if largest == 0.0:
        return tuple(unmoved_sentence([name], "that was measured") for name in labels)
    none = values < NONE * largest
    gaps = np.flatnonzero(values[1:] < GAP * values[:-1])
    if len(gaps):
        none[gaps[0] + 1 :] = True
    return tuple(_direction_in_words(row, labels) for row in rows[none])


def _direction_in_words(row: Array, labels: Sequence[str]) -> str:
    """Return a sentence on one direction of relative changes."""
    parts = row / row[int(np.argmax(np.abs(row)))]
    moving = [(name, x) for name, x in zip(labels, parts, strict=True) if abs(x) > _NEAR]
    if len(moving) == 1:
        return unmoved_sentence([moving[0][0]], "that was measured")
    powers = [Fraction(x).limit_denominator(_DENOMINATOR) for _, x in moving]
    if any(abs(float(f) - x) > _NEAR for f, (_, x) in zip(powers, moving, strict=True)):
        return (
            f"{_names_in_words([name for name, _ in moving])} can change together without a change of what was measured"
        )
    if all(f == 1 for f in powers):
        return f"{_names_in_words([name for name, _ in moving])} can be multiplied by one number"
    factors = [f"{name} by {_power_text(f)}" for (name, _), f in zip(moving, powers, strict=True)]
    return f"{_names_in_words(factors)} can be multiplied together, for any number z"


def _power_text(f: Fraction) -> str:
    return "z" if f == 1 else f"z^{f}" if f.denominator == 1 and f > 0 else f"z^({f})"


def _names_in_words(names: Sequence[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
