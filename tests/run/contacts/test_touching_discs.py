"""Two discs on a floor that touch each other without a force: they roll on as each would alone, or lie still."""

from pathlib import Path

import numpy as np
import pytest

from tests.run.contacts.scenes import body, head, loaded

#: The second disc has the radius r, beside the first one; both roll at the speed V.
PAIR = (
    head("pair")
    + "[parameters]\nr = 0.1\nV = 0.3\nmu = 0.2\n"
    + body("big", 1.7, 0.011, (0.0, 0.15))
    + """[bodies.small]
mass = 0.7
inertia = "0.3*r**2"
position = ["2*sqrt(0.15*r)", "r"]
velocity = ["V", 0.0]
angular_velocity = "-V/r"
[contacts.one]
between = [{ body = "big", disc = 0.15 }, { line = "ground" }]
friction = 0.4
[contacts.two]
between = [{ body = "small", disc = "r" }, { line = "ground" }]
friction = 0.3
[contacts.both]
between = [{ body = "small", disc = "r" }, { body = "big", disc = 0.15 }]
friction = "mu"
"""
).replace("velocity = [0.0, 0.0]\nangular_velocity = 0.0", 'velocity = ["V", 0.0]\nangular_velocity = "-V/0.15"')


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(("speed", "integrator"), [(0.3, "picard"), (-0.3, "dop853"), (0.0, "picard")])
def test_three_hundred_radii(speed: float, integrator: str, tmp_path: Path) -> None:
    """What presses them is 0: to slide on each other and to part are one motion, and lying still has modes.

    By rounding a third of these radii ended in the sentence of several motions, and of no force at rest half of them.
    """
    radii = np.linspace(0.03, 0.3, 300)
    model = loaded(PAIR, tmp_path)
    table = model.sweep(vary={"r": radii}, parameters={"V": speed}, integrator=integrator, until=1.0).to_dataframe()
    assert set(table["status"]) == {"ok"}
    (key,) = [key for key in table.columns if key.startswith("small.x")]
    assert np.abs(table[key].to_numpy() - 2.0 * np.sqrt(0.15 * radii) - speed).max() < 1e-14


@pytest.mark.slow
def test_discs_that_lie_side_by_side(tmp_path: Path) -> None:
    """They lie still without an event, and the weight of each is on the floor."""
    result = loaded(PAIR, tmp_path).simulate(parameters={"V": 0.0, "r": 0.03}, until=1.0)
    assert result.status == "ok" and len(result.events) == 0
    assert abs(result["small.x"][-1] - 2.0 * np.sqrt(0.0045)) < 1e-15 and abs(result["both.force"][-1]) < 1e-12
    assert abs(result["one.force"][-1] - 1.7 * 9.81) < 1e-12


@pytest.mark.slow
def test_eight_discs_in_a_bin_fall_on_each_other(tmp_path: Path) -> None:
    """Impacts leave parts of the heap that nothing strikes: rounding of their rates ended the run at 0.3006 s.

    Each restitution and coefficient of friction has its own sequence of some hundred events.
    """
    walls, text = (
        ("[0.0, 0.0], normal = [0.0, 1.0]", "[-0.06, 0.0], normal = [1.0, 0.0]", "[0.3, 0.0], normal = [-1.0, 0.0]"),
        head("bin"),
    )
    for i in range(8):
        text += body(f"d{i}", 1.0, 0.00125, (0.12 * (i % 3) + 0.006 * (i // 3), 0.07 + 0.13 * (i // 3)))
        others = [f'{{ line = "ground", on = {wall} }}' for wall in walls]
        others += [f'{{ body = "d{k}", disc = 0.05 }}' for k in range(i)]
        for number, other in enumerate(others):
            text += f'[contacts.d{i}c{number}]\nbetween = [{{ body = "d{i}", disc = 0.05 }}, {other}]\n'
            text += "friction = 0.1\nrestitution = 0.3\n"
    result = loaded(text, tmp_path).simulate(until=0.32)
    assert result.status == "ok", result.reason
    assert len([event for event in result.events if event.name.endswith(".hit")]) > 100
    for i in range(8):
        for k in range(i):
            apart = np.hypot(result[f"d{i}.x"] - result[f"d{k}.x"], result[f"d{i}.y"] - result[f"d{k}.y"])
            assert apart.min() > 0.1 - 1e-9
