"""Eight discs in a bin and five boxes on each other beside MuJoCo: processor times of warm loops, and what sinks.

python -m benchmarks.beside_mujoco

writes ``docs/tables/mujoco.md``. Both tools begin with the same places (`benchmarks.beside_siconos`) and run until all
bodies rest. Discs are spheres in MuJoCo, whose centres stay in the plane; boxes have the corners that touch. How deep
bodies sink is the least distance of a contact at the end, symgen's by the gaps of its file.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Mapping
from pathlib import Path
from textwrap import fill
from typing import Any

import numpy as np

import symgen
from benchmarks.beside_siconos import text_of
from benchmarks.peers.mujoco_contacts import VERSION, run_of

PAGE = Path(__file__).resolve().parents[1] / "docs" / "tables" / "mujoco.md"
UNTIL = {"discs 8": 3.0, "dropped 5": 1.0}
REPEATS = 5
#: Settings of MuJoCo: its own, small steps, and these with contacts as stiff as the steps allow.
THEIRS: dict[str, dict[str, float]] = {
    "step 2 ms, as it comes": {"step": 2e-3, "time": 0.02},
    "step 0.1 ms": {"step": 1e-4, "time": 0.02},
    "step 0.1 ms, stiff": {"step": 1e-4, "time": 2e-4},
}
#: Settings of symgen.
OWN: dict[str, Mapping[str, Any]] = {"as it comes": {}, "rk4, step 1 ms": {"integrator": "rk4", "step": 1e-3}}

_PROSE = (
    f"Written by `python -m benchmarks.beside_mujoco` (MuJoCo {VERSION}): processor time of a warm run with all "
    f"of its Python [s], the least of {REPEATS} on a machine shared with other work, how deep bodies have sunk "
    "into each other at the end [m], and the largest speed there [m/s, rad/s]. Eight discs (52 contacts) fall "
    "into a bin for 3 s; five boxes of 0.2 m (10 contacts) that fall by 1 mm each lie on each other after 1 s. "
    "Contacts of MuJoCo are soft: `solref` says how deep they are, and stiff ones take small steps. Those of "
    "symgen do not sink."
)


def own(scene: str, setting: Mapping[str, Any]) -> tuple[float, float, float]:
    """Return symgen's processor time of a loop [s], the least gap and the largest speed at the end."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.toml"
        path.write_text(text_of(scene), encoding="utf-8")
        model = symgen.load(path)
    until, seconds = UNTIL[scene], list[float]()
    for _ in range(1 + REPEATS):
        began = time.process_time()
        run = model.simulate(until=until, times=[0.0, until], verify=False, **setting)
        seconds.append(time.process_time() - began)
        if not run.ok:
            raise RuntimeError(f"{scene}: {run.reason}")
    gaps = [run[f"{contact.name}.gap"][-1] for contact in model.mechanism.bounded if contact.one_sided]
    return min(seconds[1:]), float(min(gaps)), float(np.abs(run.v.values[-1]).max())


def theirs(scene: str, setting: Mapping[str, float]) -> tuple[float, float, float]:
    """Return MuJoCo's processor time of a run [s], the least distance of a contact and the largest speed at the end."""
    return run_of(scene, UNTIL[scene], setting["step"], setting["time"], REPEATS)


def page() -> str:
    """Return the page."""
    lines = [
        "# Contacts beside MuJoCo",
        "",
        *fill(_PROSE, 112, break_on_hyphens=False).split("\n"),
        "",
        "| scene | tool | setting | seconds | sunk | speed |",
        "| --- | --- | --- | --- | --- | --- |",
    ]
    for scene in UNTIL:
        for tool, settings, measure in (("symgen", OWN, own), ("MuJoCo", THEIRS, theirs)):
            for name, setting in settings.items():
                seconds, least, speed = measure(scene, setting)
                lines.append(f"| {scene} | {tool} | {name} | {seconds:.2g} | {max(0.0, -least):.1e} | {speed:.0e} |")
                print(lines[-1], flush=True)
    return "\n".join([*lines, ""])


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
