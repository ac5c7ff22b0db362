"""Unique reactions of an overconstrained beam: the closed form of bars that give, and the motion of other methods."""

import numpy as np
import pytest

from benchmarks.shared_loads import CASES, GRAVITY, MASS, beam, shares, tensions
from symgen.errors import InputError

METHOD = "stiffness-scaled-penalty"


@pytest.mark.parametrize("stiffness", CASES)
def test_bars_share_a_load_like_their_stiffness(stiffness):
    found, _ = tensions(stiffness, METHOD)
    np.testing.assert_allclose(found[0], shares(stiffness, MASS * GRAVITY * np.cos(0.3)), rtol=1e-9)
    np.testing.assert_allclose(found[1], shares(stiffness, found[1].sum()), rtol=1e-7)  # in motion as well
    equal, _ = tensions(stiffness, "direct-correction")
    np.testing.assert_allclose(equal[0], MASS * GRAVITY * np.cos(0.3) / 3.0, rtol=1e-9)


def test_symmetric_bars_are_strained_alike():
    found, _ = tensions((1e6, 2e6, 1e6), METHOD)
    np.testing.assert_allclose(found[:, 1], 2.0 * found[:, 0], rtol=1e-9)
    np.testing.assert_allclose(found[:, 2], found[:, 0], rtol=1e-9)


def test_the_motion_does_not_depend_on_the_stiffness():
    _, expected = tensions(CASES[0], "direct-correction")
    for stiffness in CASES[1:3]:
        np.testing.assert_allclose(tensions(stiffness, METHOD)[1], expected, rtol=0.0, atol=1e-7)


@pytest.mark.parametrize("period", [0.03, 0.3])
def test_the_period_changes_nothing_but_the_iteration(period):
    keys = {"method": METHOD, "until": 0.1, "times": [0.0], "options": {"method.period": period}}
    found = np.asarray(beam(CASES[2]).simulate(**keys).lam)[0]
    np.testing.assert_allclose(found, shares(CASES[2], MASS * GRAVITY * np.cos(0.3)), rtol=1e-8)


def test_results_say_how_loads_are_shared():
    keys = {"until": 0.1, "times": [0.1]}
    own = beam(CASES[1]).simulate(method=METHOD, **keys)
    other = beam(CASES[1]).simulate(method="direct-correction", **keys)
    assert any("shared like the stiffness of rows" in note for note in own.notes)
    assert any("of minimum norm" in note for note in other.notes)
    assert any("not unique" in note for note in other.notes) and not any("not unique" in note for note in own.notes)


def test_both_coordinates_agree_and_loops_are_refused():
    keys = {"method": METHOD, "until": 0.1, "times": [0.0]}
    joint = np.asarray(beam(CASES[2]).simulate(coordinates="joint", **keys).lam)[0]
    np.testing.assert_allclose(joint, shares(CASES[2], MASS * GRAVITY * np.cos(0.3)), rtol=1e-9)
    with pytest.raises(InputError, match="which reads the stiffness of single rows"):
        beam(CASES[2]).simulate(shape="looped", **keys)
    with pytest.raises(InputError, match=r"stiffness"):
        beam((1e6, -1.0, 1e6))
