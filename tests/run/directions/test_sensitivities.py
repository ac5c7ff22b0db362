"""Sensitivities of runs: against closed forms and independent models, differences of whole runs, and identities."""

import pickle
import subprocess
import sys

import numpy as np
import pytest
from support.rotation import of_turn

import symgen
from symgen import InputError
from symgen.api import Model
from symgen.derive.methods import METHODS
from symgen.describe.facts.lifted import lift_numbers
from tests.run.directions.differences import differences
from tests.run.directions.lengths import (
    BY_NAME,
    FOUR_BAR,
    G_BY,
    LENGTHS,
    MASSES,
    ROD,
    ROD_BY,
    ROD_PERIOD,
    ROD_STATE,
    SLIDER_CRANK,
    STATE,
    G,
    model,
)

TIGHT = {"rtol": 1e-13, "atol": 1e-13, "integrator": "dop853"}


@pytest.fixture(scope="module")
def four_bar(tmp_path_factory):
    return model(tmp_path_factory.mktemp("lengths"), FOUR_BAR)


@pytest.fixture(scope="module", params=["absolute", "joint"])
def run(request, four_bar):
    return four_bar.simulate(
        until=2.0, times=[1.0, 2.0], sensitivities=tuple(BY_NAME), coordinates=request.param, **TIGHT
    )


@pytest.mark.slow_cases("joint")
def test_lengths_masses_and_gravity_of_the_four_bar(run):
    angle, speed = run.gradient("crank.theta").row(), run.gradient("crank.omega").row()
    assert abs(run.q.row()["crank.theta"] - STATE[0]) < 1e-12
    for name, (of_angle, of_speed) in BY_NAME.items():
        assert angle[name] == pytest.approx(of_angle, rel=1e-11), name
        assert speed[name] == pytest.approx(of_speed, rel=1e-11), name
    assert run.status == "ok"
    assert run.sensitivities.violation < 1e-9


@pytest.mark.slow_cases("joint")
def test_what_scales_alone_changes_nothing(run):
    # masses cancel; the clock of larger lengths is slower by the root of these over g
    speed, acceleration = run.v.row()["crank.omega"], run.a.row()["crank.alpha"]
    for quantity, rate in (("crank.theta", speed), ("crank.omega", acceleration + speed / 2.0)):
        by = run.gradient(quantity).row()
        lengths = sum(value * by[name] for name, value in LENGTHS.items())
        assert sum(value * by[name] for name, value in MASSES.items()) == pytest.approx(0.0, abs=1e-12)
        assert lengths == pytest.approx(-9.81 * by["g"], abs=1e-12)
        assert lengths == pytest.approx(-0.5 * 2.0 * rate, abs=1e-11)


@pytest.mark.slow
def test_sensitivities_of_both_coordinates_agree(four_bar):
    runs = [
        four_bar.simulate(until=0.7, sensitivities=("a", "m2"), coordinates=c, **TIGHT) for c in ("absolute", "joint")
    ]
    for name in ("rocker.theta", "crank.alpha", "rocker.C.x", "D.angle.rate", "coupler.vy"):
        one, other = (run.gradient(name) for run in runs)
        np.testing.assert_allclose(one.values, other.values, rtol=0.0, atol=1e-10 * np.abs(one.values).max())
    assert runs[0].gradient("crank.alpha").units == ("(rad/s^2)/m", "(rad/s^2)/kg")


def test_steps_are_those_of_a_run_without_sensitivities(four_bar):
    settings = {"until": 1.0, "integrator": "dop853"}
    plain, directed = four_bar.simulate(**settings), four_bar.simulate(sensitivities=["a", "g"], **settings)
    counts = [(r.steps, r.rejected, r.evaluations) for r in (plain, directed)]
    assert counts[0] == counts[1]
    np.testing.assert_allclose(plain.q.values, directed.q.values, rtol=0.0, atol=1e-12)


def test_more_directions_than_vectors_hold(four_bar):
    names = [*BY_NAME, "crank.theta", "crank.omega"]
    whole = four_bar.simulate(until=0.3, sensitivities=names, times=[0.3], **TIGHT)
    one = four_bar.simulate(until=0.3, sensitivities="crank.omega", times=[0.3], **TIGHT)
    np.testing.assert_allclose(
        whole.gradient("rocker.theta")["crank.omega"], one.gradient("rocker.theta")["crank.omega"], rtol=1e-12
    )


