"""The classical scheme of order 4 on SE(3): bodies rotate and translate by exponentials of screws."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.run.integrators.rk4 import KIND as RK4
from symgen.run.integrators.rkmk4 import LieTableau

if TYPE_CHECKING:
    from symgen.run.layout.compiled import ModelInfo


@dataclass(frozen=True)
class ScrewTableau(LieTableau):
    """An explicit scheme without an error estimate, applied to screws of free bodies within a step."""

    def loop(self, adaptive: bool) -> Any:
        """Return the loop of exponential updates."""
        from symgen.run.loops.schemes import screw

        return screw.constant

    def scheme(self, info: ModelInfo, spins: NDArray[np.int64], stage: int) -> tuple[Any, int]:
        """Return the record of the scheme with the free bodies, and the workspace of their screws."""
        from symgen.run.layout.scheme_records import Screws

        names = [q.name for q in info.velocities]
        free = [(e, j) for e, j in info.spins if j >= 3 and names[j - 3] == names[j].rpartition(".")[0] + ".vx"]
        return Screws(self.record(False), spins, np.array(free, dtype=np.int64).ravel(), stage), 2 * info.nv + 3


KIND = ScrewTableau(
    name="rkmk4-screws",
    order=4,
    reference="Park, Chung, IEEE Trans. Robot. 21 (2005) 850-863, doi 10.1109/TRO.2005.852253; Munthe-Kaas (1999)",
    a=RK4.a,
    b=RK4.b,
    c=RK4.c,
    real_boundary=RK4.real_boundary,
)
