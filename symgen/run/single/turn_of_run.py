"""The turn of a single run: what happens at its events by `symgen.run.modes.turn`, and its log as happenings.

Velocities that joints do not allow, and states without modes, are refused with their sentences.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.entry import bind_arguments
from symgen.compile.loopcode.loop_instances import compiled_loop
from symgen.compile.native import types
from symgen.describe.bounds.bounded_modes import HIT, MODE, REST
from symgen.describe.parts.event_sections import RESET, STOP
from symgen.run.effects.accumulation import Past, add_resets
from symgen.run.effects.applying import NO_VALUES, NO_VELOCITIES
from symgen.run.effects.pushing import KeptSeries, KeptTies
from symgen.run.effects.resets import KEEPING, KeptEffect, OfEffects
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.loops.event_loop import EVENT_STATE, EventState
from symgen.run.modes.bounded_rows import NOT_APPLIED, SIGN
from symgen.run.modes.pin_impulses import kicks_along_rows
from symgen.run.modes.refusals import HOLDING_SENTENCES, names_in, refusal, refusal_of_catch
from symgen.run.modes.turn import FURTHER, begin_modes, open_rows_of, take_resets, take_turn
from symgen.run.modes.turn_meanings import CONTACTS, CORNERS, meanings_of_turn
from symgen.run.modes.turn_records import OfModes
from symgen.run.single.contact_notes import sharing_contacts
from symgen.run.single.events import Happening
from symgen.run.single.turn_memory import WORDS, effects_of_runs, modes_of_runs, what_changes

if TYPE_CHECKING:
    from symgen.compile.native.types import Signature
    from symgen.run.effects.effects import Impact
    from symgen.run.loops.run_spec import Watched
    from symgen.run.single.simulation import Simulation

Array = NDArray[np.float64]

#: What is asked for: modes where a run begins or inputs have changed; the same after all rows were taken out of force,
#: as gaps may strike; what happens at the events noted; why a step has failed.
BEGIN, BEGIN_OPEN, MEET, END = range(4)


def serve_modes(doing: float, modes: OfModes, state: EventState) -> int:
    """Begin in modes, or do what happens at events; see `take_turn`."""
    if doing >= float(MEET):
        return int(take_turn(abi.MET if doing == float(MEET) else int(doing) - END, modes, state))
    if doing == float(BEGIN_OPEN):
        open_rows_of(modes, state)
    return int(begin_modes(modes, state))


def serve_resets(doing: float, effects: OfEffects, state: EventState) -> int:
    """Do what happens at the events of a run without rows with bounds; see `take_resets`."""
    return int(take_resets(abi.MET, effects, state))


_loops: dict[str, Any] = {}


def serving_function(modes: bool, effects: bool, turning: tuple[str, ...]) -> tuple[Any, Signature]:
    """Return `serve_modes` or `serve_resets`, made at the first use, and its types.

    Parameters
    ----------
    modes, effects : bool
        Whether rows have bounds, and events change the run or gaps strike.
    turning : tuple of str
        See `symgen.run.loops.run_spec.Watched`.
    """
    name = "_".join(("serve_modes" if modes else "serve", *["and_resets"] * (modes and effects), *turning))
    signature = types.int64(types.float64, FURTHER["modes" if modes else "effects"], EVENT_STATE)
    if name not in _loops:
        meanings = {**KEEPING, **meanings_of_turn(effects and modes, turning)}
        source = serve_modes if modes else serve_resets
        name_of_loop = f"compiled_{name}"  # it is found by its name, as all loops are
        # a turn is entered at events alone: passes over its text would take longer than the events of any run
        loop = compiled_loop(__name__, name_of_loop, source, signature, once=True, **meanings)
        _loops[name] = globals()[name_of_loop] = loop
    return _loops[name], signature


class TurnOfRun:
    """What happens where a run begins, at its events, and where its inputs change.

    Parameters
    ----------
    simulation : Simulation
        The run, which has events.
    watched : Watched
        Its events.

    Attributes
    ----------
    gaps_put : dict of str to float
        What the gaps were that the start has put to 0, by the names of their rows.
    sharing : set of str
        Contacts that have had forces which are not unique.
    unsought : int
        Most rows that depend on each other, of which other motions than the one found were not sought.
    """

    def __init__(self, simulation: Simulation, watched: Watched) -> None:
        self.simulation, self.watched, self.rows = simulation, watched, watched.bounded
        self.effects = what_changes(simulation.compiled, watched)
        self.gaps_put = dict[str, float]()
        self.sharing = set[str]()
        self.unsought = 0

    # -- entries -------------------------------------------------------------------------------------------------------

    def begin(self, opened: bool = False) -> None:
        """Choose modes where the run begins, or goes on after something has changed.

        Parameters
        ----------
        opened : bool
            Whether all rows are taken out of force before, as closed gaps may strike.

        Raises
        ------
        InputError
            If the state has no modes.
        """
        state, info = self.simulation.state, self.simulation.compiled.info
        if self.rows is None or (state.control[abi.BEGUN] == 1 and not opened):
            return
        y = state.y.copy()
        before = self._count
        self._serve(BEGIN_OPEN if opened else BEGIN)
        if state.control[abi.STEPS] == 0:
            self._keep_gaps_put()
        self._note(before, Happening(self._now, "", MODE, y[: info.work], y[info.own_states]))

    def meet(self, happened: Sequence[Happening]) -> int:
        """Do what happens at the events at which a loop ended; return `DONE` if it may be entered again.

        Parameters
        ----------
        happened : sequence of Happening
            Events at the present time, the latest ones of the run.

        Raises
        ------
        InputError
            If joints, or other events, do not allow what an event sets, or the state has no modes.
        """
        stops = any(event.action == STOP for event in happened)
        if all(event.action not in (RESET, MODE) for event in happened):
            return abi.MET if stops else abi.DONE
        before = self._count
        code = self._serve(MEET)
        self._write_resets()
        if self.rows is not None:
            here, past = replace(happened[0], action=MODE, impact=None, energy=0.0), self._happened
            past[:] = [event for event in past if event.t != here.t or event.action != MODE]
            self._note(before, here)
        return {abi.DONE: abi.MET, abi.MET: abi.DONE}.get(code, code)

    def _keep_gaps_put(self) -> None:
        """Keep the gaps that the start has put to 0."""
        assert self.rows is not None, "gaps belong to rows"
        moved = self.memory.choice.placing.moved
        self.gaps_put = {name: float(x) for name, x in zip(self.rows.names, moved, strict=True) if x != 0.0}

    def explain_end(self, code: int) -> None:
        """Look for the reason why a step has failed, by the code of the loop.

        Raises
        ------
        InputError
            If a formula of a row is no number after the present time.
        """
        if self.rows is not None:
            self._serve(END + code)

    def _serve(self, doing: int) -> int:
        """Enter the compiled turn; return its code, `MET` to go on, unless it is refused."""
        resets, state = self._resets, self.simulation.state
        resets.ends[:] = resets.kept.energy[:] = np.nan
        if self.rows is not None:
            strikes = self.memory.strikes
            strikes.left[:] = strikes.struck.energy[:] = strikes.rested.energy[:] = np.nan
        try:
            with np.errstate(all="ignore"):
                code = int(self._entry(float(doing)))
        except (ArithmeticError, ValueError):  # plain Python raises where compiled code has numbers that are not finite
            if not resets.chosen.any():
                raise
            code, resets.ends[e.FAILURE] = e.IMPOSSIBLE, NO_VELOCITIES
        if code in (e.IMPOSSIBLE, e.NO_MODES):
            raise self._refusal(code)
        if resets.ends[e.UNSOUGHT] > 0.0:
            self.unsought = int(resets.ends[e.UNSOUGHT])
        if self.rows is not None and self.rows.contacts:
            choice = self.memory.choice
            modes = state.w[choice.rows.first : choice.rows.first + MODE_NUMBERS * choice.rows.count].reshape(
                -1, MODE_NUMBERS
            )
            self.sharing |= sharing_contacts(self.rows, modes)
        if self.rows is not None and self.memory.renewed[0]:  # the matrices of a scheme depend on the rows
            self.memory.renewed[0] = 0
            self._renew_scheme()
        elif self.watched.holding:
            self._renew_scheme()
        return code

    def _renew_scheme(self) -> None:
        """Set up the scheme for the rows that are in force."""
        simulation = self.simulation
        simulation.scheme = simulation.integrator.setup(simulation.compiled, simulation.spec, simulation.state.w).scheme

    def _refusal(self, code: int) -> InputError:
        """Return why the run cannot go on."""
        resets, state, info = self._resets, self.simulation.state, self.simulation.compiled.info
        failure, which, first, second = (float(resets.ends[k]) for k in range(e.FAILURE, e.SECOND_NUMBER + 1))
        v = state.y[info.nq : info.work].copy()
        if code == e.IMPOSSIBLE:
            numbers = np.flatnonzero(resets.chosen).tolist()
            if failure in HOLDING_SENTENCES:
                event = self.watched.names[int(resets.ends[e.IMPOSSIBLE_EVENT])]
                return refusal_of_catch(int(failure), event, first, self._now)
            if failure == NO_VALUES:
                return self.effects.no_values(numbers, resets.chosen, resets.work, self._now)
            return self.effects.no_velocities(numbers, resets.work, v, self._now)
        assert self.rows is not None, "rows have modes"
        if failure == NOT_APPLIED:
            hits = self.watched.events_of_rows(HIT, len(self.rows.names))
            numbers = [hit for row, hit in enumerate(hits) if int(which) >> row & 1]
            return self.effects.no_velocities(numbers, resets.work, v, self._now)
        every = [row.name for row in info.rows]
        return refusal(self.rows, every, int(failure), which, first, second, self._now)

    # -- what has happened ---------------------------------------------------------------------------------------------

    @property
    def accumulation(self) -> tuple[float, tuple[str, ...]]:
        """The time at which resets accumulate [s], and the events with the latest ones."""
        ends = self._resets.ends
        return float(ends[e.ACCUMULATION]), tuple(names_in(float(ends[e.GATHERING]), self.watched.names))

    @property
    def effects_in_order(self) -> list[tuple[tuple[int, ...], Array, Array, Any]]:
        """Effects of the latest turn in their order.

        Numbers of events, state before, scratch after each, and of contacts what it was tied to; else None.
        """
        resets = self._resets
        found: list[Any] = [(resets.kept, np.flatnonzero(resets.chosen), resets.kept.w, None)]
        if self.rows is not None:
            choice, strikes = self.memory.choice, self.memory.strikes
            active, ties = np.flatnonzero(strikes.active), strikes.ties
            w = strikes.rested.w.copy()  # the formulas of rows that come to rest read their signs
            w[choice.rows.first + MODE_NUMBERS * active + SIGN] = 1.0
            none = np.full_like(ties.leads, -1), np.zeros_like(ties.parts)
            struck = KeptTies(ties.kept.copy(), ties.kept_ways.copy(), *none)
            rested = KeptTies(*(x.copy() for x in (ties.held, ties.ways, ties.leads, ties.parts)))
            if np.any(ties.leads >= 0):
                memory = strikes.memory
                series = KeptSeries(memory.impacts.copy(), memory.rates.copy(), memory.rests.copy())
                rested = rested._replace(series=series)
            if self.rows.one_problem:
                struck, rested = (
                    ties._replace(pins=strikes.memory.pins.copy(), kicks=kicks_along_rows(choice, kept.impulses))
                    for ties, kept in ((struck, strikes.struck), (rested, strikes.rested))
                )
            both = (struck, rested) if self.rows.contacts or self.rows.one_problem else (None, None)
            found += [(strikes.struck, strikes.events[active], strikes.struck.w, both[0])]
            found += [(strikes.rested, strikes.events[active], w, both[1])]
        happened = [x for x in found if not np.isnan(x[0].energy[0])]
        return [(tuple(numbers.tolist()), kept.y.copy(), w.copy(), ties) for kept, numbers, w, ties in happened]

    def forget_after(self, happened: Sequence[Happening]) -> None:
        """Remember the resets of some events alone, as a run goes on from an earlier state."""
        if "memory" in vars(self):
            past = self._resets.past
            past.counts[:] = 0
            for event in happened:
                if event.action == RESET or event.impact is not None:
                    add_resets_of(past, self.effects.chosen([event.number]), event.t)

    def _write_resets(self) -> None:
        """Have the resets at the present time name what they have changed."""
        resets, now = self._resets, self._now
        if np.isnan(resets.kept.energy[0]):
            return
        impact = self._impact(np.flatnonzero(resets.chosen).tolist(), resets.kept)
        names = {self.watched.names[k] for k in np.flatnonzero(resets.chosen)}
        energy, happened = impact.energy, self._happened
        first = len(happened)
        while first > 0 and happened[first - 1].t == now:
            first -= 1
        for i, event in enumerate(happened[first:], first):
            if event.action == RESET and event.name in names:
                happened[i] = replace(event, impact=impact, energy=energy)
                energy = 0.0

    def _note(self, before: int, here: Happening) -> None:
        """Have the past events name the transitions that were logged since some count."""
        assert self.rows is not None, "rows have transitions"
        names, strikes, log, happened = self.rows.names, self.memory.strikes, self.memory.transitions, self._happened
        impact: Impact | None = None
        for number in range(before, self._count):
            at = number % len(log.times)
            row, word = int(log.rows[at]), WORDS[log.words[at]]
            event = replace(here, name=f"{names[row]}.{word}", number=-1)
            if word == HIT:
                energy = 0.0
                if impact is None:
                    impact = self._impact(strikes.events[np.flatnonzero(strikes.active)].tolist(), strikes.struck)
                    energy = impact.energy
                event = replace(event, impact=impact, energy=energy, number=int(strikes.events[row]))
            elif word == REST and (left := [x for x in strikes.left[self._rows_named(row)] if not np.isnan(x)]):
                event = replace(event, left=float(max(left)))
            happened.append(event)

    def _rows_named(self, row: int) -> list[int]:
        """Return the rows with the name of a row: the pieces of its gap."""
        assert self.rows is not None, "rows have names"
        return [i for i, name in enumerate(self.rows.names) if name == self.rows.names[row]]

    def _impact(self, numbers: Sequence[int], kept: KeptEffect) -> Impact:
        """Return what some events have changed."""
        return self.effects.impact(numbers, kept.v, kept.impulses, float(kept.energy[0]))

    # -- memory --------------------------------------------------------------------------------------------------------

    @property
    def _now(self) -> float:
        return float(self.simulation.state.clock[abi.TIME])

    @property
    def _count(self) -> int:
        """Number of transitions so far."""
        return 0 if self.rows is None else int(self.memory.transitions.count[0])

    @property
    def _happened(self) -> list[Happening]:
        """Past events of the run."""
        events = self.simulation.events
        assert events is not None, "a turn has events"
        return events.happened

    @property
    def _resets(self) -> Any:
        return self.memory if self.rows is None else self.memory.strikes.effects

    @cached_property
    def memory(self) -> Any:
        """The data of `symgen.run.modes.turn`: `OfModes` where rows have bounds, else `OfEffects`."""
        simulation, sizes = self.simulation, (len(self.simulation.state.y), len(self.simulation.state.w))
        if self.rows is None:
            return effects_of_runs(simulation.compiled, self.watched, simulation.spec.until, *sizes, keeps=True)
        return modes_of_runs(simulation.compiled, self.watched, self.rows, simulation.span, *sizes, keeps=True)

    @cached_property
    def _entry(self) -> Callable[..., int]:
        watched, turning = self.watched, self.watched.turning
        if CONTACTS in turning and CORNERS not in turning:  # one code, so that the next file with corners has it
            turning = CORNERS, *turning
        function, signature = serving_function(self.rows is not None, watched.effects is not None, turning)
        return bind_arguments(function, types.FunctionType(signature), 0.0, self.memory, self.simulation.state)


def add_resets_of(past: Past, chosen: NDArray[np.int64], t: float) -> None:
    """Add a time at which events have reset a run, from Python."""
    from symgen.compile.loopcode.exact import compiled_form

    compiled_form(add_resets)(past, chosen, t)
