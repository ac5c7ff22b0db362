"""Explicit Runge-Kutta pairs as data: coefficients that check themselves, and what a loop needs of them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.integrators._base import Array, BatchCall, IntegratorParameter, LoopCall, State
from symgen.ir.program import STATUS

if TYPE_CHECKING:
    from symgen.model import CompiledModel
    from symgen.runtime.run import RunSpec


@dataclass(frozen=True)
class Tableau:
    """An explicit Runge-Kutta scheme, with an embedded error estimate and dense output where it has them.

    Parameters
    ----------
    name, reference : str
        Name as typed, and the source of the coefficients.
    order : int
        Order of the propagated solution.
    forms : tuple of str
        Problem forms it solves.
    a : Array, shape (s, s)
        Strictly lower triangular.
    b, c : Array, shape (s,)
        Weights and nodes.
    errors : tuple of Array, shape (s + 1,)
        Weights of the error estimates; the last element belongs to the stage at the end of the step.
    error_order : int
        The step is chosen with exponent -1 / (error_order + 1).
    extra_a, extra_c : Array
        Stages that only dense output needs; they may use the stage at the end of the step.
    dense : Array, shape (s + 1 + extra, degree), or None
        y(t + x h) = y + h sum_k K_k sum_j dense[k, j] x^(j + 1).
    real_boundary : float
        Where the region of absolute stability ends on the negative real axis.
    """

    name: str
    order: int
    reference: str
    a: Array
    b: Array
    c: Array
    real_boundary: float
    forms: tuple[str, ...] = ("ode", "one-step")
    parameters: tuple[IntegratorParameter, ...] = ()
    errors: tuple[Array, ...] = ()
    error_order: int = 0
    extra_a: Array = field(default_factory=lambda: np.zeros((0, 0)))
    extra_c: Array = field(default_factory=lambda: np.zeros(0))
    dense: Array | None = None

    def __post_init__(self) -> None:
        s = self.stages
        if self.a.shape != (s, s) or self.c.shape != (s,) or np.any(np.triu(self.a) != 0.0):
            raise ValueError(f"tableau {self.name}: a must be strictly lower triangular, shape {(s, s)}")
        if not np.allclose(self.a.sum(axis=1), self.c, atol=1e-13) or abs(self.b.sum() - 1.0) > 1e-13:
            raise ValueError(f"tableau {self.name}: rows of a must add up to c, and b to 1")
        for e in self.errors:
            if e.shape != (s + 1,) or abs(e.sum()) > 1e-13:
                raise ValueError(f"tableau {self.name}: error weights must add up to 0, shape {(s + 1,)}")
        if self.dense is not None:
            ends = self.dense.sum(axis=1)
            if not np.allclose(ends[:s], self.b, atol=1e-12) or not np.allclose(ends[s:], 0.0, atol=1e-12):
                raise ValueError(f"tableau {self.name}: dense output must meet the end of the step")

    @property
    def stages(self) -> int:
        """Number of stages of one step."""
        return int(self.b.shape[0])

    @property
    def adaptive(self) -> bool:
        """Whether the scheme estimates its error."""
        return bool(self.errors)

    def packed(self) -> tuple[NDArray[np.int64], NDArray[np.int64], Array, Array]:
        """Return the nonzero coefficients row by row as the loops read them.

        Rows are the stages, then b, then the stages of dense output. Row r has the entries from ``start[r]`` to
        ``start[r + 1]`` of `column` and `value`; `nodes` holds c of all stages, 1 for the end of the step.
        """
        s, extra = self.stages, len(self.extra_c)
        rows = [self.a[i] for i in range(s)] + [self.b] + [self.extra_a[i] for i in range(extra)]
        start, column, value = [0], list[int](), list[float]()
        for row in rows:
            for j, x in enumerate(row):
                if x != 0.0:
                    column.append(j)
                    value.append(float(x))
            start.append(len(column))
        nodes = np.concatenate([self.c, [1.0], self.extra_c])
        return np.array(start, dtype=np.int64), np.array(column, dtype=np.int64), np.array(value), nodes

    def loop(self, spec: RunSpec) -> Any:
        """Return the loop of runs with constant or with adaptive steps."""
        from symgen.runtime import explicit

        return explicit.adaptive_steps if spec.adaptive else explicit.fixed_steps

    def call(self, compiled: CompiledModel, spec: RunSpec, state: State) -> LoopCall:
        """Return the loop for a run and its arguments."""
        law = compiled.law_module
        confirm = getattr(law, "confirm", law.rhs)  # a law without pivots of S has nothing to confirm
        y, p, w, iw = state.y, state.p, state.w, state.iw
        common = (law.rhs, confirm, law.accept, *self.packed(), self.stages, compiled.info.nq)
        room = np.zeros(self._room(len(y)))
        if not spec.adaptive:
            assert spec.step is not None, "a constant step is given"
            return LoopCall(self.loop(spec), (*common, y, p, w, iw, 0.0, spec.step, spec.until), (room,))
        control = (0.0, spec.step or 0.0, spec.largest_step, spec.until, spec.rtol, spec.atol)
        return LoopCall(self.loop(spec), (*common, *self._pair(), y, p, w, iw, *control), (room,))

    def batch(self, ny: int, spec: RunSpec) -> BatchCall | None:
        """Return the loop over many runs."""
        if not spec.adaptive:
            from symgen.runtime.batch import fixed_runs

            assert spec.step is not None, "a constant step is given"
            return BatchCall(fixed_runs, (*self.packed(), self.stages, spec.step, spec.until), self._room(ny))
        from symgen.runtime.batch import adaptive_runs

        control = (spec.step or 0.0, spec.largest_step, spec.until, spec.rtol, spec.atol)
        return BatchCall(adaptive_runs, (*self.packed(), self.stages, *self._pair(), *control), self._room(ny))

    def _room(self, ny: int) -> int:
        # all stages, two states, two error sums, and what `accept` measured at the end of a step
        return (self.stages + 5 + len(self.extra_c)) * ny + len(STATUS)

    def _pair(self) -> tuple[Array, int, int, Array]:
        """Return what adaptive loops need beyond the scheme: error weights, their number and order, dense output."""
        assert self.dense is not None, "every adaptive tableau has dense output"
        return (
            np.concatenate(self.errors),
            len(self.errors),
            self.error_order,
            np.ascontiguousarray(self.dense).ravel(),
        )
