"""Energy lost in dry friction and at stops, as quantities of outputs: ``NAME.dissipated`` [J].

Each is an integral beside the state, which only runs whose outputs read it have. That of a stop is 0 between impacts,
which add what they take (`symgen.run.single.impacts`).
"""

from __future__ import annotations

from collections.abc import Iterable

from symgen.base.vocabulary.expressions import Expr, Reading, call
from symgen.base.vocabulary.measures import Exerted, Integral
from symgen.describe.bounds.friction import effort_at_rest, rate_of, total_effort
from symgen.describe.bounds.smooth_friction import smooth_effort
from symgen.describe.formulas.readings import integrals
from symgen.describe.mechanism import EndStop, Friction, Mechanism

#: Last word of their names.
LOSS = "dissipated"


def _loss(bounded: Friction | EndStop) -> Integral:
    """Return the integral of the power that dry friction or a stop takes."""
    if isinstance(bounded, EndStop):
        effort: Expr = effort_at_rest(bounded)
    elif bounded.speed is not None:
        effort = Reading(f"{bounded.name}.force", Exerted((smooth_effort(bounded),)))
    else:
        effort = total_effort(bounded)
    return Integral(call("neg", call("mul", effort, rate_of(bounded))))


def loss_of(bounded: Friction | EndStop) -> Reading:
    """Return the energy that dry friction or a stop has taken since the start of a run."""
    return Reading(f"{bounded.name}.{LOSS}", _loss(bounded))


def losses(bounded: Iterable[Friction | EndStop]) -> dict[str, Reading]:
    """Return the losses by their names."""
    return {reading.name: reading for reading in map(loss_of, bounded)}


def places_of_losses(mechanism: Mechanism) -> tuple[int | None, ...]:
    """Return the places of the losses of stops among the integrals of a run; None where no output reads one."""
    numbers = integrals(mechanism)
    return tuple(numbers.get(_loss(stop)) for stop in mechanism.stops)
