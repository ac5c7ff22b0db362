"""Descriptions that mechanisms were validated from, kept as long as these exist in this process."""

from __future__ import annotations

import weakref
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

from symgen.base.errors import InputError
from symgen.describe.mechanism import Mechanism


class Source(str):
    """The name of a file for messages, with the folder that its meshes are named from.

    Attributes
    ----------
    folder : str
        Where the file is, or another folder that names of meshes begin in.
    file : path or None
        The file, where its lines are those of the description: TOML.
    """

    folder: str = ""
    file: Path | None = None

    @classmethod
    def of_file(cls, path: Path, folder: Path | None = None) -> Source:
        """Return the source of a file; meshes are named from the folder that it is in, unless from another one."""
        source = cls(path.name)
        source.folder = str(path.absolute().parent if folder is None else folder)
        source.file = path if folder is None else None
        return source


@contextmanager
def errors_in(source: str) -> Iterator[None]:
    """Note the file in errors, where `source` has one."""
    try:
        yield
    except InputError as error:
        if isinstance(source, Source):
            error.file = source.file
        raise


class Origin(NamedTuple):
    """A description, and the name of its file or other origin for messages."""

    raw: Mapping[str, Any]
    source: str


_ORIGINS: dict[int, Origin] = {}


def keep_origin(mechanism: Mechanism, raw: Mapping[str, Any], source: str) -> Mechanism:
    """Return `mechanism`, and keep its description beside it."""
    _ORIGINS[id(mechanism)] = Origin(raw, source)  # as in `symgen.describe.remembered`
    weakref.finalize(mechanism, _ORIGINS.pop, id(mechanism), None).atexit = False
    return mechanism


def origin_of(mechanism: Mechanism) -> Origin | None:
    """Return the description of a mechanism; None for one that was pickled, or derived from another."""
    return _ORIGINS.get(id(mechanism))
