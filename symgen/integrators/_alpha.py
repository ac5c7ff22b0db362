"""The generalised-alpha family as data."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.integrators._base import IntegratorParameter, LoopCall, State

if TYPE_CHECKING:
    from symgen.model import CompiledModel
    from symgen.runtime.run import RunSpec


@dataclass(frozen=True)
class AlphaFamily:
    """A scheme of Newmark's family.

    Parameters
    ----------
    name, reference : str
        Name as typed, and the source.
    order : int
        Order with the default parameters.
    forms : tuple of str
        Problem forms it solves.
    parameters : tuple of IntegratorParameter
        What shapes the scheme.
    coefficients : callable
        Gives (alpha_m, alpha_f, gamma, beta) for values of the parameters.
    """

    name: str
    order: int
    reference: str
    forms: tuple[str, ...]
    parameters: tuple[IntegratorParameter, ...]
    coefficients: Callable[[Mapping[str, float]], tuple[float, float, float, float]]
    adaptive: bool = False
    real_boundary: float = np.inf

    def loop(self, spec: RunSpec) -> Any:
        """Return the loop of the family."""
        from symgen.runtime.alpha import alpha_steps

        return alpha_steps

    def call(self, compiled: CompiledModel, spec: RunSpec, state: State) -> LoopCall:
        """Return the loop for a run and its arguments."""
        from symgen.runtime.manifold import stay
        from symgen.runtime.newton import Pattern, alpha_plan

        law, info, n = compiled.law_module, compiled.info, compiled.law.unknowns
        values = {q.name: spec.integrator_parameters.get(q.name, q.default) for q in self.parameters}
        assert spec.step is not None, "a constant step is given"
        before = (
            *(law.residual, law.tangent, law.rhs, getattr(law, "confirm", law.rhs), law.accept),
            getattr(compiled.model, "turn", stay),
            *self.coefficients(values),
            *(info.nq, info.nv, info.m, n),
            *(info.sections["multipliers"][0], info.sections["mask"][0], info.sections["change"][0]),
            *(state.y, state.p, state.w, state.iw, 0.0, spec.step, spec.until),
        )
        plan, numbers, sources = alpha_plan(Pattern.of(compiled, state.w))
        slopes = np.zeros(sources)
        slopes[-1] = 1.0
        room = np.zeros(3 * info.ny + 3 * n + 2 * info.nv + 4)
        return LoopCall(self.loop(spec), before, (room, slopes, numbers, plan))
