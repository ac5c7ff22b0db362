"""Functions of `symgen.compile.native.language` as text for LLVM, with directional derivatives beside each float.

A float has L directions beside it, one vector of LLVM. Directions of an array lie behind it: element i has its own
at ``place + L i``, counted from the beginning of the array. Control flow follows the values; integers, booleans, tables
and comparisons have no directions, and neither has a number that a caller outside hands over.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping

from symgen.base.ir.graph import CARRIED
from symgen.compile.native import language as lang
from symgen.compile.native import sines
from symgen.compile.native.llvm import LlvmPrinter, declarations, head, taken
from symgen.compile.native.llvm_values import TYPES, literal, slot
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
        First element of the directions behind each array of floats.
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

    def symbol(f: lang.Function) -> str:
        if f.key not in names:
            names[f.key] = f"{name}.{len(names)}.{f.name}"
            functions.append(f)
        return names[f.key]

    own = TangentPrinter(function, symbol, lanes, places, together, apart)
    texts = [own.text()]
    texts += [TangentPrinter(f, symbol, lanes, None, together).text() for f in itertools.islice(functions, 1, None)]
    texts += [
        sines.definition(n) for n in (sines.width(1), sines.MOST) if any(sines.sine_name(n) in text for text in texts)
    ]
    texts += [f"declare {head(f, each, named=False)}" for each, f in own.declared.items()]
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
        First element of the directions behind each array; None where a caller hands over their addresses.
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
                self.slots.append(f"  {slot(name + '.d')} = alloca {self.kind}")
        return super().text()

    def head(self) -> str:
        """Return result, name and parameters; an inner function takes directions behind each float."""
        f = self.function
        if self.places is not None:
            return head(f, self.symbol(f))
        parts = list[str]()
        for p in f.parameters:
            parts += [f'{kind} %"{own}"' for kind, own in taken(p)]
            if p.type == "float" and not p.address:
                parts.append(f'{"ptr" if p.array else self.kind} %"{p.name}.d"')
        return f'{self.returned(f.returned)} @"{self.symbol(f)}"({", ".join(parts)}) nounwind'

    def returned(self, kind: lang.Scalar) -> str:
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
                self.shadows[p.name] = self.put(f'getelementptr double, ptr %"{p.name}", i64 {place}')
            elif p.array:
                self.shadows[p.name] = f'%"{p.name}.d"'
            elif p.name in self.function.variables:
                self.keep(p.name, f'%"{p.name}.d"' if inner else self.of_time(p.name))
            else:
                self.tangents[p.name] = f'%"{p.name}.d"' if inner else self.of_time(p.name)

    def of_time(self, name: str) -> str | None:
        """Print the directions of a number that the caller hands over; time may have some, behind the scratch."""
        if self.places is None or name not in self.places:
            return None
        place = self.put(f'getelementptr double, ptr %"w", i64 {self.places[name]}')
        return self.put(f"load {self.kind}, ptr {place}, align 8")

    # -- statements

    def begin(self, label: str) -> None:
        """Begin a block; values printed before may not exist on the way to it."""
        super().begin(label)
        self.printed.clear()

    def set_variable(self, statement: lang.Assign) -> None:
        """Print an assignment to a variable."""
        if statement.value.type != "float":
            super().set_variable(statement)
            return
        value, directions = self.dual(statement.value)
        self.assign(statement.name, value)
        if statement.name in self.function.fixed:
            self.tangents[statement.name] = directions
        else:
            self.keep(statement.name, directions)

    def keep(self, name: str, directions: str | None) -> None:
        """Print an assignment to the directions of a variable."""
        self.lines.append(f"  store {self.kind} {full_directions(directions)}, ptr {slot(name + '.d')}, align 8")

    def store(self, statement: lang.Store) -> None:
        """Print an assignment to an element of an array."""
        if statement.value.type != "float":
            super().store(statement)
            return
        value, directions = self.dual(statement.value)
        own, place = self.places_of(statement.array, statement.index)
        self.lines.append(f"  store double {value}, ptr {own}")
        self.lines.append(f"  store {self.kind} {full_directions(directions)}, ptr {place}, align 8")

    def end(self, value: lang.Expression) -> None:
        """Print the end of the function; the directions of its result are not handed to a caller outside."""
        if value.type != "float" or self.places is not None:
            super().end(value)
            return
        (number, directions), kind = self.dual(value), self.returned("float")
        one = self.put(f"insertvalue {kind} poison, double {number}, 0")
        both = self.put(f"insertvalue {kind} {one}, {self.kind} {full_directions(directions)}, 1")
        self.lines.append(f"  ret {kind} {both}")

    def places_of(self, array: str, index: lang.Expression) -> tuple[str, str]:
        """Return the addresses of an element and of its directions."""
        at = self.value(index)
        own = self.put(f"getelementptr double, ptr {self.base(array)}, i64 {at}")
        first = self.put(f"mul nsw i64 {at}, {self.lanes}")
        return own, self.put(f"getelementptr double, ptr {self.shadows[array]}, i64 {first}")

    def view(self, statement: lang.ArrayView) -> None:
        """Name a part of an array."""
        super().view(statement)
        if statement.type == "float" and statement.array in self.shadows:
            first = self.put(f"mul nsw i64 {self.value(statement.first)}, {self.lanes}")
            self.shadows[statement.name] = self.put(
                f"getelementptr double, ptr {self.shadows[statement.array]}, i64 {first}"
            )

    def pick(self, statement: lang.Pick) -> None:
        """Name one of two arrays."""
        super().pick(statement)
        one, other = self.shadows[statement.chosen], self.shadows[statement.otherwise]
        test = self.value(statement.test)
        self.shadows[statement.name] = self.put(f"select i1 {test}, ptr {one}, ptr {other}")

    # -- values

    def value(self, e: lang.Expression) -> str:
        """Print the instructions of an expression and return its value; unused directions cost nothing."""
        return self.dual(e)[0] if e.type == "float" else super().value(e)

    def dual(self, e: lang.Expression) -> Dual:
        """Print the instructions of a float and return it with its directions."""
        if isinstance(e, lang.Constant):
            return literal(e.value), None
        if isinstance(e, lang.Variable):
            if e.name in self.values:
                return self.values[e.name], self.tangents.get(e.name)
            return super().value(e), self.put(f"load {self.kind}, ptr {slot(e.name + '.d')}, align 8")
        if isinstance(e, lang.ArrayElement):
            if e.array not in self.shadows:
                return super().value(e), None
            own, place = self.places_of(e.array, e.index)
            return self.put(f"load double, ptr {own}"), self.put(f"load {self.kind}, ptr {place}, align 8")
        if isinstance(e, lang.ScalarOperation):
            return self.differentiated(e)
        if isinstance(e, lang.FunctionCall) and e.function.name in CARRIED:
            return self.carried(e)
        if isinstance(e, lang.FunctionCall):
            pair, kind = self.call(e), self.returned("float")
            return self.put(f"extractvalue {kind} {pair}, 0"), self.put(f"extractvalue {kind} {pair}, 1")
        if isinstance(e, lang.Choice):
            return self.chosen(e)
        raise Foreign(f"a {type(e).__name__} with directions")

    def carried(self, e: lang.FunctionCall) -> Dual:
        """Print a number with the directions of another one, or with none."""
        (value, _), *others = [self.dual(a) for a in e.arguments if not isinstance(a, str)]
        return value, others[0][1] if others else None

    def call(self, e: lang.FunctionCall) -> str:
        """Print a call of another function, by its own code where this knows the places of all directions."""
        symbol = self.apart(e.function) if self.hands_on(e) else ""
        if not symbol:
            return super().call(e)
        self.declared[symbol] = e.function
        return LlvmPrinter.called(self, f'@"{symbol}"', e.function.returned, e.arguments)

    def hands_on(self, e: lang.FunctionCall) -> bool:
        """Whether a callee without a float as its result takes arguments of this function, under the same names."""
        own = {p.name: p for p in self.function.parameters if p.name not in self.function.variables}
        names = (a if isinstance(a, str) else a.name if isinstance(a, lang.Variable) else "" for a in e.arguments)
        same = [*map(own.get, names)] == [*e.function.parameters]
        return same and e.function.returned != "float" and self.places is not None

    def called(self, function: str, returned: lang.Scalar, arguments: tuple[lang.Expression | str, ...]) -> str:
        """Print a call with directions behind each float."""
        parts = list[str]()
        for a in arguments:
            if not isinstance(a, str) and a.type == "float":
                value, directions = self.dual(a)
                parts += [f"double {value}", f"{self.kind} {full_directions(directions)}"]
                continue
            parts += self.handed(a)
            if isinstance(a, str) and a in self.shadows:
                parts.append(f"ptr {self.shadows[a]}")
        return self.put(f"call {self.returned(returned)} {function}({', '.join(parts)}) nounwind")

    def chosen(self, e: lang.Choice) -> Dual:
        """Print a choice between floats."""
        yes, no, end = self.labels("then", "else", "end")
        self.branch(self.value(e.test), yes, no)
        values, directions = list[str](), list[str]()
        for label, part in ((yes, e.chosen), (no, e.otherwise)):
            self.begin(label)
            value, direction = self.dual(part)
            values.append(f"[{value}, %{self.label}]")
            directions.append(f"[{full_directions(direction)}, %{self.label}]")
            self.jump(end)
        self.begin(end)
        return self.put(f"phi double {', '.join(values)}"), self.put(f"phi {self.kind} {', '.join(directions)}")
