"""Least squares within bounds, how far they determine each number, and in words what data cannot tell apart."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.search.sampled_motions import Remembering
from symgen.base.errors import enumeration
from symgen.result.unmoved import unmoved_sentence

Array = NDArray[np.float64]
#: Share of intervals that cover the value.
COVERED = 0.95
#: Searches end where a step changes the sum, the numbers or the slopes by less, and after this many steps.
STILL, STEPS = 1e-12, 100
#: A direction is none below this part of the largest singular value, or beyond a gap of this size.
NONE, GAP = 1e-10, 1e-8
#: Exponents in words have at most this denominator, and are right to this.
_DENOMINATOR, _NEAR = 6, 1e-3


class LeastSquares(NamedTuple):
    """Where a sum of squares is least.

    Attributes
    ----------
    x : Array, shape (n,)
        The numbers.
    residuals, slopes : Array, shapes (k,) and (k, n)
        There, with their derivatives.
    at_bound : Array, shape (n,)
        -1 for a number that meets its lower bound, 1 for its upper one, else 0.
    steps : int
        Steps that were made.
    is_still : bool
        Whether the search ended by itself.
    """

    x: Array
    residuals: Array
    slopes: Array
    at_bound: NDArray[np.int64]
    steps: int
    is_still: bool


def least_squares_within(
    rows: Callable[[Array], tuple[Array, Array]], start: Array, low: Array, high: Array
) -> LeastSquares:
    """Return the numbers within bounds with which a sum of squares is least.

    Parameters
    ----------
    rows : callable
        Takes numbers; returns residuals, infinite ones where there are none, and their derivatives.
    start, low, high : Array, shape (n,)
        Where the search begins, and bounds.
    """
    from scipy.optimize import least_squares

    kept = Remembering(rows)

    def residuals(x: Any) -> Array:
        return kept(x)[0]

    def slopes(x: Any) -> Array:
        return kept(x)[1]

    found = least_squares(
        residuals,
        start,
        jac=slopes,
        bounds=(low, high),
        x_scale="jac",
        xtol=STILL,
        ftol=STILL,
        gtol=STILL,
        max_nfev=STEPS,
    )
    rest, by = kept(found.x)
    at_bound = np.asarray(found.active_mask, dtype=np.int64)
    return LeastSquares(found.x, rest, by, at_bound, int(found.nfev), found.status != 0)


class Determined(NamedTuple):
    """How far data determine numbers.

    Attributes
    ----------
    errors : Array, shape (n,)
        Standard errors; nan for a number that meets its bound, and for all where `null` has sentences.
    correlations : Array, shape (n, n)
        Of the errors.
    intervals : list of (float, float)
        95 % intervals; one-sided where a bound is met.
    null : tuple of str
        Sentences on numbers that the data do not determine.
    """

    errors: Array
    correlations: Array
    intervals: list[tuple[float, float]]
    null: tuple[str, ...]


def determine(found: LeastSquares, sizes: Array, labels: Sequence[str]) -> Determined:
    """Return how far a least sum of squares determines its numbers.

    Parameters
    ----------
    found : LeastSquares
        The least sum.
    sizes : Array, shape (n,)
        What a change of each number is measured by.
    labels : sequence of str
        Their names.
    """
    from scipy.stats import t as student

    x, residuals, slopes = found.x, found.residuals, found.slopes
    null = null_directions(slopes, sizes, labels)
    free, count = np.flatnonzero(found.at_bound == 0), len(residuals) - len(x)
    errors, correlations = np.full(len(x), np.nan), np.full((len(x), len(x)), np.nan)
    variance = float(residuals @ residuals) / count if count > 0 else math.nan
    if len(free) and not null:
        scaled = slopes[:, free] * sizes[free]
        covariance = np.linalg.pinv(scaled.T @ scaled) * variance * np.outer(sizes[free], sizes[free])
        errors[free] = np.sqrt(np.diag(covariance))
        spread = np.outer(errors[free], errors[free])
        correlations[np.ix_(free, free)] = covariance / np.where(spread > 0.0, spread, np.nan)
    half = errors * (float(student.ppf(0.5 + 0.5 * COVERED, count)) if count > 0 else math.nan)
    low = np.where(found.at_bound == 0, x - half, np.where(found.at_bound < 0, x, np.nan))
    high = np.where(found.at_bound == 0, x + half, np.where(found.at_bound > 0, x, np.nan))
    return Determined(errors, correlations, list(zip(low.tolist(), high.tolist(), strict=True)), null)


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
        return f"{enumeration([name for name, _ in moving])} can change together without a change of what was measured"
    if all(f == 1 for f in powers):
        return f"{enumeration([name for name, _ in moving])} can be multiplied by one number"
    factors = [f"{name} by {_power_text(f)}" for (name, _), f in zip(moving, powers, strict=True)]
    return f"{enumeration(factors)} can be multiplied together, for any number z"


def _power_text(f: Fraction) -> str:
    return "z" if f == 1 else f"z^{f}" if f.denominator == 1 and f > 0 else f"z^({f})"