@pytest.mark.slow
def test_the_slider_crank_of_idas(tmp_path):
    for tolerance, error in ((1e-9, 1e-8), (1e-13, 2e-12)):
        settings = {"rtol": tolerance, "atol": tolerance, "times": [10.0], "coordinates": "joint"}
        run = model(tmp_path, SLIDER_CRANK).simulate(sensitivities=("k", "c"), **settings)
        assert run.outputs.row()["G"] == pytest.approx(G, rel=error)
        for name, value in G_BY.items():
            assert run.gradient("G").row()[name] == pytest.approx(value, rel=error)
    assert "dop853 in place of picard, which has no sensitivities" in run.notes


@pytest.fixture(scope="module")
def rod(tmp_path_factory):
    return model(tmp_path_factory.mktemp("rod"), ROD)


def test_the_rod_on_a_pin(rod):
    run = rod.simulate(until=3.0, times=[3.0], sensitivities=tuple(ROD_BY), **TIGHT)
    assert run.v.row()["rod.omega"] == pytest.approx(ROD_STATE[1], rel=1e-11)
    for name, (of_angle, of_speed) in ROD_BY.items():
        assert run.gradient("rod.theta").row()[name] == pytest.approx(of_angle, rel=1e-11)
        assert run.gradient("rod.omega").row()[name] == pytest.approx(of_speed, rel=1e-11)


@pytest.mark.slow_cases("joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_the_time_of_an_event_that_ends_the_run(rod, coordinates):
    # the rod passes the vertical after a quarter of its period
    run = rod.simulate(
        until=3.0, stop_when="rod.theta < -pi/2", sensitivities=tuple(ROD_BY), coordinates=coordinates, **TIGHT
    )
    period, by = ROD_PERIOD
    assert run.status == "ok"
    assert run.end == pytest.approx(period / 4.0, rel=1e-12)
    assert run.sensitivities.end == pytest.approx({name: value / 4.0 for name, value in by.items()}, rel=1e-11)
    # its angle there stays what it is
    for name, value in run.gradient("rod.theta").row().items():
        assert value + run.v.row()["rod.omega"] * run.sensitivities.end[name] == pytest.approx(0.0, abs=1e-11)


def test_events_that_are_only_recorded_change_nothing(rod):
    plain, noted = (
        rod.simulate(until=1.0, sensitivities="length", record_when=when, **TIGHT) for when in ((), "rod.theta < -pi/2")
    )
    assert len(noted.events) == 1
    assert noted.sensitivities.end is None
    for name, value in plain.gradient("rod.omega").row().items():
        assert noted.gradient("rod.omega").row()[name] == pytest.approx(value, rel=1e-11)


@pytest.mark.parametrize(("integrator", "order", "step"), [("rk4", 4, 2e-2), ("dopri5", 5, 1e-2), ("dop853", 8, 0.1)])
def test_errors_fall_with_the_order_of_the_scheme(rod, integrator, order, step):
    errors = []
    for part in (1.0, 0.5):
        run = rod.simulate(
            until=3.0,
            times=[3.0],
            sensitivities="length",
            integrator=integrator,
            step=part * step,
            options={"integrator.adaptive": "false"} if integrator != "rk4" else {},
            coordinates="joint",
        )
        errors.append(abs(run.gradient("rod.theta").row()["length"] - ROD_BY["length"][0]))
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.7)


CONSTANT = {"integrator": "rk4", "step": 1e-2, "until": 0.4, "times": [0.4]}


@pytest.mark.by_turns(3)
@pytest.mark.fast("absolute-circle")
@pytest.mark.parametrize("name", ["lean", "circle", "radius"])
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_rolling_disc_whose_start_is_closed_again(name, coordinates):
    disc = symgen.load("rolling-disc")
    settings = {**CONSTANT, "coordinates": coordinates}
    run = disc.simulate(sensitivities=name, **settings)
    value = disc.parameters()[name]
    for quantity in ("disc.x", "disc.e1", "disc.wy"):
        expected = differences(disc, name, value, 1e-3 * value, quantity, **settings)
        assert run.gradient(quantity).row()[name] == pytest.approx(expected, rel=1e-10, abs=1e-11)


