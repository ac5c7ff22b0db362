"""From the word after a command to a mechanism: a catalogue name or the path of a file.

Bounds of a file are checked on its text before the TOML parser builds anything of it. The parser keeps every prefix
of a dotted key, so a long key costs the square of its parts; brackets that are nested too deep end in a
`RecursionError`. No table of a mechanism file lies deeper than four keys, so the bounds refuse nothing that has a
meaning.
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from symgen.base import arguments
from symgen.base.errors import InputError, quote, suggest
from symgen.base.files import system_message
from symgen.describe.files.meant_files import hint_on_files
from symgen.describe.files.origins import Source, errors_in
from symgen.describe.files.validate import validate
from symgen.describe.formulas.parser import LONGEST_TEXT
from symgen.describe.mechanism import Mechanism
from symgen.describe.parts.own_units import entry_in_si

_CATALOGUE = re.compile(r"(?P<name>[a-z][a-z0-9-]*)(:(?P<size>[0-9]{1,9}))?")

#: Levels of tables in a file.
DEEPEST = 20
#: Maximum bytes of a file, and operators in all formulas together.
LARGEST_FILE = 1_000_000
MOST_OPERATORS = 50_000
#: Parameters: each is a name in every module that is emitted.
MOST_PARAMETERS = 10_000
#: Parts of a dotted key, and parts after the second one in all keys together: the parser keeps a kilobyte for each.
LONGEST_KEY, MOST_PARTS = 8, 50_000

# What may hold a dot that joins no keys (comments and strings) comes first; a string that does not end matches nothing
# here, and the parser reports it. Nothing is tried twice: the loops do not backtrack.
_TOKEN = re.compile(
    r"""(?P<comment>\#[^\n]*+)
      | (?P<long>\"{3}(?:[^"\\]++|\\.|"{1,2}+(?!"))*+"{3,5}+ | '{3}(?:[^']++|'{1,2}+(?!'))*+'{3,5}+)
      | (?P<part>"(?:[^"\\\n]++|\\.)*+" | '[^'\n]*+' | [A-Za-z0-9_+-]++)
      | (?P<dot>\.) | (?P<space>[ \t]++) | (?P<other>.)""",
    re.VERBOSE | re.DOTALL,
)


def load_mechanism(model: str | os.PathLike[str], parameters: Mapping[str, float] | None = None) -> Mechanism:
    """Return the mechanism called `model` in the catalogue or described in the file `model`.

    Parameters
    ----------
    model : str or path
        ``"four-bar"``, ``"n-four-bar:40"`` or the path of a file: TOML, or of another program's format
        (`symgen.describe.formats`), read with a fixed base.
    parameters : mapping of str to float, optional
        Values in SI units in place of the defaults of some parameters; dependent quantities are checked with these.

    Raises
    ------
    InputError
        If the mechanism is unknown or its description is wrong.
    """
    raw, source = read_raw(model)
    return validate(set_parameters(raw, parameters, source) if parameters else raw, source)


def set_parameters(raw: Mapping[str, Any], values: Mapping[str, float], source: str) -> dict[str, Any]:
    """Return the description `raw` with other values for some of its parameters.

    Parameters
    ----------
    raw : mapping
        The description, not yet validated.
    values : mapping of str to float
        New values in SI units; an unknown name is an error.
    source : str
        File name or other origin, for messages.
    """
    section = raw.get("parameters", {})
    entries = dict(section) if isinstance(section, Mapping) else {}
    for name, value in values.items():
        if name not in entries:
            got = f"the unknown parameter {quote(name)}"
            hint = suggest(name, entries) or "it has no parameters"
            raise InputError(f"{source}: parameters", "the name of a parameter", got, hint)
        entries[name] = entry_in_si(entries[name], value)
    return {**raw, "parameters": entries}


def read_raw(model: str | os.PathLike[str]) -> tuple[dict[str, Any], str]:
    """Return the nested dictionary of `model`, not yet validated, and the name of its origin for messages."""
    from symgen.describe import catalogue

    arguments.path_argument("model", model)
    text = os.fspath(model)
    match = _CATALOGUE.fullmatch(text)
    if match and match.group("name") in catalogue.all_names():
        size = match.group("size")
        return catalogue.raw(match.group("name"), None if size is None else int(size)), text
    path = Path(text)
    if _is_file(path):
        return _read_file(path) if path.suffix == ".toml" else _read_other(path)
    entries, expected = catalogue.all_names(), "a catalogue name or the path of a file"
    if path.suffix == ".toml" or os.sep in text or "/" in text:
        own = path.stem in entries and path.name == text
        hint = f"did you mean '{path.stem}' of the catalogue?" if own else hint_on_files(path)
        raise InputError("model", expected, f"{quote(text)}, which is no file", hint)
    if beside := hint_on_files(path):
        raise InputError("model", expected, quote(text), beside)
    hint = suggest(text.partition(":")[0], entries)
    if ":" in text and not hint.startswith("known"):
        hint = f"a size is written as in {catalogue.example_of_size()}"
    raise InputError("model", expected, quote(text), hint)


def _read_file(path: Path) -> tuple[dict[str, Any], Source]:
    """Return the tables of a TOML file."""
    source = Source.of_file(path)
    text = read_text(path)
    with errors_in(source):
        return parse_toml(text, source), source


def _read_other(path: Path) -> tuple[dict[str, Any], Source]:
    """Return the tables of a file of another program's format; without a known end it is TOML."""
    from symgen.describe.formats import format_of, read_robot

    other = format_of(path)
    if other is None:
        return _read_file(path)
    read = read_robot(path, other)
    return read.raw, Source.of_file(path, read.folder)


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):  # a name too long for the system, or with a null character
        return False


