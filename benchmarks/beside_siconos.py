"""Stacks of boxes, discs in a bin and a gripper beside Siconos: errors and processor times of loops at three steps.

python -m benchmarks.beside_siconos [ROWS]

measures symgen and takes Siconos' rows from a file that `benchmarks/peers/siconos_peer.py` has written, stores both in
``benchmarks/records/beside_siconos.jsonl`` and writes ``docs/tables/siconos.md``; without ROWS, the page from the
record. Stacks are over their closed forms: an upper box of 1 kg that 3 N push slides with 3 - mu g, boxes that fall by
1 mm each lie on each other. Discs are over symgen at 1e-12, 0.2 s after they were dropped; the gripper of smooth pins,
whose finger bounces to rest, over the event-driven simulation of `benchmarks.bounded.rubbing`.
"""

from __future__ import annotations

import json
import sys
import tempfile
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import symgen
from benchmarks.bounded.rubbing.beside import reference as simulated
from benchmarks.bounded.rubbing.machines import gripper

Array = NDArray[np.float64]
ROOT = Path(__file__).resolve().parents[1]
RECORD, PAGE = ROOT / "benchmarks" / "records" / "beside_siconos.jsonl", ROOT / "docs" / "tables" / "siconos.md"
G, HALF, RADIUS, MU, BIN_MU, PUSH, DROP = 9.81, 0.1, 0.05, 0.2, 0.3, 3.0, 1e-3
SCENES = {**{f"{scene} {count}": 0.3 for scene in ("pushed", "dropped") for count in (3, 5, 10)}, "discs 8": 0.2}
SCENES["gripper"] = 0.25
#: Settings of symgen: at constant steps, and as it comes.
OWN: dict[str, dict[str, Any]] = {
    **{f"rk4 {step:g}": {"integrator": "rk4", "step": step} for step in (1e-2, 1e-3, 1e-4)},
    "as it comes": {},
}


