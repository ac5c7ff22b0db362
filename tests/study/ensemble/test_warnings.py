"""What rows say that are ok, and on devices no rows that steps go across without a word."""

from dataclasses import replace

import numpy as np
import pytest
from support.emitted import mechanism_of

import symgen
from symgen.base.errors import InputError
from symgen.run.breaks.foreseen_seams import foresee_changes
from symgen.study.ensemble.lines import table_lines
from symgen.study.stress.bench import Base
from symgen.study.stress.families import singular_passage

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


@pytest.mark.parametrize("target", ["cpu", "lanes"])
def test_what_is_said_of_steps_is_said_of_all_rows(target):
    """Steps that are too long for the gains of a method."""
    model, speeds = pushed("0"), [1.0, 2.0]
    unstable = {"method": "baumgarte", "options": {"method.alpha": 1e3}, "integrator": "rk4", "step": STEP}
    found = symgen.sweep(model, {"b.vx": speeds}, target=target, quantities=("b.vx",), until=1.0, **unstable)
    assert found.counts["ok"] == 2
    alone = model.simulate(until=1.0, **unstable).warnings
    assert list(found.warnings) == [alone, alone] and "is unstable with rk4" in alone[0]
    assert found.common_warnings() == [(alone[0], 2)]
    assert found.to_json()["warnings"] == [{"warning": alone[0], "runs": 2}]
    heading, lines = table_lines(found)
    assert [line[heading.index("warnings")] for line in lines] == [alone[0]] * 2
    assert list(found.to_xarray()["warnings"].values) == [alone[0]] * 2


def test_rows_meet_pushes_whose_times_depend_on_what_varies():
    """v = 1 + long, by constant steps as by adaptive ones; lanes cannot end their steps there."""
    long, model = np.array([0.3, 0.5 * STEP, 1e-4]), pushed(PUSH, at=0.123, long=1.0)
    for settings in (CONSTANT, {**ADAPTIVE, "until": 1.0}):
        found = symgen.sweep(model, {"long": long}, quantities=("b.vx",), **settings)
        assert found.counts["ok"] == 3 and list(found.warnings) == [()] * 3
        np.testing.assert_allclose(found["b.vx"][:, -1], 1.0 + long, rtol=1e-9)
    with pytest.raises(InputError, match="no formulas that jump at times known beforehand"):
        symgen.sweep(model, {"long": long}, target="lanes", quantities=("b.vx",), **CONSTANT)


def test_rows_have_what_single_runs_say_of_singular_positions():
    chosen = {"until": 1.3, "integrator": "rk4", "step": 0.01}
    found = symgen.sweep("n-four-bar:1", {"coupler0.omega": [0.0]}, **chosen)
    assert found.warnings[0] == symgen.simulate("n-four-bar:1", start={"coupler0.omega": 0.0}, **chosen).warnings
    assert "passed near a singular position" in found.warnings[0][0]
    unstable = {
        "method": "baumgarte",
        "options": {"method.alpha": 1e3},
        "integrator": "rk4",
        "step": 0.01,
        "until": 0.02,
    }
    everywhere = symgen.sweep("pendulum", {"bob_mass": [1.0, -1.0]}, **unstable)
    assert "is unstable with" in everywhere.warnings[0][0] and everywhere.warnings[1] == ()


@pytest.mark.fast("direct-correction-cpu", "velocity-projection-cpu")
@pytest.mark.parametrize("target", ["cpu", "lanes"])
@pytest.mark.parametrize("method", ["direct-correction", "velocity-projection"])
def test_rows_are_in_doubt_where_energy_jumps_as_single_runs_are(target, method):
    model = symgen.load(singular_passage(Base.of_mechanism("four-bar"), 1e-2).mechanism)
    chosen = {"method": method, "integrator": "rk4", "step": 1e-3, "until": 2.0}
    found = symgen.sweep(model, {"crank.omega": [-1.0, -1.2]}, target=target, **chosen)
    alone = model.simulate(start={"crank.omega": -1.0}, **chosen)
    assert list(found.status) == ["unverified"] * 2 and alone.status == "unverified"
    assert found.reason[0] == alone.reason and "energy jumped by 0.00" in alone.reason


