"""Numbers of a model that a search varies: their values, and runs that are differentiated by them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.search.sampled_motions import NoMotion
from symgen.base.errors import InputError, SymgenError
from symgen.base.settings import Settings, differs_from_default
from symgen.describe.formulas.evaluate import parameter_values
from symgen.result.build import build_result
from symgen.result.sensitivities import Differentiated
from symgen.run.layout import abi

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.result.result import Result
    from symgen.run.planning.named_directions import RunDirection
    from symgen.run.planning.prepare import Prepared

Array = NDArray[np.float64]

#: Tolerances of runs whose derivatives guide a search, unless they are set.
_RTOL = _ATOL = 1e-10


def tighten_tolerances(where: str, settings: Settings) -> Settings:
    """Return the settings of a run whose derivatives count: tight tolerances where they are left open.

    Raises
    ------
    InputError
        If it goes on from another run.
    """
    if not isinstance(settings.start, Mapping):
        raise InputError(where, "a run that begins at a start", "one that goes on from another run")
    if not differs_from_default(settings, "step"):
        settings = replace(settings, rtol=settings.rtol or _RTOL, atol=settings.atol or _ATOL)
    return replace(settings, verify=False)


def put_numbers(mechanism: Mechanism, settings: Settings, numbers: Mapping[str, float]) -> Settings:
    """Return settings with values of numbers: parameters, values of the start, ``method.NAME``."""
    parameters, start, options = dict(settings.parameters), dict(settings.start), dict(settings.options)
    own = {p.name for p in mechanism.parameters}
    for name, value in numbers.items():
        if name in own:
            parameters[name] = value
        elif name.startswith("method."):
            options[name] = value
        else:
            start[name] = value
    return replace(settings, parameters=parameters, start=start, options=options)


class FreeNumbers:
    """Numbers of a model that a search varies.

    Parameters
    ----------
    where : str
        Argument that has their names, for messages.
    mechanism, settings : Mechanism, Settings
        The model and how it runs.
    keys : mapping of str to str
        Names as typed, each with its name in the mechanism: parameters, values of the start, ``method.NAME``.

    Attributes
    ----------
    names : tuple of str
        Names as typed.
    runs : int
        Runs that were made.
    """

    def __init__(self, where: str, mechanism: Mechanism, settings: Settings, keys: Mapping[str, str]) -> None:
        self.where, self.mechanism, self.keys, self.names, self.runs = where, mechanism, keys, tuple(keys), 0
        self._moved = False
        self.settings = tighten_tolerances(where, settings)

    def settings_at(self, x: Array) -> Settings:
        """Return the settings of a run with values of the numbers."""
        numbers = dict(zip(self.keys.values(), x.tolist(), strict=False))
        return put_numbers(self.mechanism, self.settings, numbers)

    def run(self, times: Sequence[float], x: Array | None = None) -> tuple[Differentiated, Result]:
        """Make a run to the last of some times; with the values of the settings where there is no `x`."""
        settings = self.settings if x is None else self.settings_at(x)
        run = Differentiated(self.mechanism, replace(settings, times=[*times], until=float(times[-1])), self.keys)
        self.runs += 1
        result = run.result(build_result(run.run, run.integrate()))
        self._moved = True
        return run, result

    def motion(self, x: Array, times: Array, names: Sequence[str]) -> tuple[Array, Array]:
        """Return columns of a run at times and their derivatives, shapes (k, columns), (k, columns, n).

        Raises
        ------
        InputError
            If no run was made before, and the settings, or the machine, allow no derivatives.
        NoMotion
            If the run does not reach all times.
        """
        try:
            _, result = self.run(times.tolist(), x)
        except SymgenError as error:
            if isinstance(error, InputError) and not self._moved:
                raise
            raise NoMotion(str(error)) from None
        if result.interrupted:
            raise KeyboardInterrupt
        if result.outcome.code != abi.DONE or len(result.t) != len(times):
            raise NoMotion(result.reason or "the run ends early")
        slopes = [result.gradient(name).values for name in names]
        return np.column_stack([result[name] for name in names]), np.stack(slopes, axis=1)

    def values(self, directions: Sequence[RunDirection], run: Prepared, result: Result) -> Array:
        """Return the values of the numbers in a run that was made without `x`."""
        return np.array([self._value_of_number(d, run, result) for d in directions])

    def _value_of_number(self, d: RunDirection, run: Prepared, result: Result) -> float:
        if d.kind == "parameter":
            return float(parameter_values(self.mechanism, self.settings.parameters)[d.key])
        if d.kind == "method":
            p, law = run.start.p, run.compiled.law
            return float(p[law.parameter_offset + [name for name, _ in law.parameters].index(d.key)])
        if d.key in self.settings.start:
            return float(self.settings.start[d.key])
        start = result.start["q"] | result.start["v"]
        if d.key not in start:
            expected = f"the value of {d.key} at the start, where the search begins"
            raise InputError(self.where, expected, "none", f"give start={{'{d.key}': VALUE}}")
        return float(start[d.key])
