"""What an integrator is to a run: a loop, and what the loop is entered with."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from symgen.runtime.compiled import CompiledModel
    from symgen.runtime.run import RunSpec

Array = NDArray[np.float64]


@dataclass(frozen=True)
class IntegratorParameter:
    """A number that an integrator takes.

    Parameters
    ----------
    name, note : str
        Note says what it does.
    default, minimum, maximum : float
        Values outside [minimum, maximum] are refused.
    """

    name: str
    default: float
    note: str
    minimum: float
    maximum: float


@dataclass(frozen=True)
class Setup:
    """What a loop is entered with beside the model, the state and the outputs.

    Attributes
    ----------
    loop : compiled function
        An instance of `symgen.runtime.frame.integrate`.
    functions : tuple
        What it takes first, from `law_functions`.
    scheme : record
        The scheme, one of those of `symgen.runtime.records`.
    step : float
        Constant step, or first step of an adaptive run [s]; 0: chosen by the loop.
    memory, room : int
        Numbers that the scheme keeps from step to step, and that it needs for one behind the state that is tried.
    safety : float
        Part of the step that its error estimate would allow that is taken.
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
        """Name as typed."""

    @property
    def order(self) -> int:
        """Order of the propagated solution."""

    @property
    def reference(self) -> str:
        """Source of the scheme."""

    @property
    def forms(self) -> tuple[str, ...]:
        """Problem forms it solves."""

    @property
    def adaptive(self) -> bool:
        """Whether it estimates its error and chooses its steps."""

    @property
    def parameters(self) -> tuple[IntegratorParameter, ...]:
        """Numbers that shape the scheme."""

    @property
    def real_boundary(self) -> float:
        """Where the region of stability ends on the negative real axis."""

    @property
    def stages(self) -> int:
        """Evaluations that a step takes, for estimates of how long a run lasts."""

    def loop(self, adaptive: bool) -> Any:
        """Return the compiled loop that runs with constant or adaptive steps enter; None: it depends on the model."""

    @property
    def row_targets(self) -> tuple[str, ...]:
        """Targets of sweeps with a loop over many runs: ``cpu``, ``lanes``, ``cuda``; none where there is no loop."""

    def setup(self, compiled: CompiledModel, spec: RunSpec, w: Array) -> Setup:
        """Return the arguments of the loop.

        Parameters
        ----------
        compiled : CompiledModel
            Model and method.
        spec : RunSpec
            What the run is to do.
        w : Array
            Scratch of a consistent start, with the mask of redundant rows.
        """


def adapts(integrator: Integrator, options: Mapping[str, str | float]) -> bool:
    """Whether an integrator chooses its steps: as it does by itself, or as the option ``adaptive`` sets."""
    keys = (f"{owner}.adaptive" for owner in ("integrator", integrator.name))
    chosen = next((str(options[key]).lower() for key in keys if key in options), "")
    return chosen != "false" if integrator.adaptive else estimates(integrator) and chosen == "true"


def estimates(integrator: Integrator) -> bool:
    """Whether an integrator can choose its steps, by itself or by its option ``adaptive``."""
    return bool(getattr(integrator, "estimates", integrator.adaptive))


def law_functions(compiled: CompiledModel, *names: str) -> tuple[Any, ...]:
    """Return the emitted functions that a loop takes first, 0 in place of those that it does not call.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    *names : str
        What is called beside ``rhs``, ``confirm`` and ``accept``: ``turn``, ``residual``, ``tangent``.
    """
    from symgen.runtime.manifold import stay

    law = compiled.law_module
    # a law without pivots of S has nothing to confirm; coordinates that change as velocities do are not turned
    common = law.rhs, getattr(law, "confirm", law.rhs), law.accept
    turn = getattr(compiled.model, "turn", stay) if "turn" in names else 0
    return *common, turn, *(getattr(law, name) if name in names else 0 for name in ("residual", "tangent"))
