"""Ropes in space, through eyelets and over sheaves, beside equations written here."""

import math
import subprocess
import sys

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import symgen
from symgen.base.errors import InputError

G = 9.81
TIGHT = {"integrator": "dop853", "rtol": 1e-12, "atol": 1e-13}


def turned(axis: tuple[float, ...], angle: float) -> np.ndarray:
    """Return a rotation matrix by the formula of Rodrigues."""
    x, y, z = np.array(axis) / np.linalg.norm(axis)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * cross @ cross


def hole(**keys: object) -> symgen.Model:
    """Return a ball on a rope through a hole, at whose other end a weight hangs in a guide."""
    return symgen.load(described_hole(**keys).build())


def described_hole(**keys: object) -> symgen.MechanismBuilder:
    builder = symgen.MechanismBuilder("hole", space="spatial", gravity=(0.0, 0.0, -G))
    builder.body("ball", type="point", mass=1.0, position=(0.4, 0.0, -0.3), velocity=(0.3, 1.4, 0.2))
    builder.parameter("m", 1.5).body(
        "weight", type="point", mass="m", position=(0.0, 0.0, -1.0), velocity=(0.0, 0.0, 0.12)
    )
    builder.joint("guide", "rows", rows=[{"position": "weight.x"}, {"position": "weight.y"}])
    builder.joint(
        "rope", "rope", between=("ball", "weight"), at=("centre", "centre"), over=[{"at": (0.0, 0.0, 0.0)}], **keys
    )
    return builder


def spun(times: np.ndarray, m: float = 1.5) -> np.ndarray:
    """Return x, y and z of the ball: its distance from the hole has the inertia of both."""
    start = np.array([0.4, 0.0, -0.3, 0.3, 1.4, 0.2])

    def rates(_, y):
        x, v = y[:3], y[3:]
        r = np.linalg.norm(x)
        u = x / r
        along = v @ u
        # with r'' = u . a + (v^2 - r'^2)/r; weight: m r'' = T - m G, ball: a = g - T u
        g = np.array([0.0, 0.0, -G])
        bend = (v @ v - along**2) / r
        tension = m * (G + u @ g + bend) / (1.0 + m)
        return np.concatenate([v, g - tension * u])

    return solve_ivp(rates, (0.0, times[-1]), start, "DOP853", rtol=1e-12, atol=1e-13, t_eval=times).y[:3].T


@pytest.mark.slow
@pytest.mark.parametrize(
    "settings", [{}, {"coordinates": "joint"}, {"shape": "looped"}], ids=["plain", "joint", "looped"]
)
def test_a_ball_on_a_rope_through_a_hole(settings) -> None:
    result = hole().simulate(until=1.5, **TIGHT, **settings)
    assert result.ok, result.reason
    found = np.array([result[f"ball.{k}"] for k in "xyz"]).T
    np.testing.assert_allclose(found, spun(result.t), rtol=0, atol=1e-9)


@pytest.mark.slow
def test_a_command_runs_it(tmp_path) -> None:
    (tmp_path / "hole.toml").write_text(described_hole().to_toml())
    words = ["--until", "1.5", "--integrator", "dop853", "--rtol", "1e-12", "--atol", "1e-13", "--save", "run.csv"]
    command = [sys.executable, "-m", "symgen", "run", "hole.toml", *words]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    table = np.genfromtxt(tmp_path / "run.csv", delimiter=",", names=True, deletechars="")
    found = np.array([table[f"ball.{k}"] for k in "xyz"]).T
    np.testing.assert_allclose(found, spun(table["t"]), rtol=0, atol=1e-9)


