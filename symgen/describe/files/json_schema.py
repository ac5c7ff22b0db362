"""JSON schema of a mechanism file, for editors: completion and checking while a file is written."""

from __future__ import annotations

import inspect
from collections.abc import Iterable
from typing import Any

import msgspec

from symgen.describe.beams.beam_sections import BeamSection
from symgen.describe.bounds.keys import keys_of_any_joint, sections_of_files
from symgen.describe.contacts.outline_sections import OutlineSection
from symgen.describe.modal.modal_bodies import ModalSection, SpatialModalSection
from symgen.describe.parts.event_sections import EventSection
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


def file_schema() -> dict[str, Any]:
    """Return the JSON schema (draft 2020-12) of a mechanism file, with every joint and force type."""
    parameter = {"anyOf": [{"type": ["number", "string"]}, _schema_of_table(ParameterSection)]}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "symgen mechanism",
        "type": "object",
        "required": ["mechanism"],
        "additionalProperties": False,
        "properties": {
            "mechanism": _schema_of_table(MechanismSection),
            "run": _schema_of_table(RunSection),
            "parameters": _schema_of_named_entries(parameter),
            "inputs": _schema_of_named_entries(
                {"anyOf": [{"type": ["number", "string"]}, _schema_of_table(InputSection)]}
            ),
            "states": _schema_of_named_entries(_schema_of_table(StateSection)),
            "tables": _schema_of_named_entries(_schema_of_table(TableSection)),
            "bodies": _schema_of_named_entries(
                {
                    "anyOf": [
                        *map(_schema_of_table, (BodySection, SpatialBodySection, ModalSection, SpatialModalSection))
                    ]
                }
            )
            | {"minProperties": 1},
            "beams": _schema_of_named_entries(_schema_of_table(BeamSection)),
            "joints": _schema_of_named_entries(
                {"oneOf": _schema_of_kinds(JOINTS.items(), JOINTS.aliases, **keys_of_any_joint())}
            ),
            "outputs": _schema_of_named_entries(
                {"anyOf": [{"type": ["number", "string"]}, _schema_of_table(OutputSection)]}
            ),
            "forces": _schema_of_named_entries({"oneOf": _schema_of_kinds(FORCES.items(), FORCES.aliases)}),
            "outlines": _schema_of_named_entries(_schema_of_table(OutlineSection)),
            **{
                section: _schema_of_named_entries(_schema_of_table(kind.table))
                for section, kind in sections_of_files().items()
            },
            "events": _schema_of_named_entries(_schema_of_table(EventSection)),
        },
    }


def _schema_of_named_entries(entry: dict[str, Any]) -> dict[str, Any]:
    return {"type": "object", "additionalProperties": entry, "propertyNames": {"pattern": _NAME}}


def _schema_of_kinds(
    kinds: Iterable[tuple[str, Any]], aliases: dict[str, str], **common: object
) -> list[dict[str, Any]]:
    """Return one alternative for each kind, selected by its type; `common` are the types of shared keys."""
    result, shared = [], {key: msgspec.json.schema(kind) for key, kind in common.items()}
    for name, kind in kinds:
        table = _schema_of_table(kind)
        own = {"type": {"enum": [name, *(a for a, t in aliases.items() if t == name)]}}
        table["properties"] = own | table["properties"] | shared
        table["required"] = ["type", *table.get("required", [])]
        result.append(table)
    return result


def _schema_of_table(struct: type[Any]) -> dict[str, Any]:
    """Return the schema of one table, with tables inside it in place rather than by reference."""
    definitions = msgspec.json.schema(struct)["$defs"]

    def inline_references(part: object) -> Any:
        if isinstance(part, dict):
            if "$ref" in part:
                return inline_references(definitions[part["$ref"].rpartition("/")[2]])
            return {key: inline_references(value) for key, value in part.items()}
        return [inline_references(item) for item in part] if isinstance(part, list) else part

    table: dict[str, Any] = inline_references(definitions[struct.__name__])
    return table | {"description": key_texts(struct)}


def key_texts(struct: type[Any]) -> str:
    """Return the texts on a table and its keys; those that kinds share are described by the struct they share."""
    shared = [base for base in struct.__bases__ if base is not msgspec.Struct]
    own = inspect.cleandoc(struct.__doc__ or "")
    keys = key_texts(shared[0]).partition(_KEYS)[2] if shared else ""
    if not keys:
        return own
    before, heading, after = own.partition(_KEYS)
    if heading:
        return f"{before}{_KEYS}{keys}\n{after}"
    summary, _, notes = own.partition("\n\n")
    return f"{summary}\n\n{_KEYS}{keys}\n\n{notes}"
