"""Nodes of the graph back to SymPy, for people to read: what is shown is exactly what is compiled.

Nothing is evaluated or simplified on the way but brackets and signs, so each shown operation is one of the graph. Where
people go on to compute with the expressions, SymPy's automatic evaluation puts them into its own normal form.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

import sympy as sp
from sympy.printing.str import StrPrinter

from symgen.formulate.equations import Equations
from symgen.formulate.translate import table_function
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
#: Operations that SymPy's own arithmetic does well; minima, and conditions, are left as they are.
_EVALUATED: dict[str, Any] = {
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "div": lambda a, b: a / b,
    "neg": lambda a: -a,
    "pow": lambda a, b: a**b,
    "abs": sp.Abs,
    **{name: getattr(sp, name) for name in ELEMENTARY},
}


class _Text(StrPrinter):  # type: ignore[misc]  # SymPy is untyped
    """Prints products with a negative number in front as those of the positive one with a sign.

    SymPy takes them for sums where it decides about brackets, and leaves these out round a product below: there would
    be ``-2*3*x/y*z`` for ``-2*3*x/(y*z)``.
    """

    def _print_Mul(self, expr: Any) -> str:
        first, *others = expr.args
        if first.is_Number and first.is_negative and any(map(_is_literal, others)):
            return f"-{super()._print_Mul(sp.Mul(-first, *others, evaluate=False))}"
        return str(super()._print_Mul(expr))


def _is_literal(part: Any) -> bool:
    """Whether a factor is a number, or a power of whole ones, that SymPy leaves as it is in products."""
    return bool(part.is_Number or (part.is_Pow and all(x.is_Integer for x in part.args)))


class Display:
    """SymPy expressions, text and LaTeX of the nodes of derived equations.

    Parameters
    ----------
    equations : Equations
        What was derived.
    evaluated : bool
        Whether sums and products are put into SymPy's normal form.
    named : mapping of int to str, optional
        Nodes that stand under a name of their own where they are used.
    """

    def __init__(self, equations: Equations, evaluated: bool = False, named: Mapping[int, str] | None = None) -> None:
        self.equations, self.evaluated = equations, evaluated
        self.named = {node: sp.Symbol(name, real=True) for node, name in (named or {}).items()}
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
        for n in self.below([node]):
            if n not in self._memo:
                self._memo[n] = self.named.get(n) or self._build(n)
        return self._memo[node]

    def definition(self, node: int) -> Any:
        """Return the SymPy expression of a node that has a name."""
        for n in self.below(self.graph.nodes[node].args):
            if n not in self._memo:
                self._memo[n] = self.named.get(n) or self._build(n)
        return self._build(node)

    def below(self, nodes: Iterable[int]) -> list[int]:
        """Return what `nodes` are written with, in evaluation order: as far as the next nodes with names."""
        seen: set[int] = set()
        waiting = list(nodes)
        while waiting:
            node = waiting.pop()
            if node not in seen:
                seen.add(node)
                if node not in self.named:
                    waiting.extend(self.graph.nodes[node].args)
        return sorted(seen)

    def text(self, node: int) -> str:
        """Return a node as text that Python and SymPy read."""
        count = self.graph.tree_operations([node])
        if count > LONGEST:
            return f"<{count} operations>"
        return str(_Text({"full_prec": False, "order": "none"}).doprint(self.expression(node)))

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
            return table_function(str(payload))(*values)
        if op == "where":
            return sp.Piecewise((values[1], self._condition(args[0])), (values[2], True), evaluate=False)
        if op in _RELATIONS or op in ("and", "or", "not", "step", "defined"):
            return sp.Piecewise((sp.Integer(1), self._condition(node)), (sp.Integer(0), True), evaluate=False)
        if self.evaluated and op in _EVALUATED:
            return _EVALUATED[op](*values)
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
        if op == "defined":  # what is no number differs from itself
            return sp.Eq(self._memo[args[0]], self._memo[args[0]], evaluate=False)
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
    letter = quantity if len(quantity) == 1 else rf"\mathrm{{{_upright(quantity)}}}"
    return rf"{letter}_{{{index}}}"


def _upright(name: str) -> str:
    return name.replace("_", r"\_")
