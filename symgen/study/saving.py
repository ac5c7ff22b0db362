"""Files of studies: rows as CSV, or the report."""

from __future__ import annotations

from collections.abc import Callable
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from symgen.base.arguments import path_argument as argument_path
from symgen.base.errors import InputError

if TYPE_CHECKING:
    from symgen.study.report.write import Reported


def save_study(study: Reported, path: str | PathLike[str], save_rows: Callable[[Path], Path]) -> Path:
    """Write a study to a file, by its ending.

    Parameters
    ----------
    study : Study or Stress
        The study.
    path : path
        The file; it appears whole or not at all.
    save_rows : callable
        Writes the rows to a CSV file.

    Raises
    ------
    InputError
        If the ending is another, matplotlib is missing for a report, or the file cannot be written.
    """
    file = argument_path("save", path)
    if file.suffix.lower() == ".csv":
        return save_rows(file)
    from symgen.study.report.write import WRITTEN, write_report

    if file.suffix.lower() in WRITTEN:
        return write_report(study, file)
    raise InputError("save", f"a file ending in {', '.join(('.csv', *WRITTEN))}", f"'{file}'")
