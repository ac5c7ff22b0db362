"""Text of a file or a method cannot leave the comments and docstrings of emitted code, and names cannot collide."""

import ast
import builtins
import copy
import itertools
import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, ClassVar

import msgspec
import numpy as np
import pytest
from support.canaries import CANARIES, CODE, SMALL, bases, places, planted
from support.emitted import Emitted, mechanism_of
from support.random_space import make

from symgen.base.errors import InputError
from symgen.base.escapes import LONGEST, comment_text
from symgen.compile.store.loaded_modules import load_module
from symgen.derive.emit.printer import table_name
from symgen.derive.methods._base import MethodOption, MethodParameter, MultiplierMethod
from symgen.describe.files.section_names import SECTIONS
from symgen.describe.mechanism import Mechanism
from symgen.run.compiling.method_choice import MethodChoice, choose_method
from symgen.run.compiling.pipeline import generate

EXPLICIT, IMPLICIT = choose_method("direct-correction"), choose_method("lagrange", None, True)
#: What is emitted: shape and target, with the methods they have.
ROUTES = {
    "straight": ({}, (EXPLICIT, IMPLICIT)),
    "looped": ({"shape": "looped"}, (EXPLICIT, IMPLICIT)),
    "lanes": ({"target": "lanes"}, (EXPLICIT,)),
    "cuda": ({"target": "cuda"}, (EXPLICIT,)),
}


def emitted(mechanism: Mechanism, *methods: MethodChoice) -> dict[str, str]:
    """Source of every module of every route."""
    found = {}
    for route, (keys, choices) in ROUTES.items():
        if mechanism.states and route == "looped":
            continue  # refused
        for stem, (source, _) in generate(mechanism, methods or choices, **keys).modules.items():
            found[f"{route} {stem}"] = source
    return found


def code(source: str) -> str:
    """Everything that would run, as text; checked to be nothing but imports, numbers and decorated functions."""
    tree = ast.parse(source)
    for node in tree.body[1:]:
        assert isinstance(node, ast.Import | ast.ImportFrom | ast.Assign | ast.FunctionDef | ast.If), ast.unparse(node)
        if isinstance(node, ast.Import):
            assert {alias.name for alias in node.names} <= {"math", "numpy"}
        if isinstance(node, ast.ImportFrom):
            assert node.level == 1 or (node.module or "").partition(".")[0] == "numba"
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.FunctionDef) and ast.get_docstring(node) is not None:
            node.body = node.body[1:]
    return ast.unparse(tree)


def codes(sources: Mapping[str, str]) -> list[tuple[str, str]]:
    """Names of modules with what would run; without digests, which comments have a part in."""
    texts = ((name, code(source)) for name, source in sources.items())
    return sorted((re.sub(r"_[0-9a-f]{16}", "", name), re.sub(r"_[0-9a-f]{16}", "", text)) for name, text in texts)


def executed(sources: Mapping[str, str], folder: Path) -> None:
    """Load all modules for processors; nothing that is planted in them may have run then."""
    for name, source in sources.items():
        route, stem = name.split()
        (folder / route).mkdir(parents=True, exist_ok=True)
        (folder / route / f"{stem}.py").write_text(source, encoding="utf-8")
    for path in sorted(folder.rglob("*.py")):
        if path.parent.name != "cuda":
            load_module(path)
    assert not hasattr(builtins, "planted")


@pytest.mark.by_turns(12)
@pytest.mark.fast("tables", "states", "outputs")
@pytest.mark.parametrize("section", SECTIONS)
def test_text_in_any_field_of_a_file_is_refused_or_harmless(section, tmp_path):
    """Every field that may hold text, by the schema, each with every way out of a docstring that is not refused."""
    own = [path for path in places() if path[0] == section]
    accepted: list[Mechanism] = []
    for path in own:
        for number, canary in enumerate(CANARIES):
            kept = len(accepted)
            for raw in planted(path, canary):
                try:
                    accepted.append(mechanism_of(raw))
                except InputError as refused:
                    assert "\n" not in str(refused) and len(str(refused)) < 600, path
            if number > 2 and len(accepted) == kept:
                break  # no text at all goes in here
    assert own or section == "run"
    assert (section in ("mechanism", "parameters", "inputs", "run")) == bool(accepted)
    base = SMALL if section != "states" else next(bases(("states",)))
    plain = codes(emitted(mechanism_of(base)))
    seen: list[dict[str, str]] = []
    for mechanism in accepted:
        sources = emitted(mechanism)
        if sources not in seen:  # a title is not printed at all
            seen.append(sources)
            assert codes(sources) == plain
            executed(sources, tmp_path / str(len(seen)))


