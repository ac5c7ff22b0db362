"""Frequencies about rest and equilibria: answers and times of symgen, and of Exudyn, MuJoCo and SymPy.

    python -m benchmarks.analyses [--peers-python PATH | --peers-json FILE]

What is asked, and what errors are, stands in ``benchmarks/peers/analyses.py``. Of symgen ``seconds`` is the question
asked of a model that stands at its place, ``call`` the whole of `model.modes()` with its search for the equilibrium,
from the cache.
"""

from __future__ import annotations

import argparse
import json
import math
import subprocess
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from rich.table import Table

import symgen
from benchmarks.peers.analyses import CATENARY, CHAINS, FOUR_BAR, GRAVITY, SLOPE, places
from benchmarks.show import show
from symgen.analyses.linear.eigenmodes import modes_about
from symgen.analyses.linear.named_places import NamedPlace, subject_at
from symgen.base.settings import Settings

ROOT = Path(__file__).resolve().parents[1]
LARGE = 1000
REPEATS = 3


def chain(n: int) -> symgen.Model:
    """Return point masses of 1 kg on massless links of 1 m, hanging."""
    builder = symgen.MechanismBuilder(f"chain-{n}", gravity=(0.0, -GRAVITY))
    for i in range(n):
        builder.body(f"m{i}", type="point", mass=1.0, position=(0.0, -1.0 - i))
        before = ("ground", (0.0, 0.0)) if i == 0 else (f"m{i - 1}", "centre")
        builder.joint(f"l{i}", "distance", between=(before[0], f"m{i}"), at=(before[1], "centre"), length=1.0)
    return symgen.Model(builder.build())


def rods(kind: str) -> symgen.Model:
    """Return the hanging rod, or the four-bar at rest."""
    builder = symgen.MechanismBuilder(kind, gravity=(0.0, -GRAVITY))
    if kind == "rod":
        ends = {"A": (-0.5, 0.0)}
        builder.body("rod", mass=2.0, inertia=2.0 / 12.0, position=(0.0, -0.5), angle=-math.pi / 2, points=ends)
        builder.joint("pin", "revolute", between=("ground", "rod"), at=((0.0, 0.0), "A"))
        return symgen.Model(builder.build())
    for name, mass, place, angle in zip(("crank", "coupler", "rocker"), (1.0, 3.0, 3.0), *places(), strict=True):
        points = {"A": (-0.5 * mass, 0.0), "B": (0.5 * mass, 0.0)}
        inertia = mass**3 / 12.0
        builder.body(name, mass=mass, inertia=inertia, position=tuple(place), angle=angle, points=points)
    for name, a, b, at in (
        ("A", "ground", "crank", ((0.0, 0.0), "A")),
        ("B", "crank", "coupler", ("B", "A")),
        ("C", "coupler", "rocker", ("B", "B")),
        ("D", "ground", "rocker", ((4.0, 0.0), "A")),
    ):
        builder.joint(name, "revolute", between=(a, b), at=at)
    return symgen.Model(builder.build())


def catenary(n: int = 10) -> symgen.Model:
    """Return links of 2 m in all on pins 1 m apart, in a V that closes."""
    builder, half, x, y = symgen.MechanismBuilder("catenary", gravity=(0.0, -GRAVITY)), 1.0 / n, 0.0, 0.0
    for i in range(n):
        angle = -SLOPE if i < n // 2 else SLOPE
        place = (x + half * math.cos(angle), y + half * math.sin(angle))
        ends = {"A": (-half, 0.0), "B": (half, 0.0)}
        inertia = 2 * half * (2 * half) ** 2 / 12
        builder.body(f"l{i}", mass=2 * half, inertia=inertia, position=place, angle=angle, points=ends)
        before = ("ground", (0.0, 0.0)) if i == 0 else (f"l{i - 1}", "B")
        builder.joint(f"j{i}", "revolute", between=(before[0], f"l{i}"), at=(before[1], "A"))
        x, y = x + 2 * half * math.cos(angle), y + 2 * half * math.sin(angle)
    builder.joint("end", "revolute", between=("ground", f"l{n - 1}"), at=((1.0, 0.0), "B"))
    return symgen.Model(builder.build())


def fastest(call: Callable[[], Any]) -> tuple[float, Any]:
    """Return the least time of a few calls behind a first one, and the answer."""
    call()
    best, answer = math.inf, None
    for _ in range(REPEATS):
        start = time.perf_counter()
        answer = call()
        best = min(best, time.perf_counter() - start)
    return best, answer


def own() -> list[dict[str, Any]]:
    """Return symgen's rows."""
    from scipy.special import roots_laguerre

    rows = []
    for problem, model, truth in (
        ("rod", rods("rod"), np.array([1.5 * GRAVITY])),
        *((f"chain of {n}", chain(n), GRAVITY * roots_laguerre(n)[0]) for n in (*CHAINS, 100)),
        ("four-bar", rods("four-bar"), np.array([FOUR_BAR[1]])),
    ):
        for coordinates in ("absolute", "joint"):
            settings = Settings(coordinates=coordinates)
            subject, y = subject_at(NamedPlace(model.mechanism, settings, "equilibrium", model.simulate))
            seconds, result = fastest(partial(modes_about, subject, y))
            call, _ = fastest(partial(model.modes, coordinates=coordinates))
            error = float(np.abs(result.omega_squared / truth - 1.0).max())
            way = f"modes, {coordinates} coordinates"
            rows.append({"problem": problem, "way": way, "error": error, "seconds": seconds, "call": call})
    for n in (100, LARGE):
        model = chain(n)
        call, result = fastest(partial(model.modes, count=10))
        error = math.nan
        if n == 100:
            error = float(np.abs(result.omega_squared / (GRAVITY * roots_laguerre(n)[0][:10]) - 1.0).max())
        rows.append({"problem": f"chain of {n}", "way": "modes(count=10), sparse", "error": error, "call": call})
        call, _ = fastest(partial(model.equilibrium, shape="looped"))
        rows.append({"problem": f"chain of {n}", "way": "equilibrium, sparse", "error": math.nan, "call": call})
    model = catenary()
    for shape in ("straight", "looped"):
        call, rest = fastest(partial(model.equilibrium, shape=shape))
        error = abs(rest.q["l0.theta"] / CATENARY - 1.0)
        way = f"equilibrium, {shape}, {rest.iterations} steps"
        rows.append({"problem": "catenary", "way": way, "error": error, "call": call})
    return [{"peer": "symgen", "version": symgen.__version__, **row} for row in rows]


def main() -> None:
    """Print one table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--peers-python", type=Path, default=ROOT / ".bench-venv" / "bin" / "python")
    parser.add_argument("--peers-json", type=Path)
    options = parser.parse_args()
    rows = own()
    if options.peers_json is not None:
        rows += json.loads(options.peers_json.read_text())
    elif options.peers_python.exists():
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "rows.json"
            command = [str(options.peers_python), "-m", "benchmarks.peers.analyses", "--json", str(path)]
            subprocess.run(command, check=True, cwd=ROOT, stdout=subprocess.DEVNULL)
            rows += json.loads(path.read_text())
    table = Table("problem", "who", "way", "error", "ms", "whole call [ms]")
    for row in sorted(rows, key=lambda row: row["problem"]):
        numbers = [row.get("error"), *(None if (s := row.get(k)) is None else 1e3 * s for k in ("seconds", "call"))]
        shown = ["" if x is None or x != x else f"{x:.2g}" for x in numbers]
        table.add_row(row["problem"], f"{row['peer']} {row['version']}", row["way"], *shown)
    show(table)


if __name__ == "__main__":
    main()
