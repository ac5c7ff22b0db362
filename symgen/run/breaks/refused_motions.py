"""Formulas of rows, drivers and couplings with jumps in value or rate: these take an impulse that no method computes.

A formula may jump where conditions, signs, minima, maxima and absolute values change, and at the cut of `atan2`, but
need not: a ramp may end smoothly. So the formula is evaluated on both sides. Terms of time alone are examined before a
run, all others by `symgen.run.single.row_jumps` where a run passes such a place.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping
from functools import partial
from itertools import pairwise

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import names_in_expression
from symgen.describe.facts.kinks import ChangingRow, kink_expressions, rows_with_kinks
from symgen.describe.formulas.evaluate import parameter_values
from symgen.describe.mechanism import Mechanism
from symgen.describe.parts.driven_mechanism import Jump
from symgen.describe.remembered import compute_once
from symgen.run.breaks.in_time import InTime

#: Distance of evaluations, as a part of the run, and at most of the time to the next change; and the factor by which a
#: second one is nearer: differences that stay are jumps, those that shrink are curvature.
NEAR, _APART, _NEARER = 1e-5, 0.125, 16.0
#: Largest negligible jump of a value, as a part of its range, and of a rate, as a part of the speeds on both sides; and
#: relative rounding error of differences, in units of the last digit.
_SMALL, _ROUNDING = 1e-6, 64.0 * sys.float_info.epsilon
#: Part of a jump by which it may differ from that at the larger distance.
_STAYS = 0.2


def refuse_jumps(mechanism: Mechanism, parameters: Mapping[str, float], until: float) -> None:
    """Refuse rows, drivers and couplings whose terms of time jump within a run.

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
        With the formula, and time and size of the jump of its value or rate.
    """
    if (
        _rows_that_jump(mechanism)
        and (refusal := jump_of_motion(mechanism, parameter_values(mechanism, parameters), until)) is not None
    ):
        raise refusal


def motion_names(mechanism: Mechanism) -> frozenset[str]:
    """Return the names in the terms of time that may jump."""
    return frozenset(name for row, _ in _rows_that_jump(mechanism) for name in names_in_expression(row.motion))


def jump_of_motion(mechanism: Mechanism, values: Mapping[str, float], until: float) -> InputError | None:
    """Return the error for the first jump of a term of time within a run, with its time and size, or None.

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
    for row, changes in _rows_that_jump(mechanism):
        crossings = set[float]()
        for change in changes:
            try:
                crossings.update(formulas.crossings(change, until))
            except InputError:  # more often than can be separated
                continue
        times = [0.0, *sorted(t for t in crossings if 1e-9 * until < t < (1.0 - 1e-9) * until), until]
        for (before, t), (_, after) in zip(pairwise(times), pairwise(times[1:]), strict=False):
            h = min(NEAR * until, _APART * (t - before), _APART * (after - t))
            kind, size = jump_at_time(partial(formulas.value_at, row.motion), t, h, (0.0, until), row.is_speed)
            if kind:
                return InputError(
                    f"{mechanism.name}: {row.key}",
                    "a motion whose value and rate do not jump",
                    f"a {kind} that jumps by {size:.6g} {row.unit if kind == 'value' else f'{row.unit}/s'} "
                    f"at t = {t:.6g} s",
                    "it would take an impulse; a ramp such as a cubic table takes forces",
                )
    return None


def jump_at_time(
    f: Callable[[float], float],
    t: float,
    h: float,
    extent: tuple[float, float],
    value_alone: bool = False,
    scales: tuple[float, float] = (0.0, 0.0),
) -> tuple[str, float]:
    """Return kind and size of the jump of a function's value or slope at a time; an empty kind without a jump.

    Parameters
    ----------
    f : callable
        The function.
    t, h : float
        The time, and the larger distance of evaluations from it [s].
    extent : pair of float
        Begin and end of the range by whose values and slopes changes are judged negligible [s].
    value_alone : bool
        Whether the slope may jump.
    scales : pair of float
        Further values and slopes of which negligible jumps are a part.
    """
    h /= _NEARER
    (value, slope, speed), (far_value, far_slope, _) = (
        _differences_of_sides(f, t, h),
        _differences_of_sides(f, t, _NEARER * h),
    )
    for kind, near, far in (("value", value, far_value), ("rate", slope, far_slope))[: 1 if value_alone else 2]:
        if near != 0.0 and abs(near - far) <= _STAYS * abs(near):
            begin, end = extent
            samples = [x for i in range(33) if math.isfinite(x := f(begin + (end - begin) * i / 32))]
            spread = max(samples, default=0.0) - min(samples, default=0.0)
            rounding = _ROUNDING * max(scales[0], *map(abs, samples), 0.0)
            small, size = (rounding, spread) if kind == "value" else (rounding / h, max(speed, spread / (end - begin)))
            if abs(near) > max(small, _SMALL * max(size, scales[kind == "rate"])):
                return kind, near
    return "", 0.0


def _differences_of_sides(f: Callable[[float], float], t: float, h: float) -> tuple[float, float, float]:
    """Return the differences of value and slope between both sides of a time, by parabolas, and the larger slope."""
    ends = list[tuple[float, float]]()
    for way in (-h, h):
        a, b, c = (f(t + k * way) for k in (1, 2, 3))
        ends.append((3.0 * a - 3.0 * b + c, (-2.5 * a + 4.0 * b - 1.5 * c) / way))
    (value, slope), (other, further) = ends
    return other - value, further - slope, max(abs(slope), abs(further))


@compute_once
def _rows_that_jump(mechanism: Mechanism) -> tuple[tuple[ChangingRow, tuple[Jump, ...]], ...]:
    """Return rows whose terms of time may jump, with the changes of these."""
    rows = (
        (row, [e for e in kink_expressions(row.motion) if "t" in set(names_in_expression(e))])
        for row in rows_with_kinks(mechanism)
    )
    return tuple((row, tuple(map(Jump, changes))) for row, changes in rows if changes)
