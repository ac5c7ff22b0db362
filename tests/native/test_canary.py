"""Fails with a clear sentence when a new version of Numba changed what `symgen.native` stands on."""

from __future__ import annotations

import numba
import pytest
from numba.core.codegen import JITCPUCodegen
from numba.core.registry import cpu_target

from symgen.native import internals, machine


def test_the_internals_of_numba_are_as_expected():
    problems = internals.changed()
    assert not problems, f"Numba {numba.__version__} changed; adapt symgen/native: " + "; ".join(problems)


def test_what_is_missing_or_takes_other_arguments_is_named(monkeypatch):
    odd = ((JITCPUCodegen, "gone", ["self"]), (JITCPUCodegen, "magic_tuple", ["self", "more"]))
    monkeypatch.setattr(internals, "_NEEDED", odd)
    monkeypatch.setattr(internals, "_OF_THE_COMPILER", ("_tm", "_gone"))
    assert internals.changed() == [
        "JITCPUCodegen has no 'gone' any more",
        "JITCPUCodegen.magic_tuple should take (self, more), but takes (self)",
        "the compiler has no '_gone' any more",
    ]


def test_another_calling_convention_is_seen(monkeypatch):
    monkeypatch.setattr(internals, "_CONVENTION", "void ()")
    (problem,) = internals.changed()
    assert problem.startswith("functions should be called as void (), but are called as i32 (")


@pytest.mark.parametrize("name", ["BOUNDSCHECK", "DEBUGINFO_DEFAULT"])
def test_nothing_is_made_from_the_source_where_numba_is_asked_to_check(monkeypatch, name):
    monkeypatch.setattr(internals.config, name, 1)
    assert not internals.usable.__wrapped__()
    monkeypatch.setattr(internals.config, name, 0)
    assert internals.usable.__wrapped__()


def test_machine_code_is_for_the_processor_that_numba_compiles_for():
    # The address of a function of the text, called in C's convention, is all that loading gives.
    text = 'define i64 @"symgen.test.seven"() {\n  ret i64 7\n}\n'
    assert cpu_target.target_context.codegen() is machine.codegen()
    (address,) = machine.load(machine.compiled(text, "symgen.test.seven"), ["symgen.test.seven"]).values()
    assert address > 0
    with pytest.raises(RuntimeError):
        machine.compiled("define nonsense", "f")
