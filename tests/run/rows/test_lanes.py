"""Runs in lanes against runs by themselves: equal to rounding, and done alone where they do not go well."""

import math
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.checks import assert_same_motion
from support.emitted import mechanism_of

import symgen
from symgen.base.errors import InputError
from symgen.base.ir.program import LANES, lane_bases
from symgen.run.compiling.method_choice import choose_method
from symgen.run.compiling.pipeline import compile_model, generate
from symgen.run.layout import ensemble_abi as e
from symgen.study.ensemble.loop_runs import aligned

ROUNDED = [e.SUMMARY.index(name) for name in ("code", "end", "outputs", "steps", "evaluations", "iterations", "start")]


def both(model, vary, **chosen):
    """Return the sweep by single runs and the one in lanes."""
    return [symgen.sweep(model, vary, target=target, jobs=1, **chosen) for target in ("cpu", "lanes")]


def scale(values):
    return np.maximum(1.0, np.nanmax(np.abs(values)))


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases("lagrange-options0", "direct-correction-options1")
@pytest.mark.parametrize(
    ("method", "options"),
    [
        ("lagrange", {}),
        ("direct-correction", {}),
        pytest.param("baumgarte", {"method.alpha": 3.0}, marks=pytest.mark.slow),
        pytest.param("penalty", {}, marks=pytest.mark.slow),
        pytest.param("direct-correction", {"method.weight": "mass"}, marks=pytest.mark.slow),
        pytest.param("post-stabilization", {}, marks=pytest.mark.slow),
        pytest.param("velocity-projection", {}, marks=pytest.mark.slow),
    ],
)
def test_planar_rows_are_those_of_single_runs(method, options):
    """Thirteen rows: a full group and a part of one; outputs that no step meets."""
    single, lanes = both(
        "four-bar",
        {"crank_mass": "lin(1.5, 2.5, 13)"},
        **{"method": method, "options": options, "integrator": "rk4", "step": 1e-3, "until": 0.2},
        times=(0.0, 0.05, 0.10007, 0.2),
        quantities=("q", "v", "energy.total", "rocker.ax"),
    )
    assert lanes.counts == single.counts
    assert lanes.counts["ok"] == 13
    rounding, within = (0.2, 1e-9) if method == "penalty" else (1e-6, 1e-10)  # springs make vibrations of rounding
    np.testing.assert_allclose(lanes.values, single.values, rtol=0, atol=within * scale(single.values))
    np.testing.assert_array_equal(lanes.summary[:, ROUNDED], single.summary[:, ROUNDED])
    for name in ("position_violation_max", "energy_drift_max", "energy_scale", "smallest_pivot", "speed_scale"):
        column = e.SUMMARY.index(name)
        np.testing.assert_allclose(lanes.summary[:, column], single.summary[:, column], rtol=rounding, atol=1e-11)


@pytest.mark.parametrize("integrator", ["euler", "heun", "dop853"])
def test_every_tableau_takes_the_same_steps(integrator):
    options = {"integrator.adaptive": "false"} if integrator == "dop853" else {}
    single, lanes = both(
        "pendulum",
        {"bob_mass": "lin(0.8, 1.2, 9)"},
        **{"method": "lagrange", "integrator": integrator, "options": options, "step": 1e-4, "until": 0.01},
    )
    np.testing.assert_allclose(lanes.values, single.values, rtol=0, atol=1e-12)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("method", [pytest.param("lagrange", marks=pytest.mark.slow), "direct-correction"])
def test_spatial_rows_are_those_of_single_runs(method):
    """Euler parameters, and angles in space whose turns are counted."""
    single, lanes = both(
        "spatial-slider-crank",
        {"crank.wx": "lin(5.5, 6.5, 5)"},
        **{"method": method, "integrator": "rk4", "step": 1e-3, "until": 0.1, "quantities": ("q", "v")},
    )
    assert lanes.counts == single.counts
    np.testing.assert_allclose(lanes.values, single.values, rtol=0, atol=1e-9 * scale(single.values))


