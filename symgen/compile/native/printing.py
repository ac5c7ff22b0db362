"""Functions of `symgen.compile.native.language` as text with braces: the common part of JavaScript and C."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Iterable, Mapping
from typing import ClassVar

from symgen.compile.native import language as lang
from symgen.compile.native.folding import walk_statements

#: Precedence of binary operators in C and JavaScript. Signs that differ are in the printers.
_SIGNS = {"add": ("+", 12), "sub": ("-", 12), "mul": ("*", 13), "div": ("/", 13), "and": ("&&", 5), "or": ("||", 4)}
_COMPARED = ("lt", "le", "gt", "ge", "eq", "ne")
_SIGNS |= {"lt": ("<", 10), "le": ("<=", 10), "gt": (">", 10), "ge": (">=", 10), "eq": ("==", 9), "ne": ("!=", 9)}


def order_functions(
    functions: Mapping[str, lang.Function], reserved: Collection[str]
) -> tuple[list[lang.Function], dict[object, str]]:
    """Return functions and their callees, callees first, and the names of functions and of their tables.

    Parameters
    ----------
    functions : mapping of str to Function
        Functions by their names in the text.
    reserved : collection of str
        Reserved words, and names that a text around the functions has; `functions` keep their names.
    """
    names: dict[object, str] = {function.key: name for name, function in functions.items()}
    order, defined = list[lang.Function](), set[object]()

    def define_function(function: lang.Function) -> None:
        for called in function.called:
            define_function(called)
        if function.key in defined:
            return
        defined.add(function.key)
        if function.key not in names:
            names[function.key] = _free_name(variable_name(function.name, reserved), names.values())
        for array in function.tables:
            names[function.key, array] = _free_name(
                f"{names[function.key]}_{variable_name(array, reserved)}", names.values()
            )
        order.append(function)

    for function in functions.values():
        define_function(function)
    return order, names


def _free_name(name: str, others: Iterable[str]) -> str:
    names, free, k = set(others), name, 2
    while free in names:
        free, k = f"{name}_{k}", k + 1
    return free


def variable_name(name: str, reserved: Collection[str]) -> str:
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
        Names of functions and tables, as `order_functions` returns them.

    Attributes
    ----------
    arrays : dict of str to tuple
        Type of the elements and number of dimensions of arrays that are no tables.
    """

    #: Reserved words.
    reserved: ClassVar[Collection[str]] = ()
    #: Binary operators that differ from those of C, with their precedence.
    signs: ClassVar[Mapping[str, tuple[str, int]]] = {}

    def __init__(self, function: lang.Function, names: Mapping[object, str]) -> None:
        self.function, self.names = function, names
        self.counters = 0
        self.arrays = {p.name: (p.type, p.rank) for p in function.parameters if p.array}
        self.views = dict[str, None]()  # names of arrays and of lengths that are assigned
        #: Variables whose only assignment is a statement of the body itself.
        self.once = function.fixed & {s.name for s in function.body if isinstance(s, lang.Assign)}
        self.read = {value.name for value in walk_statements(function.body) if isinstance(value, lang.Variable)}

    @abstractmethod
    def text(self) -> str:
        """Return the definition, after the tables that it reads."""

    @abstractmethod
    def literal_text(self, value: float | int | bool) -> tuple[str, int]:
        """Return a number and the precedence of its text."""

    @abstractmethod
    def declaration(self, s: lang.Assign) -> str:
        """Return the words before the name of a variable that is assigned once, at its assignment."""

    @abstractmethod
    def loop_head(self, s: lang.For, counter: str) -> str:
        """Return the head of a loop whose counter has its own name."""

    @abstractmethod
    def function_name(self, e: lang.ScalarOperation) -> str:
        """Return the name of an operation's function."""

    @abstractmethod
    def conversion(self, kind: str, value: lang.Expression) -> tuple[str, int]:
        """Return a value in another type."""

    @abstractmethod
    def block_text(self, number: int, lines: list[str]) -> list[str]:
        """Return the statements of a block that may be left before its end."""

    @abstractmethod
    def leave_block(self, number: int) -> str:
        """Return the statement that leaves a block."""

    @abstractmethod
    def length_text(self, array: str, axis: int) -> str:
        """Return the length of an array along an axis, which binds as strongly as a name."""

    @abstractmethod
    def array_arguments(self, array: str) -> list[str]:
        """Return the arguments of a call for an array."""

    @abstractmethod
    def name_array(self, name: str, array: str, first: lang.Expression | None, lengths: list[str]) -> list[str]:
        """Return the statements that give a name to an array, or to the elements from one on."""

    @abstractmethod
    def call_by_address(self, e: lang.Invoke) -> str:
        """Return the call of a function by its address."""

    def variable_text(self, name: str) -> str:
        """Return the name of a variable."""
        return variable_name(name, self.reserved)

    def lines(self, statements: tuple[lang.Statement, ...]) -> list[str]:
        """Return statements as lines."""
        return [line for statement in statements for line in self.statement(statement)]

    def statement(self, s: lang.Statement) -> list[str]:
        """Return one statement."""
        if isinstance(s, lang.Assign):
            once = self.declaration(s) if s.name in self.once else ""
            return [f"{once}{self.variable_text(s.name)} = {self.value(s.value)};"]
        if isinstance(s, lang.Store):
            return [f"{self.variable_text(s.array)}[{self.value(s.index)}] = {self.value(s.value)};"]
        if isinstance(s, lang.Evaluate):
            return [f"{self.value(s.call)};"]
        if isinstance(s, lang.Return):
            return [f"return {self.value(s.value)};"]
        if isinstance(s, lang.Leave):
            return [self.leave_block(s.block) if s.how == "block" else f"{s.how};"]
        if isinstance(s, lang.StatementBlock):
            return self.block_text(s.number, self.lines(s.body))
        if isinstance(s, lang.ArrayView):
            kind, rank = self.arrays[s.array]
            inner = [self.length_text(s.array, axis) for axis in range(1 if s.size is not None else s.indices, rank)]
            lengths = inner if s.size is None else [self.value(s.size), *inner]
            self.arrays[s.name] = kind, len(lengths)
            return self.name_array(s.name, s.array, s.first, lengths)
        if isinstance(s, lang.Pick):
            self.arrays[s.name] = self.arrays[s.chosen]
            then, otherwise = (
                self.name_array(s.name, a, None, [self.length_text(a, 0)]) for a in (s.chosen, s.otherwise)
            )
            return [f"if ({self.value(s.test)}) {{", *then, "} else {", *otherwise, "}"]
        if isinstance(s, lang.If):
            lines = [f"if ({self.value(s.test)}) {{", *self.lines(s.then)]
            return [*lines, *(["} else {", *self.lines(s.otherwise)] if s.otherwise else []), "}"]
        if isinstance(s, lang.While):
            return [f"while ({self.value(s.test)}) {{", *self.lines(s.body), "}"]
        assert isinstance(s, lang.For), "the language has no other statements"
        self.counters += 1
        counter = f"counter{self.counters}"
        named = [f"{self.variable_text(s.name)} = {counter};"] if s.name in self.read else []
        return [self.loop_head(s, counter), *named, *self.lines(s.body), "}"]

    def passed_arguments(self, e: lang.FunctionCall) -> list[str]:
        """Return the arguments of a call of another function."""
        return self.arguments(e.arguments)

    def arguments(self, arguments: tuple[lang.Expression | str, ...]) -> list[str]:
        """Return the arguments of a call: numbers, or by their names arrays and functions."""
        lists = (
            [self.value(a)]
            if not isinstance(a, str)
            else self.array_arguments(a)
            if a in self.arrays
            else [self.variable_text(a)]
            for a in arguments
        )
        return [argument for each in lists for argument in each]

    def value(self, e: lang.Expression, level: int = 0) -> str:
        """Return an expression, in parentheses where it binds more weakly than `level`."""
        text, own = self.expression(e)
        return text if own >= level else f"({text})"

    def expression(self, e: lang.Expression) -> tuple[str, int]:
        """Return an expression and its precedence."""
        if isinstance(e, lang.Constant):
            return self.literal_text(e.value)
        if isinstance(e, lang.Variable):
            return self.variable_text(e.name), 20
        if isinstance(e, lang.ArrayElement):
            constant = e.array in self.function.tables
            array = self.names[self.function.key, e.array] if constant else self.variable_text(e.array)
            return f"{array}[{self.value(e.index)}]", 20
        if isinstance(e, lang.FunctionCall):
            return f"{self.names[e.function.key]}({', '.join(self.passed_arguments(e))})", 20
        if isinstance(e, lang.ArrayLength):
            return self.length_text(e.array, e.axis), 20
        if isinstance(e, lang.Invoke):
            return self.call_by_address(e), 20
        if isinstance(e, lang.Logic):
            return self.binary_text(e.name, e.first, e.second)
        if isinstance(e, lang.Choice):
            return f"{self.value(e.test, 4)} ? {self.value(e.chosen, 3)} : {self.value(e.otherwise, 3)}", 2
        assert isinstance(e, lang.ScalarOperation), "functions in LLVM's language are read by their plain form"
        return self.operation(e)

    def binary_text(self, name: str, first: lang.Expression, second: lang.Expression) -> tuple[str, int]:
        """Return a binary operation by its sign."""
        sign, own = self.signs.get(name) or _SIGNS[name]
        room = "" if sign in "*/" else " "  # a sign may follow + and -
        if name in ("eq", "ne") and getattr(first, "name", "") in _COMPARED:
            left = right = own + 2  # compilers ask for parentheses here too
            return f"{self.value(first, left)}{room}{sign}{room}{self.value(second, right)}", own
        left = own + 2 if name == "or" and getattr(first, "name", "") == "and" else own  # compilers ask for parentheses
        right = own + 2 if name == "or" else own + 1
        return f"{self.value(first, left)}{room}{sign}{room}{self.value(second, right)}", own

    def operation(self, e: lang.ScalarOperation) -> tuple[str, int]:
        """Return an operation."""
        name, first = e.name, e.arguments[0]
        if name in ("and", "or") and e.type != "bool":
            return f"{self.value(first, 8)} {'&' if name == 'and' else '|'} {self.value(e.arguments[1], 8)}", 7
        if name in _SIGNS:
            return self.binary_text(name, first, e.arguments[1])
        if name == "neg":
            return f"-{self.value(first, 15)}", 14
        if name == "not":
            return f"!{self.value(first, 15)}", 14
        if name in ("float", "int", "bool"):
            return self.conversion(name, first)
        if name == "pow" and e.arguments[1].type == "int":
            exponent = e.arguments[1]
            assert isinstance(exponent, lang.Constant), "a power with a literal exponent"
            if exponent.value == 2:
                return f"square({self.value(first)})", 20
            return f"power({self.value(first)}, {int(exponent.value)})", 20
        return f"{self.function_name(e)}({', '.join(self.value(a) for a in e.arguments)})", 20