def text_of(scene: str) -> str:
    """Return the file of a scene."""
    if scene == "gripper":
        return gripper(0.0).text
    kind, count = scene.split()
    text = f'[mechanism]\nname = "{kind}"\ngravity = [0.0, {-G}]\n'
    body = "[bodies.b{}]\nmass = 1.0\ninertia = {}\nposition = [{!r}, {!r}]\n"
    contact = '[contacts.c{}]\nbetween = [{{ body = "b{}", {} }}, {{ {} }}]\nfriction = {}\n'
    drop = DROP if kind == "dropped" else 0.0
    for i in range(int(count)):
        if kind == "discs":
            x, y = 0.12 * (i % 3) + 0.006 * (i // 3), RADIUS + 0.02 + 0.13 * (i // 3)
            text += body.format(i, 0.5 * RADIUS**2, x, y)
            others = ['line = "ground"', 'line = "ground", on = [-0.06, 0.0], normal = [1.0, 0.0]']
            others += ['line = "ground", on = [0.3, 0.0], normal = [-1.0, 0.0]']
            others += [f'body = "b{k}", disc = {RADIUS}' for k in range(i)]
            for k, other in enumerate(others):
                text += contact.format(f"{i}_{k}", i, f"disc = {RADIUS}", other, BIN_MU)
            continue
        text += body.format(i, 2.0 / 3.0 * HALF**2, 0.0, HALF + (2.0 * HALF + drop) * i + drop)
        below = 'line = "ground"' if i == 0 else f'line = "b{i - 1}", on = [0.0, {HALF}]'
        for side, at in (("l", -HALF), ("r", HALF)):
            text += contact.format(f"{i}{side}", i, f"at = [{at}, {-HALF}]", below, MU)
    if kind == "pushed":
        text += f'[forces.push]\ntype = "force"\nbody = "b{int(count) - 1}"\nforce = [{PUSH}, 0.0]\n'
    return text


def ends_of(scene: str, **settings: Any) -> tuple[Array, float]:
    """Return places and angles at the end by symgen, and the processor time of the loop."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.toml"
        path.write_text(text_of(scene), encoding="utf-8")
        until = SCENES[scene]
        run = symgen.load(path).simulate(until=until, times=[0.0, until], verify=False, **settings)
    if not run.ok:
        raise RuntimeError(f"{scene}: {run.reason}")
    bodies = "abcd" if scene == "gripper" else [f"b{i}" for i in range(int(scene.split()[1]))]
    places = [[run[f"{body}.{name}"][-1] for name in ("x", "y", "theta")] for body in bodies]
    return np.array(places), run.seconds.run


@cache
def reference(scene: str) -> Array:
    """Return places and angles at the end."""
    if scene == "gripper":
        ends: Array = simulated(gripper(0.0))[-1].reshape(-1, 3)
        return ends
    kind, count = scene.split()
    if kind == "discs":
        return ends_of(scene, integrator="dop853", rtol=1e-12)[0]
    places = np.array([[0.0, HALF + 2.0 * HALF * i, 0.0] for i in range(int(count))])
    if kind == "pushed":
        places[-1, 0] = 0.5 * (PUSH - MU * G) * SCENES[scene] ** 2
    return places


def error(scene: str, ends: Array) -> float:
    """Return the largest error of a place [m]."""
    return float(np.abs(ends - reference(scene))[:, :2].max())


def measured(theirs: Path) -> Iterator[dict[str, Any]]:
    """Yield the rows of the record."""
    for line in theirs.read_text(encoding="utf-8").splitlines():
        row = json.loads(line)
        away = error(row["scene"], np.array(row.pop("ends")))
        yield {"tool": "Siconos", **row, "error": float(f"{away:.2g}"), "seconds": float(f"{row['seconds']:.2g}")}
    for scene in SCENES:
        for setting, keys in OWN.items():
            ends, seconds = ends_of(scene, **keys)
            away = error(scene, ends)
            row = {"tool": "symgen", "scene": scene, "setting": setting, "step": keys.get("step")}
            yield {**row, "error": float(f"{away:.2g}"), "seconds": float(f"{seconds:.2g}")}


def stored() -> list[dict[str, Any]]:
    """Return the rows of the record."""
    return [json.loads(line) for line in RECORD.read_text(encoding="utf-8").splitlines()]


def page(rows: list[dict[str, Any]]) -> str:
    """Return the page of the rows."""
    columns = dict[tuple[str, str], None]()
    for row in rows:
        columns[
            row["tool"], str(row["setting"]) if row["tool"] == "symgen" else f"{row['setting']}, {row['step']:g}"
        ] = None
    cells = {}
    for row in rows:
        name = row["setting"] if row["tool"] == "symgen" else f"{row['setting']}, {row['step']:g}"
        cells[row["scene"], row["tool"], name] = f"{row['error']:.1e}, {row['seconds']:.2g}"
    lines = [
        "# Contacts beside Siconos",
        "",
        "Written by `python -m benchmarks.beside_siconos`: the largest error of a place [m] and the processor time of",
        "the loop [s], taken once on a machine shared with other work. Boxes of 0.2 m are pushed or dropped onto each",
        "other, eight discs fall into a bin, a gripper of smooth pins closes, and its finger bounces to rest (over an",
        "event-driven simulation). Siconos 4.4 steps by Moreau and Jean's scheme; its settings are the tolerance of",
        "its solver of contacts and whether a stack begins 1 nm deep, then its step [s]. Where a distance begins at 0,",
        "up to rounding, Siconos' contact opens for the first steps, and a stack that rests sinks.",
        "",
        "| tool | setting | " + " | ".join(SCENES) + " |",
        "| --- | --- |" + " --- |" * len(SCENES),
    ]
    for tool, setting in columns:
        values = " | ".join(cells.get((scene, tool, setting), "") for scene in SCENES)
        lines.append(f"| {tool} | {setting} | {values} |")
    return "\n".join([*lines, ""])


if __name__ == "__main__":
    if len(sys.argv) > 1:
        found = list(measured(Path(sys.argv[1])))
        RECORD.write_text("".join(json.dumps(row) + "\n" for row in found), encoding="utf-8")
    PAGE.write_text(page(stored()), encoding="utf-8")
