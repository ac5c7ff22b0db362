"""Derivatives of runs with contacts while a parameter varies: right within the errors of differences, or in doubt.

    python -m benchmarks.contact_sweeps [bounce] [rock] [meeting] [wedge] [sled] [play] [woodpecker] [--rows 300]

Each value is a run with exact derivatives, beside differences of runs nearby: central ones of three widths, each with
half of it (Richardson). Their error is the least change from one width to the next. Between two values with other
events, the place where the order changes is found by bisection; derivatives on both sides of it are those of one-sided
differences. Where the outcome has a kink inside the widths, differences are narrower and of one side, and less exact.
Adjoints are beside some of the derivatives.
"""

from __future__ import annotations

import argparse
import tempfile
from collections import Counter
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from rich.table import Table

import symgen
from benchmarks.bounded.touch.kinds import drawn
from benchmarks.mechanisms.toml import text as toml
from benchmarks.show import show

Array = np.ndarray[Any, np.dtype[np.float64]]
#: Settings of runs, and of runs that are differenced.
OWN: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-11, "atol": 1e-12, "verify": False}
NEARBY: dict[str, Any] = OWN | {"rtol": 1e-12, "atol": 1e-13}
#: Ratio of two widths of differences, number of widths, and how often one-sided differences are narrower.
NARROWER, WIDTHS = 8.0, 3
#: Errors of one-sided differences up to which a derivative is right, beside a part of the largest one: the sum of a
#: series has rounding, and changes with the number of its impacts, so that differences nearby agree by chance.
WITHIN, ROUNDING = 4.0, 1e-6
#: Widths of differences beside a kink, over the range of the values, and errors of runs that are differenced.
BESIDE, NOISE = tuple(1e-5 * 4.0**-k for k in range(9)), 1e-11
#: Every so many values have an adjoint.
ADJOINTS = 30


@dataclass(frozen=True)
class Machine:
    """A machine whose runs are differentiated.

    Parameters
    ----------
    file : str
        Its text, or its name in the catalogue.
    parameter : str
        What varies.
    values : (float, float)
        Between what.
    until, outcome : float, str
        End of the runs [s], and the column whose derivatives are found there.
    width : float
        The largest width of differences, over the range of the values.
    """

    file: str
    parameter: str
    values: tuple[float, float]
    until: float
    outcome: str
    width: float = 1e-3

    @cached_property
    def model(self) -> symgen.Model:
        """The machine."""
        if "\n" not in self.file:
            return symgen.load(self.file)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "machine.toml"
            path.write_text(self.file, encoding="utf-8")
            return symgen.load(path)

    def ends(self, values: Array) -> Array:
        """Return the outcomes of runs over values, nan where a run has none."""
        table = self.model.sweep(vary={self.parameter: values.ravel()}, until=self.until, **NEARBY).to_dataframe()
        (key,) = [key for key in table.columns if key.split(" ")[0] == self.outcome]
        ends = np.where(table["status"].isin(("ok", "unverified")), table[key], np.nan)
        return np.asarray(ends, dtype=float).reshape(values.shape)


def varied(kind: str, seed: int, contact: str, key: str) -> str:
    """Return the file of a random scene in which a parameter is a coefficient of a contact."""
    raw = drawn(kind, seed).raw
    raw["parameters"] = {key: raw["contacts"][contact][key]}
    raw["contacts"][contact][key] = key
    return toml(raw)


#: A spinning disc that bounces ever more slowly, rests and rolls.
BOUNCE = """[mechanism]
name = "bounce"
gravity = [0.0, -9.81]
[parameters]
mu = 0.05
e = 0.7
[bodies.disc]
mass = 2.0
inertia = 0.01
position = [0.0, 1.1]
angular_velocity = 30.0
[contacts.floor]
between = [{ body = "disc", disc = 0.1 }, { line = "ground" }]
friction = "mu"
restitution = "e"
"""
MACHINES = {
    "bounce": Machine(BOUNCE, "e", (0.2, 0.75), 4.0, "disc.x"),
    "rock": Machine("rocking-block", "mu", (0.05, 0.5), 5.0, "block.x"),
    "meeting": Machine(varied("meeting", 6, "c3", "restitution"), "restitution", (0.05, 0.7), 0.9, "two.theta"),
    "wedge": Machine(varied("wedge", 1, "c1", "restitution"), "restitution", (0.1, 0.7), 1.0, "wedge.x"),
    "sled": Machine(varied("sled", 29, "c1", "friction"), "friction", (0.3, 0.6), 0.4, "disc.theta"),
    "play": Machine("slider-crank-with-clearance", "mu", (0.01, 0.3), 0.004, "slider.x"),
    "woodpecker": Machine("woodpecker", "mu", (0.25, 0.35), 0.3, "sleeve.y"),
}


