"""Formulas on the equations of one mechanism, element by element: every number is a node of a graph."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from typing import Self

from symgen.base.ir.derivative import jacobian
from symgen.base.ir.graph import PARAMETER
from symgen.base.ir.numerics import PARALLEL, SKIP, SUSPICIOUS
from symgen.base.ir.program import EliminationPlan, FixedVelocities
from symgen.derive.formulate.equations import without_bounded_rows
from symgen.derive.lower.drag import drag_forces
from symgen.derive.lower.factor import FactorNodes
from symgen.derive.lower.replay import Nodes
from symgen.derive.lower.saddle_matrix import SaddleMatrix
from symgen.derive.lower.scalar_rows import OfRows
from symgen.derive.methods._tape import FormulaStep, needed_operations


class ScalarNodes(OfRows):
    """The operations of formulas on nodes of a mechanism's graph.

    Named values and attributes are those of `symgen.derive.lower.scalar_values`; here are the solutions of
    M v' + D^T lambda = f, D v' = gamma, by elimination and with drags.
    """

    def with_closed_loops(self, operations: tuple[FormulaStep, ...], plan: EliminationPlan) -> Self:
        """Return a tape in the same graph, nothing evaluated yet, with the loops of a plan in closed form."""
        other = self.for_tape(operations)
        other.__dict__.pop("saddle", None)
        other.plan, other.stored, other.flags, other.closing = plan, {}, [], True
        return other

    def without_bounded_rows(self, operations: tuple[FormulaStep, ...], plan: EliminationPlan, closing: bool) -> Self:
        """Return another tape in the same graph, nothing evaluated yet, of motions with no row with bounds in force."""
        other = self.for_tape(operations)
        for name in ("saddle", "row_halves", "order", "_schur"):
            other.__dict__.pop(name, None)
        other.equations = without_bounded_rows(self.equations)
        other.rows = tuple(row.entries for row in other.equations.rows)
        other.stored, other.flags, other.plan, other.closing, other.brief = {}, [], plan, closing, True
        return other

    def compute(self, ends: Iterable[int]) -> None:
        """Evaluate the operations that some depend on."""
        self.evaluate_remaining(needed_operations(ends, lambda i: self.operations[i].operands))

    def _on_constrained(self, operation: FormulaStep, f: Nodes, gamma: Nodes) -> Nodes:
        accelerations, multipliers = (
            self._solve_with_drags(f, gamma) if self.equations.drags else self.saddle.solve(f, gamma)
        )
        return accelerations if operation.payload == ("accelerations",) else multipliers

    def solve_plan(self, f: Nodes, gamma: Nodes) -> tuple[Nodes, Nodes]:
        """Return v' and lambda with ``M v' + D^T lambda = f``, ``D v' = gamma``, eliminated as the plan says."""
        return self.solve_by_factor(f, gamma, self._schur_factor) if self.plan.schur else self.saddle.solve(f, gamma)

    def _solve_with_drags(self, f: Nodes, gamma: Nodes) -> tuple[Nodes, Nodes]:
        """Return v' and lambda with drags; leave its power and the squares of jamming numbers."""
        g, drags = self.graph, self.equations.drags
        given, effects = (*f, *gamma), list[Nodes]()
        for drag in drags:
            entries = dict(self.directions[drag.row])
            effects.append(tuple(entries.get(j, g.zero) for j in range(len(given))))
        without, *solved = (self._complete_solution(x, self._solve_rest(x))[1] for x in (given, *effects))
        alone = [self.reaction(drag, without) for drag in drags]
        parts = [[self.reaction(drag, effect) for effect in solved] for drag in drags]
        forces, rest = self._drag_forces(alone, parts), self._solve_rest(given)
        for force, effect in zip(forces, effects, strict=True):
            own = self._solve_rest(effect)
            rest = {k: g.sub(x, g.mul(force, own[k])) for k, x in rest.items()}
            given = tuple(g.sub(x, g.mul(force, y)) for x, y in zip(given, effect, strict=True))
        return self._complete_solution(given, rest)

    def _drag_forces(self, alone: Sequence[Nodes], parts: Sequence[Sequence[Nodes]]) -> list[int]:
        """Return the forces of drags; leave its power and the squares of jamming numbers."""
        g, drags = self.graph, self.equations.drags
        coefficients = [g.mul(drag.sign, drag.coefficient) for drag in drags]
        signed = [drag.signed for drag in drags]
        forces, doubtful = drag_forces(g, coefficients, signed, alone, parts, self.brief)
        self.flags += [] if doubtful is None else [doubtful]
        self.drag_power, self.jamming = g.zero, []
        for i, (drag, force) in enumerate(zip(drags, forces, strict=True)):
            self.drag_power = g.sub(self.drag_power, g.mul(drag.rate, force))
            if drag.signed:  # what is left of 1 is the determinant of one contact
                self.jamming.append(g.neg(g.mul(coefficients[i], parts[i][i][0])))
            else:
                self.jamming.append(g.mul(g.mul(drag.coefficient, drag.coefficient), g.dot(parts[i][i], parts[i][i])))
        return forces

    def settle_drags(self, multipliers: int, ends: Iterable[int]) -> None:
        """Put drags in place of its unknowns in f, in the values of some operations.

        Multipliers are linear in f: their derivatives are those of unit forces.
        """
        g, keys = self.graph, [("drag", i) for i in range(len(self.equations.drags))]
        reactions = [self.reaction(drag, self.values[multipliers]) for drag in self.equations.drags]
        alone = [tuple(g.replace_inputs(n, dict.fromkeys(keys, g.zero))) for n in reactions]
        slopes = [jacobian(g, n, keys) for n in reactions]
        parts = [[tuple(g.neg(x.get(key, g.zero)) for x in each) for key in keys] for each in slopes]
        forces = dict(zip(keys, self._drag_forces(alone, parts), strict=True))
        for index in dict.fromkeys(ends):
            value = self.values[index]
            new = g.replace_inputs(value if isinstance(value, tuple) else (value,), forces)
            self.values[index] = tuple(new) if isinstance(value, tuple) else new[0]

    def put_drags(self, index: int) -> None:
        """Put drags by the multipliers of a result in place of their unknowns, in the value of an operation."""
        given = self.section("multipliers", len(self.equations.rows))
        forces = {("drag", i): force for i, (_, force) in enumerate(self.forces_of_drags(given))}
        self.values[index] = tuple(self.graph.replace_inputs(self.values[index], forces))

    def _solve_rest(self, given: Nodes) -> Mapping[int, int]:
        """Return the unknowns of v' and lambda that no row alone fixes, linear in f and gamma."""
        if not self.plan.schur:
            return self.saddle.solve_rest(given)
        accelerations, multipliers = self.solve_by_factor(
            given[: self.equations.nv], given[self.equations.nv :], self._schur_factor
        )
        return dict(enumerate((*accelerations, *multipliers)))

    def _complete_solution(self, given: Nodes, rest: Mapping[int, int]) -> tuple[Nodes, Nodes]:
        """Return v' and lambda from those that no row alone fixes."""
        if not self.plan.schur:
            return self.saddle.complete_solution(given, rest)
        unknowns = tuple(rest[i] for i in range(len(given)))
        return unknowns[: self.equations.nv], unknowns[self.equations.nv :]

    def _on_stored_constrained(self, operation: FormulaStep, rank: FactorNodes, f: Nodes, gamma: Nodes) -> Nodes:
        metric, name = operation.payload
        change, multipliers = self._stored_saddle(str(metric), rank).solve(f, gamma)
        return change if name == "change" else multipliers

    def _stored_saddle(self, metric: str, rank: FactorNodes) -> SaddleMatrix:
        """Return the eliminated matrix of W and D as ``geometry`` left it, rows left out by the pivots that it left."""
        g = self.graph

        def reciprocal(row: int, pivot: int, _: int) -> int:
            if self._is_always_kept(row, rank.pivots[row], rank.diagonal[row]):
                return g.div(g.one, pivot)
            keep = g.call("step", g.input("pivot", row), g.add(g.constant(SKIP), self.mask[row]))
            return self._masked_reciprocal(keep, pivot)

        matrix = self._eliminate_fixed(self._metric_rows(metric), self.stored_constraints())
        matrix.eliminate_rest(reciprocal)
        return matrix

    @cached_property
    def saddle(self) -> SaddleMatrix:
        """The eliminated matrix of M and D; masked rows get a reciprocal pivot of 0, small pivots a flag."""
        g, fixed = self.graph, {c for block in self.plan.fixed for c in block.columns}
        matrix, eliminated = self._eliminate_fixed(self.mass_matrix, self.rows, self.plan.normal), set(self.plan.rows)
        for loop in self.plan.loops if self.closing else ():
            square, largest = matrix.eliminate_loop(loop)
            sine = PARALLEL if matrix.loops[-1].motion else SUSPICIOUS
            self.flags.append(self._is_doubtful_loop(loop, square, largest, sine))
            fixed |= set(loop.columns)
            eliminated |= set(loop.rows)
        for row, entries in enumerate(self.rows):
            if row not in eliminated and fixed & {j for j, _ in entries} and self._pinned_mass(row) is None:
                rest = self._square_of_row(row, sorted(matrix.entries[matrix.nv + row].items()))
                least = g.mul(g.constant(SUSPICIOUS), self._square_of_row(row, entries))
                self.flags.append(g.call("lt", g.add(rest, self.mask[row]), self.node_in_force(row, least)))

        def reciprocal(row: int, pivot: int, first: int) -> int:
            masked = g.add(pivot, self.mask[row])  # the mask is 0, or infinite for a row to be left out
            usual, mass = first, self._pinned_mass(row) if fixed & {j for j, _ in self.rows[row]} else None
            if mass is not None:
                usual = g.div(g.one, mass) if pivot == first else g.call("max", first, g.div(g.one, mass))
            if pivot != usual:
                least = self.node_in_force(row, g.mul(g.constant(SUSPICIOUS), usual))
                self.flags.append(g.call("lt", masked, least))
            return self._masked_reciprocal(self._is_held(row), masked)

        matrix.eliminate_rest(reciprocal)
        return matrix

    def _is_doubtful_loop(self, loop: FixedVelocities, square: int, largest: int, sine: float) -> int:
        """Return the node that is true where a loop's columns are nearly parallel or short, or a row is masked."""
        g, (a, b), (i, j) = self.graph, loop.rows, loop.columns
        least = g.add(g.mul(g.constant(sine), largest), g.add(self.mask[a], self.mask[b]))
        doubtful = g.call("le", square, least)
        if not g.depends[largest] & ~PARAMETER:
            return doubtful
        gauge = g.mul(next(iter(self.gauge[i].values())), next(iter(self.gauge[j].values())))
        short = g.call("lt", g.mul(largest, gauge), g.constant(SUSPICIOUS**2))
        return g.call("or", doubtful, short)

    def _pinned_mass(self, row: int) -> int | None:
        """Return the largest constant mass that a row holds by an entry of +-1, None without one.

        The inverse is a scale of the pivot of a row from which fixed velocities have been eliminated: what is left of
        the row may have cancelled, so that the row itself is no measure. Other bodies may be light.
        """
        g, heaviest = self.graph, None
        for j, entry in self.rows[row]:
            mass = self.mass_matrix[j, j]
            if g.value(entry) in (1.0, -1.0) and not g.depends[mass] & ~PARAMETER and mass != g.zero:
                if heaviest is None:
                    heaviest = mass
                elif (a := g.value(heaviest)) is not None and (b := g.value(mass)) is not None:
                    heaviest = mass if b > a else heaviest
                else:
                    heaviest = g.call("max", heaviest, mass)
        return heaviest
