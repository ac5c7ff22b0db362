"""Runs of symgen beside the simulation of a machine."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import numpy as np

import symgen
from benchmarks.bounded.rubbing.machines import MACHINES, Case
from benchmarks.bounded.rubbing.motion import run
from benchmarks.bounded.touch.bodies import Array

#: Output times of a run.
OUTPUTS = 25


def values_of(name: str, count: int) -> Array:
    """Return values of a machine's parameter over its range, ends included."""
    low, high = MACHINES[name][1]
    return np.linspace(low, high, count)


def reference(case: Case) -> Array:
    """Return the places of a machine over time as the simulation has them."""
    return np.array(run(case.machine, case.q, case.v, np.linspace(0.0, case.until, OUTPUTS + 1)).q)


def simulated(case: Case, **settings: Any) -> Array:
    """Return the places of a machine over time as a run of symgen has them.

    Raises
    ------
    SymgenError
        If the file is refused.
    """
    times = np.linspace(0.0, case.until, OUTPUTS + 1)
    with tempfile.TemporaryDirectory() as folder:
        (path := Path(folder) / "machine.toml").write_text(case.text, encoding="utf-8")
        tight: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-11, "atol": 1e-12, "verify": False} | settings
        result = symgen.load(path).simulate(until=case.until, times=times, **tight)
    assert result.ok, f"{result.status}: {result.reason}"
    return np.array([result[place] for place in case.places]).T


def swept(name: str, values: Array, **settings: Any) -> tuple[list[str], Array]:
    """Return the outcomes and the last places of a sweep over values of a machine's parameter."""
    case = MACHINES[name][0](float(values[0]))
    with tempfile.TemporaryDirectory() as folder:
        (path := Path(folder) / "machine.toml").write_text(case.text, encoding="utf-8")
        tight: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-11, "atol": 1e-12} | settings
        rows = symgen.load(path).sweep(vary={"value": values}, quantities=case.places, **tight).to_dataframe()
    return [str(status) for status in rows["status"]], np.array(rows[list(case.places)])
