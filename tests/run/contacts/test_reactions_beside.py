"""Friction by reactions beside stops and contacts: forces, impulses, derivatives and all targets, against NumPy."""

import itertools
import json
import math
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, root

from tests.result.targets.test_c_modes import assert_same_run, program_of
from tests.run.contacts.scenes import G, body, head, loaded
from tests.run.contacts.test_derivatives import slopes_of
from tests.run.contacts.test_printed_contacts import NODE

Array = NDArray[np.float64]
#: Angles of two rods of 1 m and 1 kg from the horizontal, and rates of their pins.
ANGLES, RATES = (-0.9, -0.3), (-1.0, -2.0)
#: Rates of the pins after the impact by kappa [m], as a linear complementarity problem of its own has printed them.
PRINTED = {
    0.0: (-2.143629, 5.363762),
    0.005: (-2.135967, 5.351115),
    0.01: (-2.128416, 5.33865),
    0.03: (-2.09924, 5.290491),
    0.1: (-2.007956, 5.139812),
}
#: Ways to run one file.
WAYS: dict[str, dict[str, Any]] = {
    "dop853": {"integrator": "dop853", "rtol": 1e-11},
    "joint": {"integrator": "dop853", "rtol": 1e-11, "coordinates": "joint"},
    "picard": {"integrator": "picard", "rtol": 1e-11},
    "radau5": {"integrator": "radau5", "rtol": 1e-11},
    "rk4": {"integrator": "rk4", "step": 1e-3},
    "looped": {"integrator": "dop853", "rtol": 1e-11, "shape": "looped"},
}


def two_rods(rates: tuple[float, float] = RATES, below: float = 1e-9, touch: str = "stop", kappa: float = 0.03) -> str:
    """Return two rods on pins with friction, whose tip is just above a stop, or a contact with a floor."""
    (a, b), text = ANGLES, head("strike") + f"[parameters]\nkappa = {kappa!r}\ne = 0.5\nmu = 0.3\n"
    near, far = np.array([math.cos(a), math.sin(a)]), np.array([math.cos(b), math.sin(b)])
    height = float(near[1] + far[1]) - below
    one, two = rates[0], rates[0] + rates[1]
    turned = np.array([-near[1], near[0]]), np.array([-far[1], far[0]])
    middle = one * turned[0] + 0.5 * two * turned[1]
    places = tuple(0.5 * near), tuple(near + 0.5 * far)
    velocities = tuple(0.5 * one * turned[0]), tuple(middle)
    for name, place, velocity, rate, angle, ends in (
        ("one", places[0], velocities[0], one, a, "p = [-0.5, 0.0], q = [0.5, 0.0]"),
        ("two", places[1], velocities[1], two, b, "q = [-0.5, 0.0]"),
    ):
        given = (float(place[0]), float(place[1])), (float(velocity[0]), float(velocity[1]))
        text += body(name, 1.0, 1.0 / 12.0, *given, rate, angle) + f"points = {{ {ends} }}\n"
    rubs = '\nfriction = { coefficient = "kappa", radius = 1.0 }\n' if kappa > 0.0 else "\n"
    text += '[joints.A]\ntype = "revolute"\nbetween = ["ground", "one"]\nat = [[0.0, 0.0], "p"]' + rubs
    text += '[joints.B]\ntype = "revolute"\nbetween = ["one", "two"]\nat = ["q", "q"]' + rubs
    if touch == "stop":
        return text + f'[stops.floor]\ngap = "two.y + 0.5*sin(two.theta) - ({height!r})"\nrestitution = "e"\n'
    line = f'{{ line = "ground", on = [0.0, {height!r}] }}'
    text += f'[contacts.floor]\nbetween = [{{ body = "two", at = [0.5, 0.0] }}, {line}]\n'
    return text + 'friction = "mu"\nrestitution = "e"\n'


