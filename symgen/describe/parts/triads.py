"""Axes of a joint in space: a right-handed triad of directions in each of its two bodies.

The third direction of a triad is the joint's axis. The first ones coincide where the joint's angle is 0: as the bodies
are described to start, unless reference directions are given.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from symgen.base.vocabulary.expressions import (
    ONE,
    ZERO,
    Expr,
    Number,
    call,
    difference,
    literal_of,
    product,
    scalar_product_of,
    sum_of_terms,
    vector_product,
)
from symgen.base.vocabulary.measures import GROUND, Direction
from symgen.base.vocabulary.rotations import rotate, rotate_back, rotation_matrix_of, scalar_product
from symgen.describe.formulas.evaluate import scalar_values
from symgen.describe.formulas.start import euler_parameters
from symgen.describe.mechanism import SpatialBody, Vec
from symgen.describe.parts.fields import value_in_words

if TYPE_CHECKING:
    from symgen.describe.parts.scope import Scope

_Triple = tuple[float, float, float]


@dataclass(frozen=True)
class Triad:
    """Three perpendicular directions of one body; `axis` is the joint's."""

    first: Direction
    second: Direction
    axis: Direction

    @property
    def body(self) -> str:
        """The body."""
        return self.axis.body


def make_triads(
    scope: Scope,
    bodies: tuple[str, str],
    axis: tuple[float | str | tuple[float | str, ...], ...],
    reference: tuple[tuple[float | str, ...], tuple[float | str, ...]] | None = None,
    keys: tuple[str, str] = ("axis", "reference"),
    *,
    fixed: bool = False,
) -> tuple[Triad, Triad]:
    """Return the triads of two bodies.

    Parameters
    ----------
    scope : Scope
        The joint.
    bodies : pair of str
        Its bodies.
    axis : three numbers, or two directions
        The axis in the first body's frame, and from there in the second's as both are described to start; or in the
        frame of each body.
    reference : pair of directions, optional
        Directions of each body that coincide where the angle is 0.
    keys : pair of str
        Their names in the file.
    fixed : bool
        Whether the joint holds the first directions together, so that these must not be arbitrary.
    """
    a, b = bodies
    if len(axis) == 2 and isinstance(axis[0], tuple) and isinstance(axis[1], tuple):
        along_a, along_b = _unit_vector(scope, keys[0], axis[0]), _unit_vector(scope, keys[0], axis[1])
    elif len(axis) == 3 and not any(isinstance(e, tuple) for e in axis):
        along_a = _unit_vector(scope, keys[0], tuple(e for e in axis if not isinstance(e, tuple)))
        along_b = _direction_in_other_body(scope, keys[0], a, b, along_a)
    else:
        expected = "a direction [x, y, z] in the first body's frame, or two, one in the frame of each body"
        raise scope.error(keys[0], expected, value_in_words(axis))
    if reference is not None:
        first_a = _part_across_axis(scope, keys[1], _unit_vector(scope, keys[1], reference[0]), along_a)
        first_b = _part_across_axis(scope, keys[1], _unit_vector(scope, keys[1], reference[1]), along_b)
    else:
        first_a = _any_direction_across(along_a)
        guess = _swing_direction(scope, keys[0], (a, b), (first_a, along_a), along_b)
        if guess is not None:
            first_b = _part_across_axis(scope, keys[0], guess, along_b)
        elif fixed:
            expected = "two directions that coincide, as the start does not say how the bodies are turned"
            raise scope.error(keys[1], expected, "no such key")
        else:
            first_b = _any_direction_across(along_b)
    return _right_handed_triad(a, first_a, along_a), _right_handed_triad(b, first_b, along_b)


