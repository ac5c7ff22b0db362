"""Functions of `symgen.native.language` as text for LLVM, in the calling convention of Numba's functions.

Operations are those that Numba puts for the same source, in the same order and with the same liberty, contraction to
fused multiply-add; so results are equal to the last bit. Arrays are arguments of seven parts each, of which only the
address of the elements is used.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterable

from symgen.native import sines
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

TYPES = {"float": "double", "int": "i64", "bool": "i1"}
_ARRAY = (
    "ptr",
    "ptr",
    "i64",
    "i64",
    "ptr",
    "i64",
    "i64",
)  # owner, parent, size, size of an element, data, shape, stride
_DATA = 4
#: The same as one value, as functions in C's convention get it.
_STRUCT = "{ptr, ptr, i64, i64, ptr, [1 x i64], [1 x i64]}"
_FLOATS = {"add": "fadd", "sub": "fsub", "mul": "fmul", "div": "fdiv"}
_INTS = {"add": "add nsw", "sub": "sub nsw", "mul": "mul nsw", "and": "and", "or": "or"}
_COMPARED = {
    "float": {"lt": "olt", "le": "ole", "gt": "ogt", "ge": "oge", "eq": "oeq", "ne": "une"},
    "int": {"lt": "slt", "le": "sle", "gt": "sgt", "ge": "sge", "eq": "eq", "ne": "ne"},
    "bool": {"lt": "ult", "le": "ule", "gt": "ugt", "ge": "uge", "eq": "eq", "ne": "ne"},
}
_INTRINSICS = {
    "sin": "sin",
    "cos": "cos",
    "exp": "exp",
    "log": "log",
    "fabs": "fabs",
    "copysign": "copysign",
    "pow": "pow",
    "round": "rint",
}


def module(
    function: Function, symbol: Callable[[Function], str], inlined: Callable[[Function], bool], together: bool = True
) -> str:
    """Return the text of a module that defines a function.

    Parameters
    ----------
    function : Function
        What is defined: once in Numba's convention, under its symbol, and once in C's, under ``cfunc.`` and its symbol.
    symbol : Callable
        Gives the name of a function in machine code.
    inlined : Callable
        Whether the body of a function that is called stands in the module too, for the compiler to copy.
    together : bool
        Whether sines and cosines of several angles are taken together (`symgen.native.sines`).
    """
    functions, declared = _reached(function, inlined)
    texts = [Printer(f, symbol, "" if f is function else "available_externally ", together).text() for f in functions]
    texts.extend(
        sines.definition(n) for n in (sines.width(1), sines.MOST) if any(sines.name(n) in text for text in texts)
    )
    texts.append(_c_function(function, symbol(function)))
    texts.extend(f"declare {_head(f, symbol(f), named=False)}" for f in declared)
    return "\n".join([*texts, *declarations(texts), ""])


def _reached(function: Function, inlined: Callable[[Function], bool]) -> tuple[list[Function], list[Function]]:
    """Return functions whose bodies belong into a module, and those of which it has to know the symbol alone."""
    functions, declared, waiting = {_key(function): function}, dict[object, Function](), list(function.called)
    while waiting:
        each = waiting.pop(0)
        if _key(each) not in functions and inlined(each):
            functions[_key(each)] = each
            waiting.extend(each.called)
        elif _key(each) not in functions:
            declared[_key(each)] = each
    return list(functions.values()), list(declared.values())


def _key(function: Function) -> object:
    """Return what tells one function from another without comparing their bodies."""
    return function.source, function.parameters


def declarations(texts: Iterable[str]) -> list[str]:
    """Return declarations of the mathematical functions that texts call."""
    text = "\n".join(texts)
    found = []
    for name in _INTRINSICS.values():
        if f"@llvm.{name}.f64(" in text:
            found.append(
                f"declare double @llvm.{name}.f64({'double, double' if name in ('copysign', 'pow') else 'double'})"
            )
    for name in "sqrt tan asin acos atan sinh cosh tanh floor ceil".split():
        if f"@{name}(" in text:
            found.append(f"declare double @{name}(double) nounwind memory(read)")
    if "@atan2(" in text:
        found.append("declare double @atan2(double, double) nounwind memory(read)")
    return found


def _head(function: Function, name: str, named: bool = True) -> str:
    """Return result, name and parameters in Numba's convention."""
    parts = ["ptr noalias" + " %.result" * named, "ptr noalias" + " %.exception" * named]
    for p in function.parameters:
        if p.array:
            parts += [f"{kind} %{p.name}.{i}" if named else kind for i, kind in enumerate(_ARRAY)]
        else:
            parts.append(f"{TYPES[p.type]} %{p.name}" if named else TYPES[p.type])
    return f'i32 @"{name}"({", ".join(parts)}) nounwind'


