"""The text of emitted modules: some checked in under ``generated/``, digests of all."""

import ast
import builtins
import difflib
import hashlib
import json
import os
import shutil
from pathlib import Path
from typing import Any

import pytest
from support.golden import everything, shown

ROOT = Path(__file__).resolve().parents[2]
GENERATED = ROOT / "generated"
DIGESTS = GENERATED / "digests.json"
UPDATE = "SYMGEN_UPDATE_GENERATED"
HOW = f"if the change is wanted, run `make generated` (or set {UPDATE}=1) and commit the result"
#: Lines of all modules that are checked in.
MOST_LINES = 15_000


def test_checked_in_packages_are_what_is_emitted(tmp_path: Path) -> None:
    expected = shown(tmp_path)
    if os.environ.get(UPDATE):
        for name in {path.parts[0] for path in expected}:
            shutil.rmtree(GENERATED / name, ignore_errors=True)
        for path, source in expected.items():
            (GENERATED / path).parent.mkdir(parents=True, exist_ok=True)
            (GENERATED / path).write_bytes(source.encode())
    there = {path.relative_to(GENERATED) for path in GENERATED.rglob("*") if path.suffix not in (".pyc", "")}
    assert there - {Path(DIGESTS.name)} == {*expected}, f"files in generated/ differ; {HOW}"
    for path, source in expected.items():
        found = (GENERATED / path).read_bytes().decode()
        if path.suffix == ".json":
            assert_alike(json.loads(found), json.loads(source))
        elif found != source:
            pytest.fail(difference(f"generated/{path}", found, source))
    assert sum(text.count("\n") for path, text in expected.items() if path.suffix == ".py") <= MOST_LINES


def assert_alike(found: Any, expected: Any) -> None:
    """Compare metadata; numbers of a start are those of this machine's sine, up to rounding."""
    if isinstance(expected, dict):
        assert list(found) == list(expected), HOW
        pairs = [(found[key], value) for key, value in expected.items()]
    elif isinstance(expected, list):
        assert len(found) == len(expected), HOW
        pairs = [*zip(found, expected, strict=True)]
    else:
        assert found == (pytest.approx(expected, rel=1e-12, abs=1e-15) if isinstance(expected, float) else expected), (
            HOW
        )
        return
    for one, other in pairs:
        assert_alike(one, other)


@pytest.mark.slow
def test_emitted_modules_have_the_digests_that_are_checked_in() -> None:
    expected = {
        f"{name}/{stem}.py": hashlib.sha256(source.encode()).hexdigest()
        for name, emitted in everything().items()
        for stem, source in emitted().items()
    }
    if os.environ.get(UPDATE):
        DIGESTS.write_text(json.dumps(expected, indent=0, sort_keys=True) + "\n", encoding="utf-8")
    found = json.loads(DIGESTS.read_text(encoding="utf-8"))
    changed = sorted(name for name in {*found, *expected} if found.get(name) != expected.get(name))
    shows = "`symgen generate` at both commits shows what changed"
    assert not changed, f"{len(changed)} emitted modules changed: {', '.join(changed[:20])}; {shows}; {HOW}"


def difference(name: str, found: str, expected: str) -> str:
    """Return a unified diff of at most 60 lines, and how to update."""
    lines = list(
        difflib.unified_diff(
            found.splitlines(), expected.splitlines(), f"{name} (checked in)", f"{name} (emitted now)", lineterm="", n=1
        )
    )
    more = [f"... {len(lines) - 60} further lines"] if len(lines) > 60 else []
    return "\n".join([f"{name} is not what the sources emit; {HOW}", *lines[:60], *more])


@pytest.mark.slow_cases("andrews", "n_four_bar_2")
@pytest.mark.parametrize("name", everything())
def test_emitted_modules_name_nothing_of_this_machine(name: str) -> None:
    for stem, text in everything()[name]().items():
        for word in (str(ROOT), str(Path.home()), "/tmp"):
            assert word not in text, f"{name}/{stem} contains '{word}'"


@pytest.mark.by_turns(2)
@pytest.mark.fast("slider_crank", "n_four_bar_2", "driven_four_bar", "four_bar_joint")
@pytest.mark.parametrize("name", everything())
def test_nothing_is_named_that_is_not_defined_nor_defined_that_is_not_used(name: str) -> None:
    """Imports, constants and functions: of a module's own names, and of those of its siblings."""
    trees = {stem: ast.parse(source) for stem, source in everything()[name]().items()}
    for stem, tree in trees.items():
        functions = [node for node in tree.body if isinstance(node, ast.FunctionDef)]
        imports = [node for node in tree.body if isinstance(node, ast.Import | ast.ImportFrom)]
        imported = {alias.asname or alias.name for node in imports for alias in node.names}
        constants = {n.id for node in tree.body if isinstance(node, ast.Assign) for n in ast.walk(node) if bound(n)}
        for node in (node for node in imports if isinstance(node, ast.ImportFrom) and node.module in trees):
            sibling = trees[str(node.module)]
            there = {getattr(n, "name", "") for n in sibling.body} | {n.id for n in ast.walk(sibling) if bound(n)}
            assert {alias.name for alias in node.names} <= there, stem
        used: set[str] = set()
        for function in functions:
            own = {n.arg for n in ast.walk(function) if isinstance(n, ast.arg)}
            own |= {n.id for n in ast.walk(function) if bound(n)}
            own |= {n.name for n in ast.walk(function) if isinstance(n, ast.FunctionDef)}
            named = {n.id for n in ast.walk(function) if isinstance(n, ast.Name)}
            used |= named - own
        outside = {
            n.id
            for node in tree.body
            if not isinstance(node, ast.FunctionDef)
            for n in ast.walk(node)
            if isinstance(n, ast.Name) and not bound(n)
        }
        names = [f.name for f in functions]
        assert len(names) == len(set(names)), stem
        assert used <= imported | constants | set(names) | set(dir(builtins)), stem
        if stem != "machine":  # what it defines is for its siblings
            assert imported | constants <= used | outside, stem


def bound(node: ast.AST) -> bool:
    return isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
