"""Statements with constant tests, sums and loops folded, and what is not read left out."""

from __future__ import annotations

import operator
from collections import Counter
from collections.abc import Callable, Iterator
from typing import Any

import msgspec

from symgen.compile.native import language as lang

_INTEGERS: dict[str, Callable[[Any, Any], Any]] = {
    "add": operator.add,
    "sub": operator.sub,
    "mul": operator.mul,
    "min": min,
    "max": max,
    "floordiv": operator.floordiv,
}
_COMPARISONS: dict[str, Callable[[Any, Any], Any]] = {
    "lt": operator.lt,
    "le": operator.le,
    "gt": operator.gt,
    "ge": operator.ge,
    "eq": operator.eq,
    "ne": operator.ne,
}
_CALLS = lang.FunctionCall, lang.Invoke, lang.Insert


def walk_statements(value: object) -> Iterator[Any]:
    """Yield statements and expressions in their order, without the bodies of called functions."""
    waiting = [value]
    while waiting:
        each = waiting.pop()
        if isinstance(each, tuple):
            waiting += reversed(each)
        elif isinstance(each, msgspec.Struct) and not isinstance(each, lang.Function):
            yield each
            waiting += [getattr(each, name) for name in reversed(each.__struct_fields__)]


def is_pure(value: object) -> bool:
    """Whether an expression calls no function."""
    return not any(isinstance(each, _CALLS) for each in walk_statements(value))


#: Functions that were looked through, by identity: their hash would take as long. They stay alive while they are here.
_ASSIGNED: dict[int, tuple[lang.Function, Counter[str]]] = {}
_MOST_KEPT = 4096


def assigned_names(function: lang.Function) -> Counter[str]:
    """Return how often the statements of a function assign to each variable."""
    kept = _ASSIGNED.get(id(function))
    if kept is not None and kept[0] is function:
        return kept[1]
    found = Counter(s.name for s in walk_statements(function.body) if isinstance(s, lang.Assign | lang.For))
    if len(_ASSIGNED) >= _MOST_KEPT:
        _ASSIGNED.clear()
    _ASSIGNED[id(function)] = function, found
    return found


