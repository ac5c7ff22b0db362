"""Adams-Bashforth-Moulton schemes as data."""

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
class Adams:
    """A predictor-corrector scheme.

    Parameters
    ----------
    name, reference : str
        Name as typed, and the source.
    order : int
        Order; with varying steps the highest one.
    adaptive : bool
        Whether steps and order vary.
    real_boundary : float
        End of the region of stability on the negative real axis, for the highest order.
    """

    row_targets: ClassVar[tuple[str, ...]] = ()

    name: str
    order: int
    reference: str
    adaptive: bool
    real_boundary: float
    forms: tuple[str, ...] = ("ode",)
    parameters: tuple[IntegratorParameter, ...] = ()

    @property
    def stages(self) -> int:
        """Evaluations of a step: at the predicted and at the corrected state."""
        return 2

    def loop(self, adaptive: bool) -> Any:
        """Return the loop for all orders."""
        from symgen.run.loops.schemes import adams

        return adams.adaptive if adaptive else adams.constant

    def setup(self, compiled: CompiledModel, spec: RunSpec, w: Array) -> Setup:
        """Return the arguments of the loop."""
        from symgen.run.layout.scheme_records import Multistep
        from symgen.run.loops.schemes import adams

        nodes, factors = np.polynomial.legendre.leggauss(5)  # exact for polynomials up to degree 9
        scheme = Multistep(nodes, factors, np.arange(adams.DEPTH, dtype=np.int64), self.order)
        width, step = padded(compiled.info.ny), spec.step if spec.step is not None else 1e-6 * spec.until
        loop, functions = self.loop(spec.adaptive), law_functions(compiled)
        return Setup(loop, functions, scheme, step, *adams.memory(width), 0.8)
