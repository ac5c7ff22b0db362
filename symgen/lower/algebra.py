"""The equations as a method sees them: named blocks, products and solves. Method formulas are written against it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from symgen.formulate.equations import Equations
from symgen.ir.derivative import jacobian
from symgen.ir.program import STATUS, Target
from symgen.lower.factor import Factor, factorise, minimum_degree
from symgen.lower.vectors import Scalar, Sparse, Vector

#: A pivot of S below this fraction of its diagonal entry is suspicious: rank is then decided on D D^T (design.md, 1).
SUSPICIOUS = 1e-6
#: A pivot of D D^T (rows scaled) below this belongs to a row that depends on the others: the row is skipped.
SKIP = 1e-12
#: A pivot of D D^T (rows scaled) below this is near a singular position and is reported.
WARN = 1e-4


@dataclass
class System:
    """The equations as a method sees them: named blocks and the operations a formula may use.

    Attributes
    ----------
    mask : list of int
        Nodes added to the pivots of S: 0, or infinite in rows that the runtime leaves out.
    D : Sparse
    f, gamma, nu, phi, v : Vector
        As in the notation; `phi` is zero in nonholonomic rows.
    """

    equations: Equations
    parameter_names: Sequence[str] = ()
    parameter_offset: int = 0

    def __post_init__(self) -> None:
        e = self.equations
        g = self.graph = e.graph.copy()
        self._parameters = {n: g.input("p", self.parameter_offset + i) for i, n in enumerate(self.parameter_names)}
        self.mask = [g.input("mask", i) for i in range(e.m)]
        self.D = Sparse(g, tuple(row.entries for row in e.rows), e.nv)
        self.f = Vector(g, e.forces)
        self.gamma = Vector(g, tuple(r.gamma for r in e.rows))
        self.nu = Vector(g, tuple(r.nu for r in e.rows))
        self.phi = Vector(g, tuple(g.zero if r.phi is None else r.phi for r in e.rows))
        self.q_rates = Vector(g, e.q_rates)
        self.v = Vector(g, tuple(g.input("v", i) for i in range(e.nv)))
        self.flags: list[int] = []
        self.kept: list[tuple[Target, int]] = []
        self.kept_sections: dict[str, int] = {}

    def parameter(self, name: str) -> Scalar:
        """Return a parameter of the method."""
        return Scalar(self.graph, self._parameters[name])

    # -- mass matrix -------------------------------------------------------------------------------------------------

    @cached_property
    def inverse_mass(self) -> list[dict[int, int]]:
        """Rows of M^-1 as column -> node; blocks are inverted by elimination, single entries by their reciprocal."""
        g = self.graph
        result: list[dict[int, int]] = [{} for _ in range(self.equations.nv)]
        for block in self.equations.mass:
            n = len(block.columns)
            matrix = {
                (i, j): block.entries[i][j]
                for i in range(n)
                for j in range(n)
                if block.entries[i][j] != g.zero or i == j
            }
            factor = factorise(g, matrix, range(n), lambda _, pivot, __: g.div(g.one, pivot))
            for j in range(n):
                unit = [g.one if i == j else g.zero for i in range(n)]
                for i, node in enumerate(factor.solve(g, unit)):
                    if node != g.zero:
                        result[block.columns[i]][block.columns[j]] = node
        return result

    def minv(self, x: Vector) -> Vector:
        """Return M^-1 x."""
        g = self.graph
        result = [g.zero] * len(x.nodes)
        for block in self.equations.mass:
            if len(block.columns) == 1:
                j = block.columns[0]
                # two literals are divided while code is generated, so that a weight over its mass is g to the last
                # digit
                literal = g.value(x.nodes[j]) is not None and g.value(block.entries[0][0]) is not None
                mass = block.entries[0][0]
                result[j] = g.div(x.nodes[j], mass) if literal else g.mul(self.inverse_mass[j][j], x.nodes[j])
                continue
            for i in block.columns:
                row = sorted(self.inverse_mass[i].items())
                result[i] = g.total(g.mul(e, x.nodes[j]) for j, e in row)
        return Vector(g, tuple(result))

    @property
    def regular(self) -> bool:
        """Whether no mass is a literal 0."""
        return all(self.graph.value(b.entries[i][i]) != 0.0 for b in self.equations.mass for i in range(len(b.columns)))

    @property
    def free_acceleration(self) -> Vector:
        """Return M^-1 f, or 0 where M is singular: the start of iterations."""
        return self.minv(self.f) if self.regular else self.zeros(self.equations.nv)

    @property
    def heavy_penalty(self) -> Scalar:
        """Return 1e5 times the mean of M's diagonal: few iterations, and few digits lost."""
        g = self.graph
        diagonal = [b.entries[i][i] for b in self.equations.mass for i in range(len(b.columns))]
        return Scalar(g, g.mul(g.constant(1e5 / max(1, len(diagonal))), g.total(diagonal)))

    @cached_property
    def inverse_mass_root(self) -> Sparse:
        """Return L^-T with M = L L^T: the inverse root of M, diagonal where M is; by rows of the transposed, L^-1.

        Any root serves a least-squares solution in the metric of M; Cholesky's is the cheapest.
        """
        g = self.graph
        rows: list[tuple[tuple[int, int], ...]] = [()] * self.equations.nv
        for block in self.equations.mass:
            n = len(block.columns)
            lower: dict[tuple[int, int], int] = {}
            inverse: dict[tuple[int, int], int] = {}
            for i in range(n):
                for j in range(i + 1):
                    rest = g.sub(block.entries[i][j], g.total(g.mul(lower[i, k], lower[j, k]) for k in range(j)))
                    lower[i, j] = g.call("sqrt", rest) if i == j else g.div(rest, lower[j, j])
            for i in range(n):
                inverse[i, i] = g.div(g.one, lower[i, i])
                for j in range(i):
                    rest = g.total(g.mul(lower[i, k], inverse[k, j]) for k in range(j, i))
                    inverse[i, j] = g.neg(g.mul(rest, inverse[i, i]))
                entries = ((block.columns[j], inverse[i, j]) for j in range(i + 1))
                rows[block.columns[i]] = tuple((j, node) for j, node in entries if node != g.zero)
        return Sparse(g, tuple(rows), self.equations.nv)

    def inverse(self, x: Scalar) -> Scalar:
        """Return 1 / x."""
        return Scalar(self.graph, self.graph.div(self.graph.one, x.node))

    @property
    def inverse_step(self) -> Scalar:
        """Return one over the step that is being taken."""
        return self.inverse(Scalar(self.graph, self.graph.input("status", STATUS.index("step"))))

    # -- D W D^T -----------------------------------------------------------------------------------------------------

    @cached_property
    def order(self) -> tuple[int, ...]:
        """Elimination order of the rows; one for S and D D^T, whose pattern is contained in S's."""
        return minimum_degree(self.D.neighbours([frozenset(r) for r in self.inverse_mass]))

    def gram(self, weight: Sequence[Mapping[int, int]] | None) -> dict[tuple[int, int], int]:
        """Return D W D^T as nodes; `weight` None is the identity, else rows of W."""
        g = self.graph
        left: list[dict[int, int]] = []
        for row in self.D.rows:
            if weight is None:
                left.append(dict(row))
                continue
            weighted: dict[int, int] = {}
            for j, e in row:
                for k, node in weight[j].items():
                    weighted[k] = g.add(weighted.get(k, g.zero), g.mul(e, node))
            left.append(weighted)
        result: dict[tuple[int, int], int] = {}
        for i, near in enumerate(self.D.neighbours([frozenset(r) for r in weight] if weight is not None else None)):
            for j in (i, *(n for n in sorted(near) if n > i)):
                node = g.total(g.mul(left[i][k], e) for k, e in self.D.rows[j] if k in left[i])
                if node != g.zero or i == j:
                    result[i, j] = result[j, i] = node
        return result

    @cached_property
    def schur(self) -> Factor:
        """Factor of S = D M^-1 D^T; rows masked by the runtime get a reciprocal pivot of 0, small pivots a flag."""
        return self._masked_factor(self.gram(self.inverse_mass))

    def pseudoinverse_factor(self, matrix: Sparse) -> Factor:
        """Return the factor of B B^T for a scaled constraint matrix B, with masks and flags as for `schur`."""
        other = System.__new__(System)
        other.__dict__.update(self.__dict__, D=matrix)
        return self._masked_factor(other.gram(None))

    def _masked_factor(self, matrix: Mapping[tuple[int, int], int]) -> Factor:
        g = self.graph

        def reciprocal(row: int, pivot: int, diagonal: int) -> int:
            masked = g.add(pivot, self.mask[row])  # the mask is 0, or infinite for a row to be left out
            if pivot != diagonal:
                self.flags.append(g.call("lt", masked, g.mul(g.constant(SUSPICIOUS), diagonal)))
            return g.div(g.one, masked)

        return factorise(g, matrix, self.order, reciprocal)

    def solve_schur(self, right: Vector) -> Vector:
        """Return lambda with S lambda = right."""
        return Vector(self.graph, tuple(self.schur.solve(self.graph, right.nodes)))

    def gram_factor(self, weight: Sequence[Mapping[int, int]] | None = None) -> Factor:
        """Return the factor of D W D^T that decides rank: dependent rows get a reciprocal pivot of 0."""
        g = self.graph

        def reciprocal(row: int, pivot: int, diagonal: int) -> int:
            if pivot == diagonal:
                return g.div(g.one, pivot)
            # near a singular position rounding lifts the pivot of a masked row above SKIP: the mask keeps it out
            keep = g.call("step", pivot, g.add(g.mul(g.constant(SKIP), diagonal), self.mask[row]))
            return g.div(keep, g.add(pivot, g.sub(g.one, keep)))

        return factorise(g, self.gram(weight), self.order, reciprocal)

    def factor_with(self, rank: Factor, matrix: Mapping[tuple[int, int], int]) -> Factor:
        """Return the factor of D W D^T without the rows that `rank`, the factor of D D^T, finds dependent."""
        g = self.graph

        def reciprocal(row: int, pivot: int, _: int) -> int:
            if rank.pivots[row] == rank.diagonal[row]:
                return g.div(g.one, pivot)
            least = g.add(g.mul(g.constant(SKIP), rank.diagonal[row]), self.mask[row])
            keep = g.call("step", rank.pivots[row], least)
            return g.div(keep, g.add(pivot, g.sub(g.one, keep)))

        return factorise(g, matrix, self.order, reciprocal)

    # -- M + a D^T D -------------------------------------------------------------------------------------------------

    def mass(self, x: Vector) -> Vector:
        """Return M x."""
        g = self.graph
        result = [g.zero] * len(x.nodes)
        for block in self.equations.mass:
            for i, row in zip(block.columns, block.entries, strict=True):
                result[i] = g.total(g.mul(e, x.nodes[j]) for j, e in zip(block.columns, row, strict=True))
        return Vector(g, tuple(result))

    def penalties(self, penalty: Scalar) -> Vector:
        """Return the penalty of each row, 0 for rows that the runtime leaves out.

        A row that depends on others where the constraints hold does so no more at the stages of a step, where they hold
        to the integrator's error only: a penalty on what it adds there would pull at the motion itself.
        """
        g = self.graph
        return Vector(g, tuple(g.mul(penalty.node, g.call("step", g.one, mask)) for mask in self.mask))

    def augmented_factor(self, penalties: Vector) -> Factor:
        """Return the factor of ``M + D^T a D``, a by rows, which is positive definite whatever the rank of D."""
        g = self.graph
        matrix: dict[tuple[int, int], int] = {}
        for block in self.equations.mass:
            for i, row in zip(block.columns, block.entries, strict=True):
                for j, node in zip(block.columns, row, strict=True):
                    if node != g.zero or i == j:
                        matrix[i, j] = node
        for entries, penalty in zip(self.D.rows, penalties, strict=True):
            for i, a in entries:
                scaled = g.mul(penalty, a)
                for j, b in entries:
                    if j >= i:
                        matrix[i, j] = g.add(matrix.get((i, j), g.zero), g.mul(scaled, b))
                        matrix[j, i] = matrix[i, j]
        near: list[set[int]] = [set() for _ in range(self.equations.nv)]
        for i, j in matrix:
            if i != j:
                near[i].add(j)
        order = minimum_degree([frozenset(n) for n in near])
        return factorise(g, matrix, order, lambda _, pivot, __: g.div(g.one, pivot))

    def solve(self, factor: Factor, right: Vector) -> Vector:
        """Return the solution for a right-hand side."""
        return Vector(self.graph, tuple(factor.solve(self.graph, right.nodes)))

    # -- what an iterated law keeps in w between its blocks ------------------------------------------------------------

    def keep(self, section: str, x: Vector) -> Vector:
        """Store a vector in a section once per evaluation; return it as the iteration reads it, literals folded."""
        g, loaded = self.graph, list[int]()
        first = self.kept_sections.get(section, 0)
        slot = first
        for node in x:
            if g.value(node) is not None:
                loaded.append(node)
                continue
            self.kept.append((Target(section, slot), node))
            loaded.append(g.input(section, slot))
            slot += 1
        self.kept_sections[section] = slot
        return Vector(g, tuple(loaded))

    def keep_constraints(self) -> Sparse:
        """Store the variable entries of D; return D as the iteration reads it."""
        flat = self.keep("kept_jacobian", Vector(self.graph, tuple(e for row in self.D.rows for _, e in row)))
        nodes = iter(flat)
        rows = tuple(tuple((j, next(nodes)) for j, _ in row) for row in self.D.rows)
        return Sparse(self.graph, rows, self.equations.nv)

    def keep_factor(self, factor: Factor) -> Factor:
        """Store a factor; return it as the iteration reads it."""
        g = self.graph
        flat = [n for k in factor.order for _, n in factor.lower[k]] + [factor.reciprocal[k] for k in factor.order]
        nodes = iter(self.keep("kept_factor", Vector(g, tuple(flat))))
        lower = {k: tuple((i, next(nodes)) for i, _ in factor.lower[k]) for k in factor.order}
        reciprocal = {k: next(nodes) for k in factor.order}
        return Factor(factor.order, lower, reciprocal, factor.pivots, factor.diagonal)

    def variable(self, section: str, size: int) -> Vector:
        """Return a vector that the iteration changes, as it reads it."""
        return Vector(self.graph, tuple(self.graph.input(section, i) for i in range(size)))

    def at_velocity(self, x: Vector, v: Vector) -> Vector:
        """Return a vector with the velocities replaced by `v`."""
        inputs = {("v", i): n for i, n in enumerate(v)}
        return Vector(self.graph, tuple(self.graph.replaced(x.nodes, inputs)))

    def constraint_rate_transposed(self, y: Vector, v: Vector) -> Vector:
        """Return (dD/dt)^T y along the motion with velocities `v`."""
        g, e = self.graph, self.equations
        flat = [n for row in self.D.rows for _, n in row]
        rates = self.at_velocity(Vector(g, e.q_rates), v)
        keys = [("t", 0), *(("q", i) for i in range(e.nq))]
        derivatives = iter(jacobian(g, flat, keys))
        result = [g.zero] * e.nv
        for row, factor in zip(self.D.rows, y, strict=True):
            for j, _ in row:
                rate = g.total(
                    node if space == "t" else g.mul(node, rates.nodes[i])
                    for (space, i), node in sorted(next(derivatives).items())
                )
                result[j] = g.add(result[j], g.mul(rate, factor))
        return Vector(g, tuple(result))

    def zeros(self, size: int) -> Vector:
        """Return the zero vector."""
        return Vector(self.graph, (self.graph.zero,) * size)

    def flag(self) -> int | None:
        """Return the node that is true where a pivot of S was suspicious."""
        g, result = self.graph, None
        for node in self.flags:
            result = node if result is None else g.call("or", result, node)
        return result
