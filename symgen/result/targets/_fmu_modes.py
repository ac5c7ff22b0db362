"""Rows with bounds of a mechanism in model exchange: event indicators, and rows that modes put into force."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from symgen.compile.native.c99_words import break_line
from symgen.run.printed import exchanged_run
from symgen.run.printed.partition import POOR
from symgen.run.printed.partition_tables import count_states
from symgen.run.starts.assembler import layout_of_starts

if TYPE_CHECKING:
    from collections.abc import Iterable

    from symgen.result.targets._c_model import CModel


def indicator_names(model: CModel) -> tuple[str, ...]:
    """Return the names of event indicators: events, margins of modes, comparisons in formulas, the choice of states."""
    if not model.exchanges:
        return ()
    run, names = model.printed_run, tuple(event.name for event in model.mechanism.events)
    if run is not None and run.watched is not None:
        names = (*run.watched.names, *(f"comparison_{i}" for i in range(1, len(run.watched.switches) + 1)))
    return (*names, "choice_of_states")


def values_of_exchange(model: CModel) -> dict[str, Any]:
    """Return the values of templates for model exchange, and for the modes in it."""
    has_modes = model.exchanges and bool(model.mechanism.bounded)
    flags = {"exchanges": model.exchanges, "exchange_modes": has_modes, "now": "f->t", "states": 0}
    flags["indicator_count"] = len(indicator_names(model))
    if not model.exchanges:
        return flags
    values = {
        **flags,
        **{name: int(getattr(model.partition, name)) for name in ("rank_q", "rank_v", "rest")},
        "states": count_states(layout_of_starts(model.compiled), model.partition),
        "poor": POOR,
        "asked": {name.lower(): getattr(exchanged_run, name) for name in ("COMPLETE", "HANDLE", "GO_ON", "ASK")},
        "answers": {name.lower(): getattr(exchanged_run, name) for name in ("QUIET", "HAPPENED", "OVER", "STUCK")},
    }
    if has_modes:
        outputs, run = [output.name for output in model.mechanism.outputs], model.printed_run
        watched = None if run is None else run.watched
        rows = () if watched is None or watched.bounded is None else watched.bounded.names
        values |= {
            "now": "evaluation_time(f)",
            "next": exchanged_run.NEXT,
            "behind": exchanged_run.AFTER,
            "rests": exchanged_run.RESTS,
            "mode_outputs": _numbers(outputs.index(f"{row}.mode") for row in rows),
        }
    return values


def _numbers(numbers: Iterable[int]) -> str:
    return break_line(", ".join(map(str, numbers)))
