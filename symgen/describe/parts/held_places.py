"""Where a joint with ``holds_at = "present"`` holds: a point of one body in the frame of the other.

Rows between two points that are apart belong to a joint only if they are measured in axes of a body: two forces along
axes of the ground are a couple then, and the spin of the two bodies changes without a cause.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import msgspec

from symgen.base.vocabulary.expressions import Number, Reading, call
from symgen.base.vocabulary.measures import GROUND, Component, Direction, FormulaMeasure, Holonomic, Measure, Row
from symgen.describe.mechanism import Holding, Joint, Mechanism
from symgen.describe.parts.holding_keys import HOLDS_AT, PRESENT
from symgen.describe.parts.scope import Scope

#: Last word of the names of states.
AT = "at"


def at_present_place(scope: Scope, joint: Joint, table: Mapping[str, Any]) -> Joint:
    """Return a joint whose rows hold a point in the frame of a body, where its table asks for present positions.

    Raises
    ------
    InputError
        If neither body has a frame that turns.
    """
    if table.get(HOLDS_AT) != PRESENT:
        return joint
    return msgspec.structs.replace(joint, rows=tuple(_in_frame_of_body(scope, row) for row in joint.rows))


def _in_frame_of_body(scope: Scope, row: Row) -> Row:
    """Return a row on two points along an axis of the first body, or of the second where the first is a point mass."""
    measure = row.measure if isinstance(row, Holonomic) else None
    if not isinstance(measure, Component) or measure.along.body != GROUND:
        return row
    bodies = measure.a.body, measure.b.body
    if GROUND in bodies:
        return row
    frame = next((body for body in bodies if scope.turns(body)), None)
    if frame is None:
        expected = "a body that turns, in whose frame the other one is held"
        hint = "a distance joint holds how far two points are apart"
        raise scope.error(HOLDS_AT, expected, f"the point masses '{bodies[0]}' and '{bodies[1]}'", hint)
    along = Direction(frame, measure.along.vector)
    return msgspec.structs.replace(row, measure=Component(measure.a, measure.b, along))


def name_of_place(joint: str, label: str) -> str:
    """Return the name of the state that says where a row holds."""
    return f"{joint}.{label}.{AT}"


def at_place_of_states(joint: Joint, states: Mapping[str, float] | None) -> Joint:
    """Return a joint whose rows hold where the states of a run say."""
    rows = list[Row]()
    for row in joint.rows:
        place = (states or {}).get(name_of_place(joint.name, row.label), 0.0)
        rows.append(msgspec.structs.replace(row, value=call("add", row.value, Number(place))) if place else row)
    return msgspec.structs.replace(joint, rows=tuple(rows))


def places_of(mechanism: Mechanism, holding: Holding) -> tuple[str, ...]:
    """Return the names of the states that say where the rows of a joint hold."""
    rows = mechanism.joint_named(holding.joint).rows if holding.present else ()
    return tuple(name_of_place(holding.joint, row.label) for row in rows)


def measure_beyond_value(row: Holonomic, joint: str) -> Measure:
    """Return what a row holds at 0, or at the value of a place: its measure, less its value where that moves."""
    if isinstance(row.value, Number):
        return row.measure
    return FormulaMeasure(call("sub", Reading(f"{joint}.{row.label}", row.measure), row.value))
