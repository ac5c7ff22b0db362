"""Functions of `symgen.compile.native.language` as text for LLVM.

Operations have the order of the source and one liberty, contraction to fused multiply-add. A function takes numbers as
they are, an array as the address of its elements and its lengths, another function as its address.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from symgen.compile.native import language as lang
from symgen.compile.native import sines
from symgen.compile.native.llvm_values import (
    INTRINSICS,
    TYPES,
    ValuePrinter,
    float_literal,
    function_name,
    variable_slot,
)

#: The argument for the number of runs, in functions for several runs at once.
COUNT_OF_LANES = "lanes"
#: Attribute of functions for several runs: LLVM halves vectors of 512 bits of processors where they once cost clock.
WIDEST = ' "prefer-vector-width"="512"'
#: Name that closes a loop of the runtime which is neither turned into vectors nor copied: loops over arrays as short as
#: the coordinates of a mechanism are no faster with it, and take twice as long to compile.
_AS_WRITTEN = ", !llvm.loop !0"
_METADATA = (
    "!0 = distinct !{!0, !1, !2}",
    '!1 = !{!"llvm.loop.vectorize.enable", i1 false}',
    '!2 = !{!"llvm.loop.unroll.disable"}',
)


def llvm_module(
    function: lang.Function,
    symbol: Callable[[lang.Function], str],
    inlined: Callable[[lang.Function], bool],
    together: bool = True,
) -> str:
    """Return the text of a module that defines a function.

    Parameters
    ----------
    function : Function
        The function.
    symbol : Callable
        Returns the name of a function in machine code.
    inlined : Callable
        Whether the body of a callee is in the module too, for the compiler to copy. Any other callee has to be in
        memory under its symbol when the module is loaded: LLVM calls address 0 for an undefined symbol.
    together : bool
        Whether sines and cosines of several angles are taken together (`symgen.compile.native.sines`).
    """
    functions, declared = functions_of_module(function, inlined)
    texts = []
    for f in functions:
        linkage = "" if f is function else "internal " if is_copied(f) else "available_externally "
        texts.append(LlvmPrinter(f, symbol, linkage, together).text())
    texts.extend(
        sines.function_definition(n)
        for n in (sines.function_width(1), sines.MOST)
        if any(sines.sine_name(n) in text for text in texts)
    )
    texts.extend(f"declare {function_head(f, symbol(f), named=False)}" for f in declared)
    return "\n".join([*texts, *declarations(texts), ""])


def loop_module(function: lang.Function, symbol: str) -> str:
    """Return the text of a module that defines a loop, with its called parts.

    Loops are unrolled in functions over lanes, and in parts that ask for it (`symgen.compile.store.jit.jit`).

    Parameters
    ----------
    function : Function
        From `symgen.compile.native.loops`.
    symbol : str
        Its name in machine code.
    """
    names: dict[int, str] = {id(function): symbol}
    functions = [function]
    for each in functions:  # callees follow
        for part in each.called:
            if id(part) not in names:
                names[id(part)] = f"{symbol}.{len(names)}.{part.name}"
                functions.append(part)
    texts, inserted = list[str](), dict[str, str]()
    for each in functions:
        printer = LlvmPrinter(each, lambda f: names[id(f)], "" if each is function else "internal ", False)
        printer.as_written = not (getattr(each.source, "unrolled", False) or printer.for_lanes())
        texts.append(printer.text())
        inserted |= printer.inserted
    lines = [line for text in inserted.values() for line in text.splitlines()]
    texts += [line for line in lines if not line.startswith("declare ")]
    declared = dict.fromkeys(line for line in lines if line.startswith("declare "))
    return "\n".join([*texts, *declared, *declarations(texts), *_METADATA, ""])


def functions_of_module(
    function: lang.Function, inlined: Callable[[lang.Function], bool]
) -> tuple[list[lang.Function], list[lang.Function]]:
    """Return functions whose bodies belong in a module, and functions of which it needs only the symbol."""
    functions, declared, waiting = {function.key: function}, dict[object, lang.Function](), list(function.called)
    while waiting:
        each = waiting.pop(0)
        if each.key not in functions and (is_copied(each) or inlined(each)):
            functions[each.key] = each
            waiting.extend(each.called)
        elif each.key not in functions:
            declared[each.key] = each
    return list(functions.values()), list(declared.values())


def is_copied(function: lang.Function) -> bool:
    """Whether a function has no machine code of its own at its call.

    Such functions take tables of looped code or the number of lanes, or are inlined.
    """
    handed_on = any(p.type == "unsigned" or p.name == COUNT_OF_LANES for p in function.parameters)
    return function.inlined or (handed_on and all(is_copied(f) for f in function.called))


def declarations(texts: Iterable[str]) -> list[str]:
    """Return declarations of the mathematical functions in texts."""
    text = "\n".join(texts)
    lines = []
    for name, count in {**lang.FUNCTIONS, "round": 1}.items():
        if f"{function_name(name)}(" in text:
            attributes = "" if name in INTRINSICS else " nounwind memory(read)"
            lines.append(f"declare double {function_name(name)}({', '.join(['double'] * count)}){attributes}")
    return lines


def function_head(function: lang.Function, name: str, named: bool = True) -> str:
    """Return result, name and parameters."""
    parts = [f'{kind} %"{own}"' if named else kind for p in function.parameters for kind, own in parameter_types(p)]
    return f'{TYPES[function.returned]} @"{name}"({", ".join(parts)}) nounwind'


def parameter_types(parameter: lang.FunctionParameter) -> list[tuple[str, str]]:
    """Return LLVM's types of a parameter, and its names."""
    if parameter.address:
        return [("ptr", parameter.name)]
    if not parameter.array:
        return [(TYPES[parameter.type], parameter.name)]
    return [("ptr", parameter.name), *(("i64", f"{parameter.name}.{axis}") for axis in range(parameter.rank))]


