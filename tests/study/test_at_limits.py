"""Families at limits: friction, contacts and stops that just hold or just let go, and drivers that contradict."""

import json
import subprocess
import sys

import numpy as np
import pytest

from symgen.api import Model
from symgen.base.errors import InputError
from symgen.study.stress.bench import Base
from symgen.study.stress.cell_outcome import GOOD
from symgen.study.stress.cell_references import reference_of_cell
from symgen.study.stress.families import FAMILIES, levels_of_family
from symgen.study.stress.study import stress

BASE = Base.of_mechanism("four-bar")
HELD = ("slope", "grip", "wedge", "pull-off")
G = 9.81


def accelerations(family, ratio):
    """Newton's equations of what moves, solved for accelerations and normal forces together; held where it need not."""
    if ratio >= 1.0:
        return np.zeros(3)
    if family == "slope":  # a, N along and across the slope: m a = m g sin - mu N, N = m g cos
        mu = ratio * np.tan(0.5)
        return np.array([np.linalg.solve([[1.0, mu], [0.0, 1.0]], [G * np.sin(0.5), G * np.cos(0.5)])[0], 0.0, 0.0])
    if family == "grip":  # both walls rub upwards with mu N, N = 40 N
        return np.array([0.0, 2.0 * (ratio * G / 80.0) * 40.0 - G, 0.0])
    if family == "pull-off":
        return np.array([0.0, G / ratio - G, 0.0])
    s, c, mu, r = np.sin(0.9), np.cos(0.9), 0.3, 0.1
    normals = np.array([[s, c], [-s, c]])
    along = np.array([[c, -s], [c, s]])  # against the slip of a disc that turns to the left: n turned right
    forces = np.linalg.solve((normals + mu * along).T, [0.0, G])
    limit = mu * r * forces.sum()
    return np.array([0.0, 0.0, (limit / ratio - limit) / 0.005])


@pytest.mark.parametrize("family", HELD)
@pytest.mark.parametrize("quick", [True, False])
def test_references_are_those_of_newtons_equations(family, quick):
    for level in levels_of_family(family, BASE, quick):
        motion = reference_of_cell(level)
        assert motion["unusable"] is None and "constant accelerations" in motion["how"]
        own = 0.5 * np.linspace(0.0, 2.0, 51)[:, None] ** 2 * accelerations(family, level.values[0])
        np.testing.assert_allclose(np.array(motion["q"])[:, :3], own, atol=1e-11)


@pytest.mark.parametrize("family", HELD)
def test_a_run_holds_or_goes_on_either_side_of_the_limit(family):
    """At 41 ratios around the limit, 1e-9 beside it the nearest; a run beyond it leaves, however slowly."""
    (level, *_) = levels_of_family(family, BASE, True)
    near = np.geomspace(1e-9, 0.2, 20)
    model, body = Model(level.mechanism), level.mechanism.bodies[0].name
    for ratio in (*(1.0 - near), *(1.0 + near)):
        result = model.simulate(until=2.0, parameters={"ratio": float(ratio)})
        end = np.array([result[f"{body}.{name}"][-1] for name in ("x", "y", "theta")])
        expected = 2.0 * accelerations(family, ratio)
        assert result.status == "ok"
        np.testing.assert_allclose(end, expected, rtol=1e-5, atol=1e-9)


@pytest.mark.parametrize("family", ["slope", "grip", "wedge"])
@pytest.mark.parametrize("method", ["penalty", "udwadia-kalaba"])
def test_looped_code_has_friction_in_the_balance_of_forces(family, method):
    """A balance without it would leave a third of the forces, and call a right run failed."""
    (level, *_) = levels_of_family(family, BASE, True)
    changes = {"shape": "looped", "step": 1e-3, "parameters": {"ratio": 0.9}}
    result = Model(level.mechanism).simulate(until=2.0, method=method, integrator="rk4", **changes)
    body = level.mechanism.bodies[0].name
    end = np.array([result[f"{body}.{name}"][-1] for name in ("x", "y", "theta")])
    assert result.status == "ok" and result.evaluations > 7000, "so that more than the start is balanced"
    np.testing.assert_allclose(end, 2.0 * accelerations(family, 0.9), rtol=1e-5, atol=1e-5)


@pytest.mark.parametrize("shape", ["straight", "looped"])
@pytest.mark.parametrize("method", ["rattle", "half-explicit", "discrete-gradient", "index3-augmented-lagrangian"])
def test_methods_that_read_all_rows_are_refused_beside_a_stop(method, shape):
    """Their looped code held a stop closed that is pulled open, and the run was ok."""
    (level, *_) = levels_of_family("pull-off", BASE, True)
    with pytest.raises(InputError, match="where rows may be off"):
        Model(level.mechanism).simulate(until=0.01, method=method, shape=shape)


@pytest.mark.by_turns(5)
@pytest.mark.slow
@pytest.mark.parametrize("family", [*HELD, "contradiction"])
def test_no_method_says_ok_of_a_wrong_motion(family):
    study = stress(["four-bar"], [family], searches=False)
    assert not study.false_successes
    judged = [row for row in study.rows if row.outcome != "refused"]
    assert {row.case for row in judged} == {level.label for level in levels_of_family(family, BASE, False)}
    if family == "contradiction":
        assert {row.status for row in judged if row.values[0] > 1e-5} == {"failed"}
    else:
        assert {row.outcome for row in judged if row.method in ("lagrange", "auto")} == {GOOD}


def test_contradictions_are_told_in_a_process_of_their_own():
    words = [*("stress", "four-bar", "--cases", "contradiction"), *("--methods", "lagrange", "--quick", "--json")]
    done = subprocess.run([sys.executable, "-m", "symgen", *words], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    rows = json.loads(done.stdout)["rows"]
    assert {row["status"] for row in rows if row["values"] == [1e-3]} == {"failed"}
    assert {row["outcome"] for row in rows if row["values"] == [1e-12]} == {GOOD}


def test_families_at_limits_have_both_sides():
    for family in HELD:
        for values in (FAMILIES[family].values, FAMILIES[family].quick):
            assert min(values) < 1.0 < max(values)
