"""The mechanisms included in symgen: TOML files, and modules for those with sizes.

A file ``name.toml`` is the entry ``name``. A module ``n_four_bar.py`` is the sized entry ``n-four-bar``, its `KIND` a
`Sized` that makes the description for a size. Entries are of two groups: entries of this folder are studied with every
method, in the gallery and in ``generated/``; the folder ``machines`` has entries with motor and load to start from.

In: a name, with a size for sized entries.
Out: the description as a nested dictionary, not yet validated.
Imports: msgspec; `base` and `vocabulary`.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, cast

import msgspec

from symgen.base.errors import InputError
from symgen.base.registry import Registry


def _catalogue_folder() -> Path:
    """Return the folder of the files; in an archive, its equivalent."""
    here = Path(__file__).parent
    if here.is_dir():
        return here
    from importlib.resources import files

    return cast(Path, files(__name__))


_FOLDER = _catalogue_folder()
#: Groups of entries: those of studies, the gallery and tests of every method, and machines to start from.
STUDIED, MACHINES = "studied", "machines"


class Sized(msgspec.Struct, frozen=True):
    """A family of mechanisms, one for each size.

    Parameters
    ----------
    build : callable
        Size -> nested dictionary, as read from a file.
    default, largest : int
        Default and largest size; the smallest is 1.
    """

    build: Callable[[int], dict[str, Any]]
    default: int
    largest: int


class CatalogueEntry(msgspec.Struct, frozen=True):
    """One line of the catalogue."""

    name: str
    title: str
    source: str
    sized: bool = False
    default_size: int | None = None
    group: str = STUDIED


SIZED: Registry[Sized] = Registry(__name__, "sized mechanism")


def _files_of_group(group: str) -> dict[str, Path]:
    folder = _FOLDER / MACHINES if group == MACHINES else _FOLDER
    paths = sorted(folder.iterdir(), key=lambda path: path.name)
    return {path.name.removesuffix(".toml"): path for path in paths if path.name.endswith(".toml")}


def names(group: str = STUDIED) -> tuple[str, ...]:
    """Return all names of a group in alphabetical order.

    Parameters
    ----------
    group : {"studied", "machines"}
        Group of the entries.
    """
    return tuple(sorted({*_files_of_group(group), *(SIZED.names if group == STUDIED else ())}))


def all_names() -> tuple[str, ...]:
    """Return the names of all groups in alphabetical order."""
    return tuple(sorted((*names(STUDIED), *names(MACHINES))))


def file_of_entry(name: str) -> Path | None:
    """Return the file of the entry `name`; None for sized ones, which are built."""
    return (_files_of_group(STUDIED) | _files_of_group(MACHINES)).get(name)


def raw(name: str, size: int | None = None) -> dict[str, Any]:
    """Return the description of the entry `name`, not yet validated.

    Parameters
    ----------
    name : str
        One of `all_names`.
    size : int, optional
        Only for sized entries.
    """
    if name in SIZED:
        family = SIZED.get(name)
        number = family.default if size is None else size
        if not 1 <= number <= family.largest:
            raise InputError("model", f"a size of '{name}' from 1 to {family.largest}", str(number))
        return family.build(number)
    if size is not None:
        raise InputError("model", f"'{name}' without a size", f"'{name}:{size}'")
    import tomllib

    file = (_files_of_group(STUDIED) | _files_of_group(MACHINES))[name]
    return _with_whole_paths(tomllib.loads(file.read_text(encoding="utf-8")), file.parent)


def _with_whole_paths(raw: dict[str, Any], folder: Path) -> dict[str, Any]:
    """Return a description with whole paths of the files of its modal bodies: an entry is read without a folder."""
    for table in raw.get("bodies", {}).values():
        if table.get("type") == "modal":
            table["file"] = str(folder / table["file"])
    return raw


def entries(group: str = STUDIED) -> tuple[CatalogueEntry, ...]:
    """Return the entries of a group with title and source, in alphabetical order.

    Parameters
    ----------
    group : {"studied", "machines"}
        Group of the entries.
    """
    result = []
    for name in names(group):
        head = raw(name)["mechanism"]
        default = SIZED.get(name).default if name in SIZED else None
        result.append(CatalogueEntry(name, head["title"], head["source"], default is not None, default, group))
    return tuple(result)


def example_of_size() -> str:
    """Return an example of an entry with a size, for messages."""
    name = SIZED.names[0]
    return f"'{name}:{SIZED.get(name).default}'"
