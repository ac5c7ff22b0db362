"""Nodes of the graph back to SymPy, for people to read: what is shown is exactly what is compiled.

Nothing is evaluated or simplified on the way but brackets and signs, so each shown operation is one of the graph.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any

import sympy as sp

from symgen.formulate.equations import Equations
from symgen.vocabulary.functions import ELEMENTARY

#: Expressions with more operations, written out without sharing, are named by that number instead.
LONGEST = 1500

_GREEK = {"theta": r"\theta", "omega": r"\omega"}
_RELATIONS = {"lt": sp.StrictLessThan, "le": sp.LessThan, "gt": sp.StrictGreaterThan, "ge": sp.GreaterThan}
_FUNCTIONS: dict[str, Any] = {
    **{name: getattr(sp, name) for name in (*ELEMENTARY, "atan2", "sign")},
    "abs": sp.Abs,
    "floor": sp.floor,
    "min": sp.Min,
    "max": sp.Max,
}


class Display:
    """SymPy expressions, text and LaTeX of the nodes of derived equations.

    Parameters
    ----------
    equations : Equations
        What was derived.
    """

    def __init__(self, equations: Equations) -> None:
        self.equations = equations
        self.graph = equations.graph
        names: dict[tuple[str, int], str] = {("t", 0): "t"}
        for space, quantities in (
            ("q", equations.coordinates),
            ("v", equations.velocities),
            ("p", equations.parameters),
        ):
            names.update({(space, i): quantity.name for i, quantity in enumerate(quantities)})
        names.update({("winding", i): f"turned_{i}" for i in range(len(equations.windings))})
        self.symbols = {key: sp.Symbol(name, real=True) for key, name in names.items()}
        self._latex = {symbol: latex_name(symbol.name) for symbol in self.symbols.values()}
        self._memo: dict[int, Any] = {}

    def expression(self, node: int) -> Any:
        """Return the SymPy expression of a node."""
        for n in self.graph.needed([node]):
            if n not in self._memo:
                self._memo[n] = self._build(n)
        return self._memo[node]

    def text(self, node: int) -> str:
        """Return a node as text that Python and SymPy read."""
        count = self.graph.tree_operations([node])
        if count > LONGEST:
            return f"<{count} operations>"
        return str(sp.sstr(self.expression(node), full_prec=False, order="none"))

    def latex(self, node: int) -> str:
        """Return a node as LaTeX."""
        count = self.graph.tree_operations([node])
        if count > LONGEST:
            return rf"\langle {count}\ \mathrm{{operations}} \rangle"
        return str(sp.latex(self.expression(node), symbol_names=self._latex, order="none", full_prec=False))

    def operations(self, nodes: Iterable[int]) -> dict[str, int]:
        """Return the operations of nodes before and after sharing of common subexpressions."""
        found = list(nodes)
        return {"before": self.graph.tree_operations(found), "after": self.graph.operations(found)}

    def _build(self, node: int) -> Any:
        op, args, payload = self.graph.nodes[node]
        if op == "const":
            return number(float(payload))  # type: ignore[arg-type]  # a constant's payload is a float
        if op == "input":
            return self.symbols[payload]  # type: ignore[index]  # an input's payload is its key
        values = [self._memo[a] for a in args]
        if op == "table":
            return sp.Function(str(payload))(*values)
        if op == "where":
            return sp.Piecewise((values[1], self._condition(args[0])), (values[2], True), evaluate=False)
        if op in _RELATIONS or op in ("and", "or", "not", "step"):
            return sp.Piecewise((sp.Integer(1), self._condition(node)), (sp.Integer(0), True), evaluate=False)
        return _arithmetic(op, values)

    def _condition(self, node: int) -> Any:
        """Return a node, 0 or 1 in the graph, as a condition."""
        op, args, _ = self.graph.nodes[node]
        if op in _RELATIONS:
            return _RELATIONS[op](*(self._memo[a] for a in args), evaluate=False)
        if op == "step":
            return sp.StrictGreaterThan(*(self._memo[a] for a in args), evaluate=False)
        if op in ("and", "or"):
            return {"and": sp.And, "or": sp.Or}[op](*(self._condition(a) for a in args), evaluate=False)
        if op == "not":
            return sp.Not(self._condition(args[0]), evaluate=False)
        return sp.Ne(self._memo[node], 0, evaluate=False)


def _arithmetic(op: str, values: list[Any]) -> Any:
    if op == "add":
        return _sum(*values)
    if op == "sub":
        return _sum(values[0], _negative(values[1]))
    if op == "mul":
        return _product(*values)
    if op == "div":
        return _product(values[0], sp.Pow(values[1], sp.S.NegativeOne, evaluate=False))
    if op == "neg":
        return _negative(values[0])
    if op == "pow":
        return sp.Pow(*values, evaluate=False)
    return _FUNCTIONS[op](*values, evaluate=False)


def _sum(*terms: Any) -> Any:
    """Return a sum without brackets round sums inside."""
    return sp.Add(*(part for term in terms for part in (term.args if term.is_Add else (term,))), evaluate=False)


def _product(*factors: Any) -> Any:
    """Return a product without brackets round products inside, a number in front, a square as such."""
    if len(factors) == 2 and factors[0] == factors[1] and factors[0].is_Symbol:
        return sp.Pow(factors[0], 2, evaluate=False)
    parts = [part for factor in factors for part in (factor.args if factor.is_Mul else (factor,))]
    return sp.Mul(*sorted(parts, key=lambda part: not part.is_Number), evaluate=False)


def _negative(value: Any) -> Any:
    if value.is_Number:
        return -value
    if value.is_Mul and value.args[0].is_Number:
        return sp.Mul(-value.args[0], *value.args[1:], evaluate=False)
    return sp.Mul(sp.S.NegativeOne, value, evaluate=False)


def number(value: float) -> Any:
    """Return a literal that prints with all its digits and no more."""
    return sp.Integer(int(value)) if value == int(value) and abs(value) < 1e15 else sp.Float(repr(value), 17)


def latex_name(name: str) -> str:
    """Return the LaTeX of a name: ``crank.theta`` has the body as index, a parameter stands upright."""
    body, _, quantity = name.rpartition(".")
    if not body:
        return "t" if name == "t" else rf"\mathrm{{{_upright(name)}}}"
    index = rf"\mathrm{{{_upright(body)}}}"
    if quantity in _GREEK:
        return rf"{_GREEK[quantity]}_{{{index}}}"
    found = re.fullmatch(r"([vwe])([xyz0-3])", quantity)
    if found:
        letter = r"\omega" if found[1] == "w" else found[1]
        return rf"{letter}_{{{found[2]},{index}}}"
    return rf"{quantity}_{{{index}}}"


def _upright(name: str) -> str:
    return name.replace("_", r"\_")