@pytest.mark.parametrize(
    "force",
    ["1 if t > 0.3 else 0", "max(0, t - 0.3)", "-sign(b.vx)", "-10*max(0, b.x - 0.2)", "1 if b.x > 0.2 else 0"],
)
def test_adaptive_rows_on_a_device_are_refused_where_steps_have_to_end(force, monkeypatch):
    monkeypatch.setattr("symgen.study.ensemble.device_runs.check_target", lambda *_: None)
    with pytest.raises(InputError, match="no jumps and kinks of formulas, at which adaptive steps end"):
        symgen.sweep(pushed(force, m=1.0), {"m": [1.0, 2.0]}, target="cuda", **{**ADAPTIVE, "until": 1.0})


def test_pieces_are_those_asked_for_whatever_other_threads_ask():
    """Threads of a sweep share what was found last; one may forget it before another has read it."""

    class Forgetful(dict):
        def __setitem__(self, key, value):
            pass

    known = foresee_changes(pushed(PUSH, at=0.123, long=1.0).mechanism)
    other = replace(known, latest=Forgetful())
    for values in ({"at": 0.2, "long": 0.1}, {"at": 0.5, "long": 0.1}):
        assert other.seams(values, 1.0) == known.seams(values, 1.0) != ()


@pytest.mark.slow
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


def test_outputs_that_a_device_does_not_integrate_do_not_count(monkeypatch):
    monkeypatch.setattr("symgen.study.ensemble.device_runs.check_target", lambda *_: None)
    raw = {"mechanism": {"name": "free"}, "parameters": {"m": 1.0}, "outputs": {"way": "integral(abs(b.vx))"}}
    raw["bodies"] = {"b": {"mass": "m", "inertia": 0.1, "velocity": [1.0, 0.0]}}
    model = symgen.load(mechanism_of(raw))
    with pytest.raises(InputError, match="integral"):
        symgen.sweep(model, {"m": [1.0]}, quantities=("way",), target="cuda", **ADAPTIVE)
    monkeypatch.setattr(
        "symgen.study.ensemble.sweep_plan.kernel_of_recipe", lambda recipe: recipe.spec
    )  # there is no device
    with pytest.raises(AttributeError, match="first"):
        symgen.sweep(model, {"m": [1.0]}, quantities=("b.x",), target="cuda", **ADAPTIVE)


def test_what_changes_nothing_is_named():
    model = pushed("0 * idle", idle=1.0, mass_of_nothing=1.0)
    axes = {"idle": [1.0, 2.0, 3.0], "b.vx": [1.0, 2.0]}
    found = symgen.sweep(model, axes, quantities=("b.x", "b.vx"), **CONSTANT)
    sentence = "idle changes nothing that this sweep keeps"
    assert found.common_warnings() == [(sentence, 6)]
    assert found.to_json()["warnings"] == [{"warning": sentence, "runs": 6}]
    moving = symgen.sweep(model, {"b.vx": [1.0, 2.0]}, quantities=("b.x",), **CONSTANT)
    assert moving.common_warnings() == []
    together = symgen.sweep(
        model, runs={"idle": [1.0, 2.0], "mass_of_nothing": [1.0, 3.0]}, quantities=("b.x",), **CONSTANT
    )
    assert together.common_warnings() == [("idle and mass_of_nothing change nothing that this sweep keeps", 2)]
    beside = symgen.sweep(model, runs={"idle": [1.0, 2.0], "b.vx": [1.0, 2.0]}, quantities=("b.x",), **CONSTANT)
    assert beside.common_warnings() == []
    one = symgen.sweep(model, {"idle": [1.0]}, quantities=("b.x",), **CONSTANT)
    assert one.common_warnings() == []
