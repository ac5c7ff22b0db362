"""Where the runs of an ensemble are collected: in memory, or in a folder that survives a kill at any moment.

A folder holds ``sweep.json`` (what is computed), ``values.npy`` and ``summary.npy`` (a row for every run) and
``done.txt`` (finished chunks, a number and the digest of its rows on each line). A chunk's rows are written before its
line is; one that is not listed, or whose rows have another digest, is computed again over whatever is there.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections.abc import Mapping
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError, SimulationError
from symgen.base.files import check_file_name, system_message, write_whole
from symgen.compile.store.locks import file_lock
from symgen.run.layout.ensemble_abi import N_SUMMARY
from symgen.study.ensemble.chunks import Chunk

if TYPE_CHECKING:
    from filelock import BaseFileLock

Array = NDArray[np.float64]

#: Changes when the files of a folder do.
FORM = 2
DESCRIPTION, VALUES, SUMMARY, DONE, LOCK = "sweep.json", "values.npy", "summary.npy", "done.txt", "lock"
_LINE = re.compile(rb"(0|[1-9][0-9]{0,9}) [0-9a-f]{32}")


class RowTable:
    """Rows of an ensemble, by run.

    Parameters
    ----------
    runs, quantities, times : int
        Sizes.
    chunk : int
        Runs in a chunk; the last one may have fewer.
    further : int
        Numbers that each run leaves of events.

    Attributes
    ----------
    values : Array, shape (runs, quantities, times)
        Quantities at the output times.
    summary : Array, shape (runs, N_SUMMARY + further)
        See `symgen.run.layout.ensemble_abi`.
    """

    def __init__(self, runs: int, quantities: int, times: int, chunk: int, further: int = 0) -> None:
        self.runs, self.chunk, self._width = runs, chunk, N_SUMMARY + further
        self.finished: set[int] = set()
        self.values: Array
        self.summary: Array
        self._open(quantities, times)

    def _open(self, quantities: int, times: int) -> None:
        self.values = np.full((self.runs, quantities, times), np.nan)
        self.summary = np.zeros((self.runs, self._width))

    @property
    def chunks(self) -> int:
        """Number of chunks."""
        return -(-self.runs // self.chunk)

    @property
    def runs_done(self) -> int:
        """Number of runs that are done."""
        last = self.chunks - 1
        return len(self.finished) * self.chunk - (
            (self.chunks * self.chunk - self.runs) if last in self.finished else 0
        )

    def missing_chunks(self) -> list[int]:
        """Return the chunks that are not done, in order."""
        return [index for index in range(self.chunks) if index not in self.finished]

    def bounds_of_chunk(self, index: int) -> tuple[int, int]:
        """Return first and last run (exclusive) of a chunk."""
        return index * self.chunk, min(self.runs, (index + 1) * self.chunk)

    def runs_done_mask(self) -> NDArray[np.bool_]:
        """Return which runs are done."""
        done = np.zeros(self.runs, dtype=np.bool_)
        for index in self.finished:
            first, last = self.bounds_of_chunk(index)
            done[first:last] = True
        return done

    def keep_chunk(self, index: int, chunk: Chunk) -> None:
        """Keep the rows of a chunk.

        Raises
        ------
        ValueError
            If it is done already: it was computed twice.
        SimulationError
            If a file cannot be written, e.g. because the disk is full.
        """
        if index in self.finished:
            raise ValueError(f"chunk {index} is done already")
        self._write(index, chunk)
        self.finished.add(index)

    def _write(self, index: int, chunk: Chunk) -> None:
        first, last = self.bounds_of_chunk(index)
        self.values[first:last] = chunk.values
        self.summary[first:last] = chunk.summary

    def close(self) -> None:
        """Let go of files; the arrays stay readable."""

    def __enter__(self) -> RowTable:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


class FolderTable(RowTable):
    """Rows in the files of a folder, one process at a time.

    Parameters
    ----------
    folder : Path
        Made when it is missing.
    description : mapping
        Description of the computation, as JSON can express it; a folder with another one is refused.
    resume : bool
        Whether a folder that has been begun may be continued.

    Raises
    ------
    InputError
        If the folder holds something else, cannot be written, or is in use.
    """

    def __init__(
        self,
        folder: Path,
        description: Mapping[str, Any],
        sizes: tuple[int, int, int, int, int],
        resume: bool,
    ) -> None:
        self.folder = folder
        self._description = {"symgen-sweep": FORM, **description}
        self._resume = resume
        self._lock: BaseFileLock | None = None
        self._files: dict[str, tuple[int, int, int]] = {}
        self._log = -1
        super().__init__(*sizes)

    def _open(self, quantities: int, times: int) -> None:
        import filelock

        where = f"folder '{self.folder}'"
        exists = check_folder(self.folder, self._resume)
        try:
            self.folder.mkdir(exist_ok=True)
            lock = file_lock(self.folder / LOCK)
            lock.acquire(timeout=0)
            self._lock = lock
        except filelock.Timeout:
            raise InputError(where, "one that no other process uses", "one in use") from None
        except OSError as error:
            raise InputError(where, "a folder that can be written", error.strerror or "an error") from None
        try:
            if exists:
                self._check_description(where)
            self._begin(quantities, times)
            self._read_log()
        except OSError as error:
            self.close()
            raise InputError(where, "a folder that can be written", system_message(error)) from None
        except BaseException:
            self.close()
            raise

    def _check_description(self, where: str) -> None:
        earlier, own = json.loads((self.folder / DESCRIPTION).read_text(encoding="utf-8")), self._description
        differing = sorted(k for k in {*earlier, *own} if earlier.get(k) != own.get(k))
        if not differing:
            return
        # other versions may say the same in other words, so nothing is said of what they have
        got = "one by another version of symgen" if "code" in differing else f"one with another {differing[0]}"
        raise InputError(where, "the sweep that was begun there", got, "name another output")

    def _begin(self, quantities: int, times: int) -> None:
        self.values = self._array_of_file(VALUES, (self.runs, quantities, times))
        self.summary = self._array_of_file(SUMMARY, (self.runs, self._width))
        if not (self.folder / DESCRIPTION).exists():  # last, so that a folder with a description is whole
            write_whole(self.folder / DESCRIPTION, json.dumps(self._description, indent=1) + "\n")

    def _array_of_file(self, name: str, shape: tuple[int, ...]) -> Array:
        """Return the array of a file, which is made anew where it is missing or damaged."""
        if not all(shape):
            return np.zeros(shape)
        path = self.folder / name
        mapped = _read_array(path, shape)
        if mapped is None:
            path.unlink(missing_ok=True)
            np.lib.format.open_memmap(path, mode="w+", dtype=np.float64, shape=shape).flush()
            mapped = _read_array(path, shape)
            if mapped is None:
                raise OSError(f"'{name}' cannot be read back")
        self._files[name] = (os.open(path, os.O_WRONLY), int(mapped.offset), 8 * int(np.prod(shape[1:])))
        return mapped

    def _read_log(self) -> None:
        path = self.folder / DONE
        content, log = path.read_bytes() if path.exists() else b"", b""
        for line in content.split(b"\n")[:-1]:  # after the last line end is a line that a kill tore, or nothing
            match = _LINE.fullmatch(line)
            index = int(match[1]) if match else self.chunks
            first, last = self.bounds_of_chunk(index)
            own = _log_line(index, self.values[first:last].tobytes(), self.summary[first:last].tobytes())
            if index < self.chunks and index not in self.finished and own == line + b"\n":
                self.finished.add(index)
                log += line + b"\n"
        if log != content:
            write_whole(path, log)
        self._log = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o666)

    def _write(self, index: int, chunk: Chunk) -> None:
        first, _ = self.bounds_of_chunk(index)
        contents = [np.ascontiguousarray(rows).tobytes() for rows in (chunk.values, chunk.summary)]
        try:
            for name, data in zip((VALUES, SUMMARY), contents, strict=True):
                if name in self._files:
                    file, offset, size = self._files[name]
                    _write_all(file, data, offset + first * size)
            os.write(self._log, _log_line(index, *contents))
        except OSError as error:
            raise SimulationError(f"the folder '{self.folder}' cannot be written: {system_message(error)}") from None

    def close(self) -> None:
        """Let go of the files; another process may use the folder then."""
        for file, _, _ in self._files.values():
            os.close(file)
        self._files = {}
        if self._log >= 0:
            os.close(self._log)
            self._log = -1
        if self._lock is not None:
            self._lock.release()
            self._lock = None

    def remove(self) -> None:
        """Remove the files and, where nothing else is in it, the folder."""
        self.close()
        for name in (DESCRIPTION, DONE, VALUES, SUMMARY, LOCK):
            (self.folder / name).unlink(missing_ok=True)
        if not any(self.folder.iterdir()):
            self.folder.rmdir()


def _log_line(index: int, *contents: bytes) -> bytes:
    """Return the line of a chunk with these rows."""
    return f"{index} {hashlib.sha256(b''.join(contents)).hexdigest()[:32]}\n".encode()


def _read_array(path: Path, shape: tuple[int, ...]) -> np.memmap[Any, np.dtype[np.float64]] | None:
    """Return the array in a file, None where there is none of this shape."""
    try:
        array = np.load(path, mmap_mode="r") if path.is_file() else None
    except Exception:  # whatever NumPy makes of a damaged head
        return None
    fits = (
        isinstance(array, np.memmap) and array.shape == shape and array.dtype == np.float64 and array.flags.c_contiguous
    )
    return array if fits else None


def check_folder(folder: Path, resume: bool) -> bool:
    """Return whether a sweep has been begun in a folder; refuse one that may not be used.

    Raises
    ------
    InputError
        If it holds something else, or a sweep that nobody asked to continue.
    """
    where = f"folder '{folder}'"
    check_file_name(where, folder)
    if not folder.exists():
        if not folder.parent.is_dir() or not os.access(folder.parent, os.W_OK):
            raise InputError(where, "a folder that can be made", f"no folder '{folder.parent}' to make it in")
        return False
    if not folder.is_dir():
        raise InputError(where, "a folder", "a file")
    ours = {DESCRIPTION, DONE, VALUES, SUMMARY, LOCK}
    others = sorted(path.name for path in folder.iterdir() if path.name not in ours or not path.is_file())
    if others:
        raise InputError(where, "an empty one or one of a sweep", f"one with '{others[0]}' in it")
    if not (folder / DESCRIPTION).exists():
        return False
    try:
        description = json.loads((folder / DESCRIPTION).read_text(encoding="utf-8"))
        form = description["symgen-sweep"]
    except (OSError, ValueError, TypeError, KeyError):
        raise InputError(where, "a folder of a sweep", f"another '{DESCRIPTION}'") from None
    if form != FORM:
        raise InputError(where, f"a sweep of form {FORM}", f"one of form {form}")
    if not resume:
        raise InputError(where, "one in which no sweep was begun", "one with a sweep", "`resume` continues it")
    return True


def _write_all(file: int, data: bytes, offset: int) -> None:
    view = memoryview(data)
    while view:
        written = os.pwrite(file, view, offset)
        view, offset = view[written:], offset + written
