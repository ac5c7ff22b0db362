"""Straight functions of `symgen.compile.native.language` as text for LLVM in reverse: adjoints of what they read.

Rules are the ones of `symgen.compile.native.tangents`: there they print directions, here each is noted as a sum of
factors times earlier directions, and the notes are read backwards. After its own arguments a function takes the
adjoint of each array of floats. Where the function stores, the adjoint goes to what was stored and is 0 before; where
it reads, it is added. Values of the function itself are computed again, and nothing of it is stored.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator

from symgen.base.ir.graph import CARRIED
from symgen.base.ir.program import FREE_RHS
from symgen.compile.native import language as lang
from symgen.compile.native import sines
from symgen.compile.native.accesses import Place, whole_index
from symgen.compile.native.llvm import LlvmPrinter, declarations, parameter_types
from symgen.compile.native.llvm_values import TYPES, float_literal
from symgen.compile.native.read_values import Foreign
from symgen.compile.native.tangent_rules import Dual
from symgen.compile.native.tangents import TangentPrinter

#: A direction in a sum, and the text of its factor, which is printed where it is needed; None for 1.
Term = tuple[str, Callable[[], str] | None]


def _printed_factor(text: str) -> Callable[[], str]:
    """Return a factor whose line is there already."""
    return lambda: text


def adjoint_module(function: lang.Function, name: str, ends: str, together: bool = True) -> str:
    """Return the text of a module that defines the adjoint of a function.

    Parameters
    ----------
    function : Function
        The function.
    name : str
        Name of its adjoint in machine code.
    ends : str
        The array whose adjoint it takes: what it stores in others is not used.
    together : bool
        Whether sines and cosines of several angles are taken together.

    Raises
    ------
    Foreign
        If the function is not straight.
    """
    names: dict[object, str] = {}
    apart = list[lang.Function]()

    def slope_name(f: lang.Function) -> str:
        if ("slope", f.key) not in names:
            names["slope", f.key] = f"{name}.{len(names)}.{f.name}"
            apart.append(f)
        return names["slope", f.key]

    def symbol_name(f: lang.Function) -> str:
        return names.setdefault(f.key, f"{name}.{len(names)}")

    parts = [AdjointPrinter(function, symbol_name, slope_name, name, ends, together).text()]
    parts += [TangentPrinter(f, slope_name, 1, None, together).text() for f in itertools.islice(apart, 0, None)]
    used = "\n".join(parts)
    parts += [sines.function_definition(n) for n in (sines.function_width(1), sines.MOST) if sines.sine_name(n) in used]
    return "\n".join([*parts, *declarations(parts), ""])


class AdjointPrinter(TangentPrinter):
    """Prints the adjoint of one function.

    Parameters
    ----------
    function, symbol, together
        As for `LlvmPrinter`; the symbols are those of the tables of functions.
    slope : callable
        Returns the name of a callee that is not straight, with a direction beside each float.
    name, ends : str
        Name of the adjoint in machine code, and the array whose adjoint it takes.
    """

    def __init__(
        self,
        function: lang.Function,
        symbol: Callable[[lang.Function], str],
        slope: Callable[[lang.Function], str],
        name: str,
        ends: str,
        together: bool,
    ) -> None:
        super().__init__(function, symbol, 1, {}, together)
        self.slope, self.name, self.ends, self.together = slope, name, ends, together
        self.inner = dict[object, lang.Function]()
        self.counters = dict[str, int]()  # of loops, which are written out
        self.names = {p.name: p.name for p in function.parameters if p.array}  # arrays of this function, of a callee
        self.sums: list[tuple[str, tuple[Term, ...]]] = []  # directions and their terms, in the order of the function
        self.read: dict[Place, Dual] = {}
        self.stored: dict[Place, Dual] = {}
        self.result: Dual = "0", None

    def text(self) -> str:
        """Return the definition."""
        f = self.function
        LlvmPrinter.take_arguments(self)
        self.inner[f.key] = f
        self.statements(f.body)
        self.print_adjoints()
        arguments = [f'{kind} %"{own}"' for p in f.parameters for kind, own in parameter_types(p)]
        arguments += [f'ptr %"{p.name}.bar", i64 %"{p.name}.bar.0"' for p in self.arrays()]
        tables = [
            f'@"{self.symbol(each)}.{name}" = private unnamed_addr constant [{len(x)} x double] '
            f"[{', '.join('double ' + float_literal(v) for v in x)}]"
            for each in self.inner.values()
            for name, x in each.tables.items()
        ]
        begin = f'define {TYPES[f.returned]} @"{self.name}"({", ".join(arguments)}) nounwind {{'
        end = f"  ret {TYPES[f.returned]} {float_literal(0.0) if f.returned == 'float' else 0}"
        return "\n".join([*tables, begin, ".entry:", *self.slots, *self.lines, end, "}"])

    def arrays(self) -> Iterator[lang.FunctionParameter]:
        """Yield the arrays of floats."""
        return (p for p in self.function.parameters if p.array and p.type == "float")

    # -- the function, forwards

    def begin_block(self, label: str) -> None:
        """Refuse a second block."""
        raise Foreign("a choice or a loop in a function with an adjoint")

    def assign_directions(self, name: str, directions: str | None) -> None:
        """Refuse a variable that changes."""
        raise Foreign(f"the variable '{name}', which changes, in a function with an adjoint")

    def print_store(self, statement: lang.Store) -> None:
        """Note what is stored."""
        if statement.value.type == "float":
            self.stored[self.names[statement.array], self.known_index(statement.index)] = self.print_dual(
                statement.value
            )

    def print_dual(self, e: lang.Expression) -> Dual:
        """Print a float and return it with the name of its direction."""
        if isinstance(e, lang.Variable):
            if e.name not in self.values:
                raise Foreign(f"the variable '{e.name}', which changes, in a function with an adjoint")
            return self.values[e.name], self.tangents.get(e.name)
        if isinstance(e, lang.ArrayElement):
            if e.array in self.function.tables:
                return LlvmPrinter.value(self, e), None
            place = self.names[e.array], self.known_index(e.index)
            if place in self.stored:
                return self.stored[place]
            if place not in self.read:
                own = self.print_instruction(f"getelementptr double, ptr {self.array_address(e.array)}, i64 {place[1]}")
                self.read[place] = self.print_instruction(f"load double, ptr {own}"), self.note_sum()
            return self.read[place]
        if isinstance(e, lang.FunctionCall) and e.function.name not in CARRIED:
            return self.print_callee(e)
        return super().print_dual(e)

    def print_end(self, value: lang.Expression) -> None:
        """Keep the result for a caller inside."""
        self.result = self.print_dual(value) if value.type == "float" else (self.value(value), None)

    def call(self, e: lang.FunctionCall) -> str:
        """Print the statements of a callee."""
        return self.print_callee(e)[0]

    def print_callee(self, e: lang.FunctionCall) -> Dual:
        """Print the statements of a callee, and return its result."""
        if _has_branches(e.function):
            return self.call_by_directions(e)
        f, names, views = e.function, dict[str, str](), dict[str, tuple[str, tuple[str, ...]]]()
        values, tangents = dict[str, str](), dict[str, str | None]()
        for parameter, argument in zip(f.parameters, e.arguments, strict=True):
            if isinstance(argument, str):
                names[parameter.name], views[parameter.name] = self.names[argument], self.views[argument]
            elif argument.type == "float":
                values[parameter.name], tangents[parameter.name] = self.print_dual(argument)
            else:
                values[parameter.name] = self.value(argument)
        outside = self.function, self.names, self.views, self.values, self.tangents, self.sines, self.before
        self.function, self.names, self.views, self.values, self.tangents = f, names, views, values, tangents
        self.sines, groups = {}, sines.groups_of_angles(f) if self.together else {}
        self.before = {id(f.body[i]): calls for i, calls in groups.items()}
        self.inner[f.key], self.result = f, ("0", None)
        self.statements(f.body)
        self.function, self.names, self.views, self.values, self.tangents, self.sines, self.before = outside
        return self.result

    def call_by_directions(self, e: lang.FunctionCall) -> Dual:
        """Call a function of numbers that is not straight, as the search in a table, once for each direction."""
        arguments = [self.print_dual(a) for a in e.arguments if not isinstance(a, str)]
        kind, one, terms = f"{{double, {self.kind}}}", f"<double {float_literal(1.0)}>", list[Term]()
        value = ""
        for k, (_, direction) in enumerate(arguments):
            if direction is None and value:
                continue
            parts = [
                f"double {x}, {self.kind} {one if i == k else 'zeroinitializer'}" for i, (x, _) in enumerate(arguments)
            ]
            pair = self.print_instruction(f'call {kind} @"{self.slope(e.function)}"({", ".join(parts)}) nounwind')
            value = self.print_instruction(f"extractvalue {kind} {pair}, 0")
            own = self.print_instruction(f"extractvalue {kind} {pair}, 1")
            partial = self.print_instruction(f"extractelement {self.kind} {own}, i64 0")
            if direction is not None:
                terms.append((direction, _printed_factor(partial)))
        return value, self.note_sum(*terms) if terms else None

    def note_sum(self, *terms: tuple[str | None, Callable[[], str] | None]) -> str:
        """Note a direction as a sum of terms."""
        name = f"#{len(self.sums)}"
        self.sums.append((name, tuple((own, factor) for own, factor in terms if own is not None)))
        return name

    def add_directions(self, a: str | None, b: str | None) -> str | None:
        """Note the sum of two directions."""
        if a is None or b is None:
            return b if a is None else a
        return self.note_sum((a, None), (b, None))

    def subtract_directions(self, a: str | None, b: str | None) -> str | None:
        """Note the difference of two directions."""
        return a if b is None else self.note_sum((a, None), (b, lambda: float_literal(-1.0)))

    def scale_directions(self, directions: str | None, factor: Callable[[], str]) -> str | None:
        """Note the product of a direction and a number."""
        return None if directions is None else self.note_sum((directions, factor))

    def differentiate_extreme(self, name: str, a: str, b: str, da: str | None, db: str | None) -> Dual:
        """Print the least or greatest of two values; the direction is the one of the value taken."""
        sign = "olt" if name == "min" else "ogt"
        return self.print_either(self.print_instruction(f"fcmp{self.flag} {sign} double {b}, {a}"), (b, db), (a, da))

    def print_branch(self, statement: lang.If) -> bool:
        """Leave out the choice of rates without bounded rows: those with them are the same where all are off."""
        match statement.then, statement.otherwise:
            case (lang.Return(value=lang.FunctionCall(function=lang.Function(name=name))),), () if name == FREE_RHS:
                return True
        return super().print_branch(statement)

    def choose_float(self, e: lang.Choice) -> Dual:
        """Print both values and choose one; a branch would need an adjoint of its own block."""
        return self.print_either(self.value(e.test), self.print_dual(e.chosen), self.print_dual(e.otherwise))

    def count_through(self, statement: lang.For) -> None:
        """Print all passes through a loop of known length."""
        for i in range(self.known_index(statement.start), self.known_index(statement.stop), statement.step):
            self.counters[statement.name], self.values[statement.name] = i, str(i)
            self.statements(statement.body)
        self.counters.pop(statement.name, None)

    def known_index(self, e: lang.Expression) -> int:
        """Return an index, which has to be known."""
        return whole_index(e, self.counters)

    def print_either(self, test: str, yes: Dual, no: Dual) -> Dual:
        """Print one of two values by a test."""
        one, zero = float_literal(1.0), float_literal(0.0)
        (a, da), (b, db) = yes, no
        value = self.print_instruction(f"select i1 {test}, double {a}, double {b}")
        if da is None and db is None:
            return value, None
        return value, self.note_sum(
            (da, lambda: self.print_instruction(f"select i1 {test}, double {one}, double {zero}")),
            (db, lambda: self.print_instruction(f"select i1 {test}, double {zero}, double {one}")),
        )

    # -- and backwards

    def print_adjoints(self) -> None:
        """Print the adjoints. Each is read and written once, as repeated reads count as one where code is divided."""
        bars = dict[str, str]()
        stored = {place: dual for place, dual in self.stored.items() if place[0] == self.ends}
        kept = {place: dual for place, dual in self.read.items() if place in stored or place not in self.stored}
        adjoints = {place: self.address_of_adjoint(place) for place in stored | kept}
        for place, (_, direction) in stored.items():
            if direction is not None:
                self.add_to_adjoint(bars, direction, self.print_instruction(f"load double, ptr {adjoints[place]}"))
        for name, terms in reversed(self.sums):
            if name not in bars:
                continue
            for own, factor in terms:
                bar = bars[name] if factor is None else self.print_product(factor(), bars[name])
                self.add_to_adjoint(bars, own, bar)
        for place, address in adjoints.items():
            own = (kept[place][1] or "") if place in kept else ""
            bar = bars.get(own, float_literal(0.0))
            if place not in stored:
                if own not in bars:
                    continue
                before = self.print_instruction(f"load double, ptr {address}")
                bar = self.print_instruction(f"fadd{self.flag} double {before}, {bar}")
            self.lines.append(f"  store double {bar}, ptr {address}")

    def address_of_adjoint(self, place: Place) -> str:
        """Print the address of an adjoint."""
        return self.print_instruction(f'getelementptr double, ptr %"{place[0]}.bar", i64 {place[1]}')

    def add_to_adjoint(self, bars: dict[str, str], direction: str, bar: str) -> None:
        """Add to the adjoint of a direction."""
        bars[direction] = (
            self.print_instruction(f"fadd{self.flag} double {bars[direction]}, {bar}") if direction in bars else bar
        )

    def print_product(self, factor: str, bar: str) -> str:
        """Print the product of a factor and an adjoint."""
        if factor == float_literal(-1.0):
            return self.print_instruction(f"fneg double {bar}")
        return self.print_instruction(f"fmul{self.flag} double {factor}, {bar}")


def _has_branches(function: lang.Function) -> bool:
    """Whether a function of numbers alone has a loop or a choice between statements."""
    if function.returned != "float" or any(p.array or p.type != "float" for p in function.parameters):
        return False
    return any(isinstance(x, lang.If | lang.While | lang.For | lang.StatementBlock) for x in function.body)
