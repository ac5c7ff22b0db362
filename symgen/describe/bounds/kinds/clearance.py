"""The key ``clearance`` of pins in the plane: a pin with play in its hole, which touches, rubs and strikes."""

from __future__ import annotations

from typing import Annotated

import msgspec
from msgspec import Meta

from symgen.base.vocabulary.expressions import call
from symgen.base.vocabulary.measures import Component, Holonomic
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.contact_rows import CONTACTS
from symgen.describe.bounds.keys import KeyOfJoints
from symgen.describe.bounds.kinds.contact import rows_of_contact
from symgen.describe.contacts.pairs.disc_disc import touch_of_discs
from symgen.describe.contacts.surfaces import Disc
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import Scalar, read_table
from symgen.describe.parts.scope import Scope

ClearanceTable = Annotated[
    dict[str, float | str | dict[str, float | str]],
    Meta(description="a table such as { hole = 0.010, pin = 0.0095, restitution = 0.5, friction = 0.01 }"),
]


class ClearanceSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A hole in the first body of a joint, and a pin of the second one in it, without its rows.

    Parameters
    ----------
    hole, pin : scalar
        Radii [m].
    restitution : scalar
        Rate of the gap after an impact over that before, from 0 to 1; 0 by default.
    friction : scalar or table
        As that of contacts; none by default.
    """

    hole: Scalar
    pin: Scalar
    restitution: Scalar = 0.0
    friction: float | str | dict[str, float | str] | None = None


def read_clearance(scope: Scope, joint: Joint, raw: object) -> tuple[BoundedRow, ...]:
    """Return the contact of a pin in its hole, which has the joint's name.

    Raises
    ------
    InputError
        With the key that is wrong.
    """
    section = read_table(ClearanceSection, raw, scope.where("clearance"))
    first = joint.rows[0] if joint.rows else None
    if scope.spatial or joint.kind != "revolute" or not isinstance(first, Holonomic):
        got = f"a {joint.kind} joint" + (" in space" if scope.spatial else "")
        raise scope.error("clearance", "a revolute joint in the plane", got)
    assert isinstance(first.measure, Component), "a pin holds components of a vector"
    radii = [
        scope.constant(f"clearance.{key}", x, positive=True)
        for key, x in (("hole", section.hole), ("pin", section.pin))
    ]
    sizes = [scope.value(radius, "clearance") for radius in radii]
    hole = Disc(first.measure.a, call("neg", radii[0]), -sizes[0])
    touch = touch_of_discs(scope, "clearance", hole, Disc(first.measure.b, radii[1], sizes[1]))
    return rows_of_contact(scope, "clearance", scope.name, touch, section.friction, section.restitution)


KIND = KeyOfJoints("clearance", CONTACTS, ClearanceTable, read_clearance)
