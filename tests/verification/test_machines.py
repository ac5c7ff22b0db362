"""The machines of the catalogue: each runs as it comes, and its numbers are those of closed forms and SciPy.

Nothing here reads equations from symgen: positions are intersections of circles, motions are integrated by SciPy from
equations of one or two coordinates, tables are SciPy's splines.
"""

import math
import re
from functools import cache
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad, solve_ivp
from scipy.interpolate import CubicSpline, PchipInterpolator
from scipy.linalg import solve_continuous_are

import symgen
from symgen.describe import catalogue
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate

NAMES = (
    *("belt-oscillator", "bent-arc", "bicycle", "cam-follower", "cantilever", "cart-pole"),
    *("curved-lever", "dry-four-bar", "engine"),
    *(
        "flexible-slider-crank",
        "flying-spaghetti",
        "geneva",
        "inverted-pendulum",
        "jansen-leg",
        "klann-leg",
        "rocking-block",
        "scissor-lift",
        "shaper",
        "skidding-wheel",
        "slider-crank-with-clearance",
        "spin-up",
    ),
    *("toggle-press", "wiper", "woodpecker"),
)
GRAVITY = 9.81


@cache
def model(name):
    """One compilation for all tests of a machine."""
    return symgen.load(name)


@cache
def run(name):
    """The machine as it comes; its parameters and the table of this name, if it has one."""
    result = model(name).simulate()
    assert result.status == "ok" and not result.warnings and not result.notes, (result.reason, result.warnings)
    return result


def table(name, which):
    """Points of a table of the file."""
    raw = catalogue.raw(name)["tables"][which]
    return np.array(raw["x"]), np.array(raw["y"])


def meet(p, r, q, s, side):
    """Where circles about p and q meet, left of the way from p to q (side 1) or right of it (-1); points (2, ...)."""
    d = q - p
    square = d[0] ** 2 + d[1] ** 2
    along = (r**2 - s**2 + square) / (2 * square)
    across = side * np.sqrt(r**2 / square - along**2)
    return p + along * d + across * np.stack([-d[1], d[0]])


def polar(length, angle):
    return length * np.stack([np.cos(angle), np.sin(angle)])


def fixed(x, y, like):
    """A point that stands still, beside angles."""
    return np.stack([x + 0 * like, y + 0 * like])


def place(result, point):
    return np.stack([result.points[f"{point}.x"], result.points[f"{point}.y"]])


def test_machines_stand_beside_the_studied_entries(capsys):
    import json

    from symgen.cli import main

    assert catalogue.names(catalogue.MACHINES) == NAMES
    assert not set(NAMES) & set(catalogue.names())
    assert main(["list", "--json"]) == 0
    listed = {row["name"]: row["group"] for row in json.loads(capsys.readouterr().out)["mechanisms"]}
    assert {name for name, group in listed.items() if group == "machines"} == set(NAMES)
    assert set(listed) == set(catalogue.all_names())
    assert all(entry.title and entry.source and not entry.sized for entry in catalogue.entries(catalogue.MACHINES))


