"""Functions of `symgen.compile.native.language` as C99: the emitted code of a mechanism for other programs.

Numbers have the type ``real``, functions of the C library are called by ``M(sin)``, so that a text serves 64 and 32
bits. Operations have the order of the source. Integers of emitted code are indices and counters, far below 2^31.
"""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from itertools import pairwise
from typing import ClassVar

from symgen.compile.native import language as lang
from symgen.compile.native.binding import MEMORY, BoundFunctions, ConstantTable, is_bound
from symgen.compile.native.c99_words import HELPERS, RESERVED, add_helpers, break_line, c_number
from symgen.compile.native.folding import is_pure, walk_statements
from symgen.compile.native.printing import FunctionPrinter, order_functions, variable_name

_CALLED = {"floordiv": "floored", "mod": "rest", "min": "least", "max": "greatest", "abs": "fabs"}
_CALLED |= {"math.fabs": "fabs", "pow": "pow", "round": "rint"}
OF_INTEGERS = {"min": "least_of_integers", "max": "greatest_of_integers", "floordiv": "floored_quotient", "abs": "abs"}
OF_INTEGERS |= {"quotient": "quotient_of_integers", "rest": "rest_of_integers", "mod": "rest_of_integers"}
_TYPES = {"float": "real", "int": "int", "bool": "int"}
#: Limits of rounding below this are others for numbers of 32 bits, in proportion to the rounding of these.
FINEST, _COARSER = 1e-5, 2.0**29
#: Most statements of a function: the time that compilers spend on one function grows faster than its length.
_LONGEST = 600


def c_functions(
    functions: Mapping[str, lang.Function],
    bound: BoundFunctions | None = None,
    memory: str = "",
    around: frozenset[str] = frozenset(),
) -> str:
    """Return the text of functions and their callees, each once, callees first, after their helpers.

    Parameters
    ----------
    functions : mapping of str to Function
        Functions by their names in the text.
    bound : BoundFunctions, optional
        Functions of the runtime bound to a model, which follow.
    memory : str
        Type of the structure with the memory of these.
    around : frozenset of str
        Names in the text around the functions, which callees do not take.
    """
    bound = bound or BoundFunctions({})
    given = {**functions, **bound.functions}
    order, names = order_functions(given, RESERVED | (around - given.keys()))
    written: dict[object, frozenset[str]] = {}
    for function in order:
        written[function.key] = _changed_arrays(function, written)
    texts = [*map(_table_definition, bound.tables.values())]
    for function in order:
        if is_bound(function):
            texts.append(_BoundPrinter(function, names, written, bound, memory).text())
        else:
            texts.append(CPrinter(function, names, written).text())
    return add_helpers(texts)


def _table_definition(table: ConstantTable) -> str:
    """Return the definition of a table of numbers."""
    kind = "real" if table.type == "float" else "int"
    numbers = ", ".join(c_number(x) if kind == "real" else str(int(x)) for x in table.values or (0.0,))
    return break_line(f"static const {kind} {variable_name(table.name, RESERVED)}[] = {{{numbers}}};")


def _changed_arrays(function: lang.Function, of_called: Mapping[object, frozenset[str]]) -> frozenset[str]:
    """Return the arrays that a function or its callees change."""
    arrays = set[str]()
    for value in walk_statements(function.body):
        if isinstance(value, lang.Store):
            arrays.add(value.array)
        elif isinstance(value, lang.FunctionCall):
            pairs = zip(value.function.parameters, value.arguments, strict=True)
            arrays.update(str(a) for parameter, a in pairs if parameter.name in of_called[value.function.key])
        elif isinstance(value, lang.ArrayView):
            arrays.add(value.array)
    return frozenset(arrays)


def _names_in_body(body: object) -> frozenset[str]:
    """Return the names of arrays and variables that statements read or change."""
    names = set[str]()
    for value in walk_statements(body):
        if isinstance(value, lang.Variable | lang.Assign):
            names.add(value.name)
        elif isinstance(value, lang.ArrayElement | lang.Store | lang.ArrayView):
            names.add(value.array)
        elif isinstance(value, lang.FunctionCall):
            names.update(a for a in value.arguments if isinstance(a, str))
    return frozenset(names)


