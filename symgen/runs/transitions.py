"""Transitions of rows with bounds: modes at a start, at their events, where inputs, velocities or parameters jump.

A coordinate at rest stays so as long as a force within its bounds keeps it; all of these forces follow from the box
problem (`symgen.runs.box`) on accelerations, which are linear in them. Static bounds hold for coordinates that come to
rest, those in motion for coordinates that have just broken loose; a coordinate that its static bound does not hold
breaks loose too. Rows at rest that other ones determine stay off: the rows in force carry their part.

A stop is closed where its gap is 0 and stays so, by a force that pushes. Stops that strike have impacts first
(`symgen.runs.impacts`).
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
from symgen.describe.friction import MODE, REVERSE, SLIP, STICK
from symgen.describe.stops import HIT, LEAVE, REST
from symgen.layout import abi
from symgen.layout.probe import rate_functions
from symgen.loopcode.entry import direct
from symgen.loopcode.exact import compiled_form
from symgen.runs.box import INSIDE, new_box, solve_box
from symgen.runs.events import Happening
from symgen.runs.impacts import Impacts
from symgen.runs.modes import begin_in_modes

if TYPE_CHECKING:
    from symgen.loops.run_spec import BoundedRows
    from symgen.runs.simulation import Simulation

Array = NDArray[np.float64]
Integers = NDArray[np.int64]
Flags = NDArray[np.bool_]

#: Rates below this part of the largest speed are zero; accelerations below it over those of single forces are.
STILL, NO_ACCELERATION = 1e-10, 1e-10
#: Gaps below this part of the mechanism's length are closed.
TOUCHING = 1e-9
#: A force above this part of its bound is at its bound, where the row has broken loose.
AT_BOUND = 1.0 - 1e-9
#: Rows at rest of which less than this part is independent are determined by others; factors below it are rounding.
DEPENDENT, _NO_FACTOR = 1e-11, 1e-9
#: Assumed step until an adaptive run has chosen one, as a part of the run.
FIRST = 1e-3
#: Places of the numbers of a row.
HELD, CONSTANT, SIGN, LIMIT = range(4)


class Transitions:
    """The modes of a run.

    Parameters
    ----------
    simulation : Simulation
        The run.
    rows : BoundedRows
        Its rows whose forces have bounds.
    """

    def __init__(self, simulation: Simulation, rows: BoundedRows) -> None:
        self.simulation, self.rows = simulation, rows
        info = simulation.compiled.info
        self._places = [info.switchable.index(row) for row in info.bounded]
        self._is_stop = np.arange(len(rows.names)) >= rows.dry
        self._impacts = Impacts(simulation, rows)
        self._closed: Flags | None = None  # stops that a reset has taken out of force

    def _modes(self, w: Array) -> Array:
        """Return the modes of rows with bounds, copied."""
        modes: Array = self.simulation.compiled.modes(w)[self._places]
        return modes

    def begin(self) -> None:
        """Choose modes where a run begins, or goes on after something has changed."""
        state = self.simulation.state
        if state.control[abi.BEGUN] == 1:
            return
        now, y, info = float(state.clock[abi.TIME]), state.y.copy(), self.simulation.compiled.info
        changes = self.choose()
        starts = state.control[abi.BEGUN] == 0 and state.control[abi.STEPS] == 0
        self._note(changes, Happening(now, "", MODE, y[: info.work], y[info.own_states]), starts)

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
        broken, stopped, left = (
            [i for i, name in enumerate(self.rows.names) if f"{name}.{word}" in names]
            for word in (SLIP, REVERSE, LEAVE)
        )
        changes, here = self.choose(broken, stopped, left), replace(happened[0], action=MODE, impact=None, energy=0.0)
        events = self._happened
        events[:] = [event for event in events if event.t != here.t or event.action != MODE]
        self._note(changes, here)

    def release(self, happened: Sequence[Happening]) -> None:
        """Take all rows out of force before a reset: friction has no impulse, and stops strike behind it."""
        if any(event.action == RESET for event in happened):
            modes = self.simulation.compiled.modes(self.simulation.state.w)
            self._closed = self._is_stop & (self._modes(self.simulation.state.w)[:, [HELD, LIMIT]] != 0.0).any(axis=1)
            modes[self._places] = 0.0

    def _note(self, changes: Sequence[tuple[int, str]], here: Happening, starts: bool = False) -> None:
        """Have the past events name impacts and changes of modes; a start has modes, and no change of them."""
        names, impacts, left = self.rows.names, self._impacts.latest, self._impacts.left
        energy = {min(impacts, default=-1): sum({id(x): x.energy for x in impacts.values()}.values())}
        self._happened.extend(
            replace(here, name=f"{names[i]}.{HIT}", impact=impact, energy=energy.get(i, 0.0))
            for i, impact in impacts.items()
        )
        self._happened.extend(
            replace(here, name=f"{names[i]}.{word}", left=left.get(i) if word == REST else None)
            for i, word in changes
            if not starts
        )

    # -- the choice ----------------------------------------------------------------------------------------------------

    def choose(
        self, broken: Sequence[int] = (), stopped: Sequence[int] = (), left: Sequence[int] = ()
    ) -> list[tuple[int, str]]:
        """Choose the modes of the present state; return the rows that change with what they do.

        Parameters
        ----------
        broken, stopped, left : sequence of int
            Coordinates that have just broken loose, or whose rate has just become zero; stops whose force has.

        Raises
        ------
        InputError
            If numbers are undefined, a gap is negative, or forces at rest are not determined well enough to see when
            they break loose.
        """
        simulation, state = self.simulation, self.simulation.state
        before = self._modes(state.w)
        closed = self._is_stop & ((before[:, HELD] != 0.0) | (before[:, LIMIT] != 0.0))
        closed, self._closed = closed if self._closed is None else self._closed, None
        value, rate, static, sliding = self._struck(before)
        still = np.abs(rate) <= STILL * self._scales(abi.SPEED)
        still[[*broken, *stopped]] = True
        still &= ~self._is_stop | (value <= TOUCHING * self._scales(abi.LENGTH))
        loose = still & (before[:, SIGN] != 0.0)
        loose[list(broken)], loose[list(stopped)] = True, False
        group = {i for i in broken if before[i, HELD] != 0.0}
        loose |= self._sharing(before, group)
        loose[list(left)] = True
        signs = np.where(still & ~self._is_stop, 0.0, np.sign(rate))
        signs[self._is_stop] = 0.0
        rest = np.flatnonzero(still)
        signs[rest], matrix, forces = self._solve(rest, signs, static, sliding, loose)
        after = np.zeros_like(before)
        self._hold([int(i) for i in rest], signs, matrix, forces, loose, value, static, before, after)
        after[:, SIGN] = np.where(self._is_stop, 0.0, signs)
        if not np.array_equal(self._modes(state.w), after):
            simulation.compiled.modes(state.w)[self._places] = after
            begin_in_modes(simulation)
        return self._changes(before, after, closed)

    def _changes(self, before: Array, after: Array, closed: Flags) -> list[tuple[int, str]]:
        """Return the rows that change with what they do."""
        words = {(True, False): SLIP, (False, True): STICK, (False, False): REVERSE}
        pairs = list(zip(before[:, SIGN], after[:, SIGN], strict=True))[: self.rows.dry]
        changes = [(i, words[a == 0.0, b == 0.0]) for i, (a, b) in enumerate(pairs) if a != b]
        shut = (after[:, HELD] != 0.0) | (after[:, LIMIT] != 0.0)
        return changes + [
            (int(i), REST if shut[i] else LEAVE) for i in np.flatnonzero(self._is_stop & (shut != closed))
        ]

    def _struck(self, before: Array) -> tuple[Array, Array, Array, Array]:
        """Have stops that strike change the velocities; return coordinates, rates and bounds behind that."""
        state, stops = self.simulation.state, self._is_stop
        self._impacts.latest, self._impacts.left = {}, {}
        value, rate, static, sliding, restitution = self._read(state.w)
        touching = stops & (value <= TOUCHING * self._scales(abi.LENGTH))
        if (touching & (rate < -STILL * self._scales(abi.SPEED))).any():
            rows = np.flatnonzero(touching)
            signs = np.where(stops, 0.0, before[:, SIGN])
            matrix, offset = self._probe(rows, signs, np.zeros(len(stops)))
            modes = self.simulation.compiled.modes(state.w)
            modes[self._places] = 0.0
            own = modes[self._places[0] :]  # rows with bounds stand last
            numbers = rate[rows], restitution[rows - self.rows.dry], offset[rows], matrix[np.ix_(rows, rows)]
            self._impacts.strike(rows.tolist(), *numbers, own)
            value, rate, static, sliding, _ = self._read(state.w)
        return value, rate, static, sliding

    def _sharing(self, modes: Array, group: set[int]) -> Flags:
        """Return which rows at rest share the force of rows in force that have broken loose."""
        owners = modes[:, CONSTANT]
        resting = (modes[:, HELD] == 0.0) & (modes[:, SIGN] == 0.0) & (modes[:, LIMIT] != 0.0)
        result: Flags = resting & np.isin(owners, [float(i) for i in group])
        return result

    def _probe(self, rows: Integers, signs: Array, sliding: Array) -> tuple[Array, Array]:
        """Return G among some rows, and the accelerations without their forces."""
        matrix = np.zeros((len(signs), len(signs)))
        offset = self._accelerations(signs)
        mobility = self._mobility()
        usual = self._usual()
        for j in rows:
            force = sliding[j]
            probe = signs.copy()
            probe[j] = 1.0
            if self._is_stop[j] and mobility[j] > 0.0:  # accelerations as large as those that are there
                probe[j] = -max(abs(float(offset[j])), float(usual[j])) / mobility[j]
                force = -probe[j]
            if force > 0.0:
                matrix[:, j] = (offset - self._accelerations(probe)) / force
        symmetrise(matrix, rows, mobility)
        return matrix, offset

    def _solve(
        self, rest: Integers, signs: Array, static: Array, sliding: Array, loose: Flags
    ) -> tuple[Array, Array, Array]:
        """Return the signs of rows at rest, 0 where they stay at rest, G among all rows, and the forces at rest."""
        k, forces = len(rest), np.zeros(len(signs))
        if k == 0:
            return np.zeros(0), np.zeros((len(signs), len(signs))), forces
        matrix, offset = self._probe(rest, signs, sliding)
        among, stops = matrix[np.ix_(rest, rest)], self._is_stop[rest]
        opening = stops & loose[rest]
        bounds, box = np.where(loose, sliding, static)[rest], new_box(k)
        box.matrix[:], box.offset[:] = among.ravel(), offset[rest]
        while True:
            box.bounds[:] = np.where(stops, 0.0, bounds)
            box.lower[:] = np.where(stops, np.where(opening, 0.0, -np.inf), -bounds)
            find_forces(k, box)
            sizes = np.abs(box.offset) + np.abs(among) @ np.abs(box.forces)
            moves = (box.place != INSIDE) & (np.abs(box.left) > NO_ACCELERATION * sizes)
            over = moves & ~stops & (bounds > sliding[rest])
            back = moves & opening & (box.left < -NO_ACCELERATION * self._usual()[rest])
            if not (over.any() or back.any()):
                break
            bounds, opening = np.where(over, sliding[rest], bounds), opening & ~back
        moves = np.where(stops, moves & (box.left > 0.0), moves)
        moves |= ~stops & loose[rest] & (np.abs(box.forces) >= AT_BOUND * bounds) & (bounds > 0.0)
        forces[rest] = box.forces
        loose[rest] &= ~stops | opening
        direction = np.sign(np.where((box.forces == 0.0) | stops, box.left, box.forces))
        return np.where(moves, direction, 0.0), matrix, forces

    def _hold(
        self,
        rest: list[int],
        signs: Array,
        matrix: Array,
        forces: Array,
        loose: Flags,
        value: Array,
        static: Array,
        before: Array,
        after: Array,
    ) -> None:
        """Put independent rows among those at rest into force; write their constants and largest efforts.

        Stops that push come first: a coordinate that they keep at rest does not slide.
        """
        alone = self._mobility()
        rest = [i for i in rest if matrix[i, i] > DEPENDENT * alone[i] or signs[i] == 0.0]
        left, taken = matrix.copy(), list[int]()

        def independent(i: int) -> float:
            return float(left[i, i] / alone[i]) if alone[i] > 0.0 else 0.0

        least = NO_ACCELERATION * self._usual()
        pushing = [i for i in rest if self._is_stop[i] and -forces[i] * matrix[i, i] > least[i]]
        for waiting in (pushing, rest):
            if waiting is rest:
                signs[[i for i in rest if not self._is_stop[i] and independent(i) <= DEPENDENT]] = 0.0
            while True:
                free = [i for i in waiting if i not in taken and signs[i] == 0.0]
                free = [i for i in free if not (self._is_stop[i] and loose[i])]
                if max(map(independent, free), default=0.0) <= DEPENDENT:
                    break
                best = max(free, key=independent)
                taken.append(best)
                left = left - np.outer(left[:, best], left[best, :]) / left[best, best]
        taken.sort()
        for i in taken:
            held = before[i, HELD] != 0.0
            limit = 0.0 if self._is_stop[i] else static[i]
            after[i] = 1.0, before[i, CONSTANT] if held else value[i], 0.0, limit
        others = [i for i in rest if i not in taken and signs[i] == 0.0 and matrix[i, i] > DEPENDENT * alone[i]]
        others = [i for i in others if not self._is_stop[i] or independent(i) <= DEPENDENT]
        if not others:
            return
        factors = np.linalg.solve(matrix[np.ix_(taken, taken)], matrix[np.ix_(taken, others)])
        for j, i in enumerate(others):
            owners = np.flatnonzero(np.abs(factors[:, j]) > _NO_FACTOR * np.abs(factors[:, j]).max())
            if self._is_stop[i] or all(self._is_stop[taken[o]] for o in owners):
                after[i] = 0.0, -1.0, 0.0, 1.0
                continue
            if len(owners) != 1:
                names = ", ".join(self.rows.names[k] for k in (i, *(taken[o] for o in owners)))
                expected = "dry friction whose forces at rest are determined, or share one direction of motion"
                raise InputError("friction", expected, f"forces of {names} that rest at one time")
            factor = abs(float(factors[owners[0], j]))
            after[i] = 0.0, taken[owners[0]], 0.0, factor * static[i]
            after[taken[owners[0]], LIMIT] += factor * static[i]

    # -- numbers of the present state ----------------------------------------------------------------------------------

    def _read(self, w: Array) -> tuple[Array, Array, Array, Array, Array]:
        """Return coordinates and gaps, their rates, bounds at rest and at the beginning of a motion, restitutions.

        Bounds are those of friction, 0 for stops.
        """
        state, names, dry, k = self.simulation.state, self.rows.names, self.rows.dry, len(self.rows.names)
        out = self.rows.state(float(state.clock[abi.TIME]), state.y, state.p, w, self._rate)
        value, rate, restitution = out[:k], out[k : 2 * k], out[2 * k + 2 * dry :]
        static, sliding = np.zeros(k), np.zeros(k)
        static[:dry], sliding[:dry] = out[2 * k : 2 * k + 2 * dry].reshape(2, -1)
        gaps, closed = value[dry:], TOUCHING * self._scales(abi.LENGTH)[dry:]
        if not (gaps >= -closed).all():
            i = int(np.argmin(gaps >= -closed))
            got = f"{gaps[i]:.6g} at t = {state.clock[abi.TIME]:.6g} s"
            raise InputError(f"stop {names[dry + i]}", "a gap of at least 0", got, "a start within all stops")
        if not ((restitution >= 0.0) & (restitution <= 1.0)).all():
            i = int(np.argmin((restitution >= 0.0) & (restitution <= 1.0)))
            raise InputError(f"stop {names[dry + i]}", "a restitution from 0 to 1", f"{restitution[i]:g}")
        if not (np.isfinite(out).all() and (sliding >= 0.0).all() and (static >= sliding).all()):
            i = int(np.argmin(np.isfinite(static) & np.isfinite(sliding) & (sliding >= 0.0) & (static >= sliding)))
            got = f"{static[i]:g} at rest and {sliding[i]:g} in motion"
            raise InputError(f"friction of {names[i]}", "bounds of at least 0, at rest at least that in motion", got)
        if ((sliding == 0.0) & (static > 0.0)).any():
            i = int(np.argmax((sliding == 0.0) & (static > 0.0)))
            expected = "a bound in motion above 0, as that at rest is above 0"
            raise InputError(f"friction of {names[i]}", expected, "0")
        return value, rate, static, sliding, restitution

    def _scales(self, place: int) -> Array:
        """Return the mechanism's scale of speeds or of lengths in the unit of each row."""
        w, info = self.simulation.state.w, self.simulation.compiled.info
        scale, length = float(w[place]), float(w[abi.LENGTH])
        return np.array([scale / length if info.rows[row].unit == "rad" else scale for row in info.bounded])

    def _usual(self) -> Array:
        """Return the mechanism's scale of accelerations in the unit of each row."""
        w = self.simulation.state.w
        return self._scales(abi.SPEED) * (float(w[abi.SPEED]) / float(w[abi.LENGTH]))

    def _mobility(self) -> Array:
        """Return the acceleration of each coordinate by a force on it if no joints held the bodies."""
        compiled, w = self.simulation.compiled, self._scratch
        jacobian, mass = compiled.jacobian(w)[list(compiled.info.bounded)], compiled.section(w, "mass")
        inverse = np.divide(1.0, mass, out=np.zeros_like(mass), where=mass > 0.0)
        result: Array = jacobian**2 @ inverse
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
        result: Array = self.rows.accelerations(now, self._y, state.p, w, self._rate)
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


def symmetrise(matrix: Array, rows: Integers, mobility: Array) -> None:
    """Make G symmetric among some rows, and 0 for rows that joints hold still, as at a dead centre."""
    among = matrix[np.ix_(rows, rows)]
    among = 0.5 * (among + among.T)
    still = np.diag(among) <= DEPENDENT * mobility[rows]
    among[still], among[:, still] = 0.0, 0.0
    matrix[np.ix_(rows, rows)] = among


def find_forces(k: int, box: Any) -> None:
    """Solve a box problem of forces at rest.

    Raises
    ------
    InputError
        If its solution is not found.
    """
    if compiled_form(solve_box)(k, box) != 0:
        raise InputError("friction", "forces at rest that can be found", "none after many changes")
