"""Dynamics as functions beside Pinocchio and MuJoCo: a call from Python, and an evaluation alone, in turns in one run.

    ROBOTS=FOLDER python -m benchmarks.functions

measures the record anew and prints its table; ``ROBOTS`` is ``robots`` of `example-robot-data`, which is found where
`pip install example-robot-data` has put it. Evaluations alone are those of one call with many states, and for the
others those of a loop in C that enters their compiled libraries. A round takes all tools one after the other; ratios
are those of rounds, as quartiles. MuJoCo and Pinocchio are their wheels.
"""

from __future__ import annotations

import os
import random
import re
import statistics
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from benchmarks.closed_leg import MJCF, URDF, leg
from benchmarks.page_tables import KEPT, PageTable
from benchmarks.peers.functions_peer import (
    CALLS,
    FUNCTIONS,
    Batch,
    State,
    Subject,
    add_mujoco,
    add_pinocchio,
    called,
    versions,
)
from benchmarks.records import Line, Pair, Record, measure
from symgen.api import load

#: Files of robots by their names here, from the folder of `example-robot-data`.
ROBOTS = {
    "UR5": "ur_description/urdf/ur5_robot.urdf",
    "Panda": "panda_description/urdf/panda.urdf",
    "Talos": "talos_data/robots/talos_reduced.urdf",
}
LEG = "four-bar leg"
#: Coordinates of all states of one call of symgen's, rounds, and the processor time of a robot [s].
COORDINATES, ROUNDS, PATIENCE = 24_000, 300, 900.0
HEADINGS = (
    *("model", "velocities", "function", "symgen: called, alone [us]", "Pinocchio", "over symgen's: called, alone"),
    *("MuJoCo", "over symgen's: called, alone"),
)
#: What Pinocchio and MuJoCo do not read: meshes, and joints that follow others.
_PARTS = re.compile(r"<(visual|collision|mimic)\b(?:[^>]*/>|.*?</\1>)", re.DOTALL)
_COMPILER = '<mujoco><compiler fusestatic="true" boundmass="0"/>{}</mujoco></robot>'
_FLAGS = '<option><flag contact="disable" constraint="disable"/></option>'


class Job(NamedTuple):
    """What is measured."""

    model: str


def folder() -> Path:
    """Return the folder of robots."""
    own = os.environ.get("ROBOTS")
    below = "cmeel.prefix/share/example-robot-data/robots"
    installed = next((Path(x) / below for x in sys.path if (Path(x) / below).is_dir()), None)
    if own is None and installed is None:
        raise SystemExit("functions: expected files of robots, got none; pip install example-robot-data, or set ROBOTS")
    return Path(own) if own is not None else installed or Path()


def subject(name: str) -> Subject:
    """Return a robot."""
    if name == LEG:
        return Subject(leg(), URDF, MJCF, True)
    text = _PARTS.sub("", (folder() / ROBOTS[name]).read_text(encoding="utf-8"))
    with tempfile.TemporaryDirectory() as place:
        (path := Path(place) / "robot.urdf").write_text(text, encoding="utf-8")
        model = load(path)
    return Subject(model, text, text.replace("</robot>", _COMPILER.format(_FLAGS)), False)


def batches(name: str) -> tuple[int, dict[str, dict[str, Batch]], dict[str, float]]:
    """Return the number of velocities, batches by function and tool, and how far accelerations are apart."""
    own = subject(name)
    f = own.model.functions("joint")
    n, rng = len(f.velocities), np.random.default_rng(0)
    q, v, a, effort = rng.uniform(-1.0, 1.0, (4, n))
    if own.loop:
        q = f.start[0]
        v = f.reduction(q, ["thigh.omega", "lever.omega"])[1] @ v[:2]
    state = State(q, v, a, effort)
    arguments = {"mass_matrix": (q,), "bias": (q, v), "forward_dynamics": (q, v, effort), "inverse_dynamics": (q, v, a)}
    table = {key: dict[str, Batch]() for key in FUNCTIONS if not own.loop or FUNCTIONS[key][1]}
    for key, row in table.items():
        function, given = getattr(f, key), arguments[key]
        states = COORDINATES // n
        many = [np.tile(x, (states, 1)) for x in given]
        row["symgen"] = called(function, *given), CALLS
        row["symgen, alone"] = called(function, *many, count=1), states
    names = [x.name.partition(".")[0] for x in f.velocities]
    apart = dict[str, float]()
    still = state._replace(v=0.0 * v)  # files have dampers, which Pinocchio does not read
    wanted = f.forward_dynamics(still.q, still.v, still.effort)
    for tool, add in (("pinocchio", add_pinocchio), ("mujoco", add_mujoco)):
        accelerations, ways = add(own, names, state, table)
        other = accelerations(still.along(ways))
        apart[tool] = float(np.abs(other - ways @ wanted).max() / np.abs(wanted).max())
    return n, table, apart


