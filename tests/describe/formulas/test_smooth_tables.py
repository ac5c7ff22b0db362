"""Tables of smooth pieces: value, slope and second derivative against SciPy's splines."""

import copy

import numpy as np
import pytest
from support.curves import curve

from symgen.base.errors import InputError
from symgen.base.ir.derivative import jacobian
from symgen.base.ir.graph import Graph
from symgen.base.ir.program import table_of_payload
from symgen.describe.facts.digest import digest
from symgen.describe.files.builder import MechanismBuilder, to_toml
from symgen.describe.files.validate import validate
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.formulas.parser import FormulaNames, parse
from symgen.describe.table_functions import Table

KINDS = [("cubic", False), ("cubic", True), ("pchip", False), ("pchip", True)]


def points(seed, n, periodic):
    random = np.random.default_rng(seed)
    x, y = np.sort(random.uniform(-3.0, 5.0, n)), random.normal(size=n)
    if periodic:
        y[-1] = y[0]
    return tuple(x.tolist()), tuple(y.tolist())


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize(("how", "periodic"), KINDS)
@pytest.mark.parametrize("n", [4, 5, 40])
def test_values_and_derivatives_are_those_of_scipy(how, periodic, n):
    """Inside, at the points, beyond the ends; rounding is that of coefficients as large as the second derivative."""
    for seed in range(5):
        x, y = points(seed, n, periodic)
        found = Table("f", x, y, how, periodic).interpolated
        at = np.concatenate([np.linspace(x[0] - 4.0, x[-1] + 4.0, 101), x if not periodic else x[1:-1]])
        for order in range(4):
            expected = np.array([curve(x, y, how, periodic, order)(u) for u in at])
            numbers = np.array([found.value(float(u), order) for u in at])
            if order >= 2:  # at points it may jump: both sides count there
                near = np.min(np.abs(at[:, None] - np.array(x)[None, :]), axis=1) > 1e-9
                expected, numbers = expected[near], numbers[near]
            np.testing.assert_allclose(numbers, expected, rtol=1e-9, atol=1e-11 * np.abs(expected).max())


def test_two_points_of_a_pchip_are_a_line():
    found = Table("f", (1.0, 3.0), (2.0, 6.0), "pchip").interpolated
    assert [found.value(u) for u in (0.0, 1.0, 2.5, 3.0, 5.0)] == [0.0, 2.0, 5.0, 6.0, 10.0]


def test_a_cubic_table_of_a_cubic_polynomial_is_that_polynomial():
    x = np.array([0.0, 0.3, 0.7, 1.6, 2.0])
    found = Table("f", tuple(x), tuple(1.0 - x + 2.0 * x**2 - 0.5 * x**3), "cubic").interpolated
    for u in np.linspace(0.0, 2.0, 33):
        assert found.value(u) == pytest.approx(1.0 - u + 2.0 * u**2 - 0.5 * u**3, abs=1e-14)
        assert found.value(u, 2) == pytest.approx(4.0 - 3.0 * u, abs=1e-12)
        assert found.value(u, 3) == pytest.approx(-3.0, abs=1e-11)


def test_in_formulas_and_on_the_graph():
    table = Table("f", *points(3, 6, False), "cubic")
    names = FormulaNames("a formula", {"a": "a"}, tables={"f": table.function})
    tree = parse("2*f(a)", names, "test")
    assert evaluate_formula(tree, {"a": 0.4}, tables={"f": table}) == pytest.approx(
        2.0 * curve(table.x, table.y, "cubic")(0.4)
    )
    g = Graph()
    a = g.input("q", 0)
    slope = jacobian(g, [g.call(table.function, a)], [("q", 0)])[0]["q", 0]
    second = jacobian(g, [slope], [("q", 0)])[0]["q", 0]
    third = jacobian(g, [second], [("q", 0)])[0]["q", 0]
    derived = [table_of_payload(g.nodes[n].payload) for n in (slope, second, third)]
    assert derived == [("f", "slope"), ("f", "second"), ("f", "third")]
    assert jacobian(g, [third], [("q", 0)])[0] == {}  # it is constant between points
    straight = jacobian(g, [g.call("table:f'", a)], [("q", 0)])[0]
    assert straight == {}  # the slope of straight lines has none


