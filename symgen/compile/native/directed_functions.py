"""Functions of `symgen.compile.native.language` with a direction beside each float, as functions of that language.

So derivatives leave symgen wherever emitted functions do. The rules are those of all directions
(`symgen.compile.native.direction_rules`). A function takes the arguments of the one without directions; its arrays are
longer: the direction of element i stands at ``place + i``. A float that a function returns has its direction in a
second function, and a number that a caller inside hands over is followed by its direction.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import lru_cache

from symgen.base.ir.graph import CARRIED
from symgen.compile.native import language as lang
from symgen.compile.native.directed_numbers import DirectedNumbers
from symgen.compile.native.direction_rules import DirectionRules
from symgen.compile.native.folding import walk_statements
from symgen.compile.native.read_values import Foreign

#: A float and its direction, None where it is 0.
Dual = tuple[lang.Expression, lang.Expression | None]
#: First elements of the directions of arrays, by the names of parameters.
Places = tuple[tuple[str, int], ...]

_ZERO = lang.Constant("float", 0.0)
_LEAVES = lang.Constant, lang.Variable, lang.ArrayElement


def directed_function(function: lang.Function, places: Mapping[str, int]) -> lang.Function:
    """Return a function with a direction beside each float.

    Parameters
    ----------
    function : Function
        A function that returns an integer.
    places : mapping of str to int
        First element of the directions of each array of floats. A number may have its own in the array ``w``, at the
        place under its name. What has no place has no direction.

    Raises
    ------
    Foreign
        If the function has a float without a rule for its direction.
    """
    names = {p.name for p in function.parameters}
    own = tuple(sorted((name, place) for name, place in places.items() if name in names))
    return _directed(function.key, _Held(function), own, True)


class _Held:
    """A function that is told from others by its key, without its statements."""

    def __init__(self, function: lang.Function) -> None:
        self.function = function

    def __hash__(self) -> int:
        return 0

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Held) and other.function.key == self.function.key


@lru_cache(maxsize=256)
def _directed(key: object, held: _Held, places: Places, is_entry: bool) -> lang.Function:
    return _Directed(held.function, dict(places), is_entry).directed()


class _Directed(DirectionRules[lang.Expression]):
    """Writes one function with directions.

    Parameters
    ----------
    function : Function
        The function.
    places : dict of str to int
        First elements of directions by the names of arrays; in an entry of numbers too.
    is_entry : bool
        Whether callers outside hand over numbers without directions.
    """

    def __init__(self, function: lang.Function, places: dict[str, int], is_entry: bool) -> None:
        self.function, self.places, self.is_entry = function, places, is_entry
        self.statements: list[lang.Statement] = []  # of the innermost list
        self.depth, self.count = 0, 0
        self.variables, self.fixed = dict(function.variables), set(function.fixed)
        self.tangents = dict[str, lang.Expression | None]()  # of variables with one assignment, and of numbers given
        taken = {*function.variables, *(p.name for p in function.parameters)}
        self.suffix = "d"
        while any(f"{name}_{self.suffix}" in taken or name.startswith(f"{self.suffix}.") for name in taken):
            self.suffix += "d"

    # -- the function

    def directed(self) -> lang.Function:
        """Return the function."""
        f, parameters = self.function, list[lang.FunctionParameter]()
        if f.returned == "float" and any(isinstance(x, lang.Store) for x in walk_statements(f.body)):
            raise Foreign(f"directions of '{f.name}', which returns a number and stores others")
        for p in f.parameters:
            parameters.append(p)
            if p.type != "float" or p.array or p.address:
                continue
            if not self.is_entry:
                parameters.append(lang.FunctionParameter(self.direction_name(p.name), "float"))
                self.tangents[p.name] = lang.Variable("float", self.direction_name(p.name))
            else:
                place = self.places.get(p.name)
                own = None if place is None else lang.ArrayElement("float", "w", lang.Constant("int", place))
                self.tangents[p.name] = own
            if p.name in f.variables and self.is_entry:
                self.assign_direction(p.name, self.tangents.pop(p.name))
        body = self.body(f.body, False)
        calls = [x.function for x in walk_statements(body) if isinstance(x, lang.FunctionCall)]
        source = "directions", f.source, tuple(sorted(self.places.items())), self.is_entry
        return lang.Function(
            f"{f.name}_directions", tuple(parameters), f.returned, body, self.variables, frozenset(self.fixed),
            f.tables, tuple({each.key: each for each in calls}.values()), source,
        )  # fmt: skip

    def direction_name(self, name: str) -> str:
        """Return the name of a number's direction."""
        return f"{name}.{self.suffix}"

    def body(self, statements: Iterable[lang.Statement], inner: bool = True) -> tuple[lang.Statement, ...]:
        """Return statements with directions."""
        outside, self.statements = self.statements, []
        self.depth += inner
        for statement in statements:
            self.write_statement(statement)
        self.depth -= inner
        written, self.statements = self.statements, outside
        return tuple(written)

    # -- statements

    def write_statement(self, s: lang.Statement) -> None:
        """Write a statement; directions come first, as they take the values before it."""
        if isinstance(s, lang.Assign) and s.value.type == "float":
            value, direction = self.dual(s.value)
            self.assign_direction(s.name, direction)
            self.statements.append(lang.Assign(s.name, value))
        elif isinstance(s, lang.Assign):
            self.statements.append(lang.Assign(s.name, self.plain(s.value)))
        elif isinstance(s, lang.Store):
            self.store(s)
        elif isinstance(s, lang.Evaluate):
            call = self.plain(s.call)
            assert isinstance(call, lang.FunctionCall), "emitted functions call functions"
            self.statements.append(lang.Evaluate(call))
        elif isinstance(s, lang.Return):
            value = self.plain(s.value) if s.value.type != "float" else self.dual(s.value)[1] or _ZERO
            self.statements.append(lang.Return(value))
        elif isinstance(s, lang.If):
            test = self.plain(s.test)
            self.statements.append(lang.If(test, self.body(s.then), self.body(s.otherwise)))
        elif isinstance(s, lang.While):
            before = len(self.statements)
            test = self.plain(s.test)
            if len(self.statements) > before:
                raise Foreign("directions of a test at each pass")
            self.statements.append(lang.While(test, self.body(s.body)))
        elif isinstance(s, lang.For):
            start, stop = self.plain(s.start), self.plain(s.stop)
            self.statements.append(lang.For(s.name, start, stop, s.step, self.body(s.body)))
        elif isinstance(s, lang.StatementBlock):
            self.statements.append(lang.StatementBlock(s.number, self.body(s.body)))
        elif isinstance(s, lang.Leave):
            self.statements.append(s)
        else:
            raise Foreign(f"a {type(s).__name__} with directions")

    def store(self, s: lang.Store) -> None:
        """Write an assignment to an element of an array."""
        index = self.plain(s.index)
        if s.value.type != "float":
            self.statements.append(lang.Store(s.array, index, self.plain(s.value)))
            return
        value, direction = self.dual(s.value)
        if s.array not in self.places:
            raise Foreign(f"the array '{s.array}' without directions")
        self.statements.append(lang.Store(s.array, self.beside(s.array, index), direction or _ZERO))
        self.statements.append(lang.Store(s.array, index, value))

    def beside(self, array: str, index: lang.Expression) -> lang.Expression:
        """Return the index of an element's direction."""
        place = self.places[array]
        if isinstance(index, lang.Constant):
            return lang.Constant("int", int(index.value) + place)
        return lang.ScalarOperation("int", "add", (index, lang.Constant("int", place)))

    def assign_direction(self, name: str, direction: lang.Expression | None) -> None:
        """Write an assignment to the direction of a variable."""
        own = self.direction_name(name)
        if name in self.fixed and (direction is None or isinstance(direction, lang.Variable)):
            self.tangents[name] = direction
            return
        self.variables[own] = "float"
        if name in self.fixed:
            self.fixed.add(own)
        self.tangents[name] = lang.Variable("float", own)
        self.statements.append(lang.Assign(own, direction or _ZERO))

    # -- values

    def named(self, e: lang.Expression) -> lang.Expression:
        """Return an expression that may stand in several places: another one gets a name."""
        if isinstance(e, _LEAVES):
            return e
        self.count += 1
        name = f"{self.suffix}.{self.count}"
        self.variables[name] = e.type
        if not self.depth:
            self.fixed.add(name)
        self.statements.append(lang.Assign(name, e))
        return lang.Variable(e.type, name)

    def plain(self, e: lang.Expression) -> lang.Expression:
        """Return an expression without directions; functions that store numbers store directions too."""
        if isinstance(e, lang.FunctionCall):
            arrays = any(p.array and p.type == "float" for p in e.function.parameters)
            return self.call(e) if e.function.returned != "float" and arrays else self.call_plainly(e)
        if isinstance(e, lang.ArrayElement):
            return lang.ArrayElement(e.type, e.array, self.plain(e.index))
        if isinstance(e, lang.ScalarOperation):
            return lang.ScalarOperation(e.type, e.name, tuple(map(self.plain, e.arguments)))
        if isinstance(e, lang.Logic):
            return lang.Logic(e.name, self.plain(e.first), self.within(e.second))
        if isinstance(e, lang.Choice):
            return lang.Choice(e.type, self.plain(e.test), self.within(e.chosen), self.within(e.otherwise))
        if isinstance(e, lang.Constant | lang.Variable):
            return e
        raise Foreign(f"a {type(e).__name__} with directions")

    def within(self, e: lang.Expression) -> lang.Expression:
        """Return an expression that is evaluated where a test says so."""
        before = len(self.statements)
        value = self.plain(e)
        if len(self.statements) > before:
            raise Foreign("directions in a value that a test may leave out")
        return value

    def call_plainly(self, e: lang.FunctionCall) -> lang.FunctionCall:
        """Return a call of the function without directions."""
        arguments = tuple(a if isinstance(a, str) else self.plain(a) for a in e.arguments)
        return lang.FunctionCall(e.type, e.function, arguments)

    def call(self, e: lang.FunctionCall) -> lang.FunctionCall:
        """Return a call of the function with directions: of what it stores, or of its result."""
        if self.passes_arguments_on(e):
            own = {p.name for p in e.function.parameters}
            same = tuple(sorted((name, place) for name, place in self.places.items() if name in own))
            return lang.FunctionCall(e.type, _directed(e.function.key, _Held(e.function), same, True), e.arguments)
        arguments, places = list[lang.Expression | str](), dict[str, int]()
        for p, a in zip(e.function.parameters, e.arguments, strict=True):
            if isinstance(a, str):
                arguments.append(a)
                if a in self.places:
                    places[p.name] = self.places[a]
            elif a.type == "float":
                value, direction = self.print_dual(a)
                arguments += [value, direction or _ZERO]
            else:
                arguments.append(self.plain(a))
        function = _directed(e.function.key, _Held(e.function), tuple(sorted(places.items())), False)
        return lang.FunctionCall(e.type, function, tuple(arguments))

    def passes_arguments_on(self, e: lang.FunctionCall) -> bool:
        """Whether a callee takes the arguments of an entry under the same names: it is called as entries are."""
        own = {p.name: p for p in self.function.parameters if p.name not in self.function.variables}
        names = (a if isinstance(a, str) else a.name if isinstance(a, lang.Variable) else "" for a in e.arguments)
        same = [*map(own.get, names)] == [*e.function.parameters]
        return self.is_entry and same and e.function.returned != "float"

    def print_dual(self, e: lang.Expression) -> Dual:
        """Return a float that may stand in several places, with its direction."""
        value, direction = self.dual(e)
        return self.named(value), direction

    def dual(self, e: lang.Expression) -> Dual:
        """Return a float with its direction."""
        if isinstance(e, lang.Constant):
            return e, None
        if isinstance(e, lang.Variable):
            if e.name in self.tangents:
                return e, self.tangents[e.name]
            if e.name not in self.variables:
                return e, None
            self.variables.setdefault(self.direction_name(e.name), "float")
            return e, lang.Variable("float", self.direction_name(e.name))
        if isinstance(e, lang.ArrayElement):
            index = self.plain(e.index)
            own = lang.ArrayElement("float", e.array, index)
            if e.array not in self.places:
                return own, None
            return own, lang.ArrayElement("float", e.array, self.beside(e.array, index))
        if isinstance(e, lang.ScalarOperation) and e.name in ("add", "sub", "neg") and e.type == "float":
            (a, da), *others = [self.dual(x) for x in e.arguments]
            b, db = others[0] if others else (a, None)
            return self.differentiate_arithmetic(e.name, a, b, da, db)
        if isinstance(e, lang.ScalarOperation):
            return self.differentiate_operation(e)
        if isinstance(e, lang.FunctionCall) and e.function.name in CARRIED:
            (value, _), *rest = [self.print_dual(a) for a in e.arguments if not isinstance(a, str)]
            return value, rest[0][1] if rest else None
        if isinstance(e, lang.FunctionCall):
            return self.named(self.call_plainly(e)), self.call(e)
        if isinstance(e, lang.Choice):
            return self.choose(e)
        raise Foreign(f"a {type(e).__name__} with directions")

    def choose(self, e: lang.Choice) -> Dual:
        """Return one of two floats with its direction."""
        self.count += 1
        name = f"{self.suffix}.{self.count}"
        own, parts = self.direction_name(name), list[tuple[lang.Statement, ...]]()
        test = self.named(self.plain(e.test))
        self.variables |= {name: "float", own: "float"}
        for chosen in (e.chosen, e.otherwise):
            outside, self.statements = self.statements, []
            self.depth += 1
            value, direction = self.dual(chosen)
            self.depth -= 1
            ends = lang.Assign(own, direction or _ZERO), lang.Assign(name, value)
            written, self.statements = (*self.statements, *ends), outside
            parts.append(written)
        self.statements.append(lang.If(test, *parts))
        return lang.Variable("float", name), lang.Variable("float", own)

    # -- rules

    @property
    def numbers(self) -> DirectedNumbers:
        """Operations on numbers."""
        return DirectedNumbers(self.named)

    def print_plain(self, e: lang.ScalarOperation) -> lang.Expression:
        """Return an operation without directions."""
        return self.plain(e)

    def print_whole_power(self, base: lang.Expression, exponent: int) -> lang.Expression:
        """Return a power with a whole exponent."""
        if exponent in (0, 1):
            return base if exponent else lang.Constant("float", 1.0)
        return self.named(lang.ScalarOperation("float", "pow", (base, lang.Constant("int", exponent))))

    def print_sines(self, angle: lang.Expression, value: lang.Expression) -> tuple[lang.Expression, lang.Expression]:
        """Return sine and cosine of an angle."""
        return self.numbers.call("sin", value), self.numbers.call("cos", value)

    def add_printed(self, a: lang.Expression, b: lang.Expression) -> lang.Expression:
        """Return the sum of directions."""
        return self.numbers.add(a, b)

    def subtract_printed(self, a: lang.Expression | None, b: lang.Expression) -> lang.Expression:
        """Return the difference of directions, or the opposite of one."""
        return self.numbers.neg(b) if a is None else self.numbers.sub(a, b)

    def scale_printed(self, directions: lang.Expression, factor: lang.Expression) -> lang.Expression:
        """Return the product of a direction and a number."""
        return self.numbers.mul(directions, factor)

    def differentiate_extreme(
        self, name: str, a: lang.Expression, b: lang.Expression,
        da: lang.Expression | None, db: lang.Expression | None,
    ) -> Dual:  # fmt: skip
        """Return the least or greatest of two values; as in Python, the first where they do not compare."""
        test = lang.ScalarOperation("bool", "lt" if name == "min" else "gt", (b, a))
        value = self.named(lang.Choice("float", test, b, a))
        return value, None if da is None and db is None else lang.Choice("float", test, db or _ZERO, da or _ZERO)
