"""Transitions of rows with bounds: modes at a start, at their events, where inputs, velocities or parameters jump.

A coordinate at rest stays so as long as a force within its bounds keeps it; all of these forces follow from the box
problem (`symgen.run.modes.box`) on accelerations, which are linear in them. Static bounds hold for coordinates that
come to rest, those in motion for coordinates that have just broken loose; a coordinate that its static bound does not
hold breaks loose too. Rows at rest that other ones determine stay off: the rows in force carry their part.

A one-sided row is in force where its gap is 0 and stays so, by a force that pushes. Gaps that strike have impacts first
(`symgen.run.single.impacts`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.compile.loopcode.entry import direct
from symgen.compile.loopcode.exact import compiled_form, plain_form
from symgen.describe.bounds.modes import HIT, LEAVE, MODE, REST, REVERSE, SLIP, STICK
from symgen.describe.parts.events import RESET
from symgen.run.layout import abi
from symgen.run.layout.probe import rate_functions
from symgen.run.modes import choice, strikes
from symgen.run.modes.bounded_rows import (
    DEEP,
    HELD,
    LIMIT,
    NO_FORCES,
    NOT_DETERMINED,
    NOT_FINITE,
    OTHERS,
    SAME,
    SIGN,
    TOUCHING,
    first_step,
    new_choice,
    put_off,
    stays_shut,
)
from symgen.run.single.events import Happening
from symgen.run.single.impacts import Impacts
from symgen.run.single.modes import begin_in_modes

if TYPE_CHECKING:
    from symgen.run.loops.run_spec import BoundedRows
    from symgen.run.single.simulation import Simulation

Array = NDArray[np.float64]
Integers = NDArray[np.int64]
Flags = NDArray[np.bool_]


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
        self._pushes = np.arange(len(rows.names)) >= rows.dry
        self.impacts = Impacts(simulation, rows)
        self._closed: Flags | None = None  # one-sided rows that a reset has taken out of force
        self._entries = dict[str, Any]()

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
        self._choice.depth[0] = TOUCHING if state.control[abi.BEGUN] == 0 else DEEP
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
        self._choice.depth[0] = np.inf  # positions inside a run are what its steps have made of them
        changes, here = self.choose(broken, stopped, left), replace(happened[0], action=MODE, impact=None, energy=0.0)
        events = self._happened
        events[:] = [event for event in events if event.t != here.t or event.action != MODE]
        self._note(changes, here)

    def release(self, happened: Sequence[Happening]) -> None:
        """Take all rows out of force before a reset: two bounds have no impulse, and gaps strike behind it."""
        if any(event.action == RESET for event in happened):
            self.take_off()

    def take_off(self) -> None:
        """Take all rows out of force, where closed gaps may strike."""
        w = self.simulation.state.w
        self._closed = self._pushes & (self._modes(w)[:, [HELD, LIMIT]] != 0.0).any(axis=1)
        compiled_form(put_off)(self._choice, w)

    def _note(self, changes: Sequence[tuple[int, str]], here: Happening, starts: bool = False) -> None:
        """Have the past events name impacts and changes of modes; a start has modes, and no change of them."""
        names, impacts, left = self.rows.names, self.impacts.latest, self.impacts.left
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
            Coordinates that have just broken loose, or whose rate has just become zero; one-sided rows whose force has.

        Raises
        ------
        InputError
            If numbers are undefined, a gap is negative, or forces at rest are not determined well enough to see when
            they break loose.
        """
        c, w = self._choice, self.simulation.state.w
        before = self._modes(w)
        closed = self._pushes & ((before[:, HELD] != 0.0) | (before[:, LIMIT] != 0.0))
        closed, self._closed = closed if self._closed is None else self._closed, None
        for flags, rows in ((c.broken, broken), (c.stopped, stopped), (c.left, left)):
            flags[:] = 0
            flags[list(rows)] = 1
        self._strike()
        self._take_modes()
        if self.impacts.latest and self.impacts.gather(c):
            self._read()
            for flags in (c.broken, c.stopped, c.left):
                flags[:] = 0
            self._take_modes()
        return self._changes(before, self._modes(w), closed)

    def _take_modes(self) -> None:
        """Choose modes at a state whose rows have been read, and have the run go on in them."""
        state: Any = self.simulation.state  # an `EventState`: modes have events
        others = self._chosen()
        compiled_form(choice.measure_margins)(self._choice, state.w, state.hunt)
        if others:
            begin_in_modes(self.simulation, self._entry("follow_modes"))
        elif state.control[abi.BEGUN] == 1:  # margins sleep anew
            state.control[abi.BEGUN] = abi.ONWARD

    def _chosen(self) -> bool:
        """Choose modes at a state whose rows have been read; return whether they are others."""
        code = self._entry("choose_modes")(self._now)
        self._refuse(code)
        return bool(code == OTHERS)

    def _refuse(self, code: int) -> None:
        """Refuse a state for which a function has found no modes."""
        if code == NOT_FINITE:
            self._refuse_accelerations()
        if code == NO_FORCES:
            raise InputError(self.rows.kinds[0], "forces at rest that can be found", "none after many changes")
        if code == NOT_DETERMINED:
            self._refuse_undetermined()

    def _refuse_accelerations(self) -> None:
        raise InputError(self.rows.kinds[0], "accelerations that are finite", f"others at t = {self._now:.6g} s")

    def _refuse_undetermined(self) -> None:
        """Refuse forces at rest of which several carry one that other rows determine."""
        expected = f"{self.rows.nouns[0]} whose forces at rest are determined, or share one direction of motion"
        raise InputError(self.rows.kinds[0], expected, f"forces of {self._named()} that rest at one time")

    def _named(self) -> str:
        """Return the names of the rows that a function has left to be named."""
        named = self._choice.named
        return ", ".join(self.rows.names[i] for i in named[: int(np.argmax([*(named < 0), True]))])

    def _changes(self, before: Array, after: Array, closed: Flags) -> list[tuple[int, str]]:
        """Return the rows that change with what they do."""
        words = {(True, False): SLIP, (False, True): STICK, (False, False): REVERSE}
        pairs = list(zip(before[:, SIGN], after[:, SIGN], strict=True))[: self.rows.dry]
        changes = [(i, words[a == 0.0, b == 0.0]) for i, (a, b) in enumerate(pairs) if a != b]
        shut = (after[:, HELD] != 0.0) | (after[:, LIMIT] != 0.0)
        return changes + [(int(i), REST if shut[i] else LEAVE) for i in np.flatnonzero(self._pushes & (shut != closed))]

    def _strike(self) -> None:
        """Read the rows, and have gaps that strike change the velocities."""
        self.impacts.latest, self.impacts.left = {}, {}
        self._read()
        code = self._entry("find_struck", strikes)(self._now) if self._pushes.any() else SAME
        self._refuse(code)
        if code == OTHERS:
            self.impacts.strike(self._choice)
            self._read()
            compiled_form(strikes.forget_passed)(self._choice, self.simulation.state.w)

    # -- numbers of the present state ----------------------------------------------------------------------------------

    @property
    def _now(self) -> float:
        return float(self.simulation.state.clock[abi.TIME])

    @cached_property
    def _choice(self) -> Any:
        """The rows and working memory of `symgen.run.modes.choice`."""
        simulation, state, span = self.simulation, self.simulation.state, self.simulation.span
        rates = rate_functions(simulation.compiled.law_module)
        c = new_choice(simulation.compiled, self.rows, rates, len(state.y), len(state.w))
        c.step[0] = first_step(span)
        return c

    def _entry(self, name: str, module: Any = choice) -> Any:
        """Return a function of `choice`, or of such a module, on the arrays of the run; it takes the time."""
        if name not in self._entries:
            state, kind = self.simulation.state, module.KINDS[name]
            arrays = state.y, state.p, state.w, state.iw, state.control
            arguments = 0.0, self._choice, *arrays[: len(kind.signature.arguments) - 2]
            self._entries[name] = direct(compiled_form(getattr(module, name)), kind, *arguments)
        return self._entries[name]

    def _read(self) -> None:
        """Read coordinates and gaps, rates, bounds and restitutions.

        Raises
        ------
        InputError
            With the first number that is out of range.
        """
        if self._entry("read_rows")(self._now) == SAME:
            return
        c, names, dry, now = self._choice, self.rows.names, self.rows.dry, self._now
        kinds, nouns = self.rows.kinds, self.rows.nouns
        gaps, restitution = c.value[dry:], c.restitution[dry:]
        static, sliding = c.static[:dry], c.sliding[:dry]
        w = self.simulation.state.w
        shut = np.array([bool(plain_form(stays_shut)(c, w, i)) for i in range(dry, len(names))], dtype=bool)
        within = (gaps >= -c.depth[0] * self._scales(abi.LENGTH)[dry:]) | shut
        if not within.all():
            i = int(np.argmin(within))
            got = f"{gaps[i]:.6g} at t = {now:.6g} s"
            raise InputError(
                f"{kinds[dry + i]} {names[dry + i]}", "a gap of at least 0", got, f"a start within all {nouns[dry + i]}"
            )
        if not ((restitution >= 0.0) & (restitution <= 1.0)).all():
            i = int(np.argmin((restitution >= 0.0) & (restitution <= 1.0)))
            raise InputError(f"{kinds[dry + i]} {names[dry + i]}", "a restitution from 0 to 1", f"{restitution[i]:g}")
        if ((sliding == 0.0) & (static > 0.0)).any():
            i = int(np.argmax((sliding == 0.0) & (static > 0.0)))
            expected = "a bound in motion above 0, as that at rest is above 0"
            raise InputError(f"{kinds[i]} of {names[i]}", expected, "0")
        defined = np.isfinite(static) & np.isfinite(sliding) & (sliding >= 0.0) & (static >= sliding)
        i = int(np.argmin(defined)) if dry else 0
        got = f"{c.static[i]:g} at rest and {c.sliding[i]:g} in motion"
        raise InputError(f"{kinds[i]} of {names[i]}", "bounds of at least 0, at rest at least that in motion", got)

    def _scales(self, place: int) -> Array:
        """Return the mechanism's scale of speeds or of lengths in the unit of each row."""
        w = self.simulation.state.w
        scales: Array = np.where(self._choice.angular != 0, w[place] / w[abi.LENGTH], w[place])
        return scales
