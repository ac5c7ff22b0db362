"""Checks of entries of a journal: what a cell of a stress study stores."""

from __future__ import annotations

from typing import Any, TypedDict, get_type_hints

import msgspec

from symgen.result.result import FAILED, OK, UNVERIFIED
from symgen.study.journal import Outcome
from symgen.study.stress.cell_outcome import OUTCOMES
from symgen.study.stress.stress_rows import LargestSteps, StressRow

#: Fields of a row and of a largest step that follow from their task; their entry stores the others.
OF_TASK = frozenset(
    (
        *("model", "family", "case", "values", "method", "integrator", "step", "until"),
        *("reference_error", "watched"),
    )
)


def _stored(row: type) -> type[msgspec.Struct]:
    """Return the type of an entry: the fields of a row that its task does not have."""
    return msgspec.defstruct(row.__name__, [(n, kind) for n, kind in get_type_hints(row).items() if n not in OF_TASK])


_RUN, _STEPS = _stored(StressRow), _stored(LargestSteps)


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


def check_run(entry: Outcome) -> None:
    """Raise `ValueError` unless an entry of a journal belongs to a run."""
    msgspec.convert(entry, _RUN)
    if entry["outcome"] not in OUTCOMES or entry["status"] not in (OK, UNVERIFIED, FAILED, "not run"):
        raise ValueError(entry["status"])


def check_limit(entry: Outcome) -> None:
    """Raise `ValueError` unless an entry of a journal belongs to a search."""
    msgspec.convert(entry, _STEPS)
