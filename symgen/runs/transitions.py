"""Transitions of dry friction: modes at a start, at events of modes, and where inputs, velocities or parameters jump.

A coordinate at rest stays so as long as a force within its bounds keeps it; all of these forces follow from the box
problem (`symgen.runs.box`) on accelerations, which are linear in them. Static bounds hold for coordinates that come to
rest, those in motion for coordinates that have just broken loose; a coordinate that its static bound does not hold
breaks loose too. Rows at rest that other ones determine stay off: the rows in force carry their part.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.describe.events import RESET
from symgen.describe.friction import JAM, MODE, REVERSE, SLIP, STICK
from symgen.layout import abi
from symgen.layout.probe import rate_functions
from symgen.loopcode.entry import direct
from symgen.loopcode.exact import compiled_form
from symgen.runs.box import INSIDE, new_box, solve_box
from symgen.runs.events import Happening
from symgen.runs.modes import begin_in_modes

if TYPE_CHECKING:
    from symgen.loops.run_spec import DryFrictions
    from symgen.runs.simulation import Simulation

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

#: Rates below this part of the largest speed are zero; accelerations below it over those of single forces are.
STILL, NO_ACCELERATION = 1e-10, 1e-10
#: A force above this part of its bound is at its bound, where the row has broken loose.
_AT_BOUND = 1.0 - 1e-9
#: Rows at rest of which less than this part is independent are determined by others; factors below it are rounding.
DEPENDENT, _NO_FACTOR = 1e-11, 1e-9
#: Bounds by reactions agree within this part of them, after so many solutions at most.
_AGREED, _AGREEMENTS = 1e-14, 2000
#: Assumed step until an adaptive run has chosen one, as a part of the run.
FIRST = 1e-3
#: Places of the numbers of a row.
HELD, CONSTANT, SIGN, LIMIT = range(4)


class Transitions:
    """The dry friction of a run.

    Parameters
    ----------
    simulation : Simulation
        The run.
    frictions : DryFrictions
        Its dry friction.
    """

    def __init__(self, simulation: Simulation, frictions: DryFrictions) -> None:
        self.simulation, self.frictions = simulation, frictions
        info = simulation.compiled.info
        self._places = [info.switchable.index(row) for row in info.bounded]

    def _modes(self, w: Array) -> Array:
        """Return the modes of rows of friction, copied."""
        modes: Array = self.simulation.compiled.modes(w)[self._places]
        return modes

    def begin(self) -> None:
        """Choose modes where a run begins, or goes on after something has changed."""
        state = self.simulation.state
        if state.control[abi.BEGUN] == 1:
            return
        changes, info = self.choose((), ()), self.simulation.compiled.info
        if state.control[abi.BEGUN] == 0 and state.control[abi.STEPS] == 0:  # a start has modes, and no change of them
            return
        now, y = float(state.clock[abi.TIME]), state.y.copy()
        self._happened.extend(
            Happening(now, f"{name}.{word}", MODE, y[: info.work], y[info.own_states]) for name, word in changes
        )

    @property
    def _happened(self) -> list[Happening]:
        """Past events of the run."""
        events = self.simulation.events
        assert events is not None, "modes have events"
        return events.happened

    def meet(self, happened: Sequence[Happening]) -> None:
        """Choose modes at the events at which a loop ended.

        Parameters
        ----------
        happened : sequence of Happening
            Events at the present time.
        """
        names = [event.name for event in happened if event.action == MODE]
        if not names and all(event.action != RESET for event in happened):
            return
        broken, stopped = (
            [i for i, name in enumerate(self.frictions.names) if f"{name}.{word}" in names] for word in (SLIP, REVERSE)
        )
        for i, name in enumerate(self.frictions.names):
            if f"{name}.{JAM}" in names:
                self._refuse_jam(i, 1.0)
        self._note(self.choose(broken, stopped))

    def release(self, happened: Sequence[Happening]) -> None:
        """Take all rows out of force before a reset: forces with bounds have no impulse."""
        if any(event.action == RESET for event in happened):
            self.simulation.compiled.modes(self.simulation.state.w)[self._places] = 0.0

    def _note(self, changes: Sequence[tuple[str, str]]) -> None:
        """Have the past events name the changes of modes at the present time."""
        happened, now = self._happened, float(self.simulation.state.clock[abi.TIME])
        first = len(happened)
        while first > 0 and happened[first - 1].t == now:
            first -= 1
        here = happened[first:]
        others = [event for event in here if event.action != MODE]
        named = [replace(here[0], name=f"{name}.{word}", action=MODE, impact=None) for name, word in changes]
        happened[first:] = [*others, *named]

    # -- the choice ----------------------------------------------------------------------------------------------------

    def choose(self, broken: Sequence[int], stopped: Sequence[int]) -> list[tuple[str, str]]:
        """Choose the modes of the present state; return the names of coordinates that change with what they do.

        Parameters
        ----------
        broken, stopped : sequence of int
            Coordinates that have just broken loose, or whose rate has just become zero.

        Raises
        ------
        InputError
            If bounds are undefined, or forces at rest are not determined well enough to see when they break loose.
        """
        simulation, state = self.simulation, self.simulation.state
        self._refuse_redundant(state.w)
        before = self._modes(state.w)
        value, rate, static, sliding = self._read(state.w)
        still = np.abs(rate) <= STILL * self._speeds(state.w)
        still[[*broken, *stopped]] = True
        loose = still & (before[:, SIGN] != 0.0)
        loose[list(broken)], loose[list(stopped)] = True, False
        group = {i for i in broken if before[i, HELD] != 0.0}
        loose |= self._sharing(before, group)
        signs = np.where(still, 0.0, np.sign(rate))
        rest = np.flatnonzero(still)
        signs[rest], matrix = self._solve(rest, signs, static, sliding, loose)
        after = np.zeros_like(before)
        after[:, SIGN] = signs
        self._hold([int(i) for i in rest if signs[i] == 0.0], matrix, value, static, before, after)
        if not np.array_equal(before, after):
            simulation.compiled.modes(state.w)[self._places] = after
            begin_in_modes(simulation)
        words = {(True, False): SLIP, (False, True): STICK, (False, False): REVERSE}
        pairs = zip(self.frictions.names, before[:, SIGN], after[:, SIGN], strict=True)
        return [(name, words[a == 0.0, b == 0.0]) for name, a, b in pairs if a != b]

    def _sharing(self, modes: Array, group: set[int]) -> Array:
        """Return which rows at rest share the force of rows in force that have broken loose."""
        owners = modes[:, CONSTANT]
        resting = (modes[:, HELD] == 0.0) & (modes[:, SIGN] == 0.0) & (modes[:, LIMIT] != 0.0)
        result: Array = resting & np.isin(owners, [float(i) for i in group])
        return result

    def _solve(self, rest: Integers, signs: Array, static: Array, sliding: Array, loose: Array) -> tuple[Array, Array]:
        """Return the signs of coordinates at rest, 0 where they stay at rest, and G among all of them.

        Bounds by reactions follow the forces, which follow the bounds, until both agree; `static` and `sliding` of
        these coordinates become bounds.
        """
        k, size, pressed = len(rest), len(signs), list(self.frictions.pressed)
        matrix = np.zeros((size, size))
        if k == 0 and not pressed:
            return np.zeros(0), matrix
        moving = [i for i in pressed if signs[i] != 0.0]
        plain = np.where(np.isin(np.arange(size), pressed), 0.0, signs)
        offset, alone = self._accelerations(plain), self._reactions()
        parts = np.zeros((*alone.shape, size))
        for j in (*rest, *moving):
            if sliding[j] > 0.0:
                probe, force = plain.copy(), 1.0 if j in pressed else sliding[j]
                probe[j] = 0.0 if j in pressed else 1.0
                matrix[:, j] = (offset - self._accelerations(probe, j if j in pressed else None)) / force
                parts[:, :, j] = (alone - self._reactions()) / force
        for i in pressed:
            self._refuse_jam(i, float((sliding if i in moving else static)[i] * np.linalg.norm(parts[i, :, i])))
        if k == 0:
            return np.zeros(0), matrix
        among = matrix[np.ix_(rest, rest)]
        among = 0.5 * (among + among.T)
        fixed = np.diag(among) <= DEPENDENT * self._mobility()[rest]  # as at a dead centre
        among[fixed], among[:, fixed] = 0.0, 0.0
        coefficients, box, forces = np.where(loose, sliding, static)[rest], new_box(k), np.zeros(size)
        size_of = np.ones(size)
        size_of[pressed] = np.where(signs[pressed] == 0.0, np.inf, np.linalg.norm(alone[pressed], axis=1))
        box.matrix[:] = among.ravel()
        for _ in range(_AGREEMENTS):
            forces[moving] = signs[moving] * sliding[moving] * size_of[moving]
            bounds = np.where(coefficients > 0.0, coefficients, 0.0)
            np.multiply(bounds, size_of[rest], out=bounds, where=bounds > 0.0)
            box.bounds[:], box.offset[:] = bounds, offset[rest] - matrix[rest][:, moving] @ forces[moving]
            if compiled_form(solve_box)(k, box) != 0:
                raise InputError("friction", "forces at rest that can be found", "none after many changes")
            forces[rest] = box.forces
            before = size_of.copy()
            size_of[pressed] = np.linalg.norm(alone[pressed] - parts[pressed] @ forces, axis=1)
            if (np.abs(size_of - before) > _AGREED * size_of).any():
                continue
            sizes = np.abs(box.offset) + np.abs(among) @ np.abs(box.forces)
            moves = (box.place != INSIDE) & (np.abs(box.left) > NO_ACCELERATION * sizes)
            over = moves & (coefficients > sliding[rest])
            if not over.any():
                break
            coefficients = np.where(over, sliding[rest], coefficients)
        else:
            names = ", ".join(self.frictions.names[i] for i in pressed)
            raise InputError("friction", "bounds and reactions that agree", f"others at {names} after many changes")
        moves |= loose[rest] & (np.abs(box.forces) >= _AT_BOUND * bounds) & (bounds > 0.0)
        matrix[np.ix_(rest, rest)] = among
        direction = np.sign(np.where(box.forces == 0.0, box.left, box.forces))
        static[pressed], sliding[pressed] = static[pressed] * size_of[pressed], sliding[pressed] * size_of[pressed]
        return np.where(moves, direction, 0.0), matrix

    def _refuse_redundant(self, w: Array) -> None:
        """Refuse friction by reactions where rows depend on others: reactions are not determined."""
        info, mask = self.simulation.compiled.info, self.simulation.compiled.section(w, "mask")
        rows = [info.rows[i].name for i in range(info.m) if mask[i] != 0.0 and i not in info.bounded]
        if rows and self.frictions.pressed:
            names = ", ".join(self.frictions.names[i] for i in self.frictions.pressed)
            expected = "rows that determine all reactions, where friction depends on one"
            raise InputError(f"friction of {names}", expected, f"{', '.join(rows)}, which other rows determine")

    def _refuse_jam(self, i: int, number: float) -> None:
        """Refuse friction that alone brings about all of its reaction: accelerations are none, or not unique."""
        if not number < 1.0:
            now, name = float(self.simulation.state.clock[abi.TIME]), self.frictions.names[i]
            expected = "friction that brings about less than all of its own reaction (a jamming number below 1)"
            raise InputError(f"friction of {name}", expected, f"{number:.12g} at t = {now:.9g} s")

    def _hold(self, rest: list[int], matrix: Array, value: Array, static: Array, before: Array, after: Array) -> None:
        """Put independent rows among those at rest into force; write their constants and largest efforts."""
        alone = self._mobility()
        left, taken = matrix.copy(), list[int]()
        while True:
            waiting = [i for i in rest if i not in taken]
            shares = [left[i, i] / alone[i] if alone[i] > 0.0 else 0.0 for i in waiting]
            if max(shares, default=0.0) <= DEPENDENT:
                break
            best = waiting[int(np.argmax(shares))]
            taken.append(best)
            left = left - np.outer(left[:, best], left[best, :]) / left[best, best]
        taken.sort()
        for i in taken:
            held, limit = before[i, HELD] != 0.0, 0.0 if i in self.frictions.pressed else static[i]
            after[i] = 1.0, before[i, CONSTANT] if held else value[i], 0.0, limit
        others = [i for i in rest if i not in taken and matrix[i, i] > DEPENDENT * alone[i]]
        if not others:
            return
        pressed = set(rest) & set(self.frictions.pressed)
        if pressed and (self.frictions.changes or self._moves(taken)):
            names = ", ".join(self.frictions.names[i] for i in rest)
            expected = "friction by reactions whose forces at rest are determined, or that rests for good"
            raise InputError("friction", expected, f"{names} at rest at one time, beside what changes")
        for i in pressed & set(taken):
            after[i, LIMIT] = static[i]
        factors = np.linalg.solve(matrix[np.ix_(taken, taken)], matrix[np.ix_(taken, others)])
        for j, i in enumerate(others):
            owners = np.flatnonzero(np.abs(factors[:, j]) > _NO_FACTOR * np.abs(factors[:, j]).max())
            if len(owners) != 1:
                names = ", ".join(self.frictions.names[k] for k in (i, *(taken[o] for o in owners)))
                expected = "dry friction whose forces at rest are determined, or share one direction of motion"
                raise InputError("friction", expected, f"forces of {names} that rest at one time")
            factor = abs(float(factors[owners[0], j]))
            after[i] = 0.0, taken[owners[0]], 0.0, 0.0 if i in self.frictions.pressed else factor * static[i]
            after[taken[owners[0]], LIMIT] += factor * static[i]

    # -- numbers of the present state ----------------------------------------------------------------------------------

    def _read(self, w: Array) -> tuple[Array, Array, Array, Array]:
        """Return coordinates, their rates, and bounds at rest and at the beginning of a motion."""
        state = self.simulation.state
        out = self.frictions.state(float(state.clock[abi.TIME]), state.y, state.p, w, self._rate)
        value, rate, static, sliding = out.reshape(4, -1)
        if not (np.isfinite(out).all() and (sliding >= 0.0).all() and (static >= sliding).all()):
            names = self.frictions.names
            i = int(np.argmin(np.isfinite(static) & np.isfinite(sliding) & (sliding >= 0.0) & (static >= sliding)))
            got = f"{static[i]:g} at rest and {sliding[i]:g} in motion"
            raise InputError(f"friction of {names[i]}", "bounds of at least 0, at rest at least that in motion", got)
        if ((sliding == 0.0) & (static > 0.0)).any():
            i = int(np.argmax((sliding == 0.0) & (static > 0.0)))
            expected = "a bound in motion above 0, as that at rest is above 0"
            raise InputError(f"friction of {self.frictions.names[i]}", expected, "0")
        return value, rate, static, sliding

    def _speeds(self, w: Array) -> Array:
        """Return the speed in the unit of each coordinate that counts as fast."""
        speed, length = float(w[abi.SPEED]), float(w[abi.LENGTH])
        rows = self.simulation.compiled.info.rows
        units = [rows[row].unit for row in self.simulation.compiled.info.bounded]
        return np.array([speed / length if unit == "rad" else speed for unit in units])

    def _moves(self, taken: Sequence[int]) -> bool:
        """Return whether the mechanism can move with the rows of some coordinates at rest in force."""
        compiled, w = self.simulation.compiled, self._scratch
        info = compiled.info
        rows = [i for i in range(info.m) if i not in info.bounded] + [info.bounded[i] for i in taken]
        mass = compiled.section(w, "mass")
        weights = np.divide(1.0, np.sqrt(mass), out=np.ones_like(mass), where=mass > 0.0)
        return bool(np.linalg.matrix_rank(compiled.jacobian(w)[rows] * weights, DEPENDENT) < info.nv)

    def _mobility(self) -> Array:
        """Return the acceleration of each coordinate by a force on it if no joints held the bodies."""
        compiled, w = self.simulation.compiled, self._scratch
        jacobian, mass = compiled.jacobian(w)[list(compiled.info.bounded)], compiled.section(w, "mass")
        inverse = np.divide(1.0, mass, out=np.zeros_like(mass), where=mass > 0.0)
        result: Array = jacobian**2 @ inverse
        return result

    def _reactions(self) -> Array:
        """Return the components of reactions after `_accelerations`, of all coordinates."""
        frictions, state = self.frictions, self.simulation.state
        result = np.zeros((len(frictions.names), 2))
        if frictions.reactions is not None:
            now = float(state.clock[abi.TIME])
            forces = frictions.reactions(now, self._y, state.p, self._scratch, self._rate)
            result[list(frictions.pressed)] = forces.reshape(-1, 2)
        return result

    def _accelerations(self, signs: Array, pushed: int | None = None) -> Array:
        """Return the accelerations of coordinates with all rows off and efforts of some signs.

        A coordinate whose bounds depend on a reaction may be `pushed` by a force of -1.
        """
        state, now = self.simulation.state, float(self.simulation.state.clock[abi.TIME])
        w = self._scratch
        w[:] = state.w
        modes = self.simulation.compiled.modes(w)
        modes[self._places] = 0.0
        modes[self._places, SIGN] = signs
        if pushed is not None:
            modes[self._places[pushed], LIMIT] = 1.0
        if w[abi.STEP_STATUS] == 0.0:  # of laws whose gains follow the step, before the first one
            span = self.simulation.span
            w[abi.STEP_STATUS] = span.step if span.step > 0.0 else FIRST * span.duration
        self._y[:] = state.y
        self._counters[:] = state.iw
        rates, confirm = self._rates
        if rates(now) != 0:
            confirm(now)
        state.control[abi.EVALUATIONS] += 1
        result: Array = self.frictions.accelerations(now, self._y, state.p, w, self._rate)
        if not np.isfinite(result).all():
            raise InputError("friction", "accelerations that are finite", f"others at t = {now:.6g} s")
        return result

    @cached_property
    def _scratch(self) -> Array:
        return np.array(self.simulation.state.w)

    @cached_property
    def _y(self) -> Array:
        return np.array(self.simulation.state.y)

    @cached_property
    def _rate(self) -> Array:
        return np.zeros_like(self.simulation.state.y)

    @cached_property
    def _counters(self) -> Integers:
        return np.array(self.simulation.state.iw)

    @cached_property
    def _rates(self) -> tuple[Any, Any]:
        arrays = 0.0, self._y, self.simulation.state.p, self._scratch, self._counters, self._rate
        first, second = (direct(f, abi.RHS, *arrays) for f in rate_functions(self.simulation.compiled.law_module))
        return first, second
