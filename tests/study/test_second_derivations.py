"""Independent equations of stress studies and comparisons: tables, and formulas with kinks."""

import numpy as np
import pytest

from symgen import load
from symgen.study.references.independent import IndependentEquations
from symgen.study.references.motion import CompiledEquations
from symgen.study.stress.study import stress


@pytest.mark.fast("engine")
@pytest.mark.parametrize("name", ["cam-follower", "engine", "scissor-lift"])
def test_both_forms_of_the_equations_are_the_same(name):
    """Tables are read, and the second slope of a kink is zero beside it."""
    mechanism, values = load(name).mechanism, load(name).parameters()
    plain, compiled = (form(mechanism, values) for form in (IndependentEquations, CompiledEquations))
    start = load(name).simulate(until=1e-6, method="lagrange", integrator="rk4", step=1e-6)
    q, v = start.q.values[-1], start.v.values[-1]
    for t in (0.0, 0.013, 9.0):  # at 9 s the ramp of the lift is over
        for a, b in zip(plain.evaluate(t, q, v), compiled.evaluate(t, q, v), strict=True):
            np.testing.assert_allclose(a, b, rtol=1e-9, atol=1e-9 * max(1.0, np.abs(a).max(initial=0.0)))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["cam-follower", "scissor-lift"])
def test_stress_judges_tables_and_kinks(name):
    study = stress(name, ["gravity"], ["lagrange"], quick=True, jobs=1)
    assert not study.unusable and {row.outcome for row in study.rows} == {"ok"}
