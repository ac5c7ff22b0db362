"""Runs in joint coordinates that go on from results and files: bit for bit the run in one piece."""

import json
import pickle

import numpy as np
import pytest
import xarray as xr
from support.emitted import mechanism_of

import symgen
from run.single.test_going_on import assert_the_rest
from symgen.cli import main
from symgen.describe.catalogue import raw

STEP, FIRST, LAST = 2e-3, 12, 30
JOINT = {"coordinates": "joint", "step": STEP, "output_step": STEP}

#: A loop; one in space with a redundant row; a tree with Euler parameters in the state; a motor that moves a joint of
#: the tree; methods that remember bases and momenta, schemes that remember steps and Newton matrices.
PIECES = [
    ("four-bar", "direct-correction", "rk4"),
    ("four-bar", "augmented-hamiltonian", "rk4"),
    ("four-bar", "direct-correction", "abm4"),
    ("bricard", "direct-correction", "rk4"),
    ("spherical-double-pendulum", "lagrange", "rk4"),
    ("driven-four-bar", "direct-correction", "rk4"),
    *(
        pytest.param(*other, marks=pytest.mark.slow)
        for other in (
            ("four-bar", "null-space", "rk4"),
            ("four-bar", "coordinate-partitioning", "abm4"),
            ("four-bar", "ggl", "radau5"),
            ("spatial-slider-crank", "generalized-alpha", "generalized-alpha"),
            ("stewart-platform", "direct-correction", "rk4"),
        )
    ),
]


@pytest.mark.by_turns(4)
@pytest.mark.slow_cases(
    "bricard-direct-correction-rk4", "driven-four-bar-direct-correction-rk4", "four-bar-augmented-hamiltonian-rk4"
)
@pytest.mark.parametrize(("name", "method", "integrator"), PIECES)
def test_two_runs_are_the_run_in_one_piece(name, method, integrator):
    """Every table and everything that is kept, with constant steps."""
    constant = {"integrator.adaptive": "false"} if integrator == "radau5" else {}
    settings = {**JOINT, "method": method, "integrator": integrator, "options": constant, "max_violation": 1e-2}
    model = symgen.load(name)
    whole = model.simulate(until=STEP * LAST, **settings)
    first = model.simulate(until=STEP * FIRST, **settings)
    second = model.simulate(until=STEP * LAST, start=pickle.loads(pickle.dumps(first.last_state)), **settings)
    assert second.coordinates == "joint" and second.state == whole.state
    assert second.notes[0] == f"goes on from t = {STEP * FIRST:g} s of another run"
    assert (second.steps, second.rank) == (LAST - FIRST, whole.rank)
    assert len(second.t) == LAST - FIRST + 1
    assert_the_rest(second, whole, 1e-10 if method == "null-space" else 0.0)


@pytest.mark.slow
def test_through_files_and_a_reset(tmp_path):
    event = {"blow": {"when": "crank.theta < 1.02", "reset": {"crank.omega": "2"}}}
    settings = {**JOINT, "integrator": "abm4", "events": event}
    model = symgen.load("four-bar")
    whole = model.simulate(until=0.3, **settings)
    assert len(whole.events) == 1
    half = STEP * round(whole.events[0].t / STEP / 2)
    found = None
    for until in (half, 0.3):  # before the blow, and behind it
        found = model.simulate(until=until, **settings, **({"start": found} if found else {}))
    assert len(found.events) == 1 and found.events[0].impulses == whole.events[0].impulses
    np.testing.assert_array_equal(found.q.values, whole.q.values[-len(found.t) :])
    words = ["--coordinates", "joint", "--integrator", "rk4", "--step", str(STEP), "--output-step", str(STEP)]
    file, out = model.simulate(until=0.1, integrator="rk4", **JOINT).save(tmp_path / "first.nc"), tmp_path / "second.nc"
    assert main(["run", "four-bar", *words, "--until", "0.2", "--from", str(file), "--save", str(out)]) == 0
    plain = model.simulate(until=0.2, integrator="rk4", **JOINT)
    with xr.open_dataset(out, engine="h5netcdf") as opened:
        np.testing.assert_array_equal(opened["q"], plain.q.values[-len(opened.time) :])
        assert json.loads(opened.attrs["run"])["notes"] == ["goes on from t = 0.1 s of another run"]


def test_step_by_step_from_a_result():
    model = symgen.load("four-bar")
    constant = {**JOINT, "integrator": "rk4"}
    first, whole = model.simulate(until=0.1, **constant), model.simulate(until=0.2, **constant)
    run = model.start(start=first, coordinates="joint", integrator="rk4", step=STEP)
    run.run(0.2)
    assert run.bodies["rocker.theta"] == whole["rocker.theta"][-1] and run.t == 0.2


@pytest.mark.parametrize(
    ("before", "after", "said"),
    [
        ("joint", "absolute", "coordinates absolute instead of joint"),
        ("absolute", "joint", "coordinates joint instead of absolute"),
        ("joint", "joint", "method lagrange instead of direct-correction"),
    ],
)
def test_runs_of_another_making_take_coordinates_and_velocities(before, after, said):
    """The motion goes on within the integrator's error; the work does, and the balance of energy begins anew."""
    tight = {"integrator": "dop853", "rtol": 1e-11, "atol": 1e-13}
    model, other = symgen.load("four-bar"), {"method": "lagrange"} if before == after else {}
    whole = model.simulate(until=0.4, coordinates=before, **tight)
    first = model.simulate(until=0.2, coordinates=before, **tight)
    second = model.simulate(until=0.4, start=first, coordinates=after, **tight, **other)
    assert second.notes[0].startswith("goes on from t = 0.2 s of another run with its coordinates and velocities alone")
    assert said in second.notes[0]
    np.testing.assert_allclose(second.q.values[-1], whole.q.values[-1], rtol=0.0, atol=1e-8)


@pytest.mark.slow
def test_another_tree_takes_coordinates_and_velocities():
    described = raw("slider-crank")
    trees = []
    for joint in ("Q", "P"):
        described["joints"] = {
            name: {**table, **({"cut": True} if name == joint else {})}
            for name, table in raw("slider-crank")["joints"].items()
        }
        trees.append(symgen.load(mechanism_of(described)))
    first = trees[0].simulate(until=0.02, **JOINT)
    second = trees[1].simulate(until=0.04, start=first, **JOINT)
    assert "alone: tree " in second.notes[0] or "another one" in second.notes[0], second.notes
    whole = trees[0].simulate(until=0.04, **JOINT)
    np.testing.assert_allclose(second.q.values[-1], whole.q.values[-1], rtol=0.0, atol=1e-7)
