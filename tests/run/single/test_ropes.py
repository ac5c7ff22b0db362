"""Ropes over sheaves: tackles, a swing about a sheave, a drum that winds a rope up, and a rope that goes slack."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import symgen
from symgen.base.errors import InputError

G = 10.0


def tackle(**keys):
    """A load in a loop of the rope, and a counterweight over a fixed sheave."""
    builder = symgen.MechanismBuilder("tackle", gravity=(0.0, -G))
    builder.body("load", type="point", mass=3.0, position=(0.0, -1.0))
    builder.body("weight", type="point", mass=2.0, position=(0.5, -0.5))
    builder.joint("load_guide", "rows", rows=[{"position": "load.x"}])
    builder.joint("weight_guide", "rows", rows=[{"position": "weight.x - 0.5"}])
    over = [
        {"body": "load", "at": "centre", "radius": 0.1, "turn": "left"},
        {"at": (0.3, 0.0), "radius": 0.2, "turn": "right"},
    ]
    builder.joint("rope", "rope", between=("ground", "weight"), at=((-0.1, 0.0), "centre"), over=over, **keys)
    return symgen.load(builder.build())


@pytest.mark.slow_cases("joint", "looped")
@pytest.mark.parametrize(
    "settings", [{}, {"coordinates": "joint"}, {"shape": "looped"}], ids=["plain", "joint", "looped"]
)
def test_a_tackle_halves_the_weight_of_its_load(settings):
    result = tackle().simulate(until=0.5, rtol=1e-10, **settings)
    assert result.ok
    rise = G * (2.0 * 2.0 - 3.0) / (3.0 + 4.0 * 2.0)
    np.testing.assert_allclose(result["load.vy"], rise * result.t, atol=1e-10)
    np.testing.assert_allclose(result["weight.vy"], -2.0 * rise * result.t, atol=1e-10)
    np.testing.assert_allclose(result["multiplier.rope.tension"], 2.0 * (G - 2.0 * rise), rtol=1e-9)


def test_the_length_at_the_start_is_that_of_the_way():
    row = tackle().mechanism.joints[-1].rows[0]
    assert row.value.value == pytest.approx(1.0 + 0.1 * math.pi + 1.0 + 0.2 * math.pi + 0.5, abs=1e-14)
    with_length = tackle(length="2.5 + 0.3*pi").mechanism.joints[-1].rows[0]
    assert symgen.load(tackle().mechanism).simulate(until=0.01).ok and with_length.label == "tension"


def swinging(**keys):
    builder = symgen.MechanismBuilder("swing", gravity=(0.0, -G))
    builder.body("bob", type="point", mass=1.5, position=(0.75, -0.9))
    over = [{"at": (0.0, 0.0), "radius": 0.2, "turn": "right"}]
    builder.joint("rope", "rope", between=("ground", "bob"), at=((-2.0, 0.2), "centre"), over=over, **keys)
    return symgen.load(builder.build())


def test_a_bob_swings_about_a_sheave():
    """The contact moves along the rim: an own equation of the direction of the rope."""
    radius, at = 0.2, np.array([0.75, -0.9])
    length = math.sqrt(at @ at - radius**2)
    first = math.atan2(at[1], at[0]) - math.asin(radius / math.hypot(*at))

    def rates(t, y):
        free = length + radius * (y[0] - first)
        return [y[1], -(G * math.cos(y[0]) + radius * y[1] ** 2) / free]

    result = swinging().simulate(until=3.0, rtol=1e-11)
    assert result.ok
    own = solve_ivp(rates, (0.0, 3.0), [first, 0.0], method="DOP853", rtol=1e-12, atol=1e-13, t_eval=result.t)
    direction, free = own.y[0], length + radius * (own.y[0] - first)
    # with the centre to the right, the rope leaves the rim to the left of the centre as it goes along
    x = -radius * np.sin(direction) + free * np.cos(direction)
    y = radius * np.cos(direction) + free * np.sin(direction)
    np.testing.assert_allclose(result["bob.x"], x, atol=1e-8)
    np.testing.assert_allclose(result["bob.y"], y, atol=1e-8)


def test_a_rope_winds_up_round_by_round():
    """Without gravity the speed stays, and the free length l falls by l l' = -r v, over more than a round."""
    builder = symgen.MechanismBuilder("winding", gravity=(0.0, 0.0))
    builder.body("puck", type="point", mass=0.5, position=(0.1, -1.0), velocity=(-0.8, 0.0))
    over = [{"at": (0.0, 0.0), "radius": 0.1, "turn": "right"}]
    builder.joint("rope", "rope", between=("ground", "puck"), at=((-1.0, 0.1), "centre"), over=over)
    result = symgen.load(builder.build()).simulate(until=6.0, rtol=1e-11)
    assert result.ok
    free = result["puck.x"] ** 2 + result["puck.y"] ** 2 - 0.01
    np.testing.assert_allclose(free, 1.0 - 2.0 * 0.1 * 0.8 * result.t, atol=1e-8)
    rounds = np.unwrap(np.arctan2(result["puck.y"], result["puck.x"]))
    assert rounds[0] - rounds[-1] > 1.2 * math.tau