def test_a_unit_is_refused_where_it_was_typed():
    raw = SMALL | {"parameters": SMALL["parameters"] | {"k": {"value": 1.0, "unit": f'm"""\n{CODE}'}}}
    with pytest.raises(InputError, match=r"parameters\.k\.unit: expected a unit such as 'kg m\^2', at most 40"):
        mechanism_of(raw)


def unchecked(value: Any, texts: Iterator[str]) -> Any:
    """A value of a description with a text of its own in every field that is for people; nothing is checked."""
    if isinstance(value, msgspec.Struct):
        fields = {name: getattr(value, name) for name in value.__struct_fields__}
        words = ("unit", "note", "title", "source")
        own = {n for n, f in fields.items() if n in words and f != "rad"}  # which rows are angles is no text of a file
        return type(value)(**{n: next(texts) if n in own else unchecked(f, texts) for n, f in fields.items()})
    return tuple(unchecked(item, texts) for item in value) if isinstance(value, tuple) else value


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("space", ["planar", pytest.param("spatial", marks=pytest.mark.slow)])
def test_emission_is_safe_by_itself(space, tmp_path):
    """A mechanism that was never validated, as a program may make one, with every canary as the unit of a parameter."""
    raw = copy.deepcopy(SMALL) if space == "planar" else make(np.random.default_rng(4), ("screw",), ("force",))[0]
    raw["parameters"] |= {f"u{i}": 1.0 for i in range(2 * len(CANARIES))}
    first = next(iter(raw["bodies"]))
    pushed = ["*".join(f"u{i}" for i in range(2 * len(CANARIES))), *[0.0] * (1 if space == "planar" else 2)]
    raw["forces"] |= {"all": {"type": "force", "body": first, "force": pushed}}
    mechanism = mechanism_of(raw)
    plain = codes(emitted(mechanism))
    sources = emitted(unchecked(mechanism, itertools.cycle(CANARIES)))
    assert codes(sources) == plain
    assert sum("import builtins" in source for source in sources.values()) > 2, "the canaries are there"
    executed(sources, tmp_path)


class Talkative(MultiplierMethod):
    """A method whose words are set by the test."""

    name = "talkative"
    summary = reference = "m"
    parameters: ClassVar = (MethodParameter("gain", 1.0, "m", "m"),)
    options: ClassVar = (*MultiplierMethod.options, MethodOption("word", ("m",), "m"))


@pytest.mark.slow
def test_words_of_methods_are_harmless(monkeypatch, tmp_path):
    mechanism = mechanism_of(SMALL)

    def choice() -> MethodChoice:
        return replace(EXPLICIT, method=Talkative(), options=Talkative().complete_options({}))

    plain = codes(emitted(mechanism, choice()))
    for number, canary in enumerate(CANARIES):
        for field in ("summary", "reference"):
            monkeypatch.setattr(Talkative, field, canary)
        monkeypatch.setattr(Talkative, "parameters", (MethodParameter("gain", 1.0, canary, canary),))
        options = (*MultiplierMethod.options, MethodOption("word", (canary,), canary))
        monkeypatch.setattr(Talkative, "options", options)
        sources = emitted(mechanism, choice())
        assert codes(sources) == plain
        executed(sources, tmp_path / str(number))


def test_harmless_text_is_left_alone():
    for text in ("kg m^2", "N m s/rad", "m/s²", "Bayo, García de Jalón (1988) 'x'", "{{ a }}", "# % $"):
        assert comment_text(text) == text
    assert comment_text('5" \\ a\nb') == "5' / a b"
    assert len(comment_text("m" * 10**6)) == LONGEST


# -- names -------------------------------------------------------------------------------------------------------------

#: Names of tables that differ in case or by what is added to them, or that are names of something else.
NAMES = (
    *("f", "F", "g", "g_slope", "slope_g", "table_g", "points_g", "values_g", "G_X", "g_x", "g_X", "X", "Y", "x", "y"),
    *("math", "np", "njit", "cuda", "numba", "model", "w", "p", "k", "T", "at", "out", "here", "tables", "machine"),
    *("rhs", "confirm", "accept", "geometry", "spread", "measure", "observe", "prepare", "masses", "move", "normalise"),
    *("MASK", "SAVED", "PIVOT", "CHANGE", "LAST", "OPEN", "NUMBERS", "q0", "v0", "s0", "s1", "p0", "mask_0", "xs"),
    *("int", "float", "range", "len", "print", "open", "eval", "exec", "low", "high", "middle", "part", "rise", "lane"),
    *("sine", "cosine", "reduced", "turned", "return_", "lambda_", "a" * 64, "A" * 64),
)


def stored(node: ast.AST) -> bool:
    """Whether a node is a name that is bound."""
    return isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)


