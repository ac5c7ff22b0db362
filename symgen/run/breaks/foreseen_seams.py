"""Seams of a run: foreseen times at which inputs and formulas jump or have kinks, and the values of inputs after them.

A run ends a step at each of these times and takes the values after it before the next step, so that no step or stage
sees both sides of a jump. An error estimate notices a jump only where stages of a step lie on both sides of it: a push
shorter than a step may lie between two stages.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from typing import Any

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import names_in_expression
from symgen.describe.facts.kinks import jumps_in_time, jumps_of_gaps
from symgen.describe.formulas.evaluate import parameter_values
from symgen.describe.mechanism import Event, Mechanism
from symgen.describe.parts.driven_mechanism import DrivenMechanism, Jump
from symgen.describe.remembered import compute_once
from symgen.run.breaks.in_time import MOST_PIECES, InTime, line_of_formula, new_search
from symgen.run.loops.run_spec import Seam
from symgen.run.loops.seams import seams_with_room
from symgen.run.loops.times_of_jumps import (
    BESIDE,
    BESIDE_A_SIDE,
    COUNT,
    KINK,
    SAME,
    SEAMS_OF_PASSAGE,
    SEAMS_OF_WINDOW,
    SKIP,
    STRIKE,
    JumpSearch,
    lay_seams,
    note_passage,
)

#: Schemes of a lower order end steps where those of this order do.
LEAST_ORDER = 3


def seams_of_motion(
    driven: DrivenMechanism, values: Mapping[str, float], until: float, first: float = 0.0, beyond: float = 0.0
) -> tuple[Seam, ...]:
    """Return the seams of a motion from `first` to `until`, empty without jumps.

    Parameters
    ----------
    driven : DrivenMechanism
        Mechanism and its inputs.
    values : mapping of str to float
        Of all parameters.
    until, first : float
        End of the run, and its beginning [s].
    beyond : float
        Fraction of the end time by which the search for jumps goes beyond it: data need not reach there.

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

    until *= 1.0 + beyond
    jumps = {t for data in driven.samples.values() for t in data.t}
    for jump in driven.jumps:
        jumps.update(formulas.crossings(jump, until, first))
    times = [first, *_times_in(_passages_of(((t, KINK) for t in jumps), until, first))]
    if len(times) > MOST_PIECES:
        raise InputError("inputs", f"at most {MOST_PIECES} jumps", f"{len(times) - 1}")
    switches = [jump for jump in driven.jumps if jump.switch]
    if not (switches or driven.samples or len(times) > 1):
        return ()
    result, before = list[Seam](), dict[str, float]()
    for begin, end in pairwise([*times, until]):
        middle = 0.5 * (begin + end)
        now = {name: data.at(middle) for name, data in driven.samples.items()}
        now |= {jump.switch: 0.0 if math.isnan(x := formulas.value_at(jump.value, middle)) else x for jump in switches}
        result.append(Seam(begin, {name: x for name, x in now.items() if before.get(name) != x}))
        before = now
    return tuple(result)


def merge_seams(seams: tuple[Seam, ...], kinks: tuple[Seam, ...]) -> tuple[Seam, ...]:
    """Return seams with changes of numbers and seams without in one sequence, one of each two at the same time."""
    if not (seams and kinks):
        return seams or kinks
    apart, times, result = SAME * kinks[-1].t, [kink.t for kink in kinks], list(kinks)
    for seam in seams:
        at = bisect_left(times, seam.t - apart)
        if at < len(times) and times[at] <= seam.t + apart:
            result[at] = replace(result[at], values={**result[at].values, **seam.values})
        else:
            result.append(seam)
    return tuple(sorted(result, key=lambda seam: seam.t))


def with_further_seams(seams: tuple[Seam, ...], times: Sequence[float], until: float) -> tuple[Seam, ...]:
    """Return seams on both sides of some times, in place of seams at these without changes of numbers."""
    apart, result = BESIDE_A_SIDE * until, list[Seam]()
    for seam in seams:
        if seam.values or seam.t == 0.0 or not any(abs(seam.t - t) < apart for t in times):
            result.append(seam)
        else:
            result += [Seam(t, {}) for t in (seam.t - apart, seam.t + apart) if 0.0 < t < until]
    return tuple(result)


