"""Locks between processes: empty files of symgen's own, never the files of others."""

from __future__ import annotations

import errno
import os
import stat
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from filelock import BaseFileLock


def file_lock(path: Path, mode: int = 0o644) -> BaseFileLock:
    """Return a lock, not yet taken.

    Parameters
    ----------
    path : Path
        Its file, which need not exist.
    mode : int
        Permissions of a new file.

    Raises
    ------
    OSError
        If the path is a link or holds anything but an empty file: taking a lock may empty a file.
    """
    import filelock

    try:
        status = os.lstat(path)
    except FileNotFoundError:
        pass
    else:
        if not stat.S_ISREG(status.st_mode) or status.st_size or status.st_nlink > 1:
            raise OSError(errno.EEXIST, f"'{path.name}', which is no lock of symgen")
    return filelock.FileLock(path, mode=mode)
