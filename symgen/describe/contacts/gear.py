"""A spur gear with involute teeth, in numbers."""

from __future__ import annotations

import msgspec

from symgen.base.vocabulary.expressions import ZERO, Expr


class Gear(msgspec.Struct, frozen=True):
    """A spur gear, as the law of its flanks needs it.

    Parameters
    ----------
    teeth : int
        Number of teeth.
    base : Expr
        Radius of the base circle [m].
    half_tooth : float
        Half of the angle of a tooth at the base circle [rad].
    inner, outer, pitch : float
        Radii over the module of where the flanks begin, which is not within the base circle, of the tips, and of the
        circle on which teeth have their pitch.
    cosine : float
        Of the pressure angle.
    first : Expr
        Direction of the middle of a tooth in the body [rad].
    centre : tuple of Expr
        Place of the centre in the body [m].
    """

    teeth: int
    base: Expr
    half_tooth: float
    inner: float
    outer: float
    pitch: float
    cosine: float
    first: Expr = ZERO
    centre: tuple[Expr, Expr] = (ZERO, ZERO)
