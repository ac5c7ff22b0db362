"""Remarks on an answer: bounds that it meets, what it no longer passes, and aims that were met in another way."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from symgen.analyses.search.sampled_motions import Aim, Sampled, mean_weights
from symgen.base.errors import enumeration
from symgen.base.vocabulary.expressions import ZERO, Call, Expr
from symgen.base.vocabulary.measures import GROUND
from symgen.describe.facts.kinks import discontinuities_of
from symgen.describe.facts.lifted import literal_points_in_words
from symgen.describe.facts.pins import PinPlaces
from symgen.describe.formulas.formula_text import to_text
from symgen.describe.formulas.readings import OUTPUT, readings_of_joint
from symgen.describe.mechanism import Mechanism
from symgen.study.design.problem import QuantityReader, Varied

#: Angles of drivers that end as near as this to a turn have made one [rad].
TURNED = 1e-6
#: Half a unit of the last digit that is printed of a number, in parts of it.
PRINTED = 5e-7


class WatchedQuantities:
    """Quantities of a motion that remarks are about, beside the ones of the aim and the limits.

    Parameters
    ----------
    reader : QuantityReader
        Reads them.
    """

    def __init__(self, reader: QuantityReader) -> None:
        mechanism = reader.mechanism
        self.kinks = [
            reader.formula(_text_of_kink(x.argument), x.argument, "")
            for x in discontinuities_of(mechanism)
            if x.table is None and not x.jumps
        ]
        self.drivers = [*_angles_of_drivers(mechanism, reader)]
        self._reader = reader

    def remarks(self, before: Sampled, after: Sampled) -> Iterator[str]:
        """Yield what happens no longer, and which drivers turn by less than a turn."""
        for place in self.kinks:
            first, last = before.values[:, place], after.values[:, place]
            if first.min() < 0.0 < first.max() and not last.min() < 0.0 < last.max():
                where = f"where {self._reader.quantities[place].text} = 0"
                yield f"the motion no longer passes a kink of the file, {where}: it does other work than before"
        for name, place in self.drivers:
            angle = after.values[:, place]
            steps = np.diff(angle)
            turn = abs(float(angle[-1] - angle[0]))
            if (np.all(steps > 0.0) or np.all(steps < 0.0)) and turn < 2.0 * np.pi - TURNED:
                made = f"{name} makes {turn / (2.0 * np.pi):.3g} turns until {after.times[-1]:g} s"
                yield f"{made}: loads of the rest of a turn do not count"


def _text_of_kink(argument: Expr) -> str:
    """Return what is 0 at a kink: of ``0 - x``, x."""
    if isinstance(argument, Call) and argument.function == "sub" and argument.arguments[0] == ZERO:
        argument = argument.arguments[1]
    return to_text(argument)


def _angles_of_drivers(mechanism: Mechanism, reader: QuantityReader) -> Iterator[tuple[str, int]]:
    for joint in mechanism.joints:
        if joint.kind == "driver":
            for label, (reading, unit) in readings_of_joint(joint, OUTPUT).items():
                if unit == "rad" and not label.endswith("rate"):
                    yield joint.name, reader.formula(f"{joint.name}.{label}", reading, unit)


def remarks_on_values(varied: Varied, values: np.ndarray, after: Sampled) -> Iterator[str]:
    """Yield which bounds are met, which numbers change nothing, and which points move alone."""
    for side, ends in (("lower", varied.low), ("upper", varied.high)):
        if met := [name for name, is_met in zip(varied.names, _meets(varied, values, ends), strict=True) if is_met]:
            verb, bound = ("meets its", "bound") if len(met) == 1 else ("meet their", "bounds")
            yield f"{enumeration(met)} {verb} {side} {bound}: a wider range may give more"
    still = [name for i, name in enumerate(varied.names) if not after.slopes[:, :, i].any()]
    if still:
        yield f"{enumeration(still)} {'changes' if len(still) == 1 else 'change'} neither the aim nor a limit"
    yield from literal_points_in_words(varied.names)
    if varied.pins:
        yield _sentence_on_pins(varied.pins)


def _meets(varied: Varied, values: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """Return which numbers meet a bound."""
    return np.asarray(np.abs(values - ends) <= 1e-9 * (varied.high - varied.low))


def _sentence_on_pins(pins: PinPlaces) -> str:
    """Return what pins move, and what stays."""
    bodies = dict.fromkeys(spot.body for own in pins.spots.values() for spot in own if spot.body != GROUND)
    centres = dict.fromkeys(str(each.path[1]) for each in pins.moved if each.path[2] == "centre_of_mass")
    names, verb = enumeration([*pins.keys]), "moves" if len(pins.keys) == 1 else "move"
    what = f"points of {enumeration([*bodies])}"
    if centres:
        noun = "centre" if len(centres) == 1 else "centres"
        what += f", and the {noun} of mass of {enumeration([*centres])} in the middle of them"
    return f"{names} {verb} {what}: mass and inertia stay"


def remarks_on_means(varied: Varied, aim: Aim, values: np.ndarray, after: Sampled) -> Iterator[str]:
    """Yield how far numbers are known whose aim is a mean, where half of the times give others."""
    free = np.flatnonzero(~_meets(varied, values, varied.low) & ~_meets(varied, values, varied.high))
    (size, slope), (half, other) = (after.mean_square(aim.quantity, every) for every in (1, 2))
    dy = after.slopes[after.even][:, aim.quantity, free]
    curvature = dy.T @ (mean_weights(len(dy))[:, np.newaxis] * dy)
    # the step of least squares from where the slopes of one mean vanish to where those of the other do
    steps = np.linalg.pinv(curvature, hermitian=True) @ (size * slope - half * other)[free]
    for i, step in zip(free, np.abs(steps * (varied.high - varied.low)[free]), strict=True):
        if step > PRINTED * abs(values[i]):
            unit = f" {varied.units[i]}".rstrip()
            yield f"{varied.names[i]} is known to {step:.1g}{unit}, as its mean over {len(dy)} times is no better"


def remark_on_sign(aim: Aim, after: Sampled) -> Iterator[str]:
    """Yield that the largest value of a quantity is not its largest size."""
    y = after.values[:, aim.quantity]
    if aim.taken.word == "max" and -y.min() > y.max():
        quantity, unit = aim.taken.quantity, f" {aim.unit}".rstrip()
        low, high = f"{y.min():.4g}{unit}", f"{y.max():.4g}{unit}"
        yield f"{quantity} goes down to {low}, beyond its largest value of {high}: peak({quantity}) counts both signs"


def sentence_on_limits(missed: Sequence[tuple[str, str]]) -> str:
    """Return that limits cannot be kept together, or that one cannot, and by how much at the best."""
    parts = [f"{text} is missed by {amount}" for text, amount in missed]
    if len(parts) == 1:
        return f"no candidate keeps all limits: at the best {parts[0]}"
    return f"limits contradict each other: at the best {enumeration(parts)}"
