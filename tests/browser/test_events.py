"""Events in pages happen at the times of runs: one source of effects, of the search and of steps."""

from pathlib import Path

import pytest
from support.struck import STOPPED, STRUCK

from symgen import load
from tests.browser.chromium import Chromium
from tests.browser.test_controls import CLOSES, settled, typed

pytestmark = pytest.mark.browser


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("name", STRUCK)
def test_events_happen_at_the_times_of_a_run(name: str, coordinates: str, chromium: Chromium, tmp_path: Path) -> None:
    (tmp_path / "struck.toml").write_text(STRUCK[name])
    model = load(tmp_path / "struck.toml")
    until = 3.0 if name == "four-bar" else 1.5
    result = model.simulate(
        method="direct-correction", integrator="rk4", step=1e-3, until=until, shape="straight", coordinates=coordinates
    )  # fmt: skip
    chromium.open(result.view().save(tmp_path / "page.html"), 1280, 800)
    times = [event.t for event in result.events]
    assert len(times) >= 2
    for time, following in zip(times, [*times[1:], until], strict=True):
        between = round(0.5 * (time + following), 3)
        assert chromium.run(f"window.symgen.run({{}}, {between}).at(-1)") == pytest.approx(time, rel=0, abs=1e-9)


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_an_event_ends_the_motion(coordinates: str, chromium: Chromium, tmp_path: Path) -> None:
    """The ball, thrown at 1 m/s, is 1.2 m away after 1.2 s; the page says so and keeps the state."""
    (tmp_path / "stopped.toml").write_text(STOPPED)
    result = load(tmp_path / "stopped.toml").simulate(integrator="rk4", step=1e-3, coordinates=coordinates)
    assert result.t[-1] == pytest.approx(1.2, abs=1e-9)
    chromium.open(result.view().save(tmp_path / "page.html"))
    *_, last, clock = chromium.run("window.symgen.run({}, 1.5)")
    impacts = [event.t for event in result.events if event.name == "floor"]
    assert (last, clock) == pytest.approx((impacts[-1], 1.2), rel=0, abs=1e-9)
    chromium.run("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
    typed(chromium, "e", "0.6")
    settled(chromium)
    assert chromium.run(CLOSES) == "the event 'far' ends the motion at t = 1.2 s"
    assert chromium.said == []
