"""Small parts of a result: its rank, and where the time went."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Rank:
    """Rank of D at the start, and rows that were left out because they repeat another row for all q."""

    rows: int
    rank: int
    identical_rows_dropped: int
    redundant_rows: tuple[str, ...] = ()


@dataclass(frozen=True)
class Seconds:
    """Wall-clock times [s]; `run` is the integration loop alone, the best of several where repeated."""

    derive: float
    emit: float
    compile: float
    run: float
    run_spread: float = 0.0
