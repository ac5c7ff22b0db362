"""Machines that rub beside stops and contacts: runs and sweeps over a parameter beside a simulation of their own.

    python -m benchmarks.bounded.rubbing --count 300
    python -m benchmarks.bounded.rubbing --machines gripper,brake --every 10
    python -m benchmarks.bounded.rubbing --write gripper > gripper.toml

A sweep has all values; every so many of them are single runs as well, compared over time.
"""

from __future__ import annotations

import argparse
import contextlib
import sys
import time

import numpy as np

from benchmarks.bounded.rubbing.beside import reference, simulated, swept, values_of
from benchmarks.bounded.rubbing.machines import MACHINES
from benchmarks.bounded.rubbing.modes import Unsolved
from benchmarks.bounded.touch.bodies import Array
from symgen.base.errors import SymgenError

#: A second difference above so many times the median is a corner.
CORNER = 20.0


def main() -> int:
    """Run what the command line asks for; return the number of values that are off or refused."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--machines", default=",".join(MACHINES))
    parser.add_argument("--count", type=int, default=300, help="values of each parameter")
    parser.add_argument("--every", type=int, default=10, help="one of so many values is a single run as well")
    parser.add_argument("--most", type=float, default=1e-8, help="largest difference of a place or an angle [m, rad]")
    parser.add_argument("--write", metavar="MACHINE", help="print the file of a machine")
    options = parser.parse_args()
    if options.write:
        make, (low, _) = MACHINES[options.write]
        print(make(low).text, end="")
        return 0
    return sum(_compared(name, options.count, options.every, options.most) for name in options.machines.split(","))


def _compared(name: str, count: int, every: int, most: float) -> int:
    """Compare a machine over its values; return how many are off or refused."""
    values, began = values_of(name, count), time.process_time()
    places = dict[int, Array]()
    for i, value in enumerate(values):
        with contextlib.suppress(Unsolved):
            places[i] = reference(MACHINES[name][0](float(value)))
    took = time.process_time() - began
    try:
        statuses, last = swept(name, values)
    except SymgenError as error:
        print(f"{name}: {error}")
        return count
    known = list(places)
    off = np.abs(last[known] - np.array([place[-1] for place in places.values()])).max(axis=1)
    corners, smooth = _corners(values, last)
    runs = [float(np.abs(simulated(MACHINES[name][0](float(values[i]))) - places[i]).max()) for i in known[::every]]
    bad = count - statuses.count("ok") + int(np.sum(off > most)) + sum(error > most for error in runs)
    print(
        f"{name}: {count} values, {statuses.count('ok')} ok, {count - len(known)} without a reference ({took:.0f} s); "
        f"largest difference at the end {off.max():.1e}, of {len(runs)} runs over time {max(runs):.1e}; "
        f"another sequence of events near {corners or 'no value'}, largest second difference between {smooth:.1e}; "
        f"{bad} off",
        flush=True,
    )
    return bad


def _corners(values: Array, last: Array) -> tuple[str, float]:
    """Return the values near which ends have a corner, and the largest second difference elsewhere.

    Between values at which the sequence of events changes, as where pins come to rest a swing earlier, ends are smooth.
    """
    steps = np.abs(np.diff(last, 2, axis=0)).max(axis=1)
    corner = steps > CORNER * np.median(steps)
    own = values[1:-1][corner]
    apart = np.split(own, np.flatnonzero(np.diff(own) > 1.5 * (values[1] - values[0])) + 1) if len(own) else []
    return ", ".join(f"{x.mean():.5g}" for x in apart), float(steps[~corner].max(initial=0.0))


if __name__ == "__main__":
    sys.exit(min(main(), 1))
