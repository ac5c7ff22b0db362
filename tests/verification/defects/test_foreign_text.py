"""Text of a file is never executed, and never takes the process down: defects A1 to A3."""

from __future__ import annotations

import ast
import contextlib
import io
import json
import random
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest
from support.processes import python

import symgen
from benchmarks.fuzzing.texts import CANARY
from benchmarks.mechanisms.toml import text
from symgen.cli import main
from verification.running import DEFECTS, measured
from verification.running import symgen as command

#: Texts that would run, or break emitted text, wherever they were copied unchecked.
HOSTILE = (
    f'"""\nimport os; open("{CANARY}", "w")\n"""',
    f"'''\nopen('{CANARY}', 'w')\n'''",
    f"\nopen('{CANARY}', 'w')\n#",
    f"\r\nopen('{CANARY}', 'w')\r\n#",
    f"\u2028open('{CANARY}', 'w')\u2028#",
    f"\x0copen('{CANARY}', 'w')\x0c#",
    f"]\nopen('{CANARY}', 'w')\n#",
    f"{{{{ cycler.__init__.__globals__.os.system('touch {CANARY}') }}}}",
    f"{{% set x = cycler.__init__.__globals__.os.system('touch {CANARY}') %}}",
    f"__import__('os').system('touch {CANARY}')",
    "\\",
    'a"""',
    "\x00",
    "\\N{LEFT CURLY BRACKET}",
)
PLANE = {"between": ["ground", "b"], "at": [[0.0, 0.0], [0.0, 0.0]], "axis": [1.0, 0.0], "body": "b"}
#: A value of every key that a joint or force may need.
USUAL: dict[str, Any] = {
    "between": ["ground", "b"],
    "at": [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]],
    "axis": [0.0, 0.0, 1.0],
    "axes": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
    "normal": [0.0, 0.0, 1.0],
    "length": 1.0,
    "radius": 1.0,
    "pitch": 1.0,
    "body": "b",
    "joint": "held",
    "joints": ["held", "other"],
    "pinion": "held",
    "rack": "slide",
    "value": 0.0,
    "on": [0.0, 0.0, 0.0],
    "ratio": 1.0,
}


