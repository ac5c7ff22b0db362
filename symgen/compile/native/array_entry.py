"""Calls of compiled functions with NumPy arrays at the cost of a call of C: the entry itself is machine code.

A function ``f(x1, ..., xk, out)`` on arrays becomes a built-in function of Python. Its entry reads the arguments as
NumPy lays arrays out, makes the result, and calls the compiled function; this takes a tenth of a microsecond. Whatever
is not an array of the expected length, of 64-bit numbers side by side, goes to an ordinary Python function, which
converts or refuses it.
"""

from __future__ import annotations

import ctypes
import functools
import sys
from collections.abc import Callable, Sequence
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symgen.compile.native.machine import load_machine_code

#: Slots of a block: functions of NumPy and Python, facts of the result, then two for each argument.
(
    FUNCTION,  # address of the compiled function
    KERNEL,  # address of a function that makes the result of what that one writes, or 0
    SIZES,  # its integers: address and number
    SIZES_COUNT,
    SCRATCH,  # what the compiled function writes for it: address and length
    SCRATCH_LENGTH,
    OTHERWISE,  # the Python function for other arguments
    DIMENSIONS,  # number of dimensions of the result; 0: a number
    ROWS,
    COLUMNS,
    LENGTH,  # its elements
    ARRAY_TYPE,
    VIEW_TYPE,  # a subclass whose instances are taken as well
    NUMBERS,  # the description of 64-bit numbers
    EMPTY,  # PyArray_Empty
    VECTORCALL,
    INCREMENT,  # Py_IncRef
    DECREMENT,  # Py_DecRef
    TO_FLOAT,  # PyFloat_FromDouble
    DEFAULT,  # address of the last argument where it is left out
    FIRST,  # lengths of arguments
) = range(21)
#: Places of functions in NumPy's table for extensions, which never change.
_ARRAY_TYPE, _EMPTY = 2, 184
#: Bytes from the beginning of an array to what it says of itself.
_DATA, _ND, _SHAPE, _DESCR, _FLAGS = 16, 24, 32, 56, 64
#: C order and aligned; these and writeable.
_READ, _WRITE = 0x101, 0x501
_FASTCALL, _KEYWORDS = 0x80, 0x2


class _Definition(ctypes.Structure):
    """PyMethodDef."""

    _fields_ = (
        ("name", ctypes.c_char_p),
        ("function", ctypes.c_void_p),
        ("flags", ctypes.c_int),
        ("doc", ctypes.c_char_p),
    )


class EntrySlots(np.ndarray[Any, np.dtype[np.int64]]):
    """The slots of an entry, with what has to live as long."""

    kept: tuple[Any, ...]


def supports_entries() -> bool:
    """Whether arrays are laid out as the entries read them: CPython with a global lock, 64 bits."""
    plain = sys.implementation.name == "cpython" and object.__basicsize__ == 2 * ctypes.sizeof(ctypes.c_void_p) == 16
    return plain and getattr(sys, "_is_gil_enabled", lambda: True)()


def entry_slots(
    address: int,
    kernel: int,
    sizes: NDArray[np.int64],
    scratch: NDArray[np.float64],
    lengths: Sequence[int],
    shape: tuple[int, ...],
    default: NDArray[np.float64],
    otherwise: Callable[..., Any],
    views: type[np.ndarray[Any, Any]] = np.ndarray,
) -> EntrySlots:
    """Return the slots of an entry.

    Parameters
    ----------
    address, kernel : int
        Addresses of ``f(x1, ..., xk, out)`` and, or 0, of ``kernel(sizes, scratch, out)``, which then makes the result
        of what ``f`` writes into `scratch`. Both return 0 where all went well.
    sizes, scratch : Array
        For the kernel.
    lengths : sequence of int
        Lengths of the arguments.
    shape : tuple of int
        Shape of the result, of at most two dimensions.
    default : Array
        The last argument where it is left out.
    otherwise : callable
        Called with all other arguments, and where a function returns something else.
    views : type
        A subclass of arrays, which lives as long as the process: its instances are arguments like others.
    """
    block = np.zeros(FIRST + len(lengths), dtype=np.int64).view(EntrySlots)
    numbers = np.dtype(np.float64)
    block.kept = sizes, scratch, default, otherwise, numbers
    api, python = _numpy_table(), ctypes.pythonapi
    assert api[_ARRAY_TYPE] == id(np.ndarray), "the first entries of NumPy's table are known"
    block[:FIRST] = [
        *(address, kernel, sizes.ctypes.data, len(sizes), scratch.ctypes.data, len(scratch), id(otherwise)),
        *(len(shape), *(*shape, 1, 1)[:2], int(np.prod(shape)), id(np.ndarray), id(views), id(numbers)),
        api[_EMPTY],
        *(_address_of(getattr(python, name)) for name in ("PyObject_Vectorcall", "Py_IncRef", "Py_DecRef")),
        _address_of(python.PyFloat_FromDouble),
        default.ctypes.data,
    ]
    block[FIRST:] = lengths
    return block


