"""Frames of interfaces, which modal bodies carry: place + shape m from the centre of mass, turned by turn m.

In the plane the turn is an angle. In space it is the rotation of the Euler parameters (1, p) over their length, with p
half of the turn: R = 1 + f (p~ + p~ p~) with f = 2 / (1 + p.p), and the angular velocity f (p' - p x p') in axes of the
interface. Turns are small where linear modes hold, so that any rotation of this first order would do; this one is exact
as a rotation and has no singularity.

An interface has no velocities of the state. Its own, those of its frame, are combinations of its body's: `columns`,
with what they are at v' = 0: `biases`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from symgen.derive.formulate.vector_algebra import PlaneVectors, Triple, Vectors
from symgen.describe.modal_body import CarriedInterface, Numbers

if TYPE_CHECKING:
    from symgen.derive.formulate.measure_nodes import ModelNodes


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


def _field(model: ModelNodes, factors: list[int], parts: tuple[Numbers, ...], start: Numbers) -> list[int]:
    """Return the nodes of a constant vector and of a combination of one for each mode."""
    g = model.graph
    return [
        g.sum_of([g.constant(x), *(g.mul(f, g.constant(part[a])) for f, part in zip(factors, parts, strict=True))])
        for a, x in enumerate(start)
    ]


def _columns(model: ModelNodes, parts: Sequence[tuple[int, tuple[int, ...]]], size: int) -> list[dict[int, int]]:
    """Return the rows of a matrix that is given by its columns: index of a velocity, and entries."""
    return [{i: column[a] for i, column in parts if column[a] != model.graph.zero} for a in range(size)]


def _in_plane(model: ModelNodes, carried: CarriedInterface) -> InterfaceFrame:
    g, v = model.graph, PlaneVectors(model.graph)
    first, (m, rates) = model.first[carried.host], model.modes(carried.host)
    x, y, c, s, vx, vy, w = model.frame_inputs(carried.host)
    arm = v.rotate((c, s), v.pair(_field(model, m, carried.shape, carried.place)))
    speed = v.rotate((c, s), v.pair(_field(model, rates, carried.shape, (0.0, 0.0))))
    turns = [g.constant(turn) for (turn,) in carried.turn]
    angle = g.add(model.names[f"{carried.host}.theta"], g.dot(turns, m))
    bias = v.sub(v.scale(g.mul(g.constant(2.0), w), v.perp(speed)), v.scale(g.mul(w, w), arm))
    shapes = [v.rotate((c, s), (g.constant(a), g.constant(b))) for a, b in carried.shape]
    moving = [(first, (g.one, g.zero)), (first + 1, (g.zero, g.one)), (first + 2, v.perp(arm))]
    moving += [(first + 3 + i, shape) for i, shape in enumerate(shapes)]
    turning = {first + 2: g.one} | {first + 3 + i: turn for i, turn in enumerate(turns) if turn != g.zero}
    velocity = v.add((vx, vy), v.add(v.scale(w, v.perp(arm)), speed))
    slots = (
        *v.add((x, y), arm),
        *(g.call("cos", angle), g.call("sin", angle)),
        *velocity,
        g.add(w, g.dot(turns, rates)),
    )
    return InterfaceFrame(slots, (*_columns(model, moving, 2), turning), (*bias, g.zero), angle)


def _in_space(model: ModelNodes, carried: CarriedInterface) -> InterfaceFrame:
    g, v = model.graph, Vectors(model.graph)
    first, (m, rates) = model.first[carried.host], model.modes(carried.host)
    host = model.frame_inputs(carried.host)
    origin, velocity, omega = v.triple(host[:3]), v.triple(host[12:15]), v.triple(host[15:])
    axes = v.triple(host[3:6]), v.triple(host[6:9]), v.triple(host[9:12])
    arm = v.triple(_field(model, m, carried.shape, carried.place))
    speed = v.triple(_field(model, rates, carried.shape, (0.0,) * 3))
    # the origin: A (w x a + a'), and at w' = 0, m'' = 0 its rate A (w x (w x a + a') + w x a')
    within = v.add(v.cross(omega, arm), speed)
    bias = v.matrix_times(axes, v.add(v.cross(omega, within), v.cross(omega, speed)))
    moving = [(first + a, unit) for a, unit in enumerate(v.units)]
    moving += [(first + 3 + a, v.matrix_times(axes, v.cross(unit, arm))) for a, unit in enumerate(v.units)]
    for i, (a, b, c) in enumerate(carried.shape):
        moving.append((first + 6 + i, v.matrix_times(axes, (g.constant(a), g.constant(b), g.constant(c)))))
    # the axes: those of the body, turned by R; in axes of the interface w_i = R^T w + f (p' - p x p')
    halves = [v.triple([g.constant(0.5 * turn) for turn in turns]) for turns in carried.turn]
    p = v.triple(_field(model, m, tuple(tuple(0.5 * x for x in turns) for turns in carried.turn), (0.0,) * 3))
    dp = v.triple(_field(model, rates, tuple(tuple(0.5 * x for x in turns) for turns in carried.turn), (0.0,) * 3))
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
