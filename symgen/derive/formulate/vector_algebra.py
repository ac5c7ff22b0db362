"""Vectors and matrices of nodes for the recursions over the bodies of a tree."""

from __future__ import annotations

from collections.abc import Sequence

from symgen.base.ir.graph import Graph

Pair = tuple[int, int]
Triple = tuple[int, int, int]
#: Three rows of a matrix.
Matrix = tuple[Triple, Triple, Triple]


class PlaneVectors:
    """Operations on pairs of nodes of one graph."""

    def __init__(self, graph: Graph) -> None:
        self.graph = graph

    def pair(self, nodes: Sequence[int]) -> Pair:
        """Return two nodes as a vector."""
        x, y = nodes
        return x, y

    def add(self, a: Pair, b: Pair) -> Pair:
        """Return a + b."""
        return self.graph.add(a[0], b[0]), self.graph.add(a[1], b[1])

    def sub(self, a: Pair, b: Pair) -> Pair:
        """Return a - b."""
        return self.graph.sub(a[0], b[0]), self.graph.sub(a[1], b[1])

    def scale(self, factor: int, a: Pair) -> Pair:
        """Return a times a number."""
        return self.graph.mul(factor, a[0]), self.graph.mul(factor, a[1])

    def perp(self, a: Pair) -> Pair:
        """Return a rotated left by 90 degrees."""
        return self.graph.neg(a[1]), a[0]

    def cross(self, a: Pair, b: Pair) -> int:
        """Return the component of a x b normal to the plane."""
        return self.graph.sub(self.graph.mul(a[0], b[1]), self.graph.mul(a[1], b[0]))

    def rotate(self, axes: Pair, a: Pair) -> Pair:
        """Return a vector rotated by the angle with cosine and sine `axes`."""
        g, (c, s), (x, y) = self.graph, axes, a
        return g.sub(g.mul(c, x), g.mul(s, y)), g.add(g.mul(s, x), g.mul(c, y))


