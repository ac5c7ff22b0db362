"""The effects of the events of a run, with the data that their loops take."""

from __future__ import annotations

import contextlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.compile.loopcode.exact import compiled_form
from symgen.run.effects.applying import (
    NO_VALUES,
    NO_VELOCITIES,
    EffectChanges,
    EffectWork,
    apply_where_released,
    new_effect_work,
)
from symgen.run.layout.scales import fill_jacobian
from symgen.run.layout.start_records import Instant
from symgen.run.starts.assembler import layout_of_starts
from symgen.run.starts.impulse import ROUNDING, new_impulse, smallest_impulse
from symgen.run.starts.starting import observe_nothing

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel

Array = NDArray[np.float64]
#: No impulses along rows that are off.
NO_KICKS: Mapping[int, float] = MappingProxyType({})


@dataclass(frozen=True)
class Effect:
    """What an event changes.

    Attributes
    ----------
    velocities : tuple of str
        Velocities that get new values.
    writes : tuple of str
        States of the file's own that get new values.
    """

    velocities: tuple[str, ...] = ()
    writes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Impact:
    """Effect of events at one time on a state.

    Attributes
    ----------
    v : Array, shape (nv,)
        Velocities afterwards.
    impulses : Array
        Of each row of D, then of each velocity that was set.
    imposed : tuple of str
        These velocities.
    energy : float
        Change of the energy [J].
    """

    v: Array
    impulses: Array
    imposed: tuple[str, ...]
    energy: float


