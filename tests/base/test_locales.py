"""Numbers for readers in German and French: what is a number, and what is a name, a version or data."""

from collections.abc import Iterator
from datetime import date

import pytest

from symgen.base.errors import InputError
from symgen.base.locales import choose_locale, local_date, local_signs, local_text

NARROW = "\u202f"


@pytest.fixture(autouse=True)
def none_afterwards() -> Iterator[None]:
    yield
    choose_locale(None)


@pytest.mark.parametrize(
    ("text", "german", "french"),
    [
        ("t = 0.17 s, -0.5 m.", "t = 0,17 s, -0,5 m.", "t = 0,17 s, -0,5 m."),
        ("123456.5 and 12345", "123.456,5 and 12.345", f"123{NARROW}456,5 and 12{NARROW}345"),
        ("3.1×10⁻⁷ of 55.1%", "3,1×10⁻⁷ of 55,1%", "3,1×10⁻⁷ of 55,1%"),
        ("4.78e-14, 0 +- 5.10162i", "4,78e-14, 0 +- 5,10162i", "4,78e-14, 0 +- 5,10162i"),
        ("(0.25) [1.0, 2.0]", "(0,25) [1,0, 2,0]", "(0,25) [1,0, 2,0]"),
    ],
)
def test_numbers_follow_the_locale(text: str, german: str, french: str) -> None:
    assert local_text(text) == text
    choose_locale("de")
    assert local_text(text) == german
    choose_locale("fr")
    assert local_text(text) == french


@pytest.mark.parametrize(
    "text",
    [
        *("symgen 0.9.0, Python 3.13.0", "four-bar-0.5", "rod.x1.5", "2026-11-30 12:30", "model.toml:12.5"),
        *("`a = 0.5`", "1.2,3.4", "n-four-bar:40", "line 1204 of 2026", "5 of 8 rows"),
    ],
)
def test_names_versions_dates_and_code_stay(text: str) -> None:
    choose_locale("de")
    assert local_text(text) == text


def test_dates_and_marks_of_pages() -> None:
    day = date(2026, 11, 3)
    assert local_date(day) == "2026-11-03" and local_signs() is None
    choose_locale("de")
    assert local_date(day) == "03.11.2026" and local_signs() == {"decimal": ",", "group": "."}
    choose_locale("fr-CH")
    assert local_date(day) == "03.11.2026"
    choose_locale("fr")
    assert local_date(day) == "03/11/2026"


@pytest.mark.parametrize("name", ["", "xx_q", "../de", "de\n", "deutsch und mehr"])
def test_a_locale_that_is_none_is_said(name: str) -> None:
    with pytest.raises(InputError, match="--locale: expected a locale, such as de, fr or de_CH, got"):
        choose_locale(name)
