"""Formulas of time: their values, and the times at which they pass a level."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property, partial
from itertools import pairwise

import numpy as np

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import ONE, ZERO, Call, Expr, Name, call, names_in_expression
from symgen.compile.loopcode.loop_instances import Meanings, compiled_loop
from symgen.compile.native.annotations import signature_from
from symgen.compile.native.compiler import is_interpreted
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.mechanism import Mechanism
from symgen.describe.parts.driven_mechanism import Jump, compared_with_zero
from symgen.describe.remembered import compute_once
from symgen.describe.table_functions import Table
from symgen.run.breaks.coded_formulas import CodedFormula, Formula, code_formula, coded_at
from symgen.run.loops.times_of_jumps import (
    BESIDE_A_SIDE,
    COUNT,
    FROM,
    LEFT_OUT,
    MOST_PASSAGES,
    MOST_SAMPLES,
    NEXT_TO,
    SAME,
    SKIP,
    TO,
    TOO_MANY,
    JumpSearch,
    levels_below,
    note_line,
    search_curve,
)

#: Functions that are constant wherever what they compare does not pass.
CONDITIONS = ("lt", "le", "gt", "ge", "sign")
#: Most pieces of a run.
MOST_PIECES = MOST_PASSAGES


def new_search(
    jump: Jump | None,
    until: float,
    first: float = 0.0,
    shortest: float = math.inf,
    grid: tuple[float, float] | None = (0.0, 0.0),
    room: int = MOST_PASSAGES + 1,
) -> JumpSearch:
    """Return a search for passages.

    Parameters
    ----------
    jump : Jump, optional
        The formula; none where times are known.
    until, first : float
        End and begin [s].
    shortest : float
        Largest distance of samples [s].
    grid : (float, float), optional
        First point and distance of the grid of constant steps [s], 0 for steps without a grid. None where steps vary:
        then no passage at the start counts.
    room : int
        Room for passages; a search with room for all of them keeps its samples, too.
    """
    levels, period = ((), 0.0) if jump is None else (jump.levels, jump.period)
    origin, step = grid or (0.0, 0.0)
    return JumpSearch(
        *(float(until), shortest, origin, step, SAME, BESIDE_A_SIDE, NEXT_TO, -1 if grid is not None else 0),
        kinds=np.array([SKIP]),
        first=np.array([0, len(levels)]),
        levels=np.sort(np.array(levels, dtype=np.float64)),
        periods=np.array([float(period)]),
        ends=np.array([float(until)]),
        known=np.array([float(until), float(first)]),
        moments=np.empty(room),
        samples=np.empty(MOST_SAMPLES + 2 if room > MOST_PASSAGES else 0),
        flags=np.empty(room, dtype=np.int64),
        found=np.zeros(4, dtype=np.int64),
    )


def _search(f: JumpSearch, state: Formula) -> int:
    """JumpSearch for the passages of a formula that is no straight line; return their number."""
    search_curve(f, state, 0, f.known[FROM], f.known[TO])
    return int(f.found[COUNT])


def _plain_at(f: JumpSearch, state: Callable[[float], float], j: int, t: float) -> float:
    """Return the value of a formula where nothing is compiled, by a function of the time."""
    return float(state(t))


_CODED = Meanings("searches before a run", formula_at=_plain_at if is_interpreted() else coded_at)
_search_loop = compiled_loop(__name__, "_search_loop", _search, signature_from(_search), contracted=False, **_CODED)


@dataclass(frozen=True)
class Passing:
    """A formula and its latest passages: runs whose values agree in what it reads have the same.

    Attributes
    ----------
    jump : Jump
        The formula and its levels.
    tables : dict of str to Table
        Tables that it may read.
    latest : dict
        The latest times, by what they depend on.
    """

    jump: Jump
    tables: Mapping[str, Table]
    latest: dict[tuple[float, ...], tuple[tuple[float, ...], int]] = field(default_factory=dict)

    @cached_property
    def reads(self) -> tuple[str, ...]:
        """Names of the values that the formula reads, apart from the time."""
        return tuple(sorted({*names_in_expression(self.jump.argument)} - {"t"}))

    @cached_property
    def line(self) -> tuple[Expr, Expr] | None:
        """From `slope_and_offset`."""
        return slope_and_offset(self.jump.argument)

    @cached_property
    def conditions(self) -> tuple[Jump, ...] | None:
        """Comparisons of a formula that reads the time nowhere else, so that its value is constant between them."""
        found = dict[Jump, None]()
        return tuple(found) if _reads_in_conditions(self.jump.argument, found) else None

    @cached_property
    def codes(self) -> CodedFormula:
        """The formula as codes."""
        return code_formula(self.jump.argument, self.tables)

    def times(self, formulas: InTime, until: float, first: float) -> tuple[float, ...]:
        """Return the times from `first` to `until` [s] at which the formula passes its levels.

        Raises
        ------
        InputError
            If it passes them too often, or too often to separate the times.
        """
        key = until, first, formulas.shortest, *(formulas.values[name] for name in self.reads)
        found = self.latest.get(key)
        if found is None:
            found = self._found(formulas, until, first)
            self.latest.clear()  # threads do so, too
            self.latest[key] = found
        times, left_out = found
        if left_out:
            got = "a formula that changes sides more often" + (
                "" if left_out == TOO_MANY else " than can be distinguished"
            )
            raise InputError("inputs", f"at most {MOST_PIECES} jumps", got)
        return times

    def _found(self, formulas: InTime, until: float, first: float) -> tuple[tuple[float, ...], int]:
        line = _value_and_slope(self.line, formulas.values)
        if not self.jump.levels:
            return (), 0
        if line is None and self.conditions is not None:
            return self._between_conditions(formulas, until, first), 0
        room = len(self.jump.levels) if line is not None and self.jump.period == 0.0 else MOST_PASSAGES + 1
        f = new_search(self.jump, until, first, formulas.shortest, room=room)
        if line is not None:
            note_line(f, 0, *line, first, until)
        elif is_interpreted():
            _search_loop(f, partial(formulas.value_at, self.jump.argument))
        else:
            _search_loop(f, self.codes.of(formulas.values))
        return tuple(f.moments[: f.found[COUNT]].tolist()), int(f.found[LEFT_OUT])

    def _between_conditions(self, formulas: InTime, until: float, first: float) -> tuple[float, ...]:
        """Return when a formula passes a level that is constant as long as its conditions are."""
        times = sorted({t for jump in self.conditions or () for t in formulas.crossings(jump, until, first)})
        looks, f = (0.5 * (a + b) for a, b in pairwise((first, *times, until))), new_search(self.jump, until, room=0)
        sides = [levels_below(f, 0, formulas.value_at(self.jump.argument, t)) for t in looks]
        return tuple(t for t, (before, after) in zip(times, pairwise(sides), strict=True) if before != after)


def _reads_in_conditions(e: Expr, found: dict[Jump, None]) -> bool:
    """Whether a formula reads the time in nothing but comparisons, which are put into `found`."""
    if not isinstance(e, Call):
        return not (isinstance(e, Name) and e.name == "t")
    if e.function in CONDITIONS:
        if "t" in set(names_in_expression(e)):
            found[Jump(compared_with_zero(e))] = None
        return True
    return all(_reads_in_conditions(a, found) for a in e.arguments)


class InTime:
    """Values of formulas of parameters and t at given times.

    Parameters
    ----------
    mechanism : Mechanism
        Source of the tables that they may read, and of the largest step, which bounds the distance of samples.
    values : mapping of str to float
        Values of the parameters.
    """

    def __init__(self, mechanism: Mechanism, values: Mapping[str, float]) -> None:
        self._mechanism, self._tables = mechanism, {table.name: table for table in mechanism.tables}
        self.values, self.shortest = dict(values), mechanism.defaults.max_step or math.inf

    def value_at(self, e: Expr, t: float) -> float:
        """Return the value of a formula at a time [s], or nan if it is undefined."""
        self.values["t"] = t
        try:
            return evaluate_formula(e, self.values, tables=self._tables)
        except InputError:  # no comparison with it holds
            return math.nan

    def crossings(self, jump: Jump, until: float, first: float = 0.0) -> tuple[float, ...]:
        """Return the times from `first` to `until` [s] at which a jump's argument passes its levels.

        Raises
        ------
        InputError
            If it passes them too often, or too often to separate the times.
        """
        known = _passings(self._mechanism)
        passing = known.get(jump)
        if passing is None:
            passing = known[jump] = Passing(jump, self._tables)
        return passing.times(self, until, first)


@compute_once
def _passings(mechanism: Mechanism) -> dict[Jump, Passing]:
    """Return an empty table of the passages known for each jump of a mechanism."""
    return {}


def line_of_formula(jump: Jump, values: Mapping[str, float]) -> tuple[float, float] | None:
    """Return value at 0 and slope of a jump's argument if it is a straight line over time, else None."""
    return _value_and_slope(slope_and_offset(jump.argument), values)


