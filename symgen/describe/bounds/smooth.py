"""Rows with bounds as forces of the state: a smooth law in place of the exact one, sliding alone, elastic stops."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import msgspec

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import Number, Reading
from symgen.base.vocabulary.measures import Exerted
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.bounded_modes import two_sided_rows, unit_of_effort, without_bounds
from symgen.describe.bounds.dry_friction import Friction
from symgen.describe.bounds.elastic_stop import ElasticStop
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.mechanism import Force, Mechanism, Output

#: Kind of such a force, and what may have a smooth law.
SMOOTH, WITH_LAWS = "friction", "dry friction"


def rows_as_forces(mechanism: Mechanism, rows: Iterable[BoundedRow]) -> Mechanism:
    """Return a mechanism with some rows as forces, dry friction and elastic stops, which ``NAME.force`` reports."""
    smooth = [row for row in rows if isinstance(row, Friction | ElasticStop)]
    bodies = {joint.name: joint.bodies for joint in mechanism.joints}
    forces = tuple(
        Force(x.row, SMOOTH if isinstance(x, Friction) else x.family.one, bodies.get(x.owner, ()), (x.smooth_effort,))
        for x in smooth
    )
    outputs = tuple(
        Output(f"{row.name}.force", Reading(f"{row.name}.force", Exerted(force.efforts)), unit_of_effort(row))
        for row, force in zip(smooth, forces, strict=True)
    )
    return msgspec.structs.replace(
        mechanism, forces=(*mechanism.forces, *forces), outputs=(*mechanism.outputs, *outputs)
    )


def sliding_rows_as_forces(where: str, mechanism: Mechanism, apart: Sequence[BoundedRow] = ()) -> Mechanism:
    """Return a mechanism with its dry friction as forces against the rates, 0 at rest; some rows stay as they are.

    Raises
    ------
    InputError
        If bounds depend on reactions.
    """
    rows = [row for row in two_sided_rows(mechanism) if isinstance(row, Friction) and row not in apart]
    if names := ", ".join(row.name for row in rows if row.pressed):
        raise InputError(where, "dry friction with constant bounds", f"friction of {names} by the reaction")
    return rows_as_forces(without_bounds(mechanism, rows), rows) if rows else mechanism


def smooth_rows(where: str, rows: Sequence[BoundedRow], speed: float, values: Mapping[str, float]) -> list[BoundedRow]:
    """Return dry friction with the bound in motion times tanh(rate / `speed`), at values of all parameters.

    Raises
    ------
    InputError
        If a bound depends on a reaction, or jumps as a motion begins.
    """
    smooth = list[BoundedRow]()
    for row in rows:
        expected = "dry friction with one constant bound, or with stribeck_speed"
        if row.pressed:
            raise InputError(where, expected, f"that of {row.name} by the reaction")
        if not isinstance(row, Friction):
            raise InputError(where, expected, f"the {row.family.one} {row.name}")
        if row.changing and row.numbers[0][1] != row.numbers[1][1] and row.stribeck_speed is None:
            raise InputError(where, expected, f"that of {row.name}, two formulas")
        bounds = () if row.changing else tuple(evaluate_formula(bound, values, where) for _, bound in row.numbers)
        low, high = min(bounds, default=0.0), max(bounds, default=0.0)
        if high != low and row.stribeck_speed is None:
            raise InputError(where, expected, f"that of {row.name}, {high:g} at rest and {low:g} in motion")
        smooth.append(msgspec.structs.replace(row, speed=Number(speed)))
    return smooth
