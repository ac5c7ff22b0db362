"""Who imports what: read from the sources, and seen in a process that really runs.

``lint-imports`` (pyproject.toml) holds the direction between streets and between their rooms; here the libraries that
each room may use are held, which its docstring names, and what one really pays for.
"""

from __future__ import annotations

import ast
import functools
import os
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest

import symgen
from benchmarks import structure
from symgen import api
from symgen.compile.store import sources

PACKAGE = Path(__file__).resolve().parents[2] / "symgen"

SOURCES = sorted(PACKAGE.rglob("*.py"))
#: Most files in circles of imports, those for types included, and in the largest one.
IN_CIRCLES, LARGEST_CIRCLE = 105, 10
#: Streets without rooms: their folders are parts of one thing.
WHOLE = ("cli",)


def owner(path: Path) -> str:
    """Return the room, street or module of symgen that a source file belongs to."""
    street, *rest = path.relative_to(PACKAGE).parts
    return f"{street}/{rest[0]}" if len(rest) > 1 and street not in WHOLE else street.removesuffix(".py")


def imported(path: Path) -> Iterator[str]:
    """Yield the modules that a file imports, at any place, for types as for values."""
    todo: list[ast.AST] = [ast.parse(path.read_text(encoding="utf-8"))]
    while todo:
        node = todo.pop()
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path} imports relatively"
            yield node.module or ""
        else:  # a statement stands in no expression
            todo += (
                n for n in ast.iter_child_nodes(node) if isinstance(n, ast.stmt | ast.excepthandler | ast.match_case)
            )


@functools.cache
def libraries(path: Path) -> frozenset[str]:
    """Return the libraries from outside the standard library that a file imports, by the names of packages."""
    found = {name.partition(".")[0] for name in imported(path)} - set(sys.stdlib_module_names) - {"symgen"}
    return frozenset({"PIL": "pillow"}.get(name, name) for name in found)


@functools.cache
def table() -> dict[str, set[str]]:
    """Return the libraries of each room, by the line `Imports` of its docstring, and of the modules beside rooms."""
    known = set[str]().union(*map(libraries, SOURCES))
    lines = {room: next(line for line in text if line.startswith("Imports: ")) for room, text in ROOMS.items()}
    words = {room: set(re.findall(r"\w+", line.partition("; `")[0].lower())) for room, line in lines.items()}
    return {
        "api": {"numpy"},
        "extension": set(),
        "gym": set(),
        **{room: known & names for room, names in words.items()},
    }


#: Streets and rooms, and the lines of their docstrings.
ROOMS = {
    owner(path): (ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or "").splitlines()
    for path in SOURCES
    if path.name == "__init__.py" and path.parent.relative_to(PACKAGE).as_posix() == owner(path)
}


def test_a_room_says_in_twelve_lines_what_goes_in_and_comes_out() -> None:
    for room, lines in ROOMS.items():
        assert len(lines) <= 12, room
        assert [line.partition(":")[0] for line in lines[-3:]] == ["In", "Out", "Imports"], room


def test_the_page_of_the_architecture_is_the_sum_of_the_rooms() -> None:
    page = (PACKAGE.parent / "docs" / "development" / "architecture.md").read_text(encoding="utf-8")
    lines = dict(re.findall(r"^\| `([\w/]+)` \| (.*) \|$", page.partition("## One walk")[0], re.MULTILINE))
    assert lines == {room: text[0].replace("``", "`") for room, text in ROOMS.items()}
    text = [line for line in page.splitlines() if not line.startswith("| `")]
    assert len(" ".join(text).split()) <= 800
    assert max(len(line) for line in page.splitlines() if not line.startswith("|")) < 120


def test_docstrings_name_what_rooms_use() -> None:
    used = dict[str, set[str]]()
    for path in SOURCES:
        used.setdefault(owner(path), set()).update(libraries(path))
    assert not used.pop("__init__") | used.pop("__main__")
    assert used == table()


def test_a_file_imports_only_the_libraries_of_its_package() -> None:
    others = {path: libraries(path) - table().get(owner(path), set()) for path in SOURCES}
    assert {path.relative_to(PACKAGE).as_posix(): names for path, names in others.items() if names} == {}


