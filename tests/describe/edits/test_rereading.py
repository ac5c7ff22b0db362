"""Texts that are read by their numbers, beside the same texts read whole."""

from __future__ import annotations

import random
import re

import pytest

from symgen.base.errors import InputError
from symgen.describe import catalogue
from symgen.describe.edits.rereading import ReadText, read_text_after

SOURCE = "a.toml"


def whole(text: str) -> ReadText:
    return read_text_after(None, text, SOURCE)


def with_other_numbers(text: str, chance: random.Random) -> str:
    """Return a text in which half of the numbers that stand alone are others, of other lengths."""
    others = ("0", "-3", "12345", "7.25", "-1e-3", "0.5E+2", "+2.0")

    def line_with_others(line: str) -> str:
        pattern = r"(?<=[\[ ])-?[0-9]+\.[0-9]+(?=[,\] \n])"
        return line if "#" in line else re.sub(pattern, lambda m: chance.choice((m[0], chance.choice(others))), line)

    return "".join(map(line_with_others, text.splitlines(keepends=True)))


@pytest.mark.parametrize("entry", ["four-bar", "andrews", "bricard", "slider-crank"])
def test_a_text_with_other_numbers_is_read_as_a_whole_one(entry: str) -> None:
    file, chance = catalogue.file_of_entry(entry), random.Random(3)
    assert file is not None
    before = whole(file.read_text(encoding="utf-8"))
    for _ in range(4):
        text = with_other_numbers(before.text, chance)
        again, expected = read_text_after(before, text, SOURCE), whole(text)
        assert again.kind is before.kind and text != before.text
        assert again[:3] == expected[:3] and again.numbers == expected.numbers
        assert repr(again.raw) == repr(expected.raw)  # 1 and 1.0 are equal, but not alike
        before = again


TEXT = 'a = 1.0  # 2 of them\n[b]\nc = [1, -2.5, "3.0"]\nd = { e = 4, f = 1979-05-27 }\n'


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("1.0", "1.0x"),
        ("1.0", "01"),
        ("1.0", "1."),
        ("1.0", '"1.0"'),
        ("1.0", "1_0"),
        ("1.0", "0x10"),
        ("2 of", "3 of"),
        ("-2.5", "-2.5, 6"),
        ('"3.0"', '"3.5"'),
        ("4", "{}"),
        ("1979", "1978"),
        ("e =", "g ="),
        ("4, f", "5, g"),
        ("\n[b]", "\n\n[b]"),
    ],
)
def test_a_text_with_another_change_is_read_whole(old: str, new: str) -> None:
    before, text = whole(TEXT), TEXT.replace(old, new, 1)
    try:
        expected = whole(text)
    except InputError as error:
        with pytest.raises(InputError, match=re.escape(str(error))):
            read_text_after(before, text, SOURCE)
        return
    again = read_text_after(before, text, SOURCE)
    assert again.kind is not before.kind and again[:4] == expected[:4]


def test_numbers_that_changed_are_told_by_their_paths() -> None:
    before = whole(TEXT)
    again = read_text_after(before, TEXT.replace("-2.5", "17").replace("e = 4", "e = 4.5"), SOURCE)
    assert again.changed_numbers(before) == {("b", "c", 1): 17.0, ("b", "d", "e"): 4.5}
    assert before.changed_numbers(again) == {("b", "c", 1): -2.5, ("b", "d", "e"): 4.0}