@pytest.mark.slow_cases("crank.theta", "crank.omega")
@pytest.mark.parametrize("name", ["crank.theta", "crank.omega", "rocker.omega", "D.angle"])
def test_values_of_the_start(name):
    four_bar = symgen.load("four-bar")
    value = {"crank.theta": 1.1, "crank.omega": 0.4, "rocker.omega": -0.3, "D.angle": 1.9}[name]
    settings = {**CONSTANT, "method": "lagrange"}
    run = four_bar.simulate(sensitivities=name, start={name: value}, **settings)
    expected = differences(four_bar, name, value, 3e-4, "rocker.theta", **settings)
    assert run.gradient("rocker.theta").row()[name] == pytest.approx(expected, rel=1e-9)


@pytest.mark.slow
def test_parameters_of_the_method():
    four_bar = symgen.load("four-bar")
    settings = {**CONSTANT, "method": "baumgarte", "times": [0.4]}
    run = four_bar.simulate(sensitivities="method.alpha", options={"method.alpha": 5.0}, **settings)
    ends = [
        four_bar.simulate(options={"method.alpha": 5.0 + k * 0.02}, verify=False, **settings)["crank.x"][-1]
        for k in (-2, -1, 1, 2)
    ]
    expected = (8.0 * (ends[2] - ends[1]) - (ends[3] - ends[0])) / 0.24
    assert run.gradient("crank.x").row()["method.alpha"] == pytest.approx(expected, rel=1e-6)


@pytest.mark.slow
def test_inputs(tmp_path):
    text = """
[mechanism]
name = "pushed"
[parameters]
m = 2.0
[inputs]
push = { default = 1.5, unit = "N" }
other = { default = 0.0, unit = "N" }
[bodies.p]
type = "point"
mass = "m"
velocity = [0.0, 0.0]
[forces.f]
type = "force"
body = "p"
force = ["push + other", 0.0]
"""
    pushed = model(tmp_path, text)
    run = pushed.simulate(until=2.0, sensitivities=("push", "m"), inputs={"other": "3*t"}, **TIGHT)
    # x = (push t^2/2 + t^3/2) / m
    assert run.gradient("p.x").row() == pytest.approx({"push": 1.0, "m": -(3.0 + 4.0) / 4.0}, rel=1e-11)
    table = {"t": [0.0, 1.0, 3.0], "u": [0.0, 2.0, 1.0], "interpolation": "hold"}
    # nothing for a second, then x = 2 (t - 1)^2 / (2 m)
    held = pushed.simulate(until=2.0, sensitivities="m", inputs={"push": table}, times=[0.5, 2.0], **TIGHT)
    assert held.gradient("p.x")["m"] == pytest.approx([0.0, -0.25], rel=1e-11, abs=1e-15)
    assert held.gradient("p.ax")["m"] == pytest.approx([0.0, -0.5], rel=1e-11, abs=1e-15)
    with pytest.raises(InputError, match="the input 'push', which varies"):
        pushed.simulate(until=2.0, sensitivities="push", inputs={"push": table}, **TIGHT)


@pytest.mark.slow
def test_files_pickles_and_json(four_bar, tmp_path):
    run = four_bar.simulate(until=0.2, sensitivities=("a", "m1"), integrator="dop853")
    again = pickle.loads(pickle.dumps(run))
    assert np.array_equal(again.gradient("crank.theta").values, run.gradient("crank.theta").values)
    told = run.to_json()["sensitivities"]
    assert told["by"] == {"a": "m", "m1": "kg"}
    assert told["final"]["crank.theta"] == run.gradient("crank.theta").row()
    pytest.importorskip("h5netcdf")
    import xarray as xr

    with xr.open_dataset(run.save(tmp_path / "run.nc"), engine="h5netcdf") as data:
        assert list(data["direction"].values) == ["a", "m1"]
        assert np.array_equal(data["sensitivity_q"].values, run.sensitivities.table("q"))
    assert "sensitivities" not in four_bar.simulate(until=0.2, integrator="dop853").to_json()


