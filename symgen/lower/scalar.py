"""Formulas on the equations of one mechanism, element by element: every number is a node of a graph."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from copy import copy
from dataclasses import replace
from functools import cached_property
from typing import Any

from symgen.formulate.equations import Equations, MassBlock
from symgen.ir.derivative import jacobian
from symgen.ir.graph import PARAMETER, Graph
from symgen.ir.numerics import SKIP, SUSPICIOUS, TINY
from symgen.ir.program import STATUS, Entry, Target
from symgen.lower.factor import Factor, factorise, minimum_degree
from symgen.lower.replay import Nodes, Replay
from symgen.methods._formula import Operation

Outputs = list[tuple[Target, int]]
#: A sparse matrix: for each row its (column, node) entries in increasing order of column.
Rows = tuple[tuple[tuple[int, int], ...], ...]
#: Rows of a matrix W of weights: for each its nodes by column.
Weight = Sequence[Mapping[int, int]]


class Scalars(Replay):
    """The operations of formulas on nodes of a mechanism's graph.

    Parameters
    ----------
    equations : Equations
        The derived equations; their graph is copied.
    operations : tuple of Operation
        The tape.
    parameters : sequence of str
        Parameters of the method.
    places : mapping of str to (str, int)
        Space and first index of sections that are parts of other arrays.
    """

    def __init__(
        self,
        equations: Equations,
        operations: tuple[Operation, ...] = (),
        parameters: Sequence[str] = (),
        places: Mapping[str, tuple[str, int]] | None = None,
    ) -> None:
        super().__init__(equations.graph.copy(), operations)
        e, g = equations, self.graph
        k = e.nq + e.nv
        self.places = {"rates.q": ("ydot", 0), "rates.v": ("ydot", e.nq), "rates.work": ("ydot", k)} | {
            **{"k_q": ("k", 0), "k_v": ("k", e.nq), "k_first": ("k", k), "k_second": ("k", k + e.m)}
        }
        self.equations, self.places = equations, self.places if places is None else dict(places)
        self.parameters = {name: g.input("parameter", i) for i, name in enumerate(parameters)}
        self.mask = tuple(g.input("mask", i) for i in range(e.m))
        self.rows: Rows = tuple(row.entries for row in e.rows)
        self.phi = tuple(g.zero if r.phi is None else r.phi for r in e.rows)
        self.nu = tuple(r.nu for r in e.rows)
        self.v = tuple(g.input("v", i) for i in range(e.nv))
        self.flags: list[int] = []
        self.kept: dict[str, Outputs] = {}

    def following(self, operations: tuple[Operation, ...]) -> Scalars:
        """Return the same for another tape, in the same graph."""
        other = copy(self)
        other.operations, other.values = operations, {}
        return other

    def size(self, name: str) -> int:
        """Return the length that ``nq``, ``nv`` or ``m`` stands for."""
        return {"nq": self.equations.nq, "nv": self.equations.nv, "m": self.equations.m}[name]

    def section(self, name: str, size: int) -> Nodes:
        """Return a section of ``w``, or of what stands for it, as inputs."""
        space, first = self.places.get(name, (name, 0))
        return tuple(self.graph.input(space, first + i) for i in range(size))

    # -- named values --------------------------------------------------------------------------------------------------

    def _on_quantity(self, operation: Operation) -> Nodes:
        e = self.equations
        name = str(operation.payload[0])
        gamma = tuple(r.gamma for r in e.rows)
        known = {"f": e.forces, "q_rates": e.q_rates, "phi": self.phi, "nu": self.nu, "v": self.v, "gamma": gamma}
        return known[name]

    def _on_section(self, operation: Operation) -> Nodes:
        return self.section(str(operation.payload[0]), self.size(operation.size))

    def _on_parameter(self, operation: Operation) -> int:
        return self.parameters[str(operation.payload[0])]

    def _on_status(self, operation: Operation) -> int:
        return self.graph.input("status", STATUS.index(str(operation.payload[0])))

    def _on_power(self, operation: Operation) -> int:
        return self.equations.power

    def _on_driving(self, operation: Operation, accelerations: Nodes) -> int:
        g, driving = self.graph, self.equations.driving
        assert driving is not None, "drivers prescribe coordinates"
        return g.add(g.total(g.mul(node, accelerations[j]) for j, node in driving.entries), driving.rest)

    def _on_zeros(self, operation: Operation) -> Nodes:
        return (self.graph.zero,) * self.size(operation.size)

    def _on_holonomic_or(self, operation: Operation, otherwise: Nodes) -> Nodes:
        rows = zip(self.equations.rows, otherwise, strict=True)
        return tuple(node if row.phi is None else row.phi for row, node in rows)

    def _on_dot(self, operation: Operation, a: Nodes, b: Nodes) -> int:
        return self.graph.dot(a, b)

    # -- D -------------------------------------------------------------------------------------------------------------

    def _on_constraints(self, operation: Operation) -> Rows:
        return self.rows

    def product(self, matrix: Rows, x: Nodes) -> Nodes:
        """Return a matrix times a vector."""
        g = self.graph
        return tuple(g.total(g.mul(e, x[j]) for j, e in row) for row in matrix)

    def _on_product(self, operation: Operation, matrix: Rows, x: Nodes) -> Nodes:
        solved = self.operations[operation.operands[1]]
        if self.mass_entries and matrix is self.rows and solved.kind == "minv":  # D M^-1 u from what S is made of
            half = self._half(solved.operands[0])
            return tuple(self.graph.dot(scaled, half) for scaled in self._halves(self.rows)[1])
        return self.product(matrix, x)

    def _on_transposed(self, operation: Operation, matrix: Rows, y: Nodes) -> Nodes:
        g = self.graph
        result = [g.zero] * self.equations.nv
        for row, factor in zip(matrix, y, strict=True):
            for j, e in row:
                result[j] = g.add(result[j], g.mul(e, factor))
        return tuple(result)

    def _on_times_transposed(self, operation: Operation, matrix: Rows, other: Rows) -> Rows:
        g, rows = self.graph, []
        for row in matrix:
            own = dict(row)
            entries = ((k, g.total(g.mul(own[j], e) for j, e in right if j in own)) for k, right in enumerate(other))
            rows.append(tuple((k, node) for k, node in entries if node != g.zero))
        return tuple(rows)

    @cached_property
    def jacobian(self) -> tuple[Entry, ...]:
        """The structural entries of D; variable ones get a slot in the section ``jacobian``."""
        entries: list[Entry] = []
        slot = 0
        for i, row in enumerate(self.rows):
            for j, node in row:
                constant = self.graph.value(node)
                entries.append(Entry(i, j, constant, None if constant is not None else slot))
                slot += constant is None
        return tuple(entries)

    def stored_constraints(self) -> Rows:
        """Return D as ``geometry`` left it."""
        g = self.graph
        rows: list[list[tuple[int, int]]] = [[] for _ in range(self.equations.m)]
        for e in self.jacobian:
            node = g.constant(e.constant) if e.constant is not None else g.input("jacobian", e.slot or 0)
            rows[e.row].append((e.column, node))
        return tuple(map(tuple, rows))

    def _on_stored_constraints(self, operation: Operation) -> Rows:
        return self.stored_constraints()

    def _on_constraint_rate_transposed(self, operation: Operation, y: Nodes, v: Nodes) -> Nodes:
        g, e = self.graph, self.equations
        flat = [n for row in self.rows for _, n in row]
        rates = self._on_at_velocity(operation, e.q_rates, v)
        derivatives = iter(jacobian(g, flat, [("t", 0), *(("q", i) for i in range(e.nq))]))
        result = [g.zero] * e.nv
        for row, factor in zip(self.rows, y, strict=True):
            for j, _ in row:
                rate = g.total(
                    node if space == "t" else g.mul(node, rates[i])
                    for (space, i), node in sorted(next(derivatives).items())
                )
                result[j] = g.add(result[j], g.mul(rate, factor))
        return tuple(result)

    def _on_mass_rate(self, operation: Operation, x: Nodes, v: Nodes) -> Nodes:
        g, e = self.graph, self.equations
        result = [g.zero] * e.nv
        if self.mass_entries:
            rates = self._on_at_velocity(operation, e.q_rates, v)
            slopes = jacobian(g, self.mass_entries, [("t", 0), *(("q", i) for i in range(e.nq))])
            changes = {
                entry: g.total(n if space == "t" else g.mul(n, rates[i]) for (space, i), n in sorted(found.items()))
                for entry, found in zip(self.mass_entries, slopes, strict=True)
            }
            for (i, j), node in sorted(self.mass_matrix.items()):
                if node in changes:
                    result[i] = g.add(result[i], g.mul(changes[node], x[j]))
        return tuple(result)

    def _on_at_velocity(self, operation: Operation, x: Nodes | int, v: Nodes) -> Any:
        vector = isinstance(x, tuple)
        found = self.graph.replaced(x if isinstance(x, tuple) else (x,), {("v", i): n for i, n in enumerate(v)})
        return tuple(found) if vector else found[0]

    # -- M -------------------------------------------------------------------------------------------------------------

    @cached_property
    def mass_entries(self) -> tuple[int, ...]:
        """Entries of M that change with the position, each once; none where bodies have coordinates of their own."""
        g = self.graph
        nodes = (n for block in self.equations.mass for row in block.entries for n in row)
        return tuple(dict.fromkeys(n for n in nodes if g.depends[n] & ~PARAMETER))

    @cached_property
    def with_stored_mass(self) -> Scalars:
        """The same tape with M as the section ``mass_entry`` holds it, for functions that are not given the state.

        M is replaced before anything is made of it: products with it do not keep its entries together.
        """
        other = self._with_mass(_replaced(self.equations.mass, self.mass_entries, self.graph, "mass_entry"))
        other.values, other.kept, other.flags = {}, {}, []
        other.run(range(len(other.operations)))
        return other

    @cached_property
    def body(self) -> Scalars:
        """The same tape with the metric of carried bodies in the place of M."""
        return self._with_mass(self.equations.metric)

    def _with_mass(self, mass: tuple[MassBlock, ...]) -> Scalars:
        """Return the same tape with another matrix in the place of M, nothing evaluated yet."""
        other = copy(self)
        for name in ("mass_entries", "mass_matrix", "mass_factor", "coupled", "inverse_mass", "gauge"):
            other.__dict__.pop(name, None)
        other.equations = replace(self.equations, mass=mass)
        return other

    def _on_body_entries(self, operation: Operation) -> Nodes:
        return self.body.mass_entries

    def _on_weighted_body(self, operation: Operation, rank: Factor) -> Factor:
        """Return the factor of D W^-1 D^T in the function that decides rank."""

        def keep(row: int) -> int:
            return self._decided(row, rank.pivots[row], rank.diagonal[row])

        return self._weighted(self.body.mass_gram(self.rows), keep)

    def _on_body_inverse(self, operation: Operation, x: Nodes) -> Nodes:
        body = self.body
        stored = body._with_mass(_replaced(body.equations.mass, body.mass_entries, self.graph, "body_entry"))
        return stored._back(stored._forward(x))

    @cached_property
    def mass_matrix(self) -> dict[tuple[int, int], int]:
        """The entries of M that are not structurally zero."""
        return {
            (i, j): node
            for block in self.equations.mass
            for i, row in zip(block.columns, block.entries, strict=True)
            for j, node in zip(block.columns, row, strict=True)
            if node != self.graph.zero or i == j
        }

    @cached_property
    def mass_factor(self) -> Factor:
        """The factor of an M that changes, from the leaves of the tree inwards: nothing is filled in."""
        near: list[set[int]] = [set() for _ in range(self.equations.nv)]
        for i, j in self.mass_matrix:
            if i != j:
                near[i].add(j)
        order, _ = minimum_degree([frozenset(n) for n in near])
        return factorise(self.graph, self.mass_matrix, order, self._reciprocal)

    @cached_property
    def coupled(self) -> Sequence[Mapping[int, int]]:
        """For each velocity those that M^-1 couples it with."""
        if not self.mass_entries:
            return self.inverse_mass
        found: list[Mapping[int, int]] = [{} for _ in range(self.equations.nv)]
        for block in self.equations.mass:
            for j in block.columns:
                found[j] = dict.fromkeys(block.columns, 0)
        return found

    def _forward(self, x: Sequence[int]) -> list[int]:
        """Return L^-1 x of M = L d L^T."""
        g, found = self.graph, list(x)
        for k in self.mass_factor.order:
            for i, entry in self.mass_factor.lower[k]:
                found[i] = g.sub(found[i], g.mul(entry, found[k]))
        return found

    def _back(self, half: Sequence[int]) -> Nodes:
        """Return L^-T d^-1 x."""
        g, x, factor = self.graph, list(half), self.mass_factor
        for k in reversed(factor.order):
            x[k] = g.mul(x[k], factor.reciprocal[k])
            for i, entry in factor.lower[k]:
                x[k] = g.sub(x[k], g.mul(entry, x[i]))
        return tuple(x)

    def _halves(self, matrix: Rows) -> tuple[list[list[int]], list[list[int]]]:
        """Return L^-1 D^T by the rows of D, and d^-1 L^-1 D^T."""
        g, found = self.graph, list[list[int]]()
        for row in matrix:
            x = [g.zero] * self.equations.nv
            for j, node in row:
                x[j] = node
            found.append(self._forward(x))
        reciprocal = self.mass_factor.reciprocal
        return found, [[g.mul(reciprocal[k], x) for k, x in enumerate(half)] for half in found]

    def _half(self, index: int) -> list[int]:
        """Return L^-1 of a value of the tape; of sums and of D^T y from what is known of their parts."""
        g, operation = self.graph, self.operations[index]
        parts = operation.operands
        if operation.kind in ("add", "sub") and operation.size == "nv":
            return [getattr(g, operation.kind)(a, b) for a, b in zip(*map(self._half, parts), strict=True)]
        if operation.kind == "transposed" and self.values[parts[0]] is self.rows:
            y, (halves, _) = self.values[parts[1]], self._halves(self.rows)
            return [g.dot([half[k] for half in halves], y) for k in range(self.equations.nv)]
        return self._forward(self.values[index])

    def mass_gram(self, matrix: Rows) -> dict[tuple[int, int], int]:
        """Return D M^-1 D^T as nodes."""
        if not self.mass_entries:
            return self.gram(matrix, self.inverse_mass)
        g, (halves, scaled) = self.graph, self._halves(matrix)
        result: dict[tuple[int, int], int] = {}
        for i, near in enumerate(self.neighbours(matrix, self.coupled)):
            for j in (i, *(n for n in sorted(near) if n > i)):
                node = g.dot(scaled[i], halves[j])
                if node != g.zero or i == j:
                    result[i, j] = result[j, i] = node
        return result

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
            factor = factorise(g, matrix, range(n), self._reciprocal)
            for j in range(n):
                unit = [g.one if i == j else g.zero for i in range(n)]
                for i, node in enumerate(factor.solve(g, unit)):
                    if node != g.zero:
                        result[block.columns[i]][block.columns[j]] = node
        return result

    def _on_minv(self, operation: Operation, x: Nodes) -> Nodes:
        g = self.graph
        if self.mass_entries:
            return self._back(self._half(operation.operands[0]))
        result = [g.zero] * len(x)
        for block in self.equations.mass:
            if len(block.columns) == 1:
                j, mass = block.columns[0], block.entries[0][0]
                # two literals are divided while code is generated, so that a weight over its mass is g to the last
                # digit
                literal = g.value(x[j]) is not None and g.value(mass) is not None
                result[j] = g.div(x[j], mass) if literal else g.mul(self.inverse_mass[j][j], x[j])
                continue
            for i in block.columns:
                result[i] = g.total(g.mul(e, x[j]) for j, e in sorted(self.inverse_mass[i].items()))
        return tuple(result)

    def _on_mass(self, operation: Operation, x: Nodes) -> Nodes:
        g = self.graph
        result = [g.zero] * len(x)
        for block in self.equations.mass:
            for i, row in zip(block.columns, block.entries, strict=True):
                result[i] = g.total(g.mul(e, x[j]) for j, e in zip(block.columns, row, strict=True))
        return tuple(result)

    def _on_free_acceleration(self, operation: Operation, f: Nodes) -> Nodes:
        regular = all(self.graph.value(node) != 0.0 for node in self._diagonal)
        return self._on_minv(operation, f) if regular else (self.graph.zero,) * len(f)

    def _on_gauged(self, operation: Operation, x: Nodes) -> Nodes:
        return tuple(self.graph.mul(next(iter(self.gauge[j].values())), n) for j, n in enumerate(x))

    @cached_property
    def gauge(self) -> list[dict[int, int]]:
        """Rows of the diagonal matrix that rank is decided with: 1 for translations, 1 / l^2 for rotations."""
        units = (v.unit for v in self.equations.velocities)
        return [{j: self.graph.input("gauge", j) if u == "rad/s" else self.graph.one} for j, u in enumerate(units)]

    @property
    def _diagonal(self) -> list[int]:
        return [b.entries[i][i] for b in self.equations.mass for i in range(len(b.columns))]

    def _on_inverse_mass_root(self, operation: Operation) -> Rows:
        """Return L^-T with M = L L^T by rows of the transposed, L^-1; Cholesky's root is the cheapest."""
        rows: list[tuple[tuple[int, int], ...]] = [()] * self.equations.nv
        for block in self.equations.mass:
            for i, entries in zip(block.columns, self._inverse_root(block), strict=True):
                rows[i] = tuple((block.columns[j], n) for j, n in enumerate(entries) if n != self.graph.zero)
        return tuple(rows)

    def _inverse_root(self, block: MassBlock) -> Iterator[list[int]]:
        g, n = self.graph, len(block.columns)
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
            yield [inverse[i, j] for j in range(i + 1)]

    # -- factorisations ------------------------------------------------------------------------------------------------

    def _reciprocal(self, row: int, pivot: int, diagonal: int) -> int:
        return self.graph.div(self.graph.one, pivot)

    def neighbours(self, matrix: Rows, coupled: Sequence[Mapping[int, int]] | None = None) -> list[frozenset[int]]:
        """Return, for each row of D, the other rows with which D W D^T has an entry; `coupled`: rows of W, or None."""
        by_column: dict[int, set[int]] = {}
        for i, row in enumerate(matrix):
            for j, _ in row:
                for k in (j,) if coupled is None else coupled[j]:
                    by_column.setdefault(k, set()).add(i)
        own = [sorted(j for j, _ in row) for row in matrix]
        return [frozenset(n for j in own[i] for n in by_column.get(j, ()) if n != i) for i in range(len(matrix))]

    @cached_property
    def order(self) -> tuple[int, ...]:
        """Elimination order of the rows; one for S and D D^T, whose pattern is contained in S's."""
        return minimum_degree(self.neighbours(self.rows, self.coupled))[0]

    def gram(self, matrix: Rows, weight: Weight | None = None) -> dict[tuple[int, int], int]:
        """Return D W D^T as nodes; `weight` None is the identity, else rows of W."""
        g = self.graph
        left: list[dict[int, int]] = []
        for row in matrix:
            if weight is None:
                left.append(dict(row))
                continue
            weighted: dict[int, int] = {}
            for j, e in row:
                for k, node in weight[j].items():
                    weighted[k] = g.add(weighted.get(k, g.zero), g.mul(e, node))
            left.append(weighted)
        result: dict[tuple[int, int], int] = {}
        for i, near in enumerate(self.neighbours(matrix, weight)):
            for j in (i, *(n for n in sorted(near) if n > i)):
                node = g.total(g.mul(left[i][k], e) for k, e in matrix[j] if k in left[i])
                if node != g.zero or i == j:
                    result[i, j] = result[j, i] = node
        return result

    def _on_schur(self, operation: Operation) -> Factor:
        """Return the factor of S = D M^-1 D^T; masked rows get a reciprocal pivot of 0, small pivots a flag."""
        return self._masked_factor(self.mass_gram(self.rows))

    def _on_pseudoinverse(self, operation: Operation, matrix: Rows) -> Factor:
        return self._masked_factor(self.gram(matrix))

    def _masked_factor(self, matrix: Mapping[tuple[int, int], int]) -> Factor:
        g = self.graph

        def reciprocal(row: int, pivot: int, diagonal: int) -> int:
            masked = g.add(pivot, self.mask[row])  # the mask is 0, or infinite for a row to be left out
            if pivot != diagonal:
                self.flags.append(g.call("lt", masked, g.mul(g.constant(SUSPICIOUS), diagonal)))
            return g.div(g.one, masked)

        return factorise(g, matrix, self.order, reciprocal)

    def _on_flag(self, operation: Operation) -> int | None:
        """Return the node that is true where a pivot of S was suspicious so far."""
        result = None
        for node in self.flags:
            result = node if result is None else self.graph.call("or", result, node)
        return result

    def _on_rank(self, operation: Operation) -> Factor:
        """Return the factor of D G D^T that decides rank: dependent rows get a reciprocal pivot of 0."""

        def reciprocal(row: int, pivot: int, diagonal: int) -> int:
            return self._kept(self._decided(row, pivot, diagonal), pivot)

        return factorise(self.graph, self.gram(self.rows, self.gauge), self.order, reciprocal)

    def _decided(self, row: int, pivot: int, diagonal: int) -> int:
        """Return 1 where a pivot of D G D^T says that its row is kept, else 0; a row eliminated alone always is."""
        g = self.graph
        if self._certain(row, pivot, diagonal):
            return g.one
        # near a singular position rounding lifts the pivot of a masked row above SKIP: the mask keeps it out
        usual = self._usual(row, diagonal)
        return g.call("step", pivot, g.add(g.mul(g.constant(SKIP), usual), self.mask[row]))

    def _certain(self, row: int, pivot: int, diagonal: int) -> bool:
        """Whether a row is kept whatever the position: it is eliminated alone, and cannot vanish."""
        return pivot == diagonal and self.equations.rows[row].size is None

    def _usual(self, row: int, diagonal: int) -> int:
        """Return what the pivot of a row in D G D^T is compared with: its square, or what it was before."""
        g, found = self.graph, self.equations.rows[row]
        if found.size is None:
            return diagonal
        if found.unit not in ("rad", "rad/s"):
            return g.call("max", diagonal, found.size)
        turns = [next(iter(self.gauge[j].values())) for j, _ in found.entries]
        gauge = g.mul(g.constant(1.0 / max(1, len(turns))), g.total(turns))
        return g.call("max", diagonal, g.mul(found.size, gauge))

    def _kept(self, keep: int, pivot: int) -> int:
        """Return 1 / pivot where `keep` is 1, else 0."""
        g = self.graph
        return g.div(g.one, pivot) if keep == g.one else g.div(keep, g.call("max", pivot, g.constant(TINY)))

    def _weighted(self, matrix: Mapping[tuple[int, int], int], keep: Callable[[int], int]) -> Factor:
        """Return the factor of D W D^T, of the rows for which `keep` gives 1."""

        def reciprocal(row: int, pivot: int, _: int) -> int:
            return self._kept(keep(row), pivot)

        return factorise(self.graph, matrix, self.order, reciprocal)

    def _weighted_apart(self, rank: Factor, gram: Callable[[Rows], dict[tuple[int, int], int]]) -> Factor:
        """Return the same from what ``geometry`` left in w."""
        g, stored = self.graph, self._keep_factor(rank, "lower", "reciprocal")

        def keep(row: int) -> int:
            certain = self._certain(row, rank.pivots[row], rank.diagonal[row])
            return g.one if certain else g.call("step", stored.reciprocal[row], g.zero)

        return self._weighted(gram(self.stored_constraints()), keep)

    def _on_weighted_mass(self, operation: Operation, rank: Factor) -> Factor:
        """Return the factor of D M^-1 D^T without the rows that D D^T leaves out."""
        return self._weighted_apart(rank, self.mass_gram)

    def _on_weighted_identity(self, operation: Operation, rank: Factor) -> Factor:
        return self._weighted_apart(rank, self.gram)

    def _on_weighted_dependent(self, operation: Operation, rank: Factor) -> Factor:
        """Return the factor of D P D^T in the function that decides rank: what every stage needs is not read back."""

        def keep(row: int) -> int:
            return self._decided(row, rank.pivots[row], rank.diagonal[row])

        dependent = self._on_gauged(operation, self.section("dependent", self.equations.nv))
        return self._weighted(self.gram(self.rows, [{j: node} for j, node in enumerate(dependent)]), keep)

    def _on_partition_quality(self, operation: Operation, rank: Factor, factor: Factor) -> int:
        """Return det(D P D^T) / det(D G D^T): squared cosines between tangent space and independent coordinates."""
        g, quality = self.graph, self.graph.one
        for i in factor.order:
            kept = g.mul(rank.pivots[i], rank.reciprocal[i])  # 0 for rows that D D^T skips: they say nothing
            ratio = g.mul(factor.pivots[i], rank.reciprocal[i])
            quality = g.mul(quality, g.add(ratio, g.sub(g.one, kept)))
        return quality

    def _on_augmented(self, operation: Operation, penalties: Nodes) -> Factor:
        return self._augmented(self.rows, penalties)

    def _on_augmented_metric(self, operation: Operation, penalties: Nodes) -> Factor:
        return self._augmented(self.stored_constraints(), penalties)

    def _augmented(self, constraints: Rows, penalties: Nodes) -> Factor:
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
        near: list[set[int]] = [set() for _ in range(self.equations.nv)]
        for i, j in matrix:
            if i != j:
                near[i].add(j)
        order, _ = minimum_degree([frozenset(n) for n in near])
        return factorise(g, matrix, order, self._reciprocal)

    def _on_solve(self, operation: Operation, factor: Factor, right: Nodes) -> Nodes:
        return tuple(factor.solve(self.graph, right))

    def _on_geometry(self, operation: Operation, rank: Factor) -> Outputs:
        """Return Phi as the residual, its norm, nu, the variable entries of D, relative pivots, and what they decide.

        A relative pivot is the squared sine of the angle between a row and those eliminated before it.
        """
        g = self.graph
        outputs: Outputs = [(Target("residual", i), n) for i, n in enumerate(self.phi)]
        outputs += self.violation("position", self.phi)
        outputs += [(Target("nu", i), n) for i, n in enumerate(self.nu) if n != g.zero]
        entries = [node for row in self.rows for _, node in row]
        slots = ((e.slot, n) for e, n in zip(self.jacobian, entries, strict=True))
        outputs += [(Target("jacobian", slot), n) for slot, n in slots if slot is not None]
        kept, smallest = g.zero, g.one
        for i in range(len(rank.order)):
            if self._certain(i, rank.pivots[i], rank.diagonal[i]):
                kept = g.add(kept, g.one)
                continue
            relative = g.div(rank.pivots[i], self._usual(i, rank.diagonal[i]))
            outputs.append((Target("pivot", i), relative))
            kept = g.add(kept, self._decided(i, rank.pivots[i], rank.diagonal[i]))
            smallest = g.call("min", smallest, g.add(relative, self.mask[i]))
        shortest = g.one
        for i, row in enumerate(self.equations.rows):
            if row.size is not None:  # the row over the velocities of bodies, whatever loops make of it
                if row.unit == "rad" and g.value(row.size) is None:
                    shortest = g.call("min", shortest, row.size)
            elif row.unit == "rad" and g.value(rank.diagonal[i]) is None:
                shortest = g.call("min", shortest, g.mul(rank.diagonal[i], g.input("row_weight", i)))
        outputs += [to_status("rank", kept), to_status("smallest_pivot", smallest), to_status("shortest_row", shortest)]
        return outputs

    def violation(self, level: str, residuals: Sequence[int]) -> Outputs:
        """Return the norm of Phi or of D v - nu, and what is judged: rows that are no lengths times the mechanism's."""
        g = self.graph
        length = g.input("status", STATUS.index("length_scale"))
        units = (row.unit for row in self.equations.rows)
        weighed = [g.mul(length, n) if u == "rad" else n for u, n in zip(units, residuals, strict=True)]
        norm, measure = (g.call("sqrt", g.dot(x, x)) for x in (residuals, weighed))
        return [to_status(f"{level}_violation", norm), to_status(f"{level}_measure", measure)]

    # -- what is kept in w between functions ---------------------------------------------------------------------------

    def _keep(self, section: str, x: Iterable[int]) -> Iterator[int]:
        """Note what one function writes into a section, and yield it as others read it, literals as they are."""
        written = self.kept.setdefault(section, [])
        for node in x:
            if self.graph.value(node) is None:
                written.append((Target(section, len(written)), node))
                node = self.graph.input(section, len(written) - 1)
            yield node

    def _keep_factor(self, factor: Factor, lower: str, reciprocal: str) -> Factor:
        entries = iter(list(self._keep(lower, (n for k in factor.order for _, n in factor.lower[k]))))
        columns = {k: tuple((i, next(entries)) for i, _ in factor.lower[k]) for k in factor.order}
        pivots = list(self._keep(reciprocal, (factor.reciprocal[k] for k in factor.order)))
        reciprocals = dict(zip(factor.order, pivots, strict=True))
        return Factor(factor.order, columns, reciprocals, factor.pivots, factor.diagonal)

    def _on_keep(self, operation: Operation, x: Nodes) -> Nodes:
        return tuple(self._keep(str(operation.payload[0]), x))

    def _on_keep_constraints(self, operation: Operation, matrix: Rows) -> Rows:
        nodes = iter(list(self._keep(str(operation.payload[0]), (e for row in matrix for _, e in row))))
        return tuple(tuple((j, next(nodes)) for j, _ in row) for row in matrix)

    def _on_keep_factor(self, operation: Operation, factor: Factor) -> Factor:
        return self._keep_factor(factor, *(str(operation.payload[0]),) * 2)

    def _on_stored_factor(self, operation: Operation, factor: Factor) -> Factor:
        prefix = str(operation.payload[0])
        return self._keep_factor(factor, f"{prefix}lower", f"{prefix}reciprocal")


def _replaced(mass: tuple[MassBlock, ...], entries: Nodes, graph: Graph, section: str) -> tuple[MassBlock, ...]:
    """Return a matrix with entries as a section holds them."""
    places = {node: graph.input(section, k) for k, node in enumerate(entries)}
    return tuple(MassBlock(b.columns, tuple(tuple(places.get(n, n) for n in row) for row in b.entries)) for b in mass)


def to_status(name: str, node: int) -> tuple[Target, int]:
    """Return an output to the status at the beginning of ``w``."""
    return Target("status", STATUS.index(name)), node
