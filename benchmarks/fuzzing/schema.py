"""Random documents after the published schema: every value has the type that its key asks for, or nearly."""

from __future__ import annotations

import random
from collections.abc import Mapping
from typing import Any

from benchmarks.fuzzing import texts
from benchmarks.mechanisms.toml import text

Schema = Mapping[str, Any]
_NAMES = ("a", "b", "c", "rod", "disc")
_FORMULAS = ("k1", "2*k1", "t", "a.x", "b.vy*k1", "sin(t)", "angle", "length*rate", "x**2", "tab(t)", "1.0")


def document(rng: random.Random, schema: Schema) -> str:
    """Return the text of a random document.

    Parameters
    ----------
    rng : random.Random
        Where choices come from.
    schema : mapping
        The JSON schema of mechanism files.
    """
    space = rng.choice(["planar", "spatial"])
    raw = {}
    for name, section in schema["properties"].items():
        if name in ("mechanism", "bodies") or rng.random() < 0.7:
            raw[name] = _value(rng, section, schema, name)
    if isinstance(raw.get("mechanism"), dict):
        raw["mechanism"] |= {"name": "drawn", "space": space}
    return text(raw)


def _value(rng: random.Random, schema: Schema, root: Schema, key: str = "") -> Any:
    """Return a value of a schema."""
    if rng.random() < 0.01:
        return texts.value(rng)
    while "$ref" in schema:
        schema = _followed(root, str(schema["$ref"]))
    for several in ("anyOf", "oneOf"):
        if several in schema:
            choices = [s for s in schema[several] if s.get("type") != "null"]
            return _value(rng, rng.choice(choices), root, key)
    if "enum" in schema or "const" in schema:
        return rng.choice(schema.get("enum", [schema.get("const")]))
    kind = schema.get("type")
    if kind == "object" or "properties" in schema:
        return _table(rng, schema, root, key)
    if kind == "array":
        low, high = int(schema.get("minItems", 0)), int(schema.get("maxItems", 6))
        prefix = schema.get("prefixItems")
        if prefix:
            return [_value(rng, item, root, key) for item in prefix]
        return [_value(rng, schema.get("items", {}), root, key) for _ in range(rng.randint(low, max(low, high)))]
    if kind in ("number", "integer"):
        return texts.number(rng) if rng.random() < 0.05 else round(rng.uniform(-2.0, 2.0), 3)
    if kind == "boolean":
        return rng.random() < 0.5
    if kind == "string" or kind is None:
        return _word(rng, key)
    return texts.value(rng)


def _table(rng: random.Random, schema: Schema, root: Schema, key: str) -> dict[str, Any]:
    required = schema.get("required", ())
    table = {
        name: _value(rng, inner, root, name)
        for name, inner in schema.get("properties", {}).items()
        if name in required or rng.random() < 0.3
    }
    free = schema.get("additionalProperties")
    if isinstance(free, dict):
        names = (
            rng.sample(_NAMES, rng.randint(1, 3))
            if key in ("bodies", "points")
            else [f"{key[:1]}{i}" for i in range(2)]
        )
        table |= {name: _value(rng, free, root, name) for name in names}
    return table


def _word(rng: random.Random, key: str) -> str:
    if rng.random() < 0.04:
        return texts.text(rng)
    if key in ("body", "between", "carrier", "reaction"):
        return rng.choice([*_NAMES, "ground", "ground"])
    if key in ("at", "on", "centre", "point", "inertia_at"):
        return rng.choice(["centre", "a", "b"])
    if key in ("joint", "joints", "pinion", "rack"):
        return rng.choice(["j0", "j1"])
    if key == "convention":
        return rng.choice(["zxz", "zyx", "xxy"])
    if key in ("coordinate", "coordinates"):
        return rng.choice(["angle", "x", "displacement", "angle1", "theta"])
    return rng.choice(_FORMULAS)


def _followed(root: Schema, reference: str) -> Schema:
    part_of_schema: Any = root
    for part in reference.removeprefix("#/").split("/"):
        part_of_schema = part_of_schema[part]
    return dict(part_of_schema)
