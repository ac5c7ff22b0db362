"""Specification of a run for its loop: times, tolerances, limits, inputs between seams and switching functions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from symgen.run.loops.event_loop import EventState

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel

Array = NDArray[np.float64]

#: Default limit of attempts at an adaptive step in a run.
MAX_ATTEMPTS = 1e8


@dataclass(frozen=True)
class Seam:
    """A seam of two pieces of a run: the time at which a step ends, and the values of inputs from then on.

    Attributes
    ----------
    t : float
        The time [s]; that of the first one is the start.
    values : mapping of str to float
        Inputs that change; at the first one all that vary.
    skips : bool
        Whether a run goes on at the next seam, without a step between the two.
    strikes : bool
        Whether rates of gaps jump there, so that there may be impacts.
    """

    t: float
    values: Mapping[str, float]
    skips: bool = False
    strikes: bool = False


@dataclass(frozen=True)
class Switch:
    """A comparison in formulas of the state: a step ends where it changes, and the scheme begins anew.

    Attributes
    ----------
    missed : float
        Part of a step by which a passage may be missed.
    points : tuple of float
        Kinks of the table that is read; none for comparisons with zero.
    period : float
        Period of the table, 0 if it is not periodic.
    holds : bool
        Whether a row changes there, which is then examined.
    """

    missed: float = 0.0
    points: tuple[float, ...] = ()
    period: float = 0.0
    holds: bool = False


class RunFormulas(Protocol):
    """Formulas of a run, evaluated at one state."""

    @property
    def function(self) -> Any:
        """The same for loops."""

    def __call__(self, t: float, y: Array, p: Array, w: Array, ydot: Array, /) -> Array:
        """Return their values."""


class ChangingRows(Protocol):
    """Rows whose formulas may jump or have kinks over the state (`symgen.run.single.row_jumps`)."""

    def sentence(self, compiled: CompiledModel, state: EventState) -> str:
        """Return the sentence on a row that jumps or has a kink in the last step of a run; empty without one."""


@dataclass(frozen=True)
class BoundedNames:
    """What rows whose forces have bounds are called, two-sided ones first (`symgen.run.modes.choice`).

    Attributes
    ----------
    names : tuple of str
        Their names.
    kinds, nouns : tuple of str
        What each is, and what all of its family are.
    dry : int
        Number of those with two bounds.
    pressed : tuple of int
        Coordinates whose bounds depend on the reaction of their joint.
    drivers : tuple of str
        Names of the drivers of the mechanism.
    pieces : tuple of int
        One-sided rows that are further pieces of the gap of the row before them.
    contacts : tuple of int
        One-sided rows that are gaps of contacts.
    partners : tuple of int
        Of each row the other row of its contact, the gap or what acts along it; -1 for others.
    seconds, turning : tuple of int
        Rows that are the second one of two along a contact; rows against turning, without impulses.
    poisson : bool
        Whether restitutions are ratios of impulses.
    """

    names: tuple[str, ...]
    kinds: tuple[str, ...]
    nouns: tuple[str, ...]
    dry: int
    pressed: tuple[int, ...]
    drivers: tuple[str, ...]
    pieces: tuple[int, ...] = ()
    contacts: tuple[int, ...] = ()
    partners: tuple[int, ...] = ()
    seconds: tuple[int, ...] = ()
    turning: tuple[int, ...] = ()
    poisson: bool = False

    @property
    def one_sided(self) -> bool:
        """Whether any row is one-sided."""
        return self.dry < len(self.names)

    @property
    def one_problem(self) -> bool:
        """Whether one-sided rows have the impacts of contacts: beside reactions, and by Poisson's law."""
        return self.one_sided and (bool(self.pressed) or self.poisson)

    @property
    def paired(self) -> bool:
        """Whether slip of contacts has two rows, as in space."""
        return bool(self.seconds)


@dataclass(frozen=True, kw_only=True)
class BoundedRows(BoundedNames):
    """Rows whose forces have bounds, with their formulas.

    Attributes
    ----------
    names, kinds, nouns, dry, pressed, drivers, pieces, contacts, partners, seconds, turning, poisson
        See `BoundedNames`.
    state, accelerations : callable
        ``(t, y, p, w, rate)`` -> coordinates and gaps, their rates, bounds at rest and bounds at the beginning
        of a motion, of one-sided rows restitutions, where any are `shifted` by how
        much, and middles in motion; second derivatives of
        coordinates and gaps. Bounds by reactions are over these.
    reactions : callable or None
        ``(t, y, p, w, rate)`` -> components of the reactions of `pressed` coordinates, two each.
    varying : tuple of int
        Coordinates whose bounds are formulas of more than parameters.
    shifted : tuple of int
        Coordinates whose bounds at rest have another middle than those in motion.
    changes : bool
        Whether anything but the motion and inputs changes over time.
    losses : tuple of int or None
        Of each row that has impulses, the place in the state of the energy that it has taken; None for others, and
        where no output reads it.
    """

    state: RunFormulas
    accelerations: RunFormulas
    reactions: RunFormulas | None = None
    changes: bool = True
    losses: tuple[int | None, ...] = ()
    varying: tuple[int, ...] = ()
    shifted: tuple[int, ...] = ()

    @property
    def values(self) -> int:
        """Number of values of `state`."""
        return 3 * len(self.names) + (3 if self.shifted else 1) * self.dry


