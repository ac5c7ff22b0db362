"""Forces of joints that formulas read: of pins by their components, of rods and ropes by their tension."""

from __future__ import annotations

from functools import partial

from symgen.base.vocabulary.expressions import Expr, Reading, call, sum_of_terms
from symgen.base.vocabulary.measures import GROUND, Component, Dot, Driven, Holonomic, LinkStretch, Measure, axes
from symgen.describe.mechanism import Joint

#: Names of a joint's reaction, and of the pull of a rod or a rope.
REACTION, TENSION = ("F", "Fx", "Fy", "Fz"), "tension"
#: Names after an owner's -> quantity and unit.
Table = dict[str, tuple[Expr, str]]


def readings_of_reaction(joint: Joint) -> Table:
    """Return the size of the force on the first body of a joint, and its components where rows are along fixed axes.

    Joints whose rows of forces are components of a vector between two points, along axes of one frame, have one: their
    multipliers are the components, along axes of the ground or, of a joint that holds at present positions, of a body.
    """
    forces = [row for row in joint.rows if isinstance(row, Holonomic) and row.unit == "m"]
    rows = [(f"{joint.name}.{row.label}", row.measure) for row in forces]
    components = [measure for _, measure in rows if isinstance(measure, Component)]
    frames = {(each.a, each.b, each.along.body) for each in components}
    if len(rows) == 1 and not components:
        return _readings_of_pull(joint, *rows[0])
    if not rows or len(components) < len(rows) or len(frames) > 1:
        return {}
    efforts = [Reading(row, Driven(row, measure)) for row, measure in rows]
    squares = [call("mul", each, each) for each in efforts]
    table: Table = {"F": (call("sqrt", sum_of_terms(*squares)) if len(rows) > 1 else call("abs", efforts[0]), "N")}
    (body,) = {frame for _, _, frame in frames}
    dimension = len(components[0].along.vector)
    along = {measure.along.vector: effort for effort, measure in zip(efforts, components, strict=True)}
    parts = [along[axis.vector] for axis in axes(body, dimension) if axis.vector in along]
    if body != GROUND and len(parts) < dimension:
        return table
    for letter, axis in zip("xyz", axes(GROUND, dimension), strict=False):
        if body != GROUND:
            turned = (Reading(f"{body}.{letter}{k}", Dot(axis, own)) for k, own in enumerate(axes(body, dimension)))
            table[f"F{letter}"] = call("neg", sum_of_terms(*map(partial(call, "mul"), parts, turned))), "N"
        elif axis.vector in along:
            table[f"F{letter}"] = call("neg", along[axis.vector]), "N"
    return table


def _readings_of_pull(joint: Joint, row: str, measure: Measure) -> Table:
    """Return the tension of a rod or a rope, and the force of a rod on its first body, which is along the rod."""
    if not isinstance(measure, LinkStretch) and joint.kind != "rope":
        return {}
    tension = call("neg", Reading(row, Driven(row, measure)))
    table: Table = {TENSION: (tension, "N")}
    if isinstance(measure, LinkStretch):
        ends, along = (measure.a, measure.b), axes(GROUND, len(measure.a.point))
        parts = [Reading(f"{row}.{k}", Component(*ends, axis)) for k, axis in zip("xyz", along, strict=False)]
        length = call("sqrt", sum_of_terms(*(call("mul", part, part) for part in parts)))
        for label, part in zip(REACTION, (length, *parts), strict=False):
            pull = call("abs", tension) if label == "F" else tension
            table[label] = call("mul", pull, call("div", part, measure.length)), "N"
    return table
