"""A compiled model in the looped shape: shared functions, own tables, and numbers computed once a run."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import ModuleType
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

from symgen.base.vocabulary.expressions import Expr
from symgen.base.vocabulary.measures import Holonomic
from symgen.base.vocabulary.quantities import Quantity
from symgen.compile.loopcode.exact import compiled_form, plain_form
from symgen.compile.store.loaded_modules import plain_function
from symgen.derive.lower.looped.index_tables import IndexTables
from symgen.derive.lower.looped.layout import GENERIC, HEAD
from symgen.derive.lower.looped.shape import LoopedShape
from symgen.describe.facts.repeats import without_repeats
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.mechanism import Mechanism
from symgen.describe.parts.topology import state_quantities
from symgen.run.layout.compiled import Array, CompiledModel, ModelInfo, RowInfo
from symgen.run.starts.hoisting import copy_masses, sum_products

Integers = NDArray[np.int64]


@final
@dataclass(frozen=True, repr=False)
class LoopedModel(CompiledModel):
    """A compiled model in the looped shape: shared code and tables of its own.

    Attributes
    ----------
    tables : IndexTables
        Tables for the generic code.
    kernels : mapping of str to module
        By name.
    machine : module
        Calls of kernels and the generic code, except what of this is another one.
    generic : module
        The generic code that is reached through the tables: where the mechanism has rotors, that for a M with them.
    """

    shape, sparse = "looped", True
    tables: IndexTables = field(kw_only=True)
    kernels: Mapping[str, ModuleType] = field(kw_only=True)
    machine: ModuleType = field(kw_only=True)
    generic: ModuleType = field(kw_only=True)

    def scratch(self) -> Array:
        """Return a new scratch array ``w`` with the tables in it."""
        # these import Numba, which emitting code does without
        from symgen.run.layout.kernel_addresses import address

        w = np.zeros(self.law.nw)
        offset, size = self.tables.sections["tables"]
        part = w[offset : offset + size]
        part.view(np.uint32)[: len(self.tables.numbers)] = np.frombuffer(self.tables.numbers, dtype=np.uint32)
        addresses = [0 if called is None else address(called[0], self.machine, called[1]) for called in self.called]
        part.view(np.int64)[-1] = offset
        w.view(np.int64)[-1] = offset  # read from the end, as sections of a run may follow the tables
        first = self.tables.addresses
        part.view(np.int64)[first : first + len(addresses)] = addresses
        return self.with_scales(w)

    def printed_scratch(self) -> Array:
        """Return the same for a printed text: places in `called` as addresses; the tables are constants of the text."""
        w = np.zeros(self.law.nw)
        first = self.tables.sections["tables"][0] + self.tables.addresses
        w[first : first + len(self.called)] = np.arange(len(self.called))
        return self.with_scales(w)

    @property
    def called(self) -> list[tuple[Any, Any] | None]:
        """Functions that are called through the tables, in their order, with their types; None where nothing is."""
        from symgen.run.layout.kernel_addresses import GENERIC as GENERIC_CODE
        from symgen.run.layout.kernel_addresses import KERNEL

        augmented = bool(self.tables.numbers[HEAD.index("augmented_factor")])
        generic = [
            (getattr(self.generic, f"{name}_code"), GENERIC_CODE) if augmented or name != "augment" else None
            for name in GENERIC
        ]
        return [*generic, *((getattr(self.kernels[stem], name), KERNEL) for stem, name in self.tables.functions)]


#: Loops of at most so many turns are interpreted, as compiled ones have to be loaded first; bits are the same.
MOST_INTERPRETED = 400


def _call_exactly(function: Callable[..., object], turns: int, *arguments: Any) -> int:
    """Call an exact function in the form that is sooner done."""
    form = plain_form if turns <= MOST_INTERPRETED else compiled_form
    return int(form(function)(*arguments))


@dataclass(frozen=True, eq=False)
class MassDiagonal:
    """What writes the diagonal of M to its section: arguments of `symgen.run.starts.hoisting.copy_masses`.

    Attributes
    ----------
    places : Array of int64, shape (3,)
        Its place in ``p``; offset and size of the section of ``w``.
    added : Array of int64, shape (2 k,)
        Elements of the section to which numbers of ``p`` are added, each with the place of the number.
    """

    places: Integers
    added: Integers

    def __call__(self, p: Array, w: Array) -> int:
        """Write the diagonal to its section."""
        return _call_exactly(copy_masses, int(self.places[2]), self.places, self.added, p, w)


def mass_diagonal_of(shape: LoopedShape, tables: IndexTables) -> MassDiagonal:
    """Return the function that writes the diagonal of M to its section."""
    added = np.array(shape.rotor_diagonal, dtype=np.int64).ravel()
    return MassDiagonal(np.array([shape.mass_diagonal, *tables.sections["mass"]], dtype=np.int64), added)


@dataclass(frozen=True, eq=False)
class HoistedNumbers:
    """The numbers after the parameters in ``p``: what fills them, once a run.

    Attributes
    ----------
    mechanism : Mechanism
        Its parameters are the first numbers.
    constants : tuple of (int, Expr)
        Places and formulas of parameters.
    groups : tuple of (module, int)
        Kernels that compute numbers, and the places of their tables, in their order.
    tables : IndexTables
        Tables that these read.
    kernels : mapping of str to module
        By name.
    sums : tuple of Array
        Arguments of `symgen.run.starts.hoisting.sum_products` before ``p``, which comes last.
    """

    mechanism: Mechanism
    constants: tuple[tuple[int, Expr], ...]
    groups: tuple[tuple[str, int], ...]
    tables: IndexTables
    kernels: Mapping[str, ModuleType]
    sums: tuple[Integers, Integers, Integers, Array, Integers]

    def __call__(self, p: Array) -> int:
        """Fill the numbers after the parameters."""
        mechanism, numbers = self.mechanism, np.frombuffer(self.tables.numbers, dtype=np.uint32)
        values = {q.name: float(p[i]) for i, q in enumerate(mechanism.parameters)}
        tables_by_name = {t.name: t for t in mechanism.tables}
        for place, expression in self.constants:
            p[place] = evaluate_formula(expression, values, mechanism.name, tables_by_name)
        for stem, at in self.groups:
            plain_function(self.kernels[stem].prepare)(0.0, p, p, p, numbers, at, p)
        places, *_, products, _ = self.sums
        return _call_exactly(sum_products, len(products) + int(places[2]), *self.sums, p)


def filler_of_hoisted(
    mechanism: Mechanism, shape: LoopedShape, tables: IndexTables, kernels: Mapping[str, ModuleType]
) -> HoistedNumbers:
    """Return the function that fills the numbers after the parameters in ``p``."""
    constant, size = shape.products.constant, shape.gram.size
    ones = [shape.gram.place_of_entry(row, row) for row in shape.rotors]
    return HoistedNumbers(
        mechanism=mechanism,
        constants=tuple((shape.first_constant + k, expression) for expression, k in shape.constant_index.items()),
        groups=tuple((stem, at) for stem, computes, at in tables.groups if computes),
        tables=tables,
        kernels=kernels,
        sums=(
            np.array([shape.gram_base, shape.gram_base + size, size, shape.mass_diagonal + shape.nv], dtype=np.int64),
            np.array([t for t, _, _ in constant], dtype=np.int64),
            np.array([v for _, v, _ in constant], dtype=np.int64),
            np.array([x for _, _, x in constant], dtype=np.float64),
            np.array(ones, dtype=np.int64),
        ),
    )


def describe_model(mechanism: Mechanism, shape: LoopedShape, tables: IndexTables) -> ModelInfo:
    """Return the runtime's facts of a mechanism in the looped shape."""
    mechanism, repeats = without_repeats(mechanism)
    coordinates, velocities = state_quantities(mechanism)
    bounded = tuple(row for row, _ in shape.idle)
    operations: dict[str, int] = {}
    for group in shape.groups:
        for name, count in group.info.functions.items():
            operations[name] = operations.get(name, 0) + count * len(group.members)
    return ModelInfo(
        name=mechanism.name,
        digest="",
        parameters=tuple(Quantity(p.name, p.unit) for p in mechanism.parameters),
        coordinates=coordinates,
        velocities=velocities,
        rows=tuple(
            RowInfo(f"{joint.name}.{row.label}", joint.name, row.unit, isinstance(row, Holonomic))
            for joint in mechanism.joints
            for row in joint.rows
        )
        + tuple(RowInfo(row.row, row.owner, row.unit, True) for row in mechanism.bounded),
        joint_coordinates=tuple(
            Quantity(f"{joint.name}.{label}", joint.unit(label))
            for joint in mechanism.joints
            for label, _ in joint.coordinates
        ),
        sections=dict(tables.sections),
        jacobian=tuple((row, column, None, slot) for row, column, slot in shape.entries),
        hoisted=shape.hoisted,
        dropped_rows=tuple(f"{row} = {other}" for row, other in repeats),
        massless=tuple(shape.massless),
        windings=shape.windings,
        spins=tuple(shape.spins),
        operations=operations,
        inputs=mechanism.inputs,
        alone=tuple(row for row in shape.gram.rows_alone if row not in (*bounded, *shape.rotors)),
        states=tuple(Quantity(x.name, x.unit) for x in mechanism.states),
        switchable=bounded,
        bounded=bounded,
    )
