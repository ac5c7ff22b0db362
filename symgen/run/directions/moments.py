"""Emitted functions at single instants with directions of state, time, parameters and modes.

A run between two instants has directions of its own (`symgen.run.directions.directions`), or an adjoint. Here is what
both need where the motion changes: many directions at once, among them the motion itself: the direction of time.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from symgen.base.ir.program import MODE_NUMBERS
from symgen.run.directions.directed_model import DirectedModel, form_for_derivatives, lanes_for_directions
from symgen.run.layout import abi
from symgen.run.layout.probe import Ready, rate_functions

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel

Array = NDArray[np.float64]


class Moment(NamedTuple):
    """A state of a run at a time, without directions.

    Attributes
    ----------
    t : float
        Time [s].
    y, p, w : Array
        State, parameters and scratch.
    """

    t: float
    y: Array
    p: Array
    w: Array


class Directions(NamedTuple):
    """Directions at an instant, one column each.

    Attributes
    ----------
    y, t, modes : Array, shapes (ny, k), (k,), (numbers of modes, k)
        Of the state, of the time at which the state is taken, and of the numbers of modes.
    """

    y: Array
    t: Array
    modes: Array


class Moments:
    """Emitted functions of a model at single instants.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method, of straight code.
    parameters : Array, shape (np, k)
        Directions of the parameters, one column for each of the k directions.

    Attributes
    ----------
    model : DirectedModel
        The code with directions.
    count : int
        Number k of directions.
    """

    def __init__(self, compiled: CompiledModel, parameters: Array) -> None:
        self.compiled, self._seeds, self.count = compiled, parameters, parameters.shape[1]
        self.model = DirectedModel(compiled, lanes_for_directions(self.count))
        self._p, self._templates = np.zeros(0), list[tuple[Array, Array]]()

    @cached_property
    def _plain(self) -> tuple[Ready, Ready, Ready]:
        law = self.compiled.law_module
        rates, confirm = rate_functions(law)
        return Ready(law.accept, abi.ACCEPT), Ready(rates, abi.RHS), Ready(confirm, abi.RHS)

    @cached_property
    def _directed(self) -> tuple[Any, Any, Any]:
        law = self.compiled.law_module
        rates = form_for_derivatives(law, "rates" if hasattr(law, "rates") else "rhs")
        pairs = (law.accept, abi.ACCEPT), (rates, abi.RHS), (getattr(law, "confirm", rates), abi.RHS)
        accept, rates, confirm = (
            self.model.function(f, timed=True).caller(kind.signature.arguments) for f, kind in pairs
        )
        return accept, rates, confirm

    def place_of_modes(self) -> slice:
        """Return the place of the numbers of modes in the scratch array."""
        if not self.compiled.info.switchable:
            return slice(0, 0)
        first, size = self.compiled.info.sections["modes"]
        return slice(first, first + size)

    def plain(self, now: Moment) -> Moment:
        """Return a state without the directions after its arrays."""
        sizes = self.model.sizes
        return Moment(now.t, now.y[: sizes["y"]], now.p[: sizes["p"]], now.w[: sizes["w"]])

    def rates(self, now: Moment) -> Array:
        """Return the rates of a state without directions."""
        return self.rates_and_scratch(now)[0]

    def rates_and_scratch(self, now: Moment) -> tuple[Array, Array]:
        """Return the rates of a state without directions, and the scratch with what they were computed from."""
        ydot, w = np.zeros(self.model.sizes["y"]), now.w[: self.model.sizes["w"]].copy()
        y, p, iw = now.y[: len(ydot)].copy(), now.p[: self.model.sizes["p"]], self._counters()
        accept, rates, confirm = self._plain
        accept(now.t, y, p, w, iw)
        if rates(now.t, y, p, w, iw, ydot) != 0:
            confirm(now.t, y, p, w, iw, ydot)
        return ydot, w

    @staticmethod
    def _counters() -> NDArray[np.int64]:
        return np.zeros(abi.N_COUNTERS, dtype=np.int64)

    def chunks_of_states(self, now: Moment, by: Directions) -> list[tuple[int, Array, Array, Array]]:
        """Return the first direction, state, parameters and scratch of each part of as many as the code takes.

        Directions of time follow the scratch.
        """
        model, parts = self.model, list[tuple[int, Array, Array, Array]]()
        self._prepare(now)
        lanes, modes, size = model.lanes, self.place_of_modes(), model.sizes["w"]
        for k, (p, template) in enumerate(self._templates):
            first = k * lanes
            y, w = np.zeros(model.sizes["y"] * (1 + lanes)), template.copy()
            y[: model.sizes["y"]], w[:size] = now.y[: model.sizes["y"]], now.w[:size]
            part = by.y[:, first : first + lanes]
            model.directions_after(y, "y")[:, : part.shape[1]] = part
            model.directions_after(w, "w")[modes, : part.shape[1]] = by.modes[:, first : first + lanes]
            w[-lanes:][: part.shape[1]] = by.t[first : first + lanes]
            parts.append((first, y, p, w))
        return parts

    def _prepare(self, now: Moment) -> None:
        """Prepare parameters and masses with directions, which stay the same from one change of inputs to the next."""
        model, p = self.model, now.p[: self.model.sizes["p"]]
        if np.array_equal(p, self._p):
            return
        self._p, self._templates = p.copy(), []
        for first in range(0, self.count, model.lanes):
            room, part = np.zeros((len(p), model.lanes)), self._seeds[:, first : first + model.lanes]
            room[:, : part.shape[1]] = part
            if np.any(part):
                longer = model.parameters(p, room)
                w = model.scratch(longer, now.w[: model.sizes["w"]])
            else:
                longer, w = model.room_with_directions(p, "p"), model.room_with_directions(now.w, "w")
            self._templates.append((longer, np.concatenate([w, np.zeros(model.lanes)])))

    def evaluate_moment(self, function: object, length: int, now: Moment, by: Directions) -> tuple[Array, Array]:
        """Return values and directions of a function that reads no rates, shapes (length,), (length, k)."""
        call, lanes = self._caller_of_function(function, length), self.model.lanes
        slopes, out = self._room_of_moment(length), np.zeros(length * (1 + lanes))
        for first, y, p, w in self.chunks_of_states(now, by):
            call(now.t, y, p, w, np.zeros_like(y), out)
            slopes[:, first : first + lanes] = out[length:].reshape(length, lanes)
        return out[:length].copy(), slopes[:, : self.count]

    def _room_of_moment(self, length: int) -> Array:
        return np.zeros((length, -(-self.count // self.model.lanes) * self.model.lanes))

    def observe(self, function: object, length: int, now: Moment, by: Directions) -> tuple[Array, Array]:
        """Return values and directions of a function that reads rates and multipliers."""
        call, lanes, (accept, rates, confirm) = (
            self._caller_of_function(function, length),
            self.model.lanes,
            self._directed,
        )
        slopes, out = self._room_of_moment(length), np.zeros(length * (1 + lanes))
        iw = self._counters()
        for first, y, p, w in self.chunks_of_states(now, by):
            ydot = np.zeros_like(y)
            accept(now.t, y, p, w, iw)
            if rates(now.t, y, p, w, iw, ydot) != 0:
                confirm(now.t, y, p, w, iw, ydot)
            call(now.t, y, p, w, ydot, out)
            slopes[:, first : first + lanes] = out[length:].reshape(length, lanes)
        return out[:length].copy(), slopes[:, : self.count]

    def _caller_of_function(self, function: object, length: int) -> Any:
        return self.model.function(function, length, timed=True).caller(abi.OBSERVE.signature.arguments)


def modes_of_moment(compiled: CompiledModel, numbers: Array) -> Array:
    """Return the numbers of modes, or directions of them, one line a row, shape (rows, MODE_NUMBERS, ...)."""
    return numbers.reshape(len(compiled.info.switchable), MODE_NUMBERS, *numbers.shape[1:])
