"""A partitioned half-explicit Runge-Kutta pair 5(4) on index 2, on the stages of Dormand and Prince."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from symgen.compile.loopcode.padding import padded
from symgen.run.integrators.dopri5 import KIND as DOPRI5
from symgen.run.loops.integrator import Array, IntegratorParameter, Setup, law_functions

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.run_spec import RunSpec


@dataclass(frozen=True)
class HalfExplicitPair:
    """An explicit pair on the descriptor form whose stages close states of their own.

    Parameters
    ----------
    name, reference : str
        Name as typed, and the source of the coefficients.
    order : int
        Order of positions and velocities.
    a, c : Array, shapes (s, s), (s,)
        Stages and their nodes.
    closing, closed : Array, shapes (s, s), (s,)
        Row i yields the state that multipliers of stage i close, the last one the end of the step; nodes of these
        states. The first row is empty: accelerations at the beginning are those of the law.
    embedded : Array, shape (s + 1,)
        Weights of the embedded scheme; the last element belongs to the stage at the end of the step.
    error_order : int
        The exponent of step-size control is -1 / (error_order + 1).
    real_boundary : float
        End of the region of absolute stability on the negative real axis.
    """

    row_targets: ClassVar[tuple[str, ...]] = ()

    name: str
    order: int
    reference: str
    a: Array
    c: Array
    closing: Array
    closed: Array
    embedded: Array
    error_order: int
    real_boundary: float
    forms: tuple[str, ...] = ("index-2-explicit",)
    adaptive: bool = True
    parameters: tuple[IntegratorParameter, ...] = ()

    def __post_init__(self) -> None:
        s = self.stages
        if self.a.shape != (s, s) or self.closing.shape != (s, s) or np.any(np.triu(self.closing, 1) != 0.0):
            raise ValueError(f"tableau {self.name}: a and closing must be lower triangular, shape {(s, s)}")
        if not np.allclose(self.a.sum(axis=1), self.c) or not np.allclose(self.closing.sum(axis=1), self.closed):
            raise ValueError(f"tableau {self.name}: rows must add up to the nodes of their states")
        if np.any(np.diag(self.closing)[1:] == 0.0) or self.closed[-1] != 1.0 or abs(self.embedded.sum() - 1.0) > 1e-13:
            raise ValueError(f"tableau {self.name}: each stage must act on its closed state, the last one at the end")

    @property
    def stages(self) -> int:
        """Number of stages of one step."""
        return len(self.c)

    def loop(self, adaptive: bool) -> Any:
        """Return the loop for constant or adaptive steps."""
        from symgen.run.loops.schemes import partitioned

        return partitioned.adaptive if adaptive else partitioned.constant

    def setup(self, compiled: CompiledModel, spec: RunSpec, w: Array) -> Setup:
        """Return the arguments of the loop."""
        from symgen.run.layout.scheme_records import PartitionedStages
        from symgen.run.loops.newton import Pattern, acceleration_plan
        from symgen.run.loops.schemes import partitioned

        info, pattern = compiled.info, Pattern.of(compiled, w)
        plan, numbers, sources = acceleration_plan(pattern)
        slopes = np.zeros(sources)
        slopes[-1] = 1.0
        scheme = PartitionedStages(
            np.ascontiguousarray(self.a).ravel(),
            self.c,
            np.ascontiguousarray(self.closing).ravel(),
            self.closed,
            self.embedded,
            self.stages,
            self.error_order,
            pattern.spins,
            slopes,
            numbers,
            plan,
        )
        functions = law_functions(compiled, "turn", "residual", "tangent")
        sizes = padded(info.ny), info.nv, info.m, compiled.law.unknowns, self.stages
        return Setup(self.loop(spec.adaptive), functions, scheme, spec.step or 0.0, *partitioned.memory(*sizes))


_CLOSING = np.zeros((6, 6))
_CLOSING[1, :2] = [3 / 40, 9 / 40]
_CLOSING[2, :3] = [21 / 256, 45 / 256, 15 / 128]
_CLOSING[3, :4] = [19235 / 98784, -225 / 392, 6235 / 6174, 2755 / 32928]
_CLOSING[4, :5] = [-293 / 1152, 85 / 48, -2275 / 1908, 35 / 32, -2835 / 6784]
_CLOSING[5] = DOPRI5.b

KIND = HalfExplicitPair(
    name="phem56",
    order=5,
    reference="Murua, Computing 59 (1997) 43-61, and its code of this name, on the stages of Dormand and Prince",
    a=DOPRI5.a,
    c=DOPRI5.c,
    closing=_CLOSING,
    closed=np.array([0.0, 3 / 10, 3 / 8, 5 / 7, 1.0, 1.0]),
    embedded=np.append(DOPRI5.b, 0.0) - DOPRI5.errors[0],
    error_order=4,
    real_boundary=DOPRI5.real_boundary,
)
