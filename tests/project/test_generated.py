"""The checked-in modules under ``generated/`` are exactly what the sources emit today, and run on their own."""

from __future__ import annotations

import ast
import builtins
import difflib
import json
import os
import subprocess
import sys
import textwrap
from functools import cache
from pathlib import Path

import pytest

from symgen.compiling.choose_tree import on_tree
from symgen.compiling.looped import generate_looped
from symgen.compiling.pipeline import MethodChoice, choose_method, generate
from symgen.describe import load
from symgen.describe.mechanism import Mechanism
from symgen.lower.looped.law import is_loopable
from symgen.methods import METHODS

ROOT = Path(__file__).resolve().parents[2]
GENERATED = ROOT / "generated"
UPDATE = "SYMGEN_UPDATE_GENERATED"
MODELS = (
    *("pendulum", "four-bar", "slider-crank", "n-four-bar:2", "andrews", "driven-four-bar", "bricard"),
    *("four-bar joint", "bricard joint"),  # with the joints of a tree for coordinates
)
THOROUGH = ("pendulum", "four-bar")
#: Also emitted for CUDA and in lanes, by the methods of `CORE`.
OTHER_TARGETS = ("four-bar",)
CORE = ("lagrange", "baumgarte", "direct-correction")
#: Also emitted in the looped shape, the first with every method; modules of all mechanisms stand in one folder.
LOOPED = ("four-bar", "bricard")
#: Stands in headers of looped modules in place of the digest of all sources, which changes with every edit.
GENERATOR = "of-golden-trees"
EXPLICIT = {"ode", "one-step"}
HOW = f"if the change is wanted, run `make generated` (or set {UPDATE}=1) and commit the result"


def folder(model: str) -> str:
    """Return the folder's name: an identifier, so that the folder can be imported as a package."""
    return model.replace("-", "_").replace(":", "_").replace(" ", "_")


def described(model: str) -> Mechanism:
    """Return a mechanism, on its tree where its name says so."""
    name, _, coordinates = model.partition(" ")
    return on_tree(load(name)) if coordinates == "joint" else load(name)


def choices(model: str) -> tuple[MethodChoice, ...]:
    """Return what is emitted for a model.

    For small ones every method in all its forms, with all values of its options; for the others the three methods that
    share most of their code with the rest.
    """
    found: dict[str, MethodChoice] = {}
    for name, method in METHODS.items():
        if model not in THOROUGH and name not in CORE:
            continue
        explicit = bool(EXPLICIT & set(method.forms))
        variants = [{option.name: value} for option in method.options for value in option.values]
        for options in [{}, *variants] if explicit else [{}]:
            if model in THOROUGH or options.get("solver") in (None, "elimination"):
                choice = choose_method(name, options, implicit=not explicit)
                found[choice.stem] = choice
        if model in THOROUGH and set(method.forms) - EXPLICIT:
            choice = choose_method(name, None, implicit=True)
            found[choice.stem] = choice
    return tuple(found[stem] for stem in sorted(found))


@cache
def emitted(model: str) -> dict[str, str]:
    """Return file name -> source."""
    made = dict(generate(described(model), choices(model)).modules)
    if model in OTHER_TARGETS:
        core = tuple(choose_method(name) for name in CORE)
        for target in ("cuda", "lanes"):
            made |= generate(load(model), core, target=target).modules
    return {f"{stem}.py": source for stem, (source, _) in made.items()}


def looped_choices(model: str) -> list[MethodChoice]:
    """Return what is emitted in the looped shape: every method, option and descriptor form for the first model."""
    chosen = CORE if model != LOOPED[0] else tuple(METHODS.names)
    found = []
    for name in chosen:
        method = METHODS.get(name)
        variants = [{}, *({o.name: value} for o in method.options for value in o.values[1:])]
        forms = [(given, False) for given in variants] if EXPLICIT & set(method.forms) else []
        if set(method.forms) - EXPLICIT and (model == LOOPED[0] or name == CORE[0]):
            forms.append(({}, True))
        for given, implicit in forms:
            choice = choose_method(name, given, implicit)
            if is_loopable(method, choice.options, implicit):
                found.append(choice)
    return found


@cache
def emitted_looped() -> dict[str, str]:
    """Return file name -> source of looped modules, and for each mechanism one of how it is made of them."""
    files: dict[str, str] = {}
    for model in LOOPED:
        made = generate_looped(load(model), looped_choices(model), GENERATOR)
        source, tables = made.pop("mechanism")
        files[f"{folder(model)}.py"] = source
        wanted = {law: tables[law] for law in ("law_lagrange", "law_lagrange_implicit", "law_penalty") if law in tables}
        lines = json.dumps(wanted, separators=(", ", ": "))
        files[f"{folder(model)}.json"] = (
            textwrap.fill(lines, 120, break_on_hyphens=False, break_long_words=False) + "\n"
        )
        for stem, (module, _) in made.items():
            assert files.setdefault(f"{stem}.py", module) == module, f"{stem} depends on the mechanism"
    return files


