"""Laws of rows with two bounds as lines of a comparison, and what runs with bounds are measured by besides."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from typing import TYPE_CHECKING

import numpy as np
from msgspec import structs
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import Expr, call
from symgen.describe.bounds.bounded_modes import (
    HIT,
    MODE,
    measure_derivative,
    one_sided_rows,
    two_sided_rows,
    without_bounds,
)
from symgen.describe.bounds.losses import LOSS, energy_taken
from symgen.describe.bounds.smooth import WITH_LAWS, rows_as_forces, smooth_rows
from symgen.describe.mechanism import Mechanism, Output
from symgen.run.compiling.side import compile_side
from symgen.study.comparison.combinations import split_variant

if TYPE_CHECKING:
    from symgen.run.single.outcome import Motion, Outcome

Array = NDArray[np.float64]

EXACT, TANH = "exact", "tanh"
#: A coordinate rests in the reference where its rate is below this part of the largest speed.
RESTS = 1e-9


def mechanisms_of_laws(mechanism: Mechanism, laws: Sequence[str], values: Mapping[str, float]) -> dict[str, Mechanism]:
    """Return the mechanism with each law of its rows, with the energy that rows with bounds take as an output.

    Parameters
    ----------
    mechanism : Mechanism
        With the exact law.
    laws : sequence of str
        ``exact``, ``tanh:speed=1e-3``; the exact one by default.
    values : mapping
        Values of all parameters.

    Raises
    ------
    InputError
        If a law is unknown, or the mechanism has no rows with two bounds, or none that is smooth in motion.
    """
    if not mechanism.bounded and not laws:
        return {"": mechanism}
    if not two_sided_rows(mechanism) and laws:
        raise InputError("laws", f"a mechanism with {WITH_LAWS}", f"'{mechanism.name}', which has none")
    return {law: _report_losses(*_put_law(mechanism, law, values)) for law in dict.fromkeys(laws or (EXACT,))}


def _put_law(mechanism: Mechanism, law: str, values: Mapping[str, float]) -> tuple[Mechanism, list[Expr]]:
    """Return a mechanism with a law, and the energies that rows with bounds take."""
    name, options = split_variant(law)
    if law == EXACT:
        return mechanism, [energy_taken(bounded) for bounded in mechanism.bounded]
    try:
        speed = float(options["speed"]) if name == TANH and set(options) == {"speed"} else 0.0
    except ValueError:
        speed = 0.0
    if not 0.0 < speed < np.inf:
        raise InputError("laws", "exact, or tanh:speed=V with a rate V above 0", f"'{law}'")
    exact = two_sided_rows(mechanism)
    smooth = smooth_rows(f"law '{law}'", exact, speed, values)
    losses: list[Expr] = [energy_taken(row) for row in (*smooth, *one_sided_rows(mechanism))]
    return rows_as_forces(without_bounds(mechanism, exact), smooth), losses


def _report_losses(mechanism: Mechanism, losses: Sequence[Expr]) -> Mechanism:
    """Return a mechanism whose only output is the energy taken."""
    return structs.replace(mechanism, outputs=(Output(LOSS, reduce(lambda a, b: call("add", a, b), losses), "J"),))


def rates_along_rows(mechanism: Mechanism, motion: Motion) -> Array:
    """Return the rates of coordinates along rows with two bounds at the outputs of a motion, shape (k, n)."""
    formulas = [(f"rate of {row.name}", measure_derivative(row)) for row in two_sided_rows(mechanism)]
    if not formulas or not len(motion.times):
        return np.zeros((len(motion.times), len(formulas)))
    side = compile_side(mechanism, motion.compiled, "rates", "Rates along rows with bounds", formulas)
    return motion.observe_motion(side.function, len(formulas))


def is_resting(rates: Array, scales: Array) -> NDArray[np.bool_]:
    """Return where coordinates of a reference rest at an output and at both beside it."""
    rests = np.abs(rates) <= RESTS * scales
    ends = np.zeros((1, rates.shape[1]), dtype=np.bool_)
    inside: NDArray[np.bool_] = rests & np.vstack([ends, rests[:-1]]) & np.vstack([rests[1:], ends])
    return inside


@dataclass(frozen=True)
class BoundedRowMeasures:
    """Measures of a run with rows with bounds.

    Attributes
    ----------
    transitions, impacts : int
        Changes of modes, and impacts; a smooth law has no modes.
    dissipated : float or None
        Energy that rows with bounds and impacts have taken [J]; None without outputs.
    """

    transitions: int
    impacts: int
    dissipated: float | None


def contact_measures(mechanism: Mechanism, outcome: Outcome) -> BoundedRowMeasures | None:
    """Return these measures of a run of a comparison; None where its mechanism has no rows with bounds."""
    loss = next((output.value for output in mechanism.outputs if output.name == LOSS), None)
    if loss is None:
        return None
    names = list(_mode_event_names(outcome))
    impacts, dissipated = sum(name.endswith(f".{HIT}") for name in names), None
    if len(outcome.times):
        side = compile_side(mechanism, outcome.compiled, "losses", "Energy lost", [(LOSS, loss)])
        dissipated = float(outcome.observe_motion(side.function, 1)[-1, 0])
    return BoundedRowMeasures(len(names) - impacts, impacts, dissipated)


def _mode_event_names(outcome: Outcome) -> Iterator[str]:
    return (event.name for event in outcome.happened if event.action == MODE)
