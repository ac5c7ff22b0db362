"""Both shapes compute the same: every emitted function, every method, on every kind of joint and force.

The two routes share the derivation of a measure and nothing behind it: instances, tables, order of sums, factorisations
on panels and the formulas of laws are written twice. A process in which nothing is compiled evaluates all cases.
"""

import json
import os
import subprocess
import sys
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from support.emitted import mechanism_of
from support.models import parallelogram
from support.rotation import of_turn

from symgen.api import load
from symgen.derive.lower.looped.forms import form_key
from symgen.derive.methods import METHODS
from symgen.derive.methods._base import EXPLICIT_FORMS
from symgen.describe import catalogue

TESTS = Path(__file__).resolve().parents[1]
#: Where rows depend on each other, pivots near the threshold divide rounding.
TOLERANCE = {"parallelogram": 2e-9, "bricard": 5e-8}
#: There, one iteration of a correction more or less.
COUNTS = 0.2


#: A small one; slow are those that have every kind of element, and the other entries of the catalogue, by turns.
FAST = "slider-crank"
OWN = ("four-bar", "spatial-slider-crank", "chain:3", "everything", "geared", "reading", "rough", "parallelogram")
OWN += ("spatial", "spatial-geared")
OTHERS = (*OWN, "n-four-bar:3", *(name for name in catalogue.names() if name not in (FAST, *OWN)))
OF_TURN = of_turn(OTHERS, 12)
MECHANISMS = [FAST, *(pytest.param(name, marks=pytest.mark.slow) for name in OF_TURN)]


def of_all(module: str, mechanism: str = FAST) -> dict[str, dict[str, float]]:
    """Return the differences of a mechanism and those that share its process."""
    if mechanism == FAST:
        return differences(module, (FAST,))
    return differences(module, tuple(f"-{name}" for name in (FAST, *OTHERS) if name not in OF_TURN))


@cache
def differences(module: str, words: tuple[str, ...]) -> dict[str, dict[str, float]]:
    """Run a module in a process in which nothing is compiled; return the differences, which it writes."""
    path = os.pathsep.join([str(TESTS), str(TESTS.parent), os.environ.get("PYTHONPATH", "")])
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1", "PYTHONPATH": path}
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-m", module, *words],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    found: dict[str, dict[str, float]] = json.loads(done.stdout)
    return found


@pytest.mark.slow
@pytest.mark.parametrize("mechanism", MECHANISMS)
def test_every_function_of_every_method_agrees(mechanism):
    plain = of_all("support.both_shapes", mechanism)
    cases = {case: found for case, found in plain.items() if case.split()[0] == mechanism}
    methods = {case.split()[1] for case in cases}
    assert {"lagrange", "direct-correction", "penalty", "mass-orthogonal-projection"} <= methods
    tolerance = TOLERANCE.get(mechanism, 5e-10)
    apart = {
        f"{case}: {quantity}": size
        for case, found in cases.items()
        for quantity, size in found.items()
        if not size <= (COUNTS if quantity == "counters" and mechanism in TOLERANCE else tolerance)
    }
    assert not apart


@pytest.mark.slow
def test_every_method_has_loops_or_says_why_not():
    covered = {case.split()[1] for case in of_all("support.both_shapes")}
    for name in METHODS.names:
        method = METHODS.get(name)
        assert (name in covered) != bool(method.dense or not EXPLICIT_FORMS & set(method.forms)), name


@pytest.mark.slow
@pytest.mark.parametrize("mechanism", MECHANISMS)
def test_residuals_and_their_jacobians_agree(mechanism):
    plain_forms = of_all("support.both_forms", mechanism)
    cases = {case: found for case, found in plain_forms.items() if case.split()[0] == mechanism}
    assert "ggl" in {case.split()[1] for case in cases}
    apart = {
        f"{case}: {quantity}": size
        for case, found in cases.items()
        for quantity, size in found.items()
        if not size <= 1e-12
    }
    assert not apart


@pytest.mark.slow
def test_every_level_of_a_descriptor_form_is_covered():
    covered = {case.split()[1] for case in of_all("support.both_forms")}
    with_form = {name for name in METHODS.names if any(form.startswith("index") for form in METHODS.get(name).forms)}
    assert covered <= with_form
    # the others ask for the same constraints as one of these
    keys = {form_key(METHODS.get(name), METHODS.get(name).complete_options({})) for name in covered}
    assert {form_key(METHODS.get(name), METHODS.get(name).complete_options({})) for name in with_form} == keys


@pytest.mark.slow_cases("mass")
@pytest.mark.parametrize("weight", ["identity", "mass"])
def test_compiled_runs_agree(weight):
    model = load("slider-crank")
    settings = {"options": {"method.weight": weight}, "until": 0.5, "integrator": "rk4", "step": 1e-3}
    straight, looped = (model.simulate(**settings, shape=shape) for shape in ("straight", "looped"))
    assert (straight.shape, looped.shape) == ("straight", "looped")
    assert (straight.steps, straight.evaluations) == (looped.steps, looped.evaluations)
    for table in ("q", "v", "a", "lam", "joint_coordinates", "reactions"):
        values = getattr(straight, table).values
        assert getattr(looped, table).names == getattr(straight, table).names
        np.testing.assert_allclose(
            getattr(looped, table).values,
            values,
            rtol=0.0,
            atol=1e-9 * max(1.0, float(np.abs(values).max(initial=0.0))),
        )
    assert looped.position_violation_max < 1e-12


@pytest.mark.by_turns(3)
@pytest.mark.parametrize(
    ("mechanism", "method", "settings"),
    [
        ("four-bar", "ggl", {"integrator": "radau5", "rtol": 1e-8, "until": 0.3}),
        *(
            pytest.param(*case, marks=pytest.mark.slow)
            for case in (
                ("slider-crank", "penalty", {"integrator": "sdirk", "rtol": 1e-6, "until": 0.2}),
                ("spherical-double-pendulum", "generalized-alpha", {"step": 1e-3, "until": 0.1}),
                ("parallelogram", "index3-augmented-lagrangian", {"step": 1e-3, "until": 0.1}),
            )
        ),
    ],
)
def test_compiled_implicit_runs_agree(mechanism, method, settings):
    model = load(mechanism_of(parallelogram()) if mechanism == "parallelogram" else mechanism)
    straight, looped = (model.simulate(method=method, shape=shape, **settings) for shape in ("straight", "looped"))
    assert (straight.shape, looped.shape) == ("straight", "looped")
    assert straight.status == looped.status == "ok" and straight.steps == looped.steps
    for table in ("q", "v"):
        found, expected = getattr(looped, table).values, getattr(straight, table).values
        scale = max(1.0, float(np.abs(expected).max()))
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-9 * scale)
