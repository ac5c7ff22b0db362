"""The reference against closed forms and published motions, before it judges anything."""

import csv
import json
import tomllib
from pathlib import Path

import numpy as np
import pytest
from scipy.special import ellipj, ellipk

from benchmarks.plain.motion import constant_steps, integrate
from benchmarks.plain.start import start
from benchmarks.plain.system import System, read

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT / "tests" / "data"


def catalogue(name: str) -> dict:
    return tomllib.loads((ROOT / "symgen" / "describe" / "catalogue" / f"{name}.toml").read_text(encoding="utf-8"))


def moved(raw: dict, times, rtol: float = 1e-12):
    system = read(raw)
    begin = start(system)
    return system, integrate(system, begin.q, begin.v, np.asarray(times), rtol)


def column(system: System, motion, name: str):
    if name in system.names_q:
        return np.array(motion.q)[:, system.names_q.index(name)]
    return np.array(motion.v)[:, system.names_v.index(name)]


def file(text: str) -> dict:
    return tomllib.loads(text)


@pytest.mark.slow
def test_pendulum_is_elliptic() -> None:
    """IFToMM A01: theta from the downward vertical, sin(theta/2) = k sn(K - sqrt(g/L) t), k = sin(pi/4)."""
    times = np.linspace(0.0, 2.0, 9)
    raw = catalogue("pendulum")
    system, motion = moved(raw, times)
    x0 = system.bodies["bob"].start[0]
    k2 = 0.5
    sn = ellipj(ellipk(k2) - np.sqrt(9.81) * times, k2)[0]
    theta = 2 * np.arcsin(np.sqrt(k2) * sn)
    np.testing.assert_allclose(column(system, motion, "bob.x"), np.sign(x0) * np.sin(theta), atol=2e-10)
    np.testing.assert_allclose(column(system, motion, "bob.y"), -np.cos(theta), atol=2e-10)
    # the rod pulls with m (v^2/L + g cos(theta))
    tension = np.sum(np.array(motion.v) ** 2, axis=1) + 9.81 * np.cos(theta)
    np.testing.assert_allclose(np.array(motion.lam)[:, 0], tension, atol=1e-8)


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_andrews_mechanism_reaches_the_published_end() -> None:
    """Angles and speeds of the test set for IVP solvers, computed with PSIDE at 1e-14."""
    end = json.loads((DATA / "andrews_ivp.json").read_text(encoding="utf-8"))["end"]
    system, motion = moved(catalogue("andrews"), [0.0, 0.03], 1e-11)
    beta, theta, gamma, phi, delta, omega, epsilon = end[:7]
    angles = {
        "K1": beta,
        "K2": beta + theta,
        "K3": gamma,
        "K4": phi + delta,
        "K5": delta,
        "K6": omega + epsilon,
        "K7": epsilon,
    }
    for body, angle in angles.items():
        assert column(system, motion, f"{body}.theta")[-1] == pytest.approx(angle, abs=2e-6)
    assert column(system, motion, "K1.omega")[-1] == pytest.approx(end[7], rel=1e-6)


def rows(name: str) -> np.ndarray:
    with (DATA / name).open(encoding="utf-8") as lines:
        return np.array([[float(x) for x in row] for row in csv.reader(x for x in lines if not x.startswith("#"))])


@pytest.mark.slow
def test_bricard_mechanism_follows_the_published_points() -> None:
    """A permanently redundant loop: 30 rows of rank 29."""
    table = rows("bricard_square_rods.csv")
    table = table[[0, *(int(np.argmin(np.abs(table[:, 0] - t))) for t in (0.2, 0.4, 0.6))]]
    system, motion = moved(catalogue("bricard"), table[:, 0], 1e-9)
    for k, q in enumerate(motion.q):
        state = system.at(0.0, q, motion.v[k])
        ends = [
            r + a @ (point - system.bodies[name].centre)
            for name, (r, a, _) in state.frames.items()
            for point in system.bodies[name].points.values()
        ]
        for i in range(4):
            published = table[k, 1 + 3 * i : 4 + 3 * i]
            assert min(np.linalg.norm(end - published) for end in ends) < 2e-8


