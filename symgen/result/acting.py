"""Reactions of joints from D and the multipliers at many states, be they outputs of one run or ends of many."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from symgen.result.labelled import Array, Labelled
from symgen.result.points import rotation_matrices
from symgen.vocabulary.measures import GROUND

if TYPE_CHECKING:
    from symgen.runtime.compiled import ModelInfo


@dataclass(frozen=True)
class Seat:
    """Where the reaction of a joint acts: its first body, and its point there relative to the centre of mass [m].

    On the ground the point is relative to the origin; where it varies, `place` has a row for each state. It is 0 for
    kinds of joints without a point ``at``.
    """

    body: str
    place: tuple[float, ...] | Array


def _is_spatial(info: ModelInfo) -> bool:
    """Whether bodies move in space."""
    return any(velocity.name.endswith(".vz") for velocity in info.velocities)


def _labels(spatial: bool, velocities: int) -> list[str]:
    """Return the components that a reaction has on a body of so many velocities, 0 for the ground."""
    axes = "xyz" if spatial else "xy"
    turns = velocities == 0 or velocities > len(axes)
    return [*(f"F{axis}" for axis in axes), *(f"M{axis}" for axis in ("xyz" if spatial else ("",)) if turns)]


def reaction_names(joints: Mapping[str, str], info: ModelInfo) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the names of the components of all reactions, and those of their magnitudes, of any run of a model.

    Parameters
    ----------
    joints : mapping of str to str
        Joint -> its first body.
    info : ModelInfo
        The model.
    """
    sizes, spatial = Counter(velocity.name.rpartition(".")[0] for velocity in info.velocities), _is_spatial(info)
    parts, lengths = list[str](), list[str]()
    for joint, body in joints.items():
        labels = _labels(spatial, 0 if body == GROUND else sizes[body])
        parts += [f"{joint}.{label}" for label in labels]
        several = (name for letter, name in (("F", "F"), ("M", "T")) if sum(x[0] == letter for x in labels) > 1)
        lengths += [f"{joint}.{name}" for name in several]
    return tuple(parts), tuple(lengths)


