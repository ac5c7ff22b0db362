"""Events in pages happen at the times of runs: one source of effects, of the search and of steps."""

from pathlib import Path

import pytest
from support.struck import STRUCK

from symgen import load
from tests.browser.chromium import Chromium

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
