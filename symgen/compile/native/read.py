"""From the source of an emitted function to the checked language of `symgen.compile.native.language`.

Types are those that Numba would infer, for functions with plain types: a variable has one type, every
path ends with ``return``, callees are functions of the same kind. Everything else is `Foreign`: only Numba
compiles such a function.
"""

from __future__ import annotations

import ast
from collections.abc import Mapping
from typing import Any

from symgen.compile.native import language as lang
from symgen.compile.native.read_tables import TableValues
from symgen.compile.native.read_values import Foreign, Kind, as_type

__all__ = ["Foreign", "Kind", "read_function"]


def read_function(function: Any, kinds: tuple[Kind, ...], reading: tuple[object, ...] = ()) -> lang.Function:
    """Return a function with the types that follow from its arguments.

    Parameters
    ----------
    function : MachineFunction
        The function; `py_func` is the Python function.
    kinds : tuple
        Type of each argument, and whether it is an array.
    reading : tuple
        Functions that call this one, which it must not call.

    Raises
    ------
    Foreign
        If it is outside the language.
    """
    tree = tree_of_function(function)
    if function in reading:
        raise Foreign(f"the function '{function.__name__}' calls itself", tree)
    a = tree.args
    if a.vararg or a.kwarg or a.kwonlyargs or a.posonlyargs or a.defaults or len(a.args) != len(kinds):
        raise Foreign("arguments other than plain ones", tree)
    parameters = tuple(
        lang.FunctionParameter(x.arg, kind, array) for x, (kind, array) in zip(a.args, kinds, strict=True)
    )
    return Reader(function, tree, parameters, (*reading, function)).function()


def tree_of_function(function: Any) -> ast.FunctionDef:
    """Return the syntax tree of a function.

    Raises
    ------
    Foreign
        If its source is not available.
    """
    tree: ast.FunctionDef | None = function.tree() if hasattr(function, "tree") else None
    if tree is None:
        raise Foreign(f"'{function.__name__}', whose definition is not at the first column of a file as it was loaded")
    return tree


def statements_without_docstring(tree: ast.FunctionDef) -> list[ast.stmt]:
    """Return the statements of a function without its docstring."""
    first = tree.body[0]
    return tree.body[1:] if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant) else tree.body


def without_constants(test: ast.expr, names: Mapping[str, Any]) -> ast.expr | bool:
    """Return a condition without the truth values that are constants of the module, or its own truth value.

    Parameters
    ----------
    test : expr
        The condition.
    names : mapping
        Global names with their values.
    """
    if isinstance(test, ast.Name) and isinstance(names.get(test.id), bool):
        return bool(names[test.id])
    if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
        inner = without_constants(test.operand, names)
        return not inner if isinstance(inner, bool) else test
    if not isinstance(test, ast.BoolOp):
        return test
    decisive, left = isinstance(test.op, ast.Or), list[ast.expr]()
    for part in test.values:
        value = without_constants(part, names)
        if value is decisive and not left:
            return decisive
        if not isinstance(value, bool):
            left.append(value)
        elif value is decisive:  # parts before it may be undefined
            left.append(part)
            break
    if not left:
        return not decisive
    return left[0] if len(left) == 1 else ast.BoolOp(test.op, left)


