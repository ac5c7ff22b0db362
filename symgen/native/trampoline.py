"""Calls of compiled functions with many arguments, all of which stand in one piece of memory.

A call of a compiled function from Python takes its arguments apart every time: tens of microseconds for records of
arrays and for functions. Where they are the same at every call but for some numbers, it is enough to take them apart
once. A trampoline loads the arguments, in the calling convention of Numba's functions, from slots of eight bytes and
calls the function whose address stands before them.
"""

from __future__ import annotations

import ctypes
import functools
import hashlib
import inspect
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numba import types
from numba.core.datamodel import default_manager
from numba.core.registry import cpu_target
from numba.experimental import function_type

from symgen.native import internals
from symgen.native.machine import compiled, load

#: Slots before the arguments: address of the function, its result, where it would put an exception; then memory that is
#: copied before: to where, from where, how many bytes.
FUNCTION, RESULT, EXCEPTION, COPY, SOURCE, BYTES, FIRST = range(7)
#: Slots of an array of one dimension: owner, parent, size, size of an element, data, then shape and strides.
ARRAY = ("ptr", "ptr", "i64", "i64", "ptr")
#: Slots of a first-class function: its address in C's convention, its object, its address in Numba's convention.
REFERENCE = ("ptr", "ptr", "ptr")
#: What the values behind these slots are called in Numba.
_FIELDS = {
    types.float64[::1]: ("meminfo", "parent", "nitems", "itemsize", "data", "shape", "strides"),
    types.FunctionType(types.float64(types.float64)): ("c_addr", "py_addr", "jit_addr"),
}
#: Trampolines by the slots they load: whoever made one, a process has it once, since one name stands for it.
_known: dict[tuple[str, ...], Callable[[int], int] | None] = {}
_NUMBERS = {types.float64: "double", types.int64: "i64"}
_DOUBLE, _WHOLE = np.dtype(np.float64), np.dtype(np.int64)


def changed() -> list[str]:
    """Return a sentence for everything that is not as expected of what `internals` does not look at; else nothing."""
    found = list[str]()
    for name in ("_get_wrapper_address", "_get_jit_address"):
        function = getattr(function_type, name, None)
        if function is None or list(inspect.signature(function).parameters) != ["func", "sig"]:
            found.append(f"numba.experimental.function_type should have {name}(func, sig)")
    for kind, fields in _FIELDS.items():
        model = default_manager.lookup(kind)
        if (given := tuple(getattr(model, "_fields", ()))) != fields:
            found.append(f"values of type {kind} should hold {fields}, but hold {given}")
    return found


@functools.cache
def usable() -> bool:
    """Whether compiled functions may be called with blocks of arguments here."""
    return internals.usable() and not changed()


def addresses(function: Any, kind: types.FunctionType) -> tuple[int, int, int]:
    """Return what stands in the slots of a first-class function."""
    signature = kind.signature
    return (
        function_type._get_wrapper_address(function, signature),
        id(function),
        function_type._get_jit_address(function, signature),
    )


def slots(kind: Any) -> Iterator[str]:
    """Yield LLVM's types of the slots that an argument takes.

    Parameters
    ----------
    kind : Numba type
        Of the argument.

    Raises
    ------
    TypeError
        If it is none that can be laid out.
    """
    if isinstance(kind, types.BaseTuple):
        for part in kind:
            yield from slots(part)
    elif isinstance(kind, types.FunctionType):
        yield from REFERENCE
    elif isinstance(kind, types.Array) and kind.dtype in _NUMBERS and kind.layout == "C":
        yield from (*ARRAY, *("i64",) * (2 * kind.ndim))
    elif kind in _NUMBERS:
        yield _NUMBERS[kind]
    else:
        raise TypeError(f"no slots for {kind}")


