"""Spatial mechanisms: one right-hand side, what methods cost, and Bricard's six-bar beside other tools.

    python -m benchmarks.space [rhs] [methods] [peers] [--peers-python .bench-venv/bin/python] [--json FILE]

Errors are the largest distance [m] of the joints P1 to P4 over 101 times of 10 s, from a motion that symgen's second
derivation (`symgen.study.references.independent`) and SciPy give, good to 1e-12. All times are processor time: on a
shared machine short loops find quiet moments on the wall clock, and long ones do not.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.table import Table

import symgen
from benchmarks import against_gcc
from benchmarks.page_tables import KEPT, PageTable, list_of, print_tables
from benchmarks.show import show
from symgen.derive.formulate.formulate import formulate
from symgen.derive.lower.law import lower_law
from symgen.derive.lower.model import lower_model
from symgen.run.compiling.method_choice import choose_method
from symgen.study.references.reference import reference_motion as second_derivation
from symgen.study.report.source import RATIOS

ROOT = Path(__file__).resolve().parents[1]
Array = NDArray[np.float64]
#: Errors of the summary [m].
TARGETS = (1e-6, 1e-9)
#: Rod and joint relative to its middle.
JOINTS = ((0, (0.5, 0.0, 0.0)), (1, (0.0, -0.5, 0.0)), (2, (0.0, 0.0, 0.5)), (3, (-0.5, 0.0, 0.0)))
METHODS = (
    *("baumgarte", "augmented-lagrangian", "index1-augmented-lagrangian", "coordinate-partitioning"),
    "direct-correction",
)
#: The methods that the source times.
TIMED = ("baumgarte", "augmented-lagrangian", "direct-correction")
TURNS = 5


def operations(name: str) -> int:
    """Return the floating-point operations of one emitted right-hand side by Lagrange's multipliers."""
    equations = formulate(symgen.load(name).mechanism)
    choice = choose_method("lagrange")
    law = lower_law(equations, lower_model(equations, ""), choice.method, choice.options)
    return next(block.operations for block in law.blocks if block.name == "rhs")


def rhs(names: Sequence[str] = ("bricard", "spatial-slider-crank")) -> Table:
    """Return the table of single evaluations."""
    table = Table(title="one right-hand side by Lagrange's multipliers, emitted code against gcc -O3 -march=native")
    for column in ("mechanism", "operations", "emitted [ns]", "gcc [ns]", "gcc over emitted", "median ratio"):
        table.add_column(column, justify="left" if column == "mechanism" else "right")
    for name in names:
        ours, theirs, ratios = against_gcc.compare(name, against_gcc.FLAGS["-O3 for this machine"])
        cells = (f"{ours:.0f}", f"{theirs:.0f}", f"{theirs / ours:.2f}", f"{np.median(ratios):.2f}")
        table.add_row(name, str(operations(name)), *cells)
    return table


def methods(times: bool = False) -> PageTable:
    """Return costs of methods over `lagrange`, RK4 at the mechanisms' own step, in turns; the source's in brackets."""

    def cells(name: str) -> Iterator[str]:
        model, source = symgen.load(name), dict(zip(TIMED, RATIOS[name][1], strict=True))
        for method in METHODS:
            ratios = []
            for _ in range(TURNS if times else 0):
                own, base = (
                    model.simulate(method=one, integrator="rk4", until=2.0, repeat=3, max_violation=1e3).outcome
                    for one in (method, "lagrange")
                )
                ratios.append(own.cpu_seconds / base.cpu_seconds)
            second_hand = f" ({source[method]:.2f})" if method in source else ""
            yield f"{np.median(ratios):.2f}{second_hand}" if ratios else KEPT

    spatial = [name for name in RATIOS if symgen.load(name).mechanism.space == "spatial"]
    rows = tuple(((f"`{name}`",), partial(list_of, cells, name)) for name in spatial)
    headings = ("mechanism", *(f"`{name}`" for name in METHODS))
    return PageTable(
        "space methods", "benchmarks/README.md", headings, rows, tuple(range(1, len(headings))), integrators=("rk4",)
    )


# -- Bricard's six-bar beside other tools ------------------------------------------------------------------------------


def points_of(q: Array) -> Array:
    """Return P1 to P4, shape (k, 4, 3), of coordinates, shape (k, 35)."""
    from scipy.spatial.transform import Rotation

    rows = []
    for rod, place in JOINTS:
        x, e = q[:, 7 * rod : 7 * rod + 3], q[:, 7 * rod + 3 : 7 * rod + 7]
        rows.append(x + Rotation.from_quat(e[:, [1, 2, 3, 0]]).apply(place))
    return np.stack(rows, axis=1)


