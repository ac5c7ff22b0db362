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
    found = _slip_in_line(lines[number - 1], message, lines[: number - 1])
    return _grammar(message) if found is None else found._replace(got=f"{found.got} {match[0]}")


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
        return None
    key, value = pair["key"], pair["value"]
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
    if " " in name:
        joined = "_".join(name.split())
        return Slip(
            "a name of letters, digits and _, a letter first", quote(line.strip()), f"did you mean '[{joined}]'?"
        )
    return None


def _meant_value(value: str) -> Slip | None:
    """Return what was expected for a value that is none, and its valid spelling."""
    if any(mark in value for mark in _CURLY):
        straight = "".join(_CURLY.get(mark, mark) for mark in value)
        return Slip("straight quotation marks", "", f"did you mean {straight}?")
    bare = value.partition("#")[0].rstrip()
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
