"""Starts that bounds hold at rest: joints and teeth whose static bound is enough are rows, as in a run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from msgspec.structs import replace as replaced
from numpy.typing import NDArray

from symgen.analyses.rest.steady import at_rest
from symgen.analyses.state.algebra import DEPENDENT
from symgen.analyses.state.laws_at_rest import Holding, contacts_holding, forces_at_rest, multipliers_with
from symgen.analyses.state.one_sided import NO_FORCE, fault_of_mode
from symgen.analyses.state.reduced import tangent_system
from symgen.analyses.state.subject import Subject, make_subject
from symgen.base.vocabulary.expressions import Expr, Number, Reading, call
from symgen.base.vocabulary.measures import Holonomic
from symgen.describe.bounds.bounded_modes import two_sided_rows, without_bounds
from symgen.describe.joints.rows import tied_bodies
from symgen.describe.mechanism import Joint
from symgen.run.compiling.side import compile_side

if TYPE_CHECKING:
    from symgen.base.settings import Settings
    from symgen.describe.bounded import BoundedRow
    from symgen.describe.mechanism import Mechanism

Array = NDArray[np.float64]

#: End of the names of joints that hold, which no file has.
_MARK = "~held"


def rest_within_bounds(mechanism: Mechanism, settings: Settings, by: Sequence[str]) -> Subject | None:
    """Return a mechanism at a start that rows with bounds hold, these among the constraints; see `held_start`."""
    held = held_start(mechanism, settings, by)
    return None if held is None else held[0]


def held_start(mechanism: Mechanism, settings: Settings, by: Sequence[str] = ()) -> tuple[Subject, Array] | None:
    """Return a mechanism at a start that rows with bounds hold, these among the constraints, and all multipliers.

    None where the start moves, rests without them, or is not held by all rows together: beside closed stops and
    contacts, by reactions of pins and teeth, by bounds of two directions, and where several rows hold one motion.

    Parameters
    ----------
    mechanism, settings, by
        As for `symgen.analyses.state.subject.make_subject`.
    """
    rows = [row for row in two_sided_rows(mechanism) if not row.signed]
    if not rows:
        return None
    plain = make_subject(mechanism, settings, by)
    velocities = plain.y[plain.nq : plain.nq + plain.nv]
    if not plain.closed or np.any(velocities):
        return None
    x = tangent_system(plain, plain.y)
    if at_rest(plain, x) and not fault_of_mode(plain, plain.y, x.lam):
        return None
    places, own = _numbers_of_rows(plain, rows)
    joints = (_holding_joint(row, place) for row, place in zip(rows, places, strict=True))
    base = without_bounds(mechanism, rows)
    held = make_subject(replaced(base, joints=(*base.joints, *joints)), settings, by)
    holding = (*own, *contacts_holding(held))
    begun = forces_at_rest(held, held.y, holding)
    if begun is None or begun.moving or not at_rest(held, tangent_system(held, held.y)):
        return None
    forces = begun.forces
    least = NO_FORCE * float(np.abs(forces).max(initial=0.0))
    loose = [row.row for row, force in zip(holding, forces, strict=True) if row.pushes and force > -least]
    if not all(_is_held_without(held, name) for name in loose):
        return None  # what only just touches may open as well
    names = ", ".join(dict.fromkeys(row.name for row in rows))
    told = replace(held, held=(f"{rows[0].family.noun} at rest, held as rows: {names}",))
    return told, multipliers_with(held, held.y, holding, forces)


def _is_held_without(held: Subject, name: str) -> bool:
    """Return whether the other rows hold what a row does."""
    d = held.rows(held.evaluate(held.y)) * held.spans
    rows = [row.name for row in held.compiled.info.rows]
    others = np.delete(d, rows.index(name), axis=0)
    return bool(np.linalg.matrix_rank(others, DEPENDENT) == np.linalg.matrix_rank(d, DEPENDENT))


def _numbers_of_rows(plain: Subject, rows: Sequence[BoundedRow]) -> tuple[list[float], list[Holding]]:
    """Return the coordinates of rows at a state, and what they exert at most there."""
    formulas = [(f"place of {row.name}", row.place[1]) for row in rows]
    formulas += [(f"bound of {row.name}", row.numbers[0][1]) for row in rows]
    formulas += [(f"middle of {row.name}", _middle_at_rest(row)) for row in rows]
    cosines = [(row, line, cosine) for row in rows for line in row.across for cosine in line]
    formulas += [(f"{row.name} across {i}", Reading("", cosine)) for i, (row, _, cosine) in enumerate(cosines)]
    side = compile_side(
        plain.mechanism, plain.compiled, "holds", "Coordinates of rows with bounds, and the bounds", formulas
    )
    numbers = [float(x) for x in side(plain.t, plain.y, plain.p, plain.w.copy(), np.zeros_like(plain.y))]
    places, bounds, middles = (numbers[i * len(rows) : (i + 1) * len(rows)] for i in range(3))
    following, holding = iter(numbers[3 * len(rows) :]), list[Holding]()
    for row, bound, middle in zip(rows, bounds, middles, strict=True):
        across = tuple(tuple(next(following) for _ in line) for line in row.across)
        holding.append(Holding(f"{_name_of_holding(row)}.held", bound, middle, row.pressed, across))
    return places, holding


def _middle_at_rest(row: BoundedRow) -> Expr:
    """Return the middle of the bounds at rest."""
    return row.middle_of_bounds() if row.shift is None else call("add", row.middle_of_bounds(), row.shift)


def _holding_joint(row: BoundedRow, place: float) -> Joint:
    """Return the joint that holds the coordinate of a row."""
    own = Holonomic("held", row.measure, Number(place), row.unit)
    return Joint(_name_of_holding(row), "rows", tied_bodies(own), (own,))


def is_held_row(row: str) -> bool:
    """Return whether a row of this name holds a start."""
    return row.endswith(f"{_MARK}.held")


def _name_of_holding(row: BoundedRow) -> str:
    return f"{row.row.replace('.', '_')}{_MARK}"
