"""Joints of two moving bodies that catch where they are: momentum and spin go on, and a point stays in a frame.

Nothing acts from outside. The references are momenta by hand, and rotations of SciPy.
"""

from itertools import product

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation
from support.holding import DOCKING

import symgen
from symgen.base.errors import InputError

TIGHT = {"integrator": "dop853", "rtol": 1e-11, "atol": 1e-12}
COORDINATES = ("absolute", "joint")


def loaded(text, tmp_path):
    (path := tmp_path / "model.toml").write_text(text)
    return symgen.load(path)


# -- two bodies in the plane -------------------------------------------------------------------------------------------


def caught(offset, spin):
    """Return the angular velocity after the catch, and what it takes, of two bodies that are one from then on."""
    apart, mass = np.array([offset + 0.3, 0.4]), 2.0 / 3.0
    about = 0.05 * spin + mass * (apart[0] * 0.4 - apart[1] * 0.3)
    inertia = 0.07 + mass * (apart @ apart)
    return about / inertia, 0.5 * (0.05 * spin**2 + mass * (0.3**2 + 0.4**2)) - 0.5 * about**2 / inertia


def test_a_weld_where_two_bodies_are(tmp_path):
    model, (omega, lost) = loaded(DOCKING, tmp_path), caught(0.5, 0.8)
    assert omega == pytest.approx(0.287293, abs=1e-6) and lost == pytest.approx(0.0744346, abs=1e-7)
    for keys in (*product(COORDINATES, ("picard", "dop853", "rk4", "radau5")), ("absolute", "bdf")):
        run = model.simulate(coordinates=keys[0], integrator=keys[1], times=[0.9, 1.5, 1.99, 2.4])
        assert run.ok and [event.name for event in run.events] == ["weld.holds", "weld.releases"]
        assert run["a.omega"][1:] == pytest.approx(omega, abs=1e-6 if keys[1] == "bdf" else 1e-10), keys
        assert run["weld.dissipated"][-1] == pytest.approx(lost, abs=1e-6 if keys[1] == "bdf" else 1e-10)
        apart = np.array([run["b.x"] - run["a.x"], run["b.y"] - run["a.y"]]).T
        for k in (1, 2):
            c, s = np.cos(run["a.theta"][k] - 0.8), np.sin(run["a.theta"][k] - 0.8)
            assert apart[k] == pytest.approx([c * 0.8 - s * 0.4, s * 0.8 + c * 0.4], abs=1e-6), keys


def test_spin_of_300_welds(tmp_path):
    """Offsets to both sides, spins of both signs: rows of a sweep, beside the closed form."""
    offsets, spins = np.linspace(-2.0, 2.0, 20), np.linspace(-3.0, 3.0, 15)
    text = DOCKING + '[outputs.omega]\nvalue = "a.omega"\n'
    columns = ["L", "omega", "weld.dissipated", "a.vx", "b.vx"]
    swept = symgen.sweep(
        loaded(text.replace('t > 2.0"', 't > 9.0"'), tmp_path),
        {"offset": offsets, "spin": spins},
        quantities=columns,
        until=2.0,
        **TIGHT,
    )
    assert set(swept.status.ravel().tolist()) == {"ok"}
    spin, omega, lost, *speeds = (np.asarray(swept[name]).ravel() for name in columns)
    pairs = list(product(offsets, spins))
    assert len(spin) == len(pairs) == 300
    begun = np.array([0.05 * w + offset * 0.4 for offset, w in pairs])
    assert np.abs(spin - begun).max() < 1e-12
    assert np.abs(2.0 * speeds[0] + speeds[1] - 0.3).max() < 1e-12
    own = np.array([caught(*pair) for pair in pairs])
    assert np.abs(omega - own[:, 0]).max() < 1e-11 and np.abs(lost - own[:, 1]).max() < 1e-11


# -- every kind --------------------------------------------------------------------------------------------------------

