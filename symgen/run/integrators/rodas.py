"""Rodas of Hairer and Wanner: linearly implicit, one matrix a step and no iteration, L-stable and stiffly accurate."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from symgen.compile.loopcode.padding import padded
from symgen.run.integrators._implicit import ImplicitTableau
from symgen.run.loops.integrator import Array, IntegratorParameter, Setup

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.run_spec import RunSpec

_STAGES, _GAMMA = 6, 0.25
_A = np.zeros((_STAGES, _STAGES))
_A[1, :1] = 1.544
_A[2, :2] = 0.9466785280815826, 0.2557011698983284
_A[3, :3] = 3.314825187068521, 2.896124015972201, 0.9986419139977817
_A[4, :4] = 1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950
_A[5, :5] = *_A[4, :4], 1.0
#: Weights of the matrix of the mass: how stages follow those before.
_CARRIED = np.zeros((_STAGES, _STAGES))
_CARRIED[1, :1] = -5.6688
_CARRIED[2, :2] = -2.430093356833875, -0.2063599157091915
_CARRIED[3, :3] = -0.1073529058151375, -9.594562251023355, -20.47028614809616
_CARRIED[4, :4] = 7.496443313967647, -10.24680431464352, -33.99990352819905, 11.70890893206160
_CARRIED[5, :5] = 8.083246795921522, -7.981132988064893, -31.52159432874371, 16.31930543123136, -6.058818238834054
_ERRORS = np.zeros(_STAGES)
_ERRORS[5] = 1.0


@dataclass(frozen=True)
class LinearlyImplicit:
    """The scheme in the form in which no product with a Jacobian is needed for the stages before."""

    row_targets: ClassVar[tuple[str, ...]] = ()

    name: str = "rodas"
    order: int = 4
    reference: str = "Hairer, Wanner, Solving Ordinary Differential Equations II, 2nd ed., Springer 1996, section VI.4"
    forms: tuple[str, ...] = ("index-1",)
    real_boundary: float = np.inf
    adaptive: bool = True
    parameters: tuple[IntegratorParameter, ...] = ()

    @property
    def stages(self) -> int:
        """Evaluations of a step."""
        return _STAGES

    def loop(self, adaptive: bool) -> Any:
        """Return the loop of linearly implicit stages."""
        from symgen.run.loops.schemes import linear

        return linear.adaptive if adaptive else linear.constant

    def setup(self, compiled: CompiledModel, spec: RunSpec, w: Array) -> Setup:
        """Return the arguments of the loop."""
        from symgen.run.layout.scheme_records import Linear
        from symgen.run.loops.schemes import linear

        info, start = compiled.info, _MATRIX.setup(compiled, spec, w)
        stages = start.scheme._replace(
            a=_A.ravel(),
            b=np.append(_A[5, :5], 1.0),
            c=_NODES,
            errors=_ERRORS,
            filtered=_GAMMA,
            stages=_STAGES,
            order=3,
        )
        memory, room = linear.memory(padded(info.ny), compiled.law.unknowns, info.ny - info.nq - info.nv, _STAGES)
        scheme = Linear._make((*stages, _CARRIED.ravel(), _DRIFTS))
        return Setup(self.loop(spec.adaptive), start.functions, scheme, start.step, memory, room)


_NODES = np.array([0.0, 0.386, 0.21, 0.63, 1.0, 1.0])
_DRIFTS = np.array([0.25, -0.1043, 0.1035, -0.0362, 0.0, 0.0])
#: Whose one stage has the matrix of all stages.
_MATRIX = ImplicitTableau(
    name="rodas", order=1, reference="", forms=("index-1",), a=np.ones((1, 1)), b=np.ones(1), c=np.ones(1)
)
KIND = LinearlyImplicit()
