"""Dry friction as a force of the rate: a smooth law in place of the exact one, or sliding alone."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import Name, Reading, call
from symgen.base.vocabulary.measures import Effort, Exerted
from symgen.describe.bounds.friction import bound_in_motion, unit_of_effort, without_friction
from symgen.describe.mechanism import Force, Friction, Mechanism, Output


def smooth_force(friction: Friction, bodies: tuple[str, ...]) -> Force:
    """Return dry friction as a force: the bound times tanh(rate / `speed`), or times the sign of the rate."""
    return Force(friction.row, "friction", bodies, (smooth_effort(friction),))


def smooth_effort(friction: Friction) -> Effort:
    """Return the effort of this force."""
    rate = Name("rate")
    if friction.speed is None:
        way = call("sign", rate)
    else:
        way = call("tanh", call("div", rate, friction.speed))
    against = call("add", call("mul", way, bound_in_motion(friction, rate)), call("mul", friction.viscous, rate))
    return Effort("friction", friction.measure, call("neg", against))


def with_smooth_friction(mechanism: Mechanism, frictions: Sequence[Friction]) -> Mechanism:
    """Return a mechanism with some dry friction as forces, which ``NAME.force`` reports."""
    forces = tuple(smooth_force(friction, mechanism.joint_named(friction.joint).bodies) for friction in frictions)
    outputs = tuple(
        Output(
            f"{friction.name}.force",
            Reading(f"{friction.name}.force", Exerted(force.efforts)),
            unit_of_effort(friction),
        )
        for friction, force in zip(frictions, forces, strict=True)
    )
    return msgspec.structs.replace(
        mechanism, forces=(*mechanism.forces, *forces), outputs=(*mechanism.outputs, *outputs)
    )


def with_sliding_friction(where: str, mechanism: Mechanism) -> Mechanism:
    """Return a mechanism with its dry friction as forces against the rates, 0 at rest.

    Raises
    ------
    InputError
        If bounds depend on reactions.
    """
    names = ", ".join(friction.name for friction in mechanism.frictions if friction.pressed)
    if names:
        raise InputError(where, "dry friction with constant bounds", f"friction of {names} by the reaction")
    return with_smooth_friction(without_friction(mechanism), mechanism.frictions)
