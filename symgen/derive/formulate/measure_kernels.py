"""One kernel per kind of measure: value, row and quadratic velocity term, derived once and used for every occurrence.

For a measure s(q): s' = J v and s'' = J v' + b. The kernel gives s, the entries of J by body, and b. A velocity measure
u(q, v) = J v (nonholonomic rows) gives J and b of u' = J v' + b. The key of a kernel includes which slots share a body,
so that a direction fixed in the body of a marker is differentiated together with it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import sympy as sp

from symgen.base.ir.graph import Graph
from symgen.derive.formulate.frames import (
    FrameSymbols,
    SpatialFrame,
    cross_product,
    derivative_along_motion,
    frame_of_kind,
)
from symgen.derive.formulate.translate import Translator


@dataclass(frozen=True)
class Kernel:
    """A derived measure: a small graph whose inputs are slots.

    Inputs are ``("slot", i)``: first the frames' slots, frame by frame, then `constants` constants (local points,
    directions, lengths). `row` holds, for each frame, the nodes of its velocity columns.
    """

    graph: Graph
    frames: tuple[FrameSymbols, ...]
    constants: int
    value: int
    row: tuple[tuple[int, ...], ...]
    bias: int

    @property
    def outputs(self) -> tuple[int, ...]:
        """All output nodes: value, row entries frame by frame, bias."""
        return (self.value, *(n for part in self.row for n in part), self.bias)


Frames = tuple[FrameSymbols, ...]
#: Points and directions as tuples of components, lengths as symbols.
Constants = tuple[Any, ...]
_Build = Callable[[Frames, Constants], Any]


def _scalar_product(a: Sequence[Any], b: Sequence[Any]) -> Any:
    total = a[0] * b[0]
    for x, y in zip(a[1:], b[1:], strict=True):
        total = total + x * y
    return total


def _vector_difference(a: Sequence[Any], b: Sequence[Any]) -> tuple[Any, ...]:
    return tuple(x - y for x, y in zip(a, b, strict=True))


def _component(f: Frames, k: Constants) -> Any:
    a, b = f[0].locate(k[0]), f[1].locate(k[1])
    return _scalar_product(f[2].rotate(k[2]), _vector_difference(b, a))


def _squared_distance(f: Frames, k: Constants) -> Any:
    a, b = f[0].locate(k[0]), f[1].locate(k[1])
    return sp.Add(*((x - y) ** 2 for x, y in zip(b, a, strict=True)))


def _distance(f: Frames, k: Constants) -> Any:
    return sp.sqrt(_squared_distance(f, k))


def _half_square(f: Frames, k: Constants) -> Any:
    return _squared_distance(f, k) / 2


def _link_stretch(f: Frames, k: Constants) -> Any:
    return (_squared_distance(f, k) - k[2] ** 2) / (2 * k[2])


def _point_speed(f: Frames, k: Constants) -> Any:
    a = f[0].locate(k[0])
    return _scalar_product(f[1].rotate(k[1]), tuple(derivative_along_motion(x, f[:1]) for x in a))


# -- space only ------------------------------------------------------------------------------------------------------


def _direction_product(f: Frames, k: Constants) -> Any:
    return _scalar_product(f[0].rotate(k[0]), f[1].rotate(k[1]))


def _spin(f: Frames, k: Constants) -> Any:
    """Relative angular velocity along a direction; the velocity of the direction's own body stays in body axes."""
    a, b, along = _spatial_frames(f)
    total = sp.S.Zero
    for body, sign in ((b, 1), (a, -1)):
        if body is along:
            total += sign * _scalar_product(k[0], body.omega)
        elif body.turns:
            total += sign * _scalar_product(along.rotate(k[0]), body.spin())
    return total


