"""Markers and measures: the geometric quantities out of which joints, drivers, forces and outputs are made.

A *measure* is a scalar s(q) between bodies. A joint is a list of measures held at a value, a force is an effort along a
measure (generalised force J_s^T F, J_s the row with s' = J_s v), a joint coordinate is a measure that is reported.
Nothing here computes: the derivation of value, row and quadratic velocity term of each measure is `symgen.formulate`'s.
"""

from __future__ import annotations

import msgspec

from symgen.vocabulary.expressions import ONE, ZERO, Expr

#: Name of the body that does not move.
GROUND = "ground"


class Marker(msgspec.Struct, frozen=True):
    """A point fixed in `body`: coordinates in the body frame (ground: in the ground frame) [m]."""

    body: str
    point: tuple[Expr, Expr]


class Direction(msgspec.Struct, frozen=True):
    """A vector of length 1 fixed in `body` (ground: in the ground frame)."""

    body: str
    vector: tuple[Expr, Expr]


X_AXIS = Direction(GROUND, (ONE, ZERO))
Y_AXIS = Direction(GROUND, (ZERO, ONE))


class Component(msgspec.Struct, frozen=True, tag="component"):
    """s = e . (r_b - r_a): component along `along` of the vector from marker `a` to marker `b` [m]."""

    a: Marker
    b: Marker
    along: Direction


class Distance(msgspec.Struct, frozen=True, tag="distance"):
    """s = |r_b - r_a| [m]; singular where the markers meet."""

    a: Marker
    b: Marker


class LinkStretch(msgspec.Struct, frozen=True, tag="link-stretch"):
    """s = (|r_b - r_a|^2 - L^2) / (2 L) [m]: zero, with unit gradient, where the distance is `length`."""

    a: Marker
    b: Marker
    length: Expr


class Angle(msgspec.Struct, frozen=True, tag="angle"):
    """s = theta_b - theta_a [rad], turns counted."""

    a: str
    b: str


class Sum(msgspec.Struct, frozen=True, tag="sum"):
    """s = sum of coefficient times measure."""

    terms: tuple[tuple[Expr, Measure], ...]


Measure = Component | Distance | LinkStretch | Angle | Sum


class Holonomic(msgspec.Struct, frozen=True, tag="holonomic"):
    """One row Phi = s - value(t, parameters); `label` ends the multiplier's name (``JOINT.label``)."""

    label: str
    measure: Measure
    value: Expr = ZERO
    unit: str = "m"


class Nonholonomic(msgspec.Struct, frozen=True, tag="nonholonomic"):
    """One row e . v_P = value(t, parameters): velocity of marker `at` along the body-fixed direction `along` [m/s]."""

    label: str
    at: Marker
    along: Direction
    value: Expr = ZERO
    unit: str = "m/s"


Row = Holonomic | Nonholonomic


class Effort(msgspec.Struct, frozen=True):
    """A force along a measure: generalised force J_s^T (-dU/ds + F).

    In `potential` the placeholder ``s`` is the measure's value; in `magnitude` ``s`` and ``rate`` (its rate s') may be
    used besides t, parameters and body coordinates and velocities. `potential` [J] may use ``s`` and parameters only.
    """

    label: str
    measure: Measure
    magnitude: Expr = ZERO
    potential: Expr = ZERO
