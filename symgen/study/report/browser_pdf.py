"""PDF of a page, printed by a browser that is there."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from symgen.base.errors import InputError
from symgen.base.files import write_whole

#: Names under which systems have a browser that prints; `SYMGEN_BROWSER` says where another one is.
NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome", "microsoft-edge")
#: A browser that does not print within that has failed [s].
PATIENCE = 120.0


def find_browser() -> str | None:
    """Return the browser that prints; None where there is none, and matplotlib draws the pages."""
    return os.environ.get("SYMGEN_BROWSER") or next((p for p in map(shutil.which, NAMES) if p), None)


def printer_in_words() -> str:
    """Return in words what makes a PDF."""
    program = find_browser()
    if program is None:
        return "drawn by matplotlib, as there is no Chromium, Chrome or Edge (SYMGEN_BROWSER names one elsewhere)"
    return f"printed by {program}"


def print_pdf(program: str, page: str, path: Path) -> Path:
    """Print a page to a PDF file, which appears whole or not at all.

    Parameters
    ----------
    program : str
        The browser.
    page : str
        HTML without scripts and other files.
    path : Path
        The file.

    Raises
    ------
    InputError
        If it does not print.
    """
    with tempfile.TemporaryDirectory() as folder:
        source, target = Path(folder, "page.html"), Path(folder, "page.pdf")
        source.write_text(page, encoding="utf-8")
        switches = ("--headless", "--no-sandbox", "--no-first-run", "--disable-extensions", "--no-pdf-header-footer")
        words = [program, *switches, f"--user-data-dir={folder}/profile", f"--print-to-pdf={target}", source.as_uri()]
        try:
            ended = subprocess.run(words, capture_output=True, timeout=PATIENCE, check=False)
        except (OSError, subprocess.TimeoutExpired) as error:
            raise InputError("report", "a browser that prints", f"'{program}': {type(error).__name__}") from error
        if not target.is_file() or not target.stat().st_size:
            raise InputError("report", "a browser that prints", f"'{program}', which ended with {ended.returncode}")
        return write_whole(path, target.read_bytes())
