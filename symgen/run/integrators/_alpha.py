"""The generalised-alpha family as data."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from symgen.compile.loopcode.padding import padded
from symgen.run.loops.integrator import Array, IntegratorParameter, Setup, law_functions

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.run_spec import RunSpec


@dataclass(frozen=True)
class AlphaFamily:
    """A scheme of Newmark's family.

    Parameters
    ----------
    name, reference : str
        Name as typed, and the source.
    order : int
        Order with the default parameters.
    forms : tuple of str
        Problem forms that it solves.
    parameters : tuple of IntegratorParameter
        Parameters of the scheme.
    coefficients : callable
        Returns (alpha_m, alpha_f, gamma, beta) for values of the parameters.
    estimates : bool
        Whether it can choose its steps; it does so on request.
    rtol : float
        Default relative tolerance.
    """

    row_targets: ClassVar[tuple[str, ...]] = ()

    name: str
    order: int
    reference: str
    forms: tuple[str, ...]
    parameters: tuple[IntegratorParameter, ...]
    coefficients: Callable[[Mapping[str, float]], tuple[float, float, float, float]]
    adaptive: bool = False
    estimates: bool = False
    rtol: float = 1e-4
    real_boundary: float = np.inf

    @property
    def stages(self) -> int:
        """Minimum number of evaluations in a step."""
        return 1

    def loop(self, adaptive: bool) -> Any:
        """Return the loop of the family."""
        from symgen.run.loops.schemes import alpha

        return alpha.adaptive if adaptive else alpha.constant

    def setup(self, compiled: CompiledModel, spec: RunSpec, w: Array) -> Setup:
        """Return the arguments of the loop."""
        from symgen.run.layout.scheme_records import Alpha
        from symgen.run.loops.newton import Pattern, alpha_plan
        from symgen.run.loops.schemes import alpha

        values = {q.name: spec.integrator_parameters.get(q.name, q.default) for q in self.parameters}
        step = spec.step if spec.step is not None else 1e-5 * spec.until
        plan, numbers, sources = alpha_plan(Pattern.of(compiled, w))
        slopes = np.zeros(sources)
        slopes[-1] = 1.0
        scheme = Alpha(*self.coefficients(values), slopes, numbers, plan)
        functions = law_functions(compiled, "turn", "residual", "tangent")
        info = compiled.info
        memory, room = alpha.memory(padded(info.ny), info.nv + len(info.states), compiled.law.unknowns)
        return Setup(self.loop(spec.adaptive), functions, scheme, step, memory, room)
