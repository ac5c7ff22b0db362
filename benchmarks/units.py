"""The same mechanism in other units: whether the run is the same, to rounding.

    python -m benchmarks.units --output out/units.jsonl
    python -m benchmarks.units --four-bar

Catalogue entries and random mechanisms are written in units of length, mass and time that are powers of two of the
file's, with steps, ends and methods' parameters; both files are run, and the second result is brought back. For methods
whose formulas have no unit of their own every number must be equal to rounding, most are to the last bit, and so must
be the counts of steps; the others (`CARRY_UNITS`) must agree in status, rank and events. Said is what differs first.

`--four-bar` measures one four-bar of 1 um, 1 mm, 1 cm and 1 km against itself at 1 m: errors of the crank's angle at
the ends of 50 runs of different length, with adaptive steps.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from rich.table import Table

from benchmarks.mechanisms.draw import Refused, draw
from benchmarks.mechanisms.toml import text
from benchmarks.plain.moving import Array
from benchmarks.rescale import Units, back, dimension_of, rescaled
from benchmarks.show import show

#: Methods whose results are equal, with the options that make them so.
EXACT: dict[str, dict[str, str]] = {
    "lagrange": {},
    "null-space": {"method.weight": "mass"},
    "direct-correction": {"method.weight": "mass"},
    "post-stabilization": {"method.weight": "mass"},
    "velocity-projection": {"method.weight": "mass"},
}
#: Methods whose metric or defaults carry units: the identity weighs 1 rad like 1 m; penalties and gains are numbers.
CARRY_UNITS = (
    "direct-correction",
    "baumgarte",
    "adaptive-baumgarte",
    "penalty",
    "augmented-lagrangian",
    "index1-augmented-lagrangian",
    "mass-orthogonal-projection",
    "coordinate-partitioning",
    "udwadia-kalaba",
)
#: Parameters of methods -> unit (docs/methods.md).
PARAMETERS = {
    "baumgarte": {"alpha": (5.0, "1/s"), "beta": (5.0, "1/s")},
    "adaptive-baumgarte": {"gain": (5.0, "1/s")},
    "penalty": {"omega": (10.0, "1/s")},
    "augmented-lagrangian": {"omega": (10.0, "1/s")},
}
#: Exponents of two that lengths, masses and times are multiplied by: about 1e-6 to 1e6, 1e-9 to 1e9, 1e-4 to 1e4.
LENGTHS, MASSES, TIMES = (-20, -7, 0, 10, 20), (-30, -10, 0, 10, 30), (-13, -3, 0, 3, 13)
#: Lengths for methods that weigh 1 rad like 1 m: with a unit of 1 um the iteration of `augmented-lagrangian` diverges,
#: as one penalty is for rows in metres and in radians.
MODERATE = (-7, -3, 0, 3, 7)
#: Both files are in units other than the file's: a product with a number that is 1 is left out of emitted code, which
#: changes the order of the additions around it, and no power of two makes 1 of such a number again.
BEFORE = Units(3.0, 3.0, 3.0)
#: Numbers may differ by this part of the largest of their unit: products may be multiplied out, and terms of long sums
#: stand in another order, where numbers of other length are written into the same line. Random mechanisms with masses
#: of 1e-8 beside 1 multiply rounding by 1e10 in the multipliers, by less in the motion.
ROUNDING, ROUNDING_OF_FORCES = 1e-8, 1e-5
ENTRIES = ("four-bar", "slider-crank", "pendulum", "bricard", "spatial-slider-crank", "heavy-top", "rolling-disc")


@dataclass(frozen=True)
class Case:
    """A mechanism, a method and a unit system."""

    name: str
    text: str
    until: float
    step: float
    method: str
    exact: bool
    units: Units
    adaptive: bool = False


def cases(entries: list[str], mechanisms: int, seed: int) -> Iterator[Case]:
    """Yield cases: catalogue entries and random mechanisms, each with some methods and units."""
    import symgen

    folder = Path(str(symgen.__file__)).parent / "describe" / "catalogue"
    files = [(name, (folder / f"{name}.toml").read_text(encoding="utf-8")) for name in entries]
    for index in range(mechanisms):
        try:
            files.append((f"{seed}/{index}", text(draw(seed, index).raw)))
        except Refused:
            continue
    rng = random.Random(seed)
    for name, file in files:
        content = rescaled(file, BEFORE)
        for method, exact in [*((m, True) for m in EXACT), (rng.choice(CARRY_UNITS), False)]:
            lengths = LENGTHS if exact else MODERATE
            units = Units(*(2.0 ** rng.choice(powers) for powers in (lengths, MASSES, TIMES)))
            yield Case(name, content, 0.25, 1.0 / 1024, method, exact, units)
        units = Units(*(2.0 ** rng.choice(powers) for powers in (LENGTHS, MASSES, TIMES)))
        yield Case(name, content, 0.25, 1.0 / 1024, "lagrange", True, units, adaptive=True)


def options(case: Case, units: Units) -> dict[str, Any]:
    """Return a method's options, its parameters in the units asked for."""
    limits: dict[str, Any] = dict(EXACT[case.method]) if case.exact else {}
    if not case.exact:
        for name, (value, unit) in PARAMETERS.get(case.method, {}).items():
            limits[f"method.{name}"] = value * units.factor(dimension_of(unit) or (0, 0, 0))
    return limits if case.method != "null-space" else {}


