"""Results of a stress study: rows of the map and of planes, largest steps, their JSON and CSV, and the map itself."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, fields
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, cast

from symgen.base.files import check_writable, heading_with_unit, need_library, write_csv
from symgen.result.contract import json_value
from symgen.study.references.effort import IMPLICIT_BUDGET, explicit_limits
from symgen.study.saving import save_study
from symgen.study.stress.cell_outcome import ACCURATE, GOOD, OUTCOMES, REFUSED, UNJUDGED, count_outcomes, false_success

if TYPE_CHECKING:
    import pandas as pd

#: Units of columns.
UNITS = {
    **{"step": "s", "until": "s", "error": "m", "reference_error": "m"},
    **{"position_violation_max": "m", "velocity_violation_max": "m/s", "energy_drift_max": "J"},
}


@dataclass(frozen=True)
class StressRow:
    """One cell of the map.

    Attributes
    ----------
    model, family, case : str
        Base model (``-`` for a family with a mechanism of its own), family and case in words.
    values : tuple of float
        Varied quantities.
    method, integrator : str
        Names as run; the choice of ``auto`` is in `chosen`.
    step : float or None
        Constant step [s].
    until : float
        End [s].
    outcome : str
        One of `symgen.study.stress.cell_outcome.OUTCOMES`, by the distance to the reference.
    error : float or None
        Largest distance to the reference [m] at the outputs that the run reached.
    relative_error : float or None
        The same as a share of the mechanism's length.
    reference_error : float or None
        Estimated error of the reference [m]; None without one.
    status, reason
        The run's own status; ``not run`` where it was refused or predicted to be too slow.
    evaluations : int
        Right-hand sides or residuals; the budget where it took more.
    position_violation_max, velocity_violation_max, energy_drift_max : float or None
        As of a result.
    chosen, note : str
        Choice of ``auto``, and the end of a run that ended early.
    watched : bool
        Whether the run watched itself; its status counts only then.
    verified : str
        Status with ``--verify`` of a run that alone is ok and not accurate; empty for others.
    """

    model: str
    family: str
    case: str
    values: tuple[float, ...]
    method: str
    integrator: str
    step: float | None
    until: float
    outcome: str
    error: float | None
    relative_error: float | None
    reference_error: float | None
    status: str
    reason: str | None
    evaluations: int
    position_violation_max: float | None
    velocity_violation_max: float | None
    energy_drift_max: float | None
    chosen: str
    note: str
    watched: bool
    verified: str = ""

    @property
    def false_success(self) -> bool:
        """Whether the run reports ok although it is not accurate."""
        return self.watched and false_success(self.status, self.outcome)

    @property
    def verified_falsely(self) -> bool:
        """Whether it does so with ``--verify`` too."""
        return self.watched and false_success(self.verified, self.outcome)


@dataclass(frozen=True)
class LargestSteps:
    """The largest constant steps of a method on a case [s].

    None where the smallest one tried is too large; `until` where the whole run is one step, which bounds a limit that
    the run is too short for.
    """

    model: str
    family: str
    case: str
    method: str
    integrator: str
    stable_step: float | None
    accurate_step: float | None
    until: float

    @property
    def words(self) -> tuple[str, str]:
        """Both steps to three digits, ``>=`` before bounds."""
        return self._in_words(self.stable_step), self._in_words(self.accurate_step)

    def _in_words(self, step: float | None) -> str:
        return "none" if step is None else f"{'>= ' if step >= self.until else ''}{step:.3g}"


@dataclass(frozen=True)
class ExtremeReached:
    """The extreme value of a family that a method reaches with all runs up to it accurate.

    Attributes
    ----------
    reached : float or None
        The largest value tried; None where the least is too large.
    beyond : float or None
        The next one tried, which is too large; None where all are accurate.
    """

    model: str
    family: str
    method: str
    integrator: str
    reached: float | None
    beyond: float | None


@dataclass(frozen=True)
class Stress:
    """Results of a stress study.

    Attributes
    ----------
    models : tuple of str
        Base models.
    rows : tuple of StressRow
        Cells of the map and of the planes.
    limits : tuple of LargestSteps
        Largest steps.
    extremes : tuple of ExtremeReached
        Extreme values that methods reach, each with the integrator of its constant steps.
    skipped : tuple of (str, str, str)
        Model, family and why it has no cases.
    unusable : tuple of (str, str, str, str)
        Model, family, case and why its reference judges nothing.
    left_out : tuple of (str, str, str, str)
        Mechanism, method, integrator and why the pair is not run at all.
    quick, interrupted : bool
        Whether fewer cases were requested; whether the study was stopped before its last cell.
    coordinates : str
        Coordinates of the state of all runs.
    underived : tuple of (str, str)
        Models that two formulations judge, and what of each no second derivation has.
    """

    report_kind: ClassVar[str] = "stress-report"

    models: tuple[str, ...]
    rows: tuple[StressRow, ...]
    limits: tuple[LargestSteps, ...]
    skipped: tuple[tuple[str, str, str], ...]
    unusable: tuple[tuple[str, str, str, str], ...]
    left_out: tuple[tuple[str, str, str, str], ...] = ()
    quick: bool = False
    interrupted: bool = False
    coordinates: str = "absolute"
    underived: tuple[tuple[str, str], ...] = ()
    extremes: tuple[ExtremeReached, ...] = ()

    @property
    def false_successes(self) -> tuple[StressRow, ...]:
        """Cells in which a run says ok although it is not accurate."""
        return tuple(row for row in self.rows if row.false_success)

    def to_json(self) -> dict[str, Any]:
        """Return the contract of ``symgen stress --json``."""
        from symgen.study.stress.beside import beside_yardstick
        from symgen.study.stress.findings import explain_failures, findings_of_study

        constant, adaptive = explicit_limits(self.quick)
        contract = {
            "models": list(self.models),
            "coordinates": self.coordinates,
            "quick": self.quick,
            "interrupted": self.interrupted,
            "accurate": ACCURATE,
            "budget": {"explicit": constant, "adaptive": adaptive, "implicit": IMPLICIT_BUDGET},
            "cells": len(self.rows),
            "outcomes": count_outcomes([row.outcome for row in self.rows]),
            "rows": [asdict(row) for row in self.rows],
            "limits": [asdict(limit) for limit in self.limits],
            "extremes": [asdict(extreme) for extreme in self.extremes],
            "beside": [asdict(line) for line in beside_yardstick(self)],
            "skipped": [dict(zip(("model", "family", "why"), s, strict=True)) for s in self.skipped],
            "unusable": [dict(zip(("model", "family", "case", "why"), s, strict=True)) for s in self.unusable],
            "left_out": [
                dict(zip(("mechanism", "method", "integrator", "why"), s, strict=True)) for s in self.left_out
            ],
            "false_successes": [{**asdict(row), "why": explain_failures(row)} for row in self.false_successes],
            "findings": list(findings_of_study(self)),
        }
        return cast(dict[str, Any], json_value(contract))

    def to_dataframe(self) -> pd.DataFrame:
        """Return the cells as a pandas data frame."""
        need_library("to_dataframe", "pandas")
        import pandas as pd

        return pd.DataFrame([asdict(row) for row in self.rows], columns=[f.name for f in fields(StressRow)])

    def save(self, path: str | PathLike[str]) -> Path:
        """Write the cells to a ``.csv`` file, or the report to ``.html``, ``.pdf`` or ``.md``; whole or not at all.

        Raises
        ------
        InputError
            If the ending is another, matplotlib is missing for a report, or the file cannot be written.
        """
        return save_study(self, path, lambda file: save_stress_csv(self, file))


def save_stress_csv(study: Stress, path: Path, units: bool = False) -> Path:
    """Write the rows of a study to a CSV file, with units if requested; it appears whole or not at all."""
    check_writable("csv", path)
    rows = [asdict(row) | {"values": " ".join(f"{x!r}" for x in row.values)} for row in study.rows]
    heading = [heading_with_unit(f.name, UNITS.get(f.name, "")) if units else f.name for f in fields(StressRow)]
    return write_csv(path, heading, [list(row.values()) for row in rows])


#: Letters of outcomes in a map.
LETTERS = {
    "inaccurate": "i",
    "wrong branch": "b",
    "singular": "s",
    "diverged": "d",
    "too slow": "t",
    "refused": "r",
    "unjudged": "u",
}
#: Legend of the letters, one line.
LEGEND = ", ".join(f"{letter} {outcome}" for outcome, letter in LETTERS.items())


@dataclass(frozen=True)
class Entry:
    """One field of the map.

    Attributes
    ----------
    rows : tuple of StressRow
        The cells that it sums up.
    """

    rows: tuple[StressRow, ...]

    @property
    def judged(self) -> int:
        """Cells that were run against a reference."""
        return sum(row.outcome not in (REFUSED, UNJUDGED) for row in self.rows)

    @property
    def good(self) -> int:
        """Cells that were accurate."""
        return sum(row.outcome == GOOD for row in self.rows)

    @property
    def text(self) -> str:
        """Accurate cells of all that were judged, with the letters of the other outcomes: ``3/5 di``."""
        if not self.rows:
            return ""
        numbers = count_outcomes([row.outcome for row in self.rows])
        letters = "".join(LETTERS[name] for name in OUTCOMES if name in LETTERS and numbers[name])
        return f"{self.good}/{self.judged} {letters}".strip()


@dataclass(frozen=True)
class Map:
    """Fields by method and family.

    Attributes
    ----------
    lines : tuple of (str, str)
        Methods with their integrators, in the order of the rows.
    families : tuple of str
        Columns.
    """

    lines: tuple[tuple[str, str], ...]
    families: tuple[str, ...]
    rows: tuple[StressRow, ...]

    @classmethod
    def of_study(cls, study: Stress) -> Map:
        """Return the map of all families in which one quantity is varied."""
        rows = map_rows(study.rows)
        lines = tuple(dict.fromkeys((row.method, row.integrator) for row in rows))
        order = {name: i for i, name in enumerate(dict.fromkeys(method for method, _ in lines))}
        families = tuple(dict.fromkeys(row.family for row in rows))
        return cls(tuple(sorted(lines, key=lambda line: order[line[0]])), families, rows)

    def entry(self, line: tuple[str, str], family: str | None = None) -> Entry:
        """Return a field of a family, by default of all families together."""
        return Entry(
            tuple(
                row
                for row in self.rows
                if (row.method, row.integrator) == line and (family is None or row.family == family)
            )
        )


def map_rows(rows: Iterable[StressRow]) -> tuple[StressRow, ...]:
    """Return the rows of the map, without rows of planes."""
    return tuple(row for row in rows if len(row.values) == 1)


def plane_rows(rows: Iterable[StressRow], family: str) -> tuple[StressRow, ...]:
    """Return the rows of one plane."""
    return tuple(row for row in rows if row.family == family)


def plane_lines(rows: Sequence[StressRow]) -> tuple[tuple[str, str, str], ...]:
    """Return (model, method, integrator) of the planes among rows, in order."""
    return tuple(dict.fromkeys((row.model, row.method, row.integrator) for row in rows))


def outcomes_of_models(rows: Sequence[StressRow]) -> tuple[tuple[str, dict[str, int]], ...]:
    """Return the number of each outcome on each model, planes included; ``-`` are mechanisms of families."""
    models = dict.fromkeys(row.model for row in rows)
    return tuple((model, count_outcomes([row.outcome for row in rows if row.model == model])) for model in models)


def shares_of_models(rows: Sequence[StressRow]) -> tuple[tuple[str, int, int], ...]:
    """Return model, accurate cells and judged cells of the map."""
    outcomes = outcomes_of_models(map_rows(rows))
    return tuple((m, n[GOOD], sum(n.values()) - n[REFUSED] - n[UNJUDGED]) for m, n in outcomes if m != "-")
