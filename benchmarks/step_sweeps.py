"""Derivatives of a step while a parameter varies: none fails, all are smooth, and all are those of differences.

    python -m benchmarks.step_sweeps [press] [bucket] [wiper] [leg] [--rows 300]

A press and a bucket leave their stops inside the step, at a time that depends on what varies; nothing but the input
moves them there. Differences are of sixth order, of the same step from states and inputs nearby.
"""

from __future__ import annotations

import argparse
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from rich.table import Table

from benchmarks.bounded.machines import FOLDER
from benchmarks.closed_leg import leg
from benchmarks.show import show
from symgen.api import Model
from symgen.describe.facts.lifted import lifted
from symgen.describe.files.validate import validate
from symgen.run.layout import abi

Array = np.ndarray[Any, np.dtype[np.float64]]
CATALOGUE = Path(__file__).parents[1] / "symgen" / "describe" / "catalogue" / "machines"
#: Input that turns a body, and weights of differences.
INPUT, WEIGHTS = "extra", {1: 3 / 4, 2: -3 / 20, 3: 1 / 60}
#: Differences that are farther apart are made again: an event that passes from one step of the scheme to the next has a
#: kink there, as high as the error of the scheme.
NEAR = 1e-9


@dataclass(frozen=True)
class Machine:
    """A machine whose step is differentiated.

    Parameters
    ----------
    file, body : Path or None, str
        The file, none for the leg, and the body that the input turns.
    parameter, values : str, tuple of float
        What varies and between what.
    begin, dt, step : float
        Where the step begins, its length, and steps of the scheme inside [s].
    event : str
        What happens in it, or nothing.
    changes : tuple of float
        Widths of differences by the state, 0 where a stop holds it, and by the input.
    """

    file: Path | None
    body: str
    parameter: str
    values: tuple[float, float]
    begin: float
    dt: float
    step: float
    event: str = ""
    changes: tuple[float, float] = (1e-3, 1e-2)

    def model(self) -> Model:
        """Return the machine with its input."""
        if self.file is None:
            return leg()
        raw = tomllib.loads(self.file.read_text(encoding="utf-8"))
        raw.setdefault("inputs", {})[INPUT] = {"default": 0.5}
        raw.setdefault("forces", {})["driven"] = {
            "type": "torque",
            "body": self.body,
            "torque": f"{INPUT}*(1 + 0.1*{INPUT})",
        }
        return Model(validate(raw, self.file.stem))


MACHINES = {
    "press": Machine(
        FOLDER / "press.toml", "lower", "m", (4.0, 6.0), 0.25, 0.15, 1e-2, "guide.lower.leave", (0.0, 1e-3)
    ),
    "bucket": Machine(
        FOLDER / "bucket.toml", "rocker", "dig", (17e3, 23e3), 0.25, 0.2, 5e-3, "cylinder.lower.leave", (0.0, 1.0)
    ),
    "wiper": Machine(CATALOGUE / "wiper.toml", "arm", "arm_mass", (0.2, 0.8), 0.2, 0.01, 1e-4),
    "leg": Machine(None, "thigh", "load", (0.3, 1.2), 0.1, 0.01, 1e-3),
}


@dataclass(frozen=True)
class Found:
    """What became of the steps of a machine.

    Attributes
    ----------
    failed : sequence of str
        What was said of steps without derivatives, or with doubts, or without the event.
    apart : float
        Largest distance from differences, over the largest of a column.
    bend : float
        Largest second difference of an element of A and B along the sweep, over the largest element of its matrix.
    """

    failed: Sequence[str]
    apart: float
    bend: float


def difference(of: Callable[[float], Array], h: float) -> Array:
    """Return a derivative at zero."""
    return np.asarray(sum(w / h * (of(k * h) - of(-k * h)) for k, w in WEIGHTS.items()))


def allowed(f: Any, y: Array) -> Array:
    """Return changes of a state that leave rows as they are, one a column."""
    n = len(f.coordinates)

    def held(x: Array) -> Array:
        return np.concatenate([f.violation(x[:n]), f.constraint_jacobian(x[:n]) @ x[n:]])

    def along(way: Array) -> Callable[[float], Array]:
        return lambda h: held(y + h * way)

    slopes = np.column_stack([difference(along(way), 1e-4) for way in np.eye(len(y))])
    _, sizes, ways = np.linalg.svd(slopes)
    return np.asarray(ways[np.count_nonzero(sizes > 1e-8 * sizes.max(initial=1.0)) :].T)


After = Callable[[Array, Mapping[str, float]], Array]


