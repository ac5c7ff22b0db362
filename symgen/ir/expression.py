"""Formulas of a mechanism file into the graph: no derivative is needed here, so no SymPy."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.ir.graph import Graph
from symgen.vocabulary.expressions import Expr, Name, Number

_BINARY = {"add": "add", "sub": "sub", "mul": "mul", "div": "div", "pow": "power", "neg": "neg"}


def build(graph: Graph, expression: Expr, names: Mapping[str, int]) -> int:
    """Return the node of `expression`, its names replaced by the nodes in `names`.

    Parameters
    ----------
    graph : Graph
        The graph to build in.
    expression : Expr
        A validated formula.
    names : mapping of str to int
        Node of every name that may appear.

    Raises
    ------
    KeyError
        If a name is not in `names`: the validator has let something through.
    """
    if isinstance(expression, Number):
        return graph.constant(expression.value)
    if isinstance(expression, Name):
        return names[expression.name]
    arguments = [build(graph, a, names) for a in expression.arguments]
    method = _BINARY.get(expression.function)
    if method is not None:
        return int(getattr(graph, method)(*arguments))
    return graph.call(expression.function, *arguments)