@pytest.mark.slow
def test_spatial_slider_crank_follows_the_published_slider() -> None:
    table = rows("spatial_slider_crank.csv")[[0, 20, 50, 100]]
    system, motion = moved(catalogue("spatial-slider-crank"), table[:, 0], 1e-10)
    np.testing.assert_allclose(column(system, motion, "slider.x"), table[:, 1], atol=2e-8)


FOUR_BAR = """
[mechanism]
name = "four-bar"
gravity = [0.0, -9.81]
[bodies.crank]
mass = 1.0
inertia = "1/12"
position = ["0.5*cos(pi/3)", "0.5*sin(pi/3)"]
angle = "pi/3"
[bodies.coupler]
mass = 3.0
inertia = "3*9/12"
position = [1.9, 1.5]
angle = 0.4
[bodies.rocker]
mass = 3.0
inertia = "3*9/12"
position = [3.7, 1.2]
angle = 1.7
[joints.A]
type = "revolute"
between = ["ground", "crank"]
at = [[0.0, 0.0], [-0.5, 0.0]]
[joints.B]
type = "revolute"
between = ["crank", "coupler"]
at = [[0.5, 0.0], [-1.5, 0.0]]
[joints.C]
type = "revolute"
between = ["coupler", "rocker"]
at = [[1.5, 0.0], [1.5, 0.0]]
[joints.D]
type = "revolute"
between = ["ground", "rocker"]
at = [[4.0, 0.0], [-1.5, 0.0]]
[joints.motor]
type = "driver"
joint = "A"
value = "pi/3 + 2*pi*t"
"""


def test_motor_of_a_driven_four_bar() -> None:
    """Torques computed twice for this project, by minimal coordinates and by complex steps, to 30 digits."""
    system, motion = moved(file(FOUR_BAR), [0.0, 0.25, 0.5], 1e-10)
    torques = -np.array(motion.lam)[:, system.rows.index("motor.driver")]
    np.testing.assert_allclose(torques, [59.97606377405662, -78.51449364663133, 5.415190647650141], rtol=1e-9)


def body(name: str, more: str, space: bool = True) -> str:
    inertia = "[0.3, 0.2, 0.1]" if space else "0.2"
    return f"[bodies.{name}]\nmass = 2.0\ninertia = {inertia}\n{more}\n"


def head(space: bool, gravity: str) -> str:
    return f'[mechanism]\nname = "m"\nspace = "{"spatial" if space else "planar"}"\ngravity = {gravity}\n'


def test_disc_and_sphere_roll_down_a_slope() -> None:
    """A disc with a = g sin / (1 + J / m R^2), a sphere likewise; friction is what turns them."""
    lean, radius = 0.3, 0.5
    down, normal = (np.cos(lean), -np.sin(lean)), (np.sin(lean), np.cos(lean))
    disc = head(False, "[0.0, -9.81]") + body("b", f"position = [{radius * normal[0]}, {radius * normal[1]}]", False)
    disc += f'[joints.r]\ntype = "rolling"\nbetween = ["b", "ground"]\nradius = {radius}\n'
    disc += f"axis = [{down[0]}, {down[1]}]\non = [0.0, 0.0]\n"
    system, motion = moved(file(disc), [0.0, 0.8])
    acceleration = 9.81 * np.sin(lean) / (1.0 + 0.2 / (2.0 * radius**2))
    way = (np.array(motion.q)[1] - np.array(motion.q)[0])[:2] @ down
    assert way == pytest.approx(0.5 * acceleration * 0.8**2, rel=1e-10)
    lam = dict(zip(system.rows, motion.lam[-1], strict=True))
    assert lam["r.normal"] == pytest.approx(2.0 * 9.81 * np.cos(lean), rel=1e-10)
    assert lam["r.roll"] == pytest.approx(-0.2 * acceleration / radius**2, rel=1e-10)
    sphere = head(True, f"[{9.81 * np.sin(lean)}, 0.0, {-9.81 * np.cos(lean)}]")
    sphere += f"[bodies.b]\nmass = 2.0\ninertia = [0.2, 0.2, 0.2]\nposition = [0.0, 0.0, {radius}]\n"
    sphere += f'[joints.r]\ntype = "rolling-sphere"\nbody = "b"\nradius = {radius}\n'
    sphere += "normal = [0, 0, 1]\nreference = [1, 0, 0]\n"
    system, motion = moved(file(sphere), [0.0, 0.8])
    assert column(system, motion, "b.x")[-1] == pytest.approx(0.5 * acceleration * 0.8**2, rel=1e-10)
    lam = dict(zip(system.rows, motion.lam[-1], strict=True))
    assert lam["r.slip1"] == pytest.approx(-0.2 * acceleration / radius**2, rel=1e-10)


