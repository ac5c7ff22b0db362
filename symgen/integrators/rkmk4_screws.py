"""The classical scheme of order 4 on SE(3): bodies rotate and translate by exponentials of screws."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.integrators.rk4 import KIND as RK4
from symgen.integrators.rkmk4 import LieTableau
from symgen.runtime.integrator import Setup, law_functions
from symgen.runtime.padding import padded

if TYPE_CHECKING:
    from symgen.runtime.compiled import CompiledModel
    from symgen.runtime.integrator import Array
    from symgen.runtime.run import RunSpec


@dataclass(frozen=True)
class ScrewTableau(LieTableau):
    """An explicit scheme without an error estimate, applied to screws of free bodies within a step."""

    def loop(self, adaptive: bool) -> Any:
        """Return the loop of exponential updates."""
        from symgen.runtime.schemes import screw

        return screw.constant

    def setup(self, compiled: CompiledModel, spec: RunSpec, w: Array) -> Setup:
        """Return the arguments of the loop."""
        from symgen.runtime.scheme_records import Screws
        from symgen.runtime.schemes import lie

        info, names = compiled.info, [q.name for q in compiled.info.velocities]
        assert spec.step is not None, "a constant step is given"
        free = [(e, j) for e, j in info.spins if j >= 3 and names[j - 3] == names[j].rpartition(".")[0] + ".vx"]
        spins, stage = np.array([j for _, j in info.spins], dtype=np.int64), lie.stage_width(info.nq, info.nv, info.ny)
        scheme = Screws(self.record(False), spins, np.array(free, dtype=np.int64).ravel(), stage)
        room = lie.room(padded(info.ny), stage, self.stages) + 2 * info.nv + 3
        return Setup(self.loop(False), law_functions(compiled, "turn"), scheme, spec.step, 0, room)


KIND = ScrewTableau(
    name="rkmk4-screws",
    order=4,
    reference="Park, Chung, IEEE Trans. Robot. 21 (2005) 850-863, doi 10.1109/TRO.2005.852253; Munthe-Kaas (1999)",
    a=RK4.a,
    b=RK4.b,
    c=RK4.c,
    real_boundary=RK4.real_boundary,
)
