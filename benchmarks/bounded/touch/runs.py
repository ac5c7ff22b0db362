"""Runs of symgen beside the simulation of a scene, and what is to be said of each."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.bounded.touch.bodies import Array
from benchmarks.bounded.touch.modes import Unsolved
from benchmarks.bounded.touch.motion import Ended, Motion, run
from benchmarks.bounded.touch.scenes import Drawn
from benchmarks.mechanisms.toml import text

UNTIL, OUTPUTS = 1.0, 20
#: Disturbance of a start, and largest growth of it that is of use.
DISTURBANCE, GROWS = 1e-8, 1e3
#: What a run may be off by, times the growth of disturbances: with tight tolerances, and with usual ones.
TIGHT, USUAL = 1e-8, 1e-6
#: Rates below which impacts do not spring back, and bodies rest [m/s], where finer ones do not end.
_COARSE = 2e-6, 6e-6
RUNS: dict[str, tuple[Mapping[str, Any], float]] = {
    "default": ({}, USUAL),
    "dop853": ({"integrator": "dop853", "rtol": 1e-11, "atol": 1e-12, "verify": False}, TIGHT),
    "joint": ({"integrator": "dop853", "rtol": 1e-11, "atol": 1e-12, "verify": False, "coordinates": "joint"}, TIGHT),
}


@dataclass
class Reference:
    """The simulation's motion of a scene: places of all bodies at times, the growth of disturbances, and events."""

    times: Array
    places: Array
    growth: float
    events: list[tuple[float, str, int]]


@dataclass
class Verdict:
    """What became of a run: ``right``, ``WRONG`` (and `ok`), ``unverified``, ``failed``, ``sentence`` or ``raised``."""

    outcome: str
    error: float
    reason: str = ""


def reference(scene: Drawn, until: float = UNTIL) -> Reference:
    """Return the simulation of a scene, over half of the time as often as disturbances grow too much.

    Raises
    ------
    Unsolved, Ended
        If there is none that serves.
    """
    for _ in range(4):
        times = np.linspace(0.0, until, OUTPUTS + 1)
        try:
            motion, growth = _disturbed(scene, times)
        except Ended:
            if (scene.scene.slow, scene.scene.turns) == _COARSE:
                raise
            scene.scene.slow, scene.scene.turns = _COARSE
            motion, growth = _disturbed(scene, times)
        if growth <= GROWS:
            return Reference(times, np.array(motion.q), growth, motion.events)
        until *= 0.5
    raise Ended(f"disturbances grow {growth:.2g} times")


def _disturbed(scene: Drawn, times: Array) -> tuple[Motion, float]:
    """Return the motion, and how much disturbances of its start grow."""
    motion, growth = run(scene.scene, scene.q, scene.v, times.tolist()), 1.0
    for way in (1.0, -1.0):
        try:
            other = run(scene.scene, scene.q, scene.v * (1.0 + way * DISTURBANCE), times.tolist())
        except Unsolved:
            growth = np.inf
        else:
            growth = max(growth, float(np.abs(np.array(other.q) - np.array(motion.q)).max()) / DISTURBANCE)
    return motion, growth


def compared(name: str, scene: Drawn, against: Reference | None, until: float = UNTIL) -> Verdict:
    """Return the verdict of a run; without a reference only a sentence is right, or an end with one."""
    import symgen

    settings, most = RUNS[name]
    times = np.linspace(0.0, until, OUTPUTS + 1) if against is None else against.times
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.toml"
        path.write_text(text(scene.raw), encoding="utf-8")
        try:
            result = symgen.load(path).simulate(until=float(times[-1]), times=times, **settings)
        except symgen.SymgenError as refusal:
            return Verdict("sentence", float("nan"), str(refusal))
        except Exception as other:  # whatever else is raised is looked for here
            return Verdict("raised", float("nan"), f"{type(other).__name__}: {other}")
    reason = "; ".join([result.reason or "", *result.warnings])
    if against is None:
        return Verdict("unsolved" if result.status == "ok" else result.status, float("nan"), reason)
    labels = [f"{body}.{x}" for body in scene.raw["bodies"] for x in ("x", "y", "theta")]
    found = np.array([result[label] for label in labels]).T
    count = min(len(found), len(against.places))
    error = float(np.abs(found[:count] - against.places[:count]).max())
    if result.status != "ok":
        return Verdict(result.status, error, reason)
    return Verdict("right" if error <= most * against.growth and count == len(times) else "WRONG", error, reason)