def test_upright_disc_falls_at_the_known_rate() -> None:
    """Small leans of a thin uniform disc that rolls forward: rate^2 = 4 g / (5 r) - (12/5) Omega^2."""
    r, spin, lean = 0.3, 2.0, 1e-6
    text = head(True, "[0.0, 0.0, -9.81]")
    text += f"[bodies.d]\nmass = 1.0\ninertia = [{r**2 / 4}, {r**2 / 2}, {r**2 / 4}]\n"
    text += f"position = [0.0, 0.0, {r * np.cos(lean)}]\n"
    text += f"orientation = {{ rotation_vector = [{lean}, 0.0, 0.0] }}\nangular_velocity = [0.0, {spin}, 0.0]\n"
    text += f'[joints.c]\ntype = "rolling-disc"\nbody = "d"\nradius = {r}\naxis = [0, 1, 0]\nnormal = [0, 0, 1]\n'
    times = np.linspace(0.0, 0.3, 4)
    system, motion = moved(file(text), times, 1e-13)
    axis = np.array([system.at(0.0, q, v).matrix("d")[2, 1] for q, v in zip(motion.q, motion.v, strict=True)])
    # with u3 = 0 at the start: lean'' = (4/5)(g/r) lean + (6/5) Omega u3, u3' = -2 Omega lean'
    square = 0.8 * 9.81 / r - 2.4 * spin**2
    rest = 2.4 * spin**2 * lean / square
    expected = (lean + rest) * np.cosh(np.sqrt(square) * times) - rest
    np.testing.assert_allclose(axis, expected, rtol=2e-5)


@pytest.mark.slow
def test_screw_gear_and_rack() -> None:
    """A nut that falls along its thread: (m + J (2 pi / p)^2) a = m g. Two wheels: tau = (J1 + J2 (r1/r2)^2) alpha."""
    nut = head(True, "[0.0, 0.0, -9.81]") + body("n", "") + '[joints.s]\ntype = "screw"\nbetween = ["ground", "n"]\n'
    nut += "at = [[0, 0, 0], [0, 0, 0]]\naxis = [0, 0, 1]\npitch = 0.5\n"
    system, motion = moved(file(nut), [0.0, 1.0])
    fall = 2.0 * 9.81 / (2.0 + 0.1 * (2 * np.pi / 0.5) ** 2)
    assert column(system, motion, "n.z")[-1] == pytest.approx(-0.5 * fall, rel=1e-10)
    wheels = head(False, "[0.0, 0.0]") + body("a", "", False) + body("b", "position = [1.0, 0.0]", False)
    wheels += '[joints.A]\ntype = "revolute"\nbetween = ["ground", "a"]\nat = [[0, 0], "centre"]\n'
    wheels += '[joints.B]\ntype = "revolute"\nbetween = ["ground", "b"]\nat = [[1, 0], "centre"]\n'
    wheels += '[joints.g]\ntype = "gear"\nbetween = ["a", "b"]\nradii = [0.6, 0.4]\n'
    wheels += '[forces.t]\ntype = "torque"\nbody = "a"\ntorque = 3.0\n'
    system, motion = moved(file(wheels), [0.0, 1.0])
    alpha = 3.0 / (0.2 + 0.2 * 1.5**2)
    assert column(system, motion, "a.theta")[-1] == pytest.approx(0.5 * alpha, rel=1e-10)
    assert column(system, motion, "b.theta")[-1] == pytest.approx(-0.75 * alpha, rel=1e-10)
    tooth = motion.lam[-1][system.rows.index("g.mesh")]  # its torque on the first wheel is r_a times it
    assert tooth * 0.6 == pytest.approx(0.2 * alpha - 3.0, rel=1e-10)


