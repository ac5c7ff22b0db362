"""A mechanism with twice the elements in each beam, to estimate the discretisation error."""

from __future__ import annotations

import re
from typing import Any

import msgspec

from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism


def refine_beams(mechanism: Mechanism) -> tuple[Mechanism, dict[str, str]]:
    """Return the mechanism with twice the elements, and the name of each body there.

    Outputs are left out, as those of elements have no counterpart.

    Parameters
    ----------
    mechanism : Mechanism
        A mechanism with beams.
    """
    raw: dict[str, Any] = msgspec.json.decode(mechanism.beams)
    names = "|".join(sorted(raw["beams"], key=len, reverse=True))
    # an element number follows an e: its first half takes its place
    numbered = re.compile(rf"(?<![A-Za-z0-9_.])({names})\.(e?)([0-9]+)(?![A-Za-z0-9_])")

    def double_node_number(text: str) -> str:
        return numbered.sub(lambda m: f"{m[1]}.{m[2]}{2 * int(m[3]) - (m[2] == 'e')}", text)

    def double_numbers_inside(value: object) -> Any:
        if isinstance(value, str):
            return double_node_number(value)
        if isinstance(value, dict):
            return {double_node_number(key): double_numbers_inside(item) for key, item in value.items()}
        return [double_numbers_inside(item) for item in value] if isinstance(value, list) else value

    finer = {
        key: value if key == "mechanism" else double_numbers_inside(value)
        for key, value in raw.items()
        if key != "outputs"
    }
    for beam in finer["beams"].values():
        beam["elements"] = [2 * count for count in beam["elements"]]
    for section in ("joints", "forces"):
        for table in finer.get(section, {}).values():
            _double_node_numbers(table, finer["beams"])
    return validate(finer, mechanism.name), {body.name: double_node_number(body.name) for body in mechanism.bodies}


def _double_node_numbers(table: dict[str, Any], beams: dict[str, Any]) -> None:
    """Double the numbers of the nodes of a joint or force."""
    at = table.get("at")
    if table.get("body") in beams:
        table["at"] = _double_number(at)
    elif isinstance(table.get("between"), list) and isinstance(at, list):
        table["at"] = [_double_number(x) if body in beams else x for body, x in zip(table["between"], at, strict=True)]


def _double_number(at: Any) -> Any:
    return str(2 * int(at)) if str(at).isdigit() else at
