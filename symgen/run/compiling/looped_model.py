"""A compiled model in the looped shape: shared functions, own tables, and numbers computed once a run."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import ModuleType
from typing import final

import numpy as np

from symgen.base.vocabulary.measures import Holonomic
from symgen.base.vocabulary.quantities import Quantity
from symgen.compile.store.loaded_modules import plain_function
from symgen.derive.lower.looped.index_tables import IndexTables
from symgen.derive.lower.looped.layout import GENERIC, HEAD
from symgen.derive.lower.looped.shape import LoopedShape
from symgen.describe.facts.repeats import without_repeats
from symgen.describe.formulas.evaluate import evaluate
from symgen.describe.mechanism import Mechanism
from symgen.describe.parts.topology import state_quantities
from symgen.run.layout.compiled import Array, CompiledModel, ModelInfo, RowInfo


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
        from symgen.run.layout.kernel_addresses import GENERIC as GENERIC_CODE
        from symgen.run.layout.kernel_addresses import address

        w = np.zeros(self.law.nw)
        offset, size = self.tables.sections["tables"]
        part = w[offset : offset + size]
        part.view(np.uint32)[: len(self.tables.numbers)] = np.frombuffer(self.tables.numbers, dtype=np.uint32)
        augmented = bool(self.tables.numbers[HEAD.index("augmented_factor")])
        addresses = [
            address(getattr(self.generic, f"{name}_code"), self.machine, GENERIC_CODE)
            if augmented or name != "augment"
            else 0
            for name in GENERIC
        ]
        addresses += [address(getattr(self.kernels[stem], name), self.machine) for stem, name in self.tables.functions]
        part.view(np.int64)[-1] = offset
        w.view(np.int64)[-1] = offset  # read from the end, as sections of a run may follow the tables
        first = self.tables.addresses
        part.view(np.int64)[first : first + len(addresses)] = addresses
        return self.with_scales(w)


def mass_diagonal_of(shape: LoopedShape, tables: IndexTables) -> Callable[[Array, Array], int]:
    """Return the function that writes the diagonal of M to its section."""
    first, (offset, size) = shape.mass_diagonal, tables.sections["mass"]
    added = np.array(shape.rotor_diagonal, dtype=np.int64).reshape(-1, 2)

    def fill_masses(p: Array, w: Array) -> int:
        w[offset : offset + size] = p[first : first + size]
        np.add.at(w, offset + added[:, 0], p[added[:, 1]])
        return 0

    return fill_masses


def filler_of_hoisted(
    mechanism: Mechanism, shape: LoopedShape, tables: IndexTables, kernels: Mapping[str, ModuleType]
) -> Callable[[Array], int]:
    """Return the function that fills the numbers after the parameters in ``p``: interpreted, once a run."""
    numbers = np.frombuffer(tables.numbers, dtype=np.uint32)
    tables_by_name = {t.name: t for t in mechanism.tables}
    constant = shape.products.constant
    target = np.array([t for t, _, _ in constant], dtype=np.int64)
    velocity = np.array([v for _, v, _ in constant], dtype=np.int64)
    product = np.array([x for _, _, x in constant])
    size = shape.gram.size
    ones = np.array([shape.gram.place_of_entry(row, row) for row in shape.rotors], dtype=np.int64)

    def prepare(p: Array) -> int:
        values = {q.name: float(p[i]) for i, q in enumerate(mechanism.parameters)}
        for expression, k in shape.constant_index.items():
            p[shape.first_constant + k] = evaluate(expression, values, mechanism.name, tables_by_name)
        for stem, computes, at in tables.groups:
            if computes:
                plain_function(kernels[stem].prepare)(0.0, p, p, p, numbers, at, p)
        first = shape.mass_diagonal
        inverse = p[first + shape.nv : first + 2 * shape.nv]
        for base, weights in ((shape.gram_base, product), (shape.gram_base + size, product * inverse[velocity])):
            p[base : base + size] = np.bincount(target, weights, size)
            p[base + ones] = 1.0
        return 0

    return prepare


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