class Vectors:
    """Operations on triples of nodes of one graph."""

    def __init__(self, graph: Graph) -> None:
        self.graph = graph
        z, o = graph.zero, graph.one
        self.zero: Triple = (z, z, z)
        self.units: Matrix = ((o, z, z), (z, o, z), (z, z, o))

    def triple(self, nodes: Sequence[int]) -> Triple:
        """Return three nodes as a vector."""
        x, y, z = nodes
        return x, y, z

    def add(self, *vectors: Triple) -> Triple:
        """Return a sum."""
        g = self.graph
        return self.triple([g.sum_of(parts) for parts in zip(*vectors, strict=True)])

    def sub(self, a: Triple, b: Triple) -> Triple:
        """Return a - b."""
        return self.triple([self.graph.sub(x, y) for x, y in zip(a, b, strict=True)])

    def neg(self, a: Triple) -> Triple:
        """Return -a."""
        return self.triple([self.graph.neg(x) for x in a])

    def scale(self, factor: int, a: Triple) -> Triple:
        """Return a times a number."""
        return self.triple([self.graph.mul(factor, x) for x in a])

    def dot(self, a: Triple, b: Triple) -> int:
        """Return the inner product."""
        return self.graph.dot(a, b)

    def cross(self, a: Triple, b: Triple) -> Triple:
        """Return a x b."""
        g = self.graph
        return (
            g.sub(g.mul(a[1], b[2]), g.mul(a[2], b[1])),
            g.sub(g.mul(a[2], b[0]), g.mul(a[0], b[2])),
            g.sub(g.mul(a[0], b[1]), g.mul(a[1], b[0])),
        )

    def matrix_times(self, m: Matrix, a: Triple) -> Triple:
        """Return a matrix times a vector."""
        return self.triple([self.graph.dot(row, a) for row in m])

    def times_transposed(self, m: Matrix, a: Triple) -> Triple:
        """Return the transpose of a matrix times a vector."""
        return self.matrix_times(self.transpose(m), a)

    def transpose(self, m: Matrix) -> Matrix:
        """Return the transpose of a matrix."""
        a, b, c = (self.triple(column) for column in zip(*m, strict=True))
        return a, b, c

    def product(self, a: Matrix, b: Matrix) -> Matrix:
        """Return a product of matrices."""
        columns = [self.matrix_times(a, column) for column in self.transpose(b)]
        x, y, z = (self.triple(row) for row in zip(*columns, strict=True))
        return x, y, z

    def matrix_sum(self, a: Matrix, b: Matrix) -> Matrix:
        """Return a sum of matrices."""
        x, y, z = (self.add(p, q) for p, q in zip(a, b, strict=True))
        return x, y, z

    def rotate_symmetric(self, r: Matrix, j: Matrix) -> Matrix:
        """Return R J R^T of a symmetric J; the lower triangle reuses the nodes of the upper one."""
        g = self.graph
        for i in range(3):
            if self._is_about_axis(r, i):
                return self._rotate_about_axis(r, j, i)
        half = self.product(r, j)
        entries = [[g.zero] * 3 for _ in range(3)]
        for i in range(3):
            for k in range(i, 3):
                entries[i][k] = entries[k][i] = g.dot(half[i], r[k])
        x, y, z = (self.triple(row) for row in entries)
        return x, y, z

    def _is_about_axis(self, r: Matrix, i: int) -> bool:
        """Whether a matrix is a rotation about a coordinate axis by an angle that is not constant."""
        g, j, k = self.graph, (i + 1) % 3, (i + 2) % 3
        rest = r[i][j], r[i][k], r[j][i], r[k][i]
        around = r[i][i] == g.one and rest == (g.zero,) * 4
        return around and r[j][j] == r[k][k] and r[j][k] == g.neg(r[k][j]) and g.value(r[j][j]) is None

    def _rotate_about_axis(self, r: Matrix, a: Matrix, i: int) -> Matrix:
        """Return R A R^T of a symmetric A in half the operations, without the trace and the squares of c and s."""
        g, j, k = self.graph, (i + 1) % 3, (i + 2) % 3
        c, s = r[j][j], r[k][j]
        entries = [[g.zero] * 3 for _ in range(3)]
        swing = g.add(g.mul(s, g.sub(a[j][j], a[k][k])), g.mul(g.mul(g.constant(2.0), c), a[j][k]))
        less = g.mul(s, swing)
        entries[i][i], entries[j][j], entries[k][k] = a[i][i], g.sub(a[j][j], less), g.add(a[k][k], less)
        entries[j][k] = entries[k][j] = g.sub(g.mul(c, swing), a[j][k])
        entries[i][j] = entries[j][i] = g.sub(g.mul(c, a[i][j]), g.mul(s, a[i][k]))
        entries[i][k] = entries[k][i] = g.add(g.mul(s, a[i][j]), g.mul(c, a[i][k]))
        x, y, z = (self.triple(row) for row in entries)
        return x, y, z

    def acceleration_matrix(self, omega: Triple, alpha: Triple) -> Matrix:
        """Return K with K a the acceleration of a point at a: alpha x a + omega x (omega x a)."""
        g = self.graph
        square = [g.mul(w, w) for w in omega]
        entries = [[g.zero] * 3 for _ in range(3)]
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            entries[i][i] = g.neg(g.add(square[j], square[k]))
            both = g.mul(omega[i], omega[j])
            entries[i][j], entries[j][i] = g.sub(both, alpha[k]), g.add(both, alpha[k])
        x, y, z = (self.triple(row) for row in entries)
        return x, y, z

    def moment_of_inertia_forces(self, k: Matrix, j: Matrix) -> Triple:
        """Return J alpha + omega x (J omega) of an inertia J, from the `acceleration_matrix` of omega and alpha.

        It is the axis of K S - (K S)^T with S the second moments of mass by coordinates, J = tr(S) 1 - S.
        """
        g = self.graph
        half = g.constant(0.5)
        s = [[g.neg(x) for x in row] for row in j]
        for i in range(3):
            s[i][i] = g.mul(half, g.sub(g.add(j[(i + 1) % 3][(i + 1) % 3], j[(i + 2) % 3][(i + 2) % 3]), j[i][i]))
        return self.triple(
            [g.sub(g.dot(k[(i + 2) % 3], s[(i + 1) % 3]), g.dot(k[(i + 1) % 3], s[(i + 2) % 3])) for i in range(3)]
        )

    def second_moment(self, m: int, a: Triple) -> Matrix:
        """Return m (|a|^2 1 - a a^T): the second moment of a mass at a point."""
        return self.shift_moment(self.scale(m, a), a)

    def shift_moment(self, h: Triple, a: Triple) -> Matrix:
        """Return ((a . h) 1 - (a h^T + h a^T) / 2), which is symmetric."""
        g = self.graph
        half = g.constant(0.5)
        entries = [[g.zero] * 3 for _ in range(3)]
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            entries[i][i] = g.add(g.mul(a[j], h[j]), g.mul(a[k], h[k]))
            mixed = g.add(g.mul(a[i], h[j]), g.mul(h[i], a[j]))
            entries[i][j] = entries[j][i] = g.neg(g.mul(half, mixed))
        x, y, z = (self.triple(row) for row in entries)
        return x, y, z