def test_forces_of_joints_and_energies_have_derivatives_by_name(tmp_path):
    run = model(tmp_path, ROD).simulate(times=[1.0, 3.0], sensitivities=("length", "g", "angle"), **TIGHT)
    (turn, speed), start = ROD_STATE, 1.0
    along, across = 2.5 * np.cos(turn) - 1.5 * np.cos(start), 0.25 * np.sin(turn)
    size = np.hypot(along, across)  # the pin's force in weights
    by_turn = (-2.5 * np.sin(turn) * along + 0.25 * np.cos(turn) * across) / size
    own = {"length": 0.0, "g": size, "angle": 9.81 * 1.5 * np.sin(start) * along / size}
    total = {"length": -9.81 / 2.0 * np.cos(start), "g": -0.5 * np.cos(start), "angle": 9.81 / 2.0 * np.sin(start)}
    for name, (of_turn_, of_speed) in ROD_BY.items():
        force = own[name] + 9.81 * by_turn * of_turn_
        kinetic = speed * of_speed / 3.0 + (speed**2 / 3.0 if name == "length" else 0.0)
        assert run.gradient("pin.F").row()[name] == pytest.approx(force, rel=1e-9, abs=1e-9)
        assert run.gradient("sqrt(pin.Fx**2 + pin.Fy**2)").row()[name] == pytest.approx(force, rel=1e-9, abs=1e-9)
        assert run.gradient("energy.kinetic").row()[name] == pytest.approx(kinetic, rel=1e-9)
        assert run.gradient("energy.total").row()[name] == pytest.approx(total[name], rel=1e-9)
    assert run.gradient("pin.F").units[0] == "N/m" and run.gradient("energy.total").units[1] == "J/(m/s^2)"
    # D^T lambda acts on the second body, the reaction on the first
    sign = run["multiplier.pin.x"][-1] / run["pin.Fx"][-1]
    assert run.gradient("multiplier.pin.x").row()["g"] == pytest.approx(sign * run.gradient("pin.Fx").row()["g"])
    own = model(tmp_path, ROD).gradient("pin.F", by=("g",), until=3.0, **TIGHT)
    assert own.by["g"] == pytest.approx(run.gradient("pin.F").row()["g"], rel=1e-9) and own.unit == "N"
    with pytest.raises(InputError, match=r"a quantity with sensitivities, got 'pin\.M'"):
        run.gradient("pin.M")


def test_another_run_goes_on_from_one_with_sensitivities(four_bar):
    first = four_bar.simulate(until=0.2, sensitivities="a", **TIGHT)
    second = four_bar.simulate(until=0.5, start=first, **TIGHT)
    whole = four_bar.simulate(until=0.5, **TIGHT)
    assert second.q.row()["crank.theta"] == pytest.approx(whole.q.row()["crank.theta"], rel=1e-11)


@pytest.mark.slow
def test_a_run_without_sensitivities_imports_none_of_it():
    code = (
        "import sys, symgen; symgen.simulate('pendulum', until=0.1); "
        "print([m for m in sys.modules if 'tangents' in m or 'directions' in m or 'sensitivities' in m])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


@pytest.mark.slow
def test_a_number_that_changes_nothing_is_named(tmp_path):
    text = FOUR_BAR.replace("[bodies.crank]", 'idle = { value = 1.0, unit = "N" }\n\n[bodies.crank]', 1)
    run = model(tmp_path, text).simulate(until=0.1, sensitivities="idle", integrator="rk4", step=1e-2)
    assert "idle changes nothing in this run" in run.warnings


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"sensitivities": "lenght"}, "got 'lenght'"),
        ({"sensitivities": ("a", "a")}, "each number once, got 'a' twice"),
        ({"sensitivities": "a", "integrator": "radau5", "method": "ggl"}, "an explicit scheme .* got 'radau5'"),
        ({"sensitivities": "a", "integrator": "picard"}, "got 'picard'; take dop853"),
        ({"sensitivities": "a", "integrator": "rkmk4"}, "got 'rkmk4'"),
        ({"sensitivities": "a", "shape": "looped"}, "code of the shape 'straight', got shape 'looped'"),
        ({"sensitivities": 3}, "a list of names"),
        (
            {"sensitivities": "bodies.crank.points.B[0]"},
            r"which is .a/2.; take the parameters in it",
        ),
    ],
)
def test_what_has_no_sensitivities_is_refused(four_bar, settings, said):
    with pytest.raises(InputError, match=said):
        four_bar.simulate(until=0.1, **settings)


