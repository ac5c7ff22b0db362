"""Arithmetic on rates at the eight nodes of a step: element i of a state is at ``8 i + node``.

`rows` has the number of state elements with unknown rates, then these, then for each of them the index of the
coordinate whose rate is that element, a velocity, or -1. `first` holds rates at the start of the step, `table`
coefficients of `symgen.integrators.picard`, in rows of eight.

These are the plain loops; `symgen.loopcode.node_code` has the vector code.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from symgen.native import types
from symgen.native.compiler import interpreted
from symgen.native.pieces import Piece
from symgen.native.types import NODES

#: Number of rates in a step: at its start and at its nodes.
POINTS = NODES + 1
#: First indices of the parts of `table`: the integrals of a polynomial through the rates up to each node, the second
#: integrals, and the nodes themselves.
INTEGRALS, DOUBLED, PLACES = 0, POINTS * NODES, 2 * POINTS * NODES


def _place(h: float, rows: Any, y: Any, first: Any, rates: Any, table: Any, out: Any) -> None:
    """Set `out` to the states at the nodes: the integral of a polynomial through the rates."""
    count = rows[0]
    for c in range(1, count + 1):
        i, q = rows[c], rows[c + count]
        for k in range(NODES):
            once, twice = table[INTEGRALS + k] * first[i], table[DOUBLED + k] * first[i]
            for p in range(NODES):
                once += table[INTEGRALS + (p + 1) * NODES + k] * rates[i * NODES + p]
                twice += table[DOUBLED + (p + 1) * NODES + k] * rates[i * NODES + p]
            out[i * NODES + k] = y[i] + h * once
            if q >= 0:
                out[q * NODES + k] = y[q] + h * table[PLACES + k] * y[i] + h * h * twice


def _extrapolate(rows: Any, degree: int, ratio: float, places: Any, coefficients: Any, out: Any) -> None:
    """Set `out` to rates at the nodes of a step `ratio` times as long as the step of the Legendre `coefficients`."""
    for k in range(NODES):
        x = 1.0 + 2.0 * ratio * places[k]
        for c in range(1, rows[0] + 1):
            i = rows[c]
            total, before, here = coefficients[2 * NODES * i], 1.0, x
            for p in range(1, degree + 1):
                total += coefficients[2 * NODES * i + p] * here
                before, here = here, ((2 * p + 1) * x * here - p * before) / (p + 1)
            out[i * NODES + k] = total


def _distance(rows: Any, weights: Any, share: Any, rates: Any, before: Any) -> float:
    """Return the sum of weighted squares of differences between rates; `share` has the weights of the nodes."""
    total = 0.0
    for c in range(1, rows[0] + 1):
        i = rows[c]
        for k in range(NODES):
            difference = rates[i * NODES + k] - before[i * NODES + k]
            total += share[k] * weights[i] * difference * difference
    return total


def _expand(rows: Any, weights: Any, first: Any, rates: Any, table: Any, out: Any, squares: Any) -> None:
    """Set `out` to Legendre coefficients of rates, sixteen for each, `squares` to weighted sums of their squares."""
    for k in range(2 * NODES):
        squares[k] = 0.0
    for c in range(1, rows[0] + 1):
        i = rows[c]
        for k in range(2 * NODES):
            total = table[k] * first[i]
            for p in range(NODES):
                total += table[2 * NODES * (p + 1) + k] * rates[i * NODES + p]
            out[2 * NODES * i + k] = total
            squares[k] += weights[i] * total * total


def _sum_up(
    h: float, x: float, rows: Any, y: Any, first: Any, rates: Any, more: Any, once: Any, twice: Any, out: Any
) -> None:
    """Set `out` to the state at the part `x` of a step.

    `once` and `twice` are weights of the rates for integrals and second integrals: those at the nodes, those of `more`,
    then that at the start.
    """
    count = rows[0]
    for c in range(1, count + 1):
        i, q = rows[c], rows[c + count]
        velocity, place = once[2 * NODES] * first[i], twice[2 * NODES] * first[i]
        for k in range(NODES):
            velocity += once[k] * rates[i * NODES + k] + once[NODES + k] * more[i * NODES + k]
            place += twice[k] * rates[i * NODES + k] + twice[NODES + k] * more[i * NODES + k]
        out[i] = y[i] + h * velocity
        if q >= 0:
            out[q] = y[q] + h * x * y[i] + h * h * place


PLAIN: dict[str, Callable[..., Any]] = {
    **{"place": _place, "extrapolate": _extrapolate, "distance": _distance},
    **{"expand": _expand, "sum_up": _sum_up},
}


def _function(name: str) -> Any:
    """Return one of these functions in the form for the present compiler."""
    result = types.float64 if name == "distance" else types.void
    return PLAIN[name] if interpreted() else Piece(name, PLAIN[name], result, "symgen.loopcode.node_code")


place, extrapolate, distance = _function("place"), _function("extrapolate"), _function("distance")
expand, sum_up = _function("expand"), _function("sum_up")