PLANE = """
[mechanism]
name = "pair"
[run]
until = 2.0
[bodies.a]
mass = 2.0
inertia = 0.05
angular_velocity = 0.8
[bodies.b]
mass = 1.0
inertia = 0.02
position = [0.5, 0.0]
velocity = [0.3, 0.4]
[joints.w]
type = {}
between = ["a", "b"]
holds = {{ catches = "t > 1.0", at_start = false }}
holds_at = "present"
"""
SPACE = """
[mechanism]
name = "pair"
space = "spatial"
[run]
until = 2.0
[bodies.a]
mass = 2.0
inertia = [0.05, 0.06, 0.07]
angular_velocity = [0.3, 0.2, 0.8]
[bodies.b]
mass = 1.0
inertia = [0.02, 0.03, 0.04]
position = [0.5, 0.0, 0.0]
velocity = [0.3, 0.4, 0.1]
angular_velocity = [-0.2, 0.1, 0.4]
[joints.w]
type = {}
between = ["a", "b"]
holds = {{ catches = "t > 1.0", at_start = false }}
holds_at = "present"
"""
_AT = '\nat = ["centre", "centre"]'
_AXIS = "\naxis = [0.0, 0.0, 1.0]"
#: Kinds that hold positions, with their keys; those of which a point of b stays in the frame of a.
IN_PLANE = {
    "rigid": _AT,
    "revolute": _AT,
    "translational": f"{_AT}\naxis = [1.0, 0.0]",
    "pin-in-slot": f"{_AT}\naxis = [1.0, 0.0]",
    "distance": f"{_AT}\nlength = 1.0",
    "orientation": "",
    "rope": _AT,
}
IN_SPACE = {
    "rigid": _AT,
    "spherical": _AT,
    "revolute": _AT + _AXIS,
    "universal": f"{_AT}\naxes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]",
    "constant-velocity": _AT + _AXIS,
    "cylindrical": _AT + _AXIS,
    "translational": f"{_AT}\naxis = [1.0, 0.0, 0.0]",
    "screw": f"{_AT}{_AXIS}\npitch = 0.1",
    "planar": f"{_AT}\nnormal = [0.0, 0.0, 1.0]",
    "point-on-plane": f"{_AT}\nnormal = [0.0, 0.0, 1.0]",
    "parallel-axes": _AXIS,
    "perpendicular": "\naxes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]",
    "orientation": "",
    "distance": f"{_AT}\nlength = 1.0",
}
POINT_STAYS = {"rigid", "revolute", "spherical", "universal", "constant-velocity"}
#: Mass and moments of inertia of the two bodies.
BODIES = {"a": (2.0, np.array([0.05, 0.06, 0.07])), "b": (1.0, np.array([0.02, 0.03, 0.04]))}


