"""Changes of position in space: coordinates follow a change of v through N, Euler parameters keep their length.

Planar coordinates change as velocities do, so planar modules need no such functions.
"""

from __future__ import annotations

from symgen.base.ir.graph import Graph
from symgen.base.ir.program import Block, OutputSlot
from symgen.derive.formulate.equations import Equations
from symgen.derive.lower.hoist import Hoister

#: Squared lengths of Euler parameters this far from 1 are not rounding: the state counts as changed.
_ROUNDING = 1e-13


def position_change_blocks(hoister: Hoister, equations: Equations) -> tuple[Block, ...]:
    """Return ``move``, ``turn`` and ``normalise``; no blocks where q changes as v does.

    Notes
    -----
    ``move`` applies the section ``change`` to y: q + N dv, Euler parameters brought back to length 1. ``turn`` does
    the same by the exponential of the rotation vector, for Lie group integrators.
    """
    if not equations.spins:
        return ()
    g = hoister.graph
    change = [g.input("change", j) for j in range(equations.nv)]
    retract = _new_coordinates(g, equations, change, exponential=False)
    exact = _new_coordinates(g, equations, change, exponential=True)
    lengths, outputs = [], list[tuple[OutputSlot, int]]()
    for i, _ in equations.spins:
        e = [g.input("q", i + k) for k in range(4)]
        square = g.dot(e, e)
        lengths.append(g.call("abs", g.sub(square, g.one)))
        outputs += _normalise_parameters(g, i, e, square)
    worst = lengths[0]
    for length in lengths[1:]:
        worst = g.call("max", worst, length)
    return (
        hoister.block_with_hoisted("move", "q + N times `change`, Euler parameters of length 1", retract, ("y", "w")),
        hoister.block_with_hoisted("turn", "q moved by `change`, bodies turned by its exponential", exact, ("y", "w")),
        hoister.block_with_hoisted(
            "normalise",
            "Euler parameters of length 1; 1 where they were not",
            outputs,
            ("y",),
            g.call("lt", g.constant(_ROUNDING), worst),
        ),
    )


def _new_coordinates(
    g: Graph, equations: Equations, change: list[int], exponential: bool
) -> list[tuple[OutputSlot, int]]:
    """Return the new coordinates, body by body in the order of q."""
    outputs: list[tuple[OutputSlot, int]] = []
    starts = dict(equations.spins)
    i = j = 0
    while i < equations.nq:
        if i not in starts:
            outputs.append((OutputSlot("y", i), g.add(g.input("q", i), change[j])))
            i, j = i + 1, j + 1
            continue
        e = [g.input("q", i + k) for k in range(4)]
        half = [g.mul(g.constant(0.5), n) for n in change[j : j + 3]]
        real = g.one
        if exponential:
            real, half = _half_turn_functions(g, half)
        turned = _turn_parameters(g, e, real, half)
        outputs += _normalise_parameters(g, i, turned, g.dot(turned, turned))
        i, j = i + 4, j + 3
    return outputs


def _half_turn_functions(g: Graph, half: list[int]) -> tuple[int, list[int]]:
    """Return cos |h| and h sin |h| / |h| of half a rotation vector; a series near 0, where the quotient is lost."""
    square = g.dot(half, half)
    small = g.call("lt", square, g.constant(1e-4))
    size = g.call("sqrt", g.call("where", small, g.one, square))
    series = g.constant(1.0 / 5040.0)
    for coefficient in (1.0 / 120.0, 1.0 / 6.0, 1.0):
        series = g.sub(g.constant(coefficient), g.mul(square, series))
    factor = g.call("where", small, series, g.div(g.call("sin", size), size))
    return g.call("cos", g.call("sqrt", square)), [g.mul(factor, h) for h in half]


def _turn_parameters(g: Graph, e: list[int], real: int, h: list[int]) -> list[int]:
    """Return the product of Euler parameters e and (real, h): a turn about body axes."""
    a, b, c, d = e
    x, y, z = h
    return [
        g.sub(g.mul(a, real), g.dot((b, c, d), (x, y, z))),
        g.add(g.mul(b, real), g.add(g.mul(a, x), g.sub(g.mul(c, z), g.mul(d, y)))),
        g.add(g.mul(c, real), g.add(g.mul(a, y), g.sub(g.mul(d, x), g.mul(b, z)))),
        g.add(g.mul(d, real), g.add(g.mul(a, z), g.sub(g.mul(b, y), g.mul(c, x)))),
    ]


def _normalise_parameters(g: Graph, first: int, e: list[int], square: int) -> list[tuple[OutputSlot, int]]:
    length = g.div(g.one, g.call("sqrt", square))
    return [(OutputSlot("y", first + k), g.mul(length, n)) for k, n in enumerate(e)]
