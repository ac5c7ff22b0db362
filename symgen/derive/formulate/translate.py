"""Translation of SymPy into the graph, and of formulas of a file into SymPy for differentiation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any

import sympy as sp

from symgen.base.errors import InputError
from symgen.base.ir.formula import GraphFunctions
from symgen.base.ir.graph import Graph
from symgen.base.ir.program import derived_table, table_of_payload
from symgen.base.vocabulary.elementary_functions import ELEMENTARY
from symgen.base.vocabulary.expressions import Call, Expr, Name, Number, Reading

#: Functions of formulas, and operations of the graph with these names, in SymPy's own normal form.
TO_SYMPY: dict[str, Any] = {
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "div": lambda a, b: a / b,
    "pow": lambda a, b: a**b,
    "neg": lambda a: -a,
    "atan2": sp.atan2,
    "abs": sp.Abs,
    "sign": sp.sign,
    "min": sp.Min,
    "max": sp.Max,
    "lt": sp.StrictLessThan,
    "le": sp.LessThan,
    "gt": sp.StrictGreaterThan,
    "ge": sp.GreaterThan,
    "and": sp.And,
    "or": sp.Or,
    "not": sp.Not,
    "where": lambda c, a, b: sp.Piecewise((a, c), (b, True)),
    **{name: getattr(sp, name) for name in ELEMENTARY},
}
#: Function of SymPy -> function of a formula.
_FROM_SYMPY = {function: name for name, function in TO_SYMPY.items() if isinstance(function, type)} | {
    sp.floor: "floor"
}


class NotReal(TypeError):
    """SymPy cannot prove a part of a formula real: it rejects the part or finds no real derivative."""


class Translator:
    """Translates SymPy expressions over known symbols into nodes of one graph.

    SymPy first extracts common subexpressions of all outputs (``order="canonical"``): parts of sums and products
    that hash-consing of binary operations alone would miss.
    """

    def __init__(self, graph: Graph, symbols: Mapping[Any, int]) -> None:
        self.graph, self.functions = graph, GraphFunctions(graph)
        self.nodes: dict[Any, int] = dict(symbols)

    def translate_all(self, expressions: Sequence[Any]) -> list[int]:
        """Return the nodes of `expressions`, shared parts computed once."""
        names = sp.numbered_symbols("cse_")
        replacements, reduced = sp.cse([sp.sympify(e) for e in expressions], symbols=names, order="canonical")
        for symbol, expression in replacements:
            self.nodes[symbol] = self.translate(expression)
        return [self.translate(e) for e in reduced]

    def translate(self, e: object) -> int:
        """Return the node of one expression."""
        image = self.nodes.get(e)
        if image is None:
            image = self.nodes[e] = self._box_expression(e)
        return image

    def _box_expression(self, e: Any) -> int:
        g = self.graph
        if e in (sp.zoo, sp.nan, sp.oo, -sp.oo):
            raise InputError("a formula", "one that is defined somewhere", f"one that is {e} after simplification")
        if e.is_Number or e in (sp.pi, sp.E):
            return g.constant(float(e))
        if e.is_Add:
            return g.sum_of(self.translate(a) for a in e.args)
        if e.is_Mul:
            return self._translate_product(e)
        if e.is_Pow:
            return g.power(self.translate(e.base), self.translate(e.exp))
        if isinstance(e, sp.Heaviside):  # slope of min and max; its value at the kink is a convention
            return self.functions.call("step", self.translate(e.args[0]), g.zero)
        if isinstance(e, sp.DiracDelta):  # slope of a jump: zero everywhere else
            return g.zero
        if e.func in _FROM_SYMPY:
            return self._translate_call(_FROM_SYMPY[e.func], *e.args)
        if isinstance(e, sp.Piecewise):
            return self._translate_piecewise(e)
        if isinstance(e, _Table):
            return self.functions.call(f"table:{e.payload}", self.translate(e.args[0]))
        if e in (sp.true, sp.false):
            return g.one if e == sp.true else g.zero
        raise NotReal(f"no graph operation for {type(e).__name__}: {e}")

    def _translate_product(self, e: Any) -> int:
        g = self.graph
        above, below = g.one, g.one
        for factor in e.args:
            if factor.is_Pow and factor.exp.is_Number and factor.exp.is_negative:
                below = g.mul(below, g.power(self.translate(factor.base), g.constant(-float(factor.exp))))
            else:
                above = g.mul(above, self.translate(factor))
        return g.div(above, below)

    def _translate_call(self, function: str, first: object, *others: object) -> int:
        """Return a function of one or two arguments; with more it is applied from the left."""
        result = self.translate(first)
        if not others:
            return self.functions.call(function, result)
        for other in others:
            result = self.functions.call(function, result, self.translate(other))
        return result

    def _translate_piecewise(self, e: Any) -> int:
        *pieces, (last, _) = e.args
        result = self.translate(last)
        for value, condition in reversed(pieces):
            result = self.functions.call("where", self.translate(condition), self.translate(value), result)
        return result


class _Table(sp.Function):  # type: ignore[misc]  # SymPy is untyped
    """An interpolated table, or its derivative, as a SymPy function; each has a subclass."""

    payload = ""


@cache  # SymPy treats two classes as two functions, whatever their names
def table_function(payload: str) -> Any:
    """Return the SymPy function for the payload of a table's operation on the graph."""
    (name, what), derived = table_of_payload(payload), derived_table(payload)

    def fdiff(self: Any, argindex: int = 1) -> Any:
        return sp.S.Zero if derived is None else table_function(derived)(self.args[0])

    return type(f"{what.replace('value', 'table')}_{name}", (_Table,), {"payload": payload, "fdiff": fdiff})


def to_sympy(expression: Expr, symbols: Mapping[str, Any]) -> Any:
    """Return `expression` as a SymPy expression over `symbols`; SymPy receives node kinds of the file's tree alone.

    Raises
    ------
    NotReal
        If it compares a value that SymPy proves not to be real.
    """
    if isinstance(expression, Number):
        value = expression.value  # whole exponents keep derivatives polynomial
        return sp.Integer(int(value)) if abs(value) < 1e6 and value == int(value) else sp.Float(value)
    if isinstance(expression, Name | Reading):
        return symbols[expression.name]
    assert isinstance(expression, Call), "the tree has four node kinds"
    arguments = [to_sympy(a, symbols) for a in expression.arguments]
    if expression.function.startswith("table:"):
        return table_function(expression.function.removeprefix("table:"))(*arguments)
    try:
        return TO_SYMPY[expression.function](*arguments)
    except (TypeError, ValueError) as error:  # of relations, and of minima and maxima
        raise NotReal(str(error)) from None
