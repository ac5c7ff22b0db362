"""Derivatives of motions in a comparison: their errors against differences of references, and what they cost."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError, nearest, quoted
from symgen.describe.stops import refuse_bounds
from symgen.layout import abi
from symgen.result.sensitivities import SCHEMES, Differentiated
from symgen.runs.timing import timed

if TYPE_CHECKING:
    from symgen.base.settings import Settings
    from symgen.describe.mechanism import Mechanism
    from symgen.study.comparison.distances import Distances

Array = NDArray[np.float64]

#: Part of a parameter between references, and factors of these in differences of fourth order.
WIDTH = 1e-3
FACTORS = {-2: 1.0, -1: -8.0, 1: 8.0, 2: -1.0}


def check_parameters(mechanism: Mechanism, names: Sequence[str]) -> None:
    """Refuse names that are no parameters, and mechanisms whose motion has no derivatives.

    Raises
    ------
    InputError
        Says which.
    """
    parameters = [p.name for p in mechanism.parameters if not p.input]
    for name in names:
        if name not in parameters:
            raise InputError("gradient", f"parameters of {mechanism.name}", quoted(name), nearest(name, parameters))
    if names:
        refuse_bounds("gradient", mechanism)


def width_of(value: float) -> float:
    """Return the distance of a parameter between references."""
    return WIDTH * abs(value) if value != 0.0 else WIDTH


def slopes_of(motions: dict[int, Array], width: float) -> Array:
    """Return the derivative of a motion by differences of fourth order."""
    return np.asarray(sum(factor * motions[k] for k, factor in FACTORS.items()) / (12.0 * width))


@dataclass(frozen=True)
class Gradients:
    """Derivatives of a reference motion.

    Parameters
    ----------
    slopes : mapping of str to Array
        By the names of parameters: of all coordinates at the outputs, shape (k, nq).
    distances : Distances
        The reference, whose length makes lengths of angles.
    """

    slopes: dict[str, Array]
    distances: Distances

    def measured(self, mechanism: Mechanism, settings: Settings) -> tuple[float | None, float | None]:
        """Return the largest part by which derivatives of a run differ from the reference's, and its run time [s].

        Both are None for a scheme without sensitivities, and where a run does not reach its end.
        """
        if settings.integrator not in SCHEMES:
            return None, None
        try:
            run = Differentiated(mechanism, replace(settings, verify=False), {name: name for name in self.slopes})
            run.integrate()  # compiles
            outcome = timed(run.integrate, settings.repeat).outcome
        except InputError:
            return None, None
        if outcome.interrupted:
            raise KeyboardInterrupt
        if outcome.code != abi.DONE:
            return None, None
        own, units = run.sensitivities(outcome).table("q"), [q.unit for q in run.bodies.info.coordinates]
        scales = np.array([1.0 if unit == "m" else self.distances.size for unit in units])
        errors = list[float]()
        for k, exact in enumerate(self.slopes.values()):
            size = float(np.abs(exact * scales).max(initial=0.0))
            errors.append(float(np.abs((own[:, :, k] - exact) * scales).max(initial=0.0)) / (size or 1.0))
        return max(errors), run.seconds
