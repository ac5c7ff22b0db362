"""A quantity at the end of a run as a function of numbers of the model, with its gradient, for optimisers.

Derivatives are by forward directions, which a run carries beside its state, or by the adjoint, which goes back through
its steps: whichever costs less.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import msgspec
import numpy as np
from numpy.typing import ArrayLike, NDArray

from symgen.analyses.fit.adjoint_gradient import adjoint_gradient, is_cheaper
from symgen.analyses.search.free_numbers import FreeNumbers
from symgen.analyses.search.ranges import Bounds, make_ranges, read_bounds
from symgen.analyses.search.sampled_motions import Remembering
from symgen.base import arguments
from symgen.base.errors import AnalysisError, AssemblyError, InputError
from symgen.describe.facts.lifted import lift_numbers
from symgen.describe.formulas.reaction_readings import REACTION, TENSION
from symgen.describe.mechanism import Mechanism, Output
from symgen.describe.parts.context import Context
from symgen.describe.parts.driven_mechanism import put_formulas
from symgen.describe.parts.scope import Scope
from symgen.result.sensitivities import derivative_unit, place_of_column
from symgen.run.directions.kept_stages import Uncovered
from symgen.run.layout import abi

if TYPE_CHECKING:
    from symgen.base.settings import Settings
    from symgen.result.result import Result
    from symgen.run.planning.named_directions import RunDirection
    from symgen.run.planning.prepare import Prepared

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Gradient:
    """A quantity at the end of a run, with its derivatives.

    Attributes
    ----------
    value : float
        The quantity.
    unit : str
        Its unit; empty for a formula.
    by : mapping of str to float
        Its derivatives by name.
    units : mapping of str to str
        Their units.
    result : Result
        The run, whose status says how far it can be trusted.
    way : {"forward", "adjoint"}
        How the derivatives were found.
    memory : int
        Bytes of the steps that the adjoint went back through.
    """

    value: float
    unit: str
    by: Mapping[str, float]
    units: Mapping[str, str]
    result: Result
    way: str = "forward"
    memory: int = 0

    def __repr__(self) -> str:
        return f"<Gradient of {self.value:.6g}: " + ", ".join(f"{name} {x:.6g}" for name, x in self.by.items()) + ">"


class Objective:
    """A quantity at the end of a run as a function of chosen numbers: ``objective(x)`` is its value and its gradient.

    ``scipy.optimize.minimize(objective, objective.x0, jac=True, bounds=objective.bounds)`` makes it smallest. Where the
    mechanism cannot be closed, or the run fails, the value is infinite and the gradient 0, so that searches turn back.

    Parameters
    ----------
    where : str
        Name of the method, for messages.
    mechanism, settings : Mechanism, Settings
        The model and how it runs.
    quantity : str
        A column of results, or a formula as in ``[outputs]``.
    by : mapping of str to (float or None, float or None), or sequence of str
        The numbers, with their bounds.
    way : {"auto", "forward", "adjoint"}
        How derivatives are found: whichever costs less and covers the run, or one of them.

    Attributes
    ----------
    quantity : str
        As above.
    names : tuple of str
        The numbers, in the order of `x`.
    mechanism : Mechanism
        The mechanism that runs: numbers of the file among `names` are parameters of it.
    x0 : Array
        Their values in the run as it is described.
    bounds : list of (float or None, float or None)
        Their bounds.
    first : Gradient
        Value and derivatives in that run. At `x0` the start holds values of its own that are varied.
    doubt : str or None
        Why the derivatives of the last run are in doubt. Whether steps are short enough for the adjoint is examined in
        the first run.
    """

    def __init__(
        self,
        where: str,
        mechanism: Mechanism,
        settings: Settings,
        quantity: str,
        by: Mapping[str, Bounds | None] | Sequence[str],
        way: str = "auto",
    ) -> None:
        self._where, self.quantity, pairs = where, quantity, read_bounds(f"{where}: by", by)
        own = lift_numbers(f"{where}: by", mechanism, tuple(pairs))
        mechanism, self._column = _add_output(where, own.mechanism, quantity)
        self._free = FreeNumbers(f"{where}: by", mechanism, settings, own.keys)
        until = mechanism.defaults.until if settings.until is None else settings.until
        self.mechanism = mechanism
        self.names, self.bounds, self._times = self._free.names, list(pairs.values()), (float(until),)
        self._pages = list[Array]()
        self._quick = arguments.one_word_of(f"{where}: way", way, ("auto", "forward", "adjoint")) == "auto"
        self._way = way if not self._quick else "adjoint" if is_cheaper(len(self.names)) else "forward"
        self.doubt: str | None = None
        self.first, directions, prepared = self._run_with_derivatives(None)
        self.x0 = self._free.values(directions, prepared, self.first.result)
        make_ranges(f"{where}: by", pairs, self.x0, "the start")
        self._gradient = Remembering(self._gradient_at)

    def __repr__(self) -> str:
        return f"<Objective {self.quantity} by {', '.join(self.names)}>"

    @property
    def runs(self) -> int:
        """Runs that were made, each with all derivatives."""
        return self._free.runs

    def settings_at(self, x: ArrayLike) -> Settings:
        """Return the settings of the run with values of the numbers, for a run of `mechanism`."""
        return self._free.settings_at(self._check_values(x))

    def __call__(self, x: ArrayLike) -> tuple[float, Array]:
        """Return the value and the gradient."""
        value, slopes = self._gradient(self._check_values(x))
        return value, slopes.copy()

    def _check_values(self, x: ArrayLike) -> Array:
        array = np.array(arguments.numbers(f"{self._where}: x", x))
        if len(array) != len(self.names):
            expected = f"one number each for {', '.join(self.names)}"
            raise InputError(f"{self._where}: x", expected, f"{len(array)} numbers")
        return array

    def _gradient_at(self, x: Array) -> tuple[float, Array]:
        try:
            gradient, _, _ = self._run_with_derivatives(x)
            return gradient.value, np.array([*gradient.by.values()])
        except Uncovered:
            raise
        except (InputError, AssemblyError, AnalysisError):
            return np.inf, np.zeros(len(x))

    def _run_with_derivatives(self, x: Array | None) -> tuple[Gradient, tuple[RunDirection, ...], Prepared]:
        """Make a run with the values `x`, by default as the settings are; return it with its derivatives."""
        gradient, directions, prepared = self._run_with_directions(x)
        doubtful = gradient.result.status == "unverified"
        self.doubt = gradient.result.reason if doubtful else None
        return gradient, directions, prepared

    def _run_with_directions(self, x: Array | None) -> tuple[Gradient, tuple[RunDirection, ...], Prepared]:
        if self._way == "adjoint":
            try:
                return self._run_by_adjoint(x)
            except Uncovered:
                if not self._quick:
                    raise
                self._way = "forward"
        run, result = self._free.run(self._times, x)
        if result.outcome.code != abi.DONE:
            raise AnalysisError(f"{self._where}: the run does not reach its end: {result.reason}")
        return self._gradient_of_result(result), run.directions, run.run

    def _run_by_adjoint(self, x: Array | None) -> tuple[Gradient, tuple[RunDirection, ...], Prepared]:
        settings = self._free.settings if x is None else self._free.settings_at(x)
        self._free.runs += 1
        ending = replace(settings, times=[*self._times], until=self._times[-1])
        named = self._where, self.mechanism, ending, self._column, self._free.keys
        adjoint = adjoint_gradient(*named, self._quick, self._pages, x is None)
        slopes = dict(zip(self.names, adjoint.slopes.tolist(), strict=True))
        units = {
            name: derivative_unit(adjoint.unit, d.unit) for name, d in zip(self.names, adjoint.directions, strict=True)
        }
        gradient = Gradient(adjoint.value, adjoint.unit, slopes, units, adjoint.result, "adjoint", adjoint.memory)
        return gradient, adjoint.directions, adjoint.run

    def _gradient_of_result(self, result: Result) -> Gradient:
        table, place, unit = place_of_column(result, self._column)
        assert result.sensitivities is not None, "the run has directions"
        if result.sensitivities.end is not None:
            hint = "take record_when, or Result.gradient and result.sensitivities.end"
            raise InputError(self._where, "a run that ends at a time", f"an event at t = {result.end:g} s", hint)
        slopes = result.gradient(self._column).row()
        units = {d: derivative_unit(unit, by) for d, by in zip(self.names, result.sensitivities.units, strict=True)}
        return Gradient(float(getattr(result, table).values[-1, place]), unit, slopes, units, result)


def _add_output(where: str, mechanism: Mechanism, quantity: str) -> tuple[Mechanism, str]:
    """Return a mechanism that reports a quantity, and the name of its column; formulas become outputs."""
    text = arguments.text(where, quantity).strip()
    unit = ""
    if re.fullmatch(r"[^\W\d][\w.]*", text):
        owner, _, last = text.rpartition(".")
        if last not in REACTION and (last != TENSION or "." in owner):
            return mechanism, text
        unit = "N"  # forces of joints are no columns with directions
    name = "objective"
    while any(name == output.name for output in mechanism.outputs):
        name += "_"
    output = Output(name, Scope(Context.of_mechanism(mechanism), where).of_motion("", text), unit)
    outputs = (*mechanism.outputs, put_formulas(output, dict(mechanism.input_formulas)))
    return msgspec.structs.replace(mechanism, outputs=outputs), name
