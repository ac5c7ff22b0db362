"""The tables of a mechanism file as a Python script: the same mechanism by `symgen.MechanismBuilder`."""

from __future__ import annotations

import keyword
from collections.abc import Mapping
from typing import Any

from symgen.describe.files.section_names import NAMED, SECTIONS

_WIDE = 112


def script_of_mechanism(raw: Mapping[str, Any]) -> str:
    """Return a script that describes the mechanism of a file and runs it.

    Texts of the file are literals in it.

    Parameters
    ----------
    raw : mapping
        Sections as `symgen.describe.files.load.parse_toml` returns them.
    """
    head = dict(raw["mechanism"])
    calls = [_call_text("MechanismBuilder", [head.pop("name")], head)]
    if raw.get("run"):
        calls.append(_call_text(".run", [], raw["run"]))
    for section in (each for each in SECTIONS if each in NAMED and each in raw):
        calls += [_builder_call(section, name, content) for name, content in raw[section].items()]
    lines = "\n".join(f"    {line}" for call in calls for line in call.split("\n"))
    name = repr(raw["mechanism"]["name"])
    return (
        f'"""The mechanism {_text_for_docstring(name)}, built and run."""\n\n'
        f"from symgen import MechanismBuilder, Model\n\nbuilder = (\n{lines}\n)\n\n"
        'result = Model(builder.build()).simulate()\nprint(result.status, result.reason or "")\n'
    )


def _text_for_docstring(literal: str) -> str:
    return literal.replace("\\", "").replace('"', "'")


def _builder_call(section: str, name: str, content: Any) -> str:
    """Return the call that adds an entry of a section."""
    method = NAMED[section]
    if section == "outputs" and not isinstance(content, Mapping):
        content = {"value": content}
    if section in ("parameters", "inputs") and not isinstance(content, Mapping):
        content = {"value" if section == "parameters" else "default": content}
    keys = dict(content)
    first = [name]
    if section in ("joints", "forces") and "type" in keys:
        first.append(keys.pop("type"))
    return _call_text(f".{method}", first, keys)


def _call_text(function: str, first: list[Any], keys: Mapping[str, Any]) -> str:
    """Return a call, in one line where it fits."""
    named = {key: item for key, item in keys.items() if key.isidentifier() and not keyword.iskeyword(key)}
    other = {key: item for key, item in keys.items() if key not in named}
    parts = [*map(repr, first), *(f"{key}={item!r}" for key, item in named.items())]
    parts += [f"**{other!r}"] if other else []
    line = f"{function}({', '.join(parts)})"
    if len(line) <= _WIDE:
        return line
    return f"{function}(\n" + "".join(f"    {part},\n" for part in parts) + ")"