def rates_after(kappa: float, e: float, rates: tuple[float, float]) -> Array:
    """Return the rates of the two pins after the tip has struck: all signs of friction are tried, in NumPy."""
    (a, b), m = ANGLES, np.diag([1.0, 1.0, 1.0 / 12.0] * 2)
    (ax, ay), (bx, by) = 0.5 * np.array([math.cos(a), math.sin(a)]), 0.5 * np.array([math.cos(b), math.sin(b)])
    joints = np.array(
        [[1, 0, ay, 0, 0, 0], [0, 1, -ax, 0, 0, 0], [1, 0, -ay, -1, 0, -by], [0, 1, ax, 0, -1, bx]], dtype=np.float64
    )
    tip = np.array([0, 0, 0, 0, 1, bx])
    pins = np.array([[0, 0, 1, 0, 0, 0], [0, 0, -1, 0, 0, 1]], dtype=np.float64)
    v = np.linalg.solve(np.concatenate([joints, pins]), np.array([0.0, 0.0, 0.0, 0.0, *rates]))

    def missing(x: Array, does: tuple[int, int]) -> Array:
        after, own, push, rubs = x[:6], x[6:10], x[10], x[11:]
        sizes = kappa * np.hypot(own[[0, 2]], own[[1, 3]])
        left = m @ (after - v) - joints.T @ own - tip * push - pins.T @ rubs
        law = [pins[i] @ after if does[i] == 0 else rubs[i] + does[i] * sizes[i] for i in range(2)]
        return np.concatenate([left, joints @ after, [tip @ after + e * (tip @ v)], law])

    found = list[Array]()
    for does in itertools.product((0, 1, -1), repeat=2):
        x = root(missing, np.array([*v, *np.ones(4), 1.0, 0.0, 0.0]), args=(does,), tol=1e-14).x
        after, sizes = pins @ x[:6], kappa * np.hypot(x[[6, 8]], x[[7, 9]])
        within = all(abs(x[11 + i]) <= sizes[i] + 1e-12 if does[i] == 0 else after[i] * does[i] > 0.0 for i in range(2))
        if np.abs(missing(x, does)).max() < 1e-10 and within and x[10] > 0.0:
            found.append(after)
    assert found and all(np.allclose(each, found[0], rtol=0.0, atol=1e-9) for each in found)
    return found[0]


def relative_rates(run: Any, place: int) -> Array:
    """Return the rates of the pins at an output."""
    one, two = run["one.omega"][place], run["two.omega"][place]
    return np.array([one, two - one])


@pytest.mark.slow
@pytest.mark.parametrize("touch", ["stop", "contact"])
def test_impulses_of_pins_at_an_impact(touch: str, tmp_path: Path) -> None:
    """Rates after the impact are those of a problem of its own, for five kappas and 40 more with other rates."""
    drawn = np.random.default_rng(91).uniform(size=(40, 3))
    cases = [(kappa, RATES) for kappa in PRINTED] + [
        (0.3 * x * x, (-2.0 + 3.0 * y, -4.0 + 3.0 * z)) for x, y, z in drawn.tolist()
    ]
    seen = 0
    for kappa, rates in cases:
        tip = math.cos(ANGLES[0]) * rates[0] + math.cos(ANGLES[1]) * (rates[0] + rates[1])
        if tip > -0.1:
            continue
        text = two_rods(rates, 1e-9, touch, kappa).replace("mu = 0.3", "mu = 0.0")
        run = loaded(text, tmp_path).simulate(until=3e-9, step=1e-9, integrator="rk4", verify=False, output_step=3e-9)
        assert run.ok and run.events[0].name == "floor.hit", (kappa, rates, run.reason)
        own = rates_after(kappa, 0.5, rates)
        np.testing.assert_allclose(relative_rates(run, -1), own, rtol=0.0, atol=3e-7)
        if kappa in PRINTED:
            np.testing.assert_allclose(own, PRINTED[kappa], rtol=0.0, atol=6e-7)
        seen += 1
    assert seen > 25


# -- a block that brakes on two contacts, with a rod on a pin that rubs ------------------------------------------------


