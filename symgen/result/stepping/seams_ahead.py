"""Seams ahead of a stepped run: times at which inputs jump and formulas have kinks, up to where they are known."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from symgen.run.breaks.foreseen_seams import foresee_in_run, merge_seams, seams_of_motion
from symgen.run.layout import abi

if TYPE_CHECKING:
    from collections.abc import Mapping

    from symgen.run.loops.run_spec import RunSpec
    from symgen.run.planning.plan import Plan
    from symgen.run.single.simulation import Simulation


class SeamsAhead:
    """The seams of a run whose end is open.

    Parameters
    ----------
    plan : Plan
        The run.
    loop : Simulation
        Its arrays, at its start.
    free : bool
        Whether its constant steps have no grid.

    Attributes
    ----------
    jumps : tuple of Seam
        Jumps of inputs, known up to the end that the plan has.
    foreseen : Foreseen
        Discontinuities of formulas at which steps end.
    horizon : float
        Time up to which these are sought [s].
    """

    def __init__(self, plan: Plan, loop: Simulation, free: bool) -> None:
        self._loop = loop
        self.jumps, self._driven = plan.inputs.seams, plan.inputs.driven
        step = None if free else plan.spec.step
        order, adaptive = plan.integrator.order, plan.spec.adaptive
        self.foreseen = foresee_in_run(
            plan.mechanism, plan.events, adaptive, order, (float(loop.state.clock[abi.TIME]), step)
        )
        self.horizon = plan.spec.until

    def divide_at_seams(self, values: Mapping[str, float]) -> RunSpec:
        """Return the specification for values of parameters: inputs jump, and formulas have kinks, elsewhere."""
        spec, driven = self._loop.spec, self._driven
        if driven is not None and driven.jumps:
            self.jumps = seams_of_motion(driven, values, spec.until)
        return replace(spec, seams=merge_seams(self.jumps, self.foreseen.seams(values, self.horizon)))
