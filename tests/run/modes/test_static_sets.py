"""Dry friction in more pins than a linkage has freedom: it holds as long as any forces within all bounds do."""

from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import linprog
from support.rotation import of_turn

from tests.result.targets.test_c_modes import loaded

#: Ends of four bars from pin to pin, from one foot to the other, and what the five pins hold at rest [N m].
ENDS = np.array([[0.0, 0.0], [-0.2, 0.5], [0.3, 0.9], [0.9, 0.6], [0.7, 0.0]])
#: Direction of a force on the middle pin that rises by 1 N/s.
PULL = np.array([0.6, -0.35])


def five_bar(static: np.ndarray, part: float) -> str:
    """Return a linkage with two degrees of freedom, all of whose pins rub; in motion by a part of `static`."""
    text = '[mechanism]\nname = "five-bar"\ngravity = [0.0, 0.0]\n[run]\nuntil = 60.0\n'
    for k in range(4):
        middle, along = (ENDS[k] + ENDS[k + 1]) / 2.0, ENDS[k + 1] - ENDS[k]
        angle, half = float(np.arctan2(along[1], along[0])), float(np.hypot(*along)) / 2.0
        text += f"[bodies.b{k}]\nmass = 1.0\ninertia = 0.02\nposition = {middle.tolist()}\nangle = {angle!r}\n"
        text += f"points = {{ a = [{-half!r}, 0.0], b = [{half!r}, 0.0] }}\n"
    pins = ["ground", "b0", "b1", "b2", "b3", "ground"]
    for i in range(5):
        first = ENDS[i].tolist() if i == 0 else '"b"'
        second = ENDS[i].tolist() if i == 4 else '"a"'
        text += f'[joints.p{i}]\ntype = "revolute"\nbetween = ["{pins[i]}", "{pins[i + 1]}"]\n'
        text += f"at = [{first}, {second}]\n".replace("'", '"')
        text += f"friction = {{ sliding = {float(part * static[i])!r}, static = {float(static[i])!r} }}\n"
    return text + f'[forces.pull]\ntype = "force"\nbody = "b1"\nat = "b"\nforce = ["{PULL[0]}*t", "{PULL[1]}*t"]\n'


def breakaway(static: np.ndarray) -> float:
    """Return the largest load that any forces of the pins within their bounds hold, by a linear program."""
    turned = np.array([[-1.0, 1.0]]) * np.diff(ENDS, axis=0)[:, ::-1]  # velocity of an end by the bar's rate
    closing = turned.T  # the last end stays where it is
    rates = np.linalg.svd(closing)[2][2:].T  # of bars, in the two ways to move
    pins = np.diff(np.vstack([np.zeros((1, 2)), rates, np.zeros((1, 2))]), axis=0)
    power = PULL @ (turned[:2].T @ rates[:2])
    found = linprog(
        np.r_[np.zeros(5), -1.0],
        A_eq=np.column_stack([pins.T, power]),
        b_eq=np.zeros(2),
        bounds=[*((-s, s) for s in static), (0.0, None)],
    )
    return float(found.x[-1])


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_pins_hold_by_any_forces_within_their_bounds(coordinates: str, tmp_path: Path) -> None:
    static = np.array([1.3, 2.1, 0.9, 1.7, 2.6])
    result = loaded(five_bar(static, 0.6), tmp_path).simulate(coordinates=coordinates, verify=False)
    slips = [event.t for event in result.events if event.name.endswith(".slip")]
    assert slips[0] == pytest.approx(breakaway(static), rel=1e-9)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_random_bounds(tmp_path: Path) -> None:
    generator = np.random.default_rng(3)
    bounds = [(generator.uniform(0.3, 3.0, 5).round(3), float(generator.uniform(0.3, 1.0))) for _ in range(30)]
    for static, part in of_turn(bounds, 3):
        result = loaded(five_bar(static, part), tmp_path).simulate(
            integrator="dop853", until=1.2 * breakaway(static), verify=False
        )
        slips = [event.t for event in result.events if event.name.endswith(".slip")]
        assert slips and slips[0] == pytest.approx(breakaway(static), rel=1e-9), (static, part)
