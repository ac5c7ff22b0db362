"""Starts in which joint coordinates or their rates are held: further rows, which the emitted ``observe`` gives.

A joint coordinate is no coordinate of the state: holding it is a constraint more at the start. ``observe`` tells its
value and its rate, and as rates are linear in the velocities, also the row of its derivative. Such starts are looked
for here, in plain Python with the pieces of `symgen.runtime.closing`, and then pass the one start like any other.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.runtime import abi, decisions
from symgen.runtime import ensemble_abi as e
from symgen.runtime.closing import close_positions, complete_velocities
from symgen.runtime.exact import compiled_form, plain_form
from symgen.runtime.least_norm import dense_change, iterated_change
from symgen.runtime.manifold import stay
from symgen.runtime.probe import Ready
from symgen.runtime.scales import extent_of, free_scale, measure_lengths
from symgen.runtime.start_records import Asked, Closing, Instant, Layout, new_work

if TYPE_CHECKING:
    from symgen.runtime.compiled import CompiledModel
    from symgen.runtime.held import Held

Array = NDArray[np.float64]


def joint_values(compiled: CompiledModel, t: float, y: Array, p: Array, w: Array) -> Array:
    """Return value and rate of every joint coordinate in turns, shape (2 n,).

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    t, y, p, w
        As emitted functions take them; the section of angles that count turns says on which turn these are.
    """
    info = compiled.info
    out = np.zeros(info.observed)
    Ready(compiled.model.observe, abi.OBSERVE)(t, y, p, w, np.zeros_like(y), out)
    return out[info.m :]


@dataclass
class _Rows:
    """Rows of joint coordinates behind those of a model, as the pieces of a start take them.

    Attributes
    ----------
    compiled : CompiledModel
        The model.
    base : Layout
        Its layout.
    chosen : sequence of int
        Joint coordinates.
    goals : Array, shape (k,)
        Values that they shall have, or rates.
    """

    compiled: CompiledModel
    base: Layout
    chosen: Sequence[int]
    goals: Array

    def __post_init__(self) -> None:
        info, base, k = self.compiled.info, self.base, len(self.chosen)
        self.nw, m, n = len(self.compiled.scratch()), base.m, base.nv
        self.at = self.nw + 2 * (m + k)
        places = [(m + i, j, self.at + i * n + j - base.jacobian) for i in range(k) for j in range(n)]
        kinds = [(-1, int(info.joint_coordinates[c].unit != "rad")) for c in self.chosen]
        self.layout = base._replace(
            m=m + k,
            residual=self.nw,
            nu=self.nw + m + k,
            entries=np.concatenate([base.entries, np.array(places, dtype=np.int64).ravel()]),
            constants=np.concatenate([base.constants, np.zeros(k * n)]),
            rows=np.concatenate([base.rows, np.array(kinds, dtype=np.int64).ravel()]),
            alone=np.concatenate([base.alone, np.zeros(k, dtype=np.int64)]),
        )
        self._geometry = Ready(self.compiled.model.geometry, abi.MEASURE)

    def scratch(self, w: Array) -> Array:
        """Return scratch that has room for the rows, and begins and ends as `w`: there looped code finds its tables."""
        return np.concatenate([w, np.zeros(self.at - self.nw + len(self.chosen) * self.base.nv), w[-1:]])

    def geometry(self, t: float, y: Array, p: Array, w: Array) -> int:
        """Fill Phi, D and nu of all rows."""
        own, m, k, n = w[: self.nw], self.base.m, len(self.chosen), self.base.nv
        self._geometry(t, y, p, own)
        values, slopes = self._slopes(t, y, p, own)
        w[self.nw : self.nw + m] = own[self.base.residual : self.base.residual + m]
        w[self.nw + m : self.nw + m + k] = values - self.goals
        w[self.layout.nu : self.layout.nu + m] = own[self.base.nu : self.base.nu + m]
        w[self.layout.nu + m : self.layout.nu + m + k] = self.goals
        w[self.at : self.at + k * n] = slopes.ravel()
        return 0

    def _slopes(self, t: float, y: Array, p: Array, w: Array) -> tuple[Array, Array]:
        """Return the values, and the derivatives of the rates with respect to v."""
        nq, n, rows = self.base.nq, self.base.nv, np.array(self.chosen, dtype=np.int64)
        here, w, slopes = y.copy(), w.copy(), np.zeros((len(rows), n))
        here[nq : nq + n] = 0.0
        still = joint_values(self.compiled, t, here, p, w)
        for j in range(n):
            here[nq + j] = 1.0
            slopes[:, j] = (joint_values(self.compiled, t, here, p, w) - still)[2 * rows + 1]
            here[nq + j] = 0.0
        return still[2 * rows], slopes


def reach(
    compiled: CompiledModel, layout: Layout, functions: Mapping[str, Any], held: Held, now: Instant, asked: Asked
) -> int:
    """Find positions and velocities in which joint coordinates are what they are held at; return how that ended.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    layout : Layout
        Of the model, with the coordinates and velocities that are held.
    functions : mapping
        ``measure``, ``move`` and ``turns`` as `symgen.runtime.starting.close_row` takes them.
    held : Held
        What is held.
    now : Instant
        The described coordinates, with parameters and masses prepared; on return the state that was found, with the
        branches of the angles that count turns.
    asked : Asked
        Given velocities, values of held coordinates, and the summary of the start.
    """
    measure, move = Ready(functions["measure"], abi.MEASURE), Ready(functions["move"], abi.MOVE)
    geometry = Ready(compiled.model.geometry, abi.MEASURE)
    largest = (layout.m + len(held.joints)) * layout.nv
    solve: Any = plain_form(dense_change)
    if layout.sparse and largest > decisions.LARGEST_DENSE:
        solve = compiled_form(iterated_change)
    elif largest * min(layout.m + len(held.joints), layout.nv) > decisions.LARGEST_INTERPRETED:
        solve = compiled_form(dense_change)
    y, w = now.y, now.w
    work = new_work(layout, len(w))
    plain_form(measure_lengths)(geometry, layout, now, work)
    if layout.windings:
        plain_form(functions["turns"])(geometry, measure, layout, now, work)

    def closed(rows: _Rows | None, state: Instant) -> bool:
        of, phi = (layout, geometry) if rows is None else (rows.layout, rows.geometry)
        room = new_work(of, len(state.w))
        room.scale[:] = [0.0 if j in still else plain_form(free_scale)(layout, w, j) for j in range(layout.nv)]
        closing = Closing(phi, measure, move, stay, solve)
        return bool(plain_form(close_positions)(closing, of, state, room))

    still = set(np.flatnonzero(layout.fixed).tolist())
    first = y[: layout.nq].copy()
    if not closed(None, now):
        return int(e.OPEN)
    length = max(float(w[abi.LENGTH]), plain_form(extent_of)(layout, y))
    scales = np.where(layout.lengths != 0.0, length, 1.0)
    moved = np.abs(y[: layout.nq] - first)
    asked.summary[e.START_MOVED] = float(np.max(np.where(moved > decisions.MOVED * scales, moved, 0.0), initial=0.0))
    # on the way from there, so that the mechanism keeps its branch
    held_at, targets = layout.held.reshape(-1, 2), asked.targets
    chosen, goals = list(held.joints), np.array(list(held.joints.values()))
    origin = y[held_at[:, 0]]
    values = joint_values(compiled, layout.t, y, now.p, w)[0::2][chosen] if chosen else np.zeros(0)
    sizes = np.array([length if compiled.info.joint_coordinates[k].unit == "m" else 1.0 for k in chosen])
    away = [*np.abs(targets - origin) / scales[held_at[:, 0]], *np.abs(goals - values) / sizes]
    far = max(away, default=0.0)
    strides = min(max(1, math.ceil(far / decisions.STRIDE)), decisions.MOST_STRIDES)
    still |= set(held_at[:, 1].tolist())
    rows = _Rows(compiled, layout, chosen, goals)
    state = Instant(y, now.p, rows.scratch(w))
    for k in range(1, strides + 1):
        share = k / strides
        y[held_at[:, 0]] = targets if k == strides else origin + share * (targets - origin)
        rows.goals = goals if k == strides else values + share * (goals - values)
        if not closed(rows, state):
            w[:] = state.w[: len(w)]
            return int(e.OPEN)
    w[:] = state.w[: len(w)]
    # velocities, where rates are rows of D v = nu
    rates = _Rows(compiled, layout, list(held.rates), np.array(list(held.rates.values())))
    state = Instant(y, now.p, rates.scratch(w))
    rates.geometry(layout.t, *state)
    room = new_work(rates.layout, len(state.w))
    closing = Closing(geometry, measure, move, stay, solve)
    code = plain_form(complete_velocities)(closing, rates.layout, state, room, asked.given)
    w[:] = state.w[: len(w)]
    asked.summary[e.START_VELOCITIES] = 1.0 if code == e.PROJECTED else 0.0
    return int(e.ASSEMBLED if code == e.PROJECTED else code)
