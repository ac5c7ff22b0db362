"""Error against run time: symgen beside other tools, on the same neutral mechanisms and with the same measure of error.

The mechanisms, the reference solutions and the error (largest over the run, over all body angles [rad]) are those of
``benchmarks/peers``; symgen gets the numbers of the same description, and as many outputs as the peers. Peers run in an
interpreter of their own, in the same session, and each with the best of its settings.

    python -m benchmarks.against_peers [--model NAME] [--peers exudyn,mujoco] [--only TEXT] [--peers-json FILE]
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from rich.table import Table

import symgen
from benchmarks.peers import models, reference
from benchmarks.peers.measure import BUDGET, ENOUGH, MOST, REPEATS, WRONG, Row, fastest
from benchmarks.show import show

ROOT = Path(__file__).resolve().parents[1]
TARGET = 1e-6
TOLERANCES = tuple(10.0 ** (-k / 2) for k in range(8, 27))
#: Constant steps between two outputs, for each integrator; a whole number, as the peers have it.
STEPS = {"rk4": (13, 17, 20, 25, 33, 40, 50, 67, 80, 100, 200, 400), "dop853": (1, 2, 3, 4, 5, 6, 8, 10, 13, 17, 25)}


def describe(model: models.Model) -> symgen.Mechanism:
    """Return symgen's mechanism for a neutral description; all numbers are literals, as every peer gets them."""
    builder = symgen.MechanismBuilder(model.name.replace(":", "-"), gravity=(0.0, -model.gravity))
    position, velocity = model.place()
    for i, body in enumerate(model.bodies):
        builder.body(
            body.name,
            mass=body.mass,
            inertia=body.inertia,
            position=position[i],
            angle=body.angle,
            velocity=velocity[i],
            angular_velocity=body.rate,
        )

    def name(index: int) -> str:
        return "ground" if index == models.GROUND else model.bodies[index].name

    for i, joint in enumerate(model.joints):
        between = (name(joint.a), name(joint.b))
        builder.joint(f"joint{i}", "revolute", between=between, at=(joint.point_a, joint.point_b))
    for i, spring in enumerate(model.springs):
        builder.force(
            f"spring{i}",
            "spring-damper",
            between=("ground", name(spring.body)),
            at=(spring.anchor, spring.point),
            stiffness=spring.stiffness,
            free_length=spring.length,
        )
    for index, torque in model.torques.items():
        builder.force(f"torque{index}", "torque", body=name(index), torque=torque)
    return builder.build()


def rows(model: models.Model, only: str = "") -> Iterator[Row]:
    """Run symgen with every setting whose name contains a text."""
    loaded = symgen.load(describe(model))
    truth, times = reference.angles(model), reference.sample_times(model)
    columns = [f"{body.name}.theta" for body in model.bodies]
    common: dict[str, Any] = {"until": model.duration, "times": times}
    settings: list[tuple[str, dict[str, Any]]] = []
    for tolerance in TOLERANCES:
        for integrator in ("dop853", "dopri5", "picard"):
            control = {"integrator": integrator, "rtol": tolerance, "atol": tolerance}
            settings.append((f"{integrator} {tolerance:.0e}", control))
    for integrator, counts in STEPS.items():
        for count in counts:
            step = model.duration / reference.INTERVALS / count
            constant: dict[str, Any] = {"integrator": integrator, "step": step}
            if integrator == "dop853":
                constant["options"] = {"integrator.adaptive": "false"}
            settings.append((f"{integrator} {step:.3g} s", constant))
    weights: tuple[tuple[str, str, dict[str, Any]], ...] = (
        ("direct-correction", "direct-correction", {}),
        ("direct-correction mass", "direct-correction", {"method.weight": "mass"}),
        ("lagrange", "lagrange", {}),
        ("joint direct-correction", "direct-correction", {}),
        ("joint lagrange", "lagrange", {}),
    )
    for label, method, options in weights:
        for text, chosen in settings:
            if only not in f"{label}, {text}":
                continue
            all_options = options | chosen.get("options", {})
            arguments = common | chosen | {"method": method, "options": all_options}
            arguments["coordinates"] = "joint" if label.startswith("joint") else "absolute"
            result = loaded.simulate(**arguments)
            if result.status != "failed" and result.seconds.run < BUDGET / REPEATS:
                repeat = min(MOST, max(REPEATS, round(ENOUGH / result.seconds.run)))
                result = loaded.simulate(**arguments, repeat=repeat)
            done = len(result.t) == len(times)
            angles = np.column_stack([result[c] for c in columns])
            error = reference.largest_error(angles, truth) if done else float("nan")
            status = result.status if result.status != "failed" else f"failed: {result.reason}"
            ok = bool(np.isfinite(error)) and result.status != "failed"
            yield Row(
                peer="symgen",
                version=symgen.__version__,
                setting=f"{label}, {text}",
                model=model.name,
                seconds=result.seconds.run if ok else None,
                spread=result.seconds.run_spread if ok else None,
                error=error if ok else None,
                status="wrong" if ok and error > WRONG else status,
            )


