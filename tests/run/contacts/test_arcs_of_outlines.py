"""Rounded outlines on each other: distances of polygons less two radii, and the same motion from either side."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from benchmarks.mechanisms.toml import text as toml
from symgen.base.errors import InputError
from tests.run.contacts.scenes import loaded
from tests.run.contacts.test_pairs_of_outlines import TIGHT, thing

Array = NDArray[np.float64]


def corners_within(shape: dict[str, Any], place: Array) -> Array:
    """Return the corners of the polygon whose distance less the fillet is that from a shape at x, y and an angle."""
    fillet = shape["fillet"]
    if "box" in shape:
        a, b = (0.5 * size - fillet for size in shape["box"])
        own = np.array([[-a, -b], [a, -b], [a, b], [-a, b]])
    else:
        sides, radius = shape["polygon"]["sides"], shape["polygon"]["radius"]
        turns = 2.0 * math.pi * np.arange(sides) / sides
        own = (radius - fillet / math.cos(math.pi / sides)) * np.stack([np.cos(turns), np.sin(turns)], axis=1)
    c, s = math.cos(place[2]), math.sin(place[2])
    return np.asarray(place[:2] + own @ np.array([[c, s], [-s, c]]))


def distance_of_polygons(one: Array, other: Array) -> float:
    """Return the distance of two polygons that do not meet: of a corner of one from a side of the other one."""

    def least(points: Array, sides: Array) -> float:
        ends = np.roll(sides, -1, axis=0)
        along = ends - sides
        from_start = points[:, np.newaxis] - sides
        part = np.clip((from_start * along).sum(axis=2) / (along**2).sum(axis=1), 0.0, 1.0)
        return float(np.linalg.norm(from_start - part[:, :, np.newaxis] * along, axis=2).min())

    return min(least(one, other), least(other, one))


def pulled(under: dict[str, Any], on: dict[str, Any], place: list[float], swapped: bool, law: dict[str, str]) -> str:
    """Return a rounded outline that a spring pulls to the middle of one of the ground."""
    between = [{"outline": "under"}, {"outline": "on"}]
    raw = {
        "mechanism": {"name": "rounded"},
        "parameters": {"v": 2.0, "w": 20.0, **{value: 0.3 for value in law.values()}},
        "bodies": {"thing": thing(place, velocity=["v", 0.0], angular_velocity="-w")},
        "forces": {"pull": {"type": "force", "body": "thing", "force": ["-100*thing.x", "-100*thing.y"]}},
        "outlines": {"under": {"body": "ground", **under}, "on": {"body": "thing", **on}},
        "contacts": {
            "feet": {"between": between[:: -1 if swapped else 1], **law},
        },
    }
    return toml(raw)


SHAPES: dict[str, tuple[dict[str, Any], dict[str, Any], float]] = {
    "boxes": ({"box": [0.3, 0.2], "fillet": 0.04}, {"box": [0.12, 0.12], "fillet": 0.05}, 0.16),
    "long": ({"box": [0.3, 0.2], "fillet": 0.04}, {"box": [0.16, 0.12], "fillet": 0.03}, 0.16),
    "hexagon": (
        {"box": [0.3, 0.2], "fillet": 0.06},
        {"polygon": {"sides": 6, "radius": 0.08}, "fillet": 0.03},
        0.1 + 0.08 * math.cos(math.pi / 6.0),
    ),
}


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("name", SHAPES)
def test_arcs_roll_slide_and_strike_on_arcs(name: str, tmp_path: Path) -> None:
    """Contacts pass from arcs to faces of either outline; which of them comes first changes rows, and no motion.

    Reported gaps are distances of polygons, no run ends, and energy is kept without friction between impacts.
    """
    under, on, height = SHAPES[name]
    place = [0.0, height] if name != "hexagon" else [0.003, height + 0.002]
    rubbing, smooth = (
        [loaded(pulled(under, on, place, swapped, law), tmp_path) for swapped in (False, True)]
        for law in ({"friction": "mu"}, {})
    )
    draw, fixed, radii = np.random.default_rng(8), corners_within(under, np.zeros(3)), under["fillet"] + on["fillet"]
    for case in range(20):
        law = {"mu": [0.1, 0.3, 5.0][case % 4 - 1]} if case % 4 else {}
        values = law | {"v": float(draw.uniform(1.0, 3.0)), "w": float(draw.uniform(5.0, 40.0))}
        models = rubbing if case % 4 else smooth
        runs = [model.simulate(until=0.7, output_step=0.01, parameters=values, **TIGHT) for model in models]
        assert all(run.ok for run in runs), (values, [run.reason for run in runs])
        np.testing.assert_allclose(runs[0].q.values, runs[1].q.values, rtol=0.0, atol=1e-7, err_msg=str(values))
        for run in runs:
            known = np.array([distance_of_polygons(fixed, corners_within(on, q)) for q in run.q.values]) - radii
            assert np.abs(known - run["feet.gap"])[known < 0.01].max() < 1e-12, values
            assert known.min() > -1e-11, values
            energy = 0.5 * (run["thing.vx"] ** 2 + run["thing.vy"] ** 2 + 0.01 * run["thing.omega"] ** 2)
            energy += 50.0 * (run["thing.x"] ** 2 + run["thing.y"] ** 2)
            impacts = sorted(event.t for event in run.events if event.name == "feet.hit")
            between = np.searchsorted(impacts, run.t[1:]) == np.searchsorted(impacts, run.t[:-1])
            if "mu" not in values:
                assert np.abs(np.diff(energy))[between].max(initial=0.0) < 1e-8, values
            assert np.diff(energy).max() < 1e-8, values


def test_arcs_on_arcs_have_no_restitution(tmp_path: Path) -> None:
    """Where a contact changed rows, some runs had an impact that was none."""
    under, on, height = SHAPES["boxes"]
    with pytest.raises(InputError, match=r"restitution: expected no restitution where arcs of two"):
        loaded(pulled(under, on, [0.0, height], False, {"restitution": "e"}), tmp_path)
