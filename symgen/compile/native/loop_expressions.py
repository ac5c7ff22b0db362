"""Expressions in the source of loops: numbers as in emitted functions, or records, arrays and functions.

Where an expression needs statements, for instance those of a function copied into its caller, they are put before the
statement of the expression; values computed before them do not change.
"""

from __future__ import annotations

import ast
import types as python

from symgen.compile.native import language as lang
from symgen.compile.native.loop_values import EXPRESSIONS, Array, RecordValue, Value, is_number, leaves_of_value
from symgen.compile.native.read import Reader
from symgen.compile.native.read_values import Foreign, number_value


class LoopValues(Reader):
    """Reads expressions with records and arrays of several dimensions.

    Parameters
    ----------
    function : MachineFunction
        Wrapper of the Python function.
    tree : FunctionDef
        Its syntax tree.
    arguments : dict of str to object
        Values of arguments other than numbers.
    parameters : tuple of Parameter
        Parameters of all arguments.
    """

    def __init__(
        self,
        function: object,
        tree: ast.FunctionDef,
        arguments: dict[str, Value],
        parameters: tuple[lang.FunctionParameter, ...],
    ) -> None:
        super().__init__(function, tree, parameters)
        self.bound = arguments
        self.pending: list[lang.Statement] = []
        self.count = 0

    def name_number(self, value: Value, node: ast.AST) -> Value:
        """Return a value that later statements do not change: a number gets a name."""
        if not isinstance(value, EXPRESSIONS) or isinstance(value, lang.Constant):
            return value
        name = self.fresh_name("")
        self.note_type(name, value.type, node)
        self.pending.append(lang.Assign(name, value))
        return lang.Variable(value.type, name)

    def fresh_name(self, name: str) -> str:
        """Return a name that is no Python name."""
        self.count += 1
        return f"{name}..{self.count}"

    def expression(self, node: ast.expr) -> lang.Expression:
        """Return the value of an expression that is a number."""
        value = self.value(node)
        if not is_number(value):
            raise Foreign("something that is no number", node)
        number: lang.Expression = value
        return number

    def value(self, node: ast.expr) -> Value:
        """Return the value of an expression: a number, a record, an array or a function."""
        if isinstance(node, ast.Tuple):
            return RecordValue(tuple(self.name_number(v, node) for v in self.values_in_order(node.elts)))
        if isinstance(node, ast.Name) and node.id in self.bound:
            return self.bound[node.id]
        if isinstance(node, ast.IfExp):
            return self.choice(node)
        return super().expression(node)

    def values_in_order(self, nodes: list[ast.expr]) -> list[Value]:
        """Return values in their order: statements of a later one do not change an earlier one."""
        values: list[Value] = []
        for node in nodes:
            before = len(self.pending)
            value = self.value(node)
            if len(self.pending) > before and any(
                isinstance(v, EXPRESSIONS) and not isinstance(v, lang.Constant) for v in values
            ):
                behind, self.pending = self.pending[before:], self.pending[:before]
                values = [self.name_number(v, node) for v in values]
                self.pending += behind
            values.append(value)
        return values

    def numbers_of(self, nodes: list[ast.expr]) -> list[lang.Expression]:
        """Return values that are numbers."""
        values = self.values_in_order(nodes)
        if not all(is_number(v) for v in values):
            raise Foreign("something that is no number", nodes[0])
        return values

    def attribute(self, node: ast.Attribute) -> Value:
        """Return a field of a record, a number of a module, or a shape in the sense of NumPy."""
        if isinstance(node.value, ast.Name) and node.value.id not in self.bound:
            module = self.globals.get(node.value.id)
            if isinstance(module, python.ModuleType) and node.value.id not in self.variables:
                return number_value(getattr(module, node.attr), node)
        owner = self.value(node.value)
        if isinstance(owner, RecordValue) and node.attr in owner.fields:
            return owner.values[owner.fields.index(node.attr)]
        if isinstance(owner, Array) and node.attr == "shape":
            return RecordValue(tuple(lang.ArrayLength(owner.name, axis) for axis in range(owner.rank)))
        if isinstance(owner, Array) and node.attr == "size" and owner.rank == 1:
            return lang.ArrayLength(owner.name)
        raise Foreign("an attribute", node)

    def element(self, node: ast.Subscript) -> Value:
        """Return an element of an array or of a tuple."""
        if isinstance(node.value, ast.Attribute | ast.Name):
            owner = self.array_of_element(node.value)
            if isinstance(owner, RecordValue):
                index = self.expression(node.slice)
                if isinstance(index, lang.Constant) and 0 <= int(index.value) < len(owner.values):
                    return owner.values[int(index.value)]
                raise Foreign("an index", node)
            if isinstance(owner, Array) and isinstance(node.slice, ast.Slice):
                return self.one_row(owner, node.slice)
            if isinstance(owner, Array) and (count := _index_count(node)) < owner.rank:
                return self.subarray(owner, node, count)
        return super().element(node)

    def subarray(self, array: Array, node: ast.Subscript, count: int) -> Array:
        """Return the subarray at some indices, an array of fewer dimensions."""
        nodes = list(node.slice.elts) if isinstance(node.slice, ast.Tuple) else [node.slice]
        indices = [*self.numbers_of(nodes), *(lang.Constant("int", 0),) * (array.rank - count)]
        name = self.new_array(array.type, array.rank - count)
        self.pending.append(lang.ArrayView(name, array.name, self.place_at(array, indices, node), None, count))
        return Array(name, array.type, array.rank - count)

    def place_at(self, array: Array, indices: list[lang.Expression], node: ast.AST) -> lang.Expression:
        """Return the place of an element."""
        if len(indices) != array.rank or any(
            i.type != "int" or (isinstance(i, lang.Constant) and i.value < 0) for i in indices
        ):
            raise Foreign("an index", node)
        at = indices[0]
        for axis, index in enumerate(indices[1:], 1):
            row = lang.ScalarOperation("int", "mul", (at, lang.ArrayLength(array.name, axis)))
            at = lang.ScalarOperation("int", "add", (row, index))
        return at

    def one_row(self, array: Array, part: ast.Slice) -> Array:
        """Return one row of an array, ``[k : k + 1]``, as an array of the same dimensions."""
        if part.lower is None or part.step is not None or part.upper is None:
            raise Foreign("a part of an array", part)
        behind = ast.BinOp(part.lower, ast.Add(), ast.Constant(1))
        if ast.dump(part.upper) != ast.dump(behind):
            raise Foreign("a part of an array", part)
        (at,) = self.numbers_of([part.lower])
        name = self.new_array(array.type, array.rank)
        for axis in range(1, array.rank):
            at = lang.ScalarOperation("int", "mul", (at, lang.ArrayLength(array.name, axis)))
        self.pending.append(lang.ArrayView(name, array.name, at, lang.Constant("int", 1)))
        return Array(name, array.type, array.rank)

    def array_of_element(self, node: ast.expr) -> Value:
        """Return the array of an element; None for a table of the module."""
        if isinstance(node, ast.Name) and node.id not in self.bound:
            return None
        return self.value(node)

    def place(self, node: ast.Subscript) -> tuple[str, lang.Expression]:
        """Return array and index of an element."""
        owner = self.array_of_element(node.value)
        if owner is None:
            return super().place(node)
        if not isinstance(owner, Array):
            raise Foreign("an element of something else than an array", node)
        nodes = list(node.slice.elts) if isinstance(node.slice, ast.Tuple) else [node.slice]
        return owner.name, self.place_at(owner, self.numbers_of(nodes), node)

    def unary(self, node: ast.UnaryOp) -> lang.Expression:
        """Return an operation on one value."""
        if isinstance(node.op, ast.Not):
            value = self.truth(node.operand)
            if isinstance(value, lang.Constant):
                return lang.Constant("bool", not value.value)
            return lang.ScalarOperation("bool", "not", (value,))
        return super().unary(node)

    def binary(self, node: ast.BinOp) -> lang.Expression:
        """Return an operation on two values."""
        left, right = self.numbers_of([node.left, node.right])
        if left.type == right.type == "int" and not isinstance(right, lang.Constant):
            if isinstance(node.op, ast.FloorDiv | ast.Mod):
                name = "quotient" if isinstance(node.op, ast.FloorDiv) else "rest"
                return lang.ScalarOperation("int", name, (left, right))
        sign = self.operation_name(node)
        if sign == "pow" and left.type == "int" and isinstance(right, lang.Constant) and right.value == 2:
            left = self.name_number(left, node)
            return lang.ScalarOperation("int", "mul", (left, left))
        return self.arithmetic(sign, left, right, node)

    def comparison(self, node: ast.Compare) -> lang.Expression:
        """Return one comparison or several in a row."""
        values = self.numbers_of([node.left, *node.comparators])
        if len(values) > 2:
            values = [self.name_number(v, node) for v in values]  # none is computed twice
        tests: lang.Expression | None = None
        for sign, left, right in zip(node.ops, values, values[1:], strict=False):
            test = self.compare_values(sign, left, right, node)
            tests = test if tests is None else lang.Logic("and", tests, test)
        assert tests is not None, "a comparison compares"
        return tests

    def logic(self, node: ast.BoolOp) -> lang.Expression:
        """Return ``and`` or ``or`` of booleans; constant operands decide which others are read."""
        deciding = isinstance(node.op, ast.Or)
        tests: list[lang.Expression] = []
        for value_node in node.values:
            before = len(self.pending)
            value = self.expression(value_node)
            if value.type != "bool":
                raise Foreign("'and' or 'or' of numbers", node)
            if tests and len(self.pending) > before:
                behind, self.pending = self.pending[before:], self.pending[:before]
                name = self.fresh_name("decided")
                self.depth += 1
                self.note_type(name, "bool", node)
                self.depth -= 1
                test = self.join_booleans(tests, deciding)
                if not deciding:
                    chosen = lang.If(test, (*behind, lang.Assign(name, value)), (_assign_truth(name, False),))
                else:
                    chosen = lang.If(test, (_assign_truth(name, True),), (*behind, lang.Assign(name, value)))
                self.pending.append(chosen)
                tests = [lang.Variable("bool", name)]
                continue
            if isinstance(value, lang.Constant):
                if value.value is deciding:
                    tests.append(value)
                    break
                continue
            tests.append(value)
        if not tests:
            return lang.Constant("bool", not deciding)
        return self.join_booleans(tests, deciding)

    def join_booleans(self, values: list[lang.Expression], deciding: bool) -> lang.Expression:
        """Return ``and`` of booleans that False decides, or ``or`` of those that True does."""
        *first, last = values
        for earlier in reversed(first):
            last = lang.Logic("or" if deciding else "and", earlier, last)
        return last

    def choice(self, node: ast.IfExp) -> Value:
        """Return one of two values; the other one is not computed."""
        test = self.truth(node.test)
        if isinstance(test, lang.Constant):
            return self.value(node.body if test.value else node.orelse)
        outer, values, statements = self.pending, list[Value](), list[list[lang.Statement]]()
        self.depth += 1
        for part in (node.body, node.orelse):
            self.pending = []
            values.append(self.value(part))
            statements.append(self.pending)
        self.depth, self.pending = self.depth - 1, outer
        chosen, otherwise = values
        if any(statements) or isinstance(chosen, RecordValue):
            return self.choose_with_statements(test, values, statements, node)
        if isinstance(chosen, Array) and isinstance(otherwise, Array) and chosen.type == otherwise.type:
            name = self.new_array(chosen.type)
            self.pending.append(lang.Pick(name, test, chosen.name, otherwise.name))
            return Array(name, chosen.type)
        if not isinstance(chosen, EXPRESSIONS) or not isinstance(otherwise, EXPRESSIONS):
            raise Foreign("a choice between things that are no numbers", node)
        return self.choose_value(test, chosen, otherwise, node)

    def choose_with_statements(
        self, test: lang.Expression, values: list[Value], statements: list[list[lang.Statement]], node: ast.AST
    ) -> Value:
        """Return one of two values that need statements, or are records of numbers."""
        first, second = (list(leaves_of_value(value)) for value in values)
        if len(first) != len(second) or any(
            not is_number(a) or not is_number(b) or a.type != b.type for a, b in zip(first, second, strict=True)
        ):
            raise Foreign("a choice between things that are no numbers", node)
        names = [self.fresh_name("chosen") for _ in first]
        for name, value in zip(names, first, strict=True):
            self.depth += 1
            self.note_type(name, value.type, node)
            self.depth -= 1
        then, otherwise = (
            (*before, *(lang.Assign(name, v) for name, v in zip(names, branch, strict=True)))
            for before, branch in zip(statements, (first, second), strict=True)
        )
        self.pending.append(lang.If(test, then, otherwise))
        variables = tuple(lang.Variable(value.type, name) for name, value in zip(names, first, strict=True))
        return RecordValue(variables) if isinstance(values[0], RecordValue) else variables[0]

    def new_array(self, kind: lang.Scalar, rank: int = 1) -> str:
        """Return the name of a new array."""
        name = self.fresh_name("array")
        self.arrays[name] = kind
        return name


def _assign_truth(name: str, value: bool) -> lang.Statement:
    return lang.Assign(name, lang.Constant("bool", value))


def _index_count(node: ast.Subscript) -> int:
    return len(node.slice.elts) if isinstance(node.slice, ast.Tuple) else 1