def _c_function(function: Function, name: str) -> str:
    """Return the function in C's convention, which calls the other one."""
    kind = TYPES[function.returned]
    lines, arguments = [f"  %.result = alloca {kind}"], ["ptr %.result", "ptr null"]
    for p in function.parameters:
        if p.array:
            lines.append(f"  %{p.name}.{_DATA} = extractvalue {_STRUCT} %{p.name}, {_DATA}")
        arguments += _handed(p, f"%{p.name}.{_DATA}" if p.array else f"%{p.name}")
    parameters = ", ".join(f"{_STRUCT if p.array else TYPES[p.type]} %{p.name}" for p in function.parameters)
    return "\n".join(
        [
            f'define {kind} @"cfunc.{name}"({parameters}) nounwind {{',
            *lines,
            f'  %.status = call i32 @"{name}"({", ".join(arguments)})',
            f"  %.value = load {kind}, ptr %.result",
            f"  ret {kind} %.value",
            "}",
        ]
    )


def _handed(parameter: Parameter, value: str) -> list[str]:
    """Return an argument of a call; of an array the address of its elements, the rest being unused."""
    if not parameter.array:
        return [f"{TYPES[parameter.type]} {value}"]
    return [f"{kind} {value if i == _DATA else 'undef'}" for i, kind in enumerate(_ARRAY)]


