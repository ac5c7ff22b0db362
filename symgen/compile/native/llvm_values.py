"""Expressions of `symgen.compile.native.language` as instructions for LLVM; `llvm.py` prints statements."""

from __future__ import annotations

import struct
from collections.abc import Callable

from symgen.compile.native import language as lang
from symgen.compile.native import sines

TYPES = {"float": "double", "int": "i64", "bool": "i1", "unsigned": "i32"}
FLOATS = {"add": "fadd", "sub": "fsub", "mul": "fmul", "div": "fdiv"}
INTS = {"add": "add nsw", "sub": "sub nsw", "mul": "mul nsw", "and": "and", "or": "or"}
COMPARED = {
    "float": {"lt": "olt", "le": "ole", "gt": "ogt", "ge": "oge", "eq": "oeq", "ne": "une"},
    "int": {"lt": "slt", "le": "sle", "gt": "sgt", "ge": "sge", "eq": "eq", "ne": "ne"},
    "bool": {"lt": "ult", "le": "ule", "gt": "ugt", "ge": "uge", "eq": "eq", "ne": "ne"},
}
#: Intrinsic functions of LLVM, by its names.
INTRINSICS = {name: name for name in ("sin", "cos", "exp", "log", "fabs", "copysign", "pow")} | {"round": "rint"}


def function_name(name: str) -> str:
    """Return the name of a mathematical function."""
    return f"@llvm.{INTRINSICS[name]}.f64" if name in INTRINSICS else f"@{name}"


