"""Numbers of quantities over time, against the histories of the same runs."""

import numpy as np
import pytest

import symgen
from symgen.study.ensemble.time_statistics import FUNCTIONS, split_statistic

VARIED = {"crank_mass": "lin(1, 3, 4)"}
TIMES = {"until": 0.3, "output_step": 0.01}
#: By NumPy and the rule of the trapezoid, written anew.
BY_HAND = {
    "max": lambda x: x.max(axis=1),
    "min": lambda x: x.min(axis=1),
    "range": lambda x: x.max(axis=1) - x.min(axis=1),
    "mean": lambda x: (x[:, 1:] + x[:, :-1]).sum(axis=1) / (2 * (x.shape[1] - 1)),
    "rms": lambda x: np.sqrt(((x**2)[:, 1:] + (x**2)[:, :-1]).sum(axis=1) / (2 * (x.shape[1] - 1))),
    "peak": lambda x: np.maximum(x.max(axis=1), -x.min(axis=1)),
}


@pytest.mark.slow_cases("{'coordinates': 'joint'}", "{'integrator': 'rk4', 'target': 'lanes'}")
@pytest.mark.parametrize("more", [{}, {"coordinates": "joint"}, {"integrator": "rk4", "target": "lanes"}], ids=str)
def test_each_run_leaves_numbers_of_its_history(more):
    quantities = ("crank.omega", "A.F", "energy.kinetic")
    asked = [f"{function}({name})" for name in quantities for function in FUNCTIONS]
    histories = symgen.sweep("four-bar", VARIED, quantities=quantities, **TIMES, **more)
    numbers = symgen.sweep("four-bar", VARIED, quantities=[*asked, "crank.theta"], **TIMES, **more)
    assert set(FUNCTIONS) == set(BY_HAND) and numbers.values.shape == (4, len(asked) + 1, 1)
    for name in quantities:
        for function, by_hand in BY_HAND.items():
            right = by_hand(histories[name])
            assert np.allclose(numbers[f"{function}({name})"][:, 0], right, rtol=1e-13, atol=0.0)


def test_they_have_units_and_columns_in_tables(tmp_path):
    study = symgen.sweep("four-bar", VARIED, quantities=["max(A.F)", "crank.theta"], **TIMES)
    study.save(tmp_path / "runs.csv")
    lines = (tmp_path / "runs.csv").read_text().splitlines()
    assert "max(A.F) [N]" in lines[0] and "crank.theta [rad]" in lines[0] and len(lines) == 1 + 4
    assert study.to_xarray()["max(A.F)"].attrs["units"] == "N"
    with pytest.raises(symgen.InputError, match=r"keeps histories or ends of quantities, got 'max\(A.F\)'"):
        study.sensitivities(["crank_mass"])


@pytest.mark.slow
def test_runs_that_an_event_ends_count_up_to_it_and_failed_ones_leave_nothing():
    ended = symgen.sweep(
        "pendulum", {"bob.vy": [0.0]}, quantities=["min(bob.y)"], until=1.0, output_step=0.01, stop_when="bob.y + 0.5"
    )
    assert -0.5 <= ended["min(bob.y)"][0, 0] < -0.45 and ended.status[0] == "ok"
    settings = {"method": "lagrange", "integrator": "rk4", "step": 0.05, "max_violation": 1e-12}
    failed = symgen.sweep("pendulum", {"bob.vy": [0.0]}, quantities=["min(bob.y)"], until=1.0, **settings)
    assert np.isnan(failed["min(bob.y)"]).all() and failed.status[0] == "failed"


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("mx(bob.x)", r"quantity 'mx\(bob.x\)': expected max, min, .* got 'mx'; did you mean 'max'\?"),
        ("max(bob.xx)", "quantity 'bob.xx': expected a quantity of pendulum, got none of that name"),
    ],
)
def test_a_wrong_name_is_one_sentence(name, sentence):
    with pytest.raises(symgen.InputError, match=sentence):
        symgen.sweep("pendulum", {"bob.vy": [0.0]}, quantities=[name])


def test_parts_of_a_name():
    assert split_statistic("max(ram.effort)") == ("max", "ram.effort") and split_statistic("ram.effort") == (
        "",
        "ram.effort",
    )
