"""Rows of results, timing, and what is read from them; standard library only."""

from __future__ import annotations

import math
import statistics
import time
from collections.abc import Callable, Iterable, Iterator
from typing import NotRequired, TypedDict

WRONG = 0.1
REPEATS = 7
BUDGET = 2.0
ENOUGH = 0.3
MOST = 200

Measured = tuple[float, float, float, float]
"""Least time, spread, least processor time, all in s, and error in rad."""


class Row(TypedDict):
    """One setting of one peer on one mechanism.

    Attributes
    ----------
    peer, version, setting, model : str
        What was run.
    seconds : float or None
        Least loop time of the repeats in s; None where the run failed.
    spread : float or None
        Median less least loop time in s.
    cpu : float, optional
        Least processor time of the repeats in s: equal to `seconds` on a quiet
        machine, and the steadier of the two on a shared one.
    error : float or None
        Largest error of a body angle over the run in rad.
    status : str
        ``ok``, ``wrong`` (error above `WRONG`) or ``failed: reason``.
    """

    peer: str
    version: str
    setting: str
    model: str
    seconds: float | None
    spread: float | None
    cpu: NotRequired[float]
    error: float | None
    status: str


def best_of(loop: Callable[[], object]) -> tuple[float, float, float]:
    """Time a loop, which has been run once before to warm up.

    Parameters
    ----------
    loop : callable
        The integration, without its preparation.

    Returns
    -------
    best, spread, cpu : float
        Least time, median less least time, and least processor time, in s. A loop runs
        `REPEATS` times, fewer (but twice) once `BUDGET` seconds are spent, and
        more (up to `MOST`) until `ENOUGH` seconds are.
    """
    times: list[float] = []
    processor: list[float] = []
    while (
        len(times) < 2 or (len(times) < REPEATS and sum(times) < BUDGET) or (len(times) < MOST and sum(times) < ENOUGH)
    ):
        start, busy = time.perf_counter(), time.process_time()
        loop()
        processor.append(time.process_time() - busy)
        times.append(time.perf_counter() - start)
    return min(times), statistics.median(times) - min(times), min(processor)


def row(
    peer: str,
    version: str,
    setting: str,
    model: str,
    run: Callable[[], Measured],
) -> Row:
    """Run one setting and make a row of it, whatever happens.

    Parameters
    ----------
    peer, version, setting, model : str
        What is run.
    run : callable
        Returns what was measured.

    Returns
    -------
    Row
        The result; a failure becomes a status.
    """
    out = Row(
        peer=peer,
        version=version,
        setting=setting,
        model=model,
        seconds=None,
        spread=None,
        error=None,
        status="ok",
    )
    try:
        seconds, spread, cpu, error = run()
    except Exception as problem:
        lines = str(problem).strip().splitlines() or [type(problem).__name__]
        out["status"] = f"failed: {lines[-1][:120]}"
        return out
    if not math.isfinite(error):
        out["status"] = "failed: not finite"
        return out
    out["seconds"], out["spread"], out["cpu"], out["error"] = seconds, spread, cpu, error
    if error > WRONG:
        out["status"] = "wrong"
    return out


def seconds_at(rows: Iterable[Row], error: float = 1e-6) -> float | None:
    """Least time among the settings that are accurate enough.

    Parameters
    ----------
    rows : iterable of Row
        Rows of one peer and one mechanism.
    error : float
        Largest admissible error in rad.

    Returns
    -------
    float or None
        Seconds, or None where no setting reaches the error.
    """
    best = fastest(rows, error)
    return None if best is None else best["seconds"]


def fastest(rows: Iterable[Row], error: float = 1e-6) -> Row | None:
    """Find the row that `seconds_at` reads.

    Parameters
    ----------
    rows : iterable of Row
        Rows of one peer and one mechanism.
    error : float
        Largest admissible error in rad.

    Returns
    -------
    Row or None
        The fastest row that is accurate enough.
    """
    chosen: Row | None = None
    least = math.inf
    for entry in rows:
        seconds, reached = entry["seconds"], entry["error"]
        if seconds is None or reached is None or reached > error or seconds >= least:
            continue
        chosen, least = entry, seconds
    return chosen


def table(rows: Iterable[Row]) -> Iterator[str]:
    """Lay rows out as lines of text.

    Parameters
    ----------
    rows : iterable of Row
        Any rows.

    Yields
    ------
    str
        One line, a heading first.
    """
    yield f"{'model':15} {'peer':8} {'setting':58} {'seconds':>9} {'spread':>8} {'cpu':>9} {'error':>8} status"
    for entry in rows:
        cells = [
            "-" if value is None else form.format(value)
            for value, form in (
                (entry["seconds"], "{:.5f}"),
                (entry["spread"], "{:.1e}"),
                (entry.get("cpu"), "{:.5f}"),
                (entry["error"], "{:.1e}"),
            )
        ]
        yield (
            f"{entry['model']:15} {entry['peer']:8} {entry['setting']:58} "
            f"{cells[0]:>9} {cells[1]:>8} {cells[2]:>9} {cells[3]:>8} {entry['status']}"
        )
