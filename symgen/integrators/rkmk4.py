"""The classical scheme of order 4 on the rotation group (Runge-Kutta-Munthe-Kaas): bodies turn by exponentials.

In the plane it is `rk4`. In space Euler parameters keep their length by construction.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.integrators._base import BatchCall, LoopCall, State
from symgen.integrators._tableau import Tableau
from symgen.integrators.rk4 import KIND as RK4

if TYPE_CHECKING:
    from symgen.model import CompiledModel
    from symgen.runtime.run import RunSpec


@dataclass(frozen=True)
class LieTableau(Tableau):
    """An explicit scheme without an error estimate, applied to rotation vectors within a step."""

    forms: tuple[str, ...] = ("ode",)

    def loop(self, spec: RunSpec) -> Any:
        """Return the loop of exponential updates."""
        from symgen.runtime.lie import lie_steps

        return lie_steps

    def call(self, compiled: CompiledModel, spec: RunSpec, state: State) -> LoopCall:
        """Return the loop for a run and its arguments."""
        from symgen.runtime.manifold import stay

        law, info = compiled.law_module, compiled.info
        assert spec.step is not None, "a constant step is given"
        before = (
            *(law.rhs, getattr(law, "confirm", law.rhs), law.accept, getattr(compiled.model, "turn", stay)),
            *(np.ascontiguousarray(self.a).ravel(), self.b, self.c, self.stages),
            *(info.nq, info.nv, info.sections["change"][0]),
            *(state.y, state.p, state.w, state.iw, 0.0, spec.step, spec.until),
        )
        room = np.zeros(2 * info.ny + (self.stages + 1) * (2 * info.nv + 1))
        return LoopCall(self.loop(spec), before, (room, np.array([j for _, j in info.spins], dtype=np.int64)))

    def batch(self, ny: int, spec: RunSpec) -> BatchCall | None:
        """Return None: the scheme has no loop over many runs."""
        return None


KIND = LieTableau(
    name="rkmk4",
    order=4,
    reference="Munthe-Kaas, Appl. Numer. Math. 29 (1999) 115-127, doi 10.1016/S0168-9274(98)00030-0",
    a=RK4.a,
    b=RK4.b,
    c=RK4.c,
    real_boundary=RK4.real_boundary,
)
