"""Forces that are exactly at their bound: at a start, behind a reset, behind `set`, where an input jumps.

    python -m benchmarks.bounded.margins [--only start/stop/linear]

A mass of 1 kg is held by 2 N at most: by dry friction of a constant bound or by the reaction of its guide, on a stop
against its weight, on a rope. Something pushes with 2 N from t = 0 or 0.5 s on, and with more or less from then on: the
mass begins to move at once, or never.
"""

from __future__ import annotations

import argparse
import itertools
import os
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from rich.table import Table

from benchmarks.bounded.tree import Array
from benchmarks.show import show

BEGINNING = {"start": 0.0, "reset": 0.5, "set": 0.5, "jump": 0.5}
HOLDS = ("constant", "static", "reaction", "stop", "rope")
#: What is pushed with beyond 2 N over the time since then, and how far the mass has moved, by powers of this time.
GROWTHS = {
    "linear": ("s", (0.0, 0.0, 0.0, 1.0 / 6.0)),
    "quadratic": ("s**2", (0.0, 0.0, 0.0, 0.0, 1.0 / 12.0)),
    "falling": ("-s", (0.0,)),
}
UNTIL = 1.5
RUNS: dict[str, dict[str, Any]] = {
    "default": {},
    "dop853": {"integrator": "dop853", "rtol": 1e-11, "atol": 1e-12},
    "radau5": {"integrator": "radau5", "rtol": 1e-9, "atol": 1e-11},
    "rk4": {"integrator": "rk4", "step": 1e-3},
    "joint": {"coordinates": "joint", "integrator": "dop853", "rtol": 1e-11, "atol": 1e-12},
}
RIGHT = 1e-7
#: Error of a mass that breaks loose as its push grows with the square of time [m]: what exceeds the hold by less than
#: 2^-42 of it is rounding, for a microsecond or two.
LATE = 3e-6


@dataclass(frozen=True)
class Case:
    """What begins how, what holds, and how the push grows."""

    begins: str
    hold: str
    growth: str

    @property
    def name(self) -> str:
        """Its three words."""
        return f"{self.begins}/{self.hold}/{self.growth}"

    @property
    def coordinate(self) -> str:
        """What moves."""
        return "b.y" if self.hold in ("stop", "rope") else "b.x"

    def wanted(self, t: Array) -> Array:
        """Return the right coordinate."""
        since = np.maximum(t - BEGINNING[self.begins], 0.0)
        moved = np.polynomial.Polynomial(GROWTHS[self.growth][1])(since)
        if self.hold == "static" and self.growth != "falling":  # 1 N less friction as soon as it moves
            moved = moved + 0.5 * since**2
        return np.asarray(moved - (1.0 if self.hold == "rope" else 0.0))


def cases() -> Iterator[Case]:
    """Yield all cases."""
    for words in itertools.product(BEGINNING, HOLDS, GROWTHS):
        yield Case(*words)


def text(case: Case) -> str:
    """Return the file of a case."""
    begin = BEGINNING[case.begins]
    since = f"max(t - {begin!r}, 0)" if begin else "t"
    more = GROWTHS[case.growth][0].replace("s", since)
    push = f"push + {more}" if more[0] != "-" else f"push {more}"
    upright = case.hold in ("stop", "rope")
    across = ', "-4.0"' if case.hold == "reaction" else ", 0.0"
    force = f'[0.0, "{push}"]' if upright else f'["{push}"{across}]'
    friction = {
        "constant": "friction = { sliding = 2.0 }",
        "static": "friction = { sliding = 1.0, static = 2.0 }",
        "reaction": "friction = { coefficient = 0.5 }",
    }
    parts = [
        f'[mechanism]\nname = "at-its-bound"\ngravity = [0.0, {-2.0 if upright else 0.0!r}]',
        f"[bodies.b]\nmass = 1.0\ninertia = 1.0\nposition = [0.0, {-1.0 if case.hold == 'rope' else 0.0!r}]",
        "[joints.guide]\n"
        'type = "translational"\nbetween = ["ground", "b"]\nat = [[0.0, 0.0], "centre"]\n'
        f"axis = {'[0.0, 1.0]' if upright else '[1.0, 0.0]'}\n{friction.get(case.hold, '')}"
        f"{'stop = { lower = 0.0 }' if case.hold == 'stop' else ''}",
        f'[forces.thrust]\ntype = "force"\nbody = "b"\nforce = {force}',
    ]
    if case.hold == "rope":
        parts.append('[stops.rope]\ngap = "1.0 - sqrt(b.x**2 + b.y**2)"')
    if case.begins == "reset":
        parts.append("[states.push]\nstart = 0.0\nrate = 0.0")
        parts.append(f'[events.switch]\nwhen = "t > {begin!r}"\nreset = {{ push = "2.0" }}')
    elif case.begins == "start":
        parts.append("[parameters]\npush = 2.0")
    else:
        parts.append("[inputs]\npush = 0.0")
    return "\n\n".join(parts) + "\n"


def examined(case: Case, settings: dict[str, Any]) -> tuple[str, float, str]:
    """Return outcome, error and reason of a run."""
    import symgen

    times = np.linspace(0.0, UNTIL, 16)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "margin.toml"
        path.write_text(text(case), encoding="utf-8")
        try:
            model = symgen.load(path)
            if case.begins == "set":
                run = model.start(until=UNTIL, **settings)
                run.run(BEGINNING["set"])
                run.set(push=2.0)
                run.run(UNTIL)
                result = run.result()
            else:
                inputs = {"push": f"2.0 if t > {BEGINNING['jump']!r} else 0.0"} if case.begins == "jump" else {}
                result = model.simulate(until=UNTIL, times=times, inputs=inputs, **settings)
        except symgen.SymgenError as refusal:
            return ("raised" if " at t = " in str(refusal) else "sentence"), float("nan"), str(refusal)
    error = float(np.abs(result[case.coordinate] - case.wanted(np.asarray(result.t))).max())
    if result.status != "ok":
        return str(result.status), error, str(result.reason or result.warnings)
    right = LATE if (case.hold, case.growth) == ("static", "quadratic") else RIGHT
    return ("right" if error <= right else "WRONG"), error, ""


def main() -> int:
    """Print a line for each case; return 1 where a run was `ok` and wrong, failed, or was refused."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", default="", help="part of the name of cases")
    options = parser.parse_args()
    table, bad = Table("case", *RUNS), []
    for case in cases():
        if options.only in case.name:
            outcomes = [examined(case, settings) for settings in RUNS.values()]
            table.add_row(case.name, *(f"{outcome} {error:.0e}" for outcome, error, _ in outcomes))
            for name, (outcome, error, reason) in zip(RUNS, outcomes, strict=True):
                if outcome != "right":
                    bad.append(f"{case.name} {name}: {outcome} {error:.1e} {reason[:150]}")
    show(table)
    print("\n".join(bad))
    return int(bool(bad))


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        os.environ.setdefault("SYMGEN_CACHE_DIR", folder)
        sys.exit(main())