class Folding:
    """Folds the statements of one function; subclasses replace arrays and calls.

    Parameters
    ----------
    function : Function
        The function.
    constants : dict of str to Constant
        Values of variables that are constant.
    """

    def __init__(self, function: lang.Function, constants: dict[str, lang.Constant]) -> None:
        self.constants = constants
        numbers = {p.name for p in function.parameters}
        #: Variables with a single assignment.
        self.fixed = {name for name, count in assigned_names(function).items() if count == 1} - numbers

    # -- what subclasses replace

    def array(self, name: str) -> str:
        """Return the name of an array."""
        return name

    def element(self, e: lang.ArrayElement) -> lang.Expression:
        """Return an element of an array."""
        return lang.ArrayElement(e.type, self.array(e.array), self.fold_value(e.index))

    def length(self, e: lang.ArrayLength) -> lang.Expression:
        """Return the length of an array."""
        return e

    def view(self, s: lang.ArrayView) -> list[lang.Statement]:
        """Return the statement that names elements of an array from one on."""
        size = self.fold_value(s.size) if s.size is not None else None
        return [msgspec.structs.replace(s, array=self.array(s.array), first=self.fold_value(s.first), size=size)]

    def call(self, e: lang.FunctionCall | lang.Invoke) -> lang.Expression:
        """Return a call."""
        arguments = tuple(self.array(a) if isinstance(a, str) else self.fold_value(a) for a in e.arguments)
        return msgspec.structs.replace(e, arguments=arguments)

    # -- statements

    def fold_body(self, statements: tuple[lang.Statement, ...]) -> tuple[lang.Statement, ...]:
        """Return statements up to the first one that ends them."""
        folded = list[lang.Statement]()
        for statement in statements:
            folded += self.statement(statement)
            if folded and isinstance(folded[-1], lang.Return | lang.Leave):
                break
        return tuple(folded)

    def statement(self, s: lang.Statement) -> list[lang.Statement]:
        """Return a folded statement: none, one or several."""
        if isinstance(s, lang.Assign):
            value = self.fold_value(s.value)
            if isinstance(value, lang.Constant) and s.name in self.fixed:
                self.constants[s.name] = value
                return []
            return [lang.Assign(s.name, value)]
        if isinstance(s, lang.Store):
            return [lang.Store(self.array(s.array), self.fold_value(s.index), self.fold_value(s.value))]
        if isinstance(s, lang.Evaluate):
            call = self.fold_value(s.call)
            return [lang.Evaluate(call)] if isinstance(call, _CALLS) else []
        if isinstance(s, lang.Return):
            return [lang.Return(self.fold_value(s.value))]
        if isinstance(s, lang.If):
            return self.fold_branch(s)
        if isinstance(s, lang.While):
            test = self.fold_value(s.test)
            return [] if _is_constant(test, False) else [lang.While(test, self.fold_body(s.body))]
        if isinstance(s, lang.For):
            start, stop = self.fold_value(s.start), self.fold_value(s.stop)
            if isinstance(start, lang.Constant) and isinstance(stop, lang.Constant):
                if not range(int(start.value), int(stop.value), s.step):
                    return []
            body = self.fold_body(s.body)
            return [lang.For(s.name, start, stop, s.step, body)] if body else []
        if isinstance(s, lang.StatementBlock):
            body = self.fold_body(s.body)
            is_left = any(
                isinstance(x, lang.Leave) and x.how == "block" and x.block == s.number for x in walk_statements(body)
            )
            return [lang.StatementBlock(s.number, body)] if is_left else list(body)
        if isinstance(s, lang.ArrayView):
            return self.view(s)
        if isinstance(s, lang.Pick):
            chosen, otherwise = self.array(s.chosen), self.array(s.otherwise)
            return [lang.Pick(s.name, self.fold_value(s.test), chosen, otherwise)]
        return [s]

    def fold_branch(self, s: lang.If) -> list[lang.Statement]:
        """Return a folded branch, one of its sides where the test is constant."""
        test = self.fold_value(s.test)
        if isinstance(test, lang.Constant):
            return list(self.fold_body(s.then if test.value else s.otherwise))
        return branch_statement(test, self.fold_body(s.then), self.fold_body(s.otherwise))

    def drop_unused(self, body: tuple[lang.Statement, ...]) -> tuple[lang.Statement, ...]:
        """Return statements without assignments to variables and views that nothing reads."""
        read = _names_read(body)
        while True:
            body = _drop_names(body, read)
            before, read = read, _names_read(body)
            if read == before:  # bodies hold functions that they call: they are not compared
                return body

    # -- values

    def fold_value(self, e: lang.Expression) -> Any:
        """Return an expression, a constant where it has no other value."""
        if isinstance(e, lang.Variable):
            return self.constants.get(e.name, e)
        if isinstance(e, lang.ArrayElement):
            return self.element(e)
        if isinstance(e, lang.ArrayLength):
            return self.length(e)
        if isinstance(e, lang.FunctionCall | lang.Invoke):
            return self.call(e)
        if isinstance(e, lang.Logic):
            first = self.fold_value(e.first)
            if isinstance(first, lang.Constant) and bool(first.value) is (e.name == "or"):
                return first  # the second is not evaluated
            return _fold_logic(e.name, first, self.fold_value(e.second), lambda a, b: lang.Logic(e.name, a, b))
        if isinstance(e, lang.Choice):
            test = self.fold_value(e.test)
            if isinstance(test, lang.Constant):
                return self.fold_value(e.chosen if test.value else e.otherwise)
            chosen, otherwise = self.fold_value(e.chosen), self.fold_value(e.otherwise)
            if chosen == otherwise and is_pure(test):
                return chosen
            return lang.Choice(e.type, test, chosen, otherwise)
        if isinstance(e, lang.ScalarOperation):
            return _fold_operation(e, tuple(map(self.fold_value, e.arguments)))
        return e


def branch_statement(
    test: lang.Expression, then: tuple[lang.Statement, ...], otherwise: tuple[lang.Statement, ...]
) -> list[lang.Statement]:
    """Return the statement of a branch, its test negated where one side is empty, and none where both are."""
    if not then and not otherwise and is_pure(test):
        return []
    if not then:
        return [lang.If(lang.ScalarOperation("bool", "not", (test,)), otherwise, ())]
    return [lang.If(test, then, otherwise)]


