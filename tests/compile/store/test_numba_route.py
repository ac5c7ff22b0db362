"""How Numba compiles functions of the runtime: once each, without counts of references, from records to records."""

from typing import NamedTuple

import numpy as np
import pytest

from symgen.compile.store.jit import RuntimeFunction, jit


class Pair(NamedTuple):
    """A record."""

    values: np.ndarray
    factor: float


class Triple(NamedTuple):
    """A record that is longer."""

    values: np.ndarray
    factor: float
    shift: float


@jit()
def weighted(record, k):
    return record.factor * record.values[k] + record.shift


def total(record, shift):
    longer, found = Triple(*record, shift), 0.0
    for k in range(longer.values.shape[0]):
        found += weighted(longer, k)
        longer.values[k] = found
    return found


def first(record, shift):
    found = 0.0
    for k in range(1):  # an index of the same type, which a constant is not
        found = weighted(Triple(*record, shift), k)
    return found


def values():
    return np.array([0.3, -1.7, 2.0])


@pytest.mark.slow
def test_numba_calls_a_part_that_it_has_compiled_once_and_gives_the_numbers_of_the_own_compiler():
    from symgen.compile.store import numba_route

    by_own, by_numba, plain = values(), values(), values()
    own = RuntimeFunction(total)(Pair(by_own, 1.5), 0.25)
    callers = [RuntimeFunction(caller) for caller in (total, first)]
    found = [numba_route.call_by_numba(caller, Pair(by_numba, 1.5), 0.25) for caller in callers]
    assert own == pytest.approx(found[0], rel=1e-14) == 1.5 * plain.sum() + 0.75
    np.testing.assert_allclose(by_numba, 1.5 * np.cumsum(plain) + 0.25 * np.arange(1, 4), rtol=1e-14)
    np.testing.assert_allclose(by_own, by_numba, rtol=1e-14)
    assert found[1] == pytest.approx(1.5 * by_numba[0] + 0.25, rel=1e-14)

    [part] = numba_route.type_in_callers(weighted).dispatcher.overloads.values()
    assert part.fndesc.llvm_func_name in names_in(part) and part.fndesc.llvm_cpython_wrapper_name not in names_in(part)
    for caller in callers:
        [compiled] = numba_route.form_of(caller).overloads.values()
        assert compiled.fndesc.llvm_cpython_wrapper_name in names_in(compiled)
        assert part.fndesc.llvm_func_name not in names_in(compiled)
        text = compiled.library.get_llvm_str()
        assert part.fndesc.llvm_func_name in text and "NRT_incref" not in text


def names_in(compiled):
    """Names of the functions whose machine code the library of a function has."""
    return {function.name for function in compiled.library.get_defined_functions()}
