"""Emitted C and FMUs move modal bodies as a run with the same steps does."""

import numpy as np
import pytest

import symgen
from tests.result.targets.compilers import compiled, written
from tests.result.targets.test_c import rows_of
from tests.result.targets.test_fmu import fmu_of, simulated

STEP = 1e-5
OWN = {"method": "direct-correction", "integrator": "rk4", "step": STEP, "shape": "straight", "verify": False}


@pytest.fixture(scope="module")
def lever():
    return symgen.load("curved-lever")


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_program_in_c_ends_where_the_run_does(lever, tmp_path):
    names, rows = rows_of(compiled(written(lever.mechanism, tmp_path, coordinates="absolute")), "0.05")
    result = lever.simulate(until=0.05, **OWN)
    end = np.concatenate([result.q.values[-1], result.v.values[-1]])
    assert "lever.m7" in names and "lever.vm7" in names
    np.testing.assert_allclose(rows[-1, 1 : len(end) + 1], end, rtol=1e-10, atol=1e-12)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_an_fmu_has_the_stress_of_the_run(lever, tmp_path):
    fmu = fmu_of(lever, tmp_path / "lever.fmu")
    names = ["lever.m1", "lever.vm7", "peak"]
    rows = simulated(fmu, "CoSimulation", 0.02, outputs=names)
    result = lever.simulate(until=0.02, output_step=0.002, **OWN)
    for name in names:
        scale = np.abs(result[name]).max()
        np.testing.assert_allclose(rows[name], result[name], atol=1e-9 * scale)
