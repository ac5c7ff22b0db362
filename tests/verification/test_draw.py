"""Random mechanisms: the same in every process, valid, closed, and shrunk to what is needed."""

import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest

import symgen
from benchmarks.mechanisms.draw import draw
from benchmarks.mechanisms.toml import text
from benchmarks.plain import forces, joints_plane, joints_space
from benchmarks.plain.start import projected, start
from benchmarks.plain.system import read
from benchmarks.rescale import LENGTH, MASS, TIME, Units, dimension_of, rescaled
from benchmarks.verification.judge import NEARLY
from benchmarks.verification.runs import DENSE, METHODS
from benchmarks.verification.shrink import smallest
from symgen.describe.forces import FORCES
from symgen.describe.joints import JOINTS

ROOT = Path(__file__).resolve().parents[2]


@pytest.mark.slow
def test_a_number_means_the_same_mechanism_in_every_process() -> None:
    script = "from benchmarks.mechanisms.draw import draw; from benchmarks.mechanisms.toml import text; "
    script += "print(''.join(text(draw(5, i).raw) for i in range(4)))"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, cwd=ROOT, check=True)
    assert done.stdout.strip() == "".join(text(draw(5, i).raw) for i in range(4)).strip()


@pytest.mark.slow
def test_files_read_back_as_they_were_written() -> None:
    for index in range(30):
        raw = draw(5, index).raw
        assert tomllib.loads(text(raw)) == tomllib.loads(text(tomllib.loads(text(raw))))
        for section in ("bodies", "joints", "forces"):
            assert list(tomllib.loads(text(raw)).get(section, {})) == list(raw.get(section, {}))


@pytest.mark.slow
def test_symgen_takes_what_is_drawn(tmp_path: Path) -> None:
    file = tmp_path / "drawn.toml"
    for index in range(60):
        file.write_text(text(draw(5, index).raw), encoding="utf-8")
        mechanism = symgen.load(file).mechanism
        system = read(tomllib.loads(file.read_text(encoding="utf-8")))
        assert [row.label for joint in mechanism.joints for row in joint.rows] == [
            name.rpartition(".")[2] for name in system.rows
        ]


def test_the_reference_knows_every_kind() -> None:
    # points on beams and cables have references of their own in tests/verification/test_sliding.py
    assert set(joints_plane.KINDS) | set(joints_space.KINDS) >= set(JOINTS) - {"slides-on"}
    # beam elements have an energy of their own in tests/derive/formulate/test_beam_element.py
    assert set(forces.KINDS) >= set(FORCES) - {"beam"}


def test_every_method_is_verified() -> None:
    from symgen.derive.methods import METHODS as known

    assert set(METHODS) == set(known) - {"implicit-constraint"}
    assert set(DENSE) | set(NEARLY) <= set(METHODS)


@pytest.mark.parametrize("index", range(12))
def test_other_units_are_the_same_mechanism(index: int) -> None:
    """The reference's accelerations of a rescaled file, brought back, are those of the file."""
    units = Units(2.0**-6, 2.0**5, 2.0**3)
    content = text(draw(6, index).raw)
    one, other = read(tomllib.loads(content)), read(tomllib.loads(rescaled(content, units)))
    begin = start(one)
    q, rank = begin.q, one.rank(one.constraints(one.at(0.0, begin.q, begin.v)).d)
    start(other)
    lengths = [units.length if name.rpartition(".")[2] in "xyz" else 1.0 for name in one.names_q]
    speeds = np.array([units.length if "v" in name.rpartition(".")[2] else 1.0 for name in one.names_v]) / units.time
    _, v = projected(one, 0.3, q, np.random.default_rng(index).standard_normal(one.nv), rank)
    here, there = one.at(0.3, q, v), other.at(0.3 * units.time, q * lengths, v * speeds)
    (c, f), (d, g) = ((s.constraints(x), s.loads(x)[0]) for s, x in ((one, here), (other, there)))
    mine, theirs = one.accelerations(c, f, rank)[0], other.accelerations(d, g, rank)[0]
    np.testing.assert_allclose(theirs * units.time / speeds, mine, atol=1e-6 * (1.0 + np.abs(mine).max()))


@pytest.mark.parametrize(
    ("unit", "dimension"),
    [
        ("kg", MASS),
        ("m", LENGTH),
        ("s", TIME),
        ("N s/m", (0, 1, -1)),
        ("kg m^2", (2, 1, 0)),
        ("N m s/rad", (2, 1, -1)),
        ("m/s^2", (1, 0, -2)),
        ("rad/s", (0, 0, -1)),
        ("1", (0, 0, 0)),
        ("", None),
        ("furlong", None),
    ],
)
def test_units_are_read(unit: str, dimension: object) -> None:
    assert dimension_of(unit) == dimension


def test_a_failing_mechanism_becomes_small() -> None:
    raw = next(d.raw for d in (draw(5, i) for i in range(200)) if len(d.raw["bodies"]) > 3 and d.raw.get("forces"))
    kept = next(iter(raw["joints"]))
    found = smallest(raw, lambda r: kept in r.get("joints", {}))
    assert list(found["joints"]) == [kept] and not found.get("forces")
    assert len(found["bodies"]) <= 2
