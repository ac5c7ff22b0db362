"""Laws of dry friction as lines of a comparison, and what runs with dry friction or stops are measured by besides."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from typing import TYPE_CHECKING

import numpy as np
from msgspec import structs
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import Expr, Number, call
from symgen.describe.bounds.friction import MODE, rate_of, without_friction
from symgen.describe.bounds.losses import LOSS, loss_of
from symgen.describe.bounds.smooth_friction import with_smooth_friction
from symgen.describe.bounds.stops import HIT
from symgen.describe.formulas.evaluate import evaluate
from symgen.describe.mechanism import EndStop, Friction, Mechanism, Output
from symgen.run.compiling.side import compile_side
from symgen.study.comparison.combinations import variant_of

if TYPE_CHECKING:
    from symgen.run.single.outcome import Motion, Outcome

Array = NDArray[np.float64]

EXACT, TANH = "exact", "tanh"
#: A coordinate rests in the reference where its rate is below this part of the largest speed.
RESTS = 1e-9


def mechanisms_of_laws(mechanism: Mechanism, laws: Sequence[str], values: Mapping[str, float]) -> dict[str, Mechanism]:
    """Return the mechanism with each law of dry friction, with the energy that friction and stops take as an output.

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
        If a law is unknown, or the mechanism has no dry friction or none that is smooth in motion.
    """
    if not mechanism.bounded and not laws:
        return {"": mechanism}
    if not mechanism.frictions and laws:
        raise InputError("laws", "a mechanism with dry friction", f"'{mechanism.name}', which has none")
    return {law: _with_losses(*_with_law(mechanism, law, values)) for law in dict.fromkeys(laws or (EXACT,))}


def _with_law(mechanism: Mechanism, law: str, values: Mapping[str, float]) -> tuple[Mechanism, list[Expr]]:
    """Return a mechanism with a law, and the energies that friction and stops take."""
    name, options = variant_of(law)
    if law == EXACT:
        return mechanism, [loss_of(bounded) for bounded in mechanism.bounded]
    try:
        speed = float(options["speed"]) if name == TANH and set(options) == {"speed"} else 0.0
    except ValueError:
        speed = 0.0
    if not 0.0 < speed < np.inf:
        raise InputError("laws", "exact, or tanh:speed=V with a rate V above 0", f"'{law}'")
    for friction in mechanism.frictions:
        where, expected = f"law '{law}'", "dry friction with one constant bound, or with stribeck_speed"
        if friction.pressed:
            raise InputError(where, expected, f"that of {friction.name} by the reaction")
        low, high = (evaluate(bound, values, where) for bound in (friction.sliding, friction.static))
        if high != low and friction.stribeck_speed is None:
            raise InputError(where, expected, f"that of {friction.name}, {high:g} at rest and {low:g} in motion")
    smooth: list[Friction] = [structs.replace(friction, speed=Number(speed)) for friction in mechanism.frictions]
    bounded: list[Friction | EndStop] = [*smooth, *mechanism.stops]
    return with_smooth_friction(without_friction(mechanism), smooth), [loss_of(each) for each in bounded]


def _with_losses(mechanism: Mechanism, losses: Sequence[Expr]) -> Mechanism:
    """Return a mechanism whose only output is the energy taken."""
    return structs.replace(mechanism, outputs=(Output(LOSS, reduce(lambda a, b: call("add", a, b), losses), "J"),))


def rates_of_friction(mechanism: Mechanism, motion: Motion) -> Array:
    """Return the rates of coordinates with dry friction at the outputs of a motion, shape (k, n)."""
    formulas = [(f"rate of {friction.name}", rate_of(friction)) for friction in mechanism.frictions]
    if not formulas or not len(motion.times):
        return np.zeros((len(motion.times), len(formulas)))
    side = compile_side(mechanism, motion.compiled, "sliding", "Rates of dry friction", formulas)
    return motion.observed(side.function, len(formulas))


def resting(rates: Array, scales: Array) -> NDArray[np.bool_]:
    """Return where coordinates of a reference rest at an output and at both beside it."""
    rests = np.abs(rates) <= RESTS * scales
    ends = np.zeros((1, rates.shape[1]), dtype=np.bool_)
    inside: NDArray[np.bool_] = rests & np.vstack([ends, rests[:-1]]) & np.vstack([rests[1:], ends])
    return inside


@dataclass(frozen=True)
class Contact:
    """Measures of a run with dry friction or stops.

    Attributes
    ----------
    transitions, impacts : int
        Changes of modes, and impacts; a smooth law has no modes.
    dissipated : float or None
        Energy that friction and impacts have taken [J]; None without outputs.
    """

    transitions: int
    impacts: int
    dissipated: float | None


def contact_of(mechanism: Mechanism, outcome: Outcome) -> Contact | None:
    """Return these measures of a run of a comparison; None where its mechanism has no law and no stop."""
    loss = next((output.value for output in mechanism.outputs if output.name == LOSS), None)
    if loss is None:
        return None
    names = list(_names_of_modes(outcome))
    impacts, dissipated = sum(name.endswith(f".{HIT}") for name in names), None
    if len(outcome.times):
        side = compile_side(mechanism, outcome.compiled, "losses", "Energy lost", [(LOSS, loss)])
        dissipated = float(outcome.observed(side.function, 1)[-1, 0])
    return Contact(len(names) - impacts, impacts, dissipated)


def _names_of_modes(outcome: Outcome) -> Iterator[str]:
    return (event.name for event in outcome.happened if event.action == MODE)
