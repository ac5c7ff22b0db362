"""Motions of drivers with jumps in value or rate, which would take an impulse that no method computes.

A formula of time may jump where conditions, signs, minima, maxima and absolute values change, but need not: a ramp may
end smoothly. So the formula is evaluated on both sides of these times.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping
from functools import partial
from itertools import pairwise

from symgen.describe.evaluate import parameter_values
from symgen.describe.inputs import Jump
from symgen.describe.kinks import changes_of
from symgen.describe.mechanism import Mechanism
from symgen.describe.remembered import remembered
from symgen.errors import InputError
from symgen.runtime.in_time import InTime
from symgen.vocabulary.expressions import Expr, names
from symgen.vocabulary.measures import Holonomic

#: Distance of evaluations, as a part of the run, and at most of the time to the next change; and the factor by which a
#: second one is nearer: differences that stay are jumps, those that shrink are curvature.
_NEAR, _APART, _NEARER = 1e-5, 0.125, 16.0
#: Largest negligible jump of a value, as a part of its range, and of a rate, as a part of the speeds on both sides; and
#: relative rounding error of differences, in units of the last digit.
_SMALL, _ROUNDING = 1e-6, 64.0 * sys.float_info.epsilon
#: Part of a jump by which it may differ from that at the larger distance.
_STAYS = 0.2


def refuse_jumps(mechanism: Mechanism, parameters: Mapping[str, float], until: float) -> None:
    """Refuse motions of drivers that jump within a run.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    parameters : mapping of str to float
        Values of parameters that differ from the described ones.
    until : float
        End of the run [s].

    Raises
    ------
    InputError
        With the driver, and time and size of the jump of its value or rate.
    """
    if (
        _moved(mechanism)
        and (refusal := jump_of(mechanism, parameter_values(mechanism, parameters), until)) is not None
    ):
        raise refusal


def names_of_motions(mechanism: Mechanism) -> frozenset[str]:
    """Return the names in the formulas of drivers that may jump."""
    return frozenset(name for *_, formula, _ in _moved(mechanism) for name in names(formula))


def jump_of(mechanism: Mechanism, values: Mapping[str, float], until: float) -> InputError | None:
    """Return the error for the first jump of a driver within a run, with its time and size, or None.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    values : mapping of str to float
        Values of all parameters that these motions read.
    until : float
        End of the run [s].
    """
    formulas = InTime(mechanism, values)
    for joint, unit, formula, changes in _moved(mechanism):
        crossings = set[float]()
        for change in changes:
            try:
                crossings.update(formulas.crossings(change, until))
            except InputError:  # more often than can be separated
                continue
        times = [0.0, *sorted(t for t in crossings if 1e-9 * until < t < (1.0 - 1e-9) * until), until]
        for (before, t), (_, after) in zip(pairwise(times), pairwise(times[1:]), strict=False):
            h = min(_NEAR * until, _APART * (t - before), _APART * (after - t))
            kind, size = _jump(partial(formulas.at, formula), t, h, until)
            if kind:
                return InputError(
                    f"{mechanism.name}: joints.{joint}.value",
                    "a motion whose value and rate do not jump",
                    f"a {kind} that jumps by {size:.6g} {unit if kind == 'value' else f'{unit}/s'} at t = {t:.6g} s",
                    "it would take an impulse; a ramp such as a cubic table takes forces",
                )
    return None


def _jump(f: Callable[[float], float], t: float, h: float, until: float) -> tuple[str, float]:
    """Return kind and size of the jump of a function's value or slope at a time; an empty kind without a jump."""
    h /= _NEARER
    (value, slope, speed), (far_value, far_slope, _) = _sides(f, t, h), _sides(f, t, _NEARER * h)
    for kind, near, far in (("value", value, far_value), ("rate", slope, far_slope)):
        if near != 0.0 and abs(near - far) <= _STAYS * abs(near):
            samples = [x for i in range(33) if math.isfinite(x := f(until * i / 32))]
            extent = max(samples, default=0.0) - min(samples, default=0.0)
            rounding = _ROUNDING * max(map(abs, samples), default=0.0)
            small, size = (rounding, extent) if kind == "value" else (rounding / h, max(speed, extent / until))
            if abs(near) > max(small, _SMALL * size):
                return kind, near
    return "", 0.0


def _sides(f: Callable[[float], float], t: float, h: float) -> tuple[float, float, float]:
    """Return the differences of value and slope between both sides of a time, by parabolas, and the larger slope."""
    ends = list[tuple[float, float]]()
    for way in (-h, h):
        a, b, c = (f(t + k * way) for k in (1, 2, 3))
        ends.append((3.0 * a - 3.0 * b + c, (-2.5 * a + 4.0 * b - 1.5 * c) / way))
    (value, slope), (other, further) = ends
    return other - value, further - slope, max(abs(slope), abs(further))


@remembered
def _moved(mechanism: Mechanism) -> tuple[tuple[str, str, Expr, tuple[Jump, ...]], ...]:
    """Return drivers whose formulas may jump: name, unit, formula, and its changes."""
    drivers = list[tuple[str, str, Expr, tuple[Jump, ...]]]()
    for joint in mechanism.joints:
        row = joint.rows[0] if joint.kind in ("driver", "coupling") and joint.rows else None
        if isinstance(row, Holonomic) and (changes := changes_of(row.value)):
            drivers.append((joint.name, row.unit, row.value, changes))
    return tuple(drivers)
