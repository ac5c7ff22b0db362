"""From the source of the runtime's loops to the checked language of `symgen.native.language`.

A loop is written in Python with records of arrays and numbers, functions that are known by their address, and parts
that are copied into it (`symgen.runtime.instances`). All of that is known before anything runs: records, tuples and
views of arrays exist while the source is read and leave nothing but names of arrays, numbers and addresses. What else
stands in a loop is what emitted functions have, read by the same rules.

What is not in this language is `Foreign`: then the loop is Numba's to compile.
"""

from __future__ import annotations

import ast
import math
import types as python
from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

from numba import types
from numba.extending import _Intrinsic as Intrinsic

from symgen.native import language as lang
from symgen.native.intrinsics import inserted
from symgen.native.read import Reader, returns
from symgen.native.read_values import Foreign, as_type, number, truth_of

_SCALARS: dict[Any, lang.Scalar] = {types.float64: "float", types.int64: "int", types.boolean: "bool"}


class Array(NamedTuple):
    """An array, by its name in the function."""

    name: str
    type: lang.Scalar
    rank: int = 1


class Address(NamedTuple):
    """A function that is known by its address, by its name in the function; and how it is called."""

    name: str
    signature: Any


class Record(NamedTuple):
    """A tuple, with the names of its fields where it has such."""

    values: tuple[Any, ...]
    fields: tuple[str, ...] = ()


#: What a name may stand for: a number, an array, a function, or a record of such.
Value = Any
#: What is left out where a function is copied that gives nothing.
NOTHING = Record(())


def read_loop(
    function: Any, arguments: tuple[Any, ...], definition: Callable[[Any], ast.FunctionDef | None]
) -> lang.Function:
    """Return a loop with the types that follow from those of its arguments.

    Parameters
    ----------
    function : Dispatcher
        Its Python function is the loop.
    arguments : tuple of Numba types
        Of its arguments.
    definition : Callable
        Gives the syntax tree of a function, None where it is not to be read.

    Raises
    ------
    Foreign
        If it is not in the language.
    """
    names = function.py_func.__code__.co_varnames
    pairs = [laid_out(name, kind) for name, kind in zip(names, arguments, strict=False)]
    parameters = tuple(p for _, ps in pairs for p in ps)
    return LoopReader(function, tuple(v for v, _ in pairs), parameters, definition, {}).function()


def laid_out(name: str, kind: Any) -> tuple[Value, list[lang.Parameter]]:
    """Return what an argument is, and the parameters that it takes.

    Parameters
    ----------
    name : str
        Of the argument.
    kind : Numba type
        Its type.

    Raises
    ------
    Foreign
        If it is none of the types of loops.
    """
    if kind in _SCALARS:
        return lang.Variable(_SCALARS[kind], name), [lang.Parameter(name, _SCALARS[kind])]
    if isinstance(kind, types.FunctionType):
        return Address(name, kind.signature), [lang.Parameter(name, "int", address=True)]
    if isinstance(kind, types.Array) and kind.layout == "C" and kind.ndim <= 3 and kind.dtype in _SCALARS:
        found = Array(name, _SCALARS[kind.dtype], kind.ndim)
        return found, [lang.Parameter(name, found.type, True, kind.ndim)]
    if isinstance(kind, types.BaseTuple):
        fields = tuple(getattr(kind, "fields", ()))
        names = fields or tuple(str(i) for i in range(len(kind)))
        parts = [laid_out(f"{name}.{field}", part) for field, part in zip(names, kind, strict=True)]
        return Record(tuple(v for v, _ in parts), fields), [p for _, ps in parts for p in ps]
    raise Foreign(f"an argument of type {kind}")


def leaves(value: Value) -> Iterator[Value]:
    """Yield numbers, arrays and functions of a value in their order."""
    if isinstance(value, Record):
        for part in value.values:
            yield from leaves(part)
    else:
        yield value


def handed_on(kinds: Sequence[Any], values: Sequence[Value]) -> tuple[lang.Expression | str, ...]:
    """Return what values of some types are handed on as."""
    if len(kinds) != len(values):
        raise Foreign("a function with other arguments")
    return tuple(x for kind, value in zip(kinds, values, strict=True) for x in handed(kind, value))


