"""Derivatives through impacts with friction, slip, stick and rest: forward, adjoint and by differences."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from benchmarks.bounded.touch.kinds import drawn
from benchmarks.mechanisms.toml import text as toml_text
from symgen.describe.formulas.duals import Dual
from symgen.run.directions.series_directions import ImpactDirections, ImpactsAhead, slopes_left_over
from tests.run.contacts.scenes import DROP, LIGHT, G, body, floor, head, loaded, place_of_disc, rods
from tests.run.contacts.scenes_in_space import DIE

#: A spinning disc that bounces, rests and rolls.
DISC = (
    head("drop")
    + "[parameters]\nmu = 0.06\ne = 0.6\nheight = 0.8\n"
    + body("disc", 1.0, 0.005, (0.0, 0.0), (0.3, 0.0), 25.0).replace("[0.0, 0.0]", '[0.0, "height"]', 1)
    + floor("disc", 0.1, '"mu"').replace("restitution = 0.0", 'restitution = "e"')
)


def slopes_of(
    text: str,
    until: float,
    name: str,
    values: dict[str, float],
    folder: Path,
    within: float = 1e-6,
    steps: dict[str, float] | None = None,
) -> dict[str, float]:
    """Return derivatives of a coordinate at an end, which are the same forward, adjoint and by differences.

    `steps` are those of differences where they are not 1e-5.
    """
    model, by = loaded(text, folder), list(values)
    settings: dict[str, Any] = {"integrator": "dop853", "until": until}
    forward = model.simulate(rtol=1e-11, sensitivities=by, verify=False, **settings)
    assert forward.ok
    place = forward.q.names.index(name)
    slopes = np.asarray(forward.sensitivities.table("q")).reshape(len(forward.t), -1, len(by))[-1, place]
    gradient = model.gradient(name, by=by, rtol=1e-11, way="adjoint", **settings)
    for (parameter, value), slope in zip(values.items(), slopes, strict=True):
        step = (steps or {}).get(parameter, 1e-5)
        ends = [
            model.simulate(rtol=1e-12, parameters={parameter: value + h}, verify=False, **settings)[name][-1]
            for h in (step, -step)
        ]
        differences = (ends[0] - ends[1]) / (2.0 * step)
        assert abs(slope - differences) < within * abs(differences) + 1e-9, parameter
        assert abs(gradient.by[parameter] - slope) < 1e-6 * abs(slope) + 1e-9, parameter
    return dict(zip(by, map(float, slopes), strict=True))


@pytest.mark.by_turns(2)
@pytest.mark.slow_cases("0.6")
@pytest.mark.parametrize("until", [0.6, 1.6, pytest.param(2.6, marks=pytest.mark.slow)])
def test_a_bouncing_disc(until: float, tmp_path: Path) -> None:
    """After one impact, after several of which the last ones stick, and at rest."""
    slopes_of(DISC, until, "disc.x", {"mu": 0.06, "e": 0.6, "height": 0.8}, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize(("mu", "e"), [(0.05, 0.7), (0.02, 0.5), (0.1, 0.3), (0.03, 0.8)])
def test_derivatives_through_a_series_of_impacts_are_those_of_its_closed_form(
    mu: float, e: float, tmp_path: Path
) -> None:
    model, until = loaded(DROP, tmp_path), math.sqrt(2.0 / G) * (1.0 + e) / (1.0 - e) + 0.5
    run = model.simulate(
        parameters={"mu": mu, "e": e}, sensitivities=["mu", "e"], until=until, integrator="dop853", rtol=1e-11
    )
    place = run.q.names.index("disc.x")
    slopes = np.asarray(run.sensitivities.table("q")).reshape(len(run.t), -1, 2)[-1, place]

    def at(by_mu: float, by_e: float) -> float:
        return place_of_disc(mu + by_mu, e + by_e, until)[0]

    for slope, (a, b) in zip(slopes, ((1e-5, 0.0), (0.0, 1e-5)), strict=True):
        known = (8.0 * (at(a, b) - at(-a, -b)) - at(2.0 * a, 2.0 * b) + at(-2.0 * a, -2.0 * b)) / 12e-5
        assert abs(slope - known) < 1e-8 * abs(known) + 1e-9


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(("until", "known"), [(0.8, {}), (2.1, {}), (3.0, {"mu": -19.667934, "e": -0.0324622})])
def test_a_disc_whose_derivatives_are_known(until: float, known: dict[str, float], tmp_path: Path) -> None:
    slopes = slopes_of(DROP, until, "disc.x", {"mu": 0.05, "e": 0.7, "height": 1.1}, tmp_path)
    for name, slope in known.items():
        assert slopes[name] == pytest.approx(slope, rel=1e-6)


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_a_slider_with_play(tmp_path: Path) -> None:
    slopes_of(LIGHT, 0.0025, "crank.theta", {"mu": 0.05}, tmp_path)


@pytest.mark.slow
def test_rods_that_hit_the_floor(tmp_path: Path) -> None:
    """Joints share the impulse of a sliding tip at the start, where a coefficient is that of the whole run."""
    text = rods(0.2, 0.5, (1.0, 0.7), (1.0, 0.6), (20.0, 35.0, -0.4, -0.9)).replace("friction = 0.2", 'friction = "mu"')
    text = text.replace("[bodies.one]", "[parameters]\nmu = 0.2\n[bodies.one]")
    slopes_of(text, 0.3, "two.theta", {"mu": 0.2}, tmp_path)


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_contacts_that_slip_between_impacts_that_accumulate(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two discs meet on a floor; what is left out follows from earlier impacts, which the way back comes to later.

    With the ratio of the series as a constant, derivatives by mu are off by 2e-3, and by e by 4e-6.
    """
    values = {"mu": 0.2397, "e": 0.2978}
    raw = drawn("meeting", 6).raw
    raw["parameters"] = values
    raw["contacts"]["c3"] |= {"friction": "mu", "restitution": "e"}
    slopes_of(toml_text(raw), 0.9, "two.theta", values, tmp_path)
    model = loaded(toml_text(raw), tmp_path)
    settings: dict[str, Any] = {"by": ["mu", "e"], "integrator": "rk4", "step": 1e-3, "until": 0.9}
    forward, back = (model.gradient("two.theta", way=way, **settings) for way in ("forward", "adjoint"))
    assert forward.result.ok and (forward.way, back.way) == ("forward", "adjoint")
    for name in values:  # in the same steps
        assert back.by[name] == pytest.approx(forward.by[name], rel=1e-11)
    monkeypatch.setattr(ImpactDirections, "remember", lambda *impact: None)
    for way in ("forward", "adjoint"):
        forgotten = model.gradient("two.theta", way=way, **settings).result
        assert forgotten.status == "unverified" and "accumulate at c1 and c2 and c3 at t = 0.4695" in forgotten.reason


