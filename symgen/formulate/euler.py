"""Euler parameters as nodes: the matrix that they stand for, and their rates."""

from __future__ import annotations

from collections.abc import Sequence

from symgen.ir.graph import Graph


def matrix_of(g: Graph, e: Sequence[int]) -> list[int]:
    """Return A row by row in homogeneous form: A' = A skew(omega) for Euler parameters of any length."""
    a, b, c, d = e

    def twice(x: int, y: int) -> int:
        return g.mul(g.constant(2.0), g.mul(x, y))

    aa, bb, cc, dd = (g.mul(x, x) for x in (a, b, c, d))
    plus, minus = g.add(aa, bb), g.sub(aa, bb)
    sums, rest = g.add(cc, dd), g.sub(cc, dd)
    bc, ad, bd, ac, cd, ab = (twice(*pair) for pair in ((b, c), (a, d), (b, d), (a, c), (c, d), (a, b)))
    return [
        *(g.sub(plus, sums), g.sub(bc, ad), g.add(bd, ac)),
        *(g.add(bc, ad), g.add(minus, rest), g.sub(cd, ab)),
        *(g.sub(bd, ac), g.add(cd, ab), g.sub(minus, rest)),
    ]


def turning(g: Graph, e: Sequence[int], omega: Sequence[int]) -> list[int]:
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
