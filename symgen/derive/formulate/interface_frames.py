"""Frames of interfaces, which modal bodies carry: place + shape m from the centre of mass, turned by turn m.

In the plane the turn is an angle. In space it is the rotation of the Euler parameters (1, p) over their length, with p
half of the turn: R = 1 + f (p~ + p~ p~) with f = 2 / (1 + p.p), and the angular velocity f (p' - p x p') in axes of the
interface. Turns are small where linear modes hold, so that any rotation of this first order would do; this one is exact
as a rotation and has no singularity.

Where loads stiffen the body, place and turn are of second order in m, with the first derivatives `_Motion.columns`.

An interface has no velocities of the state. Its own, those of its frame, are combinations of its body's: `columns`,
with what they are at v' = 0: `biases`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from symgen.derive.formulate.vector_algebra import PlaneVectors, Triple, Vectors
from symgen.describe.modal_body import CarriedInterface, Numbers

if TYPE_CHECKING:
    from symgen.derive.formulate.measure_nodes import ModelNodes

#: Factors of products of coordinates of modes.
_Curve = tuple[tuple[Numbers, ...], ...]


@dataclass(frozen=True)
class InterfaceFrame:
    """The frame of an interface.

    Attributes
    ----------
    slots : tuple of int
        Nodes of the frame in a kernel.
    columns : tuple of dict
        Of each of its velocities, index of a velocity of the state -> factor.
    biases : tuple of int
        Of each of its velocities, the rate at v' = 0.
    angle : int
        Its angle in the plane.
    """

    slots: tuple[int, ...]
    columns: tuple[dict[int, int], ...]
    biases: tuple[int, ...]
    angle: int = 0


def interface_frame(model: ModelNodes, carried: CarriedInterface) -> InterfaceFrame:
    """Return the frame of an interface."""
    return _in_space(model, carried) if model.spatial else _in_plane(model, carried)


class _Motion(NamedTuple):
    """Place or turn of an interface in its body, as functions of the coordinates of modes: nodes of vectors.

    Attributes
    ----------
    value, rate : list of int
        The vector and its rate.
    columns : tuple of list of int
        Its derivatives by the coordinates.
    bias : list of int
        Its second derivative at m'' = 0.
    """

    value: list[int]
    rate: list[int]
    columns: tuple[list[int], ...]
    bias: list[int]


def _motion(
    model: ModelNodes, host: str, start: Numbers, parts: tuple[Numbers, ...], curve: _Curve, factor: float = 1.0
) -> _Motion:
    """Return the motion start + (parts m + m . curve m) factor."""
    g, (m, rates), size = model.graph, model.modes(host), range(len(start))

    def combined(factors: list[int], vectors: Sequence[Sequence[int]], first: Numbers) -> list[int]:
        terms = list(zip(factors, vectors, strict=True))
        return [g.sum_of([g.constant(first[a]), *(g.mul(f, vector[a]) for f, vector in terms)]) for a in size]

    nothing = (0.0,) * len(start)
    linear = tuple([g.constant(factor * part[a]) for a in size] for part in parts)
    if not curve:
        return _Motion(combined(m, linear, start), combined(rates, linear, nothing), linear, [g.zero] * len(start))
    bent = [[[g.constant(factor * x) for x in part] for part in own] for own in curve]
    halves = [combined(m, own, nothing) for own in bent]
    doubled = [combined(rates, own, nothing) for own in bent]
    two = g.constant(2.0)
    secants = tuple([g.add(x, y) for x, y in zip(a, b, strict=True)] for a, b in zip(linear, halves, strict=True))
    columns = tuple(
        [g.add(x, g.mul(two, y)) for x, y in zip(a, b, strict=True)] for a, b in zip(linear, halves, strict=True)
    )
    bias = [g.mul(two, x) for x in combined(rates, doubled, nothing)]
    return _Motion(combined(m, secants, start), combined(rates, columns, nothing), columns, bias)


def _columns(model: ModelNodes, parts: Sequence[tuple[int, tuple[int, ...]]], size: int) -> list[dict[int, int]]:
    """Return the rows of a matrix that is given by its columns: index of a velocity, and entries."""
    return [{i: column[a] for i, column in parts if column[a] != model.graph.zero} for a in range(size)]


def _in_plane(model: ModelNodes, carried: CarriedInterface) -> InterfaceFrame:
    g, v = model.graph, PlaneVectors(model.graph)
    first = model.first[carried.host]
    x, y, c, s, vx, vy, w = model.frame_inputs(carried.host)
    place = _motion(model, carried.host, carried.place, carried.shape, carried.curve)
    turning_by = _motion(model, carried.host, (0.0,), carried.turn, carried.twist)
    arm = v.rotate((c, s), v.pair(place.value))
    speed = v.rotate((c, s), v.pair(place.rate))
    turns = [turn for (turn,) in turning_by.columns]
    angle = g.add(model.names[f"{carried.host}.theta"], *turning_by.value)
    bias = v.sub(v.scale(g.mul(g.constant(2.0), w), v.perp(speed)), v.scale(g.mul(w, w), arm))
    if carried.curve:
        bias = v.add(bias, v.rotate((c, s), v.pair(place.bias)))
    shapes = [v.rotate((c, s), v.pair(column)) for column in place.columns]
    moving = [(first, (g.one, g.zero)), (first + 1, (g.zero, g.one)), (first + 2, v.perp(arm))]
    moving += [(first + 3 + i, shape) for i, shape in enumerate(shapes)]
    turning = {first + 2: g.one} | {first + 3 + i: turn for i, turn in enumerate(turns) if turn != g.zero}
    velocity = v.add((vx, vy), v.add(v.scale(w, v.perp(arm)), speed))
    slots = (
        *v.add((x, y), arm),
        *(g.call("cos", angle), g.call("sin", angle)),
        *velocity,
        g.add(w, *turning_by.rate),
    )
    return InterfaceFrame(slots, (*_columns(model, moving, 2), turning), (*bias, *turning_by.bias), angle)


def _in_space(model: ModelNodes, carried: CarriedInterface) -> InterfaceFrame:
    g, v = model.graph, Vectors(model.graph)
    first = model.first[carried.host]
    host = model.frame_inputs(carried.host)
    origin, velocity, omega = v.triple(host[:3]), v.triple(host[12:15]), v.triple(host[15:])
    axes = v.triple(host[3:6]), v.triple(host[6:9]), v.triple(host[9:12])
    place = _motion(model, carried.host, carried.place, carried.shape, carried.curve)
    arm, speed = v.triple(place.value), v.triple(place.rate)
    # the origin: A (w x a + a'), and at w' = 0, m'' = 0 its rate A (w x (w x a + a') + w x a')
    within = v.add(v.cross(omega, arm), speed)
    bias = v.matrix_times(axes, v.add(v.cross(omega, within), v.add(v.cross(omega, speed), v.triple(place.bias))))
    moving = [(first + a, unit) for a, unit in enumerate(v.units)]
    moving += [(first + 3 + a, v.matrix_times(axes, v.cross(unit, arm))) for a, unit in enumerate(v.units)]
    for i, column in enumerate(place.columns):
        moving.append((first + 6 + i, v.matrix_times(axes, v.triple(column))))
    # the axes: those of the body, turned by R; in axes of the interface w_i = R^T w + f (p' - p x p')
    half = _motion(model, carried.host, (0.0,) * 3, carried.turn, carried.twist, 0.5)
    halves = [v.triple(column) for column in half.columns]
    p, dp = v.triple(half.value), v.triple(half.rate)
    factor = g.div(g.constant(2.0), g.add(g.one, v.dot(p, p)))

    def turned(x: Triple, way: float) -> Triple:
        """Return R x, or R^T x with way -1."""
        once = v.cross(p, x)
        return v.add(x, v.scale(factor, v.add(v.scale(g.constant(way), once), v.cross(p, once))))

    def spun(x: Triple) -> Triple:
        return v.scale(factor, v.sub(x, v.cross(p, x)))

    back, spin = turned(omega, -1.0), spun(dp)
    # the rate of w_i at w' = 0, m'' = 0: (R^T)' w = -spin x R^T w, and f' = -f^2 p.p' of the second part
    slower = g.neg(g.mul(factor, v.dot(p, dp)))
    gain = v.sub(v.scale(slower, spin), v.cross(spin, back))
    if carried.twist:
        gain = v.add(gain, spun(v.triple(half.bias)))
    turning = [(first + 3 + a, turned(unit, -1.0)) for a, unit in enumerate(v.units)]
    turning += [(first + 6 + i, spun(half)) for i, half in enumerate(halves)]
    relative = v.transpose(tuple(turned(unit, 1.0) for unit in v.units))  # type: ignore[arg-type]  # three columns
    slots = (
        *v.add(origin, v.matrix_times(axes, arm)),
        *(entry for row in v.product(axes, relative) for entry in row),
        *v.add(velocity, v.matrix_times(axes, within)),
        *v.add(back, spin),
    )
    return InterfaceFrame(slots, (*_columns(model, moving, 3), *_columns(model, turning, 3)), (*bias, *gain))
