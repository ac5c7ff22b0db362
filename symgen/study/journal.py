"""Journal of a long study, a file: one line of JSON a finished cell, appended and never changed.

The key of a cell is the digest of everything that determines it, so a journal may serve several studies and survives
changes of any of them. A line torn by a kill is dropped when the file is opened again. A line that no longer matches
its digest stays, and its cell is computed again. A file that is no journal is refused and left unchanged. One process
at a time writes to it.
"""

from __future__ import annotations

import errno
import hashlib
import json
from collections.abc import Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import IO, TYPE_CHECKING, Any

from symgen.base.errors import InputError, SimulationError
from symgen.base.escapes import printable
from symgen.base.files import check_file_name
from symgen.base.plugins import plugin_digests
from symgen.base.version import __version__
from symgen.compile.store.identity import combined_digest
from symgen.compile.store.locks import file_lock
from symgen.compile.store.sources import package_digest

if TYPE_CHECKING:
    from filelock import BaseFileLock

#: First line of every journal; the number changes when the form of lines does.
FORM = 1
HEADER = json.dumps({"symgen-journal": FORM}).encode() + b"\n"

Outcome = dict[str, Any]


# -- the key of a cell -------------------------------------------------------------------------------------------------


def cell_key(**parts: object) -> str:
    """Return the digest of everything that determines a cell, 32 hexadecimal digits.

    Parameters
    ----------
    **parts
        Numbers, texts, None, and lists or mappings of these; floats count to their last digit, the order of keys does
        not. `identity` of a mechanism and `code_identity` are the parts for the model and for the computing code.

    Raises
    ------
    TypeError
        If a part has another type, whose text might not determine the value.
    """
    text = json.dumps(parts, sort_keys=True, separators=(",", ":"), default=_plain_key)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def _plain_key(value: object) -> dict[str, Any]:
    if isinstance(value, Mapping):
        return dict(value)
    raise TypeError(f"a cell's key cannot hold a {type(value).__name__}")


def code_identity() -> str:
    """Return a digest of the computing code: the version, the emitted form, the whole package and plugins."""
    from symgen.base.ir.program import FORMAT
    from symgen.run.compiling.folders import generator_digest

    return combined_digest(__version__, str(FORMAT), generator_digest(), package_digest(), *plugin_digests())


# -- the file ----------------------------------------------------------------------------------------------------------


