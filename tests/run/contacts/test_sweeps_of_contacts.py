"""Sweeps over coefficients of friction: rows are single runs."""

from pathlib import Path

import numpy as np
import pytest

from benchmarks.bounded.touch.kinds import drawn
from benchmarks.mechanisms.toml import text as toml
from tests.run.contacts.scenes import DROP, loaded, rocking_block, woodpecker

#: A disc in the corner of a sled, and its friction with the floor of it.
SLED = toml(drawn("sled", 29).raw).replace("friction = 0.4667", 'friction = "mu"') + "[parameters]\nmu = 0.4667\n"


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("text", "until", "name", "low", "high"),
    [
        (DROP, 3.0, "disc.x", 0.005, 0.6),
        (rocking_block(0.15, 0.5, 0.12), 2.0, "block.theta", 0.05, 1.2),
        (woodpecker(), 0.3, "sleeve.y", 0.25, 0.35),
        (SLED, 0.4, "disc.theta", 0.3, 0.6),
    ],
    ids=["disc", "block", "woodpecker", "sled"],
)
def test_three_hundred_coefficients_of_friction(
    text: str, until: float, name: str, low: float, high: float, tmp_path: Path
) -> None:
    """Rows of the sweep have the bits of single runs, and none fails."""
    if "[parameters]" not in text:
        text = text.replace("friction = 1.0", 'friction = "mu"').replace(
            "[bodies", "[parameters]\nmu = 1.0\n[bodies", 1
        )
    model, values = loaded(text, tmp_path), np.linspace(low, high, 300)
    table = model.sweep(vary={"mu": values}, integrator="dop853", until=until).to_dataframe()
    (key,) = [key for key in table.columns if key.startswith(name)]
    assert set(table["status"]) == {"ok"}
    for i in range(0, 300, 6):
        run = model.simulate(
            parameters={"mu": float(values[i])}, integrator="dop853", until=until, verify=False, times=None
        )
        assert run[name][-1] == table[key][i]
