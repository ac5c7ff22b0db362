"""Friction by reactions: the forces c with ``c = coefficient |N(c)|``, where N is linear in them.

The reaction of an element is ``N = N0 - sum of c_j n_j``: N0 without this friction, n_j of a unit force of element j
against its rate, one solution with the factor of the equations. For one element the equation is quadratic and has one
root c >= 0 where coefficient |n| < 1. For several it is solved by Newton's iteration, which doubles the digits.
"""

from __future__ import annotations

from collections.abc import Sequence

from symgen.formulate.equations import Drag
from symgen.ir.graph import Graph
from symgen.ir.numerics import TINY
from symgen.lower.replay import Nodes

#: Iterations for several elements, from reactions without this friction.
_ITERATIONS = 5


def drag_forces(g: Graph, drags: Sequence[Drag], alone: Sequence[Nodes], parts: Sequence[Sequence[Nodes]]) -> list[int]:
    """Return the forces c of all elements.

    Parameters
    ----------
    g : Graph
        Where they become nodes.
    drags : sequence of Drag
        The elements.
    alone : sequence of tuple of int
        N0 of each element.
    parts : sequence of sequence of tuple of int
        For each element the vectors n_j of all of them, signs included.
    """
    if len(drags) == 1:
        return [_only(g, drags[0].coefficient, alone[0], parts[0][0])]
    size = len(drags)
    forces = [g.mul(d.coefficient, length(g, n)) for d, n in zip(drags, alone, strict=True)]
    for _ in range(_ITERATIONS):
        matrix, right = list[list[int]](), list[int]()
        for i, drag in enumerate(drags):
            pressed = list(alone[i])
            for j in range(size):
                pressed = [g.sub(x, g.mul(forces[j], n)) for x, n in zip(pressed, parts[i][j], strict=True)]
            total = length(g, pressed)
            slope = g.div(drag.coefficient, total)
            row = [g.mul(slope, g.dot(pressed, parts[i][j])) for j in range(size)]
            matrix.append([g.add(g.one, x) if i == j else x for j, x in enumerate(row)])
            right.append(g.sub(g.mul(drag.coefficient, total), forces[i]))
        forces = [g.add(c, x) for c, x in zip(forces, _solved(g, matrix, right), strict=True)]
    return forces


def length(g: Graph, vector: Sequence[int]) -> int:
    """Return the length of a vector; its derivatives at 0 are 0."""
    return g.call("sqrt", g.call("max", g.dot(vector, vector), g.constant(TINY)))


def _only(g: Graph, coefficient: int, alone: Nodes, part: Nodes) -> int:
    """Return the root c >= 0 of ``c^2 = k^2 |N0 - c n|^2``: ``k N0^2 / (k b + sqrt(k^2 b^2 + (1 - k^2 n^2) N0^2))``."""
    square, own = g.dot(alone, alone), g.mul(coefficient, g.dot(alone, part))
    rest = g.sub(g.one, g.mul(g.mul(coefficient, coefficient), g.dot(part, part)))
    root = g.call("sqrt", g.add(g.mul(own, own), g.mul(rest, square)))
    return g.div(g.mul(coefficient, square), g.call("max", g.add(own, root), g.constant(TINY)))


def _solved(g: Graph, matrix: list[list[int]], right: list[int]) -> list[int]:
    """Return the solution of a small system near the identity, by elimination without pivoting."""
    size = len(right)
    for k in range(size):
        for i in range(k + 1, size):
            factor = g.div(matrix[i][k], matrix[k][k])
            for j in range(k + 1, size):
                matrix[i][j] = g.sub(matrix[i][j], g.mul(factor, matrix[k][j]))
            right[i] = g.sub(right[i], g.mul(factor, right[k]))
    for k in reversed(range(size)):
        for j in range(k + 1, size):
            right[k] = g.sub(right[k], g.mul(matrix[k][j], right[j]))
        right[k] = g.div(right[k], matrix[k][k])
    return right
