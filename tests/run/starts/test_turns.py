"""Angles in space whose turns are counted: starts whole turns away, and what a run makes of them."""

import math

import numpy as np
import pytest
from support.emitted import mechanism_of

from symgen.api import load
from symgen.compile.loopcode.exact import plain_form
from symgen.run.integrators import INTEGRATORS
from symgen.run.layout import abi
from symgen.run.loops.run_spec import RunSpec
from symgen.run.single.run import integrate
from symgen.run.starts.start_solvers import whole_turns


def wheel(position=(0.0, 0.0, 0.0), angle=0.0, **keys):
    return {
        "mass": 1.0,
        "inertia": [0.2, 0.2, 0.3],
        "position": list(position),
        "orientation": {"rotation_vector": [0.0, 0.0, angle]},
        **keys,
    }


def held(body, position=(0.0, 0.0, 0.0), kind="revolute", **keys):
    frame = [[1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]
    axis = [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]
    return {
        "type": kind,
        "between": ["ground", body],
        "at": [list(position), "centre"],
        "axis": axis,
        "reference": frame,
        **keys,
    }


def mechanism(bodies, joints):
    return load(
        mechanism_of({"mechanism": {"name": "turning", "space": "spatial"}, "bodies": bodies, "joints": joints})
    )


def start_angles(model):
    compiled = model.compile("lagrange")
    start = model.assemble(compiled)
    return compiled.section(start.w, "winding"), start


@pytest.mark.parametrize("value", [5.0, -40.0, 3.3, -math.pi, 0.3])
@pytest.mark.parametrize("described", [0.0, 3.0, -2.0])
def test_a_driver_may_start_whole_turns_away(value, described):
    model = mechanism(
        {"a": wheel(angle=described)}, {"A": held("a"), "d": {"type": "driver", "joint": "A", "value": value}}
    )
    (angle,), start = start_angles(model)
    assert angle == pytest.approx(value, abs=1e-12)
    turned = 2.0 * math.atan2(start.y[6], start.y[3])
    assert math.remainder(turned - value, math.tau) == pytest.approx(0.0, abs=1e-12)
    # the body was turned the short way: by what is left beside whole turns
    moved = 2.0 * math.asin(min(1.0, abs(math.sin((turned - described) / 2.0))))
    assert moved == pytest.approx(abs(math.remainder(value - described, math.tau)), abs=1e-9)


@pytest.mark.slow
def test_gears_and_racks_follow_a_driver_over_whole_turns():
    """A at 7 rad turns B by way of 2 A + B = 31 and the rack by 0.1 B; all described near where they belong."""
    b = 31.0 - 14.0
    bodies = {
        "a": wheel(angle=math.remainder(7.1, math.tau)),
        "b": wheel((1.0, 0.0, 0.0), math.remainder(b + 0.2, math.tau)),
        "c": wheel((0.0, 0.1 * b + 0.02, 2.0)),
    }
    rack = held("c", (0.0, 0.0, 2.0), "translational") | {
        "axis": [[0.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
        "reference": [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0]],
    }
    joints = {
        "rack": {"type": "rack-and-pinion", "pinion": "B", "rack": "C", "radius": 0.1},
        "mesh": {"type": "gear", "joints": ["A", "B"], "radii": [2.0, 1.0], "offset": 31.0},
        "A": held("a"),
        "B": held("b", (1.0, 0.0, 0.0)),
        "C": rack,
        "motor": {"type": "driver", "joint": "A", "value": "7 + 3*t"},
    }
    model = mechanism(bodies, joints)
    angles, start = start_angles(model)
    np.testing.assert_allclose(sorted(angles), [7.0, b], atol=1e-12)
    assert start.rank == len(model.compile("lagrange").info.rows)
    result = model.simulate(method="direct-correction", integrator="rk4", step=0.02, until=5.0)
    assert result.status == "ok"
    np.testing.assert_allclose(result["A.angle"], 7.0 + 3.0 * result.t, atol=1e-9)
    np.testing.assert_allclose(result["B.angle"], b - 6.0 * result.t, atol=1e-9)
    np.testing.assert_allclose(result["C.displacement"], 0.1 * (b - 6.0 * result.t), atol=1e-9)


def test_a_nut_far_along_its_thread():
    """The displacement of 0.35 m is 35 turns of 0.01 m; described only nearly so, and free to turn on."""
    screw = held("a", kind="screw", pitch=0.01)
    model = mechanism({"a": wheel((0.0, 0.0, 0.3501), 0.05, angular_velocity=[0.0, 0.0, 30.0])}, {"S": screw})
    (angle,), start = start_angles(model)
    assert start.y[2] == pytest.approx(0.01 * angle / math.tau, abs=1e-14)
    assert abs(angle - 35.0 * math.tau) < 0.1
    result = model.simulate(method="lagrange", integrator="rk4", step=1e-3, until=2.0)
    np.testing.assert_allclose(result["S.angle"], angle + 30.0 * result.t, atol=1e-7)
    np.testing.assert_allclose(result["S.displacement"], 0.01 * result["S.angle"] / math.tau, atol=1e-12)


def test_multipliers_between_outputs_far_apart_know_the_turns():
    """Baumgarte's terms contain the driven angle, which turns by more than two turns between outputs."""
    bodies, joints = {"a": wheel()}, {"A": held("a"), "d": {"type": "driver", "joint": "A", "value": "4 + 30*t"}}
    model = mechanism(bodies, joints)
    result = model.simulate(method="baumgarte", integrator="rk4", step=5e-4, until=2.0, output_step=0.5)
    assert result.status == "ok"
    np.testing.assert_allclose(result["A.angle"], 4.0 + 30.0 * result.t, atol=1e-8)
    np.testing.assert_allclose(result["multiplier.d.driver"], 0.0, atol=1e-3)


def turns_of(effects, residual):
    """What `whole_turns` says, with its arrays laid out for it."""
    (m, count), rest = np.shape(effects), np.array(residual, dtype=np.float64)
    numbers = np.concatenate([np.ravel(effects), np.full(2 * count + m, np.nan)])
    plain_form(whole_turns)(m, count, numbers, rest, m * count)
    turns = numbers[m * count : m * count + count]
    np.testing.assert_allclose(rest, residual + effects @ turns, atol=1e-12)
    return turns


def test_turns_of_gear_trains():
    turn = math.tau
    # a row of one angle decides first, even if it stands last; then the row it shares with another one
    effects = np.array([[2.0 * turn, turn], [turn, 0.0]])
    np.testing.assert_array_equal(turns_of(effects, np.array([4.0 * turn + 0.3, -3.0 * turn - 0.2])), [3.0, -10.0])
    # alone, the angle that closes the row best is shifted; the other one is left
    np.testing.assert_array_equal(turns_of(np.array([[2.0 * turn, turn]]), np.array([-3.0 * turn])), [0.0, 3.0])
    np.testing.assert_array_equal(turns_of(np.array([[0.0, 0.0]]), np.array([50.0])), [0.0, 0.0])


@pytest.mark.parametrize("seed", range(20))
def test_turns_leave_every_row_as_near_to_closed_as_its_last_angle_can(seed):
    """Integers found by the definition: rows in turn, those with the fewest free angles first."""
    random = np.random.default_rng(seed)
    m, count = int(random.integers(1, 7)), int(random.integers(1, 5))
    effects = math.tau * random.integers(-2, 3, size=(m, count)) * (random.random((m, count)) < 0.5)
    residual = random.uniform(-60.0, 60.0, m)
    expected, free, rows = np.zeros(count), set(range(count)), set(range(m))
    while rows:
        choices = {r: [i for i in sorted(free) if effects[r, i]] for r in rows}
        row = min(rows, key=lambda r: (len(choices[r]), -np.abs(effects[r]).max(), r))
        rows.remove(row)
        rest = residual[row] + effects[row] @ expected
        left = {i: abs(math.remainder(rest, effects[row, i])) for i in choices[row]}
        if left:
            best = min(left, key=lambda i: (round(left[i], 9), i))
            expected[best] = round(-rest / effects[row, best])
            free.remove(best)
    np.testing.assert_array_equal(turns_of(effects, residual), expected)


def test_outputs_inside_a_step_leave_the_turns_at_its_end():
    """A wheel that turns evenly, in steps of 2.5 rad; each output inside is measured from the angle at their end."""
    speed, step = 10.0, 0.25
    model = mechanism({"a": wheel(angular_velocity=[0.0, 0.0, speed])}, {"A": held("a", kind="screw", pitch=0.01)})
    compiled = model.compile("direct-correction")
    integrator = INTEGRATORS.get("dop853")
    times = np.arange(0.0, 4.01, 0.1)  # some at ends of steps, some inside
    loose = {"rtol": 0.1, "atol": 0.1, "max_violation": 1.0}
    spec = RunSpec(until=4.0, step=step, adaptive=True, times=times, largest_step=step, **loose)
    outcome = integrate(compiled, integrator, model.assemble(compiled), spec)
    assert outcome.code == 0 and outcome.steps == 16
    # steps as long as that leave an error, but none of a turn
    np.testing.assert_allclose(outcome.status_columns[:, abi.N_STATUS], speed * times, rtol=0.0, atol=0.5)
    np.testing.assert_allclose(outcome.w[abi.WINDING], speed * 4.0, rtol=0.0, atol=0.5)
    last = outcome.states[-1]
    shown = 2.0 * math.atan2(last[6], last[3])
    found = outcome.status_columns[-1, abi.N_STATUS]
    assert math.remainder(found - shown, math.tau) == pytest.approx(0.0, abs=1e-12)
