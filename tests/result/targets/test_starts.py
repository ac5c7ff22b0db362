"""Starts in C are those of runs, printed from their source: closed positions, velocities, rows left out."""

import subprocess

import numpy as np
import pytest

from result.targets.compilers import called, compiled, written
from symgen import Settings, load
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import prepare


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("name", ["four-bar", "driven-four-bar", "spatial-slider-crank", "rolling-disc", "wiper"])
def test_a_start_is_that_of_a_run(name, coordinates, tmp_path):
    mechanism = load(name).mechanism
    run = prepare(mechanism, Settings(coordinates=coordinates, shape="straight"), Purpose.STATE)
    library = called(written(mechanism, tmp_path, coordinates=coordinates))
    y = np.zeros(run.compiled.info.ny)
    assert library.begin(y, np.zeros(1000)) == 0
    np.testing.assert_allclose(y[: run.compiled.info.work], run.start.y[: run.compiled.info.work], rtol=0, atol=1e-13)


@pytest.mark.slow
def test_code_is_small(tmp_path):
    """With the start of runs, at -Os [bytes]; the gate is 45 kB."""
    written(load("four-bar").mechanism, tmp_path)
    built = compiled(tmp_path, "-Os", "-c", output="four_bar.o", files=[tmp_path / "four_bar.c"])
    lines = subprocess.run(["size", str(built)], capture_output=True, text=True, check=True)
    assert int(lines.stdout.splitlines()[1].split()[0]) < 30_000