def test_what_is_left_out_of_a_geometric_series() -> None:
    """Numbers ``z + b r^i`` change by ``-b / c`` over the rate ``c r^i`` that remains, whatever z and r are."""
    b, c, r = 0.3, 0.7, 0.2

    def at(i: int) -> tuple[Dual, Dual]:
        """Return the number and the rate of an impact with their derivatives by z, b, c and r."""
        slope = i * r ** (i - 1)
        number = Dual(2.0 + b * r**i, (1.0, r**i, 0.0, b * slope))
        return number, Dual(c * r**i, (0.0, 0.0, r**i, c * slope))

    part = slopes_left_over(*at(7), [at(6), at(5)])
    assert part.value == pytest.approx(-b / c, rel=1e-9)
    assert part.slopes == pytest.approx([0.0, -1.0 / c, b / c**2, 0.0], rel=1e-9, abs=1e-7)


def test_impacts_ahead_get_the_derivatives_of_what_follows() -> None:
    """Two impacts of three numbers, by units in two columns at a time, then the way back through the earlier one."""
    ahead, by = ImpactsAhead(), {(4, 0.1): np.array([1.0, 2.0, 3.0]), (4, 0.2): np.array([-1.0, 0.5, 7.0])}
    for event, t in by:
        assert not ahead.recall(event, t, (3, 2)).any()
    for units in ahead.units_of_impacts(2, [0, 1]):
        ahead.add(units, sum(slopes @ ahead.recall(*impact, (3, 2)) for impact, slopes in by.items()))
    slopes = np.arange(6.0).reshape(3, 2)
    ahead.remember([3, 4], 0.2, slopes)
    assert np.array_equal(ahead.derivatives_here(2), by[4, 0.2] @ slopes)
    assert not ahead.derivatives_here(2).any() and list(ahead.bars) == [(4, 0.1)]


#: A disc that rolls, slides or slips without friction beyond the end of a segment, round which it falls.
EDGE = (
    head("edge")
    + "[parameters]\nv = 1.0\n"
    + body("disc", 1.0, 0.005, (-0.35, 0.1))
    .replace("velocity = [0.0, 0.0]", 'velocity = ["v", 0.0]')
    .replace("angular_velocity = 0.0", 'angular_velocity = "-v/0.1"')
    + '[contacts.flat]\nbetween = [{ body = "disc", disc = 0.1 }, '
    + '{ body = "ground", segment = [[-1.0, 0.0], [0.0, 0.0]] }]\n'
)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("speed", [0.6, 0.9])
@pytest.mark.parametrize("friction", ["0.0", "0.2", "1.5"])
def test_over_the_end_of_a_segment(friction: str, speed: float, tmp_path: Path) -> None:
    """Face and end are pieces of one gap, whose curvature jumps where the disc passes from one to the other."""
    text = EDGE.replace("v = 1.0", f"v = {speed!r}") + ("" if friction == "0.0" else f"friction = {friction}\n")
    slopes_of(text, 0.75, "disc.x", {"v": speed}, tmp_path)


def test_a_segment_far_away_casts_no_doubt(tmp_path: Path) -> None:
    """Its pieces are corners of its gap alone: events elsewhere keep their speeds."""
    far = floor("disc", 0.1, "0.3").replace("restitution = 0.0", "restitution = 0.5")
    far += EDGE[EDGE.index("[contacts.flat]") :].replace("[[-1.0, 0.0], [0.0, 0.0]]", "[[5.0, 0.0], [6.0, 0.0]]")
    text = head("far") + "[parameters]\nv = 1.0\n" + body("disc", 1.0, 0.005, (0.0, 0.5), (0.3, 0.0)) + far
    text = text.replace("velocity = [0.3, 0.0]", 'velocity = ["v", 0.0]')
    result = loaded(text, tmp_path).simulate(until=0.5, sensitivities=["v"], integrator="dop853", verify=False)
    assert result.status == "ok" and len(result.events) > 0, result.reason


@pytest.mark.slow
@pytest.mark.parametrize("name", ["die.z", "ball.x"])
def test_a_box_and_a_ball_in_space(name: str, tmp_path: Path) -> None:
    """Past impacts of three corners and of the ball."""
    slopes_of(DIE, 0.45, name, {"e": 0.4, "size": 0.4}, tmp_path)