def momenta_and_place(run, k, spatial):
    """Return momentum and spin about the origin, and the place of b in the frame of a."""
    momentum, spin, axes, places = np.zeros(3), np.zeros(3), {}, {}
    for name, (mass, inertia) in BODIES.items():
        place, speed, turn = np.zeros(3), np.zeros(3), np.zeros(3)
        for i, c in enumerate("xyz" if spatial else "xy"):
            place[i], speed[i] = run[f"{name}.{c}"][k], run[f"{name}.v{c}"][k]
        if spatial:
            axes[name] = Rotation.from_quat([run[f"{name}.e{i}"][k] for i in (1, 2, 3, 0)])
            turn = axes[name].apply(inertia * np.array([run[f"{name}.w{c}"][k] for c in "xyz"]))
        else:
            axes[name] = Rotation.from_euler("z", run[f"{name}.theta"][k])
            turn[2] = (0.05 if name == "a" else 0.02) * run[f"{name}.omega"][k]
        momentum, spin = momentum + mass * speed, spin + mass * np.cross(place, speed) + turn
        places[name] = place
    return momentum, spin, axes["a"].inv().apply(places["b"] - places["a"])


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases(*(f"{kind}-SPACE" for kind in IN_SPACE if kind not in ("spherical", "rigid")))
@pytest.mark.parametrize(
    ("kind", "space"),
    [
        *(pytest.param(kind, False, id=f"{kind}-PLANE") for kind in IN_PLANE),
        *(pytest.param(kind, True, id=f"{kind}-SPACE") for kind in IN_SPACE),
    ],
)
def test_no_kind_changes_momentum_or_spin(kind, space, tmp_path):
    head, keys = (SPACE, IN_SPACE[kind]) if space else (PLANE, IN_PLANE[kind])
    model = loaded(head.format(f'"{kind}"{keys}'), tmp_path)
    for coordinates in COORDINATES:
        run = model.simulate(coordinates=coordinates, times=[0.0, 0.5, 1.0, 1.3, 2.0], **TIGHT)
        assert run.ok and [event.name for event in run.events] == ["w.holds"], run.reason
        before, caught, *after = (momenta_and_place(run, k, space) for k in (1, 2, 3, 4))
        for momentum, spin, place in after:
            assert momentum == pytest.approx(before[0], abs=1e-12) and spin == pytest.approx(before[1], abs=1e-12)
            if kind in POINT_STAYS:
                assert place == pytest.approx(caught[2], abs=1e-10)
        assert run["w.dissipated"][-1] > 1e-6 and np.abs(run.energy_error).max() < 1e-10


@pytest.mark.parametrize("head", [PLANE, SPACE])
def test_formulas_read_the_force_in_axes_of_the_ground(head, tmp_path):
    """A push on b is passed on to a: its acceleration says by which force."""
    push = "[1.0, 0.3]" if head is PLANE else "[1.0, 0.3, 0.2]"
    text = head.format(f'"rigid"{_AT}') + f'[forces.push]\ntype = "force"\nbody = "b"\nforce = {push}\n'
    text += '[outputs]\nx = "w.Fx"\ny = "w.Fy"\nsize = "w.F"\n'
    run = loaded(text, tmp_path).simulate(**TIGHT)
    held = run.t > 1.0
    assert run.outputs["x"][held] == pytest.approx(2.0 * run["a.ax"][held], abs=1e-10)
    assert run.outputs["y"][held] == pytest.approx(2.0 * run["a.ay"][held], abs=1e-10)
    assert run.outputs["size"][held] == pytest.approx(run["w.F"][held], abs=1e-10)


def test_a_point_mass_is_held_in_the_frame_of_what_turns(tmp_path):
    text = PLANE.replace("mass = 2.0\ninertia = 0.05\nangular_velocity = 0.8", 'type = "point"\nmass = 2.0').replace(
        "mass = 1.0\ninertia = 0.02", "mass = 1.0\ninertia = 0.02\nangular_velocity = 0.8"
    )
    run = loaded(text.format(f'"revolute"{_AT}'), tmp_path).simulate(**TIGHT)
    spin = sum(
        mass * (run[f"{b}.x"] * run[f"{b}.vy"] - run[f"{b}.y"] * run[f"{b}.vx"]) for b, mass in (("a", 2.0), ("b", 1.0))
    )
    assert spin + 0.02 * run["b.omega"] == pytest.approx(0.216, abs=1e-12)


def test_linear_systems_take_a_caught_joint_at_its_place(tmp_path):
    """At a time at which the weld holds: three coordinates are left, and none is off its rows."""
    model = loaded(DOCKING, tmp_path)
    for time, freedoms in ((0.5, 6), (1.5, 3), (2.2, 6)):
        assert np.shape(model.linearise(at=time, instantaneous=True).A) == (2 * freedoms, 2 * freedoms)


# -- conditions, and joints that the tree has taken --------------------------------------------------------------------