def triad_from_directions(scope: Scope, key: str, along: Vec, side: Vec) -> tuple[Vec, Vec, Vec]:
    """Return three axes, all of them expressions of parameters: x along a direction of length 1, y on a side of it.

    Raises
    ------
    InputError
        About a key, if the side is parallel to x.
    """
    rest = tuple(difference(s, product(scalar_product_of(side, along), a)) for s, a in zip(side, along, strict=True))
    size = call("sqrt", scalar_product_of(rest, rest))
    if not scope.value(size, key) > 1e-6:
        raise scope.error(key, "a direction across the beam", "one along it")
    across = tuple(_tidy_entry(e if e == ZERO else call("div", e, size)) for e in rest)
    return along, across, tuple(map(_tidy_entry, vector_product(along, across)))


def _tidy_entry(e: Expr) -> Expr:
    return literal_of(_tidy_number(e.value)) if isinstance(e, Number) else e


def make_triad(
    scope: Scope,
    body: str,
    axis: tuple[float | str | tuple[float | str, ...], ...],
    reference: tuple[float | str, ...] | None = None,
    keys: tuple[str, str] = ("axis", "reference"),
) -> Triad:
    """Return a triad of one body about an axis given in its frame, its first direction near `reference`, if given."""
    key = keys[0]
    if any(isinstance(e, tuple) for e in axis):
        raise scope.error(key, f"one direction [x, y, z] in the frame of '{body}'", value_in_words(axis))
    along = _unit_vector(scope, key, tuple(e for e in axis if not isinstance(e, tuple)))
    if reference is None:
        return _right_handed_triad(body, _any_direction_across(along), along)
    return _right_handed_triad(
        body, _part_across_axis(scope, keys[1], _unit_vector(scope, keys[1], reference), along), along
    )


def directions_across(scope: Scope, key: str, normal: Direction) -> tuple[Direction, Direction]:
    """Return two directions across another one, which may be an expression of parameters.

    They are those of a triad about the normal z of the file's values, turned with the normal n from there:
    ``t = e - (e . n) / (1 + z . n) (z + n)``.
    """
    x, y, z = (scope.value(e, key) for e in normal.vector)
    axis = _tidy_vector((x, y, z))
    triad = _right_handed_triad(normal.body, _any_direction_across(axis), axis)
    if all(isinstance(e, Number) for e in normal.vector):
        return triad.first, triad.second
    lean, turned = call("add", ONE, scalar_product_of(axis_of := triad.axis.vector, normal.vector)), list[Direction]()
    for direction in (triad.first, triad.second):
        part = call("div", scalar_product_of(direction.vector, normal.vector), lean)
        both = (sum_of_terms(z, n) for z, n in zip(axis_of, normal.vector, strict=True))
        vector = (difference(e, product(part, s)) for e, s in zip(direction.vector, both, strict=True))
        turned.append(Direction(normal.body, tuple(vector)))
    return turned[0], turned[1]


def make_cross(
    scope: Scope,
    bodies: tuple[str, str],
    axes: tuple[tuple[float | str, ...], tuple[float | str, ...]],
    reference: tuple[tuple[float | str, ...], tuple[float | str, ...]] | None = None,
) -> tuple[Triad, Triad]:
    """Return the triads about the two axes of a cross, one of each body.

    The first direction of either lies where the other body's axis is while the joint's angle about it is 0: as both
    are described to start, unless `reference` gives these two directions.
    """
    triads = []
    for i, (body, other) in enumerate((bodies, bodies[::-1])):
        along = _unit_vector(scope, "axes", axes[i])
        if reference is not None:
            first = _part_across_axis(scope, "reference", _unit_vector(scope, "reference", reference[i]), along)
        elif _is_numeric(scope, body) and _is_numeric(scope, other):
            towards = _direction_in_other_body(scope, "axes", other, body, _unit_vector(scope, "axes", axes[1 - i]))
            if abs(scalar_product(towards, along)) > 0.99:
                raise scope.error("axes", "two axes that cross", "two that start parallel")
            first = _part_across_axis(scope, "axes", towards, along)
        else:
            first = _any_direction_across(along)
        triads.append(_right_handed_triad(body, first, along))
    return triads[0], triads[1]


