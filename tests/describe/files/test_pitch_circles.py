"""Gears by radii whose axes are elsewhere: a remark with both distances, in `symgen check` and beside every result."""

import pytest

import symgen

GEARS = """
[mechanism]
name = "gears"
[parameters]
r = 0.2
{carrier}
[bodies.a]
mass = 1.0
inertia = 0.01
position = [0.0, 0.0]
[bodies.b]
mass = 1.0
inertia = 0.02
position = [{apart}, 0.0]
[joints.left]
type = "revolute"
between = ["{holder}", "a"]
at = [[0.0, 0.0], "centre"]
[joints.right]
type = "revolute"
between = ["b", "{holder}"]
at = ["centre", [{apart}, 0.0]]
[joints.teeth]
type = "gear"
between = ["a", "b"]
carrier = "{holder}"
{keys}
"""
ARM = """[bodies.arm]
mass = 1.0
inertia = 0.1
[joints.hub]
type = "revolute"
between = ["ground", "arm"]
at = [[0.0, 0.0], [0.0, 0.0]]
"""


@pytest.mark.parametrize("holder", ["ground", "arm"])
@pytest.mark.parametrize(
    ("apart", "keys", "touch"),
    [
        (0.3, 'radii = [0.1, "r"]', ""),
        (0.30001, 'radii = [0.1, "r"]', ""),  # radii are often rounded
        (0.5, 'radii = [0.1, "r"]', "0.3"),
        (0.1, 'radii = ["r", 0.3]\nmesh = "internal"', ""),
        (0.5, 'radii = ["r", 0.3]\nmesh = "internal"', "0.1"),
        (0.5, "ratio = 2.0", ""),
    ],
)
def test_axes_that_are_elsewhere_are_told(holder, apart, keys, touch, tmp_path):
    carrier = "" if holder == "ground" else ARM
    (path := tmp_path / "gears.toml").write_text(GEARS.format(apart=apart, keys=keys, holder=holder, carrier=carrier))
    model = symgen.load(path)
    if not touch:
        assert model.remarks == ()
        return
    (remark,) = model.remarks
    assert remark.startswith(
        f"joints.teeth.radii: the axes are {apart} m apart, and the pitch circles touch at {touch} m"
    )
    assert remark in model.simulate(until=0.01).notes
