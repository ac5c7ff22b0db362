"""Results of a comparison: rows, curves over time, and their study, as JSON, CSV and data frame."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from typing import TYPE_CHECKING, Any, TypedDict

import msgspec

from symgen.result.result import FAILED, OK, UNVERIFIED

if TYPE_CHECKING:
    pass


#: Units of columns.
UNITS = {
    **dict.fromkeys(("gradient_seconds", "adjoint_seconds", "differences_seconds"), "s"),
    **dict.fromkeys(("step", "wall_seconds", "run_seconds"), "s"),
    **dict.fromkeys((f"run_seconds_{x}" for x in ("spread", "median", "low", "high")), "s"),
    **{"error": "m", "velocity_error": "m/s", "reaction_error": "N", "energy_drift_max": "J"},
    **{"dissipated": "J", "creep": "m/s"},
    **{
        f"{level}_violation_{kind}": unit
        for level, unit in (("position", "m"), ("velocity", "m/s"), ("acceleration", "m/s^2"))
        for kind in ("max", "rms", "final")
    },
}


@dataclass(frozen=True)
class Row:
    """One method with one integrator at one step or tolerance.

    Violations are Euclidean norms of Phi, ``D v - nu`` and ``D v' - gamma`` over all rows, those of angles in radians:
    a radian counts as a metre. The largest ones of position and velocity are over all accepted steps and outputs; those
    of acceleration, the roots of the mean squares and the final ones are over the outputs.

    Attributes
    ----------
    method, integrator : str
        What was run.
    step, rtol : float or None
        Constant step [s], or relative tolerance.
    status, reason
        As of a result; a failed run stays a row.
    beyond_limits : bool
        Whether the run is `failed` because it exceeded one of its limits, and the row measures it to its end without
        them.
    error : float or None
        Largest distance to the reference [m] over bodies, output times and points (`symgen.result.points`); None for a
        run that did not reach its end, and where there is no reference.
    relative_error : float or None
        The same as a share of the mechanism's length, `Study.length`.
    velocity_error : float or None
        Largest difference of the velocities of the same points [m/s].
    reaction_error : float or None
        Largest difference of a joint's reaction [N] that the motion determines; a moment counts as the force
        that has it at the mechanism's length. None also where no reaction is determined, with bounded rows.
    below_reference : bool
        Whether the error is below the estimated error of the reference, which is then its only bound.
    run_seconds, run_seconds_median : float
        Processor time of the thread of the run [s]: the median of rounds after a warm-up, under both names.
    run_seconds_low, run_seconds_high, run_seconds_spread : float or None
        Quartiles of the processor time, and longest minus shortest [s]; None for one run.
    wall_seconds : float
        Median time on the wall [s].
    disturbed : bool
        Whether the time on the wall was above 1.5 times the processor time, also when the row was measured again.
    cost_ratio : float or None
        Processor time over the time of `lagrange` with the same integrator and step or tolerance: the median of ratios
        within rounds, in which both run in turn. None where one of them failed or `lagrange` was not run.
    cost_ratio_low, cost_ratio_high : float or None
        Interval that holds the median of the ratios with 95 % (`symgen.study.comparison.turns`); None for one run.
    cost_ratio_spread : float or None
        Distance from the ratio to the farther end of the interval.
    evaluations, iterations : int
        Right-hand sides, and iterations of laws, corrections and implicit stages.
    position_violation_max, velocity_violation_max, acceleration_violation_max : float
        Largest violations [m, m/s, m/s^2].
    position_violation_rms, velocity_violation_rms, acceleration_violation_rms : float or None
        Roots of their mean squares; None where a run gave no output.
    position_violation_final, velocity_violation_final, acceleration_violation_final : float or None
        At the last output.
    relative_violation : float or None
        `position_violation_max` as a share of the mechanism's length.
    energy_drift_max : float
        Largest energy error [J].
    warnings : tuple of str
        Warnings as sentences.
    coordinates : {"absolute", "joint"}
        Coordinates of the state. Violations of joint coordinates are violations of the loops.
    variant : str
        Options that distinguish the method from others of the study, such as ``alpha=5, beta=5``.
    law : str
        Law of rows with two bounds, such as ``tanh:speed=0.001``; empty without bounded rows.
    transitions, impacts : int or None
        Changes of modes of bounded rows, and impacts; None without these, as the next ones.
    dissipated : float or None
        Energy that they have taken at the end [J].
    creep : float or None
        Largest rate along a coordinate with two bounds at outputs at which it rests in the reference [m/s]; of an
        angle times the mechanism's length. None where none rests.
    gradient_error : float or None
        Largest error of the derivatives of coordinates by a parameter, over the largest derivative; angles count by the
        mechanism's length. None without `gradient`, and for schemes without derivatives.
    gradient_seconds : float or None
        Run time with these derivatives [s].
    adjoint_error, adjoint_seconds : float or None
        The same by the adjoint, of the coordinate at the end that parameters change most: a run that keeps its stages
        and the way back. None where there is none.
    differences_error, differences_seconds : float or None
        The same by differences of two runs a parameter, each with the step of least error; the time of the search for
        it is left out.
    """

    method: str
    integrator: str
    step: float | None
    rtol: float | None
    status: str
    reason: str | None
    error: float | None
    below_reference: bool
    run_seconds: float
    run_seconds_spread: float | None
    evaluations: int
    position_violation_max: float
    velocity_violation_max: float
    energy_drift_max: float
    warnings: tuple[str, ...] = ()
    iterations: int = 0
    run_seconds_median: float = 0.0
    run_seconds_low: float | None = None
    run_seconds_high: float | None = None
    wall_seconds: float = 0.0
    disturbed: bool = False
    cost_ratio: float | None = None
    cost_ratio_low: float | None = None
    cost_ratio_high: float | None = None
    cost_ratio_spread: float | None = None
    acceleration_violation_max: float | None = None
    position_violation_rms: float | None = None
    velocity_violation_rms: float | None = None
    acceleration_violation_rms: float | None = None
    position_violation_final: float | None = None
    velocity_violation_final: float | None = None
    acceleration_violation_final: float | None = None
    relative_violation: float | None = None
    coordinates: str = "absolute"
    variant: str = ""
    beyond_limits: bool = False
    relative_error: float | None = None
    velocity_error: float | None = None
    reaction_error: float | None = None
    law: str = ""
    transitions: int | None = None
    impacts: int | None = None
    dissipated: float | None = None
    creep: float | None = None
    gradient_error: float | None = None
    gradient_seconds: float | None = None
    adjoint_error: float | None = None
    adjoint_seconds: float | None = None
    differences_error: float | None = None
    differences_seconds: float | None = None

    @property
    def label(self) -> str:
        """Method with its variant, and the coordinates unless absolute: ``lagrange, joint``."""
        law = "" if self.law == "exact" else self.law
        parts = self.method, self.variant, law, "" if self.coordinates == "absolute" else self.coordinates
        return ", ".join(filter(None, parts))

    @property
    def setting(self) -> tuple[str, float | None, float | None]:
        """Integrator, step and tolerance; run times are comparable between methods that share them."""
        return self.integrator, self.step, self.rtol

    @property
    def ended(self) -> bool:
        """Whether the run reached its end."""
        return self.status != FAILED or self.beyond_limits

    @property
    def status_text(self) -> str:
        """Status with its mark, which `BEYOND` explains."""
        return f"{self.status} +" if self.beyond_limits else self.status

    @property
    def time_mark(self) -> str:
        """Mark of a run time that other work has disturbed, which `LOADED` explains."""
        return " !" if self.disturbed else ""

    def texts(self) -> list[str]:
        """Return the fields as the cells of a table; None is empty."""
        return ["" if x is None else "; ".join(x) if isinstance(x, tuple) else str(x) for x in asdict(self).values()]


@dataclass(frozen=True)
class Trace:
    """Quantities of one run at its outputs, for drawing: five digits.

    Attributes
    ----------
    t : tuple of float
        Times [s].
    error : tuple of float
        Distance to the reference [m]; empty where there is none.
    position, velocity, acceleration : tuple of float
        Violations [m, m/s, m/s^2].
    kinetic, potential, energy_error : tuple of float
        Energies [J]; the last is T + V - E0 - W.
    """

    t: tuple[float, ...] = ()
    error: tuple[float, ...] = ()
    position: tuple[float, ...] = ()
    velocity: tuple[float, ...] = ()
    acceleration: tuple[float, ...] = ()
    kinetic: tuple[float, ...] = ()
    potential: tuple[float, ...] = ()
    energy_error: tuple[float, ...] = ()


#: Values that are not JSON numbers.
_NOT_FINITE = ("nan", "inf", "-inf")


def to_entry(row: Row, trace: Trace) -> dict[str, Any]:
    """Return a row with its curves as JSON values; numbers that are not finite are texts."""

    def json_of_value(value: object) -> Any:
        if isinstance(value, tuple):
            return [json_of_value(x) for x in value]
        return str(value) if isinstance(value, float) and not math.isfinite(value) else value

    return {
        what: {name: json_of_value(value) for name, value in asdict(part).items()}
        for what, part in (("row", row), ("trace", trace))
    }


def from_entry(entry: Mapping[str, Any]) -> tuple[Row, Trace]:
    """Return the row and the curves of an entry."""

    def value_of_json(value: object) -> Any:
        if isinstance(value, list):
            return tuple(value_of_json(x) for x in value)
        return float(value) if value in _NOT_FINITE else value

    values, curves = ({name: value_of_json(value) for name, value in entry[what].items()} for what in ("row", "trace"))
    return Row(**values), Trace(**curves)


class _Entry(TypedDict):
    row: Row
    trace: Trace


def check_entry(entry: Mapping[str, Any]) -> None:
    """Raise `ValueError` unless `from_entry` can read an entry of a journal."""
    row = msgspec.convert(entry, _Entry, strict=False)["row"]
    unknown = {*entry["row"], *entry["trace"]} - {f.name for part in (Row, Trace) for f in fields(part)}
    if unknown or row.status not in (OK, UNVERIFIED, FAILED):
        raise ValueError(row.status)


def half_width(ratio: float | None, low: float | None, high: float | None) -> float | None:
    """Return the ± of a ratio that covers an interval; None without one."""
    return None if ratio is None or low is None or high is None else max(high - ratio, ratio - low)
