"""The implicit trapezoidal rule: order 2, A-stable, without numerical damping.

On index 3 it is used with projections only: alone it is unstable there, since nothing damps the constraints' own modes.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.integrators._base import LoopCall, State
from symgen.integrators._implicit import ImplicitTableau

if TYPE_CHECKING:
    from symgen.model import CompiledModel
    from symgen.runtime.run import RunSpec


@dataclass(frozen=True)
class Trapezoidal(ImplicitTableau):
    """The rule as a tableau for index 1, and in positions for index 3 with projections."""

    def loop(self, spec: RunSpec) -> Any:
        """Return None: the method decides."""
        return None

    def call(self, compiled: CompiledModel, spec: RunSpec, state: State) -> LoopCall:
        """Return the loop for a run and its arguments."""
        if compiled.law.level != "projected":
            return super().call(compiled, spec, state)
        from symgen.runtime.manifold import stay
        from symgen.runtime.newton import Pattern, constraint_forces, mass_diagonal, projection_plan
        from symgen.runtime.projected import projected_steps

        law, info, n = compiled.law_module, compiled.info, compiled.law.unknowns
        assert spec.step is not None, "a constant step is given"
        penalty = state.p[compiled.law.parameter_offset + [q for q, _ in compiled.law.parameters].index("penalty")]
        before = (
            *(law.residual, law.tangent, law.rhs, getattr(law, "confirm", law.rhs), law.accept),
            getattr(compiled.model, "turn", stay),
            *(float(penalty), info.nq, info.nv, info.m, info.sections["multipliers"][0], info.sections["change"][0]),
            *(state.y, state.p, state.w, state.iw, 0.0, spec.step, spec.until),
        )
        pattern = Pattern.of(compiled, state.w)
        plan, numbers, sources = projection_plan(pattern)
        forces = np.stack(constraint_forces(pattern), axis=1).ravel()
        room = np.zeros(3 * info.ny + 2 * n + 4 * info.m + 3 * info.nv + 5)
        after = (room, np.zeros(sources), numbers, plan, forces, mass_diagonal(pattern))
        return LoopCall(projected_steps, before, after)


KIND = Trapezoidal(
    name="trapezoidal",
    order=2,
    reference="Hairer, Wanner, Solving Ordinary Differential Equations II, 2nd ed., Springer 1996, section IV.3",
    forms=("index-1", "index-3-projected"),
    a=np.array([[0.0, 0.0], [0.5, 0.5]]),
    b=np.array([0.5, 0.5]),
    c=np.array([0.0, 1.0]),
)
