"""Numbers of quantities over the time of a run: ``peak(motor.effort)``, ``max(ram.effort)``, ``rms(crank.omega)``.

They are taken of the outputs of a run, so that a run leaves one number for each instead of a history.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError, quote, suggest
from symgen.result.over_time import time_mean, time_rms
from symgen.result.signals import Signal

Array = NDArray[np.float64]


#: What is taken of a quantity over time: functions of times, shape (n,), and of values, shape (..., n).
FUNCTIONS: Mapping[str, Callable[[Array, Array], Array]] = {
    "max": lambda t, x: np.max(x, axis=-1),
    "min": lambda t, x: np.min(x, axis=-1),
    "range": lambda t, x: np.ptp(x, axis=-1),
    "mean": time_mean,
    "rms": time_rms,
    "peak": lambda t, x: np.max(np.abs(x), axis=-1),
}
_CALL = re.compile(r"(\w+)\((.*)\)")


def split_statistic(name: str) -> tuple[str, str]:
    """Return the function and the quantity that a name means, such as ``max`` and ``ram.effort``; no function: the end.

    Raises
    ------
    InputError
        If there is no such function; says the nearest one.
    """
    call = _CALL.fullmatch(name)
    if call is None:
        return "", name
    if call[1] not in FUNCTIONS:
        expected = f"{', '.join(FUNCTIONS)} of a quantity over time"
        raise InputError(f"quantity {quote(name)}", expected, quote(call[1]), suggest(call[1], [*FUNCTIONS]))
    return call[1], call[2].strip()


@dataclass(frozen=True)
class OverTime:
    """Numbers that each run leaves instead of histories.

    Attributes
    ----------
    quantities : tuple of Signal
        Names and units of these numbers; each has the source and the column of its quantity.
    functions : tuple of str
        Keys of `FUNCTIONS`; empty: the value at the end.
    places : tuple of int
        Each number's quantity, by its place among the quantities of the loops.
    """

    quantities: tuple[Signal, ...]
    functions: tuple[str, ...]
    places: tuple[int, ...]

    def evaluate_runs(self, values: Array, times: Array, good: NDArray[np.bool_]) -> Array:
        """Return the numbers of runs, shape (runs, numbers, 1).

        Parameters
        ----------
        values : Array, shape (runs, quantities, times)
            Quantities at the output times; nan after the end of a run that an event has ended.
        times : Array
            Output times [s].
        good : Array of bool, shape (runs,)
            Which runs came to their end; others leave nan.
        """
        numbers = np.full((len(values), len(self.places), 1), np.nan)
        reached = np.sum(~np.isnan(values).all(axis=1), axis=-1)  # a quantity may be undefined at single outputs
        for count in np.unique(reached[good & (reached > 0)]):
            rows = np.flatnonzero(good & (reached == count))
            for i, (function, place) in enumerate(zip(self.functions, self.places, strict=True)):
                x = values[rows, place, :count]
                numbers[rows, i, 0] = FUNCTIONS[function](times[:count], x) if function else x[:, -1]
        return numbers


def ends_of(kept: Sequence[Signal]) -> OverTime:
    """Return the values of quantities at the end of each run."""
    return OverTime(tuple(kept), ("",) * len(kept), tuple(range(len(kept))))


def read_statistics(
    parts: Sequence[tuple[str, str]], kept: Sequence[Signal], choose: Callable[[Sequence[str]], tuple[Signal, ...]]
) -> OverTime | None:
    """Return what names ask for over time, None where all of them are plain quantities.

    Parameters
    ----------
    parts : sequence of (str, str)
        Functions and quantities, from `split_statistic`.
    kept : sequence of Signal
        All these quantities, as loops leave them.
    choose : callable
        Returns the quantities that names mean.
    """
    if not any(function for function, _ in parts):
        return None
    loops = {signal.name: i for i, signal in enumerate(kept)}
    quantities, functions, places = list[Signal](), list[str](), list[int]()
    for function, name in parts:
        for signal in choose([name]):
            label = f"{function}({signal.name})" if function else signal.key
            table = label if function else signal.table
            quantities.append(Signal(table, label, signal.unit, signal.source, signal.column))
            functions.append(function)
            places.append(loops[signal.name])
    return OverTime(tuple(quantities), tuple(functions), tuple(places))
