"""Directions of a motion that drivers prescribe: derivatives of its states by parameters, by implicit functions.

Nothing is integrated: positions satisfy Phi(t, q, p) = 0, so that D dq = -Phi_p, and velocities D v = nu, so that
D dv = dnu - dD v. Both right sides come from ``geometry`` with directions; rates and multipliers with directions from
the law.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from symgen.base.vocabulary.rotations import composed_rotation
from symgen.run.directions.directed_model import DirectedModel, Seeds
from symgen.run.directions.directed_observer import Observer
from symgen.run.layout import abi
from symgen.run.layout.probe import rate_functions
from symgen.run.layout.records import Outputs
from symgen.run.single.new_state import model_sizes
from symgen.run.single.observe import observe_scratch, observe_with_rates

if TYPE_CHECKING:
    from symgen.run.layout.compiled import ModelInfo
    from symgen.run.starts.assembly import Start

Array = NDArray[np.float64]

#: Rates of Euler parameters in unit orientation by unit angular velocities.
_HALVES = (0.0, 0.5, 0.0, 0.0), (0.0, 0.0, 0.5, 0.0), (0.0, 0.0, 0.0, 0.5)
#: Singular values of D below this part of the largest one count as zero, where rows repeat others.
_CUTOFF = 1e-9


class DrivenStates(NamedTuple):
    """A motion that was followed: arrays with one row a time, `status` as of `symgen.run.single.outcome.Motion`."""

    times: Array
    states: Array
    status: Array


@dataclass(frozen=True)
class DrivenDirections:
    """Directions of a motion that drivers prescribe.

    Parameters
    ----------
    model : DirectedModel
        The code.
    start : Start
        The start, with the parameters of the whole motion.
    motion : DrivenStates
        The motion.
    seeds : Array, shape (np, n)
        Directions of the parameters.
    """

    model: DirectedModel
    start: Start
    motion: DrivenStates
    seeds: Array

    @property
    def count(self) -> int:
        """Number of directions."""
        return int(self.seeds.shape[1])

    @property
    def info(self) -> ModelInfo:
        """Names and sizes of the model."""
        return self.model.plain.info

    @cached_property
    def _parts(self) -> list[tuple[Array, Array]]:
        """Parameters, and scratch at the start, with as many directions as the code takes."""
        nothing, parts = np.zeros((1, self.count)), list[tuple[Array, Array]]()
        for first in range(0, self.count, self.model.lanes):
            own = Seeds(nothing, self.seeds).seeds_of_part(first, self.model.lanes)
            p = self.model.parameters(self.start.p, own.p)
            parts.append((p, self.model.scratch(p, self.start.w)))
        return parts

    @cached_property
    def _longer(self) -> list[Array]:
        """States with directions, shape (k, longer ny), for each part."""
        return [*self._states_with_directions()]

    @cached_property
    def states(self) -> Array:
        """Directions of the states, shape (k, ny, n)."""
        parts = [self.model.directions_after(states, "y") for states in self._longer]
        return np.concatenate(parts, axis=-1)[..., : self.count]

    def observe(self, function: object, length: int) -> tuple[Array, Array]:
        """Return the values of a function of the motion and their directions, shapes (k, length), (k, length, n).

        Parameters
        ----------
        function : compiled function
            Of type `symgen.run.layout.abi.OBSERVE`.
        length : int
            Number of values that it writes.
        """
        model, law, k = self.model, self.model.whole.law_module, len(self.motion.times)
        sizes, iw = model_sizes(model.whole), np.zeros(abi.N_COUNTERS, dtype=np.int64)
        code: Any = (sizes, *rate_functions(law), law.accept, model.function(function, length))
        values, parts = np.zeros((k, length)), list[Array]()
        for states, (p, w) in zip(self._longer, self._parts, strict=True):
            rows = np.zeros((k, length * (1 + model.lanes)))
            outputs = Outputs(self.motion.times, states, self.motion.status)
            observe_with_rates(code, outputs, p, w.copy(), iw, rows, np.zeros(2 * sizes.ny + rows.shape[1]))
            values = rows[:, :length]
            parts.append(rows[:, length:].reshape(k, length, model.lanes))
        return values, np.concatenate(parts, axis=-1)[..., : self.count]

    def energies(self) -> Array:
        """Return the directions of kinetic and potential energy, shape (k, 2, n)."""
        windings, parts = self.motion.status[:, abi.N_STATUS :], list[Array]()
        for states, (p, w) in zip(self._longer, self._parts, strict=True):
            observer = Observer(self.model, self.motion.times, states, windings, ((np.inf, p),), w)
            parts.append(observer.observe_energies())
        return np.concatenate(parts, axis=-1)[..., : self.count]

    # -- states --------------------------------------------------------------------------------------------------------

    def _states_with_directions(self) -> Iterator[Array]:
        model, info, motion = self.model, self.info, self.motion
        k, own, lanes = len(motion.times), info.ny, model.lanes
        v = motion.states[:, info.nq : info.work]
        for p, w in self._parts:
            states = np.zeros((k, own * (1 + lanes)))
            states[:, :own] = motion.states[:, :own]
            directions = model.directions_after(states, "y")  # a view
            (entries,), (violated,) = self._scratch(states, p, w, ("jacobian",), ("residual",))
            inverse = self._inverses(self._matrices(entries, True))
            directions[:, : info.nq] = self._coordinates(motion.states, -(inverse @ violated))
            _, (slopes, nu) = self._scratch(states, p, w, (), ("jacobian", "nu"))
            changed = np.einsum("kijl,kj->kil", self._matrices(slopes, False), v)
            directions[:, info.nq : info.work] = inverse @ (nu - changed)
            yield states

    def _scratch(
        self, states: Array, p: Array, w: Array, plain: tuple[str, ...], directed: tuple[str, ...]
    ) -> tuple[list[Array], list[Array]]:
        """Return sections of the scratch after ``geometry``, and the directions of sections, shape (k, size, L)."""
        model, sections, lanes = self.model, self.info.sections, self.model.lanes
        plain_size, places = model.sizes["w"], list[int]()
        for name in plain:
            places += sections[name]
        for name in directed:
            first, size = sections[name]
            places += (plain_size + first * lanes, size * lanes)
        rows = np.zeros((len(states), sum(places[1::2])))
        outputs = Outputs(self.motion.times, states, self.motion.status)
        sizes, where = model_sizes(model.whole), np.array(places, dtype=np.int64)
        observe_scratch(model.whole.model.geometry, sizes, outputs, p, w.copy(), where, rows, np.zeros(sizes.ny))
        pieces = np.split(rows, np.cumsum(places[1::2])[:-1], axis=1)
        return pieces[: len(plain)], [x.reshape(len(states), -1, lanes) for x in pieces[len(plain) :]]

    def _matrices(self, entries: Array, whole: bool) -> Array:
        """Return D at all times from its entries that vary, or its directions, which constant entries have none of."""
        info = self.info
        d = np.zeros((len(entries), info.m, info.nv, *entries.shape[2:]))
        for row, column, number, slot in info.jacobian:
            if slot is not None:
                d[:, row, column] = entries[:, slot]
            elif whole:
                d[:, row, column] = number or 0.0
        return d

    def _inverses(self, d: Array) -> Array:
        """Return the inverse of D at all times; the pseudo-inverse where rows repeat others."""
        if self.info.m == self.info.nv and not self.start.redundant_rows:
            return np.asarray(np.linalg.inv(d), dtype=np.float64)
        return np.asarray(np.linalg.pinv(d, rcond=_CUTOFF))

    def _coordinates(self, states: Array, along: Array) -> Array:
        """Return the directions of coordinates from those along velocities: N dv."""
        info = self.info
        if info.nq == info.nv:
            return along
        result = np.zeros((len(states), info.nq, along.shape[2]))
        euler, spun = set[int](), set[int]()
        for first, at in info.spins:
            euler |= {*range(first, first + 4)}
            spun |= {*range(at, at + 3)}
            e: Any = tuple(states[:, first : first + 4].T)
            for k, half in enumerate(_HALVES):
                turned = np.column_stack(composed_rotation(e, half))
                result[:, first : first + 4] += turned[:, :, np.newaxis] * along[:, at + k, np.newaxis]
        places = [i for i in range(info.nq) if i not in euler]
        result[:, places] = along[:, [j for j in range(info.nv) if j not in spun]]
        return result
