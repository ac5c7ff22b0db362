"""Starts that bounds hold at rest: joints and teeth whose static bound is enough are rows, as in a run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from msgspec.structs import replace as replaced
from numpy.typing import NDArray

from symgen.analyses.rest.steady import at_rest
from symgen.analyses.state.reduced import tangent_system
from symgen.analyses.state.subject import Subject, make_subject
from symgen.base.vocabulary.expressions import Number
from symgen.base.vocabulary.measures import Holonomic
from symgen.describe.bounds.bounded_modes import one_sided_rows, two_sided_rows, without_bounds
from symgen.describe.joints.rows import tied_bodies
from symgen.describe.mechanism import Joint
from symgen.run.compiling.side import compile_side

if TYPE_CHECKING:
    from symgen.base.settings import Settings
    from symgen.describe.bounded import BoundedRow
    from symgen.describe.mechanism import Mechanism

Array = NDArray[np.float64]

#: Rounding of a force over its bound.
_ROUNDING = 1e-9
#: End of the names of joints that hold, which no file has.
_MARK = "~held"


def rest_within_bounds(mechanism: Mechanism, settings: Settings, by: Sequence[str]) -> Subject | None:
    """Return a mechanism at a start that rows with bounds hold, these among the constraints.

    None where the start moves, rests without them, is not held by all rows together, or where what they exert is
    not known: beside stops and contacts, by the reaction of a pin, with bounds that differ in the two directions.

    Parameters
    ----------
    mechanism, settings, by
        As for `symgen.analyses.state.subject.make_subject`.
    """
    rows = two_sided_rows(mechanism)
    if not rows or one_sided_rows(mechanism) or any(len(r.pressed) > 1 or r.signed or r.unequal for r in rows):
        return None
    plain = make_subject(mechanism, settings, by)
    velocities = plain.y[plain.nq : plain.nq + plain.nv]
    if not plain.closed or np.any(velocities) or at_rest(plain, tangent_system(plain, plain.y)):
        return None
    formulas = [(f"place of {row.name}", row.place[1]) for row in rows]
    formulas += [(f"bound of {row.name}", row.numbers[0][1]) for row in rows]
    side = compile_side(
        plain.mechanism, plain.compiled, "holds", "Coordinates of rows with bounds, and the bounds", formulas
    )
    numbers = side(plain.t, plain.y, plain.p, plain.w.copy(), np.zeros_like(plain.y))
    places, bounds = numbers[: len(rows)], numbers[len(rows) :]
    base = without_bounds(mechanism)
    joints = (_holding_joint(row, float(place)) for row, place in zip(rows, places, strict=True))
    held = make_subject(replaced(base, joints=(*base.joints, *joints)), settings, by)
    x = tangent_system(held, held.y)
    if np.any(held.redundant) or not at_rest(held, x) or not _keeps_bounds(held, x.lam, rows, bounds):
        return None
    names = ", ".join(dict.fromkeys(row.name for row in rows))
    return replace(held, held=(f"{rows[0].family.noun} at rest, held as rows: {names}",))


def _holding_joint(row: BoundedRow, place: float) -> Joint:
    """Return the joint that holds the coordinate of a row."""
    own = Holonomic("held", row.measure, Number(place), row.unit)
    return Joint(f"{row.row.replace('.', '_')}{_MARK}", "rows", tied_bodies(own), (own,))


def _keeps_bounds(held: Subject, lam: Array, rows: Sequence[BoundedRow], bounds: Array) -> bool:
    """Return whether the forces of rows are within their bounds, which the force of one row may scale."""
    forces = {row.name: abs(float(x)) for row, x in zip(held.compiled.info.rows, lam, strict=True)}
    for row, bound in zip(rows, bounds, strict=True):
        pressed = forces[row.pressed[0]] if row.pressed else 1.0
        exerted = forces[f"{row.row.replace('.', '_')}{_MARK}.held"]
        if exerted > float(bound) * pressed * (1.0 + _ROUNDING):
            return False
    return True
