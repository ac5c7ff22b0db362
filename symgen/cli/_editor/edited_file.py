"""The file that is edited: read once, written on request alone, whole, and never over changes of others unasked."""

from __future__ import annotations

import hashlib
import threading
from pathlib import Path
from typing import Any

from symgen.base.errors import InputError, quote
from symgen.base.files import check_writable, system_message, write_whole
from symgen.describe import catalogue
from symgen.describe.edits.template import new_file_text
from symgen.describe.edits.text_changes import keep_line_ends
from symgen.describe.files.load import LARGEST_FILE, read_text
from symgen.describe.files.meant_files import hint_on_files

_MARK = "\ufeff"


class Document:
    """A mechanism file, which need not exist yet.

    Parameters
    ----------
    path : Path
        Where it is, or will be.
    text : str, optional
        What a file that does not exist yet begins with.

    Attributes
    ----------
    path : Path
        As given.
    """

    def __init__(self, path: Path, text: str | None = None) -> None:
        check_writable("edit", path)
        self.path, self._begun = path, text
        self._lock = threading.Lock()
        if text is None:
            read_text(path)

    @classmethod
    def of_arguments(cls, model: str | None, new: str | None) -> Document:
        """Return the document of the words of a command: a file, a new one, or a copy of an entry of the catalogue.

        Raises
        ------
        InputError
            If there is no such file or entry, or a file that would be begun exists.
        """
        if (model is None) == (new is None):
            got = "neither" if model is None else "both"
            raise InputError("edit", "the path of a mechanism file or a catalogue name, or --new NAME", got)
        if new is not None:
            return cls._begin_from(Path(f"{new}.toml"), new_file_text(new))
        name = str(model)
        entry = catalogue.file_of_entry(name)
        if entry is not None and not Path(name).is_file():
            return cls._begin_from(Path(f"{name}.toml"), entry.read_text(encoding="utf-8"))
        path = Path(name)
        if not path.is_file():
            hint = hint_on_files(path)
            if not hint and path.suffix == ".toml":
                hint = f"symgen edit --new {path.stem} begins one"
            raise InputError(
                "edit", "the path of a mechanism file or a catalogue name without a size", quote(name), hint
            )
        return cls(path)

    @classmethod
    def _begin_from(cls, path: Path, text: str) -> Document:
        if path.exists():
            raise InputError("edit", "the name of a file that does not exist yet", f"'{path}'", f"symgen edit {path}")
        return cls(path, text)

    def read(self) -> dict[str, Any]:
        """Return the text with one line end, and the digest of the file, empty where there is none.

        Raises
        ------
        InputError
            If it cannot be read, is too large or no text.
        """
        if not self.path.exists() and self._begun is not None:
            return {"text": self._begun, "digest": ""}
        text = read_text(self.path)
        return {"text": text.replace("\r\n", "\n"), "digest": self.file_digest()}

    def save(self, text: str, digest: str, force: bool) -> dict[str, Any]:
        """Write the text, or return that the file has changed since it had a digest.

        Parameters
        ----------
        text : str
            The text, with one line end.
        digest : str
            Of the file when it was read or saved last.
        force : bool
            Whether changes of others are written over.

        Raises
        ------
        InputError
            If it cannot be written.
        """
        if len(text.encode(errors="replace")) > LARGEST_FILE:
            raise InputError(self.path.name, f"a file of at most {LARGEST_FILE} bytes", "a larger one")
        with self._lock:
            if not force and self.file_digest() != digest:
                return {"changed": True}
            before = self._read_bytes().decode("utf-8", errors="replace")
            text = keep_line_ends(text, before)
            if before.startswith(_MARK) and not text.startswith(_MARK):
                text = _MARK + text
            write_whole(self.path, text)
            return {"saved": True, "digest": self.file_digest()}

    def _read_bytes(self) -> bytes:
        try:
            return self.path.read_bytes()
        except FileNotFoundError:
            return b""
        except OSError as error:
            raise InputError(str(self.path), "a file that can be read", system_message(error)) from None

    def file_digest(self) -> str:
        """Return the digest of the file as it is on the disk; empty where there is none."""
        content = self._read_bytes()
        return hashlib.sha256(content).hexdigest() if content or self.path.exists() else ""
