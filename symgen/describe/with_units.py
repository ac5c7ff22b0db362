"""What to write in place of a number with its unit, such as ``3 mm``: files hold SI units, without their names."""

from __future__ import annotations

import math
import re

#: Units that people write behind numbers -> how many of the SI unit one is, and that unit.
UNITS = {
    **{"m": (1.0, "m"), "mm": (1e-3, "m"), "cm": (1e-2, "m"), "km": (1e3, "m"), "in": (0.0254, "m")},
    **{"kg": (1.0, "kg"), "g": (1e-3, "kg"), "t": (1e3, "kg"), "lb": (0.45359237, "kg")},
    **{"s": (1.0, "s"), "ms": (1e-3, "s"), "min": (60.0, "s"), "h": (3600.0, "s")},
    **{"N": (1.0, "N"), "kN": (1e3, "N"), "Nm": (1.0, "N m"), "N m": (1.0, "N m")},
    **{"rad": (1.0, "rad"), "deg": (math.pi / 180.0, "rad"), "°": (math.pi / 180.0, "rad")},
    **{"rpm": (math.pi / 30.0, "rad/s"), "rad/s": (1.0, "rad/s"), "deg/s": (math.pi / 180.0, "rad/s")},
    **{"m/s": (1.0, "m/s"), "mm/s": (1e-3, "m/s"), "km/h": (1.0 / 3.6, "m/s"), "N/m": (1.0, "N/m")},
}
_NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\S.*?)\s*")


def in_si(text: str) -> str:
    """Return how a number with a unit is written, as a hint; empty where a text is none, or its unit not known."""
    found = _NUMBER.fullmatch(text)
    if found is None or found[2] not in UNITS:
        return ""
    factor, unit = UNITS[found[2]]
    return f"numbers are in SI units, written without them: {float(found[1]) * factor:.10g} for {unit}"
