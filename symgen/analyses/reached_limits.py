"""The limits of a file beside what a run reaches."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from symgen.describe.formulas.evaluate import evaluate_formula

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism, OperatingLimit
    from symgen.result.result import Result


class ReachedLimit(NamedTuple):
    """A limit and what came nearest to it, or went beyond it most.

    Attributes
    ----------
    name, unit : str
        The output or parameter, and the unit of the numbers.
    side : str
        ``smallest`` or ``largest``.
    limit, reached : float
        The limit and the value.
    t : float or None
        When it was reached, at an output of the run [s]; None for a parameter.
    """

    name: str
    unit: str
    side: str
    limit: float
    reached: float
    t: float | None

    @property
    def is_met(self) -> bool:
        """Whether the value is within the limit; NaN is not."""
        return self.reached <= self.limit if self.side == "largest" else self.reached >= self.limit


def reached_limits(mechanism: Mechanism, result: Result) -> tuple[ReachedLimit, ...]:
    """Return the limits of a file in its order, parameters first, each beside what a run with outputs reached.

    Parameters
    ----------
    mechanism : Mechanism
        The machine.
    result : Result
        A run of it. Between its outputs a value can go farther.
    """
    return tuple(_reached_values(mechanism, result))


def _reached_values(mechanism: Mechanism, result: Result) -> Iterator[ReachedLimit]:
    outputs = result.whole(("outputs",))
    columns = {name: (outputs.values[:, i], outputs.units[i]) for i, name in enumerate(outputs.names)}
    units = {parameter.name: parameter.unit for parameter in mechanism.parameters}
    for limit in mechanism.limits:
        for side, bound in _ends_of_limit(limit, result.parameters):
            if limit.name in units:
                yield ReachedLimit(limit.name, units[limit.name], side, bound, result.parameters[limit.name], None)
                continue
            values, unit = columns[limit.name]
            k = _index_of_extreme(values, side)
            yield ReachedLimit(limit.name, unit, side, bound, float(values[k]), float(result.t[k]))


def _ends_of_limit(limit: OperatingLimit, parameters: Mapping[str, float]) -> Iterator[tuple[str, float]]:
    for side, end in (("smallest", limit.smallest), ("largest", limit.largest)):
        if end is not None:
            yield side, evaluate_formula(end, parameters, f"{limit.name}.{side}")


def _index_of_extreme(values: NDArray[np.float64], side: str) -> int:
    """Return where a column is largest or smallest; the first NaN, if any."""
    return int(np.argmax(values) if side == "largest" else np.argmin(values))
