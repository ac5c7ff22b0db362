"""Derivatives of a step while a parameter varies: none fails, all are smooth, and all are those of differences.

    python -m benchmarks.step_sweeps [press] [bucket] [wiper] [leg] [--rows 300]

A press and a bucket leave their stops inside the step, at a time that depends on what varies. What rests on a stop
moves with it and with nothing else, so there the derivatives by the state are those along a motion of the stop.
Differences are of sixth order, of the same step from states and inputs nearby. Where an event passes from one step of
the scheme to the next the step has a kink, as high as the error of the scheme: there they are of one side.
"""

from __future__ import annotations

import argparse
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from rich.table import Table

from benchmarks.bounded.machines import FOLDER
from benchmarks.closed_leg import leg
from benchmarks.show import show
from symgen.analyses.functions.model_functions import Functions
from symgen.api import Model
from symgen.describe.facts.lifted import lift_numbers
from symgen.describe.files.validate import validate
from symgen.result.stepping.stepped_run import SteppedRun
from symgen.run.layout import abi

Array = np.ndarray[Any, np.dtype[np.float64]]
CATALOGUE = Path(__file__).parents[1] / "symgen" / "describe" / "catalogue" / "machines"
#: Input that turns a body, and parameter that moves a stop.
INPUT, SHIFT = "extra", "shift"
#: Weights of differences by the numbers of their points: central ones, ahead and behind.
CENTRAL = {1: 3 / 4, -1: -3 / 4, 2: -3 / 20, -2: 3 / 20, 3: 1 / 60, -3: -1 / 60}
AHEAD = {0: -49 / 20, 1: 6.0, 2: -15 / 2, 3: 20 / 3, 4: -15 / 4, 5: 6 / 5, 6: -1 / 6}
BEHIND = {-k: -weight for k, weight in AHEAD.items()}
#: Differences that are farther apart are made again with a tenth and a hundredth of the width.
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
        Widths of differences by the state, or by the place of the stop [m], and by the input.
    rests : str
        The joint that rests on its lower stop where the step begins, or nothing.
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
    rests: str = ""

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
        if self.rests:
            raw["parameters"][SHIFT] = {"value": 0.0, "unit": "m"}
            joint = raw["joints"][self.rests]
            for keys, key in ((joint["stop"], "lower"), (joint["start"], "displacement")):
                keys[key] = f"{keys[key]} + {SHIFT}"
        return Model(validate(raw, self.file.stem))


MACHINES = {
    "press": Machine(
        FOLDER / "press.toml", "lower", "m", (4.0, 6.0), 0.25, 0.15, 1e-2, "guide.lower.leave", (1e-3, 1e-3), "guide"
    ),
    "bucket": Machine(
        *(FOLDER / "bucket.toml", "rocker", "dig", (17e3, 23e3), 0.25, 0.2, 5e-3, "cylinder.lower.leave"),
        *((1e-4, 1.0), "cylinder"),
    ),
    "wiper": Machine(CATALOGUE / "wiper.toml", "arm", "arm_mass", (0.2, 0.8), 0.2, 0.01, 1e-4),
    "leg": Machine(None, "thigh", "load", (0.3, 1.2), 0.1, 0.01, 1e-3),
}


class Ended(NamedTuple):
    """The state after a step, and the steps of the scheme in which its events were."""

    state: Array
    steps: tuple[int, ...]


class Comparison(NamedTuple):
    """The derivatives of a step beside differences.

    Attributes
    ----------
    matrix : Array
        A along the changes that rows and stops allow, and B beside it.
    apart : float
        Largest distance from differences, over the largest of a column.
    wrong : sequence of str
        Doubts, and other events than that of the machine.
    """

    matrix: Array
    apart: float
    wrong: Sequence[str]


