"""The mechanism file's vocabulary in Python, which passes the same validator as a file, and the text of such a file."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any, Self, Unpack

from symgen.base.arguments import kind_of_value, text
from symgen.base.errors import InputError
from symgen.base.keywords import spell_out_keywords
from symgen.describe.files.builder_keys import (
    BodyKeys,
    EventKeys,
    ForceKeys,
    JointKeys,
    LimitKeys,
    MechanismKeys,
    RunKeys,
    TableKeys,
)
from symgen.describe.files.section_names import NAMED, SECTIONS
from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism


class MechanismBuilder:
    """Collects bodies, joints and forces, then makes a `Mechanism` or the text of a file.

    Every method takes the keys of the file's table as keyword arguments and returns the builder. Nothing but names is
    checked before `build`.

    Parameters
    ----------
    name : str
        Lower-case words joined by dashes.
    **keys
        Further keys of ``[mechanism]``: ``title``, ``source``, ``author``, ``revision``, ``space``, ``gravity``,
        ``shape``.

    Examples
    --------
    >>> pendulum = (
    ...     MechanismBuilder("rod-pendulum", gravity=(0.0, -9.81))
    ...     .parameter("length", 0.8, unit="m")
    ...     .body("rod", mass=1.2, inertia="1.2*length**2/12", points={"top": (0.0, "length/2")})
    ...     .joint("pin", "revolute", between=("ground", "rod"), at=((0.0, 0.0), "top"))
    ... )
    >>> pendulum.build().bodies[0].coordinates
    ('x', 'y', 'theta')
    """

    def __init__(self, name: str, **keys: Unpack[MechanismKeys]) -> None:
        self._raw: dict[str, dict[str, Any]] = {"mechanism": {"name": name} | _plain_value(keys)}

    def __repr__(self) -> str:
        counts = ", ".join(
            f"{len(entries)} {section}" for section, entries in self._raw.items() if section != "mechanism"
        )
        return f"<MechanismBuilder {str(self._raw['mechanism']['name'])[:60]}: {counts or 'nothing yet'}>"

    def run(self, **keys: Unpack[RunKeys]) -> Self:
        """Set run defaults: ``integrator``, ``verify``, and the times of ``[run]`` in a file [s]."""
        self._raw["run"] = self._raw.get("run", {}) | _plain_value(keys)
        return self

    def parameter(
        self, name: str, value: float | str, unit: str = "", note: str = "", **limits: Unpack[LimitKeys]
    ) -> Self:
        """Add a number that stays adjustable at run time, or a formula of other parameters that follows them.

        Reports compare it with the limits ``smallest`` and ``largest``.
        """
        keys = {"value": value, "unit": unit, "note": note, **limits}
        return self._add_entry("parameters", name, {key: item for key, item in keys.items() if item != ""})

    def input(self, name: str, default: float | str, unit: str = "", note: str = "") -> Self:
        """Add a number from outside, which may change during a run."""
        keys = {"default": default, "unit": unit, "note": note}
        return self._add_entry("inputs", name, {key: item for key, item in keys.items() if item != ""})

    def table(self, name: str, x: object, y: object, **keys: Unpack[TableKeys]) -> Self:
        """Add a function of one argument by interpolation: ``interpolation``, ``periodic`` as in a file."""
        return self._add_entry("tables", name, {"x": x, "y": y} | keys)

    def body(self, name: str, **keys: Unpack[BodyKeys]) -> Self:
        """Add a body: ``mass``, ``inertia``, ``points``, ``position``, ``angle``, ... as in a file."""
        return self._add_entry("bodies", name, {**keys})

    def beam(self, name: str, **keys: object) -> Self:
        """Add a beam: ``start``, ``end``, ``elements``, ``section``, ``material``, ... as in a file."""
        return self._add_entry("beams", name, keys)

    def joint(self, name: str, type: str, **keys: object) -> Self:
        """Add a joint of a type, with that type's keys."""
        return self._add_entry("joints", name, {"type": type} | keys)

    def force(self, name: str, type: str, **keys: object) -> Self:
        """Add a force element of a type, with that type's keys."""
        return self._add_entry("forces", name, {"type": type} | keys)

    def event(self, name: str, **keys: Unpack[EventKeys]) -> Self:
        """Add an event: ``when``, ``direction``, ``action``, ``reset`` as in a file."""
        return self._add_entry("events", name, {**keys})

    def state(self, name: str, rate: float | str, start: float | str = 0.0, unit: str = "") -> Self:
        """Add a state with a rate of its own, such as the current of a motor, which every formula may read."""
        keys = {"rate": rate, "start": start, "unit": unit}
        return self._add_entry("states", name, {key: item for key, item in keys.items() if item != ""})

    def stop(self, name: str, **keys: object) -> Self:
        """Add a stop between any parts, such as a rope: ``gap``, ``restitution`` as in a file."""
        return self._add_entry("stops", name, keys)

    def output(self, name: str, value: str, unit: str = "", **limits: Unpack[LimitKeys]) -> Self:
        """Add a formula that results report, such as ``"integral(motor.power)"``, with limits as parameters have."""
        keys = {"value": value, "unit": unit, **limits}
        return self._add_entry("outputs", name, {key: item for key, item in keys.items() if item != ""})

    @property
    def source(self) -> str:
        """Name of this description in messages."""
        return f"builder '{self._raw['mechanism']['name']}'"

    def raw(self) -> dict[str, dict[str, Any]]:
        """Return a copy of the nested dictionary, as read from a file."""
        copied: dict[str, dict[str, Any]] = _plain_value(self._raw)
        return copied

    def build(self) -> Mechanism:
        """Return the validated mechanism."""
        return validate(self.raw(), self.source)

    def to_toml(self) -> str:
        """Return the text of the file that describes the same mechanism."""
        return to_toml(self.raw())

    def _add_entry(self, section: str, name: str, content: dict[str, Any]) -> Self:
        text(f"{self.source}: {section}", name)
        entries = self._raw.setdefault(section, {})
        if name in entries:
            raise InputError(f"{self.source}: {section}.{name}", "a name used once", f"'{name}' twice")
        entries[name] = _plain_value(content)
        return self


