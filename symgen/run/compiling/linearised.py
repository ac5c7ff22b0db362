"""The descriptor form with its exact derivatives, compiled on demand next to a model's modules.

The function is evaluated a few times an analysis, so it is plain Python; SymPy and Jinja2 are imported only where the
cache has no entry.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import refuse_overflow
from symgen.base.vocabulary.infos import BY, LinearisedInfo
from symgen.compile.store.loaded_modules import load_module
from symgen.describe.formulas.evaluate import dependent_parameters
from symgen.describe.mechanism import Mechanism
from symgen.run.compiling.side import compile_beside, digest_of_formulas, side_module
from symgen.run.layout.abi import OBSERVE
from symgen.run.layout.compiled import CompiledModel
from symgen.run.layout.probe import Few

Array = NDArray[np.float64]

#: Name of the emitted function, and beginning of its module's name.
NAME = "linearised"


@dataclass(frozen=True)
class LinearisedState:
    """All values and derivatives of a descriptor form at one state, by group."""

    form: DescriptorForm
    out: Array

    def value(self, group: str) -> Array:
        """Return the values of a group."""
        first, size = self.form.places[group]
        return self.out[first : first + size]

    def by(self, group: str, space: str) -> Array:
        """Return the derivatives of a group by one of `symgen.base.vocabulary.infos.BY`, shape (values, size)."""
        first, size = self.form.places[group]
        derivatives = np.zeros((size, self.form.widths[space]))
        entries, rows, columns = self.form.entries(group, space)
        derivatives[rows - first, columns] = self.out[self.form.values + entries]
        return derivatives


@dataclass(frozen=True)
class DescriptorForm:
    """The function and the meaning of its numbers.

    Attributes
    ----------
    function : compiled function
        ``(t, y, p, w, ydot, out)``.
    places : mapping of str to (int, int)
        Group -> first value and number of values; groups of `symgen.derive.lower.descriptor_derivatives`, and
        ``functions``.
    widths : mapping of str to int
        Numbers of each space.
    functions : mapping of str to (int, int)
        Quantity of the state -> its place in ``functions``, and how many of value, rate and second rate exist.
    units : mapping of str to str
        Their units.
    elements : tuple of (str, int)
        Force and velocity of each value of the group ``elements``.
    pattern : Array of int64, shape (n, 3)
        Value, space, by its place in `symgen.base.vocabulary.infos.BY`, and index of each derivative.
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
        """Number of values before the derivatives."""
        return sum(size for _, size in self.places.values())

    @cached_property
    def _split(self) -> dict[tuple[str, str], tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]]:
        places = {}
        for group, (first, size) in self.places.items():
            inside = (self.pattern[:, 0] >= first) & (self.pattern[:, 0] < first + size)
            for k, space in enumerate(BY):
                entries = np.flatnonzero(inside & (self.pattern[:, 1] == k))
                places[group, space] = entries, self.pattern[entries, 0], self.pattern[entries, 2]
        return places

    def entries(self, group: str, space: str) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
        """Return number, value and index of each derivative of a group by a space."""
        return self._split[group, space]

    @cached_property
    def _few(self) -> Few:
        return Few(self.function, OBSERVE)

    def at(self, t: float, y: Array, a: Array, p: Array, w: Array) -> LinearisedState:
        """Evaluate at a state.

        Parameters
        ----------
        t : float
            Time [s].
        y : Array
            q and v, and the rest of the state.
        a : Array, shape (nv,)
            v'.
        p, w : Array
            Parameters, and scratch with the multipliers in their section.
        """
        out = np.zeros(self.values + len(self.pattern))
        rates = np.concatenate([np.zeros(self.widths["q"]), a])
        self._few(t, y, p, w, rates, out)
        return LinearisedState(self, out)


def compile_linearised(mechanism: Mechanism, compiled: CompiledModel, by: tuple[str, ...] = ()) -> DescriptorForm:
    """Return the descriptor form of a mechanism with its derivatives, generated only if the cache does not have it.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism, with its tree where the state has joint coordinates.
    compiled : CompiledModel
        The model whose ``p`` and ``w`` it reads.
    by : tuple of str
        Parameters to differentiate by.

    Raises
    ------
    InputError
        If numbers that meet in a formula overflow.
    """
    form = _compile_module(mechanism, compiled, by, ())
    assert form is not None, "the whole form is wanted"
    return form


#: Groups that determine whether a motion near a state grows or decays.
GROWTH = ("motion", "balance", "accelerations", "states")


def compile_growth(mechanism: Mechanism, compiled: CompiledModel) -> DescriptorForm | None:
    """Return the groups `GROWTH` with derivatives by state, v' and multipliers; None where nothing can decay.

    Raises
    ------
    InputError
        If numbers that meet in a formula overflow.
    """
    return _compile_module(mechanism, compiled, (), GROWTH)


def _compile_module(
    mechanism: Mechanism, compiled: CompiledModel, by: tuple[str, ...], groups: tuple[str, ...]
) -> DescriptorForm | None:
    of_model, around = compiled.info, compile_beside(mechanism, compiled)
    # the digest that names folders does not cover outputs
    outputs = () if groups else mechanism.outputs
    reported = [(o.name, o.unit) for o in outputs], digest_of_formulas(o.value for o in outputs)

    def make() -> tuple[str, dict[str, Any]]:
        from symgen.derive.emit.emit import emit_side
        from symgen.derive.lower.descriptor_derivatives import can_decay, lower_descriptor

        if groups and not can_decay(mechanism, around):
            return '"""Nothing decays."""\n', {}
        with refuse_overflow(f"mechanism '{mechanism.name}'"):
            side, info = lower_descriptor(mechanism, by, around, groups)
        return emit_side(side), info.to_dict()

    identity = around, by, dependent_parameters(mechanism.parameters) if by else "", groups, reported
    metadata, path = side_module(mechanism, NAME, identity, make)
    if not metadata:
        return None
    info = msgspec.convert(metadata, LinearisedInfo)
    places, first = dict[str, tuple[int, int]](), 0
    functions, at = dict[str, tuple[int, int]](), 0
    for name, _, orders in info.functions:
        functions[name] = at, orders
        at += orders
    for group, size in (*info.sizes, ("functions", at)):
        places[group] = first, size
        first += size
    nv, m, parameters = of_model.nv, of_model.m, len(of_model.parameters)
    return DescriptorForm(
        function=getattr(load_module(path), NAME),
        places=places,
        widths=dict(zip(BY, (1, of_model.nq, nv, nv, m, parameters, len(of_model.states)), strict=True)),
        functions=functions,
        units={name: unit for name, unit, _ in info.functions},
        elements=info.elements,
        pattern=np.array(info.pattern, dtype=np.int64).reshape(-1, 3),
    )
