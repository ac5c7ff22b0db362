"""Calls of compiled functions from Python: arguments unpacked at every call, or laid out in memory in advance.

A compiled function takes a number as it is, an array as the address of its elements and its lengths, another function
as its address. A call unpacks its arguments every time: tens of microseconds for records of arrays and functions.
Where only some numbers differ between calls, a trampoline loads them from slots of eight bytes and calls
the function whose address precedes them.
"""

from __future__ import annotations

import ctypes
import functools
import hashlib
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from symgen.compile.native import types
from symgen.compile.native.machine import load_machine_code

#: Slots before the arguments: address of the function, its result; then memory to copy before: destination, source,
#: number of bytes.
FUNCTION, RESULT, COPY, SOURCE, BYTES, FIRST = range(6)
_SLOTS = {types.float64: "double", types.int64: "i64", types.boolean: "i1"}
_C: dict[Any, Any] = {"double": ctypes.c_double, "i64": ctypes.c_int64, "i1": ctypes.c_bool, "ptr": ctypes.c_void_p}
_DTYPES = {types.float64: np.dtype(np.float64), types.int64: np.dtype(np.int64), types.uint32: np.dtype(np.uint32)}
_NUMBERS = {dtype: number for number, dtype in _DTYPES.items()}
_buffer_of = ctypes.c_char.from_buffer

Slots = list[int | float]
#: Appends the content of the slots of an argument.
Filler = Callable[[Any, Slots], None]


def slot_types(kind: types.Kind) -> Iterator[str]:
    """Yield LLVM's types of the slots of an argument."""
    if isinstance(kind, types.RecordType):
        for part in kind:
            yield from slot_types(part)
    elif isinstance(kind, types.FunctionType):
        yield "ptr"
    elif isinstance(kind, types.ArrayType):
        yield from ("ptr", *("i64",) * kind.ndim)
    else:
        yield _SLOTS[kind]


def slot_values(kind: types.Kind, value: Any) -> Slots:
    """Return the content of the slots of an argument: integers, addresses among them, and floating-point numbers.

    Raises
    ------
    TypeError, ValueError
        If the argument has another type.
    """
    slots = Slots()
    filler_of(kind)(value, slots)
    return slots


def filler_of(kind: types.Kind) -> Filler:
    """Return a function that appends the content of the slots of an argument of a type to a list.

    A run has hundreds of slots, within records of records: what follows from types is looked at once, not at calls.
    """
    if isinstance(kind, types.RecordType):
        return _filler_of_record(kind)
    if isinstance(kind, types.ArrayType):
        dtype, ndim = _DTYPES[kind.dtype], kind.ndim

        def fill_array(value: object, slots: Slots) -> None:
            if not isinstance(value, np.ndarray):
                raise TypeError(f"expected an array {kind}, got {type(value).__name__}")
            if not value.flags.c_contiguous or value.ndim != ndim or value.dtype != dtype:
                raise TypeError(f"expected an array {kind}, got one of {value.ndim} dimensions of {value.dtype}")
            slots.append(address_of(value))
            slots.extend(value.shape)

        return fill_array
    if isinstance(kind, types.FunctionType):
        signature = kind.signature
        return lambda value, slots: slots.append(value.address(signature))
    if kind is types.float64:
        return lambda value, slots: slots.append(float(value))
    return lambda value, slots: slots.append(int(value))


def _filler_of_record(kind: types.RecordType) -> Filler:
    """Return the function that appends the slots of a record."""
    fillers = tuple(map(filler_of, kind.parts))

    def fill_record(value: Iterable[object], slots: Slots) -> None:
        for fill, item in zip(fillers, value, strict=True):
            fill(item, slots)

    def fill_integers(value: Sequence[int], slots: Slots) -> None:  # sizes are tens of integers
        if len(value) != len(fillers):
            fill_record(value, slots)
        slots.extend(map(int, value))

    return fill_integers if kind.whole else fill_record


def address_of(array: np.ndarray[Any, Any]) -> int:
    """Return the address of the elements of a contiguous array, by its buffer in a quarter of the time."""
    try:
        return ctypes.addressof(_buffer_of(array))
    except (TypeError, ValueError):  # without elements, or not to be written
        return int(array.__array_interface__["data"][0])