def cart(kappa: float) -> str:
    """Return the block, at 2 m/s; the rod of 1 m and 1 kg hangs at rest relative to it."""
    text = head("cart") + f"[parameters]\nkappa = {kappa!r}\nmu = 0.3\n"
    text += body("block", 3.0, 0.4, (0.0, 0.1), (2.0, 0.0))
    text += body("rod", 1.0, 1.0 / 12.0, (0.0, -0.4), (2.0, 0.0), 0.0, -math.pi / 2.0)
    text += 'points = { a = [-0.5, 0.0] }\n[joints.pin]\ntype = "revolute"\nbetween = ["block", "rod"]\n'
    text += 'at = [[0.0, 0.0], "a"]\nfriction = { coefficient = "kappa", radius = 1.0 }\n'
    for name, x in (("left", -0.8), ("right", 0.8)):
        text += f'[contacts.{name}]\nbetween = [{{ body = "block", at = [{x}, -0.1] }}, {{ line = "ground" }}]\n'
        text += 'friction = "mu"\n'
    return text


def cart_accelerations(theta: float, omega: float, kappa: float, slides: float, turns: float) -> Array:
    """Return accelerations of block and rod, and the forces on the floor and across, with given signs of friction."""
    c, s = math.cos(theta), math.sin(theta)

    def missing(x: Array) -> Array:
        a, alpha, across, up, floor = x
        rod = a - 0.5 * (alpha * s + omega**2 * c), 0.5 * (alpha * c - omega**2 * s)
        along = -slides * 0.3 * floor
        return np.array(
            [
                rod[0] - across,
                rod[1] + G - up,
                alpha / 12.0 + turns * kappa * math.hypot(across, up) - 0.5 * (s * across - c * up),
                3.0 * a + across - along if slides else a,
                floor - 3.0 * G - up,
            ]
        )

    return np.asarray(root(missing, np.array([0.0, 0.0, 0.0, G, 4.0 * G]), tol=1e-14).x)


def cart_reference(kappa: float, until: float) -> tuple[list[float], Array]:
    """Return when the block stops, and the rod turns about, and the end: x, theta, rates."""
    times, t, z, slides, turns = list[float](), 0.0, np.array([0.0, -math.pi / 2.0, 2.0, 0.0]), 1.0, 1.0
    while t < until:

        def rates(_: float, z: Array, slides: float = slides, turns: float = turns) -> Array:
            a, alpha, *_ = cart_accelerations(z[1], z[3], kappa, slides, turns)
            return np.array([z[2], z[3], a, alpha])

        solution = solve_ivp(
            rates, (t, until), z, method="DOP853", rtol=1e-12, atol=1e-14, dense_output=True, max_step=0.01
        )
        at, steps = (2 if slides else 3), solution.t
        signs = [solution.sol(x)[at] * (1.0 if slides else turns) for x in steps]
        passed = next((k for k in range(1, len(steps)) if signs[k] < 0.0), None)
        if passed is None:
            return times, solution.y[:, -1]
        t = float(brentq(lambda x, at=at, of=solution: of.sol(x)[at], steps[passed - 1], steps[passed], xtol=1e-15))
        z = np.asarray(solution.sol(t))
        times.append(t)
        z[at] = 0.0
        if slides:
            slides = 0.0
            _, _, across, _, floor = cart_accelerations(z[1], z[3], kappa, 0.0, turns)
            assert abs(across) < 0.3 * floor
        else:
            turns = -turns
    return times, z


@pytest.mark.slow
@pytest.mark.parametrize("way", ["dop853", "looped", "joint"])
def test_a_rod_held_by_its_pin_brakes_with_its_block(way: str, tmp_path: Path) -> None:
    """The block stops after v/(mu g), in v^2/(2 mu g); the rod does not turn."""
    run = loaded(cart(0.25), tmp_path).simulate(until=1.0, verify=False, **WAYS[way])
    assert run.ok and [event.name for event in run.events] == ["left.stick", "right.stick"]
    assert run.events[0].t == pytest.approx(2.0 / (0.3 * G), abs=1e-12)
    assert run["block.x"][-1] == pytest.approx(4.0 / (2.0 * 0.3 * G), abs=1e-12)
    assert abs(run["rod.theta"][-1] + math.pi / 2.0) < 1e-12