@pytest.mark.slow
def test_a_slider_whose_factorisation_is_that_of_constants():
    """Nothing is left to be factorised for each run; x = 1 - cos(t/sqrt(m))."""
    body = {"mass": "m", "inertia": 0.1}
    guide = {"type": "translational", "between": ["ground", "b"], "at": [[0.0, 0.0], "centre"], "axis": [1.0, 0.0]}
    raw = {"mechanism": {"name": "slider"}, "parameters": {"m": 1.0}, "bodies": {"b": body}, "joints": {"guide": guide}}
    raw["forces"] = {"spring": {"type": "force", "body": "b", "force": ["1 - b.x", "0"]}}
    masses = np.array([1.0, 2.0])
    settings = {"integrator": "rk4", "step": 1e-3, "until": 1.0, "target": "lanes"}
    found = symgen.sweep(mechanism_of(raw), {"m": masses}, method="direct-correction", **settings)
    np.testing.assert_allclose(found["b.x"][:, -1], 1.0 - np.cos(1.0 / np.sqrt(masses)), rtol=0.0, atol=1e-12)


@pytest.mark.slow
def test_runs_that_do_not_go_well_are_left_to_single_runs():
    """Through singular positions, and beyond the limits: the rows are those of single runs."""
    chosen = {"integrator": "rk4", "step": 1e-3, "until": 1.5}
    single, lanes = both(
        "n-four-bar:2", {"vertical0.omega": "lin(-1.2, -0.8, 9)"}, method="direct-correction", **chosen
    )
    events = single.summary[:, e.SUMMARY.index("rank_event_count")] > 0
    assert events.any()
    assert_same_motion(lanes.values[events], single.values[events])
    assert_same_motion(lanes.summary[events], single.summary[events])
    np.testing.assert_allclose(lanes.values, single.values, rtol=0, atol=1e-9)
    strict = {"max_violation": 1e-12, **chosen}
    single, lanes = both("four-bar", {"crank_mass": "lin(1.5, 2.5, 9)"}, method="lagrange", **strict)
    assert single.counts["failed"] == 9
    assert lanes.reasons() == single.reasons()
    assert_same_motion(lanes.summary, single.summary)


@pytest.mark.slow
def test_runs_that_choose_rows_anew_are_left_to_single_runs():
    """Two bodies with two pins: the row that repeats is that along the line through these, which turns."""
    spinning = {"mass": 1.0, "inertia": 0.1, "angular_velocity": "w"}
    first = {**spinning, "position": [0.5, 0.0], "velocity": [0.0, "0.5*w"]}
    second = {**spinning, "position": [0.75, 0.0], "velocity": [0.0, "0.75*w"]}
    first["points"] = {"O": [-0.5, 0.0], "P": [0.0, 0.0], "Q": [0.5, 0.0]}
    second["points"] = {"P": [-0.25, 0.0], "Q": [0.25, 0.0]}
    raw = {"mechanism": {"name": "turning"}, "parameters": {"w": 1.0}, "bodies": {"a": first, "b": second}}
    raw["joints"] = {
        "pin": {"type": "revolute", "between": ["ground", "a"], "at": [[0.0, 0.0], "O"]},
        "p": {"type": "revolute", "between": ["a", "b"], "at": ["P", "P"]},
        "q": {"type": "revolute", "between": ["a", "b"], "at": ["Q", "Q"]},
    }
    turned = np.array([0.3, 1.4])  # rad, within 1 s
    chosen = {"method": "lagrange", "integrator": "rk4", "step": 1e-2, "until": 1.0, "max_violation": 1e-3}
    single, lanes = both(mechanism_of(raw), {"w": turned}, **chosen)
    np.testing.assert_allclose(lanes["a.theta"][:, -1], turned, rtol=0, atol=1e-9)
    assert_same_motion(lanes.values[1], single.values[1])
    pivots = np.array([found["smallest_pivot"] for found in (single, lanes)])
    np.testing.assert_allclose(pivots[1], pivots[0], rtol=1e-9)
    assert pivots[0, 1] > 0.05


