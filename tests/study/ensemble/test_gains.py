"""Sweeps over parameters of the method: every row is the single run with that option, bit for bit."""

import pytest

import symgen
from symgen.base.errors import InputError

GAINS = [1.0, 5.0, 20.0]
STOP = {"low": {"when": "crank.theta > 1.02", "action": "stop"}}


@pytest.mark.parametrize(
    ("coordinates", "events"), [("absolute", {}), ("joint", {}), ("joint", STOP)], ids=["absolute", "joint", "stopped"]
)
def test_a_row_is_the_run_with_that_option(coordinates, events):
    common = {"method": "baumgarte", "integrator": "rk4", "step": 2e-3, "until": 0.1, "events": events}
    common["coordinates"] = coordinates
    varied = {"method.alpha": GAINS, "method.beta": GAINS}
    found = symgen.sweep("four-bar", runs=varied, **common)
    for row, gain in enumerate(GAINS):
        options = {"method.alpha": gain, "method.beta": gain}
        single = symgen.simulate("four-bar", options=options, shape="straight", **common)
        assert found["crank.theta"][row, 0] == single["crank.theta"][-1]
        assert found["rocker.omega"][row, 0] == single["rocker.omega"][-1]
    assert len({*found["rocker.omega"][:, 0]}) == 3  # the gains tell


@pytest.mark.parametrize(
    ("vary", "sentence"),
    [
        ({"method.alpa": GAINS}, r"a parameter of the method, .*did you mean 'method.alpha'\?"),
        ({"method.solver": GAINS}, "a parameter of the method, which is a number"),
        ({"method.beta": GAINS}, "one way of giving it a value, got two"),
        ({"method.alpha": [-1.0, 1.0]}, "vary 'method.alpha': expected at least 0, got -1"),
    ],
)
def test_what_cannot_vary(vary, sentence):
    with pytest.raises(InputError, match=sentence):
        symgen.sweep("four-bar", vary, method="baumgarte", options={"method.beta": 3.0})


def test_it_is_named_in_files(tmp_path):
    found = symgen.sweep("pendulum", {"method.alpha": GAINS}, method="baumgarte", until=0.1)
    assert found.save(tmp_path / "a.csv").read_text(encoding="utf-8").startswith("run,method.alpha,t [s],")
    assert found.to_xarray()["method.alpha"].values.tolist() == GAINS