def numbers(kind: Any, value: Any) -> Iterator[int | float]:
    """Yield what stands in the slots of an argument: integers, addresses among them, and floating-point numbers."""
    if kind is types.float64:
        yield float(value)
    elif kind is types.int64:
        yield int(value)
    elif isinstance(kind, types.Array):
        if not (isinstance(value, np.ndarray) and value.flags.c_contiguous and value.ndim == kind.ndim):
            raise TypeError("an array of another kind")
        if value.dtype != (_DOUBLE if kind.dtype is types.float64 else _WHOLE):
            raise TypeError("an array of other numbers")
        data, _ = value.__array_interface__["data"]
        yield from (0, 0, value.size, value.itemsize, data, *value.shape, *value.strides)
    elif isinstance(kind, types.BaseTuple):
        for part, item in zip(kind, value, strict=True):
            yield from numbers(part, item)
    else:
        yield from addresses(value, kind)


def trampoline(
    returned: Any, arguments: tuple[Any, ...], made: Callable[[str, str], bytes] = compiled
) -> Callable[[int], int] | None:
    """Return what calls a function with arguments from a block of slots, None where Numba calls it otherwise.

    Parameters
    ----------
    returned : Numba type
        Of the result; a number of eight bytes.
    arguments : tuple of Numba types
        Of the function.
    made : callable
        Gives the object file of a module in LLVM's language with the function of a name.

    Returns
    -------
    callable or None
        Takes the address of a block and returns 0, or what Numba returns where an exception was raised. The
        interpreter's lock is not held meanwhile.
    """
    if not usable():
        return None
    try:
        kinds = tuple(kind for argument in arguments for kind in slots(argument))
    except TypeError:
        return None
    convention = cpu_target.target_context.call_conv.get_function_type(returned, arguments)
    asked = [_plain(kind) for kind in convention.args[2:]]
    if returned not in _NUMBERS or asked != [*kinds] or str(convention.return_type) != "i32":
        return None
    if kinds not in _known:
        _known[kinds] = _compiled(kinds, made)
    return _known[kinds]


def _plain(kind: Any) -> str:
    """Return LLVM's type of an argument, pointers without what they point to."""
    return "ptr" if kind.is_pointer else str(kind)


def _compiled(kinds: tuple[str, ...], made: Callable[[str, str], bytes]) -> Callable[[int], int] | None:
    name = "symgen.trampoline." + hashlib.sha256(" ".join(kinds).encode()).hexdigest()[:32]
    try:
        address = load(made(text(name, kinds), name), [name])[name]
    except RuntimeError:  # an LLVM that does not know the language any more
        return None
    return ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p)(address)


def text(name: str, kinds: tuple[str, ...]) -> str:
    """Return the module with a trampoline in LLVM's language.

    It copies memory as it is told, which costs a tenth of what a copy made from Python does, and calls the function.

    Parameters
    ----------
    name : str
        Of the function.
    kinds : tuple of str
        Types of the slots from `FIRST` on.
    """
    place = "getelementptr inbounds i64, ptr %block, i64"
    head = {FUNCTION: "ptr", COPY: "ptr", SOURCE: "ptr", BYTES: "i64"}
    lines = [f"%s{RESULT} = {place} {RESULT}", f"%s{EXCEPTION} = {place} {EXCEPTION}"]
    for i, kind in (*head.items(), *enumerate(kinds, FIRST)):
        lines += [f"%s{i} = {place} {i}", f"%v{i} = load {kind}, ptr %s{i}, align 8"]
    lines.append(f"call void @llvm.memcpy.p0.p0.i64(ptr %v{COPY}, ptr %v{SOURCE}, i64 %v{BYTES}, i1 false)")
    given = (f"{kind} %v{i}" for i, kind in enumerate(kinds, FIRST))
    arguments = ", ".join((f"ptr %s{RESULT}", f"ptr %s{EXCEPTION}", *given))
    lines += [f"%status = call i32 %v{FUNCTION}({arguments})", "ret i32 %status"]
    body = "".join(f"  {line}\n" for line in lines)
    declared = "declare void @llvm.memcpy.p0.p0.i64(ptr, ptr, i64, i1)\n"
    return f'{declared}define i32 @"{name}"(ptr %block) {{\n{body}}}\n'
