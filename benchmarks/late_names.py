"""Names that are bound late: who means each name of the frame and of the turn, and when, as a page made from the code.

``python -m benchmarks.late_names`` writes ``docs/development/late-names.md``. The page follows from all `Meanings` of
`symgen.compile.loopcode.loop_instances` in the street `run`, and from the parts of schemes in
`symgen.run.loops.frame.RECIPES`.
"""

from __future__ import annotations

import ast
import importlib
import types
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from symgen.compile.loopcode.loop_instances import Meanings
from symgen.compile.native.pieces import Piece
from symgen.run.loops import frame
from symgen.run.printed import exchanged_run, foreseen_run, kept_reset, kept_run
from symgen.run.rows import lanes, row_observers, rows
from symgen.run.single import turn_of_run

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "development" / "late-names.md"
RUN = ROOT / "symgen" / "run"
#: Functions that are compiled with other meanings of names, and the packages of functions that are copied for it.
ROOTS = (
    *(frame.integrate, rows.run_rows, lanes.run_lanes, row_observers.observe_left),
    *(turn_of_run.serve_modes, turn_of_run.serve_resets, kept_reset.reset_run),
    *(kept_run.start_run, kept_run.advance_run, exchanged_run.indicate_run, exchanged_run.exchange_run),
    foreseen_run.foresee_run,
)
_COPIED = ("symgen.run.", "symgen.compile.loopcode.")
_HEAD = """# Names that are bound late

All loops share one source, and so do all turns of events. They call functions by global names, and `Instances` in
`symgen/compile/loopcode/loop_instances.py` makes copies in which some names mean something else: the step of a scheme,
the search for events, vector lanes. By default most names mean functions of `loops/unbound.py`, which do
nothing. This page, which `python -m benchmarks.late_names` makes from the code, says what each name means, and when.
Files are those of `symgen/run`.

## Who binds names

| dictionary | runs |
| --- | --- |
"""
_SCHEMES = """
A scheme, in `loops/schemes`, binds names in the calls of `loop` at the end of its file. `over_rows` inserts the
compiled loop of one run for `integrate`. [One frame](internals.md#one-frame) says what differs
between loops.
"""
_NAMES = """| name | by default | otherwise |
| --- | --- | --- |
"""


#: Packages, from which modules are imported.
_PACKAGES = {".".join(path.parent.relative_to(ROOT).parts) for path in (ROOT / "symgen").rglob("__init__.py")}


@dataclass(frozen=True)
class Meaning:
    """What a name means somewhere.

    Attributes
    ----------
    binder : str
        File and name of the dictionary, or file of the scheme, that binds it.
    value : str
        The function, or the constant.
    file : str
        File of the function, which for a constant is that of the binder.
    """

    binder: str
    value: str
    file: str


@cache
def _tree(module: str) -> ast.Module:
    return ast.parse((ROOT / (module.replace(".", "/") + ".py")).read_text(encoding="utf-8"))


def file_of(module: str) -> str:
    """Return the file of a module as the page has it."""
    return module.removeprefix("symgen.run.").replace(".", "/") + ".py"


@cache
def modules() -> tuple[types.ModuleType, ...]:
    """Return the modules of the street."""
    names = (path.relative_to(ROOT).with_suffix("").parts for path in sorted(RUN.rglob("*.py")))
    return tuple(importlib.import_module(".".join(parts)) for parts in names if parts[-1] != "__init__")


def assigned(module: str) -> Iterator[str]:
    """Yield the names that a module assigns."""
    for node in _tree(module).body:
        if isinstance(node, ast.Assign | ast.AnnAssign):
            for target in node.targets if isinstance(node, ast.Assign) else [node.target]:
                yield from (x.id for x in ast.walk(target) if isinstance(x, ast.Name))


def definition(module: str, name: str) -> tuple[str, str]:
    """Return the module that defines a global name of a module, and its name there."""
    for node in _tree(module).body:
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("symgen."):
            for alias in node.names:
                if (alias.asname or alias.name) == name and node.module not in _PACKAGES:
                    return definition(str(node.module), alias.name)
    return module, name


@cache
def dictionaries() -> dict[str, Meanings]:
    """Return all dictionaries of meanings, by file and name."""
    return {
        f"{file_of(module.__name__)} {name}": value
        for module in modules()
        for name in assigned(module.__name__)
        if isinstance(value := getattr(module, name), Meanings)
    }


def _meaning(binder: str, value: Any) -> Meaning:
    plain = value.plain if isinstance(value, Piece) else getattr(value, "py_func", value)
    if isinstance(plain, types.FunctionType):
        return Meaning(binder, plain.__name__, file_of(plain.__module__))
    return Meaning(binder, getattr(value, "__name__", repr(value)), binder.partition(" ")[0])


def schemes() -> list[tuple[str, dict[str, Any]]]:
    """Return modules of schemes with the names that each of their loops binds; loops of plugins are left out."""
    modules()
    found = ((recipe[0], names) for recipe, names in frame.RECIPES.values())
    own = (scheme for scheme in found if scheme[0].startswith("symgen.run."))
    return sorted(own, key=lambda scheme: scheme[0])


