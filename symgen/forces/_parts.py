"""What springs and dampers of either sort share."""

from __future__ import annotations

from symgen.vocabulary.expressions import ZERO, Expr, Name, call, number


def spring_energy(stiffness: Expr, free: Expr, further: Expr) -> Expr:
    """Return k (s - s0)^2 / 2 plus a further potential, without terms that are zero."""
    if stiffness == ZERO:
        return further
    stretch = Name("s") if free == ZERO else call("sub", Name("s"), free)
    energy = call("mul", call("div", stiffness, number(2.0)), call("pow", stretch, number(2.0)))
    return energy if further == ZERO else call("add", energy, further)


def damped(damping: Expr, actuator: Expr) -> Expr:
    """Return actuator - c rate, without terms that are zero."""
    if damping == ZERO:
        return actuator
    drag = call("mul", call("neg", damping), Name("rate"))
    return drag if actuator == ZERO else call("add", actuator, drag)