@dataclass(frozen=True)
class Acting:
    """What reactions are worked out from.

    Attributes
    ----------
    info : ModelInfo
        The model.
    seats : mapping
        Joint name -> where its reaction acts.
    states : Array, shape (k, ny)
        States, coordinates first.
    """

    info: ModelInfo
    seats: Mapping[str, Seat]
    states: Array

    def reactions(self, entries: Array, multipliers: Array) -> Labelled:
        """Return -D^T lambda of each joint on its first body as forces and moments in ground axes.

        Moments are about the joints' points.

        Parameters
        ----------
        entries : Array, shape (k, varying entries)
            D's entries that vary, as ``geometry`` leaves them.
        multipliers : Array, shape (k, m)
            lambda.
        """
        columns: dict[str, list[tuple[int, str]]] = {}
        for i, velocity in enumerate(self.info.velocities):
            body, _, component = velocity.name.rpartition(".")
            columns.setdefault(body, []).append((i, component))
        by_joint: dict[str, list[tuple[int, int, Array]]] = {joint: [] for joint in self.seats}
        constant = np.ones(len(self.states))
        for row, column, number, slot in self.info.jacobian:
            value = constant * (number or 0.0) if slot is None else entries[:, slot]
            by_joint[self.info.rows[row].joint].append((row, column, value))
        names, values = list[str](), list[Array]()
        for joint, seat in self.seats.items():
            generalised: dict[int, Array] = {}
            for row, column, value in by_joint[joint]:
                part = -value * multipliers[:, row]
                generalised[column] = generalised[column] + part if column in generalised else part
            if seat.body == GROUND:
                force, moment = self._on_ground(generalised, columns)
            else:
                force, moment = self._on_body(seat.body, generalised, columns[seat.body])
            place = self._in_space(np.asarray(seat.place))[..., np.newaxis, :]
            arm = (place @ np.swapaxes(self._axes(seat.body), 1, 2))[..., 0, :]
            moment = moment - np.cross(arm, force)
            for label, value in self._labelled(force, moment, columns.get(seat.body, [])):
                names.append(f"{joint}.{label}")
                values.append(value)
        return self._table(names, values)

    def in_body_axes(self, reactions: Labelled) -> Labelled:
        """Return reactions in the axes of the bodies that they act on."""
        values = reactions.values.copy()
        for joint, seat in self.seats.items():
            for letter in "FM":
                indices = [i for i, n in enumerate(reactions.names) if n.startswith(f"{joint}.{letter}")]
                if seat.body != GROUND and len(indices) > 1:
                    turned = self._in_space(reactions.values[:, indices])[:, np.newaxis] @ self._axes(seat.body)
                    values[:, indices] = turned[:, 0, : len(indices)]
        return Labelled(values, reactions.names, reactions.units)

    def magnitudes(self, reactions: Labelled) -> Labelled:
        """Return the lengths of the reactions' forces, and of their moments where these have several components."""
        names, values = list[str](), list[Array]()
        for joint in self.seats:
            for letter, name in (("F", "F"), ("M", "T")):
                indices = [i for i, n in enumerate(reactions.names) if n.startswith(f"{joint}.{letter}")]
                if len(indices) > 1:
                    names.append(f"{joint}.{name}")
                    values.append(np.linalg.norm(reactions.values[:, indices], axis=1))
        return self._table(names, values)

    def _table(self, names: list[str], values: list[Array]) -> Labelled:
        stacked = np.column_stack(values) if values else np.zeros((len(self.states), 0))
        return Labelled(stacked, tuple(names), tuple("N" if n.rpartition(".")[2][0] == "F" else "N m" for n in names))

    @property
    def _spatial(self) -> bool:
        return _is_spatial(self.info)

    def _labelled(self, force: Array, moment: Array, indices: list[tuple[int, str]]) -> Iterator[tuple[str, Array]]:
        """Yield the components that a reaction has on a body: a point mass, unlike the ground, takes no moment."""
        for label in _labels(self._spatial, len(indices)):
            values = force if label[0] == "F" else moment
            yield label, values[:, "xyz".index(label[1:] or "z")]

    def _on_ground(
        self, generalised: Mapping[int, Array], columns: Mapping[str, list[tuple[int, str]]]
    ) -> tuple[Array, Array]:
        """Return the reaction on the ground: what balances the joint's forces on all bodies, about the origin."""
        total, about = np.zeros((len(self.states), 3)), np.zeros((len(self.states), 3))
        for body, indices in columns.items():
            if any(i in generalised for i, _ in indices):
                force, moment = self._on_body(body, generalised, indices)
                place = np.column_stack(self._coordinates(body, "xyz" if self._spatial else "xy"))
                total -= force
                about -= moment + np.cross(self._in_space(place), force)
        return total, about

    def _on_body(
        self, body: str, generalised: Mapping[int, Array], indices: list[tuple[int, str]]
    ) -> tuple[Array, Array]:
        """Return force, and moment about the centre of mass, both in ground axes, shapes (k, 3)."""
        nothing = np.zeros(len(self.states))
        parts = {component: generalised.get(i, nothing) for i, component in indices}
        force = np.column_stack([parts.get(c, nothing) for c in ("vx", "vy", "vz")])
        if "omega" in parts:
            return force, np.column_stack([nothing, nothing, parts["omega"]])
        moment = np.column_stack([parts.get(c, nothing) for c in ("wx", "wy", "wz")])  # in body axes
        return force, (moment[:, np.newaxis] @ np.swapaxes(self._axes(body), 1, 2))[:, 0]

    def _axes(self, body: str) -> Array:
        """Return the rotation matrices of a body at the outputs, shape (k, 3, 3)."""
        known = {quantity.name for quantity in self.info.coordinates}
        found = np.zeros((len(self.states), 3, 3)) + np.eye(3)
        if f"{body}.theta" in known:
            found[:, :2, :2] = rotation_matrices(np.column_stack(self._coordinates(body, ("theta",))))
        elif f"{body}.e0" in known:
            found = rotation_matrices(np.column_stack(self._coordinates(body, ("e0", "e1", "e2", "e3"))))
        return found

    @staticmethod
    def _in_space(vectors: Array) -> Array:
        """Return vectors with three components."""
        missing = 3 - vectors.shape[-1]
        return np.concatenate([vectors, np.zeros((*vectors.shape[:-1], missing))], axis=-1)

    def _coordinates(self, body: str, names: Iterable[str]) -> list[Array]:
        """Return coordinates of a body at the outputs."""
        known = {quantity.name: i for i, quantity in enumerate(self.info.coordinates)}
        return [self.states[:, known[f"{body}.{name}"]] for name in names]
