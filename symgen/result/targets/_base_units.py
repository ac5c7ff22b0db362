"""Units as products of SI base units, in the form of FMI model descriptions."""

from __future__ import annotations

from symgen.base.units import read_unit


def base_unit(unit: str) -> dict[str, int | float] | None:
    """Return the exponents of base units and, unless it is 1, the factor; None for an unknown unit.

    Parameters
    ----------
    unit : str
        Such as ``kg m^2``, ``N/m``, ``N m s/rad``.
    """
    read = read_unit(unit)
    if isinstance(read, str):
        return None
    factor = {} if read.is_si else {"factor": float(read.factor)}
    return {**dict(read.exponents), **factor}