def array_entry(block: EntrySlots, inputs: int, object_file: Callable[[str, str], bytes]) -> Any:
    """Return the built-in function of a block.

    Parameters
    ----------
    block : Block
        Its slots.
    inputs : int
        Number of arguments.
    object_file : callable
        Returns the object file of a module in LLVM's language with a named function.
    """
    return _new_builtin(_builtin_definition(inputs, object_file), block)


def batch_function(inputs: int, object_file: Callable[[str, str], bytes]) -> Callable[..., int]:
    """Return a function that calls a compiled one for many states, without the interpreter's lock.

    It takes the addresses of a block of slots and of a working memory for `SCRATCH`, the number of states, the
    addresses of the first result and of a status, and address and step of each argument; it returns the first state at
    which a function returned another number than 0, which is the status then, or -1.
    """
    return _compile_batch(inputs, object_file)


@functools.cache
def _compile_batch(inputs: int, object_file: Callable[[str, str], bytes]) -> Callable[..., int]:
    name = f"symgen.many.{inputs}"
    address = load_machine_code(object_file(batch_text(name, inputs), name), name)
    kinds = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p]
    return ctypes.CFUNCTYPE(ctypes.c_int64, *kinds, *(ctypes.c_void_p, ctypes.c_int64) * inputs)(address)


@functools.cache
def _numpy_table() -> Any:
    """Return NumPy's table of functions for extensions."""
    read = ctypes.pythonapi.PyCapsule_GetPointer
    read.restype, read.argtypes = ctypes.c_void_p, [ctypes.py_object, ctypes.c_char_p]
    address = read(import_module("numpy._core._multiarray_umath")._ARRAY_API, None)
    return ctypes.cast(address, ctypes.POINTER(ctypes.c_size_t))


def _address_of(function: Any) -> int:
    return int(ctypes.cast(function, ctypes.c_void_p).value or 0)


@functools.cache
def _builtin_definition(inputs: int, object_file: Callable[[str, str], bytes]) -> _Definition:
    """Return the definition of built-in functions of so many arguments, which lives as long as the process."""
    name = f"symgen.array_entry.{inputs}"
    address = load_machine_code(object_file(entry_text(name, inputs), name), name)
    return _Definition(b"compiled", address, _FASTCALL | _KEYWORDS, b"A compiled function of the state.")


def _new_builtin(definition: _Definition, block: EntrySlots) -> Any:
    new = ctypes.pythonapi.PyCFunction_NewEx
    new.restype, new.argtypes = ctypes.py_object, [ctypes.c_void_p, ctypes.py_object, ctypes.c_void_p]
    return new(ctypes.addressof(definition), block, None)


# -- text for LLVM -----------------------------------------------------------------------------------------------------


