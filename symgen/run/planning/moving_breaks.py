"""Breaks in time that move with a number that a run is differentiated by.

At a kink that moves, steps end on both sides: a stage at its very time would belong to neither. A jump that moves
changes the motion by itself, which a run between two seams does not see: it is refused.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import names_in_expression
from symgen.describe.formulas.evaluate import parameter_values
from symgen.run.breaks.foreseen_seams import foresee_changes, times_between, with_further_seams

if TYPE_CHECKING:
    from symgen.describe.parts.driven_mechanism import Jump
    from symgen.run.planning.prepare import Prepared
    from symgen.run.planning.start_directions import StartDirections


def with_moving_kinks(run: Prepared, start: StartDirections) -> Prepared:
    """Return a run that ends steps on both sides of kinks that move.

    Parameters
    ----------
    run : Prepared
        The run.
    start : StartDirections
        Its directions.

    Raises
    ------
    InputError
        If a jump moves.
    """
    formulas, driven = foresee_changes(run.plan.mechanism), run.plan.inputs.driven
    inputs = () if driven is None else driven.jumps
    jumps = _moving_kinks((*formulas.sides, *(jump for jump in inputs if jump.switch)), start)
    kinks = _moving_kinks((*formulas.kinks, *(jump for jump in inputs if not jump.switch)), start)
    if not (jumps or kinks):
        return run
    mechanism, until = run.plan.mechanism, run.spec.until
    values = parameter_values(mechanism, run.plan.parameters)
    for jump in jumps:
        if times := times_between((jump,), mechanism, values, until)[0]:
            name = next(d.name for k, d in enumerate(start.directions) if _is_moving(jump, start, k))
            raise InputError(
                f"sensitivities '{name}'",
                "a number that moves no comparison of formulas with the time",
                f"one that moves the comparison at t = {times[0]:g} s",
                "write ramps by max or abs, and jumps as an event at that time, which resets a state of the file",
            )
    if not run.spec.adaptive:  # whose steps end on both sides of each anyway
        return run
    times = times_between(kinks, mechanism, values, until)[0]
    return run.with_spec(seams=with_further_seams(run.spec.seams, times, until))


def _moving_kinks(jumps: Sequence[Jump], start: StartDirections) -> tuple[Jump, ...]:
    """Return the jumps whose times depend on a direction."""
    return tuple(jump for jump in jumps if any(_is_moving(jump, start, k) for k in range(start.count)))


def _is_moving(jump: Jump, start: StartDirections, k: int) -> bool:
    """Whether direction `k` changes a number in the argument of a jump."""
    own = (start.duals.values.get(name) for name in set(names_in_expression(jump.argument)))
    return any(x is not None and len(x.slopes) > k and x.slopes[k] != 0.0 for x in own)
