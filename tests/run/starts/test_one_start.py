"""The one start: every bit is the same interpreted, compiled and in a sweep, and both shapes start alike."""

import os
import subprocess
import sys
import tomllib

import numpy as np
import pytest
from support.emitted import mechanism_of
from support.models import circles, parallelogram
from support.random_closed import make

import symgen
from symgen.api import load
from symgen.base.errors import AssemblyError, InputError
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.start_records import Instant, StartConditions
from symgen.run.starts import decisions
from symgen.run.starts.assembler import ALONE, Assembly, as_one_row
from symgen.run.starts.held import Held
from symgen.study.ensemble.chunks import make_rows

#: Random mechanisms: seed, space, doubled joint, contradicting velocities.
CASES = [
    (3, "planar", False, True),
    (4, "planar", True, True),
    (2, "spatial", False, True),
    (1, "spatial", True, False),
]
SHAKE = np.array([0.0, 0.02, -0.1, 0.3])
TURNING = np.array([1.0, 0.0, -2.0, 0.5])


def rows_of(model, compiled, held=()):
    """Described starts, and what is asked of them."""
    varied = {"shake": SHAKE, "turning": TURNING}
    rows = make_rows(model.mechanism, model.parameters(), varied, (), {})
    values = [model.parameters({"shake": a, "turning": b}) for a, b in zip(SHAKE, TURNING, strict=True)]
    p = np.stack([compiled.parameter_array(each, {}) for each in values])
    targets = rows.q[:, list(held)] + np.array([0.0, 0.07, -0.23, 0.11])[:, None] if held else np.zeros((len(p), 0))
    return rows, p, targets


def one_by_one(compiled, rows, p, targets, held):
    """Each start alone, as a single run has it."""
    found = []
    for i in range(len(p)):
        assembly = Assembly(compiled, Held(dict.fromkeys(held, 0.0)), ask_light=True)
        y, summary = np.zeros(compiled.info.ny), np.zeros((1, e.N_SUMMARY))
        y[: compiled.info.nq] = rows.q[i]
        state = as_one_row(y, p[i].copy(), compiled.scratch())
        assembly.close_all(state, StartConditions(rows.v[i : i + 1].copy(), targets[i : i + 1].copy(), summary), *ALONE)
        found.append((*state, summary))
    return tuple(np.concatenate(part) for part in zip(*found, strict=True))


def all_at_once(compiled, rows, p, targets, held):
    """The same starts as rows of a sweep."""
    count, ny = len(p), compiled.info.ny
    y = np.zeros((count, ny))
    y[:, : compiled.info.nq] = rows.q
    now = Instant(y, p.copy(), np.full((count, len(compiled.scratch())), np.nan))
    asked = StartConditions(rows.v, targets, np.zeros((count, e.N_SUMMARY)))
    assembly = Assembly(compiled, Held(dict.fromkeys(held, 0.0)), ask_light=True)
    control = np.zeros(e.N_CONTROL, dtype=np.int64)
    assert assembly.close_all(now, asked, np.arange(count), control) == count
    return *now, asked.summary


@pytest.mark.by_turns(3)
@pytest.mark.fast("planar-3-True", "planar-4-False")
@pytest.mark.parametrize("holds", [False, True])
@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case[1]}-{case[0]}")
def test_every_bit_is_that_of_a_sweep(monkeypatch, case, holds):
    """Of the state, of parameters and scratch, and of all that is said of the start; compiled or interpreted."""
    model = load(mechanism_of(make(*case)))
    compiled = model.compile("lagrange")
    held = (2,) if holds else ()
    rows, p, targets = rows_of(model, compiled, held)
    sweep = all_at_once(compiled, rows, p, targets, held)
    for limit in (decisions.LARGEST_INTERPRETED, 0):
        monkeypatch.setattr(decisions, "LARGEST_INTERPRETED", limit)
        for found, expected in zip(one_by_one(compiled, rows, p, targets, held), sweep, strict=True):
            np.testing.assert_array_equal(found, expected)
    summary = dict(zip(e.SUMMARY, sweep[3].T, strict=True))
    assert np.all(summary["start"][:2] == e.ASSEMBLED), "or nothing is tested"
    assert np.all((summary["redundant_rows"][:2] > 0) == case[2])
    assert summary["start_velocities"][0] == 1.0 or not case[3]
    if holds:
        np.testing.assert_array_equal(sweep[0][:2, 2], targets[:2, 0])