def tackle(rotation: np.ndarray, flipped: bool) -> symgen.Model:
    """Return a load in a loop of the rope, and a counterweight over a fixed sheave, in a plane that is turned.

    The load is a body that spins about the axis of its sheave; `flipped` has the fixed sheave described from behind.
    """

    def at(x: float, y: float) -> tuple[float, ...]:
        return tuple(map(float, rotation @ np.array([x, y, 0.0])))

    down, along = rotation @ [0.0, -1.0, 0.0], rotation @ [1.0, 0.0, 0.0]
    axis = rotation @ [0.0, 0.0, 1.0]
    builder = symgen.MechanismBuilder("tackle", space="spatial", gravity=tuple(map(float, 10.0 * down)))
    spin = {"rotation_vector": tuple(map(float, 0.5 * math.pi * axis))}
    builder.body(
        "load",
        mass=3.0,
        inertia=(0.1, 0.1, 0.1),
        position=at(0.0, -1.0),
        orientation=spin,
        angular_velocity=tuple(map(float, 2.0 * axis)),
    )
    builder.body("weight", type="point", mass=2.0, position=at(0.5, -0.5))
    for name, x in (("load", 0.0), ("weight", 0.5)):
        rows = [" + ".join(f"({a:.17g})*{name}.{k}" for a, k in zip(way, "xyz", strict=True)) for way in (along, axis)]
        rows = [{"position": f"{rows[0]} - ({x})"}, {"position": rows[1]}]
        builder.joint(f"{name}_guide", "rows", rows=rows)
    sign = -1.0 if flipped else 1.0
    over = [
        {"body": "load", "at": "centre", "radius": 0.1, "turn": "left", "axis": tuple(map(float, axis))},
        {
            "at": at(0.3, 0.0),
            "radius": 0.2,
            "turn": "left" if flipped else "right",
            "axis": tuple(map(float, sign * axis)),
        },
    ]
    ends = {"between": ("ground", "weight"), "at": (at(-0.1, 0.0), "centre")}
    return symgen.load(builder.joint("rope", "rope", over=over, **ends).build())


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("flipped", [False, True])
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_tackle_in_a_turned_plane(coordinates, flipped) -> None:
    """The load rises by g (2 m2 - m1)/(m1 + 4 m2), whichever way its body spins and the axis of a sheave points."""
    rotation = turned((0.3, -0.5, 0.8), 1.1)
    result = tackle(rotation, flipped).simulate(until=0.5, coordinates=coordinates, **TIGHT)
    assert result.ok, result.reason
    rise = 10.0 * (2.0 * 2.0 - 3.0) / (3.0 + 4.0 * 2.0)
    up = rotation @ [0.0, 1.0, 0.0]
    speeds = {
        name: sum(a * result[f"{name}.v{k}"] for a, k in zip(up, "xyz", strict=True)) for name in ("load", "weight")
    }
    np.testing.assert_allclose(speeds["load"], rise * result.t, atol=1e-10)
    np.testing.assert_allclose(speeds["weight"], -2.0 * rise * result.t, atol=1e-10)
    np.testing.assert_allclose(result["multiplier.rope.tension"], 2.0 * (10.0 - 2.0 * rise), rtol=1e-9)


def swinging(beside: float) -> symgen.Model:
    """Return a bob on a rope over a sheave, that begins to move out of the plane of the sheave."""
    builder = symgen.MechanismBuilder("swing", space="spatial", gravity=(0.0, -G, 0.0))
    builder.body("bob", type="point", mass=1.5, position=(0.75, -0.9, 0.0), velocity=(0.0, 0.0, beside))
    over = [{"at": (0.0, 0.0, 0.0), "radius": 0.2, "turn": "right", "axis": (0.0, 0.0, 1.0)}]
    builder.joint("rope", "rope", between=("ground", "bob"), at=((-2.0, 0.2, 0.0), "centre"), over=over)
    return symgen.load(builder.build())


