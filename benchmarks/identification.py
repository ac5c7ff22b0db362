"""Identification from noisy records: how many of 95 % intervals cover the value, beside scipy with differences.

    python -m benchmarks.identification                       the table of its page, from the record
    python -m benchmarks.records identification --workers N   measures the record, a quarter of an hour of one core

Each case is a mechanism with numbers to be found, and a column that is measured at 101 times with independent noise.
Records are runs with the true values, each with noise of its own; a fit begins 10 % off. All runs take the same
constant steps, so that nothing but the noise is in the way.

A batch of records is fitted at once: Gauss and Newton's method, with a sweep over all values and their neighbours in
each step, and the interval that `identify` gives. Some fits of each batch are made again, by `identify`, which has
exact derivatives, and by `scipy.optimize.least_squares` with differences of plain runs.
"""

from __future__ import annotations

import math
import random
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from benchmarks.page_tables import PageTable, print_tables, step_size
from benchmarks.records import Line, Pair, Record

Array = NDArray[np.float64]

ROTOR = """
[mechanism]
name = "rotor"
gravity = [0.0, 0.0]
[parameters]
sliding = { value = 0.3, unit = "N m" }
viscous = { value = 0.05, unit = "N m s" }
slow = { value = 0.5, unit = "rad/s" }
[bodies.rotor]
mass = 1.0
inertia = 0.2
[joints.pin]
type = "revolute"
between = ["ground", "rotor"]
at = [[0.0, 0.0], "centre"]
friction = { sliding = "sliding", static = 0.5, viscous = "viscous", stribeck_speed = "slow" }
[forces.drive]
type = "torque"
body = "rotor"
torque = "1.2*sin(2*t)"
"""
BALL = """
[mechanism]
name = "ball"
gravity = [0.0, -9.81]
[parameters]
height = { value = 1.0, unit = "m" }
restitution = 0.7
[bodies.ball]
mass = 1.0
inertia = 0.1
position = [0.0, "height"]
[stops.floor]
gap = "ball.y"
restitution = "restitution"
"""
DRIVE = """
[mechanism]
name = "drive"
gravity = [0.0, 0.0]
[parameters]
play = { value = 0.1, unit = "rad" }
drag = { value = 0.05, unit = "N m s/rad" }
[bodies.motor]
mass = 1.0
inertia = 0.01
[bodies.load]
mass = 1.0
inertia = 0.05
[joints.shaft]
type = "revolute"
between = ["ground", "motor"]
at = [[0.0, 0.0], "centre"]
[joints.gear]
type = "revolute"
between = ["motor", "load"]
at = ["centre", "centre"]
stop = { lower = "-play/2", upper = "play/2", restitution = 0.2 }
[forces.torque]
type = "torque"
body = "motor"
torque = "0.5*sin(10*t)"
[forces.drag]
type = "torsional-spring-damper"
between = ["ground", "load"]
damping = "drag"
"""


@dataclass(frozen=True)
class Case:
    """A mechanism, and what is measured of it.

    Attributes
    ----------
    what : str
        What it is, as its page has it.
    text : str
        Its file, with the true values.
    quantity : str
        Column that is measured.
    until : float
        Time of the last measurement [s].
    noise : float
        Standard deviation of the noise.
    step : float
        Step of all runs [s].
    true : mapping of str to float
        True values of the numbers to be found.
    """

    what: str
    text: str
    quantity: str
    until: float
    noise: float
    step: float
    true: Mapping[str, float]


CASES = {
    "joint": Case(
        "joint with friction that falls with the speed",
        *(ROTOR, "rotor.theta", 4.0, 0.003, 0.04),
        {"sliding": 0.3, "viscous": 0.05, "slow": 0.5},
    ),
    "ball": Case("bouncing ball", BALL, "ball.y", 2.0, 0.01, 0.04, {"restitution": 0.7, "height": 1.0}),
    "backlash": Case("drive with play", DRIVE, "load.theta", 0.5, 0.001, 0.005, {"play": 0.1, "drag": 0.05}),
}
#: Fits of a case, those of a batch, those of them that `identify` makes too, and measurements of a record.
FITS, BATCH, ALSO, TIMES = 1000, 100, 2, 101
#: A fit begins at this multiple of the true values.
BEGUN = 1.1
#: Width of differences, relative to a value; a correction below this part of a standard error is none.
WIDTH, STILL = 1e-5, 1e-6
#: Processor time of a batch at most [s].
PATIENCE = 280.0
#: Two-sided quantile of 95 % of a normal distribution.
_QUANTILE = 1.959964


