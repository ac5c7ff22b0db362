"""Expressions of emitted functions in the language of `symgen.compile.native.language`; see `read.py`."""

from __future__ import annotations

import ast
import builtins
import math
import types
from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any, cast

import numpy as np

from symgen.compile.native import language as lang

#: Functions of ``math`` that return an integer.
_INTEGER = ("floor", "ceil")
_ARITHMETIC = {ast.Add: "add", ast.Sub: "sub", ast.Mult: "mul", ast.Div: "div", ast.FloorDiv: "floordiv"}
_ARITHMETIC |= {ast.Mod: "mod", ast.Pow: "pow", ast.BitAnd: "and", ast.BitOr: "or"}
_COMPARISONS = {ast.Lt: "lt", ast.LtE: "le", ast.Gt: "gt", ast.GtE: "ge", ast.Eq: "eq", ast.NotEq: "ne"}
_RANK = {"bool": 0, "int": 1, "float": 2}
#: Powers with a literal exponent become products up to this one.
_LARGEST_EXPONENT = 64

Kind = tuple[lang.Scalar, bool]  # type of a number or of an array's elements, and whether it is an array


class Foreign(Exception):
    """Code outside the language, and its place."""

    def __init__(self, what: str, node: ast.AST | None = None) -> None:
        super().__init__(what + (f" (line {node.lineno})" if isinstance(node, ast.stmt | ast.expr) else ""))


