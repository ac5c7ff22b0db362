"""Stops that give way: a force of the depth beyond a gap and of its rate, which only pushes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from symgen.base.vocabulary.expressions import ONE, ZERO, Expr, Name, Reading, call, difference, sum_of_terms
from symgen.base.vocabulary.measures import Effort, Exerted
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.bounded_modes import measure_derivative
from symgen.describe.bounds.end_stop import GapStop
from symgen.describe.formulas.formula_text import to_text
from symgen.describe.mechanism import ModeEvent, Output


class ElasticStop(GapStop, frozen=True):
    """An elastic stop: a force ``stiffness depth - damping gap'`` where the gap is below 0, which never pulls.

    Nothing is held: it is a force of the state, without impacts and modes.

    Parameters
    ----------
    name, owner, measure, value, unit
        See `symgen.describe.bounds.end_stop.GapStop`.
    stiffness, damping : Expr
        Force over depth [N/m or N m], and over the rate of the gap [N s/m or N m s].
    """

    stiffness: Expr
    damping: Expr = ZERO

    @property
    def along(self) -> str:
        """No coordinate: it shares no force with other rows."""
        return ""

    @property
    def smooth(self) -> bool:
        """A force replaces it."""
        return True

    @property
    def effort(self) -> Effort:
        """The force along the gap."""
        return self.smooth_effort

    @property
    def smooth_effort(self) -> Effort:
        """The force along the gap."""
        depth = difference(self.value, Name("s"))
        pushing = call("max", sum_of_terms(self._spring_force(depth), *self._damper_force(Name("rate"))), ZERO)
        inside = pushing if self.damping == ZERO else call("where", call("gt", depth, ZERO), pushing, ZERO)
        return Effort("stop", self.measure, inside)

    def _spring_force(self, depth: Expr) -> Expr:
        return call("mul", self.stiffness, depth)

    def _damper_force(self, rate: Expr) -> tuple[Expr, ...]:
        return () if self.damping == ZERO else (call("neg", call("mul", self.damping, rate)),)

    @property
    def numbers(self) -> tuple[tuple[str, Expr], ...]:
        """A restitution, which it has none of."""
        return ((f"restitution of {self.name}", ONE),)

    @property
    def taking(self) -> Expr:
        """The part of the force that takes energy: all but the force of the spring."""
        spring = self._spring_force(call("max", difference(self.value, measure_derivative(self, 0)), ZERO))
        return call("sub", Reading(f"{self.name}.force", Exerted((self.smooth_effort,))), spring)

    def events(self, beside: Sequence[BoundedRow]) -> tuple[ModeEvent, ...]:
        """Return none: it has no modes."""
        return ()

    def outputs(self, beside: Sequence[BoundedRow]) -> Iterator[Output]:
        """Yield nothing: forces are reported where they are made."""
        return iter(())

    def facts(self) -> dict[str, Any]:
        """Return what describes it."""
        return {"stiffness": to_text(self.stiffness), "damping": to_text(self.damping)}
