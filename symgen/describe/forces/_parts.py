"""Keys and efforts shared by both sorts of springs and dampers."""

from __future__ import annotations

from typing import Protocol

from symgen.base.vocabulary.expressions import ZERO, Expr, Name, call, literal_of, sum_of_terms
from symgen.base.vocabulary.measures import Effort, Measure
from symgen.describe.parts.scope import Scope


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


def effort_of_spring_and_damper(
    scope: Scope, keys: Sprung, label: str, measure: Measure, coordinate: str, free: float | str
) -> Effort:
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
        Measure of the effort.
    coordinate : str
        Its name in the file: ``"length"`` or ``"angle"``.
    free : scalar
        Coordinate of the unloaded spring.
    """
    stiffness, rest = scope.constant("stiffness", keys.stiffness), scope.constant(f"free_{coordinate}", free)
    damping = scope.constant("damping", keys.damping)
    actuator = scope.of_state("actuator", keys.actuator, {coordinate: "s", "rate": "rate"})
    potential = scope.potential("potential", keys.potential, {coordinate: "s"})
    return Effort(
        label,
        measure,
        sum_of_terms(actuator, damper_force(damping)),
        sum_of_terms(spring_potential(stiffness, rest), potential),
    )


def spring_potential(stiffness: Expr, free: Expr = ZERO) -> Expr:
    """Return the potential k (s - s0)^2 / 2."""
    if stiffness == ZERO:
        return ZERO
    stretch = Name("s") if free == ZERO else call("sub", Name("s"), free)
    return call("mul", call("div", stiffness, literal_of(2.0)), call("pow", stretch, literal_of(2.0)))


def damper_force(damping: Expr) -> Expr:
    """Return the force -c s'."""
    return ZERO if damping == ZERO else call("mul", call("neg", damping), Name("rate"))
