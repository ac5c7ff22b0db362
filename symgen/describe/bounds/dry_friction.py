"""Dry friction along a coordinate of a joint: a row in force at rest, an effort of a given sign in motion."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, ClassVar

import msgspec

from symgen.base.ir.program import JAMMING
from symgen.base.vocabulary.expressions import ONE, ZERO, Expr, Name, Number, Reading, call, sum_of_terms
from symgen.base.vocabulary.measures import Effort, Exerted, Holonomic, Measure
from symgen.describe.bounded import BoundedRow, RowFamily
from symgen.describe.bounds.bounded_modes import (
    JAM,
    REVERSE,
    SLIP,
    bounds_from_carried_force,
    effort_in_force,
    equals_whole_number,
    event_of_mode,
    measure_derivative,
    name_of_number,
    unit_of_effort,
)
from symgen.describe.bounds.by_reaction import size_of_reaction
from symgen.describe.bounds.row import Bounds
from symgen.describe.formulas.formula_text import to_text
from symgen.describe.mechanism import ModeEvent, Output
from symgen.describe.parts.driven_mechanism import replace_names

#: Factor of a mean.
_HALF = Number(0.5)


def _inspection_line(facts: Mapping[str, Any]) -> str:
    """Return the line of `symgen inspect` on a row."""
    x = facts
    viscous = "" if x["viscous"] == "0.0" else f", {x['viscous']} times the rate beside"
    stribeck = "" if x["stribeck_speed"] is None else f", falling over a rate of {x['stribeck_speed']}"
    unit = f"times the force of {' and '.join(x['reaction'])}" if x["reaction"] else x["unit"]
    at_most = x["static"] if "backwards" not in x else " and ".join(x.get("resting", (x["sliding"], x["backwards"])))
    at_rest = f"row {x['row']} in force at rest up to {at_most} {unit}"
    jam = "" if x["jamming_number"] is None else f"; jamming number {x['jamming_number']:.3g} at the start"
    motion = f"{x['sliding']} in motion" + (f" forwards, {x['backwards']} backwards" if "backwards" in x else "")
    return f"dry friction {x['name']}: {at_rest}; {motion}{stribeck}{viscous}{jam}"


FRICTION = RowFamily(
    one="friction",
    some="dry friction",
    noun="dry friction",
    in_force="at rest",
    off="in motion",
    part="frictions",
    fact="friction",
    named="that of {}",
    hint="runs and sweeps have it",
    held="while it sticks, {} does not change",
    line=_inspection_line,
    apart="'friction = { sliding = BOUND }' has a bound of its own",
)


class Friction(Bounds, frozen=True):
    """Dry friction along a coordinate of a joint.

    At rest the force is what keeps it at rest, up to `static`; in motion it is `sliding` against the rate. Where
    `stribeck_speed` is set, the bound falls from `static` to `sliding` as exp(-(rate / stribeck_speed)^exponent).

    Bounds of two directions are a force of half their difference, and the mean bound to both sides of it: 0 and B hold
    what a force of B/2 and a bound of B/2 hold. At rest that force is another one where bounds at rest are given.

    Parameters
    ----------
    name : str
        Of the joint where it has one coordinate, else ``JOINT.COORDINATE``.
    joint : str
        The joint.
    measure : Measure
        The coordinate.
    unit : str
        Unit of the coordinate.
    sliding, static : Expr
        Bounds [N or N m], or these over the size of the joint's reaction [1 or m]; ``rate`` in `sliding` is the size of
        the rate.
    viscous : Expr
        Force over rate [N s/m or N m s].
    stribeck_speed : Expr or None
        A rate [m/s or rad/s].
    pressed : tuple of str
        Rows of the joint whose forces are its reaction; none where the bounds do not depend on it.
    across : tuple of tuple of Measure
        Of a reaction along fixed axes, the cosines of these with each direction across the joint's axis; none where
        the forces themselves are the components.
    speed : Expr or None
        Where the friction is regularised, the rate of tanh(rate / speed) in place of the sign [m/s or rad/s].
    backwards : Expr or None
        Bound of motions with a negative rate [N or N m], where it is not `sliding`.
    exponent : Expr or None
        Of the fall over `stribeck_speed`; 2 by default.
    resting : tuple of Expr
        Bounds at rest forwards and backwards [N or N m], where they are not those of motions that begin.
    changing : bool
        Whether bounds depend on more than parameters: they are read whenever they matter.
    """

    family: ClassVar[RowFamily] = FRICTION

    name: str
    joint: str
    measure: Measure
    unit: str
    sliding: Expr
    static: Expr
    viscous: Expr = ZERO
    stribeck_speed: Expr | None = None
    pressed: tuple[str, ...] = ()
    across: tuple[tuple[Measure, ...], ...] = ()
    speed: Expr | None = None
    backwards: Expr | None = None
    exponent: Expr | None = None
    changing: bool = False
    resting: tuple[Expr, ...] = ()

    @property
    def label(self) -> str:
        """The name, which no other row has."""
        return self.name

    @property
    def row(self) -> str:
        """Name of the row that is in force at rest."""
        return f"{self.name}.friction"

    @property
    def owner(self) -> str:
        """The joint."""
        return self.joint

    @property
    def along(self) -> str:
        """The coordinate."""
        return self.name

    @property
    def smooth(self) -> bool:
        """Whether a smooth force replaces it."""
        return self.speed is not None

    @property
    def unequal(self) -> bool:
        """Whether its bounds differ in the two directions."""
        return self.backwards is not None

    @property
    def where(self) -> str:
        """Its place in a file."""
        return f"joints.{self.joint}.friction"

    @property
    def held(self) -> Holonomic:
        """The row in force."""
        return Holonomic("friction", self.measure, unit=self.unit)

    @property
    def effort(self) -> Effort:
        """The effort of a coordinate that moves; its sign is a number of the row, 0 at rest.

        The number ``effort`` is that of friction at rest which shares its hold with other rows, 0 in motion. Of
        friction by a reaction only this and the viscous part are here.
        """
        rate = Name("rate")
        against: Expr = sum_of_terms(name_of_number(self, "effort"), self.middle_of_bounds(rate))
        sign = name_of_number(self, "sign")
        if not self.pressed:
            against = call("add", against, call("mul", sign, self.bound_in_motion(rate)))
        if self.shift is not None:
            rests = call("sub", ONE, call("mul", sign, sign))
            against = call("add", against, call("mul", rests, self.shift))
        return Effort("friction", self.measure, call("neg", call("add", against, call("mul", self.viscous, rate))))

    @property
    def smooth_effort(self) -> Effort:
        """The effort of a smooth force: the bound times tanh(rate / `speed`), or times the sign of the rate."""
        rate = Name("rate")
        way = call("sign", rate) if self.speed is None else call("tanh", call("div", rate, self.speed))
        dry = call("mul", way, self.bound_in_motion(rate))
        if self.backwards is not None:
            dry = call("add", dry, call("mul", call("abs", way), self.middle_of_bounds(rate)))
        against = call("add", dry, call("mul", self.viscous, rate))
        return Effort("friction", self.measure, call("neg", against))

    @property
    def place(self) -> tuple[str, Expr]:
        """The coordinate."""
        return self.name, measure_derivative(self, 0)

    @property
    def numbers(self) -> tuple[tuple[str, Expr], ...]:
        """Bounds at rest and at the beginning of a motion."""
        return (
            (f"bound of {self.name} at rest", self.static),
            (f"bound of {self.name} in motion", self.bound_in_motion()),
        )

    def bound_in_motion(self, rate: Expr = ZERO) -> Expr:
        """Return the bound at a rate, by default at the beginning of a motion; of two bounds the mean."""
        sliding = bound_at_rate(self.sliding, rate)
        if self.backwards is not None:
            return mean_of(sliding, bound_at_rate(self.backwards, rate))
        if self.stribeck_speed is None:
            return sliding
        if rate == ZERO:  # rounding of the sum would put it above that at rest
            return self.static
        ratio = call("div", rate, self.stribeck_speed)
        power = call("mul", ratio, ratio)
        if self.exponent is not None:
            power = call("pow", call("div", call("abs", rate), self.stribeck_speed), self.exponent)
        fall = call("exp", call("neg", power))
        return call("add", sliding, call("mul", call("sub", self.static, sliding), fall))

    def middle_of_bounds(self, rate: Expr = ZERO) -> Expr:
        """Return the force in the middle between the bounds of two directions, against a positive rate."""
        if self.backwards is None:
            return ZERO
        return _middle_of(bound_at_rate(self.sliding, rate), bound_at_rate(self.backwards, rate))

    @property
    def shift(self) -> Expr | None:
        """Middle of the bounds at rest less the middle of those in motion; None where it is 0."""
        if not self.resting:
            return None
        return call("sub", _middle_of(*self.resting), self.middle_of_bounds())

    @property
    def coefficient(self) -> Expr:
        """Bound in motion over the size of the reaction, a formula of ``rate``."""
        return self.bound_in_motion(Name("rate"))

    @property
    def without_reaction(self) -> Friction:
        """The row with its viscous part, and the number ``effort``, where its bounds depend on a reaction."""
        if not self.pressed:
            return self
        none = {"sliding": ZERO, "static": ZERO, "stribeck_speed": None, "exponent": None}
        return msgspec.structs.replace(self, pressed=(), across=(), **none)

    @property
    def taking(self) -> Expr:
        """The effort that takes energy, a formula of outputs."""
        if self.smooth:
            return Reading(f"{self.name}.force", Exerted((self.smooth_effort,)))
        return self.total_effort()

    def total_effort(self) -> Expr:
        """Return the effort at rest and in motion, a formula of outputs."""
        force = Reading(f"{self.name}.force", Exerted((self.effort,)))
        total = call("add", force, effort_in_force(self))
        if not self.pressed:
            return total
        against = call("mul", self.bound_in_motion(measure_derivative(self)), size_of_reaction(self))
        return call("sub", total, call("mul", name_of_number(self, "sign"), against))

    def events(self, beside: Sequence[BoundedRow]) -> tuple[ModeEvent, ...]:
        """Return the events at which its mode is chosen anew.

        Where its effort at rest is a number of its own, as several rows share it, a bound that varies may reach that;
        ``limit`` is then what counts as none. A row at rest that is not in force, as joints lock it, is watched by its
        rate: the joints may move it, as a driver that starts smoothly does.
        """
        held, sign, limit = (name_of_number(self, number) for number in ("held", "sign", "limit"))
        limit_at_rest, off = sum_of_terms(limit, *bounds_from_carried_force(self, beside)), call("sub", ONE, held)
        if self.changing or self.pressed:
            bound = call("mul", self.static, size_of_reaction(self)) if self.pressed else self.static
            limit_at_rest = call("add", bound, limit if self.pressed else limit_at_rest)
            shares = equals_whole_number(name_of_number(self, "constant"), -1)
            own = call("sub", call("add", bound, limit), call("abs", name_of_number(self, "effort")))
            off = call("mul", off, call("add", call("sub", ONE, shares), call("mul", shares, own)))
        effort = effort_in_force(self)
        left = call("sub", limit_at_rest, effort), call("add", limit_at_rest, effort)  # smooth, as their least is not
        locked = call("sub", held, call("mul", call("sub", ONE, held), call("abs", measure_derivative(self))))
        resting_rate = call("mul", call("sub", ONE, call("mul", sign, sign)), locked)
        moving = call("add", call("mul", sign, measure_derivative(self)), resting_rate)
        resting = (call("add", call("mul", held, each), off) for each in left)
        events = (
            *(event_of_mode(self, SLIP, each, "effort at rest at a bound") for each in resting),
            event_of_mode(self, REVERSE, moving, "rate of sliding 0"),
        )
        if not self.pressed:
            return events
        free = call("sub", ONE, name_of_number(self, JAMMING))
        return (*events, event_of_mode(self, JAM, free, "jamming number 1"))

    def outputs(self, beside: Sequence[BoundedRow]) -> Iterator[Output]:
        """Yield mode (0 at rest, else the sign of the rate) and force.

        A one-sided row in force carries the friction of its own coordinate: where its effort pulls, that is friction.
        """
        total = self.total_effort()
        for row in beside:
            if row.one_sided and row.along == self.along:
                effort = effort_in_force(row)
                pulls = call("mul", Number(0.5), call("sub", effort, call("abs", effort)))
                total = call("sub" if row.reversed else "add", total, pulls)
        yield Output(f"{self.name}.mode", name_of_number(self, "sign"), "")
        yield Output(f"{self.name}.force", total, unit_of_effort(self))

    def facts(self) -> dict[str, Any]:
        """Return what `symgen inspect` says of it."""
        return {
            **{key: to_text(getattr(self, key)) for key in ("static", "sliding", "viscous")},
            "stribeck_speed": None if self.stribeck_speed is None else to_text(self.stribeck_speed),
            **({} if self.backwards is None else {"backwards": to_text(self.backwards)}),
            **({"resting": [to_text(bound) for bound in self.resting]} if self.resting else {}),
            **({} if self.exponent is None else {"stribeck_exponent": to_text(self.exponent)}),
        }


def mean_of(forwards: Expr, backwards: Expr) -> Expr:
    """Return the mean of the bounds of two directions."""
    return call("mul", _HALF, call("add", forwards, backwards))


def _middle_of(forwards: Expr, backwards: Expr) -> Expr:
    """Return the force in the middle between the bounds of two directions, against a positive rate."""
    return call("mul", _HALF, call("sub", forwards, backwards))


def bound_at_rate(bound: Expr, rate: Expr) -> Expr:
    """Return a bound with the size of a rate for ``rate``."""
    size = ZERO if rate == ZERO else call("abs", rate)
    return replace_names(bound, lambda name: size if name == Name("rate") else name)
