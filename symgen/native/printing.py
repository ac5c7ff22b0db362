"""Functions of `symgen.native.language` as text of languages with braces: the common part of JavaScript and C."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Iterable, Mapping
from typing import ClassVar

from symgen.native import language as lang

#: Precedence of binary operators in C and JavaScript. Signs that differ are in the printers.
_SIGNS = {"add": ("+", 12), "sub": ("-", 12), "mul": ("*", 13), "div": ("/", 13), "and": ("&&", 5), "or": ("||", 4)}
_SIGNS |= {"lt": ("<", 10), "le": ("<=", 10), "gt": (">", 10), "ge": (">=", 10), "eq": ("==", 9), "ne": ("!=", 9)}


def ordered(
    functions: Mapping[str, lang.Function], reserved: Collection[str]
) -> tuple[list[lang.Function], dict[object, str]]:
    """Return functions and their callees, callees first, and the names of functions and of their tables.

    Parameters
    ----------
    functions : mapping of str to Function
        Functions by their names in the text.
    reserved : collection of str
        Reserved words.
    """
    names: dict[object, str] = {function.key: name for name, function in functions.items()}
    order, defined = list[lang.Function](), set[object]()

    def define(function: lang.Function) -> None:
        for called in function.called:
            define(called)
        if function.key in defined:
            return
        defined.add(function.key)
        if function.key not in names:
            names[function.key] = _free(word(function.name, reserved), names.values())
        for array in function.tables:
            names[function.key, array] = _free(f"{names[function.key]}_{word(array, reserved)}", names.values())
        order.append(function)

    for function in functions.values():
        define(function)
    return order, names


def _free(name: str, taken: Iterable[str]) -> str:
    names, free, k = set(taken), name, 2
    while free in names:
        free, k = f"{name}_{k}", k + 1
    return free


def word(name: str, reserved: Collection[str]) -> str:
    """Return the name of a variable; names from the reader have dots."""
    name = name.replace(".", "_") if not name[0].isdigit() else f"held{name.replace('.', '_')}"
    return f"{name}_" if name in reserved else name


class FunctionPrinter(ABC):
    """The text of one function.

    Parameters
    ----------
    function : Function
        The function.
    names : mapping of object to str
        Names of functions and tables, as `ordered` returns them.
    """

    #: Reserved words.
    reserved: ClassVar[Collection[str]] = ()
    #: Binary operators that differ from those of C, with their precedence.
    signs: ClassVar[Mapping[str, tuple[str, int]]] = {}

    def __init__(self, function: lang.Function, names: Mapping[object, str]) -> None:
        self.function, self.names = function, names
        self.counters = 0

    @abstractmethod
    def text(self) -> str:
        """Return the definition, after the tables that it reads."""

    @abstractmethod
    def literal(self, value: float | int | bool) -> tuple[str, int]:
        """Return a number and the precedence of its text."""

    @abstractmethod
    def defined(self, s: lang.Assign) -> str:
        """Return the words before the name of a variable that is assigned once, at its assignment."""

    @abstractmethod
    def loop_head(self, s: lang.For, counter: str) -> str:
        """Return the head of a loop whose counter has its own name."""

    @abstractmethod
    def called(self, e: lang.ScalarOperation) -> str:
        """Return the name of an operation's function."""

    @abstractmethod
    def converted(self, kind: str, value: lang.Expression) -> tuple[str, int]:
        """Return a value in another type."""

    def word(self, name: str) -> str:
        """Return the name of a variable."""
        return word(name, self.reserved)

    def lines(self, statements: tuple[lang.Statement, ...]) -> list[str]:
        """Return statements as lines."""
        return [line for statement in statements for line in self.statement(statement)]

    def statement(self, s: lang.Statement) -> list[str]:
        """Return one statement."""
        if isinstance(s, lang.Assign):
            once = self.defined(s) if s.name in self.function.fixed else ""
            return [f"{once}{self.word(s.name)} = {self.value(s.value)};"]
        if isinstance(s, lang.Store):
            return [f"{self.word(s.array)}[{self.value(s.index)}] = {self.value(s.value)};"]
        if isinstance(s, lang.Evaluate):
            return [f"{self.value(s.call)};"]
        if isinstance(s, lang.Return):
            return [f"return {self.value(s.value)};"]
        if isinstance(s, lang.Leave):
            return [f"{s.how};"]
        if isinstance(s, lang.If):
            lines = [f"if ({self.value(s.test)}) {{", *self.lines(s.then)]
            return [*lines, *(["} else {", *self.lines(s.otherwise)] if s.otherwise else []), "}"]
        if isinstance(s, lang.While):
            return [f"while ({self.value(s.test)}) {{", *self.lines(s.body), "}"]
        assert isinstance(s, lang.For), "the language has no other statements"
        self.counters += 1
        counter = f"counter{self.counters}"
        return [self.loop_head(s, counter), f"{self.word(s.name)} = {counter};", *self.lines(s.body), "}"]

    def value(self, e: lang.Expression, level: int = 0) -> str:
        """Return an expression, in parentheses where it binds more weakly than `level`."""
        text, own = self.expression(e)
        return text if own >= level else f"({text})"

    def expression(self, e: lang.Expression) -> tuple[str, int]:
        """Return an expression and its precedence."""
        if isinstance(e, lang.Constant):
            return self.literal(e.value)
        if isinstance(e, lang.Variable):
            return self.word(e.name), 20
        if isinstance(e, lang.ArrayElement):
            constant = e.array in self.function.tables
            array = self.names[self.function.key, e.array] if constant else self.word(e.array)
            return f"{array}[{self.value(e.index)}]", 20
        if isinstance(e, lang.FunctionCall):
            arguments = (self.word(a) if isinstance(a, str) else self.value(a) for a in e.arguments)
            return f"{self.names[e.function.key]}({', '.join(arguments)})", 20
        if isinstance(e, lang.Logic):
            return self.binary(e.name, e.first, e.second)
        if isinstance(e, lang.Choice):
            return f"{self.value(e.test, 4)} ? {self.value(e.chosen, 3)} : {self.value(e.otherwise, 3)}", 2
        assert isinstance(e, lang.ScalarOperation), "emitted functions have no other expressions"
        return self.operation(e)

    def binary(self, name: str, first: lang.Expression, second: lang.Expression) -> tuple[str, int]:
        """Return a binary operation by its sign."""
        sign, own = self.signs.get(name) or _SIGNS[name]
        room = "" if sign in "*/" else " "  # a sign may follow + and -
        return f"{self.value(first, own)}{room}{sign}{room}{self.value(second, own + 1)}", own

    def operation(self, e: lang.ScalarOperation) -> tuple[str, int]:
        """Return an operation."""
        name, first = e.name, e.arguments[0]
        if name in ("and", "or") and e.type != "bool":
            return f"{self.value(first, 8)} {'&' if name == 'and' else '|'} {self.value(e.arguments[1], 8)}", 7
        if name in _SIGNS:
            return self.binary(name, first, e.arguments[1])
        if name == "neg":
            return f"-{self.value(first, 15)}", 14
        if name == "not":
            return f"!{self.value(first, 15)}", 14
        if name in ("float", "int", "bool"):
            return self.converted(name, first)
        if name == "pow" and e.arguments[1].type == "int":
            exponent = e.arguments[1]
            assert isinstance(exponent, lang.Constant), "a power with a literal exponent"
            if exponent.value == 2:
                return f"square({self.value(first)})", 20
            return f"power({self.value(first)}, {int(exponent.value)})", 20
        return f"{self.called(e)}({', '.join(self.value(a) for a in e.arguments)})", 20
