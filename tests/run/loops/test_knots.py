"""Points of tables that are read over the state: adaptive steps end where the motion passes them."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import PchipInterpolator
from support.checks import assert_same_motion
from support.pushed import pushed_mass

import symgen
from symgen.describe import catalogue
from symgen.describe.facts.kinks import Discontinuity
from symgen.describe.table_functions import Table
from symgen.run.compiling.events import switch_of_event
from symgen.study.ensemble.parameter_sweep import sweep

#: Force over position, linear between points; constant beyond them.
X, Y = (0.2, 0.37, 0.61, 0.85, 1.1), (1.0, -6.0, 9.0, -8.0, 2.0)
MASS, SPEED, UNTIL = 2.0, 1.5, 1.0
SLIDER = pushed_mass("passing", "size*push(mass.x)", X, Y, "size", MASS, SPEED, UNTIL)
#: The same equation in space: 2 kg m^2 about a hinge, and a torque over its angle.
HINGE = f"""
[mechanism]
name = "turning"
space = "spatial"
[run]
until = {UNTIL}
step = 1e-2
[tables.push]
x = {list(X)}
y = {list(Y)}
[bodies.rod]
mass = 1.0
inertia = [0.1, {MASS}, {MASS - 0.25}]
position = [0.5, 0.0, 0.0]
angular_velocity = [0.0, 0.0, {SPEED}]
points = {{ A = [-0.5, 0.0, 0.0] }}
[joints.hinge]
type = "revolute"
between = ["ground", "rod"]
at = [[0.0, 0.0, 0.0], "A"]
axis = [0.0, 0.0, 1.0]
[forces.push]
type = "torsional-spring-damper"
joint = "hinge"
actuator = "push(angle)"
"""
TIMES = np.linspace(0.0, UNTIL, 201)


@pytest.fixture(scope="module")
def passing(tmp_path_factory: pytest.TempPathFactory) -> symgen.Model:
    file = tmp_path_factory.mktemp("knots") / "passing.toml"
    file.write_text(SLIDER, encoding="utf-8")
    return symgen.load(file)


def passed(times: np.ndarray, size: float = 1.0) -> tuple[np.ndarray, np.ndarray]:
    """Position and speed of the mass, which never turns round: piece by piece sines or hyperbolic ones, in one form.

    On a piece x'' = c (x - x0) + f, so x - x0 = v S + f C with S = sinh(w t)/w, C = (cosh(w t) - 1)/w^2, w^2 = c
    complex; the time at which a piece ends by bisection.
    """
    edges = [0.0, *X, math.inf]
    slopes = [0.0, *np.diff(Y) / np.diff(X), 0.0]
    at = [Y[0], *Y]

    def motion(v: float, f: float, c: float, t: np.ndarray | float) -> tuple[np.ndarray, np.ndarray]:
        w = np.sqrt(complex(c)) if c else 1e-30
        s, k = (np.sinh(w * t) / w, (np.cosh(w * t) - 1.0) / w**2) if c else (t, 0.5 * np.square(t))
        return np.real(v * s + f * k), np.real(v * (1.0 + c * k) + f * s)

    x, v = np.zeros_like(times), np.zeros_like(times)
    t0, v0 = 0.0, SPEED
    for begin, end, slope, force in zip(edges[:-1], edges[1:], slopes, at, strict=True):
        c, f = size * slope / MASS, size * force / MASS
        low, high = 0.0, 10.0 * UNTIL
        while low < (middle := 0.5 * (low + high)) < high and end < math.inf:
            grid = middle * np.linspace(0.0, 1.0, 9)
            low, high = (low, middle) if np.any(motion(v0, f, c, grid)[0] >= end - begin) else (middle, high)
        last = high if end < math.inf else math.inf
        here = (times >= t0) & (times <= t0 + last)
        moved, speed = motion(v0, f, c, times[here] - t0)
        x[here], v[here] = begin + moved, speed
        if last < math.inf:
            t0, v0 = t0 + last, float(motion(v0, f, c, last)[1])
    assert np.all(v > 0.0), "it is made for a mass that does not turn round"
    return x, v


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("integrator", ["dop853", "dopri5"])
def test_steps_end_at_points_of_a_table_of_state(passing: symgen.Model, integrator: str, coordinates: str) -> None:
    """Straight lines, the worst of tables: a step across a point is refused, or off by a hundred tolerances."""
    x, v = passed(TIMES)
    for rtol in (1e-8, 1e-10):
        result = passing.simulate(
            method="lagrange", integrator=integrator, rtol=rtol, atol=rtol, times=TIMES, coordinates=coordinates
        )
        # a step that ends behind a point instead of before it may be refused: once for each of the five, and some more
        assert result.status == "ok" and result.rejected <= 10
        # a tolerance a step at most, in some tens of steps of which few are as bad
        assert max(np.abs(result.q["mass.x"] - x).max(), np.abs(result.v["mass.vx"] - v).max()) < 20.0 * rtol


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_forces_read_angles_of_their_own_in_space(tmp_path: Path, coordinates: str) -> None:
    file = tmp_path / "turning.toml"
    file.write_text(HINGE, encoding="utf-8")
    settings = {"integrator": "dop853", "rtol": 1e-9, "atol": 1e-9, "times": TIMES, "coordinates": coordinates}
    result = symgen.load(file).simulate(method="lagrange", **settings)
    assert result.status == "ok" and result.rejected <= 10
    assert np.abs(result.v["rod.wz"] - passed(TIMES)[1]).max() < 20.0 * 1e-9


@pytest.mark.slow
def test_rows_of_a_sweep_are_single_runs(passing: symgen.Model) -> None:
    sizes, settings = [0.7, 1.0], {"method": "lagrange", "integrator": "dop853", "times": [0.3, 1.0]}
    found = sweep(passing, {"size": sizes}, quantities=("mass.x",), **settings)
    for i, size in enumerate(sizes):
        alone = passing.simulate(**settings, parameters={"size": size})
        assert_same_motion(found.values[i, 0], alone.q["mass.x"])
        np.testing.assert_allclose(found.values[i, 0], passed(np.array([0.3, 1.0]), size)[0], rtol=0.0, atol=1e-7)


def test_events_are_found_between_points(passing: symgen.Model) -> None:
    """Half-way between two points, and at one."""
    settings = {"method": "lagrange", "integrator": "dop853", "rtol": 1e-9, "atol": 1e-9, "times": [0.0, UNTIL]}
    found = passing.simulate(record_when=("mass.x > 0.73", "mass.x > 0.85"), **settings)
    times = np.array([event.t for event in found.events])
    np.testing.assert_allclose(passed(times)[0], [0.73, 0.85], rtol=0.0, atol=1e-7)
    plain = passing.simulate(**settings)
    assert found.steps == plain.steps
    assert_same_motion(found.q["mass.x"][-1], plain.q["mass.x"][-1])


def test_a_run_that_goes_on_ends_steps_there_too(passing: symgen.Model) -> None:
    settings = {"method": "lagrange", "integrator": "dopri5", "rtol": 1e-9, "atol": 1e-9}
    first = passing.simulate(until=0.35, times=[0.0, 0.35], **settings)
    second = passing.simulate(start=first, times=[0.35, 0.6, UNTIL], **settings)
    assert second.status == "ok" and second.rejected <= 10
    np.testing.assert_allclose(second.q["mass.x"], passed(second.t)[0], rtol=0.0, atol=1e-7)


def test_tables_of_many_points_do_not_take_a_step_each(tmp_path: Path) -> None:
    """Fifteen hundred points of a sine: kinks far below the tolerance."""
    x = np.linspace(0.0, 4.0, 1500)
    file = tmp_path / "fine.toml"
    text = SLIDER.replace(str(list(X)), str(x.tolist())).replace(str(list(Y)), str(np.sin(3.0 * x).tolist()))
    file.write_text(text.replace("[bodies.mass]", 'interpolation = "cubic"\n[bodies.mass]'), encoding="utf-8")
    result = symgen.load(file).simulate(method="lagrange", integrator="dop853", rtol=1e-7, atol=1e-7, times=TIMES)
    points = np.count_nonzero(x < result.q["mass.x"][-1])
    assert result.status == "ok" and result.steps < 0.2 * points
    fine = solve_ivp(lambda t, z: [z[1], np.sin(3.0 * z[0]) / MASS], (0.0, UNTIL), [0.0, SPEED], rtol=1e-10, atol=1e-10)
    np.testing.assert_allclose(result.q["mass.x"][-1], fine.y[0, -1], rtol=0.0, atol=1e-6)


def test_arguments_whose_rate_is_not_defined_stop_no_run(tmp_path: Path) -> None:
    """The rate of sqrt(x) is infinite where the mass starts."""
    file = tmp_path / "root.toml"
    file.write_text(SLIDER.replace("push(mass.x)", "push(sqrt(mass.x))"), encoding="utf-8")
    result = symgen.load(file).simulate(method="lagrange", integrator="dop853", times=[0.0, 0.5])

    def rates(t: float, z: np.ndarray) -> list[float]:
        return [z[1], float(np.interp(math.sqrt(z[0]), X, Y)) / MASS]

    fine = solve_ivp(rates, (0.0, 0.5), [0.0, SPEED], rtol=1e-10, atol=1e-10, max_step=1e-3)
    assert result.status == "ok"
    np.testing.assert_allclose(result.q["mass.x"][-1], fine.y[0, -1], rtol=0.0, atol=1e-6)


def test_constant_steps_keep_their_grid(passing: symgen.Model) -> None:
    assert passing.simulate(method="lagrange", integrator="rk4").steps == 100


@pytest.mark.slow
def test_the_engine_keeps_to_an_equation_of_its_crank_alone() -> None:
    """Over the angle, whose points are known: d(omega)/d(theta), piece by piece between them, by SciPy."""
    model, raw = symgen.load("engine"), catalogue.raw("engine")["tables"]["pressure"]
    x, y = np.array(raw["x"]), np.array(raw["y"])
    period = x[-1]
    pressure = PchipInterpolator(np.r_[x[:-1] - period, x, x[1:] + period], np.r_[y[:-1], y, y[1:]])
    p = model.parameters()
    r, rod, area = p["stroke"] / 2, p["rod_length"], math.pi * p["bore"] ** 2 / 4

    def inertia(theta: complex) -> complex:
        """What half of omega^2 is multiplied by in the kinetic energy."""
        sine, cosine = np.sin(theta), np.cos(theta)
        root = np.sqrt(rod**2 - (r * sine) ** 2)
        turned, piston = r * cosine / root, -r * sine - r**2 * sine * cosine / root
        # the rod's centre of mass is a third of its length from the crank's pin
        along, across = -r * sine + (piston + r * sine) / 3.0, r * cosine * 2.0 / 3.0
        own = p["rod_mass"] * rod**2 / 12.0
        moving = p["rod_mass"] * (along**2 + across**2) + own * turned**2 + p["piston_mass"] * piston**2
        return p["flywheel"] + moving

    def lift(theta: complex) -> complex:
        """Where the piston is."""
        return r * np.cos(theta) + np.sqrt(rod**2 - (r * np.sin(theta)) ** 2)

    def slope(function: Callable[[complex], complex], theta: float) -> float:
        return float(np.imag(function(theta + 1e-30j))) / 1e-30

    def rates(theta: float, z: np.ndarray) -> list[float]:
        _, omega = z
        gas, brake = -1e5 * area * pressure(theta % period), -p["brake"] * (omega / p["speed"]) ** 2
        torque = gas * slope(lift, theta) + brake
        domega = (torque - 0.5 * slope(inertia, theta) * omega**2) / (inertia(theta).real * omega)
        return [1.0 / omega, domega]

    times = np.linspace(0.0, 0.1, 201)
    # a tolerance a step at most, in hundreds of steps; across points it would be thousands
    for integrator, rtol, most in (("dop853", 1e-8, 20.0), ("dop853", 1e-10, 20.0), ("dopri5", 1e-10, 100.0)):
        result = model.simulate(integrator=integrator, rtol=rtol, atol=rtol, until=0.1, times=times)
        assert result.status == "ok" and result.rejected <= 0.1 * (result.steps + result.rejected)
        theta, omega = result.q["crank.theta"], result.v["crank.omega"]
        z, found = np.array([0.0, p["speed"]]), [np.array([0.0, p["speed"]])]
        knots = [x_ + k * period for k in range(3) for x_ in x[:-1]]
        stops = sorted({*(k for k in knots if k < theta[-1]), *theta})
        for a, b in pairwise(stops):
            z = solve_ivp(rates, (a, b), z, method="DOP853", rtol=1e-12, atol=1e-13, first_step=b - a).y[:, -1]
            if b in set(theta):
                found.append(z)
        t, speed = np.array(found).T
        # a time that is off is an angle that is off by speed times that
        worst = max(np.abs((t - times) * omega / theta[-1]).max(), np.abs(speed / omega - 1.0).max())
        assert worst < most * rtol, (integrator, rtol, worst / rtol)


DIP = """[mechanism]
name = "dip"
gravity = [-0.4, 0.0]
[bodies.bob]
type = "point"
mass = 2.0
position = [0.0, 0.0]
velocity = [1.0, 0.0]
[outputs]
other = "integral(bob.x)"
narrow = "integral(max(0, 0.004 - abs(bob.x - place)))"
[parameters]
place = 0.5
"""


@pytest.mark.slow
def test_rows_done_one_by_one_take_the_steps_of_integrals_nobody_asks_for(tmp_path: Path) -> None:
    """Single runs add up what all outputs ask for, and their steps follow it; rows that are them left it out."""
    file = tmp_path / "dip.toml"
    # without kinks it is the event that makes rows single runs; integrands that are steep shorten steps
    text = DIP.replace("max(0, 0.004 - abs(bob.x - place))", "1/(1e-3 + (bob.x - place)**2)")
    file.write_text(text.replace("-0.4, 0.0]", "-0.4, -9.81]"), encoding="utf-8")
    model, settings = symgen.load(file), {"integrator": "dopri5", "rtol": 1e-6, "until": 1.0, "method": "lagrange"}
    found = sweep(model, {"place": [0.3, 0.6]}, quantities=["bob.x"], record_when="bob.x > 0.4", **settings)
    for k, place in enumerate((0.3, 0.6)):
        single = model.simulate(parameters={"place": place}, record_when="bob.x > 0.4", **settings)
        assert found["steps"][k] == single.steps


def test_methods_with_momenta_run_rows_without_integrals_nobody_asks_for(tmp_path: Path) -> None:
    """They hold no integrals; a sweep that wants none of them is right without."""
    file = tmp_path / "dip.toml"
    file.write_text(DIP, encoding="utf-8")
    settings = {"integrator": "dop853", "until": 0.1, "method": "augmented-hamiltonian"}
    found = sweep(symgen.load(file), {"place": [0.3, 0.6]}, quantities=["bob.x"], **settings)
    assert list(found.status) == ["ok", "ok"]


@pytest.mark.by_turns(4)
@pytest.mark.fast("101-linear-dop853", "101-linear-abm", "101-linear-picard", "101-linear-sdirk", "1001-pchip-dopri5")
@pytest.mark.parametrize("integrator", ["dop853", "dopri5", "abm", "picard", "sdirk", "radau5"])
@pytest.mark.parametrize(("points", "how"), [(101, "linear"), (1001, "pchip"), (6001, "linear")])
def test_a_spike_of_a_table_is_not_stepped_over(tmp_path: Path, points: int, how: str, integrator: str) -> None:
    """A bump of one point among many that are flat, as on a road: a step over all of it would see nothing."""
    x = np.linspace(0.0, 10.0, points)
    y = np.zeros(points)
    y[int(0.535 * points)] = 0.5 / x[1]
    text = f'[mechanism]\nname = "road"\ngravity = [0.0, 0.0]\n[run]\nuntil = 9.0\n[tables.bump]\nx = {x.tolist()}\n'
    text += f'y = {y.tolist()}\ninterpolation = "{how}"\n[bodies.a]\ntype = "point"\nmass = 1.0\n'
    text += "position = [0.0, 0.0]\nvelocity = [1.0, 0.0]\n"
    text += '[forces.push]\ntype = "force"\nbody = "a"\nforce = ["0", "bump(a.x)"]\n'
    file = tmp_path / "road.toml"
    file.write_text(text, encoding="utf-8")
    result = symgen.load(file).simulate(method="lagrange", integrator=integrator, rtol=1e-8)
    # triangle and bell have the same area; two hundred tolerances of a speed of 1 m/s, as steps around it are many
    assert result["a.vy"][-1] == pytest.approx(0.5, abs=2e-6)


def test_points_that_bend_nothing_are_passed() -> None:
    """Those of a fine smooth table cost no steps; those around a spike of it do."""
    x = np.linspace(0.0, 1.0, 1001)
    smooth, spiked = np.sin(6.0 * x), np.sin(6.0 * x)
    spiked[500] += 1.0
    counts = []
    for y in (smooth, spiked):
        table = Table("t", tuple(x), tuple(y), "cubic")
        counts.append(len(switch_of_event(Discontinuity(table.x[0], table), 1e-8).points))
    # straight lines begin at both ends; the waves of a spline beside a spike fall by 3.7 from point to point
    assert counts[0] == 2 and 5 <= counts[1] <= 60