@pytest.mark.slow
def test_a_rod_swings_while_its_block_brakes(tmp_path: Path) -> None:
    """Every way has the times and the end of two freedoms in SciPy."""
    (stops, about), end = cart_reference(0.01, 0.9)
    model = loaded(cart(0.01), tmp_path)
    for way, settings in WAYS.items():
        run = model.simulate(until=0.9, verify=False, **settings)
        assert run.ok and [event.name for event in run.events] == ["left.stick", "right.stick", "pin.reverse"], way
        assert [event.t for event in run.events] == pytest.approx([stops, stops, about], abs=2e-12)
        assert run["block.x"][-1] == pytest.approx(end[0], abs=2e-12)
        assert run["rod.theta"][-1] == pytest.approx(end[1], abs=1e-11)


@pytest.mark.slow
def test_three_hundred_pins_on_a_block(tmp_path: Path) -> None:
    """Rows of the sweep are single runs, and end where SciPy does."""
    values, model = np.linspace(0.002, 0.07, 300), loaded(cart(0.01), tmp_path)
    settings: dict[str, Any] = {"until": 0.9, "integrator": "dop853", "rtol": 1e-11}
    table = model.sweep(vary={"kappa": values}, **settings).to_dataframe()
    assert set(table["status"]) == {"ok"}
    (key,) = [key for key in table.columns if key.startswith("rod.theta")]
    for i in range(0, 300, 25):
        run = model.simulate(parameters={"kappa": float(values[i])}, verify=False, times=None, **settings)
        assert run["rod.theta"][-1] == table[key][i]
        assert run["rod.theta"][-1] == pytest.approx(cart_reference(float(values[i]), 0.9)[1][1], abs=2e-11)


# -- targets and derivatives -------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize(("text", "until"), [(cart(0.01), 0.9), (two_rods(below=0.1), 0.9)], ids=["cart", "rods"])
def test_c_pages_and_steps_are_runs(text: str, until: float, tmp_path: Path) -> None:
    model, step = loaded(text + f"[run]\nuntil = {until}\nstep = 5e-4\n", tmp_path), 5e-4
    words = assert_same_run(model, program_of(model, tmp_path / "c"), until, step)
    run = model.simulate(method="direct-correction", integrator="rk4", step=step, until=until)
    assert words and run.ok
    own = np.array([run[each][-1] for each in (*run.q.names, *run.v.names)])
    steps = model.start(method="direct-correction", integrator="rk4", step=step)
    for _ in range(3):
        steps.step(until / 3.0)
    name = run.q.names[-1]
    assert steps[name] == pytest.approx(run[name][-1], abs=1e-11)
    model.generate(tmp_path / "page", target="javascript")
    (module,), node = (tmp_path / "page").glob("*.mjs"), shutil.which("node")
    assert node, "this test needs Node: apt-get install nodejs"
    command = [node, "--input-type=module", "-e", NODE, str(module), repr(until), repr(step)]
    page = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    np.testing.assert_allclose(np.array(page["y"])[: len(own)], own, rtol=0.0, atol=1e-11)
    assert [each["name"] for each in page["happened"]] == [event.name for event in run.events]


@pytest.mark.slow
@pytest.mark.parametrize("touch", ["stop", "contact"])
@pytest.mark.parametrize(("kappa", "until"), [(0.03, 0.2), (0.03, 1.2), (0.3, 0.3)])
def test_derivatives_pass_impulses_of_pins(touch: str, kappa: float, until: float, tmp_path: Path) -> None:
    """After one impact, at which pins slide or stick, and after a series that comes to rest."""
    text = two_rods(below=0.1, touch=touch, kappa=kappa)
    values = {"kappa": kappa, "e": 0.5} | ({"mu": 0.3} if touch == "contact" else {})
    slopes_of(text, until, "two.theta", values, tmp_path, within=2e-6)


@pytest.mark.slow
def test_impulses_of_joints_are_those_of_both_coordinates(tmp_path: Path) -> None:
    """Absolute and joint coordinates have the same impulses of joints; those of friction are kappa times their size."""
    model = loaded(two_rods(below=0.1), tmp_path)
    runs = [model.simulate(until=0.1, coordinates=each, rtol=1e-10, verify=False) for each in ("absolute", "joint")]
    first, second = (run.events[0] for run in runs)
    assert first.impulses == pytest.approx(dict(second.impulses), abs=1e-9)
    assert first.work == pytest.approx(second.work, abs=1e-9)
    for joint in "AB":
        size = math.hypot(first.impulses[f"{joint}.x"], first.impulses[f"{joint}.y"])
        assert abs(first.impulses[f"{joint}.friction"]) == pytest.approx(0.03 * size, rel=1e-9)


