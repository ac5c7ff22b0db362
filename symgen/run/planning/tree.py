"""Runs in joint coordinates: the start of bodies as a start of joints, and the motion of joints as one of bodies.

A run in joint coordinates begins where one in the bodies' own coordinates does: both are assembled in those, so that
what is held, noted and refused is the same. What it gives is carried back to the bodies, where results, reactions,
violations and outputs are read as of any other run.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.derive.lower.windings import winding_order
from symgen.describe.bounds.bounded_modes import mode_events
from symgen.describe.bounds.by_reaction import tied_impulses
from symgen.describe.parts.topology import state_measures
from symgen.describe.spanning_tree import Topology
from symgen.run.layout import abi
from symgen.run.layout.probe import Ready
from symgen.run.single.outcome import Outcome
from symgen.run.starts.assembly import Start

if TYPE_CHECKING:
    from symgen.describe.mechanism import Event, Mechanism
    from symgen.run.effects.effects import Effects, Impact
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.layout.records import State
    from symgen.run.single.events import Happening

Array = NDArray[np.float64]

#: What both descriptions of a motion measure alike, taken over from the run.
_SCALES = (abi.LENGTH, abi.SPEED, abi.MEAN_MASS)
#: Differences of bodies' places after a change of parameters, over the size of bodies or mechanism, that are rounding.
MOVED = 1e-12
#: What is kept of bodies for a run that goes on: state, parameters, scratch, and the rank at the start of the tree.
BODIES = ("body_y", "body_p", "body_w", "tree_rank")


@dataclass(frozen=True)
class TreeRun:
    """A run in joint coordinates, and what carries it to bodies.

    Attributes
    ----------
    whole, mechanism : Mechanism
        As described, and with its tree.
    compiled, start : CompiledModel, Start
        In joint coordinates.
    bodies : CompiledModel
        In the bodies' own.
    body_start : Start
        Where the same run would begin there.
    events : tuple of Event
        That are looked for.
    effects : callable, optional
        Returns what they change on bodies, where many runs share that.
    over : int
        Which of the bodies that turn in space would start turned over, -1 where none.
    """

    whole: Mechanism
    mechanism: Mechanism
    compiled: CompiledModel
    start: Start
    bodies: CompiledModel
    body_start: Start
    events: tuple[Event, ...] = ()
    effects: Callable[[], Effects | None] | None = None
    over: int = -1

    @property
    def topology(self) -> Topology:
        """The tree."""
        assert self.mechanism.topology is not None, "the mechanism has a tree"
        return self.mechanism.topology

    # -- the motion of bodies ------------------------------------------------------------------------------------------

    def positions(self, outcome: Outcome) -> Array:
        """Return the coordinates of bodies at the outputs, shape (k, nq)."""
        return self._moving_joints(outcome)[:, : self.bodies.info.nq]

    def carry_outcome(self, outcome: Outcome) -> CarriedOutcome:
        """Return the outcome of a run as the motion of bodies."""
        info, own = self.bodies.info, self.compiled.info
        moving = self._moving_joints(outcome)
        k, n = len(outcome.times), info.nq + info.nv
        states = np.zeros((k, info.ny))
        states[:, :n] = moving[:, :n]
        states[:, n:] = outcome.states[:, own.work :]
        status = np.zeros((k, abi.N_STATUS + info.kept))
        status[:, : abi.N_STATUS] = outcome.status_columns[:, : abi.N_STATUS]
        # the joints of the tree hold by construction: their rows count as independent
        status[:, abi.RANK] += self.body_start.rank - self.start.rank
        for i, turned in enumerate(self._turns(outcome.states, outcome.status_columns[:, abi.N_STATUS :])):
            status[:, abi.N_STATUS + i] = turned
        # rows of cut joints alone may be off, the same ones in the same order
        status[:, abi.N_STATUS + info.windings :] = outcome.status_columns[:, abi.N_STATUS + own.windings :]
        w = self.body_start.w.copy()
        w[list(_SCALES)] = outcome.w[list(_SCALES)]
        self.bodies.modes(w)[:] = self.compiled.modes(outcome.w)
        for i in range(info.windings):
            w[abi.WINDING + i] = status[-1, abi.N_STATUS + i] if k else w[abi.WINDING + i]
        values = {f.name: getattr(outcome, f.name) for f in fields(Outcome)}
        start = replace(self.body_start, notes=outcome.start.notes)
        values |= {"states": states, "status_columns": status, "compiled": self.bodies, "start": start}
        happened, halt = self._carry_events(outcome)
        values |= {"p": self._parameters(outcome.p), "w": w, "happened": happened}
        if halt is not None:
            values |= {"code": abi.HALTED, "reason": str(halt)}
        values["held"] = tuple((t, self._parameters(numbers)) for t, numbers in outcome.held)
        last = outcome.simulation.state.y
        end = self._of_bodies(outcome.end, last, outcome.p)
        return CarriedOutcome(**values, inner=outcome, end_state=end, work=last[own.work], tree=self)

    def arrays(self, outcome: CarriedOutcome) -> dict[str, NDArray[Any]]:
        """Return the arrays from which another run goes on, beside the loop's."""
        y = self.body_start.y.copy()
        y[: self.bodies.info.work] = outcome.end_state
        rank = np.array([self.start.rank])
        return dict(zip(BODIES, (y, outcome.p.copy(), outcome.w.copy(), rank), strict=True))

    def _carry_events(self, outcome: Outcome) -> tuple[tuple[Happening, ...], InputError | None]:
        """Return the events with coordinates, velocities and row impulses of the bodies.

        The second value is the error of the first reset that the joints of the bodies do not allow.
        """
        result: list[Happening] = []
        impacts: dict[int, Impact] = {}
        numbers = {event.name: i for i, event in enumerate(self._watched)}
        effects = None
        for event in outcome.happened:
            p = next((own for until, own in outcome.held if event.t <= until), outcome.p)
            state, impact = self._of_bodies(event.t, event.state, p), event.impact
            if impact is not None:
                effects = effects or self._effects_on_bodies()
                if id(impact) not in impacts:  # resets at the same time share what they do
                    together = [numbers[x.name] for x in outcome.happened if x.impact is impact]
                    try:
                        impacts[id(impact)] = self._impact(effects, together, event, impact.v, state, p)
                    except InputError as error:
                        return tuple(result), error
                impact = impacts[id(impact)]
            result.append(replace(event, state=state, impact=impact))
        return tuple(result), None

    @cached_property
    def _watched(self) -> tuple[Event, ...]:
        """Events of the run, and of rows whose forces have bounds."""
        return (*self.events, *mode_events(self.whole))

    def _effects_on_bodies(self) -> Effects:
        from symgen.run.compiling.events import effects_of_events

        effects = self.effects() if self.effects else effects_of_events(self.whole, self.bodies, self._watched)
        assert effects is not None, "an event has changed something"
        return effects

    def _impact(
        self, effects: Effects, numbers: Sequence[int], event: Happening, after: Array, state: Array, p: Array
    ) -> Impact:
        """Return the effect of resets on bodies in a state, where joints have some velocities afterwards."""
        own, info = self.compiled.info, self.bodies.info
        v = self._of_bodies(event.t, np.concatenate([event.state[: own.nq], after]), p)[info.nq :]
        y = np.zeros(info.ny)
        y[: info.work] = state
        y[info.own_states] = event.own
        given = numbers, event.t, y, self._parameters(p), self.body_start.w.copy()
        if tied_impulses(self.whole):
            assert event.impact is not None, "the event has changed something"
            places = {row.name: i for i, row in enumerate(info.rows)}
            impulses = {places[own.rows[i].name]: float(event.impact.impulses[i]) for i in own.bounded}
            kicks = {row: impulse for row, impulse in impulses.items() if impulse != 0.0}
            return effects.carried(*given, replace(event.impact, v=v), kicks)
        return replace(effects.apply(*given), v=v)

    def _parameters(self, numbers: Array) -> Array:
        """Return the parameters of a piece of the run as the code for bodies takes them, prepared."""
        p = self.body_start.p.copy()
        count = len(self.bodies.info.parameters)
        if np.array_equal(p[:count], numbers[:count]):
            return p
        p[:count] = numbers[:count]
        self.bodies.prepare(p)
        return p

    @cached_property
    def signs(self) -> Array:
        """Signs, 1 or -1 each, that continue the Euler parameters of bodies from the start."""
        info = self.bodies.info
        here, signs = self.bodies_at(self.start.t, self.start.y, self.start.p, self.start.w), np.ones(info.nq)
        for first, _ in info.spins:
            if here[first : first + 4] @ self.body_start.y[first : first + 4] < 0.0:
                signs[first : first + 4] = -1.0
        return signs

    def _moving_joints(self, outcome: Outcome) -> Array:
        info = self.bodies.info
        motion = outcome.observe_motion(self.compiled.model.bodies, info.nq + 2 * info.nv)
        motion[:, : info.nq] *= self.signs
        return motion

    def _of_bodies(self, t: float, y: Array, p: Array) -> Array:
        """Return coordinates and velocities of bodies at one state."""
        state = self.bodies_at(t, y, p, self.start.w)
        state[: self.bodies.info.nq] *= self.signs
        return state

    def bodies_at(self, t: float, y: Array, p: Array, w: Array) -> Array:
        """Return coordinates and velocities of bodies at one state of joints."""
        own, info = self.compiled.info, self.bodies.info
        state, out = np.zeros(own.ny), np.zeros(info.nq + 2 * info.nv)
        state[: own.work] = y[: own.work]
        Ready(self.compiled.model.bodies, abi.OBSERVE)(t, state, p, w.copy(), np.zeros(own.ny), out)
        return out[: info.nq + info.nv]

    @property
    def names(self) -> list[str]:
        """Names of the coordinates and velocities of bodies."""
        return [x.name for x in (*self.bodies.info.coordinates, *self.bodies.info.velocities)]

    def refuse_moves(self, t: float, state: State, p: Array) -> None:
        """Refuse parameters that move bodies at a state: joints of the tree hold wherever they are.

        Raises
        ------
        InputError
            If they do.
        """
        numbers = state.p.copy()
        numbers[: len(p)] = p
        with np.errstate(all="ignore"):
            self.compiled.prepare(numbers)
            before, after = (self.bodies_at(t, state.y, x, state.w) for x in (state.p, numbers))
        places = np.zeros(len(before))
        places[: len(self.body_start.datum)] = self.body_start.datum
        by = np.abs(after - before) / np.maximum(np.abs(before - places), float(state.w[abi.LENGTH]))
        if not by.max(initial=0.0) <= MOVED:
            name = self.names[int(np.argmax(np.where(np.isfinite(by), by, np.inf)))]
            expected = "parameters that leave the position of every joint as it is"
            raise InputError("set", expected, f"some that move {name}", "start anew for another geometry")

    def _turns(self, states: Array, windings: Array) -> list[Array]:
        """Return the angles that count turns as the code for bodies remembers them, at the outputs."""
        places = places_of_turns(self.whole, self.mechanism, self.bodies.shape)
        return [sign * states[:, i] if own else windings[:, i] for own, i, sign in places]


