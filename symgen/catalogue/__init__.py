"""The mechanisms that come with symgen: TOML files, and modules for those that come in sizes.

A file ``name.toml`` is the entry ``name``. A module ``n_four_bar.py`` is the sized entry ``n-four-bar``, its `KIND` a
`Sized` that makes the description for a size.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, cast

import msgspec

from symgen.errors import InputError
from symgen.registry import Registry


def _folder() -> Path:
    """Return the folder of the files; in an archive, what stands for one."""
    here = Path(__file__).parent
    if here.is_dir():
        return here
    from importlib.resources import files

    return cast(Path, files(__name__))


_FOLDER = _folder()


class Sized(msgspec.Struct, frozen=True):
    """A family of mechanisms, one for each size.

    Parameters
    ----------
    build : callable
        Size -> nested dictionary, as a file would give it.
    default, largest : int
        The size where none is asked for, and the largest that is allowed; the smallest is 1.
    """

    build: Callable[[int], dict[str, Any]]
    default: int
    largest: int


class Entry(msgspec.Struct, frozen=True):
    """One line of the catalogue."""

    name: str
    title: str
    source: str
    sized: bool = False
    default_size: int | None = None


SIZED: Registry[Sized] = Registry(__name__, "sized mechanism")


def _files() -> dict[str, Path]:
    found = sorted(_FOLDER.iterdir(), key=lambda path: path.name)
    return {path.name.removesuffix(".toml"): path for path in found if path.name.endswith(".toml")}


def names() -> tuple[str, ...]:
    """Return all names in alphabetical order."""
    return tuple(sorted({*_files(), *SIZED.names}))


def raw(name: str, size: int | None = None) -> dict[str, Any]:
    """Return the description of the entry `name`, not yet validated.

    Parameters
    ----------
    name : str
        One of `names`.
    size : int, optional
        Only for sized entries.
    """
    if name in SIZED:
        family = SIZED.get(name)
        wanted = family.default if size is None else size
        if not 1 <= wanted <= family.largest:
            raise InputError("model", f"a size of '{name}' from 1 to {family.largest}", str(wanted))
        return family.build(wanted)
    if size is not None:
        raise InputError("model", f"'{name}' without a size", f"'{name}:{size}'")
    from symgen.describe.load import read_toml

    return read_toml(_files()[name])


def entries() -> tuple[Entry, ...]:
    """Return every entry with its title and source, in alphabetical order."""
    result = []
    for name in names():
        head = raw(name)["mechanism"]
        default = SIZED.get(name).default if name in SIZED else None
        result.append(Entry(name, head["title"], head["source"], default is not None, default))
    return tuple(result)


def example_of_size() -> str:
    """Return how a size is written, for messages."""
    name = SIZED.names[0]
    return f"'{name}:{SIZED.get(name).default}'"
