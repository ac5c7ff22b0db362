"""Text planted in every place of a mechanism file that may hold text, found by walking the file's JSON schema."""

import atexit
import copy
import shutil
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

import numpy as np

import symgen
from benchmarks.finite_elements import solid
from support.models import EVERYTHING
from support.random_space import make
from symgen.describe.files.json_schema import file_schema
from symgen.describe.forces import FORCES
from symgen.describe.joints import JOINTS

#: What would run if it left the comment or docstring that it is printed into.
CODE = "import builtins; builtins.planted = True"
#: Ways out of a comment or docstring, one each, and text that is not Python inside of it.
CANARIES = (
    f'm"""\n{CODE}\n"""',
    f"]\n{CODE}\n#",
    f"]\r{CODE}\r#",
    f"m\x0c\n{CODE}\n",
    f"\u2028{CODE}\u2029",
    f"'''\n{CODE}\n'''",
    "\\N{no such name} \\x \\u12",
    '"',
    "\\",
    "{{ 7*7 }}{% for %}",
    "__import__('builtins').__setattr__('planted', True)",
    "a\x00b",
    "m" * 3000,
)
#: Alternatives of bodies in the schema -> the mechanisms they belong to.
_SPACES = {"BodySection": "planar", "SpatialBodySection": "spatial"}
#: The same of modal bodies, by the components of a place.
_BENT = {"ModalSection": 2, "SpatialModalSection": 3}
#: Keys that a shape has for a mesh alone.
_MESH = {"file", "scale"}
#: Sections whose entries are all of one kind.
_ALIKE = ("parameters", "inputs", "states", "tables", "bodies", "beams", "stops", "outputs", "events")


