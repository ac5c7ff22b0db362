"""Runs in which nothing is chosen: the integrator, the steps, and the second run that estimates the error."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq
from study.ensemble.single_runs import assert_rows
from support.emitted import mechanism_of

import symgen
from symgen.base.errors import InputError
from symgen.base.settings import Settings
from symgen.cli import main
from symgen.derive.methods import METHODS
from symgen.describe import catalogue
from symgen.result import judge
from symgen.run.layout.right_hand_side import rates_at_nodes
from symgen.run.planning.prepare import make_plan, prepare
from symgen.study.ensemble.sweep_plan import make_ensemble

EXPLICIT = [name for name in METHODS.names if {"ode", "one-step"} & set(METHODS.get(name).forms)]


def block(*force, run=None, **more):
    """A block of 1 kg on a straight guide along x, with forces along it."""
    return {
        "mechanism": {"name": "block", "gravity": [0.0, 0.0]},
        "run": run or {},
        "bodies": {"block": {"mass": 1.0, "inertia": 1.0}},
        "joints": {
            "guide": {"type": "translational", "between": ["ground", "block"], "at": [[0, 0], "centre"], "axis": [1, 0]}
        },
        "forces": {f"f{i}": {"type": "force", "body": "block", "force": [f, 0.0]} for i, f in enumerate(force)},
    } | more


def model(*force, run=None, **more):
    return symgen.Model(mechanism_of(block(*force, run=run, **more)))


def stop_speed(until, push, stiffness, damping, gap):
    """Speed at a time of 1 kg that a force pushes against a stiff stop, piece by piece in closed form."""
    t, v = math.sqrt(2.0 * gap / push), math.sqrt(2.0 * gap * push)
    decay, rest = damping / 2.0, push / stiffness
    omega = math.sqrt(stiffness - decay**2)
    while True:
        # from the stop's surface at speed v: u = rest + exp(-decay s) (a cos + b sin), u(0) = 0, u'(0) = v
        a, b = -rest, (v - decay * rest) / omega

        def depth(s, a=a, b=b):
            return rest + math.exp(-decay * s) * (a * math.cos(omega * s) + b * math.sin(omega * s))

        contact = brentq(depth, 1.0 / omega, 4.0 / omega, xtol=1e-16)
        speed = math.exp(-decay * contact) * (
            (b * omega - decay * a) * math.cos(omega * contact) - (a * omega + decay * b) * math.sin(omega * contact)
        )
        t, v = t + contact, speed  # backwards, and under the push until it is at the stop again
        if t + 2.0 * -v / push > until:
            return v + push * (until - t)
        t, v = t - 2.0 * v / push, -v


def test_a_stiff_stop_is_met_by_default():
    """Constant steps of a millisecond end at -0.136 m/s."""
    found = model("5.0", "-1e6*(block.x - 0.5) - 200*block.vx if block.x > 0.5 else 0").simulate(until=2.0)
    right = stop_speed(2.0, 5.0, 1e6, 200.0, 0.5)
    assert found.ok and found.integrator == "dop853" and right == pytest.approx(-0.2838, abs=1e-4)
    assert found.v["block.vx"][-1] == pytest.approx(right, abs=1e-6)


# -- the integrator ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("method", EXPLICIT)
def test_picard_is_the_default_of_laws_that_have_vectors(method):
    four_bar = symgen.load("four-bar")
    own = METHODS.get(method).default_integrator
    assert own == ("picard" if rates_at_nodes(four_bar.compile(method))[1] else "dop853")
    assert make_plan(four_bar.mechanism, Settings(method=method)).integrator.name == own


@pytest.mark.parametrize("method", sorted({*METHODS.names} - {*EXPLICIT}))
def test_methods_of_another_form_keep_their_integrator(method):
    plan = make_plan(symgen.load("pendulum").mechanism, Settings(method=method))
    assert plan.integrator.name == METHODS.get(method).default_integrator


@pytest.mark.slow
def test_comparisons_and_loops_are_for_dop853():
    assert model("-block.x").simulate(until=0.1).integrator == "picard"
    assert model("-block.x if block.x > 0 else 0").simulate(until=0.1).integrator == "dop853"
    assert model("1.0 if t > 0.05 else 0").simulate(until=0.1).integrator == "picard"
    assert symgen.simulate("pendulum", until=0.01, shape="looped").integrator == "dop853"


def test_a_file_names_integrator_step_and_second_run():
    constant = model("-block.x", run={"integrator": "rk4", "step": 0.01, "until": 0.1})
    found = constant.simulate()
    assert (found.integrator, found.step, found.steps, found.rtol) == ("rk4", 0.01, 10, None)
    assert constant.simulate(integrator="picard").rtol == 1e-8
    assert make_plan(constant.mechanism, Settings(integrator="dop853")).spec.step == 0.01
    assert model("-block.x", run={"integrator": "auto", "until": 0.1}).simulate().notes
    first = model("-block.x", run={"step": 0.01, "until": 0.1})
    plan = make_plan(first.mechanism, Settings())
    assert (plan.integrator.name, plan.spec.step) == ("picard", 0.01)
    assert first.simulate().step is None
    assert make_plan(model("-block.x").mechanism, Settings()).spec.step is None
    with pytest.raises(InputError, match="did you mean 'rk4'"):
        model("-block.x", run={"integrator": "rk5"}).simulate()


# -- the second run ----------------------------------------------------------------------------------------------------


def test_the_second_run_follows_the_operations_of_the_first(monkeypatch):
    pendulum = symgen.load("pendulum")
    monkeypatch.setattr(judge, "MOST_OPERATIONS", math.inf)
    found = pendulum.simulate(until=1.0)
    assert found.ok and 0.0 < found.error_estimate < 1e-6 and not found.notes
    assert "error about" in repr(found)
    assert pendulum.simulate(until=1.0, rtol=1e-8).error_estimate is None, "who sets a tolerance is not checked"
    assert pendulum.simulate(until=1.0, integrator="rk4").error_estimate is None
    assert pendulum.simulate(until=1.0, verify=False).error_estimate is None
    assert pendulum.simulate(until=1.0, integrator="rk4", verify=True).error_estimate > 0.0
    monkeypatch.setattr(judge, "MOST_OPERATIONS", 0)
    slow = pendulum.simulate(until=1.0)
    assert (slow.status, slow.reason) == ("unverified", "no part of it was checked")
    assert slow.error_estimate is None and f"global error not estimated as {slow.unchecked}: `verify`" in repr(slow)
    assert slow.unchecked.startswith("it took ") and slow.unchecked.endswith(" operations, more than 0")
    assert slow.to_json()["unchecked"] == slow.unchecked and found.to_json()["unchecked"] is None
    assert pendulum.simulate(until=1.0, rtol=1e-8).unchecked == "its tolerances were set"
    assert pendulum.simulate(until=1.0, integrator="rk4").unchecked == "its steps are constant"
    assert pendulum.simulate(until=1.0, verify=False).unchecked == "verify is off"
    run = pendulum.start(integrator="rk4", step=1e-3)
    run.run(0.01)
    assert run.result().unchecked == "its steps are constant"


def test_the_clock_decides_on_no_second_run(monkeypatch):
    """The operations of a run are its evaluations times those of its longest function, and 100 for each call."""
    from symgen.run.single import run as loops

    pendulum, timed = symgen.load("pendulum"), loops._in_thread
    alone = pendulum.simulate(until=1.0, verify=False)
    longest = max(alone.outcome.compiled.law.operations.values())
    count = alone.evaluations * (100 + longest)
    for seconds in (1e-9, 1e9):  # of machines of any speed
        monkeypatch.setattr(loops, "_in_thread", lambda *a, s=seconds: (timed(*a)[0], s, s, False))
        for limit, estimated in ((count, True), (count - 1, False)):
            monkeypatch.setattr(judge, "MOST_OPERATIONS", limit)
            assert (pendulum.simulate(until=1.0).error_estimate is not None) is estimated


def test_the_file_and_the_run_switch_it(monkeypatch, capsys):
    monkeypatch.setattr(judge, "MOST_OPERATIONS", math.inf)
    off = model("-block.x", run={"verify": False, "until": 0.1})
    assert off.simulate().error_estimate is None and off.simulate(verify=True).error_estimate is not None
    on = model("-block.x", run={"verify": True, "until": 0.1})
    monkeypatch.setattr(judge, "MOST_OPERATIONS", 0)
    assert on.simulate().error_estimate is not None and on.simulate(verify=False).error_estimate is None
    assert main(["run", "pendulum", "--until", "0.1", "--no-verify", "--json"]) == 0
    assert '"error_estimate": null' in capsys.readouterr().out
    assert main(["run", "pendulum", "--until", "0.1", "--verify", "--json"]) == 0
    assert '"error_estimate": null' not in capsys.readouterr().out


@pytest.mark.slow_cases("joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_run_that_goes_on_is_checked_from_where_it_begins(monkeypatch, coordinates):
    """A motor has done work until then."""
    monkeypatch.setattr(judge, "MOST_OPERATIONS", math.inf)
    wiper, settings = symgen.load("wiper"), {"coordinates": coordinates}
    first = wiper.simulate(until=0.5, **settings)
    second = wiper.simulate(until=1.0, start=first, **settings)
    assert first.ok and abs(first.work[-1]) > 0.1 and second.t[0] == 0.5
    assert (second.status, second.reason) == ("ok", None) and 0.0 < second.error_estimate < 1e-6


@pytest.mark.slow
def test_a_chaotic_motion_beyond_its_horizon_is_unverified(monkeypatch):
    monkeypatch.setattr(judge, "MOST_OPERATIONS", math.inf)
    found = symgen.simulate("chain:2", until=60.0)
    assert found.status == "unverified" and "a run with rtol = 1e-09 differs by" in found.reason
    monkeypatch.undo()
    long = symgen.simulate("chain:2", until=8000.0, times=[0.0, 8000.0])  # of which a first part is checked
    assert long.status == "unverified" and "a run with rtol = 1e-09 differs by" in long.reason
    upto = float(long.reason.rpartition("t = ")[2].split(" ")[0])
    assert 1.0 < upto < 10.0, "the digits of both motions part within some seconds"
    assert symgen.simulate("chain:2", until=8000.0, times=[0.0, 8000.0], rtol=1e-8).ok


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_long_run_is_checked_over_a_first_part(monkeypatch, coordinates):
    """The part follows from the operations of the run; what it shows holds for the part alone."""
    pendulum, count = symgen.load("pendulum"), judge.count_operations_of_run
    run = prepare(pendulum.mechanism, Settings(until=10.0, coordinates=coordinates))
    whole = pendulum.simulate(until=10.0, coordinates=coordinates)
    assert whole.ok and whole.unchecked is None
    for times in (None, [0.0, 10.0]):
        monkeypatch.setattr(judge, "MOST_OPERATIONS", 0.6 * count(run, whole.outcome))
        part = pendulum.simulate(until=10.0, times=times, coordinates=coordinates)
        assert part.status == "unverified" and part.error_estimate is None
        assert " s alone: there a run with rtol = 1e-09 agrees within " in part.reason
        upto = float(part.reason.removeprefix("checked up to t = ").partition(" ")[0])
        assert upto == pytest.approx(4.0, abs=0.6), "what a run without outputs takes is less"
        assert part.unchecked.startswith("it took ") and part["bob.x"][-1] == whole["bob.x"][-1]
        for chosen in ({"rtol": 1e-8}, {"verify": False}, {"integrator": "rk4"}):
            assert pendulum.simulate(until=10.0, times=times, coordinates=coordinates, **chosen).ok


@pytest.mark.slow
def test_a_stiff_run_proposes_an_implicit_integrator():
    """A damper of 4000 1/s, compared with the state or not: by the iteration, and by the eigenvalues at the start."""
    for force in ("1.0 - 4000*block.vx", "1.0 - 4000*block.vx if block.x > -1 else 0"):
        found = model(force).simulate(until=2.5)
        assert found.ok and found.steps > 1000
        assert found.proposals == ("--integrator radau5",) and "radau5" in found.notes[-1]
        assert "; stiff: `integrator` radau5 takes longer steps)" in repr(found)
        taken = model(force).simulate(until=2.5, integrator="radau5")
        assert taken.ok and taken.steps < 0.2 * found.steps and not taken.proposals
    assert not model("1.0 - 4000*block.vx").simulate(until=2.5, method="udwadia-kalaba").proposals  # no implicit form
    assert (
        not model("-4e4*block.x", bodies={"block": {"mass": 1.0, "velocity": [1.0, 0.0], "inertia": 1.0}})
        .simulate(until=30.0)
        .proposals
    ), "a vibration that is followed is not stiff"


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("name", catalogue.names())
def test_every_entry_of_the_catalogue_is_ok_by_default(name):
    found = symgen.simulate(name, until=min(2.0, symgen.load(name).mechanism.defaults.until))
    assert found.rtol == 1e-8
    assert found.ok, found.reason


# -- elsewhere ---------------------------------------------------------------------------------------------------------


def test_a_row_is_the_default_run():
    four_bar, settings = symgen.load("four-bar"), {"until": 0.5, "times": (0.25, 0.5)}
    found = symgen.sweep(four_bar, {"crank_mass": [1.0, 2.5]}, quantities=("q", "v"), **settings)
    assert found.ensemble.recipe.integrator == "picard"
    assert_rows(found, four_bar, **settings, verify=False)


@pytest.mark.parametrize("named", [None, "euler"])
def test_lanes_take_constant_steps(named):
    """Rows in lanes against rows one after another are in `tests/run/rows/test_lanes.py`."""
    run = {"integrator": named} if named else None
    many = make_ensemble(model("-block.x", run=run), Settings(until=0.1), {"block.x": [0.1, 0.2]}, {}, None, "lanes")
    assert many.recipe.integrator == (named or "rk4") and not many.recipe.spec.adaptive


def test_a_result_tells_how_its_absolute_tolerance_counts():
    default, given = (
        symgen.simulate("four-bar", integrator="dop853", until=1.0, **more) for more in ({}, {"atol": 1e-10})
    )
    assert default.atol == given.atol and not np.array_equal(default.q.values, given.q.values)
    assert default.to_json()["relative_atol"] is True and given.to_json()["relative_atol"] is False
    assert "atol 1e-10 of length and speed" in default._repr_html_() and "of length" not in given._repr_html_()
    assert symgen.simulate("four-bar", until=0.2, integrator="rk4").to_json()["relative_atol"] is None
