"""Rank in joint coordinates: the same in all units, to the bit, and by thresholds that mean what they do for bodies."""

from importlib.resources import files

import numpy as np
import pytest

import symgen
from benchmarks.rescale import Units, rescaled
from symgen.describe.catalogue import raw
from symgen.describe.files.builder import to_toml

#: Both texts are in units of their own: no number of a file is 1, as such ones are left out of emitted code.
BEFORE = Units(3.0, 3.0, 3.0)
#: Powers of two, which change no digit: about 1e-6 and 1e6 for lengths.
UNITS = (Units(2.0**-20, 2.0**-10, 2.0**5), Units(2.0**20, 2.0**30, 2.0**-10))


def text_of(name, size=None):
    if size is not None:
        return rescaled(to_toml(raw(name, size)), BEFORE)
    return rescaled((files("symgen.describe.catalogue") / f"{name}.toml").read_text(encoding="utf-8"), BEFORE)


def run(tmp_path, text, units, until, method):
    path = tmp_path / f"{units.length:g}.toml"
    path.write_text(rescaled(text, units), encoding="utf-8")
    times = {"until": until * units.time, "step": 3.0 / 1024 * units.time}
    return symgen.load(path).simulate(method=method, coordinates="joint", integrator="rk4", **times)


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "size", "until", "method", "rank", "events"),
    [
        ("four-bar", None, 0.5, "direct-correction", 8, 0),
        ("n-four-bar", 1, 2.7, "direct-correction", 8, 1),  # the flat four-bar, through the line of its bars
        pytest.param("n-four-bar", 2, 2.7, "coordinate-partitioning", 14, 1, marks=pytest.mark.slow),
        pytest.param("bricard", None, 0.2, "direct-correction", 29, 0, marks=pytest.mark.slow),
    ],
)
def test_units_change_nothing(tmp_path, name, size, until, method, rank, events):
    """Status, rank, which rows depend, passages and pivots: the same bits; angles too."""
    text = text_of(name, size)
    here = run(tmp_path, text, Units(), until, method)
    assert (here.rank.rank, here.rank_event_count) == (rank, events)
    for units in UNITS:
        there = run(tmp_path, text, units, until, method)
        assert (there.status, there.rank, there.steps) == (here.status, here.rank, here.steps)
        passages = [(e.t_in / units.time, e.t_out / units.time, e.rank, e.smallest_pivot) for e in there.rank_events]
        assert passages == [(e.t_in, e.t_out, e.rank, e.smallest_pivot) for e in here.rank_events]
        np.testing.assert_array_equal(there.smallest_pivot, here.smallest_pivot)
        angles = [i for i, unit in enumerate(here.q.units) if unit == "rad"]
        np.testing.assert_array_equal(there.q.values[:, angles], here.q.values[:, angles])


@pytest.mark.slow_cases("n-four-bar:1-1.4", "bricard-1.0")
@pytest.mark.parametrize(("name", "until"), [("n-four-bar:1", 1.4), ("four-bar", 2.0), ("bricard", 1.0)])
def test_pivots_are_those_of_bodies_up_to_a_factor(name, until):
    """Measured over whole motions: 1.2 to 3.4 times as large, so `SKIP` and `WARN` mean the same in both."""
    settings = {"method": "direct-correction", "integrator": "rk4", "step": 2e-3, "output_step": 2e-3, "until": until}
    bodies, joints = (symgen.load(name).simulate(coordinates=c, **settings) for c in ("absolute", "joint"))
    ratio = joints.smallest_pivot / bodies.smallest_pivot
    assert 1.0 < ratio.min() and ratio.max() < 5.0
    near = bodies.smallest_pivot < 1e-3
    if near.any():  # one factor where it counts: both vanish as the square of the distance
        np.testing.assert_allclose(ratio[near], ratio[near].mean(), rtol=0.02)
    assert joints.rank_event_count == bodies.rank_event_count
    for a, b in zip(bodies.rank_events, joints.rank_events, strict=True):
        assert abs(a.t_in - b.t_in) < 2.5 * 2e-3 and abs(a.t_out - b.t_out) < 2.5 * 2e-3  # two steps
