"""From the source of the runtime's loops to the checked language of `symgen.compile.native.language`.

A loop is written in Python with records of arrays and numbers, functions by their address, and parts
that are copied into it (`symgen.compile.loopcode.loop_instances`). All of these are fixed before anything runs:
records, tuples and views of arrays exist only while the source is read and leave names of arrays, numbers and
addresses. The rest of a loop is as in emitted functions, read by the same rules.

Code outside this language is `Foreign`: only Numba compiles such a loop.
"""

from __future__ import annotations

import ast
import math
import types as python
from collections.abc import Callable
from typing import Any, NamedTuple

from symgen.compile.native import language as lang
from symgen.compile.native import types
from symgen.compile.native.loop_expressions import LoopValues
from symgen.compile.native.loop_values import (
    EXPRESSIONS,
    NOTHING,
    NUMBERS,
    SCALARS,
    Address,
    Array,
    RecordValue,
    Value,
    argument_value,
    is_number,
    leaves_of_value,
    pass_values,
    value_in_callee,
)
from symgen.compile.native.pieces import Piece, piece_text
from symgen.compile.native.read import Renamed, always_returns, statements_without_docstring, tree_of_function
from symgen.compile.native.read_values import Foreign, as_type, truth_value_of

#: Makes the compiled function of the plain form of a piece; None: pieces are inserted in LLVM's language.
Pieces = Callable[[Piece], Any] | None


def read_loop(
    function: Any, arguments: tuple[types.Kind, ...], pieces: Pieces = None, apart: bool = False
) -> lang.Function:
    """Return a loop with the types that follow from its arguments.

    Parameters
    ----------
    function : MachineFunction
        Its Python function is the loop.
    arguments : tuple of types
        Types of its arguments (`symgen.compile.native.types`).
    pieces : callable, optional
        Makes the compiled function of the plain form of a piece, for languages other than LLVM's.
    apart : bool
        Whether functions with numbers as results are called rather than copied into their callers: the text is
        shorter.

    Raises
    ------
    Foreign
        If it is outside the language.
    """
    names = function.py_func.__code__.co_varnames
    pairs = [argument_value(name, kind) for name, kind in zip(names, arguments, strict=False)]
    parameters = tuple(p for _, ps in pairs for p in ps)
    return LoopReader(function, tuple(v for v, _ in pairs), parameters, {}, pieces, apart).function()


class _Copied(NamedTuple):
    """A function while it is copied into another: its end, and the variable of its result."""

    block: int
    result: str


