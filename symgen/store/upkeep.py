"""Size of the cache, and removal: of everything, or of what was not used for longest.

The size is known from a tally: its first line says when everything was last counted and how much there was, every
further line how much was written since; many lines become one again. Where the sum passes the limit, and once a day,
the cache is pruned.

Only files that this package writes are ever removed, told by folder and by name, so that a cache folder that was
pointed at something else by mistake loses nothing. A file that another process removes or writes meanwhile is left to
it.
"""

from __future__ import annotations

import os
import re
import time
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from symgen.store import private
from symgen.store.paths import private_folder

if TYPE_CHECKING:
    from filelock import BaseFileLock

MODELS, NATIVE, BYTECODE, LOCKS = "models", "native", "bytecode", "locks"
LIMIT = 10**9

# `<name>_<digest16>_<format>`: the digest has a fixed length, so underscores in the name do no harm.
MODEL_FOLDER = re.compile(
    r"(?P<name>[A-Za-z0-9][A-Za-z0-9_-]{0,63})_(?P<digest>[0-9a-f]{16})_(?P<format>0|[1-9][0-9]{0,5})"
)

_TALLY = "written"
_DAY = 86400.0
# The tally is read at every write: a day in which much is written must not make writing ever slower.
_LINES = 200
# Pruning leaves room: else every entry that is written would mean looking through all the others.
_SHARE = 0.8
# A temporary file older than this was left by a process that was killed.
_ABANDONED = 3600.0


@dataclass(frozen=True)
class CacheInfo:
    """What a cache holds.

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


@dataclass(frozen=True)
class _Item:
    """What is removed together: its files in the order of removal, when it was last used, and its size."""

    files: tuple[Path, ...]
    used: float
    bytes: int


def info(root: Path) -> CacheInfo:
    """Count what is in a cache folder."""
    models = list(_models(root))
    native = list(_files(root / NATIVE, private.SUFFIX))
    others = list(_files(root / BYTECODE, private.SUFFIX))
    return CacheInfo(len(models), len(native), sum(item.bytes for item in (*models, *native, *others)))


def clear(root: Path) -> CacheInfo:
    """Remove all that symgen wrote, except the folders of models that another process is making now.

    The locks, which are empty files, stay: two processes must not hold a lock by the same name on different files.

    Parameters
    ----------
    root : Path
        The cache folder; it stays.

    Returns
    -------
    CacheInfo
        What is left.
    """
    for folder in _model_folders(root):
        lock = folder_lock(root, folder.name)
        try:
            lock.acquire(timeout=0)
        except (OSError, NotImplementedError):  # Timeout is an OSError: somebody is at work there
            continue
        try:
            for item in _pairs(folder):
                _remove(item)
            _remove_temporary(folder, 0.0)
            _remove_folder(folder)
        finally:
            lock.release()
    for name in (NATIVE, BYTECODE):
        for item in _files(root / name, private.SUFFIX):
            _remove(item)
        _tidy(root / name, 0.0)
    for name in (MODELS, NATIVE, BYTECODE):
        _remove_folder(root / name)
    private.remove(root / LOCKS / _TALLY)
    private.remove(root / "pruned")  # of earlier versions
    return info(root)


def prune(root: Path, limit: int = LIMIT) -> CacheInfo:
    """Remove what was not used for longest until the cache is small enough, and what killed processes left behind.

    Parameters
    ----------
    root : Path
        The cache folder.
    limit : int, default 1 GB
        Bytes that may stay.

    Returns
    -------
    CacheInfo
        What is left.
    """
    items = [
        *_models(root),
        *_files(root / NATIVE, private.SUFFIX),
        *_files(root / BYTECODE, private.SUFFIX),
    ]
    excess = sum(item.bytes for item in items) - limit
    for item in sorted(items, key=lambda item: (item.used, item.files)):
        if excess <= 0:
            break
        _remove(item)
        excess -= item.bytes
    for name in (NATIVE, BYTECODE):
        _tidy(root / name, _ABANDONED)
    for folder in _model_folders(root):
        _remove_temporary(folder, _ABANDONED)
        _remove_folder(folder)
    return info(root)


def note_written(root: Path, size: int) -> None:
    """Note that an entry of so many bytes was written, and prune if there is too much by now.

    An entry that replaces another counts twice until everything is counted again, and one that another process notes
    while lines become one may not count until then.
    """
    with suppress(OSError):
        tally = _tally(root)
        if tally is None or sum(tally[1:]) + size > LIMIT:
            _count(root, time.time(), prune(root, LIMIT if tally is None else int(_SHARE * LIMIT)).bytes)
        elif len(tally) > _LINES:
            _count(root, tally[0], sum(tally[1:]) + size)
        else:
            _append(root, f"{size}\n")


def root_of(path: Path) -> Path | None:
    """Return the cache folder that a file lies in, None where it lies in none."""
    return next((folder.parent for folder in path.parents if folder.name in (MODELS, NATIVE, BYTECODE)), None)


def _tally(root: Path) -> list[int] | None:
    """Return when the cache was counted, what it held and what was written since; None where it is to be counted."""
    try:
        tally = [int(word) for word in (private.read_own(root / LOCKS / _TALLY) or b"").split()]
        known = len(tally) > 1 and 0 <= time.time() - tally[0] < _DAY and min(tally) >= 0
    except (ValueError, OverflowError):  # what stands there is no tally
        return None
    return tally if known else None


def _count(root: Path, when: float, total: int) -> None:
    private.write_own(root / LOCKS / _TALLY, f"{int(when)} {total}\n".encode())


def _append(root: Path, line: str) -> None:
    """Append with one system call, so that lines of several processes do not mix."""
    descriptor = os.open(root / LOCKS / _TALLY, os.O_WRONLY | os.O_APPEND | getattr(os, "O_NONBLOCK", 0))
    try:
        os.write(descriptor, line.encode())
    finally:
        os.close(descriptor)


def folder_lock(root: Path, folder: str) -> BaseFileLock:
    """Return the lock of a model's folder, not yet taken."""
    import filelock

    private_folder(root / LOCKS)
    return filelock.FileLock(root / LOCKS / f"{folder}.lock", mode=0o600)


