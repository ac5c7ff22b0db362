"""What code depends on follows from its imports: a change of one character anywhere makes other results of it."""

import ast
import os
import shutil
from pathlib import Path

import pytest

import symgen
from symgen.compile.store import sources
from symgen.run.compiling import folders
from symgen.run.effects import stepping
from symgen.run.loops import frame
from symgen.study import journal
from symgen.study.ensemble import recipe

PACKAGE = Path(symgen.__file__).parent
#: Streets, their rooms, and the modules beside them.
PLACES = sorted(
    path.relative_to(PACKAGE).as_posix()
    for path in (*PACKAGE.glob("*.py"), *PACKAGE.glob("*"), *PACKAGE.glob("*/*"))
    if (path / "__init__.py").is_file() or (path.parent == PACKAGE and path.suffix == ".py" and path.stem != "__main__")
)


@pytest.fixture(scope="module")
def copied(tmp_path_factory):
    """A copy of the package with its templates, for changes."""
    package = tmp_path_factory.mktemp("copied") / "symgen"
    shutil.copytree(PACKAGE, package, ignore=shutil.ignore_patterns("__pycache__"))
    if not (package / "templates").is_dir():
        shutil.copytree(PACKAGE.parent / "templates", package.parent / "templates")
    return package


@pytest.fixture
def package(copied, monkeypatch):
    """The copy, in the place of the package that is imported."""
    monkeypatch.setattr(sources, "_PACKAGE", str(copied))
    forget()
    yield copied
    forget()


@pytest.fixture(scope="module")
def unchanged(copied):
    """Digests of the copy as it is."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sources, "_PACKAGE", str(copied))
        return identities()


def forget():
    """Forget what has been read: as in another process."""
    for kept in (sources.source_table, sources.package_digest, sources.reached_digest, sources._digest_of_sources):
        kept.cache_clear()


def identities():
    """Return the digests that folders of sweeps, journals of studies and emitted code carry."""
    forget()
    return {
        "rows": recipe.run_code_identity(),
        "cells": journal.code_identity(),
        "code": folders.generator_digest.__wrapped__(),
        "stepping": sources.reached_digest(*sources.LOOPS),
        "compiler": sources.reached_digest(*sources.COMPILER),
    }


def change(path):
    """Change the first letter of a file's text, which its size does not show; return what it was."""
    text = path.read_bytes()
    place = next(i for i, character in enumerate(text) if chr(character).isalpha())
    path.write_bytes(text[:place] + bytes([text[place] ^ 0x20]) + text[place + 1 :])
    return text


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize("place", [*PLACES, "templates"])
def test_one_character_in_any_room_makes_other_results(place, package, unchanged):
    path = package / place if (package / place).exists() else package.parent / place
    file = path if path.is_file() else max(path.rglob("*.j2" if place == "templates" else "*.py"))
    text = change(file)
    after = identities()
    file.write_bytes(text)
    assert after["rows"] != unchanged["rows"] and after["cells"] != unchanged["cells"]


@pytest.mark.slow
def test_what_is_put_back_makes_the_same_results(package, unchanged):
    text = change(package / "run/loops/frame.py")
    assert identities() != unchanged
    (package / "run/loops/frame.py").write_bytes(text)
    assert identities() == unchanged


@pytest.mark.parametrize(
    ("file", "remade"),
    [
        ("run/effects/stepping.py", {"code"}),
        ("run/modes/choice.py", {"stepping"}),
        ("run/starts/starting.py", {"code", "stepping"}),
        ("base/ir/program.py", {"code", "stepping"}),
        ("base/vocabulary/elementary_functions.py", {"code", "stepping", "compiler"}),
        ("describe/formulas/formula_nodes.py", {"code"}),
        ("derive/lower/looped/kernels.py", {"code"}),
        ("derive/methods/lagrange.py", {"code"}),
        ("run/integrators/dop853.py", {"stepping"}),
        ("compile/native/llvm.py", {"code", "stepping", "compiler"}),
        ("compile/store/emitted.py", {"code", "stepping", "compiler"}),
    ],
)
def test_entries_of_the_cache_depend_on_what_their_makers_import(file, remade, package, unchanged):
    assert changed(package / file, unchanged) >= {*remade, "rows", "cells"}


@pytest.mark.parametrize("file", ["study/report/document.py", "cli/run.py"])
def test_entries_of_the_cache_outlive_changes_of_what_no_maker_imports(file, package, unchanged):
    assert changed(package / file, unchanged) == {"rows", "cells"}


def changed(file, before):
    """Return the identities that a change of a file changes."""
    text = change(file)
    after = identities()
    file.write_bytes(text)
    return {name for name in before if before[name] != after[name]}


