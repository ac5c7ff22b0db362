"""The classical scheme of order 4 on the rotation group (Runge-Kutta-Munthe-Kaas): bodies rotate by exponentials.

In the plane it is `rk4`. In space Euler parameters keep their length by construction.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from symgen.compile.loopcode.padding import padded
from symgen.run.integrators._tableau import Tableau
from symgen.run.integrators.rk4 import KIND as RK4
from symgen.run.loops.integrator import Array, Setup, law_functions

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel, ModelInfo
    from symgen.run.loops.run_spec import RunSpec


@dataclass(frozen=True)
class LieTableau(Tableau):
    """An explicit scheme without an error estimate, applied to rotation vectors within a step."""

    row_targets: ClassVar[tuple[str, ...]] = ()

    forms: tuple[str, ...] = ("ode",)

    def loop(self, adaptive: bool) -> Any:
        """Return the loop of exponential updates."""
        from symgen.run.loops.schemes import lie

        return lie.constant

    def setup(self, compiled: CompiledModel, spec: RunSpec, w: Array) -> Setup:
        """Return the arguments of the loop."""
        from symgen.run.loops.schemes import lie

        info = compiled.info
        assert spec.step is not None, "constant steps have a length"
        spins, stage = np.array([j for _, j in info.spins], dtype=np.int64), lie.stage_width(info.nq, info.nv, info.ny)
        scheme, further = self.scheme(info, spins, stage)
        room = lie.lie_room(padded(info.ny), stage, self.stages) + further
        return Setup(self.loop(False), law_functions(compiled, "turn"), scheme, spec.step, 0, room)

    def scheme(self, info: ModelInfo, spins: NDArray[np.int64], stage: int) -> tuple[Any, int]:
        """Return the record of the scheme, and the extra workspace of its updates."""
        from symgen.run.layout.scheme_records import Rotations

        return Rotations(self.record(False), spins, stage), 0


KIND = LieTableau(
    name="rkmk4",
    order=4,
    reference="Munthe-Kaas, Appl. Numer. Math. 29 (1999) 115-127, doi 10.1016/S0168-9274(98)00030-0",
    a=RK4.a,
    b=RK4.b,
    c=RK4.c,
    real_boundary=RK4.real_boundary,
)
