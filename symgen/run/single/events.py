"""Events of a run: their data for loops, their actions, and their accumulation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.ir.program import MODE_NUMBERS
from symgen.describe.bounds.bounded_modes import HIT, JAM, LEAVE, LIFT, REVERSE, SLIP
from symgen.describe.facts.gap_corners import CORNER
from symgen.describe.parts.event_sections import RECORD, STOP
from symgen.run.effects.effects import Impact
from symgen.run.layout import abi
from symgen.run.loops import event_loop
from symgen.run.loops import search_records as searching
from symgen.run.loops.afresh import begin_afresh
from symgen.run.single.contact_notes import sentence_on_motions, sentence_on_sharing

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel, ModelInfo
    from symgen.run.layout.records import Sizes, State
    from symgen.run.loops.run_spec import Watched
    from symgen.run.modes.row_records import Choice
    from symgen.run.single.outcome import Outcome
    from symgen.run.single.turn_of_run import TurnOfRun

Array = NDArray[np.float64]


def event_state(watched: Watched, sizes: Sizes, state: State) -> event_loop.EventState:
    """Return the initial state of a run with the state of its events."""
    events, n = len(watched.names), len(watched.names) + len(watched.switches)
    points = [x for switch in watched.switches for x in switch.points]
    first = event_loop.notes_at(n, sizes.width, len(state.w))
    noted = events + sum(switch.holds for switch in watched.switches)
    tables = first + ((searching.NOTES + 2 * noted) * (2 + sizes.width) if noted else 0)
    beginning = tables + len(points)
    examined = watched.rows is not None or (watched.turns and watched.adaptive)
    hunt = np.zeros(beginning + (1 + 2 * sizes.width if examined else 0))
    hunt[searching.COUNT], hunt[searching.NEEDS_RATES] = n, watched.needs_rates
    hunt[searching.TABLES], hunt[tables:beginning] = tables, points
    hunt[searching.BEGINNING] = beginning if examined else 0
    hunt[searching.REACH] = 0.0 if watched.adaptive else np.inf
    columns = hunt[searching.N_HEAD :][: searching.N_COLUMNS * n].reshape(-1, n)
    columns[searching.DIRECTION, :events] = watched.directions
    columns[searching.ACTION, :events] = [action != RECORD for action in watched.actions]
    columns[searching.ACTION, events:] = [(searching.ANEW, searching.EXAMINE)[x.holds] for x in watched.switches]
    columns[searching.OF_FORCES, list(watched.of_forces)] = 1.0
    columns[searching.MARGIN, :events], columns[searching.ROW, :events] = margins_of(watched)
    columns[searching.MISSED, list(watched.corners)] = watched.missed
    columns[searching.MISSED, events:] = [switch.missed for switch in watched.switches]
    columns[searching.PERIOD, events:] = [switch.period for switch in watched.switches]
    sizes_of_tables = [len(switch.points) for switch in watched.switches]
    columns[searching.POINTS, events:] = sizes_of_tables
    columns[searching.FIRST, events:] = np.cumsum([0, *sizes_of_tables])[:-1]
    return event_loop.EventState._make((*state, hunt))


#: Kinds of margins by the words of events.
_MARGINS = {
    **{SLIP: searching.FORCE, LEAVE: searching.FORCE, LIFT: searching.FORCE},
    **{HIT: searching.GAP, REVERSE: searching.RATE, JAM: searching.PART, CORNER: searching.CORNER},
}


def margins_of(watched: Watched) -> tuple[list[int], list[int]]:
    """Return of which kind of margin each event is, 0 for others, and the number of its bounded row."""
    return [_MARGINS.get(word, 0) for word in watched.words], [max(row, 0) for row in watched.owners]


@dataclass(frozen=True)
class Happening:
    """An event that happened.

    Attributes
    ----------
    t : float
        Time [s].
    name, action : str
        Name and action of the event.
    state : Array, shape (nq + nv,)
        Coordinates and velocities before a reset.
    own : Array
        States of the file's own before a reset.
    impact : Impact or None
        Effect of a reset; resets at the same time share it.
    energy : float
        Energy added by the reset [J]; for resets at the same time, the first has the total.
    left : float or None
        Time until impacts would have accumulated [s], where a gap is at rest by them.
    number : int
        Number of the event; -1 where none is named, as what happened has been found beside others.
    """

    t: float
    name: str
    action: str
    state: Array
    own: Array
    impact: Impact | None = None
    energy: float = 0.0
    left: float | None = None
    number: int = -1


class Events:
    """The events of a run.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    watched : Watched
        Switching functions of its events.
    until : float
        End of the run [s].

    Attributes
    ----------
    happened : list of Happening
        Past events in order of time.
    accumulation : float or None
        Time at which events accumulate [s].
    turn : TurnOfRun or None
        What happens at them, where they change the run.
    """

    def __init__(self, compiled: CompiledModel, watched: Watched, until: float) -> None:
        self.compiled, self.watched, self.until = compiled, watched, until
        self.happened: list[Happening] = []
        self.accumulation: float | None = None
        self.turn: TurnOfRun | None = None
        self._recent: tuple[str, ...] = ()
        self._jump, self._changes, self._noted = "", False, 0.0

    def forget_after(self, t: float) -> None:
        """Remove later events, as a run continues from an earlier state."""
        self.happened = [event for event in self.happened if event.t <= t]
        self.accumulation = None
        if self.turn is not None:
            self.turn.forget_after(self.happened)

    def take(self, state: event_loop.EventState) -> list[tuple[int, Happening]]:
        """Store and return the passages noted by a loop since the last call, with numbers of events."""
        names, actions, info = self.watched.names, self.watched.actions, self.compiled.info
        self._noted = float(state.hunt[searching.NOTED])
        notes = event_loop.taken_notes(state.hunt, len(state.y), len(state.w))
        events = [
            (number, Happening(t, names[number], actions[number], y[: info.work], y[info.own_states], number=number))
            for t, number, y in notes
            if number < len(names)
        ]
        self._changes = len(events) < len(notes)
        self.happened += (event for _, event in events)
        return events

    def meet(self, state: event_loop.EventState, events: Sequence[tuple[int, Happening]]) -> int:
        """Do what happens at the events at which a loop ended; return `DONE` if it may be entered again.

        Parameters
        ----------
        state : State
            State at the events; changed by resets.
        events : sequence of (int, Happening)
            From `take`.

        Raises
        ------
        InputError
            If the constraints, or other events at the same time, do not allow what happens.
        """
        now = float(state.clock[abi.TIME])
        if self._changes:  # of formulas of rows
            if self._finds_jump(state):
                return abi.JUMPED
            if self.watched.adaptive:
                begin_afresh(state)
        here = [event for _, event in events if event.t == now]
        if self.turn is None:
            return abi.MET if any(event.action == STOP for event in here) else abi.DONE
        state.hunt[searching.NOTED] = self._noted  # the turn reads the notes
        try:
            code = self.turn.meet(here)
        finally:
            state.hunt[searching.NOTED] = 0.0
        self.accumulation, self._recent = self.turn.accumulation if code == abi.GATHERED else (None, ())
        return code

    def _finds_jump(self, state: event_loop.EventState) -> bool:
        """Return whether a row jumps or has a kink in the last step, and store the sentence on it."""
        rows = self.watched.rows
        self._jump = "" if rows is None else rows.sentence(self.compiled, state)
        if not self._jump and self.watched.turns and self.turn is not None:
            self._jump = self._turned_stop(state, self.turn.memory.choice)
        return bool(self._jump)

    def _turned_stop(self, state: event_loop.EventState, choice: Choice) -> str:
        """Return the sentence on the closed stop whose row has turned within the last step; empty without one."""
        watched, rows, hunt, info = self.watched, self.watched.bounded, state.hunt, self.compiled.info
        most = event_loop.FAR * watched.missed * state.w[abi.SPEED]
        if rows is None or not (watched.adaptive and hunt[searching.SPED] > most):
            return ""
        t, width = float(state.clock[abi.TIME]), len(state.y)
        y = hunt[int(hunt[searching.BEGINNING]) + 1 + width :][:width]
        with np.errstate(all="ignore"):
            values = rows.state(t, y.copy(), state.p, state.w.copy(), np.zeros(width))
        held = state.w[choice.rows.first :][: MODE_NUMBERS * len(rows.names) : MODE_NUMBERS] != 0.0
        rates = np.where(held, np.abs(values[len(rows.names) :][: len(rows.names)]), -1.0)
        rates[[i for i in range(len(rows.names)) if i not in watched.turns]] = -1.0
        i = int(np.argmax(rates))
        if not rates[i] > event_loop.SMALL * hunt[searching.SPED]:  # something else is astray
            return ""
        unit = info.rows[info.bounded[i]].unit
        return (
            f"the gap of {rows.names[i]} turns sharply at t = {t:.6g} s: the closed stop would change its rate by "
            f"{rates[i]:.6g} {unit}/s without an impact; corners of abs, min, max and conditions are impacts"
        )

    def reason(self, code: int, state: State, t: float) -> str:
        """Return the reason for the end of a run at a time [s]: events accumulate, or a condition is undefined."""
        if code == abi.GATHERED:
            return accumulation_sentence(self._recent, self.accumulation or t)
        assert isinstance(state, event_loop.EventState), "a run with events"
        return undefined_sentence(self.watched.names[event_loop.undefined_event(state)], t)

    def jump(self, state: State) -> str:
        """Return the sentence on a row that jumps or has a kink where a run failed; empty without one."""
        assert isinstance(state, event_loop.EventState), "a run with events"
        _ = self._jump or self._finds_jump(state)
        return self._jump


def accumulation_sentence(names: Sequence[str], t: float) -> str:
    """Return the reason for the end of a run whose events `names` accumulate at a time [s]."""
    events = " and ".join(f"'{name}'" for name in names)
    return f"events of {events} accumulate at t = {t:.13g} s: the model does not determine the motion after that"


def undefined_sentence(name: str, t: float) -> str:
    """Return the reason for the end of a run at an event with an undefined condition, at a time [s]."""
    return f"the condition of the event '{name}' is undefined at t = {t:.6g} s"


# -- events with names -------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class EventRecord:
    """An event that happened during a run.

    Attributes
    ----------
    t : float
        Time [s].
    name, action : str
        Name of the event, and its action: ``record``, ``stop`` or ``reset``.
    q, v : mapping
        Coordinates and velocities at the event, before a reset.
    v_after : mapping or None
        Velocities after a reset.
    impulses : mapping
        Impulses of a reset: of constraint rows, signed as the multipliers, and along the velocities with new values.
    work : float
        Energy added by a reset [J]; for resets at the same time, the first has the total.
    """

    t: float
    name: str
    action: str
    q: Mapping[str, float]
    v: Mapping[str, float]
    v_after: Mapping[str, float] | None = None
    impulses: Mapping[str, float] = field(default_factory=dict)
    work: float = 0.0

    def to_json(self) -> dict[str, Any]:
        """Return the record as JSON data."""
        after = None if self.v_after is None else dict(self.v_after)
        state = {"q": dict(self.q), "v": dict(self.v), "v_after": after}
        numbers = {"impulses": dict(self.impulses), "work": self.work}
        return {"t": self.t, "name": self.name, "action": self.action, **state, **numbers}


def stop_notes(outcome: Outcome) -> list[str]:
    """Return a note on the event at which a run ended, if any."""
    names = [f"'{e.name}'" for e in outcome.happened if e.action == STOP and e.t == outcome.end]
    if not names or outcome.code != abi.DONE:
        return []
    return [f"stopped at t = {outcome.end:.13g} s by the event {' and '.join(names)}"]


def gap_notes(outcome: Outcome) -> list[str]:
    """Return a note on gaps that were closed at the start without being 0."""
    turn = outcome.simulation.turn
    put = {} if turn is None else turn.gaps_put
    gaps = ", ".join(f"{name} ({gap:.3g})" for name, gap in put.items())
    return [f"gaps that touch at the start were put to 0: {gaps}"] if gaps else []


def sharing_notes(outcome: Outcome) -> list[str]:
    """Return notes on contacts whose forces have not been unique, and on motions that were not sought."""
    turn = outcome.simulation.turn
    return [] if turn is None else [*sentence_on_sharing(turn.sharing), *sentence_on_motions(turn.unsought)]


def rest_notes(outcome: Outcome) -> list[str]:
    """Return a note on each gap that ever faster impacts have brought to rest, with the time that was left.

    A single impact without rebound accumulates nothing: its events say all.
    """
    notes = dict.fromkeys(
        f"impacts of {event.name.rpartition('.')[0]} accumulate at t = {event.t + event.left:.13g} s: "
        f"it rests from t = {event.t:.13g} s on, where {event.left:.3g} s were left"
        for event in outcome.happened
        if event.left
    )
    return list(notes)


def impact_notes(outcome: Outcome) -> list[str]:
    """Return a note on the first impact at several gaps at once, if any."""
    hits = [event for event in outcome.happened if event.name.endswith(f".{HIT}") and event.impact is not None]
    for first, second in pairwise(hits):
        if first.impact is second.impact:
            together = dict.fromkeys(event.name.rpartition(".")[0] for event in hits if event.impact is first.impact)
            struck = " and ".join(together) if len(together) > 1 else f"pieces of {first.name.rpartition('.')[0]}"
            return [
                f"{struck} strike at once at t = {first.t:.13g} s: by Newton's law each gap opens with "
                "its restitution times the rate at which it closed, which is not what impacts one after the other do"
            ]
    return []


def record_of(info: ModelInfo, event: Happening) -> EventRecord:
    """Return an event of a run with names."""
    q = {c.name: float(x) for c, x in zip(info.coordinates, event.state[: info.nq], strict=True)}
    v = {c.name: float(x) for c, x in zip(info.velocities, event.state[info.nq :], strict=True)}
    impact = event.impact
    if impact is None:
        return EventRecord(event.t, event.name, event.action, q, v)
    after = {c.name: float(x) for c, x in zip(info.velocities, impact.v, strict=True)}
    signs = [-1.0] * info.m + [1.0] * len(impact.imposed)  # D^T lambda is on the left of the equations of motion
    names = [*(row.name for row in info.rows), *impact.imposed]
    bounded = (info.rows[i].name for i in info.bounded)
    closed, impulses = {f"{row.rpartition('.')[0]}.rate": row for row in bounded}, dict[str, float]()
    for name, s, x in zip(names, signs, impact.impulses, strict=True):  # of a closed gap and of one that strikes
        row = closed.get(name, name)
        impulses[row] = impulses.get(row, 0.0) + float(s * x)
    return EventRecord(event.t, event.name, event.action, q, v, after, impulses, event.energy)
