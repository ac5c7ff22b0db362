"""Errors of stress studies count in the motion: what stands still follows nothing, and limits are those of theory."""

import numpy as np
import pytest

from symgen.result.points import SMALL, Points
from symgen.study.stress.bench import Base, NotApplicable
from symgen.study.stress.cell_outcome import GOOD, CellRun, classify_outcome
from symgen.study.stress.cell_references import reference_of_cell
from symgen.study.stress.families import levels_of_family
from symgen.study.stress.stress_rows import LargestSteps
from symgen.study.stress.study import stress


@pytest.mark.parametrize("reach", np.geomspace(1e-9, 3.0, 20))
def test_small_motions_are_the_scale_of_their_errors(reach):
    """A point on a line: the scale is the size of the mechanism, or the range of a motion below a tenth of it."""
    points = Points(bodies=((0, 1.0),))
    q = np.zeros((50, 3))
    q[:, 0] = reach * np.sin(np.linspace(0.0, 6.0, 50))
    moved = np.abs(q[:, 0]).max()
    assert points.scale_of_errors(q) == pytest.approx(1.0 if moved >= SMALL else moved)
    assert points.scale_of_errors(q, small=1.0) == pytest.approx(min(1.0, moved))
    still = points.distances_over_time(np.zeros_like(q), q)
    run = CellRun(True, still, np.ones(50), 0.0, points.scale_of_errors(q))
    assert classify_outcome(run) != GOOD, "it has not moved at all"


def test_nothing_that_moves_counts_in_the_size():
    assert Points(bodies=((0, 2.0),)).scale_of_errors(np.zeros((5, 3))) == 2.0


@pytest.mark.slow
@pytest.mark.parametrize("model", ["four-bar", "slider-crank", "pendulum", "spatial-slider-crank"])
def test_no_error_above_a_thousandth_of_the_motion_is_ok(model):
    """What errors are shares of is never above the range of the motion: the largest way of a body's end."""
    base = Base.of_mechanism(model)
    for family in ("stiffness", "damping", "gravity", "mass-ratio", "light-stiff"):
        try:
            levels = levels_of_family(family, base, False)
        except NotApplicable:
            continue
        for level in levels:
            motion = reference_of_cell(level, True)
            if motion["unusable"] is None:
                q = np.array(motion["q"])
                points = Points.of_mechanism(level.mechanism, {p.name: p.value for p in level.mechanism.parameters})
                moved = points.distances_over_time(np.repeat(q[:1], len(q), axis=0), q).max()
                assert motion["length"] <= moved * (1.0 + 1e-12) or moved < 1e-12 * motion["length"]


@pytest.mark.slow
@pytest.mark.parametrize("model", ["pendulum", "slider-crank"])
def test_a_wrong_motion_on_stiff_springs_is_not_verified(model):
    """Motions of 1e-9 to 1e-4 m that are wrong by as much are ok by what one run sees, and two runs differ by it."""
    methods = ["lagrange", "generalized-alpha", "rattle", "penalty"]
    study = stress([model], ["stiffness", "damping"], methods, searches=False)
    wrong = study.false_successes
    assert wrong and not [row for row in wrong if row.verified_falsely]
    assert {row.verified for row in wrong} == {"unverified"} and {
        row.verified for row in study.rows if row.outcome == GOOD
    } == {""}


@pytest.mark.slow
def test_the_largest_step_on_a_spring_is_that_of_the_polynomial():
    """RK4 ends at 2.828 on the imaginary axis, 0.172 s for the spring of 1e4 N/m at 16.44 1/s; 0.197 s stood."""
    study = stress(["four-bar"], ["stiffness"], ["lagrange"], quick=True)
    (limit,) = (x for x in study.limits if x.integrator == "rk4" and x.case == "10000 N/m")
    assert limit.stable_step <= 2.8285 / 16.44 * 1.01
    # the mass swings between its start and twice its rest: an error of a tenth of its range is a fifth of the amplitude
    steps, omega = np.linspace(0.05, 0.1, 501), 16.44

    def error(h):
        z, k = 1j * omega * h, np.arange(1, int(1.0 / h) + 1)
        factor = 1.0 + z + z**2 / 2.0 + z**3 / 6.0 + z**4 / 24.0
        return np.abs((factor**k).real - np.cos(omega * h * k)).max()

    predicted = max(h for h in steps if error(h) <= 0.2)
    assert 0.9 * predicted < limit.stable_step < 1.1 * predicted


@pytest.mark.parametrize(("step", "word"), [(None, "none"), (1.0, ">= 1"), (0.25, "0.25")])
def test_a_bound_is_marked(step, word):
    assert LargestSteps("m", "f", "c", "lagrange", "rk4", step, step, 1.0).words == (word, word)
