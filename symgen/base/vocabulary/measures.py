"""Markers and measures: the geometric quantities out of which joints, drivers, forces and outputs are made.

A *measure* is a scalar s(q) between bodies. A joint is a list of measures held at a value, a force is an effort along a
measure (generalised force J_s^T F, J_s the row with s' = J_s v), a joint coordinate is a measure that is reported.
Nothing here computes: the derivation of value, row and quadratic velocity term of each measure is
`symgen.derive.formulate`'s.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import msgspec

from symgen.base.vocabulary.expressions import ONE, ZERO, Expr

#: Name of the body that does not move.
GROUND = "ground"


class Marker(msgspec.Struct, frozen=True):
    """A point fixed in `body`: two or three coordinates in the body frame (ground: in the ground frame) [m]."""

    body: str
    point: tuple[Expr, ...]


class Direction(msgspec.Struct, frozen=True):
    """A vector of length 1 fixed in `body` (ground: in the ground frame)."""

    body: str
    vector: tuple[Expr, ...]


def nested_parts(value: object, whole: tuple[type, ...] = ()) -> Iterator[Any]:
    """Yield a value of the vocabulary and everything inside it, each before its parts; types in `whole` have none."""
    waiting: list[object] = [value]
    while waiting:  # a stack: generators within generators take several times as long
        each = waiting.pop()
        yield each
        if isinstance(each, whole):
            continue
        if isinstance(each, msgspec.Struct):
            waiting += msgspec.structs.astuple(each)[::-1]
        elif isinstance(each, tuple):
            waiting += each[::-1]


def markers_in(value: object) -> Iterator[Marker]:
    """Yield the markers in a value of the vocabulary, in order."""
    return (part for part in nested_parts(value, (Marker,)) if isinstance(part, Marker))


def axes(body: str, dimension: int) -> tuple[Direction, ...]:
    """Return the axes of a body's frame, two in the plane, three in space."""
    return tuple(Direction(body, tuple(ONE if i == j else ZERO for j in range(dimension))) for i in range(dimension))


class Component(msgspec.Struct, frozen=True, tag="component"):
    """s = e . (r_b - r_a): component along `along` of the vector from marker `a` to marker `b` [m]."""

    a: Marker
    b: Marker
    along: Direction


class Distance(msgspec.Struct, frozen=True, tag="distance"):
    """``s = |r_b - r_a|`` [m]; singular where the markers meet."""

    a: Marker
    b: Marker


class HalfSquare(msgspec.Struct, frozen=True, tag="half-square"):
    """``s = |r_b - r_a|^2 / 2`` [m^2]: smooth where the markers meet."""

    a: Marker
    b: Marker


class LinkStretch(msgspec.Struct, frozen=True, tag="link-stretch"):
    """``s = (|r_b - r_a|^2 - L^2) / (2 L)`` [m]: zero, with unit gradient, where the distance is `length`."""

    a: Marker
    b: Marker
    length: Expr


class Angle(msgspec.Struct, frozen=True, tag="angle"):
    """s = theta_b - theta_a [rad], turns counted."""

    a: str
    b: str


class Dot(msgspec.Struct, frozen=True, tag="dot"):
    """s = u . v of two directions in space: 0 where they are perpendicular."""

    u: Direction
    v: Direction


class Turn(msgspec.Struct, frozen=True, tag="turn"):
    """Angle in space from direction `zero` to `pointer` about the axis zero x quarter [rad], turns counted.

    ``s = atan2(pointer . quarter, pointer . zero)``, continued over whole turns; `zero` and `quarter` are perpendicular
    and belong to one body. Singular where `pointer` is parallel to the axis.
    """

    zero: Direction
    quarter: Direction
    pointer: Direction


class Spin(msgspec.Struct, frozen=True, tag="spin"):
    """Component of the angular velocity of `b` relative to `a` along a direction [rad/s]: a rate without a value.

    Torques in space act on it; as a measure its value is 0.
    """

    a: str
    b: str
    along: Direction


class Bearing(msgspec.Struct, frozen=True, tag="bearing"):
    """Angle in space of the vector from marker `a` to marker `b` about the axis zero x quarter [rad], turns counted.

    ``s = atan2((r_b - r_a) . quarter, (r_b - r_a) . zero)``, continued over whole turns; `zero` and `quarter` are
    perpendicular and belong to the body of `a`. Singular where `b` lies on the axis through `a`.
    """

    a: Marker
    b: Marker
    zero: Direction
    quarter: Direction


class Swing(Bearing, frozen=True, tag="swing"):
    """A bearing whose markers may meet: nearer than `least` [m] it has the rate of a vector with this length."""

    least: Expr


