"""Changes of tables that a file has: further points, stops and friction of joints, copies of bodies."""

from __future__ import annotations

from collections.abc import Mapping
from string import ascii_uppercase
from typing import Any

from symgen.base.errors import InputError
from symgen.describe.edits.snippet_tables import (
    EditedFile,
    Spot,
    blocks_of_headers,
    exact_number,
    insert_tables,
    need_body,
    vector_text,
)
from symgen.describe.edits.text_changes import Change

#: What a click gives a joint: a stop [rad or m, after its kind], and friction [N m or N].
KEYS: Mapping[str, Mapping[str, str]] = {
    "stop": {
        "revolute": 'stop = { lower = "-90 deg", upper = "90 deg", restitution = 0.2 }',
        "translational": "stop = { lower = -0.1, upper = 0.1, restitution = 0.2 }",
    },
    "friction": {"revolute": "friction = { sliding = 0.1 }", "translational": "friction = { sliding = 1.0 }"},
}

Changes = tuple[tuple[Change, ...], str]


def point_change(file: EditedFile, spot: Spot, place: Spot) -> Changes:
    """Return the change that gives a body another point: a further hole of a bar, a point that draws a path."""
    need_body("point", spot)
    own = file.raw["bodies"][spot.body].get("points", {})
    span = file.parts.values.get(("bodies", spot.body, "points"))
    if span is None or not file.text[slice(*span)].endswith("}"):
        raise InputError("point", "a body with points = { ... }", f"'{spot.body}' without", "write it into the text")
    dx, dy = file.turn_into_body(spot.body, place.x - spot.x, place.y - spot.y)
    name = next((c for c in ascii_uppercase if c not in own), f"P{len(own)}")
    inner = file.text[span[0] + 1 : span[1] - 1].rstrip()
    entry = f"{name} = {vector_text((spot.at[0] + dx, spot.at[1] + dy))}"
    at = span[0] + 1 + len(inner)
    return (Change(at, at, f", {entry}" if inner else f" {entry} "),), f"bodies.{spot.body}.points.{name}"


def key_change(kind: str, file: EditedFile, spot: Spot) -> Changes:
    """Return the change that gives the joint at a spot a stop or friction, about where it is at the start.

    Raises
    ------
    InputError
        If there is no pin or slide, or it has the key already.
    """
    joint = file.joint_at(spot)
    entry = file.raw.get("joints", {}).get(joint)
    line = KEYS[kind].get({"prismatic": "translational"}.get(name := str((entry or {}).get("type")), name))
    if entry is None or line is None:
        got = f"'{joint}', which is {name}" if entry is not None else "another point"
        raise InputError(kind, "a pin or a slide", got)
    if kind in entry:
        raise InputError(kind, f"a joint without {kind}", f"'{joint}', which has one", "change it in the text")
    if kind == "stop" and name == "revolute" and (angle := file.angle_between(*entry["between"])):
        line = (
            f"stop = {{ lower = {exact_number(angle - 1.5)}, upper = {exact_number(angle + 1.5)}, restitution = 0.2 }}"
        )
    _, end = _block_of_table(file, "joints", joint, kind)
    return (Change(end, end, f"\n{line}"),), f"joints.{joint}"


def copy_changes(file: EditedFile, spot: Spot, place: Spot) -> Changes:
    """Return the change that adds a copy of a body whose point lies at another place; no joint holds it.

    Raises
    ------
    InputError
        If the body is written in another way than as a table with numbers for its position.
    """
    need_body("copy", spot)
    body: Mapping[str, Any] = file.raw["bodies"][spot.body]
    start, end = _block_of_table(file, "bodies", spot.body, "copy")
    position = body.get("position", [0.0, 0.0])
    if not isinstance(position, list) or not all(type(x) in (int, float) for x in position):
        raise InputError("copy", "a body whose position is in numbers", f"'{spot.body}'", "copy its table in the text")
    name = file.take_free_name(spot.body.rstrip("0123456789") or spot.body)
    moved = f"position = {vector_text((position[0] + place.x - spot.x, position[1] + place.y - spot.y))}"
    header, *lines = file.text[start:end].split("\n")
    span = file.parts.values.get(("bodies", spot.body, "position"))
    if span is None:
        lines.append(moved)
    else:
        row = file.text.count("\n", start, span[0]) - 1
        lines[row] = moved
    table = "\n".join([header.replace(spot.body, name, 1), *lines])
    return insert_tables([(f"bodies.{name}", table)], file.parts, file.text), f"bodies.{name}"


def _block_of_table(file: EditedFile, section: str, name: str, kind: str) -> tuple[int, int]:
    """Return the characters of a table with a header of its own."""
    blocks = zip(file.parts.headers, blocks_of_headers(file.parts, file.text), strict=True)
    found = next((block for header, block in blocks if header.path == (section, name)), None)
    if found is None:
        raise InputError(kind, f"a table [{section}.{name}]", "one written in another way", "change it in the text")
    return found
