"""Checks of entries of a journal: what a cell of a stress study stores."""

from __future__ import annotations

from typing import Any, TypedDict

import msgspec

from symgen.result.result import FAILED, OK, UNVERIFIED
from symgen.study.journal import Outcome
from symgen.study.stress.cell_outcome import OUTCOMES


class _Motion(TypedDict):
    unusable: None
    how: str
    estimated_error: float
    q: list[list[float]]
    decay: float
    sines: list[float]
    length: float
    parameters: dict[str, float]


class _Unusable(TypedDict):
    unusable: str


def check_motion(entry: Outcome) -> None:
    """Raise `ValueError` unless an entry of a journal belongs to a reference."""
    motion: dict[str, Any] = msgspec.convert(entry, _Motion if entry.get("unusable") is None else _Unusable)
    if len({*map(len, motion.get("q", ()))}) > 1:
        raise ValueError("rows of different lengths")


class _Run(TypedDict):
    outcome: str
    error: float | None
    relative_error: float | None
    status: str
    reason: str | None
    evaluations: int
    position_violation_max: float | None
    velocity_violation_max: float | None
    energy_drift_max: float | None
    chosen: str
    note: str


class _Steps(TypedDict):
    stable_step: float | None
    accurate_step: float | None


def check_run(entry: Outcome) -> None:
    """Raise `ValueError` unless an entry of a journal belongs to a run."""
    run = msgspec.convert(entry, _Run)
    if run["outcome"] not in OUTCOMES or run["status"] not in (OK, UNVERIFIED, FAILED, "not run"):
        raise ValueError(run["status"])


def check_limit(entry: Outcome) -> None:
    """Raise `ValueError` unless an entry of a journal belongs to a search."""
    msgspec.convert(entry, _Steps)
