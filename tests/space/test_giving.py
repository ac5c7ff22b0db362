"""Rolling that gives way, beside closed forms: cars that brake, discs that slip and then roll, tops that turn over."""

import math

import numpy as np
import pytest
from support.emitted import Emitted

import symgen
from symgen.study.references.independent import IndependentEquations
from tests.study.test_independent_space import second_rates

G = 9.81
FLAT = {"normal": (0.0, 0.0, 1.0)}


def mechanism(name, gravity=G):
    return symgen.MechanismBuilder(name, space="spatial", gravity=(0.0, 0.0, -gravity))


def simulated(builder, **settings):
    result = symgen.load(builder.build()).simulate(**settings)
    assert result.status in ("ok", "unverified"), result.reason
    return result


# -- a body that slips and then rolls ----------------------------------------------------------------------------------


def coin(stiffness=1e6, speed=1e-3, friction=0.3, **motion):
    """An upright coin of 2 kg that touches the road with its weight."""
    builder = mechanism("coin").body(
        "coin", mass=2.0, inertia=(0.045, 0.09, 0.045), position=(0.0, 0.0, 0.3 - 2.0 * G / stiffness), **motion
    )
    law = {"coefficient": friction, "speed": speed}
    return builder.joint(
        *("road", "rolling-disc"),
        **FLAT | {"body": "coin", "axis": (0, 1, 0), "radius": 0.3, "stiffness": stiffness, "friction": law},
    )


@pytest.mark.slow
def test_a_coin_slips_and_then_rolls():
    """With no spin at first two thirds of the speed remain; friction is mu m g until then, and 0 from then on."""
    result = simulated(coin(velocity=(1.0, 0.0, 0.0)), until=0.5, rtol=1e-10)
    assert result["coin.vx"][-1] == pytest.approx(2.0 / 3.0, abs=1e-10)
    assert 0.3 * result["coin.wy"][-1] == pytest.approx(2.0 / 3.0, abs=1e-10)
    slipping = result.t < 0.1
    rolls = 1.0 / (3.0 * 0.3 * G)
    np.testing.assert_allclose(result["coin.vx"][slipping], 1.0 - 0.3 * G * result.t[slipping], atol=1e-9)
    np.testing.assert_allclose(result["road.slip1"][slipping], -0.3 * 2.0 * G, rtol=1e-5)
    np.testing.assert_allclose(result["road.slip1"][result.t > rolls + 0.02], 0.0, atol=1e-5)
    np.testing.assert_allclose(result["road.normal"], 2.0 * G, rtol=1e-5)
    np.testing.assert_allclose(result["road.gap"], -2.0 * G / 1e6, atol=1e-9)


