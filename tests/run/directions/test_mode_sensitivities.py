"""Derivatives through sticks, slips, impacts and rest, forward and by the adjoint, against closed forms."""

import json
import random
from pathlib import Path

import pytest

import symgen
from tests.run.directions.lengths import model
from tests.run.directions.mode_models import MACHINES, chain, loop, richardson

TIGHT = {"rtol": 1e-12, "atol": 1e-12, "integrator": "dop853"}
CLOSED = json.loads((Path(__file__).parents[2] / "data" / "derivatives_through_modes.json").read_text())

PULLED = MACHINES / "belt-oscillator.toml"
PUSH = '\n[inputs]\npush = { default = 0.0, unit = "N" }\n'
BALL = """
[mechanism]
name = "ball"
gravity = [0.0, "-g"]
[parameters]
h = { value = 1.0, unit = "m" }
e = 0.7
g = { value = 9.81, unit = "m/s^2" }
[bodies.ball]
mass = 1.0
inertia = 0.1
position = [0.0, "h"]
[stops.floor]
gap = "ball.y"
restitution = "e"
"""
ROTOR = """
[mechanism]
name = "rotor"
gravity = [0.0, 0.0]
[parameters]
J = { value = 0.2, unit = "kg m^2" }
w0 = { value = 5.0, unit = "rad/s" }
c = { value = 0.05, unit = "N m s" }
T = { value = 0.3, unit = "N m" }
[bodies.rotor]
mass = 1.0
inertia = "J"
angular_velocity = "w0"
[joints.pin]
type = "revolute"
between = ["ground", "rotor"]
at = [[0.0, 0.0], "centre"]
friction = { sliding = "T", viscous = "c" }
"""
QUANTITIES = {"belt": "block.x", "ball": "ball.y", "rotor": "rotor.theta"}
NAMES = {
    "belt": {"m": "mass", "k": "stiffness", "v": "speed", "Fs": "static", "Fd": "sliding"},
    "ball": {name: name for name in ("h", "e", "g")},
    "rotor": {name: name for name in ("J", "w0", "c", "T")},
}


@pytest.fixture(scope="module")
def models(tmp_path_factory):
    folder = tmp_path_factory.mktemp("modes")
    texts = {"ball": BALL, "rotor": ROTOR}
    return {"belt": symgen.load("belt-oscillator"), **{name: model(folder, text) for name, text in texts.items()}}


@pytest.mark.by_turns(8)
@pytest.mark.slow
@pytest.mark.parametrize(("name", "row"), [(name, row) for name in QUANTITIES for row in range(len(CLOSED[name]))])
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("way", ["forward", "adjoint"])
def test_closed_forms(models, way, coordinates, name, row):
    values, names = CLOSED[name][row], NAMES[name]
    found = models[name].gradient(
        QUANTITIES[name], by=tuple(names.values()), way=way, until=values["t"], coordinates=coordinates, **TIGHT
    )
    assert found.value == pytest.approx(values["value"], rel=1e-11)
    assert found.by == pytest.approx({own: values[f"d_{short}"] for short, own in names.items()}, rel=1e-9)
    assert found.result.ok


def status_of(found):
    return found.result.status, found.result.reason or ""


@pytest.mark.slow
@pytest.mark.parametrize("way", ["forward", "adjoint"])
def test_what_is_together_for_these_numbers_only_is_in_doubt(tmp_path, models, way):
    text, settings = PULLED.read_text(), {"way": way, "until": 2.5, **TIGHT}
    pulled = model(tmp_path, text.replace("-stiffness*block.x", "push - stiffness*block.x") + PUSH)
    # static friction of 6 N holds the block up to 0.9 s, when the force of 3 N ends
    for end, status in ((0.9, "unverified"), (0.8, "ok")):
        push = f"3.0 if t > 0.25 and t < {end} else 0.0"
        found = pulled.gradient("block.x", by=("stiffness", "static"), inputs={"push": push}, **settings)
        assert found.result.status == status
        if status != "ok":
            expected = "the event 'contact.slip' and a jump at t = 0.9 s are together for these numbers only"
            assert found.result.reason == expected
    body, stop = BALL[BALL.index("[bodies.ball]") :].split("[stops.floor]")
    other = (body + "[stops.other_floor]" + stop).replace("ball", "other").replace('"h"', '"2 - h"')
    two = model(tmp_path, BALL + other)
    status, reason = status_of(two.gradient("ball.y", by=("h",), **settings | {"until": 1.0}))
    assert status == "unverified"
    assert reason.startswith("the events 'floor.hit' and 'other_floor.hit' at t = 0.451524 s are together for these")
    assert two.gradient("ball.y", by=("g",), **settings | {"until": 1.0}).result.ok


