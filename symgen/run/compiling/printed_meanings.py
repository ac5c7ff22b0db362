"""Meanings of parameters of printed functions: rooms in memory, constants, tables, and other functions."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.compile.loopcode.exact import compiled_form
from symgen.compile.native import language as lang
from symgen.compile.native import types
from symgen.compile.native.binding import ConstantTable, Elements, Meaning, Room
from symgen.compile.native.loop_values import argument_value
from symgen.compile.native.loops import read_loop
from symgen.compile.native.read_values import Foreign

if TYPE_CHECKING:
    pass


#: Name of an array in the memory, by the parameter; None where it is constant, empty where it is passed.
Naming = Callable[[str], str | None]


#: Arrays of the memory with as many numbers as transitions are kept, which a program may change.
OF_TRANSITIONS = frozenset(("transitions_times", "transitions_rows", "transitions_words"))


@lru_cache(maxsize=512)
def source_of_piece(function: object) -> lang.Function:
    """Return a function of the runtime, whose callees are functions of their own; it is read once a process.

    Raises
    ------
    Foreign
        If nothing is compiled, so that no types are known.
    """
    signature = getattr(compiled_form(function), "signature", None)
    if signature is None:
        raise Foreign("been left to Python, by NUMBA_DISABLE_JIT")
    return read_loop(compiled_form(function), signature.arguments, None, apart=True)


def meanings_of_names(
    function: object, arguments: tuple[Any, ...], emitted: Mapping[int, lang.Function], room: Naming
) -> dict[str, Meaning]:
    """Return the meanings of a function's parameters for the arguments of a call.

    Parameters
    ----------
    function : Exact
        The function, with a signature.
    arguments : tuple
        Records, numbers, arrays and functions, as it is called with them.
    emitted : mapping of int to Function
        Emitted functions by the identity of those in the arguments; others are functions of the runtime.
    room : callable
        See `Naming`.
    """
    compiled = compiled_form(function)
    assert compiled.signature is not None, "an entry has a signature"
    names = compiled.py_func.__code__.co_varnames
    meanings = dict[str, Meaning]()
    for name, kind, argument in zip(names, compiled.signature.arguments, arguments, strict=False):
        _, parameters = argument_value(name, kind)
        for parameter, value in zip(parameters, _table_items(kind, argument), strict=True):
            meanings[parameter.name] = _meaning_of_value(parameter, value, emitted, room)
    return meanings


def _table_items(kind: types.Kind, value: Any) -> Iterator[Any]:
    """Yield numbers, arrays and functions of an argument in the order of parameters."""
    if isinstance(kind, types.RecordType):
        for part, item in zip(kind, value, strict=True):
            yield from _table_items(part, item)
    else:
        yield value


def _meaning_of_value(
    parameter: lang.FunctionParameter, value: Any, emitted: Mapping[int, lang.Function], room: Naming
) -> Meaning:
    if parameter.address:
        return emitted[id(value)] if id(value) in emitted else source_of_piece(value)
    if not parameter.array:
        if value is None:
            return None
        number = float(value) if parameter.type == "float" else int(value)
        return lang.Constant(parameter.type, number)
    name, values = room(parameter.name), np.ravel(value)
    if name is not None:
        return Room(name, len(values), name in OF_TRANSITIONS) if name else Elements(len(values))
    table = tuple(values.tolist())
    return ConstantTable(parameter.name.rpartition(".")[2], parameter.type, table)


def identity_of_meaning(meaning: Meaning) -> Hashable:
    """Return what two meanings that are one have in common."""
    return meaning.key if isinstance(meaning, lang.Function) else meaning
