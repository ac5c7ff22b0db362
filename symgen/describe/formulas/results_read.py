"""What formulas read of the results of a motion: accelerations, efforts of rows and forces, and integrals over time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from symgen.base.vocabulary.expressions import Expr, Name, moving_quantities, readings_in
from symgen.base.vocabulary.measures import Carrying, Driven, Exerted, Integral
from symgen.describe.coordinate_names import ACCELERATIONS
from symgen.describe.formulas.readings import OUTPUT
from symgen.describe.mechanism import Joint, Mechanism
from symgen.describe.remembered import compute_once

_ACCELERATIONS = frozenset(ACCELERATIONS.values())


def rows_read_by_output(value: Expr) -> set[str]:
    """Return the rows whose efforts a formula of outputs reads, in integrals as well."""
    rows = set[str]()
    for reading in readings_in(value):
        if isinstance(reading.source, Driven):
            rows.add(reading.source.row)
        elif isinstance(reading.source, Integral):
            rows |= rows_read_by_output(reading.source.of)
    return rows


def joints_with_multipliers(joints: Sequence[Joint], formulas: Sequence[Expr], cuts: Sequence[str]) -> tuple[str, ...]:
    """Return joints that carry nothing in a tree: those that cut it, and those whose reactions formulas read."""
    read = {row.rpartition(".")[0] for formula in formulas for row in rows_read_by_output(formula)}
    drivers = {joint.name for joint in joints if joint.kind == "driver"}
    return (*cuts, *(j.name for j in joints if j.name in read - drivers - set(cuts)))


def reads_results(value: Expr) -> bool:
    """Whether a formula reads accelerations, or forces of rows or of force elements: what a motion results in."""
    return any(
        x.name.rpartition(".")[2] in _ACCELERATIONS
        if isinstance(x, Name)
        else x.order == OUTPUT or isinstance(x.source, Carrying | Driven | Exerted)
        for x in moving_quantities(value)
    )


@compute_once
def integrals_of_outputs(mechanism: Mechanism) -> Mapping[Integral, int]:
    """Return the integrals in outputs, numbered in their order, each once."""
    sources = (r.source for output in mechanism.outputs for r in readings_in(output.value))
    return {source: i for i, source in enumerate(dict.fromkeys(s for s in sources if isinstance(s, Integral)))}


def integrands_of_run(mechanism: Mechanism) -> tuple[Any, ...]:
    """Return the integrands of a run: joints, forces, and the rates of states with the formulas of integrals."""
    rates = *(x.rate for x in mechanism.states), *(integral.of for integral in integrals_of_outputs(mechanism))
    return mechanism.joints, mechanism.forces, rates
