"""Formulas on the equations of one mechanism, element by element: every number is a node of a graph."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property
from typing import Self

from symgen.base.ir.derivative import jacobian
from symgen.base.ir.graph import PARAMETER
from symgen.base.ir.numerics import PARALLEL, SKIP, SUSPICIOUS, TINY
from symgen.base.ir.polynomial import NormalForms
from symgen.base.ir.program import STATUS, EliminationPlan, FixedVelocities, OutputSlot
from symgen.derive.formulate.equations import Equations, without_bounded_rows
from symgen.derive.lower.blocks import SaddleMatrix
from symgen.derive.lower.drag import drag_forces
from symgen.derive.lower.factor import FactorNodes, factorisation, minimum_degree
from symgen.derive.lower.replay import Nodes
from symgen.derive.lower.scalar_mass import OfMass
from symgen.derive.lower.scalar_values import Outputs, Rows, to_status
from symgen.derive.methods._tape import FormulaStep, needed


class ScalarNodes(OfMass):
    """The operations of formulas on nodes of a mechanism's graph.

    Named values and attributes are those of `symgen.derive.lower.scalar_values`; here are factorisations, and
    the decision on rank.
    """

    def __init__(
        self,
        equations: Equations,
        operations: tuple[FormulaStep, ...] = (),
        parameters: Sequence[str] = (),
        places: Mapping[str, tuple[str, int]] | None = None,
        plan: EliminationPlan | None = None,
    ) -> None:
        super().__init__(equations, operations, parameters, places)
        self.plan = EliminationPlan() if plan is None else plan
        self.closing = self.brief = False

    def with_closed_loops(self, operations: tuple[FormulaStep, ...], plan: EliminationPlan) -> Self:
        """Return a tape in the same graph, nothing evaluated yet, with the loops of a plan in closed form."""
        other = self.following(operations)
        other.__dict__.pop("saddle", None)
        other.plan, other.stored, other.flags, other.closing = plan, {}, [], True
        return other

    def without_bounded_rows(self, operations: tuple[FormulaStep, ...], plan: EliminationPlan, closing: bool) -> Self:
        """Return another tape in the same graph, nothing evaluated yet, of motions with no row with bounds in force."""
        other = self.following(operations)
        for name in ("saddle", "row_halves", "order", "_schur"):
            other.__dict__.pop(name, None)
        other.equations = without_bounded_rows(self.equations)
        other.rows = tuple(row.entries for row in other.equations.rows)
        other.stored, other.flags, other.plan, other.closing, other.brief = {}, [], plan, closing, True
        return other

    def compute(self, ends: Iterable[int]) -> None:
        """Evaluate the operations that some depend on."""
        self.run(needed(ends, lambda i: self.operations[i].operands))

    def _on_constrained(self, operation: FormulaStep, f: Nodes, gamma: Nodes) -> Nodes:
        accelerations, multipliers = self._dragged(f, gamma) if self.equations.drags else self.saddle.solve(f, gamma)
        return accelerations if operation.payload == ("accelerations",) else multipliers

    def solution(self, f: Nodes, gamma: Nodes) -> tuple[Nodes, Nodes]:
        """Return v' and lambda with ``M v' + D^T lambda = f``, ``D v' = gamma``, eliminated as the plan says."""
        return self.by_factor(f, gamma, self._schur) if self.plan.schur else self.saddle.solve(f, gamma)

    def _dragged(self, f: Nodes, gamma: Nodes) -> tuple[Nodes, Nodes]:
        """Return v' and lambda with drags; leave its power and the squares of jamming numbers."""
        g, drags = self.graph, self.equations.drags
        given, effects = (*f, *gamma), list[Nodes]()
        for drag in drags:
            entries = dict(self.directions[drag.row])
            effects.append(tuple(entries.get(j, g.zero) for j in range(len(given))))
        without, *solved = (self._completed(x, self._rest(x))[1] for x in (given, *effects))
        alone = [self.reaction(drag, without) for drag in drags]
        parts = [[self.reaction(drag, effect) for effect in solved] for drag in drags]
        forces, rest = self._drag_forces(alone, parts), self._rest(given)
        for force, effect in zip(forces, effects, strict=True):
            own = self._rest(effect)
            rest = {k: g.sub(x, g.mul(force, own[k])) for k, x in rest.items()}
            given = tuple(g.sub(x, g.mul(force, y)) for x, y in zip(given, effect, strict=True))
        return self._completed(given, rest)

    def _drag_forces(self, alone: Sequence[Nodes], parts: Sequence[Sequence[Nodes]]) -> list[int]:
        """Return the forces of drags; leave its power and the squares of jamming numbers."""
        g, drags = self.graph, self.equations.drags
        signed = [g.mul(drag.sign, drag.coefficient) for drag in drags]
        forces, doubtful = drag_forces(g, signed, alone, parts, self.brief)
        self.flags += [] if doubtful is None else [doubtful]
        self.drag_power, self.jamming = g.zero, []
        for i, (drag, force) in enumerate(zip(drags, forces, strict=True)):
            self.drag_power = g.sub(self.drag_power, g.mul(drag.rate, force))
            self.jamming.append(g.mul(g.mul(drag.coefficient, drag.coefficient), g.dot(parts[i][i], parts[i][i])))
        return forces

    def settle_drags(self, multipliers: int, ends: Iterable[int]) -> None:
        """Put drags in place of its unknowns in f, in the values of some operations.

        Multipliers are linear in f: their derivatives are those of unit forces.
        """
        g, keys = self.graph, [("drag", i) for i in range(len(self.equations.drags))]
        reactions = [self.reaction(drag, self.values[multipliers]) for drag in self.equations.drags]
        alone = [tuple(g.replaced(n, dict.fromkeys(keys, g.zero))) for n in reactions]
        slopes = [jacobian(g, n, keys) for n in reactions]
        parts = [[tuple(g.neg(x.get(key, g.zero)) for x in each) for key in keys] for each in slopes]
        forces = dict(zip(keys, self._drag_forces(alone, parts), strict=True))
        for index in dict.fromkeys(ends):
            value = self.values[index]
            new = g.replaced(value if isinstance(value, tuple) else (value,), forces)
            self.values[index] = tuple(new) if isinstance(value, tuple) else new[0]

    def _rest(self, given: Nodes) -> Mapping[int, int]:
        """Return the unknowns of v' and lambda that no row alone fixes, linear in f and gamma."""
        if not self.plan.schur:
            return self.saddle.rest(given)
        accelerations, multipliers = self.by_factor(given[: self.equations.nv], given[self.equations.nv :], self._schur)
        return dict(enumerate((*accelerations, *multipliers)))

    def _completed(self, given: Nodes, rest: Mapping[int, int]) -> tuple[Nodes, Nodes]:
        """Return v' and lambda from those that no row alone fixes."""
        if not self.plan.schur:
            return self.saddle.completed(given, rest)
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
            if self._certain(row, rank.pivots[row], rank.diagonal[row]):
                return g.div(g.one, pivot)
            keep = g.call("step", g.input("pivot", row), g.add(g.constant(SKIP), self.mask[row]))
            return self._masked_reciprocal(keep, pivot)

        matrix = self._with_fixed(self._metric(metric), self.stored_constraints())
        matrix.eliminate_rest(reciprocal)
        return matrix

    def _metric(self, name: str) -> Mapping[tuple[int, int], int]:
        if name == "mass":
            return self.mass_matrix
        g = self.graph
        scales = (next(iter(x.values())) if name == "scaled" else g.one for x in self.gauge)
        return {(j, j): g.div(g.one, node) for j, node in enumerate(scales)}

    def _with_fixed(self, mass: Mapping[tuple[int, int], int], rows: Rows, normal: bool = False) -> SaddleMatrix:
        """Return a matrix from which fixed velocities have been eliminated with their rows."""
        simpler = NormalForms(self.graph).simpler if normal else None
        matrix = SaddleMatrix(self.graph, self.equations.nv, mass, rows, simpler)
        for block in self.plan.fixed:
            matrix.fix(block)
        return matrix

    @cached_property
    def saddle(self) -> SaddleMatrix:
        """The eliminated matrix of M and D; masked rows get a reciprocal pivot of 0, small pivots a flag."""
        g, fixed = self.graph, {c for block in self.plan.fixed for c in block.columns}
        matrix, eliminated = self._with_fixed(self.mass_matrix, self.rows, self.plan.normal), set(self.plan.rows)
        for loop in self.plan.loops if self.closing else ():
            square, largest = matrix.close(loop)
            sine = PARALLEL if matrix.loops[-1].motion else SUSPICIOUS
            self.flags.append(self._doubtful(loop, square, largest, sine))
            fixed |= set(loop.columns)
            eliminated |= set(loop.rows)
        for row, entries in enumerate(self.rows):
            if row not in eliminated and fixed & {j for j, _ in entries} and self._pinned_mass(row) is None:
                rest = self._square(row, sorted(matrix.entries[matrix.nv + row].items()))
                least = g.mul(g.constant(SUSPICIOUS), self._square(row, entries))
                self.flags.append(g.call("lt", g.add(rest, self.mask[row]), self.in_force(row, least)))

        def reciprocal(row: int, pivot: int, first: int) -> int:
            masked = g.add(pivot, self.mask[row])  # the mask is 0, or infinite for a row to be left out
            usual, mass = first, self._pinned_mass(row) if fixed & {j for j, _ in self.rows[row]} else None
            if mass is not None:
                usual = g.div(g.one, mass) if pivot == first else g.call("max", first, g.div(g.one, mass))
            if pivot != usual:
                least = self.in_force(row, g.mul(g.constant(SUSPICIOUS), usual))
                self.flags.append(g.call("lt", masked, least))
            return self._masked_reciprocal(self._held(row), masked)

        matrix.eliminate_rest(reciprocal)
        return matrix

    def _doubtful(self, loop: FixedVelocities, square: int, largest: int, sine: float) -> int:
        """Return the node that is true where a loop's columns are nearly parallel or short, or a row is masked."""
        g, (a, b), (i, j) = self.graph, loop.rows, loop.columns
        least = g.add(g.mul(g.constant(sine), largest), g.add(self.mask[a], self.mask[b]))
        doubtful = g.call("le", square, least)
        if not g.depends[largest] & ~PARAMETER:
            return doubtful
        gauge = g.mul(next(iter(self.gauge[i].values())), next(iter(self.gauge[j].values())))
        short = g.call("lt", g.mul(largest, gauge), g.constant(SUSPICIOUS**2))
        return g.call("or", doubtful, short)

    def _square(self, row: int, entries: Iterable[tuple[int, int]]) -> int:
        """Return the square of a row of the scale that decides rank."""
        g = self.graph
        return g.total(g.mul(g.mul(n, next(iter(self.gauge[j].values()))), n) for j, n in entries)

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

    def _on_weighted_body(self, operation: FormulaStep, rank: FactorNodes) -> FactorNodes:
        """Return the factor of D W^-1 D^T in the function that decides rank."""
        return self._weighted_beside(rank, self.body.mass_gram(self.rows))

    @cached_property
    def order(self) -> tuple[int, ...]:
        """Elimination order of the rows; one for S and D D^T, whose pattern is contained in S's."""
        return minimum_degree(self.neighbours(self.rows, self.coupled), self.plan.rows)[0]

    def _on_schur(self, operation: FormulaStep) -> FactorNodes:
        """Return the factor of S = D M^-1 D^T; masked rows get a reciprocal pivot of 0, small pivots a flag."""
        return self._schur

    @cached_property
    def _schur(self) -> FactorNodes:
        return self._masked_factor(self.mass_gram(self.rows))

    def _on_compliant(self, operation: FormulaStep, compliance: int) -> FactorNodes:
        """Return the factor of S + e: a term of a diagonal entry is a term of its pivot."""
        g = self.graph

        def reciprocal(row: int, pivot: int, _: int) -> int:
            return self._masked_reciprocal(self._held(row), g.add(pivot, g.add(compliance, self.mask[row])))

        return factorisation(g, self.mass_gram(self.rows), self.order, reciprocal)

    def _on_pseudoinverse(self, operation: FormulaStep, matrix: Rows) -> FactorNodes:
        return self._masked_factor(self.gram(matrix))

    def _masked_factor(self, matrix: Mapping[tuple[int, int], int]) -> FactorNodes:
        g = self.graph

        def reciprocal(row: int, pivot: int, diagonal: int) -> int:
            masked = g.add(pivot, self.mask[row])  # the mask is 0, or infinite for a row to be left out
            if pivot != diagonal:
                least = self.in_force(row, g.mul(g.constant(SUSPICIOUS), diagonal))
                self.flags.append(g.call("lt", masked, least))
            return self._masked_reciprocal(self._held(row), masked)

        return factorisation(g, matrix, self.order, reciprocal)

    def _held(self, row: int) -> int:
        """Return 1 where a row is in force, 0 where it is off."""
        held = self.equations.rows[row].held
        return self.graph.one if held is None else held

    def _off(self, row: int) -> int:
        """Return 0 where a row is in force, 1 where it is off."""
        return self.graph.sub(self.graph.one, self._held(row))

    def in_force(self, row: int, node: int) -> int:
        """Return a node of a row, 0 where the row is off."""
        return self.graph.mul(self._held(row), node)

    def _on_penalties(self, operation: FormulaStep, penalty: int) -> Nodes:
        return tuple(self.in_force(i, a) for i, a in enumerate(super()._on_penalties(operation, penalty)))

    def _on_flag(self, operation: FormulaStep) -> int | None:
        """Return the node that is true where a pivot of S was suspicious so far."""
        result = None
        for node in self.flags:
            result = node if result is None else self.graph.call("or", result, node)
        return result

    def _on_rank(self, operation: FormulaStep) -> FactorNodes:
        """Return the factor of D G D^T that decides rank: dependent rows get a reciprocal pivot of 0."""
        if not self.plan.schur and "whole" not in operation.payload:
            return self._rank_of_rest()

        def reciprocal(row: int, pivot: int, diagonal: int) -> int:
            return self._masked_reciprocal(self._decided(row, pivot, diagonal), pivot)

        return factorisation(self.graph, self.gram(self.rows, self.gauge), self.order, reciprocal)

    def _rank_of_rest(self) -> FactorNodes:
        """Return the same pivots behind fixed velocities, without L: they do not depend on the order before them."""
        pivots, reciprocals = dict[int, int](), dict[int, int]()
        diagonal = {row: self._square(row, entries) for row, entries in enumerate(self.rows)}
        linked = {j for row in self.plan.rows for j, _ in self.rows[row]}

        def reciprocal(row: int, pivot: int, first: int) -> int:
            alone = pivot == first and linked.isdisjoint(j for j, _ in self.rows[row])
            pivots[row] = diagonal[row] if alone else pivot
            keep = self._decided(row, pivots[row], diagonal[row])
            reciprocals[row] = self._masked_reciprocal(keep, pivots[row])
            return reciprocals[row]

        self._with_fixed(self._metric("scaled"), self.rows, self.plan.normal).eliminate_rest(reciprocal)
        order = (*sorted(self.plan.rows), *pivots)
        pivots |= {row: diagonal[row] for row in self.plan.rows}
        return FactorNodes(order, {}, reciprocals, pivots, diagonal)

    def _decided(self, row: int, pivot: int, diagonal: int) -> int:
        """Return 1 where the pivot of D G D^T keeps its row, else 0; a row eliminated alone is kept where it holds."""
        g = self.graph
        if self._certain(row, pivot, diagonal):
            return g.one
        # near a singular position rounding lifts the pivot of a masked row above SKIP: the mask keeps it out
        usual = self._usual(row, diagonal)
        kept = g.call("step", pivot, g.add(g.mul(g.constant(SKIP), usual), self.mask[row]))
        return self.in_force(row, kept)

    def _certain(self, row: int, pivot: int, diagonal: int) -> bool:
        """Whether a row is kept in every position: it fixes a velocity, or is eliminated alone and cannot vanish."""
        constraint = self.equations.rows[row]
        return row in self.plan.rows or (pivot == diagonal and constraint.size is None and constraint.held is None)

    def _usual(self, row: int, diagonal: int) -> int:
        """Return the scale of the pivot of a row in D G D^T: the row's square, or the pivot before."""
        g, constraint = self.graph, self.equations.rows[row]
        if constraint.size is None:
            return diagonal
        if constraint.unit not in ("rad", "rad/s"):
            return g.call("max", diagonal, constraint.size)
        turns = [next(iter(self.gauge[j].values())) for j, _ in constraint.entries]
        gauge = g.mul(g.constant(1.0 / max(1, len(turns))), g.total(turns))
        return g.call("max", diagonal, g.mul(constraint.size, gauge))

    def _masked_reciprocal(self, keep: int, pivot: int) -> int:
        """Return 1 / pivot where `keep` is 1, else 0."""
        g = self.graph
        return g.div(g.one, pivot) if keep == g.one else g.div(keep, g.call("max", pivot, g.constant(TINY)))

    def _weighted(self, matrix: Mapping[tuple[int, int], int], keep: Callable[[int], int]) -> FactorNodes:
        """Return the factor of D W D^T, of the rows with `keep` 1."""

        def reciprocal(row: int, pivot: int, _: int) -> int:
            return self._masked_reciprocal(keep(row), pivot)

        return factorisation(self.graph, matrix, self.order, reciprocal)

    def _weighted_beside(self, rank: FactorNodes, matrix: Mapping[tuple[int, int], int]) -> FactorNodes:
        """Return the same in the function that decides rank."""
        return self._weighted(matrix, lambda row: self._decided(row, rank.pivots[row], rank.diagonal[row]))

    def _weighted_apart(self, rank: FactorNodes, gram: Callable[[Rows], dict[tuple[int, int], int]]) -> FactorNodes:
        """Return the same from the values that ``geometry`` left in w."""
        g, stored = self.graph, self._keep_factor(rank, "lower", "reciprocal")

        def keep(row: int) -> int:
            certain = self._certain(row, rank.pivots[row], rank.diagonal[row])
            return g.one if certain else g.call("step", stored.reciprocal[row], g.zero)

        return self._weighted(gram(self.stored_constraints()), keep)

    def _on_weighted_mass(self, operation: FormulaStep, rank: FactorNodes) -> FactorNodes:
        """Return the factor of D M^-1 D^T without the rows that D D^T leaves out."""
        return self._weighted_apart(rank, self.mass_gram)

    def _on_weighted_identity(self, operation: FormulaStep, rank: FactorNodes) -> FactorNodes:
        return self._weighted_apart(rank, self.gram)

    def _on_weighted_dependent(self, operation: FormulaStep, rank: FactorNodes) -> FactorNodes:
        """Return the factor of D P D^T in the function that decides rank: every stage needs it, none reads it back."""
        dependent = self._on_gauged(operation, self.section("dependent", self.equations.nv))
        return self._weighted_beside(rank, self.gram(self.rows, [{j: node} for j, node in enumerate(dependent)]))

    def _on_partition_quality(self, operation: FormulaStep, rank: FactorNodes, factor: FactorNodes) -> int:
        """Return det(D P D^T) / det(D G D^T): squared cosines between tangent space and independent coordinates."""
        g, quality = self.graph, self.graph.one
        for i in factor.order:
            share = g.mul(rank.pivots[i], rank.reciprocal[i])  # 0 for rows that D D^T skips: they do not count
            ratio = g.mul(factor.pivots[i], rank.reciprocal[i])
            quality = g.mul(quality, g.add(ratio, g.sub(g.one, share)))
        return quality

    def _on_row_stiffness(self, operation: FormulaStep, otherwise: int) -> Nodes:
        return tuple(otherwise if row.stiffness is None else row.stiffness for row in self.equations.rows)

    def _on_augmented(self, operation: FormulaStep, penalties: Nodes) -> FactorNodes:
        return self._augmented(self.rows, penalties)

    def _on_augmented_metric(self, operation: FormulaStep, penalties: Nodes) -> FactorNodes:
        return self._augmented(self.stored_constraints(), penalties)

    def _augmented(self, constraints: Rows, penalties: Nodes) -> FactorNodes:
        """Return the factor of M + D^T a D."""
        g = self.graph
        matrix = dict(self.mass_matrix)
        for entries, penalty in zip(constraints, penalties, strict=True):
            for i, a in entries:
                scaled = g.mul(penalty, a)
                for j, b in entries:
                    if j >= i:
                        matrix[i, j] = g.add(matrix.get((i, j), g.zero), g.mul(scaled, b))
                        matrix[j, i] = matrix[i, j]
        return self.factorised(matrix)

    def _on_solve(self, operation: FormulaStep, factor: FactorNodes, right: Nodes) -> Nodes:
        return tuple(factor.solve(self.graph, right))

    def _on_geometry(self, operation: FormulaStep, rank: FactorNodes) -> Outputs:
        """Return Phi as the residual, its norm, nu, the variable entries of D, relative pivots, and their decisions.

        A relative pivot is the squared sine of the angle between a row and those eliminated before it.
        """
        g = self.graph
        outputs: Outputs = [(OutputSlot("residual", i), n) for i, n in enumerate(self.phi)]
        outputs += self.violation("position", self.phi)
        outputs += [(OutputSlot("nu", i), n) for i, n in enumerate(self.nu) if n != g.zero]
        entries = [node for row in self.rows for _, node in row]
        slots = ((e.slot, n) for e, n in zip(self.jacobian, entries, strict=True))
        outputs += [(OutputSlot("jacobian", slot), n) for slot, n in slots if slot is not None]
        count, smallest = g.zero, g.one
        for i in range(len(rank.order)):
            if self._certain(i, rank.pivots[i], rank.diagonal[i]):
                count = g.add(count, g.one)
                continue
            relative = g.div(rank.pivots[i], self._usual(i, rank.diagonal[i]))
            outputs.append((OutputSlot("pivot", i), self.in_force(i, relative)))
            count = g.add(count, self._decided(i, rank.pivots[i], rank.diagonal[i]))
            smallest = g.call("min", smallest, g.add(relative, g.add(self.mask[i], self._off(i))))
        shortest = g.one
        for i, row in enumerate(self.equations.rows):
            if row.size is not None:  # the row over the velocities of bodies, whatever loops make of it
                if row.unit == "rad" and g.value(row.size) is None:
                    shortest = g.call("min", shortest, g.add(row.size, self._off(i)))
            elif row.unit == "rad" and g.value(rank.diagonal[i]) is None:
                length = g.mul(rank.diagonal[i], g.input("row_weight", i))
                shortest = g.call("min", shortest, g.add(length, self._off(i)))
        outputs += [
            to_status("rank", count),
            to_status("smallest_pivot", smallest),
            to_status("shortest_row", shortest),
        ]
        return outputs

    def violation(self, level: str, residuals: Sequence[int]) -> Outputs:
        """Return the norm of Phi or of D v - nu, and the judged one: rows that are no lengths times the mechanism's."""
        g = self.graph
        length = g.input("status", STATUS.index("length_scale"))
        units = (row.unit for row in self.equations.rows)
        weighed = [g.mul(length, n) if u == "rad" else n for u, n in zip(units, residuals, strict=True)]
        norm, measure = (g.call("sqrt", g.dot(x, x)) for x in (residuals, weighed))
        return [to_status(f"{level}_violation", norm), to_status(f"{level}_measure", measure)]
