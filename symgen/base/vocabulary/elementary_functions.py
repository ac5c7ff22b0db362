"""Elementary functions of formulas: the one table for all stages.

Each has the same name here, in files, in `math`, NumPy and SymPy.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Elementary:
    """An elementary function of one number.

    Parameters
    ----------
    evaluate : callable
        The function itself.
    slope : callable
        Its derivative on an expression graph: takes the `symgen.base.ir.graph.Graph` and the nodes of the argument and
        of the function, and returns a node.
    everywhere : bool
        Whether it is a number for every argument that is one.
    """

    evaluate: Callable[[float], float]
    slope: Callable[[Any, int, int], int]
    everywhere: bool = True


#: Added to the divisors of slopes, which are then never 0: lost next to any root other than 0, and so large
#: that slopes of slopes are finite numbers.
_NEVER_NOTHING = 1e-100


def nonzero_divisor(g: Any, a: Any, part: float = _NEVER_NOTHING) -> Any:
    """Return the divisor of a slope that is unbounded at the end of a function's range: a, and never 0.

    The parts of the argument hardly ever change it there: the root of v^2 + w^2 at rest, or a penetration
    where nothing touches. Infinity times such a 0 would not be a number.
    """
    return g.add(a, g.constant(part))


def _cosine_of_arcsine(g: Any, a: int) -> int:
    """Return sqrt(1 - a^2), and never 0: as large as rounding of a may make it."""
    cosine: int = g.call("sqrt", nonzero_divisor(g, g.sub(g.one, g.mul(a, a)), 1e-16))
    return cosine


def _root_of_square_minus_one(g: Any, a: int) -> int:
    """Return sqrt(a - 1) sqrt(a + 1), never 0: undefined below -1, as the function is, and exact near 1."""
    product: int = g.mul(g.call("sqrt", nonzero_divisor(g, g.sub(a, g.one), 1e-32)), g.call("sqrt", g.add(a, g.one)))
    return product


ELEMENTARY: Mapping[str, Elementary] = {
    "sqrt": Elementary(math.sqrt, lambda g, a, n: g.div(g.constant(0.5), nonzero_divisor(g, n)), everywhere=False),
    "exp": Elementary(math.exp, lambda g, a, n: n),
    "log": Elementary(math.log, lambda g, a, n: g.div(g.one, a), everywhere=False),
    "sin": Elementary(math.sin, lambda g, a, n: g.call("cos", a)),
    "cos": Elementary(math.cos, lambda g, a, n: g.neg(g.call("sin", a))),
    "tan": Elementary(math.tan, lambda g, a, n: g.add(g.one, g.mul(n, n))),
    "asin": Elementary(math.asin, lambda g, a, n: g.div(g.one, _cosine_of_arcsine(g, a)), everywhere=False),
    "acos": Elementary(math.acos, lambda g, a, n: g.neg(g.div(g.one, _cosine_of_arcsine(g, a))), everywhere=False),
    "atan": Elementary(math.atan, lambda g, a, n: g.div(g.one, g.add(g.one, g.mul(a, a)))),
    "sinh": Elementary(math.sinh, lambda g, a, n: g.call("cosh", a)),
    "cosh": Elementary(math.cosh, lambda g, a, n: g.call("sinh", a)),
    "tanh": Elementary(math.tanh, lambda g, a, n: g.sub(g.one, g.mul(n, n))),
    "asinh": Elementary(math.asinh, lambda g, a, n: g.div(g.one, g.call("sqrt", g.add(g.one, g.mul(a, a))))),
    "acosh": Elementary(math.acosh, lambda g, a, n: g.div(g.one, _root_of_square_minus_one(g, a)), everywhere=False),
    "atanh": Elementary(math.atanh, lambda g, a, n: g.div(g.one, g.sub(g.one, g.mul(a, a))), everywhere=False),
}