def entry_text(name: str, inputs: int) -> str:
    """Return the module of an entry for `inputs` arrays, the last one optional, then maybe one for the result."""
    lines = [
        f'define ptr @"{name}"(ptr %self, ptr %args, i64 %nargs, ptr %kwnames) {{',
        "start:",
        "  %number = alloca double",
        f"  %at = getelementptr i8, ptr %self, i64 {_DATA}",
        "  %block = load ptr, ptr %at",
        *(_slot_lines(slot) for slot in range(FIRST + inputs)),
        "  %plain = icmp eq ptr %kwnames, null",
        f"  %enough = icmp sge i64 %nargs, {inputs - 1}",
        f"  %few = icmp sle i64 %nargs, {inputs + 1}",
        "  %some = and i1 %enough, %few",
        "  %right = and i1 %plain, %some",
        "  br i1 %right, label %check0, label %otherwise",
    ]
    for i in range(inputs):
        after = "result" if i == inputs - 1 else f"check{i + 1}"
        lines.append(f"check{i}:")
        if i == inputs - 1:
            lines += [f"  %has{i} = icmp sge i64 %nargs, {inputs}", f"  br i1 %has{i}, label %read{i}, label %result"]
            lines.append(f"read{i}:")
        lines += _check_lines(i, f"%s{FIRST + i}", _READ)
        lines.append(f"  br i1 %ok{i}, label %{after}, label %otherwise")
    last, d = inputs - 1, inputs
    lines += [
        "result:",
        f"  %last = phi ptr [ %p{DEFAULT}, %check{last} ], [ %data{last}, %dense{last}.is ]",
        f"  %given = icmp sgt i64 %nargs, {inputs}",
        f"  %scalar = icmp eq i64 %s{DIMENSIONS}, 0",
        "  br i1 %given, label %take, label %make",
        "take:",
        "  br i1 %scalar, label %otherwise, label %taken",
        "taken:",
        *_check_lines(d, f"%s{ROWS}", _WRITE, f"%s{DIMENSIONS}"),
        f"  %two = icmp eq i64 %s{DIMENSIONS}, 2",
        "  %where = select i1 %two, i64 8, i64 0",
        f"  %second = getelementptr i8, ptr %shape{d}, i64 %where",
        "  %width = load i64, ptr %second",
        f"  %wide = icmp eq i64 %width, %s{COLUMNS}",
        "  %flat = xor i1 %two, true",
        "  %fits = or i1 %flat, %wide",
        f"  %good = and i1 %fits, %ok{d}",
        "  br i1 %good, label %own, label %otherwise",
        "own:",
        f"  %mine = load ptr, ptr %place{d}",
        f"  call void %p{INCREMENT}(ptr %mine)",
        "  br label %call",
        "make:",
        "  br i1 %scalar, label %call, label %new",
        "new:",
        f"  call void %p{INCREMENT}(ptr %p{NUMBERS})",
        f"  %nd = trunc i64 %s{DIMENSIONS} to i32",
        f"  %dims = getelementptr i64, ptr %block, i64 {ROWS}",
        f"  %fresh = call ptr %p{EMPTY}(i32 %nd, ptr %dims, ptr %p{NUMBERS}, i32 0)",
        "  %none = icmp eq ptr %fresh, null",
        "  br i1 %none, label %failed, label %made",
        "failed:",
        "  ret ptr null",
        "made:",
        f"  %into = getelementptr i8, ptr %fresh, i64 {_DATA}",
        "  %room = load ptr, ptr %into",
        "  br label %call",
        "call:",
        "  %object = phi ptr [ %mine, %own ], [ null, %make ], [ %fresh, %made ]",
        f"  %out = phi ptr [ %data{d}, %own ], [ %number, %make ], [ %room, %made ]",
        *_call_lines(
            [(f"%data{i}" if i < last else "%last", f"%s{FIRST + i}") for i in range(inputs)],
            "%out",
            f"%p{SCRATCH}",
        ),
        "  %done = icmp eq i64 %status, 0",
        "  br i1 %done, label %finish, label %drop",
        "finish:",
        "  br i1 %scalar, label %float, label %array",
        "float:",
        "  %x = load double, ptr %number",
        f"  %float.object = call ptr %p{TO_FLOAT}(double %x)",
        "  ret ptr %float.object",
        "array:",
        "  ret ptr %object",
        "drop:",
        "  br i1 %scalar, label %otherwise, label %release",
        "release:",
        f"  call void %p{DECREMENT}(ptr %object)",
        "  br label %otherwise",
        "otherwise:",
        f"  %slow = call ptr %p{VECTORCALL}(ptr %p{OTHERWISE}, ptr %args, i64 %nargs, ptr %kwnames)",
        "  ret ptr %slow",
        "}",
    ]
    return "\n".join(lines) + "\n"


def batch_text(name: str, inputs: int) -> str:
    """Return the module of a loop over states."""
    arrays = "".join(f", ptr %x{i}, i64 %step{i}" for i in range(inputs))
    body = [f"  %from{i} = getelementptr double, ptr %x{i}, i64 %o{i}" for i in range(inputs)]
    lines = [
        f'define i64 @"{name}"(ptr %block, ptr %scratch, i64 %count, ptr %results, ptr %wrong{arrays}) {{',
        "start:",
        *(_slot_lines(slot) for slot in range(FIRST + inputs)),
        "  br label %head",
        "head:",
        "  %k = phi i64 [ 0, %start ], [ %next, %after ]",
        "  %more = icmp slt i64 %k, %count",
        "  br i1 %more, label %body, label %end",
        "body:",
        *(f"  %o{i} = mul i64 %k, %step{i}" for i in range(inputs)),
        *body,
        f"  %oo = mul i64 %k, %s{LENGTH}",
        "  %out = getelementptr double, ptr %results, i64 %oo",
        *_call_lines([(f"%from{i}", f"%s{FIRST + i}") for i in range(inputs)], "%out", "%scratch"),
        "  %done = icmp eq i64 %status, 0",
        "  br i1 %done, label %after, label %failed",
        "after:",
        "  %next = add i64 %k, 1",
        "  br label %head",
        "failed:",
        "  store i64 %status, ptr %wrong",
        "  ret i64 %k",
        "end:",
        "  ret i64 -1",
        "}",
    ]
    return "\n".join(lines) + "\n"


