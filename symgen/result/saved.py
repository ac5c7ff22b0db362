"""Files that results were saved to, read by whoever wants something of them."""

from __future__ import annotations

import csv
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from symgen.errors import InputError
from symgen.files import check_name
from symgen.result.export import SAVED, need

_Found = TypeVar("_Found")


def read_saved(
    option: str, path: Path, of_dataset: Callable[[str, Path], _Found], of_columns: Callable[[str, Path], _Found]
) -> _Found:
    """Return what is read from a file of a result.

    Parameters
    ----------
    option : str
        Who asks, for messages.
    path : Path
        A ``.nc``, ``.parquet`` or ``.csv`` file.
    of_dataset, of_columns : callable
        Read a NetCDF file, and one of columns.

    Raises
    ------
    InputError
        If there is no such file, or it is none of a result.
    """
    ending = path.suffix.lower()
    if ending not in SAVED:
        raise InputError(option, f"a file ending in {', '.join(SAVED)}", f"'{path}'")
    need(option, *SAVED[ending])
    check_name(option, path)
    if not path.is_file():
        raise InputError(option, "a file of a result", f"'{path}', which is none")
    try:
        return (of_dataset if ending == ".nc" else of_columns)(option, path)
    except InputError:
        raise
    except (OSError, ValueError, KeyError, IndexError, TypeError, StopIteration, csv.Error) as error:
        why = " ".join(str(error).split())[:80] or "it has no rows"
        raise InputError(option, "a file of a result", f"'{path}', which cannot be read as one ({why})") from None
