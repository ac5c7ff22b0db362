"""What a person meant where a text is no formula: hints that name the slip and its valid spelling."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from symgen.base.units import Unit, read_unit
from symgen.describe.formulas.identifiers import CALLABLE

#: A number followed by a word, which may be a unit.
_WITH_UNIT = re.compile(r"(?<![A-Za-z0-9_])[0-9.]+(?:[eE][-+]?[0-9]+)?\s*([A-Za-z%°]+)")
_PRODUCT = re.compile(r"(?<![A-Za-z0-9_.])([0-9]+\.?[0-9]*)([A-Za-z][A-Za-z0-9_.]*)")
_CALL = re.compile(rf"\b({'|'.join(sorted(CALLABLE))})\s+([A-Za-z0-9_.]+)")
_COMMA = re.compile(r"(?<![A-Za-z0-9_.])([0-9]+),\s?([0-9]+)")
#: Words that users write for names of formulas, and for coordinates and velocities of bodies.
_NAMES = {"time": "t", "pi": "pi", "π": "pi", "seconds": "t"}
_COORDINATES = {
    **dict.fromkeys(("angle", "phi", "rotation", "orientation"), "theta"),
    **dict.fromkeys(("theta_dot", "thetadot", "angular_velocity", "rate", "dtheta"), "omega"),
    **{"xdot": "vx", "x_dot": "vx", "dx": "vx", "ydot": "vy", "y_dot": "vy", "dy": "vy", "zdot": "vz"},
}
_CONDITIONS = "conditions are written with <, <=, > and >="
_PRODUCTS, _MINUS, _QUOTES = "a product is written with *", "a minus is written -", "a formula has no text in it"
_SIGNS = {
    **{"^": "a power is written **", "²": "a power is written **", "³": "a power is written **"},
    **{"%": "there is no remainder", "=": _CONDITIONS, "!": f"{_CONDITIONS}, and 'not'"},
    **{"≤": _CONDITIONS, "≥": _CONDITIONS, "&": "write 'and'", "|": "write 'or'", "[": "a formula has no lists"},
    **{'"': _QUOTES, "'": _QUOTES, "·": _PRODUCTS, "×": _PRODUCTS, "∙": _PRODUCTS, "÷": "a division is written /"},
    **{"−": _MINUS, "–": _MINUS, "{": "groups are in round brackets", "?": "a choice is written A if CONDITION else B"},
}


def hint_on_sign(sign: str, text: str) -> str:
    """Return a hint on a sign that has no place in a formula."""
    return _SIGNS.get(sign, "") or hint_on_units(text)


def hint_on_units(text: str) -> str:
    """Return a hint where a number in a formula has a unit, or no sign of a product."""
    words = (match[1] for match in _WITH_UNIT.finditer(text))
    unit = next((word for word in words if isinstance(read_unit(word), Unit)), "")
    if unit:
        return f"a formula has no units, its numbers are in SI units: make the number in {unit} a parameter"
    product = _PRODUCT.search(text)
    return "" if product is None else f"did you mean '{product[1]}*{product[2]}'?"


def hint_on_grammar(text: str) -> str:
    """Return a hint where the parts of a text are right and their order is not."""
    if re.search(r"\bthen\b", text):
        return "a choice is written A if CONDITION else B"
    if call := _CALL.search(text):
        return f"did you mean '{call[1]}({call[2]})'?"
    opened = text.count("(") - text.count(")")
    if opened:
        return f"a bracket {'is not closed' if opened > 0 else 'closes that none opens'}"
    return hint_on_units(text)


def hint_on_commas(text: str) -> str:
    """Return a hint where a comma may be a decimal one."""
    comma = _COMMA.search(text)
    return "" if comma is None else f"did you mean {comma[1]}.{comma[2]}, with a decimal point?"


def meant_name(name: str, known: Iterable[str], coordinates: Mapping[str, tuple[str, ...]]) -> str:
    """Return the hint on a name that is none: another word, or a coordinate without its body; empty if neither is."""
    word = _NAMES.get(name.lower(), "")
    if word in known:
        return f"did you mean '{word}'?"
    owner = next((body for body, own in coordinates.items() if name in own), "")
    return f"a coordinate has its body before it: did you mean '{owner}.{name}'?" if owner else ""


def meant_coordinate(owner: str, name: str, known: Iterable[str]) -> str:
    """Return the hint on a word for a coordinate or velocity of a body, empty if there is none."""
    word = _COORDINATES.get(name.lower(), "")
    return f"did you mean '{owner}.{word}'?" if word in known else ""
