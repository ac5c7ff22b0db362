"""Arguments of compiled functions from Python: taken apart, and laid out in memory for a trampoline."""

import ctypes
from collections import namedtuple

import numpy as np
import pytest

from symgen.compile.native.calls import (
    BYTES,
    COPY,
    FIRST,
    FUNCTION,
    RESULT,
    SOURCE,
    argument_type,
    lockless_caller,
    slot_types,
    slot_values,
    trampoline,
)
from symgen.compile.native.machine import compile_module, load_machine_code
from symgen.compile.native.types import ArrayType, FunctionType, RecordType, boolean, float64, int64, uint32, void

Pair = namedtuple("Pair", "one other")
RECORD = RecordType((float64[:, ::1], RecordType((int64, boolean))), Pair)
#: Returns x plus the first of an array, or its negative.
TEXT = """
define double @"symgen.test_calls"(double %x, ptr %a, i64 %n, i1 %sign) {
  %y = load double, ptr %a
  %z = fadd double %x, %y
  %m = fneg double %z
  %r = select i1 %sign, double %z, double %m
  ret double %r
}
"""
SIGNATURE = float64(float64, float64[::1], boolean)


@pytest.fixture(scope="module")
def address():
    return load_machine_code(compile_module(TEXT, "symgen.test_calls"), "symgen.test_calls")


def test_types_are_written_as_numba_writes_them():
    assert repr(int64(float64[::1], uint32[:, ::1], FunctionType(void(boolean)))) == (
        "int64(float64[::1], uint32[:, ::1], &void(boolean))"
    )
    assert RECORD.fields == Pair._fields and RecordType((int64,)).fields == () and len(RECORD) == 2


def test_slots_and_what_is_in_them():
    matrix = np.zeros((2, 3))
    values = Pair(matrix, (7, True))
    assert list(slot_types(RECORD)) == ["ptr", "i64", "i64", "i64", "i1"]
    assert list(slot_values(RECORD, values)) == [matrix.ctypes.data, 2, 3, 7, 1]
    assert (
        argument_type(values) == RECORD
        and argument_type(np.float64(1.0)) is float64
        and argument_type(np.True_) is boolean
    )
    with pytest.raises(TypeError, match="no str"):
        argument_type("x")


def test_addresses_of_arrays_that_are_empty_or_not_to_be_written():
    kept, empty = np.arange(6.0), np.zeros((0, 3))
    kept.flags.writeable = False
    for array in (kept, kept[2:], empty, np.arange(6.0)[3:]):
        assert slot_values(ArrayType(float64, array.ndim), array)[0] == array.ctypes.data


def test_records_of_integers_alone():
    sizes = RecordType((int64, int64), Pair)
    assert slot_values(sizes, Pair(np.int64(3), 4)) == [3, 4]
    for few in ((3,), (3, 4, 5)):
        with pytest.raises(ValueError, match="zip"):
            slot_values(sizes, few)


@pytest.mark.parametrize("value", [None, [1.0], np.zeros(2, int), np.zeros((1, 2)), np.zeros(4)[::2]])
def test_another_array_is_refused(value):
    with pytest.raises(TypeError, match="expected an array"):
        list(slot_values(ArrayType(float64, 1), value))


def test_a_call_takes_arguments_apart(address):
    call = lockless_caller(address, SIGNATURE)
    assert call(1, np.array([2.0]), True) == 3.0
    assert call(1.0, np.array([2.0]), False) == -3.0
    with pytest.raises(TypeError, match="expected 3 arguments, got 2"):
        call(1.0, True)


def test_a_trampoline_copies_and_calls(address):
    call = trampoline(SIGNATURE, compile_module)
    assert call is trampoline(float64(float64, float64[::1], boolean), compile_module)
    target, source = np.zeros(1), np.array([5.0])
    block = np.zeros(FIRST + 4, np.int64)
    block[[FUNCTION, COPY, SOURCE, BYTES]] = address, target.ctypes.data, source.ctypes.data, source.nbytes
    block[FIRST:] = 0, target.ctypes.data, 1, 1
    block.view(float)[FIRST] = 0.5
    call(ctypes.c_void_p(block.ctypes.data))
    assert block.view(float)[RESULT] == 5.5
