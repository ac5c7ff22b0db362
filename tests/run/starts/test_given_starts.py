"""Starts whose coordinates are all given: places that no way leads to from the described one."""

import math

import numpy as np
import pytest
from support.models import circles

import symgen
from symgen.base.errors import AssemblyError


def four_bar(model, crank, side):
    """Return all coordinates of a four-bar of the catalogue by joints and lengths of its description."""
    closed = model.simulate(until=1e-3, step=1e-3)
    q = closed.q.row(0)
    r = 2.0 * np.array([q["crank.x"], q["crank.y"]])  # bars have their centres in the middle
    c = 2.0 * np.array([q["coupler.x"], q["coupler.y"]]) - r
    d = 2.0 * np.array([q["rocker.x"], q["rocker.y"]]) - c
    one, two, three = (float(np.hypot(*x)) for x in (r, c - r, c - d))
    tip = one * np.array([math.cos(crank), math.sin(crank)])
    new = circles(tip, d, two, three, side)
    bars = {"crank": (np.zeros(2), tip), "coupler": (tip, new), "rocker": (new, d)}
    found = {}
    for name, (begin, end) in bars.items():
        own = math.atan2(*({"crank": r, "coupler": c - r, "rocker": d - c}[name])[::-1]) - q[f"{name}.theta"]
        x, y = 0.5 * (begin + end)
        angle = math.atan2(*(end - begin)[::-1]) - own
        found |= {f"{name}.x": float(x), f"{name}.y": float(y), f"{name}.theta": angle}
    return found


@pytest.mark.parametrize("angle", [0.3, math.pi / 2, 2.5, 3.0])
def test_a_pendulum_starts_where_it_is_told_to(angle):
    """From the described place, x alone cannot be moved to first order: full starts were refused."""
    start = {"bob.x": -math.cos(angle), "bob.y": -math.sin(angle)}
    result = symgen.simulate("pendulum", start=start, until=0.01, step=1e-3)
    assert result.status == "ok" and result.q.row(0) == pytest.approx(start, abs=1e-12)


def test_what_is_not_closed_as_it_is_given_is_refused_as_before():
    with pytest.raises(AssemblyError, match=r"with bob\.x = 0.6 m, bob\.y = -0.81 m held"):
        symgen.simulate("pendulum", start={"bob.x": 0.6, "bob.y": -0.81}, until=0.01)


@pytest.mark.parametrize("name", ["driven-four-bar", "four-bar"])
def test_both_branches_of_a_four_bar_can_be_begun_with(name):
    model = symgen.load(name)
    crank = model.simulate(until=1e-3, step=1e-3).q.row(0)["crank.theta"]
    for side in (1.0, -1.0):
        start = four_bar(model, crank, side)
        result = model.simulate(start=start, until=2e-3, step=1e-3)
        assert result.status == "ok"
        assert result.q.row(0) == pytest.approx(start, abs=1e-12)


def test_another_branch_of_a_driven_mechanism_is_refused_with_a_way_to_get_there():
    with pytest.raises(AssemblyError, match="the analysis kinematics finds other ways"):
        symgen.simulate("driven-four-bar", start={"rocker.theta": 4.0}, until=0.01)
    with pytest.raises(AssemblyError) as refused:  # here something is free
        symgen.simulate("four-bar", start={"rocker.theta": 4.0}, until=0.01)
    assert "other ways" not in str(refused.value)


def test_sweeps_begin_where_single_runs_do():
    angles = [0.3, 1.0, 2.0]
    rows = {"bob.x": [-math.cos(a) for a in angles], "bob.y": [-math.sin(a) for a in angles]}
    found = symgen.sweep("pendulum", runs=rows, until=0.01, output_step=0.01, step=1e-3)
    assert found.counts["ok"] == 3
