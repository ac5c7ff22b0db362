"""The power of drivers is summed once: energy balances in all coordinates, whatever a driven body touches.

A driver of a joint of the tree has no row: its power follows from its rows of M and f, to which friction by a reaction
does not belong.
"""

import math
from dataclasses import replace

import numpy as np
import pytest

import symgen
from benchmarks.meeting import FEATURES, write_modal_files
from symgen.base.errors import InputError
from symgen.result.judge import judge
from symgen.result.points import Verification
from symgen.run.planning.prepare import prepare

COORDINATES = ("absolute", "joint")
RTOL = 1e-9
TIGHT = {"integrator": "dop853", "rtol": RTOL, "atol": 1e-11}
#: Energy errors over the tolerance and the energy in motion: ten times what smooth runs have at most.
MOST = 10.0
#: Drivers of the cart and of the pole; those of a file with a driver of its own are enough.
DRIVERS = {
    "rail": '[joints.drive]\ntype = "driver"\njoint = "rail"\nvalue = "0.1 + 0.1*sin(3*t)"\n',
    "pin": '[joints.drive]\ntype = "driver"\njoint = "pin"\nvalue = "0.4 - pi/2 + 0.6*sin(4*t)"\n',
}
#: Refusals of a driver: of a joint without a coordinate, of one with friction, in coordinates without a tree.
REFUSALS = ("a joint that has a coordinate", "no driver prescribes", "absolute ones for modal bodies")


def share_of_error(result: symgen.Result) -> float:
    """The energy error over what moves."""
    sizes = np.ptp(result.kinetic), np.ptp(result.potential), np.ptp(result.work), np.abs(result.kinetic).max()
    return result.energy_drift_max / max(sizes)


@pytest.mark.by_turns(5)
@pytest.mark.fast("efficiency of a gear")
@pytest.mark.parametrize("feature", FEATURES)
def test_energy_balances_beside_a_driver_in_every_cell(feature, tmp_path):
    """Of all features of `docs/meeting.md`, by the driver of the cart or the pole, in both coordinates."""
    text, balanced = FEATURES[feature], 0
    write_modal_files(text, tmp_path)
    drives = {"own": ""} if "euler_angles" in text or 'type = "driver"' in text else DRIVERS
    for name, drive in drives.items():
        (path := tmp_path / f"{name}.toml").write_text(f"{text}\n{drive}")
        for coordinates in COORDINATES:
            try:
                result = symgen.load(path).simulate(coordinates=coordinates, **TIGHT)
            except InputError as error:
                assert any(refusal in str(error) for refusal in REFUSALS), error
            else:
                balanced += 1
                assert share_of_error(result) < MOST * RTOL, (name, coordinates)
                assert not any("balance" in warning for warning in result.warnings)
    assert balanced


BELT = """
[mechanism]
name = "belt"
gravity = [0.0, -9.81]
[bodies.belt]
mass = {mass}
inertia = 1.0
[bodies.part]
mass = 1.0
inertia = 0.005
position = [0.0, {height}]
[joints.guide]
type = "translational"
between = ["ground", "belt"]
at = [[0.0, 0.0], "centre"]
axis = {axis}
[joints.motor]
type = "driver"
joint = "guide"
value = "{value}"
{more}
"""
_DISC = 'between = [{ body = "part", disc = 0.1 }, { line = "belt" }]'
_SLIDE = '[joints.slide]\ntype = "translational"\nbetween = ["belt", "part"]\nat = ["centre", "centre"]\naxis = [1, 0]'


def belt(mass: float = 100.0, height: float = 0.1, axis: str = "[1.0, 0.0]", value: str = "3*t", more: str = "") -> str:
    """A body that a driver moves, and a part that it touches."""
    return BELT.format(mass=mass, height=height, axis=axis, value=value, more=more)


