"""The catalogue's slider-crank with its rod of one, two and four modal bodies, against beam elements."""

import numpy as np
import pytest

import symgen
from benchmarks.finite_elements import solid
from symgen.describe import catalogue

SETTINGS = {
    "until": 0.05,
    "integrator": "radau5",
    "rtol": 1e-7,
    "atol": 1e-9,
    "max_energy_error": 1.0,
    "output_step": 1e-4,
    "verify": False,
}


def text_of_rod(folder, count):
    """The machine with bodies in a row, rigidly joined, in place of the beam."""
    text = catalogue.file_of_entry("flexible-slider-crank").read_text(encoding="utf-8")
    before, rest = text.split("[beams.rod]")
    after = rest[rest.index("[joints.pin]") :].split("[outputs]")[0]
    length = 0.3 / count
    bar = solid((length, 0.008), (max(8, 24 // count), 2), young=2e11, poisson=0.3, density=7870.0, thick=0.008)
    faces = bar.ends | ({"middle": np.flatnonzero(np.abs(bar.x[:, 0] - 0.15) < 1e-9)} if count == 1 else {})
    symgen.reduced(bar.x, bar.mass, bar.stiffness, faces, 2).save(folder / f"rod{count}.npz")
    parts = ""
    for i in range(count):
        parts += f'[bodies.r{i}]\ntype = "modal"\nfile = "rod{count}.npz"\nposition = [{0.15 + i * length!r}, 0.0]\n'
        parts += f'velocity = [0.0, "0.15*speed*{1 - (i + 0.5) / count!r}"]\nangular_velocity = "-0.5*speed"\n\n'
        if i:
            parts += f'[joints.w{i}]\ntype = "rigid"\nbetween = ["r{i - 1}.tip", "r{i}.root"]\n'
            parts += "at = [[0.0, 0.0], [0.0, 0.0]]\n\n"
    after = after.replace('between = ["crank", "rod"]', 'between = ["crank", "r0.root"]')
    after = after.replace('at = ["tip", "start"]', 'at = ["tip", [0.0, 0.0]]')
    after = after.replace('between = ["slider", "rod"]', f'between = ["slider", "r{count - 1}.tip"]')
    return before + parts + after.replace('at = ["centre", "end"]', 'at = ["centre", [0.0, 0.0]]')


def bend(result, start, middle, end):
    """How far the middle of the rod is from the line between its ends."""
    (x, y), (u, w), (p, q) = ((result[f"{name}.x"], result[f"{name}.y"]) for name in (start, middle, end))
    return ((p - x) * (w - y) - (q - y) * (u - x)) / np.hypot(p - x, q - y)


@pytest.mark.by_turns(6)
@pytest.mark.slow
def test_the_rod_bends_as_beams_do(tmp_path):
    """2.3e-4, 7e-5 and 6e-5 m of 1.87e-3 m, of which four bodies alone are ok; energy keeps its balance to 1e-10."""
    text = catalogue.file_of_entry("flexible-slider-crank").read_text(encoding="utf-8")
    (tmp_path / "beams.toml").write_text(text.replace("elements = 4", "elements = 16"), encoding="utf-8")
    beams = symgen.load(tmp_path / "beams.toml").simulate(**SETTINGS)
    exact = bend(beams, "rod.start", "rod.8", "rod.end")
    apart = {}
    for count, middle in ((1, "r0.middle"), (2, "r1.root"), (4, "r2.root")):
        (tmp_path / "rod.toml").write_text(text_of_rod(tmp_path, count), encoding="utf-8")
        result = symgen.load(tmp_path / "rod.toml").simulate(**SETTINGS)
        apart[count] = np.abs(bend(result, "r0.root", middle, f"r{count - 1}.tip") - exact).max()
        assert (result.status == "ok") == (count == 4), result.reason
        assert result.energy_drift_max < 1e-10 * np.ptp(result.kinetic)
    assert apart[1] < 2.3e-4 and apart[2] < 7e-5 and apart[4] < 6e-5, apart
