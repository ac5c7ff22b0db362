"""From the source of an emitted function to the checked language of `symgen.native.language`.

Types are those that Numba would infer, for functions in which they are plain to see: a variable has one type, every
path ends with ``return``, callees are functions of the same kind. Whatever else occurs is `Foreign`, which means that
the function is Numba's to compile; it is no error.
"""

from __future__ import annotations

import ast
import builtins
import math
import types
from collections.abc import Callable, Mapping
from typing import Any, cast

from symgen.native.language import (
    Assign,
    Call,
    Choice,
    Constant,
    Element,
    Evaluate,
    Expression,
    For,
    Function,
    If,
    Leave,
    Logic,
    Operation,
    Parameter,
    Return,
    Scalar,
    Statement,
    Store,
    Variable,
    While,
)

#: Functions of ``math``: number of arguments. All take floats and return one, but for ``floor`` and ``ceil``.
FUNCTIONS = {
    **dict.fromkeys("sqrt exp log sin cos tan asin acos atan sinh cosh tanh fabs floor ceil".split(), 1),
    **dict.fromkeys(("atan2", "copysign", "pow"), 2),
}
_INTEGER = ("floor", "ceil")
_ARITHMETIC = {ast.Add: "add", ast.Sub: "sub", ast.Mult: "mul", ast.Div: "div", ast.FloorDiv: "floordiv"}
_ARITHMETIC |= {ast.Mod: "mod", ast.Pow: "pow", ast.BitAnd: "and", ast.BitOr: "or"}
_COMPARISONS = {ast.Lt: "lt", ast.LtE: "le", ast.Gt: "gt", ast.GtE: "ge", ast.Eq: "eq", ast.NotEq: "ne"}
_RANK = {"bool": 0, "int": 1, "float": 2}
#: Powers with a literal exponent become products up to this one.
_LARGEST_EXPONENT = 64

Kind = tuple[Scalar, bool]  # type of a number or of an array's elements, and whether it is an array
Definition = Callable[[Any], "ast.FunctionDef | None"]


class Foreign(Exception):
    """Something that the language does not have, and where."""

    def __init__(self, what: str, node: ast.AST | None = None) -> None:
        super().__init__(what + (f" (line {node.lineno})" if isinstance(node, ast.stmt | ast.expr) else ""))


def read(function: Any, kinds: tuple[Kind, ...], definition: Definition, reading: tuple[object, ...] = ()) -> Function:
    """Return a function with the types that follow from those of its arguments.

    Parameters
    ----------
    function : Dispatcher
        What the Python function is called through; `py_func` is the function itself.
    kinds : tuple
        Type of each argument, and whether it is an array.
    definition : Callable
        Gives the syntax tree of a function, None where it is not to be read.
    reading : tuple
        Functions that call this one, which it must not call.

    Raises
    ------
    Foreign
        If it is not in the language.
    """
    tree = definition(function)
    if tree is None:
        raise Foreign(f"the function '{function.__name__}'")
    if function in reading:
        raise Foreign(f"the function '{function.__name__}' calls itself", tree)
    return Reader(function, tree, kinds, definition, (*reading, function)).function()


