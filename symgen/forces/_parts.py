"""What springs and dampers of either sort share."""

from __future__ import annotations

from typing import Protocol

from symgen.describe.scope import Scope
from symgen.vocabulary.expressions import ZERO, Expr, Name, call, number
from symgen.vocabulary.measures import Effort, Measure


class Sprung(Protocol):
    """The keys that both sorts have; an actuator and a potential may use the element's own coordinate."""

    @property
    def stiffness(self) -> float | str: ...
    @property
    def damping(self) -> float | str: ...
    @property
    def actuator(self) -> float | str: ...
    @property
    def potential(self) -> float | str: ...


def sprung(scope: Scope, keys: Sprung, label: str, measure: Measure, coordinate: str, free: float | str) -> Effort:
    """Return the effort of a spring, a damper and an actuator.

    Parameters
    ----------
    scope : Scope
        Resolves the keys.
    keys : Sprung
        The table of the file.
    label : str
        Of the effort.
    measure : Measure
        What it works along.
    coordinate : str
        What the file calls that: ``"length"`` or ``"angle"``.
    free : scalar
        Where the spring is at rest.
    """
    stiffness, rest = scope.constant("stiffness", keys.stiffness), scope.constant(f"free_{coordinate}", free)
    damping = scope.constant("damping", keys.damping)
    actuator = scope.of_state("actuator", keys.actuator, {coordinate: "s", "rate": "rate"})
    potential = scope.potential("potential", keys.potential, {coordinate: "s"})
    return Effort(label, measure, _damped(damping, actuator), _spring_energy(stiffness, rest, potential))


def _spring_energy(stiffness: Expr, free: Expr, further: Expr) -> Expr:
    """Return k (s - s0)^2 / 2 plus a further potential, without terms that are zero."""
    if stiffness == ZERO:
        return further
    stretch = Name("s") if free == ZERO else call("sub", Name("s"), free)
    energy = call("mul", call("div", stiffness, number(2.0)), call("pow", stretch, number(2.0)))
    return energy if further == ZERO else call("add", energy, further)


def _damped(damping: Expr, actuator: Expr) -> Expr:
    """Return actuator - c rate, without terms that are zero."""
    if damping == ZERO:
        return actuator
    drag = call("mul", call("neg", damping), Name("rate"))
    return drag if actuator == ZERO else call("add", actuator, drag)
