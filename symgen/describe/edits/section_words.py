"""Words that a mechanism file may have, each with a sentence, for editors that complete them."""

from __future__ import annotations

import re
from functools import cache
from typing import Any

from symgen.base.unit_symbols import SYMBOLS
from symgen.describe.files.json_schema import file_schema
from symgen.describe.files.section_names import NAMED, SECTIONS

_KEYS = re.compile(r"^(\w+(?:, \w+)*) : (.*)\n((?:    .*\n?|\n(?=    ))+)", re.MULTILINE)


@cache
def words_of_sections() -> dict[str, Any]:
    """Return the words of each section.

    Returns
    -------
    dict
        ``sections``: name -> ``named`` (whether entries have names of their own), ``keys`` (key -> sentence), and for
        joints and forces ``types`` (type -> its ``text`` and its ``keys``). ``units``: symbols of units.
    """
    properties = file_schema()["properties"]
    sections = {name: _words_of_section(name, properties[name]) for name in SECTIONS}
    return {"sections": sections, "units": sorted(SYMBOLS)}


def _words_of_section(name: str, part: dict[str, Any]) -> dict[str, Any]:
    entry = part["additionalProperties"] if name in NAMED else part
    if "oneOf" in entry:
        kinds = entry["oneOf"]
        types = {
            kind: {"text": _first_sentence(table["description"]), "keys": _words_of_keys(table)}
            for table in kinds
            for kind in table["properties"]["type"]["enum"]
        }
        return {"named": True, "keys": {}, "types": types}
    tables = [table for table in entry.get("anyOf", [entry]) if "properties" in table]
    keys: dict[str, str] = {}
    for table in tables:
        keys = {**_words_of_keys(table), **keys}
    return {"named": name in NAMED, "keys": keys}


def _words_of_keys(table: dict[str, Any]) -> dict[str, str]:
    """Return the keys of a table, each with what it is: the first sentence of its text, else what its values are."""
    texts = dict[str, str]()
    for names, kind, text in _KEYS.findall(table["description"]):
        texts |= {name: f"{kind}. {_first_sentence(text)}" for name in names.split(", ")}
    return {key: texts.get(key) or _kind_of_value(part) for key, part in table["properties"].items()}


def _kind_of_value(part: dict[str, Any]) -> str:
    found = part.get("description") or next(
        (inner["description"] for inner in part.get("anyOf", ()) if "description" in inner), ""
    )
    return str(found)


def _first_sentence(text: str) -> str:
    """Return the first sentence of a text."""
    words = " ".join(text.partition("\n\n")[0].split()).replace("`", "")
    return re.split(r"(?<=\.)\s", words, maxsplit=1)[0]
