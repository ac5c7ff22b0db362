"""Switching functions at points of a step: its beginning, inner points of the motion, and its end.

Functions of forces have no known slopes; their slopes are those of the polynomial through the values at all points.
"""

from __future__ import annotations

from typing import Any

from symgen.compile.store.emitted import plain
from symgen.run.loops.search_records import (
    ASLEEP,
    D_END,
    D_HIGH,
    D_INSIDE,
    D_LOW,
    D_START,
    G_END,
    G_INSIDE,
    G_START,
    INSIDE,
    MARGIN,
    MARGINS,
    MEASURE,
    N_COLUMNS,
    N_HEAD,
    OF_FORCES,
    PLACES,
    SPREAD,
    STEEPEST,
    WHOLE,
)
from symgen.run.loops.switching import is_finite, taken_for

A = Any
#: States between steps are not corrected: sleeping margins count there with this part of their size.
_UNCORRECTED = 1e-6


@plain
def enter_point(hunt: A, n: int, x: float) -> int:
    """Store the functions evaluated at an inner point, x after the beginning of the step [s]."""
    at, out, i = N_HEAD, N_HEAD + N_COLUMNS * n, int(hunt[INSIDE])
    hunt[PLACES + i], hunt[INSIDE] = x, float(i + 1)
    for k in range(n):
        g, d = taken_for(hunt, n, k, x), hunt[out + n + k]
        if hunt[at + ASLEEP * n + k] > 0.0:
            g += max(0.0, _UNCORRECTED * hunt[at + MEASURE * n + k] - hunt[at + ASLEEP * n + k])
        hunt[at + (G_INSIDE + i) * n + k], hunt[at + (D_INSIDE + i) * n + k] = g, d
        if is_finite(d) == 1 and hunt[at + OF_FORCES * n + k] == 0.0:
            hunt[at + STEEPEST * n + k] = max(hunt[at + STEEPEST * n + k], abs(d))
    return 0


@plain
def value_at(hunt: A, n: int, k: int, i: int) -> float:
    """Return g at point i of the whole step: 0 for its beginning, then inner points, then its end."""
    count = int(hunt[INSIDE])
    column = G_START if i == 0 else G_END if i > count else G_INSIDE + i - 1
    return float(hunt[N_HEAD + column * n + k])


@plain
def slope_at(hunt: A, n: int, k: int, i: int) -> float:
    """Return g' at such a point."""
    count = int(hunt[INSIDE])
    column = D_START if i == 0 else D_END if i > count else D_INSIDE + i - 1
    return float(hunt[N_HEAD + column * n + k])


@plain
def time_of(hunt: A, i: int) -> float:
    """Return the time of such a point from the beginning of the step [s]."""
    count = int(hunt[INSIDE])
    return float(0.0 if i == 0 else hunt[WHOLE] if i > count else hunt[PLACES + i - 1])


@plain
def spread_points(hunt: A) -> int:
    """Set the weights of the points of a step in the polynomial through all of them."""
    last = int(hunt[INSIDE]) + 1
    for i in range(last + 1):
        product = 1.0
        for j in range(last + 1):
            if j != i:
                product *= (time_of(hunt, i) - time_of(hunt, j)) / hunt[WHOLE]
        hunt[SPREAD + i] = product
    return 0


@plain
def difference_at(hunt: A, n: int, k: int, i: int) -> float:
    """Return the slope at a point of the polynomial through the values at all of them."""
    total = 0.0
    for j in range(int(hunt[INSIDE]) + 2):
        if j != i:
            rise = (value_at(hunt, n, k, j) - value_at(hunt, n, k, i)) / (time_of(hunt, i) - time_of(hunt, j))
            total += hunt[SPREAD + i] / hunt[SPREAD + j] * rise
    return total


@plain
def slopes_of_forces(hunt: A, n: int) -> int:
    """Set slopes of functions of forces by differences, at all points of a step.

    After an event the rate of a force is not known otherwise.
    """
    at, last = N_HEAD, int(hunt[INSIDE]) + 1
    spread_points(hunt)
    for k in range(n):
        if hunt[at + OF_FORCES * n + k] != 0.0:
            for i in range(last + 1):
                column = D_START if i == 0 else D_END if i == last else D_INSIDE + i - 1
                d = difference_at(hunt, n, k, i)
                hunt[at + column * n + k] = d
                if is_finite(d) == 1 and not (MARGINS and hunt[at + MARGIN * n + k] != 0.0):  # whose own are learnt
                    hunt[at + STEEPEST * n + k] = max(hunt[at + STEEPEST * n + k], abs(d))
            hunt[at + D_LOW * n + k], hunt[at + D_HIGH * n + k] = hunt[at + D_START * n + k], hunt[at + D_END * n + k]
    return 0


@plain
def slope_between(hunt: A, n: int, k: int, x: float, otherwise: float) -> float:
    """Return the slope of a function of forces at a time x of the step, from those at its points."""
    if hunt[INSIDE] == 0.0 or hunt[N_HEAD + OF_FORCES * n + k] == 0.0:
        return otherwise
    i = 0
    while i < int(hunt[INSIDE]) and time_of(hunt, i + 1) < x:
        i += 1
    share = (x - time_of(hunt, i)) / (time_of(hunt, i + 1) - time_of(hunt, i))
    return float((1.0 - share) * slope_at(hunt, n, k, i) + share * slope_at(hunt, n, k, i + 1))
