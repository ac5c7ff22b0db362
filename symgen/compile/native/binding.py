"""Functions of the runtime bound to one model: numbers, tables and functions that are constant for it become literals.

A function of a start or of an event takes the layout of a model, functions by their address and working memory. For one
model all of them are constant. They go from callers to callees: an argument that is the same at every call is no
argument any more, branches with constant tests are folded, and what is left over is left out. Operations and their
order stay, so results have the same bits.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import msgspec

from symgen.compile.native import language as lang
from symgen.compile.native.folding import Folding, arrays_in, assigned_names, walk_statements
from symgen.compile.native.read_values import Foreign

_BOUND = "bound"
#: Beginnings of names of memory and of tables, which no variable has.
MEMORY, TABLE = "memory.", "table."


@dataclass(frozen=True)
class Room:
    """An array of a model's working memory.

    Attributes
    ----------
    name : str
        Its name, the same in all functions.
    size : int
        Its length.
    resizable : bool
        Whether printed code may give it another length, and asks for that.
    """

    name: str
    size: int
    resizable: bool = False


@dataclass(frozen=True)
class ConstantTable:
    """An array whose elements are constant."""

    name: str
    type: lang.Scalar
    values: tuple[float, ...]

    @property
    def size(self) -> int:
        """Its length."""
        return len(self.values)


@dataclass(frozen=True)
class Elements:
    """An array by its address, with its length where all calls have the same one."""

    size: int | None = None


#: Meaning of a parameter: a constant, an array, a function, or None for a number that is passed.
Meaning = lang.Constant | Room | ConstantTable | Elements | lang.Function | None


@dataclass(frozen=True)
class BoundFunctions:
    """Functions bound to a model.

    Attributes
    ----------
    functions : dict of str to Function
        By name.
    tables : dict of str to ConstantTable
        Tables that they read.
    rooms : dict of str to (str, int)
        Working memory that they use: type of the elements and length.
    with_memory : frozenset
        Keys of functions that use working memory, or call such functions, and of all that are given: their callers need
        not know.
    """

    functions: dict[str, lang.Function]
    tables: dict[str, ConstantTable] = field(default_factory=dict)
    rooms: dict[str, tuple[lang.Scalar, int]] = field(default_factory=dict)
    with_memory: frozenset[object] = frozenset()

    @property
    def arrays(self) -> dict[str, tuple[lang.Scalar, int]]:
        """Type of the elements and number of dimensions of memory and tables."""
        kinds = {name: kind for name, (kind, _) in self.rooms.items()}
        return {name: (kind, 1) for name, kind in (kinds | {n: t.type for n, t in self.tables.items()}).items()}

    @property
    def memory(self) -> dict[str, tuple[lang.Scalar, int]]:
        """Type and length of each array of the memory, by its name there."""
        return {name.removeprefix(MEMORY): room for name, room in self.rooms.items()}


def bind_functions(
    entries: Mapping[str, tuple[lang.Function, Mapping[str, Meaning]]], passed: frozenset[object]
) -> BoundFunctions:
    """Return functions bound to a model.

    Parameters
    ----------
    entries : mapping of str to (Function, mapping of str to Meaning)
        Functions by their names, with the meanings of those parameters that are constant.
    passed : frozenset
        Keys of functions that stay as they are: emitted ones.

    Raises
    ------
    Foreign
        If a length differs between calls, or a function.
    """
    binder, own = _Binder(passed), _name_tables(entries)
    while True:
        binder.changed, binder.visited = False, set()
        for name, (function, _) in entries.items():
            binder.visit_call(function, dict(own[name]))
        if not binder.changed:
            break
    binder.final = True
    functions = {name: binder.bound_function(function) for name, (function, _) in entries.items()}
    functions = {name: msgspec.structs.replace(f, name=name) for name, f in functions.items()}
    with_memory = frozenset((*binder.with_memory, *(f.key for f in functions.values())))
    return BoundFunctions(functions, binder.tables, binder.rooms, with_memory)


def _name_tables(entries: Mapping[str, tuple[lang.Function, Mapping[str, Meaning]]]) -> dict[str, dict[str, Meaning]]:
    """Return meanings in which equal tables are one, and others have different names."""
    tables, names = dict[tuple[lang.Scalar, tuple[float, ...]], ConstantTable](), set[str]()

    def name_of_meaning(meaning: Meaning) -> Meaning:
        if isinstance(meaning, Room):
            return replace(meaning, name=MEMORY + meaning.name)
        if not isinstance(meaning, ConstantTable):
            return meaning
        key = meaning.type, meaning.values
        if key not in tables:
            name, k = TABLE + meaning.name, 2
            while name in names:
                name, k = f"{TABLE}{meaning.name}_{k}", k + 1
            names.add(name)
            tables[key] = replace(meaning, name=name)
        return tables[key]

    return {name: {n: name_of_meaning(m) for n, m in meanings.items()} for name, (_, meanings) in entries.items()}


def is_bound(function: lang.Function) -> bool:
    """Whether a function is bound to a model."""
    return isinstance(function.source, tuple) and function.source[0] == _BOUND


def common_meaning(one: Meaning, other: Meaning) -> Meaning:
    """Return the meaning of a parameter that has both."""
    if one == other and type(one) is type(other):
        return one
    sized = Room, ConstantTable, Elements
    if isinstance(one, sized) and isinstance(other, sized):
        return Elements(one.size if one.size == other.size else None)
    if isinstance(one, lang.Function) or isinstance(other, lang.Function):
        raise Foreign("different functions in one place")
    return None


class _Binder:
    """Meanings of parameters, by functions, and what comes of functions."""

    def __init__(self, passed: frozenset[object]) -> None:
        self.passed = passed
        self.meanings: dict[object, dict[str, Meaning]] = {}
        self.visited, self.changed, self.final = set[object](), False, False
        self.results: dict[object, lang.Function] = {}
        self.tables: dict[str, ConstantTable] = {}
        self.rooms: dict[str, tuple[lang.Scalar, int]] = {}
        self.with_memory = set[object]()

    def visit_call(self, function: lang.Function, meanings: dict[str, Meaning]) -> None:
        """Note the meanings of the parameters at a call, and visit the function."""
        own = self.meanings.get(function.key)
        if own is None:
            self.meanings[function.key], self.changed = meanings, True
        else:
            for name, meaning in meanings.items():
                joined = common_meaning(own[name], meaning) if name in own else meaning
                if name not in own or joined != own[name] or type(joined) is not type(own[name]):
                    own[name], self.changed = joined, True
        if function.key not in self.visited:
            self.visited.add(function.key)
            _Specialised(self, function).statements()

    def bound_function(self, function: lang.Function) -> lang.Function:
        """Return a function bound to the meanings that its parameters have at all calls."""
        if function.key in self.passed:
            return function
        if function.key not in self.results:
            self.results[function.key] = _Specialised(self, function).function()
        return self.results[function.key]


class _Specialised(Folding):
    """One function with the meanings of its parameters."""

    def __init__(self, binder: _Binder, function: lang.Function) -> None:
        self.binder, self.own = binder, function
        meanings = binder.meanings[function.key]
        self.meanings = {p.name: meanings.get(p.name, Elements() if p.array else None) for p in function.parameters}
        kinds = {p.name: p.type for p in function.parameters}
        super().__init__(function, {n: m for n, m in self.meanings.items() if isinstance(m, lang.Constant)})
        self.views: dict[str, Meaning] = {}
        self.kinds: dict[str, lang.Scalar] = kinds
        self.used: dict[str, tuple[lang.Scalar, ConstantTable | Room]] = {}

    def statements(self) -> tuple[lang.Statement, ...]:
        """Return the statements of the function."""
        return self.fold_body(self.own.body)

    def function(self) -> lang.Function:
        """Return the function with those parameters that are still passed."""
        body = self.drop_unused(self.statements())
        parameters = tuple(
            p for p in self.own.parameters if isinstance(self.meanings[p.name], Elements) or not self.meanings[p.name]
        )
        names = {x.name for x in walk_statements(body) if isinstance(x, lang.Variable | lang.Assign | lang.For)}
        calls = (x.function for x in walk_statements(body) if isinstance(x, lang.FunctionCall))
        called, binder = {f.key: f for f in calls}, self.binder
        bound = msgspec.structs.replace(
            self.own,
            name=self.own.name.strip("_"),
            parameters=parameters,
            body=body,
            variables={name: kind for name, kind in self.own.variables.items() if name in names},
            called=tuple(called.values()),
            source=(_BOUND, self.own.key),  # functions with the same text may take different arrays
        )
        arrays = arrays_in(body)
        for name, (kind, meaning) in self.used.items():
            if name in arrays and isinstance(meaning, ConstantTable):
                binder.tables[name] = meaning
            elif name in arrays:
                binder.rooms[name] = kind, max(meaning.size, binder.rooms.get(name, (kind, 1))[1])
        if any(name.startswith(MEMORY) for name in arrays) or not binder.with_memory.isdisjoint(called):
            binder.with_memory.add(bound.key)
        return bound

    # -- arrays

    def meaning_of_array(self, array: str) -> Meaning:
        """Return the meaning of an array."""
        return self.views[array] if array in self.views else self.meanings.get(array, Elements())

    def array(self, name: str) -> str:
        """Return the name of an array: its own, or the name of memory or of a table."""
        meaning = self.meaning_of_array(name)
        if isinstance(meaning, ConstantTable | Room):
            _, other = self.used.get(meaning.name, ("", meaning))
            self.used[meaning.name] = self.kinds[name], max(meaning, other, key=lambda each: each.size)
            return meaning.name
        return name

    def element(self, e: lang.ArrayElement) -> lang.Expression:
        """Return an element of an array: a number where a table holds nothing else there."""
        index, meaning = self.fold_value(e.index), self.meaning_of_array(e.array)
        if isinstance(meaning, ConstantTable):
            values = meaning.values
            if len(set(values)) <= 1:
                return lang.Constant(e.type, values[0] if values else 0)
            if isinstance(index, lang.Constant):
                return lang.Constant(e.type, values[int(index.value)])
        return lang.ArrayElement(e.type, self.array(e.array), index)

    def length(self, e: lang.ArrayLength) -> lang.Expression:
        """Return the length of an array."""
        meaning = self.meaning_of_array(e.array)
        if isinstance(meaning, Room) and meaning.resizable:
            return lang.ArrayLength(self.array(e.array))
        size = getattr(meaning, "size", None)
        if size is None or e.axis:
            if self.binder.final:
                raise Foreign(f"the length of '{e.array}' in '{self.own.name}', which differs between calls")
            return e
        return lang.Constant("int", size)

    def view(self, s: lang.ArrayView) -> list[lang.Statement]:
        """Return the statement that names elements of an array from one on."""
        first, size = self.fold_value(s.first), self.fold_value(s.size) if s.size is not None else None
        self.kinds[s.name] = self.kinds[s.array]
        length = int(size.value) if isinstance(size, lang.Constant) else None
        whole = isinstance(first, lang.Constant) and first.value == 0
        meaning = self.meaning_of_array(s.array)
        if whole and length is not None and isinstance(meaning, Room):
            self.views[s.name] = replace(meaning, size=length)
            return []
        if length == 0 and isinstance(meaning, Room):
            self.views[s.name] = replace(meaning, size=0)
            return []
        if length == 0:
            self.views[s.name] = ConstantTable("nothing", self.kinds[s.name], ())
            return []
        self.views[s.name] = Elements(length)
        return [msgspec.structs.replace(s, array=self.array(s.array), first=first, size=size)]

    # -- calls

    def call(self, e: lang.FunctionCall | lang.Invoke) -> lang.Expression:
        """Return a call of the bound function with the arguments that it still takes."""
        if isinstance(e, lang.FunctionCall):
            callee = e.function
        else:
            own = self.meanings.get(str(e.function))
            if not isinstance(own, lang.Function):
                raise Foreign(f"a function by its address in '{self.own.name}'")
            callee = own
        values = [a if isinstance(a, str) else self.fold_value(a) for a in e.arguments]
        if callee.key in self.binder.passed:
            arguments = tuple(self.array(a) if isinstance(a, str) else a for a in values)
            return lang.FunctionCall(callee.returned, callee, arguments)
        assigned = assigned_names(callee)
        meanings = dict[str, Meaning]()
        for p, a in zip(callee.parameters, values, strict=True):
            if isinstance(a, str):
                meanings[p.name] = self.meaning_of_array(a) if p.array else self.meanings[a]
            else:
                meanings[p.name] = a if isinstance(a, lang.Constant) and p.name not in assigned else None
        if not self.binder.final:
            self.binder.visit_call(callee, meanings)
            return lang.FunctionCall(e.type, callee, tuple(values))
        bound = self.binder.bound_function(callee)
        left = {p.name for p in bound.parameters}
        taken = tuple(
            self.array(a) if isinstance(a, str) else a
            for p, a in zip(callee.parameters, values, strict=True)
            if p.name in left
        )
        return lang.FunctionCall(e.type, bound, taken)