def read_text(path: Path) -> str:
    """Return the text of the mechanism file at `path`."""
    try:
        with path.open("rb") as file:
            content = file.read(LARGEST_FILE + 1)
    except OSError as error:
        raise InputError(str(path), "a file that can be read", system_message(error)) from None
    if len(content) > LARGEST_FILE:
        raise InputError(path.name, f"a file of at most {LARGEST_FILE} bytes", "a larger one")
    try:
        return content.decode("utf-8-sig")  # some editors begin files with a byte order mark
    except UnicodeDecodeError as error:
        raise InputError(path.name, "text in UTF-8", f"another byte at position {error.start}") from None


def parse_toml(text: str, source: str) -> dict[str, Any]:
    """Return the tables of TOML text, not yet validated."""
    import tomllib

    _check_text(text, source)
    try:
        raw = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        from symgen.describe.files.slips import slip_in_toml

        raise InputError(source, *slip_in_toml(text, str(error))) from None
    except ValueError:  # of `int`
        digits = sys.get_int_max_str_digits()
        raise InputError(source, f"whole numbers of at most {digits} digits", "a longer one") from None
    except (RecursionError, MemoryError):
        raise _nesting_error(source) from None
    _check_values(raw, source)
    return raw


def _check_text(text: str, source: str) -> None:
    """Refuse TOML text that has keys of too many parts.

    Raises
    ------
    InputError
        With the bound that it exceeds.
    """
    parts = further = 0
    after_dot = False
    for token in _TOKEN.finditer(text):
        kind = token.lastgroup
        if kind == "space":
            continue
        if kind == "part":
            parts = parts + 1 if after_dot else 1
            if parts > LONGEST_KEY:
                expected = f"keys of at most {LONGEST_KEY} parts joined by dots"
                raise InputError(source, expected, f"a longer one {_position_in_words(text, token.start())}")
            further += parts > 2
            if further > MOST_PARTS:
                expected = f"at most {MOST_PARTS} tables inside tables, by dotted keys"
                raise InputError(source, expected, f"more {_position_in_words(text, token.start())}")
        after_dot = kind == "dot"


def _position_in_words(text: str, position: int) -> str:
    """Return a position in words, as `tomllib` has it."""
    line = text.rfind("\n", 0, position) + 1
    return f"(at line {text.count(chr(10), 0, position) + 1}, column {position - line + 1})"


def _check_values(raw: Mapping[str, Any], source: str) -> None:
    """Refuse tables that are nested too deep, or exceed the bounds of a mechanism.

    Raises
    ------
    InputError
        With the bound that they exceed.
    """
    parameters = raw.get("parameters")
    if isinstance(parameters, dict) and len(parameters) > MOST_PARAMETERS:
        raise InputError(f"{source}: parameters", f"at most {MOST_PARAMETERS} parameters", f"{len(parameters)}")
    operators = 0
    stack: list[tuple[object, int]] = [(raw, 0)]
    while stack:
        value, depth = stack.pop()
        if depth > DEEPEST:
            raise _nesting_error(source)
        if isinstance(value, str) and len(value) <= LONGEST_TEXT:  # a longer one is refused where it is read
            operators += sum(map(value.count, "+-*/(<>,"))
        inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
        stack.extend((item, depth + 1) for item in inner)
    if operators > MOST_OPERATORS:
        raise InputError(source, f"formulas of at most {MOST_OPERATORS} operators together", f"{operators}")


def _nesting_error(source: str) -> InputError:
    """Return the error about nesting."""
    return InputError(source, f"tables nested at most {DEEPEST} levels deep", "deeper nesting")
