"""Velocities that joints do not allow are projected in the metric of the whole M: rotors, products of inertia."""

import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support.rotation import of_turn

import symgen
from benchmarks.bounded.draw import KINDS
from benchmarks.bounded.rotors import geared, thrown
from benchmarks.mechanisms.toml import text
from symgen.describe.files.validate import validate

#: Two wheels with a rotor between them, and gears that the described velocities contradict.
WHEELS: dict[str, Any] = {
    "mechanism": {"name": "wheels"},
    "parameters": {"spin": 1.0, "rotor": 1.0},
    "bodies": {
        "a": {"mass": 1.0, "inertia": 1.0, "angular_velocity": "spin"},
        "b": {"mass": 1.0, "inertia": 1.0, "angular_velocity": 0.0},
    },
    "joints": {
        "p": {"type": "revolute", "between": ["ground", "a"], "at": [[0.0, 0.0], "centre"]},
        "q": {"type": "revolute", "between": ["a", "b"], "at": ["centre", "centre"], "rotor_inertia": "rotor"},
        "g": {"type": "gear", "between": ["a", "b"], "radii": [1.0, 2.0]},
    },
}
SHORT = {"until": 1e-3, "step": 1e-3, "integrator": "rk4", "verify": False}


def rates(spin: float, rotor: float) -> np.ndarray:
    """Return the nearest velocities with a + 2 b = 0, by hand."""
    m, n = np.array([[1.0 + rotor, -rotor], [-rotor, 1.0 + rotor]]), np.array([1.0, 2.0])
    along, v = np.linalg.solve(m, n), np.array([spin, 0.0])
    return v - along * (n @ v) / (n @ along)


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_rotor_takes_part_in_a_start(coordinates: str) -> None:
    model = symgen.Model(validate(WHEELS, "wheels"))
    run = model.simulate(coordinates=coordinates, **SHORT)
    assert run.v["a.omega"][0] == pytest.approx(5.0 / 7.0, abs=1e-15)
    assert run.v["b.omega"][0] == pytest.approx(-2.5 / 7.0, abs=1e-15)


def test_a_held_velocity_stays_and_the_rotor_weighs_the_others() -> None:
    """A third wheel beside both: with a held, M has a say in what b and c do."""
    bodies = {**WHEELS["bodies"], "c": {"mass": 1.0, "inertia": 2.0, "angular_velocity": 3.0}}
    joints = {
        **WHEELS["joints"],
        "r": {"type": "revolute", "between": ["b", "c"], "at": ["centre", "centre"], "rotor_inertia": 0.5},
        "g": {
            "type": "rows",
            "between": ["a", "b", "c"],
            "rows": [{"position": "a.theta + 2*b.theta - c.theta"}],
        },
    }
    model = symgen.Model(validate({**WHEELS, "bodies": bodies, "joints": joints}, "wheels"))
    run = model.simulate(start={"a.omega": 1.5}, **SHORT)
    # b and c free, a changes from what the joints left of its described rate to what is held
    m = np.array([[2.0, -1.0, 0.0], [-1.0, 2.5, -0.5], [0.0, -0.5, 2.5]])
    n, v = np.array([[1.0, 2.0, -1.0], [1.0, 0.0, 0.0]]), np.array([1.5, 0.0, 3.0])
    along = np.linalg.solve(m, n.T)
    after = v - along @ np.linalg.solve(n @ along, n @ v - [0.0, 1.5])
    assert [run.v[f"{name}.omega"][0] for name in "abc"] == pytest.approx(after, abs=1e-14)


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_rows_of_sweeps_begin_as_single_runs(coordinates: str) -> None:
    model, spins, rotors = symgen.Model(validate(WHEELS, "wheels")), np.linspace(-2.0, 2.0, 21), np.linspace(0, 9, 21)
    settings = {name: value for name, value in SHORT.items() if name != "verify"}
    rows = model.sweep(
        runs={"spin": spins, "rotor": rotors}, quantities=("a.omega", "b.omega"), coordinates=coordinates, **settings
    )
    assert set(rows.status) == {"ok"}
    exact = np.array([rates(*pair) for pair in zip(spins, rotors, strict=True)])
    ends = np.column_stack([rows["a.omega"][:, -1], rows["b.omega"][:, -1]])
    np.testing.assert_allclose(ends, exact, atol=1e-14)


