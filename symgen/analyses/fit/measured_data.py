"""Measured data: columns over time, from files, mappings and results."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.result.saved import Recorded, read_recorded

Array = NDArray[np.float64]


@dataclass(frozen=True)
class MeasuredData:
    """Measured columns over time.

    Attributes
    ----------
    whence : str
        Where they are from, for messages.
    t : Array, shape (k,)
        Times [s], increasing.
    columns : mapping of str to Array
        Measured quantities by name.
    """

    whence: str
    t: Array
    columns: Mapping[str, Array]


def measured_columns(source: object, number: int = 0, where: str = "identify: data") -> MeasuredData:
    """Return measured columns: of a file, of a mapping with ``t``, or of a result.

    Raises
    ------
    InputError
        If they are no columns over increasing times, or hold numbers that are not finite.
    """
    if isinstance(source, str | Path):
        record = read_recorded(where, Path(source))
        whence, t, columns = record.whence, record.t, dict(record.columns)
    elif isinstance(source, Recorded):
        whence, t, columns = source.whence, source.t, dict(source.columns)
    elif isinstance(source, Mapping):
        whence = f"{where} {number + 1}"
        columns = {str(name): np.asarray(values, dtype=np.float64) for name, values in source.items()}
        if "t" not in columns:
            raise InputError(whence, "a column 't' of times", "none")
        t = columns.pop("t")
    else:
        raise InputError(where, "files, or mappings with a column 't'", f"a {type(source).__name__}")
    if len(t) == 0 or not np.all(np.diff(t) > 0.0) or not np.all(np.isfinite(t)):
        raise InputError(whence, "increasing times", "others")
    if t[0] < 0.0:
        raise InputError(whence, "times from the start of the run at 0 s on", f"{t[0]:g} s")
    for name, values in columns.items():
        if values.shape != t.shape:
            raise InputError(whence, f"{len(t)} numbers of {name}", f"an array of shape {values.shape}")
        if not np.all(np.isfinite(values)):
            raise InputError(whence, "finite numbers", f"others in {name}")
    return MeasuredData(whence, t, columns)
