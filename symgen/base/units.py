"""Units of measurement: their texts read into factors to SI units, and the numbers converted exactly.

A unit is a product of symbols with whole powers, such as ``kg m^2``, ``N m/rad``, ``1/min`` or ``W/(m K)``. One
factor follows a slash, or several in brackets.
"""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

from symgen.base.errors import InputError, quote, suggest
from symgen.base.unit_symbols import ALIKE, COMMON, DERIVED, MEANT, OTHERS, SPELLINGS, SYMBOLS

#: Characters of a unit, largest power, and characters of a text that is compared with numbers.
LONGEST_UNIT, LARGEST_POWER, LONGEST_AMOUNT = 40, 12, 80

#: Characters at most of a word that may be several symbols, and of the longest of these.
LONGEST_RUN, LONGEST_SYMBOL = 8, 4

_DIGITS = re.compile(r"[1-9]")
_WORD = re.compile(r"\s*([A-Za-z][A-Za-z0-9]*|1|%)")
_FACTOR = re.compile(r"\s*[A-Za-z0-9%(]")
_POWER = re.compile(r"\s*\^(-?[0-9]{1,2})(?![0-9])")
_AMOUNT = re.compile(
    r"\s*(?P<number>[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)\s*(?P<unit>\S.*)?", re.DOTALL
)
_WORD_OF_FORMULA = re.compile(r"(?:if|and|or|not|else)\b|\*\*|[-+*/<>=!,)]")


@dataclass(frozen=True)
class Unit:
    """A unit.

    Attributes
    ----------
    text : str
        As written.
    si : str
        The SI unit of the same quantity; `text` itself where it is one.
    factor : Fraction
        SI units in one of these.
    exponents : tuple of (str, int)
        Exponents of base units, in the order of the text; the radian is one of them.
    cycles : bool
        Whether it counts cycles (Hz), which angular velocities are not measured in.
    """

    text: str
    si: str
    factor: Fraction
    exponents: tuple[tuple[str, int], ...]
    cycles: bool = False

    @property
    def is_si(self) -> bool:
        """Whether numbers in it are numbers in SI units."""
        return self.factor == 1

    def to_si(self, value: float) -> float:
        """Return a number in this unit in SI units, rounded once from its decimal digits."""
        return (
            value
            if self.is_si or not math.isfinite(value)
            else _round_fraction(Fraction(repr(float(value))) * self.factor)
        )

    def from_si(self, value: float) -> float:
        """Return a number in SI units in this unit: one of at most 15 digits where such a number means it."""
        if self.is_si or not math.isfinite(value):
            return value
        number = _round_fraction(Fraction(repr(float(value))) / self.factor)
        short = float(f"{number:.15g}")
        return short if self.to_si(short) == value else number

    def fits(self, other: Unit) -> bool:
        """Whether both are units of one quantity; radians may be left out, but count neither as 1 nor as cycles."""
        own, others = dict(self.exponents), dict(other.exponents)
        alike = own.pop("rad", 0) == others.pop("rad", 0)
        return own == others and (alike or (bool(own) and not self.cycles and not other.cycles))


def _round_fraction(value: Fraction) -> float:
    try:
        return float(value)
    except OverflowError:
        return math.inf if value > 0 else -math.inf


def read_unit(text: str) -> Unit | str:
    """Return the unit that a text means, or the part of the text that is no unit; an empty text is the unit of 1."""
    return text if len(text) > LONGEST_UNIT or not text.isprintable() else _read_unit_text(text)


@lru_cache(maxsize=4096)
def _read_unit_text(text: str) -> Unit | str:
    """Return the unit that a text of any length means, or the part of it that is no unit."""
    if not text:
        return Unit("", "", Fraction(1), ())
    written = text
    for spelling, symbol in SPELLINGS.items():
        written = written.replace(spelling, symbol)
    return _Reader(text, written.strip()).read_whole_unit()


def unit_of(text: str, where: str, *, quantity: str = "") -> Unit:
    """Return the unit that a text means; an empty text is the unit of a plain number.

    Parameters
    ----------
    text, where : str
        The unit as written; file and key, for messages.
    quantity : str
        An SI unit of the quantity, where this is known.

    Raises
    ------
    InputError
        If it is no unit, or none of that quantity.
    """
    unit = read_unit(text)
    expected = f"a unit such as {ALIKE.get(quantity, quantity)}" if quantity else "a unit such as 'kg m^2'"
    if isinstance(unit, str):
        if len(text) > LONGEST_UNIT or not text.isprintable():
            expected += f", at most {LONGEST_UNIT} characters on one line"
        raise InputError(where, expected, quote(text), _unit_hint(unit, text, quantity))
    if quantity and not unit.fits(known_unit(quantity)):
        raise InputError(where, expected, quote(text))
    return unit


