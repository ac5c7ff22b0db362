"""Root loci: how eigenvalues move with a parameter, and where the motion stops being stable."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symgen import arguments
from symgen.analyses.asked import Array, Asked, asked_modes, range_of
from symgen.describe.evaluate import parameter_values
from symgen.errors import InputError
from symgen.files import write_whole
from symgen.result.export import PLOTTED, check_path
from symgen.result.plots import COLOURS

Complex = NDArray[np.complex128]

#: Real parts below this fraction of the largest eigenvalue count as zero: they are where nothing decays or grows.
LEVEL = 1e-9


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
    """

    name: str
    values: Array
    branches: Complex
    crossings: tuple[Crossing, ...]

    def to_dict(self) -> dict[str, Any]:
        """Return what JSON can express."""
        return {
            "name": self.name,
            "values": self.values.tolist(),
            "branches": [[[float(x.real), float(x.imag)] for x in row] for row in self.branches],
            "crossings": [
                {"value": c.value, "eigenvalue": [c.eigenvalue.real, c.eigenvalue.imag], "rising": c.rising}
                for c in self.crossings
            ],
        }

    def plot(self, path: str | Path) -> Path:
        """Draw real and imaginary parts over the parameter, and the plane of eigenvalues, into a file.

        Parameters
        ----------
        path : str or Path
            A ``.png``, ``.svg`` or ``.pdf`` file.

        Raises
        ------
        InputError
            If the ending is not known, matplotlib is missing, or the file cannot be written.
        """
        path = arguments.path("plot", path)
        check_path("plot", path, PLOTTED, "plot")
        figure = self._drawn()
        kind = path.suffix.lower().removeprefix(".")
        metadata = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}.get(kind, {})
        return write_whole(path, lambda file: figure.savefig(file, format=kind, dpi=150, metadata=metadata))

    def _drawn(self) -> Any:
        from matplotlib.figure import Figure

        figure = Figure(figsize=(10.0, 4.5), layout="constrained")
        over, plane = figure.subplots(1, 2)
        for k, branch in enumerate(self.branches.T):
            colour = COLOURS[k % len(COLOURS)]
            over.plot(self.values, branch.real, color=colour)
            over.plot(self.values, np.abs(branch.imag), color=colour, linestyle=":")
            plane.plot(branch.real, branch.imag, color=colour, marker=".", markersize=3, linestyle="none")
        for crossing in self.crossings:
            over.axvline(crossing.value, color="#999999", linewidth=0.8)
        over.axhline(0.0, color="#999999", linewidth=0.8)
        plane.axvline(0.0, color="#999999", linewidth=0.8)
        over.set_xlabel(self.name)
        over.set_ylabel("real part, and imaginary part dotted [1/s]")
        plane.set_xlabel("real part [1/s]")
        plane.set_ylabel("imaginary part [1/s]")
        return figure


def locus(asked: Asked, over: tuple[str, Sequence[float] | Array], states: Sequence[str] = ()) -> Locus:
    """Return how the eigenvalues move with a parameter; see `symgen.api.Model.locus`.

    Raises
    ------
    InputError
        If the range is none, what varies is said twice, or the number of eigenvalues changes.
    """
    name, values = range_of("over", over)
    if len(values) < 2 or np.any(np.diff(values) <= 0.0):
        raise InputError(f"over {name}", "two values or more in increasing order", f"{len(values)}")
    settings = asked.settings
    if name in settings.inputs or name in settings.parameters:
        raise InputError(f"over {name}", "one way of giving it a value", "two")
    parameter_values(asked.mechanism, {name: float(values[0])})

    def eigenvalues(value: float) -> Complex:
        changed = replace(settings, parameters={**settings.parameters, name: value})
        return asked_modes(replace(asked, settings=changed), states).eigenvalues

    found = [eigenvalues(float(values[0]))]
    for value in values[1:]:
        now = eigenvalues(float(value))
        if len(now) != len(found[0]):
            expected = f"{len(found[0])} eigenvalues at all values, as at {values[0]:g}; give states"
            raise InputError(f"over {name}", expected, f"{len(now)} at {value:g}")
        found.append(_followed(found, now))
    branches = np.array(found)
    return Locus(name, values, branches, _crossings(values, branches, eigenvalues))


def _followed(before: Sequence[Complex], now: Complex) -> Complex:
    """Return eigenvalues in the order of the ones before, which are gone on from in straight lines."""
    from scipy.optimize import linear_sum_assignment

    expected = before[-1] if len(before) < 2 else 2.0 * before[-1] - before[-2]
    far = np.abs(expected[:, None] - now[None, :]) + np.abs(before[-1][:, None] - now[None, :])
    return np.asarray(now[linear_sum_assignment(far)[1]])


def _crossings(values: Array, branches: Complex, eigenvalues: Callable[[float], Complex]) -> tuple[Crossing, ...]:
    from scipy.optimize import brentq

    level = LEVEL * np.abs(branches).max(initial=1e-300)
    found = list[Crossing]()
    for branch in branches.T:
        # a value at which nothing decays or grows may be the one that is passed
        sided = np.flatnonzero(np.abs(branch.real) > level)
        for k, following in pairwise(sided):
            a, b = branch[k], branch[following]
            if a.real * b.real > 0.0 or a.imag < 0.0:
                continue

            def nearest(value: float, branch: Complex = branch) -> complex:
                now = eigenvalues(value)
                return complex(now[np.abs(now - np.interp(value, values, branch)).argmin()])

            try:
                at = float(brentq(lambda x: nearest(x).real, values[k], values[following], xtol=1e-13, rtol=1e-14))
            except ValueError:
                continue  # branches meet between and were told apart wrongly
            if abs(nearest(at).real) <= 1e-6 * abs(branches).max():
                found.append(Crossing(at, nearest(at), bool(b.real > 0.0)))
    return tuple(sorted(found, key=lambda c: c.value))
