"""Types of compiled functions from annotations: numbers, arrays, functions, tuples and records."""

from __future__ import annotations

import pickle
from collections.abc import Callable

import numpy as np
import pytest

from symgen.compile.loopcode.exact import compiled_form, exact, plain_form
from symgen.compile.native import types
from symgen.compile.native.annotations import (
    Array,
    Cube,
    Integers,
    Matrix,
    Record,
    function_type,
    record_type,
    signature_from,
    type_of,
)
from symgen.compile.native.compiler import is_interpreted
from symgen.compile.store.jit import jit

F, N = types.float64, types.int64
#: step(t, y) -> code.
Step = Callable[[float, Array], int]


class Body(Record):
    """A body."""

    mass: float
    places: Array
    count: int  # as a method of tuples is called


class Wheel(Body):
    """A body that turns."""

    spin: Matrix


def rolled(wheel: Wheel, step: Step, pair: tuple[int, bool], marks: Integers, deep: Cube) -> float:
    """Return a number of a wheel."""
    return wheel.mass


@jit(entry=True)
def times_mass(body: Body, numbers: Array) -> float:
    """Return one of some numbers times a mass."""
    return float(body.mass * numbers[body.count])


@exact(entry=True)
def times_twice_mass(body: Body, numbers: Array) -> float:
    """Return one of some numbers times twice a mass."""
    return float(2.0 * body.mass * numbers[body.count])


def test_types_of_annotations():
    assert [type_of(hint) for hint in (float, int, bool)] == [F, N, types.boolean]
    assert [type_of(hint) for hint in (Array, Integers, Matrix)] == [F[::1], N[::1], F[:, ::1]]
    assert type_of(tuple[int, Array]) == types.RecordType((N, F[::1]))
    assert function_type(Step) == types.FunctionType(N(F, F[::1]))
    assert type_of("Array", {"Array": Array}) == F[::1] and type_of("float", {}) == F


def test_a_record_has_the_fields_of_its_base_first():
    assert Wheel._fields == ("mass", "places", "count", "spin") and issubclass(Wheel, Body)
    assert record_type(Wheel) == types.RecordType((F, F[::1], N, F[:, ::1]), Wheel)
    wheel = Wheel(1.0, np.ones(2), 3, spin=np.ones((2, 2)))
    assert wheel.count == 3 and wheel[0] == 1.0 and isinstance(wheel, Body) and isinstance(wheel, tuple)
    assert pickle.loads(pickle.dumps(wheel._replace(count=4))).count == 4
    with pytest.raises(AttributeError):
        wheel.count = 5
    with pytest.raises(TypeError, match="spin"):
        Wheel(1.0, np.ones(2), 3)


def test_signatures_follow_from_functions():
    expected = F(record_type(Wheel), function_type(Step), types.RecordType((N, types.boolean)), N[::1], F[:, :, ::1])
    assert signature_from(rolled) == expected and function_type(rolled) == types.FunctionType(expected)


@pytest.mark.parametrize("hint", ["complex", "str", "list[float]", "dict[str, int]"])
def test_other_annotations_are_refused(hint):
    with pytest.raises(TypeError, match="compiled functions have no type for"):
        type_of(hint, {})


def test_entries_are_compiled_for_their_annotations():
    numbers = np.arange(3.0)
    arguments = Body(3.0, np.zeros(0), 2), numbers
    assert times_mass(*arguments) == compiled_form(times_twice_mass)(*arguments) / 2.0 == 6.0
    assert plain_form(times_twice_mass)(*arguments) == 12.0
    if not is_interpreted():
        assert compiled_form(times_twice_mass).signature == times_mass.signature == F(record_type(Body), F[::1])