@pytest.mark.by_turns(4)
@pytest.mark.slow
def test_both_shapes_have_the_same_start():
    """On random mechanisms, in a process in which nothing is compiled: straight, looped, and by sparse algebra."""
    script = "from support.both_starts import main; main()"
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1", "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, env=environment)
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert len(lines) >= 28 and all(line.endswith(": same") for line in lines), done.stdout


# -- what is held ------------------------------------------------------------------------------------------------------


def coordinates_of(compiled):
    return [q.name for q in compiled.info.coordinates], [v.name for v in compiled.info.velocities]


def test_a_held_angle_takes_the_others_along():
    """The crank of the four-bar at another angle: coupler and rocker where two circles meet, on the described side."""
    model = load("four-bar")
    compiled = model.compile("lagrange")
    names, _ = coordinates_of(compiled)
    for angle in (-2.9, 0.4, 1.9):
        start = model.assemble(compiled, held=Held({names.index("crank.theta"): angle}))
        q = dict(zip(names, start.y, strict=False))
        assert q["crank.theta"] == angle
        b, d = 2.0 * np.array([np.cos(angle), np.sin(angle)]), np.array([10.0, 0.0])
        c = circles(b, d, 8.0, 5.0, 1.0)
        np.testing.assert_allclose([q["rocker.x"], q["rocker.y"]], (c + d) / 2, atol=1e-12)
        assert start.notes[0].startswith(f"the start holds crank.theta = {angle:g} rad; ") and len(start.notes) == 1
        assert {"crank.theta", "rocker.x"} <= {change.name for change in start.changes}


def test_a_held_position_and_what_it_cannot_reach():
    model = load("slider-crank")
    compiled = model.compile("lagrange")
    names, _ = coordinates_of(compiled)
    start = model.assemble(compiled, held=Held({names.index("slider.x"): 0.5}))
    q = dict(zip(names, start.y, strict=False))
    # r^2 + x^2 - 2 r x cos(phi) = l^2 between crank and line of the slider
    assert np.cos(q["crank.theta"]) == pytest.approx((0.15**2 + 0.5**2 - 0.45**2) / (2 * 0.15 * 0.5), abs=1e-12)
    with pytest.raises(AssemblyError, match=r"with slider.x = 0.7 m held"):
        model.assemble(compiled, held=Held({names.index("slider.x"): 0.7}))  # crank and rod reach 0.6 m


def test_a_held_velocity_is_not_projected():
    description = make(3, "planar", held_velocity=True)
    model = load(mechanism_of(description))
    compiled = model.compile("lagrange")
    _, names = coordinates_of(compiled)
    index = names.index("b0.omega")
    free = model.assemble(compiled)
    assert "projected in the metric of the mass matrix" in free.notes[-1]
    start = model.assemble(compiled, held=Held(velocities={index: 0.7}))
    assert start.y[compiled.info.nq + index] == pytest.approx(0.7, abs=1e-14)
    changed = {change.name for change in start.changes}
    assert "b0.omega" not in changed and changed & {"b1.omega", "b2.omega"}


# -- what is said ------------------------------------------------------------------------------------------------------


def test_what_was_changed_is_data():
    description = make(3, "planar", held_velocity=True)
    model = load(mechanism_of(description))
    compiled = model.compile("lagrange")
    start = model.assemble(compiled)
    q, v = model.initial_state(model.parameters())
    quantities = (*compiled.info.coordinates, *compiled.info.velocities)
    before = dict(zip((x.name for x in quantities), [*q, *v], strict=True))
    after = dict(zip((x.name for x in quantities), start.y, strict=False))
    assert {change.name for change in start.changes} == {
        name for name in before if before[name] is not None and abs(after[name] - before[name]) > 1e-8
    }
    for change in start.changes:
        assert (change.before, change.after) == (before[change.name], after[change.name])
        assert change.unit == next(x.unit for x in quantities if x.name == change.name)


@pytest.mark.slow_cases("looped")
@pytest.mark.parametrize("shape", ["straight", "looped"])
def test_a_massless_body_that_nothing_holds_is_refused(shape):
    bead = {"type": "point", "mass": 0.0, "position": [0.3, 0.4]}
    held = {"type": "distance", "between": ["ground", "bead"], "at": [[0.0, 0.0], "centre"], "length": 0.5}
    other = {**held, "at": [[1.0, 0.0], "centre"], "length": float(np.hypot(0.7, 0.4))}
    for joints, free in (({}, True), ({"a": held}, True), ({"a": held, "b": other}, False)):
        bodies = {"bead": bead, "bob": {"type": "point", "mass": 1.0}}
        description = {"mechanism": {"name": "beads"}, "bodies": bodies, "joints": joints}
        model = load(mechanism_of(description))
        if free:
            with pytest.raises(
                InputError, match="body 'bead': expected a mass, or joints that hold it, got a massless"
            ):
                model.simulate(until=0.01, shape=shape)
        else:
            assert model.simulate(until=0.01, shape=shape).ok


