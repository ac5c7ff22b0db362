"""Mechanisms that have a page of equations, by their size."""

from __future__ import annotations

from typing import TYPE_CHECKING

from symgen.base.errors import InputError

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism


#: Mechanisms with more rows and velocities have no page.
MOST_ROWS = 1500
#: Up to so many velocities of bodies a page has the code of a run in straight lines, unless the shape is set.
MOST_STRAIGHT = 150


def check_size(mechanism: Mechanism) -> None:
    """Refuse a mechanism too large for a readable page, before anything is derived.

    Raises
    ------
    InputError
        If it has too many rows or velocities.
    """
    rows = sum(len(joint.rows) for joint in mechanism.joints)
    speeds = sum(len(body.speeds) for body in mechanism.bodies)
    if max(rows, speeds) > MOST_ROWS:
        expected = f"at most {MOST_ROWS} constraint rows and velocities for a page"
        raise InputError("page", expected, f"{rows} rows and {speeds} velocities", "text and JSON have no such limit")
