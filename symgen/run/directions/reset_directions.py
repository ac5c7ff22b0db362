"""Directions of resets and impacts: how a state after an event depends on the state before it, and on all numbers.

Velocities follow from the equations of the smallest impulse, which are differentiated:

    M (v+ - v-) = C^T i,    C v+ = c
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.describe.bounds.bounded_modes import MODE
from symgen.describe.parts.event_sections import RECORD
from symgen.run.directions.directed_observer import Observer
from symgen.run.effects.applying import EffectWork
from symgen.run.effects.effects import Effects, Impact
from symgen.run.layout import abi

if TYPE_CHECKING:
    from symgen.run.directions.directed_model import DirectedModel
    from symgen.run.loops.run_spec import RunSpec
    from symgen.run.starts.assembly import Start

Array = NDArray[np.float64]

#: Part of the largest singular value of rows below which they depend on each other.
_NONE = 1e-10
#: Roundings of a switching function up to which it is 0 at the start.
_AT_START = 8.0


def events_at_start(spec: RunSpec, model: DirectedModel, start: Start) -> list[str]:
    """Return the doubts about events that act where the run starts, and that directions move.

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
    if watched is None or all(action in (RECORD, MODE) for action in watched.actions):
        return []
    count = len(watched.names) + len(watched.switches)
    windings = start.w[np.newaxis, abi.WINDING : abi.WINDING + model.plain.info.windings]
    observer = Observer(model, np.array([start.t]), start.y[np.newaxis], windings, ((np.inf, start.p),), start.w)
    values, slopes = (x[0] for x in observer.observe_directions(watched.function, 3 * count))
    return [
        f"the event '{name}' is at the start: with other numbers it may happen behind it"
        for k, (name, action) in enumerate(zip(watched.names, watched.actions, strict=True))
        if action not in (RECORD, MODE)
        and abs(values[k]) <= _AT_START * values[2 * count + k]
        and np.any(slopes[k] != 0.0)
    ]