GOOD = {
    "mechanism": {"name": "cam"},
    "tables": {"cam": {"x": [0.0, 1.0, 2.0, 3.0, 4.0], "y": [0.0, 1.0, 0.5, 0.2, 0.0], "interpolation": "cubic"}},
    "bodies": {"block": {"mass": 1.0, "inertia": 1.0}},
    "joints": {"lift": {"type": "driver", "body": "block", "coordinate": "y", "value": "cam(2*t)"}},
}


def changed(keys, joint=None):
    raw = copy.deepcopy(GOOD)
    raw["tables"]["cam"] |= keys
    raw["joints"]["lift"] |= joint or {}
    return raw


def test_round_trip_and_digest():
    mechanism = validate(GOOD, "cam.toml")
    assert mechanism.tables[0] == Table("cam", (0.0, 1.0, 2.0, 3.0, 4.0), (0.0, 1.0, 0.5, 0.2, 0.0), "cubic")
    assert 'interpolation = "cubic"' in to_toml(GOOD)
    builder = MechanismBuilder("cam").table("cam", **GOOD["tables"]["cam"]).body("block", mass=1.0, inertia=1.0)
    builder.joint("lift", "driver", body="block", coordinate="y", value="cam(2*t)")
    assert builder.build() == mechanism
    raw = {**GOOD, "joints": {}}
    plain = {**raw, "tables": {"cam": {k: v for k, v in GOOD["tables"]["cam"].items() if k != "interpolation"}}}
    linear = {**raw, "tables": {"cam": plain["tables"]["cam"] | {"interpolation": "linear"}}}
    assert digest(validate(plain, "")) == digest(validate(linear, "")) != digest(validate(raw, ""))


@pytest.mark.parametrize(
    ("keys", "joint", "message"),
    [
        ({"interpolation": "spline"}, {}, "cam.interpolation: expected 'linear' or 'cubic' or 'pchip', got 'spline'"),
        (
            {"x": [0.0, 1.0, 2.0], "y": [0.0, 1.0, 0.0]},
            {},
            "cam.x: expected 4 numbers or more for interpolation = 'cubic', got 3",
        ),
        (
            {"interpolation": "pchip", "x": [0.0, 1.0], "y": [0.0, 0.0], "periodic": True},
            {},
            "cam.x: expected 4 numbers or more for interpolation = 'pchip', periodic, got 2",
        ),
        (
            {"interpolation": "linear", "periodic": True},
            {},
            "cam.periodic: expected true where interpolation is 'cubic'",
        ),
        ({"periodic": 1}, {}, "cam.periodic: expected true or false, got 1"),
        (
            {"periodic": True, "y": [0.0, 1.0, 0.5, 0.2, 0.1]},
            {},
            "cam.y: expected the same value at both ends of",
        ),
        ({"x": [0.0, 1e-300, 2e-300, 3e-300, 4.0]}, {}, "cam: expected points between which curves have finite coeffi"),
        (
            {"interpolation": "pchip"},
            {},
            "the table 'cam', which has no meaning here; a motion needs two continuous derivatives, which",
        ),
        ({"interpolation": "linear"}, {}, "the table 'cam', which has no meaning here; a motion needs two continuous"),
        ({}, {"value": "cam"}, "got the function 'cam' without its argument; write cam(...)"),
        ({}, {"value": "cam(block.y)"}, "got 'block.y', which has no meaning here"),
    ],
)
def test_bad_tables_are_told_in_a_sentence(keys, joint, message):
    with pytest.raises(InputError) as caught:
        validate(changed(keys, joint), "cam.toml")
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)
