"""Tables of a file that hold numbers alone: points of functions, and defaults of runs."""

from __future__ import annotations

import math

from symgen.base.errors import InputError, quote
from symgen.base.units import read_amount
from symgen.describe.parts.fields import read_table
from symgen.describe.parts.sections import RunSection, TableSection
from symgen.describe.run_defaults import Defaults
from symgen.describe.table_functions import Table


def read_table_function(name: str, raw: object, where: str) -> Table:
    """Return the function that the table `name` defines by points."""
    section = read_table(TableSection, raw, where)
    if len(section.x) < 2:
        raise InputError(f"{where}.x", "two numbers or more", str(len(section.x)))
    if len(section.y) != len(section.x):
        raise InputError(f"{where}.y", f"as many numbers as x has, {len(section.x)}", str(len(section.y)))
    for key in ("x", "y"):
        for value in getattr(section, key):
            if not math.isfinite(value):
                raise InputError(f"{where}.{key}", "finite numbers", str(value))
    for left, right in zip(section.x, section.x[1:], strict=False):
        if not left < right:
            raise InputError(f"{where}.x", "increasing numbers", f"{right!r} after {left!r}")
    how, fewest = section.interpolation, 4 if section.interpolation == "cubic" or section.periodic else 2
    if len(section.x) < fewest:
        expected = f"{fewest} numbers or more for interpolation = '{how}'{', periodic' if section.periodic else ''}"
        raise InputError(f"{where}.x", expected, str(len(section.x)))
    if section.periodic and how == "linear":
        raise InputError(f"{where}.periodic", "true where interpolation is 'cubic' or 'pchip'", "true for 'linear'")
    if section.periodic and section.y[0] != section.y[-1]:
        got = f"{section.y[0]!r} and {section.y[-1]!r}"
        raise InputError(f"{where}.y", "the same value at both ends of a period", got)
    table = Table(name, section.x, section.y, how, section.periodic)
    try:
        finite = all(math.isfinite(c) for piece in table.interpolated.pieces for c in piece)
    except (ArithmeticError, ValueError):
        finite = False
    if not finite:
        raise InputError(where, "points between which curves have finite coefficients", "points too close or far")
    return table


#: Keys of ``[run]`` that are times.
_TIMES = ("until", "step", "output_step", "max_step", "predictable_until")


def read_run_defaults(raw: object, where: str, source: str) -> Defaults:
    """Return the defaults of runs; `source` says where the data of the mechanism come from."""
    run = read_table(RunSection, raw, where)
    times = {key: _duration(getattr(run, key), f"{where}.{key}") for key in _TIMES}
    until, own, output_step, max_step, predictable = times.values()
    assert until is not None, "it has a default"
    usual = Defaults().step
    step = own or (usual if until >= usual else 0.01 * until)
    if step > until:
        raise InputError(f"{where}.step", f"at most until = {until!r}", repr(step))
    return Defaults(until, step, output_step, predictable, max_step, source, own, run.integrator, run.verify)


def _duration(value: float | str | None, where: str) -> float | None:
    """Return a time above 0 [s], of a number of seconds or a text with its unit."""
    if isinstance(value, str):
        amount = read_amount(value)
        if amount is None:
            raise InputError(where, "a number of seconds above 0, or one with its unit", quote(value))
        value = amount.in_si(where, "s")
    if value is not None and not value > 0.0:
        raise InputError(where, "a number above 0", str(value))
    if value is not None and not math.isfinite(value):
        raise InputError(where, "a finite number", str(value))
    return value
