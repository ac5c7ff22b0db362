"""Derivatives of formulas: motions of rows and drivers over time and parameters, and potentials.

SymPy differentiates. It treats every part of a formula as complex unless it can prove it real: the derivative of
``abs(log(t))`` has real and imaginary parts, and a condition on a choice between numbers is invalid. Where its
result is not real, the rules of the graph are applied instead, operation by operation.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import sympy as sp

from symgen.base.ir.derivative import jacobian
from symgen.base.vocabulary.expressions import Expr, names_in_expression
from symgen.derive.formulate.equations import DriverPower
from symgen.derive.formulate.translate import NotReal, Translator, to_sympy

if TYPE_CHECKING:
    from collections.abc import Mapping

    from symgen.base.ir.graph import Graph
    from symgen.derive.formulate.measure_nodes import ModelNodes
    from symgen.describe.spanning_tree import Topology


def symbols_of_names(e: Expr, *placeholders: str) -> dict[str, Any]:
    """Return a symbol for each name of a formula and each placeholder."""
    return {
        n: sp.Symbol(f"x{i}", real=True) for i, n in enumerate(dict.fromkeys([*placeholders, *names_in_expression(e)]))
    }


def translate_expressions(
    model: ModelNodes, symbols: dict[str, Any], expressions: list[Any], **nodes: int
) -> list[int]:
    """Return the nodes of SymPy expressions over symbols of names; placeholders stand for `nodes`."""
    images = {symbol: nodes[n] if n in nodes else model.names[n] for n, symbol in symbols.items()}
    return Translator(model.graph, images).translate_all(expressions)


def time_function(model: ModelNodes, e: Expr) -> tuple[int, int, int]:
    """Return the value and the first two time derivatives of a formula of t and parameters."""
    g = model.graph
    if "t" not in names_in_expression(e):
        return model.expression(e), g.zero, g.zero
    symbols = symbols_of_names(e)
    t = symbols["t"]
    try:
        formula = to_sympy(e, symbols)
        first = sp.diff(formula, t)
        nodes = translate_expressions(model, symbols, [formula, first, sp.diff(first, t)])
        return nodes[0], nodes[1], nodes[2]
    except NotReal:
        value = model.expression(e)
        slope = _slope_of_node(g, value, ("t", 0))
        return value, slope, _slope_of_node(g, slope, ("t", 0))


def slope_and_potential(model: ModelNodes, e: Expr, s: int) -> tuple[int, int]:
    """Return -dU/ds and U of a formula U of parameters and ``s``, the node `s`."""
    symbols = symbols_of_names(e, "s")
    try:
        potential = to_sympy(e, symbols)
        force, energy = translate_expressions(model, symbols, [-sp.diff(potential, symbols["s"]), potential], s=s)
        return force, energy
    except NotReal:
        g, key = model.graph, ("s", 0)
        value = model.expression(e, s=g.input(*key))
        energy, slope = g.replace_inputs([value, _slope_of_node(g, value, key)], {key: s})
        return g.neg(slope), energy


def _slope_of_node(g: Graph, node: int, key: tuple[str, int]) -> int:
    """Return the derivative of a node with respect to an input, by the rules of the graph."""
    return jacobian(g, [node], [key])[0].get(key, g.zero)


class Coordinate(NamedTuple):
    """A coordinate of a tree as nodes, with its rate and the prescribed part of its acceleration.

    `number` is the index of its velocity in the state, below 0 where a driver prescribes it; then `acceleration` is the
    complete acceleration, else 0.
    """

    number: int
    value: int
    rate: int
    acceleration: int


def prescribed_coordinates(model: ModelNodes, topology: Topology) -> dict[tuple[str, str], Coordinate]:
    """Return the coordinates that drivers prescribe, by body and label."""
    g, coordinates = model.graph, dict[tuple[str, str], Coordinate]()
    for k, x in enumerate(topology.prescribed):
        sign = g.constant(x.sign)
        nodes = (g.mul(sign, node) for node in time_function(model, x.value))
        coordinates[x.body, x.label] = Coordinate(-1 - k, *nodes)
    return coordinates


def power_of_drivers(
    graph: Graph,
    coordinates: Mapping[int, Coordinate],
    mass: Mapping[tuple[int, int], int],
    forces: Mapping[int, int],
) -> DriverPower | None:
    """Return the power of drivers from their rows of M and f, None without drivers."""
    driven = {i: c for i, c in coordinates.items() if i < 0}
    if not driven:
        return None
    entries, rest = dict[int, int](), graph.zero
    for i, c in sorted(driven.items(), reverse=True):
        rest = graph.sub(rest, graph.mul(c.rate, forces[i]))
        for (row, j), node in sorted(mass.items()):
            if row == i and j >= 0:
                entries[j] = graph.add(entries.get(j, graph.zero), graph.mul(c.rate, node))
    return DriverPower(tuple(sorted(entries.items())), rest)
