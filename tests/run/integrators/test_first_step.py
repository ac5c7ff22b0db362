"""The first step of adaptive runs, from starts that are 0 but for rounding."""

from __future__ import annotations

from pathlib import Path

import pytest

import symgen

FALL = """
[mechanism]
name = "pushed"
[run]
until = 1.0
step = 1e-2
[bodies.mass]
mass = 2.0
inertia = 0.1
position = [POSITION, 0.0]
[forces.push]
type = "force"
body = "mass"
force = [3.0, 0.0]
"""


@pytest.mark.parametrize("integrator", ["dop853", "dopri5"])
@pytest.mark.parametrize("position", [0.0, 1e-17, 1e-16, 3e-15, 1e-12])
def test_coordinates_that_are_rounding_do_not_decide(integrator: str, position: float, tmp_path: Path) -> None:
    """From rest, x = F / (2 m) t^2; what assembling leaves of a coordinate is no size that a motion has."""
    file = tmp_path / "pushed.toml"
    file.write_text(FALL.replace("POSITION", repr(position)), encoding="utf-8")
    result = symgen.load(file).simulate(method="lagrange", integrator=integrator, rtol=1e-10, atol=1e-12)
    assert result.status == "ok", result.reason
    assert abs(result.q["mass.x"][-1] - position - 0.75) < 1e-12  # the absolute tolerance: the motion is a parabola
    assert result.steps < 30