#: What a driven body touches.
SCENES = {
    "disc slides, then rolls": belt(more=f"[contacts.floor]\n{_DISC}\nfriction = 0.3"),
    "disc on a belt that turns round": belt(value="0.5*sin(6*t)", more=f"[contacts.floor]\n{_DISC}\nfriction = 0.1"),
    "disc on a light belt": belt(mass=1.0, more=f"[contacts.floor]\n{_DISC}\nfriction = 0.3"),
    "friction by the reaction of a slide": belt(
        height=0.0, value="0.5*sin(6*t)", more=f"{_SLIDE}\nfriction = {{ coefficient = 0.3 }}"
    ),
    "dry friction of a slide": belt(height=0.0, value="0.5*sin(6*t)", more=f"{_SLIDE}\nfriction = {{ sliding = 3.0 }}"),
    "impacts on a plate that lifts": belt(
        height=0.3,
        axis="[0.0, 1.0]",
        value="0.05*sin(9*t)",
        more=f"[contacts.plate]\n{_DISC}\nfriction = 0.3\nrestitution = 0.5",
    ),
    "a part that is caught": belt(
        height=0.3,
        value="t**2",
        more='[joints.catch]\ntype = "rigid"\nbetween = ["belt", "part"]\nat = ["centre", "centre"]\n'
        'holds = "t > 0.2"\nholds_at = "present"',
    ),
    "a stop that strikes": belt(
        height=0.0, value="0.2*sin(9*t)", more=f"{_SLIDE}\nstop = {{ lower = -0.05, upper = 0.05, restitution = 0.3 }}"
    ),
}


@pytest.mark.slow_cases("impacts on a plate that lifts-joint", "impacts on a plate that lifts-absolute")
@pytest.mark.parametrize("coordinates", COORDINATES)
@pytest.mark.parametrize("scene", SCENES)
def test_energy_balances_where_a_driven_body_touches_another_one(scene, coordinates, tmp_path):
    (path := tmp_path / "belt.toml").write_text(SCENES[scene])
    result = symgen.load(path).simulate(coordinates=coordinates, until=0.8, **TIGHT)
    assert result.status == "ok" and share_of_error(result) < MOST * RTOL


@pytest.mark.parametrize("coordinates", COORDINATES)
@pytest.mark.parametrize("keys", [{}, {"integrator": "radau5"}, {"integrator": "dop853", "shape": "looped"}])
def test_a_belt_gives_its_disc_the_energy_that_it_has(keys, coordinates, tmp_path):
    """The disc slides with mu g and turns with 2 mu g / r up to 3 v = 3 m/s, where it rolls with 1.5 J.

    Friction takes as much as the disc has then: the belt gives mu m g times its own way, 3 J.
    """
    (path := tmp_path / "belt.toml").write_text(SCENES["disc slides, then rolls"])
    if coordinates == "joint":
        keys = {k: x for k, x in keys.items() if k != "shape"}
    result = symgen.load(path).simulate(coordinates=coordinates, until=0.5, **keys)
    rolls = 3.0 / (3.0 * 0.3 * 9.81)
    at = np.minimum(result.t, rolls)
    assert result.work == pytest.approx(1.5 * (0.3 * 9.81 * at) ** 2, abs=1e-7)
    assert result.status == "ok" and result.events[0].t == pytest.approx(rolls, abs=1e-9)


def test_a_balance_that_finer_steps_leave_open_is_told(tmp_path):
    """No run has such an error: numbers of one are put in place of the ones that it has."""
    (path := tmp_path / "belt.toml").write_text(SCENES["disc slides, then rolls"])
    run = prepare(symgen.load(path).mechanism, symgen.Settings(until=0.3, coordinates="joint"))
    outcome = run.integrate()
    assert judge(run, outcome).warnings == ()
    leaky = replace(outcome, energy_drift_max=0.006 * outcome.energy_scale)
    (warning,) = judge(run, leaky).warnings
    assert "leaves its balance" in warning and "0.006 of the energy in motion" in warning and "rtol = 1e-08" in warning
    seen = Verification(None, "agrees", 1e-9, 100, energy=leaky.energy_drift_max)
    (warning,) = judge(run, leaky, seen).warnings
    assert warning.endswith("finer steps leave it as it is")
    assert judge(run, leaky, replace(seen, energy=0.0)).warnings == ()
    assert math.isclose(leaky.energy_scale, outcome.energy_scale)
