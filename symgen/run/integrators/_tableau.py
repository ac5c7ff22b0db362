"""Explicit Runge-Kutta pairs as data, with checked coefficients, and their records for loops."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from symgen.compile.loopcode.padding import padded
from symgen.run.loops.integrator import Array, IntegratorParameter, Setup, law_functions

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.run_spec import RunSpec


@dataclass(frozen=True)
class Tableau:
    """An explicit Runge-Kutta scheme, optionally with an embedded error estimate and dense output.

    Parameters
    ----------
    name, reference : str
        Name as typed, and the source of the coefficients.
    order : int
        Order of the propagated solution.
    forms : tuple of str
        Problem forms that it solves.
    a : Array, shape (s, s)
        Strictly lower triangular.
    b, c : Array, shape (s,)
        Weights and nodes.
    errors : tuple of Array, shape (s + 1,)
        Weights of the error estimates; the last element belongs to the stage at the end of the step.
    error_order : int
        The exponent of step-size control is -1 / (error_order + 1).
    extra_a, extra_c : Array
        Stages for dense output alone; they may use the stage at the end of the step.
    dense : Array, shape (s + 1 + extra, degree), or None
        y(t + x h) = y + h sum_k K_k sum_j dense[k, j] x^(j + 1).
    real_boundary : float
        End of the region of absolute stability on the negative real axis.
    safety : float
        Ratio of the step taken to the one that the error estimate allows.
    """

    row_targets: ClassVar[tuple[str, ...]] = ("cpu", "lanes", "cuda")

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
    safety: float = 0.9

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
    def zero(self) -> complex:
        """The zero of the stability function R(z) nearest to the negative real axis, within reach of that axis.

        A zero outside the region of stability is isolated: neighbouring modes grow.
        """
        powers, terms = np.ones(self.stages), [1.0]
        for _ in range(self.stages):
            terms.append(float(self.b @ powers))
            powers = self.a @ powers
        roots = np.roots([x if abs(x) > 1e-14 else 0.0 for x in reversed(terms)])
        near = roots[(roots.real < 0.0) & (roots.imag >= 0.0) & (np.abs(roots) <= self.real_boundary)]
        return complex(min(near, key=lambda z: float(z.imag)))

    @property
    def adaptive(self) -> bool:
        """Whether the scheme estimates its error."""
        return bool(self.errors)

    def packed(self) -> tuple[NDArray[np.int64], NDArray[np.int64], Array, Array]:
        """Return the nonzero coefficients row by row for the loops.

        Rows are the stages, then b, then the stages of dense output, then the error weights. Row r has the entries from
        ``start[r]`` to ``start[r + 1]`` of `column` and `value`; `nodes` holds c of all stages, 1 for the end of the
        step.
        """
        s, extra = self.stages, len(self.extra_c)
        rows = [*(self.a[i] for i in range(s)), self.b, *(self.extra_a[i] for i in range(extra)), *self.errors]
        start, column, value = [0], list[int](), list[float]()
        for row in rows:
            for j, x in enumerate(row):
                if x != 0.0:
                    column.append(j)
                    value.append(float(x))
            start.append(len(column))
        nodes = np.concatenate([self.c, [1.0], self.extra_c])
        return np.array(start, dtype=np.int64), np.array(column, dtype=np.int64), np.array(value), nodes

    def record(self, adaptive: bool) -> Any:
        """Return the record of the scheme for loops, with dense output for adaptive ones."""
        from symgen.run.layout.scheme_records import TableauRecord as Record

        start, column, value, nodes = self.packed()
        dense, ends = np.zeros(0), any(e[-1] != 0.0 for e in self.errors)
        if adaptive:
            assert self.dense is not None, "every adaptive tableau has dense output"
            dense = np.zeros((self.dense.shape[1], padded(len(nodes))))
            dense[:, : len(nodes)] = self.dense.T
        count = np.arange(padded(len(nodes)), dtype=np.int64)
        sizes = self.stages, len(self.errors), self.error_order, len(dense), int(ends)
        return Record(start, column, value, nodes, dense.ravel(), count, *sizes)

    def loop(self, adaptive: bool) -> Any:
        """Return the loop for constant or adaptive steps."""
        from symgen.run.loops.schemes import explicit

        return explicit.adaptive if adaptive else explicit.constant

    def setup(self, compiled: CompiledModel, spec: RunSpec, w: Array) -> Setup:
        """Return the arguments of the loop."""
        from symgen.run.loops.schemes import explicit

        width, scheme = padded(compiled.info.ny), self.record(spec.adaptive)
        memory = len(scheme.nodes) * width if spec.adaptive else 0
        functions, room = law_functions(compiled), explicit.explicit_room(width, scheme, compiled.info.kept)
        return Setup(self.loop(spec.adaptive), functions, scheme, spec.step or 0.0, memory, room, self.safety)
