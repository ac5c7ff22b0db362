"""Runs of symgen: their configurations, and their outcomes as plain arrays."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.plain.moving import Array


@dataclass(frozen=True)
class Configuration:
    """One run.

    Attributes
    ----------
    method, integrator : str
        Names, or ``"auto"``.
    shape : str
        ``"straight"``, ``"looped"`` or ``"auto"``; ``"joint"`` for straight code in joint coordinates.
    rtol : float or None
        Tolerance of an adaptive run, with a hundredth of it as the absolute one; None with constant steps.
    options : mapping
        Of method and integrator.
    """

    method: str
    integrator: str
    shape: str
    rtol: float | None = None
    options: Mapping[str, Any] = field(default_factory=dict)

    @property
    def label(self) -> str:
        """Name in tables."""
        steps = "constant" if self.rtol is None else f"{self.rtol:.0e}"
        return f"{self.method}/{self.integrator}/{steps}/{self.shape}"


@dataclass
class Outcome:
    """Status and results of a run.

    Attributes
    ----------
    status, reason : str
        As symgen says; ``"refused"`` where it raised an error that is one sentence, ``"raised"`` for another one.
    t : Array
        Output times.
    columns : dict
        For q, v, lam, reactions: an array of outputs by names.
    names : dict
        The names of these columns.
    energies : Array
        Kinetic, potential, work.
    facts : dict
        Warnings, notes, steps, rank, seconds and so on, ready for JSON.
    """

    status: str
    reason: str
    t: Array = field(default_factory=lambda: np.zeros(0))
    columns: dict[str, Array] = field(default_factory=dict)
    names: dict[str, tuple[str, ...]] = field(default_factory=dict)
    energies: Array = field(default_factory=lambda: np.zeros((0, 3)))
    facts: dict[str, Any] = field(default_factory=dict)


def run(path: Path, configuration: Configuration, times: Array, step: float | None = None) -> Outcome:
    """Return the outcome of a run of the file at `path`.

    Parameters
    ----------
    path : Path
        A mechanism file.
    configuration : Configuration
        What to run.
    times : Array
        Output times [s], the last of which is the end.
    step : float, optional
        The constant step [s].
    """
    import symgen

    changes: dict[str, Any] = {"until": float(times[-1]), "times": times, "options": dict(configuration.options)}
    if configuration.rtol is not None:
        changes |= {"rtol": configuration.rtol, "atol": 1e-2 * configuration.rtol}
    elif step is not None:
        changes["step"] = step
    began = time.perf_counter()
    try:
        model = symgen.load(path)
        joint = configuration.shape == "joint"
        changes |= {"shape": "straight", "coordinates": "joint"} if joint else {"shape": configuration.shape}
        result = model.simulate(method=configuration.method, integrator=configuration.integrator, **changes)
    except symgen.SymgenError as error:
        return Outcome("refused", str(error), facts={"seconds": time.perf_counter() - began})
    except Exception as error:  # whatever else is raised is what is looked for here
        return Outcome("raised", f"{type(error).__name__}: {error}", facts={"seconds": time.perf_counter() - began})
    tables = {name: getattr(result, name) for name in ("q", "v", "lam", "reactions")}
    facts = {
        "warnings": list(result.warnings),
        "notes": list(result.notes),
        "steps": result.steps,
        "rejected": result.rejected,
        "evaluations": result.evaluations,
        "position_violation": result.position_violation_max,
        "velocity_violation": result.velocity_violation_max,
        "energy_drift": result.energy_drift_max,
        "rank": asdict(result.rank),
        "rank_events": result.rank_event_count,
        "method": result.method,
        "integrator": result.integrator,
        "shape": result.shape,
        "not_unique": list(result.non_unique_reactions),
        "seconds": time.perf_counter() - began,
    }
    return Outcome(
        result.status,
        result.reason or "",
        np.asarray(result.t),
        {name: np.asarray(table) for name, table in tables.items()},
        {name: tuple(table.names) for name, table in tables.items()},
        np.column_stack([result.kinetic, result.potential, result.work]),
        facts,
    )


def basic(shapes: list[str]) -> list[Configuration]:
    """Return the runs of every mechanism: adaptive and constant steps, and everything chosen automatically."""
    configurations = []
    for shape in shapes:
        if shape == "auto":
            configurations.append(Configuration("auto", "auto", "auto"))
            continue
        configurations.append(Configuration("lagrange", "dop853", shape, 1e-10))
        configurations.append(Configuration("lagrange", "picard", shape, 1e-10))
        configurations.append(Configuration("direct-correction", "rk4", shape))
    return configurations


#: Every method with an integrator that goes with it, and a tolerance where that is adaptive (docs/methods.md); but the
#: step of game engines, `implicit-constraint`, whose first order is far from the reference at these steps.
METHODS: dict[str, tuple[str, float | None]] = {
    "lagrange": ("rk4", None),
    "baumgarte": ("rk4", None),
    "adaptive-baumgarte": ("rk4", None),
    "penalty": ("rk4", None),
    "augmented-lagrangian": ("rk4", None),
    "index1-augmented-lagrangian": ("rk4", None),
    "augmented-hamiltonian": ("rk4", None),
    "udwadia-kalaba": ("rk4", None),
    "null-space": ("rk4", None),
    "coordinate-partitioning": ("rk4", None),
    "direct-correction": ("rk4", None),
    "post-stabilization": ("rk4", None),
    "velocity-projection": ("rk4", None),
    "mass-orthogonal-projection": ("rk4", None),
    "ggl": ("radau5", 1e-8),
    "generalized-alpha": ("generalized-alpha", None),
    "index3-augmented-lagrangian": ("trapezoidal", None),
    "energy-projection": ("rk4", None),
    "compliant-constraints": ("rk4", None),
    "invariant-stabilization": ("rk4", None),
    "braun-goldfarb": ("rk4", None),
    "hamiltonian-baumgarte": ("rk4", None),
    "controllable-velocity-projection": ("rk4", None),
    "dependent-correction": ("rk4", None),
    "stiffness-scaled-penalty": ("rk4", None),
    "half-explicit": ("half-explicit", None),
    "rattle": ("rattle", None),
    "discrete-gradient": ("discrete-gradient", None),
    "symmetric-projection": ("gauss", None),
}
#: Methods that have straight code only.
DENSE = (
    *("coordinate-partitioning", "dependent-correction", "null-space", "augmented-hamiltonian"),
    *("hamiltonian-baumgarte", "invariant-stabilization", "braun-goldfarb"),
)


def every_method(shape: str) -> list[Configuration]:
    """Return one run by every method."""
    return [
        Configuration(name, integrator, "straight" if name in DENSE and shape == "looped" else shape, rtol)
        for name, (integrator, rtol) in METHODS.items()
    ]