@pytest.mark.slow
def test_a_new_module_is_another_code(package):
    before = identities()
    (package / "run" / "integrators" / "new.py").write_text("KIND = None\n")
    after = identities()
    (package / "run" / "integrators" / "new.py").unlink()
    assert after["rows"] != before["rows"] and after["stepping"] != before["stepping"]
    assert identities() == before


@pytest.mark.slow
def test_imports_are_those_that_python_sees():
    """At any place of a module, in parentheses and under other names."""
    files = dict(sources.files_of_package(str(PACKAGE)))
    for name, (_, found) in sources.read_sources(files).items():
        if name.endswith(".py"):
            assert set(found) == imported(Path(files[name]), set(files)) - {name}, name


def imported(path, known):
    """Return the names of sources that a file imports, by Python's own grammar."""
    dotted = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            dotted |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            dotted |= {str(node.module), *(f"{node.module}.{alias.name}" for alias in node.names)}
    paths = {name.partition(".")[2].replace(".", "/") for name in dotted if name.partition(".")[0] == "symgen"}
    return known & ({f"{p}.py" for p in paths} | {f"{p}/__init__.py" if p else "__init__.py" for p in paths})


# -- functions ---------------------------------------------------------------------------------------------------------


def test_a_compiled_function_depends_on_constants_of_other_rooms():
    """Constants that a callee imports are numbers in its machine code."""
    names = {
        Path(function.py_func.__code__.co_filename).relative_to(PACKAGE).as_posix()
        for module in (frame, stepping)
        for function in vars(module).values()
        if hasattr(function, "py_func")
    }
    assert "run/effects/stepping.py" in names
    reached = sources.reached_sources(sources.source_table(), {*sources.LOOPS, *names})
    assert {"base/ir/program.py", "run/layout/abi.py", "run/effects/stepping.py"} <= reached


@pytest.mark.slow
def test_a_function_of_somebody_else_depends_on_what_its_file_imports(tmp_path, package):
    """As a function of a plugin does on a room that no loop imports."""
    (tmp_path / "own.py").write_text("from symgen.study.report import document\n\ndef own(x):\n    return x\n")
    scope = {}
    exec(compile((tmp_path / "own.py").read_text(), str(tmp_path / "own.py"), "exec"), scope)
    before = sources.source_stamp(scope["own"])
    text = change(package / "study" / "report" / "document.py")
    forget()
    after = sources.source_stamp(scope["own"])
    (package / "study" / "report" / "document.py").write_bytes(text)
    assert after != before


# -- the table in the cache --------------------------------------------------------------------------------------------


@pytest.fixture
def settled(package, monkeypatch, tmp_path):
    """The copy, whose files count as old, with an empty cache."""
    monkeypatch.setenv("SYMGEN_CACHE_DIR", str(tmp_path / "cache"))
    monkeypatch.setattr(sources, "_RECENT", float("-inf"))
    return package


def tables(tmp_path):
    return sorted((tmp_path / "cache" / "tables").glob("sources-*"))


def test_the_package_is_read_once_for_all_processes(settled, tmp_path, monkeypatch):
    before = identities()
    assert len(tables(tmp_path)) == 1
    monkeypatch.setattr(sources, "read_sources", lambda files: pytest.fail("read again"))
    assert identities() == before


@pytest.mark.slow
def test_a_change_that_keeps_size_and_time_is_seen(settled, tmp_path):
    file = settled / "run" / "effects" / "stepping.py"
    before, status = identities(), file.stat()
    text = change(file)
    os.utime(file, ns=(status.st_atime_ns, status.st_mtime_ns))
    after = identities()
    file.write_bytes(text)
    assert after["rows"] != before["rows"] and len(tables(tmp_path)) == 2


@pytest.mark.slow
@pytest.mark.parametrize("damage", [b"", b"nonsense", None], ids=["empty", "other content", "one bit"])
def test_a_spoilt_table_is_read_anew(damage, settled, tmp_path):
    before = identities()
    (path,) = tables(tmp_path)
    content = bytearray(path.read_bytes())
    content[-1] ^= 1
    path.write_bytes(content if damage is None else damage)
    assert identities() == before


def test_what_has_just_been_written_is_not_kept(settled, tmp_path, monkeypatch):
    """A second change within the resolution of times would not be seen."""
    monkeypatch.setattr(sources, "_RECENT", float("inf"))
    identities()
    assert tables(tmp_path) == []


def test_an_archive_is_one_source(tmp_path, monkeypatch):
    """All that is in it changes with it."""
    stamps = set()
    for text in (b"one", b"another"):
        archive = tmp_path / f"{text.decode()}.zip"
        archive.write_bytes(text)
        monkeypatch.setattr(sources, "_PACKAGE", str(archive / "symgen"))
        forget()
        stamps.add((sources.package_digest(), sources.reached_digest(*sources.LOOPS)))
    forget()
    assert len({package for package, _ in stamps}) == len({loops for _, loops in stamps}) == 2
