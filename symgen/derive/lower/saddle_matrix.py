"""Elimination of M v' + D^T lambda = f, D v' = gamma on a static pattern, velocities first that rows fix.

A row with an entry of +-1 that no elimination has changed fixes this velocity by the others: v' = +-(gamma - n v'). The
velocity and its row leave the equations together, and so do the two rows of a hinge's axis with two angular velocities.
The other entries of M become N^T M N, those of D lose a column. This cannot fail, and decides nothing on rank: such
rows are independent of each other. Accelerations of fixed velocities then follow from their rows, and multipliers of
the rows from the equations of the velocities, both as they were before.

The two rows of a joint may close a loop: two of their velocities follow from the others, and one determinant takes the
place of two pivots. It vanishes where both columns are parallel, so that a flag goes with it.

What is left over is eliminated one by one: velocities, then rows.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from symgen.base.ir.graph import Graph
from symgen.base.ir.polynomial import NormalForms
from symgen.base.ir.program import FixedVelocities
from symgen.derive.lower.factor import minimum_degree
from symgen.derive.lower.replay import Nodes
from symgen.derive.lower.scalar_values import Rows


@dataclass(frozen=True)
class _Fixed:
    """Fixed velocities that have been eliminated: B^-1, entries of M among them, of others with them, N = B^-1 D.

    `weighed` are the entries of M N less those of M with others.
    """

    columns: tuple[int, ...]
    rows: tuple[int, ...]
    inverse: list[list[int]]
    mass: list[list[int]]
    beside: dict[int, list[int]]
    with_rows: dict[int, list[int]]
    motion: dict[int, list[int]]
    weighed: dict[int, list[int]]


@dataclass(frozen=True)
class _Single:
    """An unknown eliminated alone: the sign of its pivot, the reciprocal of its size, and its factors by unknowns."""

    unknown: int
    sign: int
    reciprocal: int
    factors: dict[int, int]


class SaddleMatrix:
    """The matrix [M D^T; D 0] while unknowns are eliminated: velocities are numbered from 0, rows from `nv` on.

    Parameters
    ----------
    graph : Graph
        Graph of the nodes.
    nv : int
        Number of velocities.
    mass : mapping of (row, column) to node
        M, both triangles.
    rows : Rows
        D.
    simpler : callable, optional
        Returns a cheaper node of the same value, for entries of M, and every entry and right-hand side that changes.
    """

    def __init__(
        self,
        graph: Graph,
        nv: int,
        mass: Mapping[tuple[int, int], int],
        rows: Rows,
        simpler: Callable[[int], int] | None = None,
    ) -> None:
        self.graph, self.nv, self.simpler = graph, nv, simpler or (lambda node: node)
        self.normal = simpler is not None
        self.entries: list[dict[int, int]] = [{} for _ in range(nv + len(rows))]
        for (i, j), node in mass.items():
            self._set_symmetric(i, j, self.simpler(node))
        for r, row in enumerate(rows, nv):
            for c, node in row:
                self._set_symmetric(r, c, node)
        self.before = [dict(x) for x in self.entries]
        self.left = set(range(len(self.entries)))
        self.changed: set[tuple[int, int]] = set()
        self.fixed: list[_Fixed] = []
        self.loops: list[_Fixed] = []
        self.singles: list[_Single] = []
        self.solutions: dict[tuple[Nodes, Nodes], tuple[Nodes, Nodes]] = {}

    def _set_symmetric(self, i: int, j: int, node: int) -> None:
        for a, b in ((i, j), (j, i)):
            if node == self.graph.zero:
                self.entries[a].pop(b, None)
            else:
                self.entries[a][b] = node

    def is_unit(self, i: int, j: int) -> bool:
        """Whether an entry is +-1."""
        return self.graph.value(self.entries[i].get(j, self.graph.zero)) in (1.0, -1.0)

    def _take_unknowns(self, unknowns: Sequence[int]) -> dict[int, list[int]]:
        """Return the entries of some unknowns with those left over, by the latter."""
        zero, of = self.graph.zero, [self.entries[x] for x in unknowns]
        return {i: [x.get(i, zero) for x in of] for i in sorted({i for x in of for i in x} & self.left)}

    def eliminate_fixed(self, block: FixedVelocities) -> list[int]:
        """Eliminate velocities with the rows that fix them; return the unknowns whose entries change."""
        g, k = self.graph, self.entries
        columns, rows = block.columns, tuple(self.nv + r for r in block.rows)
        inverse = self._invert_block([[k[r].get(c, g.zero) for c in columns] for r in rows])
        mass = [[k[c].get(d, g.zero) for d in columns] for c in columns]
        self.left -= {*columns, *rows}
        beside, with_rows = self._take_unknowns(columns), self._take_unknowns(rows)
        for i in {*beside, *with_rows}:
            for x in (*columns, *rows):
                k[i].pop(x, None)
        motion = {i: [g.dot(line, x) for line in inverse] for i, x in with_rows.items()}
        none = [g.zero] * len(columns)
        weighed = {
            i: self._difference([g.dot(line, x) for line in mass], beside.get(i, none)) for i, x in motion.items()
        }
        touched = sorted({*beside, *motion})
        for a, i in enumerate(touched):
            for j in touched[a:]:
                if i not in motion and j not in motion:
                    continue
                node = before = k[i].get(j, g.zero)
                one, other = (i, j) if i in motion else (j, i)
                if other in motion:
                    node = g.add(node, g.dot(weighed[one], motion[other]))
                if other in beside:
                    node = g.sub(node, g.dot(motion[one], beside[other]))
                self.changed |= {(i, j), (j, i)}
                if node != before:
                    self._set_symmetric(i, j, self.simpler(node))
        self.fixed.append(_Fixed(columns, rows, inverse, mass, beside, with_rows, motion, weighed))
        return touched

    def eliminate_loop(self, block: FixedVelocities) -> tuple[int, int]:
        """Eliminate velocities with the rows of a loop; return the squares of the determinant and of its largest value.

        The latter is the product of the columns' squares, the former over it the squared sine of their angle.
        """
        g, k, (a, b) = self.graph, self.entries, (self.nv + r for r in block.rows)
        one, two = ([k[r].get(c, g.zero) for r in (a, b)] for c in block.columns)
        determinant, _ = self._adjugate([[x, y] for x, y in zip(one, two, strict=True)])
        self.eliminate_fixed(block)
        self.loops.append(self.fixed.pop())
        simpler = NormalForms(g).simpler  # columns of hinges in the plane have constant lengths
        return g.mul(determinant, determinant), g.mul(simpler(g.dot(one, one)), simpler(g.dot(two, two)))

    def velocities_left_in_row(self, row: int) -> tuple[int, ...]:
        """Return the velocities left over in a row."""
        return tuple(sorted(i for i in self.entries[self.nv + row] if i < self.nv))

    def _difference(self, one: Sequence[int], other: Sequence[int]) -> list[int]:
        return [self.graph.sub(a, b) for a, b in zip(one, other, strict=True)]

    def _invert_block(self, matrix: list[list[int]]) -> list[list[int]]:
        g = self.graph
        if len(matrix) == 1:
            return [[g.div(g.one, matrix[0][0])]]
        determinant, adjugate = self._adjugate(matrix)
        reciprocal = g.div(g.one, determinant)
        return [[g.mul(reciprocal, x) for x in line] for line in adjugate]

    def _adjugate(self, matrix: list[list[int]]) -> tuple[int, list[list[int]]]:
        """Return determinant and adjugate, both with the sign that leaves fewer signs beside normal forms."""
        g, ((a, b), (c, d)) = self.graph, matrix
        determinant, entries = g.sub(g.mul(a, d), g.mul(b, c)), [[d, g.neg(b)], [g.neg(c), a]]
        if self.normal and sum(g.nodes[x].op == "neg" for line in entries for x in line) > 2:
            return g.neg(determinant), [[g.neg(x) for x in line] for line in entries]
        return determinant, entries

    def eliminate_rest(self, reciprocal: Callable[[int, int, int], int]) -> None:
        """Eliminate the unknowns left over: velocities, then rows, each in an order of low fill.

        Parameters
        ----------
        reciprocal : callable
            ``reciprocal(row, pivot, first)`` returns the node used for 1 / pivot of a row, `first` being its pivot
            before the other rows are eliminated; 0 for a row to be skipped.
        """
        g, k = self.graph, self.entries
        places = sorted(self.left)
        number = {x: i for i, x in enumerate(places)}
        near = [frozenset(number[j] for j in k[i] if j != i) for i in places]
        order, _ = minimum_degree(near, frozenset(number[x] for x in places if x < self.nv))
        first: dict[int, int] = {}
        for x in (places[i] for i in order):
            if x >= self.nv and not first:
                first = {i: g.neg(k[i].get(i, g.zero)) for i in self.left}
            sign, pivot = (1, k[x].get(x, g.zero)) if x < self.nv else (-1, g.neg(k[x].get(x, g.zero)))
            inverse = g.div(g.one, pivot) if x < self.nv else reciprocal(x - self.nv, pivot, first[x])
            self.left.discard(x)
            others = {i: node for (i, (node,)) in self._take_unknowns((x,)).items()}
            factors = {i: g.mul(node, inverse) for i, node in others.items()}
            join = g.sub if sign > 0 else g.add
            for a, i in enumerate(others):
                for j in list(others)[a:]:
                    self._set_symmetric(i, j, join(k[i].get(j, g.zero), g.mul(factors[i], others[j])))
            self.singles.append(_Single(x, sign, inverse, factors))

    def solve(self, f: Nodes, gamma: Nodes) -> tuple[Nodes, Nodes]:
        """Return v' and lambda."""
        if (f, gamma) not in self.solutions:
            self.solutions[f, gamma] = self._solve_normal_forms(f, gamma)
        return self.solutions[f, gamma]

    def _is_cheaper_by_mass(self, step: _Fixed) -> bool:
        """Whether M times the velocities known from rows is cheaper with M N, which is there, than for itself."""
        zero = self.graph.zero
        alone = sum(x != zero for line in step.mass for x in line)
        none = [zero] * len(step.columns)
        more = sum(
            x != zero and y == zero
            for i, w in step.weighed.items()
            for x, y in zip(w, step.beside.get(i, none), strict=True)
        )
        return more < alone

    def _solve_normal_forms(self, f: Nodes, gamma: Nodes) -> tuple[Nodes, Nodes]:
        given = tuple(map(self.simpler, (*f, *gamma)))
        return self.complete_solution(given, self.solve_rest(given))

    def solve_rest(self, given: Nodes) -> dict[int, int]:
        """Return the unknowns that no row alone fixes, linear in the right-hand side."""
        g, b = self.graph, list(given)
        for step in (*self.fixed, *self.loops):
            known = [g.dot(line, [b[r] for r in step.rows]) for line in step.inverse]
            right = [b[c] for c in step.columns]
            if self._is_cheaper_by_mass(step):
                for i, entries in step.motion.items():
                    b[i] = self.simpler(g.add(g.sub(b[i], g.dot(entries, right)), g.dot(step.weighed[i], known)))
                others = sorted(step.beside.keys() - step.motion.keys())
            else:
                force = self._difference(right, [g.dot(line, known) for line in step.mass])
                for i, entries in step.motion.items():
                    b[i] = self.simpler(g.sub(b[i], g.dot(entries, force)))
                others = list(step.beside)
            for i in others:
                b[i] = self.simpler(g.sub(b[i], g.dot(step.beside[i], known)))
        for single in self.singles:
            for i, factor in single.factors.items():
                b[i] = (g.sub if single.sign > 0 else g.add)(b[i], g.mul(factor, b[single.unknown]))
        x: dict[int, int] = {}
        for single in reversed(self.singles):
            value = g.mul(b[single.unknown], single.reciprocal)
            value = value if single.sign > 0 else g.neg(value)
            for i, factor in single.factors.items():
                value = (g.sub if single.sign > 0 else g.add)(value, g.mul(factor, x[i]))
            x[single.unknown] = value
        for step in reversed(self.loops):
            self._add_loop_unknowns(step, b, x)
        return x

    def complete_solution(self, given: Nodes, rest: Mapping[int, int]) -> tuple[Nodes, Nodes]:
        """Return v' and lambda of a right-hand side and its unknowns that no row alone fixes."""
        x = dict(rest)
        accelerations = [(s.rows, s.columns, s.inverse) for s in self.fixed]
        multipliers = [(s.columns, s.rows, [list(line) for line in zip(*s.inverse, strict=True)]) for s in self.fixed]
        self._add_from_equations(accelerations, given, x)
        self._add_from_equations(multipliers, given, x)
        return tuple(x[i] for i in range(self.nv)), tuple(x[i] for i in range(self.nv, len(given)))

    def _add_loop_unknowns(self, step: _Fixed, right: list[int], x: dict[int, int]) -> None:
        """Add the unknowns of a loop from what elimination has left of its equations."""
        g, size = self.graph, range(len(step.rows))
        for a, c in enumerate(step.columns):
            value = g.dot(step.inverse[a], [right[r] for r in step.rows])
            for i, n in step.motion.items():
                value = g.sub(value, g.mul(n[a], x[i]))
            x[c] = value
        forces = [
            g.sub(
                g.sub(right[c], g.dot(step.mass[a], [x[d] for d in step.columns])),
                g.sum_of(g.mul(n[a], x[i]) for i, n in step.beside.items()),
            )
            for a, c in enumerate(step.columns)
        ]
        x |= {r: g.dot([step.inverse[a][b] for a in size], forces) for b, r in enumerate(step.rows)}

    def _add_from_equations(
        self,
        waiting: list[tuple[tuple[int, ...], tuple[int, ...], list[list[int]]]],
        right: Nodes,
        x: dict[int, int],
    ) -> None:
        """Add unknowns from equations as they were before: each as soon as all others in them are there."""
        g = self.graph
        while waiting:
            later = []
            for equations, unknowns, inverse in waiting:
                others = [sorted(self.before[i].keys() - set(unknowns)) for i in equations]
                if any(j not in x for each in others for j in each):
                    later.append((equations, unknowns, inverse))
                    continue
                rest = [
                    g.sub(right[i], g.sum_of(g.mul(self.before[i][j], x[j]) for j in each))
                    for i, each in zip(equations, others, strict=True)
                ]
                x |= {unknown: g.dot(line, rest) for unknown, line in zip(unknowns, inverse, strict=True)}
            assert len(later) < len(waiting), "fixed velocities form no chain"
            waiting = later