class Job(NamedTuple):
    """A number of fits of a case, each to a record of its own."""

    case: str
    batch: int


@dataclass(frozen=True)
class Subject:
    """A case that is ready: its model, and its column without noise.

    Attributes
    ----------
    case : Case
        The case.
    model : Model
        Its model.
    settings : mapping
        Settings of its runs.
    t, clean : Array
        Times [s], and the column without noise.
    """

    case: Case
    model: Any
    settings: Mapping[str, Any]
    t: Array
    clean: Array

    def record(self, number: int) -> Array:
        """Return the measured column of record `number`."""
        dice = np.random.default_rng([*CASES.values()].index(self.case) * FITS + number)
        return self.clean + self.case.noise * dice.standard_normal(len(self.t))

    @property
    def begun(self) -> dict[str, float]:
        """The values at which fits begin."""
        return {name: BEGUN * value for name, value in self.case.true.items()}

    def fit(self, number: int) -> Any:
        """Return the fit to record `number`."""
        data = {"t": self.t, self.case.quantity: self.record(number)}
        return self.model.identify(data, free=tuple(self.case.true), parameters=self.begun, **self.settings)

    def by_differences(self, number: int) -> tuple[Array, int]:
        """Return the fit of a record by `scipy.optimize.least_squares` with differences, and its count of runs."""
        from scipy.optimize import least_squares

        names, data, runs = tuple(self.case.true), self.record(number), 0

        def residuals(x: Array) -> Array:
            nonlocal runs
            runs += 1
            values = dict(zip(names, map(float, x), strict=True))
            keys: dict[str, Any] = {"parameters": values, "times": self.t, "until": self.case.until, "verify": False}
            result = self.model.simulate(**keys, **self.settings)
            return np.asarray(result[self.case.quantity]) - data

        start = np.array([*self.begun.values()])
        solution = least_squares(residuals, start, x_scale=start)
        return solution.x, runs


@cache
def subject(name: str) -> Subject:
    """Return a case that is ready."""
    import symgen

    case = CASES[name]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"{name}.toml"
        path.write_text(case.text, encoding="utf-8")
        model = symgen.load(path)
    options = {"integrator.adaptive": "false"}
    settings: dict[str, Any] = {"step": case.step, "integrator": "dopri5", "options": options}
    t = np.linspace(0.0, case.until, TIMES)
    clean = model.simulate(times=t, until=case.until, verify=False, **settings)[case.quantity]
    return Subject(case, model, settings, t, np.array(clean))


@dataclass(frozen=True)
class Fitted:
    """Fits of a batch.

    Attributes
    ----------
    x, errors : Array, shape (fits, numbers)
        Values and their standard errors.
    half : Array, shape (fits, numbers)
        Halves of the 95 % intervals.
    steps : int
        Steps of the iteration.
    """

    x: Array
    errors: Array
    half: Array
    steps: int


def columns_at(own: Subject, x: Array) -> tuple[Array, Array]:
    """Return the column of each row of values, by rows and times, and its derivatives, by rows, times and numbers."""
    rows, names = len(x), tuple(own.case.true)
    widths = WIDTH * np.abs(x)
    points = [x] + [x + sign * widths * (np.arange(len(names)) == k) for k in range(len(names)) for sign in (1, -1)]
    runs = dict(zip(names, np.concatenate(points).T.tolist(), strict=True))
    study = own.model.sweep(
        runs=runs, quantities=[own.case.quantity], times=own.t, until=own.case.until, **own.settings
    )
    if study.counts["failed"]:
        raise ArithmeticError(f"{study.counts['failed']} rows of {own.case.what} failed")
    values = np.asarray(study[own.case.quantity]).reshape(len(points), rows, len(own.t))
    slopes = [(values[1 + 2 * k] - values[2 + 2 * k]) / (2.0 * widths[:, k, None]) for k in range(len(names))]
    return values[0], np.stack(slopes, axis=-1)