@dataclass(frozen=True, kw_only=True, repr=False)
class CarriedOutcome(Outcome):
    """The outcome of a run in joint coordinates, as the motion of bodies.

    Attributes
    ----------
    inner : Outcome
        Outcome of the loop.
    end_state : Array, shape (nq + nv,)
        Coordinates and velocities of bodies in the last state that was accepted.
    work : float
        Work done until there [J].
    tree : TreeRun
        The run.
    """

    inner: Outcome = field(repr=False)
    end_state: Array = field(repr=False)
    work: float
    tree: TreeRun = field(repr=False)

    @property
    def imbalance(self) -> float:
        """Imbalance of the loop, by the law of the joints."""
        return self.inner.imbalance


def places_of_turns(whole: Mechanism, mechanism: Mechanism, shape: str) -> list[tuple[bool, int, float]]:
    """Return where a tree has the angles that the code for bodies counts turns of.

    Parameters
    ----------
    whole, mechanism : Mechanism
        As described, and with its tree.
    shape : str
        Of the code for bodies.

    Returns
    -------
    list of (bool, int, float)
        Whether it is a coordinate of the tree, else one of its own angles that count turns; index; and sign.
    """
    assert mechanism.topology is not None, "it has a tree"
    coordinates = state_measures(mechanism, mechanism.topology)
    own = {m: i for i, m in enumerate(winding_order(mechanism, "straight"))}
    places = list[tuple[bool, int, float]]()
    for measure in winding_order(whole, shape):
        if measure in coordinates:
            i, _, sign = coordinates[measure]
            places.append((True, i, sign))
        else:
            places.append((False, own[measure], 1.0))
    return places