def solved(case: Case, units: Units, folder: Path) -> Any:
    """Return the result of a case in units, or the error that it ends in."""
    import symgen

    path = folder / "scaled.toml"
    path.write_text(case.text if units == Units() else rescaled(case.text, units), encoding="utf-8")
    # a relative tolerance alone: an absolute one has a unit
    how: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-9} if case.adaptive else {"integrator": "rk4"}
    try:
        return symgen.load(path).simulate(
            **how,
            method=case.method,
            step=case.step * units.time,
            until=case.until * units.time,
            output_step=16 * case.step * units.time,
            options=options(case, units),
            shape="straight",
        )
    except (symgen.SymgenError, ArithmeticError, ValueError) as error:  # plain Python raises where numbers end
        return f"{type(error).__name__}: {error}"


def without_adaptive(result: Any) -> bool:
    """Return whether a run with a relative tolerance alone was refused for that."""
    return isinstance(result, str) and "atol" in result


def first_difference(one: Any, other: Any, units: Units, exact: bool) -> tuple[str, float]:
    """Return where two results part, empty where they do not, and the largest difference of the numbers compared.

    The second result is brought back to the units of the first. Numbers differ by what the largest of their unit and
    table is multiplied by.
    """
    if isinstance(one, str) or isinstance(other, str):
        both = isinstance(one, str) and isinstance(other, str)
        return "" if both else f"start: {one if isinstance(one, str) else other}", 0.0
    for what in ("rank", *(("steps", "evaluations") if exact else ()), "rank_event_count", "status"):
        if getattr(one, what) != getattr(other, what):
            return f"{what}: {getattr(one, what)} and {getattr(other, what)} ({one.reason or other.reason})", 0.0
    largest = 0.0
    for name in ("q", "v", "lam") if exact else ():
        a, b = _table(one, name, Units()), _table(other, name, units)
        tables = getattr(one, name).units
        for unit in sorted(set(tables)):
            columns = [k for k, u in enumerate(tables) if u == unit]
            scale = np.nanmax(np.abs(a[:, columns]), initial=1e-300)
            off = np.abs(a[:, columns] - b[:, columns]).max(axis=1) / scale
            largest = max(largest, float(np.nanmax(off, initial=0.0)))
            for k in np.flatnonzero(off > (ROUNDING if name != "lam" else ROUNDING_OF_FORCES)):
                return f"{'output' if k else 'start'} {k}: {name} [{unit}] off by {off[k]:.1e} of the largest", largest
    return "", largest


def _table(result: Any, name: str, units: Units) -> Array:
    """Return a table of a result, every column brought back by its unit."""
    table = getattr(result, name)
    values = np.array(table)
    for k, unit in enumerate(table.units):
        values[:, k] = back(units, unit)(values[:, k])
    return values


# -- the four-bar of four sizes ----------------------------------------------------------------------------------------

FOUR_BAR = """
[mechanism]
name = "sized"
gravity = [0.0, -9.81]
[bodies.crank]
mass = 1.0
inertia = 0.08333333333333333
position = [0.1811788772383368, 0.4660195429836131]
angle = 1.2
points = { a = [-0.5, 0.0], b = [0.5, 0.0] }
angular_velocity = 3.0
[bodies.coupler]
mass = 1.0
inertia = 0.4033333333333333
position = [1.4105157862616067, 1.265752646382045]
angle = 0.30823360485921275
points = { a = [-1.1, 0.0], b = [1.1, 0.0] }
[bodies.rocker]
mass = 1.0
inertia = 0.21333333333333335
position = [2.4793369090232697, 0.7997331033984321]
angle = 1.5966280632474863
points = { a = [-0.8, 0.0], b = [0.8, 0.0] }
[joints.A]
type = "revolute"
between = ["ground", "crank"]
at = [[0.0, 0.0], "a"]
[joints.B]
type = "revolute"
between = ["crank", "coupler"]
at = ["b", "a"]
[joints.C]
type = "revolute"
between = ["coupler", "rocker"]
at = ["b", "b"]
[joints.E]
type = "revolute"
between = ["ground", "rocker"]
at = [[2.5, 0.0], "a"]
"""
#: Name -> size of the crank [m]; time goes with its root, so that gravity stays what it is.
SIZES = {"1 m": 1.0, "1 um": 1e-6, "1 mm": 1e-3, "1 cm": 1e-2, "1 km": 1e3}


