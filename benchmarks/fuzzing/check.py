"""One file under `symgen check`, in this process: what it says, what it costs, what it leaves behind."""

from __future__ import annotations

import contextlib
import io
import os
import re
import shutil
import tempfile
import time
import traceback
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

#: Limits of one file: processor time for reading it, and for deriving and assembling what is valid [s], and memory of
#: a process that checks it alone [bytes]: what valid files leave loaded, code and modules of some 0.3 MB each, is
#: no other file's.
SECONDS, ASSEMBLY = 2.0, 10.0
MEMORY = 300_000_000
#: A sentence is at most this long.
LONGEST = 1000
#: Characters that have no place in what is printed.
_CONTROL = re.compile("[\x00-\x09\x0b-\x1f\x7f-\x9f\u2028\u2029\u202a-\u202e]")


@dataclass(frozen=True)
class File:
    """A file to be checked.

    Attributes
    ----------
    number : int
        Which one of its seed.
    text : str
        Its text.
    whole : bool
        Whether a valid one is assembled too, by ``symgen check``, or only read.
    """

    number: int
    text: str
    whole: bool


_folder: Path | None = None
_checks = 0
#: What a process has before its first file [bytes].
_begun = 0


def _home() -> Path:
    """Return this process's own folder, with a cache and an empty home in it."""
    global _folder, _begun
    if _folder is None:
        _folder = Path(tempfile.mkdtemp(prefix="symgen-fuzz-"))
        for name in ("cache", "home", "work"):
            (_folder / name).mkdir()
        os.environ |= {"SYMGEN_CACHE_DIR": str(_folder / "cache"), "HOME": str(_folder / "home"), "COLUMNS": "200"}
        os.chdir(_folder / "work")
        _warmed()
        _begun = _resident()
    return _folder


def _warmed() -> None:
    """Import what a check imports, so that no file pays for it."""
    import symgen.api
    import symgen.derive.formulate.formulate
    import symgen.describe.joints
    import symgen.run.starts.assembly  # noqa: F401  # loaded beforehand: its time is not that of a file

    Path("file.toml").write_text('[mechanism]\nname = "a"\n[bodies.b]\ntype = "point"\nmass = 1\n', encoding="utf-8")
    _answer(["check", "file.toml"])


def _answer(words: list[str]) -> tuple[Any, str, str, str]:
    """Return exit code, standard output, standard error and the traceback of a command."""
    from symgen.cli import main

    out, err = io.StringIO(), io.StringIO()
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code: Any = main(words)
    except BaseException:
        return None, out.getvalue(), err.getvalue(), traceback.format_exc()
    return code, out.getvalue(), err.getvalue(), ""


def _read(path: str) -> tuple[Any, str, str, str]:
    """Return the same for reading the file alone."""
    from symgen.base.errors import SymgenError
    from symgen.describe.files.load import load_mechanism

    try:
        load_mechanism(path)
    except SymgenError as error:
        return error.exit_code, "", f"symgen: {error}\n", ""
    except BaseException:
        return None, "", "", traceback.format_exc()
    return 0, "", "", ""


def check(file: File) -> dict[str, Any]:
    """Return what is to be said of a file: whether it is valid, and what is wrong with how it was taken."""
    global _checks
    home = _home()
    path = Path("file.toml")
    path.write_bytes(file.text.encode("utf-8", errors="surrogatepass"))
    before = _resident()
    began, limit = time.process_time(), SECONDS
    code, out, err, raised = _read("file.toml")
    if code == 0 and file.whole:
        limit = ASSEMBLY
        code, out, err, raised = _answer(["check", "file.toml"])
    seconds = time.process_time() - began
    wrong = _wrong(code, out, err, raised)
    if seconds > limit:
        wrong.append(f"took {seconds:.1f} s of the processor")
    used = _begun + _most() - before
    if used > MEMORY:
        wrong.append(f"took {used / 1e6:.0f} MB")
    wrong += _left(home)
    _checks += 1
    if _checks % 200 == 0:
        shutil.rmtree(home / "cache", ignore_errors=True)
        (home / "cache").mkdir(exist_ok=True)
    return {**asdict(file), "code": code, "seconds": seconds, "wrong": wrong, "text": file.text if wrong else ""}


def _status(name: str) -> int:
    """Return a number of this process's memory [bytes]."""
    text = Path("/proc/self/status").read_text(encoding="ascii", errors="replace")
    return int(text.partition(f"{name}:")[2].split()[0]) * 1024


def _resident() -> int:
    """Return how much memory this process has, and begin to look for the most from here on [bytes]."""
    Path("/proc/self/clear_refs").write_text("5", encoding="ascii")
    return _status("VmRSS")


def _most() -> int:
    """Return the most memory this process has had since `_resident` was asked [bytes]."""
    return _status("VmHWM")


def _wrong(code: Any, out: str, err: str, raised: str) -> list[str]:
    if raised:
        return [f"raised {raised.strip().splitlines()[-1][:300]}"]
    faults = []
    if code not in (0, 2):
        faults.append(f"exit code {code}")
    if code == 2 and not (err.startswith("symgen: ") and err.count("\n") == 1 and not out):
        faults.append(f"not one sentence: {err[:300]!r}")
    if len(err) > LONGEST:
        faults.append(f"a sentence of {len(err)} characters")
    for name, text in (("output", out), ("sentence", err)):
        if _CONTROL.search(text):
            faults.append(f"control characters in the {name}: {text[:300]!r}")
    return faults


def _left(home: Path) -> list[str]:
    """Return what a file made beside itself, and remove it."""
    faults = []
    for folder, own in ((home / "work", {"file.toml"}), (home / "home", set())):
        for path in folder.iterdir():
            if path.name not in own:
                faults.append(f"left {path.name[:80]!r} behind")
                shutil.rmtree(path, ignore_errors=True) if path.is_dir() else path.unlink()
    return faults