@dataclass(frozen=True)
class Watched:
    """The switching functions of a run: of its events, then of the comparisons in its formulas.

    Attributes
    ----------
    names : tuple of str
        Names of the events.
    directions : tuple of int
        1, -1, or 0 for both.
    actions : tuple of str
        ``record``, ``stop`` or ``reset``.
    words : tuple of str
        What happens to the row with bounds of each event; empty for other events.
    owners : tuple of int
        Numbers of these rows; -1 for other events.
    function : emitted function
        Values of all functions, then their rates, then the scale of the rounding of each value.
    needs_rates : bool
        Whether the rates depend on accelerations.
    effects : Effects or None
        What events change, see `symgen.run.effects.effects`; None where they change nothing.
    switches : tuple of Switch
        Comparisons in formulas.
    jumps : bool
        Whether rates may jump at a switch, and not only have a kink.
    rows : ChangingRows or None
        Rows that change at a switch.
    adaptive : bool
        Whether steps are adaptive: these end at switches, constant ones after them.
    bounded : BoundedRows or None
        Rows whose forces have bounds.
    of_forces : tuple of int
        Numbers of the functions that depend on accelerations or forces, whose rates count these as constant.
    corners : tuple of int
        Numbers of the events at which gaps of closed stops pass corners.
    turns : tuple of int
        Numbers of the rows with bounds whose gaps are formulas, which may turn sharply.
    missed : float
        Fraction of a step by which a corner may be missed.
    holding : bool
        Whether joints hold for a while.
    """

    names: tuple[str, ...]
    directions: tuple[int, ...]
    actions: tuple[str, ...]
    function: Any
    needs_rates: bool
    words: tuple[str, ...] = ()
    owners: tuple[int, ...] = ()
    effects: Any = None
    switches: tuple[Switch, ...] = ()
    jumps: bool = False
    rows: ChangingRows | None = None
    adaptive: bool = True
    bounded: BoundedRows | None = None
    of_forces: tuple[int, ...] = ()
    corners: tuple[int, ...] = ()
    turns: tuple[int, ...] = ()
    missed: float = 0.0
    holding: bool = False

    @property
    def turning(self) -> tuple[str, ...]:
        """What of rows has its own meanings in a turn, see `symgen.run.modes.turn_meanings.TURNING`."""
        rows, holding = self.bounded, ("holding",) * self.holding
        if rows is None:
            return holding
        has = {
            "pressed": rows.pressed and not rows.one_sided,
            "corners": self.corners,
            "pieces": rows.pieces,
            "contacts": rows.contacts,
            "reactions": rows.one_problem,
            "poisson": rows.one_problem and rows.poisson,
            "paired": rows.paired,
        }
        return (*(kind for kind, those in has.items() if those), *holding)

    def events_of_rows(self, word: str, rows: int) -> list[int]:
        """Return the event with a word of each of some rows with bounds; -1 where a row has none."""
        found = {
            row: event for event, (row, own) in enumerate(zip(self.owners, self.words, strict=True)) if own == word
        }
        return [found.get(row, -1) for row in range(rows)]


@dataclass(frozen=True)
class RunSpec:
    """Specification of a run.

    Parameters
    ----------
    until : float
        End time [s].
    step : float or None
        Constant step, or first step of an adaptive run [s]; None lets an adaptive run choose.
    adaptive : bool
        Whether steps follow the error estimate.
    rtol, atol : float
        Tolerances of an adaptive run.
    relative : bool
        Whether `atol` applies to coordinates and speeds over the mechanism's own; else it has their units.
    times : Array
        Output times, increasing.
    largest_step : float
        Bound of adaptive steps [s].
    largest_turn : float
        Bound of the change of an angle in a step, as angles that count turns follow it [rad].
    max_violation : float
        Largest tolerated |Phi| (times the scale of lengths) and |D v - nu| (times the largest speed).
    max_velocity_violation : float or None
        The limit of |D v - nu| where it differs.
    max_energy_error : float
        Largest tolerated energy error, as a fraction of the energy in motion.
    integrator_parameters : mapping
        Values of the integrator's parameters that differ from the defaults.
    max_evaluations : int or None
        Evaluations of the right-hand side, after which no step begins.
    max_attempts : float
        An adaptive run is stopped when it has taken, or at its present rate would take, more attempts at a step.
    duration : float or None
        Time in which a motion that begins at rest is taken to cross the mechanism [s]; until `until` by default.
    seams : tuple of Seam
        Times at which inputs jump, and their values from then on; the first one has the values at the start.
    events : Watched or None
        Switching functions: events, and ends of adaptive steps.
    in_place : str
        What to write in place of formulas that jump with the state; empty without such formulas.
    """

    until: float
    step: float | None
    adaptive: bool
    times: Array
    rtol: float = 1e-8
    atol: float = 1e-10
    relative: bool = False
    largest_step: float = np.inf
    largest_turn: float = np.inf
    max_violation: float = 1e-6
    max_velocity_violation: float | None = None
    max_energy_error: float = 0.05
    integrator_parameters: Mapping[str, float] = field(default_factory=dict)
    max_evaluations: int | None = None
    max_attempts: float = MAX_ATTEMPTS
    duration: float | None = None
    seams: tuple[Seam, ...] = ()
    events: Watched | None = None
    in_place: str = ""

    @property
    def velocity_limit(self) -> float:
        """Largest tolerated |D v - nu|, as a fraction of the largest speed."""
        return self.max_violation if self.max_velocity_violation is None else self.max_velocity_violation
