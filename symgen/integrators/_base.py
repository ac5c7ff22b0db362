"""What an integrator is to a run: a loop with its arguments, and what it promises."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from symgen.model import CompiledModel
    from symgen.runtime.run import RunSpec

Array = NDArray[np.float64]


@dataclass(frozen=True)
class IntegratorParameter:
    """A number that an integrator takes; values outside [minimum, maximum] are refused."""

    name: str
    default: float
    note: str
    minimum: float
    maximum: float


@dataclass(frozen=True)
class State:
    """The arrays a loop works on: state, parameters, scratch and integers."""

    y: Array
    p: Array
    w: Array
    iw: NDArray[np.int64]


@dataclass(frozen=True)
class LoopCall:
    """A loop and what it is called with.

    Outputs and what the run watches stand between the two tuples: ``loop(*before, times, states, status, gauges,
    control, events, *after)``.
    """

    loop: Any
    before: tuple[Any, ...]
    after: tuple[Any, ...]


@dataclass(frozen=True)
class BatchCall:
    """A loop over many runs, as in `symgen.runtime.batch`: what stands between functions and rows, and working memory.

    Attributes
    ----------
    loop : compiled function
        ``loop(*functions, *arguments, sizes, selected, ...)``.
    arguments : tuple
        The scheme and the steps.
    room : int
        Numbers of working memory that one run needs.
    """

    loop: Any
    arguments: tuple[Any, ...]
    room: int


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

    def loop(self, spec: RunSpec) -> Any:
        """Return the compiled loop that such runs enter, None where it depends on the model as well."""

    def call(self, compiled: CompiledModel, spec: RunSpec, state: State) -> LoopCall:
        """Return the loop for a run and its arguments."""


class BatchIntegrator(Integrator, Protocol):
    """An integrator that may have a loop over many runs."""

    def batch(self, ny: int, spec: RunSpec) -> BatchCall | None:
        """Return the loop over many runs with states of length `ny`, None where the scheme has none."""
