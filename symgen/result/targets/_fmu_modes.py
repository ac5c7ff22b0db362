"""Rows with bounds of a mechanism in model exchange: event indicators, and rows that modes put into force."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from symgen.compile.native.c99_words import broken_line
from symgen.run.printed import exchanged_run
from symgen.run.starts.assembler import layout_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from symgen.result.targets._c_model import CModel


def indicator_names(model: CModel) -> tuple[str, ...]:
    """Return the names of the switching functions of a run: events, margins of modes, comparisons in formulas."""
    run = model.printed_run
    watched = None if run is None or not model.mechanism.bounded else run.watched
    if watched is None:
        return tuple(event.name for event in model.mechanism.events)
    return (*watched.names, *(f"comparison_{i}" for i in range(1, len(watched.switches) + 1)))


def values_of_exchange(model: CModel, holonomic: Sequence[int]) -> dict[str, Any]:
    """Return the values of templates for model exchange, and for the modes in it.

    Parameters
    ----------
    model : CModel
        The mechanism.
    holonomic : sequence of int
        Its rows that are functions of positions.
    """
    has_modes = model.exchanges and bool(model.mechanism.bounded)
    flags = {"exchanges": model.exchanges, "exchange_modes": has_modes}
    if not has_modes:
        return {"now": "f->t", **flags}
    info = model.compiled.info
    asked = {name.lower(): getattr(exchanged_run, name) for name in ("COMPLETE", "HANDLE", "GO_ON", "ASK")}
    answers = {name.lower(): getattr(exchanged_run, name) for name in ("HAPPENED", "OVER", "STUCK")}
    outputs, run = [output.name for output in model.mechanism.outputs], model.printed_run
    watched = None if run is None else run.watched
    rows = () if watched is None or watched.bounded is None else watched.bounded.names
    positions = [*holonomic, *(-1 for _ in info.spins)]
    return {
        **flags,
        "now": "evaluation_time(f)",
        "functions_of_modes": len(indicator_names(model)),
        "switches": _numbers(layout_of(model.compiled).switches.tolist()),
        "velocity_rows": _numbers(range(info.m)),
        "position_rows": _numbers(positions or (-1,)),
        "asked": asked,
        "answers": answers,
        "next": exchanged_run.NEXT,
        "behind": exchanged_run.BEHIND,
        "rests": exchanged_run.RESTS,
        "mode_outputs": _numbers(outputs.index(f"{row}.mode") for row in rows),
    }


def _numbers(numbers: Iterable[int]) -> str:
    return broken_line(", ".join(map(str, numbers)))
