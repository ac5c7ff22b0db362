"""Discs in a bin, boxes on each other and a quadruped beside MuJoCo: processor times of warm loops, and what sinks.

python -m benchmarks.beside_mujoco

writes ``docs/tables/mujoco.md``. Both tools begin with the same places (`benchmarks.beside_siconos`) and run until all
bodies rest. Discs are spheres in MuJoCo, whose centres stay in the plane; boxes have the corners that touch. How deep
bodies sink is the least distance of a contact at the end, symgen's by the gaps of its file. The quadruped is one file
of MuJoCo, which symgen imports.
"""

from __future__ import annotations

import math
import os
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path
from textwrap import fill
from typing import Any

import numpy as np

import symgen
from benchmarks.beside_siconos import text_of
from benchmarks.peers.mujoco_contacts import VERSION, run_of, standing
from symgen.describe.files.validate import validate
from symgen.describe.formats import read_robot

PAGE = Path(__file__).resolve().parents[1] / "docs" / "tables" / "mujoco.md"
QUADRUPED = Path(__file__).resolve().parent / "mechanisms" / "quadruped.xml"
#: Seconds between which the feet of a quadruped are watched, which has come to stand.
STANDS = 5.0, 10.0
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
_STANDING = (
    "A quadruped of 13 bodies with the masses and lengths that Unitree publishes of its A1 stands on four feet, its "
    "joints held by `position` actuators: processor time to a first result of symgen, from an empty cache, and of "
    f"1 s after that, how deep feet have sunk at {STANDS[1]:g} s, and how far they have crept since "
    f"{STANDS[0]:g} s [m]. Both tools read one file, symgen with `symgen import --contacts ground`."
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


def stand() -> tuple[float, float, float, float]:
    """Return symgen's processor times to a first result and of a warm second, the least gap, and how far feet creep."""
    began = time.process_time()
    model = symgen.Model(validate(read_robot(QUADRUPED, "mjcf", contacts=True).raw, QUADRUPED.name))
    seconds = list[float]()
    for _ in range(1 + REPEATS):
        model.simulate(until=1.0, times=[0.0, 1.0], verify=False)
        seconds.append(time.process_time() - began)
        began = time.process_time()
    run = model.simulate(until=STANDS[1], times=[0.0, *STANDS], verify=False)
    if not run.ok:
        raise RuntimeError(f"quadruped: {run.reason}")
    feet = [contact.name for contact in model.mechanism.bounded if contact.one_sided]
    gaps = [run[f"{foot}.gap"][-1] for foot in feet]
    places = [[run[f"{foot.removesuffix('_contact')}.{axis}"][1:] for axis in "xy"] for foot in feet]
    return seconds[0], min(seconds[1:]), float(min(gaps)), max(math.hypot(*map(np.ptp, place)) for place in places)


def page() -> str:
    """Return the page."""
    with tempfile.TemporaryDirectory() as folder:
        os.environ["SYMGEN_CACHE_DIR"] = folder  # nothing is compiled before
        first, own_second, depth, creep = stand()
    del os.environ["SYMGEN_CACHE_DIR"]
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
    lines += ["", *fill(_STANDING, 112, break_on_hyphens=False).split("\n"), ""]
    lines += ["| tool | setting | first result | seconds | sunk | creep |", "| --- | --- | --- | --- | --- | --- |"]
    lines.append(f"| symgen | as it comes | {first:.2g} | {own_second:.2g} | {max(0.0, -depth):.1e} | {creep:.0e} |")
    for name, setting in THEIRS.items():
        seconds, least, moved = standing(QUADRUPED, setting["step"], setting["time"], STANDS)
        lines.append(f"| MuJoCo | {name} | | {seconds:.2g} | {max(0.0, -least):.1e} | {moved:.0e} |")
    return "\n".join([*lines, ""])


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
