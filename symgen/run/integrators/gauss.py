"""Gauss's collocation with two nodes between symmetric projections: order 4, its own adjoint."""

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
class Gauss:
    """The scheme, with constant steps and the law as its right-hand side."""

    row_targets: ClassVar[tuple[str, ...]] = ()

    name: str = "gauss"
    order: int = 4
    reference: str = "Hairer, Lubich, Wanner, Geometric Numerical Integration, 2nd ed., Springer 2006, II.1.3, VIII.6"
    forms: tuple[str, ...] = ("symmetric",)
    real_boundary: float = 3.4  # where the iteration of rates converges: sqrt(12)
    adaptive: bool = False
    parameters: tuple[IntegratorParameter, ...] = ()

    @property
    def stages(self) -> int:
        """Number of nodes."""
        return 2

    def loop(self, adaptive: bool) -> Any:
        """Return the loop of the scheme."""
        from symgen.run.loops.schemes import symmetric

        return symmetric.constant

    def setup(self, compiled: CompiledModel, spec: RunSpec, w: Array) -> Setup:
        """Return the arguments of the loop."""
        from symgen.run.layout.scheme_records import Symmetric
        from symgen.run.loops.schemes import symmetric

        law, info, model = compiled.law, compiled.info, compiled.model
        assert spec.step is not None, "a constant step is given"
        share = law.parameter_offset + [name for name, _ in law.parameters].index("share")
        rows = np.array([0.0 if row.holonomic else 1.0 for row in info.rows])
        functions = model.geometry, model.measure, model.spread
        scheme = Symmetric(*functions, share, info.sections["residual"][0], rows)
        memory, room = symmetric.memory(padded(info.ny), info.nv, info.m)
        return Setup(self.loop(False), law_functions(compiled, "turn"), scheme, spec.step, memory, room)


KIND = Gauss()
