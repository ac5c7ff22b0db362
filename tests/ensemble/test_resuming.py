"""Folders of sweeps of other versions, or of other runs: continued where they are the same, refused else."""

import json

import numpy as np
import pytest

import symgen
from symgen.api import Model
from symgen.describe.builder import MechanismBuilder
from symgen.ensemble.table import DONE
from symgen.errors import InputError

PENDULUM = {"vary": {"bob.vy": "lin(0, 1, 9)"}, "until": 0.02}


def content(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.name != "lock"}


def refused(folder, got, model="pendulum", **asked):
    before = content(folder)
    with pytest.raises(
        InputError, match=f"expected the sweep that was begun there, got one {got}; name another output"
    ):
        symgen.sweep(model, output=folder, resume=True, **asked)
    assert content(folder) == before


def test_a_folder_of_an_older_version_is_refused_and_left_as_it_is(tmp_path):
    folder = tmp_path / "runs"
    symgen.sweep("pendulum", output=folder, **PENDULUM)
    now = json.loads((folder / "sweep.json").read_text())
    for older in ({**now, "code": "0" * 64}, {key: x for key, x in now.items() if key != "code"}):
        (folder / "sweep.json").write_text(json.dumps(older))
        refused(folder, "by another version of symgen", **PENDULUM)
    (folder / "sweep.json").write_text(json.dumps({**now, "symgen-sweep": 1}))
    with pytest.raises(InputError, match="expected a sweep of form 2, got one of form 1"):
        symgen.sweep("pendulum", output=folder, resume=True, **PENDULUM)


def test_other_runs_of_the_same_version_are_refused(tmp_path):
    folder = tmp_path / "runs"
    symgen.sweep("pendulum", output=folder, **PENDULUM)
    for asked in ({"stop_when": "bob.y > 0"}, {"coordinates": "joint"}, {"quantities": ("bob.x",)}, {"step": 4e-4}):
        refused(folder, "with another recipe", **PENDULUM, **asked)
    refused(folder, "with another (start|recipe)", start={"bob.vx": 0.1}, **PENDULUM)
    refused(folder, "with another mechanism", model="spherical-double-pendulum", vary={"upper.vx": "lin(0, 1, 9)"})


@pytest.fixture(scope="module")
def cart():
    return Model(
        MechanismBuilder("cart")
        .run(until=0.7, step=0.05)
        .parameter("late", 0.2)
        .input("push", 0.5, unit="N")
        .body("block", type="point", mass=1.0, velocity=(0.0, 0.0))
        .force("all", "force", body="block", force=("push", 0.0))
        .build()
    )


def test_runs_with_events_and_jumps_go_on_and_are_told_apart(cart, tmp_path):
    folder, vary = tmp_path / "runs", {"late": "lin(0.1, 0.4, 7)"}
    asked = {
        "inputs": {"push": "2 if t > late else 0"},
        "stop_when": "block.x > 0.02",
        "method": "lagrange",
        "integrator": "rk4",
    }
    whole = symgen.sweep(cart, vary, **asked)
    symgen.sweep(cart, vary, output=folder, **asked)
    (folder / DONE).write_text("".join(f"{line}\n" for line in (folder / DONE).read_text().splitlines()[:3]))
    again = symgen.sweep(cart, vary, output=folder, resume=True, **asked)
    np.testing.assert_array_equal(again.values, whole.values)
    np.testing.assert_array_equal(again.summary, whole.summary)
    # 2 N from `late` on reach 0.02 m after the root of 0.02 s^2
    np.testing.assert_allclose(again["end"], np.linspace(0.1, 0.4, 7) + np.sqrt(0.02), atol=1e-12)
    changed = {**asked, "inputs": {"push": "2 if t > 2*late else 0"}}
    refused(folder, "with another inputs", model=cart, vary=vary, **changed)
    samples = {**asked, "inputs": {"push": {"t": [0.0, 0.1], "u": [0.0, 2.0], "interpolation": "hold"}}}
    symgen.sweep(cart, vary, output=tmp_path / "samples", **samples)
    samples["inputs"] = {"push": {"t": [0.0, 0.2], "u": [0.0, 2.0], "interpolation": "hold"}}
    refused(tmp_path / "samples", "with another inputs", model=cart, vary=vary, **samples)
