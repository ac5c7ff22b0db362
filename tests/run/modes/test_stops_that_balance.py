"""A stop beside dry pins: where weights and a force balance, accelerations are rounding, and tell nothing."""

from pathlib import Path

import numpy as np
import pytest

import symgen
from benchmarks.bounded.machines import MACHINES, text

#: A press on its lower stop whose first pin rubs by its reaction, the other two by a constant moment.
PRESS = (
    text(MACHINES["press"], True)
    .replace('friction = { sliding = "dry" }', "friction = { coefficient = 0.2, radius = 0.01 }", 1)
    .replace("until = 1.0", "until = 0.5")
)


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_stop_is_left_once_and_pins_slip_once(tmp_path: Path, coordinates: str) -> None:
    """The lift 200 t takes the weights of the ram and of 2 kg of links from the stop; pins hold a while longer."""
    (tmp_path / "press.toml").write_text(PRESS)
    model = symgen.load(tmp_path / "press.toml")
    slips = []
    for mass in np.linspace(4.0, 6.0, 7):
        result = model.simulate(parameters={"m": float(mass)}, coordinates=coordinates, integrator="dop853")
        assert [event.name for event in result.events] == ["guide.lower.leave", "A.slip", "knee.slip", "B.slip"]
        assert result.events[0].t == pytest.approx((mass + 2.0) * 9.81 / 200.0, abs=1e-13)
        slips.append(result.events[1].t)
    np.testing.assert_allclose(np.diff(slips, 2), 0.0, atol=1e-13)
