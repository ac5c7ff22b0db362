"""Euler parameters as nodes: rotation matrix, rates and products."""

from __future__ import annotations

import math
from collections.abc import Sequence

from symgen.base.ir.graph import Graph


def rotation_matrix_rows(g: Graph, e: Sequence[int]) -> list[int]:
    """Return A row by row in homogeneous form: A' = A skew(omega) for Euler parameters of any length."""
    a, b, c, d = e

    def times_two(x: int, y: int) -> int:
        return g.mul(g.constant(2.0), g.mul(x, y))

    aa, bb, cc, dd = (g.mul(x, x) for x in (a, b, c, d))
    plus, minus = g.add(aa, bb), g.sub(aa, bb)
    sums, rest = g.add(cc, dd), g.sub(cc, dd)
    bc, ad, bd, ac, cd, ab = (times_two(*pair) for pair in ((b, c), (a, d), (b, d), (a, c), (c, d), (a, b)))
    return [
        *(g.sub(plus, sums), g.sub(bc, ad), g.add(bd, ac)),
        *(g.add(bc, ad), g.add(minus, rest), g.sub(cd, ab)),
        *(g.sub(bd, ac), g.add(cd, ab), g.sub(minus, rest)),
    ]


def rate_of_parameters(g: Graph, e: Sequence[int], omega: Sequence[int]) -> list[int]:
    """Return e' = G^T omega / 2 for an angular velocity in body axes: it keeps the length of e."""
    half = g.constant(0.5)
    x, y, z = (g.mul(half, w) for w in omega)
    a, b, c, d = e
    return [
        g.neg(g.dot((b, c, d), (x, y, z))),
        g.add(g.mul(a, x), g.sub(g.mul(c, z), g.mul(d, y))),
        g.add(g.mul(a, y), g.sub(g.mul(d, x), g.mul(b, z))),
        g.add(g.mul(a, z), g.sub(g.mul(b, y), g.mul(c, x))),
    ]


def elementary_rotation(g: Graph, angle: int, axis: int) -> list[int]:
    """Return the Euler parameters of a rotation about the first, second or third axis (1, 2, 3)."""
    half = g.mul(g.constant(0.5), angle)
    e = [g.call("cos", half), g.zero, g.zero, g.zero]
    e[axis] = g.call("sin", half)
    return e


def inverse_rotation(g: Graph, e: Sequence[int]) -> list[int]:
    """Return the Euler parameters of the inverse rotation."""
    return [e[0], *(g.neg(x) for x in e[1:])]


def compose_rotations(g: Graph, p: Sequence[int], q: Sequence[int]) -> list[int]:
    """Return the Euler parameters of A(p) A(q)."""
    a, b, c, d = p
    w, x, y, z = q
    return [
        g.sub(g.mul(a, w), g.dot((b, c, d), (x, y, z))),
        g.add(g.add(g.mul(a, x), g.mul(b, w)), g.sub(g.mul(c, z), g.mul(d, y))),
        g.add(g.add(g.mul(a, y), g.mul(c, w)), g.sub(g.mul(d, x), g.mul(b, z))),
        g.add(g.add(g.mul(a, z), g.mul(d, w)), g.sub(g.mul(b, y), g.mul(c, x))),
    ]


def parameters_of_matrix(g: Graph, matrix: Sequence[Sequence[int]]) -> list[int]:
    """Return the Euler parameters of a rotation matrix of literals, such as joint axes; the largest is positive."""
    r = [[g.value(n) or 0.0 for n in row] for row in matrix]
    trace = r[0][0] + r[1][1] + r[2][2]
    squares = [1.0 + trace, *(1.0 - trace + 2.0 * r[i][i] for i in range(3))]
    k = max(range(4), key=squares.__getitem__)
    e = [0.0] * 4
    e[k] = 0.5 * math.sqrt(squares[k])
    if k == 0:
        for i in range(3):
            e[1 + i] = (r[(i + 2) % 3][(i + 1) % 3] - r[(i + 1) % 3][(i + 2) % 3]) / (4.0 * e[0])
    else:
        i, a, b = k - 1, k % 3, (k + 1) % 3
        e[0] = (r[b][a] - r[a][b]) / (4.0 * e[k])
        e[1 + a] = (r[a][i] + r[i][a]) / (4.0 * e[k])
        e[1 + b] = (r[b][i] + r[i][b]) / (4.0 * e[k])
    return [g.constant(x) for x in e]
