"""Linear systems by code that is kept: what is asked for is what is answered, whatever was asked for before."""

import pytest
from analyses import rods
from numpy.testing import assert_allclose


def reporting(formula, unit="m"):
    """A mass on a guide with a spring, which reports a formula; the name tells it from mechanisms of other tests."""
    body = {"mass": 2.0, "inertia": 0.1, "points": {"A": [0.25, 0.0]}}
    guide = {"type": "translational", "between": ["ground", "body"], "at": [[0.0, 0.0], "centre"], "axis": [1.0, 0.0]}
    ends = {"between": ["ground", "body"], "at": [[-1.0, 0.0], "A"]}
    spring = {"type": "spring-damper", **ends, "stiffness": 8.0, "free_length": 1.25}
    outputs = {"e": {"value": formula, "unit": unit}}
    return rods.model({"body": body}, {"guide": guide}, forces={"spring": spring}, outputs=outputs)


@pytest.mark.parametrize("shape", ["straight", "looped"])
def test_an_output_that_was_changed_is_reported_as_it_is_now(shape):
    """The rows of C by hand: x + 0.25, twice that, and 3 x'."""
    wanted = {"body.A.x": [1.0, 0.0], "2*body.A.x": [2.0, 0.0], "3*body.A.vx": [0.0, 3.0]}
    for formula, row in wanted.items():
        system = reporting(formula).linearise(states=("body.x",), shape=shape)
        assert system.outputs == ("e",)
        assert_allclose(system.C, [row], rtol=1e-12, atol=1e-14)