class Derivative(NamedTuple):
    """A derivative of a run: the value of the parameter, the outcome's slope, status, reason, and events."""

    value: float
    slope: float
    status: str
    reason: str
    events: tuple[str, ...]


class Sweep(NamedTuple):
    """Derivatives over the values of a parameter, beside differences.

    Attributes
    ----------
    statuses : Counter
        Of the runs.
    apart, adjoint : float
        Largest distance of derivatives from differences, over the largest derivative, and of adjoints from derivatives.
    kinks, orders, changes : int
        Numbers of values beside a kink, of different orders of events, and of changes of the order that were found.
    wrong : list of str
        Derivatives that are `ok` and not those of differences.
    reasons : set of str
        Why others are not `ok`.
    """

    statuses: Counter[str]
    apart: float
    adjoint: float
    kinks: int
    orders: int
    changes: int
    wrong: list[str]
    reasons: set[str]


def derivative(machine: Machine, value: float) -> Derivative:
    """Return the derivative of a run at a value."""
    run = machine.model.simulate(
        parameters={machine.parameter: value}, until=machine.until, sensitivities=[machine.parameter], **OWN
    )
    slope = float(run.gradient(machine.outcome).values[-1, 0]) if run.status in ("ok", "unverified") else np.nan
    return Derivative(value, slope, run.status, run.reason or "", tuple(event.name for event in run.events))


def differences(machine: Machine, values: Array) -> tuple[Array, Array]:
    """Return derivatives by central differences at values, and their errors."""
    widths = machine.width * (machine.values[1] - machine.values[0]) * NARROWER ** -np.arange(WIDTHS)
    points = widths[:, np.newaxis] * np.array([-1.0, 1.0, -0.5, 0.5])
    ends = machine.ends(values[:, np.newaxis, np.newaxis] + points)
    whole, half = ((ends[..., k + 1] - ends[..., k]) / (points[:, k + 1] - points[:, k]) for k in (0, 2))
    extrapolated = (4.0 * half - whole) / 3.0
    errors = np.abs(np.diff(extrapolated, axis=1))
    best = np.argmin(np.where(np.isfinite(errors), errors, np.inf), axis=1)
    at = np.arange(len(values))
    return extrapolated[at, best + 1], errors[at, best]


def from_one_side(machine: Machine, value: float, way: float) -> tuple[float, float]:
    """Return a derivative by differences on one side of a value, and its error."""
    slopes = list[float]()
    for width in machine.width * (machine.values[1] - machine.values[0]) * NARROWER ** -np.arange(1.0, 1.0 + WIDTHS):
        f = machine.ends(value + way * width * np.array([0.0, 0.5, 1.0, 1.5, 2.0]))
        slopes.append(float(way * np.dot((-25.0, 48.0, -36.0, 16.0, -3.0), f) / (6.0 * width)))
    errors = np.abs(np.diff(slopes))
    best = int(np.argmin(np.where(np.isfinite(errors), errors, np.inf)))
    return slopes[best + 1], float(errors[best])


def between(machine: Machine, one: Derivative, other: Derivative) -> tuple[Derivative, Derivative]:
    """Return neighbours with different events between two others, as near to each other as 1e-12 of the range."""
    near = 1e-12 * (machine.values[1] - machine.values[0])

    def events(value: float) -> tuple[str, ...]:
        run = machine.model.simulate(parameters={machine.parameter: value}, until=machine.until, **OWN)
        return tuple(event.name for event in run.events)

    low, high = one.value, other.value
    while high - low > near:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if events(middle) == one.events else (low, middle)
    return derivative(machine, low), derivative(machine, high)


