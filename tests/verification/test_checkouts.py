"""Operations of a checkout's emitted code: sums over the functions that a step calls."""

import re

import pytest

from benchmarks.checkouts import ROOT, counted


def named(module, function):
    """The operations that a function of the checked-in four-bar names in its docstring."""
    text = (ROOT / "generated" / "four_bar" / f"{module}.py").read_text(encoding="utf-8")
    return int(re.search(rf'^def {function}\(.*\n    """.*: (\d+) operations', text, re.M)[1])


@pytest.mark.slow
def test_a_step_has_the_operations_of_the_functions_that_it_calls():
    """A correction has one round; without rows nothing is corrected, and energies are measured."""
    law = "direct_correction"
    parts = [("model", "geometry"), (law, "drift"), (law, "spread"), ("model", "measure")]
    found = counted(ROOT, "four-bar", "direct-correction", "absolute")
    assert found == (named(law, "rhs"), sum(named(*part) for part in parts))
    assert counted(ROOT, "free-rigid-body", "direct-correction", "absolute")[1] < 40
