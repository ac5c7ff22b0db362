"""Location of the cache: the user's cache folder, the folder named by ``SYMGEN_CACHE_DIR``, or a temporary one."""

from __future__ import annotations

import atexit
import os
import shutil
import stat
import tempfile
from dataclasses import dataclass
from pathlib import Path

from symgen.base.errors import SymgenError

ENVIRONMENT_VARIABLE = "SYMGEN_CACHE_DIR"

_ATTEMPTS = 100

_TAG_NAME = "CACHEDIR.TAG"
_TAG_TEXT = (
    "Signature: 8a477f597d28d172789f06886806bc55\n"
    "# This folder is a cache made by symgen; `symgen cache clear` empties it.\n"
    "# About cache folder tags: https://bford.info/cachedir/\n"
)


@dataclass(frozen=True)
class CacheLocation:
    """The cache folder of this process.

    Attributes
    ----------
    path : Path
        Existing folder that belongs to the user and can be written.
    persistent : bool
        False if `path` is a temporary folder that is removed when the process ends.
    reason : str
        Sentence on why the configured folder is not used; empty if it is used.
    """

    path: Path
    persistent: bool
    reason: str = ""


# By process and configuration: a forked child must not share its parent's temporary folder, which the parent removes.
_locations: dict[tuple[int, str | None], CacheLocation] = {}


def cache_location() -> CacheLocation:
    """Return the cache folder with the reason for it; a missing folder is made.

    Returns
    -------
    CacheLocation
        The same object for every call, until ``SYMGEN_CACHE_DIR`` changes.
    """
    key = _location_key()
    if key not in _locations:
        _locations[key] = _find_location(key[1])
    return _locations[key]


def _location_key() -> tuple[int, str | None]:
    return os.getpid(), os.environ.get(ENVIRONMENT_VARIABLE) or None


def replace_by_temporary(root: Path, reason: str) -> Path:
    """Return a temporary folder that replaces an unusable cache folder from now on.

    Parameters
    ----------
    root : Path
        The folder; if it is the cache folder of this process, `cache_location` gives the new one afterwards.
    reason : str
        The problem, as a sentence.

    Raises
    ------
    SymgenError
        If no temporary folder can be made either.
    """
    location = _temporary_location(reason)
    key = _location_key()
    if key in _locations and _locations[key].path == root:
        _locations[key] = location
    return location.path


def cache_root() -> Path:
    """Return the cache folder of this process; it exists and can be written."""
    return cache_location().path


def state_root() -> Path:
    """Return the folder for what the user would miss, which need not exist: no command empties it."""
    wish = os.environ.get(ENVIRONMENT_VARIABLE)
    if wish:
        return Path(wish).expanduser().absolute()
    import platformdirs

    return Path(platformdirs.user_state_path("symgen", appauthor=False))


def is_private_to_user(status: os.stat_result, *, private: bool = False) -> bool:
    """Return whether a file or folder belongs to the user and nobody else can change it.

    Parameters
    ----------
    status : os.stat_result
        Result of ``stat``.
    private : bool, default False
        Require that nobody else can read it either.

    Returns
    -------
    bool
        Always True on systems without owners (Windows).
    """
    if not hasattr(os, "geteuid"):
        return True
    forbidden = (stat.S_IRWXG | stat.S_IRWXO) if private else (stat.S_IWGRP | stat.S_IWOTH)
    return status.st_uid == os.geteuid() and not status.st_mode & forbidden


def private_folder(path: Path) -> bool:
    """Make a folder that only the user can enter; return whether it is one.

    Parameters
    ----------
    path : Path
        The folder; its parents are made as well. A link is refused.

    Returns
    -------
    bool
        False if it cannot be made, is no folder, or is open to others.
    """
    for _ in range(_ATTEMPTS):
        try:
            status = os.lstat(path)
            return stat.S_ISDIR(status.st_mode) and is_private_to_user(status, private=True)
        except OSError:
            pass
        try:
            _make_private_folder(path)
        except FileNotFoundError:  # another process cleared the cache and removed the new parent
            continue
        except OSError:
            return False
    return False


def _find_location(wish: str | None) -> CacheLocation:
    try:
        if wish is None:
            import platformdirs

            path = Path(platformdirs.user_cache_path("symgen", appauthor=False))
        else:
            path = Path(wish).expanduser().absolute()
        reason = _reason_against(path)
    except (OSError, RuntimeError) as error:  # no home folder at all is a RuntimeError
        return _temporary_location(f"the cache folder cannot be used: {error}")
    return CacheLocation(path, persistent=True) if not reason else _temporary_location(reason)


def _reason_against(path: Path) -> str:
    """Make `path` if it is missing; return the reason against its use, or nothing."""
    try:
        if not path.exists():
            _make_private_folder(path)
            (path / _TAG_NAME).write_text(_TAG_TEXT, encoding="utf-8")
        status = path.stat()
        if not stat.S_ISDIR(status.st_mode):
            return f"the cache folder '{path}' is not a folder"
        if not is_private_to_user(status):
            return f"the cache folder '{path}' belongs to, or can be changed by, somebody else"
        # Access rights are wrong on read-only file systems and for the superuser, so write a file.
        tempfile.TemporaryFile(dir=path).close()
    except OSError as error:
        return f"the cache folder '{path}' cannot be written: {error.strerror or error}"
    return ""


def _make_private_folder(path: Path) -> None:
    """Make a folder and its parents, each for the user only (`Path.mkdir` gives the mode to the last one alone)."""
    if not path.parent.is_dir():
        _make_private_folder(path.parent)
    path.mkdir(mode=0o700, exist_ok=True)


def _temporary_location(reason: str) -> CacheLocation:
    try:
        path = Path(tempfile.mkdtemp(prefix="symgen-"))
    except OSError as error:
        why = f"{reason}, and no temporary folder can be made ({error.strerror or error})"
        raise SymgenError(f"{why}; set {ENVIRONMENT_VARIABLE} to a folder that can be written") from None
    atexit.register(_remove_temporary, path, os.getpid())
    return CacheLocation(path, persistent=False, reason=reason)


def _remove_temporary(path: Path, process: int) -> None:
    if os.getpid() == process:
        shutil.rmtree(path, ignore_errors=True)
