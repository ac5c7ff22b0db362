"""All methods with their integrators where stops are left: in a joint with play, by a mass pushed ahead, by a ball.

python -m benchmarks.bounded.methods [--only penalty,ggl] [--integrators rk4,dop853]
"""

from __future__ import annotations

import argparse
import math
import os
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from rich.table import Table

from benchmarks.bounded.motion import Simulation
from benchmarks.bounded.rows import Bounded, angle, joint
from benchmarks.bounded.tree import GROUND, Array, Link, Tree
from benchmarks.show import show

FOLDER = Path(__file__).parent / "files"
#: Differences up to the first are right, those up to the second the method's own, if it is one that leaves rows open.
RIGHT, NEAR = 1e-7, 1e-4
#: By so much, at least, an error of constant steps falls with half of them, if it is below the other number.
FALLS, COARSEST = 1.6, 0.1
STEP, RTOL = 1e-3, 1e-9
TIMES = np.linspace(0.0, 1.2, 13)
OUTCOMES = ("right", "near", "sentence", "unverified", "failed", "WRONG", "raised")


def _pin(parent: int, mass: float, inertia: float, **forces: Any) -> Link:
    nothing = np.zeros(3)
    tensor = np.diag([0.0, 0.0, inertia])
    return Link(parent, False, np.array([0.0, 0.0, 1.0]), np.eye(3), nothing, nothing, mass, tensor, **forces)


def _slide(mass: float, **forces: Any) -> Link:
    nothing = np.zeros(3)
    return Link(GROUND, True, np.eye(3)[0], np.eye(3), nothing, nothing, mass, np.zeros((3, 3)), **forces)


def wanted() -> dict[str, dict[str, Array]]:
    """Return right values of coordinates at `TIMES`, by file."""
    z, x = np.array([0.0, 0.0, 1.0]), np.eye(3)[0]
    play = Tree(
        [_pin(GROUND, 0.5, 0.1, stiffness=2.0), _pin(0, 0.1, 0.012, torque=0.6 * z, frequency=7.0)], [], np.zeros(3)
    )
    pushed = Tree([_slide(0.3, force=7.0 * x, frequency=4.0, phase=math.pi / 2), _slide(0.7)], [], np.zeros(3))
    times = [float(t) for t in TIMES]
    turned = Simulation(play, [Bounded("play", joint(1), lower=-0.04, upper=0.04)]).run(np.zeros(2), np.zeros(2), times)
    touch = Bounded("touch", angle({0: -1.0, 1: 1.0}, 0.01), lower=0.0)
    moved = Simulation(pushed, [touch]).run(np.zeros(2), np.array([1.0, 0.0]), times)
    u, s = np.array(turned.u), np.array(moved.u)
    lifted = np.maximum(TIMES - 0.5, 0.0) ** 3 * 20.0 / 6.0
    return {
        "backlash": {"load.theta": u[:, 0], "rotor.theta": u.sum(axis=1)},
        "pushed": {"a.x": s[:, 0], "c.x": s[:, 1] + 0.01},
        "lifted": {"ball.y": lifted},
    }


@dataclass(frozen=True)
class Line:
    """What became of a run."""

    file: str
    method: str
    integrator: str
    outcome: str
    error: float
    reason: str = ""


def pairs(methods: list[str], integrators: list[str]) -> Iterator[tuple[str, str]]:
    """Yield methods with the integrators that they fit."""
    from symgen.derive.methods import METHODS
    from symgen.run.integrators import INTEGRATORS

    for method in methods or METHODS.names:
        forms = set(METHODS.get(method).forms)
        for integrator in INTEGRATORS.names:
            if forms & set(INTEGRATORS.get(integrator).forms) and (not integrators or integrator in integrators):
                yield method, integrator


def adaptive(integrator: str) -> bool:
    """Whether an integrator chooses its steps by a tolerance."""
    from symgen.run.integrators import INTEGRATORS

    return bool(INTEGRATORS.get(integrator).adaptive)


def off(model: Any, method: str, integrator: str, right: dict[str, Array], step: float) -> tuple[str, float, str]:
    """Return status, error and reason of a run."""
    settings: dict[str, Any] = {"step": step}
    if adaptive(integrator):
        settings = {"rtol": RTOL, "atol": 1e-2 * RTOL}
    run = model.simulate(
        method=method, integrator=integrator, times=TIMES, until=1.2, verify=method == "energy-projection", **settings
    )
    count = len(run.t)
    error = max(float(np.abs(run[name] - values[:count]).max()) for name, values in right.items())
    return str(run.status), error if run.status != "ok" or count == len(TIMES) else math.inf, str(run.reason or "")


def examined(file: str, model: Any, method: str, integrator: str, right: dict[str, Array]) -> Line:
    """Return what became of a run, with constant steps also with half of them."""
    import symgen

    try:
        status, error, reason = off(model, method, integrator, right, STEP)
        if status != "ok":
            return Line(file, method, integrator, "unverified" if status == "unverified" else "failed", error, reason)
        if error > RIGHT and not adaptive(integrator):
            half = off(model, method, integrator, right, 0.5 * STEP)[1]
            if half < error / FALLS and error < COARSEST:
                return Line(file, method, integrator, "right", error, "its error falls with the step")
    except symgen.SymgenError as refusal:
        inside = " at t = " in str(refusal)
        return Line(file, method, integrator, "raised" if inside else "sentence", math.nan, str(refusal))
    except Exception as other:  # whatever else is raised is looked for here
        return Line(file, method, integrator, "raised", math.nan, f"{type(other).__name__}: {other}")
    outcome = "right" if error <= RIGHT else "near" if error <= NEAR else "WRONG"
    return Line(file, method, integrator, outcome, error)


def examine(methods: list[str], integrators: list[str], files: list[str]) -> list[Line]:
    """Return what became of all runs."""
    import symgen

    lines = []
    right = wanted()
    for file in files or right:
        model = symgen.load(FOLDER / f"{file}.toml")
        for method, integrator in pairs(methods, integrators):
            line = examined(file, model, method, integrator, right[file])
            lines.append(line)
            if line.outcome not in ("right", "sentence"):
                print(f"{file} {method} {integrator}: {line.outcome} {line.error:.1e} {line.reason[:150]}", flush=True)
    return lines


def main() -> int:
    """Print counts and all that is neither right nor a sentence; return 1 where a run was `ok` and wrong, or raised."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", default="", help="methods")
    parser.add_argument("--integrators", default="")
    parser.add_argument("--files", default="")
    options = parser.parse_args()
    chosen = [[x for x in text.split(",") if x] for text in (options.only, options.integrators, options.files)]
    lines = examine(*chosen)
    table = Table("file", *OUTCOMES)
    for file in dict.fromkeys(line.file for line in lines):
        counts = Counter(line.outcome for line in lines if line.file == file)
        table.add_row(file, *(str(counts[outcome]) for outcome in OUTCOMES))
    show(table)
    return int(any(line.outcome in ("WRONG", "raised") for line in lines))


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        os.environ.setdefault("SYMGEN_CACHE_DIR", folder)
        sys.exit(main())