class Reader(TableValues):
    """Reads one function."""

    def __init__(
        self,
        function: Any,
        tree: ast.FunctionDef,
        parameters: tuple[lang.FunctionParameter, ...],
        reading: tuple[object, ...] = (),
    ) -> None:
        super().__init__(function, parameters)
        self.source, self.tree, self.reading = function, tree, reading
        self.assigned: dict[str, int] = {}  # number of assignments; those below the body itself count twice
        self.returned: set[lang.Scalar] = set()
        self.loops = 0

    def read(self, called: Any, kinds: tuple[Kind, ...]) -> lang.Function:
        """Return a function that this one calls."""
        return read_function(called, kinds, self.reading)

    def function(self) -> lang.Function:
        """Return the function."""
        statements = self.statements(statements_without_docstring(self.tree))
        if not self.returned and any(p.type == "unsigned" for p in self.parameters):
            # looped code calls functions without a result: an unused 0
            self.returned.add("int")
            statements = (*statements, lang.Return(lang.Constant("int", 0)))
        if not always_returns(statements) or len(self.returned) != 1:
            raise Foreign("paths that return nothing, or different types", self.tree)
        if "bool" in self.returned:
            raise Foreign("a boolean result", self.tree)
        return self.typed_function(statements)

    def typed_function(self, statements: tuple[lang.Statement, ...]) -> lang.Function:
        """Return the function of the translated statements, with results of one type."""
        (returned,) = self.returned
        fixed = {name for name, count in self.assigned.items() if count == 1 and name in self.variables}
        return lang.Function(
            name=self.source.__name__,
            parameters=self.parameters,
            returned=returned,
            body=statements,
            variables=self.variables,
            fixed=frozenset(fixed),
            tables=self.tables,
            called=tuple(self.called.values()),
            source=self.source,
            inlined=is_inlined(self.source),
        )

    def statements(self, nodes: list[ast.stmt]) -> tuple[lang.Statement, ...]:
        """Return the translation of statements."""
        statements: list[lang.Statement] = []
        for node in nodes:
            statements.extend(self.statement(node))
        return tuple(statements)

    def read_inner(self, nodes: list[ast.stmt], loop: bool = False) -> tuple[lang.Statement, ...]:
        """Return the translation of the statements of a branch or of a loop."""
        self.depth += 1
        self.loops += loop
        statements = self.statements(nodes)
        self.depth -= 1
        self.loops -= loop
        return statements

    def statement(self, node: ast.stmt) -> list[lang.Statement]:
        """Return the translation of a statement."""
        if isinstance(node, ast.Assign):
            return self.assignment(node)
        if isinstance(node, ast.AugAssign):
            self.note_sign(node.target, ast.BinOp(_as_expression(node.target), node.op, node.value))
            before = self.expression(_as_expression(node.target))
            return [
                self.store(
                    node.target, self.arithmetic(self.operation_name(node), before, self.expression(node.value), node)
                )
            ]
        if isinstance(node, ast.Return):
            if node.value is None:
                raise Foreign("a return without value", node)
            value = self.expression(node.value)
            self.returned.add(value.type)
            return [lang.Return(value)]
        if isinstance(node, ast.If):
            condition = without_constants(node.test, self.globals)
            if isinstance(condition, bool):
                return list(self.statements(node.body if condition else node.orelse))
            return [lang.If(self.truth(condition), self.read_inner(node.body), self.read_inner(node.orelse))]
        if isinstance(node, ast.While) and not node.orelse:
            test = self.truth(node.test)
            return [lang.While(test, self.read_inner(node.body, loop=True))]
        if isinstance(node, ast.For) and not node.orelse:
            return [self.loop(node)]
        if isinstance(node, ast.Break | ast.Continue) and self.loops:
            return [lang.Leave("break" if isinstance(node, ast.Break) else "continue")]
        if isinstance(node, ast.Expr):
            call = self.expression(node.value)
            if isinstance(call, lang.FunctionCall | lang.Invoke):
                return [lang.Evaluate(call)]
        if isinstance(node, ast.Pass):
            return []
        raise Foreign(f"a statement '{type(node).__name__}'", node)

    def assignment(self, node: ast.Assign) -> list[lang.Statement]:
        """Return the statements of an assignment; all values are computed before the first one is stored."""
        first, statements = node.targets[0], list[lang.Statement]()
        self.note_signs(node)
        if isinstance(first, ast.Tuple) and isinstance(node.value, ast.Tuple) and len(node.targets) == 1:
            targets, values = first.elts, [self.expression(x) for x in node.value.elts]
            if len(targets) != len(values):
                raise Foreign("an assignment of unequal lengths", node)
            if all(isinstance(v, lang.Constant) for v in values):
                return [self.store(t, v) for t, v in zip(targets, values, strict=True)]
            for i, value in enumerate(values):
                values[i] = self.name_value(f"{len(self.variables)}.{i}", value, statements, node)
            return statements + [self.store(t, v) for t, v in zip(targets, values, strict=True)]
        view = self.name_view(node) or self.read_several_results(node)
        if view:
            return view
        value = self.expression(node.value)
        if len(node.targets) > 1 and not isinstance(value, lang.Constant):
            value = self.name_value(f"{len(self.variables)}.0", value, statements, node)
        return statements + [self.store(target, value) for target in node.targets]

    def read_several_results(self, node: ast.Assign) -> list[lang.Statement]:
        """Return the assignments of the values of a function that returns several; empty for any other assignment.

        The function's statements replace the call, under names that are no Python names.
        """
        target, call = node.targets[0], node.value
        if not isinstance(target, ast.Tuple) or not isinstance(call, ast.Call):
            return []
        called = self.meaning_in_module(call.func)
        tree = tree_of_function(called) if is_inlined(called) else None
        if tree is None or len(node.targets) > 1 or call.keywords or len(call.args) != len(tree.args.args):
            raise Foreign("several values of a call", node)
        *body, last = statements_without_docstring(tree)
        own = {x.arg for x in tree.args.args} | {
            n.id for s in body for n in ast.walk(s) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)
        }
        names = {name: f"{tree.name}.{name}" for name in own}  # no Python names
        inside = Renamed(names)
        others = {n.id for s in tree.body for n in ast.walk(s) if isinstance(n, ast.Name)} - own
        if others:
            raise Foreign(f"the name '{min(others)}'", node)
        if not isinstance(last, ast.Return) or not isinstance(last.value, ast.Tuple):
            raise Foreign("several values of something else than straight code", node)
        parameters = [ast.Name(names[x.arg], ast.Store()) for x in tree.args.args]
        steps: list[ast.stmt] = [
            *(ast.Assign([x], v) for x, v in zip(parameters, call.args, strict=True)),
            *map(inside.visit, body),
        ]
        if not all(isinstance(s, ast.Assign) for s in steps):
            raise Foreign("several values of something else than straight code", node)
        steps.append(ast.Assign([target], inside.visit(last.value)))
        return list(self.statements([ast.fix_missing_locations(ast.copy_location(s, node)) for s in steps]))

    def name_value(
        self, name: str, value: lang.Expression, before: list[lang.Statement], node: ast.AST
    ) -> lang.Expression:
        """Return a value under a name that is no Python name, so that later statements do not change it."""
        self.note_type(name, value.type, node)
        before.append(lang.Assign(name, value))
        return lang.Variable(value.type, name)

    def store(self, target: ast.expr, value: lang.Expression) -> lang.Statement:
        """Return the assignment of a value to a name or an element."""
        if isinstance(target, ast.Name):
            self.note_type(target.id, value.type, target)
            return lang.Assign(target.id, value)
        if isinstance(target, ast.Subscript):
            array, index = self.place(target)
            kind = self.arrays.get(array)
            if kind is None or kind == "unsigned":
                raise Foreign("an element of a constant", target)
            if kind == "int" and value.type == "float":
                raise Foreign("a float in an array of integers", target)
            return lang.Store(array, index, as_type(kind, value))
        raise Foreign("a target of an assignment", target)

    def note_type(self, name: str, kind: lang.Scalar, node: ast.AST) -> None:
        """Note the type of a value assigned to a variable."""
        if name in self.arrays or self.numbers.get(name, kind) != kind or self.variables.get(name, kind) != kind:
            raise Foreign(f"variable '{name}' has two types", node)
        self.variables[name] = kind
        once = not self.depth and name not in self.numbers
        self.assigned[name] = self.assigned.get(name, 0) + (1 if once else 2)

    def loop(self, node: ast.For) -> lang.Statement:
        """Return a loop over a range."""
        call = node.iter
        if not (
            isinstance(node.target, ast.Name) and isinstance(call, ast.Call) and self.builtin_name(call.func) == "range"
        ):
            raise Foreign("a loop over something else than a range", node)
        bounds = [self.expression(x) for x in call.args]
        if (
            not 1 <= len(bounds) <= 3
            or call.keywords
            or any(b.type != "int" for b in bounds)
            or any(self.is_unsigned(x) for x in call.args)
        ):
            raise Foreign("a range", node)
        start, stop = (lang.Constant("int", 0), bounds[0]) if len(bounds) == 1 else bounds[:2]
        step = bounds[2] if len(bounds) == 3 else lang.Constant("int", 1)
        if not isinstance(step, lang.Constant) or step.value == 0:
            raise Foreign("a range whose step is no constant", node)
        self.depth += 1
        self.note_type(node.target.id, "int", node)
        self.depth -= 1
        return lang.For(node.target.id, start, stop, int(step.value), self.read_inner(node.body, loop=True))


class Renamed(ast.NodeTransformer):
    """Gives variables other names."""

    def __init__(self, names: dict[str, str]) -> None:
        self.names = names

    def visit_Name(self, node: ast.Name) -> ast.Name:
        """Return a name under its other name."""
        return ast.copy_location(ast.Name(self.names.get(node.id, node.id), node.ctx), node)


def is_inlined(function: Any) -> bool:
    """Whether a function is declared as inlined."""
    return bool(getattr(function, "inlined", False))


def _as_expression(target: ast.expr) -> ast.expr:
    """Return the target of an assignment as an expression to read."""
    if isinstance(target, ast.Name):
        return ast.copy_location(ast.Name(target.id, ast.Load()), target)
    if isinstance(target, ast.Subscript):
        return ast.copy_location(ast.Subscript(target.value, target.slice, ast.Load()), target)
    raise Foreign("a target of an assignment", target)


def always_returns(statements: tuple[lang.Statement, ...]) -> bool:
    """Whether every path through statements ends with a return."""
    if not statements:
        return False
    last = statements[-1]
    return isinstance(last, lang.Return) or (
        isinstance(last, lang.If) and always_returns(last.then) and always_returns(last.otherwise)
    )
