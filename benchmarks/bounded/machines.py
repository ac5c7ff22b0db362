"""Machines that leave their stops: how many rows of a sweep fail, and whether all leave at one smooth time.

    python -m benchmarks.bounded.machines [press] [bucket] [--rows 301] [--only dop853]

A row leaves where weights and the growing force balance, at a time that is linear in the parameter: its second
differences over the parameter are rounding. Machines with dry friction in their pins leave later, as linearly.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from rich.table import Table

from benchmarks.show import show

FOLDER = Path(__file__).parent / "files"


@dataclass(frozen=True)
class Machine:
    """A machine, the parameter that varies and between what, the event of leaving, and its pins."""

    file: str
    parameter: str
    values: tuple[float, float]
    leaves: str
    pins: tuple[str, ...]
    dry: float


MACHINES = {
    "press": Machine("press.toml", "m", (4.0, 6.0), "guide.lower.leave", ("A", "knee", "B"), 0.5),
    "bucket": Machine("bucket.toml", "dig", (17e3, 23e3), "cylinder.lower.leave", ("A", "B", "C", "D", "E", "F"), 40.0),
}
#: Settings of runs by name; `picard` is the default's.
SETTINGS: dict[str, dict[str, Any]] = {
    "picard": {"integrator": "picard"},
    "dop853": {"integrator": "dop853"},
    "radau5": {"integrator": "radau5"},
    "rk4": {"integrator": "rk4", "step": 1e-3},
}
#: Integrators that have a loop over many runs.
SWEPT = ("picard", "dop853", "rk4")


@dataclass(frozen=True)
class Found:
    """What became of the rows of a machine.

    Attributes
    ----------
    statuses : mapping of str to int
        How often each occurred in a sweep; among single runs for integrators without sweeps.
    reasons : sequence of str
        The commonest of those that failed.
    never : int
        Single runs that did not leave.
    differences : float
        Largest second difference of the times at which single runs left [s].
    span : float
        How far these times are apart [s]: what varies has to matter.
    """

    statuses: Mapping[str, int]
    reasons: Sequence[str]
    never: int
    differences: float
    span: float


def text(machine: Machine, dry: bool) -> str:
    """Return the file of a machine, with dry friction in its pins or without."""
    content = (FOLDER / machine.file).read_text(encoding="utf-8")
    if dry:
        content = content.replace("dry = { value = 0.0,", f"dry = {{ value = {machine.dry!r},")
        for pin in machine.pins:
            head = f"[joints.{pin}]\n"
            content = content.replace(head, f'{head}friction = {{ sliding = "dry" }}\n')
    return content


def examined(
    machine: Machine, dry: bool, coordinates: str, settings: Mapping[str, Any], rows: int, singles: int
) -> Found:
    """Return what became of the rows of a sweep, and of some of them run alone."""
    import symgen

    values = np.linspace(*machine.values, rows)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / machine.file
        path.write_text(text(machine, dry), encoding="utf-8")
        model = symgen.load(path)
        keywords: dict[str, Any] = {"until": 1.0, "coordinates": coordinates, "verify": False, **settings}
        times, statuses, why = [], Counter[str](), Counter[str]()
        for value in values[:: max(1, rows // singles)]:
            run = model.simulate(parameters={machine.parameter: float(value)}, output_step=0.25, **keywords)
            left = [event.t for event in run.events if event.name == machine.leaves]
            times.append(left[-1] if run.status == "ok" and left else np.nan)
            statuses[run.status] += 1
            why[(run.reason or "").partition(" at t")[0]] += run.status != "ok"
        if settings["integrator"] in SWEPT:
            output: dict[str, Any] = {"quantities": ("q",), "output_step": 1.0, "jobs": 1}
            found = symgen.sweep(model, {machine.parameter: values}, **output, **keywords)
            statuses = Counter(str(s) for s in np.ravel(found.status))
            why = Counter(dict(found.reasons()))
    known = np.array(times)
    differences = np.abs(np.diff(known, 2))
    largest = float(np.nanmax(differences)) if np.isfinite(differences).any() else float("nan")
    reasons = [reason for reason, _ in why.most_common(2) if reason]
    return Found(statuses, reasons, int(np.isnan(known).sum()), largest, float(np.nanmax(known) - np.nanmin(known)))


def main() -> int:
    """Print a line for each machine and kind of run; return 1 where a row fails or leaves at another time."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("machines", nargs="*", default=[], metavar="press|bucket")
    parser.add_argument("--rows", type=int, default=301)
    parser.add_argument("--singles", type=int, default=30, help="rows that are run alone as well")
    parser.add_argument("--only", default=",".join(SETTINGS))
    options = parser.parse_args()
    table = Table("machine", "pins", "coordinates", "integrator", "statuses", "never left", "second differences [s]")
    bad = False
    reasons = []
    for name in options.machines or MACHINES:
        for dry in (False, True):
            for coordinates in ("absolute", "joint"):
                for integrator in options.only.split(","):
                    machine, settings = MACHINES[name], SETTINGS[integrator]
                    found = examined(machine, dry, coordinates, settings, options.rows, options.singles)
                    statuses = ", ".join(f"{status} {count}" for status, count in found.statuses.items())
                    cells = (name, "dry" if dry else "smooth", coordinates, integrator, statuses)
                    table.add_row(*cells, str(found.never), f"{found.differences:.1e}")
                    print(*cells, found.never, f"{found.differences:.1e}", *found.reasons, sep="; ", file=sys.stderr)
                    bad = bad or set(found.statuses) != {"ok"} or found.never > 0 or not found.differences < 1e-9
                    reasons += [f"{' '.join(cells[:4])}: {reason}" for reason in found.reasons]
    show(table)
    print("\n".join(reasons))
    return int(bad)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        os.environ.setdefault("SYMGEN_CACHE_DIR", folder)
        sys.exit(main())