for _method, _keys, _open in (
    (MechanismBuilder.__init__, MechanismKeys, False),
    (MechanismBuilder.run, RunKeys, False),
    (MechanismBuilder.table, TableKeys, False),
    (MechanismBuilder.body, BodyKeys, False),
    (MechanismBuilder.event, EventKeys, False),
    (MechanismBuilder.joint, JointKeys, True),
    (MechanismBuilder.force, ForceKeys, True),
):
    spell_out_keywords(_method, _keys, dict.fromkeys(_keys.__annotations__), _open)


def _plain_value(value: object) -> Any:
    """Return `value` as read from a file: tables, lists, texts, numbers (NumPy's too) and truth values."""
    if isinstance(value, Mapping):
        return {key: _plain_value(item) for key, item in value.items()}
    if isinstance(value, str | bool | int):
        return value
    if hasattr(value, "__float__") and not getattr(value, "shape", ()):
        return float(value)
    if hasattr(value, "__iter__"):
        return [_plain_value(item) for item in value]
    return value


_BARE = re.compile(r"[A-Za-z0-9_-]+")


def to_toml(raw: Mapping[str, Any]) -> str:
    """Return the file's text for the nested dictionary `raw`.

    Parameters
    ----------
    raw : mapping
        Sections as `symgen.describe.files.load.parse_toml` returns them.
    """
    blocks = []
    for section in (*SECTIONS, *(key for key in raw if key not in SECTIONS)):
        if section not in raw:
            continue
        if section in NAMED and section not in ("parameters", "inputs", "outputs"):
            blocks += [_toml_table(f"{section}.{_toml_key(name)}", content) for name, content in raw[section].items()]
        else:
            blocks.append(_toml_table(section, raw[section]))
    return "\n".join(blocks)


def _toml_table(header: str, content: Mapping[str, Any]) -> str:
    lines = [f"{_toml_key(key)} = {_toml_value(value)}\n" for key, value in content.items() if value is not None]
    return f"[{header}]\n" + "".join(lines)


def _toml_key(key: str) -> str:
    return key if _BARE.fullmatch(key) else toml_text(key)


def toml_text(text: str) -> str:
    """Return a text as a TOML file has it on one line, in quotation marks."""
    # A JSON string is a TOML basic string, except that TOML wants DEL escaped too.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _toml_value(value: object) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, str):
        return toml_text(value)
    if isinstance(value, Mapping):
        inner = ", ".join(f"{_toml_key(key)} = {_toml_value(item)}" for key, item in value.items() if item is not None)
        return f"{{ {inner} }}" if inner else "{}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(_toml_value(item) for item in value) + "]"
    raise InputError("mechanism file", "texts, numbers, lists and tables", kind_of_value(value))