class Printer:
    """Prints one function."""

    def __init__(self, function: Function, symbol: Callable[[Function], str], linkage: str, together: bool) -> None:
        self.function, self.symbol, self.linkage = function, symbol, linkage
        groups = sines.groups(function) if together else {}
        self.before = {id(function.body[i]): calls for i, calls in groups.items()}
        self.found: dict[tuple[str, Expression], str] = {}  # sines and cosines
        self.lines: list[str] = []
        self.slots: list[str] = []
        self.values: dict[str, str] = {}  # of fixed variables
        self.count = 0
        self.flag = " contract"  # what operations on floats may be
        self.label = ".entry"
        self.leaving: list[tuple[str, str]] = []  # labels after `continue` and `break`, innermost last

    def text(self) -> str:
        """Return the definition."""
        f = self.function
        for name, kind in f.variables.items():
            if name not in f.fixed:
                self.slots.append(f"  {_slot(name)} = alloca {TYPES[kind]}")
        self.begun()
        self.statements(f.body)
        tables = [
            f'@"{self.symbol(f)}.{name}" = private unnamed_addr constant [{len(x)} x double] '
            f"[{', '.join('double ' + _float(v) for v in x)}]"
            for name, x in f.tables.items()
        ]
        head = f"define {self.linkage}{self.head()} {{"
        return "\n".join([*tables, head, ".entry:", *self.slots, *self.lines, "}"])

    def head(self) -> str:
        """Return result, name and parameters."""
        return _head(self.function, self.symbol(self.function))

    def begun(self) -> None:
        """Print what stands before the statements."""
        for p in self.function.parameters:
            if not p.array:
                self.take(p.name, p.type, f"%{p.name}")

    def take(self, name: str, kind: Scalar, value: str) -> None:
        """Give an argument that is a number its name."""
        if name in self.function.variables:
            self.lines.append(f"  store {TYPES[kind]} {value}, ptr {_slot(name)}")
        else:
            self.values[name] = value

    def put(self, text: str) -> str:
        """Print an instruction and return its value."""
        self.count += 1
        self.lines.append(f"  %.{self.count} = {text}")
        return f"%.{self.count}"

    def labels(self, *names: str) -> list[str]:
        """Return new labels."""
        self.count += 1
        return [f".{name}{self.count}" for name in names]

    def begin(self, label: str) -> None:
        """Begin a block."""
        self.lines.append(f"{label}:")
        self.label = label

    def jump(self, label: str) -> None:
        """End a block."""
        self.lines.append(f"  br label %{label}")

    def branch(self, test: str, yes: str, no: str) -> None:
        """End a block with a choice."""
        self.lines.append(f"  br i1 {test}, label %{yes}, label %{no}")

    # -- statements

    def statements(self, statements: tuple[Statement, ...]) -> bool:
        """Print statements; return whether what follows them can be reached."""
        for statement in statements:
            for angles in self.before.get(id(statement), ()):
                self.take_sines(angles)
            if isinstance(statement, Assign):
                self.assign(statement.name, self.value(statement.value))
            elif isinstance(statement, Store):
                value = self.value(statement.value)
                place = self.place(statement.array, statement.index)
                self.lines.append(f"  store {TYPES[statement.value.type]} {value}, ptr {place}")
            elif isinstance(statement, Evaluate):
                self.value(statement.call)
            elif isinstance(statement, If):
                if not self.choose(statement):
                    return False
            elif isinstance(statement, While):
                self.repeat(statement)
            elif isinstance(statement, For):
                self.count_through(statement)
            elif isinstance(statement, Leave):
                self.leave(statement)
                return False
            elif isinstance(statement, Return):
                kind = TYPES[statement.value.type]
                self.lines.append(f"  store {kind} {self.value(statement.value)}, ptr %.result")
                self.lines.append("  ret i32 0")
                return False
            elif not self.other(statement):
                return False
        return True

    def other(self, statement: Statement) -> bool:
        """Print a statement that only loops have; return whether what follows it can be reached."""
        raise TypeError(f"emitted functions have no {type(statement).__name__}")

    def leave(self, statement: Leave) -> None:
        """Print the end of a loop, or of what it repeats."""
        self.jump(self.leaving[-1][statement.how == "break"])

    def assign(self, name: str, value: str) -> None:
        """Give a variable a value."""
        if name in self.function.fixed:
            self.values[name] = value
        else:
            self.lines.append(f"  store {TYPES[self.function.variables[name]]} {value}, ptr {_slot(name)}")

    def choose(self, statement: If) -> bool:
        """Print a choice between statements."""
        yes, no, end = self.labels("then", "else", "end")
        self.branch(self.value(statement.test), yes, no if statement.otherwise else end)
        reached = not statement.otherwise
        for label, statements in ((yes, statement.then), (no, statement.otherwise)):
            if statements:
                self.begin(label)
                if self.statements(statements):
                    reached = True
                    self.jump(end)
        if reached:
            self.begin(end)
        return reached

    def repeat(self, statement: While) -> None:
        """Print a loop with a test."""
        test, body, end = self.labels("test", "body", "end")
        self.jump(test)
        self.begin(test)
        self.branch(self.value(statement.test), body, end)
        self.begin(body)
        self.leaving.append((test, end))
        if self.statements(statement.body):
            self.jump(test)
        self.leaving.pop()
        self.begin(end)

    def count_through(self, statement: For) -> None:
        """Print a loop over a range, whose counter is its own: the body may assign the variable."""
        test, body, step, end = self.labels("test", "body", "step", "end")
        counter = f"%.counter{self.count}"
        self.slots.append(f"  {counter} = alloca i64")
        start, stop = self.value(statement.start), self.value(statement.stop)
        self.lines.append(f"  store i64 {start}, ptr {counter}")
        self.jump(test)
        self.begin(test)
        now = self.put(f"load i64, ptr {counter}")
        self.branch(self.put(f"icmp {'slt' if statement.step > 0 else 'sgt'} i64 {now}, {stop}"), body, end)
        self.begin(body)
        self.assign(statement.name, now)
        self.leaving.append((step, end))
        if self.statements(statement.body):
            self.jump(step)
        self.leaving.pop()
        self.begin(step)
        now = self.put(f"load i64, ptr {counter}")
        self.lines.append(f"  store i64 {self.put(f'add nsw i64 {now}, {statement.step}')}, ptr {counter}")
        self.jump(test)
        self.begin(end)

    # -- values

    def value(self, e: Expression) -> str:
        """Print what an expression needs and return its value."""
        if isinstance(e, Constant):
            return _float(e.value) if e.type == "float" else str(int(e.value))
        if isinstance(e, Variable):
            known = self.values.get(e.name)
            return known if known is not None else self.put(f"load {TYPES[e.type]}, ptr {_slot(e.name)}")
        if isinstance(e, Element):
            return self.put(f"load {TYPES[e.type]}, ptr {self.place(e.array, e.index)}")
        if isinstance(e, Operation):
            return self.operation(e.type, e.name, e.arguments)
        if isinstance(e, Call):
            return self.call(e)
        if isinstance(e, Logic):
            return self.decide(e)
        assert isinstance(e, Choice), "all kinds of expressions are known"
        return self.select(e)

    def place(self, array: str, index: Expression) -> str:
        """Return the address of an element."""
        return self.put(f"getelementptr double, ptr {self.base(array)}, i64 {self.value(index)}")

    def base(self, array: str) -> str:
        """Return the address of an array."""
        constant = array in self.function.tables
        return f'@"{self.symbol(self.function)}.{array}"' if constant else f"%{array}.{_DATA}"

    def operation(self, kind: Scalar, name: str, arguments: tuple[Expression, ...]) -> str:
        """Print an operation."""
        first = arguments[0].type
        if name in sines.NAMES and sines.is_simple(arguments[0]) and (name, arguments[0]) in self.found:
            return self.found[name, arguments[0]]
        if name == "pow" and arguments[1].type == "int":
            exponent = arguments[1]
            assert isinstance(exponent, Constant), "a power with a literal exponent"
            return self.product(self.value(arguments[0]), int(exponent.value))
        values = [self.value(a) for a in arguments]
        if name in _COMPARED["float"]:
            flag = self.flag if first == "float" else ""
            compare = "fcmp" if first == "float" else "icmp"
            return self.put(f"{compare}{flag} {_COMPARED[first][name]} {TYPES[first]} {', '.join(values)}")
        if name in ("min", "max"):
            return self.least(kind, name, values)
        if kind == "float" and name in _FLOATS:
            return self.put(f"{_FLOATS[name]}{self.flag} double {values[0]}, {values[1]}")
        if name in _INTS:
            return self.put(f"{_INTS[name]} {TYPES[kind]} {values[0]}, {values[1]}")
        if name in ("float", "int", "bool"):
            return self.converted(first, name, values[0])
        if name == "not":
            return self.put(f"xor i1 {values[0]}, true")
        if name == "neg":
            return self.put(
                f"fsub{self.flag} double -0.0, {values[0]}" if kind == "float" else f"sub i64 0, {values[0]}"
            )
        if name in ("quotient", "rest"):
            return self.quotient(values[0], values[1], rest_wanted=name == "rest")
        if name in ("floordiv", "mod"):
            return self.divided(name, *values)
        if name == "abs" and kind == "int":
            below = self.put(f"icmp slt i64 {values[0]}, 0")
            return self.put(f"select i1 {below}, i64 {self.put(f'sub i64 0, {values[0]}')}, i64 {values[0]}")
        return self.function_of_math({"abs": "fabs"}.get(name, name).removeprefix("math."), values)

    def least(self, kind: Scalar, name: str, values: list[str]) -> str:
        """Print the least or greatest of two values: as in Python, the first where they do not compare."""
        sign = _COMPARED[kind]["lt" if name == "min" else "gt"]
        compare = f"fcmp{self.flag}" if kind == "float" else "icmp"
        test = self.put(f"{compare} {sign} {TYPES[kind]} {values[1]}, {values[0]}")
        return self.put(f"select i1 {test}, {TYPES[kind]} {values[1]}, {TYPES[kind]} {values[0]}")

    def product(self, base: str, exponent: int) -> str:
        """Print a power as products, by squaring."""
        result = _float(1.0)
        while exponent:
            if exponent & 1:
                result = self.put(f"fmul{self.flag} double {result}, {base}")
            exponent >>= 1
            base = self.put(f"fmul{self.flag} double {base}, {base}")
        return result

    def divided(self, name: str, value: str, divisor: str) -> str:
        """Print quotient or rest of a division by a positive constant, rounded downwards."""
        rest = self.put(f"srem i64 {value}, {divisor}")
        below = self.put(f"icmp slt i64 {rest}, 0")
        if name == "mod":
            return self.put(f"select i1 {below}, i64 {self.put(f'add i64 {rest}, {divisor}')}, i64 {rest}")
        quotient = self.put(f"sdiv i64 {value}, {divisor}")
        return self.put(f"select i1 {below}, i64 {self.put(f'sub i64 {quotient}, 1')}, i64 {quotient}")

    def quotient(self, value: str, divisor: str, *, rest_wanted: bool) -> str:
        """Print quotient or rest of a division by any integer, rounded downwards; those by 0 are 0."""
        none = self.put(f"icmp eq i64 {divisor}, 0")
        divisor = self.put(f"select i1 {none}, i64 1, i64 {divisor}")
        quotient, rest = self.put(f"sdiv i64 {value}, {divisor}"), self.put(f"srem i64 {value}, {divisor}")
        signs = self.put(f"icmp slt i64 {self.put(f'xor i64 {rest}, {divisor}')}, 0")
        below = self.put(f"and i1 {signs}, {self.put(f'icmp ne i64 {rest}, 0')}")
        other = f"add i64 {rest}, {divisor}" if rest_wanted else f"sub i64 {quotient}, 1"
        found = self.put(f"select i1 {below}, i64 {self.put(other)}, i64 {rest if rest_wanted else quotient}")
        return self.put(f"select i1 {none}, i64 0, i64 {found}")

    def converted(self, before: Scalar, after: str, value: str) -> str:
        """Print a conversion."""
        if after == "bool":
            test = f"fcmp{self.flag} une double {value}, 0.0" if before == "float" else f"icmp ne i64 {value}, 0"
            return self.put(test)
        if before == "bool":
            wide = self.put(f"zext i1 {value} to i32")
            return self.put(f"sitofp i32 {wide} to double" if after == "float" else f"sext i32 {wide} to i64")
        return self.put(f"sitofp i64 {value} to double" if after == "float" else f"fptosi double {value} to i64")

    def function_of_math(self, name: str, values: list[str]) -> str:
        """Print a call of a mathematical function."""
        called = f"@llvm.{_INTRINSICS[name]}.f64" if name in _INTRINSICS else f"@{name}"
        value = self.put(f"call{self.flag} double {called}({', '.join(f'double {v}' for v in values)})")
        return self.put(f"fptosi double {value} to i64") if name in ("floor", "ceil", "round") else value

    def take_sines(self, angles: tuple[Expression, ...]) -> None:
        """Print sines and cosines of several angles; the first fills the vector up."""
        values = [self.value(angle) for angle in angles]
        n = sines.width(len(values))
        vector = "undef"
        for i in range(n):
            value = values[i] if i < len(values) else values[0]
            vector = self.put(f"insertelement <{n} x double> {vector}, double {value}, i32 {i}")
        pair = self.put(f"call {sines.kind(n)} {sines.name(n)}(<{n} x double> {vector}) nounwind memory(none)")
        for k, name in enumerate(sines.NAMES):
            found = self.put(f"extractvalue {sines.kind(n)} {pair}, {k}")
            for i, angle in enumerate(angles):
                self.found[name, angle] = self.put(f"extractelement <{n} x double> {found}, i32 {i}")

    def call(self, e: Call) -> str:
        """Print a call of another function."""
        f = e.function
        kind = TYPES[f.returned]
        self.count += 1
        result = f"%.result{self.count}"
        self.slots.append(f"  {result} = alloca {kind}")
        parts = [f"ptr {result}", "ptr null"]
        for p, argument in zip(f.parameters, e.arguments, strict=True):
            parts += _handed(p, f"%{argument}.{_DATA}" if isinstance(argument, str) else self.value(argument))
        self.put(f'call i32 @"{self.symbol(f)}"({", ".join(parts)}) nounwind')
        return self.put(f"load {kind}, ptr {result}")

    def decide(self, e: Logic) -> str:
        """Print `and` or `or`."""
        more, end = self.labels("more", "end")
        first = self.value(e.first)
        before = self.label
        self.branch(first, *((more, end) if e.name == "and" else (end, more)))
        self.begin(more)
        second = self.value(e.second)
        after = self.label
        self.jump(end)
        self.begin(end)
        return self.put(f"phi i1 [{'false' if e.name == 'and' else 'true'}, %{before}], [{second}, %{after}]")

    def select(self, e: Choice) -> str:
        """Print a choice between values."""
        yes, no, end = self.labels("then", "else", "end")
        self.branch(self.value(e.test), yes, no)
        parts = []
        for label, part in ((yes, e.chosen), (no, e.otherwise)):
            self.begin(label)
            value = self.value(part)
            parts.append(f"[{value}, %{self.label}]")
            self.jump(end)
        self.begin(end)
        return self.put(f"phi {TYPES[e.type]} {', '.join(parts)}")


def _slot(name: str) -> str:
    return f'%"{name}."'


def _float(value: float | int | bool) -> str:
    return f"0x{struct.pack('>d', float(value)).hex()}"
