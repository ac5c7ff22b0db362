"""Drags, which depend on reactions: the forces c with ``c = coefficient |N(c)|``, where N is linear in them.

The reaction of an element is ``N = N0 - sum of c_j n_j``: N0 without drags, n_j of a unit force of element j
along its coordinate, one solution with the factor of the equations. A coefficient has the sign of the element's rate.
For one element the equation is quadratic and has one root of each sign where coefficient |n| < 1. For several it is
solved by Newton's iteration, which doubles the digits. Where reactions have one component whose sign counts, as those
of contacts do, equations are linear; beside others they are linear rows of the same iteration.
"""

from __future__ import annotations

from collections.abc import Sequence

from symgen.base.ir.graph import Graph
from symgen.base.ir.numerics import TINY
from symgen.derive.lower.replay import Nodes

#: Iterations for several elements, from reactions without drags.
_ITERATIONS = 5
#: Where a last correction shows whether more are needed: iterations before it, and its largest part of the forces.
_FEWER, _CONVERGED = 2, 1e-10


def drag_forces(
    g: Graph,
    coefficients: Sequence[int],
    signed: Sequence[bool],
    alone: Sequence[Nodes],
    parts: Sequence[Sequence[Nodes]],
    brief: bool,
) -> tuple[list[int], int | None]:
    """Return the forces c of all elements, and the node that is true where they have not converged.

    Parameters
    ----------
    g : Graph
        Where they become nodes.
    coefficients : sequence of int
        Of the elements, with the signs of their rates.
    signed : sequence of bool
        Whether the sign of the one component of a reaction counts.
    alone : sequence of tuple of int
        N0 of each element.
    parts : sequence of sequence of tuple of int
        For each element the vectors n_j of all of them.
    brief : bool
        Whether as few iterations are enough as usual drags need; else there is no such node.
    """
    if all(signed):
        return _linear_drag_forces(g, coefficients, alone, parts), None
    if len(coefficients) == 1:
        return [_root_of_one(g, coefficients[0], alone[0], parts[0][0])], None
    forces = [g.mul(k, _size_of(g, n, one)) for k, n, one in zip(coefficients, alone, signed, strict=True)]
    factors = list[list[int]]()
    for _ in range(_FEWER if brief else _ITERATIONS):
        total, pressed = _sizes_of_reactions(g, forces, signed, alone, parts)
        slopes = [k if one else g.div(k, size) for k, size, one in zip(coefficients, total, signed, strict=True)]
        along = [(g.one,) if one else n for n, one in zip(pressed, signed, strict=True)]
        matrix = [
            [g.add(g.mul(slope, g.dot(n, each)), g.one if i == j else g.zero) for j, each in enumerate(parts[i])]
            for i, (slope, n) in enumerate(zip(slopes, along, strict=True))
        ]
        factors = _factorise(g, matrix)
        change = _solve_factors(g, factors, _missing_forces(g, coefficients, total, forces))
        forces = [g.add(c, x) for c, x in zip(forces, change, strict=True)]
    if not brief:
        return forces, None
    total, _ = _sizes_of_reactions(g, forces, signed, alone, parts)
    change = _solve_factors(g, factors, _missing_forces(g, coefficients, total, forces))
    allowed = g.mul(g.constant(_CONVERGED**2), g.dot(forces, forces))
    forces = [g.add(c, x) for c, x in zip(forces, change, strict=True)]
    return forces, g.call("lt", allowed, g.dot(change, change))


def _linear_drag_forces(
    g: Graph, coefficients: Sequence[int], alone: Sequence[Nodes], parts: Sequence[Sequence[Nodes]]
) -> list[int]:
    """Return the forces c of all elements with ``c = coefficient N(c)``; parameters as for `drag_forces`."""
    matrix = [
        [g.add(g.mul(k, n), g.one if i == j else g.zero) for j, (n,) in enumerate(parts[i])]
        for i, k in enumerate(coefficients)
    ]
    right = [g.mul(k, n) for k, (n,) in zip(coefficients, alone, strict=True)]
    return _solve_factors(g, _factorise(g, matrix), right)


def length_of_vector(g: Graph, vector: Sequence[int]) -> int:
    """Return the length of a vector; its derivatives at 0 are 0."""
    return g.call("sqrt", g.call("max", g.dot(vector, vector), g.constant(TINY)))


def _size_of(g: Graph, reaction: Nodes, signed: bool) -> int:
    """Return the size of a reaction, or its one component where the sign counts."""
    return reaction[0] if signed else length_of_vector(g, reaction)


def _sizes_of_reactions(
    g: Graph,
    forces: Sequence[int],
    signed: Sequence[bool],
    alone: Sequence[Nodes],
    parts: Sequence[Sequence[Nodes]],
) -> tuple[list[int], list[Nodes]]:
    """Return the sizes of the reactions, and the reactions, with some forces."""
    pressed = [
        tuple(g.sub(x, g.dot(forces, [n[a] for n in each])) for a, x in enumerate(own))
        for own, each in zip(alone, parts, strict=True)
    ]
    return [_size_of(g, n, one) for n, one in zip(pressed, signed, strict=True)], pressed


def _missing_forces(g: Graph, coefficients: Sequence[int], total: Sequence[int], forces: Sequence[int]) -> list[int]:
    """Return what is missing at each force."""
    return [g.sub(g.mul(k, size), c) for k, size, c in zip(coefficients, total, forces, strict=True)]


def _root_of_one(g: Graph, coefficient: int, alone: Nodes, part: Nodes) -> int:
    """Return the root c of ``c^2 = k^2 |N0 - c n|^2`` with the sign of k.

    It is ``k N0^2 / (k N0 n + sqrt((k N0 n)^2 + (1 - k^2 n^2) N0^2))``.
    """
    square, own = g.dot(alone, alone), g.mul(coefficient, g.dot(alone, part))
    rest = g.sub(g.one, g.mul(g.mul(coefficient, coefficient), g.dot(part, part)))
    root = g.call("sqrt", g.add(g.mul(own, own), g.mul(rest, square)))
    return g.div(g.mul(coefficient, square), g.call("max", g.add(own, root), g.constant(TINY)))


def _factorise(g: Graph, matrix: list[list[int]]) -> list[list[int]]:
    """Return the triangular factors of a small matrix near the identity, by elimination without pivoting."""
    factors = [list(line) for line in matrix]
    for k, pivot in enumerate(factors):
        for line in factors[k + 1 :]:
            line[k] = g.div(line[k], pivot[k])
            line[k + 1 :] = [g.sub(x, g.mul(line[k], y)) for x, y in zip(line[k + 1 :], pivot[k + 1 :], strict=True)]
    return factors


def _solve_factors(g: Graph, factors: list[list[int]], right: list[int]) -> list[int]:
    """Return the solution for a right-hand side."""
    x = list(right)
    for k, line in enumerate(factors):
        x[k] = g.sub(x[k], g.dot(line[:k], x[:k]))
    for k in reversed(range(len(x))):
        x[k] = g.div(g.sub(x[k], g.dot(factors[k][k + 1 :], x[k + 1 :])), factors[k][k])
    return x
