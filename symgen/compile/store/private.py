"""Files for this package only: they carry a digest of their content and are opened only if they are the user's own.

Cached machine code and byte code are as powerful as programs, and unpickling a foreign file runs it. Such data are
therefore read only from a regular file that belongs to the user, in a folder nobody else can enter, and only after the
digest in the file's head has been compared with its content.
"""

from __future__ import annotations

import errno
import hashlib
import os
import stat
from pathlib import Path

from symgen.compile.store.paths import is_private_to_user, private_folder

SUFFIX = ".bin"
TEMPORARY = ".tmp-"

_MAGIC = b"symgen private 1\n"
_HEAD = len(_MAGIC) + hashlib.sha256().digest_size
_ATTEMPTS = 100
# Names that do not exist on every system; without them the flags are not set.
_ANY = getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)
# A pipe in a file's place must be recognised, not waited for.
_READ = os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0) | _ANY
_WRITE = os.O_WRONLY | os.O_CREAT | os.O_EXCL | _ANY


def read_entry(path: Path, key: str) -> bytes | None:
    """Return the content for a key, or nothing.

    Parameters
    ----------
    path : Path
        File written by `write_entry`.
    key : str
        The same text as for `write_entry`: a file renamed or copied to another key's place is a miss.

    Returns
    -------
    bytes or None
        None if the file is missing, damaged, or not the user's own. A damaged file is removed.
    """
    content = read_own(path)
    if content is None:
        return None
    head, data = content[:_HEAD], content[_HEAD:]
    if head != _entry_head(key, data):
        remove_file(path)
        return None
    note_use(path)
    return data


def read_own(path: Path) -> bytes | None:
    """Return the content of a file if it is the user's own, in a folder that nobody else can enter.

    Parameters
    ----------
    path : Path
        A regular file; a link is refused.

    Returns
    -------
    bytes or None
        None if the file cannot be read or is not the user's own.
    """
    try:
        if not private_folder(path.parent):
            return None
        descriptor = os.open(path, _READ)
        with open(descriptor, "rb") as file:
            # Check the opened file, not the name, which may refer to another file by now.
            status = os.fstat(descriptor)
            return file.read() if stat.S_ISREG(status.st_mode) and is_private_to_user(status) else None
    except OSError:
        return None


def write_entry(path: Path, key: str, data: bytes) -> int:
    """Write data for a key so that a reader gets all of them or the former content; return the size of the file.

    Parameters
    ----------
    path : Path
        File to write; a missing folder is made.
    key : str
        Text without which the file cannot be read back.
    data : bytes
        Data to keep.

    Raises
    ------
    OSError
        As for `write_own`.
    """
    write_own(path, _entry_head(key, data) + data)
    return _HEAD + len(data)


def write_own(path: Path, content: bytes) -> None:
    """Write a file through a temporary sibling, for the user only.

    Parameters
    ----------
    path : Path
        File to write; a missing folder is made.
    content : bytes
        The whole new content.

    Raises
    ------
    OSError
        If it cannot be written or the folder is not the user's own; no file remains then.
    """
    for attempt in range(_ATTEMPTS):
        if not private_folder(path.parent):
            raise PermissionError(errno.EACCES, "the folder is not private", str(path.parent))
        sibling = path.with_name(f"{TEMPORARY}{os.urandom(12).hex()}")
        try:
            descriptor = os.open(sibling, _WRITE, 0o600)
            try:
                with open(descriptor, "wb") as file:
                    file.write(content)
                os.replace(sibling, path)
            except BaseException:
                remove_file(sibling)
                raise
            return
        except FileNotFoundError:  # another process cleared the cache meanwhile
            if attempt == _ATTEMPTS - 1:
                raise


def remove_file(path: Path) -> bool:
    """Remove a file; False if it could not be removed or did not exist."""
    try:
        path.unlink()
    except OSError:
        return False
    return True


def note_use(path: Path) -> None:
    """Note the use of a file, for the removal of the least recently used files."""
    try:
        os.utime(path)
    except OSError:
        pass


def _entry_head(key: str, data: bytes) -> bytes:
    digest = hashlib.sha256(key.encode())
    digest.update(b"\0")
    digest.update(data)
    return _MAGIC + digest.digest()