class LoopReader(LoopValues):
    """Reads a loop, or a part that loops call.

    Parameters
    ----------
    function : MachineFunction
        Its Python function is the loop.
    arguments : tuple
        Values of the arguments.
    parameters : tuple of Parameter
        Their parameters.
    shared : dict
        Called parts read so far, by their arguments.
    pieces, apart
        As for `read_loop`.
    """

    def __init__(
        self,
        function: Any,
        arguments: tuple[Value, ...],
        parameters: tuple[lang.FunctionParameter, ...],
        shared: dict[Any, lang.Function],
        pieces: Pieces = None,
        apart: bool = False,
    ) -> None:
        tree = tree_of_function(function)
        names = [x.arg for x in tree.args.args]
        if len(names) != len(arguments):
            raise Foreign("arguments other than plain ones", tree)
        # an argument that is a number has its own name, and may be given another value
        bound = {n: v for n, v in zip(names, arguments, strict=True) if not isinstance(v, lang.Variable)}
        super().__init__(function, tree, bound, parameters)
        self.shared, self.plain_piece, self.apart = shared, pieces, apart
        self.copies: list[_Copied] = []

    def function(self) -> lang.Function:
        """Return the function."""
        statements = self.statements(statements_without_docstring(self.tree))
        if not always_returns(statements):  # no result: an unused 0
            self.returned.add("int")
            statements = (*statements, lang.Return(lang.Constant("int", 0)))
        if len(self.returned) != 1:
            raise Foreign("results of different types", self.tree)
        return self.typed_function(statements)

    # -- statements

    def statement(self, node: ast.stmt) -> list[lang.Statement]:
        """Return the translation of a statement, after the statements that it needs."""
        outer, self.pending = self.pending, []
        statements = self._statement(node)
        statements, self.pending = [*self.pending, *statements], outer
        return statements

    def _statement(self, node: ast.stmt) -> list[lang.Statement]:
        if isinstance(node, ast.Return):
            return self.end(node)
        if isinstance(node, ast.If):
            test = self.truth(node.test)
            if isinstance(test, lang.Constant):
                return list(self.statements(node.body if test.value else node.orelse))
            return [lang.If(test, self.read_inner(node.body), self.read_inner(node.orelse))]
        if isinstance(node, ast.While) and not node.orelse:
            return [self.repeat(node)]
        if isinstance(node, ast.For) and isinstance(node.iter, ast.Tuple):
            return self.unroll(node)
        if isinstance(node, ast.AnnAssign) and node.value is not None:
            return self.assignment(ast.copy_location(ast.Assign([node.target], node.value), node))
        if isinstance(node, ast.Expr):
            value = self.value(node.value)
            return [lang.Evaluate(value)] if isinstance(value, lang.FunctionCall | lang.Invoke | lang.Insert) else []
        return super().statement(node)

    def repeat(self, node: ast.While) -> lang.Statement:
        """Return a loop with a test, which may need its own statements."""
        outer, self.pending = self.pending, []
        self.depth += 1
        test = self.truth(node.test)
        self.depth -= 1
        before, self.pending = self.pending, outer
        body = self.read_inner(node.body, loop=True)
        if not before:
            return lang.While(test, body)
        leave = lang.If(lang.ScalarOperation("bool", "not", (test,)), (lang.Leave("break"),), ())
        return lang.While(lang.Constant("bool", True), (*before, leave, *body))

    def unroll(self, node: ast.For) -> list[lang.Statement]:
        """Return the statements for each of some values."""
        if node.orelse or any(isinstance(x, ast.Break | ast.Continue) for s in node.body for x in ast.walk(s)):
            raise Foreign("the end of a loop over a tuple", node)
        statements: list[lang.Statement] = []
        for value in self.value(node.iter).values:
            statements += [*self.assign_value(node.target, value), *self.read_inner(node.body)]
        return statements

    def end(self, node: ast.Return) -> list[lang.Statement]:
        """Return the end of the function, or of one copied into it."""
        if not self.copies:
            value = lang.Constant("int", 0) if node.value is None else self.expression(node.value)
            self.returned.add(value.type)
            return [lang.Return(value)]
        copied, statements = self.copies[-1], list[lang.Statement]()
        if node.value is not None:
            value = self.value(node.value)
            if is_number(value):
                self.note_type(copied.result, value.type, node)
                statements.append(lang.Assign(copied.result, value))
            else:
                if copied.result in self.bound or self.depth:
                    raise Foreign("several results that are no numbers", node)
                self.bound[copied.result] = value
        return [*statements, lang.Leave("block", copied.block)]

    def assignment(self, node: ast.Assign) -> list[lang.Statement]:
        """Return the statements of an assignment; all values are computed before the first one is stored."""
        value = self.value(node.value)
        if len(node.targets) > 1:
            value = self.name_number(value, node)
        return [s for target in node.targets for s in self.assign_value(target, value)]

    def assign_value(self, target: ast.expr, value: Value) -> list[lang.Statement]:
        """Return the assignment of a value to a name or an element, or of several to several."""
        if isinstance(target, ast.Tuple):
            values = list(value.values) if isinstance(value, RecordValue) else []
            if len(values) != len(target.elts):
                raise Foreign("an assignment of unequal lengths", target)
            return [s for t, v in zip(target.elts, values, strict=True) for s in self.assign_value(t, v)]
        if isinstance(value, EXPRESSIONS):
            if isinstance(target, ast.Name) and target.id in self.bound:
                raise Foreign(f"variable '{target.id}' has two types", target)
            return [self.store(target, value)]
        if not isinstance(target, ast.Name) or target.id in self.variables or target.id in self.numbers:
            raise Foreign("a target of an assignment", target)
        if self.depth and self.bound.get(target.id, value) != value:
            raise Foreign(f"'{target.id}' stands for different things", target)
        self.bound[target.id] = value
        return []

    # -- calls

    def call(self, node: ast.Call) -> Value:
        """Return the result of a function."""
        if node.keywords:
            raise Foreign("arguments by name", node)
        if isinstance(node.func, ast.Attribute) and self.is_of_math(node.func):
            if node.func.attr not in ("isfinite", "isnan"):
                return super().call(node)
            (number,) = self.numbers_of(node.args)
            number = self.name_number(as_type("float", number), node)
            if node.func.attr == "isnan":
                return lang.ScalarOperation("bool", "ne", (number, number))
            size = lang.ScalarOperation("float", "abs", (number,))
            return lang.ScalarOperation("bool", "lt", (size, lang.Constant("float", math.inf)))
        builtin = self.builtin_name(node.func)
        if builtin == "round" and len(node.args) == 1:
            (value,) = self.numbers_of(node.args)
            if value.type == "float":
                return lang.ScalarOperation("int", "round", (value,))
        if builtin == "bool" and len(node.args) == 1:
            return truth_value_of(self.expression(node.args[0]))
        if builtin is not None:
            return self.call_builtin(builtin, self.numbers_of(node.args), node)
        arguments = [x for a in node.args for x in self.argument(a)]
        called = (
            self.function_of_member(node.func)
            if isinstance(node.func, ast.Attribute)
            else self.called_meaning(node.func)
        )
        if isinstance(called, Address):
            return self.read_call_by_address(called, arguments, node)
        if isinstance(called, Piece):
            return self.read_piece(called, arguments, node)
        if isinstance(called, type) and issubclass(called, tuple) and hasattr(called, "_fields"):
            if len(called._fields) != len(arguments):
                raise Foreign("a record with other fields", node)
            return RecordValue(tuple(self.name_number(v, node) for v in arguments), called._fields)
        called = getattr(called, "compiled", called)  # also of interpreted functions
        plain = getattr(called, "py_func", None)
        if not isinstance(plain, python.FunctionType):
            raise Foreign("a call", node)
        if called.inlined and not (self.apart and _gives_numbers(called)):
            if called.contracted != self.source.contracted:
                raise Foreign(f"the function '{called.__name__}', whose sums are others", node)
            return self.copy_part(called, arguments, node)
        return self.call_part(called, arguments, node)

    def function_of_member(self, node: ast.Attribute) -> Any:
        """Return a function in a record or in a module."""
        if isinstance(node.value, ast.Name) and node.value.id not in self.bound:
            module = self.globals.get(node.value.id)
            if isinstance(module, python.ModuleType):
                return getattr(module, node.attr, None)
        return self.value(node)

    def called_meaning(self, node: ast.expr) -> Any:
        """Return the meaning of a called name."""
        if not isinstance(node, ast.Name):
            raise Foreign("a call", node)
        return self.bound[node.id] if node.id in self.bound else self.globals.get(node.id)

    def argument(self, node: ast.expr) -> list[Value]:
        """Return one argument of a call, or the elements of a tuple."""
        if not isinstance(node, ast.Starred):
            return self.values_in_order([node])
        value = self.value(node.value)
        if not isinstance(value, RecordValue):
            raise Foreign("arguments that are no tuple", node)
        return list(value.values)

    def read_call_by_address(self, called: Address, arguments: list[Value], node: ast.Call) -> lang.Expression:
        """Return the result of a function by its address."""
        result = SCALARS.get(called.signature.result)
        if result is None:
            raise Foreign("a function with other results", node)
        return lang.Invoke(result, called.name, pass_values(called.signature.arguments, arguments))

    def read_piece(self, called: Piece, arguments: list[Value], node: ast.Call) -> Value:
        """Return the result of a function in LLVM's language, or of its plain form."""
        if called.name == "bare" and len(arguments) == 1:
            return arguments[0]  # no reference counting here
        if called.name == "part" and len(arguments) == 3 and isinstance(arguments[0], Array):
            source, first, size = arguments
            view = self.new_array(source.type)
            size = self.name_number(size, node)
            self.pending.append(lang.ArrayView(view, source.name, first, size))
            return Array(view, source.type)
        if self.plain_piece is not None:
            return self.call_part(self.plain_piece(called), arguments, node)
        kinds: list[types.NumberType | types.ArrayType] = []
        for value in arguments:
            if isinstance(value, Array):
                kinds.append(types.ArrayType(NUMBERS[value.type], value.rank))
            elif isinstance(value, EXPRESSIONS):
                kinds.append(NUMBERS[value.type])
            else:
                raise Foreign("an argument of another kind", node)
        symbol, text = piece_text(called, tuple(kinds))
        nothing = called.result is types.void
        return lang.Insert(SCALARS.get(called.result, "int"), symbol, text, pass_values(kinds, arguments), nothing)

    def call_part(self, called: Any, arguments: list[Value], node: ast.Call) -> lang.Expression:
        """Return the result of a called part."""
        tree = tree_of_function(called)
        if len(tree.args.args) != len(arguments):
            raise Foreign(f"the function '{called.__name__}'", node)
        pairs = [value_in_callee(x.arg, v) for x, v in zip(tree.args.args, arguments, strict=True)]
        inside, parameters = tuple(v for v, _ in pairs), tuple(p for _, ps in pairs for p in ps)
        key = (called, parameters)
        if key not in self.shared:
            reader = LoopReader(called, inside, parameters, self.shared, self.plain_piece, self.apart)
            self.shared[key] = reader.function()
        function = self.called[called, parameters] = self.shared[key]  # type: ignore[index]  # its identity
        leaf_arguments = (
            v.name if isinstance(v, Array | Address) else v for v in leaves_of_value(RecordValue(tuple(arguments)))
        )
        return lang.FunctionCall(function.returned, function, tuple(leaf_arguments))

    def copy_part(self, called: Any, arguments: list[Value], node: ast.Call) -> Value:
        """Return the result of a part whose code is copied to its call."""
        tree = tree_of_function(called)
        if len(tree.args.args) != len(arguments) or len(self.copies) > 20:
            raise Foreign(f"the function '{called.__name__}'", node)
        names = {name: self.fresh_name(name) for name in called.py_func.__code__.co_varnames}  # in an order that stays
        body = [Renamed(names).visit(statement) for statement in statements_without_docstring(tree)]
        assigned = {x.id for s in body for x in ast.walk(s) if isinstance(x, ast.Name) and isinstance(x.ctx, ast.Store)}
        for x, value in zip(tree.args.args, arguments, strict=True):
            name = names[x.arg]
            if isinstance(value, EXPRESSIONS) and (name in assigned or not isinstance(value, lang.Constant)):
                self.note_type(name, value.type, node)
                self.pending.append(lang.Assign(name, value))
            else:
                self.bound[name] = value
        before = self.globals, self.locals, self.depth, self.loops
        self.globals, self.locals = called.py_func.__globals__, frozenset(names.values())
        single = _ends_once(body)
        self.count += 1
        copied = _Copied(self.count, self.fresh_name("result"))
        self.depth = self.loops = 0
        self.copies.append(copied)
        statements = self.statements(body)
        self.copies.pop()
        self.globals, self.locals, self.depth, self.loops = before
        if statements and statements[-1] == lang.Leave("block", copied.block):
            statements = statements[:-1]
        self.pending += list(statements) if single else [lang.StatementBlock(copied.block, statements)]
        if copied.result in self.bound:
            return self.bound[copied.result]
        if copied.result in self.variables:
            return lang.Variable(self.variables[copied.result], copied.result)
        return NOTHING


def _gives_numbers(function: Any) -> bool:
    """Whether results of a function are numbers, so that it may be called: records and arrays have no address."""
    plain = function.py_func
    if hasattr(plain, "viewing"):
        return False
    results = [
        x.value for x in ast.walk(tree_of_function(function)) if isinstance(x, ast.Return) and x.value is not None
    ]
    names = [x.func.id for x in results if isinstance(x, ast.Call) and isinstance(x.func, ast.Name)]
    made = (plain.__globals__.get(name) for name in names)
    records = any(isinstance(x, type) and hasattr(x, "_fields") for x in made)
    return not records and not any(isinstance(x, ast.Tuple) for x in results)


def _ends_once(body: list[ast.stmt]) -> bool:
    """Whether a function returns at its end only."""
    returns = [x for statement in body for x in ast.walk(statement) if isinstance(x, ast.Return)]
    return not returns or (len(returns) == 1 and returns[0] is body[-1])