class LlvmPrinter(ValuePrinter):
    """Prints one function."""

    def __init__(
        self, function: lang.Function, symbol: Callable[[lang.Function], str], linkage: str, together: bool
    ) -> None:
        super().__init__(function, symbol)
        self.linkage = linkage
        self.as_written = False  # loops are not unrolled
        groups = sines.groups_of_angles(function) if together else {}
        self.before = {id(function.body[i]): calls for i, calls in groups.items()}
        self.leaving: list[tuple[str, str]] = []  # labels after `continue` and `break`, innermost last
        self.blocks: dict[int, str] = {}  # labels after blocks

    def text(self) -> str:
        """Return the definition."""
        f = self.function
        for name, kind in f.variables.items():
            if name not in f.fixed:
                self.slots.append(f"  {variable_slot(name)} = alloca {TYPES[kind]}")
        self.take_arguments()
        self.statements(f.body)
        tables = [
            f'@"{self.symbol(f)}.{name}" = private unnamed_addr constant [{len(x)} x double] '
            f"[{', '.join('double ' + float_literal(v) for v in x)}]"
            for name, x in f.tables.items()
        ]
        copied = " alwaysinline" * (f.inlined and bool(self.linkage))
        begin = f"define {self.linkage}{self.head_of_function()}{copied}{WIDEST * self.for_lanes()} {{"
        return "\n".join([*tables, begin, ".entry:", *self.slots, *self.lines, "}"])

    def for_lanes(self) -> bool:
        """Whether the function is for several runs at once."""
        names = (*self.function.variables, *(p.name for p in self.function.parameters))
        return COUNT_OF_LANES in names

    def head_of_function(self) -> str:
        """Return result, name and parameters."""
        return function_head(self.function, self.symbol(self.function))

    def take_arguments(self) -> None:
        """Name the arguments."""
        for p in self.function.parameters:
            if p.array:
                own, *lengths = (f'%"{name}"' for _, name in parameter_types(p))
                self.views[p.name] = own, tuple(lengths)
            elif p.name in self.function.variables:
                self.lines.append(f'  store {TYPES[p.type]} %"{p.name}", ptr {variable_slot(p.name)}')
            elif not p.address:
                self.values[p.name] = f'%"{p.name}"'

    # -- statements

    def statements(self, statements: tuple[lang.Statement, ...]) -> bool:
        """Print statements; return whether the following ones can be reached."""
        for statement in statements:
            for angles in self.before.get(id(statement), ()):
                self.take_sines(angles)
            if isinstance(statement, lang.Assign):
                self.set_variable(statement)
            elif isinstance(statement, lang.Store):
                self.print_store(statement)
            elif isinstance(statement, lang.Evaluate):
                self.value(statement.call)
            elif isinstance(statement, lang.If):
                if not self.print_branch(statement):
                    return False
            elif isinstance(statement, lang.While):
                self.print_loop(statement)
            elif isinstance(statement, lang.For):
                self.count_through(statement)
            elif isinstance(statement, lang.ArrayView):
                self.name_view(statement)
            elif isinstance(statement, lang.StatementBlock):
                self.print_block(statement)
            elif isinstance(statement, lang.Pick):
                self.name_either_array(statement)
            elif isinstance(statement, lang.Leave):
                in_block = statement.how == "block"
                label = self.blocks[statement.block] if in_block else self.leaving[-1][statement.how == "break"]
                self.jump(label)
                return False
            else:
                assert isinstance(statement, lang.Return), "all kinds of statements are known"
                self.print_end(statement.value)
                return False
        return True

    def set_variable(self, statement: lang.Assign) -> None:
        """Print an assignment to a variable."""
        self.assign_value(statement.name, self.value(statement.value))

    def print_store(self, statement: lang.Store) -> None:
        """Print an assignment to an element of an array."""
        value = self.value(statement.value)
        place = self.element_address(statement.array, statement.index)
        self.lines.append(f"  store {TYPES[statement.value.type]} {value}, ptr {place}")

    def print_end(self, value: lang.Expression) -> None:
        """Print the end of the function."""
        self.lines.append(f"  ret {TYPES[value.type]} {self.value(value)}")

    def name_view(self, statement: lang.ArrayView) -> None:
        """Name a part of an array."""
        data, first = self.array_address(statement.array), self.value(statement.first)
        if statement.size is None:
            lengths = self.views[statement.array][1][statement.indices :]
        else:
            rest = self.views[statement.array][1][1:] if statement.array in self.views else ()
            lengths = (self.value(statement.size), *rest)
        self.views[statement.name] = self.print_instruction(f"getelementptr double, ptr {data}, i64 {first}"), lengths
        if statement.type == "unsigned":
            self.small.add(statement.name)

    def print_block(self, statement: lang.StatementBlock) -> None:
        """Print statements that may be left before their end."""
        (end,) = self.new_labels("end")
        self.blocks[statement.number] = end
        if self.statements(statement.body):
            self.jump(end)
        self.begin_block(end)

    def name_either_array(self, statement: lang.Pick) -> None:
        """Name one of two arrays."""
        test, (a, m), (b, n) = self.value(statement.test), self.views[statement.chosen], self.views[statement.otherwise]
        data = self.print_instruction(f"select i1 {test}, ptr {a}, ptr {b}")
        self.views[statement.name] = data, (self.print_instruction(f"select i1 {test}, i64 {m[0]}, i64 {n[0]}"),)

    def assign_value(self, name: str, value: str) -> None:
        """Set a variable to a printed value."""
        if name in self.function.fixed:
            self.values[name] = value
        else:
            self.lines.append(f"  store {TYPES[self.function.variables[name]]} {value}, ptr {variable_slot(name)}")

    def print_branch(self, statement: lang.If) -> bool:
        """Print a choice between statements."""
        yes, no, end = self.new_labels("then", "else", "end")
        self.branch(self.value(statement.test), yes, no if statement.otherwise else end)
        reached = not statement.otherwise
        for label, statements in ((yes, statement.then), (no, statement.otherwise)):
            if statements:
                self.begin_block(label)
                if self.statements(statements):
                    reached = True
                    self.jump(end)
        if reached:
            self.begin_block(end)
        return reached

    def print_loop(self, statement: lang.While) -> None:
        """Print a loop with a test."""
        test, body, end = self.new_labels("test", "body", "end")
        self.jump(test)
        self.begin_block(test)
        self.branch(self.value(statement.test), body, end)
        self.begin_block(body)
        self.leaving.append((test, end))
        if self.statements(statement.body):
            self.jump_back(test)
        self.leaving.pop()
        self.begin_block(end)

    def jump_back(self, label: str) -> None:
        """End the body of a loop."""
        self.jump(label)
        if self.as_written:
            self.lines[-1] += _AS_WRITTEN

    def count_through(self, statement: lang.For) -> None:
        """Print a loop over a range with its own counter, as the body may assign the variable."""
        test, body, step, end = self.new_labels("test", "body", "step", "end")
        counter = f"%.counter{self.count}"
        self.slots.append(f"  {counter} = alloca i64")
        start, stop = self.value(statement.start), self.value(statement.stop)
        self.lines.append(f"  store i64 {start}, ptr {counter}")
        self.jump(test)
        self.begin_block(test)
        now = self.print_instruction(f"load i64, ptr {counter}")
        self.branch(
            self.print_instruction(f"icmp {'slt' if statement.step > 0 else 'sgt'} i64 {now}, {stop}"), body, end
        )
        self.begin_block(body)
        self.assign_value(statement.name, now)
        self.leaving.append((step, end))
        if self.statements(statement.body):
            self.jump(step)
        self.leaving.pop()
        self.begin_block(step)
        now = self.print_instruction(f"load i64, ptr {counter}")
        self.lines.append(
            f"  store i64 {self.print_instruction(f'add nsw i64 {now}, {statement.step}')}, ptr {counter}"
        )
        self.jump_back(test)
        self.begin_block(end)
