"""Forces that jump or bend where the state passes something: nobody knows beforehand when, so steps have to see it."""

from __future__ import annotations

import math

import numpy as np
import pytest

import symgen

#: Two kilograms that are pushed harder behind a line, beside an oscillation that has steps of usual length.
LINE = """[mechanism]
name = "line"
gravity = [0.0, 0.0]
[parameters]
line = 0.3
[bodies.bob]
type = "point"
mass = 2.0
position = [0.0, 0.5]
velocity = [0.5, 0.0]
[forces.push]
type = "force"
body = "bob"
force = ["3 if bob.x < line else 7", "-400*bob.y"]
[outputs]
before = "integral(1 if bob.x < line else 0)"
"""
TIMES = np.linspace(0.05, 0.8, 16)


@pytest.fixture(scope="module")
def line(tmp_path_factory: pytest.TempPathFactory) -> symgen.Model:
    file = tmp_path_factory.mktemp("jumps") / "line.toml"
    file.write_text(LINE, encoding="utf-8")
    return symgen.load(file)


@pytest.mark.slow_cases("abm")
@pytest.mark.parametrize("integrator", ["abm", "dop853", "dopri5", "picard", "radau5", "sdirk"])
def test_forces_that_jump_behind_a_line(line: symgen.Model, integrator: str) -> None:
    """Outputs of steps that were refused afterwards stayed, and no stage of `sdirk` lies in its first quarter.

    They were off by 4e-3 and 1e-3 m/s, and `ok`.
    """
    for place in np.linspace(0.021, 0.69, 12):
        result = line.simulate(
            method="lagrange", integrator=integrator, rtol=1e-8, times=TIMES, until=0.8, parameters={"line": place}
        )
        met = (math.sqrt(0.25 + 3.0 * place) - 0.5) / 1.5
        behind, speed = np.maximum(TIMES - met, 0.0), 0.5 + 1.5 * np.minimum(TIMES, met)
        before = np.minimum(TIMES, met)
        assert result.status == "ok", result.reason
        np.testing.assert_allclose(result["bob.vx"], speed + 3.5 * behind, rtol=0.0, atol=1e-5)
        x = 0.5 * before + 0.75 * before**2 + speed * behind + 1.75 * behind**2
        np.testing.assert_allclose(result["bob.x"], x, rtol=0.0, atol=1e-5)
        np.testing.assert_allclose(result["before"], before, rtol=0.0, atol=1e-5)


@pytest.mark.parametrize("integrator", ["abm", "sdirk"])
def test_largest_errors_are_those_of_accepted_steps(line: symgen.Model, integrator: str) -> None:
    """Energies at outputs of refused steps were off by more than 1e-6 J."""
    for place in np.linspace(0.021, 0.69, 12):
        result = line.simulate(
            method="lagrange",
            integrator=integrator,
            rtol=1e-8,
            times=np.linspace(0.0, 0.8, 801),
            until=0.8,
            parameters={"line": place},
        )
        assert result.energy_drift_max < 1e-6, place
