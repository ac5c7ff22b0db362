"""Numbers and dates for readers, as a locale writes them. Words stay English, and data files never change.

A locale is chosen once, by the option ``--locale`` of a command; without one, texts stay what they are.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from datetime import date
from functools import partial
from typing import Any, NamedTuple
from weakref import WeakSet

from symgen.base.errors import InputError, quote
from symgen.base.files import need_library

#: Digits of a whole number from which on thousands are parted: numbers of four are years, lines and ports as well.
PARTED = 5
#: A number that stands alone: no part of a name, a version, a time or a date, nor of a list without blanks.
_NUMBER = re.compile(r"(?<![\w.,/:@#^_-])([-+−]?)(\d+)(?:\.(\d+(?:e[-+]?\d+)?))?(?!\d|[./:,_-]?(?!i\b)\w)")
#: Code in a sentence, which is left as it is.
_CODE = re.compile(r"(`[^`]*`)")


class Signs(NamedTuple):
    """How a locale writes.

    Attributes
    ----------
    name : str
        Of the locale, as it was given.
    decimal, group : str, str
        Between whole numbers and decimals, and between thousands.
    day : str
        The pattern of a date in numbers, such as ``dd.MM.y``.
    """

    name: str
    decimal: str
    group: str
    day: str


_chosen: list[Signs] = []


def choose_locale(name: str | None) -> None:
    """Write numbers and dates for readers as a locale does, from now on; None: as they are.

    Parameters
    ----------
    name : str or None
        Such as ``de``, ``fr`` or ``de_CH``.

    Raises
    ------
    InputError
        If there is no such locale, or Babel is missing.
    """
    _chosen[:] = [] if name is None else [_signs_of_locale(name)]


def _signs_of_locale(name: str) -> Signs:
    need_library("--locale", "babel", extra="locale")
    from babel import Locale, UnknownLocaleError

    try:
        locale = Locale.parse(name.replace("-", "_"))
    except (UnknownLocaleError, ValueError, TypeError):
        raise InputError("--locale", "a locale, such as de, fr or de_CH", quote(name), _hint_on_locale(name)) from None
    symbols = locale.number_symbols
    signs = symbols.get("latn", symbols)
    pattern = re.sub(r"y+", "y", str(locale.date_formats["short"].pattern))
    return Signs(name, signs["decimal"], signs["group"], pattern)


def _hint_on_locale(word: str) -> str:
    """Return the locale that a language means, in English or in its own words, or whose name begins a longer one."""
    from babel import Locale, localedata

    meant = word.casefold()
    first = re.split(r"[-_.@]", meant)[0]
    codes = [code for code in localedata.locale_identifiers() if "_" not in code]
    english = Locale("en").languages
    if first not in codes:
        own = (code for code in codes if meant == (Locale(code).get_display_name() or "").casefold())
        first = next((code for code in codes if meant == str(english.get(code, "")).casefold()), None) or next(own, "")
    return f"did you mean '{first}'?" if first else ""


def chosen_locale() -> str:
    """Return the name of the chosen locale; empty without one."""
    return _chosen[0].name if _chosen else ""


def local_signs() -> dict[str, str] | None:
    """Return the marks of decimals and thousands of the chosen locale for scripts of pages; None without a locale."""
    return {"decimal": _chosen[0].decimal, "group": _chosen[0].group} if _chosen else None


def local_text(text: str) -> str:
    """Return a sentence or a cell with its numbers as the chosen locale writes them."""
    if not _chosen:
        return text
    parts = _CODE.split(text)
    return "".join(part if k % 2 else _NUMBER.sub(_local_number, part) for k, part in enumerate(parts))


def _local_number(found: re.Match[str]) -> str:
    sign, whole, decimals = found.groups()
    signs = _chosen[0]
    if len(whole) >= PARTED:
        whole = f"{int(whole):,}".replace(",", signs.group)
    return f"{sign}{whole}" if decimals is None else f"{sign}{whole}{signs.decimal}{decimals}"


def local_date(day: date) -> str:
    """Return a date in numbers, as the chosen locale writes it."""
    if not _chosen:
        return day.isoformat()
    from babel.dates import format_date

    return format_date(day, _chosen[0].day, locale="en")


#: Figures are of an optional library, whose types neither have texts for all artists nor let methods be replaced.
_localised: WeakSet[Any] = WeakSet()


def localise_figure(figure: Any) -> None:
    """Write the numbers of the texts and ticks of a figure of matplotlib as the chosen locale does, once."""
    if not _chosen or figure in _localised:
        return
    _localised.add(figure)
    for text in figure.findobj(lambda part: hasattr(part, "set_text")):
        text.set_text(local_text(text.get_text()))
    for axis in (axis for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)):
        for formatter in (axis.get_major_formatter(), axis.get_minor_formatter()):
            formatter.format_ticks = partial(_local_ticks, formatter.format_ticks)


def _local_ticks(format_ticks: Callable[[Sequence[float]], list[str]], values: Sequence[float]) -> list[str]:
    return [local_text(text) for text in format_ticks(values)]
