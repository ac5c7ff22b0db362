"""Functions of `symgen.compile.native.language` as text for LLVM, with directional derivatives beside each float.

A float has L directions beside it, one vector of LLVM. Directions of an array follow it in memory: element i has its
own at ``place + L i``, counted from the beginning of the array. Control flow follows the values; integers, booleans,
tables and comparisons have no directions, and neither has a number that a caller outside hands over.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping

from symgen.base.ir.graph import CARRIED
from symgen.compile.native import language as lang
from symgen.compile.native import sines
from symgen.compile.native.llvm import LlvmPrinter, declarations, function_head, parameter_types
from symgen.compile.native.llvm_values import TYPES, float_literal, variable_slot
from symgen.compile.native.read_values import Foreign
from symgen.compile.native.tangent_rules import Dual, TangentRules, full_directions


def tangent_module(
    function: lang.Function,
    name: str,
    lanes: int,
    places: Mapping[str, int],
    together: bool = True,
    apart: Callable[[lang.Function], str] = lambda _: "",
) -> str:
    """Return the text of a module that defines a function with directions.

    Parameters
    ----------
    function : Function
        The function; functions that it calls are defined in the module too.
    name : str
        Its name in machine code. It takes the arguments of `function`.
    lanes : int
        Number of directions L.
    places : mapping of str to int
        First element of the directions after each array of floats.
    together : bool
        Whether sines and cosines of several angles are taken together.
    apart : Callable, optional
        Returns the name in machine code of a callee with directions that has code of its own, empty for others. A call
        with the caller's own arrays and numbers takes it.

    Raises
    ------
    Foreign
        If the function has a float without a rule for its directions.
    """
    names, functions = {function.key: name}, [function]

    def symbol_name(f: lang.Function) -> str:
        if f.key not in names:
            names[f.key] = f"{name}.{len(names)}.{f.name}"
            functions.append(f)
        return names[f.key]

    own = TangentPrinter(function, symbol_name, lanes, places, together, apart)
    texts = [own.text()]
    texts += [
        TangentPrinter(f, symbol_name, lanes, None, together).text() for f in itertools.islice(functions, 1, None)
    ]
    texts += [
        sines.function_definition(n)
        for n in (sines.function_width(1), sines.MOST)
        if any(sines.sine_name(n) in text for text in texts)
    ]
    texts += [f"declare {function_head(f, each, named=False)}" for each, f in own.declared.items()]
    return "\n".join([*texts, *declarations(texts), ""])


class TangentPrinter(TangentRules):
    """Prints one function with directions.

    Parameters
    ----------
    function, symbol, together
        As for `LlvmPrinter`.
    lanes : int
        Number of directions.
    places : mapping of str to int or None
        First element of the directions after each array; None where a caller hands over their addresses.
    apart : Callable, optional
        As for `module`.
    """

    def __init__(
        self,
        function: lang.Function,
        symbol: Callable[[lang.Function], str],
        lanes: int,
        places: Mapping[str, int] | None,
        together: bool,
        apart: Callable[[lang.Function], str] = lambda _: "",
    ) -> None:
        super().__init__(function, symbol, "" if places is not None else "internal ", together)
        self.apart, self.declared = apart, dict[str, lang.Function]()
        self.lanes, self.places, self.kind = lanes, places, f"<{lanes} x double>"
        self.shadows: dict[str, str] = {}  # addresses of the directions of arrays
        self.tangents: dict[str, str | None] = {}  # directions of variables that need no memory
        self.printed: dict[tuple[str, ...], str] = {}  # values of this block

    # -- the head of the function

    def text(self) -> str:
        """Return the definition."""
        for name, kind in self.function.variables.items():
            if kind == "float" and name not in self.function.fixed:
                self.slots.append(f"  {variable_slot(name + '.d')} = alloca {self.kind}")
        return super().text()

    def head_of_function(self) -> str:
        """Return result, name and parameters; an inner function takes directions after each float."""
        f = self.function
        if self.places is not None:
            return function_head(f, self.symbol(f))
        parts = list[str]()
        for p in f.parameters:
            parts += [f'{kind} %"{own}"' for kind, own in parameter_types(p)]
            if p.type == "float" and not p.address:
                parts.append(f'{"ptr" if p.array else self.kind} %"{p.name}.d"')
        return f'{self.result_type(f.returned)} @"{self.symbol(f)}"({", ".join(parts)}) nounwind'

    def result_type(self, kind: lang.Scalar) -> str:
        """Return the type of a result: a float has its directions."""
        return f"{{double, {self.kind}}}" if kind == "float" else TYPES[kind]

    def take_arguments(self) -> None:
        """Name the arguments and their directions."""
        super().take_arguments()
        for p in self.function.parameters:
            if p.type != "float" or p.address:
                continue
            inner = self.places is None
            if p.array and self.places is not None:
                if p.name not in self.places:
                    raise Foreign(f"the array '{p.name}' without directions")
                place = self.places[p.name]
                self.shadows[p.name] = self.print_instruction(f'getelementptr double, ptr %"{p.name}", i64 {place}')
            elif p.array:
                self.shadows[p.name] = f'%"{p.name}.d"'
            elif p.name in self.function.variables:
                self.assign_directions(p.name, f'%"{p.name}.d"' if inner else self.directions_of_number(p.name))
            else:
                self.tangents[p.name] = f'%"{p.name}.d"' if inner else self.directions_of_number(p.name)

    def directions_of_number(self, name: str) -> str | None:
        """Print the directions of a number that the caller hands over; time may have some, after the scratch."""
        if self.places is None or name not in self.places:
            return None
        place = self.print_instruction(f'getelementptr double, ptr %"w", i64 {self.places[name]}')
        return self.print_instruction(f"load {self.kind}, ptr {place}, align 8")

    # -- statements

    def begin_block(self, label: str) -> None:
        """Begin a block; values printed before may not exist on the way to it."""
        super().begin_block(label)
        self.printed.clear()

    def set_variable(self, statement: lang.Assign) -> None:
        """Print an assignment to a variable."""
        if statement.value.type != "float":
            super().set_variable(statement)
            return
        value, directions = self.print_dual(statement.value)
        self.assign_value(statement.name, value)
        if statement.name in self.function.fixed:
            self.tangents[statement.name] = directions
        else:
            self.assign_directions(statement.name, directions)

    def assign_directions(self, name: str, directions: str | None) -> None:
        """Print an assignment to the directions of a variable."""
        self.lines.append(
            f"  store {self.kind} {full_directions(directions)}, ptr {variable_slot(name + '.d')}, align 8"
        )

    def print_store(self, statement: lang.Store) -> None:
        """Print an assignment to an element of an array."""
        if statement.value.type != "float":
            super().print_store(statement)
            return
        value, directions = self.print_dual(statement.value)
        own, place = self.addresses_of_element(statement.array, statement.index)
        self.lines.append(f"  store double {value}, ptr {own}")
        self.lines.append(f"  store {self.kind} {full_directions(directions)}, ptr {place}, align 8")

    def print_end(self, value: lang.Expression) -> None:
        """Print the end of the function; the directions of its result are not handed to a caller outside."""
        if value.type != "float" or self.places is not None:
            super().print_end(value)
            return
        (number, directions), kind = self.print_dual(value), self.result_type("float")
        one = self.print_instruction(f"insertvalue {kind} poison, double {number}, 0")
        both = self.print_instruction(f"insertvalue {kind} {one}, {self.kind} {full_directions(directions)}, 1")
        self.lines.append(f"  ret {kind} {both}")

    def addresses_of_element(self, array: str, index: lang.Expression) -> tuple[str, str]:
        """Return the addresses of an element and of its directions."""
        at = self.value(index)
        own = self.print_instruction(f"getelementptr double, ptr {self.array_address(array)}, i64 {at}")
        first = self.print_instruction(f"mul nsw i64 {at}, {self.lanes}")
        return own, self.print_instruction(f"getelementptr double, ptr {self.shadows[array]}, i64 {first}")

    def name_view(self, statement: lang.ArrayView) -> None:
        """Name a part of an array."""
        super().name_view(statement)
        if statement.type == "float" and statement.array in self.shadows:
            first = self.print_instruction(f"mul nsw i64 {self.value(statement.first)}, {self.lanes}")
            self.shadows[statement.name] = self.print_instruction(
                f"getelementptr double, ptr {self.shadows[statement.array]}, i64 {first}"
            )

    def name_either_array(self, statement: lang.Pick) -> None:
        """Name one of two arrays."""
        super().name_either_array(statement)
        one, other = self.shadows[statement.chosen], self.shadows[statement.otherwise]
        test = self.value(statement.test)
        self.shadows[statement.name] = self.print_instruction(f"select i1 {test}, ptr {one}, ptr {other}")

    # -- values

    def value(self, e: lang.Expression) -> str:
        """Print the instructions of an expression and return its value; unused directions cost nothing."""
        return self.print_dual(e)[0] if e.type == "float" else super().value(e)

    def print_dual(self, e: lang.Expression) -> Dual:
        """Print the instructions of a float and return it with its directions."""
        if isinstance(e, lang.Constant):
            return float_literal(e.value), None
        if isinstance(e, lang.Variable):
            if e.name in self.values:
                return self.values[e.name], self.tangents.get(e.name)
            return super().value(e), self.print_instruction(
                f"load {self.kind}, ptr {variable_slot(e.name + '.d')}, align 8"
            )
        if isinstance(e, lang.ArrayElement):
            if e.array not in self.shadows:
                return super().value(e), None
            own, place = self.addresses_of_element(e.array, e.index)
            return self.print_instruction(f"load double, ptr {own}"), self.print_instruction(
                f"load {self.kind}, ptr {place}, align 8"
            )
        if isinstance(e, lang.ScalarOperation):
            return self.differentiate_operation(e)
        if isinstance(e, lang.FunctionCall) and e.function.name in CARRIED:
            return self.pair_with_directions(e)
        if isinstance(e, lang.FunctionCall):
            pair, kind = self.call(e), self.result_type("float")
            return self.print_instruction(f"extractvalue {kind} {pair}, 0"), self.print_instruction(
                f"extractvalue {kind} {pair}, 1"
            )
        if isinstance(e, lang.Choice):
            return self.choose_float(e)
        raise Foreign(f"a {type(e).__name__} with directions")

    def pair_with_directions(self, e: lang.FunctionCall) -> Dual:
        """Print a number with the directions of another one, or with none."""
        (value, _), *others = [self.print_dual(a) for a in e.arguments if not isinstance(a, str)]
        return value, others[0][1] if others else None

    def call(self, e: lang.FunctionCall) -> str:
        """Print a call of another function, by its own code where this knows the places of all directions."""
        symbol = self.apart(e.function) if self.passes_arguments_on(e) else ""
        if not symbol:
            return super().call(e)
        self.declared[symbol] = e.function
        return LlvmPrinter.print_call(self, f'@"{symbol}"', e.function.returned, e.arguments)

    def passes_arguments_on(self, e: lang.FunctionCall) -> bool:
        """Whether a callee without a float as its result takes arguments of this function, under the same names."""
        own = {p.name: p for p in self.function.parameters if p.name not in self.function.variables}
        names = (a if isinstance(a, str) else a.name if isinstance(a, lang.Variable) else "" for a in e.arguments)
        same = [*map(own.get, names)] == [*e.function.parameters]
        return same and e.function.returned != "float" and self.places is not None

    def print_call(self, function: str, returned: lang.Scalar, arguments: tuple[lang.Expression | str, ...]) -> str:
        """Print a call with directions after each float."""
        parts = list[str]()
        for a in arguments:
            if not isinstance(a, str) and a.type == "float":
                value, directions = self.print_dual(a)
                parts += [f"double {value}", f"{self.kind} {full_directions(directions)}"]
                continue
            parts += self.call_argument(a)
            if isinstance(a, str) and a in self.shadows:
                parts.append(f"ptr {self.shadows[a]}")
        return self.print_instruction(f"call {self.result_type(returned)} {function}({', '.join(parts)}) nounwind")

    def choose_float(self, e: lang.Choice) -> Dual:
        """Print a choice between floats."""
        yes, no, end = self.new_labels("then", "else", "end")
        self.branch(self.value(e.test), yes, no)
        values, directions = list[str](), list[str]()
        for label, part in ((yes, e.chosen), (no, e.otherwise)):
            self.begin_block(label)
            value, direction = self.print_dual(part)
            values.append(f"[{value}, %{self.label}]")
            directions.append(f"[{full_directions(direction)}, %{self.label}]")
            self.jump(end)
        self.begin_block(end)
        return self.print_instruction(f"phi double {', '.join(values)}"), self.print_instruction(
            f"phi {self.kind} {', '.join(directions)}"
        )
