"""``pin.F`` in ``[outputs]``: the reactions of results, as a formula of a file, in integrals, in C and in FMUs."""

from pathlib import Path

import numpy as np
import pytest

from symgen import load
from symgen.api import Model
from symgen.base.errors import InputError
from symgen.describe import catalogue
from symgen.describe.formulas.readings import readings_of_reaction

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


@pytest.mark.fast("absolute-four-bar", "absolute-bricard")
@pytest.mark.parametrize("name", ["four-bar", "bricard", "spatial-slider-crank"])
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_reaction_in_outputs_is_that_of_results(coordinates: str, name: str, tmp_path: Path) -> None:
    model, names = all_reactions(name, tmp_path)
    result = model.simulate(until=0.05, coordinates=coordinates)
    for i, column in enumerate(names):
        size = np.max(np.abs(result[column.partition(".")[0] + ".F"]))
        np.testing.assert_allclose(result.outputs[f"r{i}"], result[column], rtol=0, atol=1e-9 * size + 1e-12)


def test_the_impulse_of_a_reaction_is_integrated(tmp_path: Path) -> None:
    model = reporting("four-bar", tmp_path, 'impulse = { value = "integral(C.Fx)", unit = "N s" }\n')
    found = {c: model.simulate(until=1.0, coordinates=c, output_step=1e-3, **EXACT) for c in ("absolute", "joint")}
    for result in found.values():
        simpson = result["C.Fx"] * np.where(np.arange(1001) % 2, 4.0, 2.0)
        simpson[[0, -1]] *= 0.5
        assert result.outputs["impulse"][-1] == pytest.approx(np.sum(simpson) * 1e-3 / 3.0, abs=1e-8)


def test_a_stop_along_a_slide_leaves_it_without_the_name(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="got 'F', which 'guide' does not have"):
        reporting("toggle-press", tmp_path, 'f = { value = "guide.F" }\n')
    model = reporting("toggle-press", tmp_path, 'f = { value = "knee.F" }\n')  # a pin beside it has one
    result = model.simulate(until=0.15)
    np.testing.assert_allclose(result.outputs["f"], result["knee.F"], rtol=1e-9, atol=1e-9)
