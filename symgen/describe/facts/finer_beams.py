"""A mechanism with twice the elements in each beam, to estimate the discretisation error."""

from __future__ import annotations

import re
from typing import Any

import msgspec

from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism


def refined(mechanism: Mechanism) -> tuple[Mechanism, dict[str, str]]:
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

    def twice(text: str) -> str:
        return numbered.sub(lambda m: f"{m[1]}.{m[2]}{2 * int(m[3]) - (m[2] == 'e')}", text)

    def walk(value: object) -> Any:
        if isinstance(value, str):
            return twice(value)
        if isinstance(value, dict):
            return {twice(key): walk(item) for key, item in value.items()}
        return [walk(item) for item in value] if isinstance(value, list) else value

    finer = {key: value if key == "mechanism" else walk(value) for key, value in raw.items() if key != "outputs"}
    for beam in finer["beams"].values():
        beam["elements"] = [2 * count for count in beam["elements"]]
    for section in ("joints", "forces"):
        for table in finer.get(section, {}).values():
            _renumber(table, finer["beams"])
    return validate(finer, mechanism.name), {body.name: twice(body.name) for body in mechanism.bodies}


def _renumber(table: dict[str, Any], beams: dict[str, Any]) -> None:
    """Double the numbers of the nodes of a joint or force."""
    at = table.get("at")
    if table.get("body") in beams:
        table["at"] = _twice(at)
    elif isinstance(table.get("between"), list) and isinstance(at, list):
        table["at"] = [_twice(x) if body in beams else x for body, x in zip(table["between"], at, strict=True)]


def _twice(at: Any) -> Any:
    return str(2 * int(at)) if str(at).isdigit() else at