def with_tables(of_rate: bool = False) -> dict[str, Any]:
    """A point pushed by all tables, each of which is another number, or has another slope."""
    y = {name: [1000.0 + i, 1000.0 + i + of_rate * (i + 1.0)] for i, name in enumerate(NAMES)}
    pushed = " + ".join(f"{i + 1}*{name}({'bob.vx' if of_rate else 0.5})" for i, name in enumerate(NAMES))
    halves = [" + ".join(pushed.split(" + ")[k::2]) for k in (0, 1)]
    pin = {"type": "distance", "between": ["ground", "other"], "at": [[0.0, 0.0], "centre"], "length": 1.0}
    return {
        "mechanism": {"name": "tables"},
        "tables": {name: {"x": [0.0, 1.0], "y": y[name]} for name in NAMES},
        "bodies": {"bob": {"type": "point", "mass": 1.0}, "other": {"type": "point", "mass": 1.0, "position": [1, 0]}},
        "joints": {"pin": pin},
        "forces": {f"f{k}": {"type": "force", "body": "bob", "force": [halves[k], 0.0]} for k in (0, 1)},
    }


@pytest.mark.slow
def test_tables_of_any_names_are_kept_apart_in_every_route(tmp_path):
    """The arrays and functions of each table hold its own numbers, in every module that has tables."""
    sources = emitted(mechanism_of(with_tables(of_rate=True)))
    checked = set()
    for name, source in sources.items():
        namespace: dict[str, Any] = {}
        tree = ast.parse(source)
        bound = [
            *(n.name for n in tree.body if isinstance(n, ast.FunctionDef)),
            *(t.id for n in tree.body if isinstance(n, ast.Assign) for t in ast.walk(n) if stored(t)),
            *(a.asname or a.name for n in tree.body if isinstance(n, ast.Import | ast.ImportFrom) for a in n.names),
        ]
        assert len(bound) == len(set(bound)), f"{name} binds a name twice"
        if name.startswith("cuda") or table_name("f") not in [n.name for n in tree.body if hasattr(n, "name")]:
            continue
        tables = [n for n in tree.body if not isinstance(n, ast.ImportFrom) or n.level == 0]
        wanted = (ast.Import, ast.ImportFrom, ast.Assign)
        kept = [n for n in tables if isinstance(n, wanted) or getattr(n, "name", "").startswith(("table_", "slope_"))]
        exec(compile(ast.Module(kept, []), name, "exec"), namespace)
        for i, table in enumerate(NAMES):
            value, slope = (namespace.get(table_name(table, what)) for what in ("value", "slope"))
            assert value is None or value.py_func(0.5) == 1000.0 + i + 0.5 * (i + 1.0)
            assert slope is None or slope.py_func(0.5) == i + 1.0
        checked.add(name.split()[0])
    assert checked == {"straight", "looped", "lanes"}


def test_a_table_that_nothing_reads_is_in_no_module():
    raw = with_tables()
    raw["tables"]["idle"] = {"x": [0.0, 1.0], "y": [4711.0, 4712.0]}
    sources = emitted(mechanism_of(raw))
    assert {name.split()[0] for name in sources} >= {"straight", "looped", "lanes"}
    assert not any("4711" in source or "table_idle" in source for source in sources.values())


@pytest.mark.parametrize("count", [3, 5000])
def test_long_tables_hold_the_numbers_of_the_file(count):
    """Arrays of many numbers are written in another way; beside a sum in plain Python."""
    x = [0.1 * k for k in range(count)]
    y = [math.sin(k) * 10.0 ** (k % 40 - 20) for k in range(count)]
    raw = {
        "mechanism": {"name": "long", "gravity": [0.0, 0.0]},
        "tables": {"push": {"x": x, "y": y}},
        "bodies": {"bob": {"type": "point", "mass": 1.0}},
        "forces": {"f": {"type": "force", "body": "bob", "force": ["push(t)", 0.0]}},
    }
    found = Emitted(mechanism_of(raw), "lagrange")
    for k in (0, 1, count // 2, count - 1):
        at = found.at(x[k], [0.0, 0.0], [0.0, 0.0], found.parameters({}))
        assert at.acceleration[0] == y[k]


def test_forces_from_tables_of_any_names_are_right():
    raw = with_tables()
    expected = sum((i + 1) * (1000.0 + i) for i in range(len(NAMES)))
    found = Emitted(mechanism_of(raw), "lagrange")
    at = found.at(0.0, [0.0, 0.0, 1.0, 0.0], [0.0] * 4, found.parameters({}))
    assert at.acceleration[0] == pytest.approx(expected, rel=1e-13)