def test_rows_of_sweeps_and_steps_from_python_have_none(four_bar):
    for many in (
        lambda: four_bar.sweep({"a": [1.9, 2.0]}, sensitivities="a"),
        lambda: four_bar.start(sensitivities="a"),
    ):
        with pytest.raises(InputError, match=r"got 'sensitivities'; single runs have them: simulate\(settings, sens"):
            many()


@pytest.mark.slow
def test_a_length_that_destroys_mobility_is_refused(tmp_path):
    # a double parallelogram moves because three cranks are equally long
    bar = "[bodies.{0}]\nmass = 1.0\ninertia = 0.1\nposition = [{1}, 0.5]\nangle = 1.5707963267948966\n"
    text = '[mechanism]\nname = "double-parallelogram"\n[parameters]\nlength = { value = 1.0, unit = "m" }\n'
    text += "".join(bar.format(f"crank{k}", float(k)) for k in range(3))
    text += "[bodies.top]\nmass = 1.0\ninertia = 1.0\nposition = [1.0, 1.0]\n"
    joint = '[joints.{0}]\ntype = "revolute"\nbetween = {1}\nat = {2}\n'
    for k in range(3):
        end = '["length - 0.5", 0.0]' if k == 1 else "[0.5, 0.0]"
        text += joint.format(f"low{k}", f'["ground", "crank{k}"]', f"[[{k}.0, 0.0], [-0.5, 0.0]]")
        text += joint.format(f"high{k}", f'["crank{k}", "top"]', f"[{end}, [{k - 1}.0, 0.0]]")
    with pytest.raises(InputError, match="in whose direction the mechanism stays closed, got one by which the row"):
        model(tmp_path, text).simulate(until=0.1, sensitivities="length", integrator="dop853")


ODE = [name for name in METHODS.names if {"ode", "one-step"} & set(METHODS.get(name, "method").forms)]


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize(
    ("name", "number", "quantity", "settings"),
    [
        ("slider-crank", "rod_mass", "slider.x", {"step": 2e-3, "until": 0.4}),
        ("andrews", "bodies.K2.mass", "K1.theta", {"step": 5e-5, "until": 1e-2}),
        ("bricard", "mechanism.gravity[1]", "rod3.x", {"step": 5e-3, "until": 0.5}),
    ],
)
def test_mechanisms_of_the_catalogue(name, number, quantity, settings, coordinates):
    own = lift_numbers("here", symgen.load(name).mechanism, (number,))
    model, key = Model(own.mechanism), own.keys[number]
    value = model.parameters()[key]
    settings = {**settings, "integrator": "rk4", "times": [settings["until"]], "coordinates": coordinates}
    run = model.simulate(sensitivities=key, method="lagrange", **settings)
    expected = differences(model, key, value, 1e-2 * value, quantity, method="lagrange", **settings)
    assert run.gradient(quantity).row()[key] == pytest.approx(expected, rel=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("method", of_turn(ODE, 9))
def test_every_method_that_explicit_schemes_solve(method):
    four_bar = symgen.load("four-bar")
    limits = {"max_violation": 1.0, "max_energy_error": 1e3}
    settings = {"method": method, "integrator": "rk4", "step": 1e-2, "until": 0.3, "times": [0.3], **limits}
    run = four_bar.simulate(sensitivities=("crank_mass", "rocker_mass"), **settings)
    for name, mass in (("crank_mass", 2.0), ("rocker_mass", 5.0)):
        for quantity in ("crank.theta", "coupler.vx"):
            expected = differences(four_bar, name, mass, 3e-2, quantity, **settings)
            found = run.gradient(quantity).row()[name]
            # penalties multiply the rounding of what they hold back
            assert found == pytest.approx(expected, rel=1e-5 if method == "penalty" else 1e-8), quantity