def _unit_vector(scope: Scope, key: str, vector: tuple[float | str, ...]) -> _Triple:
    parts = scope.direction(key, GROUND, vector).vector
    if not all(isinstance(e, Number) for e in parts):
        raise scope.error(key, "numbers, no expressions of parameters", "an expression")
    x, y, z = (e.value for e in parts if isinstance(e, Number))
    return x, y, z


def _is_numeric(scope: Scope, body: str) -> bool:
    """Whether the body's orientation at the start depends on no parameter."""
    described = scope.context.bodies.get(body)
    return body == GROUND or (isinstance(described, SpatialBody) and described.orientation.is_numeric)


def _direction_in_other_body(scope: Scope, key: str, a: str, b: str, vector: _Triple) -> _Triple:
    """Return a direction of body `a` in the frame of body `b`, as both start."""
    for body in (a, b):
        if not _is_numeric(scope, body):
            got = f"one, while the orientation of '{body}' at the start is a formula"
            raise scope.error(key, "two directions, one in the frame of each body", got)
    for body, turn in ((a, rotate), (b, rotate_back)):
        described = scope.context.bodies.get(body)
        if isinstance(described, SpatialBody):
            where = f"{scope.context.source}: bodies.{body}.orientation"
            turned = euler_parameters(described.orientation, scalar_values(scope.context.values), where)
            vector = turn(rotation_matrix_of(turned), vector)
    return _tidy_vector(vector)


def _swing_direction(
    scope: Scope, key: str, bodies: tuple[str, str], directions: tuple[_Triple, _Triple], axis: _Triple
) -> _Triple | None:
    """Return the first of two directions of a body in another one's frame, turned as brings the second to its axis.

    None where the start says nothing: an orientation that depends on parameters, opposite axes.
    """
    if not all(_is_numeric(scope, body) for body in bodies):
        return None
    x, along = (_direction_in_other_body(scope, key, *bodies, vector) for vector in directions)
    lean = 1.0 + scalar_product(along, axis)
    if lean < 1e-3:
        return None
    part = scalar_product(x, axis) / lean
    return x[0] - part * (along[0] + axis[0]), x[1] - part * (along[1] + axis[1]), x[2] - part * (along[2] + axis[2])


def _part_across_axis(scope: Scope, key: str, vector: _Triple, axis: _Triple) -> _Triple:
    """Return the part of a vector that is perpendicular to the axis, of length 1."""
    rest, size = _perpendicular_part(vector, axis)
    if not size > 1e-6:
        raise scope.error(key, "a direction across the axis", "one along it")
    return rest


def _any_direction_across(axis: _Triple) -> _Triple:
    """Return a direction perpendicular to the axis: the next axis of the frame, made perpendicular."""
    k = max(range(3), key=lambda i: abs(axis[i]))
    x, y, z = (float(i == (k + 1) % 3) for i in range(3))
    return _perpendicular_part((x, y, z), axis)[0]


def _perpendicular_part(vector: _Triple, axis: _Triple) -> tuple[_Triple, float]:
    """Return the part of a vector that is perpendicular to the axis, of length 1, and its length before."""
    part = scalar_product(vector, axis)
    x, y, z = (v - part * a for v, a in zip(vector, axis, strict=True))
    size = math.hypot(x, y, z)
    return _tidy_vector((x / (size or 1.0), y / (size or 1.0), z / (size or 1.0))), size


def _right_handed_triad(body: str, first: _Triple, axis: _Triple) -> Triad:
    (a, b, c), (d, e, f) = axis, first
    second = _tidy_vector((b * f - c * e, c * d - a * f, a * e - b * d))
    return Triad(*(Direction(body, tuple(literal_of(x) for x in v)) for v in (first, second, axis)))


def _tidy_vector(v: _Triple) -> _Triple:
    """Return the vector without what is rounding of 0 or 1, so that nothing is emitted for it."""
    x, y, z = map(_tidy_number, v)
    return x, y, z


def _tidy_number(x: float) -> float:
    return round(x) + 0.0 if abs(x - round(x)) < 1e-15 else x