class Journal:
    """Finished cells by key, in a file or, without a path, in memory only.

    Parameters
    ----------
    path : Path or None
        The file; created when missing, read when it exists.

    Raises
    ------
    InputError
        If the file is no journal, cannot be written, or is used by another process.
    """

    def __init__(self, path: Path | None = None) -> None:
        self.path = path
        self._done: dict[str, Outcome] = {}
        self._file: IO[bytes] | None = None
        self._lock: BaseFileLock | None = None
        self._created = False
        if path is not None:
            self._open(path)

    def __enter__(self) -> Journal:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Release the file for other processes."""
        if self._file is not None:
            self._file.close()
            self._file = None
            if self._created and not self._done and self.path is not None:  # a refused process leaves no file
                for path in (self.path, _lock_path(self.path)):
                    with suppress(OSError):
                        path.unlink()
        if self._lock is not None:
            self._lock.release()
            self._lock = None

    def __contains__(self, key: object) -> bool:
        return key in self._done

    def __len__(self) -> int:
        return len(self._done)

    def __iter__(self) -> Iterator[str]:
        return iter(self._done)

    def drop(self, key: str) -> None:
        """Forget a cell: it is computed again, and its new line counts."""
        self._done.pop(key, None)

    def get(self, key: str) -> Outcome | None:
        """Return the outcome of a cell, None if it is not finished."""
        return self._done.get(key)

    def add(self, key: str, outcome: Mapping[str, Any]) -> Outcome:
        """Write the outcome of a cell; on return the operating system has it.

        Parameters
        ----------
        key : str
            From `cell_key`.
        outcome : mapping
            JSON values; numbers that JSON lacks (nan, infinity) are refused.

        Returns
        -------
        dict
            The outcome as read back.

        Raises
        ------
        ValueError
            If the cell is finished already: it was computed twice.
        SimulationError
            If writing fails, e.g. on a full disk.
        """
        if key in self._done:
            raise ValueError(f"cell {key} is in the journal already")
        entry = {"key": key, "outcome": dict(outcome)}
        line = json.dumps(entry | {"sha256": _entry_digest(entry)}, allow_nan=False).encode()
        recorded: Outcome = json.loads(line)["outcome"]
        if self._file is not None:
            try:
                # one write call: a kill leaves a line whole or, on a full disk, torn at the end of the file
                if self._file.write(line + b"\n") != len(line) + 1:
                    raise OSError(errno.ENOSPC, "the disk is full")
            except OSError as error:
                why = error.strerror or str(error)
                raise SimulationError(f"the journal '{self.path}' cannot be written: {why}") from None
        self._done[key] = recorded
        return recorded

    def _open(self, path: Path) -> None:
        import filelock

        check_file_name(f"journal '{path}'", path)
        if not path.parent.is_dir():  # the lock would create it
            raise InputError(f"journal '{path}'", "a file in a folder that exists", f"no folder '{path.parent}'")
        _journal_bytes(path)  # a file that is no journal gets no lock file
        try:
            lock = file_lock(_lock_path(path))
            lock.acquire(timeout=0)
        except filelock.Timeout:
            raise InputError(f"journal '{path}'", "one that no other process uses", "one in use") from None
        except OSError as error:
            raise _unusable_error(path, error) from None
        self._lock = lock
        try:
            self._read(path)
        except BaseException:
            self.close()
            raise

    def _read(self, path: Path) -> None:
        try:
            content = _journal_bytes(path)
            whole, ended, torn = content.rpartition(b"\n")
            keep = len(whole) + len(ended)
            self._done.update(filter(None, map(_parse_line, whole.split(b"\n")[1:] if ended else ())))
            self._created = not path.exists()
            self._file = path.open("ab", buffering=0)
            if torn or (content and not ended):
                self._file.truncate(keep)
            if keep == 0:
                self._file.write(HEADER)
        except OSError as error:
            raise _unusable_error(path, error) from None


def _lock_path(path: Path) -> Path:
    return path.with_name(path.name + ".lock")


def _journal_bytes(path: Path) -> bytes:
    """Return the bytes of a journal, empty if the file does not exist."""
    if path.exists() and not path.is_file():
        raise InputError(f"journal '{path}'", "a file", "a folder, a pipe or a device")
    try:
        content = path.read_bytes() if path.exists() else b""
    except OSError as error:
        raise _unusable_error(path, error) from None
    if not content.startswith(HEADER) and not HEADER.startswith(content):
        got = "something else in line 1"
        raise InputError(f"journal '{path}'", "a journal of symgen", got, "it was left as it is; name another file")
    return content


def _parse_line(line: bytes) -> tuple[str, Outcome] | None:
    """Return key and outcome of a line, None of a damaged one."""
    try:
        entry = json.loads(line)
        written = entry.pop("sha256")
        return (entry["key"], _printable_outcome(entry["outcome"])) if written == _entry_digest(entry) else None
    except (ValueError, RecursionError, AttributeError, LookupError, TypeError):
        return None


def _printable_outcome(value: object) -> Any:
    """Return an outcome with printable texts, as symgen writes them: a journal may come from somebody else."""
    if isinstance(value, str):
        return printable(value)
    if isinstance(value, dict):
        return {key: _printable_outcome(each) for key, each in value.items()}
    return [_printable_outcome(each) for each in value] if isinstance(value, list) else value


def _entry_digest(entry: Mapping[str, Any]) -> str:
    return hashlib.sha256(json.dumps(entry, allow_nan=False, sort_keys=True).encode()).hexdigest()[:32]


def _unusable_error(path: Path, error: OSError) -> InputError:
    return InputError(f"journal '{path}'", "a file that can be written", error.strerror or "an error")
