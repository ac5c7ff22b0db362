"""Events that happened, labelled as people and programs read them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from symgen.runtime.compiled import ModelInfo
    from symgen.runtime.events import Happening


@dataclass(frozen=True)
class EventRecord:
    """An event that happened during a run.

    Attributes
    ----------
    t : float
        When [s].
    name, action : str
        Which one, and what was done: ``record``, ``stop`` or ``reset``.
    q, v : mapping
        Coordinates and velocities there, before a reset.
    v_after : mapping or None
        Velocities after a reset.
    impulses : mapping
        Of a reset: those of constraint rows, signed as the multipliers, and those along the velocities that were given
        values.
    work : float
        What a reset adds to the energy [J]; resets at the same time are one, whose work the first of them has.
    """

    t: float
    name: str
    action: str
    q: Mapping[str, float]
    v: Mapping[str, float]
    v_after: Mapping[str, float] | None = None
    impulses: Mapping[str, float] = field(default_factory=dict)
    work: float = 0.0

    def to_json(self) -> dict[str, Any]:
        """Return it as JSON has it."""
        after = None if self.v_after is None else dict(self.v_after)
        state = {"q": dict(self.q), "v": dict(self.v), "v_after": after}
        numbers = {"impulses": dict(self.impulses), "work": self.work}
        return {"t": self.t, "name": self.name, "action": self.action, **state, **numbers}


def record_of(info: ModelInfo, event: Happening) -> EventRecord:
    """Label an event of a run."""
    q = {c.name: float(x) for c, x in zip(info.coordinates, event.state[: info.nq], strict=True)}
    v = {c.name: float(x) for c, x in zip(info.velocities, event.state[info.nq :], strict=True)}
    if event.after is None or event.impulses is None:
        return EventRecord(event.t, event.name, event.action, q, v)
    after = {c.name: float(x) for c, x in zip(info.velocities, event.after, strict=True)}
    signs = [-1.0] * info.m + [1.0] * len(event.given)  # D^T lambda stands on the left of the equations of motion
    names = [*(row.name for row in info.rows), *event.given]
    impulses = {name: float(s * x) for name, s, x in zip(names, signs, event.impulses, strict=True)}
    return EventRecord(event.t, event.name, event.action, q, v, after, impulses, event.energy)
