"""Tables of a mechanism: functions of one argument, defined by points."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import msgspec

from symgen.base.ir.interpolation import Interpolation, cubic_pieces, cubic_slopes, pchip_slopes, periodic_slopes
from symgen.base.vocabulary.expressions import ONE, SMOOTH, Call, Expr, call, product


class Table(msgspec.Struct, frozen=True, omit_defaults=True):
    """A function of one argument by interpolation; used as ``NAME(x)``.

    ``linear`` is constant beyond its ends. ``cubic`` (two continuous derivatives) and ``pchip`` (one, and no value
    beyond those of the points) go on in straight lines there, unless they are `periodic`. ``hermite``, which no file
    has, is cubic with given `slopes` at the points, and ``rate`` the derivative of such a one.
    """

    name: str
    x: tuple[float, ...]
    y: tuple[float, ...]
    interpolation: str = "linear"
    periodic: bool = False
    slopes: tuple[float, ...] = ()

    @property
    def function(self) -> str:
        """Function of its calls in an expression, see `symgen.base.vocabulary.expressions.Call`."""
        return f"table:{'' if self.interpolation == 'linear' else SMOOTH}{self.name}"

    @property
    def interpolated(self) -> Interpolation:
        """Its interpolation."""
        return _interpolation_of(self)


@lru_cache(maxsize=64)
def _interpolation_of(table: Table) -> Interpolation:
    x, y = table.x, table.y
    if table.interpolation == "linear":
        return Interpolation(table.name, x, y)
    slopes: Sequence[float]
    if table.slopes:
        slopes = table.slopes
    elif table.interpolation == "pchip":
        slopes = pchip_slopes(x, y, table.periodic)
    else:
        slopes = periodic_slopes(x, y) if table.periodic else cubic_slopes(x, y)
    pieces = cubic_pieces(x, y, slopes)
    if table.interpolation == "rate":
        pieces = tuple((b, 2.0 * c, 3.0 * d, 0.0) for _, b, c, d in pieces)
    return Interpolation(table.name, x, y, pieces, x[-1] - x[0] if table.periodic else 0.0)


#: Shape functions of curves (`symgen.describe.joints.slides_on`) for the place and for the slope at their first, an
#: inner and their last station, over the number of pieces from there; no file can use these names.
PLACE_SHAPES, SLOPE_SHAPES = (
    {
        where: Table(
            f"_{word}_at_{where}",
            x,
            tuple(float(at == 0.0 and word == "place") for at in x),
            "hermite",
            slopes=tuple(float(at == 0.0 and word == "slope") for at in x),
        )
        for where, x in (("first", (0.0, 1.0)), ("inner", (-1.0, 0.0, 1.0)), ("last", (-1.0, 0.0)))
    }
    for word in ("place", "slope")
)


#: Function of a shape -> the table of its derivative.
RATES_OF_SHAPES = {
    shape.function: msgspec.structs.replace(shape, name=f"{shape.name}_rate", interpolation="rate")
    for shape in (*PLACE_SHAPES.values(), *SLOPE_SHAPES.values())
}


def shapes_of_curves(with_rates: bool) -> tuple[Table, ...]:
    """Return the tables of all shape functions, and of their derivatives where tangents are needed."""
    return (*PLACE_SHAPES.values(), *SLOPE_SHAPES.values(), *(RATES_OF_SHAPES.values() if with_rates else ()))


def curve_slope(place: Expr) -> Expr:
    """Return the derivative of a coordinate of a curve by the way along it: it is linear in shape functions."""
    if not isinstance(place, Call):
        return place
    if rate := RATES_OF_SHAPES.get(place.function):
        return product(Call(rate.function, place.arguments), _slope_of_passed(place.arguments[0]))
    return Call(place.function, tuple(curve_slope(each) for each in place.arguments))


def _slope_of_passed(e: Expr) -> Expr:
    """Return the derivative by the way of how many pieces are passed, less a number."""
    if not isinstance(e, Call):
        return ONE
    first = _slope_of_passed(e.arguments[0])
    return call("div", first, e.arguments[1]) if e.function == "div" else first
