"""The interface of integrators: a loop and its arguments."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.run_spec import RunSpec

Array = NDArray[np.float64]


@dataclass(frozen=True)
class IntegratorParameter:
    """A numerical parameter of an integrator.

    Parameters
    ----------
    name, note : str
        Name, and description of its effect.
    default, minimum, maximum : float
        Values outside [minimum, maximum] are refused.
    whole : bool
        Whether it is a whole number.
    """

    name: str
    default: float
    note: str
    minimum: float
    maximum: float
    whole: bool = False


@dataclass(frozen=True)
class Setup:
    """Arguments of a loop besides the model, the state and the outputs.

    Attributes
    ----------
    loop : compiled function
        An instance of `symgen.run.loops.frame.integrate`.
    functions : tuple
        Its first arguments, from `law_functions`.
    scheme : record
        The scheme, one of those of `symgen.run.layout.records`.
    step : float
        Constant step, or first step of an adaptive run [s]; 0: chosen by the loop.
    memory, room : int
        Count of numbers that the scheme keeps between steps, and of its working memory after the trial state.
    safety : float
        Part taken of the step that the error estimate allows.
    """

    loop: Any
    functions: tuple[Any, ...]
    scheme: Any
    step: float
    memory: int
    room: int
    safety: float = 0.9


class Integrator(Protocol):
    """The interface of all integrators."""

    @property
    def name(self) -> str:
        """Name for users."""

    @property
    def order(self) -> int:
        """Order of the propagated solution."""

    @property
    def reference(self) -> str:
        """Source of the scheme."""

    @property
    def forms(self) -> tuple[str, ...]:
        """Problem forms that it solves."""

    @property
    def adaptive(self) -> bool:
        """Whether it estimates its error and chooses its steps."""

    @property
    def parameters(self) -> tuple[IntegratorParameter, ...]:
        """Numbers that shape the scheme."""

    @property
    def real_boundary(self) -> float:
        """End of the region of stability on the negative real axis."""

    @property
    def stages(self) -> int:
        """Evaluations in a step, for estimates of the duration of a run."""

    def loop(self, adaptive: bool) -> Any:
        """Return the compiled loop for constant or adaptive steps, or None if it depends on the model."""

    @property
    def row_targets(self) -> tuple[str, ...]:
        """Targets of sweeps with a loop over many runs: ``cpu``, ``lanes``, ``cuda``; empty without such a loop."""

    def setup(self, compiled: CompiledModel, spec: RunSpec, w: Array) -> Setup:
        """Return the arguments of the loop.

        Parameters
        ----------
        compiled : CompiledModel
            Model and method.
        spec : RunSpec
            Specification of the run.
        w : Array
            Scratch of a consistent start, with the mask of redundant rows.
        """


def chooses_steps(integrator: Integrator, options: Mapping[str, str | float]) -> bool:
    """Whether an integrator chooses its steps, by default or by the option ``adaptive``."""
    keys = (f"{owner}.adaptive" for owner in ("integrator", integrator.name))
    chosen = next((str(options[key]).lower() for key in keys if key in options), "")
    return chosen != "false" if integrator.adaptive else can_choose_steps(integrator) and chosen == "true"


def can_choose_steps(integrator: Integrator) -> bool:
    """Whether an integrator can choose its steps, by default or by its option ``adaptive``."""
    return bool(getattr(integrator, "estimates", integrator.adaptive))


def law_functions(compiled: CompiledModel, *names: str) -> tuple[Any, ...]:
    """Return the emitted functions for the first arguments of a loop, 0 for those that it does not call.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    *names : str
        Functions called besides ``rhs``, ``confirm`` and ``accept``: ``turn``, ``residual``, ``tangent``.
    """
    from symgen.run.layout.manifold import turn_nothing

    law = compiled.law_module
    # a law without pivots of S has nothing to confirm; coordinates whose rates are velocities are not turned
    common = law.rhs, getattr(law, "confirm", law.rhs), law.accept
    turn = getattr(compiled.model, "turn", turn_nothing) if "turn" in names else 0
    return *common, turn, *(getattr(law, name) if name in names else 0 for name in ("residual", "tangent"))
