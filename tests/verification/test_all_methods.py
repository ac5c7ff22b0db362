"""All methods on five mechanisms: ranks by the fastest run within an error, counts by status."""

import json

import pytest

from benchmarks import all_methods
from benchmarks.all_methods import Job, ends, examine, shortest, suitable, times, times_by_turns
from benchmarks.records import shortened


def test_methods_are_ranked_by_the_fastest_run_within_an_error(tmp_path, monkeypatch):
    def run(seconds, error, status="ok", integrator="rk4"):
        return (integrator, 1e-3, status, error, seconds)

    runs = {"lagrange": [run(2.0, 1e-9), run(1.0, 1e-7)], "baumgarte": [run(3.0, 1e-9)]}
    runs |= {"penalty": [run(0.5, 1e-2)], "ggl": [run(0.1, None, "failed")]}
    monkeypatch.setattr("benchmarks.records.FOLDER", tmp_path)
    monkeypatch.setattr(all_methods, "MECHANISMS", ("pendulum",))
    (tmp_path / "all_methods.jsonl").write_text(json.dumps({"mechanism": "pendulum", "runs": runs}), encoding="utf-8")
    assert {name: run.seconds for name, run in shortest("pendulum").items()} == {"lagrange": 1.0, "baumgarte": 3.0}
    assert times().measured() == [["`lagrange`", "1"], ["`baumgarte`", "3"]]
    assert ends().measured() == [["`pendulum`", "5", "4", "0", "1", "1 with `rk4`; at most 1.0e-2 m"]]
    assert any("`penalty`" in claim and "`lagrange`" not in claim for claim in times().claims())


def test_times_are_ratios_in_turns_times_that_of_the_yardstick():
    """While the row was measured, other work made it and its yardstick 1.9 times slower."""

    def row(method, seconds, ratio, step=1e-3):
        setting = {"integrator": "rk4", "step": step, "rtol": None}
        return {"method": method, "run_seconds": seconds, "cost_ratio": ratio, **setting}

    rows = [
        row("lagrange", 1.0, 1.0),
        row("baumgarte", 2.09, 1.1),
        row("ggl", 9.0, None),
        row("penalty", 3.0, 1.5, 2.0),
    ]
    assert times_by_turns(rows) == pytest.approx([1.0, 1.1, 9.0, 3.0])


@pytest.mark.slow
def test_a_method_runs_with_the_three_integrators_or_with_its_own():
    assert suitable("lagrange") == ("rk4", "dop853", "picard")
    assert suitable("hamiltonian-baumgarte") == ("rk4", "dop853") and not suitable("ggl")
    runs = shortened(examine(Job("pendulum"), ("lagrange", "rattle"))["runs"])
    assert {run[0] for run in runs["lagrange"]} == {"rk4", "dop853", "picard"}
    assert {run[0] for run in runs["rattle"]} == {"rattle"}
    assert all(run[3] < 1.0 for method in runs for run in runs[method])
