"""Texts of a file that were never saved, kept outside it until they are saved or thrown away."""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

from symgen.base.errors import InputError
from symgen.base.files import write_whole
from symgen.compile.store.paths import private_folder, state_root

#: Texts of one file that are kept at most; the oldest ones go.
MOST = 20


class Unsaved:
    """The texts of one file that were never saved, one for each page that wrote one.

    They outlive the page, the browser and the server: each is a file in a folder of the user, which nobody else can
    read.

    Parameters
    ----------
    path : Path
        The file, which need not exist.
    """

    def __init__(self, path: Path) -> None:
        self.path = path.absolute()
        self.folder = folder_of_texts() / _name_from(str(self.path))

    def keep_text(self, page: str, text: str) -> bool:
        """Keep the text of a page in place of the one before; return whether it could be kept.

        Parameters
        ----------
        page : str
            A word that no other page has.
        text : str
            The text.
        """
        if not private_folder(folder_of_texts()) or not private_folder(self.folder):
            return False
        entry = {"page": page, "file": str(self.path), "time": time.time(), "text": text}
        try:
            write_whole(self._file_of_page(page), json.dumps(entry))
        except InputError:
            return False
        for _, file in sorted(self._files_by_time(), reverse=True)[MOST:]:
            with suppress(OSError):
                file.unlink()
        return True

    def forget_page(self, page: str) -> None:
        """Throw the text of a page away; nothing happens where there is none."""
        with suppress(OSError):
            self._file_of_page(page).unlink()
            self.folder.rmdir()  # where it was the last one

    def texts_but(self, text: str) -> list[dict[str, Any]]:
        """Return the texts that differ from the one of the file, each with its page and its time, the newest first."""
        found = list[dict[str, Any]]()
        for _, file in self._files_by_time():
            with suppress(OSError, ValueError, KeyError, TypeError):
                entry = json.loads(file.read_text(encoding="utf-8"))
                kept = {"page": str(entry["page"]), "time": float(entry["time"]), "text": str(entry["text"])}
                found += [kept] if kept["text"] != text else []
        return sorted(found, key=lambda entry: -float(entry["time"]))

    def _file_of_page(self, page: str) -> Path:
        return self.folder / f"{_name_from(page)}.json"  # whatever the word is, it is no path

    def _files_by_time(self) -> Iterator[tuple[float, Path]]:
        with suppress(OSError):
            for file in self.folder.glob("*.json"):
                with suppress(OSError):
                    yield file.stat().st_mtime, file


def folder_of_texts() -> Path:
    """Return the folder for texts of all files."""
    return state_root() / "unsaved"


def _name_from(word: str) -> str:
    return hashlib.sha256(word.encode(errors="replace")).hexdigest()[:32]
