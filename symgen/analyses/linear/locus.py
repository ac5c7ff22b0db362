"""Root loci: how eigenvalues move with a parameter, and where the motion stops being stable."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from itertools import pairwise
from os import PathLike
from pathlib import Path
from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.linear.named_places import Array, NamedPlace, check_range, modes_at
from symgen.analyses.state.algebra import json_form
from symgen.base.errors import InputError, SymgenError, plural
from symgen.base.units import SI, Unit
from symgen.describe.formulas.evaluate import parameter_values
from symgen.result.plot import Plot, draw_or_save
from symgen.result.plots import COLOURS, axis_label

Complex = NDArray[np.complex128]

#: Real parts below this fraction of the largest eigenvalue count as zero: they are where nothing decays or grows.
LEVEL = 1e-9
#: Spans in which branches pass both ways are parted here, not in the middle, where a crossing may well be, so often.
PARTED, HALVINGS = 0.3819660112501051, 40
#: A span is looked into, so often, where real parts may bend by as much as this part of what they are at its ends.
BENT, LOOKS = 0.25, 12
#: Distance from a crossing, as a part of its span, that separates passing eigenvalues from those that stay on the axis.
BESIDE = 1e-5


@dataclass(frozen=True)
class Crossing:
    """A value of the parameter at which an eigenvalue passes from one half of the plane into the other.

    Attributes
    ----------
    value : float
        Of the parameter.
    eigenvalue : complex
        There [1/s].
    rising : bool
        Whether its real part becomes positive.
    """

    value: float
    eigenvalue: complex
    rising: bool


@dataclass(frozen=True)
class Locus:
    """Eigenvalues over a parameter.

    Attributes
    ----------
    name : str
        The parameter.
    values : Array, shape (k,)
        Its values.
    branches : Array of complex, shape (k, n)
        Eigenvalues [1/s]; a column is followed from value to value.
    crossings : tuple of Crossing
        Where branches pass the imaginary axis, in increasing order of the parameter.
    own_unit : Unit
        Unit of the file, which tables and plots have.
    """

    name: str
    values: Array
    branches: Complex
    crossings: tuple[Crossing, ...]
    own_unit: Unit = field(default=SI, repr=False)

    def as_written(self, value: float) -> float:
        """Return a value of the parameter in the unit of the file."""
        return self.own_unit.from_si(float(value))

    def to_dict(self) -> dict[str, Any]:
        """Return the fields in types of JSON."""
        return dict(json_form(self))

    def __repr__(self) -> str:
        first, last = self.values[[0, -1]]
        count = self.branches.shape[1]
        counts = plural(count, "eigenvalue"), plural(len(self.crossings), "crossing")
        return f"<Locus: {counts[0]} over {self.name} = {first:g} to {last:g}, {counts[1]}>"

    def _repr_html_(self) -> str:
        from symgen.analyses.kinds import notebook_html

        return notebook_html("modes", self)

    @overload
    def plot(self, path: None = None) -> Plot: ...

    @overload
    def plot(self, path: str | PathLike[str]) -> Path: ...

    def plot(self, path: str | PathLike[str] | None = None) -> Plot | Path:
        """Draw real and imaginary parts over the parameter, and the plane of eigenvalues: a figure, or a file.

        Parameters
        ----------
        path : path, optional
            A ``.png``, ``.svg``, ``.pdf`` or ``.pgf`` file. Without one the figure comes back, which notebooks show.

        Raises
        ------
        InputError
            If the suffix is not supported, matplotlib is missing, or the file cannot be written.
        """
        return draw_or_save(path, self._figure)

    def _figure(self) -> Any:
        from matplotlib.figure import Figure

        figure = Figure(figsize=(10.0, 4.5), layout="constrained")
        over, plane = figure.subplots(1, 2)
        values = [*map(self.as_written, self.values)]
        for k, branch in enumerate(self.branches.T):
            colour = COLOURS[k % len(COLOURS)]
            over.plot(values, branch.real, color=colour)
            over.plot(values, np.abs(branch.imag), color=colour, linestyle=":")
            plane.plot(branch.real, branch.imag, color=colour, marker=".", markersize=3, linestyle="none")
        for crossing in self.crossings:
            over.axvline(self.as_written(crossing.value), color="#999999", linewidth=0.8)
        over.axhline(0.0, color="#999999", linewidth=0.8)
        plane.axvline(0.0, color="#999999", linewidth=0.8)
        over.set_xlabel(axis_label(self.name, self.own_unit.text))
        over.set_ylabel("real part, and imaginary part dotted [1/s]")
        plane.set_xlabel("real part [1/s]")
        plane.set_ylabel("imaginary part [1/s]")
        return figure


def eigenvalue_locus(place: NamedPlace, over: tuple[str, Sequence[float] | Array], states: Sequence[str] = ()) -> Locus:
    """Follow eigenvalues over a parameter; see `symgen.api.Model.locus`.

    Raises
    ------
    InputError
        If the range is none, what varies is set twice, or the number of eigenvalues changes.
    """
    name, values = check_range("over", over)
    if len(values) < 2 or np.any(np.diff(values) <= 0.0):
        raise InputError(f"over {name}", "two values or more in increasing order", f"{len(values)}")
    settings = place.settings
    if name in settings.inputs or name in settings.parameters:
        raise InputError(f"over {name}", "one way of giving it a value", "two")
    parameter_values(place.mechanism, {name: float(values[0])})

    @cache
    def eigenvalues_at(value: float) -> Complex:
        changed = replace(settings, parameters={**settings.parameters, name: value})
        return modes_at(replace(place, settings=changed), states).eigenvalues

    count = len(eigenvalues_at(float(values[0])))
    for value in values[1:]:
        if (now := len(eigenvalues_at(float(value)))) != count:
            expected = f"{count} eigenvalues at all values, as at {values[0]:g}; give states"
            raise InputError(f"over {name}", expected, f"{now} at {value:g}")
    largest = max(float(np.abs(eigenvalues_at(float(value))).max(initial=1e-300)) for value in values)
    search = _Search(eigenvalues_at, LEVEL * largest)
    every = np.array(search.add_bends(values.tolist()))
    rows = list[Complex]()
    for k, value in enumerate(every):
        further = (value - every[k - 1]) / (every[k - 1] - every[k - 2]) if k > 1 else 0.0
        rows.append(_follow_branches(rows, eigenvalues_at(float(value)), further))
    branches = np.array(rows)
    own = next(p.own_unit for p in place.mechanism.parameters if p.name == name)
    return Locus(name, values, branches[np.isin(every, values)], search.find_crossings(every, branches), own)


def _follow_branches(before: Sequence[Complex], now: Complex, further: float = 0.0) -> Complex:
    """Return eigenvalues in the order of the ones before, which are gone on from in straight lines.

    `further` is the ratio of this step to the last one.
    """
    from scipy.optimize import linear_sum_assignment

    if not before:
        return now
    expected = before[-1] if len(before) < 2 else before[-1] + further * (before[-1] - before[-2])
    far = np.abs(expected[:, None] - now[None, :]) + np.abs(before[-1][:, None] - now[None, :])
    return np.asarray(now[linear_sum_assignment(far)[1]])


@dataclass(frozen=True)
class _Search:
    """The search for values at which eigenvalues pass the imaginary axis.

    Sorted by real part, eigenvalues are continuous in the parameter even where they cross: where more of them are on
    the right at one end of a span than at the other, one passes zero between. Shorter spans separate branches that
    pass both ways within a span.
    """

    eigenvalues: Callable[[float], Complex]
    level: float

    def signs_of_real_parts(self, x: Complex) -> NDArray[np.float64]:
        """Return signs of real parts, 0 of those that are nothing."""
        return np.where(np.abs(x.real) > self.level, np.sign(x.real), 0.0)

    def has_crossing_between(self, a: Complex, b: Complex) -> bool:
        """Whether one side has more at one of two values than at the other while as many are on the axis."""
        left, right = self.signs_of_real_parts(a), self.signs_of_real_parts(b)
        same = np.count_nonzero(left) == np.count_nonzero(right)
        return bool(same and np.count_nonzero(left > 0.0) != np.count_nonzero(right > 0.0))

    def order_eigenvalues(self, value: float, leave: int) -> Complex:
        """Return eigenvalues by decreasing real part without those nearest to the axis, which stay on it."""
        now = self.eigenvalues(value)
        moving = now[np.argsort(np.abs(now.real), kind="stable")[leave:]]
        return moving[np.argsort(-moving.real, kind="stable")]

    def count_on_axis(self, *values: float) -> int:
        """Return the number of eigenvalues on the axis at all of some values."""
        return int(min(np.count_nonzero(self.signs_of_real_parts(self.eigenvalues(value)) == 0.0) for value in values))

    def add_bends(self, values: Sequence[float]) -> list[float]:
        """Return values with those between them where a real part may have passed zero and come back.

        Where a real part is on the same side at both ends of a span, it has been on the other one only if it bends
        there, by more than what is left of it: as the values beside the span show, and those in it.
        """
        every = [values[0]]
        for k, (a, b) in enumerate(pairwise(values)):
            beside = [values[i - 1 : i + 2] for i in (k, k + 1) if 0 < i < len(values) - 1]
            bends = [self.bend_of_real_parts(*three) for three in beside]
            bend: Array = np.max(bends, axis=0) if bends else np.array(math.inf)
            every += [*self.values_inside(a, b, bend, LOOKS), b]
        return every

    def values_inside(self, a: float, b: float, bend: Array, looks: int) -> list[float]:
        """Return the values between two at which to evaluate real parts, given how far these may bend."""
        first, last = (self.order_eigenvalues(value, self.count_on_axis(a, b)).real for value in (a, b))
        bend = bend if bend.ndim == 0 or len(bend) == len(first) else np.asarray(bend.max(initial=0.0))
        left = np.minimum(np.abs(first), np.abs(last))
        if not looks or not np.any((first * last > 0.0) & (left > self.level) & (bend > BENT * left)):
            return []
        middle = a + PARTED * (b - a)
        try:
            if not a < middle < b or len(self.eigenvalues(middle)) != len(self.eigenvalues(a)):
                return []
        except SymgenError:  # no such motion exists between
            return []
        now = self.bend_of_real_parts(a, middle, b)
        return [*self.values_inside(a, middle, now, looks - 1), middle, *self.values_inside(middle, b, now, looks - 1)]

    def bend_of_real_parts(self, a: float, b: float, c: float) -> Array:
        """Return by how much real parts at the middle one of three values are beside the line between the others."""
        first, middle, last = (self.order_eigenvalues(value, self.count_on_axis(a, b, c)).real for value in (a, b, c))
        return np.asarray(np.abs(middle - first - (last - first) * ((b - a) / (c - a))))

    def find_crossings(self, values: Array, branches: Complex) -> tuple[Crossing, ...]:
        """Return where branches pass the imaginary axis, each pair of conjugates once."""
        spans = [(k, k + 1) for k in range(len(values) - 1) if self.has_crossing_between(branches[k], branches[k + 1])]
        for branch in branches.T:
            # a value at which nothing decays or grows may be the one that is passed
            sided = np.flatnonzero(self.signs_of_real_parts(branch))
            spans += [(int(k), int(n)) for k, n in pairwise(sided) if branch[k].real * branch[n].real < 0.0]
        apart = list[tuple[int, int]]()
        for k, n in sorted(spans):
            if apart and k < apart[-1][1]:
                apart[-1] = apart[-1][0], max(n, apart[-1][1])
            else:
                apart.append((k, n))
        crossings = [c for k, n in apart for c in self.crossings_within(float(values[k]), float(values[n]))]
        return tuple(sorted(crossings, key=lambda c: c.value))

    def crossings_within(self, a: float, b: float, halvings: int = HALVINGS) -> list[Crossing]:
        """Return the crossings between two values that branches followed between them show."""
        before = self.eigenvalues(a)
        after = _follow_branches([before], self.eigenvalues(b))
        left, right = self.signs_of_real_parts(before), self.signs_of_real_parts(after)
        passing = left * right < 0.0
        if not (passing.any() or self.has_crossing_between(before, after)):
            return []
        leave = self.count_on_axis(a, b)
        signs = (np.sign(self.order_eigenvalues(value, leave).real) for value in (a, b))
        places = np.flatnonzero(np.multiply(*signs) < 0.0)
        crossings = [c for i in places if (c := self.find_passage(a, b, int(i), leave))]
        # one of a pair of conjugates does not pass alone: then another eigenvalue passes the other way
        balance = sum((1 if c.rising else -1) * (2 if c.eigenvalue.imag > self.level else 1) for c in crossings)
        if halvings and (
            len(set(right[passing])) > 1 or balance != np.count_nonzero(right > 0.0) - np.count_nonzero(left > 0.0)
        ):
            middle = a + PARTED * (b - a)
            return self.crossings_within(a, middle, halvings - 1) + self.crossings_within(middle, b, halvings - 1)
        return crossings

    def find_passage(self, a: float, b: float, i: int, leave: int) -> Crossing | None:
        """Return where an eigenvalue of a place in the order passes, None of the other one of a pair of conjugates."""
        from scipy.optimize import brentq

        def real_part(value: float) -> float:
            return float(self.order_eigenvalues(value, leave)[i].real)

        at = float(brentq(real_part, a, b, xtol=1e-13, rtol=1e-14))
        beside = self.order_eigenvalues(at + BESIDE * ((b if at < 0.5 * (a + b) else a) - at), leave)[i]
        now = self.eigenvalues(at)
        passed = complex(now[np.abs(now - beside).argmin()])
        if passed.imag < -self.level or not abs(passed.real) <= 1e-6 * self.level / LEVEL:
            return None
        return Crossing(at, passed, real_part(b) > 0.0)
