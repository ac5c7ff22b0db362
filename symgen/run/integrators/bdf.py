"""Backward differentiation formulas of orders 1 to 5 with varying steps, for stiff problems and constraints."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from symgen.compile.loopcode.padding import padded
from symgen.run.integrators.radau5 import KIND as RADAU5
from symgen.run.loops.integrator import Array, IntegratorParameter, Setup

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.run_spec import RunSpec


@dataclass(frozen=True)
class BackwardFormulas:
    """The formulas; constant steps start with `radau5`, whose order is 5 too."""

    row_targets: ClassVar[tuple[str, ...]] = ()

    name: str = "bdf"
    order: int = 5
    reference: str = "Brenan, Campbell, Petzold, Numerical Solution of Initial-Value Problems in DAEs, SIAM 1996, ch. 5"
    forms: tuple[str, ...] = ("index-1", "index-2")
    real_boundary: float = np.inf
    adaptive: bool = True
    index2_order: int = 5
    parameters: tuple[IntegratorParameter, ...] = (
        IntegratorParameter("order", 5.0, "the highest order", 1.0, 5.0, whole=True),
    )

    @property
    def stages(self) -> int:
        """Evaluations of a step: an iterate and one that confirms it."""
        return 2

    def loop(self, adaptive: bool) -> Any:
        """Return the loop for all orders."""
        from symgen.run.loops.schemes import backward

        return backward.adaptive if adaptive else backward.constant

    def setup(self, compiled: CompiledModel, spec: RunSpec, w: Array) -> Setup:
        """Return the arguments of the loop."""
        from symgen.run.layout.scheme_records import Backward as Record
        from symgen.run.loops.schemes import backward

        info, start = compiled.info, RADAU5.setup(compiled, spec, w)
        highest = int(spec.integrator_parameters.get("order", 5.0))
        width, n, more = padded(info.ny), compiled.law.unknowns, info.ny - info.nq - info.nv
        memory, room = backward.memory(width, n, more, RADAU5.stages)
        step = spec.step if spec.step is not None else 1e-6 * spec.until
        loop, scheme = self.loop(spec.adaptive), Record._make((*start.scheme, highest))
        return Setup(loop, start.functions, scheme, step, memory, room)


KIND = BackwardFormulas()