class ValuePrinter:
    """Prints the expressions of one function.

    Attributes
    ----------
    sines : dict
        Computed sines and cosines, by their names and angles.
    lines, slots : list of str
        Printed lines, and the memory that they need.
    values : dict of str to str
        Values of variables that need no memory.
    flag : str
        Flag of operations on floats.
    inserted : dict of str to str
        Called functions in LLVM's language, by their names.
    label : str
        Of the current block.
    views : dict of str to tuple
        Address and lengths of arrays.
    small : set of str
        Arrays of `unsigned` numbers.
    """

    def __init__(self, function: lang.Function, symbol: Callable[[lang.Function], str]) -> None:
        self.function, self.symbol = function, symbol
        self.sines: dict[tuple[str, lang.Expression], str] = {}
        self.lines: list[str] = []
        self.slots: list[str] = []
        self.values: dict[str, str] = {}
        self.count = 0
        self.flag = " contract" if getattr(function.source, "contracted", True) else ""
        self.inserted: dict[str, str] = {}
        self.label = ".entry"
        self.views: dict[str, tuple[str, tuple[str, ...]]] = {}
        self.small = {p.name for p in function.parameters if p.array and p.type == "unsigned"}

    def print_instruction(self, text: str) -> str:
        """Print an instruction and return its value."""
        self.count += 1
        self.lines.append(f"  %.{self.count} = {text}")
        return f"%.{self.count}"

    def new_labels(self, *names: str) -> list[str]:
        """Return new labels."""
        self.count += 1
        return [f".{name}{self.count}" for name in names]

    def begin_block(self, label: str) -> None:
        """Begin a block."""
        self.lines.append(f"{label}:")
        self.label = label

    def jump(self, label: str) -> None:
        """End a block."""
        self.lines.append(f"  br label %{label}")

    def branch(self, test: str, yes: str, no: str) -> None:
        """End a block with a choice."""
        self.lines.append(f"  br i1 {test}, label %{yes}, label %{no}")

    def value(self, e: lang.Expression) -> str:
        """Print the instructions of an expression and return its value."""
        if isinstance(e, lang.Constant):
            return float_literal(e.value) if e.type == "float" else str(int(e.value))
        if isinstance(e, lang.Variable):
            value = self.values.get(e.name)
            return (
                value
                if value is not None
                else self.print_instruction(f"load {TYPES[e.type]}, ptr {variable_slot(e.name)}")
            )
        if isinstance(e, lang.ArrayElement):
            return self.print_instruction(f"load {TYPES[e.type]}, ptr {self.element_address(e.array, e.index)}")
        if isinstance(e, lang.ScalarOperation):
            return self.operation(e.type, e.name, e.arguments)
        if isinstance(e, lang.FunctionCall):
            return self.call(e)
        if isinstance(e, lang.ArrayLength):
            return self.views[e.array][1][e.axis]
        if isinstance(e, lang.Invoke):
            return self.call_by_address(e)
        if isinstance(e, lang.Insert):
            return self.call_piece(e)
        if isinstance(e, lang.Logic):
            return self.print_logic(e)
        assert isinstance(e, lang.Choice), "all kinds of expressions are known"
        return self.print_choice(e)

    def element_address(self, array: str, index: lang.Expression) -> str:
        """Return the address of an element."""
        size = "i32" if array in self.small else "double"
        return self.print_instruction(f"getelementptr {size}, ptr {self.array_address(array)}, i64 {self.value(index)}")

    def array_address(self, array: str) -> str:
        """Return the address of an array."""
        return self.views[array][0] if array in self.views else f'@"{self.symbol(self.function)}.{array}"'

    def operation(self, kind: lang.Scalar, name: str, arguments: tuple[lang.Expression, ...]) -> str:
        """Print an operation."""
        first = arguments[0].type
        if name in sines.NAMES and sines.is_simple(arguments[0]) and (name, arguments[0]) in self.sines:
            return self.sines[name, arguments[0]]
        if name == "pow" and arguments[1].type == "int":
            exponent = arguments[1]
            assert isinstance(exponent, lang.Constant), "a power with a literal exponent"
            return self.print_whole_power(self.value(arguments[0]), int(exponent.value))
        values = [self.value(a) for a in arguments]
        if name in COMPARED["float"]:
            flag = self.flag if first == "float" else ""
            compare = "fcmp" if first == "float" else "icmp"
            return self.print_instruction(f"{compare}{flag} {COMPARED[first][name]} {TYPES[first]} {', '.join(values)}")
        if name in ("min", "max"):
            return self.print_extreme(kind, name, values)
        if kind == "float" and name in FLOATS:
            return self.print_instruction(f"{FLOATS[name]}{self.flag} double {values[0]}, {values[1]}")
        if name in INTS:
            return self.print_instruction(f"{INTS[name]} {TYPES[kind]} {values[0]}, {values[1]}")
        if name in ("float", "int", "bool", "unsigned"):
            return self.print_conversion(first, name, values[0])
        if name == "low":
            return self.print_instruction(f"and i64 {values[0]}, {2**32 - 1}")
        if name == "bits":
            return self.print_instruction(f"bitcast double {values[0]} to i64")
        if name == "not":
            return self.print_instruction(f"xor i1 {values[0]}, true")
        if name == "neg":
            return self.print_instruction(
                f"fsub{self.flag} double -0.0, {values[0]}" if kind == "float" else f"sub i64 0, {values[0]}"
            )
        if name in ("quotient", "rest"):
            return self.print_floor_division(values[0], values[1], rest_wanted=name == "rest")
        if name in ("floordiv", "mod"):
            return self.print_division(name, *values)
        if name == "abs" and kind == "int":
            below = self.print_instruction(f"icmp slt i64 {values[0]}, 0")
            return self.print_instruction(
                f"select i1 {below}, i64 {self.print_instruction(f'sub i64 0, {values[0]}')}, i64 {values[0]}"
            )
        return self.function_of_math({"abs": "fabs"}.get(name, name).removeprefix("math."), values)

    def print_extreme(self, kind: lang.Scalar, name: str, values: list[str]) -> str:
        """Print the least or greatest of two values; as in Python, the first where they do not compare."""
        sign = COMPARED[kind]["lt" if name == "min" else "gt"]
        compare = f"fcmp{self.flag}" if kind == "float" else "icmp"
        test = self.print_instruction(f"{compare} {sign} {TYPES[kind]} {values[1]}, {values[0]}")
        return self.print_instruction(f"select i1 {test}, {TYPES[kind]} {values[1]}, {TYPES[kind]} {values[0]}")

    def print_whole_power(self, base: str, exponent: int) -> str:
        """Print a power as products, by squaring."""
        result = float_literal(1.0)
        while exponent:
            if exponent & 1:
                result = self.print_instruction(f"fmul{self.flag} double {result}, {base}")
            exponent >>= 1
            base = self.print_instruction(f"fmul{self.flag} double {base}, {base}")
        return result

    def print_division(self, name: str, value: str, divisor: str) -> str:
        """Print quotient or remainder of a division by a positive constant, rounded down."""
        rest = self.print_instruction(f"srem i64 {value}, {divisor}")
        below = self.print_instruction(f"icmp slt i64 {rest}, 0")
        if name == "mod":
            return self.print_instruction(
                f"select i1 {below}, i64 {self.print_instruction(f'add i64 {rest}, {divisor}')}, i64 {rest}"
            )
        quotient = self.print_instruction(f"sdiv i64 {value}, {divisor}")
        return self.print_instruction(
            f"select i1 {below}, i64 {self.print_instruction(f'sub i64 {quotient}, 1')}, i64 {quotient}"
        )

    def print_floor_division(self, value: str, divisor: str, *, rest_wanted: bool) -> str:
        """Print quotient or remainder of a division by any integer, rounded down; those by 0 are 0."""
        none = self.print_instruction(f"icmp eq i64 {divisor}, 0")
        divisor = self.print_instruction(f"select i1 {none}, i64 1, i64 {divisor}")
        quotient, rest = (
            self.print_instruction(f"sdiv i64 {value}, {divisor}"),
            self.print_instruction(f"srem i64 {value}, {divisor}"),
        )
        signs = self.print_instruction(f"icmp slt i64 {self.print_instruction(f'xor i64 {rest}, {divisor}')}, 0")
        below = self.print_instruction(f"and i1 {signs}, {self.print_instruction(f'icmp ne i64 {rest}, 0')}")
        other = f"add i64 {rest}, {divisor}" if rest_wanted else f"sub i64 {quotient}, 1"
        result = self.print_instruction(
            f"select i1 {below}, i64 {self.print_instruction(other)}, i64 {rest if rest_wanted else quotient}"
        )
        return self.print_instruction(f"select i1 {none}, i64 0, i64 {result}")

    def print_conversion(self, before: lang.Scalar, after: str, value: str) -> str:
        """Print a conversion."""
        if before == "unsigned":
            return self.print_instruction(f"zext i32 {value} to i64")
        if after == "unsigned":
            return self.print_instruction(f"trunc i64 {value} to i32")
        if after == "bool":
            test = f"fcmp{self.flag} une double {value}, 0.0" if before == "float" else f"icmp ne i64 {value}, 0"
            return self.print_instruction(test)
        if before == "bool":
            wide = self.print_instruction(f"zext i1 {value} to i32")
            return self.print_instruction(
                f"sitofp i32 {wide} to double" if after == "float" else f"sext i32 {wide} to i64"
            )
        return self.print_instruction(
            f"sitofp i64 {value} to double" if after == "float" else f"fptosi double {value} to i64"
        )

    def function_of_math(self, name: str, values: list[str]) -> str:
        """Print a call of a mathematical function."""
        value = self.print_instruction(
            f"call{self.flag} double {function_name(name)}({', '.join(f'double {v}' for v in values)})"
        )
        return self.print_instruction(f"fptosi double {value} to i64") if name in ("floor", "ceil", "round") else value

    def take_sines(self, angles: tuple[lang.Expression, ...]) -> None:
        """Print sines and cosines of several angles; copies of the first fill the vector."""
        values = [self.value(angle) for angle in angles]
        n = sines.function_width(len(values))
        vector = "undef"
        for i in range(n):
            value = values[i] if i < len(values) else values[0]
            vector = self.print_instruction(f"insertelement <{n} x double> {vector}, double {value}, i32 {i}")
        pair = self.print_instruction(
            f"call {sines.result_type(n)} {sines.sine_name(n)}(<{n} x double> {vector}) nounwind memory(none)"
        )
        for k, name in enumerate(sines.NAMES):
            values_of_both = self.print_instruction(f"extractvalue {sines.result_type(n)} {pair}, {k}")
            for i, angle in enumerate(angles):
                self.sines[name, angle] = self.print_instruction(
                    f"extractelement <{n} x double> {values_of_both}, i32 {i}"
                )

    def call(self, e: lang.FunctionCall) -> str:
        """Print a call of another function."""
        return self.print_call(f'@"{self.symbol(e.function)}"', e.function.returned, e.arguments)

    def call_by_address(self, e: lang.Invoke) -> str:
        """Print a call of a function by its address: a name of a parameter, or a number."""
        if isinstance(e.function, str):
            return self.print_call(f'%"{e.function}"', e.type, e.arguments)
        return self.print_call(
            self.print_instruction(f"inttoptr i64 {self.value(e.function)} to ptr"), e.type, e.arguments
        )

    def call_piece(self, e: lang.Insert) -> str:
        """Print a call of a function in LLVM's language, which takes arrays as mere addresses."""
        self.inserted[e.symbol] = e.text
        parts = [self.call_argument(argument)[0] for argument in e.arguments]
        text = f'@"{e.symbol}"({", ".join(parts)})'
        if e.nothing:
            self.lines.append(f"  call void {text}")
            return ""
        return self.print_instruction(f"call {TYPES[e.type]} {text}")

    def print_call(self, function: str, returned: lang.Scalar, arguments: tuple[lang.Expression | str, ...]) -> str:
        """Print a call."""
        parts = [part for argument in arguments for part in self.call_argument(argument)]
        return self.print_instruction(f"call {TYPES[returned]} {function}({', '.join(parts)}) nounwind")

    def call_argument(self, argument: lang.Expression | str) -> list[str]:
        """Return an argument of a call: a number, or by its name an array or a function."""
        if not isinstance(argument, str):
            return [f"{TYPES[argument.type]} {self.value(argument)}"]
        if argument not in self.views:
            return [f'ptr %"{argument}"']
        data, lengths = self.views[argument]
        return [f"ptr {data}", *(f"i64 {n}" for n in lengths)]

    def print_logic(self, e: lang.Logic) -> str:
        """Print `and` or `or`."""
        more, end = self.new_labels("more", "end")
        first = self.value(e.first)
        before = self.label
        self.branch(first, *((more, end) if e.name == "and" else (end, more)))
        self.begin_block(more)
        second = self.value(e.second)
        after = self.label
        self.jump(end)
        self.begin_block(end)
        return self.print_instruction(
            f"phi i1 [{'false' if e.name == 'and' else 'true'}, %{before}], [{second}, %{after}]"
        )

    def print_choice(self, e: lang.Choice) -> str:
        """Print a choice between values."""
        yes, no, end = self.new_labels("then", "else", "end")
        self.branch(self.value(e.test), yes, no)
        parts = []
        for label, part in ((yes, e.chosen), (no, e.otherwise)):
            self.begin_block(label)
            value = self.value(part)
            parts.append(f"[{value}, %{self.label}]")
            self.jump(end)
        self.begin_block(end)
        return self.print_instruction(f"phi {TYPES[e.type]} {', '.join(parts)}")


def variable_slot(name: str) -> str:
    """Return the memory of a variable that has more than one value."""
    return f'%"{name}."'


def float_literal(value: float | int | bool) -> str:
    """Return a float in LLVM's notation, to the last bit."""
    return f"0x{struct.pack('>d', float(value)).hex()}"
