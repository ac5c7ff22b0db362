"""Whole runs of a mechanism in C: their integrators, numbers of their memory, and words for what happens in them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.base.errors import InputError
from symgen.compile.native.c99_words import break_line, c_number
from symgen.result.targets._c_reasons import values_of_ends
from symgen.run.integrators import INTEGRATORS
from symgen.run.integrators._tableau import Tableau
from symgen.run.layout import abi
from symgen.run.modes.transition_log import OF_LOG
from symgen.run.planning.outputs import DEFAULT_OUTPUTS
from symgen.run.printed import kept_run
from symgen.run.single.turn_memory import words_of_run

if TYPE_CHECKING:
    from collections.abc import Collection

    from symgen.describe.mechanism import Mechanism
    from symgen.run.compiling.printed_run import PrintedRun
    from symgen.run.layout.compiled import CompiledModel


def check_integrator(name: str | None) -> None:
    """Refuse an integrator that is not printed: explicit Runge-Kutta schemes are, as they have no matrices.

    Raises
    ------
    InputError
        If it is another one, or none.
    """
    if name is not None and not _is_printed(name):
        schemes = ", ".join(filter(_is_printed, INTEGRATORS.names))
        raise InputError(f"integrator '{name}'", f"an explicit Runge-Kutta scheme: {schemes}", "another one")


def _is_printed(name: str) -> bool:
    return type(INTEGRATORS.get(name, "integrator")) is Tableau


def values_of_run(mechanism: Mechanism, run: PrintedRun, used: Collection[str], own: Collection[str]) -> dict[str, Any]:
    """Return the values of templates for a whole run.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism.
    run : PrintedRun
        Its run.
    used, own : collection of str
        Names of the arrays that the printed functions use, and of those that others set.
    """
    watched = run.watched
    return {
        "bounded": [row.name for row in mechanism.bounded],
        "words": words_of_run(() if watched is None else watched.turning),
        "of_log": OF_LOG,
        "functions_of_events": 0 if watched is None else len(watched.names) + len(watched.switches),
        "ending": kept_run.ENDING,
        "changed": kept_run.CHANGED,
        "end": kept_run.END_TIME,
        "integrator": run.integrator.name,
        "between": _time_between(mechanism),
        **values_of_ends(run),
        "initial": [
            {"name": name, "numbers": cells_of(array)}
            for name, array in run.memory.items()
            if name in used and name not in own and np.any(array)
        ],
    }


def _time_between(mechanism: Mechanism) -> str:
    """Return the time between two rows of an adaptive run [s]."""
    every = mechanism.defaults.output_step
    return f"until/{DEFAULT_OUTPUTS - 1}" if every is None else c_number(every)


def places_of_scales(compiled: CompiledModel) -> list[tuple[int, int]]:
    """Return the first places of scales in the scratch, and the ends of their sections."""
    alone = ((place, place + 1) for place in (abi.LENGTH, abi.SPEED, abi.MEAN_MASS))
    sections = (compiled.info.sections[name] for name in ("gauge", "row_weight"))
    return [*alone, *((first, first + size) for first, size in sections if size)]


def cells_of(array: Any) -> str:
    """Return places and numbers of an array that are not 0."""
    return break_line(", ".join(f"{{{i}, {c_number(float(array[i]))}}}" for i in np.flatnonzero(array)))
