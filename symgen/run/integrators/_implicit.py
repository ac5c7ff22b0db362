"""Implicit Runge-Kutta schemes as data, with checked coefficients."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from symgen.compile.loopcode.padding import padded
from symgen.run.loops.integrator import Array, IntegratorParameter, Setup, law_functions

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.run_spec import RunSpec


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
        Problem forms that it solves.
    a, b, c : Array
        Butcher's tableau, shapes (s, s), (s,), (s,).
    errors : Array, shape (s + 1,), or None
        Weights of the error estimate on the derivative at the beginning of the step and on those of the stages.
    error_order : int
        The exponent of step-size control is -1 / (error_order + 1).
    filter_factor : float
        The estimate is filtered by ``(1 - h filter_factor J)^-1``, with 0 not filtered.
    index2_order : int
        Order on stabilised index 2, 0 if the scheme does not solve it.
    """

    row_targets: ClassVar[tuple[str, ...]] = ()

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
        """Whether the stages are coupled."""
        return bool(np.any(np.triu(self.a, 1) != 0.0))

    def loop(self, adaptive: bool) -> Any:
        """Return the loop of implicit stages."""
        from symgen.run.loops.schemes import implicit

        return implicit.adaptive if adaptive else implicit.constant

    def setup(self, compiled: CompiledModel, spec: RunSpec, w: Array) -> Setup:
        """Return the arguments of the loop."""
        from symgen.run.layout.scheme_records import Stages
        from symgen.run.loops.newton import Pattern, stage_plan
        from symgen.run.loops.schemes import implicit

        info, s, pattern = compiled.info, self.stages, Pattern.of(compiled, w)
        slopes = np.zeros((s if self.together else 1) * pattern.size + 1)
        slopes[-1] = 1.0
        plan, numbers = stage_plan(pattern, self.a if self.together else np.ones((1, 1)), len(slopes) - 1)
        single = stage_plan(pattern, np.ones((1, 1)), len(slopes) - 1)
        scheme = Stages(
            *(np.ascontiguousarray(self.a).ravel(), self.b, self.c),
            np.zeros(s + 1) if self.errors is None else self.errors,
            *(self.filter_factor, s, int(self.together), self.error_order),  # type: ignore[arg-type]  # mypy joins kinds
            np.concatenate([pattern.rows, pattern.columns]),
            *(slopes, numbers, plan, single[1], single[0]),  # type: ignore[arg-type]  # mypy joins kinds
        )
        functions = law_functions(compiled, "residual", "tangent")
        width, n, more = padded(info.ny), compiled.law.unknowns, info.ny - info.nq - info.nv
        memory, room = implicit.memory(width, n, more, s, self.together)
        step = spec.step if spec.step is not None else 1e-4 * spec.until
        return Setup(ImplicitTableau.loop(self, spec.adaptive), functions, scheme, step, memory, room)
