"""Formula text to expression tree, letting through only what is listed here.

The text is cut into tokens first, which refuses every character and word that has no place in a formula; Python's own
grammar then gives the structure, of which a handful of node types is translated. Nothing is ever evaluated.
"""

from __future__ import annotations

import ast
import math
import re
from collections.abc import Mapping
from typing import TYPE_CHECKING

import msgspec

from symgen.base.errors import InputError, quote, suggest
from symgen.base.vocabulary.expressions import (
    FUNCTIONS,
    Call,
    Expr,
    Name,
    Number,
    Reading,
    call,
    readings_in,
)
from symgen.base.vocabulary.measures import Integral
from symgen.describe.formulas.formula_slips import (
    hint_on_commas,
    hint_on_grammar,
    meant_coordinate,
    meant_name,
)
from symgen.describe.formulas.formula_tokens import deepest_bracket, slip_in_tokens
from symgen.describe.formulas.formula_trees import depth_of_tree, fold_choice, fold_logic
from symgen.describe.formulas.identifiers import CALLABLE, INTEGRAL

if TYPE_CHECKING:
    from symgen.describe.formulas.readings import Readings

LONGEST_TEXT = 10_000
DEEPEST = 100
MOST_NODES = 5_000
LARGEST_EXPONENT = 64.0

#: The number of a beam's node between dots, which Python's grammar does not allow.
_NODE = re.compile(r"(?<=[A-Za-z0-9_])\.([0-9]+)(?=\.[A-Za-z])")
_BINARY: Mapping[type, str] = {ast.Add: "add", ast.Sub: "sub", ast.Mult: "mul", ast.Div: "div", ast.Pow: "pow"}
_COMPARE: Mapping[type, str] = {ast.Lt: "lt", ast.LtE: "le", ast.Gt: "gt", ast.GtE: "ge"}


class FormulaNames(msgspec.Struct, frozen=True):
    """Names that a formula may use.

    Parameters
    ----------
    what : str
        The formula in words, for messages: ``"an expression of parameters and t"``.
    plain : mapping of str to str
        Name as written -> name in the tree (they differ for an element's own words, ``length`` -> ``s``).
    coordinates : mapping of str to tuple of str
        Body -> its coordinates and velocities that may be written ``body.coordinate``.
    tables : mapping of str to str
        Tables that may be called -> functions of the tree.
    elsewhere : frozenset of str
        Names that exist, though not in this formula; only the message differs.
    readings : Readings, optional
        Further dotted names: points of bodies, coordinates of joints.
    results : Readings, optional
        What outputs read besides; only the message differs.
    integrals : bool
        Whether ``integral(...)`` may be written.
    hints : mapping of str to str
        Hints on some of the names.
    """

    what: str
    plain: Mapping[str, str] = {}
    coordinates: Mapping[str, tuple[str, ...]] = {}
    tables: Mapping[str, str] = {}
    elsewhere: frozenset[str] = frozenset()
    readings: Readings | None = None
    results: Readings | None = None
    integrals: bool = False
    hints: Mapping[str, str] = {}

    def with_other_names(self, what: str, plain: Mapping[str, str]) -> FormulaNames:
        """Return other plain names with the same `elsewhere` and `hints`."""
        return FormulaNames(what, plain, elsewhere=self.elsewhere, hints=self.hints)


def parse(text: str, names: FormulaNames, where: str, conditions: bool = False) -> Expr:
    """Return the tree of the formula `text`, or raise `InputError` with one sentence about what is wrong.

    Parameters
    ----------
    text : str
        The formula as written.
    names : FormulaNames
        The names it may use.
    where : str
        File and key, for the message.
    conditions : bool
        Whether the formula may be true or false instead of a number.
    """
    return _Reader(names, where).read_formula(text, conditions)


