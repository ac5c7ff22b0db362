"""Friction and stops in pages: motions behind a slider are those of runs, with their transitions and curves."""

import json
from pathlib import Path

import numpy as np
import pytest

from symgen.api import load
from symgen.result.labelled import unit_scales
from tests.browser.chromium import Chromium
from tests.browser.test_controls import settled, typed

pytestmark = pytest.mark.browser


@pytest.mark.parametrize(
    ("coordinates", "name", "value"),
    [("absolute", "push", 350.0), ("joint", "push", 350.0), ("joint", "back", 0.05137)],
)
def test_a_press_plays_with_another_push(
    coordinates: str, name: str, value: float, chromium: Chromium, tmp_path: Path
) -> None:
    """The push ends at a time that is a parameter, `back`."""
    model = load("toggle-press")
    settings = {"method": "direct-correction", "integrator": "rk4", "coordinates": coordinates}
    chromium.open(model.simulate(**settings).view(live="direct-correction").save(tmp_path / "press.html"), 1280, 800)
    typed(chromium, name, str(value))
    settled(chromium)
    assert chromium.said == []
    groups = chromium.run("symgen.groups()")
    names = [each for group in groups if not group["log"] for each in group["names"]]
    assert {"ram.y", "guide.mode", "guide.force", "guide.lower.mode", "guide.lower.force", "lost"} <= set(names)
    columns = {each: chromium.run(f"symgen.column({json.dumps(each)})") for each in names}
    t = np.array(columns["ram.y"]["t"])[:-1]  # a recording has times of 32 bits: its end may be behind that of runs
    run = model.simulate(**settings, parameters={name: value}, times=t)
    assert any(event.name == ("guide.reverse" if name == "back" else "guide.lower.hit") for event in run.events)
    away = np.abs(t - (value if name == "back" else 0.3)) > 1e-9  # where the push jumps, a run has the forces before it
    scales, units = unit_scales(run.whole()), dict(zip(run.whole().names, run.whole().units, strict=True))
    for column, seen in columns.items():
        error = np.abs(np.array(seen["values"])[:-1] - run[column])[away].max()
        assert error < 1e-8 * max(1.0, scales.get(units[column], 1.0)), column
    moments = [(m[0], m[3]) for m in chromium.run("symgen.moments()") if m[2] == "event"]
    assert [word for _, word in moments] == [event.name for event in run.events]
    assert [at for at, _ in moments] == pytest.approx([event.t for event in run.events], rel=0, abs=1e-9)
