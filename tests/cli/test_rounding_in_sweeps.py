"""Rounding in sweeps is shown as 0 beside what other quantities of the unit reach."""

import re

import pytest


@pytest.mark.slow
def test_a_column_of_rounding_is_zero_beside_lengths(cli, tmp_path):
    """A block on an inclined rail: its y is 0.5 x, and x sin(a) - y cos(a) is rounding of both."""
    file = tmp_path / "ramp.toml"
    file.write_text(
        """
[mechanism]
name = "ramp"
gravity = [0.0, -9.81]

[bodies.block]
mass = 1.0
inertia = 0.1
position = [2.0, 1.0]

[joints.rail]
type = "translational"
between = ["ground", "block"]
at = [[0.0, 0.0], "centre"]
axis = [2.0, 1.0]

[outputs]
along = { value = "block.x", unit = "m" }
off = { value = "0.3*block.x - 0.6*block.y", unit = "m" }
"""
    )
    words = ("--vary", "block.vx=lin(0,1,3)", "--until", "1", "--quantity", "along,off")
    code, out, _ = cli("sweep", str(file), *words)
    assert code == 0
    assert re.search(r"^off +m +0 +0 +0\s*$", out, re.M), out
    assert re.search(r"^along +m +-?\d\.\d+ ", out, re.M), out
