"""Nested tables to the text of a TOML file."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping
from typing import Any

#: Sections whose entries are tables with names of their own.
_NAMED = ("parameters", "tables", "bodies", "joints", "forces")
_BARE = re.compile(r"[A-Za-z0-9_-]+")


def text(raw: Mapping[str, Any]) -> str:
    """Return the text of a mechanism file."""
    blocks = []
    for section, content in raw.items():
        if section in _NAMED and isinstance(content, Mapping):
            plain = {key: item for key, item in content.items() if not isinstance(item, Mapping)}
            if plain:
                blocks.append(_block(key_text(section), plain))
            blocks += [
                _block(f"{key_text(section)}.{key_text(key)}", item)
                for key, item in content.items()
                if isinstance(item, Mapping)
            ]
        elif isinstance(content, Mapping):
            blocks.append(_block(key_text(section), content))
        else:
            blocks.insert(0, f"{key_text(section)} = {value_text(content)}\n")
    return "\n".join(blocks)


def _block(header: str, table: Mapping[str, Any]) -> str:
    return f"[{header}]\n" + "".join(f"{key_text(key)} = {value_text(item)}\n" for key, item in table.items())


def key_text(key: str) -> str:
    """Return a key, in quotes where it has to be."""
    return key if _BARE.fullmatch(key) else _string(key)


def _string(word: str) -> str:
    quoted = json.dumps(word, ensure_ascii=False)
    return re.sub(r"[\x7f\ud800-\udfff]", lambda m: f"\\u{ord(m.group()):04x}", quoted)


def value_text(value: Any) -> str:
    """Return a value as TOML writes it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float) and not math.isfinite(value):
        return "nan" if math.isnan(value) else "inf" if value > 0 else "-inf"
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, str):
        return _string(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{key_text(k)} = {value_text(v)}" for k, v in value.items()) + " }" if value else "{}"
    return "[" + ", ".join(value_text(item) for item in value) + "]"
