"""What a person meant where the text of a file is no TOML: the sentence names the slip, not the grammar."""

from __future__ import annotations

import re
from typing import NamedTuple

from symgen.base.errors import quote

_AT = re.compile(r"\(at line (\d+), column (\d+)\)$")
_HEADER = re.compile(r"\s*\[\[?([^\]#=]*)(\]?)")
_PAIR = re.compile(r"\s*(?P<key>[\w.\"'-]+(?: +[\w-]+)*)\s*(?P<sign>[=:])\s*(?P<value>.*?)\s*$")
_DECIMAL_COMMA = re.compile(r"([-+]?\d+),(\d+)\b")
_AMOUNT = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([A-Za-z°µ%][\w°µ^*/. -]*)$")
_COMMENT = re.compile(r"\s*(//|%|--|/\*|;)(.*)$")
_FORMULA = re.compile(r"[\w.(][\w.\s()]*[-+*/^][\w.\s()*/^+-]*$")
_NUMBERS = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_LIST = re.compile(rf"[\[(]\s*({_NUMBERS}(?:\s*[,;\s]\s*{_NUMBERS})+)\s*[\])]?$")
_WORD = re.compile(r"[A-Za-z_][\w.-]*$")
_WORDS = re.compile(r"\[\s*[A-Za-z_][\w.]*(?:\s*,\s*[A-Za-z_][\w.]*)*\s*\]$")
#: Quotation marks that word processors write, and the straight ones.
_CURLY = {**dict.fromkeys("“”„«»", '"'), **dict.fromkeys("‘’‚", "'")}


class Slip(NamedTuple):
    """What is wrong in a text: what was expected, what was found, and the nearest valid spelling."""

    expected: str
    got: str
    hint: str


def slip_in_toml(text: str, message: str) -> Slip:
    """Return what is wrong where a text is no TOML.

    Parameters
    ----------
    text : str
        The text.
    message : str
        Of the reader, which ends in the place.
    """
    lines = text.splitlines() or [""]
    last = f"(at line {len(lines)}, column {len(lines[-1]) + 1})"
    message = message.replace("(at end of document)", last)
    match = _AT.search(message)
    if match is None:
        return _grammar(message)
    number = min(int(match[1]), len(lines))
    if "nclosed array" in message and (opened := _line_that_opens(lines[:number])):
        text = lines[opened - 1].partition("#")[0].strip()
        slip = _slip_in_line(text, "", []) or Slip("']' at the end of a list", quote(text), f"did you mean '{text}]'?")
        return slip._replace(got=f"{slip.got} (at line {opened}, column 1)")
    found = _slip_in_line(lines[number - 1], message, lines[: number - 1])
    return _grammar(message) if found is None else found._replace(got=f"{found.got} {match[0]}")


def _line_that_opens(lines: list[str]) -> int:
    """Return the number of the last line whose list is not closed; 0 where all are."""
    opening = (i + 1 for i, line in reversed([*enumerate(lines)]) if "=" in line and line.count("[") > line.count("]"))
    return next(opening, 0)


def _grammar(message: str) -> Slip:
    """Return what the reader says, where nothing better is known."""
    return Slip("a TOML file", f"a syntax error: {message[:1].lower()}{message[1:]}", "")


def _slip_in_line(line: str, message: str, before: list[str]) -> Slip | None:
    """Return the slip in a line, given what the reader says and the lines before."""
    header = _HEADER.match(line)
    if header is not None and "=" not in line:
        return _slip_in_header(line, header, message, before)
    pair = _PAIR.match(line)
    if pair is None:
        return _slip_without_sign(line)
    key, value = pair["key"], pair["value"]
    if "\N{NO-BREAK SPACE}" in line:
        plain = line.replace("\N{NO-BREAK SPACE}", " ").strip()
        return Slip("plain blanks", "one of a word processor", f"did you mean '{plain}'?")
    if pair["sign"] == ":" and not value and key.partition(".")[2]:
        return Slip("the name of a table in brackets", quote(line.strip()), f"did you mean '[{key}]'?")
    if not value:
        return Slip("a value after '='", quote(line.strip()), "a line without a value is left out")
    if message.startswith("Cannot overwrite"):
        return Slip("each key once in its table", f"a second {quote(key)}", "keep one of the two lines")
    if pair["sign"] == ":":
        return Slip("KEY = VALUE", quote(line.strip()), f"did you mean {quote(f'{key} = {value}')}?")
    meant = _meant_value(value)
    return None if meant is None else Slip(meant.expected, quote(value), meant.hint)


