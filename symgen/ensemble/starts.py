"""Parameters and described starts of many runs at once, evaluated as arrays.

What is undefined for some values (a division by 0, the root of a negative number) is nan there, and only those runs
fail.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.describe.derived import derived
from symgen.describe.mechanism import Mechanism
from symgen.describe.start import described_start
from symgen.vocabulary.expressions import FUNCTIONS, Expr, Name, Number, Reading

if TYPE_CHECKING:
    from symgen.runtime.pieces import Piece

Array = NDArray[np.float64]

#: Functions that operators of arrays work out for all runs at once; the others are called for each.
_OPERATORS = ("add", "sub", "mul", "div", "neg")


@dataclass(frozen=True)
class Columns:
    """The numbers of many runs (`symgen.describe.numbers.Numbers`), by the functions that one run's are worked out by.

    What is undefined is nan, and stays so whatever is done with it, unless a choice leaves it aside. What is the same
    for all runs is worked out once.

    Attributes
    ----------
    values : mapping of str to float or Array
        For every name a number, or an array of shape (k,).
    """

    values: Mapping[str, Any]

    def value(self, expression: Expr, where: str = "") -> Any:
        """Return a formula's values."""
        if isinstance(expression, Number):
            return expression.value
        if isinstance(expression, Name | Reading):
            return self.values[expression.name]
        return self.apply(expression.function, *(self.value(a) for a in expression.arguments))

    def apply(self, function: str, *arguments: Any) -> Any:
        """Return a function of formulas."""
        if function == "where":
            condition, yes, no = arguments
            if not _varies(arguments):
                return condition if condition != condition else yes if condition else no
            return np.where(np.isnan(condition), np.nan, np.where(condition != 0.0, yes, no))
        if function in ("and", "or"):
            return _joined(function == "or", *arguments)
        work_out: Any = FUNCTIONS[function][1]
        if not _varies(arguments):
            return _number(work_out, *arguments)
        if function not in _OPERATORS:
            work_out = np.frompyfunc(partial(_number, work_out), len(arguments), 1)
        with np.errstate(all="ignore"):
            found = np.asarray(work_out(*arguments), dtype=np.float64)
        return np.where(np.isfinite(found), found, np.nan)

    def above(self, limit: Any, x: Any, where: str, expected: str, got: str) -> Any:
        """Return `x`, nan where it is not above a limit."""
        return np.where(x > limit, x, np.nan) if _varies((limit, x)) else x if x > limit else np.nan


def _joined(deciding: bool, a: Any, b: Any) -> Any:
    """Return whether one of two conditions holds (`deciding`), or both; undefined ones yield to those that decide."""
    values = np.asarray([*np.broadcast_arrays(a, b)], dtype=np.float64)
    undefined = np.isnan(values)
    decided = (~undefined & ((values != 0.0) == deciding)).any(axis=0)
    found = np.where(decided, float(deciding), np.where(undefined.any(axis=0), np.nan, float(not deciding)))
    return found if _varies((a, b)) else float(found)


def _varies(arguments: Iterable[Any]) -> bool:
    return any(isinstance(a, np.ndarray) for a in arguments)


def _number(function: Callable[..., Any], *arguments: float) -> float:
    """Return a function of numbers, nan where it is undefined."""
    if any(a != a for a in arguments):
        return math.nan
    try:
        found = function(*arguments)
    except (ArithmeticError, ValueError):
        return math.nan
    return found if isinstance(found, float) and math.isfinite(found) else math.nan


@dataclass(frozen=True)
class Rows:
    """What distinguishes the runs of a chunk.

    Attributes
    ----------
    parameters : Array, shape (k, number of parameters)
        Values of the mechanism's parameters.
    q, v : Array, shapes (k, nq), (k, nv)
        Described coordinates, not closed; given velocities, nan where they are to be completed.
    targets : Array, shape (k, h)
        Values of the coordinates that the runs hold.
    joints : Array, shape (k, j)
        Values of the joint coordinates and rates that the runs hold.
    pieces : tuple of tuple of Piece
        Of each run, or of all of them, where an input jumps; none where nothing does.
    """

    parameters: Array
    q: Array
    v: Array
    targets: Array
    joints: Array
    pieces: tuple[tuple[Piece, ...], ...] = ()

    def __len__(self) -> int:
        return len(self.parameters)

    def pieces_of(self, r: int) -> tuple[Piece, ...]:
        """Return the pieces of a run."""
        return self.pieces[r if len(self.pieces) > 1 else 0] if self.pieces else ()


def make_rows(
    mechanism: Mechanism,
    base: Mapping[str, float],
    varied: Mapping[str, Array],
    held: Mapping[str, int],
    given: Mapping[str, int],
    joints: Sequence[str] = (),
    settled: Iterable[str] = (),
    constant: Mapping[str, Expr] | None = None,
) -> Rows:
    """Return the rows of a chunk.

    Parameters
    ----------
    mechanism : Mechanism
        What is run.
    base : mapping
        Values of all parameters, before any varies.
    varied : mapping of str to Array, shape (k,)
        Values of all names that vary.
    held, given : mapping of str to int
        Coordinates that vary, in the order of `Rows.targets`, and velocities that vary, each with its index.
    joints : sequence of str
        Names of joint coordinates and rates that are held, in the order of `Rows.joints`.
    settled : iterable of str
        Parameters that have numbers in place of their formulas.
    constant : mapping of str to Expr, optional
        Values of those among them that do not vary, as formulas of parameters.
    """
    k = len(next(iter(varied.values())))
    values: dict[str, Any] = {**base, **{name: x for name, x in varied.items() if name in base}}
    for name, formula in derived(mechanism.parameters, {*settled, *varied}):
        values[name] = Columns(values).value(formula)
    described, speeds = described_start(mechanism, Columns(values))
    parameters, q, v = (np.empty((k, len(found))) for found in (base, described, speeds))
    for array, columns in ((parameters, [values[name] for name in base]), (q, described), (v, speeds)):
        for i, column in enumerate(columns):
            array[:, i] = np.nan if column is None else column
    undefined = [i for i, speed in enumerate(speeds) if speed is not None]
    q[~np.isfinite(v[:, undefined]).all(axis=1)] = np.nan
    numbers = Columns(values)
    chosen = {**varied, **{name: np.full(k, numbers.value(e)) for name, e in (constant or {}).items()}}
    for name, index in given.items():
        v[:, index] = chosen[name]
    targets = np.column_stack([chosen[name] for name in held]) if held else np.zeros((k, 0))
    places = np.column_stack([chosen[name] for name in joints]) if joints else np.zeros((k, 0))
    return Rows(parameters, q, v, np.ascontiguousarray(targets), places)
