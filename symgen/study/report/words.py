"""Numbers and lists for readers; plain text that HTML and Markdown show alike."""

from __future__ import annotations

import math
import re

from symgen.base.errors import plural as plural

_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
#: Placeholder of a missing number.
NONE = "–"


def rounded_number(x: float | None, digits: int = 2) -> str:
    """Return a number to some digits: 0.25, 1500, 3.1×10⁻⁷."""
    if x is None:
        return NONE
    if not math.isfinite(x):
        return "not finite"
    if x == 0.0 or 1e-3 <= abs(x) < 1e4:
        text = f"{x:.{digits}g}"
        return f"{float(text):g}" if "e" in text else text
    mantissa, _, exponent = f"{x:.{digits - 1}e}".partition("e")
    power = f"10{str(int(exponent)).translate(_RAISED)}"
    return power if float(mantissa) == 1.0 else f"{mantissa}×{power}".replace("-", "−")


def chosen_number(x: float) -> str:
    """Return a chosen, not measured, number with all its digits: 0.001, 5×10⁻⁵, 10⁻⁸."""
    mantissa, _, exponent = f"{x:g}".partition("e")
    if not exponent:
        return mantissa
    power = f"10{str(int(exponent)).translate(_RAISED)}"
    return power if mantissa == "1" else f"{mantissa}×{power}"


def readable_number(text: str) -> str:
    """Return a sentence of a result with its numbers and signs as in the rest of the report."""
    text = re.sub(r"\b\d+(\.\d+)?e[-+]\d+", lambda m: chosen_number(float(m.group())), text)
    return text.replace("|Phi|", "|Φ|").replace("|D v - nu|", "|D v − ν|")


def seconds_in_words(x: float | None) -> str:
    """Return a duration with its unit: 85 µs, 1.27 ms, 3.4 s."""
    if x is None or not math.isfinite(x):
        return NONE
    for unit, size in (("µs", 1e-6), ("ms", 1e-3)):
        if float(digits := f"{x / size:.3g}") < 1000.0:  # as rounded: 999.6 µs are 1 ms
            return f"{digits} {unit}"
    return f"{x:.3g} s"


#: Prefixes of engineering units, by powers of a thousand.
_PREFIXES = {2: "M", 1: "k", 0: "", -1: "m", -2: "µ"}
#: Units that take one.
_PREFIXED = {"N", "N m", "W", "J", "m"}
#: Units that are written in degrees.
_ANGLES = {"rad", "rad/s", "rad/s^2"}


def engineering_unit(unit: str, size: float) -> tuple[float, str]:
    """Return the unit in which numbers of a size are written, after its size in the unit given: 1000 and kN.

    Angles are degrees; lengths are metres, or millimetres below 0.1 m.
    """
    if unit in _ANGLES:
        return math.radians(1.0), unit.replace("rad", "deg")
    if unit not in _PREFIXED or not 1e-6 <= size < 1e9:
        return 1.0, unit
    level = math.floor(math.log10(float(f"{size:.3g}")) / 3.0)
    if unit == "m" and (level > 0 or size >= 0.1):
        level = 0
    level = min(2, max(-2, level))
    return 1000.0**level, f"{_PREFIXES[level]}{unit}"


def engineering_number(x: float, unit: str) -> str:
    """Return a number to three digits with its unit as engineers write it: 39.2 kN, 2.49 kW, 40.5 deg, 12 mm."""
    if not math.isfinite(x):
        return f"not finite {unit}".strip()
    if unit not in _ANGLES and (unit not in _PREFIXED or not 1e-6 <= abs(x) < 1e9):
        return f"{rounded_number(x, 3)} {unit}".strip()
    size, shown = engineering_unit(unit, abs(x))
    return f"{_three_digits(x / size)} {shown}"


def _three_digits(x: float) -> str:
    """Return three digits without a power of ten where there are few enough."""
    text = f"{x:.3g}"
    return f"{float(text):.0f}" if "e+" in text and abs(x) < 1e6 else text


def percent_in_words(x: float | None) -> str:
    """Return a fraction as percent."""
    if x is None or not math.isfinite(x):
        return NONE
    return f"{100.0 * x:.0f} %" if x >= 0.0995 else f"{100.0 * x:.1f} %"


def ratio_in_words(x: float | None) -> str:
    """Return a ratio to two decimals."""
    return NONE if x is None or not math.isfinite(x) else f"{x:.2f}" if x < 100.0 else f"{x:.0f}"


def range_in_words(low: float | None, high: float | None) -> str:
    """Return an interval of a ratio."""
    return NONE if low is None or high is None else f"{ratio_in_words(low)} – {ratio_in_words(high)}"


def value_with_spread(x: float | None, spread: float | None) -> str:
    """Return a ratio with its spread."""
    return f"{ratio_in_words(x)} ± {ratio_in_words(spread)}" if spread is not None else ratio_in_words(x)


def as_sentence(text: str) -> str:
    """Return text with a capital and a full stop."""
    return text[:1].upper() + text[1:] + ("" if text.endswith((".", ":")) else ".")


def setting_in_words(step: float | None, rtol: float | None) -> str:
    """Return a step or a tolerance in words: step 0.001 s, rtol 10⁻⁸."""
    return f"rtol {chosen_number(rtol)}" if rtol is not None else f"step {chosen_number(step or 0.0)} s"