@pytest.mark.slow
def test_results_do_not_depend_on_the_neighbours():
    """A row has the same bits whatever stands in the other lanes."""
    chosen = {"method": "direct-correction", "integrator": "rk4", "step": 1e-3, "until": 0.1, "target": "lanes"}
    masses = np.linspace(1.5, 2.5, 11)
    together = symgen.sweep("four-bar", {"crank_mass": masses}, **chosen)
    alone = [symgen.sweep("four-bar", {"crank_mass": masses[i : i + 1]}, **chosen) for i in (0, 7, 10)]
    np.testing.assert_array_equal(together.values[[0, 7, 10]], np.concatenate([found.values for found in alone]))


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"method": "augmented-lagrangian"}, "one that iterates"),
        ({"method": "coordinate-partitioning"}, "one that iterates, chooses coordinates"),
        ({"integrator": "dopri5"}, "adaptive steps"),
    ],
)
def test_what_lanes_cannot_do_is_refused(changes, words):
    chosen = {"method": "direct-correction", "integrator": "rk4", "step": 1e-3, "until": 0.1} | changes
    if "integrator" in changes:
        del chosen["step"]
    with pytest.raises(InputError, match=words):
        symgen.sweep("four-bar", {"crank_mass": [2.0]}, target="lanes", **chosen)


def test_looped_code_for_lanes_is_refused():
    with pytest.raises(InputError, match="the straight shape"):
        generate(symgen.load("four-bar").mechanism, (choose_method("lagrange"),), "looped", "lanes")


@cache
def emitted():
    """The module that a model in lanes shares."""
    return compile_model(symgen.load("four-bar").mechanism, choose_method("lagrange"), target="lanes").model


@given(st.floats(-1e5, 1e5))
def test_emitted_sines_are_good_to_the_last_place(x):
    module = emitted()
    assert abs(module.sine(x) - math.sin(x)) <= 1.2e-16
    assert abs(module.cosine(x) - math.cos(x)) <= 1.2e-16


def test_places_in_the_array_of_lanes_do_not_overlap():
    bases = lane_bases(19, 29, 71)
    assert list(bases.values()) == [0, 20, 40, 69, 140, 145]
    array = aligned(LANES * bases["numbers"])
    assert array.ctypes.data % 64 == 0
    assert len(array) == LANES * 145
    assert not array.any()


@pytest.mark.slow_cases("sin(w*a.theta)")
@pytest.mark.parametrize("torque", ["sin(w*a.theta)", "max(0, sin(a.x*w + t))"])
def test_sines_of_large_arguments_are_those_of_single_runs(torque):
    """The sines of lanes lose digits beyond 4e5 and are of another angle beyond 1e15: such rows are done alone."""
    arm = {"mass": 1.0, "inertia": 0.3, "position": [0.5, -0.1]}
    raw = {"mechanism": {"name": "fast", "gravity": [0.0, -9.81]}, "parameters": {"w": 1.0}, "bodies": {"a": arm}}
    raw["joints"] = {"pin": {"type": "revolute", "between": ["ground", "a"], "at": [[0.0, 0.0], [-0.5, 0.1]]}}
    raw["forces"] = {"drive": {"type": "torque", "body": "a", "torque": f"0.01*{torque}"}}
    chosen = {"method": "lagrange", "integrator": "rk4", "step": 1e-2, "until": 0.2}
    single, lanes = both(mechanism_of(raw), {"w": [1.0, 1e7, 1e10, 1e16]}, **chosen)
    assert lanes.counts == single.counts and lanes.counts["ok"] == 4
    assert_same_motion(lanes.values[1:], single.values[1:])
    np.testing.assert_allclose(lanes.values[0], single.values[0], rtol=0.0, atol=1e-13)
