"""Rows whose formulas jump or have kinks over the state end a run with their name; smooth changes do not."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from study.ensemble.single_runs import assert_rows
from support.emitted import mechanism_of

import symgen
from symgen.base.errors import InputError
from symgen.base.settings import Settings
from symgen.run.layout import abi
from symgen.run.planning.prepare import prepare

SCHEMES = {"dop853": {}, "rk4": {"step": 1e-3}, "picard": {}, "radau5": {}, "dopri5": {}}
CASES = [
    pytest.param(scheme, coordinates, marks=() if scheme in ("dop853", "rk4") else pytest.mark.slow)
    for scheme in SCHEMES
    for coordinates in ("absolute", "joint")
]
#: Wires x = f(y) with a jump or corner that a bead passes, or that jump in time.
JUMPING = (
    "abs(a.y - 1)",
    "max(1 - a.y, 0)",
    "min(a.y - 1, 0)",
    "0.1 if a.y > 1 else 0",
    "0.1*sign(a.y - 1)",
    "a.y if a.y < 1 else 2*a.y",
    "a.y if a.y < 1 else 2*a.y - 1",
    "sqrt((a.y - 1)**2)",
    "((a.y - 1)**2)**0.5",
    "acos(cos(3*a.y))",
    "asin(sin(1.5*a.y))",
    "atan(tan(1.5*a.y))",
    "0.1*atan2(a.y - 1, -1)",
    "0.1*atan2(sin(3*a.y), cos(3*a.y))",
    "0.1*abs(sin(3*a.y))",
    "0.1*max(a.y, 2 - a.y)",
    "1e-3*abs(a.y - 1)",
    "1e-4*sign(a.y - 1)",
    "abs(a.y - 1)*a.y",
    "max(abs(a.y - 1), 0.2)",
    "0.1 if t > 1 and a.y > 0.2 else 0",
    "a.y*(1 if t > 1 else 1.1)",
    "0.1 if t > 1 else 0",
    "0.1*max(0, t - 1)",
    "0.1*abs(t - 1)",
    "0.1*sign(sin(3*t))",
    "0.1*atan2(sin(3*t), cos(3*t))",
)
#: Wires whose value and slope are continuous, and the slope in y.
SMOOTH = {
    "abs(a.y - 1)*(a.y - 1)": lambda y: 2.0 * abs(y - 1.0),
    "max(a.y - 1, 0)**2": lambda y: 2.0 * max(y - 1.0, 0.0),
    "a.y if a.y < 1 else a.y + (a.y - 1)**3": lambda y: 1.0 + 3.0 * max(y - 1.0, 0.0) ** 2,
    "0.1*atan2(a.y - 1, 2)": lambda y: 0.2 / (4.0 + (y - 1.0) ** 2),
    "a.y + 0*sign(a.y - 1)": lambda y: 1.0,
}


def bead(wire, **row):
    """A bead that begins at y = 0.5 m with 0.5 m/s upwards, on a wire."""
    numbers = {k: getattr(math, k) for k in ("sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sqrt")}
    numbers["sign"] = lambda x: float((x > 0) - (x < 0))

    def at(y, t):
        return eval(wire.replace("a.y", "y"), {**numbers, "y": y, "t": t})

    h = 1e-6
    slope, drift = (at(0.5 + h, 0.0) - at(0.5 - h, 0.0)) / (2 * h), (at(0.5, h) - at(0.5, 0.0)) / h
    a = {"type": "point", "mass": 1.0, "position": [at(0.5, 0.0), 0.5], "velocity": [0.5 * slope + drift, 0.5]}
    held = {"type": "rows", "rows": [row or {"position": f"a.x - ({wire})"}]}
    return mechanism_of({"mechanism": {"name": "bead"}, "bodies": {"a": a}, "joints": {"wire": held}})


def ended(mechanism, scheme, coordinates, **settings):
    """The sentence of a run that fails or is refused, None of one that is ok."""
    try:
        result = symgen.simulate(
            mechanism, until=2.0, integrator=scheme, coordinates=coordinates, **SCHEMES[scheme], **settings
        )
    except InputError as error:
        return str(error)
    return result.reason if result.status == "failed" else None


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize(("scheme", "coordinates"), CASES)
def test_rows_that_jump_or_have_kinks_end_a_run_with_their_name(scheme, coordinates):
    for wire in JUMPING:
        sentence = ended(bead(wire), scheme, coordinates)
        assert sentence is not None, wire
        assert "row wire.row1 jumps: its" in sentence or "joints.wire.rows[0].position: expected a motion" in sentence


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize(("scheme", "coordinates"), CASES)
def test_rows_that_change_smoothly_are_followed(scheme, coordinates):
    for wire, slope in SMOOTH.items():
        begin = 0.25 * (1.0 + slope(0.5) ** 2)  # the speed along a wire stays
        rate = solve_ivp(
            lambda _, y, slope=slope, begin=begin: [math.sqrt(begin / (1.0 + slope(y[0]) ** 2))],
            *((0.0, 2.0), [0.5]),
            rtol=1e-10,
            atol=1e-12,
            max_step=1e-2,
        )
        settings = {"integrator": scheme, "coordinates": coordinates, **SCHEMES[scheme]}
        result = symgen.simulate(bead(wire), until=2.0, **settings)
        assert result.status == "ok", (wire, result.reason)
        assert result.q["a.y"][-1] == pytest.approx(rate.y[0, -1], abs=2e-6), wire


@pytest.mark.slow
def test_only_the_value_of_a_velocity_counts():
    jumping = bead("0", velocity="a.vx - (0.1 if a.y > 1 else 0)")
    assert "row wire.row1 jumps: its value changes by -0.1 m/s at t = 1 s" in ended(jumping, "dop853", "absolute")
    result = symgen.simulate(bead("0", velocity="a.vx - 0.1*max(a.y - 1, 0)"), until=2.0)
    assert result.status == "ok"
    assert result.q["a.x"][-1] == pytest.approx(0.1 * (result.q["a.y"][-1] - 1.0) ** 2, abs=1e-7)  # x' = 0.1 y y'
    with pytest.raises(InputError, match=r"rows\[0\]\.velocity: expected a motion .* jumps by -0\.1 m/s at t = 1 s"):
        symgen.simulate(bead("0", velocity="a.vx - (0.1 if t > 1 else 0)"), until=2.0)
    assert symgen.simulate(bead("0", velocity="a.vx - 0.1*max(t - 1, 0)"), until=2.0).status == "ok"


def test_the_sentence_has_the_jump_and_its_time():
    sentence = ended(bead("max(1 - a.y, 0)"), "dop853", "absolute")
    assert sentence.startswith("row wire.row1 jumps: its rate changes by -0.5 m/s at t = 1 s")
    sentence = ended(bead("0.1 if a.y > 1 else 0"), "rk4", "absolute")
    assert sentence.startswith("row wire.row1 jumps: its value changes by -0.1 m at t = 1 s")


def test_couplings_and_drivers_jump_at_the_cut_of_atan2():
    raw = {
        "mechanism": {"name": "slide"},
        "bodies": {"a": {"mass": 1.0, "inertia": 0.1}},
        "joints": {
            "p": {"type": "translational", "between": ["ground", "a"], "at": [[0, 0], "centre"], "axis": [1, 0]},
            "c": {"type": "driver", "joint": "p", "value": "0.1*atan2(sin(3*t), cos(3*t))"},
        },
    }
    coupled = {"type": "coupling", "terms": {"p": 1.0}, "value": "0.1*atan2(sin(3*t), cos(3*t))"}
    for held in (raw["joints"]["c"], coupled):
        raw["joints"]["c"] = held
        with pytest.raises(InputError, match=r"joints\.c\.value: .* jumps by -0\.628319 m at t = 1\.0472 s"):
            symgen.simulate(mechanism_of(raw), until=2.0)
    raw["joints"]["c"]["value"] = "0.1*atan2(sin(t), 2 + cos(t))"  # turns back before the cut
    result = symgen.simulate(mechanism_of(raw), until=4.0)
    assert result.status == "ok"
    assert result.q["a.x"][-1] == pytest.approx(0.1 * math.atan2(math.sin(4.0), 2.0 + math.cos(4.0)), abs=1e-9)


# -- a wheel that turns twice as fast as the direction of an arm -------------------------------------------------------


def belt(row, **joints):
    """An arm that turns at 1 rad/s from 1 rad, and a wheel."""
    turned = {"mass": 1.0, "inertia": 0.1}
    return mechanism_of(
        {
            "mechanism": {"name": "belt"},
            "bodies": {
                "arm": turned | {"points": {"tip": [1.0, 0.0]}, "angle": 1.0, "angular_velocity": 1.0},
                "wheel": turned | {"angle": 2.0},
            },
            "joints": {
                "hub": {"type": "revolute", "between": ["ground", "arm"], "at": [[0.0, 0.0], "centre"]},
                "axle": {"type": "revolute", "between": ["ground", "wheel"], "at": [[0.0, 0.0], "centre"]},
                **joints,
                "belt": {"type": "rows", "rows": [{"position": row, "unit": "rad"}]},
            },
        }
    )


CUT = "wheel.theta - 2*atan2(arm.tip.y, arm.tip.x)"
PLACE = {"type": "place", "between": ["ground", "arm"], "at": [[0.0, 0.0], "tip"], "angle": True}
COUNTED = belt("wheel.theta - 2*direction.angle", direction=PLACE)


@pytest.mark.parametrize(("scheme", "coordinates"), CASES)
def test_a_correction_over_the_cut_of_atan2_is_a_failure(scheme, coordinates):
    settings = {"integrator": scheme, "coordinates": coordinates, **SCHEMES[scheme]}
    result = symgen.simulate(belt(CUT), until=3.0, **settings)
    assert result.status == "failed"
    assert result.reason.startswith("row belt.row1 jumps: its value changes by 12.5664 rad at t = 2.14159 s")


@pytest.mark.parametrize(("scheme", "coordinates"), CASES)
def test_the_angle_of_a_place_counts_turns(scheme, coordinates):
    settings = {"integrator": scheme, "coordinates": coordinates, **SCHEMES[scheme]}
    for until in (3.0, 30.0):  # in long steps a coasting arm would turn several times
        result = symgen.simulate(COUNTED, until=until, **settings)
        assert result.status == "ok", result.reason
        assert result.q["arm.theta"][-1] == pytest.approx(1.0 + until, abs=1e-7)
        assert result.q["wheel.theta"][-1] == pytest.approx(2.0 + 2.0 * until, abs=1e-7)
        np.testing.assert_allclose(result.joint_coordinates["direction.angle"], result.q["arm.theta"], atol=1e-6)
        assert result.joint_coordinates["direction.angle.rate"][-1] == pytest.approx(1.0, abs=1e-7)


def test_the_angle_of_a_place_in_looped_code_and_at_a_start():
    result = symgen.simulate(COUNTED, until=30.0, shape="looped", start={"direction.angle": 8.0})
    assert result.status == "ok"
    assert result.q["arm.theta"][[0, -1]] == pytest.approx([8.0, 38.0], abs=1e-7)
    assert result.q["wheel.theta"][[0, -1]] == pytest.approx([16.0, 76.0], abs=1e-7)


def test_constant_steps_in_which_turns_are_lost_fail():
    result = symgen.simulate(COUNTED, until=30.0, integrator="rk4", step=2.0)
    assert result.status == "failed" and "take shorter ones" in result.reason


@pytest.mark.slow
def test_sweeps_count_turns_and_examine_rows():
    vary, kept = {"arm.omega": [0.1, 1.0]}, ["arm.theta", "direction.angle"]
    for settings in ({}, {"integrator": "rk4", "step": 1e-2}, {"integrator": "rk4", "step": 1e-2, "target": "lanes"}):
        found = symgen.sweep(COUNTED, vary, until=30.0, quantities=kept, **settings)
        assert found.status.tolist() == ["ok", "ok"]
        np.testing.assert_allclose(found["direction.angle"].ravel(), [4.0, 31.0], atol=1e-7)
    for settings in ({}, {"integrator": "rk4", "step": 1e-2}, {"coordinates": "joint"}):
        found = symgen.sweep(belt(CUT), vary, until=3.0, **settings)
        assert found.status.tolist() == ["ok", "failed"]
        assert "a row jumps or has a kink" in found.reason[1]
    with pytest.raises(InputError, match="expected no rows with jumps or kinks"):
        symgen.sweep(belt(CUT), vary, until=3.0, integrator="rk4", step=1e-2, target="lanes")


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases("adaptive", "constant", "joint")
@pytest.mark.parametrize(
    "settings",
    [{"integrator": "dop853"}, {"integrator": "rk4", "step": 1e-2}, {"integrator": "dop853", "coordinates": "joint"}],
    ids=["adaptive", "constant", "joint"],
)
def test_rows_that_pass_a_place_go_on_in_their_loop_as_single_runs(settings):
    """The second derivative of the wire jumps at y = 1, which the rows reach at 5, 1 and 5/7 s."""
    model, speeds = symgen.load(bead("max(a.y - 1, 0)**2")), [0.1, 0.5, 0.7]
    settings |= {"until": 3.0, "times": (1.0, 3.0), "record_when": "a.y > 0.9"}
    found = symgen.sweep(model, {"a.vy": speeds}, quantities=("q", "v", "event"), **settings)
    assert_rows(found, model, "start", **settings)
    np.testing.assert_array_equal(found["event.a.y > 0.9.count"], [0.0, 1.0, 1.0])
    np.testing.assert_allclose(found["event.a.y > 0.9.first"][1:], [0.8, 0.4 / 0.7], atol=1e-8)


@pytest.mark.slow
def test_an_angle_in_space_is_about_an_axis():
    raw = {
        "mechanism": {"name": "turned", "space": "spatial"},
        "bodies": {
            "arm": {
                "mass": 1.0,
                "inertia": [0.1, 0.1, 0.1],
                "points": {"tip": [1.0, 0.0, 0.0]},
                "angular_velocity": [0.0, 0.0, 1.0],
            }
        },
        "joints": {
            "hub": {"type": "revolute", "between": ["ground", "arm"], "at": [[0, 0, 0], "centre"], "axis": [0, 0, 1]},
            "direction": {
                "type": "place",
                "between": ["ground", "arm"],
                "at": [[0.0, 0.0, 0.0], "tip"],
                "angle": True,
                "axis": [0.0, 0.0, 2.0],
                "reference": [0.0, -1.0, 0.0],
            },
        },
    }
    for coordinates in ("absolute", "joint"):
        result = symgen.simulate(mechanism_of(raw), until=30.0, coordinates=coordinates)
        assert result.joint_coordinates["direction.angle"][-1] == pytest.approx(0.5 * math.pi + 30.0, abs=1e-6)
    raw["joints"]["direction"].pop("axis")
    with pytest.raises(InputError, match=r"joints\.direction\.axis: expected an axis"):
        mechanism_of(raw)
    with pytest.raises(InputError, match=r"joints\.direction\.axis: expected no such key"):
        belt("wheel.theta - 2*direction.angle", direction=PLACE | {"axis": [0.0, 0.0, 1.0]})


# -- energy over a switch ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("scheme", ["dop853", "picard", "dopri5"])
def test_energy_lost_by_the_projection_at_a_switch_counts(scheme):
    # half of 0.25 J goes where the velocity is projected; without the look at the row the balance must show it
    run = prepare(bead("max(1 - a.y, 0)"), Settings(integrator=scheme, until=2.0))
    events = run.spec.events
    blind = replace(events, rows=None, switches=tuple(replace(switch, holds=False) for switch in events.switches))
    outcome = run.with_spec(events=blind).integrate()
    assert outcome.code == abi.ENERGY
    assert outcome.end == pytest.approx(1.0, abs=1e-6)
    assert outcome.energy_drift_max == pytest.approx(0.125, rel=1e-6)
