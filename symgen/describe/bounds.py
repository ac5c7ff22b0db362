"""Bounds of a mechanism file, checked on its text before the TOML parser builds anything of it.

The parser keeps every beginning of a dotted key, so a long key costs the square of its parts; brackets that are nested
too deep end in a `RecursionError`. No table of a mechanism file lies deeper than four keys, so the bounds refuse
nothing that has a meaning.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from symgen.describe.parser import LONGEST_TEXT
from symgen.errors import InputError

#: Bytes of a file, levels of nesting, and operators in all formulas together.
LARGEST_FILE = 1_000_000
DEEPEST = 20
MOST_OPERATORS = 50_000
#: Parameters: each is a name in every module that is emitted.
MOST_PARAMETERS = 10_000
#: Parts of a dotted key, and parts behind the second one in all keys together: the parser keeps a kilobyte for each.
LONGEST_KEY, MOST_PARTS = 8, 50_000

# What may hold a dot that joins no keys (comments and strings) comes first; a string that does not end matches nothing
# here, and the parser says so. Nothing is tried twice: the loops keep what they have.
_TOKEN = re.compile(
    r"""(?P<comment>\#[^\n]*+)
      | (?P<long>\"{3}(?:[^"\\]++|\\.|"{1,2}+(?!"))*+"{3,5}+ | '{3}(?:[^']++|'{1,2}+(?!'))*+'{3,5}+)
      | (?P<part>"(?:[^"\\\n]++|\\.)*+" | '[^'\n]*+' | [A-Za-z0-9_+-]++)
      | (?P<dot>\.) | (?P<space>[ \t]++) | (?P<other>.)""",
    re.VERBOSE | re.DOTALL,
)


def check_text(text: str, source: str) -> None:
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
                raise InputError(source, f"keys of at most {LONGEST_KEY} parts joined by dots", "a longer one")
            further += parts > 2
            if further > MOST_PARTS:
                raise InputError(source, f"at most {MOST_PARTS} tables inside tables, by dotted keys", "more")
        after_dot = kind == "dot"


def check_values(raw: Mapping[str, Any], source: str) -> None:
    """Refuse tables that are nested too deep, or hold more than a mechanism can mean.

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
            raise too_deep(source)
        if isinstance(value, str) and len(value) <= LONGEST_TEXT:  # a longer one is refused where it stands
            operators += sum(map(value.count, "+-*/(<>,"))
        inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
        stack.extend((item, depth + 1) for item in inner)
    if operators > MOST_OPERATORS:
        raise InputError(source, f"formulas of at most {MOST_OPERATORS} operators together", f"{operators}")


def too_deep(source: str) -> InputError:
    """Return the error about nesting."""
    return InputError(source, f"tables nested at most {DEEPEST} levels deep", "deeper nesting")