def test_a_massless_body_that_nothing_holds_is_a_failed_row():
    bob = {"type": "point", "mass": 0.0, "position": ["k", 0.0]}
    description = {
        "mechanism": {"name": "bob"},
        "parameters": {"k": 1.0},
        "bodies": {"bob": bob, "bead": {"type": "point", "mass": 1.0}},
    }
    found = symgen.sweep(load(mechanism_of(description)), {"k": [0.0, 1.0]}, until=0.01)
    assert list(found.status) == ["failed", "failed"]
    assert "body 'bob': expected a mass, or joints that hold it" in found.reason[0]


# -- what is evaluated before what -------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("shape", ["straight", "looped"])
def test_nothing_is_read_that_was_not_evaluated_before(monkeypatch, shape):
    """With nan in all of the scratch array that ``geometry`` fills, starts are the same: it comes before the rest."""
    for model in (load(mechanism_of(make(2, "spatial"))), load(mechanism_of(parallelogram()))):
        compiled = model.compile("lagrange", shape=shape)
        expected = model.assemble(compiled)
        plain = type(compiled).scratch

        def poisoned(self, plain=plain):
            w = plain(self)
            # structural zeros of nu and D are never written; what a start remembers begins as 0; pivots as 1
            begin = ("status", "winding", "mask", "pivot", "nu", "jacobian", "multipliers", "tables")
            for name in set(self.info.sections) - set(begin):
                self.section(w, name)[:] = np.nan
            return w

        with monkeypatch.context() as patched:
            patched.setattr(type(compiled), "scratch", poisoned)
            found = model.assemble(compiled)
        np.testing.assert_array_equal(found.y, expected.y)
        for section in ("mask", "nu", "jacobian", *(["winding"] if compiled.info.windings else [])):
            np.testing.assert_array_equal(compiled.section(found.w, section), compiled.section(expected.w, section))


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("dimension", [2, 3])
def test_the_sentence_on_a_massless_node_between_springs_has_the_rows_that_hold_it(dimension, coordinates):
    """Two springs in series carry a load as one of the stiffness 1/(1/k + 1/c) does."""
    k, c, free, down = 400.0, 1000.0, 0.4, [0.0, -9.81, 0.0][:dimension]
    place = np.array([0.6, -0.8, 0.0][:dimension])
    springs = {
        "upper": {
            "between": ["ground", "node"],
            "at": [[0.0] * dimension, "centre"],
            "stiffness": "k",
            "free_length": free,
        },
        "lower": {"between": ["node", "load"], "at": ["centre", "centre"], "stiffness": c, "free_length": "free"},
    }
    description = {
        "mechanism": {"name": "node", "gravity": down} | ({"space": "spatial"} if dimension == 3 else {}),
        "parameters": {"k": k, "free": free},
        "bodies": {
            "load": {"type": "point", "mass": 5.0, "position": place.tolist()},
            "node": {"type": "point", "mass": 0, "position": ((free + 0.2 * c / (k + c)) * place).tolist()},
        },
        "forces": {name: {"type": "spring-damper", **spring} for name, spring in springs.items()},
        "run": {"until": 1.0},
    }
    with pytest.raises(InputError) as refused:
        load(mechanism_of(description)).simulate(coordinates=coordinates)
    rows = str(refused.value).partition('by a joint of type = "rows" with ')[2]
    assert rows.count("position") == dimension
    joint = {"type": "rows", **tomllib.loads(rows)}
    result = load(mechanism_of(description | {"joints": {"balance": joint}})).simulate(
        coordinates=coordinates, rtol=1e-10
    )
    both = {"type": "spring-damper", "between": ["ground", "load"], "at": [[0.0] * dimension, "centre"]}
    bodies = {"load": description["bodies"]["load"]}
    forces = {"both": {**both, "stiffness": 1 / (1 / k + 1 / c), "free_length": 2 * free}}
    alone = load(mechanism_of(description | {"bodies": bodies, "forces": forces})).simulate(rtol=1e-10)
    for name in ("load.x", "load.y"):
        assert result.ok and result[name][-1] == pytest.approx(alone[name][-1], abs=1e-7)
