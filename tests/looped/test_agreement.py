"""Both shapes compute the same: every emitted function, every method, on every kind of joint and force.

The two routes share the derivation of a measure and nothing behind it: instances, tables, order of sums, factorisations
on panels and the formulas of laws are written twice. A process in which nothing is compiled evaluates all cases.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from symgen import catalogue
from symgen.api import load
from symgen.methods import METHODS

TESTS = Path(__file__).resolve().parents[1]
#: Where rows depend on each other, pivots near the threshold divide rounding.
TOLERANCE = {"parallelogram": 2e-9, "bricard": 2e-9}


@pytest.fixture(scope="module")
def plain() -> dict[str, dict[str, float]]:
    """Differences of all cases, from functions that run as plain Python."""
    path = os.pathsep.join([str(TESTS), str(TESTS.parent), os.environ.get("PYTHONPATH", "")])
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1", "PYTHONPATH": path}
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-m", "support.both_shapes"],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    found: dict[str, dict[str, float]] = json.loads(done.stdout)
    return found


@pytest.mark.parametrize(
    "mechanism", [*catalogue.names(), "n-four-bar:3", "chain:3", "everything", "rough", "parallelogram", "spatial"]
)
def test_every_function_of_every_method_agrees(plain, mechanism):
    cases = {case: found for case, found in plain.items() if case.split()[0] == mechanism}
    methods = {case.split()[1] for case in cases}
    assert {"lagrange", "direct-correction", "penalty", "mass-orthogonal-projection"} <= methods
    tolerance = TOLERANCE.get(mechanism, 5e-10)
    apart = {
        f"{case}: {quantity}": size
        for case, found in cases.items()
        for quantity, size in found.items()
        if not size <= tolerance
    }
    assert not apart


def test_every_method_has_loops_or_says_why_not(plain):
    covered = {case.split()[1] for case in plain}
    for name in METHODS.names:
        method = METHODS.get(name)
        assert (name in covered) != bool(method.dense or not {"ode", "one-step"} & set(method.forms)), name


@pytest.mark.parametrize("weight", ["identity", "mass"])
def test_compiled_runs_agree(weight):
    model = load("slider-crank")
    settings = {"options": {"method.weight": weight}, "until": 0.5, "step": 1e-3}
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
