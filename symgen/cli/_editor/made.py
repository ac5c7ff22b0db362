"""What commands make of a draft, for the page to download: report, page, FMU, Python."""

from __future__ import annotations

import base64
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from symgen.api import Model
from symgen.base.errors import InputError, quote
from symgen.describe.files.script import script_of_mechanism
from symgen.describe.mechanism import Mechanism
from symgen.study.report.machine_report import machine_report
from symgen.study.report.write import write

#: Kind -> ending of the file and its type.
KINDS = {
    "report": (".html", "text/html"),
    "page": (".html", "text/html"),
    "fmu": (".fmu", "application/zip"),
    "python": (".py", "text/x-python"),
}


def make_file_for_browser(kind: str, raw: Mapping[str, Any], mechanism: Mechanism, file: Path) -> dict[str, Any]:
    """Return a file for the browser: its name, type and content in base 64.

    Parameters
    ----------
    kind : str
        One of `KINDS`.
    raw : mapping
        Tables of the draft.
    mechanism : Mechanism
        The same, validated.
    file : Path
        The file that is edited, which is named in what is made.

    Raises
    ------
    InputError
        If the kind is unknown, or the command would refuse the mechanism.
    """
    if kind not in KINDS:
        raise InputError("make", f"one of {', '.join(KINDS)}", quote(kind))
    ending, type_ = KINDS[kind]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"{file.stem}{ending}"
        if kind == "python":
            path.write_text(script_of_mechanism(raw), encoding="utf-8")
        else:
            _WRITERS[kind](Model(mechanism), path, file.name)
        content = base64.b64encode(path.read_bytes()).decode()
        return {
            "name": f"{file.stem}{'-report' if kind == 'report' else ''}{ending}",
            "type": type_,
            "content": content,
        }


def _make_report(model: Model, path: Path, name: str) -> None:
    result = model.simulate()
    write(machine_report(model, result, f"symgen report {name}", "t"), path)


def _make_page(model: Model, path: Path, _: str) -> None:
    model.simulate().view().save(path)


def _make_fmu(model: Model, path: Path, _: str) -> None:
    model.generate(path, target="fmu")


_WRITERS: dict[str, Callable[[Model, Path, str], None]] = {"report": _make_report, "page": _make_page, "fmu": _make_fmu}