@dataclass(frozen=True)
class Foreseen:
    """Foreseen discontinuities of the formulas of a mechanism; false without any.

    Their times depend on parameters: the latest result is remembered. Constant steps go on at the next point of their
    grid: a step up to it follows each discontinuity.

    Attributes
    ----------
    mechanism : Mechanism
        Owner of the tables that formulas may read.
    kinks, sides : tuple of Jump
        From `symgen.describe.facts.kinks.jumps_in_time`.
    gaps : tuple of Jump
        From `symgen.describe.facts.kinks.jumps_of_gaps`: a closed gap gives the bodies on it another velocity there.
    grid : (float, float) or None
        First point and distance of the grid of constant steps [s], 0 for steps without a grid; None where steps vary.
    latest : dict
        The latest result, by the values on which it depends.
    """

    mechanism: Mechanism
    kinks: tuple[Jump, ...] = ()
    sides: tuple[Jump, ...] = ()
    gaps: tuple[Jump, ...] = ()
    grid: tuple[float, float] | None = None
    latest: dict[tuple[float, ...], tuple[tuple[Seam, ...], bool]] = field(
        default_factory=dict, repr=False, compare=False
    )

    def __bool__(self) -> bool:
        """Whether formulas have such discontinuities."""
        return bool(self.kinks or self.sides or self.gaps)

    @cached_property
    def reads(self) -> frozenset[str]:
        """Names on which the times depend: parameters, and t."""
        return frozenset(
            name for jump in (*self.kinks, *self.sides, *self.gaps) for name in names_in_expression(jump.argument)
        )

    @property
    def passing(self) -> tuple[tuple[Jump, int], ...]:
        """The jumps, each with what runs do where it is passed, see `symgen.run.loops.times_of_jumps`."""
        grid = self.grid is not None
        side = SKIP if grid or self.mechanism.bounded else BESIDE  # where modes are chosen anew, no stage is between
        kinds = (self.kinks, KINK + SKIP if grid else KINK), (self.sides, side), (self.gaps, SKIP + STRIKE)
        return tuple((jump, kind) for jumps, kind in kinds for jump in jumps)

    def seams(self, values: Mapping[str, float], until: float) -> tuple[Seam, ...]:
        """Return the seams of a run to `until` [s], at which no number changes; empty for a run in one piece.

        Parameters
        ----------
        values : mapping of str to float
            Of all parameters.
        until : float
            End of the run [s].
        """
        return self._seams_of_numbers(values, until)[0]

    def _seams_of_numbers(self, values: Mapping[str, float], until: float) -> tuple[tuple[Seam, ...], bool]:
        """Return the seams, and whether they are complete: too many are left out."""
        if not self:
            return (), True
        key = until, *(values[name] for name in sorted(self.reads & values.keys()))
        result = self.latest.get(key)
        if result is None:  # compared runs, or runs of a sweep, often agree in these values
            passages, whole = _passages_in(self.passing, self.mechanism, values, until)
            search = _passages_of(passages, until, grid=self.grid)
            count = int(search.found[COUNT])
            result = _laid_out(search, until) if count <= MOST_PIECES else (), whole and count <= MOST_PIECES
            self.latest.clear()  # threads of a sweep do so, too
            self.latest[key] = result
        return result

    def sentence_on_missed_changes(self, values: Mapping[str, float], until: float) -> list[str]:
        """Return the sentence about discontinuities that steps of a run may miss; parameters as for `seams`."""
        if self._seams_of_numbers(values, until)[1]:
            return []
        often = "formulas change, or pass points of tables, more often than can be distinguished"
        return [f"{often}: steps do not end there, and may miss what is short"]


def foresee_by_steps(mechanism: Mechanism, order: int, first: float, step: float | None) -> Foreseen:
    """Return the discontinuities of formulas of joints, forces, integrals and gaps at which constant steps end.

    Where the k-th derivative of a table jumps, a step errs by its power k + 1: below the order of the scheme it counts,
    as the points of linear tables always do.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    order : int
        Order of the scheme.
    first, step : float
        First point and distance of the grid of steps [s].
    """
    kinks, sides, gaps, _ = _passed_times(mechanism)
    kinks = tuple(kink for kink in kinks if kink.derivative + 1 < max(order, LEAST_ORDER))
    return Foreseen(mechanism, kinks, sides, gaps, (first, step or 0.0))