def is_beside_kink(machine: Machine, value: float, slope: float, most: float) -> bool:
    """Return whether a derivative is that of narrower differences, on one side of a value at least."""
    for width in (machine.values[1] - machine.values[0]) * np.array(BESIDE):
        for way in (-1.0, 1.0):
            f = machine.ends(value + way * width * np.array([0.0, 0.5, 1.0]))
            by_difference = float(way * np.dot((-3.0, 4.0, -1.0), f)) / width
            if abs(slope - by_difference) <= ROUNDING * most + NOISE / width:
                return True
    return False


def is_right(slope: float, reference: float, error: float, most: float) -> bool:
    """Return whether a derivative is that of differences, whose error is known."""
    return bool(abs(slope - reference) <= WITHIN * error + ROUNDING * most)


def examined(machine: Machine, rows: int, changes: int = 8, adjoints: int = ADJOINTS) -> Sweep:
    """Return the derivatives of runs over the values of a parameter, beside differences."""
    values = np.linspace(*machine.values, rows)
    own = [derivative(machine, float(value)) for value in values]
    slopes, (reference, errors) = np.array([x.slope for x in own]), differences(machine, values)
    good = np.array([x.status == "ok" for x in own])
    most = float(np.nanmax(np.abs(slopes[good]), initial=0.0))
    smooth = good & (np.abs(slopes - reference) <= ROUNDING * most)
    kinks = [k for k in np.flatnonzero(good & ~smooth) if is_beside_kink(machine, values[k], slopes[k], most)]
    wrong = [
        f"{own[k].value!r}: {slopes[k]!r}, by differences {reference[k]!r} with an error of {errors[k]:.1g}"
        for k in np.flatnonzero(good & ~smooth)
        if k not in kinks
    ]
    apart = float(np.max(np.abs(slopes - reference)[smooth], initial=0.0)) / most
    changed = [k for k in range(rows - 1) if own[k].events != own[k + 1].events]
    chosen = [changed[k * len(changed) // changes] for k in range(changes)] if len(changed) > changes else changed
    for k in chosen:
        for side, way in zip(between(machine, own[k], own[k + 1]), (-1.0, 1.0), strict=True):
            reference_here, error_here = from_one_side(machine, side.value, way)
            right = is_right(side.slope, reference_here, error_here, most)
            if side.status == "ok" and not right and not is_beside_kink(machine, side.value, side.slope, most):
                from_side = f"from its side {reference_here!r} with an error of {error_here:.1g}"
                wrong.append(f"{side.value!r}: {side.slope!r}, {from_side}")
    back = 0.0
    for x in (own[k] for k in range(0, rows, adjoints) if good[k]):
        gradient = machine.model.gradient(
            machine.outcome,
            by=[machine.parameter],
            parameters={machine.parameter: x.value},
            until=machine.until,
            way="adjoint",
            integrator="dop853",
            rtol=OWN["rtol"],
            atol=OWN["atol"],
        )
        back = max(back, abs(gradient.by[machine.parameter] - x.slope) / most)
    reasons = {x.reason for x in own if x.status != "ok"}
    orders = len({x.events for x in own})
    return Sweep(Counter(x.status for x in own), apart, back, len(kinks), orders, len(chosen), wrong, reasons)


def main() -> int:
    """Print the table; return 1 where a derivative is wrong."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("machines", nargs="*", default=list(MACHINES), help="all by default")
    parser.add_argument("--rows", type=int, default=300, help="values of the parameter")
    options = parser.parse_args()
    headings = "machine", "varied", "orders", "statuses", "apart", "adjoint", "kinks", "changes", "wrong"
    table, wrong = Table(*headings), 0
    for name in options.machines:
        machine = MACHINES[name]
        sweep = examined(machine, options.rows)
        low, high = machine.values
        statuses = ", ".join(f"{count} {status}" for status, count in sorted(sweep.statuses.items()))
        cells = name, f"{machine.parameter} {low:g} to {high:g}", str(sweep.orders), statuses
        sizes = f"{sweep.apart:.1g}", f"{sweep.adjoint:.1g}", str(sweep.kinks), str(sweep.changes)
        table.add_row(*cells, *sizes, str(len(sweep.wrong)))
        for line in sweep.wrong:
            print(f"{name}: {line}", flush=True)
        for line in sorted(sweep.reasons):
            print(f"{name}: {line}", flush=True)
        wrong += len(sweep.wrong)
    show(table)
    return int(wrong > 0)


if __name__ == "__main__":
    raise SystemExit(main())
