"""Transitions where bounds depend on reactions of joints (`symgen.run.modes.agreement`).

An effort that alone brings about all of its reaction is jammed, and ends the run by name.
"""

from __future__ import annotations

from collections.abc import Sequence

from symgen.base.errors import InputError
from symgen.describe.bounds.modes import JAM
from symgen.run.modes import agreement
from symgen.run.modes.bounded_rows import DISAGREED, JAMMED, OTHERS, REDUNDANT, SHARED
from symgen.run.single.events import Happening
from symgen.run.single.transitions import Transitions


class PressedTransitions(Transitions):
    """The modes of a run in which bounds depend on reactions; no row is one-sided."""

    @property
    def _kind(self) -> str:
        """What depends on reactions."""
        return self.rows.kinds[self.rows.pressed[0]]

    def meet(self, happened: Sequence[Happening]) -> None:
        """Choose modes at the events at which a loop ended; a jam ends the run.

        Parameters
        ----------
        happened : sequence of Happening
            Events at the present time.
        """
        names = [event.name for event in happened]
        for i, name in enumerate(self.rows.names):
            if f"{name}.{JAM}" in names:
                self._refuse_jam(i, 1.0)
        super().meet(happened)

    def _chosen(self) -> bool:
        """Choose modes at a state whose rows have been read; return whether they are others."""
        code = self._entry("choose_pressed", agreement)(self._now)
        self._refuse(code)
        return bool(code == OTHERS)

    def _refuse(self, code: int) -> None:
        """Refuse a state for which a function has found no modes."""
        c, names, first = self._choice, self.rows.names, int(self._choice.named[0])
        if code == JAMMED:
            self._refuse_jam(first, float(c.jam[0]))
        if code == REDUNDANT:
            pressed, row = ", ".join(names[i] for i in self.rows.pressed), self.simulation.compiled.info.rows[first]
            expected = f"rows that determine all reactions, where {self._kind} depends on one"
            raise InputError(f"{self._kind} of {pressed}", expected, f"{row.name}, which other rows determine")
        if code == DISAGREED:
            pressed = ", ".join(names[i] for i in self.rows.pressed)
            got = f"others at {pressed} after many changes"
            raise InputError(self._kind, "bounds and reactions that agree", got)
        if code == SHARED:
            expected = f"{self._kind} by reactions whose forces at rest are determined, or that rests for good"
            raise InputError(self._kind, expected, f"{self._named()} at rest at one time, beside what changes")
        super()._refuse(code)

    def _refuse_jam(self, i: int, number: float) -> None:
        """Refuse an effort that alone brings about all of its reaction: accelerations are none, or not unique."""
        if not number < 1.0:
            name = self.rows.names[i]
            expected = f"{self._kind} that brings about less than all of its own reaction (a jamming number below 1)"
            raise InputError(f"{self._kind} of {name}", expected, f"{number:.12g} at t = {self._now:.9g} s")
