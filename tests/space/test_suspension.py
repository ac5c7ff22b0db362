"""The front suspension: the benchmark's places and nominal loads at the start, symmetry, and a second derivation."""

import numpy as np
import pytest
from support.spatial_runs import columns, point, run, start_of

from symgen.describe.files.load import load_mechanism
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.result.points import Points
from symgen.study.references.reference import reference_motion


def place(mechanism, result, body, name):
    """Path of a named point."""
    described = mechanism.body(body)
    values = {p.name: p.value for p in mechanism.parameters}
    local = [evaluate_formula(e, values) for e in dict(described.points)[name]]
    return point(result, body, np.array(local) - [evaluate_formula(e, values) for e in described.centre_of_mass])


@pytest.mark.slow
def test_places_and_loads_of_the_benchmark():
    mechanism = load_mechanism("front-suspension")
    _, result = run("front-suspension", integrator="rk4", step=1e-3, until=2e-3)
    for side, sign in (("left", 1.0), ("right", -1.0)):
        expected = {
            ("arm", "inner"): (0.97, 0.259, 0.302),
            ("arm", "outer"): (0.97, 0.572, 0.229),
            ("leaf", "inner"): (0.97, 0.1585, 0.6),
            ("leaf", "outer"): (0.97, 0.488, 0.531),
            ("wheel", "lower"): (0.97, 0.572, 0.229),
            ("wheel", "upper"): (0.97, 0.488, 0.531),
        }
        for (body, name), (x, y, z) in expected.items():
            found = place(mechanism, result, f"{body}_{side}", name)[0]
            np.testing.assert_allclose(found, [x, sign * y, z], atol=1e-12)
        seat = place(mechanism, result, "chassis", f"SEAT_{side[0].upper()}")[0]
        leaf = np.linalg.norm(seat - place(mechanism, result, f"leaf_{side}", "outer")[0])
        assert 35906.0 * (leaf - 0.252) == pytest.approx(-2728.9, abs=0.05)
        top = place(mechanism, result, "chassis", f"DAMPER_{side[0].upper()}")[0]
        z = np.linalg.norm(top - place(mechanism, result, f"arm_{side}", "damper")[0]) + 0.12074455717
        assert -4.0092e6 + 2.8397e7 * z - 6.7061e7 * z**2 + 5.2796e7 * z**3 == pytest.approx(-128.0, abs=0.05)
        tie = place(mechanism, result, f"wheel_{side}", "tie")[0]
        np.testing.assert_allclose(tie, [0.83, sign * 0.4833, 0.404], atol=1e-12)


@pytest.mark.slow
def test_a_flat_road_moves_both_sides_alike():
    _, result = run("front-suspension", integrator="rk4", step=1e-3, until=2.0, parameters={"road_height": 0.0})
    assert result.status == "ok" and (result.rank.rows, result.rank.rank) == (39, 39)
    for c, sign in (("x", 1.0), ("y", -1.0), ("z", 1.0)):
        np.testing.assert_allclose(result[f"wheel_left.{c}"], sign * result[f"wheel_right.{c}"], atol=1e-11)
    settled = result["chassis.z"][-1]
    assert 0.53 < settled < 0.57, "the assumed masses settle by a few centimetres at most"
    np.testing.assert_allclose(result["chassis.x"], 0.97, atol=1e-12)


@pytest.mark.by_turns(6)
@pytest.mark.slow
def test_independent_equations_lead_the_same_way():
    times = np.linspace(0.0, 1.0, 21)
    model, result = run("front-suspension", until=1.0, times=times)
    assert result.energy_drift_max < 1e-8
    found = reference_motion(model.mechanism, model.parameters(), *start_of(model), times, solver="scipy-dop853")
    assert (
        Points.of_mechanism(model.mechanism, model.parameters()).largest_distance(
            columns(result, model.mechanism), found.q
        )
        < 1e-11
    )
