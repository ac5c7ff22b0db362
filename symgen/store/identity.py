"""Digests of the sources that a compiled function depends on.

Nothing here depends on memory addresses, on the order of sets or on time stamps, so a digest is the same in every
process that would compile the same function.
"""

from __future__ import annotations

import functools
import hashlib
import inspect
import linecache
import os
import types
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

#: Sources of symgen by their dependents: the text of emitted code and its metadata, loops and their helpers,
#: the compiler, rows of sweeps, and cells of studies, whose run times are kept as well.
SOURCES: Mapping[str, tuple[str, ...]] = {
    "code": ("describe", "vocabulary", "formulate", "ir", "lower", "emit", "methods", "compiling", "escapes.py"),
    "loops": ("integrators", "layout", "loopcode", "loops", "rows", "runs", "starts"),
    "compiler": ("native",),
    "rows": (
        "breaks",
        "ensemble",
        "integrators",
        "result",
        "running",
        "layout",
        "loopcode",
        "loops",
        "rows",
        "runs",
        "starts",
    ),
    "cells": (
        *("breaks", "compiling", "integrators", "native", "reruns", "result", "running", "store", "study"),
        *("layout", "loopcode", "loops", "rows", "runs", "starts", "api.py", "base/settings.py"),
    ),
}
#: Folders of templates of emitted code.
TEMPLATES = ("looped", "parts", "curves")


def combined_digest(*parts: str | bytes) -> str:
    """Return the SHA-256 of the parts in hexadecimal; boundaries of parts matter."""
    result = hashlib.sha256()
    for part in parts:
        data = part.encode() if isinstance(part, str) else part
        result.update(b"%d:" % len(data))
        result.update(data)
    return result.hexdigest()


def source_stamp(function: Any) -> str:
    """Return the digest of all sources that a function's machine code depends on.

    These are loops, starts, runs and integrators of symgen as a whole, the function's own file, and the files of
    compiled functions that it calls, directly or through others.

    Parameters
    ----------
    function : function
        Python function with a source file.

    Returns
    -------
    str
        Hexadecimal digest.
    """
    files = sorted({inspect.getfile(reached) for reached in _reached(function, {})})
    # Contents without names: the same sources in another place give the same machine code.
    return combined_digest(*sorted(file_digest(file) for file in files), sources_digest(*SOURCES["loops"]))


def content(path: str) -> bytes:
    """Return the content of a source file, or of a cell of a notebook, which is no file; empty if missing."""
    try:
        return Path(path).read_bytes()
    except OSError:
        return "".join(linecache.getlines(path)).encode()


def _reached(function: Any, functions: dict[int, Any]) -> Iterable[Any]:
    """Return a function and, recursively, the compiled functions that it names, directly or in a module."""
    functions[id(function)] = function
    for name in function.__code__.co_names:
        value = function.__globals__.get(name)
        values = vars(value).values() if isinstance(value, types.ModuleType) and _near(value, function) else (value,)
        for each in values:
            called = getattr(each, "py_func", None)
            if isinstance(called, types.FunctionType) and id(called) not in functions:
                _reached(called, functions)
    return functions.values()


def _near(module: types.ModuleType, function: Any) -> bool:
    """Whether a module belongs to the function's package; versions in the key cover installed packages."""
    return module.__name__.partition(".")[0] == str(function.__module__).partition(".")[0]


@functools.cache
def file_digest(path: str) -> str:
    """Return the digest of a file's content at the first request, at the latest when it was loaded."""
    return combined_digest(content(path))


@functools.cache
def sources_digest(*places: str) -> str:
    """Return the digest of sources: of files and folders of symgen, and of folders of templates by absolute paths."""
    base = os.path.dirname(os.path.dirname(__file__))
    parts = list[str | bytes]()
    for place in places:
        root = os.path.join(base, place)
        for path in _sources(root):
            parts += (place + path[len(root) :] if not os.path.isabs(place) else path[len(root) :], content(path))
    return combined_digest(*parts)


def _sources(place: str) -> Iterator[str]:
    """Yield a source file, or those below a folder in a fixed order; twice as fast as ``rglob``.

    Of a folder in an archive, the archive.
    """
    if place.endswith((".py", ".j2")):
        yield place
        return
    if not os.path.isdir(place):  # symgen is in an archive, which is one source
        while not os.path.exists(place):
            place = os.path.dirname(place)
        yield place
        return
    with os.scandir(place) as entries:
        for entry in sorted(entries, key=lambda entry: entry.name):
            if entry.name.endswith((".py", ".j2")) or (entry.name != "__pycache__" and entry.is_dir()):
                yield from _sources(entry.path)
