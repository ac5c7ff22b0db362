"""Lengths of a mechanism that its description tells, and the place from which its coordinates are measured."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from symgen.base.vocabulary.expressions import Expr
from symgen.base.vocabulary.measures import (
    GROUND,
    Component,
    FormulaMeasure,
    FormulaSpeed,
    Holonomic,
    Marker,
    nested_parts,
)
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.formulas.start import Numbers
from symgen.describe.mechanism import AnyBody, Mechanism, SpatialBody


def own_length(body: AnyBody, parameters: Mapping[str, float]) -> float:
    """Return a body's own length [m]: 0 for a point mass.

    The largest distance of a named point from the centre of mass, and at least the largest radius of gyration, which is
    all that a body without points has.
    """
    if body.inertia is None:
        return 0.0
    where = f"bodies.{body.name}"
    centre = [evaluate_formula(e, parameters, where) for e in body.centre_of_mass]
    mass = evaluate_formula(body.mass, parameters, where)
    moments = body.inertia[:3] if isinstance(body, SpatialBody) else (body.inertia,)
    inertia = max(evaluate_formula(e, parameters, where) for e in moments)
    longest = math.sqrt(abs(inertia / mass)) if mass else 0.0
    if body.modal is not None:
        reach = (math.dist(point, centre) for point in body.modal.outline.points)
        longest = max(longest, *reach, 0.0)
    for _, point in body.points:
        away = [evaluate_formula(e, parameters, where) - c for e, c in zip(point, centre, strict=True)]
        longest = max(longest, math.hypot(*away))
    return longest


def longest_body(mechanism: Mechanism, parameters: Mapping[str, float]) -> float:
    """Return the largest own length of a body [m], 0 where all are point masses."""
    return max((own_length(body, parameters) for body in mechanism.bodies), default=0.0)


def origin_of_sizes(mechanism: Mechanism, numbers: Numbers) -> list[Any]:
    """Return the origin from which sizes of coordinates are compared: a place of the mechanism, 0 for angles.

    It is the first point of the ground that a joint or an element has, without any the place of the first body. So no
    decision depends on where the origin of coordinates lies.

    Parameters
    ----------
    mechanism, numbers
        As for `symgen.describe.formulas.start.described_start`.

    Returns
    -------
    list
        As the coordinates of a start [m].
    """
    point = next(_points_on_ground(mechanism), None)
    if point is None:
        point = next((body.position for body in mechanism.bodies), ())
    place = [numbers.value(e, f"{mechanism.name}: points of the ground") for e in point]
    moving = (body for body in mechanism.bodies if body.carried is None)
    return [x for body in moving for x in (*place, *[0.0] * (len(body.coordinates) - len(place)))]


def _points_on_ground(mechanism: Mechanism) -> Iterator[tuple[Expr, ...]]:
    """Yield the points of the ground that joints and elements have; formulas and drivers may mean the origin."""
    owned = [
        row.measure if isinstance(row, Holonomic) else row.speed
        for joint in mechanism.joints
        if joint.kind != "driver"
        for row in joint.rows
    ]
    for force in mechanism.forces:  # components of a force are along axes through the origin
        owned += [effort.measure for effort in force.efforts if not isinstance(effort.measure, Component)]
        owned += [measure for flexure in force.flexures for measure in flexure.measures]
    for measure in owned:
        inside = tuple(nested_parts(measure))
        if not any(isinstance(part, FormulaMeasure | FormulaSpeed) for part in inside):
            yield from (part.point for part in inside if isinstance(part, Marker) and part.body == GROUND)
