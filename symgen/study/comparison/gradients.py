"""Derivatives of motions in a comparison: their errors against differences of references, and what they cost.

Three ways: directions beside a run, the adjoint of one coordinate at its end, and differences of two runs a parameter,
each with the step that makes their error smallest.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.fit.adjoint_gradient import adjoint_gradient
from symgen.base.errors import InputError, SymgenError, quote, suggest
from symgen.describe.formulas.evaluate import parameter_values
from symgen.result.sensitivities import SCHEMES, Differentiated
from symgen.run.layout import abi
from symgen.run.planning.prepare import prepare
from symgen.run.single.timing import time_runs

if TYPE_CHECKING:
    from symgen.base.settings import Settings
    from symgen.describe.mechanism import Mechanism
    from symgen.run.planning.prepare import Prepared
    from symgen.study.comparison.distances import Distances

Array = NDArray[np.float64]

#: Part of a parameter between references, and factors of these in differences of fourth order.
WIDTH = 1e-3
FACTORS = {-2: 1.0, -1: -8.0, 1: 8.0, 2: -1.0}
#: Parts of a parameter among which the best step of differences of two runs is sought.
STEPS = tuple(10.0**-k for k in range(1, 10))


def check_parameters(mechanism: Mechanism, names: Sequence[str]) -> None:
    """Refuse names that are no parameters.

    Raises
    ------
    InputError
        Says which.
    """
    parameters = [p.name for p in mechanism.parameters if not p.input]
    for name in names:
        if name not in parameters:
            raise InputError("gradient", f"parameters of {mechanism.name}", quote(name), suggest(name, parameters))


def difference_width(value: float) -> float:
    """Return the distance of a parameter between references."""
    return WIDTH * abs(value) if value != 0.0 else WIDTH


def difference_slopes(motions: dict[int, Array], width: float) -> Array:
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

    def measure_all(self, mechanism: Mechanism, settings: Settings) -> dict[str, Any]:
        """Return errors of derivatives of a run and what they cost [s], by columns of rows.

        A way that a scheme or a method does not have is left out, and all where a run does not reach its end.
        """
        columns, settings = dict[str, Any](), replace(settings, verify=False)
        ways: dict[str, Callable[[Mechanism, Settings], tuple[float, float] | None]] = {
            "gradient": self._measure_forward,
            "adjoint": self._measure_adjoint,
            "differences": self._measure_differences,
        }
        for name, way in ways.items():
            try:
                pair = way(mechanism, settings)
            except SymgenError:
                pair = None
            if pair is not None:
                columns[f"{name}_error"], columns[f"{name}_seconds"] = pair
        return columns

    def _length_scales(self, units: Sequence[str]) -> Array:
        """Return factors that make lengths of coordinates."""
        return np.array([1.0 if unit == "m" else self.distances.size for unit in units])

    def _largest_error(self, name: str, own: Array, scales: Array) -> float:
        """Return the largest error of derivatives by a parameter, over the largest one."""
        exact = self.slopes[name]
        size = float(np.abs(exact * scales).max(initial=0.0))
        return float(np.abs((own - exact) * scales).max(initial=0.0)) / (size or 1.0)

    def _measure_forward(self, mechanism: Mechanism, settings: Settings) -> tuple[float, float] | None:
        if settings.integrator not in SCHEMES:
            return None
        run = Differentiated(mechanism, settings, {name: name for name in self.slopes})
        run.integrate()  # compiles
        outcome = time_runs(run.integrate, settings.repeat).outcome
        if outcome.interrupted:
            raise KeyboardInterrupt
        if outcome.code != abi.DONE:
            return None
        own, scales = (
            run.sensitivities(outcome).table("q"),
            self._length_scales([q.unit for q in run.bodies.info.coordinates]),
        )
        return max(self._largest_error(name, own[:, :, k], scales) for k, name in enumerate(self.slopes)), run.seconds

    def _measure_adjoint(self, mechanism: Mechanism, settings: Settings) -> tuple[float, float] | None:
        """Return error and cost for the coordinate at the end that parameters change most."""
        run = prepare(mechanism, settings)
        coordinates = run.assembled.of_bodies[0].info.coordinates
        scales = self._length_scales([q.unit for q in coordinates])
        sizes = {name: float(np.abs(x * scales).max(initial=0.0)) or 1.0 for name, x in self.slopes.items()}
        ends = {name: x[-1] * scales / sizes[name] for name, x in self.slopes.items()}
        place = int(np.abs(np.array([*ends.values()])).max(axis=0).argmax())
        ending, pages = replace(settings, times=[float(run.spec.times[-1])]), list[Array]()
        arguments = "compare", mechanism, ending, coordinates[place].name, {name: name for name in self.slopes}
        adjoints = [adjoint_gradient(*arguments, False, pages, False) for _ in range(1 + settings.repeat)]
        pairs = zip(ends.items(), adjoints[-1].slopes.tolist(), strict=True)
        errors = [abs(slope * scales[place] / sizes[name] - end[place]) for (name, end), slope in pairs]
        return max(errors), min(x.seconds for x in adjoints[1:])

    def _measure_differences(self, mechanism: Mechanism, settings: Settings) -> tuple[float, float] | None:
        values, errors, cost = parameter_values(mechanism, settings.parameters), list[float](), 0.0
        for name in self.slopes:
            best, chosen = np.inf, list["Prepared"]()
            for part in STEPS:
                width = part * (abs(values[name]) or 1.0)
                own = ({**settings.parameters, name: values[name] + way * width} for way in (-1.0, 1.0))
                runs = [prepare(mechanism, replace(settings, parameters=parameters)) for parameters in own]
                outcomes = [run.integrate() for run in runs]
                if any(outcome.interrupted for outcome in outcomes):
                    raise KeyboardInterrupt
                if any(outcome.code != abi.DONE for outcome in outcomes):
                    continue
                low, high = (run.positions(outcome) for run, outcome in zip(runs, outcomes, strict=True))
                scales = self._length_scales([q.unit for q in runs[0].assembled.of_bodies[0].info.coordinates])
                error = self._largest_error(name, (high - low) / (2.0 * width), scales)
                if error < best:
                    best, chosen = error, runs
            if not chosen:
                return None
            errors.append(best)
            cost += sum(time_runs(run.integrate, settings.repeat).outcome.cpu_seconds for run in chosen)
        return max(errors), cost