def test_a_spinning_coin_drives_off_at_a_third_of_its_rim():
    result = simulated(coin(angular_velocity=(0.0, 5.0, 0.0)), until=1.0, rtol=1e-10)
    assert result["coin.vx"][-1] == pytest.approx(0.3 * 5.0 / 3.0, abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(("speed", "spin"), [(1.4, 0.0), (0.0, 14.0), (-0.5, 7.0)])
def test_a_ball_slips_and_then_rolls(speed, spin):
    """The moment of momentum about any point of the track is kept: v = 5/7 v0 + 2/7 r omega0."""
    radius, mass = 0.1, 0.5
    push = {"stiffness": 1e5, "friction": {"coefficient": 0.4, "speed": 1e-4}}
    builder = mechanism("ball").body(
        "ball",
        mass=mass,
        inertia=(0.4 * mass * radius**2,) * 3,
        position=(0.0, 0.0, radius - mass * G / 1e5),
        velocity=(speed, 0.0, 0.0),
        angular_velocity=(0.0, spin, 0.0),
    )
    builder.joint("lane", "rolling-sphere", body="ball", radius=radius, **FLAT, **push)
    result = simulated(builder, until=1.0, rtol=1e-10)
    rolling = 5.0 / 7.0 * speed + 2.0 / 7.0 * radius * spin
    assert result["ball.vx"][-1] == pytest.approx(rolling, abs=1e-9)
    assert radius * result["ball.wy"][-1] == pytest.approx(rolling, abs=1e-9)
    slip = speed - radius * spin
    turns = abs(slip) / (3.5 * 0.4 * G)
    before = result.t < 0.9 * turns
    expected = speed - math.copysign(0.4 * G, slip) * result.t[before]
    np.testing.assert_allclose(result["ball.vx"][before], expected, atol=1e-9)


# -- the limit ---------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_limit_is_rolling_without_slip():
    """A coin that leans on a bend: the error falls with the first power of 1/stiffness and of the speed of friction."""

    def leaning(**contact):
        builder = mechanism("leaning").body(
            "coin",
            mass=2.0,
            inertia=(0.045, 0.045, 0.09),
            position=(0.0, 0.0, 0.3 * math.sin(1.2)),
            orientation={"rotation_vector": (1.2, 0.0, 0.0)},
            velocity=(1.0, 0.0, 0.0),
            angular_velocity=(0.0, 0.0, -1.0 / 0.3),
        )
        keys = {"body": "coin", "axis": (0, 0, 1), "radius": 0.3}
        result = simulated(builder.joint("road", "rolling-disc", **FLAT, **keys, **contact), until=0.6, rtol=1e-11)
        return np.array([result[f"coin.{x}"][-1] for x in ("x", "y", "z", "e0", "e1", "e2", "e3")])

    ideal = leaning()
    errors = []
    for scale in (1.0, 0.5, 0.25):
        friction = {"coefficient": 0.8, "speed": 2e-3 * scale}
        errors.append(np.abs(leaning(stiffness=1e5 / scale, damping=2e3, friction=friction) - ideal).max())
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    np.testing.assert_allclose(orders, 1.0, atol=0.1)
    assert errors[-1] < 2e-3


# -- planes that move --------------------------------------------------------------------------------------------------


def turntable(rate, **contact):
    """A ball on a table that turns evenly: one that gives way starts without spin, any other one rolls."""
    radius, mass = 0.05, 0.3
    builder = mechanism("turntable").body("table", mass=5.0, inertia=(1.0, 1.0, 2.0), position=(0.0, 0.0, 0.0))
    builder.joint("axle", "revolute", between=("ground", "table"), at=((0, 0, 0), "centre"), axis=(0, 0, 1))
    builder.joint("drive", "driver", joint="axle", value=f"{rate}*t")
    depth = mass * G / contact["stiffness"] if contact else 0.0
    builder.body(
        "ball",
        mass=mass,
        inertia=(0.4 * mass * radius**2,) * 3,
        position=(0.2, 0.0, radius - depth),
        velocity=(0.0, 0.2, 0.0),
        angular_velocity=(0.0 if contact else (rate * 0.2 - 0.2) / radius, 0.0, 0.0),
    )
    keys = {"between": ("ball", "table"), "radius": radius}
    return builder.joint("roll", "rolling-sphere", **FLAT, **keys, **contact)


@pytest.mark.slow
def test_a_ball_on_a_turntable_goes_round_at_two_sevenths_of_its_rate():
    """v' = 2/7 Omega x v, whatever the place: a circle about a point that the start decides."""
    rate = 3.0
    result = simulated(turntable(rate), until=4.0, rtol=1e-10, method="direct-correction")
    velocity = result["ball.vx"] + 1j * result["ball.vy"]
    np.testing.assert_allclose(velocity, velocity[0] * np.exp(2j / 7.0 * rate * result.t), atol=1e-8)
    place = result["ball.x"] + 1j * result["ball.y"]
    circle = place[0] + velocity[0] / (2j / 7.0 * rate) * (np.exp(2j / 7.0 * rate * result.t) - 1.0)
    np.testing.assert_allclose(place, circle, atol=1e-8)


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_a_ball_that_gives_way_is_caught_by_the_turntable():
    """Once it rolls, it goes round at the same rate; the table takes the opposite of what the ball feels."""
    rate = 3.0
    friction = {"coefficient": 0.5, "speed": 1e-5}
    result = simulated(turntable(rate, stiffness=1e5, friction=friction), until=3.0, rtol=1e-10, integrator="radau5")
    velocity = (result["ball.vx"] + 1j * result["ball.vy"])[result.t > 0.5]
    turned = np.unwrap(np.angle(velocity))
    slope = np.polyfit(result.t[result.t > 0.5], turned, 1)[0]
    assert slope == pytest.approx(2.0 / 7.0 * rate, abs=1e-4)
    np.testing.assert_allclose(np.abs(velocity), np.abs(velocity[0]), rtol=1e-4)


@pytest.mark.slow
def test_action_and_reaction_on_a_floating_plate():
    """A disc slips and rolls on a plate that floats: momentum and moment of momentum of both together are kept."""
    builder = mechanism("plate", gravity=0.0)
    builder.body(
        "plate", mass=3.0, inertia=(0.2, 0.3, 0.4), position=(0.1, -0.05, 0.0), angular_velocity=(0.3, 0.1, 0.2)
    )
    builder.body(
        "disc",
        mass=1.0,
        inertia=(0.02, 0.02, 0.04),
        position=(0.0, 0.1, 0.26),
        orientation={"rotation_vector": (1.1, 0.2, 0.0)},
        velocity=(0.5, 0.2, -0.3),
        angular_velocity=(1.0, 2.0, -6.0),
    )
    friction = {"coefficient": 0.6, "speed": 0.01}
    contact = {"normal": (0.1, 0.2, 1.0), "radius": 0.3, "stiffness": 2e3, "damping": 5.0, "friction": friction}
    builder.joint("roll", "rolling-disc", between=("disc", "plate"), axis=(0, 0, 1), **contact)
    result = simulated(builder, until=0.3, rtol=1e-11)
    assert result["roll.normal"].max() > 1.0, "they touch"
    assert np.hypot(result["roll.slip1"], result["roll.slip2"]).max() > 0.5
    momentum, moment = np.zeros((len(result.t), 3)), np.zeros((len(result.t), 3))
    for name, mass, inertia in (("plate", 3.0, (0.2, 0.3, 0.4)), ("disc", 1.0, (0.02, 0.02, 0.04))):
        at, v, w = (
            np.column_stack([result[f"{name}.{k}"] for k in keys])
            for keys in (("x", "y", "z"), ("vx", "vy", "vz"), ("wx", "wy", "wz"))
        )
        e0, e = result[f"{name}.e0"][:, None], np.column_stack([result[f"{name}.e{k}"] for k in (1, 2, 3)])
        spin = w * inertia
        turned = spin + 2.0 * np.cross(e, np.cross(e, spin) + e0 * spin)
        momentum += mass * v
        moment += np.cross(at, mass * v) + turned
    np.testing.assert_allclose(momentum, momentum[:1].repeat(len(result.t), 0), atol=1e-10)
    np.testing.assert_allclose(moment, moment[:1].repeat(len(result.t), 0), atol=1e-10)


# -- vehicles ----------------------------------------------------------------------------------------------------------

HULL, WHEEL, RADIUS, SPIN = 600.0, 20.0, 0.3, 0.9
AXLES = {"fl": (1.1, 0.7), "fr": (1.1, -0.7), "rl": (-1.3, 0.7), "rr": (-1.3, -0.7)}


@pytest.mark.slow
def test_a_car_brakes():
    """Friction of each wheel is what its brake leaves after the spin of the wheel, and loads move to the front."""
    torque, height = 100.0, 0.5
    road = {"stiffness": 2e7, "damping": 2e4, "friction": {"coefficient": 0.8, "speed": 1e-3}}
    builder = mechanism("car").body(
        "hull", mass=HULL, inertia=(100.0, 400.0, 450.0), position=(0, 0, height), velocity=(1.0, 0, 0)
    )
    for name, (x, y) in AXLES.items():
        builder.body(
            name,
            mass=WHEEL,
            inertia=(0.5, SPIN, 0.5),
            position=(x, y, RADIUS),
            velocity=(1.0, 0, 0),
            angular_velocity=(0, 1.0 / RADIUS, 0),
        )
        builder.joint(
            f"hub_{name}", "revolute", between=("hull", name), at=((x, y, RADIUS - height), "centre"), axis=(0, 1, 0)
        )
        builder.joint(f"road_{name}", "rolling-disc", body=name, axis=(0, 1, 0), radius=RADIUS, **FLAT, **road)
        builder.force(f"brake_{name}", "torque", joint=f"hub_{name}", torque=-torque)
    result = simulated(builder, until=0.4, rtol=1e-10)
    mass = HULL + 4.0 * WHEEL
    braking = 4.0 * torque / RADIUS / (mass + 4.0 * SPIN / RADIUS**2)
    late = result.t > 0.3
    np.testing.assert_allclose(np.polyfit(result.t[late], result["hull.vx"][late], 1)[0], -braking, rtol=1e-6)
    friction = (torque - SPIN * braking / RADIUS) / RADIUS
    front, rear = AXLES["fl"][0], AXLES["rl"][0]
    middle = 2.0 * WHEEL * (front + rear) / mass
    tipping = (HULL * height + 4.0 * WHEEL * RADIUS) * braking + 4.0 * SPIN * braking / RADIUS
    loads = {
        "f": (mass * G * (middle - rear) + tipping) / (front - rear) / 2.0,
        "r": (mass * G * (front - middle) - tipping) / (front - rear) / 2.0,
    }
    for name in AXLES:
        load = loads[name[0]]
        np.testing.assert_allclose(result[f"road_{name}.slip1"][late], -friction, rtol=1e-3)
        np.testing.assert_allclose(result[f"road_{name}.normal"][late], load, rtol=1e-3)
        slip = result["hull.vx"][late] - RADIUS * (result["hull.wy"] + result[f"hub_{name}.angle.rate"])[late]
        np.testing.assert_allclose(slip, 1e-3 * math.atanh(friction / (0.8 * load)), rtol=2e-3)


@pytest.mark.slow
def test_a_mecanum_cart_drives_sideways():
    """Rollers under 45 degrees: wheels that turn to and fro in a cross move the cart to its side at R omega."""
    radius, turn = 0.1, 4.0
    builder = mechanism("cart").body("hull", mass=20.0, inertia=(0.5, 0.5, 0.8), position=(0.0, 0.0, radius))
    for i, (x, y) in enumerate(((0.3, 0.2), (0.3, -0.2), (-0.3, 0.2), (-0.3, -0.2))):
        sign = (-1.0, 1.0, 1.0, -1.0)[i]
        name = f"wheel{i}"
        builder.body(name, mass=1.0, inertia=(0.004, 0.005, 0.004), position=(x, y, radius))
        builder.joint(f"hub{i}", "revolute", between=("hull", name), at=((x, y, 0.0), "centre"), axis=(0, 1, 0))
        builder.joint(f"motor{i}", "driver", joint=f"hub{i}", value=f"{sign * turn}*(t - 0.1*(1 - exp(-10*t)))")
        friction = {"coefficient": 0.7, "speed": 0.01, "direction": f"{sign}*pi/4"}
        keys = {"axis": (0, 1, 0), "radius": radius, "stiffness": 1e5, "damping": 300.0, "friction": friction}
        builder.joint(f"floor{i}", "rolling-disc", body=name, **FLAT, **keys)
    result = simulated(builder, until=2.0, rtol=1e-9)
    late = result.t > 1.5
    np.testing.assert_allclose(result["hull.vy"][late], radius * turn, rtol=1e-4)
    np.testing.assert_allclose(result["hull.vx"][late], 0.0, atol=1e-6)
    np.testing.assert_allclose(result["hull.wz"][late], 0.0, atol=1e-6)
    assert "floor0.slip" in result.elements.names


@pytest.mark.slow
def test_a_tippe_top_turns_over():
    """Friction lifts the stem from 0.1 rad to the lower side; Jellett's product of spin and lever is kept."""
    mass, radius, off, spin, lean = 0.006, 0.015, 0.003, 300.0, 0.1
    across, along = 8e-7, 7e-7
    builder = mechanism("top").body(
        "top",
        mass=mass,
        inertia=(across, across, along),
        points={"middle": (0.0, 0.0, off)},
        position=(0.0, 0.0, radius - off * math.cos(lean)),
        orientation={"rotation_vector": (lean, 0.0, 0.0)},
        angular_velocity=(0.0, 0.0, spin),
    )
    floor = {"stiffness": 2e3, "damping": 0.3, "friction": {"coefficient": 0.3, "speed": 0.01}}
    builder.joint("floor", "rolling-sphere", body="top", centre="middle", radius=radius, **FLAT, **floor)
    result = simulated(builder, until=12.0, rtol=1e-9)
    e = [result[f"top.e{k}"] for k in range(4)]
    upright = e[0] ** 2 - e[1] ** 2 - e[2] ** 2 + e[3] ** 2
    assert upright[0] == pytest.approx(math.cos(lean))
    assert upright[-1] < -0.99, "it stands on its stem"
    axis = np.column_stack([2 * (e[1] * e[3] + e[0] * e[2]), 2 * (e[2] * e[3] - e[0] * e[1]), upright])
    w = np.column_stack([result[f"top.w{k}"] for k in "xyz"]) * (across, across, along)
    vector, scalar = np.column_stack(e[1:]), e[0][:, None]
    momentum = w + 2.0 * np.cross(vector, np.cross(vector, w) + scalar * w)
    lever = off * axis - radius * np.array([0.0, 0.0, 1.0])
    jellett = (momentum * lever).sum(axis=1)
    np.testing.assert_allclose(jellett, jellett[0], rtol=1e-6)


# -- a second derivation -----------------------------------------------------------------------------------------------


CONTACTS = {
    "rigid": {},
    "slip": {"stiffness": 2e3, "damping": 5.0, "friction": {"coefficient": 0.6, "speed": 0.1}},
    "rollers": {"stiffness": 2e3, "friction": {"coefficient": 0.6, "speed": 0.1, "direction": 0.6}},
}


@pytest.mark.by_turns(10)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "contact"),
    [
        *((kind, x) for kind in ("rolling-disc", "rolling-sphere") for x in ("rigid", "slip")),
        ("rolling-disc", "rollers"),
    ],
)
def test_accelerations_are_those_of_a_second_derivation(kind, contact):
    """A disc or a ball in a plane of a body that turns, beside what SymPy derives from positions in the room."""
    keys = {"normal": (0.1, 0.2, 1.0), "on": (0.03, 0.02, 0.01), "radius": 0.3, "reference": (1.0, 0.3, 0.0)}
    keys |= {"axis": (0.2, 1.0, 0.1)} if kind == "rolling-disc" else {}
    builder = mechanism("pair")
    builder.body("base", mass=3.0, inertia=(0.2, 0.3, 0.4, 0.01, 0.02, 0.03), position=(0.1, -0.05, 0.02))
    builder.body("round", mass=1.0, inertia=(0.02, 0.03, 0.04), position=(0.02, 0.1, 0.27))
    described = builder.joint("roll", kind, between=("round", "base"), **keys, **CONTACTS[contact]).build()
    random, emitted = np.random.default_rng(3), Emitted(described)
    q = np.concatenate(
        [
            np.r_[at, turn / np.linalg.norm(turn)]
            for at, turn in (
                ((0.1, -0.05, 0.02), np.array([1.0, 0.1, -0.2, 0.15])),
                ((0.02, 0.1, 0.29), np.array([1.0, -0.1, 0.1, 0.3])),
            )
        ]
    )
    v = random.normal(size=12)
    equations = IndependentEquations(described, {})
    y = equations.state(q, v)
    found = emitted.at(0.0, q, v, emitted.parameters({}))
    if contact == "rigid":
        n, m = equations.n, emitted.info.m
        _, d, _, _, _ = equations.evaluate(0.0, y[:n], y[n:])
        columns = np.column_stack([equations.state(y[:n], unit)[n:] for unit in np.eye(12)])
        np.testing.assert_allclose(found.d, d[:m] @ columns, atol=1e-12)
        assert m == 3
    else:
        assert np.abs(equations.rate(0.0, y)[equations.n :]).max() > 10.0, "they touch"
    expected = second_rates(equations, y[: equations.n], v, found.acceleration)
    np.testing.assert_allclose(equations.rate(0.0, y)[equations.n :], expected, rtol=1e-9, atol=1e-9)