@dataclass(frozen=True)
class Effects:
    """The effects of the events of a run.

    Attributes
    ----------
    compiled : CompiledModel
        Model and method.
    names : tuple of str
        Names of the events.
    effects : mapping of int to Effect
        By number of the event.
    formulas : emitted function
        Velocities, their new values, values that are written, entries of the mass matrix of bodies, rates of rotors,
        their inertias.
    entries : sequence of (int, int)
        Row and column of each of these entries.
    bodies : int
        Number of velocities of bodies that joints of a tree carry, else 0.
    first : int
        Index of these velocities in the output of the emitted function of bodies.
    rotors : int
        Number of rotors.
    catches : mapping of int to (str, int)
        Of events at which joints that hold for a while catch, the state of the energy that is taken, and the event of
        the release that the state says, -1 for none; the name is empty at releases.
    """

    compiled: CompiledModel
    names: tuple[str, ...]
    effects: Mapping[int, Effect]
    formulas: Any
    entries: Sequence[tuple[int, int]]
    bodies: int = 0
    first: int = 0
    rotors: int = 0
    catches: Mapping[int, tuple[str, int]] = field(default_factory=dict)

    @cached_property
    def losses(self) -> dict[int, int]:
        """By number of an event at which a joint catches, the place in the state of the energy that it takes."""
        info = self.compiled.info
        places = {q.name: info.own_states.start + i for i, q in enumerate(info.states)}
        return {event: places[name] for event, (name, _) in self.catches.items() if name}

    @cached_property
    def changes(self) -> Any:
        """The data of the effects for loops."""
        info = self.compiled.info
        places = {q.name: info.own_states.start + i for i, q in enumerate(info.states)}
        owners = [n for n, effect in self.effects.items() for _ in effect.velocities]
        writes = [(n, places[name]) for n, effect in self.effects.items() for name in effect.writes]
        own = {} if self.bodies else {v.name: i for i, v in enumerate(info.velocities)}
        columns = [own.get(name, -1) for effect in self.effects.values() for name in effect.velocities]
        catches = [[-1, -1] for _ in self.names]
        for event, (_, release) in self.catches.items():
            catches[event] = [self.losses.get(event, -2), release]
        lists = owners, columns, writes, list(self.entries), catches
        numbers = (np.array(x, dtype=np.int64).ravel() for x in lists)
        return EffectChanges._make((self.bodies, self.first, self.rotors, *numbers))

    @cached_property
    def model(self) -> tuple[Any, ...]:
        """First argument of `apply_where_released`."""
        emitted = self.compiled.model
        bodies = emitted.bodies if self.bodies else observe_nothing
        functions = (compiled_form(f) for f in (emitted.geometry, self.formulas, bodies))
        return layout_of_starts(self.compiled), *functions, self.changes

    def memory(self, width: int, nw: int) -> Any:
        """Return working memory for states of `width` numbers and scratch of `nw`; each thread has its own."""
        return new_effect_work(self.model[0], self.changes, width, nw)

    def chosen(self, numbers: Sequence[int]) -> NDArray[np.int64]:
        """Return 1 for each of these events, else 0."""
        return np.isin(np.arange(len(self.names)), numbers).astype(np.int64)

    def apply(self, numbers: Sequence[int], t: float, y: Array, p: Array, w: Array) -> Impact:
        """Change a state by the effects of events at one time.

        Parameters
        ----------
        numbers : sequence of int
            Numbers of the events.
        t : float
            Time [s].
        y, p, w : Array
            State, parameters and scratch; the state and its kinetic energy are written.

        Raises
        ------
        InputError
            If the joints, or other effects, do not allow an effect; nothing is changed then.
        """
        return self.apply_to_state(numbers, t, y, p, w, self.memory(len(y), len(w)))

    def apply_to_state(
        self, numbers: Sequence[int], t: float, y: Array, p: Array, w: Array, work: EffectWork
    ) -> Impact:
        """Change a state as `apply` does; working memory keeps the problem of impulses."""
        info = self.compiled.info
        chosen, before = self.chosen(numbers), y[info.nq : info.work].copy()
        try:
            with np.errstate(all="ignore"):
                code = int(compiled_form(apply_where_released)(self.model, t, Instant(y, p, w), chosen, work))
        except (ArithmeticError, ValueError):  # where nothing is compiled
            code = NO_VELOCITIES
        if code == NO_VALUES:
            raise self.no_values(numbers, chosen, work, t)
        if code == NO_VELOCITIES:
            raise self.no_velocities(numbers, work, before, t)
        return self.impact(numbers, y[info.nq : info.work], work.impulse.impulses, float(work.energy[0]))

    def impact(self, numbers: Sequence[int], v: Array, impulses: Array, energy: float) -> Impact:
        """Return what some events have changed: velocities, impulses (followed by their memory) and energy."""
        labels = self._labels(numbers)
        return Impact(v.copy(), impulses[: self.compiled.info.m + len(labels)].copy(), labels, energy)

    def carried(
        self,
        numbers: Sequence[int],
        t: float,
        y: Array,
        p: Array,
        w: Array,
        known: Impact,
        kicks: Mapping[int, float] = NO_KICKS,
    ) -> Impact:
        """Return an impact of which velocities, and impulses of what events set, are known: rows have the rest.

        Impulses of contacts that slide do not follow from velocities that events set: these push along both of a
        contact's, of which one alone is held. `kicks` has the impulses along rows that are off.
        """
        info, labels, work = self.compiled.info, self._labels(numbers), self.memory(len(y), len(w))
        before, m, n, problem = y[info.nq : info.work].copy(), info.m, info.nv, work.impulse
        with contextlib.suppress(ArithmeticError, ValueError), np.errstate(all="ignore"):
            # for the rows and masses of the problem, whose solution is another one
            compiled_form(apply_where_released)(self.model, t, Instant(y, p, w), self.chosen(numbers), work)
        rows, mass = problem.rows[: (m + len(labels)) * n].reshape(-1, n), problem.mass.reshape(n, n)
        imposed = known.impulses[len(known.impulses) - len(labels) :]
        unit = 1.0 / np.sqrt(np.where(np.diag(mass) > 0.0, np.diag(mass), 1.0))
        left = unit * (mass @ (known.v - before) - rows[m:].T @ imposed)
        whole = np.zeros(m * n)
        compiled_form(fill_jacobian)(self.model[0], work.scratch, whole)
        left -= unit * sum(kick * whole.reshape(m, n)[row] for row, kick in kicks.items())
        own, *_ = np.linalg.lstsq((rows[:m] * unit).T, left, rcond=ROUNDING)
        own[list(kicks)] = list(kicks.values())
        return Impact(known.v, np.concatenate([own, imposed]), labels, known.energy)

    def _labels(self, numbers: Sequence[int]) -> tuple[str, ...]:
        """Return the velocities that some events set."""
        return tuple(name for n in self.effects if n in numbers for name in self.effects[n].velocities)

    def _where(self, numbers: Sequence[int]) -> str:
        names = " and ".join(f"'{self.names[n]}'" for n in numbers)
        return f"event{'s' * (len(numbers) > 1)} {names}: reset"

    def no_values(self, numbers: Sequence[int], chosen: NDArray[np.int64], work: EffectWork, t: float) -> InputError:
        """Return the error on values of states that are not finite, or that differ for one state."""
        writes = [(n, name) for n, effect in self.effects.items() for name in effect.writes]
        values = work.out[2 * len(self.changes.owners) :]
        got = ", ".join(f"{name} = {x:.6g}" for (n, name), x in zip(writes, values, strict=False) if chosen[n])
        return InputError(self._where(numbers), "one finite value of each state", f"{got} at t = {t:.6g} s")

    def no_velocities(self, numbers: Sequence[int], work: EffectWork, v: Array, t: float) -> InputError:
        """Return the error on velocities that cannot be, with the nearest that joints allow."""
        info, problem, labels = self.compiled.info, work.impulse, self._labels(numbers)
        k, n = info.m + len(labels), info.nv
        rows, values = problem.rows[: k * n].reshape(k, n), problem.values[:k]
        mass = problem.mass.reshape(n, n)
        goals, close = (
            ", ".join(f"{label} = {x:.6g}" for label, x in zip(labels, numbers, strict=True))
            for numbers in (values[info.m :], nearest_values(mass, rows, values, v, info.m))
        )
        expected = "velocities that the joints and each other allow"
        return InputError(self._where(numbers), expected, f"{goals} at t = {t:.6g} s", f"the nearest are {close}")