def _slip_in_header(line: str, header: re.Match[str], message: str, before: list[str]) -> Slip | None:
    name, end = header[1].strip(), header[2]
    if message.startswith("Cannot declare"):
        same = [i + 1 for i, one in enumerate(before) if (m := _HEADER.match(one)) and m[1].strip() == name and m[2]]
        where = f"the first one is at line {same[0]}; " if same else ""
        return Slip(f"one table [{name}]", "a second one", f"{where}one table has all keys")
    if not end:
        return Slip("']' at the end of a table's name", quote(line.strip()), f"did you mean '[{name}]'?")
    if line.lstrip().startswith("[["):
        return Slip("one pair of brackets", quote(line.strip()), f"did you mean '[{name}.NAME]', a table for each?")
    if not name.isascii():
        wrong = next(letter for letter in name if not letter.isascii())
        return Slip("a name of letters a to z, digits and _", quote(line.strip()), f"{quote(wrong)} is none of them")
    if " " in name:
        joined = "_".join(name.split())
        return Slip(
            "a name of letters, digits and _, a letter first", quote(line.strip()), f"did you mean '[{joined}]'?"
        )
    return None


def _slip_without_sign(line: str) -> Slip | None:
    """Return the slip in a line that has no sign between a key and its value."""
    key, _, value = line.strip().partition(" ")
    if _WORD.fullmatch(key) and value.strip():
        return Slip("KEY = VALUE", quote(line.strip()), f"did you mean '{key} = {value.strip()}'?")
    return None


def _meant_value(value: str) -> Slip | None:
    """Return what was expected for a value that is none, and its valid spelling."""
    if any(mark in value for mark in _CURLY):
        straight = "".join(_CURLY.get(mark, mark) for mark in value)
        return Slip("straight quotation marks", "", f"did you mean {straight}?")
    bare = value.partition("#")[0].rstrip()
    if bare.startswith("="):
        return Slip("one '='", "", f"did you mean {bare.lstrip('= ')}?")
    if numbers := _LIST.match(bare):
        listed = ", ".join(re.split(r"[,;\s]+", numbers[1]))
        return Slip("a list [a, b] in square brackets, with commas", "", f"did you mean [{listed}]?")
    if re.fullmatch(r"[-+]?\.\d+|[-+]?\d+\.", bare):
        return Slip("a digit on both sides of a decimal point", "", f"did you mean {float(bare)!r}?")
    if comma := _DECIMAL_COMMA.fullmatch(bare):
        return Slip("a decimal point", "", f"did you mean {comma[1]}.{comma[2]}?")
    if bare in ("True", "False"):
        return Slip("true or false", "", f"did you mean {bare.lower()}?")
    if bare.count('"') % 2 == 1:
        return Slip("a closing quotation mark", "", "a text stands between two of them")
    if rest := _after_value(bare):
        comment = _COMMENT.match(rest)
        if comment is not None and comment[1] == ";":
            return Slip("nothing after a value", "", "lines end without a semicolon")
        if comment is not None:
            return Slip("a comment that begins with #", "", f"did you mean '# {comment[2].strip()}'?")
    if amount := _AMOUNT.fullmatch(bare):
        return Slip("a number with its unit in quotation marks", "", f'did you mean "{amount[1]} {amount[2].strip()}"?')
    if _FORMULA.fullmatch(bare):
        return Slip("a formula in quotation marks", "", f'did you mean "{bare}"?')
    if _WORD.fullmatch(bare):
        return Slip("a text in quotation marks", "", f'did you mean "{bare}"?')
    if _WORDS.fullmatch(bare):
        quoted = ", ".join(f'"{word.strip()}"' for word in bare[1:-1].split(","))
        return Slip("texts in quotation marks", "", f"did you mean [{quoted}]?")
    return None


def _after_value(text: str) -> str:
    """Return what follows a number, a text in quotation marks or a list at the start of a text."""
    match = re.match(r"""[-+]?[\d.]+(?:[eE][-+]?\d+)?|"[^"]*"|\[[^\]]*\]|true\b|false\b""", text)
    return "" if match is None else text[match.end() :]
