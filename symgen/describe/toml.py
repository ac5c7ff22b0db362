"""Nested dictionary to the text of a mechanism file; reading the text gives the dictionary back."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

from symgen.arguments import shown
from symgen.describe.sections import NAMED, SECTIONS
from symgen.errors import InputError

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def to_toml(raw: Mapping[str, Any]) -> str:
    """Return the file's text for the nested dictionary `raw`.

    Parameters
    ----------
    raw : mapping
        Sections as `symgen.describe.load.read_toml` gives them.
    """
    blocks = []
    for section in (*SECTIONS, *(key for key in raw if key not in SECTIONS)):
        if section not in raw:
            continue
        if section in NAMED and section not in ("parameters", "inputs", "outputs"):
            blocks += [_block(f"{section}.{_key(name)}", content) for name, content in raw[section].items()]
        else:
            blocks.append(_block(section, raw[section]))
    return "\n".join(blocks)


def _block(header: str, content: Mapping[str, Any]) -> str:
    lines = [f"{_key(key)} = {_value(value)}\n" for key, value in content.items() if value is not None]
    return f"[{header}]\n" + "".join(lines)


def _key(key: str) -> str:
    return key if _BARE.fullmatch(key) else _text(key)


def _text(text: str) -> str:
    # A JSON string is a TOML basic string, except that TOML wants DEL escaped too.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, Mapping):
        inner = ", ".join(f"{_key(key)} = {_value(item)}" for key, item in value.items() if item is not None)
        return f"{{ {inner} }}" if inner else "{}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(_value(item) for item in value) + "]"
    raise InputError("mechanism file", "texts, numbers, lists and tables", shown(value))