def test_the_file_of_a_page_is_the_entry():
    page = Path(__file__).parents[2] / "docs" / "tutorials" / "wiper.md"
    (text,) = re.findall(r"^```toml\n(.*?)^```$", page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
    assert validate(parse_toml(text, "wiper"), "wiper") == model("wiper").mechanism


def test_the_part_of_a_file_on_a_page_stands_in_the_entry():
    root = Path(__file__).parents[2]
    page = (root / "docs" / "tutorials" / "scissor-lift.md").read_text(encoding="utf-8")
    (text,) = re.findall(r"^```text\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
    whole = (root / "symgen" / "describe" / "catalogue" / "machines" / "scissor-lift.toml").read_text(encoding="utf-8")
    assert set(text.splitlines()) <= set(whole.splitlines())


@pytest.mark.slow
@pytest.mark.parametrize("name", ["cantilever", "flexible-slider-crank"])
def test_the_beams_run_as_they_come(name):
    """Loads and speeds are such that beams bend by some percent of their lengths; energy keeps its balance."""
    result = run(name)
    assert result.energy_drift_max <= 1e-4 * np.ptp(result.kinetic)
    if name == "cantilever":  # a load that is put on at once swings by nearly twice the 0.302 at rest
        assert -0.61 < result["rod.end.y"].min() < -0.5
    else:
        assert_allclose(np.hypot(result["rod.start.x"], result["rod.start.y"]), 0.15, atol=1e-9)
        assert 1e-4 < np.abs(result.outputs["deflection"]).max() < 5e-3


@pytest.mark.slow
def test_the_block_on_the_belt_slips_and_sticks() -> None:
    """It leaves the belt at 0.06 m and comes to rest on it at 0.02 m; the period is that of the closed form."""
    result = run("belt-oscillator")
    assert [event.name for event in result.events] == ["contact.slip", "contact.stick"] * 4 + ["contact.slip"]
    slips = np.array([event.t for event in result.events[::2]])
    assert_allclose(slips, 0.6 + 0.8068887871591406 * np.arange(5), rtol=0, atol=1e-7)
    places = [event.q["block.x"] for event in result.events]
    assert_allclose(places, [0.06, 0.02] * 4 + [0.06], rtol=0, atol=1e-7)


# -- dry-four-bar ------------------------------------------------------------------------------------------------------


def dry_four_bar(theta):
    """Angles of its pins and its potential energy at angles of its crank."""
    b = polar(2.0, theta)
    c = meet(b, 8.0, fixed(10.0, 0.0, theta), 5.0, 1)
    coupler, rocker = (np.unwrap(np.arctan2(*d[::-1])) for d in (c - b, c - fixed(10.0, 0.0, theta)))
    return np.stack([theta, coupler - theta, rocker - coupler, rocker]), GRAVITY * (5 * b[1] + 6.5 * c[1])


@pytest.mark.slow
def test_dry_pins_take_the_height_between_turns() -> None:
    """Of each half swing: 4 N m times the ways of all pins, which turn round at dead centres, too."""
    result = run("dry-four-bar")
    turns = [event for event in result.events if event.name in ("A.reverse", "A.stick")]
    assert [event.name for event in turns] == ["A.reverse"] * 14 + ["A.stick"]
    thetas = [math.pi / 3, *(event.q["crank.theta"] for event in turns)]
    for before, after in pairwise(thetas):
        angles, energy = dry_four_bar(np.linspace(before, after, 20_001))
        assert_allclose(energy[0] - energy[-1], 4.0 * np.abs(np.diff(angles, axis=1)).sum(), rtol=0, atol=1e-4)
    energy = dry_four_bar(np.array(thetas))[1]
    assert_allclose(result.outputs["lost"][-1], energy[0] - energy[-1], rtol=0, atol=1e-4)
    assert abs(thetas[-1] + 2.07596285039) < 1e-6
    assert_allclose(result["crank.theta"][result.t > turns[-1].t], thetas[-1], rtol=0, atol=1e-12)


# -- toggle-press ------------------------------------------------------------------------------------------------------


def toggle(p, phi, force):
    """Inertia of the press about the angle of its links, and the torque of the piston and of weights."""
    a, m = p["link_length"], p["link_mass"]
    inertia = m * a**2 * (1 / 4 + 2 / 12 + np.cos(phi) ** 2 / 4 + 9 / 4 * np.sin(phi) ** 2)
    inertia += p["ram_mass"] * (2 * a * np.sin(phi)) ** 2
    return inertia, force * a * np.cos(phi) - GRAVITY * 2 * a * np.sin(phi) * (m + p["ram_mass"])


def press(p, phi, force, until, event=None):
    """The press from rest; the change of its inertia by a central difference."""
    way = math.copysign(1.0, force)

    def rate(t, y):
        inertia, torque = toggle(p, y[0], force)
        change = (toggle(p, y[0] + 1e-5, 0.0)[0] - toggle(p, y[0] - 1e-5, 0.0)[0]) / 2e-5
        rubbing = way * p["rubbing"] * 2 * p["link_length"] * np.sin(y[0])
        return y[1], (torque - rubbing - change * y[1] ** 2 / 2) / inertia

    return solve_ivp(rate, (0.0, until), (phi, 0.0), method="DOP853", rtol=1e-11, atol=1e-12, events=event)


def test_the_press_strikes_the_die_and_is_held_by_it() -> None:
    result = run("toggle-press")
    p, a = result.parameters, result.parameters["link_length"]

    def gap(t, y):
        return y[0] - p["shut"]

    gap.terminal = True
    down = press(p, p["open"], -p["push"], 1.0, gap)
    assert [event.name for event in result.events] == [
        *("guide.lower.hit", "guide.stick", "guide.lower.rest", "guide.slip", "guide.lower.leave")
    ]
    assert abs(result.events[0].t - down.t[-1]) < 1e-6
    assert abs(result.events[3].t - p["back"]) < 1e-12
    held = np.searchsorted(result.t, 0.2)
    inertia, torque = toggle(p, p["shut"], -p["push"])
    assert_allclose(result.outputs["guide.lower.force"][held], -torque / (2 * a * math.sin(p["shut"])), rtol=1e-6)
    rubbed = p["rubbing"] * 2 * a * (math.cos(p["shut"]) - math.cos(p["open"]))
    assert_allclose(result.outputs["lost"][held], rubbed + inertia * down.y[1, -1] ** 2 / 2, rtol=1e-6)
    up = press(p, p["shut"], p["pull"], result.t[-1] - p["back"])
    assert_allclose(result["upper.theta"][-1] + math.pi / 2, up.y[0, -1], rtol=0, atol=1e-5)


# -- wiper -------------------------------------------------------------------------------------------------------------


def wiper_arm(p, theta):
    """Angle of the wiper's arm at an angle of its crank; complex for a derivative by a complex step."""
    tip, pivot = polar(p["crank_length"], theta), fixed(p["pivot_x"], p["pivot_y"], theta)
    b = meet(tip, p["link_length"], pivot, p["rocker_length"], 1)
    return tip, b, -np.arctan((b[0] - pivot[0]) / (b[1] - pivot[1]))


def wiper_rates(p, theta):
    """Inertia of the whole wiper about its crank, and the arm's rate over the crank's."""
    h = 1e-30
    tip, b, arm = wiper_arm(p, theta + 1j * h)
    vtip, vb, rate = tip.imag / h, b.imag / h, arm.imag / h
    middle, turn = (vtip + vb) / 2, np.hypot(*(vb - vtip)) / p["link_length"]
    link = 0.2 * (middle @ middle + p["link_length"] ** 2 / 12 * turn**2)
    arm_inertia = p["arm_mass"] * p["arm_length"] ** 2 * (1 / 12 + 1 / 4)
    return p["rotor"] + link + arm_inertia * rate**2, rate


def test_the_wiper_swings_as_its_four_bar_says():
    result = run("wiper")
    _, b, arm = wiper_arm(result.parameters, result["crank.theta"])
    assert_allclose(result["arm.theta"], arm, atol=1e-11)  # |Phi| of 5e-14 m over a rocker of 0.08 m
    assert_allclose(place(result, "arm.b"), b, atol=1e-12)


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_the_wiper_turns_as_an_equation_of_its_crank_alone_says():
    """J w' + J' w^2/2 = torque; J' by a central difference, whose error of 1e-9 stays below the bound."""
    result = model("wiper").simulate(until=1.0, times=(0.0, 0.5, 1.0))
    p, curve = result.parameters, PchipInterpolator(*table("wiper", "curve"))

    def rates(_, y):
        theta, omega, _ = y
        inertia, ratio = wiper_rates(p, theta)
        slope = (wiper_rates(p, theta + 1e-5)[0] - wiper_rates(p, theta - 1e-5)[0]) / 2e-5
        torque = curve(omega) - p["friction"] * np.tanh(ratio * omega / p["creep"]) * ratio
        return [omega, (torque - slope * omega**2 / 2) / inertia, curve(omega) * omega]

    found = solve_ivp(rates, (0, 1), [0.5, 0.0, 0.0], "DOP853", rtol=1e-9, atol=1e-11, t_eval=[0.0, 0.5, 1.0]).y
    assert_allclose(result["crank.theta"], found[0], atol=1e-5)
    assert_allclose(result.outputs["energy"], found[2], atol=1e-4)


# -- legs --------------------------------------------------------------------------------------------------------------


def jansen(p, theta):
    """Points of Jansen's leg by intersections of circles."""
    tip, pivot = polar(p["m"], theta), fixed(-p["a"], -p["l"], theta)
    shoulder = meet(pivot, p["b"], tip, p["j"], 1)
    hip = meet(pivot, p["d"], shoulder, p["e"], 1)
    knee = meet(pivot, p["c"], tip, p["k"], -1)
    end = meet(hip, p["f"], knee, p["g"], -1)
    return {
        "upper.shoulder": shoulder,
        "upper.hip": hip,
        "leg.knee": knee,
        "leg.foot": meet(end, p["h"], knee, p["i"], -1),
    }


def klann(p, theta):
    """Points of Klann's leg: the lengths are distances of the patent's coordinates."""
    nine, eleven, fifteen, elbow, pin, foot, knee, hip = (
        p["scale"] * np.array(c)
        for c in (
            (1.366, 1.366),
            (1.009, 0.574),
            (1.599, 0.75),
            (0.741, 0.75),
            (1.331, 0.75),
            (0, 0),
            (0.232, 0.866),
            (0.866, 1.5),
        )
    )

    def length(a, b):
        return math.hypot(*(a - b))

    c = fixed(*fifteen, theta) + polar(length(fifteen, pin), theta)
    e = meet(c, length(pin, elbow), fixed(*eleven, theta), length(eleven, elbow), -1)
    k = meet(c, length(pin, knee), e, length(elbow, knee), -1)
    h = meet(fixed(*nine, theta), length(nine, hip), k, length(knee, hip), -1)
    return {
        "connecting.elbow": e,
        "leg.knee": k,
        "leg.hip": h,
        "leg.foot": meet(k, length(knee, foot), h, length(hip, foot), -1),
    }


LEGS = {"jansen-leg": (jansen, 0.0), "klann-leg": (klann, math.pi)}


@pytest.mark.slow
@pytest.mark.slow_cases("klann-leg")
@pytest.mark.parametrize("name", LEGS)
def test_a_leg_walks_where_circles_meet(name):
    result, (points, start) = run(name), LEGS[name]
    theta = start + result.parameters["speed"] * result.t
    assert_allclose(result["crank.theta"], theta, atol=1e-12)
    for point, found in points(result.parameters, theta).items():
        assert_allclose(place(result, point), found, atol=1e-11)


@pytest.mark.slow
def test_klann_has_the_stride_that_the_patent_says():
    """Half a turn of the crank after its start the foot is one stride ahead, on the same height."""
    result = run("klann-leg")
    stride = result.parameters["scale"]
    half = np.searchsorted(result.t, 1.0 - 1e-9)
    assert result.points["leg.foot.x"][half] == pytest.approx(stride, abs=1e-3 * stride)
    assert result.points["leg.foot.y"][half] == pytest.approx(0.0, abs=1e-3 * stride)


@pytest.mark.slow
@pytest.mark.parametrize("name", LEGS)
def test_a_turn_of_a_leg_takes_the_work_on_the_ground(name):
    """Weights and inertia give back in a turn what they take; the ground's pull along the foot's way is left."""
    result, (points, start) = run(name), LEGS[name]
    p = result.parameters
    theta = start + np.linspace(0, 2 * np.pi, 20001)
    foot = points(p, theta)["leg.foot"]
    speed = np.gradient(foot[0], theta, edge_order=2) * p["speed"]
    pressed = p["load"] * (1 - np.tanh((foot[1] - p["soil"]) / p["give"])) / 2
    work = np.trapezoid(p["pull"] * pressed * np.tanh(speed / 0.05) * speed, theta / p["speed"])
    assert result.outputs["energy"][-1] == pytest.approx(work, rel=1e-6)


# -- scissor lift ------------------------------------------------------------------------------------------------------


def lift_energy(p, angle):
    """Potential energy of the lift and length of its cylinder, at an inclination of the arms."""
    a, c, s = p["arm_length"], np.cos(angle), np.sin(angle)
    foot = np.stack([(1 - p["foot"]) * a * c, p["foot"] * a * s])
    head = np.stack([(1 - p["head"]) * a * c, (1 + p["head"]) * a * s])
    length = np.sqrt(np.sum((head - foot) ** 2, axis=0))
    along = (head - foot) / length
    masses = ((2 * 25.0, a * s / 2), (2 * 25.0, 1.5 * a * s), (p["platform_mass"] + p["load"], 2 * a * s))
    cylinder = 12.0 * (foot[1] + 0.3 * along[1]) + 6.0 * (head[1] - 0.3 * along[1])
    return GRAVITY * (sum(m * y for m, y in masses) + cylinder), length


def test_the_cylinder_of_the_lift_gives_what_virtual_work_says():
    """The ramp ends at 8 s at rest, so behind it the force is dV/ds."""
    result, h = run("scissor-lift"), 1e-30
    p, angle = result.parameters, result["left.theta"]
    energy, length = lift_energy(p, angle + 1j * h)
    effort, still = result.elements["lift.effort"], result.t > 8.0
    assert still.sum() > 10
    assert_allclose(effort[still], (energy.imag / length.imag)[still], rtol=1e-10)
    assert effort[0] == pytest.approx(energy.imag[0] / length.imag[0], rel=1e-10)
    assert_allclose(result.elements["lift.displacement"], length.real, atol=1e-12)
    assert result.outputs["energy"][-1] == pytest.approx(energy.real[-1] - energy.real[0], rel=1e-8)


# -- quick return ------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_ram_returns_in_half_the_turn_of_its_cut():
    """The lever turns back where it touches the crank's circle, at crank angles of -30 and 210 degrees."""
    events = model("shaper").simulate(until=2.2, output_step=1.1).events
    angles = np.array([event.q["crank.theta"] for event in events if event.name == "turned"])
    assert len(angles) >= 3
    expected = np.array([-np.pi / 6, 7 * np.pi / 6, 11 * np.pi / 6])
    assert_allclose(angles[:3], expected, atol=1e-9)


@pytest.mark.slow
def test_the_ram_is_where_the_lever_puts_it():
    result = run("shaper")
    p, theta = result.parameters, result["crank.theta"]
    pin = polar(p["crank_length"], theta) + fixed(0.0, p["distance"], theta)
    tip = p["lever_length"] * pin / np.hypot(*pin)
    ram = tip[0] + np.sqrt(p["link_length"] ** 2 - (p["ram_height"] - tip[1]) ** 2)
    assert_allclose(result["ram.x"], ram, atol=1e-12)
    assert result["crank.omega"].min() > 0.8 * p["idle"], "the flywheel carries the crank through the cut"


# -- engine ------------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_piston_stands_where_the_crank_puts_it():
    result = run("engine")
    p, theta = result.parameters, result["crank.theta"]
    r = p["stroke"] / 2
    assert_allclose(
        result["piston.x"], r * np.cos(theta) + np.sqrt(p["rod_length"] ** 2 - (r * np.sin(theta)) ** 2), atol=1e-12
    )


@pytest.mark.slow
def test_the_gas_gives_in_a_cycle_what_is_enclosed_in_its_diagram():
    result = model("engine").simulate(stop_when="crank.theta > 4*pi", output_step=0.01)
    p, (x, y) = result.parameters, table("engine", "pressure")
    assert result["crank.theta"][-1] == pytest.approx(4 * math.pi, abs=1e-11)
    period = x[-1]
    pressure = PchipInterpolator(np.r_[x[:-1] - period, x, x[1:] + period], np.r_[y[:-1], y, y[1:]])
    r, rod, area = p["stroke"] / 2, p["rod_length"], math.pi * p["bore"] ** 2 / 4

    def power(theta):
        root = math.sqrt(rod**2 - (r * math.sin(theta)) ** 2)
        slope = -r * math.sin(theta) - r**2 * math.sin(theta) * math.cos(theta) / root
        return -1e5 * area * pressure(theta) * slope

    work = sum(quad(power, a, b, epsrel=1e-10)[0] for a, b in pairwise(x))
    assert result.outputs["work"][-1] == pytest.approx(work, rel=1e-6)


# -- cam ---------------------------------------------------------------------------------------------------------------


def test_the_follower_keeps_the_spline_and_presses_on_the_cam():
    result, (x, y) = run("cam-follower"), table("cam-follower", "lift")
    p, spline = result.parameters, CubicSpline(x, y, bc_type="periodic")
    angle = p["speed"] * result.t
    lift, speed, acceleration = (spline(angle, k) * p["speed"] ** k for k in range(3))
    assert_allclose(result["follower.y"], lift, atol=1e-12)
    weight = p["mass"] * (acceleration + GRAVITY)
    spring = p["stiffness"] * lift + p["preload"] + p["damping"] * speed
    assert_allclose(result.outputs["contact"], weight + spring, atol=1e-8)
    assert_allclose(result.outputs["torque"], (weight + spring) * speed / p["speed"], atol=1e-9)


# -- controllers -------------------------------------------------------------------------------------------------------


def test_the_pendulum_comes_upright_as_its_equation_says():
    result = model("inverted-pendulum").simulate(times=(0.0, 0.3, 1.0, 2.0), until=2.0)
    p = result.parameters

    def rates(_, y):
        asked = -p["stiffness"] * y[0] - p["damping"] * y[1]
        torque = max(-p["limit"], min(p["limit"], asked))
        return [
            y[1],
            (torque + p["mass"] * GRAVITY * p["length"] / 2 * math.sin(y[0])) * 3 / (p["mass"] * p["length"] ** 2),
        ]

    found = solve_ivp(rates, (0, 2), [p["lean"], 0.0], "DOP853", rtol=1e-11, atol=1e-12, t_eval=result.t).y
    assert_allclose(result["rod.theta"], found[0], atol=1e-9)
    assert run("inverted-pendulum")["rod.theta"][-1] == pytest.approx(0.0, abs=1e-9)


def cart_pole(p):
    """Mass matrix without its angle, centre of the pole, and the linear system about the upright pole."""
    half = p["pole_length"] / 2
    mass, coupling = p["cart_mass"] + p["pole_mass"], p["pole_mass"] * half
    inertia = p["pole_mass"] * p["pole_length"] ** 2 / 3
    return mass, coupling, inertia


def test_the_pole_is_caught_as_its_equations_say():
    result = run("cart-pole")
    p = result.parameters
    mass, coupling, inertia = cart_pole(p)
    gains = np.array([p["gain_x"], p["gain_vx"], p["gain_lean"], p["gain_rate"]])

    def rates(_, y):
        c, s = math.cos(y[2]), math.sin(y[2])
        force = -gains @ y - coupling * s * y[3] ** 2
        a = np.linalg.solve([[mass, -coupling * c], [-coupling * c, inertia]], [force, coupling * GRAVITY * s])
        return [y[1], a[0], y[3], a[1]]

    found = solve_ivp(rates, (0, 8), [0, 0, p["lean"], 0], "DOP853", rtol=1e-11, atol=1e-12, t_eval=result.t).y
    assert_allclose(result["cart.x"], found[0], atol=1e-8)
    assert_allclose(result["pole.theta"], found[2], atol=1e-8)
    assert_allclose(result.outputs["push"], -gains @ found, atol=1e-6)


def test_the_gains_are_those_of_the_linear_quadratic_regulator():
    p = model("cart-pole").parameters()
    mass, coupling, inertia = cart_pole(p)
    inverse = np.linalg.inv([[mass, -coupling], [-coupling, inertia]])
    a, b = np.zeros((4, 4)), np.zeros((4, 1))
    a[0, 1] = a[2, 3] = 1.0
    a[[1, 3], 2] = inverse[:, 1] * coupling * GRAVITY
    b[[1, 3], 0] = inverse[:, 0]
    gains = b.T @ solve_continuous_are(a, b, np.diag([10.0, 1.0, 10.0, 1.0]), np.eye(1))
    found = [p["gain_x"], p["gain_vx"], p["gain_lean"], p["gain_rate"]]
    assert_allclose(found, gains[0], rtol=1e-5)


def test_a_controller_outside_catches_the_pole_too():
    """The same gains, 100 times a second through the input."""
    none = dict.fromkeys(("gain_x", "gain_vx", "gain_lean", "gain_rate"), 0.0)
    sim = model("cart-pole").start(parameters=none, integrator="rk4", step=1e-3)
    gains = model("cart-pole").parameters()

    def push(t, sim):
        state = sim.q["cart.x"], sim.v["cart.vx"], sim.q["pole.theta"], sim.v["pole.omega"]
        return {"force": -sum(gains[k] * s for k, s in zip(none, state, strict=True))}

    sim.every(0.01, push)
    sim.run(8.0)
    assert abs(sim.q["pole.theta"]) < 1e-3 and abs(sim.q["cart.x"]) < 1e-2
