"""Directions of impacts with friction: how velocities after one depend on the state before it, and on all numbers.

Impulses hold velocities along rows C and push along columns that are other ones where contacts slide:

    M (v+ - v-) = P^T i,    C v+ = c,    P_N = C_N - s mu W_T

Friction by reactions keeps a row at rest, or pushes along it by the size of the impulses of its joint.

Where impacts accumulate beside other contacts, c is linear in v- (`symgen.run.modes.contact_series`).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.compile.loopcode.exact import compiled_form
from symgen.compile.loopcode.loop_instances import exact_instance
from symgen.describe.bounds.bounded_modes import HIT
from symgen.run.directions.moments import Moment
from symgen.run.directions.reset_directions import ResetDirections
from symgen.run.effects.applying import EffectWork
from symgen.run.effects.effects import Effects, Impact
from symgen.run.effects.pushing import KeptTies, Ties, new_ties, push_contacts
from symgen.run.laws.problem import ON, UPPER
from symgen.run.layout.scales import fill_jacobian
from symgen.run.layout.start_records import Instant
from symgen.run.loops.run_spec import Watched
from symgen.run.modes.pin_impulses import push_with_kicks
from symgen.run.modes.turn_meanings import IN_PAIRS

Array = NDArray[np.float64]


def rows_of_velocities(watched: Watched) -> list[int]:
    """Return for each velocity that events set the row of friction that it is the rate of; -1 for others."""
    rows, owners = watched.bounded, watched.effects.changes.owners
    assert rows is not None, "a run with contacts"
    hits = {hit: i for i, hit in enumerate(watched.events_of_rows(HIT, len(rows.names))) if hit >= 0}
    places = [k - owners.tolist().index(e) for k, e in enumerate(owners.tolist())]
    return [rows.partners[hits[e]] + at - 1 if at else -1 for e, at in zip(owners.tolist(), places, strict=True)]


def tied_impact(watched: Watched, kept: KeptTies, now: Moment) -> Ties:
    """Return the ties of an impact: what is held, and multiples by the coefficients of friction at its state."""
    rows, effects = watched.bounded, watched.effects
    assert rows is not None, "a run with contacts"
    ties: Ties = new_ties(len(kept.held), effects.compiled.info.nv, effects.compiled.info.m)
    k, dry = len(rows.names), rows.dry
    width = len(now.y)
    values = rows.state(now.t, now.y.copy(), now.p.copy(), now.w.copy(), np.zeros(width))
    ties.held[:], ties.ways[:], ties.leads[:], ties.parts[:] = kept[:4]
    ties.kicks[:] = 0.0 if kept.kicks is None else kept.kicks
    for j, row in enumerate(rows_of_velocities(watched)):
        if row >= 0:
            ties.ratio[j] = ties.ways[j] * values[2 * k + dry + row]
    return ties


def targets_of(ties: Ties, along: list[int], rates: Array, values: Array) -> Array:
    """Return what impulses leave velocities at, or its directions: `values`, but where velocities are parts of others.

    Parameters
    ----------
    ties : Ties
        Of the impact.
    along : list of int
        See `rows_of_velocities`.
    rates, values : Array, shapes (count, ...)
        Velocities before the impact, and what their events ask for.
    """
    found = values.copy()
    for j, lead in enumerate(ties.leads.tolist()):
        if lead >= 0:
            found[j] = ties.parts[j] * rates[lead] + (rates[j] if along[j] >= 0 else 0.0)
    return found


def push_state(
    effects: Effects,
    numbers: tuple[int, ...],
    now: Moment,
    changed: tuple[Array, Array],
    work: EffectWork,
    tied: tuple[Ties, list[int]],
    paired: bool,
) -> Impact:
    """Change a state and its scratch by an impact of contacts, and return it; working memory keeps its problem."""
    y, w = changed
    ties, along = tied
    count, chosen, formulas = len(ties.held), effects.chosen(numbers), effects.model[2]
    compiled_form(formulas)(now.t, y, now.p.copy(), w.copy(), np.zeros(len(y)), work.out)
    ties.values[:] = targets_of(ties, along, work.out[:count], work.out[count : 2 * count])
    push = push_with_kicks if np.any(ties.kicks != 0.0) else push_in_pairs if paired else push_contacts
    compiled_form(push)(effects.model, now.t, Instant(y, now.p.copy(), w), chosen, work, ties)
    return effects.impact(numbers, y[effects.compiled.info.nq : effects.compiled.info.work], work.impulse.impulses, 0.0)


#: Schemes whose steps are as short as the direction of slip in space needs them.
IN_SPACE = ("dop853", "dopri5")
#: The same where slip of contacts has two rows.
push_in_pairs = exact_instance(push_contacts, IN_PAIRS)


def refuse_law_without_directions(watched: Watched | None, scheme: str) -> None:
    """Refuse derivatives of a run whose impacts obey a law that has none, or whose steps are too long for friction.

    Parameters
    ----------
    watched : Watched or None
        Switching functions of the run.
    scheme : str
        Its integrator; empty for steps from Python.

    Raises
    ------
    InputError
        If one-sided rows have Poisson's law, or contacts in space friction and steps cannot be as short as it needs.
    """
    rows = None if watched is None else watched.bounded
    if rows is not None and rows.paired and scheme not in IN_SPACE:
        expected, got = f"{' or '.join(IN_SPACE)} beside friction of contacts in space", f"'{scheme}'"
        raise InputError("derivatives: integrator", expected, got if scheme else "steps from Python")
    if rows is not None and rows.one_sided and rows.poisson:
        raise InputError("derivatives", 'restitution_law = "newton"', '"poisson", whose impacts have none')


class PushDirections(ResetDirections):
    """An impact of contacts, and how it changes along the directions of the state at its event.

    Parameters
    ----------
    *given
        As for `ResetDirections`.
    ties : Ties
        What impulses hold, and what they are multiples of.
    watched : Watched
        Switching functions of the run.
    parts : Array, shape (count, L)
        Directions of the parts of ``ties``.
    pins : Array of int64 or None
        Modes of friction by reactions.
    """

    def __init__(self, *given: Any) -> None:
        *others, self.ties, self.watched, self.parts, self.pins = given
        super().__init__(*others)
        if self.losses or any(place is not None for place in self.watched.bounded.losses):
            raise InputError("derivatives", "outputs without the energy that contacts take", "one that reads it")

    def _strike_directions(self, struck: list[int], values: Array, entries: Array) -> tuple[Array, Array, Array]:
        """Return the directions of velocities after an impact, of its energy, and of impulses at events."""
        info, ties, impulse, n = self.info, self.ties, self.work.impulse, self.info.nv
        rates = self._evaluate_reset(self.effects.formulas, len(self.work.out), self.y)[: len(ties.held)]
        speeds = self._values[: len(ties.held)].copy()
        values = targets_of(ties, rows_of_velocities(self.watched), rates, values)
        values += self.parts * self._values[np.maximum(ties.leads, 0), np.newaxis]
        held = [k for k in struck if ties.held[k] > 0]
        slides = [k for k in struck if ties.held[k] < 0]
        joints, mass = impulse.rows[: info.m * n].reshape(info.m, n), impulse.mass.reshape(n, n)
        push = ties.push.reshape(-1, n)
        c = np.concatenate([joints, push[held]])
        own, rest = self._probe_velocities(self.effects.formulas, len(self.work.out))
        jacobian, nu = self._joints()
        pins = PinsAtImpact(self, jacobian)
        off = ~np.any(joints != 0.0, axis=1)
        jacobian[off], nu[off] = 0.0, 0.0
        c = np.concatenate([c, pins.rows[pins.stick]])
        slopes = np.concatenate([jacobian, own[held], pins.slopes[pins.stick]])
        right = np.concatenate([nu, values[held] - rest[held], np.zeros((len(pins.stick), self.model.lanes))])
        columns, turned = c.copy(), slopes.copy()
        ratios = self._slopes_of_ratios()
        seconds = [k for k in slides if k - 1 in slides and self.changes.owners[k - 1] == self.changes.owners[k]]
        gap_of = {k: info.m + held.index(k - (2 if k in seconds else 1)) for k in slides}
        for k, at in gap_of.items():
            columns[at] += ties.ratio[k] * push[k]
            turned[at] += ties.ratio[k] * own[k] + push[k][:, np.newaxis] * ratios[k]
        pushed = pins.push_along(columns)
        masses, more = self._masses(entries, own, rest)
        before, after = self.y[info.nq : info.work], self.impact.v
        directions = self.model.directions_after(self.y, "y")[info.nq : info.work]
        change = after - before
        impulses = np.concatenate([self.impact.impulses[: info.m], ties.impulses[held], ties.kicks[pins.stick]])
        # P^T di = M (dv+ - dv-) + dM (v+ - v-) - dP^T i,  C dv+ = dc - dC v+
        right = right - np.einsum("ijk,j->ik", slopes, after)
        loads = mass @ directions - np.einsum("ijk,j->ik", masses, change) + np.einsum("ijk,i->jk", turned, impulses)
        loads = loads + pushed
        own_masses = np.diag(mass)
        unit = 1.0 / np.sqrt(np.where(own_masses > 0.0, own_masses, own_masses.mean() or 1.0))
        rows = c * unit
        lengths = np.linalg.norm(rows, axis=1)
        scale = np.divide(1.0, lengths, out=np.zeros(len(c)), where=lengths > 1e-11 * lengths.max())
        k, scaled, pairs = len(c), unit[:, np.newaxis] * mass * unit, len(seconds)
        system = np.zeros((n + k + pairs, n + k + pairs))
        system[:n, :n], system[:n, n : n + k] = scaled, -(columns * unit * scale[:, np.newaxis]).T
        system[n : n + k, :n] = rows * scale[:, np.newaxis]
        both = np.concatenate(
            [unit[:, np.newaxis] * loads, right * scale[:, np.newaxis], np.zeros((pairs, loads.shape[1]))]
        )
        slips = speeds + push @ change
        for turn, b in enumerate(seconds, n + k):
            # the direction e of slip after it turns by an angle: its velocity has no part across e
            (one, other), a = ties.ways[[b - 1, b]], b - 1
            across, size = one * push[b] - other * push[a], one * slips[a] + other * slips[b]
            by_across = one * (own[b].T @ after + rest[b]) - other * (own[a].T @ after + rest[a])
            length = float(np.linalg.norm(across * unit)) or 1.0
            coefficient = (ties.ratio[a] * one + ties.ratio[b] * other) * impulses[gap_of[b]]
            system[:n, turn] = -coefficient * across * unit
            system[turn, :n], system[turn, turn], both[turn] = (
                across * unit / length,
                -size / length,
                -by_across / length,
            )
        solution = np.linalg.lstsq(system, both, rcond=1e-12)[0]
        velocities = unit[:, np.newaxis] * solution[:n]
        energy = 0.5 * (
            (velocities - directions).T @ (mass @ (after + before))
            + np.einsum("i,ijk,j->k", change, masses, after + before)
            + (velocities + directions).T @ (mass @ change)
        )
        return velocities, energy + more(change, velocities - directions), np.zeros((len(struck), self.model.lanes))

    def _slopes_of_ratios(self) -> Array:
        """Return the directions of the multiples that impulses along contacts are, shape (count, L)."""
        rows, watched = self.watched.bounded, self.watched
        out = self._evaluate_reset(rows.state.function, rows.values, self.y)
        first = 2 * len(rows.names) + rows.dry
        slopes = np.zeros((len(self.ties.held), self.model.lanes))
        for j, row in enumerate(rows_of_velocities(watched)):
            if row >= 0:
                slopes[j] = self.ties.ways[j] * out[first + row]
        return slopes


class PinsAtImpact:
    """Friction by reactions at an impact: rows that it keeps at rest, and columns along which it pushes.

    An impulse along a row W is ``P = -s kappa |R|``, with R linear in the impulses of joints: these push along W too.

    Parameters
    ----------
    push : PushDirections
        The impact.
    slopes : Array, shape (m, nv, L)
        Directions of D.

    Attributes
    ----------
    stick : list of int
        Rows of the model that friction keeps at rest.
    rows, slopes : Array
        D, and its directions, of all rows.
    """

    def __init__(self, push: PushDirections, slopes: Array) -> None:
        self.push, self.slopes, info = push, slopes.copy(), push.info
        rows = np.zeros(info.m * info.nv)
        self.modes: list[int] = [] if push.pins is None else push.pins.tolist()
        if self.modes:
            compiled_form(fill_jacobian)(push.effects.model[0], push.work.scratch, rows)
        self.rows: Array = rows.reshape(info.m, info.nv)
        pressed = push.watched.bounded.pressed if self.modes else ()
        self.stick = [info.bounded[i] for i in pressed if self.modes[i] == ON]
        self.slide = {i: (k, info.bounded[i]) for k, i in enumerate(pressed) if self.modes[i] >= UPPER}

    def push_along(self, columns: Array) -> Array:
        """Add to the columns of joints what their impulses push along W; return the directions of the rest of W P."""
        push, info, lanes = self.push, self.push.info, self.push.model.lanes
        loads = np.zeros((info.nv, lanes))
        if not self.slide:
            return loads
        bounded = push.watched.bounded
        first, count = info.sections["multipliers"]
        sizes, impulses = push.model.sizes, push.impact.impulses[: info.m].copy()
        impulses[list(info.bounded)] = 0.0
        y, p, w = push.y[: sizes["y"]].copy(), push.p[: sizes["p"]].copy(), push.w[: sizes["w"]].copy()
        values, still = bounded.state(push.t, y, p, w, np.zeros_like(y)), np.zeros_like(y)
        by_impulse = list[Array]()
        for j in range(count):
            w[first : first + count] = 0.0
            w[first + j] = 1.0
            by_impulse.append(bounded.reactions(push.t, y, p, w, still))
        kept = push.w.copy()
        push.w[first : first + count] = impulses
        push.model.directions_after(push.w, "w")[first : first + count] = 0.0
        turned = push._evaluate_reset(bounded.reactions.function, 2 * len(bounded.pressed), push.y)
        push.w[:] = kept
        bounds = push._evaluate_reset(bounded.state.function, bounded.values, push.y)
        for i, (k, row) in self.slide.items():
            way = -np.sign(push.ties.kicks[row])
            at, place = slice(2 * k, 2 * k + 2), 2 * len(bounded.names) + bounded.dry + i
            parts = np.array(by_impulse)[:, at]
            reaction = impulses @ parts
            size = float(np.linalg.norm(reaction))
            along = reaction / size if size > 0.0 else np.zeros(2)
            columns[:count] -= np.outer(way * values[place] * (parts @ along), self.rows[row])
            change = bounds[place] * size + values[place] * (along @ turned[at])
            loads -= np.outer(self.rows[row], way * change)
            loads += self.slopes[row] * push.ties.kicks[row]
        return loads
