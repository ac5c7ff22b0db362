"""What to write in place of formulas that jump with the state: a key of joints where they read a velocity."""

from __future__ import annotations

from collections.abc import Iterator

from symgen.base.vocabulary.expressions import ZERO, Call, Expr, Name, Reading, names_in_expression, readings_in
from symgen.describe.bounds.advice import advice_at_large, advice_on_joint
from symgen.describe.bounds.bounded_modes import two_sided_rows
from symgen.describe.facts.kinks import discontinuities_of
from symgen.describe.formulas.formula_text import to_text
from symgen.describe.mechanism import Joint, Mechanism

_SMOOTH = "a steep smooth one in its place, such as tanh(v/1e-3), has motions that radau5 follows"


def advice_on_jumps(mechanism: Mechanism) -> str:
    """Return what to write in place of formulas of the state that jump; empty without such formulas.

    An effort by the sign of a velocity leads to the key of the joint that reports the coordinate of this
    velocity, or else of a joint that moves with it.
    """
    jumping = [x.argument for x in discontinuities_of(mechanism) if x.jumps]
    velocities = [found for argument in jumping if (found := _compared_velocity(mechanism, argument)) is not None]
    if not velocities:
        return _SMOOTH if jumping else ""
    alone = [read for argument, read in velocities if _is_one_quantity(argument)]
    for of_velocity in (_is_rate_of_coordinate, _moves_like_coordinate):
        for read in alone:
            for joint, label in _coordinates_without_bounds(mechanism):
                if of_velocity(joint, label, read):
                    return advice_on_joint(joint, label, read.name)
    return advice_at_large(to_text(velocities[0][0]))


def _compared_velocity(mechanism: Mechanism, argument: Expr) -> tuple[Expr, Reading | Name] | None:
    """Return a formula that is compared with zero and the velocity in it, or None."""
    speeds = {f"{body.name}.{speed}" for body in mechanism.bodies for speed in body.speeds}
    rate = next((reading for reading in readings_in(argument) if reading.order == 1), None)
    velocity = rate or next((Name(name) for name in names_in_expression(argument) if name in speeds), None)
    return None if velocity is None else (argument, velocity)


def _is_one_quantity(argument: Expr) -> bool:
    """Return whether what is compared with zero is one quantity, as in ``sign(v)`` and ``v > 0``."""
    if isinstance(argument, Call) and argument.function == "sub":
        first, second = argument.arguments
        argument = first if second == ZERO else second if first == ZERO else argument
    return not isinstance(argument, Call)


def _coordinates_without_bounds(mechanism: Mechanism) -> Iterator[tuple[Joint, str]]:
    """Yield joints and their coordinates that may have a row with two bounds and have none."""
    rough = {row.owner for row in two_sided_rows(mechanism)}
    for joint in mechanism.joints:
        if joint.kind != "driver" and joint.name not in rough:
            yield from ((joint, label) for label, _ in joint.coordinates)


def _is_rate_of_coordinate(joint: Joint, label: str, read: Reading | Name) -> bool:
    """Return whether a velocity is the rate of a coordinate of a joint."""
    return isinstance(read, Reading) and read.source == dict(joint.coordinates)[label]


def _moves_like_coordinate(joint: Joint, label: str, read: Reading | Name) -> bool:
    """Return whether a velocity is one of a body of a joint, angular or not as its coordinate is."""
    body, _, speed = read.name.partition(".")
    return body in joint.bodies and (joint.unit(label) == "rad") == speed.rpartition(".")[2].startswith(("omega", "w"))
