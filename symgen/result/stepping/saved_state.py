"""The whole state of a run, as a value that can be sent elsewhere."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.base.version import __version__
from symgen.describe.facts.digest import digest
from symgen.describe.parts.event_sections import events_in_words
from symgen.run.layout import abi

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.planning.plan import Plan
    from symgen.run.single.events import Happening


@dataclass(frozen=True)
class Saved:
    """All that a run remembers at an accepted state; see `SteppedRun.save`.

    It can be pickled, and taken up in another process by a run of the same model, method and integrator.

    Attributes
    ----------
    owner : mapping
        Properties that a run must share with the saved one, in words.
    arrays : mapping of str to array
        State, time, work, scratch, counters, past points and factors, by name.
    step : float
        The constant step of the grid that the run is on [s].
    parameters : mapping of str to float
        Values at that time.
    clocks : tuple of (float, float, int)
        Start [s], interval [s] and next beat of every controller.
    happened : tuple of Happening
        Events since the start.
    """

    owner: Mapping[str, str] = field(repr=False)
    arrays: Mapping[str, NDArray[Any]] = field(repr=False)
    step: float = field(repr=False)
    parameters: Mapping[str, float]
    clocks: tuple[tuple[float, float, int], ...]
    happened: tuple[Happening, ...] = field(default=(), repr=False)

    @property
    def t(self) -> float:
        """Time of the state [s]."""
        return float(self.arrays["clock"][abi.TIME])

    def check(self, owner: Mapping[str, str], arrays: Mapping[str, NDArray[Any]], intervals: tuple[float, ...]) -> None:
        """Refuse what belongs to another run.

        Parameters
        ----------
        owner, arrays, intervals
            Of the run that is to take it up.

        Raises
        ------
        InputError
            If they do not fit; says what is different.
        """
        for what, own in owner.items():
            if self.owner.get(what) != own:
                raise InputError("restore", f"a state of {what} {own}", f"one of {self.owner.get(what, 'another')}")
        for name in {**arrays, **self.arrays}:
            array, own_array = self.arrays.get(name), arrays.get(name, np.zeros(0))
            if name not in arrays and isinstance(array, np.ndarray) and len(array) == 0:
                continue  # as runs without events kept of them once
            fits = isinstance(array, np.ndarray) and array.dtype == own_array.dtype and array.ndim == 1
            if not fits or (name in FIXED and len(array) != len(own_array)):  # type: ignore[arg-type]  # an array
                raise InputError("restore", f"'{name}' as this run has it", "another size or kind")
        saved = tuple(interval for _, interval, _ in self.clocks)
        if saved != intervals:
            expected = f"a run with controllers as that which was saved ({_every_array(saved)})"
            raise InputError("restore", expected, _every_array(intervals), "register them with `every` before")


def identity_of_run(mechanism: Mechanism, plan: Plan, compiled: CompiledModel) -> dict[str, str]:
    """Return the properties that a run must share with a saved one, in words."""
    law, steps = compiled.law, "varying" if plan.spec.adaptive else "constant"
    return {
        "symgen": __version__,
        "mechanism": f"{mechanism.name} ({digest(mechanism)[:16]})",
        "code of shape": compiled.shape,
        "method": f"{law.method} ({law.key})",
        "integrator": f"{plan.integrator.name} with {steps} steps",
        "events": events_in_words(plan.events) or "of no kind",
    }


#: Arrays that are as long in every run of a model: room for factors is made as it is needed.
FIXED = frozenset(
    {"y", "p", "w", "iw", "clock", "gauges", "control", "events", "memory", "share", "metric", "scales", "hunt"}
)


def _every_array(intervals: tuple[float, ...]) -> str:
    """Return intervals in words."""
    return "every " + ", ".join(f"{h:g} s" for h in intervals) if intervals else "none"
