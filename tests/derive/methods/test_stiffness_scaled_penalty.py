"""Unique reactions of an overconstrained beam: the closed form of bars that give, and the motion of other methods."""

import numpy as np
import pytest
from support.emitted import mechanism_of

from benchmarks.shared_loads import CASES, GRAVITY, MASS, beam, shares, tensions
from symgen.api import load
from symgen.base.errors import InputError
from symgen.describe.catalogue import raw

METHOD = "stiffness-scaled-penalty"


@pytest.mark.slow
@pytest.mark.parametrize("stiffness", CASES)
def test_bars_share_a_load_like_their_stiffness(stiffness):
    own, _ = tensions(stiffness, METHOD)
    np.testing.assert_allclose(own[0], shares(stiffness, MASS * GRAVITY * np.cos(0.3)), rtol=1e-9)
    np.testing.assert_allclose(own[1], shares(stiffness, own[1].sum()), rtol=1e-9)  # in motion as well
    equal, _ = tensions(stiffness, "direct-correction")
    np.testing.assert_allclose(equal[0], MASS * GRAVITY * np.cos(0.3) / 3.0, rtol=1e-9)


@pytest.mark.slow
def test_symmetric_bars_are_strained_alike():
    own, _ = tensions((1e6, 2e6, 1e6), METHOD)
    np.testing.assert_allclose(own[:, 1], 2.0 * own[:, 0], rtol=1e-9)
    np.testing.assert_allclose(own[:, 2], own[:, 0], rtol=1e-9)


@pytest.mark.slow
def test_the_motion_does_not_depend_on_the_stiffness():
    _, expected = tensions(CASES[0], "direct-correction")
    for stiffness in CASES[1:3]:
        np.testing.assert_allclose(tensions(stiffness, METHOD)[1], expected, rtol=0.0, atol=1e-12)


@pytest.mark.slow_cases("1.0-1e-06", "1000000.0-1e-06")
@pytest.mark.parametrize("unit", [1e-6, 1e6])
@pytest.mark.parametrize("ratio", [1.0, 1e6])
def test_shares_depend_on_ratios_alone(unit, ratio):
    stiffness = (unit, 2.0 * ratio * unit, 5.0 * unit)
    own = np.asarray(beam(stiffness).simulate(method=METHOD, until=0.1, times=[0.0]).lam)[0]
    expected = shares(stiffness, MASS * GRAVITY * np.cos(0.3))
    np.testing.assert_allclose(own, expected, rtol=0.0, atol=1e-10)


def test_both_solvers_share_alike():
    keys = {"method": METHOD, "until": 0.2, "times": [0.0, 0.2]}
    own, other = (
        np.asarray(beam(CASES[2]).simulate(**keys, options=o).lam) for o in ({}, {"method.solver": "augmented"})
    )
    np.testing.assert_allclose(own, other, rtol=1e-8)


@pytest.mark.slow
def test_redundant_rows_do_not_pull_at_the_motion():
    """At constant steps of order 4, whose stages violate: the motion is that of the same correction without sharing."""
    description = raw("slider-crank")
    bar = {"type": "distance", "between": ["ground", "rod"], "at": [[0.0, 0.0], "P"], "length": 0.15}  # as the crank
    model = load(mechanism_of(description | {"joints": description["joints"] | {"bar": bar}}))
    keys = {"integrator": "rk4", "step": 1e-3, "until": 1.0, "times": [1.0]}
    own, other = (np.asarray(model.simulate(method=m, **keys).q)[-1] for m in (METHOD, "direct-correction"))
    np.testing.assert_allclose(own, other, rtol=0.0, atol=1e-10)


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