def fitted(own: Subject, numbers: range) -> Fitted:
    """Fit records by Gauss and Newton's method, whose steps are shortened where they lead up."""
    from scipy.stats import t as student

    data = np.array([own.record(k) for k in numbers])
    x = np.tile([*own.begun.values()], (len(data), 1))
    values, slopes = columns_at(own, x)
    change, part, steps = corrections(values - data, slopes), np.ones(len(data)), 0
    while steps < 60:
        steps += 1
        tried = x + part[:, None] * np.clip(change, -0.2 * np.abs(x), 0.2 * np.abs(x))
        new_values, new_slopes = columns_at(own, tried)
        better = np.sum((new_values - data) ** 2, axis=1) <= np.sum((values - data) ** 2, axis=1)
        errors = standard_errors(values - data, slopes)
        still = np.all(np.abs(tried - x) < STILL * errors, axis=1)
        x, values = np.where(better[:, None], tried, x), np.where(better[:, None], new_values, values)
        slopes = np.where(better[:, None, None], new_slopes, slopes)
        change, part = corrections(values - data, slopes), np.where(better, 1.0, part / 4.0)
        if np.all(still):
            break
    errors = standard_errors(values - data, slopes)
    factor = float(student.ppf(0.975, len(own.t) - x.shape[1]))
    return Fitted(x, errors, factor * errors, steps)


def corrections(residuals: Array, slopes: Array) -> Array:
    """Return the corrections of Gauss and Newton's method."""
    changes: Array = np.array([np.linalg.lstsq(j, -r, rcond=None)[0] for r, j in zip(residuals, slopes, strict=True)])
    return changes


def standard_errors(residuals: Array, slopes: Array) -> Array:
    """Return the standard errors of a model that is linear near its fit."""
    variance = np.sum(residuals**2, axis=1) / (residuals.shape[1] - slopes.shape[2])
    covariance = np.linalg.inv(np.swapaxes(slopes, 1, 2) @ slopes)
    errors: Array = np.sqrt(variance[:, None] * np.diagonal(covariance, axis1=1, axis2=2))
    return errors


def examine(job: Job, fits: int = BATCH, also: int = ALSO) -> dict[str, Any]:
    """Return of a batch, for each number, how many intervals cover it, and sums of its errors over standard errors.

    Besides: sums of squares of the latter, standard errors over values, and the processor time; of the fits that
    `identify` makes too its runs and time, those by differences, and the largest distance of results and of ends of
    intervals, in standard errors.
    """
    own, first = subject(job.case), BATCH * job.batch
    true, began = np.array([*own.case.true.values()]), time.process_time()
    batch = fitted(own, range(first, first + fits))
    seconds = time.process_time() - began
    scaled = (batch.x - true) / batch.errors
    line: dict[str, Any] = {
        "inside": np.sum(np.abs(batch.x - true) <= batch.half, axis=0).tolist(),
        "bias": scaled.sum(axis=0).tolist(),
        "square": (scaled**2).sum(axis=0).tolist(),
        "errors": (batch.errors.mean(axis=0) / true).tolist(),
        "seconds": seconds,
        **{"runs": [], "each": [], "differences": [], "apart": 0.0, "ends": 0.0},
    }
    for k in range(also):
        began = time.process_time()
        fit = own.fit(first + k)
        line["each"].append(time.process_time() - began)
        other, runs = own.by_differences(first + k)
        line["runs"].append(fit.runs)
        line["differences"].append(runs)
        x, ends = np.array([*fit.parameters.values()]), np.array([*fit.intervals.values()])
        for each in (x, other):
            line["apart"] = max(line["apart"], float(np.abs((each - batch.x[k]) / batch.errors[k]).max()))
        own_ends = np.stack([batch.x[k] - batch.half[k], batch.x[k] + batch.half[k]], axis=1)
        line["ends"] = max(line["ends"], float(np.abs((ends - own_ends) / batch.errors[k, :, None]).max()))
    return line


