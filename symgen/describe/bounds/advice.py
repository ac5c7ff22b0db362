"""Which key of joints to write in place of a formula with the sign of a velocity."""

from __future__ import annotations

from symgen.describe.mechanism import Joint

#: Message for runs without progress where forces or joints compare the state.
JUMPING = "a formula jumps to and fro with the state, as friction by sign(v) does that sticks, and no step gets across"


def advice_on_joint(joint: Joint, label: str, text: str) -> str:
    """Return the sentence on the key in place of a formula with the sign of a velocity."""
    key = "friction" if len(joint.coordinates) == 1 else f"friction.{label}"
    unit = "N m" if joint.unit(label) == "rad" else "N"
    return (
        f"for dry friction, which sticks, write '{key} = {{ sliding = BOUND }}' in [joints.{joint.name}], BOUND in "
        f"{unit}, in place of the formula with the sign of {text}"
    )


def advice_at_large(text: str) -> str:
    """Return this sentence where no joint has a coordinate with the velocity."""
    return (
        "dry friction that sticks is the key friction of a joint with that coordinate, in place of the sign of "
        f"{text}: 'friction = {{ sliding = BOUND }}', BOUND in N or N m"
    )
