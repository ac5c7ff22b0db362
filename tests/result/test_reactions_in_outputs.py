"""``pin.F`` in ``[outputs]``: the reactions of results, as a formula of a file, in integrals, in C and in FMUs."""

from pathlib import Path

import numpy as np
import pytest

from symgen import MechanismBuilder, load
from symgen.api import Model
from symgen.base.errors import InputError
from symgen.describe import catalogue
from symgen.describe.formulas.reaction_readings import readings_of_reaction

EXACT = {"rtol": 1e-11, "atol": 1e-11}


def reporting(name: str, folder: Path, outputs: str) -> Model:
    """Return an entry of the catalogue with further outputs."""
    path = catalogue.file_of_entry(name)
    assert path is not None
    text = path.read_text(encoding="utf-8")
    head = "[outputs]\n"
    text = text.replace(head, head + outputs, 1) if head in text else f"{text}\n{head}{outputs}"
    file = folder / f"{name}.toml"
    file.write_text(text, encoding="utf-8")
    return load(file)


def all_reactions(name: str, folder: Path) -> tuple[Model, list[str]]:
    joints = [joint for joint in load(name).mechanism.joints if joint.kind != "driver"]
    names = [f"{joint.name}.{label}" for joint in joints for label in readings_of_reaction(joint)]
    assert names
    lines = (f'r{i} = {{ value = "{name}", unit = "N" }}\n' for i, name in enumerate(names))
    return reporting(name, folder, "".join(lines)), names


@pytest.mark.by_turns(6)
@pytest.mark.fast("absolute-four-bar")
@pytest.mark.parametrize("name", ["four-bar", "bricard", "spatial-slider-crank"])
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_reaction_in_outputs_is_that_of_results(coordinates: str, name: str, tmp_path: Path) -> None:
    model, names = all_reactions(name, tmp_path)
    result = model.simulate(until=0.05, coordinates=coordinates)
    for i, column in enumerate(names):
        size = np.max(np.abs(result[column.partition(".")[0] + ".F"]))
        np.testing.assert_allclose(result.outputs[f"r{i}"], result[column], rtol=0, atol=1e-9 * size + 1e-12)


@pytest.mark.slow
def test_the_impulse_of_a_reaction_is_integrated(tmp_path: Path) -> None:
    model = reporting("four-bar", tmp_path, 'impulse = { value = "integral(C.Fx)", unit = "N s" }\n')
    found = {c: model.simulate(until=1.0, coordinates=c, output_step=1e-3, **EXACT) for c in ("absolute", "joint")}
    for result in found.values():
        simpson = result["C.Fx"] * np.where(np.arange(1001) % 2, 4.0, 2.0)
        simpson[[0, -1]] *= 0.5
        assert result.outputs["impulse"][-1] == pytest.approx(np.sum(simpson) * 1e-3 / 3.0, abs=1e-8)


@pytest.mark.slow
def test_a_stop_along_a_slide_leaves_it_without_the_name(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="got 'F', which 'guide' does not have"):
        reporting("toggle-press", tmp_path, 'f = { value = "guide.F" }\n')
    model = reporting("toggle-press", tmp_path, 'f = { value = "knee.F" }\n')  # a pin beside it has one
    result = model.simulate(until=0.15)
    np.testing.assert_allclose(result.outputs["f"], result["knee.F"], rtol=1e-9, atol=1e-9)


def ball_on_a_rod(space: str, length: float = 1.0, **rod: object) -> Model:
    """Return a ball on a rod with the forces of the rod as outputs; it begins at rest beside its support."""
    axes = 2 if space == "planar" else 3
    builder = MechanismBuilder("ball", space=space, gravity=(*(0.0,) * (axes - 1), -9.81))
    builder.body("ball", type="point", mass=2.0, position=(0.6, 0.3, -0.74161984870956628)[3 - axes :])
    builder.joint("rod", "distance", between=("ball", "ground"), at=("centre", (0.0,) * axes), length=length, **rod)
    for label in ("tension", "F", *(f"F{axis}" for axis in "xyz"[:axes])):
        builder.output(f"o{label}", f"rod.{label}")
    return load(builder.build())