@pytest.mark.parametrize("model", [*MODELS, "looped"])
def test_checked_in_modules_are_what_is_emitted(model: str) -> None:
    where = GENERATED / folder(model)
    expected = emitted_looped() if model == "looped" else emitted(model)
    if os.environ.get(UPDATE):
        where.mkdir(parents=True, exist_ok=True)
        for old in where.glob("*.*"):
            if old.name not in expected:
                old.unlink()
        for name, source in expected.items():
            (where / name).write_bytes(source.encode())
    there = sorted(p.name for p in where.glob("*") if p.name != "__pycache__")
    assert there == sorted(expected), f"files in {where.relative_to(ROOT)} differ from what is emitted; {HOW}"
    for name, source in expected.items():
        found = (where / name).read_bytes().decode()
        if found != source:
            pytest.fail(difference(f"generated/{folder(model)}/{name}", found, source))


def difference(name: str, found: str, expected: str) -> str:
    """Return a unified diff of at most 60 lines, and how to update."""
    lines = list(
        difflib.unified_diff(
            found.splitlines(), expected.splitlines(), f"{name} (checked in)", f"{name} (emitted now)", lineterm="", n=1
        )
    )
    more = [f"... {len(lines) - 60} further lines"] if len(lines) > 60 else []
    return "\n".join([f"{name} is not what the sources emit; {HOW}", *lines[:60], *more])


def test_nothing_else_is_checked_in() -> None:
    names = {p.name for p in GENERATED.iterdir() if p.is_dir() and p.name != "__pycache__"}
    assert names == {folder(model) for model in MODELS} | {"looped"}


def test_a_difference_says_how_to_update() -> None:
    text = difference("generated/x/model.py", "a = 1\n", "a = 2\n")
    assert "-a = 1" in text and "+a = 2" in text and "make generated" in text


def test_emitted_modules_name_nothing_of_this_machine() -> None:
    for path in GENERATED.rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        for word in (str(ROOT), str(Path.home()), "/tmp"):
            assert word not in text, f"{path.relative_to(ROOT)} contains '{word}'"


@pytest.mark.parametrize("path", sorted(GENERATED.rglob("*.py")), ids=lambda p: f"{p.parent.name}-{p.stem}")
def test_nothing_is_named_that_is_not_defined_nor_defined_that_is_not_used(path: Path) -> None:
    """Imports, constants and functions: of a module's own names, and of those of its siblings."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    functions = [node for node in tree.body if isinstance(node, ast.FunctionDef)]
    imports = [node for node in tree.body if isinstance(node, ast.Import | ast.ImportFrom)]
    imported = {alias.asname or alias.name for node in imports for alias in node.names}
    constants = {n.id for node in tree.body if isinstance(node, ast.Assign) for n in ast.walk(node) if bound(n)}
    constants.discard("__all__")
    for node in (node for node in imports if isinstance(node, ast.ImportFrom) and node.level == 1):
        sibling = ast.parse((path.parent / f"{node.module}.py").read_text(encoding="utf-8"))
        there = {getattr(n, "name", "") for n in sibling.body} | {n.id for n in ast.walk(sibling) if bound(n)}
        there |= {alias.name for n in sibling.body if isinstance(n, ast.ImportFrom) for alias in n.names}
        assert {alias.name for alias in node.names} <= there
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
    handed_on = {
        name
        for node in tree.body
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__"
        for name in ast.literal_eval(node.value)
    }
    used |= handed_on
    assert not (handed_on and functions), "a law's module only gathers"
    defined = imported | constants | {f.name for f in functions} | set(dir(builtins))
    assert used <= defined
    if path.stem != "machine":  # what it defines is for its siblings
        assert imported | constants <= used | outside


def bound(node: ast.AST) -> bool:
    return isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)


def test_a_checked_in_module_runs_without_symgen() -> None:
    """Stands alone: a fresh process that imports nothing but the emitted package; a free fall of the closed linkage."""
    script = """
        import sys
        import numpy as np
        sys.path.insert(0, sys.argv[1])
        from four_bar import lagrange, model

        y = np.zeros(19)
        y[0:3] = 0.5, 0.8660254037844386, np.pi / 3
        y[3:6] = 4.706229663272004, 3.236664273905892, 0.38564124740737094
        y[6:9] = 9.206229663272005, 2.3706388701214536, 1.8938968124057762
        p, w = np.zeros(200), np.zeros(2000)
        p[:3] = 2.0, 8.0, 5.0
        iw, ydot = np.zeros(16, dtype=np.int64), np.zeros(19)
        model.prepare(p)
        lagrange.prepare(p)
        flag = lagrange.rhs(0.0, y, p, w, iw, ydot)
        assert flag == 0, flag
        # with the crank, the whole linkage falls: M v' = f - D^T lambda has v' of the centres of mass downwards
        assert np.all(np.isfinite(ydot)) and ydot[2] == 0.0 and ydot[11] < 0.0, ydot
        forbidden = sorted({m.partition('.')[0] for m in sys.modules} & {'symgen', 'sympy', 'jinja2', 'msgspec'})
        assert not forbidden, forbidden
        print(repr(float(ydot[11])))
    """
    command = [sys.executable, "-B", "-c", textwrap.dedent(script), str(GENERATED)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600, check=False, cwd=ROOT / "tests")
    assert done.returncode == 0, done.stderr
    assert -9.81 * 3 < float(done.stdout) < 0.0