class ValueReader(ABC):
    """Reads the expressions of one function.

    Attributes
    ----------
    globals, locals : mapping, frozenset
        Names of the module, and of the function itself.
    parameters : tuple of Parameter
        Arguments; by name, arrays are in `arrays`, the others in `numbers`.
    variables : dict
        Types of the local variables assigned so far.
    tables, called : dict
        Constant arrays and functions read so far.
    """

    def __init__(self, function: Any, parameters: tuple[lang.FunctionParameter, ...]) -> None:
        self.globals: Mapping[str, Any] = function.py_func.__globals__
        self.locals = frozenset(function.py_func.__code__.co_varnames)
        self.parameters = parameters
        self.arrays = {p.name: p.type for p in parameters if p.array}
        self.numbers: dict[str, lang.Scalar] = {p.name: p.type for p in parameters if not p.array and not p.address}
        self.variables: dict[str, lang.Scalar] = {}
        self.tables: dict[str, tuple[float, ...]] = {}
        self.called: dict[tuple[object, tuple[Kind, ...]], lang.Function] = {}

    @abstractmethod
    def read(self, called: object, kinds: tuple[Kind, ...]) -> lang.Function:
        """Return a function that this one calls."""

    def expression(self, node: ast.expr) -> lang.Expression:
        """Return the value of an expression."""
        method = self._expressions.get(type(node))
        if method is None:
            raise Foreign(f"an expression '{type(node).__name__}'", node)
        value: lang.Expression = getattr(self, method)(node)
        return value

    def constant(self, node: ast.Constant) -> lang.Expression:
        """Return a literal."""
        return number_value(node.value, node)

    def name(self, node: ast.Name) -> lang.Expression:
        """Return a variable, an argument, or a number of the module."""
        name = node.id
        if name in self.variables:
            return lang.Variable(self.variables[name], name)
        if name in self.numbers:
            return lang.Variable(self.numbers[name], name)
        if name in self.locals or name not in self.globals:
            raise Foreign(f"the name '{name}'", node)
        return number_value(self.globals[name], node)

    def attribute(self, node: ast.Attribute) -> lang.Expression:
        """Return a constant of ``math``."""
        if self.is_of_math(node) and node.attr in ("inf", "pi", "nan", "e", "tau"):
            return lang.Constant("float", getattr(math, node.attr))
        raise Foreign("an attribute", node)

    def element(self, node: ast.Subscript) -> lang.Expression:
        """Return an element of an array."""
        array, index = self.place(node)
        return lang.ArrayElement(self.arrays.get(array, "float"), array, index)

    def place(self, node: ast.Subscript) -> tuple[str, lang.Expression]:
        """Return array and index of an element."""
        if not isinstance(node.value, ast.Name):
            raise Foreign("an element of an expression", node)
        name, index = node.value.id, self.expression(node.slice)
        if name not in self.arrays:
            self.tables[name] = _constant_array(self.globals.get(name), node)
        if index.type != "int" or (isinstance(index, lang.Constant) and index.value < 0):
            raise Foreign("an index", node)
        return name, index

    def unary(self, node: ast.UnaryOp) -> lang.Expression:
        """Return an operation on one value."""
        value = self.expression(node.operand)
        if isinstance(node.op, ast.Not):
            return lang.ScalarOperation("bool", "not", (truth_value_of(value),))
        if isinstance(node.op, ast.UAdd) and value.type != "bool":
            return value
        if isinstance(node.op, ast.USub) and value.type != "bool":
            if isinstance(value, lang.Constant):
                return lang.Constant(value.type, -value.value)
            return lang.ScalarOperation(value.type, "neg", (value,))
        raise Foreign("an operation", node)

    def binary(self, node: ast.BinOp) -> lang.Expression:
        """Return an operation on two values."""
        sign = self.operation_name(node)
        return self.arithmetic(sign, self.expression(node.left), self.expression(node.right), node)

    def operation_name(self, node: ast.BinOp | ast.AugAssign) -> str:
        """Return the name of an operation."""
        sign = _ARITHMETIC.get(type(node.op))
        if sign is None:
            raise Foreign("an operation", node)
        return sign

    def arithmetic(self, sign: str, left: lang.Expression, right: lang.Expression, node: ast.AST) -> lang.Expression:
        """Return an operation on two values of one type."""
        if sign in ("and", "or"):
            if left.type == right.type != "float":
                return lang.ScalarOperation(left.type, sign, (left, right))
            raise Foreign("an operation on bits", node)
        if sign == "pow":
            return _read_power(left, right, node)
        kind: lang.Scalar = "float" if "float" in (left.type, right.type) or sign == "div" else "int"
        if sign in ("floordiv", "mod") and (kind != "int" or not isinstance(right, lang.Constant) or right.value <= 0):
            raise Foreign("a division with rest", node)
        return lang.ScalarOperation(kind, sign, (as_type(kind, left), as_type(kind, right)))

    def comparison(self, node: ast.Compare) -> lang.Expression:
        """Return a comparison of two values."""
        if len(node.ops) > 1:
            raise Foreign("a comparison", node)
        return self.compare_values(node.ops[0], self.expression(node.left), self.expression(node.comparators[0]), node)

    def compare_values(
        self, op: ast.cmpop, left: lang.Expression, right: lang.Expression, node: ast.AST
    ) -> lang.Expression:
        """Return a comparison of two values in one type."""
        sign = _COMPARISONS.get(type(op))
        if sign is None:
            raise Foreign("a comparison", node)
        kind = _common_type(left, right)
        return lang.ScalarOperation("bool", sign, (as_type(kind, left), as_type(kind, right)))

    def logic(self, node: ast.BoolOp) -> lang.Expression:
        """Return ``and`` or ``or`` of booleans."""
        *first, last = [self.expression(x) for x in node.values]
        if any(x.type != "bool" for x in (*first, last)):
            raise Foreign("'and' or 'or' of numbers", node)
        for value in reversed(first):
            last = lang.Logic("and" if isinstance(node.op, ast.And) else "or", value, last)
        return last

    def choice(self, node: ast.IfExp) -> lang.Expression:
        """Return one of two values."""
        test, chosen, otherwise = self.truth(node.test), self.expression(node.body), self.expression(node.orelse)
        return self.choose_value(test, chosen, otherwise, node)

    def choose_value(
        self, test: lang.Expression, chosen: lang.Expression, otherwise: lang.Expression, node: ast.AST
    ) -> lang.Expression:
        """Return one of two values in one type."""
        if chosen.type != otherwise.type and "bool" in (chosen.type, otherwise.type):
            raise Foreign("a choice between a boolean and a number", node)
        kind = _common_type(chosen, otherwise)
        return lang.Choice(kind, test, as_type(kind, chosen), as_type(kind, otherwise))

    def truth(self, node: ast.expr) -> lang.Expression:
        """Return the truth value of an expression."""
        return truth_value_of(self.expression(node))

    def call(self, node: ast.Call) -> lang.Expression:
        """Return the result of a function."""
        if node.keywords:
            raise Foreign("arguments by name", node)
        builtin = self.builtin_name(node.func)
        if builtin == "len" and len(node.args) == 1:
            return self.length(node.args[0])
        if builtin is not None:
            return self.call_builtin(builtin, [self.expression(x) for x in node.args], node)
        if isinstance(node.func, ast.Attribute) and self.is_of_math(node.func):
            name = node.func.attr
            if lang.FUNCTIONS.get(name) != len(node.args):
                raise Foreign(f"the function 'math.{name}'", node)
            values = tuple(as_type("float", self.expression(x)) for x in node.args)
            return lang.ScalarOperation("int" if name in _INTEGER else "float", f"math.{name}", values)
        if not isinstance(node.func, ast.Name) or node.func.id in self.variables:
            raise Foreign("a call", node)
        called = self.globals.get(node.func.id)
        if not isinstance(getattr(called, "py_func", None), types.FunctionType):
            raise Foreign(f"a call of '{node.func.id}'", node)
        arguments = tuple(
            x.id if isinstance(x, ast.Name) and x.id in self.arrays else self.expression(x) for x in node.args
        )
        kinds = tuple((self.arrays[x], True) if isinstance(x, str) else (x.type, False) for x in arguments)
        if any(kind == "bool" for kind, _ in kinds):
            raise Foreign("a boolean as an argument", node)
        key = (called, kinds)
        if key not in self.called:
            self.called[key] = self.read(called, kinds)
        return lang.FunctionCall(self.called[key].returned, self.called[key], arguments)

    def call_builtin(self, name: str, values: list[lang.Expression], node: ast.Call) -> lang.Expression:
        """Return the result of a built-in function."""
        if name in ("min", "max") and len(values) > 1:
            first = values[0]
            for value in values[1:]:
                kind = _common_type(first, value)
                if kind == "bool":
                    raise Foreign("the least of booleans", node)
                first = lang.ScalarOperation(kind, name, (as_type(kind, first), as_type(kind, value)))
            return first
        if len(values) == 1:
            (value,) = values
            if name == "abs" and value.type != "bool":
                return lang.ScalarOperation(value.type, "abs", (value,))
            if name in ("float", "int"):
                return as_type(cast("lang.Scalar", name), value)
        raise Foreign(f"the function '{name}'", node)

    def length(self, node: ast.expr) -> lang.Expression:
        """Return the length of an array."""
        if not isinstance(node, ast.Name) or not any(p.array and p.name == node.id for p in self.parameters):
            raise Foreign("the length of something else than an argument", node)
        return lang.ArrayLength(node.id)

    def builtin_name(self, node: ast.expr) -> str | None:
        """Return the name of a built-in function, None for anything else."""
        if isinstance(node, ast.Name) and node.id not in self.globals and hasattr(builtins, node.id):
            return None if node.id in self.variables or node.id in self.numbers else node.id
        return None

    def is_of_math(self, node: ast.Attribute) -> bool:
        """Whether an expression is an attribute of the module ``math``."""
        return isinstance(node.value, ast.Name) and self.globals.get(node.value.id) is math

    _expressions: Mapping[type, str] = {
        ast.Constant: "constant",
        ast.Name: "name",
        ast.Attribute: "attribute",
        ast.Subscript: "element",
        ast.UnaryOp: "unary",
        ast.BinOp: "binary",
        ast.Compare: "comparison",
        ast.BoolOp: "logic",
        ast.IfExp: "choice",
        ast.Call: "call",
    }


