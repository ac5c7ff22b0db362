"""Derivatives of runs with friction of contacts in space, forward and adjoint, beside differences of runs."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from symgen import InputError
from tests.run.contacts.scenes import G, loaded
from tests.run.contacts.scenes_in_space import SKITTLE, SPUN, ball_of, body, contact, head
from tests.run.contacts.test_friction_in_space import FLOOR, in_bowl, tripod

SETTINGS: dict[str, Any] = {"integrator": "dop853", "verify": False}


def with_parameters(text: str, **values: float) -> str:
    """Return a file with parameters."""
    lines = "".join(f"{name} = {value!r}\n" for name, value in values.items())
    return text.replace("[bodies", f"[parameters]\n{lines}[bodies", 1)


def across_a_slope() -> str:
    """Return a ball that slips obliquely on a slope of 0.35 rad, and rolls."""
    angle, r = 0.35, 0.2
    text = head((G * math.sin(angle), 0.0, -G * math.cos(angle))) + ball_of(r, (0.0, 0.0, r), (-1.0, 1.5, 0.0), 1.3)
    return with_parameters(text + contact(f'body = "ball", sphere = {r}', FLOOR, friction='"mu"'), mu=0.2)


@pytest.mark.slow
@pytest.mark.by_turns(4)
@pytest.mark.parametrize("quarter", range(4))
def test_three_hundred_coefficients_across_a_slope(quarter: int, tmp_path: Path) -> None:
    """From the angle of friction, where the ball hardly stops, on; differences are those of six runs each."""
    model, h = loaded(across_a_slope(), tmp_path), 1e-4
    values = np.linspace(0.125, 0.4, 300)[quarter::4]
    own: dict[str, Any] = {"rtol": 1e-12, "atol": 1e-14, "until": 2.0, "integrator": "dop853"}
    ends = [model.sweep(vary={"mu": values + k * h}, **own).to_dataframe() for k in (-3, -2, -1, 1, 2, 3)]
    weights = np.array([-1.0, 9.0, -45.0, 45.0, -9.0, 1.0]) / (60.0 * h)
    names = ["ball.x", "ball.y"]
    wanted = sum(w * end[names].to_numpy() for w, end in zip(weights, ends, strict=True))
    tight: dict[str, Any] = {"rtol": 1e-11, "atol": 1e-13, "until": 2.0, "integrator": "dop853"}
    for number, (mu, slopes) in enumerate(zip(values.tolist(), wanted, strict=True)):
        run = model.simulate(sensitivities=["mu"], parameters={"mu": mu}, verify=False, **tight)
        found = np.asarray(run.sensitivities.table("q")).reshape(len(run.t), -1)[-1, :2]
        assert run.ok and run.q.names[:2] == tuple(names) and np.abs(found - slopes).max() < 2e-7, mu
        if number % 25 == 0:
            back = model.gradient("ball.y", by=["mu"], parameters={"mu": mu}, way="adjoint", **tight)
            assert back.result.ok and abs(back.by["mu"] - found[1]) < 1e-8


def leg(e: float, omega: Any = (0.0, 0.0, 0.0)) -> str:
    """Return a leg that falls on its foot."""
    inertia, turn = 2.0 * 0.8**2 / 12.0, Rotation.from_euler("y", 0.3)
    text = body(
        "leg", (0.0, 0.0, 0.0), (1.0, 0.6, -1.5), 2.0, (inertia, inertia, 0.002),
        turn=turn.as_rotvec(), omega=turn.inv().apply(omega),
    ).replace("position = [0.0, 0.0, 0.0]", 'position = [0.0, 0.0, "h"]')  # fmt: skip
    text += contact('body = "leg", at = [0.0, 0.0, -0.4], sphere = 0.05', FLOOR, '"e"', friction='"mu"')
    return with_parameters(head() + text, mu=0.3, h=0.5, e=e)


def bowl_with_spin() -> str:
    """Return a ball with spin that slips across a bowl, and rolls."""
    place = (0.9 * math.sin(0.6), 0.0, -0.9 * math.cos(0.6))
    return with_parameters(in_bowl(place, (0.0, 1.3, 0.0), 0.12, (0.0, 0.0, 8.0)), mu=0.12).replace(
        "friction = 0.12", 'friction = "mu"'
    )


def bounces() -> str:
    """Return the ball that is thrown on the floor with spin."""
    text = SKITTLE.replace("friction = 0.21", 'friction = "mu"').replace("restitution = 0.4", 'restitution = "e"')
    return with_parameters(text, mu=0.21, e=0.4)


def turning() -> str:
    """Return a ball with rolling resistance and torsion."""
    text = SPUN.replace("friction = 0.3", 'friction = "mu"').replace("rolling = 0.02", 'rolling = "b"')
    return with_parameters(text, mu=0.3, b=0.02)


SCENES = {
    "turned by an impact": (leg(0.2, (1.0, -2.0, 3.0)), "leg.y", 0.08, {"h": 0.5, "e": 0.2}),
    "nine impacts, rest, slip and stick": (leg(0.2, (1.0, -2.0, 3.0)), "leg.y", 0.25, {"mu": 0.3, "h": 0.5, "e": 0.2}),
    "slip out of rest": (leg(0.0), "leg.y", 0.25, {"mu": 0.3, "h": 0.5}),
    "spin in a bowl": (bowl_with_spin(), "ball.y", 2.0, {"mu": 0.12}),
    "a series of impacts": (bounces(), "ball.y", 1.0, {"mu": 0.21, "e": 0.4}),
    "rolling and torsion": (turning(), "ball.y", 2.0, {"mu": 0.3, "b": 0.02}),
}


@pytest.mark.slow
@pytest.mark.by_turns(3)
@pytest.mark.parametrize("scene", SCENES)
def test_scenes(scene: str, tmp_path: Path) -> None:
    text, name, until, values = SCENES[scene]
    model, own = loaded(text, tmp_path), {"until": until, "integrator": "dop853"}
    forward = model.simulate(rtol=1e-11, sensitivities=[*values], verify=False, **own)
    assert forward.ok
    place = forward.q.names.index(name)
    slopes = np.asarray(forward.sensitivities.table("q")).reshape(len(forward.t), -1, len(values))[-1, place]
    back = model.gradient(name, by=[*values], rtol=1e-11, way="adjoint", **own)
    for (parameter, value), slope in zip(values.items(), slopes.tolist(), strict=True):
        runs = [
            model.simulate(rtol=1e-12, atol=1e-14, parameters={parameter: value + h}, verify=False, **own)
            for h in (-4e-5, -2e-5, 2e-5, 4e-5)
        ]
        differences = float(np.array([1.0, -8.0, 8.0, -1.0]) @ [run[name][-1] for run in runs]) / 2.4e-4
        assert abs(slope - differences) < 2e-7 * max(1.0, abs(differences)), parameter
        assert abs(back.by[parameter] - slope) < 1e-8 * max(1.0, abs(slope)), parameter


@pytest.mark.slow
def test_feet_that_come_to_rest_one_by_one(tmp_path: Path) -> None:
    """The place at rest is right; that three feet share their forces then is said."""
    text = tripod((0.0, 0.0, -G), (0.9, 0.5, 0.0), (0.0, 0.0, 4.0)).replace("friction = 0.4", 'friction = "mu"')
    model = loaded(with_parameters(text, mu=0.4), tmp_path)
    run = model.simulate(sensitivities=["mu"], rtol=1e-11, atol=1e-13, until=0.6, **SETTINGS)
    assert run.status == "unverified" and "share forces at rest, whose derivatives are not followed" in run.reason
    ends = [model.simulate(parameters={"mu": x}, rtol=1e-12, until=0.6, **SETTINGS) for x in (0.4 + 1e-5, 0.4 - 1e-5)]
    for name in ("table.x", "table.y", "table.e3"):
        found = np.asarray(run.sensitivities.table("q")).reshape(len(run.t), -1)[-1, run.q.names.index(name)]
        assert abs(found - (ends[0][name][-1] - ends[1][name][-1]) / 2e-5) < 1e-7


def test_steps_that_cannot_be_shortened_are_refused(tmp_path: Path) -> None:
    model = loaded(across_a_slope(), tmp_path)
    expected = "dop853 or dopri5 beside friction of contacts in space"
    with pytest.raises(InputError, match=f"derivatives: integrator: expected {expected}, got 'rk4'"):
        model.simulate(until=0.1, sensitivities=["mu"], integrator="rk4", step=1e-3)
    run = model.start(integrator="dop853")
    run.step(0.01)
    with pytest.raises(InputError, match=f"expected {expected}, got steps from Python"):
        run.derivatives()
