"""Symbols of units with their factors to SI units: the one table that everything about units is read from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

#: pi, with more digits than a double has.
PI = Fraction("3.14159265358979323846264338327950288419716939937510")


@dataclass(frozen=True)
class Symbol:
    """The symbol of a unit.

    Attributes
    ----------
    name : str
        The unit in words.
    si : str
        The SI unit of the same quantity, as a text of base and derived SI units.
    factor : Fraction
        SI units in one of these.
    """

    name: str
    si: str
    factor: Fraction = Fraction(1)


def _symbol_of_unit(name: str, si: str, factor: str | int | Fraction = 1) -> Symbol:
    return Symbol(name, si, Fraction(factor))


_POUND, _GRAVITY, _INCH = Fraction("0.45359237"), Fraction("9.80665"), Fraction("0.0254")
#: Symbols that prefixes may precede.
PREFIXABLE: Mapping[str, Symbol] = {
    "m": _symbol_of_unit("metre", "m"),
    "g": _symbol_of_unit("gram", "kg", "0.001"),
    "s": _symbol_of_unit("second", "s"),
    "A": _symbol_of_unit("ampere", "A"),
    "K": _symbol_of_unit("kelvin", "K"),
    "mol": _symbol_of_unit("mole", "mol"),
    "rad": _symbol_of_unit("radian", "rad"),
    "N": _symbol_of_unit("newton", "N"),
    "J": _symbol_of_unit("joule", "J"),
    "W": _symbol_of_unit("watt", "W"),
    "Pa": _symbol_of_unit("pascal", "Pa"),
    "Hz": _symbol_of_unit("hertz", "Hz"),
    "V": _symbol_of_unit("volt", "V"),
    "C": _symbol_of_unit("coulomb", "C"),
    "F": _symbol_of_unit("farad", "F"),
    "ohm": _symbol_of_unit("ohm", "ohm"),
    "S": _symbol_of_unit("siemens", "S"),
    "Wb": _symbol_of_unit("weber", "Wb"),
    "T": _symbol_of_unit("tesla", "T"),
    "H": _symbol_of_unit("henry", "H"),
    "bar": _symbol_of_unit("bar", "Pa", 100000),
    "L": _symbol_of_unit("litre", "m^3", "0.001"),
    "l": _symbol_of_unit("litre", "m^3", "0.001"),
    "Nm": _symbol_of_unit("newton metre", "N m"),
    "Wh": _symbol_of_unit("watt hour", "J", 3600),
}
#: Symbols that take no prefix.
PLAIN: Mapping[str, Symbol] = {
    "1": _symbol_of_unit("one", "1"),
    "%": _symbol_of_unit("per cent", "1", "0.01"),
    "cd": _symbol_of_unit("candela", "cd"),
    "deg": _symbol_of_unit("degree", "rad", PI / 180),
    "arcmin": _symbol_of_unit("minute of arc", "rad", PI / 10800),
    "arcsec": _symbol_of_unit("second of arc", "rad", PI / 648000),
    "rev": _symbol_of_unit("revolution", "rad", 2 * PI),
    "rpm": _symbol_of_unit("revolution per minute", "rad/s", PI / 30),
    "min": _symbol_of_unit("minute", "s", 60),
    "h": _symbol_of_unit("hour", "s", 3600),
    "d": _symbol_of_unit("day", "s", 86400),
    "t": _symbol_of_unit("tonne", "kg", 1000),
    "kgf": _symbol_of_unit("kilogram-force", "N", _GRAVITY),
    "kp": _symbol_of_unit("kilopond", "N", _GRAVITY),
    "PS": _symbol_of_unit("metric horsepower", "W", 75 * _GRAVITY),
    "atm": _symbol_of_unit("standard atmosphere", "Pa", 101325),
    "Nmm": _symbol_of_unit("newton millimetre", "N m", "0.001"),
    "Ncm": _symbol_of_unit("newton centimetre", "N m", "0.01"),
    "in": _symbol_of_unit("inch", "m", _INCH),
    "ft": _symbol_of_unit("foot", "m", 12 * _INCH),
    "yd": _symbol_of_unit("yard", "m", 36 * _INCH),
    "mi": _symbol_of_unit("mile", "m", 63360 * _INCH),
    "mph": _symbol_of_unit("mile per hour", "m/s", 63360 * _INCH / 3600),
    "lb": _symbol_of_unit("pound", "kg", _POUND),
    "oz": _symbol_of_unit("ounce", "kg", _POUND / 16),
    "slug": _symbol_of_unit("slug", "kg", _POUND * _GRAVITY / (12 * _INCH)),
    "lbf": _symbol_of_unit("pound-force", "N", _POUND * _GRAVITY),
    "psi": _symbol_of_unit("pound-force per square inch", "Pa", _POUND * _GRAVITY / _INCH**2),
    "ksi": _symbol_of_unit("thousand pound-force per square inch", "Pa", 1000 * _POUND * _GRAVITY / _INCH**2),
    "hp": _symbol_of_unit("horsepower", "W", 550 * 12 * _INCH * _POUND * _GRAVITY),
}
#: Prefix -> its power of ten.
PREFIXES: Mapping[str, int] = {
    **{"f": -15, "p": -12, "n": -9, "u": -6, "m": -3, "c": -2, "d": -1},
    **{"da": 1, "h": 2, "k": 3, "M": 6, "G": 9, "T": 12},
}
#: Further spellings of symbols and signs; the first three are different characters that look alike.
SPELLINGS: Mapping[str, str] = {
    **{"\u00b5": "u", "\u03bc": "u", "\u03a9": "ohm", "\u2126": "ohm", "°": "deg"},
    **{"\u00b7": "*", "\u22c5": "*", "\u00d7": "*", "\u2212": "-", "**": "^"},
    **{"²": "^2", "³": "^3", "⁴": "^4", "⁻¹": "^-1", "⁻²": "^-2"},
}
#: Words and habits that are no symbols -> the symbol that they mean.
MEANT: Mapping[str, str] = {
    **{"meter": "m", "meters": "m", "metre": "m", "metres": "m", "millimeter": "mm", "millimetre": "mm"},
    **{"degree": "deg", "degrees": "deg", "radian": "rad", "radians": "rad", "grad": "deg", "turn": "rev"},
    **{"sec": "s", "secs": "s", "second": "s", "seconds": "s", "minute": "min", "minutes": "min", "hour": "h"},
    **{"hours": "h", "hr": "h", "kilogram": "kg", "kilo": "kg", "gram": "g", "gramm": "g", "ton": "t", "tonne": "t"},
    **{"newton": "N", "Newton": "N", "newtons": "N", "joule": "J", "watt": "W", "pascal": "Pa", "hertz": "Hz"},
    **{"inch": "in", "inches": "in", "foot": "ft", "feet": "ft", "lbs": "lb", "pound": "lb", "kph": "km/h"},
    **{"kmh": "km/h", "rps": "rev/s", "RPM": "rpm", "KG": "kg", "Kg": "kg", "KN": "kN", "kn": "kN", "MM": "mm"},
    **{"hz": "Hz", "mps": "m/s", "percent": "%", "Ohm": "ohm", "pa": "Pa", "Mpa": "MPa", "mpa": "MPa"},
}
#: Exponents of base units in derived SI units.
DERIVED: Mapping[str, Mapping[str, int]] = {
    "N": {"kg": 1, "m": 1, "s": -2},
    "J": {"kg": 1, "m": 2, "s": -2},
    "W": {"kg": 1, "m": 2, "s": -3},
    "Pa": {"kg": 1, "m": -1, "s": -2},
    "Hz": {"s": -1},
    "V": {"kg": 1, "m": 2, "s": -3, "A": -1},
    "C": {"A": 1, "s": 1},
    "F": {"kg": -1, "m": -2, "s": 4, "A": 2},
    "ohm": {"kg": 1, "m": 2, "s": -3, "A": -2},
    "S": {"kg": -1, "m": -2, "s": 3, "A": 2},
    "Wb": {"kg": 1, "m": 2, "s": -2, "A": -1},
    "T": {"kg": 1, "s": -2, "A": -1},
    "H": {"kg": 1, "m": 2, "s": -2, "A": -2},
    "1": {},
}
BASES = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")


def _table_of_symbols() -> dict[str, Symbol]:
    table = dict(PLAIN)
    for prefix, power in PREFIXES.items():
        for symbol, of in PREFIXABLE.items():
            name = f"{prefix}{symbol}"
            table.setdefault(name, Symbol(f"10^{power} {of.name}", of.si, of.factor * Fraction(10) ** power))
    return {**table, **PREFIXABLE}


#: All symbols with all prefixes.
SYMBOLS: Mapping[str, Symbol] = _table_of_symbols()


#: Symbols that hints compare with and list.
COMMON = (
    *("m", "mm", "cm", "um", "km", "kg", "g", "t", "s", "ms", "us", "min", "h", "rad", "deg", "rev", "rpm", "N", "kN"),
    *("MN", "Nm", "J", "kJ", "W", "kW", "Pa", "kPa", "MPa", "GPa", "bar", "Hz", "A", "V", "K", "in", "ft", "lb", "lbf"),
    "psi",
)
#: What units there are besides those of the SI, in short.
OTHERS = "with prefixes such as k and m, and deg, rev, rpm, min, h, bar, L, t, in, ft, lb, lbf, psi and the like"
#: SI unit of a quantity -> further units of it that hints name.
ALIKE: Mapping[str, str] = {
    "m": "m, mm, cm, km, in",
    "rad": "rad, deg, rev",
    "kg": "kg, g, t, lb",
    "s": "s, ms, min, h",
    "m/s": "m/s, mm/s, km/h",
    "rad/s": "rad/s, deg/s, rpm, rev/s",
    "N": "N, kN, MN, lbf",
    "N m": "N m, N mm, kN m",
    "N/m": "N/m, N/mm, kN/m",
    "N s/m": "N s/m, N s/mm, kN s/m",
    "kg m^2": "kg m^2, g cm^2, kg mm^2",
    "Pa": "Pa, MPa, GPa, bar",
    "1": "1 or none, %",
}