class Sweep(NamedTuple):
    """The steps of a machine over the values of a parameter.

    Attributes
    ----------
    failed : sequence of str
        Errors, doubts, and steps without the event.
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
    return np.asarray(sum(weight / h * of(k * h) for k, weight in CENTRAL.items()))


def slope(of: Callable[[float], Ended], h: float) -> Array | None:
    """Return the derivative of a state at zero, from a side on which its events stay in their steps; None without."""
    here = of(0.0).steps
    for weights in (CENTRAL, AHEAD, BEHIND):
        points = {k: of(k * h) for k in weights}
        if all(point.steps == here for point in points.values()):
            return np.asarray(sum(weight / h * points[k].state for k, weight in weights.items()))
    return None


def allowed(f: Functions, y: Array) -> Array:
    """Return changes of a state that leave rows as they are, one a column."""
    n = len(f.coordinates)

    def held(x: Array) -> Array:
        return np.concatenate([f.violation(x[:n]), f.constraint_jacobian(x[:n]) @ x[n:]])

    def along(way: Array) -> Callable[[float], Array]:
        return lambda h: held(y + h * way)

    slopes = np.column_stack([difference(along(way), 1e-4) for way in np.eye(len(y))])
    _, sizes, ways = np.linalg.svd(slopes)
    return np.asarray(ways[np.count_nonzero(sizes > 1e-8 * sizes.max(initial=1.0)) :].T)


def _distance(own: Array, of: Callable[[float], Ended], h: float) -> float:
    """Return how far a derivative is from differences, narrower ones where that is far or a kink is near."""
    apart = np.inf
    for width in (h, 0.1 * h, 0.01 * h):
        by_differences = slope(of, width)
        if by_differences is None:
            continue
        apart = min(apart, float(np.abs(own - by_differences).max() / np.abs(by_differences).max()))
        if apart < NEAR:
            break
    return apart


class Step:
    """The step of a machine at a value of its parameter, in some coordinates."""

    def __init__(self, machine: Machine, model: Model, value: float, coordinates: str) -> None:
        self.machine, self.model, self.value, self.coordinates = machine, model, value, coordinates
        self.run = self._before({})
        self.saved, self._passed = self.run.save(), len(self.run.events)
        self.run.step(machine.dt)
        self.derivatives = self.run.derivatives()
        self.inputs = {name: self.run.parameters[name] for name in self.derivatives.inputs}
        self.events = [event.name for event in list(self.run.events)[self._passed :]]

    def _before(self, parameters: Mapping[str, float]) -> SteppedRun:
        """Return a run up to the step."""
        run = self.model.start(
            parameters={self.machine.parameter: self.value, **parameters},
            coordinates=self.coordinates,
            integrator="rk4",
            step=self.machine.step,
            max_violation=1e6,
            max_energy_error=1e6,
        )
        run.step(self.machine.begin)
        return run

    def _ended(self, run: SteppedRun) -> Ended:
        times = [event.t - self.machine.begin for event in list(run.events)[self._passed :]]
        return Ended(np.array(run.state), tuple(int(t / self.machine.step) for t in times))

    def after(self, change: Array, inputs: Mapping[str, float]) -> Ended:
        """Return the end of the step from another state, with other inputs."""
        arrays = {key: x.copy() for key, x in self.saved.arrays.items()}
        arrays["y"][: len(change)] += change
        arrays["control"][abi.BEGUN] = abi.AFRESH
        self.run.restore(replace(self.saved, arrays=arrays))
        self.run.step(self.machine.dt, {**self.inputs, **inputs})
        return self._ended(self.run)

    def at_rest(self, shift: float) -> tuple[Array, Ended]:
        """Return the state before and the end of the step where the stop is moved [m]."""
        run = self._before({SHIFT: shift})
        before = np.array(run.state)
        run.step(self.machine.dt)
        return before, self._ended(run)

    @property
    def start(self) -> Array:
        """The state before."""
        return np.asarray(self.saved.arrays["y"][: len(self.derivatives.states)])

    def ways(self) -> Array:
        """Return the changes of the state before that rows and stops allow, one a column."""
        if self.machine.rests:
            return difference(lambda shift: self.at_rest(shift)[0], self.machine.changes[0])[:, np.newaxis]
        f = self.model.functions(self.coordinates, {self.machine.parameter: self.value})
        names = tuple(x.name for x in (*f.coordinates, *f.velocities))
        assert names == self.derivatives.states, "functions have the states of runs"
        return allowed(f, self.start)

    def compared(self) -> Comparison:
        """Return the derivatives beside differences."""
        derivatives, ways, (width, of_input) = self.derivatives, self.ways(), self.machine.changes
        still, distances = np.zeros(len(derivatives.states)), list[float]()
        if self.machine.rests:
            distances.append(_distance(derivatives.A @ ways[:, 0], lambda shift: self.at_rest(shift)[1], width))
        for way in () if self.machine.rests else ways.T:
            of_state = partial(lambda way, h: self.after(h * way, {}), way)
            distances.append(_distance(derivatives.A @ way, of_state, width))
        for k, (name, value) in enumerate(self.inputs.items()):
            by_input = partial(lambda name, value, h: self.after(still, {name: value + h}), name, value)
            distances.append(_distance(derivatives.B[:, k], by_input, of_input))
        # off the rows, corrections of one and of two iterations have other derivatives
        matrix = np.hstack([derivatives.A @ ways @ np.linalg.pinv(ways), derivatives.B])
        expected = [self.machine.event] if self.machine.event else []
        wrong = [*derivatives.doubts, *([] if self.events == expected else [f"events {self.events}"])]
        return Comparison(matrix, max(distances), wrong)


def examined(machine: Machine, rows: int, coordinates: str = "joint") -> Sweep:
    """Return the derivatives of steps over the values of a parameter, beside differences."""
    model, matrices, failed, most = machine.model(), list[Array](), list[str](), 0.0
    if machine.file is None:
        own = lift_numbers("load", model.mechanism, ("bodies.shank.mass",))
        machine, model = replace(machine, parameter=own.keys["bodies.shank.mass"]), Model(own.mechanism)
    for value in np.linspace(*machine.values, rows):
        try:
            compared = Step(machine, model, float(value), coordinates).compared()
        except Exception as error:  # counted, and said
            failed.append(f"{value:g}: {error}")
            continue
        matrices.append(compared.matrix)
        failed += [f"{value:g}: {x}" for x in compared.wrong]
        most = max(most, compared.apart)
    return Sweep(failed, most, bend(np.array(matrices)) if len(matrices) > 2 else np.inf)


def bend(matrices: Array) -> float:
    """Return the largest second difference of A and B along the sweep, over the largest element of each."""
    n = matrices.shape[1]
    parts = matrices[:, :, :n], matrices[:, :, n:]
    return float(max(np.abs(np.diff(part, 2, axis=0)).max() / np.abs(part).max() for part in parts))


def main() -> int:
    """Print a line for each machine; return 1 where a step fails."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("machines", nargs="*", default=[], metavar="|".join(MACHINES))
    parser.add_argument("--rows", type=int, default=300)
    options = parser.parse_args()
    table, bad = Table("machine", "coordinates", "values", "failed", "apart", "second differences"), False
    for name in options.machines or MACHINES:
        for coordinates in ("joint", "absolute"):
            sweep = examined(MACHINES[name], options.rows, coordinates)
            numbers = str(options.rows), str(len(sweep.failed)), f"{sweep.apart:.1e}", f"{sweep.bend:.1e}"
            table.add_row(name, coordinates, *numbers)
            print(name, coordinates, *numbers, *sweep.failed[:3], flush=True)
            bad = bad or bool(sweep.failed)
    show(table)
    return int(bad)


if __name__ == "__main__":
    raise SystemExit(main())
