"""Coordinates whose forces have bounds: dry friction, stops, or both, on joints, closing pins, ropes and floors."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from benchmarks.bounded.tree import Moving, Point, State

Measure = Callable[[State], Moving]


@dataclass(frozen=True, eq=False)
class Bounded:
    """A coordinate.

    Attributes
    ----------
    name : str
        Of the joint or the section.
    of : callable
        Its value and rates in a state.
    sliding, static : float
        Bounds of dry friction in motion and at rest [N or N m].
    viscous : float
        Force over rate.
    lower, upper : float
        Stops [m or rad]; infinite where there is none.
    restitution : float
        Of the stops.
    pieces : tuple of callable
        Coordinates of which the largest counts, for one with a corner; `of` is the first of them.
    """

    name: str
    of: Measure
    sliding: float = 0.0
    static: float = 0.0
    viscous: float = 0.0
    lower: float = -math.inf
    upper: float = math.inf
    restitution: float = 0.0
    pieces: tuple[Measure, ...] = ()

    @property
    def rubs(self) -> bool:
        """Whether it has dry friction."""
        return self.static > 0.0


def joint(k: int) -> Measure:
    """Return the coordinate of a joint of the tree."""

    def of(state: State) -> Moving:
        slopes = np.zeros(len(state.u))
        slopes[k] = 1.0
        return Moving(np.asarray(state.u[k]), slopes, np.asarray(0.0))

    return of


def angle(factors: dict[int, float], offset: float) -> Measure:
    """Return a sum of coordinates with an offset: the angle of a pin that closes a loop in the plane."""

    def of(state: State) -> Moving:
        slopes = np.zeros(len(state.u))
        for k, factor in factors.items():
            slopes[k] = factor
        return Moving(np.asarray(slopes @ state.u + offset), slopes, np.asarray(0.0))

    return of


def rope(first: Point, second: Point, length: float, growth: float = 0.0) -> Measure:
    """Return what is left of a rope of ``length + growth t`` between two points."""

    def of(state: State) -> Moving:
        d = state.distance(first, second)
        return Moving(length + growth * state.t - d.value, -d.slopes, -d.bias, growth)

    return of


def height(point: Point, direction: np.ndarray, level: float, growth: float = 0.0) -> Measure:
    """Return the height of a point over a floor at ``level + growth t``."""

    def of(state: State) -> Moving:
        d = state.point(point)
        value = np.asarray(direction @ d.value - level - growth * state.t)
        return Moving(value, direction @ d.slopes, np.asarray(direction @ d.bias), -growth)

    return of