class RimHeight(msgspec.Struct, frozen=True, tag="rim-height"):
    """s = n . (c - p) - R sqrt(1 - (n . k)^2) [m]: height of a thin disc's lowest point over a plane.

    Singular where the disc lies flat.
    """

    plane: Marker
    normal: Direction
    centre: Marker
    axis: Direction
    radius: Expr


class Sum(msgspec.Struct, frozen=True, tag="sum"):
    """s = sum of coefficient times measure."""

    terms: tuple[tuple[Expr, Measure], ...]


class FormulaMeasure(msgspec.Struct, frozen=True, tag="formula"):
    """s = a formula of t, parameters, coordinates of bodies and values of measures."""

    of: Expr


class ChainPiece(msgspec.Struct, frozen=True):
    """A segment or an arc of a chain: its start, its direction there, its curvature, its length, and the way before it.

    The curvature [1/m] is above 0 where the piece turns to the right, 0 of a segment. Points and directions are in the
    frame of the chain's body. A marker on the right of the piece belongs to it down to `depth` [m].
    """

    start: tuple[Expr, Expr]
    along: tuple[Expr, Expr]
    curvature: Expr
    length: Expr
    depth: Expr
    before: Expr


class Chain(msgspec.Struct, frozen=True):
    """A smooth curve of a body, of segments and arcs, and a marker on its left.

    Parameters
    ----------
    origin, centre : Marker
        The origin of the frame of the chain's body, and the marker.
    pieces : tuple of ChainPiece
        Each begins where the one before it ends, with its direction.
    closed : bool
        Whether the last piece ends where the first one begins; otherwise these two are half circles.
    hollow : bool
        Whether a piece turns to the left, so that a marker may be beside several, of which the nearest counts.
    sharp : bool
        Whether it has edges in place of corners, within which a marker that passes them turns.
    leaving : tuple of pairs
        Of each piece the ways at the ends of the stretch within which it leaves the curve, equal where it does not;
        empty where none does.
    """

    origin: Marker
    centre: Marker
    pieces: tuple[ChainPiece, ...]
    closed: bool
    hollow: bool
    sharp: bool = False
    leaving: tuple[tuple[Expr, Expr], ...] = ()


class OnChain(msgspec.Struct, frozen=True, tag="on-chain"):
    """A quantity of the marker of a chain: ``gap`` or ``way`` along it [m], ``junction``, 0 where pieces meet [m]."""

    chain: Chain
    quantity: str


class Lap(msgspec.Struct, frozen=True, tag="lap"):
    """The way of the marker of a closed chain along it [m], laps counted."""

    chain: Chain


class Wrapped(msgspec.Struct, frozen=True, tag="wrapped"):
    """s = a measure and as many periods as bring it next to its latest value, at first next to 0."""

    of: Measure
    period: Expr


class PieceNumber(msgspec.Struct, frozen=True, tag="piece-number"):
    """s = a number of the piece of a chain that its marker belongs to: it jumps where the marker passes to another."""

    chain: Chain
    number: str


#: Angles that are periodic, so that their turns must be counted.
Turning = Turn | Bearing
#: These, ways round closed chains, and measures that go on over periods.
Periodic = Turning | Lap | Wrapped
#: All angles.
AnyAngle = Angle | Turn | Bearing
Measure = (
    Component
    | Distance
    | HalfSquare
    | LinkStretch
    | Angle
    | Dot
    | Turn
    | Bearing
    | Spin
    | RimHeight
    | Sum
    | FormulaMeasure
    | OnChain
    | Lap
    | Wrapped
    | PieceNumber
)


class PointSpeed(msgspec.Struct, frozen=True, tag="point-speed"):
    """Velocity of marker `at` along a body-fixed direction, e . v_P [m/s]."""

    at: Marker
    along: Direction


class RollingSpeed(msgspec.Struct, frozen=True, tag="rolling-speed"):
    """Velocity along a direction of a plane of the material point that touches the plane, against the plane [m/s].

    ``e . (v_c + omega x r)`` with ``r = -R n`` for a sphere; for a thin disc with axis k, ``r = -R (n - (n . k) k) /
    sqrt(1 - (n . k)^2)``. Velocities are those against the body of the directions.
    """

    centre: Marker
    along: Direction
    normal: Direction
    radius: Expr
    axis: Direction | None = None


class SphereSlip(msgspec.Struct, frozen=True, tag="sphere-slip"):
    """Velocity of a sphere about `b` along the surface of a sphere about `a`, where they touch [m/s].

    ``t . (v_b - v_a - omega_b x r_b n - omega_a x r_a n)`` with ``n = side (b - a) / |b - a|``; `side` is -1 and one
    radius below 0 where one sphere is hollow. ``t = e - (e . n) / (1 + z . n) (z + n)`` is `along` e, turned with n
    from `zero` z, across it; both belong to the ground. Singular where n is opposite to z.
    """

    a: Marker
    b: Marker
    zero: Direction
    along: Direction
    radii: tuple[Expr, Expr]
    side: Expr


