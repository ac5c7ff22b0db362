"""What rows say that are ok: the words of single runs, and on devices no rows that steps go across without a word."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from support.emitted import mechanism_of

import symgen
from symgen.ensemble import jumps
from symgen.ensemble.lines import csv_of
from symgen.errors import InputError
from symgen.runtime.foreseen import foreseen

STEP = 1e-2
CONSTANT = {"method": "lagrange", "integrator": "rk4", "step": STEP, "until": 1.0}
ADAPTIVE = {"method": "lagrange", "integrator": "dopri5", "until": 0.1}


def pushed(force, **parameters):
    """Return a mass on a guide under a force."""
    body = {"mass": 1.0, "inertia": 0.1, "velocity": [1.0, 0.0]}
    guide = {"type": "translational", "between": ["ground", "b"], "at": [[0.0, 0.0], "centre"], "axis": [1.0, 0.0]}
    raw = {"mechanism": {"name": "pushed"}, "parameters": parameters, "bodies": {"b": body}, "joints": {"guide": guide}}
    raw["forces"] = {"push": {"type": "force", "body": "b", "force": [force, "0"]}}
    return symgen.load(mechanism_of(raw))


PUSH = "1 if t > at and t < at + long else 0"


def short_push():
    return pushed(PUSH, at=0.123, long=1.0)


@pytest.mark.parametrize("target", ["cpu", "lanes"])
def test_rows_whose_push_is_shorter_than_a_step_say_so(target):
    """The push of the file is long, so that nothing but the row tells; v = 1 + long where no step goes across."""
    long, model = np.array([0.3, 0.5 * STEP, 2.0 * STEP, 1e-4, 0.9 * STEP]), short_push()
    found = symgen.sweep(model, {"long": long}, target=target, quantities=("b.vx",), **CONSTANT)
    assert found.counts["ok"] == 5
    lost = np.abs(found["b.vx"][:, -1] - (1.0 + long)) > 0.9 * STEP
    assert not lost.any() and abs(found["b.vx"][3, -1] - 1.0) == 0.0  # all of the shortest one
    assert [bool(sentences) for sentences in found.warnings] == list(long < STEP)
    for row, x in zip(found.warnings, long, strict=True):
        assert row == model.simulate(parameters={"long": x}, **CONSTANT).warnings
    ((sentence, runs),) = found.told()
    assert runs == 3 and "formulas change at t = 0.123 and 0.128 s" in sentence
    assert found.to_json()["warnings"] == [{"warning": sentence, "runs": 3}]
    heading, lines = csv_of(found)
    assert [bool(line[heading.index("warnings")]) for line in lines] == list(long < STEP)
    words = found.to_xarray()["warnings"]
    assert [bool(x) for x in words.values] == list(long < STEP)


def test_values_of_the_file_say_nothing_of_rows_that_have_others():
    model = pushed(PUSH, at=0.123, long=0.1 * STEP)
    found = symgen.sweep(model, {"long": [0.1, 0.2]}, **CONSTANT)
    assert list(found.warnings) == [(), ()]
    assert not any("warning" in note for note in found.ensemble.notes)


def test_adaptive_rows_say_where_changes_cannot_be_told_apart():
    model = pushed("sign(sin(w*t))", w=10.0)
    found = symgen.sweep(model, {"w": [10.0, 1e8]}, **ADAPTIVE)
    expected = [model.simulate(parameters={"w": w}, **ADAPTIVE).warnings for w in (10.0, 1e8)]
    assert list(found.warnings) == expected and not expected[0] and "than can be told apart" in expected[1][0]


def test_rows_that_nobody_looked_at_say_so(monkeypatch):
    monkeypatch.setattr(jumps, "MOST_LOOKS", 2)
    found = symgen.sweep(short_push(), {"long": [0.1, 0.2, 0.3, 0.1]}, **CONSTANT)
    assert [len(sentences) for sentences in found.warnings] == [0, 0, 1, 0]
    assert "looked for in 2 runs" in found.warnings[2][0]


def test_rows_have_what_single_runs_say_of_singular_positions():
    chosen = {"until": 1.3, "step": 0.01}
    found = symgen.sweep("n-four-bar:1", {"coupler0.omega": [0.0]}, **chosen)
    assert found.warnings[0] == symgen.simulate("n-four-bar:1", start={"coupler0.omega": 0.0}, **chosen).warnings
    assert "passed near a singular position" in found.warnings[0][0]
    unstable = {"method": "baumgarte", "options": {"method.alpha": 1e3}, "step": 0.01, "until": 0.02}
    everywhere = symgen.sweep("pendulum", {"bob_mass": [1.0, -1.0]}, **unstable)
    assert "is unstable with" in everywhere.warnings[0][0] and everywhere.warnings[1] == ()


@pytest.mark.parametrize(
    "force",
    ["1 if t > 0.3 else 0", "max(0, t - 0.3)", "-sign(b.vx)", "-10*max(0, b.x - 0.2)", "1 if b.x > 0.2 else 0"],
)
def test_adaptive_rows_on_a_device_are_refused_where_steps_have_to_end(force, monkeypatch):
    monkeypatch.setattr("symgen.ensemble.device.check_target", lambda *_: None)
    with pytest.raises(InputError, match="no jumps, kinks and short pulses of formulas, at which adaptive steps end"):
        symgen.sweep(pushed(force, m=1.0), {"m": [1.0, 2.0]}, target="cuda", **{**ADAPTIVE, "until": 1.0})


def test_pieces_are_those_asked_for_whatever_other_threads_ask():
    """Threads of a sweep share what was found last; one may forget it before another has read it."""

    class Forgetful(dict):
        def __setitem__(self, key, value):
            pass

    known = foreseen(short_push().mechanism)
    other = replace(known, known=Forgetful())
    for values in ({"at": 0.2, "long": 0.1}, {"at": 0.5, "long": 0.1}):
        assert other.pieces(values, 1.0) == known.pieces(values, 1.0) != ()


def test_a_row_whose_input_jumps_too_often_is_a_row_that_failed():
    """The others are run: v = 1 + t under a square wave whose half period is longer than the run."""
    body = {"mass": 1.0, "inertia": 0.1, "velocity": [1.0, 0.0]}
    raw = {"mechanism": {"name": "driven"}, "parameters": {"w": 1.0}, "inputs": {"u": 0.0}, "bodies": {"b": body}}
    raw["forces"] = {"push": {"type": "force", "body": "b", "force": ["u", "0"]}}
    model, inputs = symgen.load(mechanism_of(raw)), {"u": "sign(sin(w*t + 0.1))"}
    found = symgen.sweep(model, {"w": [1.0, 1e9, 2.0]}, inputs=inputs, quantities=("b.vx",), **ADAPTIVE)
    assert list(found.status) == ["ok", "failed", "ok"]
    np.testing.assert_allclose(found["b.vx"][[0, 2], -1], 1.1, rtol=1e-12)
    with pytest.raises(InputError) as refused:
        model.simulate(parameters={"w": 1e9}, inputs=inputs, **ADAPTIVE)
    assert found.reason[1] == str(refused.value) and "jumps" in found.reason[1]


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_rows_that_closing_moves_far_say_so(coordinates):
    """A bar of 1 m is described at its pin, which the row has elsewhere: by how much is what varies."""
    bar = {"mass": 1.0, "inertia": 0.1, "position": [0.0, 0.0], "points": {"end": [0.0, 0.0], "tip": [1.0, 0.0]}}
    raw = {"mechanism": {"name": "bar"}, "parameters": {"off": 0.0}, "bodies": {"bar": bar}}
    raw["joints"] = {"pin": {"type": "revolute", "between": ["ground", "bar"], "at": [["off", 0.0], "end"]}}
    model, away = symgen.load(mechanism_of(raw)), [0.0, 1e-3, 0.5, -2.0]
    chosen = {"step": 1e-2, "until": 0.02, "coordinates": coordinates}
    found = symgen.sweep(model, {"off": away}, quantities=("bar.x",), **chosen)
    np.testing.assert_allclose(found["bar.x"][:, -1], away, atol=1e-12)
    assert [bool(row) for row in found.warnings] == [False, False, True, True]
    assert "bar.x from 0 to 0.5 m" in found.warnings[2][0]
    assert [model.simulate(parameters={"off": x}, **chosen).warnings for x in away] == list(found.warnings)


def test_what_is_held_far_away_is_no_warning():
    """What follows an angle that was asked for has to."""
    chosen, angles = {"until": 0.01, "step": 1e-3}, [0.01, 1.0, 2.0]
    held = symgen.sweep("four-bar", {"crank.theta": angles}, **chosen)
    starts = [symgen.simulate("four-bar", start={"crank.theta": x}, **chosen) for x in angles]
    assert list(held.warnings) == [run.warnings for run in starts]
    assert list(held.warnings) == [()] * 3 and (held["start_moved"] == 0.0).all()


def test_velocities_that_cannot_be_what_they_were_given_as_are_told():
    found = symgen.sweep("pendulum", {"bob.vx": [0.0, 0.3]}, until=0.01)
    assert found.counts["ok"] == 2
    assert [len(row) for row in found.warnings] == [0, 1] and "were projected" in found.warnings[1][0]


def test_outputs_that_a_device_does_not_integrate_do_not_count(monkeypatch):
    monkeypatch.setattr("symgen.ensemble.device.check_target", lambda *_: None)
    raw = {"mechanism": {"name": "free"}, "parameters": {"m": 1.0}, "outputs": {"way": "integral(abs(b.vx))"}}
    raw["bodies"] = {"b": {"mass": "m", "inertia": 0.1, "velocity": [1.0, 0.0]}}
    model = symgen.load(mechanism_of(raw))
    with pytest.raises(InputError, match="integral"):
        symgen.sweep(model, {"m": [1.0]}, quantities=("way",), target="cuda", **ADAPTIVE)
    monkeypatch.setattr("symgen.ensemble.plan.kernel_of", lambda recipe: recipe.spec)  # there is no device
    with pytest.raises(AttributeError, match="first"):
        symgen.sweep(model, {"m": [1.0]}, quantities=("b.x",), target="cuda", **ADAPTIVE)
