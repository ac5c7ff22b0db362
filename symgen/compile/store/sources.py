"""Digests of symgen's own sources: of the whole package, or of some files with all that these import.

The code that something depends on follows from its imports, so no list names it: results depend on the whole package,
entries of the cache on what their makers import. Reading the package takes longer than the rest of a warm start's
digests, so its table is kept in the cache, under the sizes and times of all files.
"""

from __future__ import annotations

import functools
import inspect
import marshal
import os
import re
import sys
import time
import types
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from symgen.compile.store.entries import get_or_make_data
from symgen.compile.store.identity import combined_digest, file_content, file_digest
from symgen.compile.store.upkeep import TABLES

#: Makers of what the cache keeps: of emitted code, of loops, and of machine code. What they import counts as well.
CODE = ("derive", "run/compiling", "templates")
LOOPS = ("run/directions", "run/integrators", "run/loops", "run/modes", "run/printed", "run/rows", "run/single")
COMPILER = ("compile/native", "compile/store/jit.py", "compile/store/emitted.py")

#: Digest of each source, and the sources that it imports.
Table = Mapping[str, tuple[str, tuple[str, ...]]]

_PACKAGE = os.path.dirname(os.path.dirname(os.path.dirname(__file__)))
_ENDINGS = (".py", ".j2")
#: Sources changed within this time [s] may change again within the resolution of their times.
_RECENT = 2.0
_IMPORT = re.compile(rb"^[ \t]*(?:from (symgen[\w.]*) import ([^(\n]+|\([^)]*\))|import (symgen[\w.]*))", re.MULTILINE)
_NAME = re.compile(rb"(\w+)(?: as \w+)?")
_COMMENT = re.compile(rb"#[^\n]*")


@functools.cache
def package_digest() -> str:
    """Return the digest of all sources of symgen and of all templates: what results of runs depend on."""
    return combined_digest(*(part for name, (digest, _) in sorted(source_table().items()) for part in (name, digest)))


@functools.cache
def reached_digest(*roots: str) -> str:
    """Return the digest of sources and of all that they import, directly or through others.

    Parameters
    ----------
    *roots : str
        Files and folders of symgen, such as ``derive`` and ``compile/store/jit.py``; ``templates`` is the folder of
        templates.
    """
    known = source_table()
    return combined_digest(*(part for name in sorted(reached_sources(known, roots)) for part in (name, known[name][0])))


def source_stamp(function: object) -> str:
    """Return the digest of all sources that a function's machine code depends on.

    These are loops, starts, runs and integrators of symgen as a whole, the function's own file, the files of compiled
    functions that it calls, directly or through others, and what all of them import.

    Parameters
    ----------
    function : function
        Python function with a source file.

    Returns
    -------
    str
        Hexadecimal digest.
    """
    return _digest_of_sources(frozenset(inspect.getfile(each) for each in _called_functions(function, {})))


@functools.cache
def _digest_of_sources(files: frozenset[str]) -> str:
    known = source_table()
    own = {name for file in files if (name := os.path.relpath(file, _PACKAGE).replace(os.sep, "/")) in known}
    others = [file for file in files if not file.startswith(_PACKAGE + os.sep)]
    imports = {name for file in others for name in imported_names(file_content(file)) if name in known}
    # Contents without names: the same sources in another place give the same machine code.
    return combined_digest(*sorted(map(file_digest, others)), reached_digest(*LOOPS, *sorted(own | imports)))


def reached_sources(known: Table, roots: Iterable[str]) -> set[str]:
    """Return the names of sources below some roots, and of all that they import."""
    if len(known) == 1:  # an archive
        return set(known)
    waiting = [name for root in roots for name in known if name == root or name.startswith(f"{root}/")]
    found = set(waiting)
    while waiting:
        new = {name for name in known[waiting.pop()][1] if name in known} - found
        found |= new
        waiting += new
    return found


@functools.cache
def source_table() -> Table:
    """Return the digest and the imports of every source, read at the first request of the process."""
    files = dict(files_of_package(_PACKAGE))
    if not files:  # symgen is in an archive, which is one source
        return {"archive": (file_digest(_archive_path()), ())}
    states, latest = list[str](), 0.0
    for name, path in files.items():
        state = os.stat(path)
        latest = max(latest, state.st_mtime, state.st_ctime)
        states.append(f"{name} {state.st_size} {state.st_mtime_ns} {state.st_ctime_ns} {state.st_ino}")
    if time.time() - latest < _RECENT:
        return read_sources(files)
    key = "\n".join((_PACKAGE, sys.version, *states))
    found: Table = marshal.loads(get_or_make_data(TABLES, "sources", key, lambda: marshal.dumps(read_sources(files))))
    return found


def read_sources(files: Mapping[str, str]) -> dict[str, tuple[str, tuple[str, ...]]]:
    """Return the digest and the imports of sources.

    Parameters
    ----------
    files : mapping of str to str
        Paths of sources by their names.
    """
    found = dict[str, tuple[str, tuple[str, ...]]]()
    for name, path in files.items():
        text = file_content(path)
        found[name] = combined_digest(text), tuple(sorted({n for n in imported_names(text) if n in files} - {name}))
    return found


def imported_names(text: bytes) -> Iterator[str]:
    """Yield names that sources have which a text of Python may import, at any place of it, for types as for values."""
    for whole in _IMPORT.finditer(text):
        module = (whole[1] or whole[3]).decode()
        names = _NAME.findall(_COMMENT.sub(b"", whole[2])) if whole[1] else ()
        for dotted in (module, *(f"{module}.{name.decode()}" for name in names)):
            path = "/".join(dotted.split(".")[1:])
            yield from (f"{path}.py", f"{path}/__init__.py") if path else ("__init__.py",)


def files_of_package(package: str) -> Iterator[tuple[str, str]]:
    """Yield names and paths of the sources of a package and of its templates, in a fixed order."""
    yield from _sources_below(package, "")
    beside = os.path.join(os.path.dirname(package), "templates")
    if not os.path.isdir(os.path.join(package, "templates")) and os.path.isdir(beside):
        yield from _sources_below(beside, "templates/")


def _sources_below(folder: str, prefix: str) -> Iterator[tuple[str, str]]:
    """Yield names and paths of the sources below a folder; twice as fast as ``rglob``."""
    if not os.path.isdir(folder):
        return
    with os.scandir(folder) as entries:
        for entry in sorted(entries, key=lambda entry: entry.name):
            if entry.name.endswith(_ENDINGS):
                yield prefix + entry.name, entry.path
            elif entry.name != "__pycache__" and entry.is_dir():
                yield from _sources_below(entry.path, f"{prefix}{entry.name}/")


def _archive_path() -> str:
    place = _PACKAGE
    while not os.path.exists(place):
        place = os.path.dirname(place)
    return place


def _called_functions(function: Any, functions: dict[int, Any]) -> Iterable[Any]:
    """Return a function and, recursively, the compiled functions that it names, directly or in a module."""
    functions[id(function)] = function
    for name in function.__code__.co_names:
        value = function.__globals__.get(name)
        values = (
            vars(value).values()
            if isinstance(value, types.ModuleType) and _functions_near(value, function)
            else (value,)
        )
        for each in values:
            called = getattr(each, "py_func", None)
            if isinstance(called, types.FunctionType) and id(called) not in functions:
                _called_functions(called, functions)
    return functions.values()


def _functions_near(module: types.ModuleType, function: object) -> bool:
    """Whether a module belongs to the function's package; versions in the key cover installed packages."""
    return module.__name__.partition(".")[0] == str(function.__module__).partition(".")[0]
