"""Formulas of a mechanism file into the graph: no derivative is needed here, so no SymPy."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from symgen.ir.formula import Functions
from symgen.ir.graph import Graph
from symgen.vocabulary.expressions import Expr, Name, Number, Reading

_ARITHMETIC = {"add": "add", "sub": "sub", "mul": "mul", "div": "div", "pow": "power", "neg": "neg"}


def build(
    graph: Graph, expression: Expr, names: Mapping[str, int], reading: Callable[[Reading], int] | None = None
) -> int:
    """Return the node of `expression`, its names replaced by the nodes in `names`.

    Parameters
    ----------
    graph : Graph
        The graph to build in.
    expression : Expr
        A validated formula.
    names : mapping of str to int
        Node of every name that may appear.
    reading : callable, optional
        Node of a measure's value or rate, where these may appear.

    Raises
    ------
    KeyError
        If a name is not in `names`: the validator has let something through.
    """
    functions = Functions(graph)

    def node(e: Expr) -> int:
        if isinstance(e, Number):
            return graph.constant(e.value)
        if isinstance(e, Name):
            return names[e.name]
        if isinstance(e, Reading):
            if reading is None:
                raise KeyError(e.name)
            return reading(e)
        arguments = [node(a) for a in e.arguments]
        method = _ARITHMETIC.get(e.function)
        return functions.call(e.function, *arguments) if method is None else int(getattr(graph, method)(*arguments))

    return node(expression)
