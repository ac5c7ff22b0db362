"""The answer of a design: values, limits with what they reached before and after, and the file with the new numbers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.search.sampled_motions import Limit
from symgen.base import arguments
from symgen.base.files import write_whole

if TYPE_CHECKING:
    from symgen import Model
    from symgen.base.settings import Settings
    from symgen.result.labelled import Labelled
    from symgen.result.result import Result

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class KeptLimit(Limit):
    """A limit before and after.

    Attributes
    ----------
    text : str
        As it is written.
    side : str
        ``largest`` or ``smallest``.
    unit : str
        Unit of the numbers.
    bound, before, after : float
        The limit, and what the quantity reached.
    t : float or None
        When it reached that after [s]; None for a mean.
    size : float
        What parts of the limit are relative to.
    active : bool
        Whether it keeps the aim from being better.
    price : float or None
        By how much the aim would be better for one unit more of room; None where that is not known.
    price_unit : str
        Unit of the price.
    of_file : bool
        Whether it is a limit of the file.
    """

    before: float
    after: float
    t: float | None
    active: bool
    price: float | None
    price_unit: str

    @property
    def is_met(self) -> bool:
        """Whether it holds after, to a millionth of its size."""
        return self.excess(self.after) <= 1e-6


@dataclass(frozen=True)
class SearchFromStart:
    """A search from one start.

    Attributes
    ----------
    whence : str
        ``file`` or ``candidate``.
    before, after : float
        The aim where it began and where it ended.
    is_within : bool
        Whether all limits hold there.
    runs : int
        Motions that it made.
    """

    whence: str
    before: float
    after: float
    is_within: bool
    runs: int


@dataclass(frozen=True, repr=False)
class Design:
    """Numbers of a machine for an aim.

    Attributes
    ----------
    mechanism : str
        Name of the machine.
    aim, unit : str
        The aim, and its unit.
    values, start_values : mapping of str to float
        Numbers that varied, after and before, in SI units.
    units : mapping of str to str
        Their units.
    ranges : mapping of str to (float, float)
        Their bounds.
    before, after : float
        The aim.
    limits : tuple of KeptLimit
        Limits of the file and of the caller.
    starts : tuple of SearchFromStart
        Searches, the one from the file first.
    runs : int
        Motions that were made, those of candidates included.
    failed : mapping of str to int
        Reasons of candidates that do not move, and how many have each.
    notes : tuple of str
        Remarks.
    reason : str or None
        Why there is no answer within limits, or the search was interrupted; None where there is one.
    interrupted : bool
        Whether it was stopped from outside; the values are the best so far.
    text : str
        The file with the new numbers.
    first_model, model : Model
        The machine before and after.
    settings : Settings
        Of its runs.
    until : float
        Last time [s].
    times : Array
        Times of checks [s].
    course : Labelled or None
        The quantity of the aim at these times, before and after; None where the aim is columns over time.
    """

    mechanism: str
    aim: str
    unit: str
    values: Mapping[str, float]
    start_values: Mapping[str, float]
    units: Mapping[str, str]
    ranges: Mapping[str, tuple[float, float]]
    before: float
    after: float
    limits: tuple[KeptLimit, ...]
    starts: tuple[SearchFromStart, ...]
    runs: int
    failed: Mapping[str, int]
    notes: tuple[str, ...]
    reason: str | None
    interrupted: bool
    text: str = field(repr=False)
    first_model: Model = field(repr=False)
    model: Model = field(repr=False)
    settings: Settings = field(repr=False)
    until: float
    times: Array = field(repr=False)
    course: Labelled | None = field(repr=False)

    @property
    def ok(self) -> bool:
        """Whether the values are within all limits and the search was not interrupted."""
        return self.reason is None

    @property
    def status(self) -> str:
        """``ok``, ``failed`` or ``interrupted``."""
        return "ok" if self.ok else "interrupted" if self.interrupted else "failed"

    @cached_property
    def result(self) -> Result:
        """The run after."""
        return self._run(self.model)

    @cached_property
    def first_result(self) -> Result:
        """The run before."""
        return self._run(self.first_model)

    def _run(self, model: Model) -> Result:
        parameters = {} if model is self.model else self.settings.parameters
        return model.simulate(
            replace(self.settings, parameters=parameters, times=self.times.tolist(), until=self.until)
        )

    def save(self, path: str | PathLike[str]) -> Path:
        """Write the file with the new numbers.

        Raises
        ------
        InputError
            If it does not end in ``.toml``, or cannot be written.
        """
        file = arguments.toml_file("save", arguments.path_argument("save", path))
        return write_whole(file, self.text)

    def report(self, path: str | PathLike[str]) -> Path:
        """Write a report of the machine before and after: ``.html``, ``.md``, ``.pdf`` or ``.tex``, its tables."""
        from symgen.study.design.design_report import design_report
        from symgen.study.report.write import write

        file = arguments.path_argument("report", path)
        return write(design_report(self), file)

    def to_json(self) -> dict[str, Any]:
        """Return the contract of ``symgen design --json``; numbers that are not finite become None."""
        from symgen.result.contract import json_value

        own = ("mechanism", "aim", "unit", "values", "units", "before", "after", "runs", "failed", "notes", "reason")
        kept = ("text", "side", "unit", "bound", "before", "after", "t", "active", "price", "price_unit", "of_file")
        facts: dict[str, Any] = json_value(
            {name: getattr(self, name) for name in (*own, "status")}
            | {"start": self.start_values, "bounds": self.ranges, "starts": [vars(each) for each in self.starts]}
            | {"limits": [{name: getattr(x, name) for name in kept} | {"met": x.is_met} for x in self.limits]}
        )
        return facts

    def __repr__(self) -> str:
        text = f"{self.aim} {self.before:.6g} -> {self.after:.6g} {self.unit}".rstrip()
        return f"<Design of {self.mechanism}: {text}{'' if self.ok else f' ({self.status})'}>"
