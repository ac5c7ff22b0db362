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


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_press_plays_with_another_push(coordinates: str, chromium: Chromium, tmp_path: Path) -> None:
    model = load("toggle-press")
    settings = {"method": "direct-correction", "integrator": "rk4", "coordinates": coordinates}
    chromium.open(model.simulate(**settings).view(live="direct-correction").save(tmp_path / "press.html"), 1280, 800)
    typed(chromium, "push", "350")
    settled(chromium)
    assert chromium.said == []
    groups = chromium.run("symgen.groups()")
    names = [name for group in groups if not group["log"] for name in group["names"]]
    assert {"ram.y", "guide.mode", "guide.force", "guide.lower.mode", "guide.lower.force", "lost"} <= set(names)
    columns = {name: chromium.run(f"symgen.column({json.dumps(name)})") for name in names}
    t = np.array(columns["ram.y"]["t"])[:-1]  # a recording has times of 32 bits: its end may be behind that of runs
    run = model.simulate(**settings, parameters={"push": 350.0}, times=t)
    assert any(event.name == "guide.lower.hit" for event in run.events)
    away = np.abs(t - 0.3) > 1e-9  # where the push jumps, a run has the forces before it
    scales, units = unit_scales(run.whole()), dict(zip(run.whole().names, run.whole().units, strict=True))
    for name, seen in columns.items():
        error = np.abs(np.array(seen["values"])[:-1] - run[name])[away].max()
        assert error < 1e-8 * max(1.0, scales.get(units[name], 1.0)), name
    moments = [(m[0], m[3]) for m in chromium.run("symgen.moments()") if m[2] == "event"]
    assert [name for _, name in moments] == [event.name for event in run.events]
    assert [at for at, _ in moments] == pytest.approx([event.t for event in run.events], rel=0, abs=1e-9)
