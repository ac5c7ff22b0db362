"""Formulas of the motion, compiled for the present state of a run."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError, quote
from symgen.base.vocabulary.expressions import readings_in
from symgen.base.vocabulary.measures import Integral
from symgen.compile.loopcode.entry import bind_arguments
from symgen.describe.parts.context import Context
from symgen.describe.parts.driven_mechanism import put_formulas
from symgen.describe.parts.scope import Scope
from symgen.run.compiling.side import Side, compile_side
from symgen.run.layout import abi
from symgen.run.layout.probe import rate_function

if TYPE_CHECKING:
    from symgen.run.planning.prepare import Prepared
    from symgen.run.single.simulation import Simulation

Array = NDArray[np.float64]


def compile_formulas(prepared: Prepared, formulas: Sequence[str], where: str) -> tuple[Side, bool]:
    """Return formulas of the motion, compiled, and whether they read accelerations or forces of joints.

    Parameters
    ----------
    prepared : Prepared
        The run.
    formulas : sequence of str
        As outputs of a file have them; no integrals.
    where : str
        What they are, for messages.

    Raises
    ------
    InputError
        If one is no formula of the motion.
    """
    mechanism, parsed = prepared.plan.mechanism, []
    context, inputs = Context.of_mechanism(mechanism), dict(mechanism.input_formulas)
    for text in formulas:
        place = f"{where} {quote(text)}"
        expression = Scope(context, place).of_motion("", text)
        if any(isinstance(reading.source, Integral) for reading in readings_in(expression)):
            raise InputError(place, "a formula of the present state", "an integral")
        parsed.append((text, put_formulas(expression, inputs)))
    purpose = "formulas at the present state of a run"
    side = compile_side(prepared.mechanism, prepared.compiled, "formulas", purpose, parsed)
    return side, bool(side.reads & {"ydot", "multipliers"})


class Meter:
    """Formulas of the motion at the present state of a run, which stays as it is.

    Parameters
    ----------
    prepared, simulation : Prepared, Simulation
        The run, and its arrays.
    formulas, where
        As for `compile_formulas`.
    """

    def __init__(self, prepared: Prepared, simulation: Simulation, formulas: Sequence[str], where: str) -> None:
        side, rated = compile_formulas(prepared, formulas, where)
        state, compiled = simulation.state, simulation.compiled
        self._state, self._w, self._iw = state, state.w.copy(), np.zeros_like(state.iw)
        self._rates, self._out = np.zeros(compiled.info.ny), np.zeros(max(1, len(formulas)))
        self._count, self._rate = len(formulas), rate_function(compiled) if rated else None
        self._evaluate = bind_arguments(
            side.function, abi.OBSERVE, 0.0, state.y, state.p, self._w, self._rates, self._out
        )

    def __call__(self) -> Array:
        """Return the values, in the order of the formulas."""
        state, t = self._state, float(self._state.clock[abi.TIME])
        self._w[:] = state.w
        if self._rate is not None:
            self._iw[:] = 0
            self._rate(t, state.y, state.p, self._w, self._iw, self._rates)
        self._evaluate(t)
        return self._out[: self._count].copy()