def peers(names: Sequence[str], python: Path, target: Path, tools: str) -> list[Row]:
    """Run the peers in their own interpreter; none where it does not exist."""
    if not python.exists():
        print(f"no peers: {python} does not exist (see benchmarks/README.md)", file=sys.stderr)
        return []
    chosen = [word for name in names for word in ("--model", name)]
    command = [str(python), "-m", "benchmarks.peers", *chosen, "--peers", tools, "--json", str(target)]
    subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    peer_rows: list[Row] = json.loads(target.read_text(encoding="utf-8"))
    return peer_rows


def summary(names: Sequence[str], rows: Sequence[Row], target: float) -> Table:
    """Return the table of least times at an error."""
    table = Table(title=f"least loop time at an error of {target:g} rad")
    for column in ("mechanism", "tool", "setting", "error [rad]", "loop [ms]", "times symgen's", "best error [rad]"):
        table.add_column(column, justify="left" if column in ("mechanism", "tool", "setting") else "right")
    for name in names:
        ours = fastest([r for r in rows if r["model"] == name and r["peer"] == "symgen"], target)
        for tool in dict.fromkeys(r["peer"] for r in rows if r["model"] == name):
            own = [r for r in rows if r["model"] == name and r["peer"] == tool]
            errors = [r["error"] for r in own if r["error"] is not None]
            best = fastest(own, target)
            floor = f"{min(errors):.1e}" if errors else "-"
            if best is None or best["seconds"] is None or best["error"] is None:
                reason = "not reached" if errors else f"never ended: {own[-1]['status']}"[:60]
                table.add_row(name, tool, reason, "-", "-", "-", floor)
                continue
            ratio = "-" if ours is None or ours["seconds"] is None else f"{best['seconds'] / ours['seconds']:.1f}"
            cells = (best["setting"], f"{best['error']:.1e}", f"{best['seconds'] * 1e3:.3f}", ratio, floor)
            table.add_row(name, f"{tool} {best['version']}", *cells)
        table.add_section()
    return table


def main(arguments: Sequence[str] | None = None) -> None:
    """Print symgen's rows if asked for, and the summary."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.against_peers", description=__doc__)
    parser.add_argument("--model", action="append", help=f"one of {', '.join(models.NAMES)}; repeatable; default all")
    parser.add_argument("--peers-python", type=Path, default=ROOT / ".bench-venv" / "bin" / "python")
    parser.add_argument("--peers-json", type=Path, help="rows of an earlier run of the peers, instead of running them")
    parser.add_argument("--peers", default="casadi,exudyn,heyoka,mujoco", help="tools to run, comma-separated")
    parser.add_argument("--only", default="", help="settings of symgen to run: those that contain this text")
    parser.add_argument("--json", type=Path, help="file for all rows")
    parser.add_argument("--error", type=float, default=TARGET, help="error of the summary [rad]")
    parser.add_argument("--rows", action="store_true", help="print every row of symgen as well")
    options = parser.parse_args(arguments)
    names = options.model or list(models.NAMES)
    measured: list[Row] = []
    for name in names:
        measured += rows(models.load(name), options.only)
    if options.rows:
        from benchmarks.peers.measure import table

        print("\n".join(table(measured)))
    if options.peers_json is not None:
        earlier: list[Row] = json.loads(options.peers_json.read_text(encoding="utf-8"))
        measured += [r for r in earlier if r["model"] in names]
    else:
        with tempfile.TemporaryDirectory() as folder:
            measured += peers(names, options.peers_python, Path(folder) / "peers.json", options.peers)
    if options.json is not None:
        options.json.write_text(json.dumps(measured, indent=1, allow_nan=False) + "\n", encoding="utf-8")
    show(summary(names, measured, options.error))


if __name__ == "__main__":
    main()
