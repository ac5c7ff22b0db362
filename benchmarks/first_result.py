"""Time to the first result of a planar four-bar that was never seen before: whole processes, from start to exit.

Three situations: nothing compiled on this machine; the runtime's loops compiled but the model new; everything warm.
Each is repeated in fresh processes; cold ones each get an empty cache folder, and every new model has numbers of its
own, so that its digest is new.

    python -m benchmarks.first_result [--repeat 5]
"""

from __future__ import annotations

import argparse
import json
import os
import random
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from rich.table import Table

from benchmarks.show import show

OPTIONS = ("--method", "direct-correction", "--integrator", "rk4", "--step", "1e-3", "--until", "10", "--json")
STAGES = ("derive", "emit", "compile", "run")


@dataclass(frozen=True)
class Timed:
    """Seconds of one process by the clock and of the processor, and of the stages it reports."""

    wall: float
    processor: float
    stages: tuple[float, ...]


def four_bar(path: Path) -> Path:
    """Write a four-bar with numbers that no earlier one had; return its path."""
    ground, crank, coupler, rocker = (x + random.uniform(-0.2, 0.2) for x in (10.0, 2.0, 8.0, 5.0))
    bodies = []
    for name, length, angle, ends in (
        ("crank", crank, 1.0471975511965976, "AB"),
        ("coupler", coupler, 0.38564124740737094, "BC"),
        ("rocker", rocker, 1.8938968124057762, "DC"),
    ):
        at = {"crank": (0.5, 0.87), "coupler": (4.7, 3.24), "rocker": (9.2, 2.37)}[name]
        bodies.append(
            f"[bodies.{name}]\nmass = {length!r}\ninertia = {length**3 / 12!r}\n"
            f"points = {{ {ends[0]} = [{-length / 2!r}, 0.0], {ends[1]} = [{length / 2!r}, 0.0] }}\n"
            f"position = [{at[0]}, {at[1]}]\nangle = {angle}\n"
            + ("angular_velocity = 0.0\n" if name == "crank" else "")
        )
    joints = (
        '[joints.A]\ntype = "revolute"\nbetween = ["ground", "crank"]\nat = [[0.0, 0.0], "A"]\n'
        '[joints.B]\ntype = "revolute"\nbetween = ["crank", "coupler"]\nat = ["B", "B"]\n'
        '[joints.C]\ntype = "revolute"\nbetween = ["coupler", "rocker"]\nat = ["C", "C"]\n'
        f'[joints.D]\ntype = "revolute"\nbetween = ["ground", "rocker"]\nat = [[{ground!r}, 0.0], "D"]\n'
    )
    head = '[mechanism]\nname = "some-four-bar"\ngravity = [0.0, -9.81]\n'
    path.write_text("\n".join([head, *bodies, joints]), encoding="utf-8")
    return path


def timed(cache: Path, *arguments: str, stages: bool = True) -> Timed:
    """Run one `symgen` process and time it from start to exit."""
    program = Path(sys.executable).with_name("symgen")
    environment = {**os.environ, "SYMGEN_CACHE_DIR": str(cache)}
    began, used = time.perf_counter(), _processor()
    done = subprocess.run([program, *arguments], capture_output=True, text=True, env=environment, check=False)
    wall, processor = time.perf_counter() - began, _processor() - used
    if done.returncode:
        raise SystemExit(f"symgen {' '.join(arguments)} failed: {done.stderr.strip() or done.stdout.strip()}")
    seconds = json.loads(done.stdout)["seconds"] if stages else {}
    return Timed(wall, processor, tuple(float(seconds[stage]) for stage in STAGES) if stages else ())


def _processor() -> float:
    """Return the seconds of the processor that all ended children of this process have used."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def measure(folder: Path, repeat: int) -> dict[str, list[Timed]]:
    """Return the processes of each situation."""
    timings: dict[str, list[Timed]] = {"symgen --help": [], "everything cold": [], "model new": [], "warm": []}
    shared = folder / "shared"
    timed(shared, "--help", stages=False)  # byte code of symgen itself is not what is measured
    timed(shared, "run", str(four_bar(folder / "first.toml")), *OPTIONS)
    for i in range(repeat):
        timings["symgen --help"].append(timed(shared, "--help", stages=False))
        cold = four_bar(folder / f"cold{i}.toml")
        timings["everything cold"].append(timed(folder / f"empty{i}", "run", str(cold), *OPTIONS))
        new = four_bar(folder / f"new{i}.toml")
        timings["model new"].append(timed(shared, "run", str(new), *OPTIONS))
        timings["warm"].append(timed(shared, "run", str(new), *OPTIONS))
    return timings


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.first_result", description=__doc__)
    parser.add_argument("--repeat", type=int, default=5, help="processes for each situation")
    options = parser.parse_args(arguments)
    with tempfile.TemporaryDirectory() as folder:
        timings = measure(Path(folder), options.repeat)
    table = Table(title=f"time to the first result of a four-bar, whole processes, median of {options.repeat} [s]")
    for column in ("situation", "process", "spread", "processor", *STAGES, "start-up and the rest"):
        table.add_column(column, justify="left" if column == "situation" else "right")
    for situation, runs in timings.items():
        walls = [r.wall for r in runs]
        cells = [f"{statistics.median(walls):.2f}", f"{min(walls):.2f} .. {max(walls):.2f}"]
        cells.append(f"{statistics.median(r.processor for r in runs):.2f}")
        if runs[0].stages:
            stages = [statistics.median(r.stages[i] for r in runs) for i in range(len(STAGES))]
            rest = statistics.median(r.wall - sum(r.stages) for r in runs)
            cells += [*(f"{s:.3f}" for s in stages), f"{rest:.2f}"]
        table.add_row(situation, *cells)
    show(table)


if __name__ == "__main__":
    main()