@pytest.mark.slow
def test_the_end_of_a_series_has_the_impulses_of_pins(tmp_path: Path) -> None:
    """The motion after a series is smooth in the restitution, though it is cut after 19, 20 or 21 impacts."""
    ends, counts = list[float](), set[int]()
    for k in range(25):
        text = two_rods(below=0.1).replace("e = 0.5", f"e = {0.48 + 0.0016 * k!r}")
        run = loaded(text, tmp_path).simulate(until=0.8, rtol=1e-11, integrator="dop853", verify=False)
        assert run.ok and any(event.name == "floor.rest" for event in run.events)
        ends.append(float(run["two.theta"][-1]))
        counts.add(sum(event.name == "floor.hit" for event in run.events))
    assert len(counts) > 1
    assert np.abs(np.diff(ends, 4)).max() < 5e-10


@pytest.mark.slow
def test_a_hinge_in_space_beside_a_stop(tmp_path: Path) -> None:
    """Both coordinates bounce alike, and derivatives pass impulses across the hinge."""
    text = (
        '[mechanism]\nname = "hinge"\nspace = "spatial"\ngravity = [0.0, 0.0, -9.81]\n[parameters]\nmu = 0.3\ne = 0.5\n'
    )
    text += "[bodies.arm]\nmass = 1.0\ninertia = [0.02, 0.05, 0.04]\nposition = [0.5, 0.0, 0.0]\n"
    text += 'points = { a = [-0.5, 0.0, 0.0] }\n[joints.pin]\ntype = "revolute"\nbetween = ["ground", "arm"]\n'
    text += 'at = [[0.0, 0.0, 0.0], "a"]\naxis = [0.0, 1.0, 0.0]\nfriction = { coefficient = "mu", radius = 0.05 }\n'
    text += '[stops.floor]\ngap = "arm.z + 0.2"\nrestitution = "e"\n'
    model = loaded(text, tmp_path)
    settings: dict[str, Any] = {"until": 0.5, "rtol": 1e-11, "integrator": "dop853", "verify": False}
    first, second = (model.simulate(coordinates=each, **settings) for each in ("absolute", "joint"))
    assert first.ok and second.ok and first.events[0].name == "floor.hit"
    assert first["arm.z"][-1] == pytest.approx(second["arm.z"][-1], abs=1e-11)
    slopes_of(text, 0.4, "arm.z", {"mu": 0.3, "e": 0.5}, tmp_path)


@pytest.mark.slow_cases("contact")
@pytest.mark.parametrize("touch", ["stop", "contact"])
def test_the_energy_that_rows_take_is_what_the_rods_lose(touch: str, tmp_path: Path) -> None:
    """Pins take energy while they turn and at impacts, and so does what the tip strikes, until it rests."""
    taken = [f"{name}.dissipated" for name in ("A", "B", "floor")]
    outputs = "".join(f'{name.replace(".", "_")} = {{ value = "{name}", unit = "J" }}\n' for name in taken)
    text = two_rods(touch=touch, below=0.05) + f"[outputs]\n{outputs}"
    ends = []
    for until in (0.05, 1.5):
        result = loaded(text, tmp_path).simulate(until=until, verify=False, integrator="dop853", rtol=1e-11)
        assert result.ok and len(result.events) > 0, result.reason
        energy = np.asarray(result["energy.kinetic"]) + np.asarray(result["energy.potential"])
        ends.append(float(sum(result[name.replace(".", "_")][-1] for name in taken)))
        assert ends[-1] == pytest.approx(float(energy[0] - energy[-1]), rel=1e-9)
    assert ends[1] > ends[0] > 0.0
    pins = loaded(text, tmp_path).simulate(until=0.05, verify=False, integrator="dop853", rtol=1e-11)
    at = next(e.t for e in pins.events if e.name == "floor.hit")
    before, after = (int(np.searchsorted(pins.t, at, side=side)) for side in ("left", "right"))
    assert pins["A_dissipated"][after] - pins["A_dissipated"][before - 1] > 1e-3
