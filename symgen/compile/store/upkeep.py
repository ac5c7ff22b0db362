"""Size of the cache, and removal of everything, or of the least recently used entries.

The cache is pruned once a day, and when one process has written a share of the limit since the last time.

Only files that this package writes are removed, recognised by folder and name, so that another folder set as cache by
mistake loses nothing. A file that another process removes or writes meanwhile is left to it.
"""

from __future__ import annotations

import os
import re
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from symgen.compile.store import private
from symgen.compile.store.locks import file_lock
from symgen.compile.store.paths import private_folder

if TYPE_CHECKING:
    from filelock import BaseFileLock

MODELS, NATIVE, BYTECODE, TABLES, LOCKS = "models", "native", "bytecode", "tables", "locks"
LIMIT = 10**9

# `<name>_<digest16>_<format>`: the digest has a fixed length, so underscores in the name do no harm.
MODEL_FOLDER = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,63}_[0-9a-f]{16}_(0|[1-9][0-9]{0,5})")

_PRUNED = "pruned"
_DAY = 86400.0
#: Share of the limit that one process may write between two prunings.
_SHARE = 0.1
# Age from which a temporary file is one of a killed process.
_ABANDONED = 3600.0
#: Bytes written by this process into each cache folder since the last pruning.
_written = Counter[Path]()


@dataclass(frozen=True)
class CacheInfo:
    """Content of a cache.

    Attributes
    ----------
    entries : int
        Emitted modules.
    compiled : int
        Compiled signatures of functions.
    bytes : int
        Size of all files together.
    """

    entries: int
    compiled: int
    bytes: int


class _Item(NamedTuple):
    """Files that are removed together, in this order: time of their last use, and size."""

    used: float
    files: tuple[Path, ...]
    bytes: int


def cache_info(root: Path) -> CacheInfo:
    """Return the size and the numbers of entries of a cache folder."""
    models = [item for folder in _model_folders(root) for item in _items_by_use(folder)]
    compiled = {folder: list(_items_by_use(folder)) for folder in _compiled_folders(root)}
    native = sum(len(items) for folder, items in compiled.items() if NATIVE in (folder.name, folder.parent.name))
    size = sum(item.bytes for items in (models, *compiled.values()) for item in items)
    return CacheInfo(len(models), native, size)


def clear_cache(root: Path) -> None:
    """Remove all files of symgen, except the folders of models that another process is making now.

    The cache folder and the locks, which are empty files, stay: two processes must not hold a lock of the same name on
    different files.
    """
    for folder in _model_folders(root):
        try:
            lock = folder_lock(root, folder.name)
            lock.acquire(timeout=0)
        except (OSError, NotImplementedError):  # Timeout is an OSError: another process is at work there
            continue
        try:
            _reduce_to_size([folder], 0, 0.0)
        finally:
            lock.release()
    _reduce_to_size(list(_compiled_folders(root)), 0, 0.0)
    with suppress(OSError):
        os.rmdir(root / MODELS)
    private.remove_file(root / LOCKS / _PRUNED)


def prune_cache(root: Path, limit: int) -> None:
    """Remove the least recently used entries down to a number of bytes, and remains of killed processes."""
    _reduce_to_size([*_model_folders(root), *_compiled_folders(root)], limit, _ABANDONED)


def _reduce_to_size(folders: list[Path], limit: int, age: float) -> None:
    """Remove entries of folders down to a size, temporary files of an age, and empty folders."""
    items = sorted(item for folder in folders for item in _items_by_use(folder))
    excess = sum(item.bytes for item in items) - limit
    for item in items:
        if excess <= 0:
            break
        for path in item.files:
            private.remove_file(path)
        excess -= item.bytes
    for folder in folders:
        with suppress(OSError):
            for path in _list_folder(folder):
                if path.name.startswith(private.TEMPORARY) and time.time() - path.lstat().st_mtime >= age:
                    private.remove_file(path)
            os.rmdir(folder)


def note_written(root: Path, size: int) -> None:
    """Add to the bytes written into a cache folder, and prune it if due."""
    _written[root] += size
    pruned = root / LOCKS / _PRUNED
    with suppress(OSError):
        recent = pruned.is_file() and abs(time.time() - pruned.stat().st_mtime) < _DAY
        if not recent or _written[root] > _SHARE * LIMIT:
            _written[root] = 0
            private.write_own(pruned, b"")
            prune_cache(root, LIMIT)


def folder_lock(root: Path, folder: str) -> BaseFileLock:
    """Return the lock of a model's folder, not yet taken."""
    private_folder(root / LOCKS)
    return file_lock(root / LOCKS / f"{folder}.lock", mode=0o600)


def _model_folders(root: Path) -> Iterator[Path]:
    for folder in _list_folder(root / MODELS):
        if MODEL_FOLDER.fullmatch(folder.name) and private_folder(folder):
            yield folder


def _compiled_folders(root: Path) -> Iterator[Path]:
    """Yield the folders of machine code, byte code and tables, subfolders before their parents."""
    for name in (NATIVE, BYTECODE, TABLES):
        yield from (path for path in _list_folder(root / name) if path.is_dir() and not path.is_symlink())
        yield root / name


def _items_by_use(folder: Path) -> Iterator[_Item]:
    """Yield the entries of a folder; the first file of each was touched when it was used."""
    suffixes = (".json", ".py") if MODEL_FOLDER.fullmatch(folder.name) else (private.SUFFIX,)
    for stem in {path.stem for path in _list_folder(folder) if path.suffix in suffixes}:
        files, statuses = tuple(folder / f"{stem}{suffix}" for suffix in suffixes), []
        for path in files:
            with suppress(OSError):
                statuses.append(path.lstat())
        if statuses:
            yield _Item(statuses[0].st_mtime, files, sum(status.st_size for status in statuses))


def _list_folder(folder: Path) -> list[Path]:
    """Return the content of a folder that is the user's own; another one counts as empty."""
    try:
        return sorted(folder.iterdir()) if folder.is_dir() and private_folder(folder) else []
    except OSError:
        return []
