"""Errors of velocities and reactions in a comparison, against references that share nothing with its own."""

import numpy as np
import pytest

import symgen
from symgen.result.points import Points


def compared(name, until, step):
    """A study of one row, the row, the same run alone, and one with tight tolerances."""
    study = symgen.compare(name, ["lagrange"], ["rk4"], [step], until=until, repeat=1, output_step=until / 20)
    common = {"until": until, "times": np.linspace(0.0, until, 21), "verify": False}
    run = symgen.load(name).simulate(method="lagrange", integrator="rk4", step=step, **common)
    tight = {"rtol": 1e-13, "atol": 1e-15, "options": {"method.weight": "mass"}}
    fine = symgen.load(name).simulate(method="direct-correction", integrator="dop853", **tight, **common)
    return study, study.rows[0], run, fine


def test_errors_of_a_pendulum_are_those_from_its_energy():
    """Released at rest at the height of its pivot: v^2 = 2 g h, and the tension is 3 g h for 1 kg at 1 m."""
    study, row, run, fine = compared("pendulum", 0.6, 1e-2)
    assert study.how == "Jacobi's elliptic functions"
    true = np.arctan2(fine.q["bob.x"], -fine.q["bob.y"])
    height, down = np.cos(true), np.sqrt(2.0 * 9.81 * np.cos(true))
    speed = np.column_stack([np.cos(true), np.sin(true)]) * down[:, None]
    off = np.linalg.norm(np.asarray(run.v) - speed, axis=1).max()
    assert row.velocity_error == pytest.approx(off, rel=0.01)
    pull = 3.0 * 9.81 * height[:, None] * np.column_stack([-np.sin(true), np.cos(true)])
    joint = run.forces.seats
    (name,) = joint
    sign = 1.0 if joint[name].body == "bob" else -1.0
    off = np.linalg.norm(sign * run.reactions[name][:, :2] - pull, axis=1).max()
    assert row.reaction_error == pytest.approx(off, rel=0.01)
    assert study.reaction == pytest.approx(3.0 * 9.81 * height.max(), rel=1e-9)
    assert study.speed == pytest.approx(down.max(), rel=1e-9)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize(("name", "until", "step"), [("four-bar", 1.0, 1e-2), ("spatial-slider-crank", 0.3, 2e-3)])
def test_errors_are_distances_to_a_run_with_tight_tolerances(name, until, step):
    study, row, run, fine = compared(name, until, step)
    model = symgen.load(name)
    size = Points.of_mechanism(model.mechanism, model.parameters()).size(np.asarray(run.q))
    split, off = (2 if model.mechanism.space == "planar" else 3), 0.0
    for joint in run.forces.seats:
        difference = run.reactions[joint] - fine.reactions[joint]
        parts = difference[:, :split], difference[:, split:] / size
        off = max(off, *(np.linalg.norm(part, axis=1).max() for part in parts))
    assert not fine.forces.non_unique and row.reaction_error == pytest.approx(off, rel=0.01)
    assert row.relative_error == pytest.approx(row.error / size) and study.length == pytest.approx(size)
    # velocities of the bodies' centres are among those compared
    between = np.asarray(run.v) - np.asarray(fine.v)
    columns = [[run.v.names.index(f"{b.name}.v{x}") for x in "xyz"[:split]] for b in model.mechanism.bodies]
    assert max(np.linalg.norm(between[:, c], axis=1).max() for c in columns) < row.velocity_error * (1.0 + 1e-6)


def test_velocities_of_points_are_the_slopes_of_their_places():
    """Central differences of the points along a motion in space with all kinds of velocities."""
    model = symgen.load("spatial-slider-crank")
    h, instants = 1e-4, np.arange(1, 6) * 0.05
    times = np.sort(np.concatenate([instants - h, instants, instants + h]))
    run = model.simulate(method="direct-correction", integrator="dop853", rtol=1e-12, until=0.3, times=times)
    points, q, v = Points.of_mechanism(model.mechanism, model.parameters()), np.asarray(run.q), np.asarray(run.v)
    before, after = q[0::3], q[2::3]
    still = points.speed_distances((q[1::3], v[1::3]))
    assert still == pytest.approx(points.distances_over_time(after, before) / (2.0 * h), rel=1e-5)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_only_determined_reactions_are_compared():
    """Bricard's mechanism has one row too many, and every joint takes part in it."""
    study = symgen.compare("bricard", ["direct-correction"], ["dop853"], rtols=[1e-6], until=0.2, repeat=1)
    assert study.rows[0].reaction_error is None and study.reaction is None
    assert study.rows[0].velocity_error > 0.0


@pytest.mark.slow
def test_iterations_of_laws_are_counted():
    study = symgen.compare("four-bar", ["augmented-lagrangian", "lagrange"], ["rk4"], [1e-2], until=0.5, repeat=1)
    law, plain = study.rows
    assert law.iterations > 2 * law.evaluations and plain.iterations == 0
