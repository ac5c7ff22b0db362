"""Content of the cache: emitted modules, one folder for each model, and self-checking files.

An emitted module is a pair of ``X.py`` and ``X.json``. The Python file is written first, then its description, which
checks itself by a digest of both and of their place. A kill at any moment therefore leaves a valid pair or a pair that
does not count, a changed bit anywhere makes a miss, and two processes that write the same pair do not disturb each
other.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from symgen.base.errors import SymgenError
from symgen.compile.store import private, upkeep
from symgen.compile.store.identity import combined_digest
from symgen.compile.store.paths import (
    ENVIRONMENT_VARIABLE,
    cache_location,
    cache_root,
    private_folder,
    replace_by_temporary,
)

_STEM = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,63}")
#: Modules by their stems: source and description; and descriptions alone.
Modules = Mapping[str, tuple[str, Mapping[str, Any]]]
Described = dict[str, dict[str, Any]]


def get_or_make_data(place: str, name: str, key: str, make: Callable[[], bytes]) -> bytes:
    """Return data determined by a key, from the cache or made anew and kept there.

    Parameters
    ----------
    place, name : str
        Folder below the cache folder, and the beginning of the file's name.
    key : str
        Text with everything the data depend on.
    make : callable
        Makes the data.
    """
    location = cache_location()
    if not location.persistent:
        return make()
    path = location.path / place / f"{plain_name(name)}-{combined_digest(key)[:32]}{private.SUFFIX}"
    data = private.read_entry(path, key)
    if data is None:
        data = make()
        with suppress(OSError):
            upkeep.note_written(location.path, private.write_entry(path, key, data))
    return data


def plain_name(name: str, length: int = 60) -> str:
    """Return the end of a name in characters valid in file systems."""
    return re.sub(r"[^0-9A-Za-z_.-]", "_", name)[-length:]


def folder_name(name: str, digest: str, number: int) -> str:
    """Return the name of a model's folder, ``<name>_<digest16>_<format>``.

    Parameters
    ----------
    name : str
        The model's name: letters, digits, ``_`` and ``-``, at most 64.
    digest : str
        Hexadecimal digest of all inputs of the modules, of which 16 digits are used.
    number : int
        Number of the emitted format.
    """
    return _check_folder(f"{name}_{digest[:16]}_{number}")


def _check_folder(folder: str) -> str:
    if upkeep.MODEL_FOLDER.fullmatch(folder) is None:
        raise ValueError(f"'{folder}' is not a folder name of the form '<name>_<digest16>_<format>'")
    return folder


class Entries:
    """The emitted modules in the cache folder of this process."""

    def __init__(self) -> None:
        self.root = cache_root()

    def path(self, folder: str, stem: str) -> Path:
        """Return the path of the Python file of an entry, ``<stem>.py``, whether it exists or not.

        Parameters
        ----------
        folder : str
            From `folder_name`.
        stem : str
            Name of the module, a Python identifier.
        """
        if _STEM.fullmatch(stem) is None:
            raise ValueError(f"'{stem}' is not the name of a module")
        return self.root / upkeep.MODELS / _check_folder(folder) / f"{stem}.py"

    def get(self, folder: str, stem: str) -> dict[str, Any] | None:
        """Return the description of an entry, None if it is not complete, and note its use.

        Of an incomplete one only the description is removed: another process may have just written the new Python file
        and be about to describe it, and a Python file without description does not count anyway.
        """
        path = self.path(folder, stem)
        text = private.read_entry(path.with_suffix(".json"), _entry_key(path, private.read_own(path)))
        metadata: dict[str, Any] | None = None if text is None else json.loads(text)
        return metadata

    def put(self, folder: str, stem: str, source: str, metadata: Mapping[str, Any]) -> None:
        """Write or overwrite an entry.

        Where the cache folder cannot be written, e.g. because the disk is full, a temporary one takes its place for
        the rest of the process, and the content of the model's folder moves there too.

        Parameters
        ----------
        folder, stem : str
            As for `path`.
        source : str
            The emitted module.
        metadata : mapping
            JSON data, without nan and infinity.

        Raises
        ------
        SymgenError
            If the temporary folder cannot be written either.
        """
        path = self.path(folder, stem)
        content, text = source.encode(), json.dumps(dict(metadata), allow_nan=False, sort_keys=True).encode()
        try:
            self._write(path, content, text)
        except OSError as error:
            self.root = replace_by_temporary(self.root, _unwritable_sentence(self.root, error))
            try:
                new = self.path(folder, stem)
                for file in sorted(path.parent.glob("[!.]*")):
                    if (old := private.read_own(file)) is not None:
                        private.write_own(new.with_name(file.name), old)
                self._write(new, content, text)
            except OSError as again:
                reason = _unwritable_sentence(self.root, again)
                raise SymgenError(f"{reason}; set {ENVIRONMENT_VARIABLE} to another folder") from again

    def _write(self, path: Path, content: bytes, text: bytes) -> None:
        private_folder(self.root)
        private.write_own(path, content)
        size = private.write_entry(path.with_suffix(".json"), _entry_key(path, content), text)
        upkeep.note_written(self.root, len(content) + size)

    @contextmanager
    def lock_folder(self, folder: str) -> Iterator[None]:
        """Lock a model's folder while its modules are made; a second process waits here.

        Call `get` again inside: the first process may have made the entry. Where files cannot be locked, no process
        waits; both then do the work and write the same. Not to be nested for one folder.
        """
        name = _check_folder(folder)
        try:
            lock = upkeep.folder_lock(self.root, name)
            lock.acquire(poll_interval=0.02)
        except (OSError, NotImplementedError):
            yield
            return
        try:
            yield
        finally:
            lock.release()

    def description(self, folder: str, stem: str, make: Callable[[], tuple[str, dict[str, Any]]]) -> dict[str, Any]:
        """Return the description of one module, like `descriptions`; `make` returns its source and description."""
        return self.descriptions(folder, (stem,), lambda _: {stem: make()})[stem]

    def descriptions(
        self, folder: str, stems: Iterable[str], make: Callable[[Callable[[str], bool]], Modules]
    ) -> Described:
        """Return the descriptions of modules; where one is missing, one process makes and keeps it.

        Parameters
        ----------
        folder : str
            As for `path`.
        stems : iterable of str
            The modules.
        make : callable
            Takes a function that tests whether a module exists; returns the others, and modules that they need, in
            the form for `put`.
        """
        stems = tuple(stems)
        with self.completing(folder, stems) as described:
            if len(described) < len(stems):
                for stem, (source, metadata) in make(described.__contains__).items():
                    self.put(folder, stem, source, metadata)
                    described[stem] = dict(metadata)
        return described

    @contextmanager
    def completing(self, folder: str, stems: Iterable[str]) -> Iterator[Described]:
        """Yield the descriptions of those modules that exist; where one is missing, other processes wait.

        Parameters
        ----------
        folder : str
            As for `path`. Not to be nested for one folder.
        stems : iterable of str
            The modules.
        """
        stems = tuple(stems)
        described = self._complete_descriptions(folder, stems)
        if len(described) == len(stems):
            yield described
        else:
            with self.lock_folder(folder):
                yield self._complete_descriptions(
                    folder, stems
                )  # another process may have made them while this one waited

    def _complete_descriptions(self, folder: str, stems: Iterable[str]) -> Described:
        """Return the descriptions of those modules that exist with all their own modules."""
        described = {stem: metadata for stem in stems if (metadata := self.get(folder, stem)) is not None}
        return {
            stem: metadata
            for stem, metadata in described.items()
            if all(self.get(folder, part) is not None for part in metadata.get("modules", ()))
        }


def _entry_key(path: Path, content: bytes | None) -> str:
    """Return the key of the description of a module with some content at its place."""
    return combined_digest(path.parent.name, path.stem, content or b"")


def _unwritable_sentence(root: Path, error: OSError) -> str:
    return f"the cache folder '{root}' cannot be written ({error.strerror or error})"