class ResetDirections:
    """A reset, and how it changes along the directions of the state at its event.

    Parameters
    ----------
    effects : Effects
        The effects of events.
    model : DirectedModel
        The code.
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
    losses : mapping of int to int
        By number of the event, the place in the state of the energy that its impacts take, where outputs read it.
    """

    def __init__(
        self,
        effects: Effects,
        model: DirectedModel,
        chosen: NDArray[np.int64],
        t: float,
        y: Array,
        p: Array,
        w: Array,
        work: EffectWork,
        impact: Impact,
        losses: Mapping[int, int],
    ) -> None:
        self.effects, self.chosen, self.t, self.y, self.p, self.w = effects, chosen, t, y, p, w
        self.work, self.impact, self.model, self.losses = work, impact, model, losses
        self.info, self.changes = effects.compiled.info, effects.changes

    def directions(self) -> Array:
        """Return the directions of the state after the reset at its event, shape (ny, L)."""
        info, changes, after = self.info, self.changes, self.model.directions_after(self.y, "y").copy()
        out, count = self._evaluate_reset(self.effects.formulas, len(self.work.out), self.y), len(changes.owners)
        numbers = self._values
        writes = changes.writes.reshape(-1, 2)
        for (event, place), slopes in zip(writes, out[2 * count :], strict=False):
            if self.chosen[event]:
                after[place] = slopes
        struck = [k for k, event in enumerate(changes.owners) if self.chosen[event]]
        if struck:
            velocities, energy, impulses = self._strike_directions(
                struck, out[count : 2 * count], out[2 * count + len(writes) :]
            )
            after[info.nq : info.work] = velocities
            after[info.work] += energy
            for k, event in enumerate(struck):
                place = self.losses.get(int(changes.owners[event]))
                if place is not None:  # half of the impulse times both rates
                    rates = numbers[event] + numbers[count + event]
                    loss = rates * impulses[k] + self.impact.impulses[info.m + k] * (out[event] + out[count + event])
                    after[place] -= 0.5 * loss
        return after

    def _evaluate_reset(self, function: object, length: int, y: Array) -> Array:
        """Return the directions of what a function writes, shape (length, L)."""
        call = self.model.function(function, length, timed=True).caller(abi.OBSERVE.signature.arguments)
        out = np.zeros(length * (1 + self.model.lanes))
        call(self.t, y, self.p, self.w.copy(), np.zeros_like(y), out)
        self._values = out[:length]
        return out[length:].reshape(length, self.model.lanes)

    def _probe_velocities(self, function: object, length: int) -> tuple[Array, Array]:
        """Return the directions of what velocities have as coefficients, and of the rest, shape (length, nv, L)."""
        info, still = self.info, self.y.copy()
        still[info.nq : info.work] = 0.0
        self.model.directions_after(still, "y")[info.nq : info.work] = 0.0
        rest, coefficients = self._evaluate_reset(function, length, still), list[Array]()
        for j in range(info.nq, info.work):
            still[j] = 1.0
            coefficients.append(self._evaluate_reset(function, length, still) - rest)
            still[j] = 0.0
        return np.stack(coefficients, axis=1), rest

    def _strike_directions(self, struck: list[int], values: Array, entries: Array) -> tuple[Array, Array, Array]:
        """Return the directions of velocities after the smallest impulse, of its energy, and of impulses at events."""
        info, impulse, n = self.info, self.work.impulse, self.info.nv
        k = info.m + len(struck)
        c, m = impulse.rows[: k * n].reshape(k, n), impulse.mass.reshape(n, n)
        own, rest = self._probe_velocities(self.effects.formulas, len(self.work.out))
        jacobian, nu = self._joints()
        off = ~np.any(c[: info.m] != 0.0, axis=1)  # of rows that are off
        jacobian[off], nu[off] = 0.0, 0.0
        slopes = np.concatenate([jacobian, own[struck]])
        right = np.concatenate([nu, values[struck] - rest[struck]])
        mass, more = self._masses(entries, own, rest)
        before, after = self.y[info.nq : info.work], self.impact.v
        directions = self.model.directions_after(self.y, "y")[info.nq : info.work]
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
        # C^T di = M (dv+ - dv-) + dM (v+ - v-) - dC^T i
        pull = unit[:, np.newaxis] * (m @ velocities - loads)
        impulses = scale[:, np.newaxis] * np.linalg.lstsq(rows.T, pull, rcond=_NONE)[0]
        return velocities, energy + more(change, velocities - directions), impulses[info.m :]

    def _joints(self) -> tuple[Array, Array]:
        """Return the directions of D and nu, shapes (m, nv, L), (m, L)."""
        info, model = self.info, self.model
        geometry = model.function(model.plain.model.geometry, timed=True).caller(abi.MEASURE.signature.arguments)
        w = self.w.copy()
        geometry(self.t, self.y.copy(), self.p, w)
        directions, (first, _), (nu, m) = model.directions_after(w, "w"), info.sections["jacobian"], info.sections["nu"]
        slopes = np.zeros((info.m, info.nv, model.lanes))
        for row, column, _, slot in info.jacobian:
            if slot is not None:
                slopes[row, column] = directions[first + slot]
        return slopes, directions[nu : nu + m].copy()

    @property
    def _first_entry(self) -> int:
        """Place of the first entry of M among the numbers of formulas."""
        return 2 * len(self.changes.owners) + len(self.changes.writes) // 2

    def _masses(self, entries: Array, own: Array, rest: Array) -> tuple[Array, Any]:
        """Return the directions of M, shape (nv, nv, L), and a function: directions of the energy of driven parts.

        Parameters
        ----------
        entries : Array
            Directions of the entries of bodies, of the rates of rotors and of their inertias.
        own, rest : Array
            From `_probe_velocities`, of all formulas.
        """
        count = len(self.changes.entries) // 2
        mass, of_bodies = self._masses_of_bodies(entries[:count])
        rotors, of_rotors = self._masses_of_rotors(entries, own, rest)
        return mass + rotors, lambda change, slopes: of_bodies(change, slopes) + of_rotors(change, slopes)

    def _masses_of_rotors(self, entries: Array, own: Array, rest: Array) -> tuple[Array, Any]:
        """Return what `_masses` does, of rotors alone: J r^T r of each with the rate r v."""
        changes, count = self.changes, self.changes.rotors
        first = self._first_entry + len(changes.entries) // 2
        turning, turned = self.work.turning.reshape(count, self.info.nv), self.work.turned
        inertias, slopes_of_inertias = self.work.out[first + count :], entries[len(entries) - count :]
        by, drift = own[first : first + count], rest[first : first + count]
        one = np.einsum("r,rik,rj->ijk", inertias, by, turning)
        mass = one + one.transpose(1, 0, 2) + np.einsum("rk,ri,rj->ijk", slopes_of_inertias, turning, turning)

        def more(change: Array, directions: Array) -> Array:
            along, momenta = turning @ change, inertias * turned
            slope = np.einsum("r,rik,i->k", momenta, by, change) + directions.T @ (turning.T @ momenta)
            return np.asarray(slope + (along * inertias) @ drift + (along * turned) @ slopes_of_inertias)

        return mass, more

    def _masses_of_bodies(self, entries: Array) -> tuple[Array, Any]:
        """Return what `_masses` does, of bodies alone."""
        info, changes, lanes = self.info, self.changes, self.model.lanes
        mass, places = np.zeros((info.nv, info.nv, lanes)), changes.entries.reshape(-1, 2).tolist()
        if not changes.bodies:
            first, size = info.sections["mass"]
            mass[range(size), range(size)] = self.model.directions_after(self.w, "w")[first : first + size]
            for (i, j), slopes in zip(places, entries, strict=True):
                mass[i, j] = mass[j, i] = slopes
            return mass, lambda change, slopes: np.zeros(lanes)
        bodies = slice(changes.first, changes.first + changes.bodies)
        coefficients, rest = self._probe_velocities(self.model.plain.model.bodies, len(self.work.motion))
        by, drift = coefficients[bodies], rest[bodies]
        carried, still = self.work.carried.reshape(changes.bodies, info.nv), self.work.drift
        full, slopes = np.zeros((changes.bodies, changes.bodies)), np.zeros((changes.bodies, changes.bodies, lanes))
        for (i, j), value, slope in zip(places, self.work.out[self._first_entry :], entries, strict=False):
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
