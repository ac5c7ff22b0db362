"""Directions of resets: how a state after an event depends on all numbers, the time of the event among them.

At an event g = 0 its time changes by ``dt = -dg / g'``, and the state there by ``dy + y' dt``. The derivative of the
reset turns that into the change of the state behind it. From this, ``y' dt`` with the rates behind the event is taken
back. Velocities follow from the equations of the smallest impulse, which are differentiated:

    M (v+ - v-) = C^T i,    C v+ = c
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.describe.parts.events import RECORD
from symgen.run.effects.effects import Effects, Impact
from symgen.run.layout import abi
from symgen.run.single.directed_observer import Observer

if TYPE_CHECKING:
    from symgen.run.loops.run_spec import RunSpec, Watched
    from symgen.run.single.directed_model import DirectedModel
    from symgen.run.starts.assembly import Start

Array = NDArray[np.float64]

#: Part of the largest singular value of rows below which they depend on each other.
_NONE = 1e-10
#: Roundings of a switching function up to which it is 0 at the start.
_AT_START = 8.0
#: Relative difference of the derivatives of the times of two events up to which these stay together.
_TOGETHER = 1e-8


def with_directions(spec: RunSpec, model: DirectedModel, doubts: list[str]) -> RunSpec:
    """Return the specification of a run whose resets change directions as well.

    Parameters
    ----------
    spec : RunSpec
        Of the run without directions.
    model : DirectedModel
        The code of the run.
    doubts : list of str
        Takes what is in doubt of the directions behind resets.
    """
    watched = spec.events
    if watched is None or watched.effects is None:
        return spec
    plain = {f.name: getattr(watched.effects, f.name) for f in fields(Effects)}
    effects = DirectedEffects(**plain, model_with=model, watched=watched, doubts=doubts)
    return replace(spec, events=replace(watched, effects=effects))


def events_at_start(spec: RunSpec, model: DirectedModel, start: Start) -> list[str]:
    """Return what is in doubt since events that act are where the run starts, and directions move these.

    Parameters
    ----------
    spec : RunSpec
        Of the run.
    model : DirectedModel
        Its code.
    start : Start
        With directions.
    """
    watched = spec.events
    if watched is None or all(action == RECORD for action in watched.actions):
        return []
    count = len(watched.names) + len(watched.switches)
    windings = start.w[np.newaxis, abi.WINDING : abi.WINDING + model.plain.info.windings]
    observer = Observer(model, np.array([start.t]), start.y[np.newaxis], windings, ((np.inf, start.p),), start.w)
    values, slopes = (x[0] for x in observer.observed(watched.function, 3 * count))
    return [
        f"the event '{name}' is at the start: with other numbers it may happen behind it"
        for k, (name, action) in enumerate(zip(watched.names, watched.actions, strict=True))
        if action != RECORD and abs(values[k]) <= _AT_START * values[2 * count + k] and np.any(slopes[k] != 0.0)
    ]


@dataclass(frozen=True, kw_only=True)
class DirectedEffects(Effects):
    """The effects of events on a state with directions.

    Attributes
    ----------
    model_with : DirectedModel
        The code of the run.
    watched : Watched
        Its events.
    doubts : list of str
        What is in doubt of the directions behind resets.
    """

    model_with: DirectedModel
    watched: Watched
    doubts: list[str]

    def apply(self, numbers: Sequence[int], t: float, y: Array, p: Array, w: Array) -> Impact:
        """Change a state and its directions by the effects of events at one time; see `Effects.apply`."""
        model, ny = self.model_with, self.model_with.sizes["y"]
        before, rate = y.copy(), self._rate(t, y, p, w)
        later = self._later(numbers, t, y, p, w)
        work = self.memory(len(y), len(w))
        impact = self.applied(numbers, t, y, p, w, work)
        change = model.shadow(before, "y") + np.outer(rate, later)
        at = model.longer(before[:ny], "y", change)
        scratch = np.concatenate([w, later])
        after = _Reset(self, self.chosen(numbers), t, at, p, scratch, work, impact).directions()
        y[ny : ny * (1 + model.lanes)] = (after - np.outer(self._rate(t, y, p, w), later)).ravel()
        return impact

    def _observer(self, t: float, y: Array, p: Array, w: Array) -> Observer:
        y = y[: self.model_with.sizes["y"] * (1 + self.model_with.lanes)]
        windings = w[np.newaxis, abi.WINDING : abi.WINDING + self.compiled.info.windings]
        return Observer(self.model_with, np.array([t]), y[np.newaxis], windings, ((np.inf, p),), w)

    def _rate(self, t: float, y: Array, p: Array, w: Array) -> Array:
        """Return the rates of the state without directions."""
        return self._observer(t, y, p, w).rates[0][0, : self.model_with.sizes["y"]]

    def _later(self, numbers: Sequence[int], t: float, y: Array, p: Array, w: Array) -> Array:
        """Return the directions of the time of events, shape (L,)."""
        watched = self.watched
        count = len(watched.names) + len(watched.switches)
        values, slopes = self._observer(t, y, p, w).observed(watched.function, 3 * count)
        with np.errstate(divide="ignore", invalid="ignore"):
            times = np.array([-slopes[0, k] / values[0, count + k] for k in numbers])
        names = " and ".join(f"'{watched.names[k]}'" for k in numbers)
        if not np.all(np.isfinite(times)):
            self.doubts.append(f"the event {names} at t = {t:.6g} s is met without speed: its time has no derivative")
        elif np.any(np.ptp(times, axis=0) > _TOGETHER * np.abs(times).max(axis=0)):
            self.doubts.append(f"the events {names} at t = {t:.6g} s are together for these numbers only")
        return np.asarray(times[0])


class _Reset:
    """A reset, and how it changes along the directions of the state at its event.

    Parameters
    ----------
    effects : DirectedEffects
        The effects of events.
    chosen : Array of int
        1 for each event that happens.
    t : float
        Time [s].
    y, p, w : Array
        State before, parameters and scratch at the event, all with directions; those of time follow the scratch.
    work : EffectWork
        Working memory after the reset.
    impact : Impact
        What it changed.
    """

    def __init__(
        self,
        effects: DirectedEffects,
        chosen: NDArray[np.int64],
        t: float,
        y: Array,
        p: Array,
        w: Array,
        work: Any,
        impact: Impact,
    ) -> None:
        self.effects, self.chosen, self.t, self.y, self.p, self.w = effects, chosen, t, y, p, w
        self.work, self.impact, self.model = work, impact, effects.model_with
        self.info, self.changes = effects.compiled.info, effects.changes

    def directions(self) -> Array:
        """Return the directions of the state after the reset at its event, shape (ny, L)."""
        info, changes, after = self.info, self.changes, self.model.shadow(self.y, "y").copy()
        out, count = self._evaluated(self.effects.formulas, len(self.work.out), self.y), len(changes.owners)
        writes = changes.writes.reshape(-1, 2)
        for (event, place), slopes in zip(writes, out[2 * count :], strict=False):
            if self.chosen[event]:
                after[place] = slopes
        struck = [k for k, event in enumerate(changes.owners) if self.chosen[event]]
        if struck:
            velocities, energy = self._struck(struck, out[count : 2 * count], out[2 * count + len(writes) :])
            after[info.nq : info.work] = velocities
            after[info.work] += energy
        return after

    def _evaluated(self, function: Any, length: int, y: Array) -> Array:
        """Return the directions of what a function writes, shape (length, L)."""
        call = self.model.function(function, length, timed=True).caller(abi.OBSERVE.signature.arguments)
        out = np.zeros(length * (1 + self.model.lanes))
        call(self.t, y, self.p, self.w.copy(), np.zeros_like(y), out)
        return out[length:].reshape(length, self.model.lanes)

    def _probed(self, function: Any, length: int) -> tuple[Array, Array]:
        """Return the directions of what velocities have as coefficients, and of the rest, shape (length, nv, L)."""
        info, still = self.info, self.y.copy()
        still[info.nq : info.work] = 0.0
        self.model.shadow(still, "y")[info.nq : info.work] = 0.0
        rest, coefficients = self._evaluated(function, length, still), list[Array]()
        for j in range(info.nq, info.work):
            still[j] = 1.0
            coefficients.append(self._evaluated(function, length, still) - rest)
            still[j] = 0.0
        return np.stack(coefficients, axis=1), rest

    def _struck(self, struck: list[int], values: Array, entries: Array) -> tuple[Array, Array]:
        """Return the directions of velocities after the smallest impulse, and of its energy."""
        info, impulse, n = self.info, self.work.impulse, self.info.nv
        k = info.m + len(struck)
        c, m = impulse.rows[: k * n].reshape(k, n), impulse.mass.reshape(n, n)
        own, rest = self._probed(self.effects.formulas, len(self.work.out))
        jacobian, nu = self._joints()
        off = ~np.any(c[: info.m] != 0.0, axis=1)  # of rows that are off
        jacobian[off], nu[off] = 0.0, 0.0
        slopes = np.concatenate([jacobian, own[struck]])
        right = np.concatenate([nu, values[struck] - rest[struck]])
        mass, more = self._masses(entries)
        before, after = self.y[info.nq : info.work], self.impact.v
        directions = self.model.shadow(self.y, "y")[info.nq : info.work]
        change = after - before
        # C dv+ = dc - dC v+, and M dv+ = M dv- - dM (v+ - v-) + dC^T i where rows leave it free
        right = right - np.einsum("ijk,j->ik", slopes, after)
        loads = m @ directions - np.einsum("ijk,j->ik", mass, change)
        loads = loads + np.einsum("ijk,i->jk", slopes, self.impact.impulses)
        own_masses = np.diag(m)
        unit = 1.0 / np.sqrt(np.where(own_masses > 0.0, own_masses, own_masses.mean() or 1.0))
        rows = c * unit
        lengths = np.linalg.norm(rows, axis=1)
        scale = np.divide(1.0, lengths, out=np.zeros(k), where=lengths > 1e-11 * lengths.max())
        rows, right = rows * scale[:, np.newaxis], right * scale[:, np.newaxis]
        left, sizes, turned = np.linalg.svd(rows)
        rank = int(np.sum(sizes > _NONE * sizes[0]))
        solution = turned[:rank].T @ ((left[:, :rank].T @ right) / sizes[:rank, np.newaxis])
        free, scaled = turned[rank:].T, unit[:, np.newaxis] * m * unit
        pull = free.T @ (unit[:, np.newaxis] * loads - scaled @ solution)
        solution = solution + free @ np.linalg.lstsq(free.T @ scaled @ free, pull, rcond=None)[0]
        velocities = unit[:, np.newaxis] * solution
        energy = 0.5 * (
            (velocities - directions).T @ (m @ (after + before))
            + np.einsum("i,ijk,j->k", change, mass, after + before)
            + (velocities + directions).T @ (m @ change)
        )
        return velocities, energy + more(change, velocities - directions)

    def _joints(self) -> tuple[Array, Array]:
        """Return the directions of D and nu, shapes (m, nv, L), (m, L)."""
        info, model = self.info, self.model
        geometry = model.function(model.plain.model.geometry, timed=True).caller(abi.MEASURE.signature.arguments)
        w = self.w.copy()
        geometry(self.t, self.y.copy(), self.p, w)
        directions, (first, _), (nu, m) = model.shadow(w, "w"), info.sections["jacobian"], info.sections["nu"]
        slopes = np.zeros((info.m, info.nv, model.lanes))
        for row, column, _, slot in info.jacobian:
            if slot is not None:
                slopes[row, column] = directions[first + slot]
        return slopes, directions[nu : nu + m].copy()

    def _masses(self, entries: Array) -> tuple[Array, Any]:
        """Return the directions of M, shape (nv, nv, L), and a function: directions of the energy of driven bodies."""
        info, changes, lanes = self.info, self.changes, self.model.lanes
        mass, places = np.zeros((info.nv, info.nv, lanes)), changes.entries.reshape(-1, 2).tolist()
        if not changes.bodies:
            first, size = info.sections["mass"]
            mass[range(size), range(size)] = self.model.shadow(self.w, "w")[first : first + size]
            for (i, j), slopes in zip(places, entries, strict=True):
                mass[i, j] = mass[j, i] = slopes
            return mass, lambda change, slopes: np.zeros(lanes)
        bodies = slice(changes.first, changes.first + changes.bodies)
        coefficients, rest = self._probed(self.model.plain.model.bodies, len(self.work.motion))
        by, drift = coefficients[bodies], rest[bodies]
        carried, still = self.work.carried.reshape(changes.bodies, info.nv), self.work.drift
        full, slopes = np.zeros((changes.bodies, changes.bodies)), np.zeros((changes.bodies, changes.bodies, lanes))
        for (i, j), value, slope in zip(
            places, self.work.out[len(self.work.out) - len(places) :], entries, strict=True
        ):
            full[i, j] = full[j, i] = value
            slopes[i, j] = slopes[j, i] = slope
        one = np.einsum("bik,bc,cj->ijk", by, full, carried)
        mass = one + one.transpose(1, 0, 2) + np.einsum("bi,bck,cj->ijk", carried, slopes, carried)

        def more(change: Array, directions: Array) -> Array:
            pulled = carried.T @ (full @ still)
            slope = np.einsum("bik,b->ik", by, full @ still)
            slope += carried.T @ (np.einsum("bck,c->bk", slopes, still) + full @ drift)
            return np.asarray(directions.T @ pulled + change @ slope)

        return mass, more
