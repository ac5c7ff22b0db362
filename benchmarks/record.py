"""What every allowed pair of method and integrator does on every catalogue entry, to compare two trees by.

    python -m benchmarks.record run FILE [MODEL ...]       every pair, in both shapes, over a short span
    python -m benchmarks.record compare OLD NEW            counts have to be equal, states up to 1e-12

A row is a run: model, method, integrator, shape of the code, constant or adaptive steps; its outputs are partly between
steps. ``FILE`` has one JSON object a line. What it has already is not run again, so a recording that was killed goes on
where it stopped; every method of a model has a process of its own, and what a process did not get done is a row too.
Loops that were only rearranged take the same steps; another order of operations may change the last digits of a state.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from symgen import catalogue
from symgen.api import Model, load
from symgen.base.errors import InputError, SymgenError
from symgen.integrators import INTEGRATORS
from symgen.methods import METHODS

#: Sizes of entries that have one.
SIZES = {"n-four-bar": 2, "chain": 3}
#: Length of a run with constant steps, and its outputs, in steps.
STEPS, AT_STEPS = 6.4, (0.0, 0.4, 1.0, 2.5, 2.7, 6.0, 6.4)
#: Length of an adaptive run in the entry's own steps, and its outputs as parts of it.
SPAN, AT_PARTS = 200.0, (0.0, 0.13, 0.5, 0.51, 0.6, 1.0)
#: Methods and adaptive integrators that are also recorded over an entry's whole time.
WHOLE = ("direct-correction", "lagrange"), ("dopri5", "dop853", "abm", "radau5")
#: Seconds after which a process with one method is given up.
PATIENCE = 3600.0
#: Counts that have to be equal.
COUNTS = ("status", "steps", "rejected", "evaluations", "counters", "outputs", "events")
TOLERANCE = 1e-12


def models() -> list[str]:
    """Return the catalogue, sized entries at small sizes."""
    return [f"{name}:{SIZES[name]}" if name in SIZES else name for name in catalogue.names()]


def runs(model: Model, method: str) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield the key of each row of a method, and the settings of its run."""
    defaults = model.mechanism.defaults
    h = defaults.step or 1e-3
    for integrator in INTEGRATORS.names:
        kind = INTEGRATORS.get(integrator)
        if not set(METHODS.get(method).forms) & set(kind.forms):
            continue
        for shape in ("straight", "looped"):
            common = {"method": method, "integrator": integrator, "shape": shape}
            constant = common | {"step": h, "until": STEPS * h, "times": [h * x for x in AT_STEPS]}
            if kind.adaptive:
                constant["options"] = {"integrator.adaptive": "false"}
                span = SPAN * h
                yield f"{integrator} {shape} adaptive", common | {"until": span, "times": [span * x for x in AT_PARTS]}
                if method in WHOLE[0] and integrator in WHOLE[1] and shape == "straight":
                    times = list(np.linspace(0.0, defaults.until, 11)) if defaults.until else None
                    yield f"{integrator} {shape} whole", common | {"until": defaults.until, "times": times}
            yield f"{integrator} {shape} constant", constant


def observe(model: Model, settings: dict[str, Any]) -> dict[str, Any]:
    """Return what a run gave, or the sentence it was refused with."""
    try:
        result = model.simulate(**settings)
    except InputError as refusal:
        return {"status": "refused", "reason": str(refusal)}
    except SymgenError as error:
        return {"status": type(error).__name__, "reason": str(error)}
    outcome = result.outcome
    return {
        "status": result.status,
        "reason": result.reason,
        "end": outcome.end,
        "steps": outcome.steps,
        "rejected": outcome.rejected,
        "evaluations": outcome.evaluations,
        "counters": outcome.counters,
        "outputs": len(outcome.times),
        "events": [[e.t_in, e.t_out, e.rank, e.smallest_pivot] for e in outcome.rank_events],
        "maxima": [outcome.position_violation_max, outcome.velocity_violation_max, outcome.energy_drift_max],
        "states": np.where(np.isfinite(outcome.states), outcome.states, 1e300).tolist(),
    }


