"""Units as products of SI base units, in the form of FMI model descriptions."""

from __future__ import annotations

import math
import re
from collections import Counter

#: Symbol of a unit -> exponents of base units and the factor to these.
_UNITS: dict[str, tuple[dict[str, int], float]] = {
    "1": ({}, 1.0),
    **{name: ({name: 1}, 1.0) for name in ("kg", "m", "s", "A", "K", "mol", "cd", "rad")},
    "N": ({"kg": 1, "m": 1, "s": -2}, 1.0),
    "J": ({"kg": 1, "m": 2, "s": -2}, 1.0),
    "W": ({"kg": 1, "m": 2, "s": -3}, 1.0),
    "Pa": ({"kg": 1, "m": -1, "s": -2}, 1.0),
    "V": ({"kg": 1, "m": 2, "s": -3, "A": -1}, 1.0),
    "Hz": ({"s": -1}, 1.0),
    "deg": ({"rad": 1}, math.pi / 180.0),
    "min": ({"s": 1}, 60.0),
    "mm": ({"m": 1}, 1e-3),
    "kN": ({"kg": 1, "m": 1, "s": -2}, 1e3),
}
_FACTOR = re.compile(r"([A-Za-z1]+)(?:\^(-?\d+))?")


def base_unit(unit: str) -> dict[str, int | float] | None:
    """Return the exponents of base units and, unless it is 1, the factor; None for an unknown unit.

    Parameters
    ----------
    unit : str
        Such as ``kg m^2``, ``N/m``, ``N m s/rad``; units after a slash divide.
    """
    exponents, factor = Counter[str](), 1.0
    body = unit.replace("(", "").replace(")", "")
    for k, part in enumerate(body.split("/")):
        for word in part.replace("*", " ").split():
            match = _FACTOR.fullmatch(word)
            if match is None or match[1] not in _UNITS:
                return None
            power = int(match[2] or 1) * (-1 if k else 1)
            own, scale = _UNITS[match[1]]
            factor *= scale**power
            for name, exponent in own.items():
                exponents[name] += power * exponent
    result: dict[str, int | float] = {name: value for name, value in exponents.items() if value}
    return {**result, **({"factor": factor} if factor != 1.0 else {})}
