"""Events of a run: what loops are told of them, what is done where one happens, and when they happen ever faster."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.errors import InputError
from symgen.runtime import abi, hunting
from symgen.runtime.hunting_records import HuntingState
from symgen.runtime.impulses import strike
from symgen.runtime.probe import Ready

if TYPE_CHECKING:
    from symgen.runtime.compiled import CompiledModel
    from symgen.runtime.records import Sizes, State

Array = NDArray[np.float64]

RECORD, STOP, RESET = "record", "stop", "reset"
#: What is left of a run until its events accumulate counts as nothing below this part of its length.
NOTHING_LEFT = 1e-9
#: So many intervals between events must have shrunk, in ratios that differ by no more than this.
_SHRINKING, _STEADY = 4, 0.2
#: So many resets in this part of a run are a heap as well.
_CROWDED, _HEAP = 50, 1e-7


@dataclass(frozen=True)
class Reset:
    """New velocities at an event.

    Attributes
    ----------
    labels : tuple of str
        Velocities that get new values.
    evaluate : callable
        (t, y, p, w, ydot) -> the velocities that are named, then their new values.
    """

    labels: tuple[str, ...]
    evaluate: Callable[[float, Array, Array, Array, Array], Array]


@dataclass(frozen=True)
class Watched:
    """The events of a run.

    Attributes
    ----------
    names : tuple of str
        Of the events.
    directions : tuple of int
        1, -1 or 0 for both.
    actions : tuple of str
        ``record``, ``stop`` or ``reset``.
    function : emitted function
        Switching functions, then their rates.
    needs_rates : bool
        Whether these depend on accelerations.
    resets : mapping of int to Reset
        By number of the event.
    products : tuple of (int, int, float)
        Entries of M beside its diagonal: row, column, value.
    """

    names: tuple[str, ...]
    directions: tuple[int, ...]
    actions: tuple[str, ...]
    function: Any
    needs_rates: bool
    resets: Mapping[int, Reset] = field(default_factory=dict)
    products: tuple[tuple[int, int, float], ...] = ()

    def hunting_state(self, sizes: Sizes, state: State) -> HuntingState:
        """Return what a run keeps, with what it keeps of its events before it has begun."""
        leaves = [action != RECORD for action in self.actions]
        hunt = hunting.new_hunt(sizes, len(state.w), self.directions, leaves, self.needs_rates)
        return HuntingState(*state, hunt)


@dataclass(frozen=True)
class Happening:
    """An event that happened.

    Attributes
    ----------
    t : float
        When [s].
    name, action : str
        Of the event.
    state : Array, shape (nq + nv,)
        Coordinates and velocities, before they change.
    after : Array, shape (nv,), or None
        Velocities after a reset.
    impulses : Array, or None
        Of each row of D, then of each velocity that was given a value.
    given : tuple of str
        These velocities.
    energy : float
        What the reset adds to the energy [J].
    """

    t: float
    name: str
    action: str
    state: Array
    after: Array | None = None
    impulses: Array | None = None
    given: tuple[str, ...] = ()
    energy: float = 0.0


class Events:
    """What happens in a run.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    watched : Watched
        Its events.
    until : float
        End of the run [s].

    Attributes
    ----------
    happened : list of Happening
        In order of time.
    accumulation : float or None
        Where events accumulate [s].
    """

    def __init__(self, compiled: CompiledModel, watched: Watched, until: float) -> None:
        self.compiled, self.watched, self.until = compiled, watched, until
        self.happened: list[Happening] = []
        self.accumulation: float | None = None

    def forget_after(self, t: float) -> None:
        """Forget what happened later: a run goes on from an earlier state."""
        self.happened = [event for event in self.happened if event.t <= t]
        self.accumulation = None

    def take(self, state: HuntingState) -> list[tuple[int, Happening]]:
        """Return what a loop has noted since it was last asked, with numbers of events, and remember it."""
        info, found = self.compiled.info, []
        for t, number, y in hunting.taken_notes(state.hunt, len(state.y), len(state.w)):
            action = self.watched.actions[number]
            event = Happening(t, self.watched.names[number], action, y[: info.nq + info.nv])
            found.append((number, event))
            self.happened.append(event)
        return found

    def meet(self, state: HuntingState, found: Sequence[tuple[int, Happening]]) -> int:
        """Do what the events ask for that a loop was left at; return `DONE` where it may be entered again.

        Parameters
        ----------
        state : State
            At the events; changed by resets.
        found : sequence of (int, Happening)
            From `take`.

        Raises
        ------
        InputError
            If a reset asks for velocities that the constraints, or other resets at the same time, do not allow.
        """
        now = float(state.clock[abi.TIME])
        here = [(number, event) for number, event in found if event.t == now]
        resets = [number for number, event in here if event.action == RESET]
        if resets:
            self._reset(state, resets)
        if any(event.action == STOP for _, event in here):
            return abi.MET
        if resets and self._accumulates(resets):
            return abi.GATHERED
        return abi.DONE

    # -- resets --------------------------------------------------------------------------------------------------------

    def _reset(self, state: HuntingState, numbers: Sequence[int]) -> None:
        info, compiled, now = self.compiled.info, self.compiled, float(state.clock[abi.TIME])
        y, w, p = state.y[: info.ny].copy(), state.w.copy(), state.p
        Ready(compiled.model.geometry, abi.MEASURE)(now, y, p, w)
        joints, nu = compiled.jacobian(w), compiled.section(w, "nu").copy()
        labels, rows, values = list[str](), [joints], [nu]
        for number in numbers:
            reset = self.watched.resets[number]
            own, asked = self._rows(reset, now, y, p, w)
            labels += reset.labels
            rows.append(own)
            values.append(asked)
        v, mass = y[info.nq : info.nq + info.nv], self._mass(w)
        blow = strike(mass, np.concatenate(rows), np.concatenate(values), v)
        if blow.contradictory or not np.all(np.isfinite(blow.v)):
            raise self._refusal(numbers, labels, blow.v, np.concatenate(rows), np.concatenate(values), now)
        after = blow.v.copy()
        for row, value in zip(np.concatenate(rows)[info.m :], np.concatenate(values)[info.m :], strict=True):
            if np.count_nonzero(row) == 1 and row.max() == 1.0:
                after[np.argmax(row)] = value  # a velocity itself: exactly, so that one at rest is at rest
        energy = 0.5 * float((after - v) @ mass @ (after + v))
        state.y[info.nq : info.nq + info.nv] = after
        state.y[info.work] += energy  # done by the impulses: the balance goes on behind it
        state.control[[abi.BEGUN, abi.KNOWN, abi.POINTS, abi.REFUSED]] = abi.AFRESH, 0, 0, 0
        state.clock[abi.ALLOWED] = 0.0
        names = {self.watched.names[number] for number in numbers}
        given, first = tuple(labels), True
        for i, event in enumerate(self.happened):
            if event.t == now and event.action == RESET and event.name in names:
                self.happened[i] = Happening(
                    *(event.t, event.name, event.action, event.state, after, blow.impulses, given),
                    energy if first else 0.0,
                )
                first = False

    def _rows(self, reset: Reset, t: float, y: Array, p: Array, w: Array) -> tuple[Array, Array]:
        """Return the rows of the velocities that a reset names, and what these rows times v+ have to be."""
        info, count = self.compiled.info, len(reset.labels)
        still, ydot = y.copy(), np.zeros(info.ny)
        still[info.nq : info.nq + info.nv] = 0.0
        rest = reset.evaluate(t, still, p, w, ydot)[:count]
        rows = np.zeros((count, info.nv))
        for j in range(info.nv):  # named velocities are linear in v
            still[info.nq + j] = 1.0
            rows[:, j] = reset.evaluate(t, still, p, w, ydot)[:count] - rest
            still[info.nq + j] = 0.0
        return rows, reset.evaluate(t, y, p, w, ydot)[count:] - rest

    def _mass(self, w: Array) -> Array:
        mass = np.diag(self.compiled.section(w, "mass"))
        for i, j, value in self.watched.products:
            mass[i, j] = mass[j, i] = value
        return mass

    def _refusal(
        self, numbers: Sequence[int], labels: Sequence[str], v: Array, rows: Array, values: Array, now: float
    ) -> InputError:
        names = " and ".join(f"'{self.watched.names[n]}'" for n in numbers)
        where = f"events {names}: reset" if len(numbers) > 1 else f"event {names}: reset"
        m = len(values) - len(labels)
        asked = ", ".join(f"{label} = {x:.6g}" for label, x in zip(labels, values[m:], strict=True))
        nearest = ", ".join(f"{label} = {x:.6g}" for label, x in zip(labels, rows[m:] @ v, strict=True))
        got = f"{asked} at t = {now:.6g} s"
        return InputError(where, "velocities that the joints and each other allow", got, f"the nearest are {nearest}")

    # -- events that accumulate ----------------------------------------------------------------------------------------

    def _accumulates(self, numbers: Sequence[int]) -> bool:
        """Return whether resets follow each other so fast that time does not get on; note where to."""
        least = NOTHING_LEFT * self.until
        for number in numbers:
            name = self.watched.names[number]
            times = np.array([event.t for event in self.happened[-_CROWDED * 4 :] if event.name == name])
            intervals = np.diff(times)
            if len(intervals) > _SHRINKING:
                last = intervals[-_SHRINKING - 1 :]
                ratios = last[1:] / last[:-1]
                ratio = float(ratios[-1])
                if ratios.max() < 1.0 and np.ptp(ratios) < _STEADY:
                    rest = float(last[-1]) * ratio / (1.0 - ratio)  # of a geometric series (Aitken)
                    if rest < least:
                        self.accumulation = float(times[-1]) + rest
                        return True
        resets = [event.t for event in self.happened[-4 * _CROWDED :] if event.action == RESET]
        if len(resets) > _CROWDED and resets[-1] - resets[-1 - _CROWDED] < _HEAP * self.until:
            self.accumulation = resets[-1]
            return True
        return False

    @property
    def recent(self) -> tuple[str, ...]:
        """Events whose resets came last."""
        names = {e.name for e in self.happened[-_SHRINKING:] if e.action == RESET}
        return tuple(name for name in self.watched.names if name in names)

    @property
    def reason(self) -> str:
        """Why a run ended whose events accumulate."""
        assert self.accumulation is not None, "events accumulate"
        return gathered(self.recent, self.accumulation)


def gathered(names: Sequence[str], t: float) -> str:
    """Return why a run ended whose events of some names accumulate at a time [s]."""
    told = " and ".join(f"'{name}'" for name in names)
    return f"events of {told} accumulate at t = {t:.13g} s: nothing says how the motion goes on behind that"