def test_benchmarks_import_what_their_page_says() -> None:
    """Libraries of symgen itself, those of the extras that the page names, and peers in files of their own."""
    root = PACKAGE.parent
    project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    page = (root / "benchmarks" / "README.md").read_text(encoding="utf-8")
    named = re.search(r"pip install -e '\.\[([\w,]+)\]'", page)
    assert named is not None
    wanted = [*project["dependencies"], *(x for e in named[1].split(",") for x in project["optional-dependencies"][e])]
    # pages are measured in the browser that tests drive
    known = {re.split(r"[<>=\[]", text)[0] for text in wanted} | {"symgen", "benchmarks", "tests"}
    for path in sorted((root / "benchmarks").rglob("*.py")):
        if path.parent.name != "peers":  # these run in an environment of their own
            found = {name.partition(".")[0] for name in imported(path)} - set(sys.stdlib_module_names)
            assert found <= known, path


def test_circles_of_imports_are_few_and_small() -> None:
    trees = structure.modules(PACKAGE)
    arrows = {name: structure.imported(tree, set(trees)) - {name} for name, tree in trees.items()}
    circles = structure.circles(arrows)
    sizes = [*map(len, circles)]
    assert sum(sizes) <= IN_CIRCLES and max(sizes) <= LARGEST_CIRCLE, circles
    # a model names none of the studies that are its methods
    assert not any(name == "symgen" or name.startswith("symgen.study") for name in arrows["symgen.api"])


def test_circles_are_found_at_any_length() -> None:
    ring = {"a": {"b", "d"}, "b": {"c"}, "c": {"a"}, "d": {"e"}, "e": set(), "f": {"g"}, "g": {"f", "a"}}
    assert sorted(sorted(circle) for circle in structure.circles(ring)) == [["a", "b", "c"], ["f", "g"]]


def test_type_checkers_see_the_studies_that_models_find() -> None:
    tree = ast.parse((PACKAGE / "__init__.py").read_text(encoding="utf-8"))
    (seen,) = (node for node in ast.walk(tree) if isinstance(node, ast.ClassDef))
    names = next(ast.unparse(node.targets[0]) for node in seen.body if isinstance(node, ast.Assign))
    assert names == f"({', '.join(api.STUDIES)})"
    assert [getattr(api.Model, name) for name in api.STUDIES] == [getattr(symgen, name) for name in api.STUDIES]


def test_a_file_that_imports_more_is_noticed(tmp_path: Path) -> None:
    text = "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    import pandas\ndef f():\n    import sympy.core\n"
    (tmp_path / "x.py").write_text(text)
    assert sorted(imported(tmp_path / "x.py")) == ["pandas", "sympy.core", "typing"]
    assert libraries(tmp_path / "x.py") == {"pandas", "sympy"}
    assert table()["compile/store"] >= {"llvmlite", "filelock"}
    assert table()["derive/lower"] == {"msgspec"} and table()["base/ir"] == set()


# -- what is loaded ----------------------------------------------------------------------------------------------------


def loaded(code: str, cache: Path, *arguments: str) -> set[str]:
    """Return the top-level modules that a process has loaded after running `code`."""
    text = code + "\nimport sys\nprint('loaded:', *sorted({m.partition('.')[0] for m in sys.modules}))"
    environment = {**os.environ, "SYMGEN_CACHE_DIR": str(cache)}
    done = subprocess.run(
        [sys.executable, "-c", text, *arguments],
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
        env=environment,
    )
    assert done.returncode == 0, done.stderr
    return set(done.stdout.rpartition("loaded:")[2].split())


DRAWING = {"matplotlib", "pandas", "pyarrow", "rich", "xarray"}


def test_importing_symgen_costs_nothing(tmp_path: Path) -> None:
    heavy = {"click", "msgspec", "numba", "numpy", "sympy", "jinja2", *DRAWING}
    assert not loaded("import symgen", tmp_path) & heavy
    assert not loaded("import symgen.compile.store.loaded_modules", tmp_path) & {
        "llvmlite",
        "numba",
        "numpy",
        "sympy",
        "jinja2",
    }