def number_value(value: object, node: ast.AST) -> lang.Constant:
    """Return a number of the source or of the module."""
    if isinstance(value, bool):
        return lang.Constant("bool", value)
    if isinstance(value, float):
        return lang.Constant("float", float(value))
    if isinstance(value, int | np.int64) and -(2**63) <= value < 2**63:
        return lang.Constant("int", int(value))
    raise Foreign(f"a value of type '{type(value).__name__}'", node)


def _constant_array(value: object, node: ast.AST) -> tuple[float, ...]:
    """Return the numbers of a constant array."""
    dtype = str(getattr(value, "dtype", ""))
    if dtype != "float64" or getattr(value, "ndim", 0) != 1:
        raise Foreign("an element of something else than an array of floats", node)
    return tuple(cast("Any", value).tolist())


def _read_power(base: lang.Expression, exponent: lang.Expression, node: ast.AST) -> lang.Expression:
    """Return a power: of a float by a literal integer, or by a float."""
    if isinstance(exponent, lang.Constant) and exponent.type == "int":
        if base.type == "float" and 0 <= exponent.value <= _LARGEST_EXPONENT:  # negative powers of 0 raise exceptions
            return lang.ScalarOperation("float", "pow", (base, exponent))
    elif exponent.type == "float":
        return lang.ScalarOperation("float", "pow", (as_type("float", base), exponent))
    raise Foreign("a power", node)


def _common_type(left: lang.Expression, right: lang.Expression) -> lang.Scalar:
    """Return the type that holds values of both."""
    return left.type if _RANK[left.type] >= _RANK[right.type] else right.type


def as_type(kind: lang.Scalar, value: lang.Expression) -> lang.Expression:
    """Return a value in a type."""
    if value.type == kind:
        return value
    if isinstance(value, lang.Constant) and kind == "float":
        return lang.Constant("float", float(value.value))
    return lang.ScalarOperation(kind, kind, (value,))


def truth_value_of(value: lang.Expression) -> lang.Expression:
    """Return the truth value of a value."""
    return value if value.type == "bool" else lang.ScalarOperation("bool", "bool", (value,))
