"""The key ``efficiency`` of gears, racks and screws: dry friction over the size of the force of teeth or threads.

Between the force F_a on the side that drives forwards and the force F_b on the other side are a multiplier and dry
friction over its size, of which a part w acts on one side and the rest on the other::

    F_a = lambda + w s c |lambda|,  F_b = lambda - (1 - w) s c |lambda|,  s from -1 to 1, the sign of the rate in motion

Efficiencies f forwards and b backwards are F_b/F_a where the one side drives, and F_a/F_b where the other one does.
From these two follow c = 2 (1 - f)(1 - b) / (1 - f b) and w = (1 - 2 b + f b) / (2 (1 - f)(1 - b)), so that friction is
that by a reaction, along the travel w x_a + (1 - w) x_b. Its jamming number is below 1 for all f and b from 0 to 1.
"""

from __future__ import annotations

import msgspec

from symgen.base.vocabulary.expressions import ONE, ZERO, Expr, call, difference, literal_of, product
from symgen.base.vocabulary.measures import Holonomic, Sum
from symgen.describe.bounds.changing import is_constant
from symgen.describe.bounds.dry_friction import FRICTION, Friction, bound_at_rate
from symgen.describe.bounds.keys import KeyOfJoints
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import Efficiency, read_value
from symgen.describe.parts.scope import Scope

#: Kinds of joints with teeth or threads: label of the row, and which of its two terms is the side that drives forwards.
GEARED = {"gear": ("mesh", 0), "rack-and-pinion": ("mesh", 1), "screw": ("screw", 1)}
_TWO, _MINUS = literal_of(2.0), literal_of(-1.0)
#: Least efficiency that a formula of the motion gives: what is below it counts as this.
_LEAST = literal_of(1e-3)


class ToothFriction(Friction, frozen=True):
    """Dry friction of teeth or threads over the size of their one force."""

    @property
    def where(self) -> str:
        """Its place in a file."""
        return f"joints.{self.joint}.efficiency"


def read_efficiency(scope: Scope, joint: Joint, raw: object) -> tuple[ToothFriction, ...]:
    """Return the friction of a joint with teeth or a thread.

    Raises
    ------
    InputError
        With the key that is wrong.
    """
    label, forwards = GEARED[joint.kind]
    row = next(row for row in joint.rows if row.label == label)
    assert isinstance(row, Holonomic) and isinstance(row.measure, Sum), "teeth and threads tie two coordinates"
    coefficient, share = _friction_and_share(scope, read_value(Efficiency, raw, scope.where("efficiency")))
    rest = difference(ONE, share)
    shares = (share, rest) if forwards == 0 else (rest, share)
    # The two terms add up to a constant, so that the travels of the sides are the first one and minus the second one.
    # In the plane angles of a gear run from the wheels to the carrier.
    signs = (_MINUS, ONE) if joint.kind == "gear" and not scope.spatial else (ONE, _MINUS)
    terms = zip(shares, signs, row.measure.terms, strict=True)
    travel = Sum(tuple((product(part, sign, k), measure) for part, sign, (k, measure) in terms if part != ZERO))
    name = f"{joint.name}.{row.label}"
    unit, static = "rad" if row.unit == "rad" else "m", bound_at_rate(coefficient, ZERO)
    changing = not is_constant(scope, static)
    friction = ToothFriction(joint.name, joint.name, travel, unit, coefficient, static, pressed=(name,))
    return (msgspec.structs.replace(friction, changing=changing),)


def _friction_and_share(scope: Scope, efficiency: float | str | tuple[float | str, float | str]) -> tuple[Expr, Expr]:
    """Return the coefficient of friction, and the part of it on the side that drives forwards."""
    if not isinstance(efficiency, tuple):
        one = scope.of_state("efficiency", efficiency, {"rate": "rate"})
        if not is_constant(scope, one):
            within = call("min", call("max", one, _LEAST), ONE)
            return call("sub", call("div", ONE, within), ONE), ONE
        if not 0.0 < (size := scope.value(one, "efficiency")) <= 1.0:
            raise scope.error("efficiency", "a value above 0 and at most 1", repr(size))
        return call("sub", call("div", ONE, one), ONE), ONE
    f, b = (scope.constant(f"efficiency[{i}]", each) for i, each in enumerate(efficiency))
    if not 0.0 < (size := scope.value(f, "efficiency[0]")) < 1.0:
        raise scope.error("efficiency[0]", "a value above 0 and below 1", repr(size))
    if not (size := scope.value(b, "efficiency[1]")) < 1.0:
        expected = "a value below 1, of 0 or less where the load does not drive"
        raise scope.error("efficiency[1]", expected, repr(size))
    both, lost = product(f, b), call("mul", call("sub", ONE, f), call("sub", ONE, b))
    coefficient = call("div", call("mul", _TWO, lost), call("sub", ONE, both))
    own = call("add", call("sub", ONE, call("mul", _TWO, b)), both)
    return coefficient, call("div", own, call("mul", _TWO, lost))


KIND = KeyOfJoints("efficiency", FRICTION, Efficiency, read_efficiency, tuple(GEARED))
