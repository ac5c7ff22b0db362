"""What closed contacts do along their surfaces in analyses: those at rest at the start stick, and are rows.

What comes out holds where the forces along them stay within the cones of their static coefficients: `fault_along`.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

import msgspec
import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import Number
from symgen.base.vocabulary.measures import FormulaMeasure, Holonomic, Measure
from symgen.derive.lower.windings import counted_turns
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.bounded_modes import measure_derivative, unit_of_effort
from symgen.describe.joints.rows import tied_bodies
from symgen.describe.mechanism import Joint
from symgen.run.compiling.side import compile_side
from symgen.run.layout import abi
from symgen.run.layout.scales import LEAST_SPEED
from symgen.run.modes.bounded_rows import STILL

if TYPE_CHECKING:
    from symgen.analyses.state.subject import Subject
    from symgen.describe.mechanism import Mechanism
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.starts.assembly import Start

Array = NDArray[np.float64]

#: Rounding of a force over its bound; directions of multipliers below this part of the largest change nothing.
_ROUNDING, _NOTHING = 1e-9, 1e-10


class Fault(msgspec.Struct, frozen=True):
    """Why a row with bounds cannot be in its mode at a state.

    Parameters
    ----------
    row : str
        The row.
    sentence : str
        What the mode would need.
    hint : str
        What may be done.
    """

    row: str
    sentence: str
    hint: str = ""

    @property
    def whole(self) -> str:
        """The sentence with its hint."""
        return f"{self.sentence}: {self.hint}" if self.hint else self.sentence


class Stuck(msgspec.Struct, frozen=True):
    """A row along a closed contact that is at rest.

    Parameters
    ----------
    row : BoundedRow
        The row.
    place : float
        The coordinate along the contact, which is held.
    coefficient : float
        Largest force over that of the gap.
    """

    row: BoundedRow
    place: float
    coefficient: float


def rows_that_stick(
    mechanism: Mechanism,
    compiled: CompiledModel,
    start: Start,
    along: Sequence[BoundedRow],
    shut: Sequence[BoundedRow],
    moving: bool = True,
) -> tuple[Stuck, ...]:
    """Return the rows along the closed contacts of a state that has no slip; none where a coefficient is 0.

    Parameters
    ----------
    mechanism, compiled
        The mechanism without rows with bounds.
    start : Start
        The state.
    along, shut : sequence of BoundedRow
        Rows along contacts, and the gaps in force.
    moving : bool
        Whether the velocities of the state count, which are 0 otherwise.

    Raises
    ------
    InputError
        If a closed contact slides.
    """
    closed = {row.row for row in shut}
    rows = [row for row in along if row.pressed[0] in closed]
    if not rows:
        return ()
    formulas = [(row.label, row.place[1]) for row in rows]
    formulas += [(f"coefficient of {row.name}", row.numbers[0][1]) for row in rows]
    formulas += [(f"rate of {row.label}", measure_derivative(row)) for row in rows]
    side = compile_side(mechanism, compiled, "slips", "Slips, their bounds and rates", formulas)
    w, found = start.w, list[Stuck]()
    values = side(start.t, start.y, start.p, w.copy(), np.zeros_like(start.y))
    places, coefficients, rates = np.asarray(values).reshape(3, -1)
    still = STILL * max(float(w[abi.SPEED]), LEAST_SPEED * (float(w[abi.LENGTH]) or 1.0))
    rates = sizes_of_pairs(rates, rows)
    for row, place, coefficient, rate in zip(rows, places.tolist(), coefficients.tolist(), rates.tolist(), strict=True):
        if coefficient > 0.0:
            if moving and abs(rate) > still:
                moves = "turns" if row.unit == "rad" else "slides"
                got = f"{row.name}, which {moves} at {rate:.6g} {row.unit}/s"
                raise InputError("analyses at a state", "closed contacts at rest", got, "a run has its motion")
            found.append(Stuck(row, place, coefficient))
    return tuple(found)


def sizes_of_pairs(numbers: Array, rows: Sequence[BoundedRow]) -> Array:
    """Return numbers of rows, where two rows of a contact follow each other the length of both."""
    sizes = np.asarray(numbers, dtype=float).copy()
    for i, row in enumerate(rows):
        if row.second:
            sizes[i - 1 : i + 1] = np.hypot(*sizes[i - 1 : i + 1])
    return sizes


def with_turns(mechanism: Mechanism, rows: Sequence[BoundedRow]) -> Mechanism:
    """Return a mechanism that counts the turns of the angles in coordinates of rows with bounds, without the rows."""
    turns = [Joint(row.row, "rows", tied_bodies(row.held), (), _angles_of(row)) for row in rows if _angles_of(row)]
    return msgspec.structs.replace(mechanism, joints=(*mechanism.joints, *turns)) if turns else mechanism


def with_rows_along(mechanism: Mechanism, stuck: Sequence[Stuck]) -> Mechanism:
    """Return a mechanism whose closed contacts, which are joints, have rows along them as well."""
    joints = {joint.name: joint for joint in mechanism.joints}
    for each in stuck:
        held = each.row.held
        row = held
        if isinstance(held, Holonomic):
            row = Holonomic(held.label, FormulaMeasure(each.row.place[1]), Number(each.place), each.row.unit)
        name, rows = each.row.owner, (*joints[each.row.owner].rows, row)
        turned = counted_turns([each.row.measure for each in stuck if each.row.owner == name])
        joints[name] = Joint(name, "rows", tied_bodies(*rows), rows, _as_coordinates(turned))
    return msgspec.structs.replace(mechanism, joints=tuple(joints.values()))


def _angles_of(row: BoundedRow) -> tuple[tuple[str, Measure], ...]:
    """Return the angles of a row whose turns are counted, as coordinates of a joint."""
    return _as_coordinates(counted_turns([row.measure]))


def _as_coordinates(angles: Iterable[Measure]) -> tuple[tuple[str, Measure], ...]:
    return tuple((f"angle{i}", angle) for i, angle in enumerate(angles))


def fault_along(subject: Subject, y: Array, lam: Array) -> Fault | None:
    """Return why the contact slides that is furthest from sticking; None where all stick.

    Contacts that share a direction have parts of its force in proportion to their bounds, as in runs.
    """
    if not subject.stuck:
        return None
    places = {row.name: i for i, row in enumerate(subject.compiled.info.rows)}
    at = [places[each.row.row] for each in subject.stuck]
    pressed = [max(-float(lam[places[each.row.pressed[0]]]), 0.0) for each in subject.stuck]
    bounds = np.array([each.coefficient * force for each, force in zip(subject.stuck, pressed, strict=True)])
    forces = _shared(np.asarray(lam)[at], bounds, subject.rows(subject.evaluate(y))[at])
    forces = sizes_of_pairs(forces, [each.row for each in subject.stuck])
    over = np.abs(forces) - bounds * (1.0 + _ROUNDING) - _ROUNDING * np.abs(lam).max()
    worst = int(np.argmax(over))
    if not over[worst] > 0.0:
        return None
    row = subject.stuck[worst].row
    verb, unit = "turns" if row.unit == "rad" else "slides", unit_of_effort(row)
    return Fault(
        row.row,
        f"the closed contact {row.name} {verb} there: it would take {abs(forces[worst]):.6g} {unit} "
        f"along it, of at most {bounds[worst]:.6g} {unit}",
    )


def _shared(forces: Array, bounds: Array, rows: Array) -> Array:
    """Return forces along rows, where rows depend on each other in proportion to their bounds."""
    _, sizes, directions = np.linalg.svd(rows.T)
    spare = directions[int(np.sum(sizes > _NOTHING * sizes[0])) :].T
    least = _NOTHING * max(float(bounds.max()), float(np.abs(forces).max()), 1e-300)
    weights = 1.0 / np.sqrt(np.maximum(bounds, least))  # parts of the least sum of force^2 / bound are as bounds are
    change, *_ = np.linalg.lstsq(weights[:, None] * spare, -weights * forces, rcond=None)
    return np.asarray(forces + spare @ change)