@pytest.mark.slow
@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_the_force_of_a_rod_is_that_of_results(space: str) -> None:
    """A ball that falls from a height z0 on a rod: m (g cos + v^2/L), pulled towards the support."""
    length = 1.0 if space == "spatial" else float(np.hypot(0.3, 0.74161984870956628))
    result = ball_on_a_rod(space, length).simulate(until=0.3, **EXACT)
    for label in ("F", "Fx", "Fy", *(("Fz",) if space == "spatial" else ())):
        np.testing.assert_allclose(result.outputs[f"o{label}"], result[f"rod.{label}"], rtol=0, atol=1e-9)
    height = result["ball.z" if space == "spatial" else "ball.y"]
    pull = 2.0 * 9.81 * (-height + 2.0 * (height[0] - height)) / length
    np.testing.assert_allclose(result.outputs["otension"], pull, rtol=1e-8)


@pytest.mark.slow
def test_a_rod_pushes_breaks_and_has_derivatives() -> None:
    """A ball above its support pushes with a negative tension; a rod breaks where m (g cos + v^2/L) is its strength."""
    builder = MechanismBuilder("rod", gravity=(0.0, -9.81)).parameter("strength", 30.0)
    builder.body("ball", type="point", mass=2.0, position=(0.6, 0.8))
    rod = {"between": ("ground", "ball"), "at": ((0.0, 0.0), "centre"), "length": 1.0}
    model = load(
        builder.joint("rod", "distance", holds="rod.F < strength", **rod).output("pull", "rod.tension").build()
    )
    result = model.simulate(until=1.0, sensitivities=("strength",), **EXACT)
    assert result.ok, result.reason
    (event,) = result.events
    # with v^2 = 2 g (y0 - y): m g (-3 y + 2 y0)/L = strength
    assert event.name == "rod.releases" and event.q["ball.y"] == pytest.approx(
        (1.6 - 30.0 / (2.0 * 9.81)) / 3.0, abs=1e-9
    )
    assert result.outputs["pull"][0] == pytest.approx(-2.0 * 9.81 * 0.8, rel=1e-12)
    ends = [model.simulate(until=1.0, parameters={"strength": 30.0 + h}, **EXACT) for h in (1e-4, -1e-4)]
    difference = (ends[0]["ball.x"][-1] - ends[1]["ball.x"][-1]) / 2e-4
    assert result.gradient("ball.x").values[-1, 0] == pytest.approx(difference, rel=1e-6)
    force = model.gradient("rod.tension", by=("strength",), until=0.1, **EXACT)
    assert force.by["strength"] == 0.0 and force.value == pytest.approx(
        model.simulate(until=0.1, **EXACT)["multiplier.rod.distance"][-1]
    )


@pytest.mark.slow
def test_a_rope_goes_slack_by_its_tension_and_is_taut_again() -> None:
    """A ball on a rope leaves the circle where m v^2/L = m g sin, flies, and is caught where the rope is taut."""
    builder = MechanismBuilder("sling", gravity=(0.0, -9.81))
    builder.body("ball", type="point", mass=1.0, position=(0.0, -1.0), velocity=(6.0, 0.0))
    holds = {"releases": "rope.tension < 0", "catches": "sqrt(ball.x**2 + ball.y**2) > 1.0"}
    rope = {"between": ("ground", "ball"), "at": ((0.0, 0.0), "centre")}
    builder.joint("rope", "rope", **rope, length=1.0, holds={**holds, "at_start": True})
    result = load(builder.build()).simulate(until=1.4, **EXACT)
    assert result.ok, result.reason
    slack, taut = result.events[:2]
    assert [slack.name, taut.name] == ["rope.releases", "rope.holds"]
    up = (6.0**2 / 9.81 - 2.0) / 3.0  # v^2 = 36 - 2 g (1 + y) is g y
    assert slack.q["ball.y"] == pytest.approx(up, abs=1e-9)
    late, x, y = taut.t - slack.t, slack.q["ball.x"], slack.q["ball.y"]
    x, y = x + slack.v["ball.vx"] * late, y + slack.v["ball.vy"] * late - 0.5 * 9.81 * late**2
    assert np.hypot(x, y) == pytest.approx(1.0, abs=1e-10)
    assert (taut.q["ball.x"], taut.q["ball.y"]) == (pytest.approx(x, abs=1e-10), pytest.approx(y, abs=1e-10))
