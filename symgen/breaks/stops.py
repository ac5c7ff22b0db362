"""Stops of a run: foreseen times at which inputs and formulas jump or have kinks, and the values of inputs behind them.

A run ends a step at each of these times and takes the values behind it before the next step, so that no step or stage
sees both sides of a jump. An error estimate notices a jump only where stages of a step lie on both sides of it: a push
shorter than a step may lie between two stages.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from typing import Any

from symgen.base.errors import InputError
from symgen.breaks.in_time import MOST_PIECES, InTime, line_of
from symgen.describe.evaluate import parameter_values
from symgen.describe.inputs import DrivenMechanism, Jump
from symgen.describe.kinks import jumps_in_time
from symgen.describe.mechanism import Event, Mechanism
from symgen.describe.remembered import remembered
from symgen.loops.run_spec import Stop
from symgen.vocabulary.expressions import names_in

#: Jumps closer than this fraction of the run are one.
SAME = 1e-14
#: Distance from a jump at which a step ends and another begins, as a fraction of the run.
_BESIDE = 1e-12


def stops_of(
    driven: DrivenMechanism, values: Mapping[str, float], until: float, first: float = 0.0, behind: float = 0.0
) -> tuple[Stop, ...]:
    """Return the stops of a motion from `first` to `until`, empty without jumps.

    Parameters
    ----------
    driven : DrivenMechanism
        Mechanism and its inputs.
    values : mapping of str to float
        Of all parameters.
    until, first : float
        End of the run, and its beginning [s].
    behind : float
        Range behind the end, as a fraction of it, that is searched for jumps as well: data need not reach there.

    Raises
    ------
    InputError
        If there are too many, or smooth data end before the run does.
    """
    formulas = InTime(driven.mechanism, values)
    for name, data in driven.curves.items():
        if data.t[0] > first or data.t[-1] < until:
            got = f"those from {data.t[0]:g} to {data.t[-1]:g} s"
            raise InputError(f"input '{name}'", f"data from {first:g} to {until:g} s, as curves end where they do", got)

    until *= 1.0 + behind
    jumps = {t for data in driven.samples.values() for t in data.t}
    for jump in driven.jumps:
        jumps.update(formulas.crossings(jump, until, first))
    times = [first]
    for t in sorted(jumps):
        if t - times[-1] > SAME * until and until - t > SAME * until:
            times.append(t)
    if len(times) > MOST_PIECES:
        raise InputError("inputs", f"at most {MOST_PIECES} jumps", f"{len(times) - 1}")
    switches = [jump for jump in driven.jumps if jump.switch]
    if not (switches or driven.samples or len(times) > 1):
        return ()
    result, before = list[Stop](), dict[str, float]()
    for begin, end in pairwise([*times, until]):
        middle = 0.5 * (begin + end)
        now = {name: data.at(middle) for name, data in driven.samples.items()}
        now |= {jump.switch: 0.0 if math.isnan(x := formulas.at(jump.value, middle)) else x for jump in switches}
        result.append(Stop(begin, {name: x for name, x in now.items() if before.get(name) != x}))
        before = now
    return tuple(result)


def merged(stops: tuple[Stop, ...], kinks: tuple[Stop, ...]) -> tuple[Stop, ...]:
    """Return stops with changes of numbers and stops without in one sequence, one of each two at the same time."""
    if not (stops and kinks):
        return stops or kinks
    result, apart = list[Stop](), SAME * kinks[-1].t
    for stop in sorted([*stops, *kinks], key=lambda stop: stop.t):
        if result and stop.t - result[-1].t <= apart:  # one of the two changes no number
            result[-1] = Stop(result[-1].t, {**result[-1].values, **stop.values})
        else:
            result.append(stop)
    return tuple(result)


def beside(stops: tuple[Stop, ...], times: Sequence[float], until: float) -> tuple[Stop, ...]:
    """Return stops on both sides of some times, in place of stops at these without changes of numbers."""
    apart, result = _BESIDE * until, list[Stop]()
    for stop in stops:
        if stop.values or stop.t == 0.0 or not any(abs(stop.t - t) < apart for t in times):
            result.append(stop)
        else:
            result += [Stop(t, {}) for t in (stop.t - apart, stop.t + apart) if 0.0 < t < until]
    return tuple(result)


@dataclass(frozen=True)
class Foreseen:
    """Foreseen discontinuities of the formulas of a mechanism; false without any.

    Their times depend on parameters: the latest result is remembered.

    Attributes
    ----------
    mechanism : Mechanism
        Owner of the tables that formulas may read.
    kinks, sides : tuple of Jump
        From `symgen.describe.kinks.jumps_in_time`.
    latest : dict
        The latest result, by the values on which it depends.
    """

    mechanism: Mechanism
    kinks: tuple[Jump, ...] = ()
    sides: tuple[Jump, ...] = ()
    latest: dict[tuple[float, ...], tuple[tuple[Stop, ...], bool]] = field(
        default_factory=dict, repr=False, compare=False
    )

    def __bool__(self) -> bool:
        """Whether formulas have such discontinuities."""
        return bool(self.kinks or self.sides)

    @cached_property
    def reads(self) -> frozenset[str]:
        """Names on which the times depend: parameters, and t."""
        return frozenset(name for jump in (*self.kinks, *self.sides) for name in names_in(jump.argument))

    def stops(self, values: Mapping[str, float], until: float) -> tuple[Stop, ...]:
        """Return the stops of a run to `until` [s], at which no number changes; empty for a run in one piece.

        Parameters
        ----------
        values : mapping of str to float
            Of all parameters.
        until : float
            End of the run [s].
        """
        return self._stops(values, until)[0]

    def _stops(self, values: Mapping[str, float], until: float) -> tuple[tuple[Stop, ...], bool]:
        """Return the stops, and whether they are complete: too many are left out."""
        if not self:
            return (), True
        key = until, *(values[name] for name in sorted(self.reads & values.keys()))
        result = self.latest.get(key)
        if result is None:  # compared runs, or runs of a sweep, often agree in these values
            kinks, all_kinks = times_between(self.kinks, self.mechanism, values, until)
            sides, all_sides = times_between(self.sides, self.mechanism, values, until)
            # a short part around each: no stage of its neighbours is at the very time, which belongs to one side
            beside = (t + way * _BESIDE * until for t in sides for way in (-1.0, 1.0))
            times = sorted({*kinks, *(t for t in beside if 0.0 < t < until)})
            result = tuple(Stop(t, {}) for t in (0.0, *times)) if times else (), all_kinks and all_sides
            self.latest.clear()  # threads of a sweep do so, too
            self.latest[key] = result
        return result

    def missed(self, values: Mapping[str, float], until: float, step: float | None) -> list[str]:
        """Return the sentence about discontinuities that steps of a run may miss: constant ones miss shorter pieces.

        Parameters
        ----------
        values, until
            As for `stops`.
        step : float or None
            The constant step [s]; None where steps are adaptive.
        """
        if not self._stops(values, until)[1]:
            often = "formulas change, or pass points of tables, more often than can be distinguished"
            return [f"{often}: steps do not end there, and may miss what is short"]
        if step is None:
            return []
        jumps = [*self.sides, *(kink for kink in self.kinks if kink.levels == (0.0,))]  # not points of tables
        times, _ = times_between(jumps, self.mechanism, values, until)
        near = min(pairwise(times), key=lambda pair: pair[1] - pair[0], default=(0.0, step))
        if near[1] - near[0] >= step:
            return []
        what = f"formulas change at t = {near[0]:.9g} and {near[1]:.9g} s, within one step of {step:g} s"
        return [f"{what}: constant steps may miss what lies between; adaptive ones do not"]


def foreseen(mechanism: Mechanism, events: Sequence[Event] = ()) -> Foreseen:
    """Return the foreseen discontinuities of formulas of joints, forces and integrals of a mechanism, and of events.

    Steps find an event that is a straight line in t wherever they end; another one may come and go within a step.
    """
    if not events:
        return Foreseen(mechanism, *_passed(mechanism))
    timely = {p.name for p in mechanism.parameters if not p.input} | {"t"}
    values = parameter_values(mechanism)
    happening = (
        jump
        for jump in (Jump(event.when) for event in events)
        if "t" in (read := {*names_in(jump.argument)}) and read <= timely and line_of(jump, values) is None
    )
    kinks, sides = jumps_in_time(mechanism, events)
    return Foreseen(mechanism, kinks, (*sides, *happening))


@remembered
def _passed(mechanism: Mechanism) -> tuple[tuple[Jump, ...], tuple[Jump, ...], dict[Any, Any]]:
    return *jumps_in_time(mechanism), {}


def times_between(
    jumps: Sequence[Jump], mechanism: Mechanism, values: Mapping[str, float], until: float
) -> tuple[tuple[float, ...], bool]:
    """Return the times inside a run at which formulas pass levels, and whether these are all.

    Parameters
    ----------
    jumps : sequence of Jump
        From `symgen.describe.kinks`. Formulas that pass levels too often to be separated are left out.
    mechanism : Mechanism
        Owner of the tables that they may read.
    values : mapping of str to float
        Of all parameters.
    until : float
        End of the run [s].

    Returns
    -------
    tuple of float
        In order [s]; empty if more than `MOST_PIECES`.
    bool
        Whether nothing was left out.
    """
    formulas, crossings, apart, whole = InTime(mechanism, values), set[float](), SAME * until, True
    for jump in jumps:
        try:
            crossings.update(formulas.crossings(_unrolled(jump, formulas, until), until))
        except InputError:
            whole = False
    times = list[float]()
    for t in sorted(crossings):
        if t - (times[-1] if times else 0.0) > apart and until - t > apart:
            times.append(t)
    return (tuple(times), whole) if len(times) <= MOST_PIECES else ((), False)


def _unrolled(jump: Jump, formulas: InTime, until: float) -> Jump:
    """Return a jump with all periodic levels in the range of its argument in a run.

    Raises
    ------
    InputError
        If the levels are too many.
    """
    if jump.period == 0.0:
        return jump
    low, high = formulas.range(jump, until)
    turns = [(x - jump.levels[0]) / jump.period for x in (low, high)]
    own = jump.levels[:-1]  # the last point is the first one of the next period
    if not (turns[1] - turns[0] + 1.0) * len(own) <= MOST_PIECES:
        raise InputError("formulas", f"at most {MOST_PIECES} points of a table", "more periods of it")
    count = range(math.floor(turns[0]), math.floor(turns[1]) + 1)
    return replace(jump, levels=tuple(x + k * jump.period for k in count for x in own))
