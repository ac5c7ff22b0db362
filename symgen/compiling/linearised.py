"""The descriptor form with its exact derivatives, compiled on demand beside a model's modules.

The function is evaluated a few times an analysis, so it is plain Python; SymPy and Jinja2 are imported only where the
cache has no entry.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symgen.compiling.pipeline import folder_of
from symgen.compiling.side import beside, stem_of
from symgen.describe.derived import derived
from symgen.describe.mechanism import Mechanism
from symgen.describe.printer import to_text
from symgen.errors import finite_numbers
from symgen.lower.windings import Beside
from symgen.runtime.abi import OBSERVE
from symgen.runtime.compiled import CompiledModel
from symgen.runtime.probe import Few
from symgen.store.entries import Entries
from symgen.store.modules import load_module

Array = NDArray[np.float64]

#: Name of the emitted function, and what its module is called after.
NAME = "linearised"
#: What values are differentiated by: time, q, v, v', multipliers and parameters.
SPACES = ("t", "q", "v", "a", "lam", "p")


@dataclass(frozen=True)
class Evaluated:
    """All values and derivatives of a descriptor form at one state, by group."""

    form: DescriptorForm
    out: Array

    def value(self, group: str) -> Array:
        """Return the values of a group."""
        first, size = self.form.places[group]
        return self.out[first : first + size]

    def by(self, group: str, space: str) -> Array:
        """Return the derivatives of a group by ``t``, ``q``, ``v``, ``a``, ``lam`` or ``p``, shape (values, size)."""
        first, size = self.form.places[group]
        found = np.zeros((size, self.form.widths[space]))
        entries, rows, columns = self.form.entries(group, space)
        found[rows - first, columns] = self.out[self.form.values + entries]
        return found


@dataclass(frozen=True)
class DescriptorForm:
    """The function and where its numbers belong.

    Attributes
    ----------
    function : compiled function
        ``(t, y, p, w, ydot, out)``.
    places : mapping of str to (int, int)
        Group -> first value and how many; groups of `symgen.lower.linearised`, and ``functions``.
    widths : mapping of str to int
        Numbers of each space.
    functions : mapping of str to (int, int)
        Quantity of the state -> its place in ``functions``, and how many of value, rate and second rate are known.
    units : mapping of str to str
        Their units.
    elements : tuple of (str, int)
        Force and velocity of each value of the group ``elements``.
    pattern : Array of int64, shape (n, 3)
        Value, space, by its place in `SPACES`, and index of each derivative.
    """

    function: Any
    places: Mapping[str, tuple[int, int]]
    widths: Mapping[str, int]
    functions: Mapping[str, tuple[int, int]]
    units: Mapping[str, str]
    elements: tuple[tuple[str, int], ...]
    pattern: NDArray[np.int64]

    @property
    def values(self) -> int:
        """How many values stand before the derivatives."""
        return sum(size for _, size in self.places.values())

    @cached_property
    def _split(self) -> dict[tuple[str, str], tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]]:
        found = {}
        for group, (first, size) in self.places.items():
            inside = (self.pattern[:, 0] >= first) & (self.pattern[:, 0] < first + size)
            for k, space in enumerate(SPACES):
                entries = np.flatnonzero(inside & (self.pattern[:, 1] == k))
                found[group, space] = entries, self.pattern[entries, 0], self.pattern[entries, 2]
        return found

    def entries(self, group: str, space: str) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
        """Return number, value and index of each derivative of a group by a space."""
        return self._split[group, space]

    @cached_property
    def _few(self) -> Few:
        return Few(self.function, OBSERVE)

    def at(self, t: float, y: Array, a: Array, p: Array, w: Array) -> Evaluated:
        """Evaluate at a state.

        Parameters
        ----------
        t : float
            Time [s].
        y : Array
            q and v, and whatever stands behind.
        a : Array, shape (nv,)
            v'.
        p, w : Array
            Parameters, and scratch with the multipliers in their section.
        """
        out = np.zeros(self.values + len(self.pattern))
        rates = np.concatenate([np.zeros(self.widths["q"]), a])
        self._few(t, y, p, w, rates, out)
        return Evaluated(self, out)


def compile_linearised(mechanism: Mechanism, compiled: CompiledModel, by: tuple[str, ...] = ()) -> DescriptorForm:
    """Return the descriptor form of a mechanism with its derivatives, generated only if the cache does not have it.

    Parameters
    ----------
    mechanism : Mechanism
        What is analysed, with its tree where the state is that of joints.
    compiled : CompiledModel
        The model that it is evaluated beside: its ``p`` and ``w``.
    by : tuple of str
        Parameters that it is differentiated by.

    Raises
    ------
    InputError
        If numbers that meet in a formula overflow.
    """
    found = _compiled(mechanism, compiled, by, ())
    assert found is not None, "the whole form is wanted"
    return found


#: Groups that say how a motion near a state grows or decays.
GROWTH = ("motion", "balance", "accelerations")


def compile_growth(mechanism: Mechanism, compiled: CompiledModel) -> DescriptorForm | None:
    """Return the groups `GROWTH` with derivatives by state, v' and multipliers; None where nothing can decay.

    Raises
    ------
    InputError
        If numbers that meet in a formula overflow.
    """
    return _compiled(mechanism, compiled, (), GROWTH)


def _compiled(
    mechanism: Mechanism, compiled: CompiledModel, by: tuple[str, ...], groups: tuple[str, ...]
) -> DescriptorForm | None:
    store, info, around, folder = Entries(), compiled.info, beside(mechanism, compiled), folder_of(mechanism)
    # outputs stand outside the digest that folders are named by
    reported = () if groups else [(o.name, o.unit, to_text(o.value)) for o in mechanism.outputs]
    stem = stem_of(NAME, around, by, derived(mechanism.parameters) if by else "", groups, reported)
    known = store.made(folder, stem, lambda: _built(mechanism, by, groups, around))
    if known["still"]:
        return None
    places, first = dict[str, tuple[int, int]](), 0
    functions, units, at = dict[str, tuple[int, int]](), dict[str, str](), 0
    for name, unit, orders in known["functions"]:
        functions[name], units[name] = (at, orders), unit
        at += orders
    for group, size in (*known["sizes"], ("functions", at)):
        places[group] = first, size
        first += size
    widths = {"t": 1, "q": info.nq, "v": info.nv, "a": info.nv, "lam": info.m, "p": len(info.parameters)}
    pattern = np.array([(i, SPACES.index(space), k) for i, space, k in known["pattern"]], dtype=np.int64).reshape(-1, 3)
    function = getattr(load_module(store.path(folder, stem)), NAME)
    elements = tuple((str(name), int(i)) for name, i in known["elements"])
    return DescriptorForm(function, places, widths, functions, units, elements, pattern)


def _built(
    mechanism: Mechanism, by: tuple[str, ...], groups: tuple[str, ...], around: Beside
) -> tuple[str, dict[str, Any]]:
    """Return the module of the function, and what its numbers are."""
    from symgen.emit.side import emit_side
    from symgen.lower.linearised import can_decay, lower_linearised

    known: dict[str, Any] = {"still": bool(groups) and not can_decay(mechanism, around)}
    text = '"""Nothing decays."""\n'
    if not known["still"]:
        with finite_numbers(f"mechanism '{mechanism.name}'"):
            program = lower_linearised(mechanism, by, around, groups)
        text = emit_side(program.side)
        known |= {
            "sizes": list(program.sizes.items()),
            "pattern": [list(place) for place in program.pattern],
            "elements": [list(place) for place in program.elements],
            "functions": [[f.name, f.unit, f.orders] for f in program.functions],
        }
    return text, known