@pytest.mark.slow_cases("adjoint")
@pytest.mark.parametrize("way", ["forward", "adjoint"])
def test_what_rests_at_the_start_has_one_side(models, way):
    rests = "rests at the start for these numbers only: derivatives on both sides differ"
    still = models["rotor"].gradient("rotor.theta", by=("w0", "T"), parameters={"w0": 0.0}, way=way, until=1.0, **TIGHT)
    assert status_of(still) == ("unverified", f"pin {rests}")
    closed = models["ball"].gradient("ball.y", by=("h", "g"), parameters={"h": 0.0}, way=way, until=1.0, **TIGHT)
    assert status_of(closed) == ("unverified", f"floor {rests}")
    assert (
        models["rotor"]
        .gradient("rotor.theta", by=("T",), parameters={"w0": 0.0}, way=way, until=1.0, **TIGHT)
        .result.ok
    )


def values_of(own, names):
    """Return the values of parameters of a file."""
    values = {p.name: p.value for p in own.mechanism.parameters}
    return {name: float(getattr(values[name], "value", values[name])) for name in names}


def compare_with_differences(own, quantity, names, until, changes=None, **settings):
    """Compare both ways with differences of runs that have the same events in the same order.

    `changes` are changes of all numbers at once, relative to their values; without any, each number changes alone.
    """
    settings = {"until": until, **TIGHT, **settings}
    run = own.simulate(sensitivities=names, times=[until], **settings)
    assert run.status == "ok"
    events, found = [event.name for event in run.events], run.gradient(quantity).row()
    back = own.gradient(quantity, by=names, way="adjoint", **settings)
    assert back.result.ok
    assert back.by == pytest.approx(found, rel=1e-8, abs=1e-8)
    values = values_of(own, names)
    for change in [changes] if changes else [{name: 1.0} for name in names]:
        widths = {name: part * values[name] for name, part in change.items()}

        def end(x, widths=widths):
            parameters = {name: values[name] + x * width for name, width in widths.items()}
            other = own.simulate(parameters=parameters, times=[until], verify=False, **settings)
            assert [event.name for event in other.events] == events
            return float(other[quantity][-1])

        size = sum(abs(width) for width in widths.values())
        slope, error = (each / size for each in richardson(end, 0.0, 2.5e-4))
        assert error < 1e-6 * max(1.0, abs(slope))
        expected = sum(found[name] * width for name, width in widths.items()) / size
        assert expected == pytest.approx(slope, rel=1e-6, abs=1e-6)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_the_dry_four_bar(coordinates):
    dry = symgen.load("dry-four-bar")
    compare_with_differences(dry, "crank.theta", ("torque", "crank_mass", "rocker_mass"), 10.0, coordinates=coordinates)


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("make", "seed", "until"),
    [*((chain, seed, 1.0) for seed in (1, 7)), *((loop, seed, 2.0) for seed in (0, 6))],
)
def test_random_chains_and_loops(tmp_path, make, seed, until):
    text, names = make(seed)
    used = tuple(name for name in names if text.count(name) > 1)
    compare_with_differences(model(tmp_path, text), "b0.theta" if make is chain else "crank.theta", used, until)


@pytest.mark.by_turns(16)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("make", "seed", "until"),
    [
        *((chain, seed, 1.0) for seed in (2, 5, 6, *range(9, 16))),
        *((loop, seed, 2.0) for seed in (1, 4, 5, *range(8, 15))),
    ],
)
def test_twenty_other_chains_and_loops_along_a_random_change_of_all_numbers(tmp_path, make, seed, until):
    """Chain 0 begins behind a stop, so that these and the ones above are the first thirty."""
    text, names = make(seed)
    used, dice = tuple(name for name in names if text.count(name) > 1), random.Random(seed)
    changes = {name: dice.choice([-1.0, 1.0]) * dice.uniform(0.3, 1.0) for name in used}
    own, quantity = model(tmp_path, text), "b0.theta" if make is chain else "crank.theta"
    compare_with_differences(own, quantity, used, until, changes)


@pytest.mark.slow
def test_energy_that_an_impact_takes_and_a_force_that_jumps():
    press = symgen.load("toggle-press")
    compare_with_differences(press, "lost", ("ram_mass", "push", "rubbing"), 0.35)
    compare_with_differences(press, "guide.lower.force", ("ram_mass", "push"), 0.2)


@pytest.mark.slow
def test_forces_that_rows_at_rest_share_are_named():
    run = symgen.load("dry-four-bar").simulate(
        until=0.1, parameters={"torque": 10.0}, sensitivities=("torque",), integrator="dop853"
    )
    assert any("rest together: derivatives of their forces there" in text for text in run.warnings)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_sweeps_have_derivatives_through_modes(models):
    rows = models["rotor"].sweep({"T": [0.2, 0.3]}, quantities=["rotor.theta"], until=6.0, integrator="dop853")
    slopes = rows.sensitivities(("J", "T"))["rotor.theta"][:, -1]
    for torque, slope in zip((0.2, 0.3), slopes, strict=True):
        angle = {"until": 6.0, "parameters": {"T": torque}, "way": "adjoint", "integrator": "dop853"}
        found = models["rotor"].gradient("rotor.theta", by=("J", "T"), **angle)
        assert dict(zip(("J", "T"), slope, strict=True)) == pytest.approx(found.by, rel=1e-6)