def swung(beside: float, times: np.ndarray) -> np.ndarray:
    """Return the way of the bob, whose rope leaves the rim where its projection is tangent, by own derivatives."""
    radius, gravity = 0.2, np.array([0.0, -G, 0.0])

    def gradient(x):
        across, height = np.sqrt(x[0] ** 2 + x[1] ** 2), x[2]
        flat, whole = np.sqrt(across**2 - radius**2), np.sqrt(across**2 + height**2 - radius**2)
        out = np.array([x[0], x[1], 0.0 * x[0]]) / across
        side = np.array([-out[1], out[0], 0.0 * x[0]])
        # the tangent in the plane, with the centre to its right: out = flat/across tangent + radius/across left
        tangent = out * flat / across - side * radius / across
        return (across * out + np.array([0.0, 0.0, 1.0]) * height) / whole + tangent - across * out / flat

    def rates(_, y):
        x, v = y[:3], y[3:]
        slope = gradient(x)
        bend = np.imag(gradient(x + 1e-30j * v)) / 1e-30 @ v
        return np.concatenate([v, gravity - slope * (slope @ gravity + bend) / (slope @ slope)])

    start = np.array([0.75, -0.9, 0.0, 0.0, 0.0, beside])
    return solve_ivp(rates, (0.0, times[-1]), start, "DOP853", rtol=1e-12, atol=1e-13, t_eval=times).y[:3].T


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_bob_swings_out_of_the_plane_of_its_sheave(coordinates) -> None:
    for beside in (0.0, 0.8):
        result = swinging(beside).simulate(until=1.5, coordinates=coordinates, **TIGHT)
        assert result.ok, result.reason
        found = np.array([result[f"bob.{k}"] for k in "xyz"]).T
        np.testing.assert_allclose(found, swung(beside, result.t), rtol=0, atol=1e-9)
        assert np.abs(result.energy_error).max() < 1e-10


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_a_sweep_over_the_weight_is_smooth_with_derivatives() -> None:
    """301 masses of the weight: none fails, ends equal single runs; the derivative equals that of own equations."""
    model, masses = hole(), np.linspace(0.5, 3.0, 301)
    swept = symgen.sweep(model, {"m": masses}, quantities=["ball.z"], until=0.6, rtol=1e-11, atol=1e-12)
    assert set(swept.status.tolist()) == {"ok"}
    ends = np.asarray(swept["ball.z"]).reshape(301)
    for k in (0, 150, 300):
        assert ends[k] == pytest.approx(spun(np.array([0.0, 0.6]), masses[k])[-1, 2], abs=1e-9)
    assert np.abs(np.diff(ends, 4)).max() < 1e-6 * np.ptp(ends)
    run = model.simulate(until=0.6, sensitivities=("m",), **TIGHT)
    sides = [spun(np.array([0.0, 0.6]), 1.5 + h)[-1, 2] for h in (1e-4, -1e-4)]
    assert run.gradient("ball.z").values[-1, 0] == pytest.approx((sides[0] - sides[1]) / 2e-4, rel=1e-6)


@pytest.mark.slow
def test_a_rope_through_a_hole_stretches_and_goes_slack() -> None:
    """The stiffer, the nearer to the rope that keeps its length; in free fall without speed it is slack."""
    times = np.linspace(0.0, 0.5, 6)
    apart = []
    for stiffness in (1e4, 1e5):
        result = hole(stiffness=stiffness, damping=40.0).simulate(until=0.5, times=times)
        assert result.ok and result["rope.force"].max() <= 0.0
        apart.append(np.abs(np.array([result[f"ball.{k}"] for k in "xyz"]).T - spun(times)).max())
    assert apart[1] < 0.2 * apart[0] < 0.2 * 5e-3
    slack = hole(length=2.5, stiffness=1e4).simulate(until=0.3)
    np.testing.assert_allclose(slack["ball.z"], -0.3 + 0.2 * slack.t - 0.5 * G * slack.t**2, atol=1e-9)
    assert not slack["rope.force"].any()


@pytest.mark.parametrize(
    ("over", "sentence"),
    [
        (
            [{"at": (0.0, 0.1, 0.0), "radius": 0.2}],
            "joints.rope.over[0].turn: expected the key of a sheave with a radius",
        ),
        ([{"at": (0.0, 0.1, 0.0), "turn": "left"}], "joints.rope.over[0].turn: expected no such key without a radius"),
        (
            [{"at": (0.0, 0.0, 0.0), "radius": 0.2, "turn": "left", "axis": (0.0, 1.0, 0.0)}],
            "joints.rope.over[0]: expected the parts of the rope beside a sheave in its plane, "
            "as the bodies start, got at[0] that is 0.3 m out of it",
        ),
        (
            [
                {"at": (0.0, 0.0, 0.5), "radius": 0.1, "turn": "left", "axis": (0.0, 1.0, 0.0)},
                {"at": (0.5, 0.0, 0.5), "radius": 0.1, "turn": "left", "axis": (0.0, 0.0, 1.0)},
            ],
            "joints.rope.over[0].axis: expected the axis of over[1] before or after it, as both are "
            "in one plane, got one at 90 degrees to it",
        ),
        ([{"at": (1.0, 0.0, 0.0)}], "joints.rope.over: expected sheaves, eyelets and ends apart from each other"),
    ],
)
def test_what_is_wrong_is_named(over, sentence) -> None:
    builder = symgen.MechanismBuilder("wrong", space="spatial")
    builder.body("bob", type="point", mass=1.0, position=(1.0, 0.0, 0.0))
    first = (-1.0, 0.0, 0.4) if len(over) == 2 else (-1.0, 0.3, 0.0)
    builder.joint("rope", "rope", between=("ground", "bob"), at=(first, "centre"), over=over)
    with pytest.raises(InputError) as error:
        builder.build()
    assert sentence in str(error.value)
