"""Lie-group integrators beside the numbers of Exudyn's test models: omega_y at the end, by number of steps."""

import pytest

from benchmarks.lie_groups import (
    ANGLES,
    BY_ANGLES,
    DOPRI5,
    EARLY,
    EXPLICIT,
    IMPLICIT,
    LIE,
    MATLAB,
    RK67,
    TOP,
    TOPS,
    by_closed_form,
    end_of_run,
    euler_parameters,
    exact,
)

#: Their runs with the smallest steps, which lie farther from the limit than those before.
ASTRAY = {TOP: (200000,), TOPS: (8000, 16000)}
#: Rounding of their runs and ours [rad/s]: the top turns 24 times a second.
ROUNDING = {TOP: 1e-9, TOPS: 1e-13}


def test_the_heavy_top_by_screws_is_theirs():
    _, omega = end_of_run(TOP, 2000, integrator="rkmk4-screws", coordinates="joint")
    theirs = EXPLICIT[TOP][2000]
    assert abs(omega - theirs) < 1e-3 * abs(theirs - DOPRI5)


@pytest.mark.slow
@pytest.mark.parametrize("name", [TOP, TOPS])
def test_rkmk4_reaches_each_of_their_numbers(name):
    """The series of the inverse differential, which ends behind order 4, changes a thousandth of the error."""
    for steps, theirs in EXPLICIT[name].items():
        if steps not in ASTRAY[name]:
            _, omega = end_of_run(name, steps, **LIE)
            assert abs(omega - theirs) < 1e-3 * abs(theirs - exact(name)) + ROUNDING[name], steps


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "counts", "rounding"), [(TOP, (1000, 2000), 2e-11), (TOPS, (6, 12, 100, 1000), 5e-13)]
)
def test_the_closed_form_of_their_scheme_gives_their_digits(name, counts, rounding):
    for steps in counts:
        assert abs(by_closed_form(name, steps) - EXPLICIT[name][steps]) < rounding, steps


@pytest.mark.slow
def test_limits_are_theirs():
    assert abs(exact(TOP) - DOPRI5) < 5e-10 and abs(exact(TOP) - RK67) < 5e-10
    assert abs(by_closed_form(TOP, 400, 0.01) - EARLY) < 1e-12
    assert abs(end_of_run(TOP, 400, 0.01, **LIE)[1] - EARLY) < 1e-12
    assert abs(exact(TOPS) - EXPLICIT[TOPS][4000]) < 3e-12
    turned = euler_parameters(5, None, integrator="dop853", coordinates="joint")
    assert [float(x) for x in turned.split(", ")] == list(MATLAB)


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_euler_angles_have_the_errors_of_theirs():
    """Their file names no scheme: it is the average acceleration, within the tolerance of their iteration."""
    _, name, keys = IMPLICIT["Euler angles"]
    assert name == ANGLES and abs(exact(ANGLES) - exact(TOPS)) < 1e-10
    for steps in (1000, 2000, 4000, 16000):
        _, omega = end_of_run(name, steps, **keys)
        assert 0.97 < (omega - exact(TOPS)) / (BY_ANGLES[steps] - exact(TOPS)) < 1.01, steps


@pytest.mark.slow
def test_indices_two_and_three_have_the_same_limit():
    """Both of theirs approach it, that of index 3 with order 1; here both are of order 2."""
    for label, order in (("index 2", 2.0), ("index 3", 1.0)):
        theirs, name, keys = IMPLICIT[label]
        (*_, middle, fine), right = theirs, exact(name)
        assert 2 * middle == fine
        assert abs((theirs[middle] - right) / (theirs[fine] - right)) == pytest.approx(2.0**order, rel=0.02)
        coarse, half = (end_of_run(name, steps, **keys)[1] - right for steps in (2000, 4000))
        assert coarse / half == pytest.approx(4.0, rel=0.02)