def shafts(kind: str, keys: str, bend: float) -> str:
    """Two shafts on bearings whose lines meet at the origin at an angle, the first one driven."""
    out = (float(np.cos(bend)), 0.0, float(np.sin(bend)))
    text = (
        head(True, "[0.0, 0.0, 0.0]")
        + body("a", "")
        + body("b", f"orientation = {{ rotation_vector = [0, {-bend}, 0] }}")
    )
    text += '[joints.A]\ntype = "revolute"\nbetween = ["ground", "a"]\nat = [[0, 0, 0], [0, 0, 0]]\naxis = [1, 0, 0]\n'
    text += '[joints.B]\ntype = "cylindrical"\nbetween = ["ground", "b"]\nat = [[0, 0, 0], [0, 0, 0]]\n'
    text += f"axis = {list(out)}\n"
    text += f'[joints.c]\ntype = "{kind}"\nbetween = ["a", "b"]\nat = [[0, 0, 0], [0, 0, 0]]\n{keys}\n'
    return text + '[joints.m]\ntype = "driver"\njoint = "A"\nvalue = "3*t"\n'


@pytest.mark.slow
def test_shafts_turn_as_their_joints_say() -> None:
    """Cardan: tan(out) = tan(in) cos(bend) with the driving fork across the shafts' plane; homokinetic: alike."""
    bend, times = 0.6, np.linspace(0.0, 1.0, 6)
    raw = file(shafts("universal", "axes = [[0, 1, 0], [0, 0, 1]]", bend))
    system, motion = moved(raw, times, 1e-10)
    turn = np.array([_turn(system, q, v) for q, v in zip(motion.q, motion.v, strict=True)])
    np.testing.assert_allclose(np.tan(turn), np.tan(3 * times) * np.cos(bend), rtol=1e-7, atol=1e-12)
    raw = file(shafts("constant-velocity", "axis = [[1, 0, 0], [1, 0, 0]]\nreference = [[0, 1, 0], [0, 1, 0]]", bend))
    system, motion = moved(raw, times, 1e-10)
    speeds = [v[system.names_v.index("b.wx")] for v in motion.v]
    np.testing.assert_allclose(speeds, 3.0, rtol=1e-9)


def _turn(system: System, q, v) -> float:
    system.follow(system.at(0.0, q, v))
    joint = next(j for j in system.joints if j.name == "B")
    return float(joint.coordinates["angle"](system.at(0.0, q, v)).value)


def test_skate_goes_round_in_a_circle() -> None:
    """A blade under the centre of mass: speed and angular velocity stay, in the plane and on a plane in space."""
    text = head(False, "[0.0, 0.0]") + body("s", "velocity = [1.0, 0.0]\nangular_velocity = 2.0", False)
    raw = file(text + '[joints.k]\ntype = "knife-edge"\nbody = "s"\naxis = [1, 0]\n')
    system, motion = moved(raw, [0.0, np.pi / 4, np.pi / 2])
    np.testing.assert_allclose(column(system, motion, "s.x"), [0.0, 0.5, 0.0], atol=1e-10)
    np.testing.assert_allclose(column(system, motion, "s.y"), [0.0, 0.5, 1.0], atol=1e-10)
    text = head(True, "[0.0, 0.0, -9.81]") + body("s", "velocity = [1.0, 0.0, 0.0]\nangular_velocity = [0.0, 0.0, 2.0]")
    text += '[joints.k]\ntype = "knife-edge"\nbody = "s"\naxis = [1, 0, 0]\nnormal = [0, 0, 1]\n'
    system, motion = moved(file(text), [0.0, np.pi / 4, np.pi / 2])
    np.testing.assert_allclose(column(system, motion, "s.y"), [0.0, 0.5, 1.0], atol=1e-10)
    assert motion.lam[-1][0] == pytest.approx(2.0 * 9.81, rel=1e-12)


