"""JSON schema of a mechanism file, for editors: completion and checking while a file is written."""

from __future__ import annotations

import inspect
from collections.abc import Iterable
from typing import Any

import msgspec

from symgen.describe.beams.beam_sections import BeamSection
from symgen.describe.bounds.keys import keys_of_any_joint, sections_of_files
from symgen.describe.parts.events import EventSection
from symgen.describe.parts.kinds import FORCES, JOINTS
from symgen.describe.parts.sections import (
    BodySection,
    InputSection,
    MechanismSection,
    OutputSection,
    ParameterSection,
    RunSection,
    SpatialBodySection,
    StateSection,
    TableSection,
)

#: Heading of keys in docstrings.
_KEYS = "Parameters\n----------\n"
_NAME = "^[A-Za-z][A-Za-z0-9_]{0,63}$"


def schema() -> dict[str, Any]:
    """Return the JSON schema (draft 2020-12) of a mechanism file, with every joint and force type."""
    parameter = {"anyOf": [{"type": ["number", "string"]}, _table(ParameterSection)]}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "symgen mechanism",
        "type": "object",
        "required": ["mechanism"],
        "additionalProperties": False,
        "properties": {
            "mechanism": _table(MechanismSection),
            "run": _table(RunSection),
            "parameters": _named(parameter),
            "inputs": _named({"anyOf": [{"type": ["number", "string"]}, _table(InputSection)]}),
            "states": _named(_table(StateSection)),
            "tables": _named(_table(TableSection)),
            "bodies": _named({"anyOf": [_table(BodySection), _table(SpatialBodySection)]}) | {"minProperties": 1},
            "beams": _named(_table(BeamSection)),
            "joints": _named({"oneOf": _kinds(JOINTS.items(), JOINTS.aliases, **keys_of_any_joint())}),
            "outputs": _named({"anyOf": [{"type": ["number", "string"]}, _table(OutputSection)]}),
            "forces": _named({"oneOf": _kinds(FORCES.items(), FORCES.aliases)}),
            **{section: _named(_table(kind.table)) for section, kind in sections_of_files().items()},
            "events": _named(_table(EventSection)),
        },
    }


def _named(entry: dict[str, Any]) -> dict[str, Any]:
    return {"type": "object", "additionalProperties": entry, "propertyNames": {"pattern": _NAME}}


def _kinds(kinds: Iterable[tuple[str, Any]], aliases: dict[str, str], **common: object) -> list[dict[str, Any]]:
    """Return one alternative for each kind, selected by its type; `common` are the types of shared keys."""
    result, shared = [], {key: msgspec.json.schema(kind) for key, kind in common.items()}
    for name, kind in kinds:
        table = _table(kind)
        own = {"type": {"enum": [name, *(a for a, t in aliases.items() if t == name)]}}
        table["properties"] = own | table["properties"] | shared
        table["required"] = ["type", *table.get("required", [])]
        result.append(table)
    return result


def _table(struct: type[Any]) -> dict[str, Any]:
    """Return the schema of one table, with tables inside it in place rather than by reference."""
    definitions = msgspec.json.schema(struct)["$defs"]

    def inlined(part: object) -> Any:
        if isinstance(part, dict):
            if "$ref" in part:
                return inlined(definitions[part["$ref"].rpartition("/")[2]])
            return {key: inlined(value) for key, value in part.items()}
        return [inlined(item) for item in part] if isinstance(part, list) else part

    table: dict[str, Any] = inlined(definitions[struct.__name__])
    return table | {"description": described(struct)}


def described(struct: type[Any]) -> str:
    """Return the texts on a table and its keys; those that kinds share are described by the struct they share."""
    shared = [base for base in struct.__bases__ if base is not msgspec.Struct]
    own = inspect.cleandoc(struct.__doc__ or "")
    keys = described(shared[0]).partition(_KEYS)[2] if shared else ""
    if not keys:
        return own
    before, heading, after = own.partition(_KEYS)
    if heading:
        return f"{before}{_KEYS}{keys}\n{after}"
    summary, _, notes = own.partition("\n\n")
    return f"{summary}\n\n{_KEYS}{keys}\n\n{notes}"
