"""Ten runs as they were recorded: status, words, steps and final state, within bounds that every processor keeps.

A change that is meant to move one of them records all anew: ``SYMGEN_UPDATE_OUTCOMES=1 python -m pytest
tests/run/single/test_outcomes.py`` writes ``tests/data/outcomes.json``, whose difference says what has changed.
"""

import json
import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import symgen
from symgen import MechanismBuilder

RECORDED = Path(__file__).resolve().parents[2] / "data" / "outcomes.json"
UPDATE = "SYMGEN_UPDATE_OUTCOMES"
#: Of the largest number in a table, with constant steps; adaptive ones have this many times their tolerance.
ROUNDING, TOLERANCES = 1e-11, 100.0
#: Share by which counts of adaptive steps may differ.
COUNTS = 0.1
#: Behind the point, so that what is nothing but rounding is not recorded.
DIGITS = 14
#: Figures in sentences.
FIGURES = re.compile(r"-?\d+\.?\d*(?:e-?\d+)?")

CONSTANT: Mapping[str, Any] = {"integrator": "rk4", "step": 1e-3, "until": 1.0}
PULSE = {"torque": "4 if t < 0.137 else 0"}
BLOW = {"blow": {"when": "crank.theta < 1", "reset": {"rocker.omega": "rocker.omega + 2"}}}
#: Settings of runs, and of sweeps where something varies.
RUNS: Mapping[str, tuple[str, Mapping[str, Any]]] = {
    "baumgarte": ("four-bar", {"method": "baumgarte"} | CONSTANT),
    "index1-augmented-lagrangian in space": (
        "spatial-slider-crank",
        {"method": "index1-augmented-lagrangian"} | CONSTANT | {"until": 0.3},
    ),
    "direct-correction in joint coordinates": ("four-bar", {"coordinates": "joint", "verify": True} | CONSTANT),
    "an impulse": ("four-bar", {"method": "coordinate-partitioning", "events": BLOW} | CONSTANT),
    "lagrange until an event": (
        "slider-crank",
        {"method": "lagrange", "integrator": "dop853", "stop_when": "crank.theta > 2", "until": 5.0},
    ),
    "a stiff governor": ("flyball-governor", {"method": "lagrange", "integrator": "radau5", "until": 0.1}),
    "auto through singular positions": ("n-four-bar:2", {"method": "auto", "integrator": "auto", "until": 2.0}),
    "an input that jumps": ("arm", {"integrator": "dop853", "coordinates": "joint", "inputs": PULSE, "until": 0.5}),
    "a sweep": ("four-bar", {"vary": {"crank_mass": [1.0, 3.0, -1.0]}, "method": "augmented-lagrangian"} | CONSTANT),
    "a sweep of events": (
        "four-bar",
        {"vary": {"B.angle": [-1.2, -0.8]}, "stop_when": "t > 0.2 + 0.1*crank.omega", "coordinates": "joint"}
        | CONSTANT,
    ),
}


def arm() -> symgen.Mechanism:
    """A rod on a pin, moved by an input."""
    builder = MechanismBuilder("arm", gravity=(0.0, -9.81)).input("torque", 0.0, unit="N m")
    builder = builder.body("arm", mass=1.0, inertia=0.05, points={"hub": (-0.3, 0.0)})
    builder = builder.joint("hub", "revolute", between=("ground", "arm"), at=((0.0, 0.0), "hub"))
    return builder.force("motor", "torque", body="arm", torque="torque").build()


def outcome(name: str) -> dict[str, Any]:
    """Return what a run leaves: words without figures, counts, and tables."""
    model, settings = RUNS[name]
    mechanism = arm() if model == "arm" else model
    if "vary" in settings:
        found = symgen.sweep(mechanism, **settings)
        return {
            "status": found.status.ravel().tolist(),
            "words": [plain([reason, *words]) for reason, words in zip(found.reason, found.warnings, strict=True)],
            "steps": found["steps"].ravel().tolist(),
            "end": found["end"].ravel().tolist(),
            "q": np.round(found.values[:, :9, -1], DIGITS).tolist(),
            "v": np.round(found.values[:, 9:, -1], DIGITS).tolist(),
        }
    run = symgen.simulate(mechanism, shape="straight", **settings)
    return {
        "status": run.status,
        "words": plain([run.reason or "", *run.warnings, *run.notes]),
        "steps": run.steps,
        "end": run.end,
        "q": np.round(run.q.values[-1], DIGITS).tolist(),
        "v": np.round(run.v.values[-1], DIGITS).tolist(),
    }


def plain(sentences: Sequence[str]) -> list[str]:
    """Return sentences without their figures."""
    return [FIGURES.sub("#", sentence) for sentence in sentences]


@pytest.fixture(scope="module")
def recorded() -> dict[str, Any]:
    if os.environ.get(UPDATE):
        lines = (f"{json.dumps(name)}: {json.dumps(outcome(name))}" for name in RUNS)
        RECORDED.write_text("{\n" + ",\n".join(lines) + "\n}\n")
    return json.loads(RECORDED.read_text())


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases(
    "a stiff governor", "a sweep of events", "index1-augmented-lagrangian in space", "auto through singular positions"
)
@pytest.mark.parametrize("name", RUNS)
def test_runs_end_as_recorded(name, recorded):
    settings, expected, found = RUNS[name][1], recorded[name], outcome(name)
    constant = "step" in settings
    assert (found["status"], found["words"]) == (expected["status"], expected["words"])
    few = 0.0 if constant else max(1.0, COUNTS * expected["steps"])
    np.testing.assert_allclose(found["steps"], expected["steps"], rtol=0.0, atol=few)
    for table in ("end", "q", "v"):
        size = np.nanmax(np.abs(expected[table]))
        bound = (ROUNDING if constant else TOLERANCES * settings.get("rtol", 1e-8)) * size
        np.testing.assert_allclose(found[table], expected[table], rtol=0.0, atol=bound, err_msg=table)