def rows(path: Path) -> dict[str, dict[str, Any]]:
    """Return what a file holds, by key; a line that was cut off counts as missing."""
    rows_by_name: dict[str, dict[str, Any]] = {}
    if path.exists():
        for line in path.read_text(encoding="utf-8").splitlines():
            try:
                row = json.loads(line)
            except ValueError:
                continue
            rows_by_name[row.pop("key")] = row
    return rows_by_name


def append(path: Path, key: str, row: dict[str, Any]) -> None:
    """Add a line."""
    with path.open("a", encoding="utf-8") as file:
        file.write(json.dumps({"key": key, **row}) + "\n")


def record_method(path: Path, name: str, method: str) -> None:
    """Record the rows of one method that are missing, in this process."""
    model, recorded = load(name), rows(path)
    for key, settings in runs(model, method):
        if (whole := f"{name} {method} {key}") not in recorded:
            append(path, whole, observe(model, settings))


def record(path: Path, chosen: list[str]) -> None:
    """Record everything that is missing, one process a model and method."""
    for name in chosen or models():
        model = load(name)
        for method in METHODS.names:
            expected = [f"{name} {method} {key}" for key, _ in runs(model, method)]
            if set(expected) <= rows(path).keys():
                continue
            command = [sys.executable, __file__, "method", str(path), name, method]
            try:
                code = str(subprocess.run(command, timeout=PATIENCE, check=False).returncode)
            except subprocess.TimeoutExpired:
                code = "late"
            recorded = rows(path)
            for key in expected:
                if key not in recorded:
                    append(path, key, {"status": "lost", "reason": f"the process ended with {code}"})
            print(f"{name} {method}: {len(expected)} rows", flush=True)


def difference(old: dict[str, Any], new: dict[str, Any], counts: tuple[str, ...] = COUNTS) -> str:
    """Return how two rows differ, empty where they do not."""
    for name in counts:
        a, b = old.get(name), new.get(name)
        if name == "events" and a is not None and b is not None:
            a, b = [e[2] for e in a], [e[2] for e in b]
        if a != b:
            return f"{name} {a} -> {b}"
    if "states" not in old or "states" not in new:
        return ""
    a, b = np.asarray(old["states"]), np.asarray(new["states"])
    if a.shape != b.shape:
        return f"shape {a.shape} -> {b.shape}"
    apart = float(np.max(np.abs(a - b), initial=0.0)) / float(np.max(np.abs(a), initial=1e-300))
    return f"states differ by {apart:.2e} of the largest" if apart > TOLERANCE else ""


def compare(old: Path, new: Path) -> int:
    """Print all differences; return how many there are in runs over the short span.

    Behind each one stands how far both shapes of the code differ in the old file, which is what rounding does to the
    same run.
    """
    before, after = rows(old), rows(new)
    worst = 0
    for key in sorted(before.keys() | after.keys()):
        if key not in after or key not in before:
            text = "missing in " + ("new" if key not in after else "old")
        else:
            text = difference(before[key], after[key])
        if text:
            other = before.get(key.replace(" straight ", " looped "), {})
            shapes = difference(other, before.get(key.replace(" looped ", " straight "), {})) if other else ""
            print(f"{key}: {text}" + (f" (shapes: {shapes})" if shapes else ""))
            worst += not key.endswith("whole")
    both = before.keys() & after.keys()
    print(f"{len(both)} rows in both; {worst} differ over the short span")
    return worst


def main() -> int:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    commands = parser.add_subparsers(dest="command", required=True)
    for name, arguments in (("run", ["file"]), ("method", ["file", "model", "method"]), ("compare", ["old", "new"])):
        command = commands.add_parser(name)
        for argument in arguments:
            command.add_argument(argument, type=Path if argument in ("file", "old", "new") else str)
        if name == "run":
            command.add_argument("models", nargs="*")
    options = parser.parse_args()
    if options.command == "compare":
        return int(compare(options.old, options.new) > 0)
    if options.command == "method":
        record_method(options.file, options.model, options.method)
    else:
        record(options.file, options.models)
    return 0


if __name__ == "__main__":
    sys.exit(main())