def handed(kind: Any, value: Value) -> Iterator[lang.Expression | str]:
    """Yield what a value of a type is handed on as: numbers, and names of arrays and functions.

    Raises
    ------
    Foreign
        If it is none of the type.
    """
    if isinstance(value, Record) and isinstance(kind, types.BaseTuple) and len(kind) == len(value.values):
        for part, item in zip(kind, value.values, strict=True):
            yield from handed(part, item)
    elif isinstance(value, Array) and isinstance(kind, types.Array):
        if _SCALARS.get(kind.dtype) != value.type or kind.ndim != value.rank:
            raise Foreign("an array of another kind")
        yield value.name
    elif isinstance(value, Address) and isinstance(kind, types.FunctionType) and kind.signature == value.signature:
        yield value.name
    elif kind in _SCALARS and _is_number(value):
        yield as_type(_SCALARS[kind], value)
    else:
        raise Foreign(f"an argument that is no {kind}")


def renamed(name: str, value: Value) -> tuple[Value, list[lang.Parameter]]:
    """Return a value as a function sees it that it is handed to, and the parameters that it takes."""
    if isinstance(value, Record):
        parts = [renamed(f"{name}.{i}", part) for i, part in enumerate(value.values)]
        return Record(tuple(v for v, _ in parts), value.fields), [p for _, ps in parts for p in ps]
    if isinstance(value, Array):
        return Array(name, value.type, value.rank), [lang.Parameter(name, value.type, True, value.rank)]
    if isinstance(value, Address):
        return Address(name, value.signature), [lang.Parameter(name, "int", address=True)]
    return lang.Variable(value.type, name), [lang.Parameter(name, value.type)]


class _Copied(NamedTuple):
    """A function that is being copied into another: where it ends, and the variable for what it returns."""

    block: int
    result: str