def known_unit(text: str) -> Unit:
    """Return the unit of a text that has been checked, or that the program wrote, which may be a longer one."""
    unit = _read_unit_text(text)
    assert isinstance(unit, Unit), text
    return unit


def _unit_hint(part: str, text: str, quantity: str) -> str:
    """Return the nearest spelling of what is no unit, else, unless the quantity is known, the usual units."""
    if part == SLASH:
        return "one factor follows '/', or several in brackets, as in 'W/(m K)'"
    if text.startswith("^"):
        return "a power of a number is written **"
    if re.match(r"[·×∙]?[A-Za-z]\w*\(", text):
        return f"a product is written with *, as in 2*{text.lstrip('·×∙')[:20]}"
    what = "" if part == text or len(part) > 12 else f"{quote(part)} is no unit, "
    if part in MEANT:
        return f"{what}did you mean '{MEANT[part]}'?"
    if (power := re.fullmatch(r"([A-Za-z]+)(-?[0-9]{1,2})", part)) and power[1] in SYMBOLS:
        return f"{what}did you mean '{power[1]}^{power[2]}'?"
    if quantity and (apart := _symbols_apart(part, text, known_unit(quantity))):
        return f"{what}did you mean '{apart}'?"
    folded = {name.casefold(): name for name in reversed([*COMMON, *SYMBOLS])}
    same = folded.get(part.casefold())
    near = f"did you mean '{same}'?" if same else suggest(part, COMMON)
    if near.startswith("did"):
        return what + near
    return what.removesuffix(", ") if quantity else f"{what}units are those of the SI, {OTHERS}"


def _symbols_apart(part: str, text: str, quantity: Unit) -> str:
    """Return ``kg m^2`` of ``kgm2``: the symbols of a word apart, if they make a unit of the quantity; else nothing."""

    def split(word: str) -> Iterator[str]:
        for end in range(min(len(word), LONGEST_SYMBOL), 0, -1):
            if word[:end] in SYMBOLS:
                power = _DIGITS.match(word, end)
                rest = power.end() if power else end
                symbol = f"{word[:end]}^{power[0]}" if power else word[:end]
                yield from (f"{symbol} {more}" for more in split(word[rest:])) if word[rest:] else (symbol,)

    readings = (text.replace(part, symbols, 1) for symbols in split(part)) if len(part) <= LONGEST_RUN else ()
    for written in readings:
        unit = read_unit(written)
        if isinstance(unit, Unit) and unit.fits(quantity):
            return written
    return ""


@dataclass(frozen=True)
class _Part:
    """A product read so far: its factor, its exponents by base unit, its SI text and whether it counts cycles."""

    factor: Fraction
    exponents: Counter[str]
    si: str
    cycles: bool = False

    def times(self, other: _Part, sign: str) -> _Part:
        """Return the product with another, or where `sign` is a slash the quotient."""
        way = -1 if sign == "/" else 1
        exponents = Counter(self.exponents)
        for base, exponent in other.exponents.items():
            exponents[base] += way * exponent
        si = f"({other.si})" if sign == "/" and _COMPOSED.search(other.si) else other.si
        own = f"({self.si})" if sign != "/" and "/" in self.si else self.si
        return _Part(self.factor * other.factor**way, exponents, f"{own}{sign}{si}", self.cycles or other.cycles)

    def power(self, exponent: int) -> _Part:
        """Return a power."""
        exponents = Counter({base: n * exponent for base, n in self.exponents.items()})
        si = f"({self.si})" if re.search(r"\W", self.si) else self.si
        return _Part(self.factor**exponent, exponents, f"{si}^{exponent}", self.cycles)


#: What is wrong with a text such as ``a/b c``.
SLASH = "/"
#: Signs of a text that needs brackets after a slash.
_COMPOSED = re.compile(r"[ */]")


class _NoUnit(Exception):
    """The text is no unit; holds the part that is none."""


