"""Numbers of rows that may be off where no row with bounds is in force."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import sympy as sp

from symgen.describe.bounds.bounded_modes import name_of_number, two_sided_rows

if TYPE_CHECKING:
    from symgen.result.reading.symbolic_equations import SymbolicEquations


def free_modes(equations: SymbolicEquations, libraries: Sequence[Any]) -> Callable[..., list[float]]:
    """Return the function of t, q, v, parameters, turned angles and states that gives the numbers in their order.

    Parameters
    ----------
    equations : SymbolicEquations
        Whose numbers.
    libraries : sequence
        As `sympy.lambdify` takes them.
    """
    rates = _rates_in_motion(equations)
    in_force = _held_by_joints(equations)
    still = [float(name in in_force) for name in equations.modes]
    if not rates:
        return lambda *_: list(still)
    places = [list(equations.modes).index(name) for name in rates]
    compute = sp.lambdify(equations.arguments[:-1], list(rates.values()), libraries)

    def modes_in_motion(*values: object) -> list[float]:
        numbers = list(still)
        for place, rate in zip(places, compute(*values), strict=True):
            numbers[place] = float(np.sign(rate))
        return numbers

    return modes_in_motion


def _held_by_joints(equations: SymbolicEquations) -> set[str]:
    """Return the names of the numbers that say that rows of joints are in force."""
    return {f"{row.name}.held" for row in equations.derived.rows if row.held is not None and not row.bounded}


def _rates_in_motion(equations: SymbolicEquations) -> Mapping[str, Any]:
    """Return the rates along rows with two bounds, by the names of the numbers with their signs."""
    rates = equations.rates_of_bounded_rows
    return {name_of_number(row, "sign").name: rates[row.row] for row in two_sided_rows(equations.mechanism)}
