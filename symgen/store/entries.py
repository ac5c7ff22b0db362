"""Emitted modules in the cache: pairs of ``X.py`` and ``X.json``, in one folder for each model.

The Python file is written first and its description last; the description holds a digest of both and of the place where
they belong. A kill at any moment therefore leaves a valid pair or something that does not count, a bit that was changed
anywhere makes a miss, and two processes that write the same pair do not disturb each other.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from symgen.errors import SymgenError
from symgen.store import private, upkeep
from symgen.store.identity import digest
from symgen.store.paths import ENVIRONMENT_VARIABLE, abandon, cache_root, private_folder

FORMAT = 2

_STEM = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,63}")


@dataclass(frozen=True)
class FolderName:
    """The name of a model's folder, ``<name>_<digest16>_<format>``, in its parts.

    Attributes
    ----------
    name : str
        The model's name: letters, digits, ``_`` and ``-``, at most 64.
    digest : str
        The first 16 hexadecimal digits of the digest of all that the modules are made from.
    format : int
        Number of the emitted format.
    """

    name: str
    digest: str
    format: int

    def __str__(self) -> str:
        text = f"{self.name}_{self.digest[:16]}_{self.format}"
        if upkeep.MODEL_FOLDER.fullmatch(text) is None:
            raise ValueError(f"'{text}' is not a folder name of the form '<name>_<digest16>_<format>'")
        return text

    @classmethod
    def parse(cls, text: str) -> FolderName | None:
        """Return the parts of a folder name, or None if it is not one."""
        found = upkeep.MODEL_FOLDER.fullmatch(text)
        return cls(found["name"], found["digest"], int(found["format"])) if found else None


#: Modules by their stems: source, and what describes it; and the latter alone.
Modules = Mapping[str, tuple[str, Mapping[str, Any]]]
Described = dict[str, dict[str, Any]]


class Entries:
    """The emitted modules below one cache folder.

    Parameters
    ----------
    root : Path, optional
        The cache folder; by default that of this process.
    """

    def __init__(self, root: Path | None = None) -> None:
        self.root = cache_root() if root is None else root

    def path(self, folder: str, stem: str) -> Path:
        """Return where the Python file of an entry is, or would be.

        Parameters
        ----------
        folder : str
            Text of a `FolderName`.
        stem : str
            Name of the module, a Python identifier.

        Returns
        -------
        Path
            Path of ``<stem>.py``.
        """
        if FolderName.parse(folder) is None:
            raise ValueError(f"'{folder}' is not a folder name of the form '<name>_<digest16>_<format>'")
        if _STEM.fullmatch(stem) is None:
            raise ValueError(f"'{stem}' is not the name of a module")
        return self.root / upkeep.MODELS / folder / f"{stem}.py"

    def get(self, folder: str, stem: str) -> dict[str, Any] | None:
        """Return the description of an entry if the entry is there and whole, and note that it was used.

        Parameters
        ----------
        folder, stem : str
            As for `path`.

        Returns
        -------
        dict or None
            What was given to `put`; None if there is no valid entry. An invalid one is made to count no more.
        """
        path = self.path(folder, stem)
        found = _validated(path)
        metadata = None if found is None else found[1]
        if metadata is not None:
            private.touch(path.with_suffix(".json"))
        else:
            # The description alone: another process may have written the new Python file just now and be about to
            # describe it, and a Python file without description does not count anyway.
            private.remove(path.with_suffix(".json"))
        return metadata

    def put(self, folder: str, stem: str, source: str, metadata: Mapping[str, Any]) -> None:
        """Write an entry, over whatever is there.

        Where the cache folder cannot be written, e.g. because the disk is full, a temporary one takes its place for
        the rest of the process, and what the model's folder held moves there too.

        Parameters
        ----------
        folder, stem : str
            As for `path`.
        source : str
            The emitted module.
        metadata : mapping
            Whatever JSON can express, without nan and infinity.

        Raises
        ------
        SymgenError
            If the temporary folder cannot be written either.
        """
        path = self.path(folder, stem)
        content, text = source.encode(), _text(metadata)
        try:
            self._write(path, content, text)
        except OSError as error:
            self._abandon(folder, error)
            try:
                self._write(self.path(folder, stem), content, text)
            except OSError as again:
                raise self._error(again) from again

    def _error(self, error: OSError) -> SymgenError:
        return SymgenError(f"{_unwritable(self.root, error)}; set {ENVIRONMENT_VARIABLE} to another folder")

    def _write(self, path: Path, content: bytes, text: str) -> None:
        description = {"format": FORMAT, "sha256": _digest(path, content, text), "metadata": json.loads(text)}
        private_folder(self.root)
        private.write_own(path, content)
        written = json.dumps(description, allow_nan=False, indent=1, sort_keys=True) + "\n"
        private.write_own(path.with_suffix(".json"), written.encode())
        upkeep.note_written(self.root, len(content) + len(written))

    def _abandon(self, folder: str, error: OSError) -> None:
        """Go on in a temporary folder, with the entries that the model's folder holds already."""
        old = self.path(folder, "model").parent
        found = {path: _validated(path) for path in sorted(old.glob("*.py")) if _STEM.fullmatch(path.stem)}
        self.root = abandon(self.root, _unwritable(self.root, error))
        try:
            for path, entry in found.items():
                if entry is not None:
                    self._write(self.path(folder, path.stem), entry[0], _text(entry[1]))
        except OSError as again:
            raise self._error(again) from again

    @contextmanager
    def building(self, folder: str) -> Iterator[None]:
        """Hold a model's folder while its modules are being made; a second process waits here.

        Ask `get` again inside: the process that was first may have made the entry. Where files cannot be locked there
        is no waiting; both then do the work and write the same. Not to be nested for one folder.

        Parameters
        ----------
        folder : str
            As for `path`.
        """
        self.path(folder, "model")  # refuses a wrong name before it becomes a file
        lock = upkeep.folder_lock(self.root, folder)
        try:
            lock.acquire(poll_interval=0.02)
        except (OSError, NotImplementedError):
            yield
            return
        try:
            yield
        finally:
            lock.release()

    def made(self, folder: str, stem: str, make: Callable[[], tuple[str, dict[str, Any]]]) -> dict[str, Any]:
        """Return what describes a module, which is made and kept where it is not there; one process makes it.

        Parameters
        ----------
        folder, stem : str
            As for `path`.
        make : callable
            Returns the module and what describes it, as `put` takes them.
        """
        return self.built(folder, (stem,), lambda _: {stem: make()})[stem]

    def built(self, folder: str, stems: Iterable[str], make: Callable[[Callable[[str], bool]], Modules]) -> Described:
        """Return what describes some modules; where one is not there they are made, by one process, and kept.

        Parameters
        ----------
        folder : str
            As for `path`.
        stems : iterable of str
            Modules that are wanted.
        make : callable
            Is told which of them there are, and returns the others, and modules that they need, as `put` takes them.
        """
        stems = tuple(stems)
        found = self._found(folder, stems)
        if len(found) < len(stems):
            with self.building(folder):
                found = self._found(folder, stems)  # another process may have made them while this one waited
                made = make(found.__contains__) if len(found) < len(stems) else {}
                for stem, (source, metadata) in made.items():
                    self.put(folder, stem, source, metadata)
                    found[stem] = dict(metadata)
        return found

    def _found(self, folder: str, stems: Iterable[str]) -> Described:
        """Return what describes those modules that are there; one whose own modules are not is not there either."""
        found = {stem: known for stem in stems if (known := self.get(folder, stem)) is not None}
        needed = {stem: known.get("modules", ()) for stem, known in found.items()}
        absent = [stem for stem, parts in needed.items() if any(self.get(folder, part) is None for part in parts)]
        return {stem: known for stem, known in found.items() if stem not in absent}

    def info(self) -> upkeep.CacheInfo:
        """Return what the whole cache holds: emitted modules, compiled functions and bytes."""
        return upkeep.info(self.root)

    def clear(self) -> upkeep.CacheInfo:
        """Remove all that symgen wrote below the root, except what another process is making; return what is left."""
        return upkeep.clear(self.root)

    def prune(self, limit: int = upkeep.LIMIT) -> upkeep.CacheInfo:
        """Remove what was not used for longest until no more than `limit` bytes are left; return what is left."""
        return upkeep.prune(self.root, limit)


def _text(metadata: Mapping[str, Any]) -> str:
    """Return metadata as the text that is digested."""
    return json.dumps(dict(metadata), allow_nan=False, sort_keys=True)


def _digest(path: Path, content: bytes, text: str) -> str:
    """Return the digest of a pair at its place."""
    return digest(path.parent.name, path.stem, content, text)


def _validated(path: Path) -> tuple[bytes, dict[str, Any]] | None:
    """Return source and metadata of a pair that is whole and in its place."""
    text = private.read_own(path.with_suffix(".json"))
    content = private.read_own(path)
    if text is None or content is None:
        return None
    try:
        description = json.loads(text)
    except (ValueError, RecursionError):  # a UnicodeDecodeError is a ValueError
        return None
    if not isinstance(description, dict) or description.get("format") != FORMAT:
        return None
    metadata = description.get("metadata")
    if not isinstance(metadata, dict):
        return None
    try:
        whole = description.get("sha256") == _digest(path, content, _text(metadata))
    except ValueError:  # nan or infinity, which is never written
        return None
    return (content, metadata) if whole else None


def _unwritable(root: Path, error: OSError) -> str:
    return f"the cache folder '{root}' cannot be written ({error.strerror or error})"