class LoopReader(Reader):
    """Reads a loop, or a part that loops call.

    Parameters
    ----------
    function : Dispatcher
        Its Python function is the loop.
    arguments : tuple
        What the arguments are.
    parameters : tuple of Parameter
        What they take.
    definition : Callable
        Gives the syntax tree of a function, None where it is not to be read.
    shared : dict
        Called parts read so far, by what they are called with.
    """

    def __init__(
        self,
        function: Any,
        arguments: tuple[Value, ...],
        parameters: tuple[lang.Parameter, ...],
        definition: Callable[[Any], ast.FunctionDef | None],
        shared: dict[Any, lang.Function],
    ) -> None:
        tree = definition(function)
        if tree is None:
            raise Foreign(f"the function '{function.__name__}'")
        super().__init__(function, ast.FunctionDef(name="", args=_NONE, body=[], decorator_list=[]), (), definition, ())
        self.tree, self.parameters, self.shared = tree, parameters, shared
        self.arrays = {p.name: p.type for p in parameters if p.array}
        self.ranks = {p.name: p.rank for p in parameters if p.array}
        self.numbers = {p.name: p.type for p in parameters if not p.array and not p.address}
        self.pending: list[lang.Statement] = []
        self.copies: list[_Copied] = []
        self.bound: dict[str, Value] = {}
        self.count = 0
        names = [x.arg for x in tree.args.args]
        if len(names) != len(arguments):
            raise Foreign("arguments other than plain ones", tree)
        # an argument that is a number has its own name, and may be given another value
        self.bound = {n: v for n, v in zip(names, arguments, strict=True) if not isinstance(v, lang.Variable)}

    def function(self) -> lang.Function:
        """Return the function."""
        statements = self.statements(_body(self.tree))
        if not returns(statements):  # nothing is returned: a 0 that nobody asks for
            self.returned.add("int")
            statements = (*statements, lang.Return(lang.Constant("int", 0)))
        if len(self.returned) != 1:
            raise Foreign("results of different types", self.tree)
        fixed = {name for name, count in self.assigned.items() if count == 1 and name in self.variables}
        return lang.Function(
            name=self.source.__name__,
            parameters=self.parameters,
            returned=next(iter(self.returned)),
            body=statements,
            variables=self.variables,
            fixed=frozenset(fixed),
            tables=self.tables,
            called=tuple(self.called.values()),
            source=self.source,
        )

    # -- statements

    def statement(self, node: ast.stmt) -> list[lang.Statement]:
        """Return what a statement does, behind what it needs to have been done."""
        outer, self.pending = self.pending, []
        found = self._statement(node)
        found, self.pending = [*self.pending, *found], outer
        return found

    def _statement(self, node: ast.stmt) -> list[lang.Statement]:
        if isinstance(node, ast.Return):
            return self.end(node)
        if isinstance(node, ast.If):
            test = self.truth(node.test)
            if isinstance(test, lang.Constant):
                return list(self.statements(node.body if test.value else node.orelse))
            return [lang.If(test, self.inner(node.body), self.inner(node.orelse))]
        if isinstance(node, ast.While) and not node.orelse:
            return [self.repeat(node)]
        if isinstance(node, ast.For) and isinstance(node.iter, ast.Tuple):
            return self.unrolled(node)
        if isinstance(node, ast.AnnAssign) and node.value is not None:
            return self.assignment(ast.copy_location(ast.Assign([node.target], node.value), node))
        if isinstance(node, ast.Expr):
            value = self.value(node.value)
            return [lang.Evaluate(value)] if isinstance(value, lang.Call | lang.Invoke | lang.Insert) else []
        return super().statement(node)

    def repeat(self, node: ast.While) -> lang.Statement:
        """Return a loop with a test, which may need statements of its own."""
        outer, self.pending = self.pending, []
        self.depth += 1
        test = self.truth(node.test)
        self.depth -= 1
        before, self.pending = self.pending, outer
        body = self.inner(node.body, loop=True)
        if not before:
            return lang.While(test, body)
        leave = lang.If(lang.Operation("bool", "not", (test,)), (lang.Leave("break"),), ())
        return lang.While(lang.Constant("bool", True), (*before, leave, *body))

    def unrolled(self, node: ast.For) -> list[lang.Statement]:
        """Return what is done for each of some values."""
        if node.orelse or any(isinstance(x, ast.Break | ast.Continue) for s in node.body for x in ast.walk(s)):
            raise Foreign("the end of a loop over a tuple", node)
        found: list[lang.Statement] = []
        for value in self.value(node.iter).values:
            found += [*self.stored(node.target, value), *self.inner(node.body)]
        return found

    def end(self, node: ast.Return) -> list[lang.Statement]:
        """Return the end of the function, or of one that is copied into it."""
        if not self.copies:
            value = lang.Constant("int", 0) if node.value is None else self.expression(node.value)
            self.returned.add(value.type)
            return [lang.Return(value)]
        copied, found = self.copies[-1], list[lang.Statement]()
        if node.value is not None:
            value = self.value(node.value)
            if _is_number(value):
                self.give(copied.result, value.type, node)
                found.append(lang.Assign(copied.result, value))
            else:
                if copied.result in self.bound or self.depth:
                    raise Foreign("several results that are no numbers", node)
                self.bound[copied.result] = value
        return [*found, lang.Leave("block", copied.block)]

    def assignment(self, node: ast.Assign) -> list[lang.Statement]:
        """Return what an assignment does; all values are worked out before the first of them is stored."""
        value = self.value(node.value)
        if len(node.targets) > 1:
            value = self.kept(value, node)
        return [s for target in node.targets for s in self.stored(target, value)]

    def kept(self, value: Value, node: ast.AST) -> Value:
        """Return a value that later statements do not change: a number is given a name."""
        if not isinstance(value, _EXPRESSIONS) or isinstance(value, lang.Constant):
            return value
        name = self.fresh("")
        self.give(name, value.type, node)
        self.pending.append(lang.Assign(name, value))
        return lang.Variable(value.type, name)

    def stored(self, target: ast.expr, value: Value) -> list[lang.Statement]:
        """Return the assignment of a value to a name or an element, or of several to several."""
        if isinstance(target, ast.Tuple):
            values = list(value.values) if isinstance(value, Record) else []
            if len(values) != len(target.elts):
                raise Foreign("an assignment of unequal lengths", target)
            return [s for t, v in zip(target.elts, values, strict=True) for s in self.stored(t, v)]
        if isinstance(value, _EXPRESSIONS):
            if isinstance(target, ast.Name) and target.id in self.bound:
                raise Foreign(f"variable '{target.id}' has two types", target)
            return [self.store(target, value)]
        if not isinstance(target, ast.Name) or target.id in self.variables or target.id in self.numbers:
            raise Foreign("a target of an assignment", target)
        if self.depth and self.bound.get(target.id, value) != value:
            raise Foreign(f"'{target.id}' stands for different things", target)
        self.bound[target.id] = value
        return []

    # -- values

    def fresh(self, name: str) -> str:
        """Return a name that is no name of Python's."""
        self.count += 1
        return f"{name}..{self.count}"

    def expression(self, node: ast.expr) -> lang.Expression:
        """Return the value of an expression that is a number."""
        value = self.value(node)
        if not _is_number(value):
            raise Foreign("something that is no number", node)
        found: lang.Expression = value
        return found

    def value(self, node: ast.expr) -> Value:
        """Return the value of an expression, which may be a record, an array or a function as well."""
        if isinstance(node, ast.Tuple):
            return Record(tuple(self.kept(v, node) for v in self.several(node.elts)))
        if isinstance(node, ast.Name) and node.id in self.bound:
            return self.bound[node.id]
        if isinstance(node, ast.IfExp):
            return self.choice(node)
        return super().expression(node)

    def several(self, nodes: list[ast.expr]) -> list[Value]:
        """Return values in their order: what a later one needs to have been done does not change an earlier one."""
        values: list[Value] = []
        for node in nodes:
            before = len(self.pending)
            value = self.value(node)
            if len(self.pending) > before and any(
                isinstance(v, _EXPRESSIONS) and not isinstance(v, lang.Constant) for v in values
            ):
                behind, self.pending = self.pending[before:], self.pending[:before]
                values = [self.kept(v, node) for v in values]
                self.pending += behind
            values.append(value)
        return values

    def numbers_of(self, nodes: list[ast.expr]) -> list[lang.Expression]:
        """Return values that are numbers."""
        values = self.several(nodes)
        if not all(_is_number(v) for v in values):
            raise Foreign("something that is no number", nodes[0])
        return values

    def attribute(self, node: ast.Attribute) -> Value:
        """Return a field of a record, a number of a module, or what NumPy calls the shape."""
        if isinstance(node.value, ast.Name) and node.value.id not in self.bound:
            module = self.globals.get(node.value.id)
            if isinstance(module, python.ModuleType) and node.value.id not in self.variables:
                return number(getattr(module, node.attr), node)
        owner = self.value(node.value)
        if isinstance(owner, Record) and node.attr in owner.fields:
            return owner.values[owner.fields.index(node.attr)]
        if isinstance(owner, Array) and node.attr == "shape":
            return Record(tuple(lang.Shape(owner.name, axis) for axis in range(owner.rank)))
        if isinstance(owner, Array) and node.attr == "size" and owner.rank == 1:
            return lang.Shape(owner.name)
        raise Foreign("an attribute", node)

    def element(self, node: ast.Subscript) -> Value:
        """Return an element of an array or of a tuple."""
        if isinstance(node.value, ast.Attribute | ast.Name):
            owner = self.owner(node.value)
            if isinstance(owner, Record):
                index = self.expression(node.slice)
                if isinstance(index, lang.Constant) and 0 <= int(index.value) < len(owner.values):
                    return owner.values[int(index.value)]
                raise Foreign("an index", node)
            if isinstance(owner, Array) and isinstance(node.slice, ast.Slice):
                return self.one(owner, node.slice)
            if isinstance(owner, Array) and (given := _indices(node)) < owner.rank:
                return self.behind(owner, node, given)
        return super().element(node)

    def behind(self, array: Array, node: ast.Subscript, given: int) -> Array:
        """Return what stands behind some indices, as an array of fewer dimensions."""
        nodes = list(node.slice.elts) if isinstance(node.slice, ast.Tuple) else [node.slice]
        indices = [*self.numbers_of(nodes), *(lang.Constant("int", 0),) * (array.rank - given)]
        name = self.array(array.type, array.rank - given)
        self.pending.append(lang.View(name, array.name, self.at(array, indices, node), None, given))
        return Array(name, array.type, array.rank - given)

    def at(self, array: Array, indices: list[lang.Expression], node: ast.AST) -> lang.Expression:
        """Return where an element stands."""
        if len(indices) != array.rank or any(
            i.type != "int" or (isinstance(i, lang.Constant) and i.value < 0) for i in indices
        ):
            raise Foreign("an index", node)
        at = indices[0]
        for axis, index in enumerate(indices[1:], 1):
            row = lang.Operation("int", "mul", (at, lang.Shape(array.name, axis)))
            at = lang.Operation("int", "add", (row, index))
        return at

    def one(self, array: Array, part: ast.Slice) -> Array:
        """Return one row of an array, ``[k : k + 1]``, as an array of the same dimensions."""
        if part.lower is None or part.step is not None or part.upper is None:
            raise Foreign("a part of an array", part)
        behind = ast.BinOp(part.lower, ast.Add(), ast.Constant(1))
        if ast.dump(part.upper) != ast.dump(behind):
            raise Foreign("a part of an array", part)
        (at,) = self.numbers_of([part.lower])
        name = self.array(array.type, array.rank)
        for axis in range(1, array.rank):
            at = lang.Operation("int", "mul", (at, lang.Shape(array.name, axis)))
        self.pending.append(lang.View(name, array.name, at, lang.Constant("int", 1)))
        return Array(name, array.type, array.rank)

    def owner(self, node: ast.expr) -> Value:
        """Return what something is an element of; None for a table of the module."""
        if isinstance(node, ast.Name) and node.id not in self.bound:
            return None
        return self.value(node)

    def place(self, node: ast.Subscript) -> tuple[str, lang.Expression]:
        """Return array and index of an element."""
        owner = self.owner(node.value)
        if owner is None:
            return super().place(node)
        if not isinstance(owner, Array):
            raise Foreign("an element of something else than an array", node)
        nodes = list(node.slice.elts) if isinstance(node.slice, ast.Tuple) else [node.slice]
        return owner.name, self.at(owner, self.numbers_of(nodes), node)

    def unary(self, node: ast.UnaryOp) -> lang.Expression:
        """Return an operation on one value."""
        if isinstance(node.op, ast.Not):
            value = self.truth(node.operand)
            if isinstance(value, lang.Constant):
                return lang.Constant("bool", not value.value)
            return lang.Operation("bool", "not", (value,))
        return super().unary(node)

    def binary(self, node: ast.BinOp) -> lang.Expression:
        """Return an operation on two values."""
        left, right = self.numbers_of([node.left, node.right])
        if left.type == right.type == "int" and not isinstance(right, lang.Constant):
            if isinstance(node.op, ast.FloorDiv | ast.Mod):
                name = "quotient" if isinstance(node.op, ast.FloorDiv) else "rest"
                return lang.Operation("int", name, (left, right))
        sign = self.sign(node)
        if sign == "pow" and left.type == "int" and isinstance(right, lang.Constant) and right.value == 2:
            left = self.kept(left, node)
            return lang.Operation("int", "mul", (left, left))
        return self.arithmetic(sign, left, right, node)

    def comparison(self, node: ast.Compare) -> lang.Expression:
        """Return one comparison or several in a row."""
        values = self.numbers_of([node.left, *node.comparators])
        if len(values) > 2:
            values = [self.kept(v, node) for v in values]  # none is worked out twice
        found: lang.Expression | None = None
        for sign, left, right in zip(node.ops, values, values[1:], strict=False):
            test = self.compared(sign, left, right, node)
            found = test if found is None else lang.Logic("and", found, test)
        assert found is not None, "a comparison compares"
        return found

    def logic(self, node: ast.BoolOp) -> lang.Expression:
        """Return ``and`` or ``or`` of booleans; what is known to be true or false decides what is read at all."""
        deciding = isinstance(node.op, ast.Or)
        found: list[lang.Expression] = []
        for value_node in node.values:
            before = len(self.pending)
            value = self.expression(value_node)
            if value.type != "bool":
                raise Foreign("'and' or 'or' of numbers", node)
            if found and len(self.pending) > before:
                behind, self.pending = self.pending[before:], self.pending[:before]
                name = self.fresh("decided")
                self.depth += 1
                self.give(name, "bool", node)
                self.depth -= 1
                test = self.joined(found, deciding)
                if not deciding:
                    chosen = lang.If(test, (*behind, lang.Assign(name, value)), (_given(name, False),))
                else:
                    chosen = lang.If(test, (_given(name, True),), (*behind, lang.Assign(name, value)))
                self.pending.append(chosen)
                found = [lang.Variable("bool", name)]
                continue
            if isinstance(value, lang.Constant):
                if value.value is deciding:
                    found.append(value)
                    break
                continue
            found.append(value)
        if not found:
            return lang.Constant("bool", not deciding)
        return self.joined(found, deciding)

    def joined(self, values: list[lang.Expression], deciding: bool) -> lang.Expression:
        """Return ``and`` of booleans that False decides, or ``or`` of those that True does."""
        *first, last = values
        for earlier in reversed(first):
            last = lang.Logic("or" if deciding else "and", earlier, last)
        return last

    def choice(self, node: ast.IfExp) -> Value:
        """Return one of two values, of which only that one is worked out."""
        test = self.truth(node.test)
        if isinstance(test, lang.Constant):
            return self.value(node.body if test.value else node.orelse)
        outer, values, needed = self.pending, list[Value](), list[list[lang.Statement]]()
        self.depth += 1
        for part in (node.body, node.orelse):
            self.pending = []
            values.append(self.value(part))
            needed.append(self.pending)
        self.depth, self.pending = self.depth - 1, outer
        chosen, otherwise = values
        if any(needed) or isinstance(chosen, Record):
            return self.decided(test, values, needed, node)
        if isinstance(chosen, Array) and isinstance(otherwise, Array) and chosen.type == otherwise.type:
            name = self.array(chosen.type)
            self.pending.append(lang.Pick(name, test, chosen.name, otherwise.name))
            return Array(name, chosen.type)
        if not isinstance(chosen, _EXPRESSIONS) or not isinstance(otherwise, _EXPRESSIONS):
            raise Foreign("a choice between things that are no numbers", node)
        return self.chosen(test, chosen, otherwise, node)

    def decided(
        self, test: lang.Expression, values: list[Value], needed: list[list[lang.Statement]], node: ast.AST
    ) -> Value:
        """Return one of two values that need statements, or are records of numbers."""
        first, second = (list(leaves(value)) for value in values)
        if len(first) != len(second) or any(
            not _is_number(a) or not _is_number(b) or a.type != b.type for a, b in zip(first, second, strict=True)
        ):
            raise Foreign("a choice between things that are no numbers", node)
        names = [self.fresh("chosen") for _ in first]
        for name, value in zip(names, first, strict=True):
            self.depth += 1
            self.give(name, value.type, node)
            self.depth -= 1
        then, otherwise = (
            (*before, *(lang.Assign(name, v) for name, v in zip(names, branch, strict=True)))
            for before, branch in zip(needed, (first, second), strict=True)
        )
        self.pending.append(lang.If(test, then, otherwise))
        found = tuple(lang.Variable(value.type, name) for name, value in zip(names, first, strict=True))
        return Record(found) if isinstance(values[0], Record) else found[0]

    def array(self, kind: lang.Scalar, rank: int = 1) -> str:
        """Return the name of a new array."""
        name = self.fresh("array")
        self.arrays[name], self.ranks[name] = kind, rank
        return name

    # -- calls

    def call(self, node: ast.Call) -> Value:
        """Return what a function gives."""
        if node.keywords:
            raise Foreign("arguments by name", node)
        if isinstance(node.func, ast.Attribute) and self.of_math(node.func) and node.func.attr == "isfinite":
            (value,) = self.numbers_of(node.args)
            size = lang.Operation("float", "abs", (as_type("float", value),))
            return lang.Operation("bool", "lt", (size, lang.Constant("float", math.inf)))
        if isinstance(node.func, ast.Attribute) and self.of_math(node.func) and node.func.attr == "isnan":
            (value,) = self.numbers_of(node.args)
            value = self.kept(as_type("float", value), node)
            return lang.Operation("bool", "ne", (value, value))
        builtin = self.builtin(node.func)
        if builtin == "round" and len(node.args) == 1:
            (value,) = self.numbers_of(node.args)
            if value.type == "float":
                return lang.Operation("int", "round", (value,))
        if builtin == "bool" and len(node.args) == 1:
            return truth_of(self.expression(node.args[0]))
        if builtin is not None:
            return self.call_builtin(builtin, self.numbers_of(node.args), node)
        if isinstance(node.func, ast.Attribute) and self.of_math(node.func):
            return super().call(node)
        arguments = [x for a in node.args for x in self.argument(a)]
        if isinstance(node.func, ast.Attribute):
            called = self.member(node.func)
        else:
            called = self.meant(node.func)
        if isinstance(called, Address):
            return self.invoke(called, arguments, node)
        if isinstance(called, Intrinsic):
            return self.insert(called, arguments, node)
        if isinstance(called, type) and issubclass(called, tuple) and hasattr(called, "_fields"):
            if len(called._fields) != len(arguments):
                raise Foreign("a record with other fields", node)
            return Record(tuple(self.kept(v, node) for v in arguments), called._fields)
        called = getattr(called, "compiled", called)  # of functions that are interpreted as well
        plain = getattr(called, "py_func", None)
        if not isinstance(plain, python.FunctionType):
            raise Foreign("a call", node)
        if called.targetoptions.get("forceinline"):
            if called.targetoptions.get("fastmath") != self.source.targetoptions.get("fastmath"):
                raise Foreign(f"the function '{called.__name__}', whose sums are others", node)
            return self.copy(called, arguments, node)
        return self.call_part(called, arguments, node)

    def member(self, node: ast.Attribute) -> Any:
        """Return a function in a record or in a module."""
        if isinstance(node.value, ast.Name) and node.value.id not in self.bound:
            module = self.globals.get(node.value.id)
            if isinstance(module, python.ModuleType):
                return getattr(module, node.attr, None)
        return self.value(node)

    def meant(self, node: ast.expr) -> Any:
        """Return what a called name means."""
        if not isinstance(node, ast.Name):
            raise Foreign("a call", node)
        return self.bound[node.id] if node.id in self.bound else self.globals.get(node.id)

    def argument(self, node: ast.expr) -> list[Value]:
        """Return one argument of a call, or those of a tuple."""
        if not isinstance(node, ast.Starred):
            return self.several([node])
        value = self.value(node.value)
        if not isinstance(value, Record):
            raise Foreign("arguments that are no tuple", node)
        return list(value.values)

    def invoke(self, called: Address, arguments: list[Value], node: ast.Call) -> lang.Expression:
        """Return what a function gives that is known by its address."""
        if called.signature.return_type is not types.int64:
            raise Foreign("a function with other results", node)
        return lang.Invoke("int", called.name, handed_on(called.signature.args, arguments))

    def insert(self, called: Any, arguments: list[Value], node: ast.Call) -> Value:
        """Return what a piece of a compiler gives."""
        name = called._name
        if name == "_bare" and len(arguments) == 1:
            return arguments[0]  # nothing counts references here
        if name == "_part" and len(arguments) == 3 and isinstance(arguments[0], Array):
            source, first, size = arguments
            view = self.array(source.type)
            size = self.kept(size, node)
            self.pending.append(lang.View(view, source.name, first, size))
            return Array(view, source.type)
        kinds: list[Any] = []
        for value in arguments:
            if isinstance(value, Array):
                kinds.append(types.Array(_NUMBERS[value.type], value.rank, "C"))
            elif isinstance(value, _EXPRESSIONS):
                kinds.append(_NUMBERS[value.type])
            else:
                raise Foreign("an argument of another kind", node)
        piece = inserted(called, tuple(kinds))
        if piece is None:
            raise Foreign(f"the function '{name}'", node)
        symbol, text, signature = piece
        nothing = signature.return_type is types.void
        given = handed_on(signature.args, arguments)
        return lang.Insert(_SCALARS.get(signature.return_type, "int"), symbol, text, given, nothing)

    def call_part(self, called: Any, arguments: list[Value], node: ast.Call) -> lang.Expression:
        """Return what a part gives that is called."""
        tree = self.definition(called)
        if tree is None or len(tree.args.args) != len(arguments):
            raise Foreign(f"the function '{called.__name__}'", node)
        pairs = [renamed(x.arg, v) for x, v in zip(tree.args.args, arguments, strict=True)]
        inside, parameters = tuple(v for v, _ in pairs), tuple(p for _, ps in pairs for p in ps)
        key = (called, parameters)
        if key not in self.shared:
            reader = LoopReader(called, inside, parameters, self.definition, self.shared)
            self.shared[key] = reader.function()
        function = self.called[called, parameters] = self.shared[key]  # type: ignore[index]  # what tells it from others
        given = (v.name if isinstance(v, Array | Address) else v for v in leaves(Record(tuple(arguments))))
        return lang.Call(function.returned, function, tuple(given))

    def copy(self, called: Any, arguments: list[Value], node: ast.Call) -> Value:
        """Return what a part gives whose code is copied to where it is called."""
        tree = self.definition(called)
        if tree is None or len(tree.args.args) != len(arguments) or len(self.copies) > 20:
            raise Foreign(f"the function '{called.__name__}'", node)
        own = frozenset(called.py_func.__code__.co_varnames)
        names = {name: self.fresh(name) for name in own}
        body = [_Renamed(names).visit(statement) for statement in _body(tree)]
        assigned = {x.id for s in body for x in ast.walk(s) if isinstance(x, ast.Name) and isinstance(x.ctx, ast.Store)}
        for x, value in zip(tree.args.args, arguments, strict=True):
            name = names[x.arg]
            if isinstance(value, _EXPRESSIONS) and (name in assigned or not isinstance(value, lang.Constant)):
                self.give(name, value.type, node)
                self.pending.append(lang.Assign(name, value))
            else:
                self.bound[name] = value
        before = self.globals, self.locals, self.depth, self.loops
        self.globals, self.locals = called.py_func.__globals__, frozenset(names.values())
        single = _ends_once(body)
        self.count += 1
        copied = _Copied(self.count, self.fresh("result"))
        self.depth = self.loops = 0
        self.copies.append(copied)
        statements = self.statements(body)
        self.copies.pop()
        self.globals, self.locals, self.depth, self.loops = before
        if statements and statements[-1] == lang.Leave("block", copied.block):
            statements = statements[:-1]
        self.pending += list(statements) if single else [lang.Block(copied.block, statements)]
        if copied.result in self.bound:
            return self.bound[copied.result]
        if copied.result in self.variables:
            return lang.Variable(self.variables[copied.result], copied.result)
        return NOTHING