class _Reader:
    """The text of a unit being read."""

    def __init__(self, text: str, written: str) -> None:
        self.text, self.written, self.position = text, written, 0

    def read_whole_unit(self) -> Unit | str:
        try:
            part = self.read_product()
            if self.position < len(self.written):
                return self.unread_word()
        except _NoUnit as error:
            return str(error)
        exponents = tuple((base, power) for base, power in part.exponents.items() if power)
        return Unit(self.text, self.text if part.factor == 1 else part.si, part.factor, exponents, part.cycles)

    def unread_word(self) -> str:
        """Return the word at which reading ended."""
        return re.split(r"[\s*/()^]", self.written[self.position :].strip(), maxsplit=1)[0] or self.text

    def take_sign(self, signs: str) -> str:
        """Take the next sign, if it is one of `signs`."""
        match = re.compile(rf"\s*([{re.escape(signs)}])").match(self.written, self.position)
        self.position = match.end() if match else self.position
        return match[1] if match else ""

    def read_product(self) -> _Part:
        """Read factors side by side, then quotients."""
        part = self.read_factor()
        while True:
            if self.take_sign("/"):
                part = part.times(self.read_factor(), "/")
                if self.take_sign("*") or _FACTOR.match(self.written, self.position):
                    raise _NoUnit(SLASH)  # a/b c is read in two ways
            elif star := self.take_sign("*"):
                part = part.times(self.read_factor(), star)
            elif _FACTOR.match(self.written, self.position):
                part = part.times(self.read_factor(), " ")
            else:
                return part

    def read_factor(self) -> _Part:
        """Read a symbol, or a product in brackets, with its power."""
        if self.take_sign("("):
            part = self.read_product()
            if not self.take_sign(")"):
                raise _NoUnit(self.text)
        else:
            match = _WORD.match(self.written, self.position)
            symbol = SYMBOLS.get(match[1]) if match else None
            if match is None or symbol is None:
                raise _NoUnit(match[1] if match else self.text)
            self.position = match.end()
            si = match[1] if symbol.factor == 1 else symbol.si
            part = _Part(symbol.factor, _base_unit_exponents(symbol.si), si, symbol.si == "Hz")
        power = _POWER.match(self.written, self.position)
        if power is None:
            return part
        if not 0 < abs(int(power[1])) <= LARGEST_POWER:
            raise _NoUnit(self.text)
        self.position = power.end()
        return part.power(int(power[1]))


def _base_unit_exponents(si: str) -> Counter[str]:
    """Return the exponents of base units in the SI unit of a symbol."""
    total = Counter[str]()
    for i, part in enumerate(si.split("/")):
        for factor in part.split():
            name, _, power = factor.partition("^")
            for base, exponent in DERIVED.get(name, {name: 1}).items():
                total[base] += exponent * int(power or 1) * (-1 if i else 1)
    return total


#: The unit of a number of which nothing is known.
SI = known_unit("")


# -- numbers with units ------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Amount:
    """A number with a unit, as written: ``600 mm``.

    Attributes
    ----------
    number : float
        The number.
    unit : str
        The text after it; empty where there is none.
    """

    number: float
    unit: str = ""

    def in_si(self, where: str, quantity: str = "", usual: str = "") -> float:
        """Return the number in SI units.

        Parameters
        ----------
        where, quantity : str
            As of `unit_of`.
        usual : str
            The unit of a number without one, SI by default.
        """
        unit = unit_of(self.unit, where, quantity=quantity) if self.unit else known_unit(usual)
        return finite_number(unit.to_si(self.number), where)


def read_amount(text: str) -> Amount | None:
    """Return the number with or without a unit that a text is; None where it is something else, such as a formula."""
    match = _AMOUNT.fullmatch(text) if len(text) <= LONGEST_AMOUNT else None
    if match is None or _WORD_OF_FORMULA.match(match["unit"] or ""):
        return None
    return Amount(float(match["number"]), (match["unit"] or "").strip())


def si_hint(value: object) -> str:
    """Return a hint with the number in SI units, where a text is a number with a unit in place of a number."""
    amount = read_amount(value) if isinstance(value, str) else None
    unit = read_unit(amount.unit) if amount is not None and amount.unit else None
    if amount is None or not isinstance(unit, Unit):
        return ""
    return f"numbers are in SI units here: {unit.to_si(amount.number)!r}"


def finite_number(value: float, where: str) -> float:
    """Return a finite number."""
    if not math.isfinite(value):
        raise InputError(where, "a finite number", str(value))
    return value
