"""Features of looped code only: tables of unsigned numbers, and calls by addresses in them.

Tables are at the end of an array of floats, as unsigned numbers of 32 bits. Here they become integers of 64 bits
where they are read: sums and products of places have the same bits as Numba's unsigned ones. Operations that
could differ, such as a difference of two places, are `Foreign`. Numba's functions in LLVM's language, which find
tables and call functions in them, are recognised by their names (`symgen/templates/looped/machine.py.j2`).
"""

from __future__ import annotations

import ast
from abc import abstractmethod
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from symgen.compile.native import language as lang
from symgen.compile.native import types
from symgen.compile.native.read_values import Foreign, ValueReader, as_type

_ELEMENTS: dict[Any, lang.Scalar] = {types.float64: "float", types.int64: "int", types.uint32: "unsigned"}


class Written(NamedTuple):
    """A function of an emitted module in LLVM's language by Numba (``numba.extending.intrinsic``)."""

    name: str
    define: Callable[..., Any]


class TableValues(ValueReader):
    """Reads expressions with tables.

    Attributes
    ----------
    depth : int
        Number of choices and loops around the current statement.
    unsigned : dict of str to bool
        Local integers, and whether they are unsigned in Numba.
    """

    def __init__(self, function: object, parameters: tuple[lang.FunctionParameter, ...]) -> None:
        super().__init__(function, parameters)
        self.depth = 0
        self.unsigned: dict[str, bool] = {}

    @abstractmethod
    def note_type(self, name: str, kind: lang.Scalar, node: ast.AST) -> None:
        """Note the type of a value assigned to a variable."""

    def name(self, node: ast.Name) -> Any:
        """Return a variable, an argument, or a number of the module."""
        return _as_integer(super().name(node))

    def element(self, node: ast.Subscript) -> Any:
        """Return an element of an array."""
        return _as_integer(super().element(node))

    def operation_name(self, node: ast.BinOp | ast.AugAssign) -> str:
        """Return the name of an operation."""
        values = (node.left, node.right) if isinstance(node, ast.BinOp) else (node.target, node.value)
        if not isinstance(node.op, ast.Add | ast.Mult) and all(self.is_unsigned(x) for x in values):
            raise Foreign("an operation without sign", node)
        return super().operation_name(node)

    def call(self, node: ast.Call) -> Any:
        """Return the result of a function."""
        called = self.meaning_in_module(node.func)
        if called is np.int64 or called is np.uint32:
            if len(node.args) != 1 or node.keywords:
                raise Foreign("an integer of other than one value", node)
            value = as_type("int", self.expression(node.args[0]))
            return value if called is np.int64 else lang.ScalarOperation("int", "low", (value,))
        if isinstance(called, Written) and not node.keywords:
            return self.call_piece(called, node)
        if any(self.is_unsigned(x) for x in node.args):
            raise Foreign("an argument without sign", node)
        return super().call(node)

    def is_unsigned(self, node: ast.expr) -> bool:
        """Whether an integer is unsigned in Numba."""
        if isinstance(node, ast.Subscript):
            return isinstance(node.value, ast.Name) and self.arrays.get(node.value.id) == "unsigned"
        if isinstance(node, ast.Name):
            return self.numbers.get(node.id) == "unsigned" or self.unsigned.get(node.id, False)
        if isinstance(node, ast.BinOp):
            return self.is_unsigned(node.left) and self.is_unsigned(node.right)
        if isinstance(node, ast.IfExp):
            return self.is_unsigned(node.body) or self.is_unsigned(node.orelse)
        return isinstance(node, ast.Call) and self.meaning_in_module(node.func) is np.uint32

    def note_signs(self, node: ast.Assign) -> None:
        """Note whether integers that get names are unsigned in Numba."""
        for target in node.targets:
            if not isinstance(target, ast.Tuple) or not isinstance(node.value, ast.Tuple):
                self.note_sign(target, node.value)
                continue
            for each, value in zip(target.elts, node.value.elts, strict=False):
                self.note_sign(each, value)

    def note_sign(self, target: ast.expr, value: ast.expr) -> None:
        """Note whether a local integer is unsigned in Numba, which would mix both kinds to a third one."""
        if isinstance(target, ast.Name):
            unsigned = self.is_unsigned(value)
            if self.unsigned.setdefault(target.id, unsigned) != unsigned:
                raise Foreign(f"variable '{target.id}' has two types", target)

    def meaning_in_module(self, node: ast.expr) -> Any:
        """Return the meaning of a name of the module or of NumPy; None for all else."""
        if isinstance(node, ast.Name):
            return None if node.id in self.locals else self.globals.get(node.id)
        if isinstance(node, ast.Attribute) and self.meaning_in_module(node.value) is np:
            return getattr(np, node.attr, None)
        return None

    def call_piece(self, called: Written, node: ast.Call) -> lang.Expression:
        """Return the result of a function in LLVM's language."""
        if called.name == "_compiled_bits" and len(node.args) == 1:
            return lang.ScalarOperation("int", "bits", (as_type("float", self.expression(node.args[0])),))
        if called.name not in ("_compiled_kernel", "_compiled_code"):
            raise Foreign(f"the function '{called.name}'", node)
        signature, _ = called.define(None, *(None for _ in node.args))
        if len(signature.arguments) != len(node.args) or signature.result is not types.int64:
            raise Foreign("a function with other arguments or results", node)
        address, *others = (self.passed_form(kind, x) for kind, x in zip(signature.arguments, node.args, strict=True))
        return lang.Invoke("int", address, tuple(others))

    def passed_form(self, kind: object, node: ast.expr) -> lang.Expression | str:
        """Return the passed form of an argument of a function called by its address."""
        if not isinstance(kind, types.ArrayType):
            return as_type(_ELEMENTS[kind], self.expression(node))
        if not isinstance(node, ast.Name) or self.arrays.get(node.id) != _ELEMENTS[kind.dtype]:
            raise Foreign("an array of another kind", node)
        return node.id

    def name_view(self, node: ast.Assign) -> list[lang.Statement]:
        """Return the statements that name an array of tables; empty for any other assignment."""
        value = node.value
        if (
            not isinstance(value, ast.Call)
            or getattr(self.meaning_in_module(value.func), "name", "") != "_compiled_tables"
        ):
            return []
        names = [x.id for x in (*node.targets, *value.args) if isinstance(x, ast.Name)]
        if self.depth or len(names) != 2 or len(node.targets) != 1 or self.arrays.get(names[1]) != "float":
            raise Foreign("tables in another place", node)
        name, owner = names
        if name in self.arrays or name in self.variables or name in self.numbers:
            raise Foreign(f"variable '{name}' has two types", node)
        self.arrays[name] = "unsigned"
        count, start = lang.ArrayLength(owner), f"{name}.start"  # no Python name
        self.note_type(start, "int", node)
        last = lang.ArrayElement("float", owner, lang.ScalarOperation("int", "sub", (count, lang.Constant("int", 1))))
        first = lang.Variable("int", start)
        size = lang.ScalarOperation(
            "int", "mul", (lang.ScalarOperation("int", "sub", (count, first)), lang.Constant("int", 2))
        )
        return [
            lang.Assign(start, lang.ScalarOperation("int", "bits", (last,))),
            lang.ArrayView(name, owner, first, size, type="unsigned"),
        ]


def _as_integer(value: Any) -> Any:
    """Return a number of a table as an integer, anything else unchanged."""
    return as_type("int", value) if getattr(value, "type", None) == "unsigned" else value