def _value_and_slope(parts: tuple[Expr, Expr] | None, values: Mapping[str, float]) -> tuple[float, float] | None:
    try:
        return None if parts is None else (evaluate_formula(parts[0], values), evaluate_formula(parts[1], values))
    except InputError:
        return None


def slope_and_offset(e: Expr) -> tuple[Expr, Expr] | None:
    """Return the formulas of the value at 0 and of the slope of a straight line over time; None for another formula."""
    if isinstance(e, Name) and e.name == "t":
        return ZERO, ONE
    if "t" not in set(names_in_expression(e)):
        return e, ZERO
    assert isinstance(e, Call), "a name or a number has no other names in it"
    parts = [slope_and_offset(a) for a in e.arguments]
    if any(part is None for part in parts) or e.function not in ("add", "sub", "neg", "mul", "div"):
        return None
    (a, m), *others = [part for part in parts if part is not None]
    if e.function == "neg":
        return call("neg", a), call("neg", m)
    ((b, n),) = others
    if e.function in ("add", "sub"):
        return _sum_of_lines(e.function, a, b), _sum_of_lines(e.function, m, n)
    if e.function == "div":
        return (call("div", a, b), call("div", m, b)) if n == ZERO else None
    if ZERO not in (m, n):
        return None
    return call("mul", a, b), call("mul", a, n) if m == ZERO else call("mul", m, b)


def _sum_of_lines(function: str, a: Expr, b: Expr) -> Expr:
    if b == ZERO:
        return a
    return call(function, a, b) if a != ZERO else b if function == "add" else call("neg", b)
