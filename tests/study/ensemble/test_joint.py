"""Sweeps in joint coordinates: the single runs to rounding, the motion of bodies' own coordinates within tolerances."""

import numpy as np
import pytest
from run.single.test_events import four_bar
from support.emitted import mechanism_of

import symgen
from study.ensemble.single_runs import assert_row, assert_rows, column_of
from symgen.base.errors import InputError
from symgen.describe.catalogue import raw
from symgen.run.compiling import events
from symgen.run.planning import tree_starts
from symgen.study.ensemble import kernel

#: Model, what varies, how it is said of a single run, and whether rows of loops depend on others: those run apart.
CASES = [
    ("four-bar", "crank_mass", (1.0, 3.0), "parameters"),
    ("slider-crank", "crank.theta", (0.3, 1.0), "start"),
    ("driven-four-bar", "coupler_mass", (1.0, 2.0), "parameters"),
    ("bricard", "rod1.z", (0.0, 0.02), "start"),
]
FURTHER = ("q", "v", "energy", "violations", "smallest_pivot")


@pytest.mark.by_turns(3)
@pytest.mark.fast("four-bar")
@pytest.mark.parametrize(("name", "varies", "values", "how"), CASES, ids=[case[0] for case in CASES])
def test_rows_are_single_runs(name, varies, values, how):
    model, asked = symgen.load(name), {"until": 0.1, "times": (0.0, 0.051, 0.1), "coordinates": "joint"}
    found = symgen.sweep(model, {varies: values}, quantities=FURTHER, **asked)
    plain = symgen.sweep(model, {varies: values}, quantities=FURTHER, **{**asked, "coordinates": "absolute"})
    assert [q.name for q in found.ensemble.recipe.quantities] == [q.name for q in plain.ensemble.recipe.quantities]
    assert_rows(found, model, how, **asked)
    assert found.to_json()["coordinates"] == "joint" == found.attributes["coordinates"]


@pytest.mark.parametrize("kept", [("q",), ("spinner.e0", "spinner.e3")])
def test_euler_parameters_go_on_from_the_start_whenever_they_are_first_kept(kept):
    """A body that has turned by more than half a turn until then has the other sign nearer to its start."""
    raw = {
        "mechanism": {"name": "spins", "space": "spatial", "gravity": [0.0, 0.0, 0.0]},
        "parameters": {"speed": 1.0},
        "bodies": {"spinner": {"mass": 1.0, "inertia": [1.0, 1.0, 1.0], "angular_velocity": [0.0, 0.0, "speed"]}},
        "joints": {"hinge": {"type": "revolute", "between": ["ground", "spinner"], "at": [[0.0, 0.0, 0.0]] * 2}},
    }
    raw["joints"]["hinge"]["axis"] = [0.0, 0.0, 1.0]
    speeds = np.array([1.0, 4.0, 8.0, -5.0])
    found = symgen.sweep(mechanism_of(raw), {"speed": speeds}, quantities=kept, until=1.0, coordinates="joint")
    np.testing.assert_allclose(found["spinner.e0"][:, 0], np.cos(0.5 * speeds), atol=1e-9)
    np.testing.assert_allclose(found["spinner.e3"][:, 0], np.sin(0.5 * speeds), atol=1e-9)


def test_both_coordinates_give_one_motion():
    asked = {"integrator": "dop853", "rtol": 1e-11, "atol": 1e-13, "until": 1.0, "times": (0.5, 1.0)}
    vary = {"crank_mass": [1.0, 3.0], "crank.omega": [0.0, 2.0]}
    bodies, joints = (symgen.sweep("four-bar", vary, coordinates=c, **asked) for c in ("absolute", "joint"))
    assert bodies.counts["ok"] == joints.counts["ok"] == 4
    np.testing.assert_allclose(joints.values, bodies.values, rtol=0.0, atol=1e-8)
    assert np.any(joints["evaluations"] != bodies["evaluations"])  # it is another state that was integrated


