"""Quantities of a motion with directions, by emitted functions of the state."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.run.directions.directed_model import form_for_derivatives
from symgen.run.layout import abi
from symgen.run.layout.probe import rate_functions

if TYPE_CHECKING:
    from symgen.run.directions.directed_model import DirectedModel

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Observer:
    """Functions of the motion at outputs, with directions.

    Parameters
    ----------
    model : DirectedModel
        The code.
    times, states : Array, shapes (k,), (k, longer ny)
        Outputs and their states with directions.
    windings : Array
        Angles that count turns at the outputs, then the numbers of modes.
    pieces : tuple of (float, Array)
        Parameters with directions of earlier pieces of the run, each with the last time at which it holds, then those
        of the last one.
    w : Array
        Scratch with directions.
    modes : sequence of (float, Array)
        Directions of the numbers of modes, each with the last time at which they hold; none without modes.
    """

    model: DirectedModel
    times: Array
    states: Array
    windings: Array
    pieces: tuple[tuple[float, Array], ...]
    w: Array
    modes: Sequence[tuple[float, Array]] = ()

    def _state_at_output(self, k: int) -> tuple[float, Array, Array]:
        """Return time, state and parameters of an output."""
        p = next(p for until, p in self.pieces if self.times[k] <= until)
        return float(self.times[k]), self.states[k].copy(), p

    @cached_property
    def rates(self) -> tuple[Array, Array]:
        """Rates of the state and the scratch at the outputs, with directions, shapes (k, longer ny), (k, longer nw)."""
        model, law = self.model, self.model.whole.law_module
        rates, confirm = rate_functions(law)
        accept, rates, confirm = (
            f.caller(kind.signature.arguments)
            for f, kind in ((law.accept, abi.ACCEPT), (rates, abi.RHS), (confirm, abi.RHS))
        )
        w, iw = self.w.copy(), np.zeros(abi.N_COUNTERS, dtype=np.int64)
        rows, scratch = np.zeros_like(self.states), np.zeros((len(self.times), len(w)))
        ydot = np.zeros(model.sizes["y"] * (1 + model.lanes))
        for k in range(len(self.times)):
            t, y, p = self._state_at_output(k)
            self._wind_angles(w, k)
            accept(t, y, p, w, iw)
            if rates(t, y, p, w, iw, ydot) != 0:
                confirm(t, y, p, w, iw, ydot)
            rows[k], scratch[k] = ydot[: rows.shape[1]], w
        return rows, scratch

    def _wind_angles(self, w: Array, k: int) -> None:
        """Set the angles that count turns, and the numbers of modes, to their values at an output."""
        w[abi.WINDING : abi.WINDING + self.windings.shape[1]] = self.windings[k]
        if self.modes and self.model.plain.info.switchable:
            first, size = self.model.plain.info.sections["modes"]
            directions = next(modes for until, modes in self.modes if self.times[k] <= until)
            self.model.directions_after(w, "w")[first : first + size] = directions

    def observe_directions(self, function: object, length: int) -> tuple[Array, Array]:
        """Return the values of a function of the motion and their directions, shapes (k, length), (k, length, L).

        Parameters
        ----------
        function : compiled function
            Of type `symgen.run.layout.abi.OBSERVE`.
        length : int
            Number of values that it writes.
        """
        call = self.model.function(function, length).caller(abi.OBSERVE.signature.arguments)
        rates, scratch = self.rates
        out, lanes = np.zeros((len(self.times), length * (1 + self.model.lanes))), self.model.lanes
        for k in range(len(self.times)):
            t, y, p = self._state_at_output(k)
            call(t, y, p, scratch[k].copy(), rates[k].copy(), out[k])
        return out[:, :length], out[:, length:].reshape(len(self.times), length, lanes)

    def observe_energies(self) -> Array:
        """Return the directions of kinetic and potential energy at the outputs, shape (k, 2, L)."""
        model, module = self.model, self.model.plain.model
        geometry = model.caller("geometry", model.whole.model.geometry)
        measure = model.function(form_for_derivatives(module, "measure")).caller(abi.MEASURE.signature.arguments)
        rows = np.zeros((len(self.times), 2, model.lanes))
        for k in range(len(self.times)):
            t, y, p = self._state_at_output(k)
            w = self.w.copy()
            self._wind_angles(w, k)
            geometry(t, y, p, w)
            measure(t, y, p, w)
            rows[k] = model.directions_after(w, "w")[[abi.KINETIC, abi.POTENTIAL]]
        return rows

    def violations_of_directions(self) -> Array:
        """Return the largest derivative of a row of Phi at the outputs in each direction, shape (k, L)."""
        model = self.model
        info = model.plain.info
        first, _ = info.sections["residual"]
        holonomic = [first + i for i, row in enumerate(info.rows) if row.holonomic]
        largest = np.zeros((len(self.times), model.lanes))
        for k in range(len(self.times)):
            t, y, p = self._state_at_output(k)
            w = self.w.copy()
            self._wind_angles(w, k)
            model.caller("geometry", model.whole.model.geometry)(t, y, p, w)
            largest[k] = np.abs(model.directions_after(w, "w")[holonomic]).max(axis=0, initial=0.0)
        return largest
