"""States whose rates read what a motion results in: reactions, accelerations and losses, beside simulations by hand."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import symgen
from symgen.base.errors import InputError
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate

M, L, INERTIA, C, G, TAU = 1.7, 0.45, 0.2, 0.25, 9.81, 0.04
TIGHT = {"rtol": 1e-11, "atol": 1e-12}
#: A door that hangs on a hinge whose load a scale shows with a lag; the scale pulls back a little.
DOOR = f"""
[mechanism]
name = "hanging-door"
gravity = [0.0, -{G}]

[parameters]
mass = {M}

[bodies.door]
mass = "mass"
inertia = {INERTIA}
position = [{L}, 0.0]

[joints.hinge]
type = "revolute"
between = ["ground", "door"]
at = [[0.0, 0.0], [-{L}, 0.0]]

[forces.air]
type = "torque"
body = "door"
torque = "-{C}*door.omega - 0.03*load"

[states]
load = {{ rate = "(hinge.Fy - load)/{TAU}" }}
swept = {{ rate = "door.alpha" }}
heat = {{ rate = "-air.power" }}
"""
#: A wheel of 2 kg m^2 that friction of 3 N m stops after 6 s, and what is left of the heat.
BRAKE = """
[mechanism]
name = "braked-wheel"

[bodies.wheel]
mass = 1.0
inertia = 2.0
angular_velocity = 9.0

[joints.axle]
type = "revolute"
between = ["ground", "wheel"]
at = [[0.0, 0.0], "centre"]
friction = { sliding = 3.0 }

[states]
warmth = { rate = "(axle.dissipated.rate - 5.0*warmth)/40.0" }
"""


def door_by_hand(until: float, mass: float = M) -> np.ndarray:
    """Return angle, rate, load and heat at the end; the ground carries minus m (a + g)."""

    def rates(_: float, y: np.ndarray) -> list[float]:
        angle, omega, load, _ = y
        alpha = (-mass * G * L * np.cos(angle) - C * omega - 0.03 * load) / (INERTIA + mass * L**2)
        rise = L * (np.cos(angle) * alpha - np.sin(angle) * omega**2)
        return [omega, alpha, (-mass * (rise + G) - load) / TAU, (C * omega + 0.03 * load) * omega]

    return solve_ivp(rates, (0.0, until), [0.0] * 4, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]


def read(text: str) -> symgen.Model:
    return symgen.load(validate(parse_toml(text, "door.toml"), "door.toml"))


@pytest.mark.slow_cases("null-space-dop853-absolute-1e-09")
@pytest.mark.parametrize(
    ("method", "integrator", "coordinates", "tolerance"),
    [
        ("lagrange", "dop853", "absolute", 1e-9),
        ("lagrange", "dop853", "joint", 1e-9),
        ("direct-correction", "dop853", "absolute", 1e-9),
        ("null-space", "dop853", "absolute", 1e-9),
        ("index1-augmented-lagrangian", "dop853", "absolute", 1e-8),
        ("lagrange", "radau5", "absolute", 1e-7),
        ("ggl", "radau5", "absolute", 1e-7),
        ("lagrange", "picard", "absolute", 1e-9),
    ],
)
def test_states_follow_reactions_and_accelerations(method, integrator, coordinates, tolerance):
    settings = {"method": method, "integrator": integrator, "coordinates": coordinates}
    result = read(DOOR).simulate(until=0.6, **settings, **TIGHT)
    exact = door_by_hand(0.6)
    assert result.status == "ok"
    found = [result[name][-1] for name in ("door.theta", "door.omega", "load", "heat", "swept")]
    np.testing.assert_allclose(found, [*exact, exact[1]], rtol=0.0, atol=tolerance)


@pytest.mark.slow_cases("joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_brake_is_heated_by_what_it_takes(coordinates):
    result = read(BRAKE).simulate(until=8.0, integrator="dop853", coordinates=coordinates, **TIGHT)
    assert result.status == "ok"
    stop, k = 6.0, 5.0 / 40.0  # until it stops 40 T' = 3 (9 - 1.5 t) - 5 T, then T falls alone
    risen = 27.0 / 40.0 * (1 - np.exp(-k * stop)) / k
    fallen = 4.5 / 40.0 * (stop / k - (1 - np.exp(-k * stop)) / k**2)
    assert result["warmth"][-1] == pytest.approx((risen - fallen) * np.exp(-2.0 * k), abs=1e-9)


@pytest.mark.slow
def test_derivatives_and_sweeps_have_them():
    model, settings = read(DOOR), {"method": "lagrange", "integrator": "dop853", "until": 0.4, **TIGHT}
    low, high = door_by_hand(0.4, M - 1e-4)[2], door_by_hand(0.4, M + 1e-4)[2]
    slope = model.simulate(sensitivities=["mass"], **settings).gradient("load").row()["mass"]
    assert slope == pytest.approx((high - low) / 2e-4, rel=1e-6)
    rows = symgen.sweep(model, {"mass": [M - 1e-4, M + 1e-4]}, quantities=["load"], **settings)
    np.testing.assert_allclose(rows["load"][:, -1], [low, high], rtol=0.0, atol=1e-9)


def test_a_linear_system_has_the_slopes_of_the_reaction():
    """About the door at rest below its hinge, moved by its angle alone the load changes in second order."""
    hanging = DOOR.replace(f"position = [{L}, 0.0]", f"position = [0.0, -{L}]\nangle = -1.5707963267948966")
    held = hanging.replace(" - 0.03*load", "").partition("swept")[0]
    system = read(held).linearise()
    values = sorted(np.linalg.eigvals(system.A).real)
    assert values[0] == pytest.approx(-1.0 / TAU, rel=1e-9)
    j = INERTIA + M * L**2
    assert values[1:3] == pytest.approx([-C / (2 * j)] * 2, rel=1e-9)


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("0.03*load", "0.03*hinge.Fy", "'hinge.Fy', which follows from all forces and may depend on this formula"),
        ("0.03*load", "0.03*door.alpha", "'door.alpha', which follows from all forces"),
        ('"door.alpha"', '"integral(door.omega)"', "an integral; a state of its own has the integrand as its rate"),
    ],
)
def test_a_circle_is_named(old, new, sentence):
    with pytest.raises(InputError, match=sentence):
        read(DOOR.replace(old, new))


def test_methods_of_momenta_and_loops_are_refused():
    with pytest.raises(InputError, match="a state reads accelerations or forces"):
        read(DOOR).simulate(until=0.1, method="hamiltonian-baumgarte")
    with pytest.raises(InputError, match="states that read accelerations or forces"):
        read(DOOR).simulate(until=0.1, shape="looped", method="lagrange", coordinates="absolute")