@pytest.mark.slow
def test_whatever_else_is_kept_is_that_of_single_runs():
    """Accelerations, reactions, multipliers and joint coordinates follow from the motion that the loop leaves."""
    asked = {"until": 0.05, "times": (0.0, 0.05), "coordinates": "joint"}
    kept = ("crank.alpha", "B.angle", "lam", "A")
    found, model = (
        symgen.sweep("four-bar", {"crank_mass": [1.0, 3.0]}, quantities=kept, **asked),
        symgen.load("four-bar"),
    )
    assert {"crank.alpha", "B.angle", "A.Fx"} < {q.name for q in found.ensemble.recipe.quantities}
    assert_rows(found, model, **asked)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(
    "steps", [{"integrator": "dop853"}, {"integrator": "rk4", "step": 1e-3}], ids=["dop853", "rk4"]
)
@pytest.mark.parametrize("method", ["direct-correction", "baumgarte"])
def test_all_quantities_of_random_rows_have_the_bits_of_single_runs(steps, method):
    """Formulas, integrals, reactions, an input that jumps and an event that changes velocities among them."""
    description = raw("four-bar")
    description["inputs"] = {"torque": 0.0}
    description["forces"] = {"motor": {"type": "torque", "body": "crank", "torque": "torque"}}
    description["events"] = {"blow": {"when": "t > 0.02", "reset": {"coupler.omega": "1.5 - 0.4*coupler.omega"}}}
    description["outputs"] = {"reach": {"value": "crank.x*t + torque"}, "path": {"value": "integral(coupler.vx**2)"}}
    model, masses = symgen.load(mechanism_of(description)), np.random.default_rng(7).uniform(1.0, 3.0, 3)
    asked = {"until": 0.2, "times": (0.0, 0.02, 0.1, 0.2), "coordinates": "joint", "method": method, **steps}
    asked["inputs"] = {"torque": "4 if t < 0.1 else 1"}
    kept = ("q", "v", "a", "joint_coordinates", "lam", "reactions", "magnitudes", "energy", "outputs", "motor")
    found = symgen.sweep(model, {"crank_mass": masses}, quantities=(*kept, "event"), **asked)
    for i, mass in enumerate(masses):
        one = model.simulate(parameters={"crank_mass": float(mass)}, **asked)
        for j, q in enumerate(found.ensemble.recipe.quantities):
            np.testing.assert_array_equal(found.values[i, j], column_of(one, q.name), q.name)


def test_events_are_found_in_both_and_auto_takes_what_is_smaller():
    vary, stop = {"crank_mass": [1.0, 3.0]}, {"stop_when": "crank.theta < 0", "until": 2.0, "integrator": "dop853"}
    bodies, joints = (symgen.sweep("four-bar", vary, coordinates=c, **stop) for c in ("absolute", "auto"))
    assert joints.ensemble.plan.coordinates == "joint" and joints.counts["ok"] == 2
    np.testing.assert_allclose(joints["crank.theta"][:, 0], 0.0, atol=1e-12)
    np.testing.assert_allclose(joints["end"], bodies["end"], atol=1e-6)
    np.testing.assert_array_equal(joints["event.crank.theta < 0.first"], joints["end"])


@pytest.mark.slow
def test_light_bodies_get_the_other_solver_in_joint_coordinates_too():
    """Where loops are not closed by determinants: a partition of coordinates inverts M."""
    asked = {"until": 0.05, "times": (0.05,), "coordinates": "joint", "method": "coordinate-partitioning"}
    found = symgen.sweep("four-bar", {"coupler_mass": [8.0, 1e-9]}, **asked)
    assert list(found["light"]) == [0.0, 1.0]
    assert_row(found, 1, symgen.load("four-bar").simulate(parameters={"coupler_mass": 1e-9}, **asked))


@pytest.mark.slow
def test_targets_without_joint_coordinates_say_so():
    for target in ("lanes", "cuda"):
        with pytest.raises(InputError, match=f"target '{target}'|CUDA|cuda"):
            symgen.sweep("four-bar", {"crank_mass": [1.0]}, coordinates="joint", target=target)
    found = symgen.sweep("four-bar", {"crank_mass": [1.0]}, coordinates="auto", target="lanes", until=0.01, step=1e-3)
    assert found.ensemble.plan.coordinates == "absolute"


def test_rows_with_resets_share_what_is_the_same_for_all(monkeypatch):
    """Events are compiled, effects for bodies as well, and a start is carried once and not for each row."""
    calls = []
    for module, name in ((events, "effects_of_events"), (kernel, "compile_events"), (tree_starts, "carried_motion")):
        original = getattr(module, name)

        def counted(*arguments, name=name, original=original):
            calls.append(name)
            return original(*arguments)

        monkeypatch.setattr(module, name, counted)
    model = four_bar(blow={"when": "t > 0.02", "reset": {"coupler.omega": "1.5 - 0.4*coupler.omega"}})
    asked = {"until": 0.05, "coordinates": "joint", "integrator": "rk4", "step": 1e-2}
    kept = ("crank.ax", "event")
    found = symgen.sweep(model, {"crank.omega": [1.0, 2.0, 3.0]}, quantities=kept, jobs=1, **asked)
    np.testing.assert_array_equal(found["event.blow.count"], 1.0)
    assert sorted(calls) == ["carried_motion", "compile_events", "effects_of_events"]
