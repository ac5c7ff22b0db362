"""Interpolated tables as functions that expressions may call."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from symgen.ir.interpolation import Interpolation
from symgen.ir.program import of_table
from symgen.vocabulary.expressions import SMOOTH


def python_name(payload: object) -> str:
    """Return the name of a table, or of a derivative of it, in expressions."""
    name, what = of_table(payload)
    return f"{what.replace('value', 'table')}_{name}"


def functions(tables: Iterable[Interpolation]) -> dict[str, Any]:
    """Return the interpolated functions and their derivatives by the names that expressions call them by."""
    by_name: dict[str, Any] = {}
    for table in tables:
        for order in range(3):
            payload = f"{SMOOTH if table.pieces else ''}{table.name}" + "'" * order
            value = np.vectorize(lambda x, table=table, order=order: table.value(float(x), order), otypes=[float])
            by_name[python_name(payload)] = value
    return by_name