def _rim_height(f: Frames, k: Constants) -> Any:
    plane, centre = f[0].locate(k[0]), f[1].locate(k[1])
    normal, axis = f[2].rotate(k[2]), f[3].rotate(k[3])
    return _scalar_product(normal, _vector_difference(centre, plane)) - k[4] * sp.sqrt(
        1 - _scalar_product(normal, axis) ** 2
    )


def _velocity_against(plane: SpatialFrame, body: SpatialFrame, point: Sequence[Any]) -> tuple[Any, Any]:
    """Return the velocity of a point of a body, and its angular velocity, as they are seen from a plane's body."""
    place = body.locate(point)
    velocity, spin = tuple(derivative_along_motion(x, (body,)) for x in place), body.spin()
    if not plane.moves:
        return velocity, spin
    origin = plane.locate((sp.S.Zero,) * 3)
    carried = cross_product(plane.spin(), _vector_difference(place, origin))
    dragged = (derivative_along_motion(x, (plane,)) + y for x, y in zip(origin, carried, strict=True))
    return _vector_difference(velocity, tuple(dragged)), _vector_difference(spin, plane.spin())


def _sphere_speed(f: Frames, k: Constants) -> Any:
    plane, ball = _spatial_frames(f)
    along, normal = plane.rotate(k[1]), plane.rotate(k[2])
    centre, spin = _velocity_against(plane, ball, k[0])
    return _scalar_product(along, centre) - k[3] * _scalar_product(along, cross_product(spin, normal))


def _disc_speed(f: Frames, k: Constants) -> Any:
    plane, disc = _spatial_frames(f)
    along, normal, axis = plane.rotate(k[1]), plane.rotate(k[2]), disc.rotate(k[4])
    lean = _scalar_product(normal, axis)
    down = tuple(lean * a - n for a, n in zip(axis, normal, strict=True))
    centre, spin = _velocity_against(plane, disc, k[0])
    return _scalar_product(along, centre) + k[3] * _scalar_product(along, cross_product(spin, down)) / sp.sqrt(
        1 - lean**2
    )


def _sphere_slip(f: Frames, k: Constants) -> Any:
    one, other, ground = _spatial_frames(f)
    places = one.locate(k[0]), other.locate(k[1])
    apart = _vector_difference(places[1], places[0])
    size = k[6] / sp.sqrt(_scalar_product(apart, apart))
    normal, zero, along = tuple(size * x for x in apart), ground.rotate(k[2]), ground.rotate(k[3])
    lean = _scalar_product(along, normal) / (1 + _scalar_product(zero, normal))
    tangent = tuple(e - lean * (z + n) for e, z, n in zip(along, zero, normal, strict=True))
    total = sp.S.Zero
    for body, place, radius, sign in ((other, places[1], k[5], 1), (one, places[0], k[4], -1)):
        if body.moves:
            total += sign * _scalar_product(tangent, tuple(derivative_along_motion(x, (body,)) for x in place))
        if body.turns:
            total -= radius * _scalar_product(tangent, cross_product(body.spin(), normal))
    return total


def _blade_speed(f: Frames, k: Constants) -> Any:
    ground, body = _spatial_frames(f)
    across = cross_product(ground.rotate(k[1]), body.rotate(k[2]))
    velocity = tuple(derivative_along_motion(x, (body,)) for x in body.locate(k[0]))
    return _scalar_product(across, velocity) / sp.sqrt(_scalar_product(across, across))


def _spatial_frames(f: Frames) -> tuple[SpatialFrame, ...]:
    assert all(isinstance(frame, SpatialFrame) for frame in f), "these measures exist in space only"
    return tuple(frame for frame in f if isinstance(frame, SpatialFrame))