class _Reader:
    """One formula being read, with the data of its messages."""

    def __init__(self, names: FormulaNames, where: str) -> None:
        self.names, self.where, self.nodes = names, where, 0
        self.rows: dict[str, Expr] = {}  # row of a modal body that stands for a name of several

    def formula_error(self, got: str, hint: str = "", expected: str = "") -> InputError:
        return InputError(self.where, expected or self.names.what, got, hint)

    def read_formula(self, text: str, conditions: bool) -> Expr:
        if len(text) > LONGEST_TEXT:
            raise self.formula_error(
                f"{len(text)} characters", expected=f"a formula of at most {LONGEST_TEXT} characters"
            )
        if not text.strip():
            raise self.formula_error("an empty text")
        text = _NODE.sub(r"._\1", text)
        if (slip := slip_in_tokens(text)) is not None:
            raise self.formula_error(*slip)
        if deepest_bracket(text) > DEEPEST:
            raise self.too_deep_error()
        try:
            # A formula may span lines in the file; Python's grammar would take the line end for the formula's.
            tree = ast.parse(re.sub(r"\s", " ", text).strip(), mode="eval")
        except SyntaxError as error:
            near = f" near column {error.offset}" if (error.offset or 0) > 1 else ""
            raise self.formula_error(
                f"{quote(text)}, which is incomplete or has a syntax error{near}", hint_on_grammar(text)
            ) from None
        except (MemoryError, RecursionError, ValueError):
            raise self.too_deep_error() from None
        condition = conditions and _is_condition(tree.body)
        result = self.convert_condition(tree.body, 0) if condition else self.convert_quantity(tree.body, 0)
        if depth_of_tree(result) > DEEPEST:
            raise self.too_deep_error()
        return result

    def too_long_error(self) -> InputError:
        return self.formula_error("more", expected=f"a formula of at most {MOST_NODES} terms")

    def too_deep_error(self) -> InputError:
        expected = f"a formula nested at most {DEEPEST} levels deep"
        return self.formula_error("deeper nesting", "long sums nest as well: group their terms in brackets", expected)

    def convert_node(self, node: ast.expr, depth: int) -> Expr:
        """Translate one node of Python's tree; all other nodes are refused."""
        self.nodes += 1
        if depth > DEEPEST:
            raise self.too_deep_error()
        if self.nodes > MOST_NODES:
            raise self.too_long_error()
        match node:
            case ast.Constant(value=int() | float() as value) if not isinstance(value, bool):
                return Number(float(value))
            case ast.Name(id=name):
                return self.convert_name(name)
            case ast.Attribute() if (path := _dotted_path(node)) is not None:
                return self.convert_dotted_name(path)
            case ast.UnaryOp(op=ast.UAdd(), operand=operand):
                return self.convert_quantity(operand, depth)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return self.folded_call("neg", self.convert_quantity(operand, depth))
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                return self.folded_call("not", self.convert_condition(operand, depth))
            case ast.BinOp(left=left, op=operator, right=right) if type(operator) in _BINARY:
                return self.convert_binary(
                    _BINARY[type(operator)], self.convert_quantity(left, depth), self.convert_quantity(right, depth)
                )
            case ast.BoolOp(op=operator, values=values):
                word = "and" if isinstance(operator, ast.And) else "or"
                return self.fold_chain(word, [self.convert_condition(value, depth) for value in values])
            case ast.Compare(left=left, ops=operators, comparators=others) if all(
                type(o) in _COMPARE for o in operators
            ):
                sides = [self.convert_quantity(left, depth)]
                for other in others:
                    before = self.nodes
                    sides.append(self.convert_quantity(other, depth))
                    if other is not others[-1]:
                        self.nodes += self.nodes - before  # is part of two comparisons
                pairs = zip(operators, sides, sides[1:], strict=False)
                return self.fold_chain("and", [self.folded_call(_COMPARE[type(o)], a, b) for o, a, b in pairs])
            case ast.IfExp(test=test, body=yes, orelse=no):
                return fold_choice(
                    self.convert_condition(test, depth),
                    self.convert_quantity(yes, depth),
                    self.convert_quantity(no, depth),
                )
            case ast.Call(func=ast.Name(id=function), args=arguments, keywords=[]):
                return self.convert_function(function, arguments, depth)
        text = ast.unparse(node)
        raise self.formula_error(f"{quote(text)}, which is no formula", hint_on_commas(text))

    def convert_quantity(self, node: ast.expr, depth: int) -> Expr:
        """Translate a node whose value must be a number."""
        if _is_condition(node):
            text = quote(ast.unparse(node))
            raise self.formula_error(f"the condition {text} in place of a number", "write '1 if ... else 0'")
        return self.convert_node(node, depth + 1)

    def convert_condition(self, node: ast.expr, depth: int) -> Expr:
        """Translate a node whose value must be true or false; constant conditions become the literals 1 and 0."""
        if not _is_condition(node):
            raise self.formula_error(
                f"{quote(ast.unparse(node))} in place of a condition", "a condition has <, <=, > or >="
            )
        return self.convert_node(node, depth + 1)

    def convert_name(self, name: str) -> Expr:
        if name == "pi":
            return Number(math.pi)
        if name in self.names.plain:
            return Name(self.names.plain[name])
        if name in self.names.elsewhere:
            raise self.formula_error(f"'{name}', which has no meaning here", self.names.hints.get(name, ""))
        if name in CALLABLE or name in self.names.tables:
            raise self.formula_error(f"the function '{name}' without its argument", f"write {name}(...)")
        if name in self.names.coordinates:
            listed = ", ".join(f"{name}.{c}" for c in self.names.coordinates[name])
            raise self.formula_error(f"the body '{name}' in place of a number", f"it has {listed}")
        known = [*self.names.plain, "pi"]
        hint = meant_name(name, known, self.names.coordinates) or suggest(name, known)
        raise self.formula_error(f"the unknown name {quote(name)}", hint)

    def convert_dotted_name(self, path: tuple[str, ...]) -> Expr:
        """Return a body's coordinate, or another quantity with a dotted name."""
        text, readings = ".".join(path), self.names.readings
        if text in self.rows:
            return self.rows[text]
        if (node := ".".join(path[:2])) in self.names.coordinates or (
            readings is not None and readings.has_force(node)
        ):
            path = (node, *path[2:])  # a node or an element of a beam
        owner = path[0]
        own = self.names.coordinates.get(owner, ())
        if len(path) == 2 and path[1] in own:
            return Name(text)
        if not self.names.coordinates and readings is None:
            raise self.formula_error(f"'{text}', which has no meaning here")
        owners = self.names.coordinates if readings is None else dict.fromkeys(readings.names_of_owners())
        if owner not in owners:
            what = "body" if readings is None else "body or joint"
            raise self.formula_error(f"the unknown {what} {quote(owner)}", suggest(owner, owners))
        reading = None if readings is None else readings.find_meaning(path, self.where)
        if reading is not None:
            self.refuse_integral(reading, text)
            return reading
        if readings is not None and len(path) == 2 and path[1] in readings.speeds_of(owner):
            raise self.formula_error(f"'{text}', a velocity")
        if (results := self.names.results) is not None and (
            (len(path) == 2 and path[1] in results.accelerations_of(owner)) or results.find_meaning(path, self.where)
        ):
            raise self.formula_error(
                f"'{text}', which follows from all forces and may depend on this formula, a circle",
                f'a state that follows it breaks the circle: [states.filtered] rate = "({text} - filtered)/0.01"',
            )
        names = (*own, *(() if readings is None else readings.names_of(owner, self.where)))
        what = f"{quote('.'.join(path[1:]))}, which {'body ' if own else ''}'{owner}' does not have"
        listed = f"it has {', '.join(names)}" if names else "it has nothing to read"
        near = listed if len(names) <= 20 else suggest(text, [f"{owner}.{k}" for k in names])
        raise self.formula_error(what, meant_coordinate(owner, path[-1], names) or near)

    def refuse_integral(self, reading: Expr, text: str) -> None:
        """Refuse an energy that only outputs integrate, where formulas have no integrals."""
        if not self.names.integrals and any(isinstance(r.source, Integral) for r in readings_in(reading)):
            raise self.formula_error(f"'{text}', an integral", f"a state with the rate '{text}.rate' is the same")

    def convert_binary(self, function: str, left: Expr, right: Expr) -> Expr:
        if function == "pow" and isinstance(right, Number) and abs(right.value) > LARGEST_EXPONENT:
            limit = f"an exponent between -{LARGEST_EXPONENT:.0f} and {LARGEST_EXPONENT:.0f}"
            raise self.formula_error(f"{right.value!r}", expected=limit)
        return self.folded_call(function, left, right)

    def folded_call(self, function: str, *arguments: Expr) -> Expr:
        """Return the call, folded where its arguments are literals, refused where they have no finite value."""
        result = fold_logic(function, arguments) if function in ("and", "or", "not") else call(function, *arguments)
        if isinstance(result, Call) and all(isinstance(a, Number) for a in result.arguments):
            from symgen.describe.formulas.formula_text import to_text

            raise self.formula_error(f"'{to_text(result)}', which has no finite value")
        return result

    def fold_chain(self, function: str, operands: list[Expr]) -> Expr:
        result = operands[0]
        for operand in operands[1:]:
            result = self.folded_call(function, result, operand)
        return result

    def convert_function(self, function: str, nodes: list[ast.expr], depth: int) -> Expr:
        if function in self.names.tables:
            self.check_argument_count(function, nodes, 1)
            return Call(self.names.tables[function], (self.convert_quantity(nodes[0], depth),))
        if function == INTEGRAL and self.names.integrals:
            self.check_argument_count(function, nodes, 1)
            return self.convert_integral(nodes[0], depth)
        if function == INTEGRAL and self.names.readings is not None and self.names.results is None:
            raise self.formula_error("an integral", "a state of its own has the integrand as its rate")
        if function not in CALLABLE:
            if function in self.names.elsewhere:
                hint = self.names.hints.get(function, "")
                raise self.formula_error(f"the table '{function}', which has no meaning here", hint)
            raise self.formula_error(
                f"the unknown function {quote(function)}", suggest(function, [*CALLABLE, *self.names.tables])
            )
        if function == "piecewise":
            return self.convert_piecewise(nodes, depth)
        if function in ("min", "max"):
            several = self.convert_rows(nodes[0], depth) if len(nodes) == 1 else ()
            if several:
                return self.fold_chain(function, several)
            if len(nodes) < 2:
                raise self.formula_error(f"{function}() with {len(nodes)}", expected="two arguments or more")
        else:
            self.check_argument_count(function, nodes, FUNCTIONS[function][0])
        arguments = [self.convert_quantity(node, depth) for node in nodes]
        return (
            self.fold_chain(function, arguments)
            if function in ("min", "max")
            else self.folded_call(function, *arguments)
        )

    def convert_rows(self, node: ast.expr, depth: int) -> list[Expr]:
        """Return a formula once for each row of a name that it reads: ``max(abs(arm.sigma))``; empty without one."""
        readings = self.names.readings
        parts = [] if readings is None else [part for part in ast.walk(node) if isinstance(part, ast.Attribute)]
        for part in parts:
            path = _dotted_path(part)
            if readings is not None and path is not None and len(path) == 2 and readings.rows_called(*path):
                text, rows = ".".join(path), readings.rows_called(*path)
                try:
                    return [self._with_row(text, row, node, depth) for row in rows]
                finally:
                    self.rows.pop(text, None)
        return []

    def _with_row(self, text: str, row: Expr, node: ast.expr, depth: int) -> Expr:
        self.rows[text] = row
        return self.convert_quantity(node, depth)

    def convert_integral(self, node: ast.expr, depth: int) -> Expr:
        """Return the reading of an integral over time."""
        integrand = self.convert_quantity(node, depth)
        if any(isinstance(r.source, Integral) for r in readings_in(integrand)):
            raise self.formula_error("an integral of an integral", "give the inner one an integrand of its own")
        from symgen.describe.formulas.formula_text import to_text

        return Reading(f"{INTEGRAL}({to_text(integrand)})", Integral(integrand))

    def check_argument_count(self, function: str, nodes: list[ast.expr], number: int) -> None:
        if len(nodes) != number:
            expected = "one argument" if number == 1 else f"{number} arguments"
            hint = hint_on_commas(", ".join(map(ast.unparse, nodes)))
            raise self.formula_error(f"{function}() with {len(nodes)}", hint, expected)

    def convert_piecewise(self, nodes: list[ast.expr], depth: int) -> Expr:
        if len(nodes) < 3 or len(nodes) % 2 == 0:
            expected = "piecewise(condition, value, ..., value otherwise)"
            raise self.formula_error(f"{len(nodes)} arguments", expected=expected)
        result = self.convert_quantity(nodes[-1], depth)
        for i in range(len(nodes) - 3, -1, -2):
            result = fold_choice(
                self.convert_condition(nodes[i], depth), self.convert_quantity(nodes[i + 1], depth), result
            )
        return result


def _dotted_path(node: ast.expr) -> tuple[str, ...] | None:
    """Return the parts of a dotted name, None where another expression precedes a dot."""
    parts: list[str] = []
    while isinstance(node, ast.Attribute):
        parts.append(node.attr.lstrip("_"))
        node = node.value
    return (node.id, *reversed(parts)) if isinstance(node, ast.Name) else None


def _is_condition(node: ast.expr) -> bool:
    """Whether the text is a condition; the tree cannot tell, as a folded condition is a plain number."""
    negated = isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not)
    return negated or isinstance(node, ast.Compare | ast.BoolOp)