def foresee_in_run(
    mechanism: Mechanism,
    events: Sequence[Event],
    adaptive: bool,
    order: int,
    grid: tuple[float, float | None],
) -> Foreseen:
    """Return the discontinuities at which steps of a run end.

    Parameters
    ----------
    mechanism, events
        The description, and the events of the run.
    adaptive : bool
        Whether steps are adaptive (`foresee_changes`) or constant (`foresee_by_steps`).
    order, grid
        Order of the scheme, first point and distance of the grid of constant steps.
    """
    return foresee_changes(mechanism, events) if adaptive else foresee_by_steps(mechanism, order, *grid)


def foresee_changes(mechanism: Mechanism, events: Sequence[Event] = ()) -> Foreseen:
    """Return the foreseen discontinuities of formulas of joints, forces, integrals and gaps, and of events.

    Steps find an event that is a straight line in t wherever they end; another one may come and go within a step.
    """
    if not events:
        kinks, sides, gaps, latest = _passed_times(mechanism)
        return Foreseen(mechanism, kinks, sides, gaps, latest=latest)
    timely = {p.name for p in mechanism.parameters if not p.input} | {"t"}
    values = parameter_values(mechanism)
    happening = (
        jump
        for jump in (Jump(event.when) for event in events)
        if "t" in (read := {*names_in_expression(jump.argument)})
        and read <= timely
        and line_of_formula(jump, values) is None
    )
    kinks, sides = jumps_in_time(mechanism, events)
    return Foreseen(mechanism, kinks, (*sides, *happening), jumps_of_gaps(mechanism))


@compute_once
def _passed_times(mechanism: Mechanism) -> tuple[tuple[Jump, ...], tuple[Jump, ...], tuple[Jump, ...], dict[Any, Any]]:
    return *jumps_in_time(mechanism), jumps_of_gaps(mechanism), {}


def times_between(
    jumps: Sequence[Jump], mechanism: Mechanism, values: Mapping[str, float], until: float, at_start: bool = False
) -> tuple[tuple[float, ...], bool]:
    """Return the times inside a run at which formulas pass levels, and whether these are all.

    Parameters
    ----------
    jumps : sequence of Jump
        From `symgen.describe.facts.kinks`. Formulas that pass levels too often to be separated are left out.
    mechanism : Mechanism
        Owner of the tables that they may read.
    values : mapping of str to float
        Of all parameters.
    until : float
        End of the run [s].
    at_start : bool
        Whether the start counts, if formulas pass levels there.

    Returns
    -------
    tuple of float
        In order [s]; empty if more than `MOST_PIECES`.
    bool
        Whether nothing was left out.
    """
    passages, whole = _passages_in(((jump, SKIP if at_start else KINK) for jump in jumps), mechanism, values, until)
    times = _times_in(_passages_of(passages, until))
    return (times, whole) if len(times) <= MOST_PIECES else ((), False)


def _passages_in(
    passing: Iterable[tuple[Jump, int]], mechanism: Mechanism, values: Mapping[str, float], until: float
) -> tuple[list[tuple[float, int]], bool]:
    """Return times at which formulas pass levels, each with its kind of passage, and whether the list is complete."""
    formulas, passages, whole = InTime(mechanism, values), list[tuple[float, int]](), True
    for jump, kind in passing:
        try:
            passages += ((t, kind) for t in formulas.crossings(jump, until))
        except InputError:
            whole = False
    return passages, whole


def _passages_of(
    passages: Iterable[tuple[float, int]],
    until: float,
    first: float = 0.0,
    grid: tuple[float, float] | None = (0.0, 0.0),
) -> JumpSearch:
    """Return a search that has found passages: those inside a run, those at the same time as one."""
    inside = sorted((t, kind) for t, kind in passages if until - t > SAME * until)
    search = new_search(None, until, first, grid=grid, room=len(inside))
    for t, kind in inside:
        note_passage(search, t, kind)
    return search


def _times_in(search: JumpSearch) -> tuple[float, ...]:
    """Return the times that a search has found [s]."""
    return tuple(search.moments[: search.found[COUNT]].tolist())


def _laid_out(search: JumpSearch, until: float) -> tuple[Seam, ...]:
    """Return the seams of a run at the passages that a search has found; none without any."""
    if search.found[COUNT] == 0:
        return ()
    most = SEAMS_OF_PASSAGE * int(search.found[COUNT]) + SEAMS_OF_WINDOW
    seams = seams_with_room(most, search.end >= 0)
    lay_seams(search, seams, until)
    times, skips = (x[: seams.rows[1]].tolist() for x in (seams.times, seams.skips))
    return tuple(Seam(t, {}, how > 0, how == 2) for t, how in zip(times, skips, strict=True) if t < until)