#: Kind -> (expression of frames and constants, number of frames, constants: v for a vector, s for a scalar, whether the
#: expression is a velocity). The fields of a measure supply them: frames of bodies, points and directions; constants of
#: points, directions, then numbers.
_MEASURES: dict[str, tuple[_Build, int, str, bool]] = {
    "component": (_component, 3, "vvv", False),
    "distance": (_distance, 2, "vv", False),
    "half-square": (_half_square, 2, "vv", False),
    "link-stretch": (_link_stretch, 2, "vvs", False),
    "point-speed": (_point_speed, 2, "vv", True),
    "dot": (_direction_product, 2, "vv", False),
    "spin": (_spin, 3, "v", True),
    "rim-height": (_rim_height, 4, "vvvvs", False),
    "sphere-speed": (_sphere_speed, 2, "vvvs", True),
    "disc-speed": (_disc_speed, 2, "vvvsv", True),
    "sphere-slip": (_sphere_slip, 3, "vvvvsss", True),
    "blade-speed": (_blade_speed, 2, "vvv", True),
}


def _factor_by_velocities(bias: Any, frames: Frames) -> Any:
    """Return a sum of products, factored by velocities: what multiplies them are entries of other rows.

    In space it stays as it is: common parts are symbols already.
    """
    if any(isinstance(each, SpatialFrame) for each in frames) or not bias.is_polynomial():
        return bias
    moving = {v for each in frames for v in each.velocities}
    gathered: dict[Any, list[Any]] = {}
    for term in sp.Add.make_args(bias):
        speeds = others = sp.S.One
        for factor in sp.Mul.make_args(term):
            if factor.free_symbols <= moving and not factor.is_number:
                speeds *= factor
            else:
                others *= factor
        gathered.setdefault(speeds, []).append(others)
    return sp.Add(*(sp.Mul(sp.Add(*others), speeds, evaluate=False) for speeds, others in gathered.items()))


@cache
def derive_kernel(kind: str, frames: tuple[tuple[int, str], ...]) -> Kernel:
    """Derive the kernel of a measure.

    Parameters
    ----------
    kind : str
        ``component``, ``distance``, ``half-square``, ``link-stretch``, ``point-speed``; in space also ``dot``,
        ``spin``, ``rim-height``, ``sphere-speed``, ``disc-speed``, ``sphere-slip`` or ``blade-speed``.
    frames : tuple of (slot, kind)
        Frame of the kernel and its kind, for each frame argument of the measure.
    """
    build, count, pattern, is_rate = _MEASURES[kind]
    assert len(frames) == count, "the caller passes one frame for each of the measure's"
    unique = {slot: frame_of_kind(f"f{slot}", frame_kind) for slot, frame_kind in frames}
    ordered = tuple(unique[i] for i in sorted(unique))
    constants: list[Any] = []
    symbols: list[Any] = []
    for letter in pattern:
        size = ordered[0].dimension if letter == "v" else 1
        part = tuple(sp.Symbol(f"k{len(symbols) + i}", real=True) for i in range(size))
        symbols += part
        constants.append(part if letter == "v" else part[0])
    value = build(tuple(unique[slot] for slot, _ in frames), tuple(constants))
    rate = value if is_rate else derivative_along_motion(value, ordered)
    row = tuple(tuple(part.column_entries(rate)) for part in ordered)
    bias = _factor_by_velocities(derivative_along_motion(rate, ordered), ordered)

    graph = Graph()
    nodes_of: dict[Any, int] = {}
    slot = 0
    for body in ordered:
        for name in body.slots:
            nodes_of[body.symbol(name)] = graph.input("slot", slot)
            slot += 1
    for i, symbol in enumerate(symbols):
        nodes_of[symbol] = graph.input("slot", slot + i)
    translator = Translator(graph, nodes_of)
    for body in ordered:
        for symbol, definition in body.definitions.items():
            translator.nodes[symbol] = translator.translate(definition)
    flat = [value, *(e for part in row for e in part), bias]
    nodes = translator.translate_all(flat)
    position = 1
    rows = []
    for body in ordered:
        width = len(body.velocities)
        rows.append(tuple(nodes[position : position + width]))
        position += width
    return Kernel(graph, ordered, len(symbols), nodes[0], tuple(rows), nodes[-1])