def reference(times: Array) -> Array:
    """Return P1 to P4 by the second derivation."""
    model = symgen.load("bricard")
    compiled = model.compile()
    start = model.assemble(compiled)
    nq = compiled.info.nq
    motion = second_derivation(model.mechanism, {}, start.y[:nq], start.y[nq:-1], times)
    if motion.estimated_error > 1e-11:
        raise AssertionError(f"the reference may be off by {motion.estimated_error:g} m")
    return points_of(motion.q)


def rows(times: Array, truth: Array) -> Iterator[dict[str, Any]]:
    """Run symgen with every setting."""
    model = symgen.load("bricard")
    names = [f"{body.name}.{c}" for body in model.mechanism.bodies for c in body.coordinates]
    settings: list[tuple[str, dict[str, Any]]] = []
    for tolerance in 10.0 ** (-np.arange(10, 24) / 2):
        settings.append((f"dop853 {tolerance:.0e}", {"integrator": "dop853", "rtol": tolerance, "atol": tolerance}))
    for count in (2, 5, 10, 20, 40):
        settings.append((f"rk4 {times[1] / count:.3g} s", {"integrator": "rk4", "step": times[1] / count}))
    for method in ("direct-correction", "lagrange"):
        for text, chosen in settings:
            arguments = {"method": method, "until": float(times[-1]), "times": times, **chosen}
            result = model.simulate(**arguments)
            if result.status == "failed":
                continue
            result = model.simulate(**arguments, repeat=min(300, max(5, round(0.5 / result.seconds.run))))
            points = points_of(np.column_stack([result[name] for name in names]))
            error = float(np.linalg.norm(points - truth, axis=2).max())
            setting, seconds = f"{method}, {text}", result.seconds.run
            yield {"peer": "symgen", "version": symgen.__version__, "setting": setting, "cpu": seconds, "error": error}


def peers(python: Path) -> tuple[Table, list[dict[str, Any]]]:
    """Return the table of least times at each error, and all rows."""
    times = np.linspace(0.0, 10.0, 101)
    truth = reference(times)
    lines = list(rows(times, truth))
    if python.exists():
        with tempfile.TemporaryDirectory() as folder:
            truth_file, made = Path(folder) / "reference.json", Path(folder) / "peers.json"
            truth_file.write_text(json.dumps({"times": times.tolist(), "points": truth.tolist()}), encoding="utf-8")
            command = [
                str(python),
                "-m",
                "benchmarks.peers.bricard",
                "--reference",
                str(truth_file),
                "--json",
                str(made),
            ]
            subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
            lines += json.loads(made.read_text(encoding="utf-8"))
    else:
        print(f"no peers: {python} does not exist (see benchmarks/README.md)", file=sys.stderr)
    table = Table(title="Bricard's six-bar, 10 s: least loop time at an error")
    for column in ("error [m]", "tool", "setting", "reached [m]", "loop [ms]", "times symgen's"):
        table.add_column(column, justify="left" if column in ("tool", "setting") else "right")
    for target in TARGETS:
        ours = _fastest([r for r in lines if r["peer"] == "symgen"], target)
        for tool in dict.fromkeys(r["peer"] for r in lines):
            best = _fastest([r for r in lines if r["peer"] == tool], target)
            if best is None or ours is None:
                table.add_row(f"{target:g}", tool, "not reached", "-", "-", "-")
                continue
            ratio = best["cpu"] / ours["cpu"]
            cells = (best["setting"], f"{best['error']:.1e}", f"{best['cpu'] * 1e3:.2f}", f"{ratio:.1f}")
            table.add_row(f"{target:g}", f"{tool} {best['version']}", *cells)
        table.add_section()
    return table, lines


def _fastest(rows: Sequence[dict[str, Any]], target: float) -> dict[str, Any] | None:
    good = [r for r in rows if r["error"] is not None and r["error"] <= target]
    return min(good, key=lambda r: float(r["cpu"]), default=None)


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the tables asked for, all of them unless told."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.space", description=__doc__)
    parser.add_argument("what", nargs="*", help="rhs, methods, peers")
    parser.add_argument("--peers-python", type=Path, default=ROOT / ".bench-venv" / "bin" / "python")
    parser.add_argument("--json", type=Path, help="file for all rows of the comparison with peers")
    options = parser.parse_args(arguments)
    wanted = options.what or ["rhs", "methods", "peers"]
    if "rhs" in wanted:
        show(rhs())
    if "methods" in wanted:
        print_tables({"methods": methods(times=True)}, ())
    if "peers" in wanted:
        table, lines = peers(options.peers_python)
        show(table)
        if options.json is not None:
            options.json.write_text(json.dumps(lines, indent=1, allow_nan=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