class Reader:
    """Reads one function."""

    def __init__(
        self,
        function: Any,
        tree: ast.FunctionDef,
        kinds: tuple[Kind, ...],
        definition: Definition,
        reading: tuple[object, ...],
    ) -> None:
        self.source, self.tree, self.definition, self.reading = function, tree, definition, reading
        self.globals: Mapping[str, Any] = function.py_func.__globals__
        self.locals = frozenset(function.py_func.__code__.co_varnames)
        a = tree.args
        if a.vararg or a.kwarg or a.kwonlyargs or a.posonlyargs or a.defaults or len(a.args) != len(kinds):
            raise Foreign("arguments other than plain ones", tree)
        self.parameters = tuple(Parameter(x.arg, kind, array) for x, (kind, array) in zip(a.args, kinds, strict=True))
        self.arrays = {p.name: p.type for p in self.parameters if p.array}
        self.numbers: dict[str, Scalar] = {p.name: p.type for p in self.parameters if not p.array}
        self.variables: dict[str, Scalar] = {}
        self.assigned: dict[str, int] = {}  # how often; assignments below the body itself count twice
        self.tables: dict[str, tuple[float, ...]] = {}
        self.called: dict[tuple[object, tuple[Kind, ...]], Function] = {}
        self.returned: set[Scalar] = set()
        self.depth = 0
        self.loops = 0

    def function(self) -> Function:
        """Return the function."""
        body = self.tree.body
        if body and isinstance(body[0], ast.Expr) and isinstance(body[0].value, ast.Constant):
            body = body[1:]  # the docstring
        statements = self.statements(body)
        if not returns(statements) or len(self.returned) != 1:
            raise Foreign("paths that return nothing, or different types", self.tree)
        (returned,) = self.returned
        if returned == "bool":
            raise Foreign("a boolean result", self.tree)
        fixed = {name for name, count in self.assigned.items() if count == 1 and name in self.variables}
        return Function(
            name=self.source.__name__,
            parameters=self.parameters,
            returned=returned,
            body=statements,
            variables=self.variables,
            fixed=frozenset(fixed),
            tables=self.tables,
            called=tuple(self.called.values()),
            source=self.source,
        )

    # -- statements

    def statements(self, nodes: list[ast.stmt]) -> tuple[Statement, ...]:
        """Return what statements do."""
        found: list[Statement] = []
        for node in nodes:
            found.extend(self.statement(node))
        return tuple(found)

    def inner(self, nodes: list[ast.stmt], loop: bool = False) -> tuple[Statement, ...]:
        """Return what the statements of a branch or of a loop do."""
        self.depth += 1
        self.loops += loop
        found = self.statements(nodes)
        self.depth -= 1
        self.loops -= loop
        return found

    def statement(self, node: ast.stmt) -> list[Statement]:
        """Return what a statement does."""
        if isinstance(node, ast.Assign):
            return self.assignment(node)
        if isinstance(node, ast.AugAssign):
            before = self.expression(_loaded(node.target))
            return [
                self.store(node.target, self.arithmetic(self.sign(node), before, self.expression(node.value), node))
            ]
        if isinstance(node, ast.Return):
            if node.value is None:
                raise Foreign("a return without value", node)
            value = self.expression(node.value)
            self.returned.add(value.type)
            return [Return(value)]
        if isinstance(node, ast.If):
            return [If(self.truth(node.test), self.inner(node.body), self.inner(node.orelse))]
        if isinstance(node, ast.While) and not node.orelse:
            test = self.truth(node.test)
            return [While(test, self.inner(node.body, loop=True))]
        if isinstance(node, ast.For) and not node.orelse:
            return [self.loop(node)]
        if isinstance(node, ast.Break | ast.Continue) and self.loops:
            return [Leave("break" if isinstance(node, ast.Break) else "continue")]
        if isinstance(node, ast.Expr):
            call = self.expression(node.value)
            if isinstance(call, Call):
                return [Evaluate(call)]
        if isinstance(node, ast.Pass):
            return []
        raise Foreign(f"a statement '{type(node).__name__}'", node)

    def assignment(self, node: ast.Assign) -> list[Statement]:
        """Return what an assignment does; all values are worked out before the first of them is stored."""
        first = node.targets[0]
        if isinstance(first, ast.Tuple) and isinstance(node.value, ast.Tuple) and len(node.targets) == 1:
            targets, values = first.elts, [self.expression(x) for x in node.value.elts]
            if len(targets) != len(values):
                raise Foreign("an assignment of unequal lengths", node)
            if all(isinstance(v, Constant) for v in values):
                return [self.store(t, v) for t, v in zip(targets, values, strict=True)]
            found: list[Statement] = []
            for i, value in enumerate(values):
                name = f"{len(self.variables)}.{i}"  # no name of Python's
                self.give(name, value.type, node)
                found.append(Assign(name, value))
                values[i] = Variable(value.type, name)
            return found + [self.store(t, v) for t, v in zip(targets, values, strict=True)]
        value = self.expression(node.value)
        if len(node.targets) > 1 and not isinstance(value, Constant):
            raise Foreign("a chain of assignments", node)
        return [self.store(target, value) for target in node.targets]

    def store(self, target: ast.expr, value: Expression) -> Statement:
        """Return the assignment of a value to a name or an element."""
        if isinstance(target, ast.Name):
            self.give(target.id, value.type, target)
            return Assign(target.id, value)
        if isinstance(target, ast.Subscript):
            array, index = self.place(target)
            kind = self.arrays.get(array)
            if kind is None:
                raise Foreign("an element of a constant", target)
            if kind == "int" and value.type == "float":
                raise Foreign("a float in an array of integers", target)
            return Store(array, index, as_type(kind, value))
        raise Foreign("a target of an assignment", target)

    def give(self, name: str, kind: Scalar, node: ast.AST) -> None:
        """Note that a variable is given a value of a type."""
        if name in self.arrays or self.numbers.get(name, kind) != kind or self.variables.get(name, kind) != kind:
            raise Foreign(f"variable '{name}' has two types", node)
        self.variables[name] = kind
        once = not self.depth and name not in self.numbers
        self.assigned[name] = self.assigned.get(name, 0) + (1 if once else 2)

    def loop(self, node: ast.For) -> Statement:
        """Return a loop over a range."""
        call = node.iter
        if not (
            isinstance(node.target, ast.Name) and isinstance(call, ast.Call) and self.builtin(call.func) == "range"
        ):
            raise Foreign("a loop over something else than a range", node)
        bounds = [self.expression(x) for x in call.args]
        if not 1 <= len(bounds) <= 3 or call.keywords or any(b.type != "int" for b in bounds):
            raise Foreign("a range", node)
        start, stop = (Constant("int", 0), bounds[0]) if len(bounds) == 1 else bounds[:2]
        step = bounds[2] if len(bounds) == 3 else Constant("int", 1)
        if not isinstance(step, Constant) or step.value == 0:
            raise Foreign("a range whose step is no constant", node)
        self.depth += 1
        self.give(node.target.id, "int", node)
        self.depth -= 1
        return For(node.target.id, start, stop, int(step.value), self.inner(node.body, loop=True))

    # -- expressions

    def expression(self, node: ast.expr) -> Expression:
        """Return the value of an expression."""
        method = self._expressions.get(type(node))
        if method is None:
            raise Foreign(f"an expression '{type(node).__name__}'", node)
        found: Expression = getattr(self, method)(node)
        return found

    def constant(self, node: ast.Constant) -> Expression:
        """Return a literal."""
        return number(node.value, node)

    def name(self, node: ast.Name) -> Expression:
        """Return a variable, an argument, or a number of the module."""
        name = node.id
        if name in self.variables:
            return Variable(self.variables[name], name)
        if name in self.numbers:
            return Variable(self.numbers[name], name)
        if name in self.locals or name not in self.globals:
            raise Foreign(f"the name '{name}'", node)
        return number(self.globals[name], node)

    def attribute(self, node: ast.Attribute) -> Expression:
        """Return a constant of ``math``."""
        if self.of_math(node) and node.attr in ("inf", "pi", "nan", "e", "tau"):
            return Constant("float", getattr(math, node.attr))
        raise Foreign("an attribute", node)

    def element(self, node: ast.Subscript) -> Expression:
        """Return an element of an array."""
        array, index = self.place(node)
        return Element(self.arrays.get(array, "float"), array, index)

    def place(self, node: ast.Subscript) -> tuple[str, Expression]:
        """Return array and index of an element."""
        if not isinstance(node.value, ast.Name):
            raise Foreign("an element of an expression", node)
        name, index = node.value.id, self.expression(node.slice)
        if name not in self.arrays:
            self.tables[name] = _table(self.globals.get(name), node)
        if index.type != "int" or (isinstance(index, Constant) and index.value < 0):
            raise Foreign("an index", node)
        return name, index

    def unary(self, node: ast.UnaryOp) -> Expression:
        """Return an operation on one value."""
        value = self.expression(node.operand)
        if isinstance(node.op, ast.Not):
            return Operation("bool", "not", (truth_of(value),))
        if isinstance(node.op, ast.UAdd) and value.type != "bool":
            return value
        if isinstance(node.op, ast.USub) and value.type != "bool":
            if isinstance(value, Constant):
                return Constant(value.type, -value.value)
            return Operation(value.type, "neg", (value,))
        raise Foreign("an operation", node)

    def binary(self, node: ast.BinOp) -> Expression:
        """Return an operation on two values."""
        sign = self.sign(node)
        return self.arithmetic(sign, self.expression(node.left), self.expression(node.right), node)

    def sign(self, node: ast.BinOp | ast.AugAssign) -> str:
        """Return what an operation is called."""
        sign = _ARITHMETIC.get(type(node.op))
        if sign is None:
            raise Foreign("an operation", node)
        return sign

    def arithmetic(self, sign: str, left: Expression, right: Expression, node: ast.AST) -> Expression:
        """Return an operation on two values of one type."""
        if sign in ("and", "or"):
            if left.type == right.type != "float":
                return Operation(left.type, sign, (left, right))
            raise Foreign("an operation on bits", node)
        if sign == "pow":
            return _power(left, right, node)
        kind: Scalar = "float" if "float" in (left.type, right.type) or sign == "div" else "int"
        if sign in ("floordiv", "mod") and (kind != "int" or not isinstance(right, Constant) or right.value <= 0):
            raise Foreign("a division with rest", node)
        return Operation(kind, sign, (as_type(kind, left), as_type(kind, right)))

    def comparison(self, node: ast.Compare) -> Expression:
        """Return a comparison of two values."""
        if len(node.ops) > 1:
            raise Foreign("a comparison", node)
        return self.compared(node.ops[0], self.expression(node.left), self.expression(node.comparators[0]), node)

    def compared(self, op: ast.cmpop, left: Expression, right: Expression, node: ast.AST) -> Expression:
        """Return a comparison of two values in one type."""
        sign = _COMPARISONS.get(type(op))
        if sign is None:
            raise Foreign("a comparison", node)
        kind = _common(left, right)
        return Operation("bool", sign, (as_type(kind, left), as_type(kind, right)))

    def logic(self, node: ast.BoolOp) -> Expression:
        """Return ``and`` or ``or`` of booleans."""
        *first, last = [self.expression(x) for x in node.values]
        if any(x.type != "bool" for x in (*first, last)):
            raise Foreign("'and' or 'or' of numbers", node)
        for value in reversed(first):
            last = Logic("and" if isinstance(node.op, ast.And) else "or", value, last)
        return last

    def choice(self, node: ast.IfExp) -> Expression:
        """Return one of two values."""
        test, chosen, otherwise = self.truth(node.test), self.expression(node.body), self.expression(node.orelse)
        return self.chosen(test, chosen, otherwise, node)

    def chosen(self, test: Expression, chosen: Expression, otherwise: Expression, node: ast.AST) -> Expression:
        """Return one of two values in one type."""
        if chosen.type != otherwise.type and "bool" in (chosen.type, otherwise.type):
            raise Foreign("a choice between a boolean and a number", node)
        kind = _common(chosen, otherwise)
        return Choice(kind, test, as_type(kind, chosen), as_type(kind, otherwise))

    def truth(self, node: ast.expr) -> Expression:
        """Return whether an expression counts as true."""
        return truth_of(self.expression(node))

    def call(self, node: ast.Call) -> Expression:
        """Return what a function gives."""
        if node.keywords:
            raise Foreign("arguments by name", node)
        builtin = self.builtin(node.func)
        if builtin is not None:
            return self.call_builtin(builtin, [self.expression(x) for x in node.args], node)
        if isinstance(node.func, ast.Attribute) and self.of_math(node.func):
            name = node.func.attr
            if FUNCTIONS.get(name) != len(node.args):
                raise Foreign(f"the function 'math.{name}'", node)
            values = tuple(as_type("float", self.expression(x)) for x in node.args)
            return Operation("int" if name in _INTEGER else "float", f"math.{name}", values)
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
            self.called[key] = read(called, kinds, self.definition, self.reading)
        return Call(self.called[key].returned, self.called[key], arguments)

    def call_builtin(self, name: str, values: list[Expression], node: ast.Call) -> Expression:
        """Return what a function of Python gives."""
        if name in ("min", "max") and len(values) > 1:
            first = values[0]
            for value in values[1:]:
                kind = _common(first, value)
                if kind == "bool":
                    raise Foreign("the least of booleans", node)
                first = Operation(kind, name, (as_type(kind, first), as_type(kind, value)))
            return first
        if len(values) == 1:
            (value,) = values
            if name == "abs" and value.type != "bool":
                return Operation(value.type, "abs", (value,))
            if name in ("float", "int"):
                return as_type(cast("Scalar", name), value)
        raise Foreign(f"the function '{name}'", node)

    def builtin(self, node: ast.expr) -> str | None:
        """Return the name of a function of Python, None for anything else."""
        if isinstance(node, ast.Name) and node.id not in self.globals and hasattr(builtins, node.id):
            return None if node.id in self.variables or node.id in self.numbers else node.id
        return None

    def of_math(self, node: ast.Attribute) -> bool:
        """Whether something is an attribute of the module ``math``."""
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


