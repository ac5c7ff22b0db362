"""Machines that lock in a page: the sentence of a run, and the time of the lock, not that of a frame behind it."""

from pathlib import Path

import pytest
from support.emitted import mechanism_of
from support.locks import LOCKED, parts

from symgen.api import load
from tests.browser.chromium import Chromium
from tests.browser.test_controls import CLOSES, settled, typed

pytestmark = pytest.mark.browser


@pytest.mark.parametrize("name", LOCKED)
def test_a_page_ends_where_a_run_does_with_its_sentence(name: str, tmp_path: Path, chromium: Chromium) -> None:
    """A driver that is faster locks sooner."""
    described, expected, _ = LOCKED[name]
    motor = described["joints"]["motor"]
    joints = {**described["joints"], "motor": {**motor, "value": motor["value"].replace("t", "pace*t")}}
    model = load(mechanism_of({**described, "joints": joints, "parameters": {"pace": 1.0}, "run": {"step": 1e-3}}))
    moved = parts(model.kinematics([0.0, 0.3, 1.0]).ended)
    result = model.simulate(until=0.9 * expected)
    assert result.ok
    chromium.open(result.view().save(tmp_path / "page.html"))
    run = "(() => { try { return symgen.run({}, 2.0).length; } catch (error) { return error.message; } })()"
    found = parts(chromium.run(run))
    assert found[0] == pytest.approx(expected, abs=1e-5) and found[1:] == moved[1:]
    assert len(chromium.run("symgen.run({}, 0.3)")) >= 18  # short of it there is a state
    chromium.run("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
    for pace in (1.5, 1.38, 1.58, 1.62, 1.72, 1.88):  # steps that halve come near to the lock, as near as chance wants
        typed(chromium, "pace", str(pace))
        settled(chromium)
        found = parts(chromium.run(CLOSES))
        assert found[0] == pytest.approx(expected / pace, abs=1e-5) and found[1:] == moved[1:]
    assert chromium.said == []