def _given(name: str, value: bool) -> lang.Statement:
    return lang.Assign(name, lang.Constant("bool", value))


class _Renamed(ast.NodeTransformer):
    """Gives local variables other names."""

    def __init__(self, names: dict[str, str]) -> None:
        self.names = names

    def visit_Name(self, node: ast.Name) -> ast.Name:
        """Return a name under its other name."""
        return ast.copy_location(ast.Name(self.names.get(node.id, node.id), node.ctx), node)


def _indices(node: ast.Subscript) -> int:
    return len(node.slice.elts) if isinstance(node.slice, ast.Tuple) else 1


def _is_number(value: Value) -> bool:
    """Whether a value is a number."""
    return isinstance(value, _EXPRESSIONS) and not (isinstance(value, lang.Insert) and value.nothing)


def _body(tree: ast.FunctionDef) -> list[ast.stmt]:
    """Return the statements of a function without its docstring."""
    body = tree.body
    return body[1:] if isinstance(body[0], ast.Expr) and isinstance(body[0].value, ast.Constant) else body


def _ends_once(body: list[ast.stmt]) -> bool:
    """Whether a function has no return but at its end."""
    returns = [x for statement in body for x in ast.walk(statement) if isinstance(x, ast.Return)]
    return not returns or (len(returns) == 1 and returns[0] is body[-1])


_NONE = ast.arguments(posonlyargs=[], args=[], kwonlyargs=[], kw_defaults=[], defaults=[])
_NUMBERS: dict[Any, Any] = {kind: number_type for number_type, kind in _SCALARS.items()}
_EXPRESSIONS = (
    lang.Constant,
    lang.Variable,
    lang.Element,
    lang.Operation,
    lang.Logic,
    lang.Choice,
    lang.Call,
    lang.Shape,
    lang.Invoke,
    lang.Insert,
)
