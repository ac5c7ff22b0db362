"""What derivatives of runs cost, in plain runs: adjoints by up to 100 numbers of a file, and eight forward directions.

Plain and differentiated loops in turns, processor time, medians; the adjoint is the run that keeps its stages and the
way back, in memory of the run before. Starts and tables of results, which Python differentiates, are apart: the last
column has a whole gradient less a whole run, by number.

    OPENBLAS_NUM_THREADS=1 python -m benchmarks.gradients [MODEL ...] [--pairs 9] [--method lagrange]
    python -m benchmarks.gradients --way beside [--peers-python .bench-venv/bin/python]

The second one has errors and times of a quantity of IDAS's slider-crank with two derivatives, of symgen and CasADi.
"""

from __future__ import annotations

import argparse
import itertools
import json
import statistics
import subprocess
import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from rich.table import Table

from benchmarks.peers.gradients import DURATION, REPEATS, TOLERANCES, error_of
from benchmarks.show import show
from symgen.api import Model, load
from symgen.base.errors import InputError
from symgen.base.settings import Settings
from symgen.describe.facts.lifted import lift_numbers
from symgen.describe.files.origins import origin_of
from symgen.result.sensitivities import prepare_for_directions
from symgen.run.directions.adjoint import run_for_adjoint
from symgen.run.directions.directions import run_with_directions
from symgen.run.layout import abi
from symgen.run.planning.named_directions import named_directions
from symgen.run.planning.start_directions import StartDirections

ROOT = Path(__file__).resolve().parents[1]
#: Errors at which times are compared.
LIMITS = 1e-6, 1e-8, 1e-9, 2e-12
#: Quantity, end [s], and settings.
ADJOINT: dict[str, tuple[str, float, dict[str, Any]]] = {
    "four-bar": ("crank.theta", 60.0, {}),
    "andrews": ("K1.theta", 0.1, {}),
    "front-suspension": ("arm_left.z", 1.0, {}),
    "chain:20": ("rod20.z", 1.0, {}),
    "n-four-bar:20": ("A1.angle", 0.6, {"integrator": "rk4", "step": 1e-4}),
}
#: End [s] and eight names.
FORWARD = {"four-bar": 60.0, "slider-crank": 20.0, "andrews": 0.1, "bricard": 20.0}
#: Keys of a body whose numbers are lifted.
KEYS = ("mass", "inertia", "points", "centre_of_mass")
ADJOINT_HEADINGS = (
    *("mechanism", "coordinates", "method", "numbers", "steps", "plain [ms]", "keeping", "back", "both"),
    *("MB", "kB a step", "Python, a number [ms]"),
)
FORWARD_HEADINGS = "mechanism", "coordinates", "numbers", "plain [ms]", "directions", "each"


def seconds(call: Callable[[], object]) -> float:
    """Return the processor time of a call [s]."""
    began = time.process_time()
    call()
    return time.process_time() - began


def medians(pairs: int, *calls: Callable[[], object]) -> list[float]:
    """Return the medians of processor times of calls in turns [s]."""
    for call in calls:
        call()
    rows = [[seconds(call) for call in calls] for _ in range(pairs)]
    return [statistics.median(column) for column in zip(*rows, strict=True)]


def numbers(model: Model, keys: Sequence[str], most: int) -> tuple[str, ...]:
    """Return paths of numbers of bodies."""
    origin = origin_of(model.mechanism)
    assert origin is not None, "the model was loaded"
    paths = list[str]()

    def walk(path: str, value: object) -> None:
        if isinstance(value, Mapping):
            for key, item in value.items():
                walk(f"{path}.{key}", item)
        elif isinstance(value, list | tuple):
            for i, item in enumerate(value):
                walk(f"{path}[{i}]", item)
        elif isinstance(value, int | float):
            paths.append(path)

    for name, body in origin.raw["bodies"].items():
        walk(f"bodies.{name}", {key: body[key] for key in keys if key in body})
    return tuple(paths[:most])


def adjoint(name: str, coordinates: str, method: str, pairs: int) -> list[str]:
    """Return the cells of an adjoint by up to 100 numbers."""
    quantity, until, own = ADJOINT[name]
    model = load(name)
    names = numbers(model, KEYS, 100)
    settings: dict[str, Any] = {"until": until, "coordinates": coordinates, "method": method}
    settings = {"integrator": "dop853"} | settings | own
    objective = model.objective(quantity, by=names, way="adjoint", **settings)
    ending = replace(objective.settings_at(objective.x0), times=[until])
    run, _ = prepare_for_directions(objective.mechanism, ending)
    end, pages, following = np.ones(run.compiled.info.ny), list[Any](), itertools.count(1)
    arguments = run.compiled, run.plan.integrator, run.start, run.spec
    seeds = StartDirections(run, named_directions(run, lift_numbers("gradients", model.mechanism, names).keys)).seeds()
    whole, last = Model(objective.mechanism), run_for_adjoint(*arguments, pages=pages)
    plain, keeping, back, gradient, simulation = medians(
        pairs,
        run.integrate,
        lambda: run_for_adjoint(*arguments, pages=pages),
        lambda: last.derivatives_by_start(end, seeds),
        lambda: objective(objective.x0 * (1.0 + 1e-15 * next(following))),
        lambda: whole.simulate(ending),
    )
    kept, more = last.run.bytes_kept, gradient - simulation - (keeping + back - plain)
    cells = name, coordinates, method, str(len(names)), str(last.run.state.control[abi.STEPS]), f"{1e3 * plain:.1f}"
    ratios = (f"{x / plain:.2f}" for x in (keeping, back, keeping + back))
    sizes = f"{kept / 1e6:.1f}", f"{kept / 1e3 / last.run.state.control[abi.STEPS]:.1f}"
    return [*cells, *ratios, *sizes, f"{1e3 * more / len(names):.2f}"]