def impulse_along(mass: Array, rows: Array, values: Array, v: Array) -> tuple[Array, Array, bool]:
    """Return the velocities after the smallest impulse along some rows.

    Parameters
    ----------
    mass : Array, shape (nv, nv)
        M.
    rows, values : Array, shapes (k, nv), (k,)
        C and c.
    v : Array, shape (nv,)
        Velocities before.

    Returns
    -------
    v : Array, shape (nv,)
        Velocities afterwards.
    impulses : Array, shape (k,)
        Of each row, in the directions of the rows; of least norm where rows depend on each other.
    contradictory : bool
        Whether ``C v+ - c`` is larger than rounding.
    """
    k, n = len(values), len(v)
    work = new_impulse(n, k)
    work.mass[:], work.rows[:], work.values[:] = mass.ravel(), rows.ravel(), values
    contradictory = compiled_form(smallest_impulse)(n, k, np.array(v, dtype=np.float64), work) != 0
    return work.after.copy(), work.impulses.copy(), contradictory


def nearest_values(mass: Array, rows: Array, values: Array, v: Array, count: int) -> Array:
    """Return the values of the last rows nearest to the wanted ones, while the first rows hold exactly.

    Velocities with the wanted values change by as little as possible, measured by the last rows.

    Parameters
    ----------
    mass, rows, values, v
        As for `impulse_along`.
    count : int
        Number of the first rows, those of joints.
    """
    own = rows[count:]
    free = impulse_along(mass, own, values[count:], v)[0]
    return np.asarray(own @ impulse_along(own.T @ own, rows[:count], values[:count], free)[0])
