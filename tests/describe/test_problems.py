"""What is wrong in a mechanism file: everything, each with its place, without what only follows."""

import pickle
import tomllib

import pytest

from symgen.base.errors import InputError
from symgen.describe import load
from symgen.describe.load import LARGEST_FILE
from symgen.describe.problems import in_line, problems
from symgen.describe.validate import errors_of, validate

GOOD = """\
[mechanism]
name = "cart"

[parameters]
mass = 2.0
half = "mass/2"
quarter = "half/2"

[tables.road]
x = [0.0, 1.0]
y = [0.0, 1.0]

[bodies.cart]
mass = "mass"
inertia = 0.1
points.hook = [
  "quarter",
  0.0,
]

[bodies.load]
mass = 1.0
inertia = 0.1

[joints.rail]
type = "translational"
between = ["ground", "cart"]
at = [[0.0, 0.0], "centre"]
axis = [1.0, 0.0]

[joints.pin]
type = "revolute"
between = ["cart", "load"]
at = ["hook", "centre"]

[joints.mesh]
type = "gear"
joints = ["pin", "wheel"]
ratio = 2.0

[joints.wheel]
type = "revolute"
between = ["ground", "load"]
at = [[0.0, 0.0], "centre"]

[forces.push]
type = "force"
body = "cart"
at = "centre"
force = ["road(cart.x)", 0.0]

[states.heat]
rate = "cart.vx"

[outputs]
"far" = "load.x"
warm = "heat"

[events.low]
when = "load.y < -1"
reset = { "load.vy" = "-load.vy" }
"""


def found(text):
    return [(problem.line, problem.where) for problem in problems(text, "cart.toml")]


def changed(*changes):
    text = GOOD
    for old, new in changes:
        assert text.count(old) == 1
        text = text.replace(old, new)
    return text


def test_nothing_is_wrong_with_a_good_file():
    assert (
        problems(
            GOOD.replace('joints = ["pin", "wheel"]', 'between = ["cart", "load"]\ncarrier = "ground"'), "cart.toml"
        )
        == ()
    )


ONE = {
    "a parameter that others need": (("mass = 2.0", 'mass = "weight"'), (5, "parameters.mass")),
    "formulas in a circle": (("mass = 2.0", 'mass = "quarter"'), (5, "parameters.mass")),
    "a key of a parameter": (("mass = 2.0", "mass = { value = 2.0, units = 'kg' }"), (5, "parameters.mass")),
    "a name": (("mass = 2.0", '"my mass" = 2.0\nmass = 2.0'), (5, "parameters")),
    "a table that a force reads": (("x = [0.0, 1.0]", "x = [1.0, 0.0]"), (10, "tables.road.x")),
    "a point over several lines": (("0.0,\n]", "0.0, 0.0,\n]"), (16, "bodies.cart.points.hook")),
    "a key that is missing": (("[bodies.load]\nmass = 1.0", "[bodies.load]"), (21, "bodies.load.mass")),
    "an unknown key": (("[bodies.load]\nmass = 1.0", "[bodies.load]\nmass = 1.0\nmas = 1.0"), (23, "bodies.load")),
    "a joint that another one needs": (('at = ["hook", "centre"]', 'at = ["hok", "centre"]'), (34, "joints.pin.at")),
    "a quoted key": (('"far" = "load.x"', '"far" = "load.q"'), (56, "outputs.far")),
    "a state that an output reads": (('rate = "cart.vx"', 'rate = "cart.vq"'), (53, "states.heat.rate")),
    "a key with a dot": (('"-load.vy"', '"-load.vz"'), (61, "events.low.reset.load.vy")),
    "an unknown section": (("[bodies.load]", "[body.load]"), (21, "")),
    "another space by its key": (('name = "cart"', 'name = "cart"\nspac = "spatial"'), (3, "mechanism")),
    "an unknown space": (('name = "cart"', 'name = "cart"\nspace = "flat"'), (3, "mechanism.space")),
    "no section of names": (('[states.heat]\nrate = "cart.vx"', "[states]\nheat = 1.0"), (53, "states.heat")),
}