def four_bars(integrator: str, runs: int, method: str = "direct-correction") -> dict[str, list[float]]:
    """Return for each size the errors of the crank's angle [rad] at the ends of runs of different length.

    The reference is the run of 1 m with a tolerance of 1e-13.
    """
    import symgen

    ends = np.linspace(0.3, 5.0, runs)
    angles: dict[str, list[float]] = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, size in SIZES.items():
            units = Units(size, 1.0, float(np.sqrt(size)))
            path = Path(folder) / "sized.toml"
            path.write_text(rescaled(FOUR_BAR, units), encoding="utf-8")
            model = symgen.load(path)
            for label, rtol in ((name, 1e-10), *((("exact", 1e-13),) if size == 1.0 else ())):
                settings = {
                    "method": method,
                    "integrator": integrator,
                    "rtol": rtol,
                    "atol": 1e-2 * rtol * min(size, 1.0),
                }
                angles[label] = [
                    float(
                        model.simulate(until=end * units.time, times=[0.0, end * units.time], **settings).q[
                            "crank.theta"
                        ][-1]
                    )
                    for end in ends
                ]
    exact = np.array(angles.pop("exact"))
    return {name: list(np.abs(np.array(values) - exact)) for name, values in angles.items()}


def _print_four_bars(runs: int) -> int:
    table = Table("integrator", "size", "median", "largest", "above 1e-7", title="crank's angle at the end [rad]")
    bad = 0
    for integrator in ("dop853", "dopri5"):
        errors = four_bars(integrator, runs)
        limit = 10.0 * max(errors["1 m"])
        for name, values in errors.items():
            above = sum(error > 1e-7 for error in values)
            bad += max(values) > limit
            table.add_row(integrator, name, f"{np.median(values):.1e}", f"{max(values):.1e}", f"{above} of {runs}")
    show(table)
    return 1 if bad else 0


def main() -> int:
    """Compare the cases that the command line asks for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--entries", default=",".join(ENTRIES), help="of the catalogue")
    parser.add_argument("--mechanisms", type=int, default=20, help="random mechanisms beside the catalogue's")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument(
        "--compiled", action="store_true", help="compile emitted code, in which multiply-add is contracted; slower"
    )
    parser.add_argument("--four-bar", action="store_true")
    parser.add_argument("--runs", type=int, default=50)
    parser.add_argument("--output", type=Path, default=Path("out/units.jsonl"))
    options = parser.parse_args()
    if options.four_bar:
        return _print_four_bars(options.runs)
    if not options.compiled:
        os.environ["NUMBA_DISABLE_JIT"] = "1"
    options.output.parent.mkdir(parents=True, exist_ok=True)
    counts: Counter[str] = Counter()
    with options.output.open("w", encoding="utf-8") as file, tempfile.TemporaryDirectory() as folder:
        for case in cases([name for name in options.entries.split(",") if name], options.mechanisms, options.seed):
            one, other = (solved(case, units, Path(folder)) for units in (Units(), case.units))
            difference, largest = first_difference(one, other, case.units, case.exact)
            if case.adaptive and without_adaptive(one):
                difference = "not offered: a relative tolerance alone"
            line = {
                "name": case.name,
                "method": case.method,
                "exact": case.exact,
                "adaptive": case.adaptive,
                "units": asdict(case.units),
                "first": difference,
                "largest": largest,
            }
            file.write(json.dumps(line) + "\n")
            file.flush()
            same = "the same bits, yes" if case.exact and largest == 0.0 else "yes"
            counts[f"{'equal' if case.exact else 'alike'}: {difference.partition(':')[0] or same}"] += 1
            print(
                case.name,
                case.method,
                [int(np.log2(x)) for x in asdict(case.units).values()],
                difference or f"same, within {largest:.0e}" * (largest > 0.0) or "same",
                flush=True,
            )
    for what, count in sorted(counts.items()):
        print(f"{count:6d}  {what}")
    return 1 if any(not what.endswith("yes") for what in counts) else 0


if __name__ == "__main__":
    sys.exit(main())