@pytest.mark.slow
def test_running_a_generated_model_needs_neither_sympy_nor_jinja2_nor_numba(tmp_path: Path) -> None:
    code = (
        "import symgen\n"
        "result = symgen.load('pendulum').simulate(step=1e-2, until=0.1)\n"
        "assert result.status == 'ok', result.reason"
    )
    assert {"sympy", "jinja2"} <= loaded(code, tmp_path)  # the first time it has to be generated
    again = loaded(code, tmp_path)
    assert "llvmlite" in again
    assert not again & ({"sympy", "jinja2", "numba"} | DRAWING)


def test_generating_needs_no_numba(tmp_path: Path) -> None:
    code = (
        "from symgen.describe import load\n"
        "from symgen.derive.formulate.formulate import formulate\n"
        "from symgen.derive.lower.model import lower_model\n"
        "from symgen.derive.emit.emit import emit_model\n"
        "equations = formulate(load('four-bar'))\n"
        "emit_model(lower_model(equations, ''), equations)"
    )
    assert not loaded(code, tmp_path) & {"numba", "scipy", *DRAWING}


@pytest.mark.slow
@pytest.mark.parametrize("choice", [("--target", "cuda"), ("--shape", "looped")], ids=" ".join)
def test_writing_code_that_does_not_run_here_needs_no_numba(tmp_path: Path, choice: tuple[str, str]) -> None:
    arguments = "generate", "pendulum", *choice, "--method", "baumgarte", "--output", str(tmp_path / "written")
    assert not loaded(CLI, tmp_path / "cache", *arguments) & {"numba", "scipy", *DRAWING}
    assert list((tmp_path / "written").glob("*.py"))


CLI = "from symgen.cli import main\nassert main() == 0"


@pytest.mark.fast("--help-", "--version-", "list --json-", "schema-", "cache info --json-")
@pytest.mark.parametrize(
    ("command", "forbidden"),
    [
        (("--help",), {"numba", "numpy", "sympy", "jinja2", *DRAWING}),
        (("--version",), {"numba", "numpy", "sympy", "jinja2", *DRAWING}),
        (("list", "--json"), {"numba", "numpy", "sympy", "jinja2", *DRAWING}),
        (("check", "four-bar", "--json"), {"numba", *DRAWING}),
        (("schema",), {"numba", "numpy", "sympy", "jinja2", *DRAWING}),
        (("cache", "info", "--json"), {"numba", "sympy", "jinja2", *DRAWING}),
        (("inspect", "pendulum", "--json"), {"numba", *DRAWING}),
        (("run", "pendulum", "--until", "0.01", "--json"), {"numba", *DRAWING}),
    ],
    ids=lambda x: " ".join(x) if isinstance(x, tuple) else "",
)
def test_a_command_loads_only_what_it_needs(tmp_path: Path, command: tuple[str, ...], forbidden: set[str]) -> None:
    assert not loaded(CLI, tmp_path, *command) & forbidden


def reached_by(path: Path) -> Iterator[str]:
    """Give the modules of symgen that a source file names in its imports, without the package's own name."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("symgen."):
            yield from (f"{node.module}.{alias.name}".removeprefix("symgen.") for alias in node.names)
            yield node.module.removeprefix("symgen.")


def test_whatever_code_is_generated_with_is_in_the_digest_of_the_generator():
    """Followed from the folders that turn a mechanism into code: else caches would keep old code after an upgrade."""
    waiting = [
        path for folder in ("formulate", "lower", "emit") for path in (PACKAGE / "derive" / folder).rglob("*.py")
    ]
    reached = set(waiting)
    while waiting:
        for name in reached_by(waiting.pop()):
            path = PACKAGE / (name.replace(".", "/") + ".py")
            if path.is_file() and path not in reached:
                reached.add(path)
                waiting.append(path)
    names = {path.relative_to(PACKAGE).as_posix() for path in reached}
    assert any(name.startswith("describe/") for name in names), "imports are followed"
    assert names <= sources.reached_sources(sources.source_table(), sources.CODE)