def number(value: object, node: ast.AST) -> Constant:
    """Return a number of the source or of the module."""
    if isinstance(value, bool):
        return Constant("bool", value)
    if isinstance(value, float):
        return Constant("float", float(value))
    if isinstance(value, int) and -(2**63) <= value < 2**63:
        return Constant("int", value)
    raise Foreign(f"a value of type '{type(value).__name__}'", node)


def _table(value: object, node: ast.AST) -> tuple[float, ...]:
    """Return the numbers of a constant array."""
    dtype = str(getattr(value, "dtype", ""))
    if dtype != "float64" or getattr(value, "ndim", 0) != 1:
        raise Foreign("an element of something else than an array of floats", node)
    return tuple(cast("Any", value).tolist())


def _power(base: Expression, exponent: Expression, node: ast.AST) -> Expression:
    """Return a power: of a float by a literal integer, or by a float."""
    if isinstance(exponent, Constant) and exponent.type == "int":
        if base.type == "float" and 0 <= exponent.value <= _LARGEST_EXPONENT:  # negative ones raise exceptions of 0
            return Operation("float", "pow", (base, exponent))
    elif exponent.type == "float":
        return Operation("float", "pow", (as_type("float", base), exponent))
    raise Foreign("a power", node)


def _common(left: Expression, right: Expression) -> Scalar:
    """Return the type that holds values of both."""
    return left.type if _RANK[left.type] >= _RANK[right.type] else right.type


def as_type(kind: Scalar, value: Expression) -> Expression:
    """Return a value in a type."""
    if value.type == kind:
        return value
    if isinstance(value, Constant) and kind == "float":
        return Constant("float", float(value.value))
    return Operation(kind, kind, (value,))


def truth_of(value: Expression) -> Expression:
    """Return whether a value counts as true."""
    return value if value.type == "bool" else Operation("bool", "bool", (value,))


def _loaded(target: ast.expr) -> ast.expr:
    """Return the target of an assignment as something that is read."""
    if isinstance(target, ast.Name):
        return ast.copy_location(ast.Name(target.id, ast.Load()), target)
    if isinstance(target, ast.Subscript):
        return ast.copy_location(ast.Subscript(target.value, target.slice, ast.Load()), target)
    raise Foreign("a target of an assignment", target)


def returns(statements: tuple[Statement, ...]) -> bool:
    """Whether every path through statements ends with a return."""
    if not statements:
        return False
    last = statements[-1]
    return isinstance(last, Return) or (isinstance(last, If) and returns(last.then) and returns(last.otherwise))
