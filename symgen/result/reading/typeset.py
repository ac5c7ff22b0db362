"""Nodes of the graph as formulas: sums of terms that can be broken between lines, none of them wider than a line.

Terms that are used more than once, or too wide, get names and are written once, in `definitions`.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from symgen.base.ir.graph import Graph
from symgen.base.ir.program import DERIVATIVES, table_of_payload
from symgen.derive.formulate.equations import Equations
from symgen.result.reading.boxes import (
    TextBox,
    boxes_apart,
    bracket_box,
    cases_box,
    count_atoms,
    fraction_box,
    function_box,
    is_literal,
    literal_box,
    name_box,
    power_box,
    row_box,
    sign_box,
)
from symgen.result.reading.notations import needs_no_bracket, python
from symgen.result.reading.quantity_names import input_names, python_name
from symgen.result.reading.structure import count_uses, free_names

#: Widest term, in units of the type's size; a line of a document has 44 of them.
TERM = 30.0
#: Shared terms with at most so many names and literals are written out.
SHORT = 3
#: Expressions with more operations, written out without sharing, are named by that number in text.
LONGEST = 1500
_RELATIONS = {"lt": "<", "le": "<=", "gt": ">", "ge": ">=", "step": ">"}
_PYTHON = {"abs": "Abs", "min": "Min", "max": "Max"}
_CONDITIONS = (*_RELATIONS, "and", "or", "not", "defined")


@dataclass(frozen=True, slots=True)
class Term:
    """A product with its sign."""

    negative: bool
    factors: tuple[TextBox, ...]
    below: tuple[TextBox, ...] = ()

    @property
    def box(self) -> TextBox:
        """The product without its sign."""
        above = _product_box(self.factors)
        if not self.below:
            return above
        return fraction_box(above, _product_box(self.below))


def _product_box(factors: Sequence[TextBox]) -> TextBox:
    """Return a product, with a dot between numbers, which would otherwise read as one."""
    if len(factors) == 1:
        return factors[0]
    parts = [factors[0]]
    for before, factor in pairwise(factors):
        parts += [sign_box("*"), factor] if is_literal(before) and is_literal(factor) else [factor]
    return row_box(*parts)


Sum = tuple[Term, ...]


def as_term(box: TextBox) -> Sum:
    """Return a box as a sum of one term."""
    return (Term(False, (box,)),)


def line_of_sum(terms: Sum) -> TextBox:
    """Return a sum in one line."""
    if len(terms) == 1 and not terms[0].negative:
        return terms[0].box
    return row_box(*(part for i, term in enumerate(terms) for part in (*leading_sign(term, i == 0), term.box)))


def leading_sign(term: Term, first: bool) -> tuple[TextBox, ...]:
    """Return the sign before a term; none before a first one that is positive."""
    if first and not term.negative:
        return ()
    return (sign_box("-" if term.negative else "+"),)


class Writer:
    """Writes nodes of a graph, each operation as it is.

    Parameters
    ----------
    graph : Graph
        Holds the nodes.
    inputs : mapping
        Inputs as they are written.
    exact : bool
        Whether numbers have all digits.
    terms : mapping of int to str, optional
        Nodes that have names of their own.
    """

    def __init__(
        self,
        graph: Graph,
        inputs: Mapping[tuple[str, int], TextBox],
        exact: bool = False,
        terms: Mapping[int, str] | None = None,
    ) -> None:
        self.graph, self.inputs, self.exact = graph, inputs, exact
        self._written: dict[int, Sum] = {n: as_term(name_box(text, whole=True)) for n, text in (terms or {}).items()}

    def sum_of_node(self, node: int) -> Sum:
        """Return a node as a sum."""
        if node not in self._written:
            for n in self.graph.required_nodes([node], self._written.__contains__):
                if n not in self._written:
                    self._written[n] = self._terms(n)
        return self._written[node]

    def box_of_node(self, node: int) -> TextBox:
        """Return a node in one line."""
        return line_of_sum(self.sum_of_node(node))

    def definition(self, node: int) -> TextBox:
        """Return a node with a name of its own by its operands."""
        for operand in self.graph.nodes[node].args:
            self.sum_of_node(operand)
        return line_of_sum(self._terms(node))

    def _terms(self, node: int) -> Sum:
        op, args, payload = self.graph.nodes[node]
        if op == "const":
            value = float(payload)  # type: ignore[arg-type]  # a constant's payload is a float
            return (Term(value < 0.0, (literal_box(abs(value), self.exact),)),)
        if op == "input":
            return as_term(self.inputs[self.graph.key(node)])
        sums = [self._written[a] for a in args]
        if op in ("add", "sub"):
            return sums[0] + (sums[1] if op == "add" else _negate_terms(sums[1]))
        if op == "neg":
            return _negate_terms(sums[0])
        if op == "mul":
            return (
                _square_term(sums[0])
                if args[0] == args[1]
                else _product_term(_single_term(sums[0]), _single_term(sums[1])),
            )
        if op == "div":
            above, below = _single_term(sums[0]), _single_term(sums[1])
            signs = above.negative != below.negative
            return (Term(signs, above.factors + below.below, above.below + below.factors),)
        if op == "pow":
            return as_term(power_box(_base_of_power(sums[0]), line_of_sum(sums[1])))
        if op == "where":
            return as_term(cases_box([(line_of_sum(sums[1]), self._condition(args[0])), (line_of_sum(sums[2]), None)]))
        if op in _CONDITIONS:
            return as_term(cases_box([(literal_box(1.0), self._condition(node)), (literal_box(0.0), None)]))
        if op == "table":
            table, what = table_of_payload(payload)
            marks = "'" * DERIVATIVES.index(what)
            return as_term(function_box(table + marks, [line_of_sum(s) for s in sums], python_name(payload)))
        return as_term(function_box(op, [line_of_sum(s) for s in sums], _PYTHON.get(op, "")))

    def _condition(self, node: int) -> TextBox:
        """Return a node, 0 or 1 in the graph, as a condition."""
        op, args, _ = self.graph.nodes[node]
        if op in _RELATIONS:
            return row_box(
                line_of_sum(self._written[args[0]]), sign_box(_RELATIONS[op]), line_of_sum(self._written[args[1]])
            )
        if op in ("and", "or"):
            return row_box(bracket_box(self._condition(args[0])), sign_box(op), bracket_box(self._condition(args[1])))
        if op == "not":
            return row_box(sign_box("not"), bracket_box(self._condition(args[0])))
        if op == "defined":
            return function_box("defined", [line_of_sum(self._written[args[0]])])
        return row_box(line_of_sum(self._written[node]), sign_box("!="), literal_box(0.0))


def text_writer(equations: Equations) -> Callable[[int], str]:
    """Return a function that writes nodes as text that Python and SymPy read, with all digits.

    The number of operations replaces an expression with more than `LONGEST` of them.
    """
    graph = equations.graph
    names = {key: name_box(text, whole=True) for key, text in input_names(equations).items()}
    writer = Writer(graph, names, exact=True)

    def text_of_node(node: int) -> str:
        count = graph.count_tree_operations([node])
        return f"<{count} operations>" if count > LONGEST else python(writer.box_of_node(node))

    return text_of_node


def text_writers_by_terms(
    equations: Equations, terms: Mapping[int, str]
) -> tuple[Callable[[int], str], Callable[[int], str]]:
    """Return functions that write nodes, and definitions of terms, with the names of terms in place of these."""
    names = {key: name_box(text, whole=True) for key, text in input_names(equations).items()}
    writer = Writer(equations.graph, names, exact=True, terms=terms)
    return lambda node: python(writer.box_of_node(node)), lambda node: python(writer.definition(node))


class Typesetter(Writer):
    """Writes nodes of derived equations in terms that are no wider than a line.

    Parameters
    ----------
    equations : Equations
        What was derived.
    ends : iterable of int
        All nodes that will be written.
    named : mapping of int to str
        Nodes with names of their own.
    taken : container of str
        Names that mean something else.

    Attributes
    ----------
    definitions : dict
        Name and sum of each named term, by node, each written with earlier ones.
    """

    def __init__(
        self, equations: Equations, ends: Iterable[int], named: Mapping[int, str], others: Container[str] = ()
    ) -> None:
        self._parameters = boxes_apart(quantity.name for quantity in equations.parameters)
        super().__init__(equations.graph, {key: self.symbol(text) for key, text in input_names(equations).items()})
        self.definitions: dict[int, tuple[TextBox, Sum]] = {}
        self._full: dict[int, Sum] = {}
        self._numbered = free_names(others)
        listed = list(ends)
        used = count_uses(self.graph, listed)
        for node in self.graph.required_nodes(listed):
            self._write(node, used[node], named.get(node))

    def symbol(self, text: str) -> TextBox:
        """Return the name of a quantity as it is typeset: no two parameters alike."""
        return self._parameters.get(text) or name_box(text)

    def name_entry(self, node: int) -> None:
        """Give a node a name unless it has one: for entries of wide matrices."""
        if node not in self.definitions and self.graph.nodes[node].op not in ("const", "input"):
            self._give_name(node, None)

    def names_used(self, nodes: Iterable[int]) -> list[int]:
        """Return the nodes with names that `nodes` are written with, in evaluation order."""
        return [n for n in self.graph.required_nodes(nodes) if n in self.definitions]

    def _write(self, node: int, uses: int, title: str | None) -> None:
        operation = self.graph.nodes[node]
        terms = self._terms(node)
        while operation.args and any(term.box.width > TERM for term in terms):
            wide = [a for a in operation.args if self._can_be_named(a)]
            if not wide or operation.op in ("add", "sub", "neg"):
                break
            self._give_name(max(wide, key=lambda a: line_of_sum(self._written[a]).width), None)
            terms = self._terms(node)
        self._full[node] = self._written[node] = terms
        if operation.op in ("const", "input", "neg", *_CONDITIONS):
            return
        size = sum(count_atoms(term.box) for term in terms)
        if (title is not None and size > 1) or (uses > 1 and size > SHORT):
            self._give_name(node, title)

    def _can_be_named(self, node: int) -> bool:
        return node not in self.definitions and self.graph.nodes[node].op not in ("const", "input", *_CONDITIONS)

    def _give_name(self, node: int, title: str | None) -> None:
        title = title or next(self._numbered)
        self.definitions[node] = name_box(title), self._full[node]
        self._written[node] = as_term(name_box(title))


def _negate_terms(terms: Sum) -> Sum:
    return tuple(replace(term, negative=not term.negative) for term in terms)


def _single_term(terms: Sum) -> Term:
    return terms[0] if len(terms) == 1 else Term(False, (bracket_box(line_of_sum(terms)),))


def _base_of_power(terms: Sum) -> TextBox:
    """Return a sum as the base of a power."""
    simple = len(terms) == 1 and not terms[0].negative and not terms[0].below and len(terms[0].factors) == 1
    box = line_of_sum(terms)
    return box if simple and box.kind in ("name", "bracket", "call") and not needs_no_bracket(box) else bracket_box(box)


def _square_term(terms: Sum) -> Term:
    return Term(False, (power_box(_base_of_power(terms), literal_box(2.0)),))


def _product_term(a: Term, b: Term) -> Term:
    factors = sorted(a.factors + b.factors, key=lambda box: not is_literal(box))
    if len(factors) > 1 and factors[0].kind == "number" and factors[0].text == "1":
        factors = factors[1:]
    return Term(a.negative != b.negative, tuple(factors), a.below + b.below)


def break_lines(terms: Sum, first: float, others: float) -> list[list[TextBox]]:
    """Return the lines of a sum: boxes side by side, signs among them.

    Parameters
    ----------
    terms : Sum
        What is written.
    first, others : float
        Widths of the first line and of those that follow.
    """
    lines: list[list[TextBox]] = [[]]
    left = first
    for i, term in enumerate(terms):
        parts = [*leading_sign(term, i == 0), term.box]
        wide = sum(p.width for p in parts)
        if lines[-1] and wide > left:
            lines.append([])
            left = others
        lines[-1] += parts
        left -= wide
    return lines
