"""Events that end an integration of `scipy.integrate.solve_ivp`, which reads attributes of a function."""

from collections.abc import Callable
from typing import Any


class Ending:
    """A function whose zero ends an integration.

    Parameters
    ----------
    of : callable
        Time, state and further arguments -> number.
    direction : float
        Sign of the passages of zero that count; 0 for both.
    """

    terminal = True

    def __init__(self, of: Callable[..., float], direction: float = 0.0) -> None:
        self.of, self.direction = of, direction

    def __call__(self, *given: Any) -> float:
        return self.of(*given)