def schema() -> dict[str, Any]:
    """The published schema of mechanism files."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        assert main(["schema"]) == 0
    found: dict[str, Any] = json.loads(out.getvalue())
    return found


def texts_of(part: Any, root: Mapping[str, Any], way: tuple = ()) -> Iterator[tuple]:
    """Ways from a part of the schema to every place that takes a text: keys, ``0`` in a list, ``*`` for a name."""
    while "$ref" in part:
        part = root["$defs"][part["$ref"].rpartition("/")[2]]
    for several in ("anyOf", "oneOf", "allOf"):
        for choice in part.get(several, ()):
            yield from texts_of(choice, root, way)
    if part.get("type") == "string" or "enum" in part:
        yield way
    for key, inner in part.get("properties", {}).items():
        yield from texts_of(inner, root, (*way, key))
    if isinstance(part.get("additionalProperties"), dict):
        yield from texts_of(part["additionalProperties"], root, (*way, "*"))
    inside = [*part.get("prefixItems", ()), *([part["items"]] if isinstance(part.get("items"), dict) else [])]
    for item in inside:
        yield from texts_of(item, root, (*way, 0))


def base(spatial: bool) -> dict[str, Any]:
    """A mechanism with something of every section."""
    three = [0.0, 0.0, 0.0] if spatial else [0.0, 0.0]
    body = {"mass": "m", "inertia": [1.0, 1.0, 1.0] if spatial else 1.0, "points": {"P": three}}
    pin = {"type": "revolute", "between": ["ground", "b"], "at": [three, three]}
    return {
        "mechanism": {"name": "hostile", "space": "spatial" if spatial else "planar"},
        "run": {"until": 1.0},
        "parameters": {"m": {"value": 1.0, "unit": "kg", "note": "a note"}},
        "tables": {"tab": {"x": [0.0, 1.0], "y": [0.0, 1.0]}},
        "bodies": {"b": body, "c": {"type": "point", "mass": 1.0}},
        "joints": {"held": {**pin, **({"axis": [0.0, 0.0, 1.0]} if spatial else {})}},
        "forces": {"f": {"type": "force", "body": "b", "force": three}},
    }


def planted(way: tuple, hostile: str, kinds: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    """Files with the text at the end of a way, in the plane and in space, under every kind that has the key."""
    for spatial in (False, True):
        raw = base(spatial)
        section = way[0]
        choices: list[dict[str, Any]] = [{}]
        if section in ("joints", "forces") and len(way) > 2:
            choices = [
                {"type": kind, **{k: USUAL[k] for k in needed if k in USUAL}}
                for kind, (keys, needed) in kinds[section].items()
                if way[2] in keys
            ]
        for choice in choices:
            if choice:
                raw[section]["planted"] = choice
            name = {"bodies": "b", "parameters": "m", "tables": "tab"}.get(section, "planted")
            yield put(raw, way, hostile, name)


def put(value: Any, way: tuple, hostile: str, name: str) -> Any:
    """A copy of nested tables with a text at the end of a way; what is not there yet is made."""
    if not way:
        return hostile
    key, rest = way[0], way[1:]
    if key == 0:
        items = list(value) if isinstance(value, list) and value else [0.0, 0.0, 0.0]
        return [put(items[0], rest, hostile, name), *items[1:]]
    table = dict(value) if isinstance(value, dict) else {}
    if key == "*":
        return {**table, name: put(table.get(name), rest, hostile, "P")}
    return {**table, key: put(table.get(key), rest, hostile, name)}


def kinds_of(found: Mapping[str, Any]) -> dict[str, dict[str, tuple[set[str], list[str]]]]:
    """Section -> kind -> its keys, and those it requires, as the schema says."""
    table: dict[str, dict[str, tuple[set[str], list[str]]]] = {}
    for section in ("joints", "forces"):
        table[section] = {}
        for choice in found["properties"][section]["additionalProperties"]["oneOf"]:
            named = choice["properties"]["type"]
            for kind in named.get("enum", [named.get("const")]):
                table[section][kind] = (set(choice["properties"]), list(choice.get("required", ())))
    return table


def code_of(module: ast.Module) -> str:
    """A module without its docstrings, and without the texts of its comments: what is executed."""
    for node in ast.walk(module):
        if isinstance(node, ast.Module | ast.FunctionDef | ast.ClassDef) and ast.get_docstring(node) is not None:
            node.body = node.body[1:] or [ast.Pass()]
    return ast.dump(module)


@pytest.fixture(scope="module")
def files() -> list[tuple[tuple, str]]:
    """For every text of the schema, files with hostile texts there."""
    found = schema()
    ways = sorted({way for way in texts_of(found, found) if way}, key=str)
    kinds, rng = kinds_of(found), random.Random(1)
    assert ("mechanism", "title") in ways and ("parameters", "*", "unit") in ways and len(ways) > 60
    made = [(w, text(raw)) for w in ways for h in rng.sample(HOSTILE, 4) for raw in planted(w, h, kinds)]
    assert {way for way, _ in made} == set(ways)
    return made


@pytest.mark.parametrize("emitted", [6, pytest.param(12, marks=pytest.mark.slow)])
def test_nothing_in_a_file_is_executed(
    emitted: int,
    files: list[tuple[tuple, str]],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Every text is refused in one line for a terminal, or taken and stays text in everything made of the file."""
    monkeypatch.chdir(tmp_path)
    file, taken = tmp_path / "planted.toml", set()
    for way, content in files:
        file.write_text(content, encoding="utf-8")
        try:
            symgen.load(file)
            taken.add(content)
        except symgen.SymgenError as error:
            said = str(error)
            assert said.isprintable() and len(said) < 1000, (way, said[:300])
        assert not (tmp_path / CANARY).exists(), way
    assert taken, "titles, sources, units and notes may hold any text"
    for content in random.Random(2).sample(sorted(taken), emitted):
        file.write_text(content, encoding="utf-8")
        code = main(["generate", str(file), "--output", str(tmp_path / "out"), "--method", "lagrange"])
        assert code == 0, (capsys.readouterr().err, content)
        assert main(["check", str(file)]) == 0, (capsys.readouterr().err, content)
        assert main(["inspect", str(file)]) == 0
        assert main(["inspect", str(file), "--format", "latex"]) == 0
        assert not list(tmp_path.rglob(CANARY)), content
        for module in (tmp_path / "out").rglob("*.py"):
            assert CANARY not in code_of(ast.parse(module.read_text(encoding="utf-8"))), content


@pytest.mark.parametrize("name", ["inject_unit", "emitted_not_python"])
def test_units_stay_text(name: str, tmp_path: Path) -> None:
    for words in (["check"], ["generate", "--output", tmp_path / "out"], ["run", "--until", "0.01", "--step", "1e-3"]):
        said = command([words[0], DEFECTS / f"{name}.toml", *words[1:]], tmp_path, NUMBA_DISABLE_JIT="1")
        assert said.code == 2 and said.sentence and "unit" in said.err, said.err
    assert not list(tmp_path.rglob("EXECUTED*"))
    for module in (tmp_path / "out").rglob("*.py"):
        assert "os.system" not in code_of(ast.parse(module.read_text(encoding="utf-8")))


def test_a_full_disk_is_said(tmp_path: Path) -> None:
    """Saving stops in the middle of the file; the process stays alive and leaves nothing behind."""
    script = """
import resource, signal, sys
import symgen
result = symgen.load("pendulum").simulate(until=20.0, step=1e-3)
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (48_000, resource.RLIM_INFINITY))
try:
    result.save("full.nc")
except symgen.SymgenError as error:
    print("said:", error)
"""
    done = python(script, cwd=tmp_path)
    assert done.returncode == 0, (done.returncode, done.stderr)
    assert done.stdout.startswith("said:") and done.stdout.count("\n") == 1
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("dotted", ["a" + ".a" * 20_000 + " = 1", "[" + "a." * 20_000 + "a]"])
def test_dotted_names_cost_what_their_length_says(dotted: str, tmp_path: Path) -> None:
    """40 kB took 1.6 GB and 6 s; depth is told before anything is built."""
    file = tmp_path / "dotted.toml"
    file.write_text(f'[mechanism]\nname = "dotted"\n{dotted}\n', encoding="utf-8")
    said = measured(["check", file], tmp_path)
    assert said.code == 2 and said.sentence, said.err
    assert "parts joined by dots" in said.err
    assert said.memory < 300e6
