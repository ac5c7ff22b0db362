"""Rows of one mechanism's constraints: factors of D W D^T, and the decision on rank."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property

from symgen.base.ir.numerics import SKIP, SUSPICIOUS, TINY
from symgen.base.ir.polynomial import NormalForms
from symgen.base.ir.program import STATUS, EliminationPlan, OutputSlot
from symgen.derive.formulate.equations import Equations
from symgen.derive.lower.factor import FactorNodes, factorise_symmetric, minimum_degree
from symgen.derive.lower.replay import Nodes
from symgen.derive.lower.saddle_matrix import SaddleMatrix
from symgen.derive.lower.scalar_mass import OfMass
from symgen.derive.lower.scalar_values import Outputs, Rows, to_status
from symgen.derive.methods._tape import FormulaStep


class OfRows(OfMass):
    """Operations with factors of rows: which rows count, and which of their pivots are suspicious."""

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

    def _on_weighted_body(self, operation: FormulaStep, rank: FactorNodes) -> FactorNodes:
        """Return the factor of D W^-1 D^T in the function that decides rank."""
        return self._weighted_factor_at_decision(rank, self.body.mass_gram(self.rows))

    @cached_property
    def order(self) -> tuple[int, ...]:
        """Elimination order of the rows; one for S and D D^T, whose pattern is contained in S's."""
        return minimum_degree(self.neighbours(self.rows, self.coupled), self.plan.rows)[0]

    def _on_schur(self, operation: FormulaStep) -> FactorNodes:
        """Return the factor of S = D M^-1 D^T; masked rows get a reciprocal pivot of 0, small pivots a flag."""
        return self._schur_factor

    @cached_property
    def _schur_factor(self) -> FactorNodes:
        return self._masked_factor(self.mass_gram(self.rows))

    def _on_compliant(self, operation: FormulaStep, compliance: Nodes) -> FactorNodes:
        """Return the factor of S + e: a term of a diagonal entry is a term of its pivot."""
        g = self.graph

        def reciprocal(row: int, pivot: int, _: int) -> int:
            return self._masked_reciprocal(self._is_held(row), g.add(pivot, g.add(compliance[row], self.mask[row])))

        return factorise_symmetric(g, self.mass_gram(self.rows), self.order, reciprocal)

    def _on_pseudoinverse(self, operation: FormulaStep, matrix: Rows) -> FactorNodes:
        return self._masked_factor(self.gram(matrix))

    def _masked_factor(self, matrix: Mapping[tuple[int, int], int]) -> FactorNodes:
        g = self.graph

        def reciprocal(row: int, pivot: int, diagonal: int) -> int:
            masked = g.add(pivot, self.mask[row])  # the mask is 0, or infinite for a row to be left out
            if pivot != diagonal:
                least = self.node_in_force(row, g.mul(g.constant(SUSPICIOUS), diagonal))
                self.flags.append(g.call("lt", masked, least))
            return self._masked_reciprocal(self._is_held(row), masked)

        return factorise_symmetric(g, matrix, self.order, reciprocal)

    def _is_held(self, row: int) -> int:
        """Return 1 where a row is in force, 0 where it is off."""
        held = self.equations.rows[row].held
        return self.graph.one if held is None else held

    def _is_off(self, row: int) -> int:
        """Return 0 where a row is in force, 1 where it is off."""
        return self.graph.sub(self.graph.one, self._is_held(row))

    def node_in_force(self, row: int, node: int) -> int:
        """Return a node of a row, 0 where the row is off."""
        return self.graph.mul(self._is_held(row), node)

    def _on_penalties(self, operation: FormulaStep, penalty: int) -> Nodes:
        return tuple(self.node_in_force(i, a) for i, a in enumerate(super()._on_penalties(operation, penalty)))

    def _on_flag(self, operation: FormulaStep) -> int | None:
        """Return the node that is true where a pivot of S was suspicious so far."""
        result = None
        for node in self.flags:
            result = node if result is None else self.graph.call("or", result, node)
        return result

    def _on_rank(self, operation: FormulaStep) -> FactorNodes:
        """Return the factor of D G D^T that decides rank: dependent rows get a reciprocal pivot of 0."""
        if not self.plan.schur and "whole" not in operation.payload:
            return self._pivots_after_fixed()

        def reciprocal(row: int, pivot: int, diagonal: int) -> int:
            return self._masked_reciprocal(self._is_kept(row, pivot, diagonal), pivot)

        return factorise_symmetric(self.graph, self.gram(self.rows, self.gauge), self.order, reciprocal)

    def _pivots_after_fixed(self) -> FactorNodes:
        """Return the same pivots after fixed velocities, without L: they do not depend on the order before them."""
        pivots, reciprocals = dict[int, int](), dict[int, int]()
        diagonal = {row: self._square_of_row(row, entries) for row, entries in enumerate(self.rows)}
        linked = {j for row in self.plan.rows for j, _ in self.rows[row]}

        def reciprocal(row: int, pivot: int, first: int) -> int:
            alone = pivot == first and linked.isdisjoint(j for j, _ in self.rows[row])
            pivots[row] = diagonal[row] if alone else pivot
            keep = self._is_kept(row, pivots[row], diagonal[row])
            reciprocals[row] = self._masked_reciprocal(keep, pivots[row])
            return reciprocals[row]

        self._eliminate_fixed(self._metric_rows("scaled"), self.rows, self.plan.normal).eliminate_rest(reciprocal)
        order = (*sorted(self.plan.rows), *pivots)
        pivots |= {row: diagonal[row] for row in self.plan.rows}
        return FactorNodes(order, {}, reciprocals, pivots, diagonal)

    def _is_kept(self, row: int, pivot: int, diagonal: int) -> int:
        """Return 1 where the pivot of D G D^T keeps its row, else 0; a row eliminated alone is kept where it holds."""
        g = self.graph
        if self._is_always_kept(row, pivot, diagonal):
            return g.one
        # near a singular position rounding lifts the pivot of a masked row above SKIP: the mask keeps it out
        usual = self._scale_of_pivot(row, diagonal)
        kept = g.call("step", pivot, g.add(g.mul(g.constant(SKIP), usual), self.mask[row]))
        return self.node_in_force(row, kept)

    def _is_always_kept(self, row: int, pivot: int, diagonal: int) -> bool:
        """Whether a row is kept in every position: it fixes a velocity, or is eliminated alone and cannot vanish."""
        constraint = self.equations.rows[row]
        return row in self.plan.rows or (pivot == diagonal and constraint.size is None and constraint.held is None)

    def _scale_of_pivot(self, row: int, diagonal: int) -> int:
        """Return the scale of the pivot of a row in D G D^T: the row's square, or the pivot before."""
        g, constraint = self.graph, self.equations.rows[row]
        if constraint.size is None:
            return diagonal
        if constraint.unit not in ("rad", "rad/s"):
            return g.call("max", diagonal, constraint.size)
        turns = [next(iter(self.gauge[j].values())) for j, _ in constraint.entries]
        gauge = g.mul(g.constant(1.0 / max(1, len(turns))), g.sum_of(turns))
        return g.call("max", diagonal, g.mul(constraint.size, gauge))

    def _masked_reciprocal(self, keep: int, pivot: int) -> int:
        """Return 1 / pivot where `keep` is 1, else 0."""
        g = self.graph
        return g.div(g.one, pivot) if keep == g.one else g.div(keep, g.call("max", pivot, g.constant(TINY)))

    def _weighted_factor(self, matrix: Mapping[tuple[int, int], int], keep: Callable[[int], int]) -> FactorNodes:
        """Return the factor of D W D^T, of the rows with `keep` 1."""

        def reciprocal(row: int, pivot: int, _: int) -> int:
            return self._masked_reciprocal(keep(row), pivot)

        return factorise_symmetric(self.graph, matrix, self.order, reciprocal)

    def _weighted_factor_at_decision(self, rank: FactorNodes, matrix: Mapping[tuple[int, int], int]) -> FactorNodes:
        """Return the same in the function that decides rank."""
        return self._weighted_factor(matrix, lambda row: self._is_kept(row, rank.pivots[row], rank.diagonal[row]))

    def _weighted_factor_from_stored(
        self, rank: FactorNodes, gram: Callable[[Rows], dict[tuple[int, int], int]]
    ) -> FactorNodes:
        """Return the same from the values that ``geometry`` left in w."""
        g, stored = self.graph, self._keep_factor(rank, "lower", "reciprocal")

        def keep(row: int) -> int:
            certain = self._is_always_kept(row, rank.pivots[row], rank.diagonal[row])
            return g.one if certain else g.call("step", stored.reciprocal[row], g.zero)

        return self._weighted_factor(gram(self.stored_constraints()), keep)

    def _on_weighted_mass(self, operation: FormulaStep, rank: FactorNodes) -> FactorNodes:
        """Return the factor of D M^-1 D^T without the rows that D D^T leaves out."""
        return self._weighted_factor_from_stored(rank, self.mass_gram)

    def _on_weighted_identity(self, operation: FormulaStep, rank: FactorNodes) -> FactorNodes:
        return self._weighted_factor_from_stored(rank, self.gram)

    def _on_weighted_dependent(self, operation: FormulaStep, rank: FactorNodes) -> FactorNodes:
        """Return the factor of D P D^T in the function that decides rank: every stage needs it, none reads it back."""
        dependent = self._on_gauged(operation, self.section("dependent", self.equations.nv))
        return self._weighted_factor_at_decision(
            rank, self.gram(self.rows, [{j: node} for j, node in enumerate(dependent)])
        )

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
        return self._augmented_factor(self.rows, penalties)

    def _on_augmented_metric(self, operation: FormulaStep, penalties: Nodes) -> FactorNodes:
        return self._augmented_factor(self.stored_constraints(), penalties)

    def _augmented_factor(self, constraints: Rows, penalties: Nodes) -> FactorNodes:
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
        return self.factorise_matrix(matrix)

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
            if self._is_always_kept(i, rank.pivots[i], rank.diagonal[i]):
                count = g.add(count, g.one)
                continue
            relative = g.div(rank.pivots[i], self._scale_of_pivot(i, rank.diagonal[i]))
            outputs.append((OutputSlot("pivot", i), self.node_in_force(i, relative)))
            count = g.add(count, self._is_kept(i, rank.pivots[i], rank.diagonal[i]))
            smallest = g.call("min", smallest, g.add(relative, g.add(self.mask[i], self._is_off(i))))
        shortest = g.one
        for i, row in enumerate(self.equations.rows):
            if row.size is not None:  # the row over the velocities of bodies, whatever loops make of it
                if row.unit == "rad" and g.value(row.size) is None:
                    shortest = g.call("min", shortest, g.add(row.size, self._is_off(i)))
            elif row.unit == "rad" and g.value(rank.diagonal[i]) is None:
                length = g.mul(rank.diagonal[i], g.input("row_weight", i))
                shortest = g.call("min", shortest, g.add(length, self._is_off(i)))
        outputs += [
            to_status("rank", count),
            to_status("smallest_pivot", smallest),
            to_status("shortest_row", shortest),
        ]
        return outputs

    def velocity_residuals(self) -> list[int]:
        """Return D v - nu of the rows in force, with the D and nu that ``geometry`` stores."""
        g, residuals = self.graph, list[int]()
        for i, row in enumerate(self.stored_constraints()):
            total = g.sum_of(g.mul(e, g.input("v", j)) for j, e in row)
            if self.equations.rows[i].nu != g.zero:
                total = g.sub(total, g.input("nu", i))
            residuals.append(self.node_in_force(i, total))
        return residuals

    def violation(self, level: str, residuals: Sequence[int]) -> Outputs:
        """Return the norm of Phi or of D v - nu, and the judged one: rows that are no lengths times the mechanism's."""
        g = self.graph
        length = g.input("status", STATUS.index("length_scale"))
        units = (row.unit for row in self.equations.rows)
        weighed = [g.mul(length, n) if u == "rad" else n for u, n in zip(units, residuals, strict=True)]
        norm, measure = (g.call("sqrt", g.dot(x, x)) for x in (residuals, weighed))
        return [to_status(f"{level}_violation", norm), to_status(f"{level}_measure", measure)]

    def _metric_rows(self, name: str) -> Mapping[tuple[int, int], int]:
        if name == "mass":
            return self.mass_matrix
        g = self.graph
        scales = (next(iter(x.values())) if name == "scaled" else g.one for x in self.gauge)
        return {(j, j): g.div(g.one, node) for j, node in enumerate(scales)}

    def _eliminate_fixed(self, mass: Mapping[tuple[int, int], int], rows: Rows, normal: bool = False) -> SaddleMatrix:
        """Return a matrix from which fixed velocities have been eliminated with their rows."""
        simpler = NormalForms(self.graph).simpler if normal else None
        matrix = SaddleMatrix(self.graph, self.equations.nv, mass, rows, simpler)
        for block in self.plan.fixed:
            matrix.eliminate_fixed(block)
        return matrix

    def _square_of_row(self, row: int, entries: Iterable[tuple[int, int]]) -> int:
        """Return the square of a row of the scale that decides rank."""
        g = self.graph
        return g.sum_of(g.mul(g.mul(n, next(iter(self.gauge[j].values()))), n) for j, n in entries)
