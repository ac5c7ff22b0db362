"""Rolling that gives way: the plane is a one-sided spring, and slip meets a smooth force in place of rows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import ClassVar

import msgspec

from symgen.base.vocabulary.expressions import (
    ZERO,
    Expr,
    Name,
    Number,
    Reading,
    call,
    difference,
    literal_of,
    product,
    sum_of_terms,
)
from symgen.base.vocabulary.measures import Effort, FormulaMeasure, Measure, Speed
from symgen.describe.mechanism import Force
from symgen.describe.parts.fields import Scalar, value_in_words
from symgen.describe.parts.scope import Scope

#: Slip over the speed of friction below which its direction fades, so that it is defined at rest too.
AT_REST = 1e-8


class SlipFriction(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Friction of a contact that gives way, against the slip of the point that touches.

    Parameters
    ----------
    coefficient : scalar
        Friction over the push of the plane, once it slips.
    speed : scalar
        Slip [m/s], above 0, over which friction rises: it is `coefficient` times the push times tanh(slip / `speed`).
    """

    coefficient: Scalar
    speed: Scalar


class GivingContact(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A round body and what it rolls on, which may give way.

    Parameters
    ----------
    stiffness : scalar
        Push of the plane over the depth of the body in it [N/m], above 0: the contact gives way, lifts off and comes
        back. Without it the body rolls without slip.
    damping : scalar
        Beside it, push over the rate of the depth [N s/m]; 0 by default. It adds or takes at most what the stiffness
        gives, so that the push begins at 0 and the plane never pulls.
    friction : table
        Beside it, friction against the slip, { coefficient, speed }; none by default.
    """

    #: Keys of joints of any kind that the kind reads itself, each beside another one.
    TAKES: ClassVar[Mapping[str, str]] = {"friction": "stiffness"}

    stiffness: Scalar | None = None
    damping: Scalar | None = None
    friction: SlipFriction | None = None

    def force_of_contact(
        self,
        scope: Scope,
        bodies: tuple[str, ...],
        height: Measure,
        radius: Expr,
        slips: Sequence[tuple[str, Measure | Speed]],
    ) -> Force:
        """Return the push of the plane and friction, which have the names of the multipliers of the rigid joint.

        Parameters
        ----------
        scope : Scope
            The joint.
        bodies : tuple of str
            Its bodies.
        height : Measure
            Height over the plane, which it touches where that is the radius.
        radius : Expr
            The radius; 0 where the height is that of the lowest point.
        slips : sequence of (str, Measure or Speed)
            Label of each direction of slip, and a velocity or a measure whose rate is the slip.
        """
        push = _Push(scope, self.stiffness or 0.0, self.damping or 0.0, radius)
        efforts = [Effort("normal", height, push.damper(), push.potential())]
        if self.friction is not None:
            efforts += _efforts_of_slip(scope, self.friction, push.on(Reading("height", height)), slips)
        return Force(scope.name, scope.kind, bodies, tuple(efforts))


def refuse_damping(scope: Scope, stiffness: float | str | None, damping: float | str | None) -> None:
    """Refuse damping where nothing gives way."""
    if stiffness is None and damping is not None:
        raise scope.error("damping", "the key stiffness beside it", value_in_words(damping))


def force_of_pull(
    scope: Scope,
    bodies: tuple[str, ...],
    label: str,
    way: Measure,
    length: Expr,
    stiffness: float | str,
    damping: float | str | None,
) -> Force:
    """Return a force along a length that only pulls, where that is beyond another one."""
    pull = _Push(scope, stiffness, damping or 0.0, length, beyond=True)
    return Force(scope.name, scope.kind, bodies, (Effort(label, way, pull.damper(), pull.potential()),))


class _Push:
    """The push of a plane as formulas of a height and its rate, below an edge or with `beyond` above it."""

    def __init__(
        self, scope: Scope, stiffness: float | str, damping: float | str, edge: Expr, beyond: bool = False
    ) -> None:
        self.edge, self.beyond = edge, beyond
        self.stiffness = scope.constant("stiffness", stiffness, positive=True)
        self.damping = scope.constant("damping", damping)
        if (size := scope.value(self.damping, "damping")) < 0.0:
            raise scope.error("damping", "a value of at least 0", repr(size))

    def potential(self) -> Expr:
        """Return the energy of the spring."""
        half = call("div", self.stiffness, literal_of(2.0))
        return call("mul", half, call("pow", self._depth(Name("s")), literal_of(2.0)))

    def damper(self) -> Expr:
        """Return what the damper adds to the push of the spring."""
        return self._damper(Name("s"), Name("rate"))

    def on(self, height: Reading) -> Expr:
        """Return the whole push."""
        rate = Reading(f"{height.name}.rate", height.source, 1)
        return sum_of_terms(call("mul", self.stiffness, self._depth(height)), self._damper(height, rate))

    def _depth(self, height: Expr) -> Expr:
        depth = difference(height, self.edge) if self.beyond else difference(self.edge, height)
        return call("max", depth, ZERO)

    def _damper(self, height: Expr, rate: Expr) -> Expr:
        """Return the force of the damper: at most the spring's, so that nothing jumps as the body touches."""
        if self.damping == ZERO:
            return ZERO
        spring, against = call("mul", self.stiffness, self._depth(height)), call("mul", self.damping, rate)
        return call("max", call("min", call("neg", against), spring), call("neg", spring))


def _efforts_of_slip(
    scope: Scope, friction: SlipFriction, push: Expr, slips: Sequence[tuple[str, Measure | Speed]]
) -> list[Effort]:
    """Return friction along each direction of slip: together as large as the law says, against the whole slip."""
    coefficient = scope.constant("friction.coefficient", friction.coefficient)
    if (size := scope.value(coefficient, "friction.coefficient")) < 0.0:
        raise scope.error("friction.coefficient", "a value of at least 0", repr(size))
    speed = scope.constant("friction.speed", friction.speed, positive=True)
    bound = call("neg", call("mul", coefficient, push))
    if len(slips) == 1:
        ((label, slip),) = slips
        return [Effort(label, slip, call("mul", bound, call("tanh", call("div", Name("rate"), speed))))]
    rates = [Reading(f"{label}.rate", slip, 1) for label, slip in slips]
    least = call("pow", call("mul", Number(AT_REST), speed), literal_of(2.0))
    whole = call("sqrt", sum_of_terms(*(call("pow", rate, literal_of(2.0)) for rate in rates), least))
    over = call("div", call("mul", bound, call("tanh", call("div", whole, speed))), whole)
    return [Effort(label, slip, product(over, rate)) for (label, slip), rate in zip(slips, rates, strict=True)]


def gap_of(height: Measure, radius: Expr) -> tuple[str, Measure]:
    """Return the coordinate ``gap`` of a contact that gives way: below 0 where it touches."""
    return "gap", height if radius == ZERO else FormulaMeasure(call("sub", Reading("height", height), radius))