def test_torque_free_top_keeps_its_momentum_and_precesses() -> None:
    """Euler: w1 and w2 of a symmetric body turn at (J3 - J1) w3 / J1 in its own axes."""
    text = head(True, "[0.0, 0.0, 0.0]") + "[bodies.b]\nmass = 1.0\ninertia = [0.4, 0.4, 0.1]\n"
    system, motion = moved(file(text + "angular_velocity = [1.0, 0.0, 5.0]\n"), [0.0, 0.7])
    turn = (0.1 - 0.4) / 0.4 * 5.0 * 0.7
    np.testing.assert_allclose(motion.v[-1][3:], [np.cos(turn), np.sin(turn), 5.0], atol=1e-9)
    a = system.at(0.0, motion.q[-1], motion.v[-1]).matrix("b")
    np.testing.assert_allclose(a @ (np.array([0.4, 0.4, 0.1]) * motion.v[-1][3:]), [0.4, 0.0, 0.5], atol=1e-9)


@pytest.mark.slow
def test_massless_link_is_a_rod() -> None:
    """A body without mass between two pins does what a rod without mass does."""
    common = head(False, "[0.0, -9.81]") + '[bodies.p]\ntype = "point"\nmass = 1.0\nposition = [0.6, -0.8]\n'
    rod = '[joints.r]\ntype = "distance"\nbetween = ["ground", "p"]\nat = [[0, 0], "centre"]\nlength = 1.0\n'
    link = "[bodies.l]\nmass = 0\ninertia = 0\nposition = [0.3, -0.4]\n" + f"angle = {np.arctan2(-0.8, 0.6)}\n"
    link += '[joints.a]\ntype = "revolute"\nbetween = ["ground", "l"]\nat = [[0, 0], [-0.5, 0]]\n'
    link += '[joints.b]\ntype = "revolute"\nbetween = ["l", "p"]\nat = [[0.5, 0], "centre"]\n'
    (one, by_rod), (other, by_link) = (moved(file(common + more), [0.0, 0.5, 1.0]) for more in (rod, link))
    np.testing.assert_allclose(column(one, by_rod, "p.x"), column(other, by_link, "p.x"), atol=1e-9)


def test_bushing_swings_at_the_root_of_stiffness_over_mass() -> None:
    text = head(True, "[0.0, 0.0, 0.0]") + body("b", "velocity = [0.01, 0.0, 0.0]\nangular_velocity = [0.0, 0.0, 1e-5]")
    text += '[forces.e]\ntype = "bushing"\nbetween = ["ground", "b"]\nat = [[0, 0, 0], "centre"]\n'
    text += "stiffness = [50.0, 50.0, 50.0, 4.0, 4.0, 4.0]\n"
    system, motion = moved(file(text), [0.0, 0.9])
    assert column(system, motion, "b.x")[-1] == pytest.approx(0.01 / 5.0 * np.sin(5.0 * 0.9), rel=1e-6)
    assert column(system, motion, "b.wz")[-1] == pytest.approx(1e-5 * np.cos(np.sqrt(40.0) * 0.9), rel=1e-6)


@pytest.mark.slow
def test_constant_steps_converge_with_order_four() -> None:
    raw = catalogue("four-bar")
    _, exact = moved(raw, [0.0, 0.4], 1e-13)
    errors = []
    for step in (0.02, 0.01, 0.005):
        again = read(raw)
        begin = start(again)
        rough = constant_steps(again, begin.q, begin.v, np.array([0.0, 0.4]), step)
        errors.append(np.abs(rough.q[-1] - exact.q[-1]).max())
    slopes = np.log2(np.array(errors[:-1]) / errors[1:])
    assert (slopes > 3.7).all(), (errors, slopes)