def _slot_lines(slot: int) -> str:
    return (
        f"  %a{slot} = getelementptr i64, ptr %block, i64 {slot}\n"
        f"  %s{slot} = load i64, ptr %a{slot}\n  %p{slot} = inttoptr i64 %s{slot} to ptr"
    )


def _check_lines(i: int, length: str, flags: int, dimensions: str = "1") -> list[str]:
    """Return the lines that read argument `i` and tell whether it is an array as expected."""
    return [
        f"  %place{i} = getelementptr ptr, ptr %args, i64 {i}",
        f"  %o{i} = load ptr, ptr %place{i}",
        f"  %type{i}.at = getelementptr i8, ptr %o{i}, i64 8",
        f"  %type{i} = load i64, ptr %type{i}.at",
        f"  %plain{i} = icmp eq i64 %type{i}, %s{ARRAY_TYPE}",
        f"  %view{i} = icmp eq i64 %type{i}, %s{VIEW_TYPE}",
        f"  %array{i} = or i1 %plain{i}, %view{i}",
        f"  br i1 %array{i}, label %array{i}.is, label %otherwise",
        f"array{i}.is:",
        f"  %descr{i}.at = getelementptr i8, ptr %o{i}, i64 {_DESCR}",
        f"  %descr{i} = load i64, ptr %descr{i}.at",
        f"  %numbers{i} = icmp eq i64 %descr{i}, %s{NUMBERS}",
        f"  %nd{i}.at = getelementptr i8, ptr %o{i}, i64 {_ND}",
        f"  %nd{i}.short = load i32, ptr %nd{i}.at",
        f"  %nd{i} = sext i32 %nd{i}.short to i64",
        f"  %line{i} = icmp eq i64 %nd{i}, {dimensions}",
        f"  %flags{i}.at = getelementptr i8, ptr %o{i}, i64 {_FLAGS}",
        f"  %flags{i} = load i32, ptr %flags{i}.at",
        f"  %set{i} = and i32 %flags{i}, {flags}",
        f"  %side{i} = icmp eq i32 %set{i}, {flags}",
        f"  %known{i} = and i1 %numbers{i}, %line{i}",
        f"  %dense{i} = and i1 %known{i}, %side{i}",
        f"  br i1 %dense{i}, label %dense{i}.is, label %otherwise",
        f"dense{i}.is:",
        f"  %shape{i}.at = getelementptr i8, ptr %o{i}, i64 {_SHAPE}",
        f"  %shape{i} = load ptr, ptr %shape{i}.at",
        f"  %length{i} = load i64, ptr %shape{i}",
        f"  %ok{i} = icmp eq i64 %length{i}, {length}",
        f"  %data{i}.at = getelementptr i8, ptr %o{i}, i64 {_DATA}",
        f"  %data{i} = load ptr, ptr %data{i}.at",
    ]


def _call_lines(arrays: Sequence[tuple[str, str]], out: str, scratch: str) -> list[str]:
    """Return the lines that call the functions; `%status` is 0 where all went well."""
    arguments = ", ".join(f"ptr {data}, i64 {length}" for data, length in arrays)
    return [
        f"  %two.steps = icmp ne i64 %s{KERNEL}, 0",
        f"  %target = select i1 %two.steps, ptr {scratch}, ptr {out}",
        f"  %target.length = select i1 %two.steps, i64 %s{SCRATCH_LENGTH}, i64 %s{LENGTH}",
        f"  %first = call i64 %p{FUNCTION}({arguments}, ptr %target, i64 %target.length)",
        "  br i1 %two.steps, label %kernel, label %direct",
        "kernel:",
        f"  %second.status = call i64 %p{KERNEL}(ptr %p{SIZES}, i64 %s{SIZES_COUNT}, ptr %target, "
        f"i64 %s{SCRATCH_LENGTH}, ptr {out}, i64 %s{LENGTH})",
        "  br label %status.known",
        "direct:",
        "  br label %status.known",
        "status.known:",
        "  %status = phi i64 [ %second.status, %kernel ], [ %first, %direct ]",
    ]