def _model_folders(root: Path) -> Iterator[Path]:
    for folder in _listing(root / MODELS):
        if MODEL_FOLDER.fullmatch(folder.name) and private_folder(folder):
            yield folder


def _models(root: Path) -> Iterator[_Item]:
    for folder in _model_folders(root):
        yield from _pairs(folder)


def _pairs(folder: Path) -> Iterator[_Item]:
    for stem in sorted({path.stem for path in _listing(folder) if path.suffix in (".py", ".json")}):
        item = _item(folder / f"{stem}.json", folder / f"{stem}.py")
        if item is not None:
            yield item


def _files(folder: Path, suffix: str) -> Iterator[_Item]:
    """Give the files with a suffix in a folder and in the folders directly below."""
    for path in _listing(folder):
        if path.suffix == suffix:
            if (item := _item(path)) is not None:
                yield item
        elif path.is_dir() and not path.is_symlink():
            yield from _files(path, suffix)


def _item(*files: Path) -> _Item | None:
    """Give what is known of the files that exist; the first was touched when it was used."""
    statuses = []
    for path in files:
        with suppress(OSError):
            statuses.append(path.lstat())
    if not statuses:
        return None
    return _Item(files, statuses[0].st_mtime, sum(status.st_size for status in statuses))


def _listing(folder: Path) -> list[Path]:
    """List a folder that is ours; another one is empty to us."""
    try:
        return sorted(folder.iterdir()) if folder.is_dir() and private_folder(folder) else []
    except OSError:
        return []


def _remove(item: _Item) -> None:
    for path in item.files:
        private.remove(path)


def _tidy(folder: Path, age: float) -> None:
    """Remove abandoned files in a folder and below, and folders that are empty."""
    _remove_temporary(folder, age)
    for path in _listing(folder):
        if path.is_dir() and not path.is_symlink():
            _remove_temporary(path, age)
            _remove_folder(path)


def _remove_temporary(folder: Path, age: float) -> None:
    for path in _listing(folder):
        if path.name.startswith(private.TEMPORARY):
            with suppress(OSError):
                if time.time() - path.lstat().st_mtime >= age:
                    private.remove(path)


def _remove_folder(folder: Path) -> None:
    with suppress(OSError):
        os.rmdir(folder)
