"""Implicit Runge-Kutta schemes as data: coefficients that check themselves."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.integrators._base import Array, IntegratorParameter, LoopCall, State

if TYPE_CHECKING:
    from symgen.model import CompiledModel
    from symgen.runtime.run import RunSpec


@dataclass(frozen=True)
class ImplicitTableau:
    """An implicit Runge-Kutta scheme for the descriptor form.

    Parameters
    ----------
    name, reference : str
        Name as typed, and the source of the coefficients.
    order : int
        Order on index-1 problems.
    forms : tuple of str
        Problem forms it solves.
    a, b, c : Array
        Butcher's tableau, shapes (s, s), (s,), (s,).
    errors : Array, shape (s + 1,), or None
        Weights of the error estimate on the derivative at the beginning of the step and on those of the stages.
    error_order : int
        The step is chosen with exponent -1 / (error_order + 1).
    filter_factor : float
        The estimate is filtered by ``(1 - h filter_factor J)^-1``; 0: it is not.
    index2_order : int
        Order on stabilised index 2, 0 where that is not solved.
    """

    name: str
    order: int
    reference: str
    forms: tuple[str, ...]
    a: Array
    b: Array
    c: Array
    errors: Array | None = None
    error_order: int = 0
    filter_factor: float = 0.0
    index2_order: int = 0
    real_boundary: float = np.inf
    parameters: tuple[IntegratorParameter, ...] = ()

    def __post_init__(self) -> None:
        s = self.stages
        if self.a.shape != (s, s) or not np.allclose(self.a.sum(axis=1), self.c, atol=1e-12):
            raise ValueError(f"tableau {self.name}: rows of a must add up to c, shape {(s, s)}")
        if abs(self.b.sum() - 1.0) > 1e-12:
            raise ValueError(f"tableau {self.name}: b must add up to 1")
        if self.errors is not None and (self.errors.shape != (s + 1,)):
            raise ValueError(f"tableau {self.name}: error weights must have shape {(s + 1,)}")

    @property
    def stages(self) -> int:
        """Number of stages."""
        return int(self.b.shape[0])

    @property
    def adaptive(self) -> bool:
        """Whether the scheme estimates its error."""
        return self.errors is not None

    @property
    def together(self) -> bool:
        """Whether all stages have to be solved together."""
        return bool(np.any(np.triu(self.a, 1) != 0.0))

    def loop(self, spec: RunSpec) -> Any:
        """Return the loop of implicit stages."""
        from symgen.runtime.implicit import implicit_steps

        return implicit_steps

    def call(self, compiled: CompiledModel, spec: RunSpec, state: State) -> LoopCall:
        """Return the loop for a run and its arguments."""
        from symgen.runtime.newton import Pattern, stage_plan

        law, info, s = compiled.law_module, compiled.info, self.stages
        n, ny, pattern = compiled.law.unknowns, info.ny, Pattern.of(compiled, state.w)
        size = s * n if self.together else n
        room = np.zeros(2 * ny + n + s * n + 2 * size + s + s * s + 1)
        slopes = np.zeros((s if self.together else 1) * pattern.size + 1)
        slopes[-1] = 1.0
        single, single_numbers = stage_plan(pattern, np.ones((1, 1)), len(slopes) - 1)
        plan, numbers = stage_plan(pattern, self.a, len(slopes) - 1) if self.together else (single, single_numbers)
        step = spec.step if spec.step is not None else 1e-4 * spec.until
        before = (
            *(law.residual, law.tangent, law.rhs, getattr(law, "confirm", law.rhs), law.accept),
            *(np.ascontiguousarray(self.a).ravel(), self.b, self.c, s, int(self.together)),
            *(np.zeros(s + 1) if self.errors is None else self.errors, self.filter_factor, self.error_order),
            *(info.nq, info.nv, info.m, n),
            *(info.sections["multipliers"][0], info.sections["mask"][0]),
            *(state.y, state.p, state.w, state.iw, int(spec.adaptive), 0.0, step),
            *(spec.largest_step, spec.until, spec.rtol, spec.atol),
        )
        entries = np.concatenate([pattern.rows, pattern.columns])
        return LoopCall(
            ImplicitTableau.loop(self, spec), before, (room, slopes, numbers, plan, single_numbers, single, entries)
        )