@cache
def meanings() -> dict[str, list[Meaning]]:
    """Return all meanings of each name besides the one by default."""
    found = dict[str, list[Meaning]]()
    for binder, names in dictionaries().items():
        for name, value in names.items():
            found.setdefault(name, []).append(_meaning(binder, value))
    for module, parts in schemes():
        for name, value in parts.items():
            meaning = _meaning(file_of(module), value)
            if meaning not in found.setdefault(name, []):
                found[name].append(meaning)
    return found


def _callees(function: Any, bound: dict[str, list[Any]]) -> Iterator[Any]:
    """Yield the functions that a function may call: by default, and by all meanings of names."""
    for name in function.__code__.co_names:
        for value in (function.__globals__.get(name), *bound.get(name, ())):
            plain = getattr(value, "py_func", value)
            if isinstance(plain, types.FunctionType) and plain.__module__.startswith(_COPIED):
                yield plain


@cache
def users() -> dict[str, list[types.FunctionType]]:
    """Return the functions that use each name, of those that are copied with other meanings."""
    bound = dict[str, list[Any]]()
    for names in (*map(dict, dictionaries().values()), *(parts for _, parts in schemes())):
        for name, value in names.items():
            bound.setdefault(name, []).append(value)
    waiting: list[Any] = [getattr(root, "py_func", root) for root in ROOTS]
    reached = set(waiting)
    while waiting:
        new = set(_callees(waiting.pop(), bound)) - reached
        reached |= new
        waiting += new
    found = dict[str, list[types.FunctionType]]()
    for function in reached:
        for name in function.__code__.co_names:
            found.setdefault(name, []).append(function)
    return found


@cache
def defaults() -> dict[str, list[tuple[str, str]]]:
    """Return file and name of what each name means by default: where it is used, and no dictionary binds it."""
    found = dict[str, list[tuple[str, str]]]()
    for name, others in meanings().items():
        bound = {(meaning.file, meaning.value) for meaning in others}
        where = (definition(f.__module__, name) for f in users().get(name, ()) if name in f.__globals__)
        places = {(file_of(module), own) for module, own in where}
        found[name] = sorted(places - bound) or sorted(places)
    return found


#: Parts of the page, by the rooms of the functions that use a name.
PARTS = {
    "The frame of loops": ("layout/", "loops/"),
    "The turn of events": ("effects/", "modes/"),
    "Rows of sweeps": ("rows/",),
    "Printed runs": ("printed/",),
}
#: The last part, of names that functions of the compiler mean by default.
_VECTORS = "Arrays and vectors"


def part_of(name: str) -> str:
    """Return the part of the page that a name belongs to: that of the lowest room in which it is used."""
    if all(file.startswith("symgen/compile/") for file, _ in defaults()[name]):
        return _VECTORS
    files = [file_of(function.__module__) for function in users()[name]]
    return next(part for part, rooms in PARTS.items() if any(file.startswith(rooms) for file in files))


def said(meaning: Meaning) -> str:
    """Return a function with its file, or a constant."""
    constant = meaning.value in ("True", "False") or meaning.value[0].isdigit()
    return f"`{meaning.value}`" if constant else f"`{meaning.value}` in `{meaning.file}`"


def _otherwise(meanings: list[Meaning]) -> str:
    """Return all other meanings of a name: those of dictionaries by their runs, and those of schemes by the value."""
    runs = {binder: names.when for binder, names in dictionaries().items()}
    by_value = dict[str, list[str]]()
    for meaning in meanings:
        if meaning.binder in runs:
            by_value.setdefault(said(meaning), []).append(runs[meaning.binder])
    texts = [f"{', '.join(dict.fromkeys(when))}: {value}" for value, when in by_value.items()]
    schemes = dict[str, list[str]]()
    for meaning in meanings:
        if meaning.binder not in runs:
            own = meaning.file == meaning.binder
            value = f"`{meaning.value}`" if own else said(meaning)
            schemes.setdefault(value, []).append(f"`{Path(meaning.binder).stem}`")
    texts += [f"{', '.join(names)}: {value}" for value, names in schemes.items()]
    return "; ".join(texts)


def page() -> str:
    """Return the page."""
    binders = [f"| `{binder}` | {names.when} |\n" for binder, names in dictionaries().items()]
    text, found, known = [_HEAD, *binders, _SCHEMES], meanings(), defaults()
    for part in (*PARTS, _VECTORS):
        text += [f"\n## {part}\n\n", _NAMES]
        for name, others in found.items():
            if part_of(name) == part:
                usual = ", ".join(f"`{file}`" for file, _ in known[name])
                text.append(f"| `{name}` | {usual} | {_otherwise(others)} |\n")
    return "".join(text)


def main() -> None:
    """Write the page."""
    PAGE.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