def _is_constant(e: lang.Expression, value: bool) -> bool:
    return isinstance(e, lang.Constant) and bool(e.value) is value


def _fold_logic(name: str, first: object, second: object, make: Callable[[Any, Any], Any]) -> Any:
    """Return ``and`` or ``or`` of two values."""
    decisive = name == "or"
    for one, other in ((first, second), (second, first)):
        if isinstance(one, lang.Constant):
            if bool(one.value) is not decisive:
                return other
            if one is first or is_pure(first):
                return lang.Constant("bool", decisive)
    return make(first, second)


def _fold_operation(e: lang.ScalarOperation, values: tuple[Any, ...]) -> Any:
    """Return an operation on values; sums of floats stay, so that their rounding does."""
    operation = lang.ScalarOperation(e.type, e.name, values)
    if e.name in ("and", "or") and e.type == "bool":
        return _fold_logic(e.name, values[0], values[1], lambda a, b: operation)
    if not all(isinstance(v, lang.Constant) for v in values):
        return operation
    numbers = [v.value for v in values]
    if e.name in _COMPARISONS:
        return lang.Constant("bool", _COMPARISONS[e.name](*numbers))
    if e.name == "not":
        return lang.Constant("bool", not numbers[0])
    if e.type == "int" and e.name in _INTEGERS and (e.name != "floordiv" or numbers[1]):
        return lang.Constant("int", int(_INTEGERS[e.name](*numbers)))
    if e.name == "neg":
        return lang.Constant(e.type, -numbers[0])
    if e.name == "float":
        return lang.Constant("float", float(numbers[0]))
    if e.name == "bool":
        return lang.Constant("bool", bool(numbers[0]))
    return operation


def _names_read(body: tuple[lang.Statement, ...]) -> set[str]:
    """Return the names of variables that statements read, and of arrays that they read or change."""
    values = list(walk_statements(body))
    reads = Counter(value.name for value in values if isinstance(value, lang.Variable))
    for s in values:  # a variable that its own assignments alone read is not read
        if isinstance(s, lang.Assign) and is_pure(s.value):
            reads[s.name] -= sum(isinstance(v, lang.Variable) and v.name == s.name for v in walk_statements(s.value))
    return arrays_in(body) | {name for name, count in reads.items() if count > 0}


def arrays_in(body: tuple[lang.Statement, ...]) -> set[str]:
    """Return the names of arrays that statements read or change, and of functions that they hand on."""
    names = set[str]()
    for value in walk_statements(body):
        if isinstance(value, lang.ArrayElement | lang.Store | lang.ArrayView | lang.ArrayLength):
            names.add(value.array)
        elif isinstance(value, lang.Pick):
            names |= {value.chosen, value.otherwise}
        elif isinstance(value, lang.FunctionCall | lang.Invoke | lang.Insert):
            names |= {a for a in value.arguments if isinstance(a, str)}
    return names


def _drop_names(body: tuple[lang.Statement, ...], read: set[str]) -> tuple[lang.Statement, ...]:
    """Return the statements without those that only name what is not read."""
    shorter = list[lang.Statement]()
    for s in body:
        if isinstance(s, lang.Assign) and s.name not in read:
            if isinstance(s.value, _CALLS):
                shorter.append(lang.Evaluate(s.value))
                continue
            if is_pure(s.value):
                continue
        if isinstance(s, lang.ArrayView | lang.Pick) and s.name not in read:
            continue
        if isinstance(s, lang.If):
            shorter += branch_statement(s.test, _drop_names(s.then, read), _drop_names(s.otherwise, read))
            continue
        if isinstance(s, lang.For):
            inner = _drop_names(s.body, read)
            if not inner:
                continue
            s = msgspec.structs.replace(s, body=inner, name=s.name if s.name in read else "")
        elif isinstance(s, lang.While | lang.StatementBlock):
            s = msgspec.structs.replace(s, body=_drop_names(s.body, read))
        shorter.append(s)
    return tuple(shorter)