def again(stored: Line, dice: random.Random) -> Iterator[Pair]:
    """Yield the intervals that cover values of a batch, and their widths, beside those measured again."""
    job = Job(stored["case"], stored["batch"])
    new = examine(job, also=0)
    for k, name in enumerate(CASES[job.case].true):
        what = f"{job.case} {job.batch}, {name}"
        yield Pair(f"{what}: intervals that cover it", stored["inside"][k], new["inside"][k])
        yield Pair(f"{what}: standard error", stored["errors"][k], new["errors"][k])


def jobs() -> Iterator[Job]:
    """Yield all batches, those of all cases in turns."""
    return (Job(case, batch) for batch in range(FITS // BATCH) for case in CASES)


RECORD = Record("identification", jobs, examine, again, PATIENCE, share=0.05)


# -- the page ----------------------------------------------------------------------------------------------------------


def batches(case: str) -> list[Line]:
    """Return the stored batches of a case."""
    return [line for line in RECORD.lines() if line["case"] == case and "inside" in line]


def covered(case: str, k: int) -> tuple[int, int]:
    """Return how many intervals cover number `k` of a case, and how many there are."""
    lines = batches(case)
    return sum(line["inside"][k] for line in lines), BATCH * len(lines)


def interval(hits: int, count: int) -> tuple[float, float]:
    """Return the 95 % interval of a share, by Wilson [1]."""
    z, share = _QUANTILE, hits / count
    middle = (share + z * z / (2.0 * count)) / (1.0 + z * z / count)
    half = z * math.sqrt(share * (1.0 - share) / count + (z / (2.0 * count)) ** 2) / (1.0 + z * z / count)
    return middle - half, middle + half


def median(values: list[float]) -> float:
    """Return the median of values."""
    return float(np.median(values))


def digit(x: float) -> str:
    """Return a number with one digit, such as 2e-3."""
    return step_size(float(f"{x:.0e}"))


def page_table() -> PageTable:
    """Return the table of the fits, a row for each number."""

    def cells(case: str, k: int) -> list[str]:
        lines, (hits, count) = batches(case), covered(case, k)
        low, high = interval(hits, count)
        bias, square = (sum(line[key][k] for line in lines) / count for key in ("bias", "square"))
        return [
            f"{100.0 * np.mean([line['errors'][k] for line in lines]):.2f}",
            f"{100.0 * hits / count:.1f} ({100.0 * low:.1f} to {100.0 * high:.1f})",
            f"{round(bias, 2) + 0.0:.2f}",
            f"{math.sqrt(square):.2f}",
            f"{median([runs for line in lines for runs in line['runs']]):.0f}",
            f"{median([runs for line in lines for runs in line['differences']]):.0f}",
        ]

    rows = tuple(
        ((case.what if k == 0 else "", f"`{number}`"), partial(cells, name, k))
        for name, case in CASES.items()
        for k, number in enumerate(case.true)
    )
    headings = (
        "case",
        "number",
        "standard error [%]",
        "covered [%]",
        "mean error",
        "deviation",
        "runs",
        "by differences",
    )
    return PageTable("identification", "docs/tables/sensitivities.md", headings, rows, stored=True, claims=claims)


def claims() -> Iterator[str]:
    """Yield what the page says of the fits."""
    lines = [line for case in CASES for line in batches(case)]
    seconds = [sum(line["seconds"] for line in batches(case)) for case in CASES]
    yield f"A thousand fits by sweeps took {min(seconds):.0f} to {max(seconds):.0f} s of the processor."
    each = [median([time for line in batches(case) for time in line["each"]]) for case in CASES]
    yield f"One by `identify` took {min(each):.2f} to {max(each):.2f} s."
    apart, ends = (max(line[key] for line in lines) for key in ("apart", "ends"))
    yield (
        f"Of {ALSO * len(lines)} fits that were made in all three ways, results were at most {digit(apart)} of a "
        f"standard error apart, and ends of intervals {digit(ends)}."
    )


if __name__ == "__main__":
    sys.exit(print_tables({"identification": page_table()}, ()))