def argument_type(value: object) -> types.Kind:
    """Return the type of an argument.

    Raises
    ------
    TypeError
        If compiled functions cannot take the argument.
    """
    if isinstance(value, float):
        return types.float64
    if isinstance(value, np.ndarray) and value.dtype in _NUMBERS:
        return types.ArrayType(_NUMBERS[value.dtype], value.ndim)
    if isinstance(value, bool | np.bool_):
        return types.boolean
    if isinstance(value, int | np.integer):
        return types.int64
    if isinstance(value, tuple):
        return types.RecordType(tuple(map(argument_type, value)), type(value))
    raise TypeError(f"compiled functions take numbers, arrays and records of these, no {type(value).__name__}")


def lockless_caller(address: int, signature: types.Signature) -> Callable[..., Any]:
    """Return a Python function that calls a compiled one without the interpreter's lock."""
    expected = signature.arguments
    kinds = [_C[slot] for kind in expected for slot in slot_types(kind)]
    returned = None if signature.result is types.void else _C[_SLOTS[signature.result]]
    function, fillers = ctypes.CFUNCTYPE(returned, *kinds)(address), tuple(map(filler_of, expected))

    def call_function(*arguments: object) -> Any:
        if len(arguments) != len(expected):
            raise TypeError(f"expected {len(expected)} arguments, got {len(arguments)}")
        slots = Slots()
        for fill, value in zip(fillers, arguments, strict=True):
            fill(value, slots)
        return function(*slots)

    return call_function


def trampoline(signature: types.Signature, object_file: Callable[[str, str], bytes]) -> Callable[[int], Any]:
    """Return a function that takes the address of a block of slots and calls the function with the arguments there.

    Parameters
    ----------
    signature : Signature
        Signature of the function; its result is a number of eight bytes.
    object_file : callable
        Returns the object file of a module in LLVM's language with a named function.
    """
    kinds = tuple(slot for kind in signature.arguments for slot in slot_types(kind))
    return _trampoline(_SLOTS[signature.result], kinds, object_file)


@functools.cache
def _trampoline(
    returned: str, kinds: tuple[str, ...], object_file: Callable[[str, str], bytes]
) -> Callable[[int], Any]:
    name = "symgen.trampoline." + hashlib.sha256(" ".join((returned, *kinds)).encode()).hexdigest()[:32]
    address = load_machine_code(object_file(trampoline_text(name, returned, kinds), name), name)
    return ctypes.CFUNCTYPE(None, ctypes.c_void_p)(address)


def trampoline_text(name: str, returned: str, kinds: tuple[str, ...]) -> str:
    """Return the module with a trampoline in LLVM's language.

    It copies memory first, which costs a tenth of a copy made from Python, and calls the function.

    Parameters
    ----------
    name, returned : str
        Name of the function, and the type of the result.
    kinds : tuple of str
        Types of the slots from `FIRST` on.
    """
    place = "getelementptr inbounds i64, ptr %block, i64"
    lines = [f"%s{RESULT} = {place} {RESULT}"]
    for i, kind in (*{FUNCTION: "ptr", COPY: "ptr", SOURCE: "ptr", BYTES: "i64"}.items(), *enumerate(kinds, FIRST)):
        lines += [f"%s{i} = {place} {i}", f"%v{i} = load {kind}, ptr %s{i}, align 8"]
    lines.append(f"call void @llvm.memcpy.p0.p0.i64(ptr %v{COPY}, ptr %v{SOURCE}, i64 %v{BYTES}, i1 false)")
    arguments = ", ".join(f"{kind} %v{i}" for i, kind in enumerate(kinds, FIRST))
    lines.append(f"%result = call {returned} %v{FUNCTION}({arguments})")
    lines += [f"store {returned} %result, ptr %s{RESULT}", "ret void"]
    body = "".join(f"  {line}\n" for line in lines)
    declared = "declare void @llvm.memcpy.p0.p0.i64(ptr, ptr, i64, i1)\n"
    return f'{declared}define void @"{name}"(ptr %block) {{\n{body}}}\n'