class BladeSpeed(msgspec.Struct, frozen=True, tag="blade-speed"):
    """Velocity of marker `at` of a body across its blade, in a plane of the ground [m/s].

    ``v_P . (n x d) / |n x d|`` with the plane's normal n and the direction d of the blade, fixed in the body: to the
    left of the blade, seen from the normal's tip. Singular where the blade stands on end.
    """

    at: Marker
    normal: Direction
    blade: Direction


class FormulaSpeed(msgspec.Struct, frozen=True, tag="formula-speed"):
    """A formula of t, parameters, coordinates of bodies, measures, and rates of these, in which it is linear."""

    of: Expr


Speed = PointSpeed | RollingSpeed | SphereSlip | BladeSpeed | FormulaSpeed


class Holonomic(msgspec.Struct, frozen=True, tag="holonomic"):
    """One row Phi = s - value(t, parameters); `label` ends the multiplier's name (``JOINT.label``)."""

    label: str
    measure: Measure
    value: Expr = ZERO
    unit: str = "m"


class StiffHolonomic(Holonomic, frozen=True, kw_only=True, tag="stiff-holonomic"):
    """A row with a stiffness [N/m], by which redundant rows share a load; the row does not give."""

    stiffness: Expr


class Nonholonomic(msgspec.Struct, frozen=True, tag="nonholonomic"):
    """One row u = value(t, parameters) on a velocity u = J v that is no rate of a measure."""

    label: str
    speed: Speed
    value: Expr = ZERO
    unit: str = "m/s"


Row = Holonomic | StiffHolonomic | Nonholonomic


class Effort(msgspec.Struct, frozen=True):
    """A force along a measure: generalised force J_s^T (-dU/ds + F).

    The measure may be a velocity without a value (`Spin`, `Speed`), which has no potential and no ``s``.
    In `potential` the placeholder ``s`` is the measure's value; in `magnitude` ``s`` and ``rate`` (its rate s') may be
    used besides t, parameters and body coordinates and velocities. `potential` [J] may use ``s`` and parameters only.
    """

    label: str
    measure: Measure | Speed
    magnitude: Expr = ZERO
    potential: Expr = ZERO


class Flexure(msgspec.Struct, frozen=True):
    """A beam element between the frames of two sections, elastic and damped.

    With H_a and H_b the frames, psi = log(H_a^-1 H_b) is the element's deformation: length and shear displacements [m],
    then in the plane its bend, in space twist and two bends [rad]. Its potential is ``d^T F^-1 d / 2`` with
    ``d = psi - rest`` and ``F = h C + h/12 ad_psi C ad_psi^T``, its damping force ``-damping F^-1 psi'``; with a time
    for each strain it is ``-F^-1 F_T F^-1 psi'``, where F_T is F with C times these times.

    `measures` are what psi is a function of, with e_i the axes of the frames and r the vector between their origins: in
    the plane (e_i of a + e_i of b) . r of both axes and the bend; in space those of all axes, twice the axial vector of
    the relative rotation and its trace. `compliances` is the diagonal of C in the order of psi, `turn` what the bend is
    beyond the measure of it.
    """

    measures: tuple[Measure, ...]
    length: Expr
    compliances: tuple[Expr, ...]
    rest: tuple[Expr, ...]
    damping: Expr | tuple[Expr, ...] = ZERO  # a time, or a time for each strain in the order of psi
    turn: Expr = ZERO


class Flexed(msgspec.Struct, frozen=True, tag="flexed"):
    """A component of the strain in the middle of a beam element, or with `stress` of the force and moment there."""

    flexure: Flexure
    component: int
    stress: bool = False


class Exerted(msgspec.Struct, frozen=True, tag="exerted"):
    """Sum of efforts: of -dU/ds + F [N, N m], or with `power` of that times s' [W]."""

    efforts: tuple[Effort, ...]
    power: bool = False
    flexures: tuple[Flexure, ...] = ()


class Driven(msgspec.Struct, frozen=True, tag="driven"):
    """Effort of a row's driver along its measure: -lambda [N, N m], or with `power` that times s' [W]."""

    row: str
    measure: Measure
    power: bool = False


class Carrying(msgspec.Struct, frozen=True, tag="carrying"):
    """Sum of the bounds at rest of the rows that a row in force carries beside its own force [N].

    With `share`, of a row that another one carries: what the carrier exerts, over its own bound with this sum; else 0.
    """

    row: str
    share: bool = False


class Integral(msgspec.Struct, frozen=True, tag="integral"):
    """The integral over time, from the start of the run, of a formula of outputs."""

    of: Expr


#: Sources of readings.
Source = Measure | Speed | Exerted | Driven | Carrying | Integral | Flexed
