"""Adams-Bashforth-Moulton schemes as data."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.integrators._base import IntegratorParameter, LoopCall, State

if TYPE_CHECKING:
    from symgen.model import CompiledModel
    from symgen.runtime.run import RunSpec


@dataclass(frozen=True)
class Adams:
    """A predictor-corrector scheme.

    Parameters
    ----------
    name, reference : str
        Name as typed, and the source.
    order : int
        Order, the highest one with varying steps.
    adaptive : bool
        Whether steps and order vary.
    real_boundary : float
        Where the region of stability ends on the negative real axis, for the highest order.
    """

    name: str
    order: int
    reference: str
    adaptive: bool
    real_boundary: float
    forms: tuple[str, ...] = ("ode",)
    parameters: tuple[IntegratorParameter, ...] = ()

    def loop(self, spec: RunSpec) -> Any:
        """Return the loop of all orders."""
        from symgen.runtime.adams import adams_steps

        return adams_steps

    def call(self, compiled: CompiledModel, spec: RunSpec, state: State) -> LoopCall:
        """Return the loop for a run and its arguments."""
        from symgen.runtime.adams import DEPTH

        law, ny = compiled.law_module, compiled.info.ny
        nodes, factors = np.polynomial.legendre.leggauss(5)  # exact for polynomials up to degree 9
        step = spec.step if spec.step is not None else 1e-6 * spec.until
        before = (
            *(law.rhs, getattr(law, "confirm", law.rhs), law.accept, self.order, int(spec.adaptive), compiled.info.nq),
            *(nodes, factors, state.y, state.p, state.w, state.iw),
            *(0.0, step, spec.largest_step, spec.until, spec.rtol, spec.atol),
        )
        room = np.zeros((3 + DEPTH) * ny + 2 * (DEPTH + 1))
        return LoopCall(self.loop(spec), before, (room,))
