"""A mechanism as functions of its state know it: without history, in chosen coordinates, with its numbers."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.base import arguments
from symgen.base.errors import InputError, suggest
from symgen.base.settings import COORDINATES, Settings
from symgen.describe.bounds.bounded_modes import one_sided_rows, refuse_bounds, without_bounds
from symgen.describe.bounds.contact_rows_in_space import refuse_rows_in_pairs
from symgen.describe.bounds.smooth import sliding_rows_as_forces
from symgen.describe.facts.repeats import without_repeats
from symgen.describe.formulas.evaluate import parameter_values
from symgen.describe.parts.holding_joints import has_modes_of_joints, in_modes
from symgen.describe.parts.topology import state_quantities
from symgen.run.compiling.choices import choose_coordinates, mechanism_on_tree, take_tree_of
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import prepare

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.run.planning.prepare import Prepared

Array = NDArray[np.float64]
#: A row with less than this part of its length beside the rows before it depends on them.
DEPENDENT = 1e-9


class StateModel:
    """A mechanism in which no row with bounds is in force.

    Parameters
    ----------
    where : str
        What needs it, for messages.
    mechanism : Mechanism
        The description.
    coordinates : {"absolute", "joint", "auto"}
        Coordinates of the state.
    parameters : mapping
        Numbers that differ from the described ones: of parameters, inputs, own states and the time ``t``.

    Attributes
    ----------
    mechanism : Mechanism
        With its tree in joint coordinates.
    kind : {"absolute", "joint"}
        Its coordinates.
    coordinates, velocities : tuple of Quantity
        Names and units of q and v.
    rows : tuple of str
        Names of the rows.
    parameters : tuple of str
        Names of the numbers ``p``.
    """

    def __init__(self, where: str, mechanism: Mechanism, coordinates: str, parameters: Mapping[str, float]) -> None:
        coordinates = arguments.one_word_of("coordinates", coordinates, COORDINATES)
        if has_modes_of_joints(mechanism):
            given = arguments.mapping("set", parameters, "numbers by the names of parameters")
            own = {p.name for p in mechanism.parameters}
            values = {name: x for name, x in given.items() if name in own}
            mechanism = in_modes(mechanism, parameter_values(mechanism, values))
        refuse_rows_in_pairs(where, mechanism)
        sliding = sliding_rows_as_forces(where, mechanism)
        described = without_bounds(sliding, one_sided_rows(sliding))
        refuse_bounds(where, described)
        self.kind = choose_coordinates(described, coordinates, "straight").name
        if self.kind == "joint" and described is not mechanism:  # runs have the rows that are left out here
            described = take_tree_of(described, mechanism)
        self._described = described
        self.mechanism = mechanism_on_tree(self._described) if self.kind == "joint" else self._described
        self.coordinates, self.velocities = state_quantities(self.mechanism)
        distinct = without_repeats(self.mechanism)[0]
        self.rows = tuple(f"{joint.name}.{row.label}" for joint in distinct.joints for row in joint.rows)
        self._own = tuple(state.name for state in self.mechanism.states)
        self.parameters = (*(p.name for p in self.mechanism.parameters), *self._own, "t")
        self._changed: dict[str, float] = {}
        self.values(parameters)
        self._changed = dict(parameters)

    def values(self, changed: Mapping[str, float]) -> Array:
        """Return the numbers ``p`` with changed ones; those that follow others by formulas follow them here.

        Raises
        ------
        InputError
            If there is no such name, or a value is not finite.
        """
        given = {**self._changed, **arguments.mapping("values", changed, "numbers by name")}
        beside = {name: given.pop(name) for name in (*self._own, "t") if name in given}
        for name in given:
            if name not in self.parameters:
                hint = suggest(str(name), {*self.parameters})
                raise InputError("values", f"a parameter of {self.mechanism.name}", f"'{name}'", hint)
        of_file = parameter_values(self.mechanism, given)
        last = [arguments.number(f"values '{name}'", beside.get(name, 0.0)) for name in (*self._own, "t")]
        return np.array([*of_file.values(), *last])

    @cached_property
    def _prepared(self) -> Prepared:
        own = {p.name for p in self.mechanism.parameters}
        parameters = {name: x for name, x in self._changed.items() if name in own}
        settings = Settings(coordinates=self.kind, parameters=parameters, shape="straight")
        return prepare(self._described, settings, Purpose.STATE)

    @property
    def start(self) -> tuple[Array, Array]:
        """Coordinates and velocities at the start of a run.

        Raises
        ------
        AssemblyError
            If the mechanism cannot be closed.
        """
        y, nq, nv = self._prepared.start.y, len(self.coordinates), len(self.velocities)
        return y[:nq].copy(), y[nq : nq + nv].copy()

    @property
    def rank(self) -> int:
        """The rank of D at the start."""
        return int(self._prepared.start.rank) if self.rows else 0

    @cached_property
    def kept(self) -> tuple[int, ...]:
        """Rows that are independent of those before them at the start."""
        if not self.rows:
            return ()
        d, kept, basis = self._prepared.compiled.jacobian(self._prepared.start.w), list[int](), list[Array]()
        for i, row in enumerate(d):
            size = np.linalg.norm(row)
            left = row / size if size > 0.0 else row
            for _ in range(2):
                for one in basis:
                    left = left - (one @ left) * one
            if np.linalg.norm(left) > DEPENDENT:
                kept.append(i)
                basis.append(left / np.linalg.norm(left))
        return tuple(kept)