@pytest.mark.slow
def test_c_begins_as_single_runs(tmp_path: Path) -> None:
    symgen.Model(validate(WHEELS, "wheels")).generate(tmp_path / "c", target="c")
    (tmp_path / "c" / "own.c").write_text(
        "#include <stdio.h>\n"
        '#include "wheels.h"\n'
        "int main(void) { static wheels m; wheels_init(&m); wheels_set(&m, WHEELS_P_rotor, 4.0); wheels_start(&m);\n"
        'printf("%.17g %.17g\\n", (double)m.y[2], (double)m.y[5]); printf("%.17g %.17g\\n", (double)m.y[8],'
        " (double)m.y[11]); return 0; }\n",
        encoding="utf-8",
    )
    command = ["cc", "-std=c99", "-O1", "own.c", "wheels.c", "-lm", "-o", "own"]
    subprocess.run(command, cwd=tmp_path / "c", check=True, capture_output=True)
    out = subprocess.run([str(tmp_path / "c" / "own")], check=True, capture_output=True, text=True).stdout.split()
    assert [float(x) for x in out[2:]] == pytest.approx(rates(1.0, 4.0), abs=1e-14)


def test_a_body_with_products_of_inertia() -> None:
    """A wheel in space on a skew pin, thrown about all axes: its rate is the share of its angular momentum."""
    tensor = [0.4, 0.5, 0.6, 0.1, -0.05, 0.08]
    axis, spin = np.array([0.6, 0.0, 0.8]), np.array([0.3, -1.0, 2.0])
    body = {"mass": 1.0, "inertia": tensor, "angular_velocity": spin.tolist()}
    pin = {
        "type": "revolute", "between": ["ground", "a"], "at": [[0.0, 0.0, 0.0], "centre"], "axis": axis.tolist()
    }  # fmt: skip
    raw = {"mechanism": {"name": "wheel", "space": "spatial"}, "bodies": {"a": body}, "joints": {"p": pin}}
    run = symgen.Model(validate(raw, "wheel")).simulate(**SHORT)
    xx, yy, zz, xy, xz, yz = tensor
    whole = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    rate = (axis @ whole @ spin) / (axis @ whole @ axis)
    got = [run.v[f"a.{label}"][0] for label in ("wx", "wy", "wz")]
    assert got == pytest.approx(rate * axis, abs=1e-14)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", of_turn(range(1, 16), 15))
def test_random_mechanisms_with_rotors(kind: str, seed: int, tmp_path: Path) -> None:
    mechanism = thrown(geared(kind, seed, slides=False), seed)
    raw = {name: table for name, table in mechanism.raw.items() if name not in ("stops", "forces")}
    joints = raw["joints"].items()
    raw["joints"] = {n: {k: x for k, x in t.items() if k not in ("stop", "friction")} for n, t in joints}
    path = tmp_path / "thrown.toml"
    path.write_text(text(raw), encoding="utf-8")
    state = mechanism.tree.at(0.0, mechanism.u, mechanism.v)
    for coordinates in ("absolute", "joint"):
        run = symgen.load(path).simulate(coordinates=coordinates, **SHORT)
        for name, k in mechanism.bodies.items():
            exact = state.slopes[k] @ mechanism.v
            for label, x in zip("xyz" if kind.startswith("spatial") else "xy", exact, strict=False):
                assert run.v[f"{name}.v{label}"][0] == pytest.approx(x, abs=1e-12)