def forward(name: str, coordinates: str, method: str, pairs: int) -> list[str]:
    """Return the cells of eight forward directions."""
    model = load(name)
    gravity = (f"mechanism.gravity[{i}]" for i in range(len(model.mechanism.gravity)))
    names = (*numbers(model, ("mass", "inertia"), 8), *gravity, *numbers(model, ("points",), 8))[:8]
    own = lift_numbers("numbers", model.mechanism, names)
    settings = Settings(
        integrator="dop853",
        method=method,
        coordinates=coordinates,
        until=FORWARD[name],
        times=[FORWARD[name]],
        rtol=1e-9,
        verify=False,
    )
    run, _ = prepare_for_directions(own.mechanism, settings)
    seeds = StartDirections(run, named_directions(run, own.keys)).seeds()
    arguments = run.compiled, run.plan.integrator, run.start, run.spec, seeds
    plain, directed = medians(pairs, run.integrate, lambda: run_with_directions(*arguments))
    each = (directed / plain - 1.0) / seeds.count
    return [name, coordinates, str(seeds.count), f"{1e3 * plain:.1f}", f"{directed / plain:.2f}", f"{each:.2f}"]


def beside(interpreter: Path) -> None:
    """Print errors and loop times of IDAS's slider-crank, of symgen and, with its interpreter, of CasADi.

    Loop times of symgen are medians of 15 runs; those of both are wall times.
    """
    model, rows = load(Path(__file__).with_name("idas-slider-crank.toml")), list[dict[str, Any]]()
    for coordinates in ("joint", "absolute"):
        for tolerance in TOLERANCES:
            settings: dict[str, Any] = {"rtol": tolerance, "atol": tolerance, "coordinates": coordinates}
            settings |= {"integrator": "dop853", "verify": False, "times": [DURATION]}
            runs = [model.simulate(sensitivities=("k", "c"), **settings) for _ in range(REPEATS + 1)][1:]
            error = error_of([runs[0].outputs.row()["G"], *runs[0].gradient("G").row().values()])
            taken = statistics.median(run.seconds.run for run in runs)
            rows.append(
                {"peer": "symgen", "way": f"dop853 {tolerance:.0e}, {coordinates}", "error": error, "seconds": taken}
            )
    if interpreter.exists():
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "rows.json"
            command = [str(interpreter), "-m", "benchmarks.peers.gradients", "--json", str(path)]
            subprocess.run(command, check=True, cwd=ROOT, stdout=subprocess.DEVNULL)
            rows += json.loads(path.read_text())
    table = Table("peer", "way", "error", "ms", title="slider-crank of IDAS: G, dG/dk, dG/dc")
    for row in rows:
        table.add_row(row["peer"], row["way"], *("" if x is None else f"{x:.2g}" for x in (row["error"], _ms(row))))
    show(table)
    for limit in LIMITS:
        best = dict[str, float]()
        for row in rows:
            if row["error"] is not None and row["error"] <= limit:
                best[row["peer"]] = min(row["seconds"], best.get(row["peer"], np.inf))
        print(f"error {limit:.0e}: " + ", ".join(f"{peer} {1e3 * x:.3g} ms" for peer, x in best.items()))


def _ms(row: dict[str, Any]) -> float | None:
    return None if row["seconds"] is None else 1e3 * float(row["seconds"])


def main() -> None:
    """Print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("models", nargs="*", default=[*ADJOINT])
    parser.add_argument("--pairs", type=int, default=9)
    parser.add_argument("--coordinates", default="absolute,joint")
    parser.add_argument("--method", default="lagrange,direct-correction")
    parser.add_argument("--way", choices=("adjoint", "forward", "beside"), default="adjoint")
    parser.add_argument("--peers-python", type=Path, default=ROOT / ".bench-venv" / "bin" / "python")
    own = parser.parse_args()
    if own.way == "beside":
        beside(own.peers_python)
        return
    measure, headings = (adjoint, ADJOINT_HEADINGS) if own.way == "adjoint" else (forward, FORWARD_HEADINGS)
    table = Table(*headings, title=f"{own.way}, in plain runs")
    for name in own.models:
        for coordinates in own.coordinates.split(","):
            for method in own.method.split(","):
                try:
                    row = measure(name, coordinates, method, own.pairs)
                except InputError as error:
                    row = [name, coordinates, method, error.got]
                table.add_row(*row)
    show(table)


if __name__ == "__main__":
    main()
