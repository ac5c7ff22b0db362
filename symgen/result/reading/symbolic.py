"""Nodes of the graph as SymPy expressions, for people to compute with, and SymPy expressions as boxes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import reduce
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from symgen.base.errors import InputError
from symgen.base.ir.graph import Graph
from symgen.derive.formulate.equations import Equations
from symgen.derive.formulate.translate import TO_SYMPY, NotReal, Translator, table_function
from symgen.result.reading.boxes import TextBox, matrix_box, name_box, rate_box
from symgen.result.reading.notations import latex
from symgen.result.reading.quantity_names import input_names
from symgen.result.reading.typeset import Writer

_CONDITIONS = {
    **{"lt": sp.StrictLessThan, "le": sp.LessThan, "gt": sp.StrictGreaterThan, "ge": sp.GreaterThan},
    **{"step": sp.StrictGreaterThan, "and": sp.And, "or": sp.Or, "not": sp.Not},
}
#: Functions left unevaluated, since SymPy compares expressions slowly.
_UNEVALUATED = {"floor": sp.floor, "min": sp.Min, "max": sp.Max}


class FileSymbol(sp.Symbol):  # type: ignore[misc]  # SymPy has no types
    """A symbol with a name of the file, which SymPy prints in LaTeX as documents and pages have it."""

    __slots__ = ()

    def _latex(self, printer: object) -> str:
        return latex(name_box(self.name))


class Symbolic:
    """SymPy expressions of the nodes of derived equations, in SymPy's normal form.

    Parameters
    ----------
    equations : Equations
        What was derived.
    named : mapping of int to str, optional
        Nodes that have a name of their own where they are used.
    """

    def __init__(self, equations: Equations, named: Mapping[int, str] | None = None) -> None:
        self.named = {node: FileSymbol(text, real=True) for node, text in (named or {}).items()}
        self.graph = equations.graph
        self.symbols = {key: FileSymbol(text, real=True) for key, text in input_names(equations).items()}
        self._built: dict[int, Any] = {}

    def expression(self, node: int) -> Any:
        """Return the SymPy expression of a node."""
        self._build_all([node])
        return self._built[node]

    def definition(self, node: int) -> Any:
        """Return the SymPy expression of a node that has a name."""
        self._build_all(self.graph.nodes[node].args)
        return self._build_node(node)

    def _build_all(self, nodes: Iterable[int]) -> None:
        """Build what nodes are written with: as far as the next nodes with names."""
        for n in self.graph.required_nodes(nodes, self.named.__contains__):
            if n not in self._built:
                self._built[n] = self.named.get(n) or self._build_node(n)

    def _build_node(self, node: int) -> Any:
        op, args, payload = self.graph.nodes[node]
        if op == "const":
            return exact_literal(float(payload))  # type: ignore[arg-type]  # a constant's payload is a float
        if op == "input":
            return self.symbols[self.graph.key(node)]
        values = [self._built[a] for a in args]
        if op == "table":
            return table_function(str(payload))(*values)
        if op == "where":
            return sp.Piecewise((values[1], self._condition(args[0])), (values[2], True), evaluate=False)
        if op in _UNEVALUATED:
            return _UNEVALUATED[op](*values, evaluate=False)
        if op in _CONDITIONS or op == "defined":
            return sp.Piecewise((sp.Integer(1), self._condition(node)), (sp.Integer(0), True), evaluate=False)
        return TO_SYMPY[op](*values)

    def _condition(self, node: int) -> Any:
        """Return a node, 0 or 1 in the graph, as a condition."""
        op, args, _ = self.graph.nodes[node]
        if op == "defined":  # what is no number differs from itself
            return sp.Eq(self._built[args[0]], self._built[args[0]], evaluate=False)
        if op not in _CONDITIONS:
            return sp.Ne(self._built[node], 0, evaluate=False)
        operand = self._condition if op in ("and", "or", "not") else self._built.__getitem__
        return _CONDITIONS[op](*map(operand, args), evaluate=False)


def exact_literal(value: float) -> Any:
    """Return a literal that prints with all its digits and no more."""
    return sp.Integer(int(value)) if value == int(value) and abs(value) < 1e15 else sp.Float(repr(value), 17)


class Boxed(Translator):
    """Boxes of SymPy expressions, with names for functions that are no operations of the graph."""

    def __init__(self) -> None:
        super().__init__(Graph(), {})
        self.functions = self.graph  # type: ignore[assignment]  # each function as it is, undefined where it may be
        self._names: dict[tuple[str, int], TextBox] = {}
        self._writer = Writer(self.graph, self._names, exact=True)

    def box(self, value: object) -> TextBox:
        """Return an expression or a matrix, with all digits of numbers."""
        if isinstance(value, sp.MatrixBase):
            return matrix_box([[self.box(x) for x in line] for line in value.tolist()])
        return self._writer.box_of_node(self.translate(value))

    def _box_expression(self, e: object) -> int:
        if isinstance(e, sp.Eq) and e.lhs == e.rhs:  # what is no number differs from itself
            return self.graph.call("defined", self.translate(e.lhs))
        if isinstance(e, sp.Ne) and e.rhs == 0:
            return self.translate(e.lhs)
        try:
            return super()._box_expression(e)
        except (NotReal, InputError):
            key = "name", len(self._names)
            self._names[key] = _name_of_expression(e)
            return self.graph.input(*key)


def _name_of_expression(e: object) -> TextBox:
    if isinstance(e, sp.Derivative) and {str(x) for x in e.variables} == {"t"}:
        return reduce(lambda box, _: rate_box(box), e.variables, _name_of_expression(e.expr))
    return name_box(e.func.__name__ if isinstance(e, AppliedUndef) else str(e))
