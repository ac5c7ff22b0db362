"""Arithmetic on rates at the eight nodes of a step: element i of a state is at ``8 i + node``.

`rows` has the number of state elements with unknown rates, then these, then for each of them the index of the
coordinate whose rate is that element, a velocity, or -1. `first` holds rates at the start of the step, `table`
coefficients of `symgen.run.integrators.picard`, in rows of eight.

These are the plain loops; `symgen.compile.loopcode.node_code` has the vector code.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from symgen.compile.native import types
from symgen.compile.native.annotations import Array, Integers
from symgen.compile.native.compiler import is_interpreted
from symgen.compile.native.pieces import piece_of
from symgen.compile.native.types import NODES

_Function = TypeVar("_Function", bound=Callable[..., Any])

#: Number of rates in a step: at its start and at its nodes.
POINTS = NODES + 1
#: First indices of the parts of `table`: the integrals of a polynomial through the rates up to each node, the second
#: integrals, and the nodes themselves.
INTEGRALS, DOUBLED, PLACES = 0, POINTS * NODES, 2 * POINTS * NODES
#: Room for Legendre coefficients of a rate, and the first index of the second part of the table of `refine`.
TERMS, CORRECTIONS = 2 * NODES, POINTS * NODES


def _place(h: float, rows: Integers, y: Array, first: Array, rates: Array, table: Array, out: Array) -> None:
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


def _extrapolate(rows: Integers, degree: int, ratio: float, places: Array, coefficients: Array, out: Array) -> None:
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


def _distance(rows: Integers, weights: Array, share: Array, rates: Array, before: Array) -> float:
    """Return the sum of weighted squares of differences between rates; `share` has the weights of the nodes."""
    total = 0.0
    for c in range(1, rows[0] + 1):
        i = rows[c]
        for k in range(NODES):
            difference = rates[i * NODES + k] - before[i * NODES + k]
            total += share[k] * weights[i] * difference * difference
    return total


def _expand(
    rows: Integers, weights: Array, first: Array, rates: Array, table: Array, out: Array, squares: Array
) -> None:
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


def _refine(rows: Integers, table: Array, coefficients: Array, more: Array, out: Array) -> None:
    """Set `out` to Legendre `coefficients`, corrected by the rates `more` at points between the nodes.

    `table` has the polynomials at these points, then the coefficients of those that are 1 at one of these points and 0
    at all others and at the nodes.
    """
    for c in range(1, rows[0] + 1):
        first = TERMS * rows[c]
        for k in range(TERMS):
            out[first + k] = coefficients[first + k]
        for p in range(NODES):
            left = more[NODES * rows[c] + p]
            for k in range(POINTS):
                left -= table[k * NODES + p] * coefficients[first + k]
            for k in range(TERMS):
                out[first + k] += table[CORRECTIONS + p * TERMS + k] * left


def _integrate_legendre(terms: int, x: Array, once: Array, twice: Array) -> None:
    """Set `once` and `twice` to integrals and second integrals of shifted Legendre polynomials from 0 to eight `x`.

    The integral of P_k on (0, 1) is (P_k+1 - P_k-1) / (4 k + 2), the second one likewise.
    """
    for o in range(NODES):
        z = 2.0 * x[o] - 1.0
        lower, here, last, now = 1.0, z, 0.0, x[o]
        once[o], twice[o] = x[o], 0.5 * x[o] * x[o]
        for k in range(1, terms + 1):
            upper = ((2 * k + 1) / (k + 1)) * z * here - (k / (k + 1)) * lower
            last, before, now = now, last, (upper - lower) / (4 * k + 2)
            if k < terms:
                once[k * NODES + o] = now
            if k > 1:
                twice[(k - 1) * NODES + o] = (now - before) / (4 * k - 2)
            lower, here = here, upper


def _sum_up(
    h: float, terms: int, x: Array, rows: Integers, y: Array, coefficients: Array, once: Array, twice: Array, out: Array
) -> None:
    """Set `out` to the states at eight parts `x` of a step, from Legendre coefficients and integrals."""
    count = rows[0]
    for c in range(1, count + 1):
        i, q = rows[c], rows[c + count]
        for o in range(NODES):
            velocity = place = 0.0
            for k in range(terms):
                velocity += coefficients[TERMS * i + k] * once[k * NODES + o]
                place += coefficients[TERMS * i + k] * twice[k * NODES + o]
            out[i * NODES + o] = y[i] + h * velocity
            if q >= 0:
                out[q * NODES + o] = y[q] + h * x[o] * y[i] + h * h * place


PLAIN: dict[str, Callable[..., Any]] = {
    **{"place": _place, "extrapolate": _extrapolate, "distance": _distance},
    **{"expand": _expand, "refine": _refine, "integrate_legendre": _integrate_legendre, "sum_up": _sum_up},
}


def _nodes(name: str, plain: _Function, result: types.NumberType = types.void) -> _Function:
    """Return one of these functions in the form for the present compiler."""
    return plain if is_interpreted() else piece_of(name, plain, result, "symgen.compile.loopcode.node_code")


place, extrapolate = _nodes("place", _place), _nodes("extrapolate", _extrapolate)
distance = _nodes("distance", _distance, types.float64)
expand, refine = _nodes("expand", _expand), _nodes("refine", _refine)
integrate_legendre, sum_up = _nodes("integrate_legendre", _integrate_legendre), _nodes("sum_up", _sum_up)