def test_a_rope_that_stretches_goes_slack_and_comes_back():
    """A thrown bob flies as free while the rope is slack; with damping it hangs in the end by m g over k."""
    builder = symgen.MechanismBuilder("bungee", gravity=(0.0, -G))
    builder.body("bob", type="point", mass=1.0, position=(0.0, -0.5))
    builder.joint(
        "rope", "rope", between=("ground", "bob"), at=((0.0, 0.0), "centre"), length=1.0, stiffness=200.0, damping=4.0
    )
    result = symgen.load(builder.build()).simulate(until=8.0, rtol=1e-9)
    assert result.ok
    slack = result.t < math.sqrt(2.0 * 0.5 / G)
    np.testing.assert_allclose(result["bob.y"][slack], -0.5 - 0.5 * G * result.t[slack] ** 2, atol=1e-9)
    np.testing.assert_array_equal(result["rope.force"][slack][:-1], 0.0)
    assert result["rope.force"].max() == 0.0, "it never pushes"
    assert result["rope.stretch"][-1] == pytest.approx(G / 200.0, rel=1e-3)
    assert result["rope.length"][-1] == pytest.approx(1.0 + G / 200.0, rel=1e-4)


@pytest.mark.slow
def test_a_rope_glides_through_an_eyelet():
    """Two weights beside an eyelet between them: (m2 - m1) g/(m1 + m2), and the eyelet may move."""
    builder = symgen.MechanismBuilder("eyelet", gravity=(0.0, -G))
    builder.body("carrier", mass=1.0, inertia=0.1, position=(0.0, 0.2), points={"eye": (0.0, -0.2)})
    builder.joint("rail", "translational", between=("ground", "carrier"), at=((0.0, 0.2), "centre"), axis=(0.0, 1.0))
    builder.joint("lift", "driver", joint="rail", value="0.5*0.6*t**2")
    for name, mass, y in (("left", 1.0, -1.0), ("right", 3.0, -0.5)):
        builder.body(name, type="point", mass=mass, position=(0.0, y))
        builder.joint(f"{name}_guide", "rows", rows=[{"position": f"{name}.x"}])
    over = [{"body": "carrier", "at": "eye"}]
    builder.joint("rope", "rope", between=("left", "right"), at=("centre", "centre"), over=over)
    result = symgen.load(builder.build()).simulate(until=0.4, rtol=1e-11)
    assert result.ok
    # in the frame of the eyelet both weigh by g + 0.6
    share = (G + 0.6) * 2.0 / 4.0
    np.testing.assert_allclose(result["left.vy"], (share + 0.6) * result.t, atol=1e-9)
    np.testing.assert_allclose(result["right.vy"], (0.6 - share) * result.t, atol=1e-9)


@pytest.mark.parametrize(
    ("keys", "sentence"),
    [
        ({"damping": 1.0}, "joints.rope.damping: expected the key stiffness beside it, got 1.0"),
        ({"length": 0.0}, "joints.rope.length: expected a value above 0, got 0.0"),
        ({"stiffness": -1.0}, "joints.rope.stiffness: expected a value above 0, got -1.0"),
    ],
)
def test_what_is_wrong_is_named(keys, sentence):
    with pytest.raises(InputError) as error:
        tackle(**keys)
    assert sentence in str(error.value)


def test_a_sheave_that_holds_an_end_inside_is_named():
    builder = symgen.MechanismBuilder("inside", gravity=(0.0, -G)).body(
        "bob", type="point", mass=1.0, position=(0.1, 0.0)
    )
    over = [{"at": (0.0, 0.0), "radius": 0.2, "turn": "right"}]
    builder.joint("rope", "rope", between=("ground", "bob"), at=((-1.0, 0.0), "centre"), over=over)
    expected = "joints.rope.over: expected sheaves, eyelets and ends apart from each other"
    with pytest.raises(InputError, match=rf"{expected}, got over\[0\] and at\[1\] that overlap"):
        builder.build()