def _length_variables(body: tuple[lang.Statement, ...]) -> set[str]:
    """Return the variables that are lengths of parts of arrays, or that such alone read; their values call nothing.

    In C an address has no length.
    """
    values, lengths = list(walk_statements(body)), set[str]()
    called = {v.name for v in values if isinstance(v, lang.Assign) and not is_pure(v.value)}
    reads = Counter(v.name for v in values if isinstance(v, lang.Variable))
    reads.subtract(v.size.name for v in values if isinstance(v, lang.ArrayView) and isinstance(v.size, lang.Variable))
    waiting = {name for name, count in reads.items() if count == 0} - called
    while waiting:
        lengths |= waiting
        own = [v.value for v in values if isinstance(v, lang.Assign) and v.name in waiting]
        reads.subtract(v.name for v in walk_statements(tuple(own)) if isinstance(v, lang.Variable))
        waiting = {name for name, count in reads.items() if count == 0} - called - lengths
    return lengths


def _split_into_parts(function: lang.Function) -> list[tuple[lang.Statement, ...]]:
    """Return the body of a long straight function in parts, one part of others."""
    body = function.body
    ends = [s for s in walk_statements(body) if isinstance(s, lang.Return)]
    if len(body) <= 2 * _LONGEST or ends != [body[-1]]:
        return [body]
    count = -(-len(body) // _LONGEST)
    at = [(len(body) - 1) * k // count for k in range(count + 1)]
    return [*(body[first:last] for first, last in pairwise(at)), body[-1:]]


class CPrinter(FunctionPrinter):
    """Prints one function."""

    reserved = RESERVED
    types: ClassVar[Mapping[str, str]] = _TYPES
    of_integers: ClassVar[Mapping[str, str]] = OF_INTEGERS

    def __init__(
        self, function: lang.Function, names: Mapping[object, str], written: Mapping[object, frozenset[str]]
    ) -> None:
        super().__init__(function, names)
        self.written, self.shared = written[function.key], dict[str, str]()

    def text(self) -> str:
        """Return the definition, after the tables that it reads and after its parts where it is long."""
        f, own = self.function, self.names[self.function.key]
        lines = self.tables()
        parts = _split_into_parts(f)
        if len(parts) > 1:
            return "\n".join(map(break_line, [*lines, *self._print_parts(own, parts)]))
        used = _names_in_body(f.body)
        lines.append(f"static {self.types[f.returned]} {own}({', '.join(map(self._parameter, f.parameters))}) {{")
        lines += [f"(void){self.variable_text(p.name)};" for p in f.parameters if p.name not in used]
        return "\n".join(map(break_line, [*lines, *self._declare_locals(used), *self.lines(f.body), "}"]))

    def tables(self) -> list[str]:
        """Return the tables that the function reads."""
        f, lines = self.function, list[str]()
        for name, values in f.tables.items():
            numbers = ", ".join(self.literal_text(x)[0] for x in values)
            lines.append(f"static const real {self.names[f.key, name]}[{len(values)}] = {{{numbers}}};")
        return lines

    def _declare_locals(self, used: Collection[str]) -> list[str]:
        """Return declarations of variables that are assigned several times."""
        f, parameters = self.function, {p.name for p in self.function.parameters}
        return [
            f"{self.types[kind]} {self.variable_text(name)} = 0;"
            for name, kind in f.variables.items()
            if name in used and name not in parameters and name not in self.once and name not in self.shared
        ]

    def _print_parts(self, own: str, parts: Sequence[tuple[lang.Statement, ...]]) -> list[str]:
        """Return functions of parts, and the function that calls them; shared values are elements of arrays."""
        f, names = self.function, [_names_in_body(part) for part in parts]
        arguments = {p.name: p for p in f.parameters}
        sizes = Counter[str]()
        for name, kind in f.variables.items():
            if name not in arguments and sum(name in used for used in names) > 1:
                array = "values" if kind == "float" else "numbers"
                self.shared[name] = f"{array}[{sizes[array]}]"
                sizes[array] += 1
        lines, calls = list[str](), list[str]()
        for k, (part, used) in enumerate(zip(parts[:-1], names, strict=False), 1):
            body = self.lines(part)
            own_arguments = [p for p in f.parameters if p.name in used]
            arrays = [a for a in ("values", "numbers") if any(f"{a}[" in line for line in body)]
            heads = [*map(self._parameter, own_arguments)]
            heads += [f"{'real' if a == 'values' else 'int'} *restrict {a}" for a in arrays]
            lines += [f"static void {own}_part{k}({', '.join(heads)}) {{", *self._declare_locals(used), *body, "}", ""]
            calls.append(
                f"{own}_part{k}({', '.join([*(self.variable_text(p.name) for p in own_arguments), *arrays])});"
            )
        every = frozenset[str]().union(*names)
        lines.append(f"static {self.types[f.returned]} {own}({', '.join(map(self._parameter, f.parameters))}) {{")
        lines += [f"(void){self.variable_text(p.name)};" for p in f.parameters if p.name not in every]
        lines += [f"{'real' if a == 'values' else 'int'} {a}[{size}];" for a, size in sizes.items()]
        return [*lines, *calls, *self.lines(parts[-1]), "}"]

    def variable_text(self, name: str) -> str:
        """Return the name of a variable, or the array element in which parts share it."""
        return self.shared.get(name) or super().variable_text(name)

    def _parameter(self, parameter: lang.FunctionParameter) -> str:
        kind, name = self.types[parameter.type], self.variable_text(parameter.name)
        if not parameter.array:
            return f"{kind} {name}"
        return f"{'' if parameter.name in self.written else 'const '}{kind} *restrict {name}"

    def literal_text(self, value: float | int | bool) -> tuple[str, int]:
        """Return a number and the precedence of its text."""
        text = str(int(value)) if isinstance(value, int) else c_number(value)
        return text, 14 if text.startswith("-") else 20

    def declaration(self, s: lang.Assign) -> str:
        """Return the words before the name of a variable that is assigned once, at its assignment."""
        return "" if s.name in self.shared else f"const {self.types[self.function.variables[s.name]]} "

    def loop_head(self, s: lang.For, counter: str) -> str:
        """Return the head of a loop whose counter has its own name."""
        first, last, sign = self.value(s.start), self.value(s.stop), "<" if s.step > 0 else ">"
        kind = self.types["int"]
        return f"for ({kind} {counter} = {first}, end = {last}; {counter} {sign} end; {counter} += {s.step}) {{"

    def function_name(self, e: lang.ScalarOperation) -> str:
        """Return the name of an operation's function."""
        if e.type == "int" and e.arguments[0].type == "int":
            return self.of_integers[e.name]
        name = _CALLED.get(e.name, e.name.removeprefix("math."))
        name = name if name in HELPERS else f"M({name})"
        return f"({self.types['int']}){name}" if e.type == "int" else name

    def conversion(self, kind: str, value: lang.Expression) -> tuple[str, int]:
        """Return a value in another type."""
        if kind == "bool":
            return f"{self.value(value, 10)} != 0", 9
        return f"({self.types[kind]}){self.value(value, 15)}", 14

    def block_text(self, number: int, lines: list[str]) -> list[str]:
        """Return the statements of a block that may be left before its end."""
        return ["{", *lines, "}", f"end{number}:;"]

    def leave_block(self, number: int) -> str:
        """Return the statement that leaves a block."""
        return f"goto end{number};"

    def length_text(self, array: str, axis: int) -> str:
        """Return the length of an array along an axis, an argument or a variable."""
        return self.variable_text(f"{array}.n{axis}")

    def array_arguments(self, array: str) -> list[str]:
        """Return the arguments of a call for an array."""
        return [self.variable_text(array)]

    def name_array(self, name: str, array: str, first: lang.Expression | None, lengths: list[str]) -> list[str]:
        """Return the statements that give a name to an array, or to the elements from one on."""
        kind, _ = self.arrays[name]
        address, sizes = self.variable_text(name), [self.length_text(name, axis) for axis in range(len(lengths))]
        self.views |= dict.fromkeys(
            [f"{self.types[kind]} *{address} = 0;", *(f"{self.types['int']} {n} = 0;" for n in sizes)]
        )
        begin = f" + {self.value(first, 13)}" if first is not None else ""
        return [f"{address} = {self.variable_text(array)}{begin};", *map("{} = {};".format, sizes, lengths)]

    def call_by_address(self, e: lang.Invoke) -> str:
        """Return the call of a function by its address."""
        address = self.variable_text(e.function) if isinstance(e.function, str) else self.value(e.function)
        kinds = [kind for a in e.arguments for kind in self.argument_types(a)]
        return f"(({self.types[e.type]} (*)({', '.join(kinds)})){address})({', '.join(self.arguments(e.arguments))})"

    def argument_types(self, argument: lang.Expression | str) -> list[str]:
        """Return the types of the arguments of a call for one value."""
        if not isinstance(argument, str):
            return [self.types[argument.type]]
        if argument not in self.arrays:
            return ["void *"]
        kind, _ = self.arrays[argument]
        return [f"{self.types[kind]} *", *(self.types["int"] for _ in self.array_arguments(argument)[1:])]


class _BoundPrinter(CPrinter):
    """Prints one function bound to a model.

    Parameters
    ----------
    function, names, written
        As for `CPrinter`.
    bound : BoundFunctions
        The functions, with the memory that they use.
    memory : str
        Type of the structure with this memory.
    """

    def __init__(
        self,
        function: lang.Function,
        names: Mapping[object, str],
        written: Mapping[object, frozenset[str]],
        bound: BoundFunctions,
        memory: str,
    ) -> None:
        super().__init__(function, names, written)
        self.bound, self.memory = bound, memory
        self.arrays |= bound.arrays
        #: Variables that are not printed.
        self.lengths = _length_variables(function.body)

    def text(self) -> str:
        """Return the definition."""
        f, own = self.function, self.names[self.function.key]
        used, body = _names_in_body(f.body), self.lines(f.body)
        heads = [f"{self.memory} *model"] if f.key in self.bound.with_memory else []
        unused = ["(void)model;"] if heads and not any(re.search(r"\bmodel\b", line) for line in body) else []
        heads += map(self._parameter, f.parameters)
        lines = [f"static {self.types[f.returned]} {own}({', '.join(heads) or 'void'}) {{", *unused]
        lines += [f"(void){self.variable_text(p.name)};" for p in f.parameters if p.name not in used]
        return "\n".join(map(break_line, [*lines, *self._declare_locals(used), *self.views, *body, "}"]))

    def statement(self, s: lang.Statement) -> list[str]:
        """Return one statement."""
        return [] if isinstance(s, lang.Assign) and s.name in self.lengths else super().statement(s)

    def length_text(self, array: str, axis: int) -> str:
        """Return the length of an array: a member of the structure has one."""
        if array not in self.bound.rooms:
            return super().length_text(array, axis)
        own = self.variable_text(array)
        return f"(int)(sizeof {own}/sizeof *{own})"

    def variable_text(self, name: str) -> str:
        """Return the name of a variable, or a member of the structure."""
        if name in self.bound.rooms:
            return f"model->{name.removeprefix(MEMORY)}"
        return super().variable_text(name)

    def passed_arguments(self, e: lang.FunctionCall) -> list[str]:
        """Return the arguments of a call of another function."""
        return [*(["model"] if e.function.key in self.bound.with_memory else []), *self.arguments(e.arguments)]

    def _parameter(self, parameter: lang.FunctionParameter) -> str:
        return super()._parameter(parameter).replace("*restrict ", "*")  # some are parts of others

    def literal_text(self, value: float | int | bool) -> tuple[str, int]:
        """Return a number; a macro replaces limits of rounding by limits for 32 bits."""
        if isinstance(value, float) and 0.0 < abs(value) < FINEST:
            single = value * _COARSER if abs(value) < 1e-7 else math.copysign(1e-3, value)
            return f"FINE({value!r}, {single:.3g})", 20
        return super().literal_text(value)

    def name_array(self, name: str, array: str, first: lang.Expression | None, lengths: list[str]) -> list[str]:
        """Return the statement that gives a name to an array, or to the elements from one on."""
        kind, _ = self.arrays[name]
        address, begin = self.variable_text(name), f" + {self.value(first, 13)}" if first is not None else ""
        self.views |= {f"{self.types[kind]} *{address} = 0;": None}
        return [f"{address} = {self.variable_text(array)}{begin};"]
