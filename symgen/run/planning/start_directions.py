"""Directions of a start: derivatives of the state at which a run begins.

The start is closed, so its directions solve the derivative of what closed it: positions by the shortest change at the
closed start, where held quantities have directions of their own; velocities likewise.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.base.vocabulary.rotations import composed_rotation
from symgen.compile.native import types
from symgen.describe.formulas.duals import Dual, Duals, as_dual, dual_slopes, parameter_duals
from symgen.describe.formulas.evaluate import parameter_values, scalar_values
from symgen.describe.formulas.start import described_start
from symgen.run.directions.directed_model import DirectedModel, Seeds, lanes_for_directions
from symgen.run.layout import abi
from symgen.run.layout.probe import Ready
from symgen.run.planning.held_numbers import held_quantities
from symgen.run.planning.shortest_changes import NONE, shortest_slope, shortest_solution

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel, ModelInfo
    from symgen.run.planning.named_directions import RunDirection
    from symgen.run.planning.prepare import Prepared
    from symgen.run.starts.assembly import Start

Array = NDArray[np.float64]

#: Rates of Euler parameters in unit orientation by unit angular velocities.
_HALVES = (0.0, 0.5, 0.0, 0.0), (0.0, 0.0, 0.5, 0.0), (0.0, 0.0, 0.0, 0.5)
#: Part of the largest velocity by which a described one may differ from that of the start.
_KEPT = 1e-9


@dataclass(frozen=True)
class StartDirections:
    """Directions of the start of a run.

    Parameters
    ----------
    run : Prepared
        The run.
    directions : tuple of RunDirection
        What it is differentiated by.
    """

    run: Prepared
    directions: tuple[RunDirection, ...]

    @property
    def compiled(self) -> CompiledModel:
        """Code in the coordinates of bodies, whose start is closed."""
        return self.run.assembled.of_bodies[0]

    @property
    def start(self) -> Start:
        """The start in the coordinates of bodies."""
        return self.run.assembled.of_bodies[1]

    @property
    def info(self) -> ModelInfo:
        """Names of the coordinates of bodies."""
        return self.compiled.info

    @property
    def count(self) -> int:
        """Number of directions."""
        return len(self.directions)

    @cached_property
    def duals(self) -> Duals:
        """Parameters with their directions."""
        changed = self.run.plan.parameters
        values = parameter_values(self.run.plan.mechanism, changed)
        by = [d.key if d.kind == "parameter" else "" for d in self.directions]
        return Duals(parameter_duals(self.run.plan.mechanism, values, changed, by))

    def parameters(self, compiled: CompiledModel) -> Array:
        """Return the directions of the array of parameters of a model, shape (np, n)."""
        law = compiled.law
        law_size = max(1, law.parameter_offset + len(law.parameters) + law.hoisted)
        rows = np.zeros((law_size, self.count))
        own = self.duals.values
        rows[: len(compiled.info.parameters)] = list(
            dual_slopes([own.get(q.name) for q in compiled.info.parameters], self.count)
        ) or np.zeros((0, self.count))
        places = {name: law.parameter_offset + i for i, (name, _) in enumerate(law.parameters)}
        for k, d in enumerate(self.directions):
            if d.kind == "method":
                rows[places[d.key], k] = 1.0
        return rows

    def seeds(self) -> Seeds:
        """Return the directions of the start in the coordinates of the state.

        Raises
        ------
        InputError
            If no closed start exists in a direction.
        """
        if self.run.plan.last is not None:
            raise InputError("sensitivities", "a run from the described start", "one that continues another run")
        y, tree = self.of_bodies, self.run.tree
        own = self.run.compiled
        if tree is None:
            return Seeds(y, self.parameters(own))
        return Seeds(self._on_tree(y), self.parameters(own))

    # -- in the coordinates of bodies ----------------------------------------------------------------------------------

    @cached_property
    def _model(self) -> DirectedModel:
        return DirectedModel(self.compiled, lanes_for_directions(8))

    def _derived(self, function: Any, kind: types.FunctionType, y: Array, p: Array, length: int = 0) -> Array:
        """Return the directions of what a function writes, to ``out`` or to the scratch array, shape (rows, n).

        Parameters
        ----------
        function, kind : emitted function, FunctionType
            ``geometry`` or ``observe``.
        y, p : Array, shapes (ny, n), (np, n)
            Directions of state and parameters.
        length : int
            Length of ``out``.
        """
        model, start = self._model, self.start
        call, parts = model.function(function, length).caller(kind.signature.arguments), list[Array]()
        seeds = Seeds(y, p)
        for first in range(0, seeds.count, model.lanes):
            own = seeds.seeds_of_part(first, model.lanes)
            numbers = model.parameters(start.p, own.p)
            state, w = model.room_with_directions(start.y, "y", own.y), model.room_with_directions(start.w, "w")
            if length:
                out = np.zeros(length * (1 + model.lanes))
                call(start.t, state, numbers, w, np.zeros_like(state), out)
                parts.append(out[length:].reshape(length, model.lanes))
            else:
                call(start.t, state, numbers, w)
                parts.append(model.directions_after(w, "w"))
        return np.concatenate(parts, axis=1)[:, : seeds.count]

    def _geometry(self, y: Array, p: Array) -> Array:
        return self._derived(self.compiled.model.geometry, abi.MEASURE, y, p)

    def _joints(self, y: Array, p: Array) -> Array:
        """Return the directions of joint coordinates and their rates, shape (2 joints, n)."""
        info = self.info
        if not info.joint_coordinates:
            return np.zeros((0, y.shape[1]))
        return self._derived(self.compiled.model.observe, abi.OBSERVE, y, p, info.observed)[info.m :]

    @cached_property
    def _turning(self) -> Array:
        """The matrix from velocities to rates of coordinates, shape (nq, nv)."""
        info, q = self.info, self.start.y
        motion = np.zeros((info.nq, info.nv))
        euler = {first + k for first, _ in info.spins for k in range(4)}
        spun = {at + k for _, at in info.spins for k in range(3)}
        places = [i for i in range(info.nq) if i not in euler]
        motion[places, [j for j in range(info.nv) if j not in spun]] = 1.0
        for first, at in info.spins:
            e0, e1, e2, e3 = q[first : first + 4].tolist()
            for k, half in enumerate(_HALVES):
                motion[first : first + 4, at + k] = composed_rotation((e0, e1, e2, e3), half)
        return motion

    @cached_property
    def of_bodies(self) -> Array:
        """Directions of the state of bodies at the start, shape (ny, n)."""
        info, n = self.info, self.count
        p = self.parameters(self.compiled)
        _, v = described_start(self.run.plan.mechanism, self.duals)
        y = np.zeros((info.ny, n))
        y[: info.nq] = self._closed[0]
        y[info.nq : info.work] = self._velocities(v, y, p)
        y[info.own_states] = self._states()
        return y

    def _targets(self, table: dict[str, int]) -> dict[int, Array]:
        """Return the directions of held quantities by their places in a table."""
        held = {hold.name: hold.value for hold in self.run.plan.holds if hold.name in table}
        directions = dict[int, Array]()
        for name, value in held.items():
            if value is not None:
                slopes = self.duals.value(value, f"start '{name}'")
                directions[table[name]] = np.array(next(dual_slopes([slopes], self.count)))
        for k, d in enumerate(self.directions):
            if d.kind == "start" and d.key in table:
                directions[table[d.key]] = np.eye(self.count)[k]
        return directions

    def _fixed(self) -> set[int]:
        """Return the velocities whose coordinates stay as described."""
        described = [hold for hold in self.run.plan.holds if hold.value is None]
        return set(held_quantities(self.info, described, self._numbers, [0.0] * self.info.nv).fixed)

    @cached_property
    def _numbers(self) -> Any:
        """Values of formulas without directions."""
        return scalar_values({name: x.value for name, x in self.duals.values.items()})

    @property
    def notes(self) -> tuple[str, ...]:
        """What was chosen for directions of the start."""
        moved = [d.name for d, chosen in zip(self.directions, self._closed[1].tolist(), strict=True) if chosen]
        if not moved:
            return ()
        words = "the start is not held: derivatives are those of the shortest change that keeps it closed"
        return (f"sensitivities to {', '.join(moved)}: {words}",)

    @cached_property
    def _closed(self) -> tuple[Array, NDArray[np.bool_]]:
        """Directions of coordinates: the described ones, and the shortest change that keeps loops closed.

        With these, whether coordinates that are not held move although others would close the loops as well.
        """
        info, motion, p = self.info, self._turning, self.parameters(self.compiled)
        q, _ = described_start(self.run.plan.mechanism, self.duals)
        described = np.array(list(dual_slopes(q, self.count))).reshape(info.nq, self.count)
        along = np.linalg.pinv(motion) @ described
        y = np.zeros((info.ny, self.count))
        y[: info.nq] = motion @ along
        holonomic = [i for i in self._in_force if info.rows[i].holonomic]
        first, size = info.sections["residual"]
        rows = self.compiled.jacobian(self._scratch)[holonomic]
        violated = self._geometry(y, p)[first : first + size][holonomic]
        coordinates = {q.name: i for i, q in enumerate(info.coordinates)}
        joints = {q.name: k for k, q in enumerate(info.joint_coordinates)}
        fixed = {j: np.zeros(self.count) for j in self._fixed()}
        for i, target in self._targets(coordinates).items():
            j = int(np.argmax(np.abs(motion[i])))
            fixed[j] = target - along[j]
        held = self._targets(joints)
        if held:
            unit = np.zeros((info.ny, info.nv))
            unit[: info.nq] = motion
            by, at = self._joints(unit, np.zeros((len(p), info.nv)))[::2], self._joints(y, p)[::2]
            rows = np.vstack([rows, by[list(held)]])
            violated = np.vstack([violated, at[list(held)] - np.array(list(held.values()))])
        names = [info.rows[i].name for i in holonomic] + [info.joint_coordinates[k].name for k in held]
        scales = np.sqrt(self.compiled.section(self.start.w, "gauge"))
        change = shortest_solution(
            rows, -violated, fixed, names, np.zeros((info.nv, self.count)), scales, self.directions
        )
        free = [j for j in range(info.nv) if j not in fixed]
        moved = np.abs(change[free]).max(axis=0, initial=0.0) > _KEPT * np.abs(along + change).max(axis=0, initial=0.0)
        loose = rows.shape[1] > 0 and np.linalg.matrix_rank(rows[:, free]) < len(free)
        return np.asarray(motion @ (along + change)), moved & loose

    @cached_property
    def _in_force(self) -> list[int]:
        """Rows that close a start: those with bounds are off there."""
        off = self.compiled.off(self.start.w)
        return [i for i, row in enumerate(self.info.rows) if row.name not in off]

    @cached_property
    def _scratch(self) -> Array:
        """Scratch after ``geometry`` at the start."""
        w, start = self.start.w.copy(), self.start
        Ready(self.compiled.model.geometry, abi.MEASURE)(start.t, start.y.copy(), start.p, w)
        return w

    def _velocities(self, described: Sequence[Dual | None], y: Array, p: Array) -> Array:
        """Return the directions of velocities: specified ones have their own, others complete them."""
        info, start, n = self.info, self.start, self.count
        v = start.y[info.nq : info.work]
        places = {q.name: j for j, q in enumerate(info.velocities)}
        fixed = {j: np.array(next(dual_slopes([x], n))) for j, x in enumerate(described) if x is not None}
        kept = np.array([0.0 if x is None else as_dual(x).value for x in described])
        held = self._targets(places)
        fixed |= held
        for j in held:
            kept[j] = v[j]
        rates = self._targets({f"{q.name}.rate": k for k, q in enumerate(info.joint_coordinates)})
        derived = self._geometry(y, p)
        first, size = info.sections["nu"]
        own = self._in_force
        rows, slopes = self.compiled.jacobian(self._scratch)[own], self._jacobians(derived)[own]
        right = derived[first : first + size][own] - np.einsum("ijk,j->ik", slopes, v)
        if rates:
            unit = np.zeros((info.ny, info.nv))
            unit[info.nq : info.work] = np.eye(info.nv)
            by, at = self._joints(unit, np.zeros((len(p), info.nv)))[1::2], self._joints(y, p)[1::2]
            rows = np.vstack([rows, by[list(rates)]])
            right = np.vstack([right, np.array(list(rates.values())) - at[list(rates)]])
            slopes = np.concatenate([slopes, np.zeros((len(rates), info.nv, n))])
        names = [info.rows[i].name for i in own] + [f"{info.joint_coordinates[k].name}.rate" for k in rates]
        scales = np.sqrt(self.compiled.section(self.start.w, "gauge"))
        free = [j for j in range(info.nv) if j not in fixed]
        apart = np.abs(v - kept)[list(fixed)].max(initial=0.0)
        fits = apart <= _KEPT * np.abs(v).max(initial=0.0)
        if fits:
            more = shortest_slope(rows, slopes, v, free, scales, np.zeros((info.nv, n)), bool(rates))
            try:
                return shortest_solution(rows, right, fixed, names, more, scales, self.directions)
            except InputError:
                if np.any(np.abs(v[free]) > _KEPT * np.abs(v).max(initial=0.0)):
                    raise
        # specified velocities contradict joints, or would after a change: they are projected in the metric of masses
        change, free = v - kept, [j for j in range(info.nv) if j not in held]
        masses = np.maximum(self.compiled.section(self.start.w, "mass"), 1e-300)
        scales = 1.0 / np.sqrt(masses)
        more = shortest_slope(rows, slopes, change, free, scales, self._masses(p) * change[:, np.newaxis], bool(rates))
        given = np.zeros((info.nv, n))
        for j, target in fixed.items():
            given[j] = target
        still = {j: np.zeros(n) for j in held}
        return given + shortest_solution(rows, right - rows @ given, still, names, more, scales, self.directions)

    def _masses(self, p: Array) -> Array:
        """Return the directions of the masses of velocities, shape (nv, n)."""
        model, parts = self._model, list[Array]()
        seeds, (first, size) = Seeds(np.zeros((1, p.shape[1])), p), self.info.sections["mass"]
        for k in range(0, seeds.count, model.lanes):
            w = model.scratch(model.parameters(self.start.p, seeds.seeds_of_part(k, model.lanes).p), self.start.w)
            parts.append(model.directions_after(w, "w")[first : first + size])
        return np.concatenate(parts, axis=1)[:, : seeds.count]

    def _jacobians(self, derived: Array) -> Array:
        """Return the directions of D, shape (m, nv, n)."""
        info, (first, _) = self.info, self.info.sections["jacobian"]
        slopes = np.zeros((info.m, info.nv, derived.shape[1]))
        for row, column, _, slot in info.jacobian:
            if slot is not None:
                slopes[row, column] = derived[first + slot]
        return slopes

    def _states(self) -> Array:
        """Return the directions of the file's own states."""
        held = {hold.name: hold.value for hold in self.run.plan.holds}
        numbers = [self.duals.value(held.get(x.name) or x.start, x.name) for x in self.run.plan.mechanism.states]
        rows = np.array(list(dual_slopes(numbers, self.count))).reshape(len(numbers), self.count)
        for k, d in enumerate(self.directions):
            for i, x in enumerate(self.run.plan.mechanism.states):
                if d.kind == "start" and d.key == x.name:
                    rows[i, k] = 1.0
        return rows

    # -- in the coordinates of joints ----------------------------------------------------------------------------------

    def _on_tree(self, bodies: Array) -> Array:
        """Return the directions of joint coordinates from the directions of bodies."""
        tree, own, info = self.run.tree, self.run.compiled.info, self.info
        assert tree is not None, "the state is that of joints"
        model, length = DirectedModel(tree.compiled, lanes_for_directions(8)), info.nq + 2 * info.nv
        call = model.function(tree.compiled.model.bodies, length).caller(abi.OBSERVE.signature.arguments)
        start, n = tree.start, self.count

        def moved(seeds: Seeds) -> Array:
            parts = list[Array]()
            for first in range(0, seeds.count, model.lanes):
                part = seeds.seeds_of_part(first, model.lanes)
                p, y = model.parameters(start.p, part.p), model.room_with_directions(start.y, "y", part.y)
                out = np.zeros(length * (1 + model.lanes))
                call(start.t, y, p, model.room_with_directions(start.w, "w"), np.zeros_like(y), out)
                parts.append(out[length:].reshape(length, model.lanes)[: info.work])
            rows = np.concatenate(parts, axis=1)[:, : seeds.count]
            rows[: info.nq] *= tree.signs[:, np.newaxis]
            return rows

        unit = np.zeros((own.ny, own.work))
        unit[: own.work] = np.eye(own.work)
        by = moved(Seeds(unit, np.zeros((len(start.p), own.work))))
        rest = bodies[: info.work] - moved(Seeds(np.zeros((own.ny, n)), self.parameters(tree.compiled)))
        result = np.zeros((own.ny, n))
        result[: own.work] = np.linalg.lstsq(by, rest, rcond=NONE)[0]
        result[own.own_states] = bodies[info.own_states]
        return result