def examine(job: Job) -> dict[str, Any]:
    """Return times [us] and quartiles of ratios by function and tool."""
    n, table, apart = batches(job.model)
    return {
        "velocities": n,
        "versions": versions(),
        "apart": apart,
        "functions": {k: timed(x) for k, x in table.items()},
    }


def timed(row: dict[str, Batch], rounds: int = ROUNDS) -> dict[str, dict[str, Any]]:
    """Return least times [us] of batches in turns, and quartiles of times over those of symgen."""
    times: dict[str, list[float]] = {tool: [] for tool in row}
    for batch, _ in row.values():
        batch()
    for _ in range(rounds):
        for tool, (batch, count) in row.items():
            began = time.perf_counter()
            batch()
            times[tool].append(1e6 * (time.perf_counter() - began) / count)
    result = {tool: dict[str, Any](us=min(own)) for tool, own in times.items()}
    for tool, own in times.items():
        base = times["symgen, alone" if tool.endswith("alone") else "symgen"]
        result[tool]["over"] = statistics.quantiles([a / b for a, b in zip(own, base, strict=True)], n=4)
    return result


def again(stored: Line, dice: random.Random) -> Iterator[Pair]:
    """Yield what needs no other program: the number of velocities of the leg."""
    if stored["model"] == LEG:
        yield Pair(LEG, stored["velocities"], len(leg().functions("joint").velocities))


RECORD = Record("functions", lambda: map(Job, (*ROBOTS, LEG)), examine, again, PATIENCE, share=1.0)


# -- the table ---------------------------------------------------------------------------------------------------------


def cells(model: str, function: str) -> list[str]:
    """Return the cells of a line of the table."""
    line = next((line for line in RECORD.lines() if line["model"] == model and "functions" in line), None)
    if line is None:
        return [KEPT] * 5
    row, loop = line["functions"][function], model == LEG
    theirs = {"pinocchio": FUNCTIONS[function][1 if loop else 0], "mujoco": FUNCTIONS[function][2]}
    own = [f"{row['symgen']['us']:.2g}, {row['symgen, alone']['us']:.2g}"]
    for tool, name in theirs.items():
        times = [row[key] for key in (tool, f"{tool}, alone") if key in row]
        numbers = ", ".join(f"{x['us']:.2g}" for x in times)
        own.append(f"`{name}`: {numbers}" if times else "")
        own.append(", ".join(_ratio(*x["over"]) for x in times))
    return own


def _ratio(low: float, middle: float, high: float) -> str:
    """Return a ratio with its quartiles."""
    return f"{middle:.2g} ({low:.2g} to {high:.2g})"


def tables() -> tuple[PageTable, ...]:
    """Return the table of the page of robots."""
    velocities = {line["model"]: str(line.get("velocities", KEPT)) for line in RECORD.lines()}
    rows = []
    for model in (*ROBOTS, LEG):
        for function in FUNCTIONS:
            if model != LEG or FUNCTIONS[function][1]:
                names = model, velocities.get(model, KEPT), f"`{function}`"
                rows.append((names, lambda model=model, function=function: cells(model, function)))
    return (PageTable("functions", "docs/tables/robots.md", HEADINGS, tuple(rows), stored=True, claims=claims),)


def claims() -> Iterator[str]:
    """Yield the sentence of the page on how far accelerations are apart, and on the versions."""
    lines = [line for line in RECORD.lines() if "functions" in line]
    if len(lines) == len(ROBOTS) + 1:
        trees = [line["apart"] for line in lines if line["model"] != LEG]
        (loop,) = (line["apart"] for line in lines if line["model"] == LEG)
        most = {tool: max(x[tool] for x in trees) for tool in loop}
        versions = lines[0]["versions"]
        yield (
            f"Accelerations of trees are {most['pinocchio']:.0e} of the largest from those of Pinocchio"
            f" {versions['pinocchio']} and {most['mujoco']:.0e} from those of MuJoCo {versions['mujoco']}, those of the"
            f" leg {loop['pinocchio']:.0e} and {loop['mujoco']:.0e}."
        )


def main() -> None:
    """Measure the record anew and print its table."""
    RECORD.path.unlink(missing_ok=True)
    measure(examine, RECORD.jobs(), RECORD.path, PATIENCE)
    for table in tables():
        for row in table.measured():
            print(" | ".join(row))
    print(*claims(), sep="\n")


if __name__ == "__main__":
    main()