def _along(after: After, way: Array, inputs: Mapping[str, float]) -> Callable[[float], Array]:
    """Return a step as a function of a change of its state."""
    return lambda h: after(h * way, inputs)


def _of_input(after: After, still: Array, inputs: Mapping[str, float], name: str) -> Callable[[float], Array]:
    """Return a step as a function of a change of an input."""
    return lambda h: after(still, {**inputs, name: inputs[name] + h})


def _distance(own: Array, of: Callable[[float], Array], h: float) -> float:
    """Return how far a derivative is from differences, narrower ones where that is far."""
    apart = np.inf
    for width in (h, 0.1 * h):
        slope = difference(of, width)
        apart = min(apart, float(np.abs(own - slope).max() / np.abs(slope).max()))
        if apart < NEAR:
            break
    return apart


def stepped(machine: Machine, model: Model, value: float, coordinates: str) -> tuple[Array, float, Sequence[str]]:
    """Return A along the rows beside B of a step, how far they are from differences, and what is wrong."""
    run = model.start(
        parameters={machine.parameter: value},
        coordinates=coordinates,
        integrator="rk4",
        step=machine.step,
        max_violation=1e6,
        max_energy_error=1e6,
    )
    run.step(machine.begin)
    saved, before = run.save(), len(run.events)
    run.step(machine.dt)
    found, events = run.derivatives(), [event.name for event in list(run.events)[before:]]
    wrong = [*found.doubts, *([f"events {events}"] if events != [machine.event] * bool(machine.event) else [])]
    n, inputs = len(found.states), {name: run.parameters[name] for name in found.inputs}

    def after(change: Array, given: Mapping[str, float]) -> Array:
        arrays = {key: x.copy() for key, x in saved.arrays.items()}
        arrays["y"][:n] += change
        arrays["control"][abi.BEGUN] = abi.AFRESH
        run.restore(replace(saved, arrays=arrays))
        run.step(machine.dt, dict(given))
        return np.array(run.state)

    distances, still = list[float](), np.zeros(n)
    ways = allowed(model.functions(coordinates, {machine.parameter: value}), saved.arrays["y"][:n])
    if machine.changes[0]:
        for way in ways.T:
            distances.append(_distance(found.A @ way, _along(after, way, inputs), machine.changes[0]))
    for k, name in enumerate(found.inputs):
        distances.append(_distance(found.B[:, k], _of_input(after, still, inputs, name), machine.changes[1]))
    apart = max(distances)
    # off the rows, corrections of one and of two iterations have other derivatives
    return np.hstack([found.A @ ways @ ways.T, found.B]), apart, wrong


def examined(machine: Machine, rows: int, coordinates: str = "joint") -> Found:
    """Return what became of the steps over the values of a parameter."""
    model, matrices, failed, most = machine.model(), list[Array](), list[str](), 0.0
    if machine.file is None:
        own = lifted("load", model.mechanism, ("bodies.shank.mass",))
        machine, model = replace(machine, parameter=own.keys["bodies.shank.mass"]), Model(own.mechanism)
    for value in np.linspace(*machine.values, rows):
        try:
            matrix, apart, wrong = stepped(machine, model, float(value), coordinates)
        except Exception as error:  # counted, and said
            failed.append(f"{value:g}: {error}")
            continue
        matrices.append(matrix)
        failed += [f"{value:g}: {x}" for x in wrong]
        most = max(most, apart)
    all_of = np.array(matrices)
    n = all_of.shape[1]
    bends = [
        np.abs(np.diff(part, 2, axis=0)).max() / np.abs(part).max() for part in (all_of[:, :, :n], all_of[:, :, n:])
    ]
    return Found(failed, most, float(max(bends)))


def main() -> int:
    """Print a line for each machine; return 1 where a step fails."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("machines", nargs="*", default=[], metavar="|".join(MACHINES))
    parser.add_argument("--rows", type=int, default=300)
    options = parser.parse_args()
    table, bad = Table("machine", "coordinates", "values", "failed", "apart", "second differences"), False
    for name in options.machines or MACHINES:
        for coordinates in ("joint", "absolute"):
            found = examined(MACHINES[name], options.rows, coordinates)
            numbers = str(options.rows), str(len(found.failed)), f"{found.apart:.1e}", f"{found.bend:.1e}"
            table.add_row(name, coordinates, *numbers)
            print(name, coordinates, *numbers, *found.failed[:3], flush=True)
            bad = bad or bool(found.failed)
    show(table)
    return int(bad)


if __name__ == "__main__":
    raise SystemExit(main())
