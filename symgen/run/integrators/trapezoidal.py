"""The implicit trapezoidal rule: order 2, A-stable, without numerical damping.

On index 3 it requires projections: alone it is unstable, since nothing damps the modes of the constraints.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.compile.loopcode.padding import padded
from symgen.run.integrators._implicit import ImplicitTableau
from symgen.run.loops.integrator import Array, Setup, law_functions

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.run_spec import RunSpec


@dataclass(frozen=True)
class Trapezoidal(ImplicitTableau):
    """The rule as a tableau for index 1, and in positions for index 3 with projections."""

    def loop(self, adaptive: bool) -> Any:
        """Return None: the method decides."""
        return None

    def setup(self, compiled: CompiledModel, spec: RunSpec, w: Array) -> Setup:
        """Return the arguments of the loop."""
        if compiled.law.level != "projected":
            return super().setup(compiled, spec, w)
        from symgen.run.layout.scheme_records import Projection
        from symgen.run.loops.newton import Pattern, constraint_forces, projection_plan
        from symgen.run.loops.schemes import projected

        law, info = compiled.law, compiled.info
        assert spec.step is not None, "a constant step is given"
        pattern = Pattern.of(compiled, w)
        plan, numbers, sources = projection_plan(pattern)
        forces = np.stack(constraint_forces(pattern), axis=1).ravel()
        place = law.parameter_offset + [name for name, _ in law.parameters].index("penalty")
        rows = np.array([0.0 if row.holonomic else 1.0 for row in info.rows])
        scheme = Projection(place, np.zeros(sources), numbers, plan, forces, rows)
        functions = law_functions(compiled, "turn", "residual", "tangent")
        memory, room = projected.memory(padded(info.ny), info.nv + len(info.states), info.m, law.unknowns)
        return Setup(projected.constant, functions, scheme, spec.step, memory, room)


KIND = Trapezoidal(
    name="trapezoidal",
    order=2,
    reference="Hairer, Wanner, Solving Ordinary Differential Equations II, 2nd ed., Springer 1996, section IV.3",
    forms=("index-1", "index-3-projected"),
    a=np.array([[0.0, 0.0], [0.5, 0.5]]),
    b=np.array([0.5, 0.5]),
    c=np.array([0.0, 1.0]),
)
