"""SymPy into the graph, and formulas of a file into SymPy where a derivative is wanted."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any

import sympy as sp

from symgen.errors import InputError
from symgen.ir.formula import Functions
from symgen.ir.graph import Graph
from symgen.ir.program import of_table
from symgen.vocabulary.expressions import SMOOTH, Call, Expr, Name, Number, Reading
from symgen.vocabulary.functions import ELEMENTARY

_UNARY = {**{getattr(sp, name): name for name in ELEMENTARY}, sp.Abs: "abs", sp.sign: "sign", sp.floor: "floor"}
_RELATIONS = {
    sp.StrictLessThan: "lt",
    sp.LessThan: "le",
    sp.StrictGreaterThan: "gt",
    sp.GreaterThan: "ge",
}


class NotReal(TypeError):
    """SymPy cannot tell that a part of a formula is a real number, and so has no use for it or no real derivative."""


class Translator:
    """Translates SymPy expressions over known symbols into nodes of one graph.

    Common subexpressions over all outputs are taken out by SymPy first (``order="canonical"``), which finds parts
    of sums and products that hash-consing of binary operations alone would miss.
    """

    def __init__(self, graph: Graph, symbols: Mapping[Any, int]) -> None:
        self.graph, self.functions = graph, Functions(graph)
        self.known: dict[Any, int] = dict(symbols)

    def all(self, expressions: Sequence[Any]) -> list[int]:
        """Return the nodes of `expressions`, shared parts computed once."""
        names = sp.numbered_symbols("cse_")
        replacements, reduced = sp.cse([sp.sympify(e) for e in expressions], symbols=names, order="canonical")
        for symbol, expression in replacements:
            self.known[symbol] = self.node(expression)
        return [self.node(e) for e in reduced]

    def node(self, e: Any) -> int:
        """Return the node of one expression."""
        image = self.known.get(e)
        if image is None:
            image = self.known[e] = self._build(e)
        return image

    def _build(self, e: Any) -> int:
        g = self.graph
        if e in (sp.zoo, sp.nan, sp.oo, -sp.oo):
            raise InputError("a formula", "one that is defined somewhere", f"one that is {e} after simplification")
        if e.is_Number or e in (sp.pi, sp.E):
            return g.constant(float(e))
        if e is sp.zoo:
            raise OverflowError("a division by zero")
        if e.is_Add:
            return g.total(self.node(a) for a in e.args)
        if e.is_Mul:
            return self._product(e)
        if e.is_Pow:
            return g.power(self.node(e.base), self.node(e.exp))
        if isinstance(e, sp.Heaviside):  # slope of min and max; which side the kink itself counts to is a convention
            return self.functions.call("step", self.node(e.args[0]), g.zero)
        if isinstance(e, sp.DiracDelta):  # slope of a jump: zero everywhere else
            return g.zero
        if e.func in _UNARY:
            return self.functions.call(_UNARY[e.func], self.node(e.args[0]))
        if e.func in _RELATIONS:
            return self.functions.call(_RELATIONS[e.func], self.node(e.lhs), self.node(e.rhs))
        if isinstance(e, sp.atan2):
            return self.functions.call("atan2", *(self.node(a) for a in e.args))
        if isinstance(e, sp.Max | sp.Min):
            return self._fold("max" if isinstance(e, sp.Max) else "min", e.args)
        if isinstance(e, sp.And | sp.Or):
            return self._fold("and" if isinstance(e, sp.And) else "or", e.args)
        if isinstance(e, sp.Not):
            return self.functions.call("not", self.node(e.args[0]))
        if isinstance(e, sp.Piecewise):
            return self._piecewise(e)
        if isinstance(e, _Table):
            return self.functions.call(f"table:{e.payload}", self.node(e.args[0]))
        if e in (sp.true, sp.false):
            return g.one if e == sp.true else g.zero
        raise NotReal(f"no graph operation for {type(e).__name__}: {e}")

    def _product(self, e: Any) -> int:
        g = self.graph
        above, below = g.one, g.one
        for factor in e.args:
            if factor.is_Pow and factor.exp.is_Number and factor.exp.is_negative:
                below = g.mul(below, g.power(self.node(factor.base), g.constant(-float(factor.exp))))
            else:
                above = g.mul(above, self.node(factor))
        return g.div(above, below)

    def _fold(self, function: str, args: Sequence[Any]) -> int:
        result = self.node(args[0])
        for a in args[1:]:
            result = self.functions.call(function, result, self.node(a))
        return result

    def _piecewise(self, e: Any) -> int:
        *pieces, (last, _) = e.args
        result = self.node(last)
        for value, condition in reversed(pieces):
            result = self.functions.call("where", self.node(condition), self.node(value), result)
        return result


class _Table(sp.Function):  # type: ignore[misc]  # SymPy is untyped
    """An interpolated table or a derivative of it as a SymPy function; subclasses know which."""

    payload = ""


@cache  # SymPy takes two classes for two functions, whatever their names
def table_function(payload: str) -> Any:
    """Return the function with the payload of a table's operation on the graph.

    The slope of straight lines is constant between their points: its own derivative is zero.
    """
    name, what = of_table(payload)
    last = not payload.startswith(SMOOTH) and what == "slope"

    def fdiff(self: Any, argindex: int = 1) -> Any:
        return sp.S.Zero if last else table_function(payload + "'")(self.args[0])

    return type(f"{what.replace('value', 'table')}_{name}", (_Table,), {"payload": payload, "fdiff": fdiff})


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


def to_sympy(expression: Expr, symbols: Mapping[str, Any]) -> Any:
    """Return `expression` as a SymPy expression over `symbols`; only node kinds of the file's own tree reach SymPy.

    Raises
    ------
    NotReal
        If it compares what SymPy knows to be no real number.
    """
    if isinstance(expression, Number):
        return (
            sp.Float(expression.value)
            if expression.value != int_or_none(expression.value)
            else sp.Integer(int(expression.value))
        )
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


def int_or_none(value: float) -> int | None:
    """Return `value` as an int where it is a small whole number: exact exponents keep derivatives polynomial."""
    return int(value) if abs(value) < 1e6 and value == int(value) else None
