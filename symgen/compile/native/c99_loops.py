"""Functions of the runtime as C99, called as machine code is: arrays with lengths, functions by their address."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from symgen.compile.native import language as lang
from symgen.compile.native.c99 import OF_INTEGERS, CPrinter
from symgen.compile.native.c99_words import RESERVED, add_helpers, break_line
from symgen.compile.native.printing import order_functions

#: Types of functions with the arguments of machine code.
_WIDE = {"float": "real", "int": "long long", "bool": "int"}


def c_loops(functions: Mapping[str, lang.Function]) -> str:
    """Return the text of functions of the runtime with the arguments of machine code; else as `c_functions`.

    An array is the address of its elements and its lengths, another function its address, integers have 64 bits. The
    functions of the mapping have external linkage, so that machine code may call them, and they may call machine code.
    """
    order, names = order_functions(functions, RESERVED)
    outside = {function.key for function in functions.values()}
    texts = [_LoopPrinter(function, names, external=function.key in outside).text() for function in order]
    return add_helpers(texts, _WIDE["int"])


class _LoopPrinter(CPrinter):
    """Prints one function with the arguments of machine code.

    Parameters
    ----------
    function, names
        As for `FunctionPrinter`.
    external : bool
        Whether other texts may call it.
    """

    types = _WIDE
    of_integers: ClassVar = {**OF_INTEGERS, "abs": "size_of_integer"}

    def __init__(self, function: lang.Function, names: Mapping[object, str], external: bool) -> None:
        super().__init__(function, names, {function.key: frozenset()})
        self.external = external

    def text(self) -> str:
        """Return the definition, after the tables that it reads."""
        f, own = self.function, self.names[self.function.key]
        body, every = self.lines(f.body), f.variables.keys()
        head = f"{self.types[f.returned]} {own}({', '.join(map(self._parameter, f.parameters))}) {{"
        lines = [*self.tables(), head if self.external else f"static {head}", *self._declare_locals(every), *self.views]
        return "\n".join(map(break_line, [*lines, *body, "}"]))

    def array_arguments(self, array: str) -> list[str]:
        """Return the arguments of a call for an array: its address and its lengths."""
        _, rank = self.arrays[array]
        return [self.variable_text(array), *(self.length_text(array, axis) for axis in range(rank))]

    def _parameter(self, parameter: lang.FunctionParameter) -> str:
        if parameter.address:
            return f"void *{self.variable_text(parameter.name)}"
        kind = self.types[parameter.type]
        if not parameter.array:
            return f"{kind} {self.variable_text(parameter.name)}"
        address, *lengths = self.array_arguments(parameter.name)
        return ", ".join([f"{kind} *{address}", *(f"{self.types['int']} {n}" for n in lengths)])
