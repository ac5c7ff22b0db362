"""Tables and facts of one run: frozen and labelled."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from symgen.arguments import shown
from symgen.describe.mechanism import ACCELERATIONS
from symgen.errors import InputError, nearest
from symgen.result.labelled import Array, Labelled
from symgen.result.tables import MotionTables

if TYPE_CHECKING:
    from symgen.result.measured import Measured
    from symgen.result.reactions import Forces
    from symgen.result.run_parts import Rank, Seconds
    from symgen.runtime.events import EventRecord
    from symgen.runtime.last_state import LastState
    from symgen.runtime.outcome import Outcome, RankEvent

#: What a run can end as.
OK, UNVERIFIED, FAILED = "ok", "unverified", "failed"
#: Tables of a result: of the state and of what follows from it, of forces, and of the file's own quantities.
TABLES = (
    *("q", "v", "a", "lam", "reactions", "body_reactions", "magnitudes", "joint_coordinates"),
    *("points", "elements", "outputs", "energy", "violations"),
)
#: Columns of two of them.
ENERGIES, VIOLATIONS = ("kinetic", "potential", "work", "error"), ("position", "velocity", "acceleration")
#: Reason of a run that was stopped from outside.
INTERRUPTED = "interrupted"


def accelerations_of(velocities: Iterable[str]) -> tuple[str, ...]:
    """Return the names of accelerations by those of the velocities."""
    parts = (name.rpartition(".") for name in velocities)
    return tuple(f"{body}.{ACCELERATIONS[component]}" for body, _, component in parts)


@dataclass(frozen=True, repr=False)
class RunData(MotionTables):
    """What a run gave, see `symgen.Result`, which adds the ways out of Python."""

    of_process: ClassVar[tuple[str, ...]] = ("outcome", "forces", "measured", "ended")
    kept: ClassVar[tuple[str, ...]] = (
        *("non_unique_reactions", "shape", "start", "last_state"),
        "_final_multipliers",
    )

    mechanism: str
    method: str
    integrator: str
    step: float | None
    rtol: float | None
    atol: float | None
    until: float
    status: str
    reason: str | None
    warnings: tuple[str, ...]
    notes: tuple[str, ...]
    parameters: Mapping[str, float]
    t: Array
    q: Labelled
    v: Labelled
    kinetic: Array
    potential: Array
    work: Array
    energy_error: Array
    smallest_pivot: Array
    rank: Rank
    rank_events: tuple[RankEvent, ...]
    rank_event_count: int
    steps: int
    rejected: int
    evaluations: int
    iterations: int
    seconds: Seconds
    position_violation_max: float
    velocity_violation_max: float
    energy_drift_max: float
    error_estimate: float | None
    outcome: Outcome
    forces: Forces
    measured: Measured
    ended: Callable[[], LastState]
    inputs: Mapping[str, str | float] = field(default_factory=dict)
    end: float = math.nan
    events: tuple[EventRecord, ...] = ()
    accumulation: float | None = None
    coordinates: str = "absolute"
    state: tuple[str, ...] = ()
    watched: tuple[tuple[str, str], ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the tables."""
        return TABLES

    @property
    def searched(self) -> tuple[str, ...]:
        """Tables in which a column is looked for by its name alone, cheap ones first."""
        return ("q", "v", "joint_coordinates", "a", "lam", "reactions", "outputs", "elements", "points")

    # -- derived, when first asked for ---------------------------------------------------------------------------------

    @cached_property
    def a(self) -> Labelled:
        """Accelerations v', named after the velocities: ``crank.ax``, ``crank.alpha``."""
        units = tuple(f"{unit}^2" for unit in self.v.units)
        return Labelled(self.outcome.accelerations, accelerations_of(self.v.names), units)

    @cached_property
    def violations(self) -> Labelled:
        """Norms of Phi, ``D v - nu`` and ``D v' - gamma``: ``position``, ``velocity``, ``acceleration``."""
        status = self.outcome.status_columns
        values = np.column_stack([status[:, 0], status[:, 1], self.outcome.acceleration_violations])
        return Labelled(values, VIOLATIONS, ("m", "m/s", "m/s^2"))

    @cached_property
    def body_reactions(self) -> Labelled:
        """The reactions in the axes of the bodies that they act on, under the same names."""
        return self.forces.in_body_axes(self.reactions)

    def reaction(self, joint: str) -> Array:
        """Return the reaction of one joint, shape (k, 3), in space (k, 6): force [N] and moment [N m]."""
        known = list(dict.fromkeys(name.rpartition(".")[0] for name in self.reactions.names))
        if joint not in known:
            raise InputError("joint", "the name of a joint", shown(joint), nearest(str(joint), known))
        return self.reactions[joint]

    @cached_property
    def _final_multipliers(self) -> dict[str, float]:
        return self.forces.final()

    @property
    def interrupted(self) -> bool:
        """Whether the run was stopped from outside."""
        return self.reason == INTERRUPTED

    @property
    def ok(self) -> bool:
        """Whether the status is ``"ok"``."""
        return self.status == OK

    @property
    def energy(self) -> Labelled:
        """Energies as one table: ``kinetic``, ``potential``, ``work``, ``error`` [J]."""
        values = np.column_stack([self.kinetic, self.potential, self.work, self.energy_error])
        return Labelled(values, ENERGIES, ("J",) * len(ENERGIES))

    @cached_property
    def last_state(self) -> LastState:
        """Where the run ended, with all that it kept: what another one goes on from."""
        return self.ended()

    @cached_property
    def start(self) -> dict[str, Any]:
        """State that the run began with: ``t``, and by name ``q`` and ``v``."""
        y, nq = self.outcome.start.y, len(self.q.names)
        return {
            "t": self.outcome.start.t,
            "q": dict(zip(self.q.names, y[:nq].tolist(), strict=True)),
            "v": dict(zip(self.v.names, y[nq : nq + len(self.v.names)].tolist(), strict=True)),
        }

    @cached_property
    def shape(self) -> str:
        """Return the shape of the code that ran: ``straight`` or ``looped``."""
        return self.outcome.compiled.shape