ROD = """
[mechanism]
name = "rod"
gravity = [0.0, -9.81]
[run]
until = 1.2
[bodies.rod]
mass = 1.0
inertia = 0.03
points = { top = [-0.3, 0.0] }
position = [0.3, 0.0]
[joints.pin]
type = "revolute"
between = ["ground", "rod"]
at = [[0.0, 0.0], "top"]
[joints.latch]
type = "orientation"
between = ["ground", "rod"]
holds_at = "present"
holds = {holds}
"""


def fall(time, theta=0.0):
    """Return the angle of the rod after it has fallen from rest for a time."""

    def rates(_, y):
        return [y[1], -9.81 * 0.3 * np.cos(y[0]) / 0.12]

    return solve_ivp(rates, (0.0, time), [theta, 0.0], "DOP853", rtol=1e-12, atol=1e-13).y[0, -1]


@pytest.mark.parametrize("coordinates", COORDINATES)
@pytest.mark.parametrize(
    ("holds", "names", "phases"),
    [
        # a condition that stays true does not become true again
        ('{ catches = "t > 0.3", releases = "t > 0.7", at_start = false }', "holds releases", (0.3, 0.5)),
        # one that is true before the catch does not release after it
        ('{ catches = "t > 0.3", releases = "t > 0.1", at_start = false }', "holds", (0.3,)),
        ('{ catches = "sin(10*t) > 0.5", releases = "t > 0.2" }', "holds releases holds", None),
        ('"t > 0.3 and t < 0.7"', "holds releases", (0.3, 0.5)),
        ('{ releases = "t > 0.7", catches = "t > 0.9", at_start = true }', "releases holds", (0.2,)),
    ],
)
def test_a_joint_catches_and_releases_as_its_conditions_become_true(holds, names, phases, coordinates, tmp_path):
    model = loaded(ROD.replace("{holds}", holds), tmp_path)
    run = model.simulate(coordinates=coordinates, **TIGHT)
    assert run.ok, run.reason
    assert [event.name for event in run.events] == [f"latch.{name}" for name in names.split()]
    if phases is not None:
        theta = 0.0
        for phase in phases:
            theta = fall(phase, theta)
        assert run["rod.theta"][-1] == pytest.approx(theta, abs=1e-9)


@pytest.mark.parametrize("kind", ["orientation", "driver"])
def test_what_would_prescribe_a_coordinate_of_the_tree_keeps_its_row_where_it_holds_for_a_while(kind, tmp_path):
    keys = 'type = "driver"\njoint = "pin"\nvalue = "0.3*t"\nholds_at = "present"'
    old = 'type = "orientation"\nbetween = ["ground", "rod"]\nholds_at = "present"'
    text = ROD.replace("{holds}", '"t > 0.3 and t < 0.7"')
    assert old in text
    model = loaded(text if kind == "orientation" else text.replace(old, keys), tmp_path)
    runs = [model.simulate(coordinates=coordinates, **TIGHT) for coordinates in ("absolute", "joint", "auto")]
    rate = 0.3 if kind == "driver" else 0.0
    for run in runs:
        assert run.ok and run["rod.omega"][(run.t > 0.3) & (run.t < 0.7)] == pytest.approx(rate, abs=1e-9)
        assert run["rod.theta"][-1] == pytest.approx(runs[0]["rod.theta"][-1], abs=1e-8)


def test_two_point_masses_have_no_frame(tmp_path):
    text = SPACE.replace("inertia = [0.05, 0.06, 0.07]\nangular_velocity = [0.3, 0.2, 0.8]", 'type = "point"')
    text = text.replace("inertia = [0.02, 0.03, 0.04]", 'type = "point"').replace(
        "angular_velocity = [-0.2, 0.1, 0.4]\n", ""
    )
    with pytest.raises(
        InputError, match=r"holds_at: expected a body that turns, .* the point masses 'a' and 'b'; a dist"
    ):
        loaded(text.format(f'"spherical"{_AT}'), tmp_path)
