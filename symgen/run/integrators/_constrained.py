"""Explicit schemes whose stages satisfy constraints by forces along D^T, as data."""

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
class ConstrainedTableau:
    """An explicit scheme on the descriptor form, without an error estimate.

    Parameters
    ----------
    name, reference : str
        Name as typed, and the source.
    order : int
        Order of positions and velocities.
    forms : tuple of str
        Problem forms that it solves.
    scheme : str
        Its module in `symgen.run.loops.schemes`.
    a, c : Array, shapes (s, s), (s,)
        Row i yields the state after stage i, the last one the end of the step; nodes of these states.
    real_boundary : float
        End of the region of absolute stability on the negative real axis.
    """

    row_targets: ClassVar[tuple[str, ...]] = ()

    name: str
    order: int
    reference: str
    forms: tuple[str, ...]
    scheme: str
    a: Array
    c: Array
    real_boundary: float
    adaptive: bool = False
    parameters: tuple[IntegratorParameter, ...] = ()

    def __post_init__(self) -> None:
        s = len(self.c)
        if self.a.shape != (s, s) or np.any(np.triu(self.a, 1) != 0.0) or not np.allclose(self.a.sum(axis=1), self.c):
            raise ValueError(f"tableau {self.name}: a must be lower triangular with rows that add up to c")
        if np.any(np.diag(self.a) == 0.0) or self.c[-1] != 1.0:
            raise ValueError(f"tableau {self.name}: each stage must act on the next, and the last one at the end")

    @property
    def stages(self) -> int:
        """Number of evaluations in a step."""
        return len(self.c)

    def loop(self, adaptive: bool) -> Any:
        """Return the loop of the scheme."""
        from importlib import import_module

        return import_module(f"symgen.run.loops.schemes.{self.scheme}").constant

    def setup(self, compiled: CompiledModel, spec: RunSpec, w: Array) -> Setup:
        """Return the arguments of the loop."""
        from symgen.run.layout.scheme_records import ConstrainedStages
        from symgen.run.loops.newton import Pattern, acceleration_plan
        from symgen.run.loops.schemes.constrained import memory

        info, pattern = compiled.info, Pattern.of(compiled, w)
        assert spec.step is not None, "a constant step is given"
        plan, numbers, sources = acceleration_plan(pattern)
        slopes = np.zeros(sources)
        slopes[-1] = 1.0
        rows = np.array([0.0 if row.holonomic else 1.0 for row in info.rows])
        nodes = np.concatenate([[0.0], self.c])
        scheme = ConstrainedStages(
            np.ascontiguousarray(self.a).ravel(), nodes, self.stages, pattern.spins, rows, slopes, numbers, plan
        )
        functions = law_functions(compiled, "turn", "residual", "tangent")
        kept, room = memory(padded(info.ny), info.nv, info.m, compiled.law.unknowns, self.stages)
        return Setup(self.loop(False), functions, scheme, spec.step, kept, room)
