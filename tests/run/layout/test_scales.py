"""Mechanisms with rows in metres and in radians, in very small and very large units of length."""

from importlib.resources import files

import numpy as np
import pytest

from benchmarks.rescale import Units, rescaled
from symgen.api import load

#: A light lever on a universal joint carries a body on a pin: rows of all kinds on a light body. Rows of an axis along
#: one of the body would be eliminated with its velocities, and lightness would spoil nothing.
LIGHT = """
[mechanism]
name = "light"
space = "spatial"
gravity = [0.0, 0.0, -9.81]
[bodies.lever]
mass = 1e-8
inertia = [1e-9, 1.2e-9, 1.5e-9]
position = [0.3, 0.1, 0.0]
[bodies.load]
mass = 1.3
inertia = [0.19, 0.34, 0.33]
position = [0.7, 0.4, 0.2]
angular_velocity = [0.4, -0.3, 0.7]
[joints.hook]
type = "universal"
between = ["ground", "lever"]
at = [[0.0, 0.0, 0.0], [-0.3, -0.1, 0.0]]
axes = [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]
[joints.pin]
type = "revolute"
between = ["lever", "load"]
at = [[0.4, 0.3, 0.2], [0.0, 0.0, 0.0]]
axis = [0.6, 0.0, 0.8]
[forces.wind]
type = "torque"
body = "lever"
torque = ["-0.6*load.wx", "0.1*load.wy", "0.3"]
"""


def in_units(tmp_path, text, length):
    """Return a mechanism whose unit of length is smaller by a factor."""
    path = tmp_path / f"{length:g}.toml"
    path.write_text(rescaled(text, Units(length, 1.0, 1.0)), encoding="utf-8")
    return load(path)


def brought_back(table, length):
    """Return a table of a result with lengths, and multipliers of angles, in metres."""
    powers = {"m": 1, "m/s": 1, "m/s^2": 1, "N": 1, "N m": 2}
    return np.asarray(table) / length ** np.array([powers.get(unit, 0) for unit in table.units])


def of_catalogue(name):
    """Return the text of a file of the catalogue."""
    return (files("symgen.describe.catalogue") / f"{name}.toml").read_text(encoding="utf-8")


def check_alike(tmp_path, text, length, tables, **settings):
    """Run a mechanism in metres and in another unit; the results are alike."""
    here, there = (in_units(tmp_path, text, x).simulate(**settings) for x in (1.0, length))
    assert here.status == there.status == "ok", (here.reason, there.reason)
    assert here.rank == there.rank
    for name in tables:
        expected, found = np.asarray(getattr(here, name)), brought_back(getattr(there, name), length)
        scale = np.abs(expected).max()
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-6 * scale)
    return here


@pytest.mark.parametrize("length", [2.0**-20, 2.0**20])
def test_a_guide_and_pins(tmp_path, length):
    """The guide's row is an angle, the pins' are lengths: they meet where velocities are completed."""
    check_alike(tmp_path, of_catalogue("slider-crank"), length, ("q", "v", "lam"), until=1e-2, step=1e-3)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("length", [2.0**-10, 2.0**10])
def test_redundant_rows_and_their_reactions(tmp_path, length):
    """Rank, the rows that are left out, and multipliers of least norm."""
    found = check_alike(tmp_path, of_catalogue("bricard"), length, ("q", "v", "lam"), until=1e-2, step=1e-3)
    assert found.rank.rank == 29 and len(found.rank.redundant_rows) == 1


@pytest.mark.slow
@pytest.mark.parametrize("length", [2.0**-20, 2.0**20])
def test_light_bodies(tmp_path, length):
    """What is added to M, where light bodies spoil the elimination, suits rows of both kinds."""
    found = check_alike(tmp_path, LIGHT, length, ("q", "v", "lam"), until=0.1, step=1e-3, shape="straight")
    assert any("light bodies" in note for note in found.notes)
