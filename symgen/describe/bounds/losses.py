"""Energy lost at rows with bounds, as quantities of outputs: ``NAME.dissipated`` [J].

Each is an integral beside the state, which only runs whose outputs read it have. Impacts add what they take
(`symgen.run.modes.strikes`); between them that of a one-sided row is 0. What drives of surfaces give, but for impacts,
is ``NAME.driven`` [J].
"""

from __future__ import annotations

from collections.abc import Sequence

from symgen.base.vocabulary.expressions import ZERO, Expr, Reading, call
from symgen.base.vocabulary.measures import Integral
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.bounded_modes import measure_derivative
from symgen.describe.formulas.results_read import integrals_of_outputs
from symgen.describe.mechanism import Mechanism

#: Last words of their names: of what a row takes, and of what a moving surface gives.
LOSS, GAIN = "dissipated", "driven"


def _integral_of_power(row: BoundedRow) -> Integral:
    """Return the integral of the power that a row takes."""
    return Integral(call("neg", call("mul", row.taking, measure_derivative(row))))


def energy_taken(row: BoundedRow) -> Reading:
    """Return the energy that a row has taken since the start of a run."""
    return Reading(f"{row.name}.{LOSS}", _integral_of_power(row))


def _energy_given(row: BoundedRow) -> Reading:
    """Return the energy that the drive of a surface has given along a row."""
    return Reading(f"{row.name}.{GAIN}", Integral(call("mul", row.taking, row.surface)))


def losses_by_name(rows: Sequence[BoundedRow]) -> dict[str, Expr]:
    """Return the losses by their names, and what drives of surfaces give, of rows with one name their sum."""
    losses = dict[str, Expr]()
    for reading in (*map(energy_taken, rows), *(_energy_given(row) for row in rows if row.surface != ZERO)):
        own = losses.get(reading.name)
        losses[reading.name] = reading if own is None else call("add", own, reading)
    return losses


def places_of_losses(mechanism: Mechanism) -> tuple[int | None, ...]:
    """Return the places of the losses of rows that have impulses among the integrals; None where no output reads one.

    Of the two rows of a contact the gap has them.
    """
    numbers = integrals_of_outputs(mechanism)
    struck = (row.one_sided or (row.pressed and not row.in_contact) for row in mechanism.bounded)
    return tuple(
        numbers.get(_integral_of_power(row)) if has else None
        for row, has in zip(mechanism.bounded, struck, strict=True)
    )