def places(part: dict[str, Any] | None = None, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Yield the path of every text of the schema: keys, ``*`` for any name, indices, and names of alternatives."""
    part = file_schema() if part is None else part
    kinds = part.get("type", ())
    if "string" in ([kinds] if isinstance(kinds, str) else kinds) and "enum" not in part:
        yield path
    for key in ("anyOf", "oneOf"):
        for i, choice in enumerate(part.get(key, ())):
            kind = choice.get("properties", {}).get("type", {}).get("enum", [])
            name = kind[0] if key == "oneOf" else choice.get("title", i)
            yield from places(choice, (*path, ("either", name)))
    for name, value in part.get("properties", {}).items():
        yield from places(value, (*path, name))
    if isinstance(part.get("additionalProperties"), dict):
        yield (*path, "* itself")
        yield from places(part["additionalProperties"], (*path, "*"))
    for i, item in enumerate(part.get("prefixItems", ())):
        yield from places(item, (*path, i))
    if isinstance(part.get("items"), dict):
        yield from places(part["items"], (*path, 0))


#: A description with something in every section, quickly emitted.
SMALL: dict[str, Any] = {
    "mechanism": {"name": "small", "gravity": [0.0, "-g"]},
    "parameters": {"g": {"value": 9.81, "unit": "m/s^2"}, "k": 2.0},
    "inputs": {"u": {"default": 0.5, "unit": "N m"}},
    "tables": {"tab": {"x": [0.0, 1.0], "y": [1.0, 3.0]}},
    "bodies": {"rod": {"mass": "k", "inertia": 1.0, "points": {"P": ["k", 0.0]}}},
    "joints": {"pin": {"type": "revolute", "between": ["ground", "rod"], "at": [[0.0, 0.0], "P"]}},
    "forces": {"push": {"type": "torque", "body": "rod", "torque": "k*tab(rod.omega) + g + u"}},
    "outputs": {"reach": {"value": "rod.P.x", "unit": "m"}},
    "events": {"level": {"when": "rod.theta > 1.0"}},
}


_BOX = {"mass": "k", "inertia": [1.0, 1.0, 1.0]}
_IN_SPACE: dict[str, Any] = {
    "mechanism": {"name": "small", "space": "spatial"},
    "parameters": {"k": 2.0},
    "bodies": {"rod": _BOX, "box": _BOX},
}


def _beside(base: dict[str, Any], **keys: Any) -> dict[str, Any]:
    return base | {"joints": {**base.get("joints", {}), "extra": keys}}


#: Joints of kinds that no larger description has.
BESIDE: dict[str, dict[str, Any]] = {
    kind: _beside(base, type=kind, **keys)
    for kind, base, keys in (
        ("rows", SMALL, {"rows": [{"position": "rod.P.x - k", "label": "side"}]}),
        ("coupling", SMALL, {"terms": {"pin": "k"}, "value": "sin(t)"}),
        ("place", SMALL, {"between": ["ground", "rod"], "at": [[0.0, "k"], "P"]}),
        ("orientation", SMALL, {"between": ["ground", "rod"], "angle": "k"}),
        (
            *("rope", SMALL),
            {
                **{"between": ["ground", "rod"], "at": [[-9.0, 5.0], "P"], "length": 30.0, "stiffness": "k"},
                "over": [{"body": "ground", "at": [9.0, 9.0], "radius": 0.5, "turn": "right"}],
            },
        ),
        ("parallel-axes", _IN_SPACE, {"between": ["rod", "box"], "axis": [0.0, 0.0, 1.0]}),
        ("perpendicular", _IN_SPACE, {"between": ["rod", "box"], "axes": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]}),
    )
}


@cache
def modal_file(dimension: int) -> str:
    """Return the path of the file of a bar, in the plane or in space."""
    bar = solid((1.0, 0.1, 0.1)[:dimension], (2, 1, 1)[:dimension])
    folder = mkdtemp()
    atexit.register(shutil.rmtree, folder, True)
    return str(symgen.reduced(bar.x, bar.mass, bar.stiffness, inner=1).save(Path(folder) / "bar.npz"))


def bases(path: tuple[Any, ...]) -> Iterator[dict[str, Any]]:
    """Yield valid descriptions that have what a path leads through, in the plane and in space."""
    section, kind = path[0], next((p[1] for p in path if isinstance(p, tuple)), None)
    if section == "states":
        yield SMALL | {"states": {"x": {"rate": "k - x", "start": 1.0}}}
        return
    if section == "stops":
        yield copy.deepcopy(SMALL) | {"stops": {"wall": {"gap": "9.0 - rod.P.x"}}}
        return
    if section == "beams":
        section_of = {"width": 0.02, "height": 0.01}
        keys = {"elements": 2, "section": section_of, "material": {"young": 7e10, "poisson": 0.3, "density": 2700.0}}
        yield copy.deepcopy(SMALL) | {"beams": {"leaf": {"start": [3.0, 0.0], "end": [4.0, 0.0], **keys}}}
        return
    if section == "joints" and kind in BESIDE:
        yield copy.deepcopy(BESIDE[kind])
        return
    if kind in _BENT:
        raw = SMALL if _BENT[kind] == 2 else make(np.random.default_rng(1), ["revolute"])[0]
        arm = {"type": "modal", "file": modal_file(_BENT[kind])}
        yield copy.deepcopy(raw) | {"bodies": {"arm": arm, **raw["bodies"]}}
        return
    if _MESH & set(path[1:]) and kind == "SpatialBodySection":
        shape = {"type": "mesh", "file": "x.stl"}
        yield _IN_SPACE | {"bodies": {"rod": _BOX | {"shape": [shape] if 0 in path[:6] else shape}}}
    if section not in ("joints", "forces") or kind is None:
        spatial = _SPACES.get(str(kind)) == "spatial"
        yield make(np.random.default_rng(1), ["revolute"])[0] if spatial else copy.deepcopy(SMALL)
        return
    found = False
    if kind in {keys["type"] for keys in EVERYTHING[section].values()}:
        found = True
        yield copy.deepcopy(EVERYTHING)
    struct = (JOINTS if section == "joints" else FORCES).get(str(kind), "schema")
    if "spatial" in struct.SPACES:
        found = True
        yield make(np.random.default_rng(1), *(([kind], []) if section == "joints" else ([], [kind])))[0]
    assert found, f"no description has an entry of kind {kind!r} in [{section}]: support.canaries needs one"


def planted(path: tuple[Any, ...], text: str) -> Iterator[dict[str, Any]]:
    """Yield descriptions with a text in one place, otherwise valid."""
    for raw in bases(path):
        steps = [step for step in path if not isinstance(step, tuple)]
        kind = next((p[1] for p in path if isinstance(p, tuple)), None)
        if len(steps) > 1 and steps[1] == "*":
            entries = raw[path[0]]
            steps[1] = next(n for n, keys in entries.items() if path[0] in _ALIKE or keys["type"] == kind)
        yield _put(raw, steps, text)


def _put(value: Any, steps: list[Any], text: str) -> Any:
    """Return a value with a text at the end of some steps, containers made where there are none."""
    if not steps:
        return text
    step, rest = steps[0], steps[1:]
    if isinstance(step, int):
        items = list(value) if isinstance(value, list | tuple) else [0.0] * (step + 1)
        items[step] = _put(items[step], rest, text)
        return items
    entries = dict(value) if isinstance(value, dict) else {}
    if step == "* itself":
        first = next(iter(entries), None)
        return {text if name == first else name: entry for name, entry in entries.items()} or {text: 1.0}
    name = next(iter(entries), "any") if step == "*" else step
    if _wants_table(entries.get(name), rest):
        entries[name] = {"value": entries[name]}
    entries[name] = _put(entries.get(name), rest, text)
    return entries


def _wants_table(value: Any, rest: list[Any]) -> bool:
    """Whether a parameter is given as a number where keys of its table are wanted."""
    return rest[:1] in (["unit"], ["note"], ["value"]) and not isinstance(value, dict)
