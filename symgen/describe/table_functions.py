"""Tables of a mechanism: functions of one argument, defined by points."""

from __future__ import annotations

from functools import lru_cache

import msgspec

from symgen.base.ir.interpolation import Interpolation, cubic_pieces, cubic_slopes, pchip_slopes, periodic_slopes
from symgen.base.vocabulary.expressions import SMOOTH


class Table(msgspec.Struct, frozen=True, omit_defaults=True):
    """A function of one argument by interpolation; used as ``NAME(x)``.

    ``linear`` is constant beyond its ends. ``cubic`` (two continuous derivatives) and ``pchip`` (one, and no value
    beyond those of the points) go on in straight lines there, unless they are `periodic`.
    """

    name: str
    x: tuple[float, ...]
    y: tuple[float, ...]
    interpolation: str = "linear"
    periodic: bool = False

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
    if table.interpolation == "pchip":
        slopes = pchip_slopes(x, y, table.periodic)
    else:
        slopes = periodic_slopes(x, y) if table.periodic else cubic_slopes(x, y)
    return Interpolation(table.name, x, y, cubic_pieces(x, y, slopes), x[-1] - x[0] if table.periodic else 0.0)
