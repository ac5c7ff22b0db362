"""Multipliers, and reactions of joints from D and the multipliers at many states: outputs of a run, or ends of many."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from symgen.base.errors import plural
from symgen.base.ir.program import MODE_NUMBERS
from symgen.base.vocabulary.measures import GROUND
from symgen.describe.facts.carriers import bodies_of_reactions
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.modal_body import COORDINATE, names_of_modes
from symgen.result.interface_poses import interface_poses
from symgen.result.labelled import Array, Labelled
from symgen.result.points import rotation_matrices
from symgen.result.signals import SignalTables, fill_table, signals_of_forces
from symgen.run.layout import abi

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.describe.modal_body import CarriedInterface
    from symgen.run.layout.compiled import CompiledModel, ModelInfo
    from symgen.run.single.outcome import Motion


@dataclass(frozen=True)
class Seat:
    """Where the reaction of a joint acts: its first body, and its point there relative to the centre of mass [m].

    On the ground the point is relative to the origin; where it varies, `place` has a row for each state. It is 0 for
    kinds of joints without a point ``at``. On an interface, `carried`, it is a point of that, while `body` carries it.
    """

    body: str
    place: tuple[float, ...] | Array
    carried: CarriedInterface | None = None


@dataclass(frozen=True)
class Acting:
    """Data from which reactions are computed.

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
            joint = self.info.rows[row].joint
            if joint not in by_joint:  # a row of its own, whose measure is a formula
                continue
            value = constant * (number or 0.0) if slot is None else entries[:, slot]
            by_joint[joint].append((row, column, value))
        forces, moments, arms = list[Array](), list[Array](), list[Array]()
        for joint, seat in self.seats.items():
            generalised: dict[int, Array] = {}
            for row, column, value in by_joint[joint]:
                part = -value * multipliers[:, row]
                generalised[column] = generalised[column] + part if column in generalised else part
            if seat.body == GROUND:
                force, moment = self._reaction_on_ground(generalised, columns)
            else:
                force, moment = self._reaction_on_body(seat.body, generalised, columns[seat.body])
            place = self._three_components(self._place_on_body(seat))[..., np.newaxis, :]
            arm = (place @ np.swapaxes(self._axes_of_body(seat.body), 1, 2))[..., 0, :]
            forces.append(force)
            moments.append(moment)
            arms.append(np.broadcast_to(arm, force.shape))
        vectors = {"F": forces, "M": list(np.array(moments) - np.cross(arms, forces)) if forces else []}
        numbers = {joint: k for k, joint in enumerate(self.seats)}
        return self._make_table(
            "reactions",
            (vectors[part[0]][numbers[joint]][:, "xyz".index(part[1:] or "z")] for joint, part in self._parts),
        )

    def _place_on_body(self, seat: Seat) -> Array:
        """Return the place of a seat from the centre of mass of its body, in axes of the body."""
        if seat.carried is None:
            return np.asarray(seat.place)
        names = names_of_modes(COORDINATE, len(seat.carried.shape))
        modes = np.column_stack(self._coordinates_of_body(seat.body, names))
        return interface_poses(seat.carried, modes).place(np.asarray(seat.place))

    @cached_property
    def signals(self) -> SignalTables:
        """The columns of all tables of forces."""
        return signals_of_forces(self.info, {joint: seat.body for joint, seat in self.seats.items()})

    @cached_property
    def _parts(self) -> list[tuple[str, str]]:
        """Joint and component of each column of the reactions."""
        return [(joint, part) for s in self.signals["reactions"] for joint, _, part in [s.key.rpartition(".")]]

    def _columns_of_vectors(self, letter: str) -> dict[str, list[int]]:
        """Return the columns of the reactions that are components of forces (F) or moments (M), by joint."""
        columns = dict[str, list[int]]()
        for i, (joint, part) in enumerate(self._parts):
            if part[0] == letter:
                columns.setdefault(joint, []).append(i)
        return columns

    def in_body_axes(self, reactions: Labelled) -> Labelled:
        """Return reactions in the axes of the bodies that they act on."""
        values = reactions.values.copy()
        for letter in "FM":
            for joint, columns in self._columns_of_vectors(letter).items():
                body = self.seats[joint].body
                if body != GROUND and len(columns) > 1:
                    turned = self._three_components(reactions.values[:, columns])[:, np.newaxis] @ self._axes_of_body(
                        body
                    )
                    values[:, columns] = turned[:, 0, : len(columns)]
        return self._make_table("body_reactions", values.T)

    def magnitudes(self, reactions: Labelled) -> Labelled:
        """Return the lengths of the reactions' forces, and of their moments where these have several components."""
        columns = {"F": self._columns_of_vectors("F"), "T": self._columns_of_vectors("M")}
        places = [columns[s.key[-1]][s.key[:-2]] for s in self.signals["magnitudes"]]
        return self._make_table("magnitudes", (np.linalg.norm(reactions.values[:, place], axis=1) for place in places))

    def _make_table(self, table: str, columns: Iterable[Array]) -> Labelled:
        values = [*columns]
        stacked = np.column_stack(values) if values else np.zeros((len(self.states), 0))
        return fill_table(stacked, self.signals[table])

    @property
    def _spatial(self) -> bool:
        return any(velocity.name.endswith(".vz") for velocity in self.info.velocities)

    def _reaction_on_ground(
        self, generalised: Mapping[int, Array], columns: Mapping[str, list[tuple[int, str]]]
    ) -> tuple[Array, Array]:
        """Return the reaction on the ground: what balances the joint's forces on all bodies, about the origin."""
        total, about = np.zeros((len(self.states), 3)), np.zeros((len(self.states), 3))
        for body, indices in columns.items():
            if any(i in generalised for i, _ in indices):
                force, moment = self._reaction_on_body(body, generalised, indices)
                place = np.column_stack(self._coordinates_of_body(body, "xyz" if self._spatial else "xy"))
                total -= force
                about -= moment + np.cross(self._three_components(place), force)
        return total, about

    def _reaction_on_body(
        self, body: str, generalised: Mapping[int, Array], indices: list[tuple[int, str]]
    ) -> tuple[Array, Array]:
        """Return force, and moment about the centre of mass, both in ground axes, shapes (k, 3)."""
        nothing = np.zeros(len(self.states))
        parts = {component: generalised.get(i, nothing) for i, component in indices}
        force = np.column_stack([parts.get(c, nothing) for c in ("vx", "vy", "vz")])
        if "omega" in parts:
            return force, np.column_stack([nothing, nothing, parts["omega"]])
        moment = np.column_stack([parts.get(c, nothing) for c in ("wx", "wy", "wz")])  # in body axes
        return force, (moment[:, np.newaxis] @ np.swapaxes(self._axes_of_body(body), 1, 2))[:, 0]

    def _axes_of_body(self, body: str) -> Array:
        """Return the rotation matrices of a body at the outputs, shape (k, 3, 3)."""
        if (known := self._turns.get(body)) is not None:
            return known
        names = self._places_of_coordinates
        turns = np.zeros((len(self.states), 3, 3)) + np.eye(3)
        if f"{body}.theta" in names:
            turns[:, :2, :2] = rotation_matrices(np.column_stack(self._coordinates_of_body(body, ("theta",))))
        elif f"{body}.e0" in names:
            turns = rotation_matrices(np.column_stack(self._coordinates_of_body(body, ("e0", "e1", "e2", "e3"))))
        self._turns[body] = turns
        return turns

    @cached_property
    def _turns(self) -> dict[str, Array]:
        """Rotation matrices of the bodies that were asked for: several joints act on one body."""
        return {}

    @cached_property
    def _places_of_coordinates(self) -> dict[str, int]:
        return {quantity.name: i for i, quantity in enumerate(self.info.coordinates)}

    @staticmethod
    def _three_components(vectors: Array) -> Array:
        """Return vectors with three components."""
        missing = 3 - vectors.shape[-1]
        return np.concatenate([vectors, np.zeros((*vectors.shape[:-1], missing))], axis=-1)

    def _coordinates_of_body(self, body: str, names: Iterable[str]) -> list[Array]:
        """Return coordinates of a body at the outputs."""
        return [self.states[:, self._places_of_coordinates[f"{body}.{name}"]] for name in names]


#: Singular values of D^T below this fraction of the largest one count as zero.
CUTOFF = 1e-6
#: A multiplier direction that changes no acceleration and has more than this in a joint makes its reaction not unique.
_SHARE = 1e-8


def seats_of_reactions(mechanism: Mechanism, parameters: Mapping[str, float]) -> dict[str, Seat]:
    """Return where the reactions of joints act, by name: at the points ``at`` of their first bodies."""
    markers, nothing, by_joint = dict(mechanism.seats), (0.0,) * len(mechanism.gravity), dict[str, Seat]()
    bodies = {body.name: body for body in mechanism.bodies}
    for name, body in bodies_of_reactions(mechanism).items():
        place, carried = nothing, None
        if name in markers:
            place = tuple(evaluate_formula(e, parameters, f"joints.{name}.at") for e in markers[name].point)
            if (on := markers[name].body) != GROUND:
                centre = (evaluate_formula(e, parameters, f"bodies.{on}") for e in bodies[on].centre_of_mass)
                place, carried = tuple(x - c for x, c in zip(place, centre, strict=True)), bodies[on].carried
        by_joint[name] = Seat(body, place, carried)
    return by_joint


@dataclass(frozen=True, repr=False)
class Forces:
    """Data from which multipliers and reactions are computed.

    Attributes
    ----------
    outcome : Motion
        States and raw multipliers at the outputs; its model gives D.
    seats : mapping
        Joint name -> where its reaction acts.
    """

    outcome: Motion
    seats: Mapping[str, Seat]

    def __repr__(self) -> str:
        return f"<Forces of {plural(len(self.seats), 'joint')} at {plural(len(self.outcome.times), 'output')}>"

    @property
    def compiled(self) -> CompiledModel:
        """The model that was run."""
        return self.outcome.compiled

    @property
    def redundant(self) -> bool:
        """Whether some rows depend on others at the start."""
        return self.outcome.start.rank < self.compiled.in_force(self.outcome.start.w)

    @cached_property
    def signals(self) -> SignalTables:
        """The columns of all tables of forces."""
        return signals_of_forces(self.compiled.info, {joint: seat.body for joint, seat in self.seats.items()})

    # -- multipliers ---------------------------------------------------------------------------------------------------

    def multipliers(self) -> Labelled:
        """Return lambda at all outputs, of minimum norm where the rows of D are dependent."""
        return fill_table(_multipliers_of_minimum_norm(self.outcome), self.signals["lam"])

    def final(self) -> dict[str, float]:
        """Return the multipliers at the last output by name; empty where there is no output."""
        o = self.outcome
        if not len(o.times):
            return {}
        # evaluated there alone: a run without other requests need not evaluate every output again
        last = replace(o, times=o.times[-1:], states=o.states[-1:], status_columns=o.status_columns[-1:])
        values = _multipliers_of_minimum_norm(last)[0]
        return {row.name: float(x) for row, x in zip(self.compiled.info.rows, values, strict=True)}

    @property
    def non_unique(self) -> tuple[str, ...]:
        """Joints whose reactions are not determined, in the order of the file."""
        info = self.compiled.info
        ambiguous = {name.partition(".")[0] for pair in info.dropped_rows for name in pair.split(" = ")}
        if self.redundant and not self.compiled.law.unique_multipliers:
            columns, _ = _weighed_rows(self.outcome, self.outcome.start.t, self.outcome.start.y)
            off = self.compiled.off(self.outcome.start.w)
            rows = [i for i, row in enumerate(info.rows) if row.name not in off]
            left, singular, _ = np.linalg.svd(columns.T[rows], full_matrices=True)
            rank = int(np.sum(singular > CUTOFF * singular.max(initial=0.0)))
            share = np.linalg.norm(left[:, rank:], axis=1)
            ambiguous |= {row.joint for row, x in zip([info.rows[i] for i in rows], share, strict=True) if x > _SHARE}
        return tuple(joint for joint in self.seats if joint in ambiguous)

    # -- reactions -----------------------------------------------------------------------------------------------------

    def reactions(self, multipliers: Labelled) -> Labelled:
        """Return -D^T lambda of each joint on its first body, at all outputs; see `Acting.reactions`."""
        return self._acting.reactions(self._entries_at_outputs(), multipliers.values)

    def in_body_axes(self, reactions: Labelled) -> Labelled:
        """Return reactions in the axes of the bodies that they act on."""
        return self._acting.in_body_axes(reactions)

    def magnitudes(self, reactions: Labelled) -> Labelled:
        """Return the lengths of the reactions' forces, and of their moments where these have several components."""
        return self._acting.magnitudes(reactions)

    @cached_property
    def _acting(self) -> Acting:
        return Acting(self.compiled.info, self.seats, self.outcome.states)

    def _entries_at_outputs(self) -> Array:
        """Return the entries of D that vary at all outputs, as ``geometry`` leaves them."""
        from symgen.run.layout.probe import Ready

        o, geometry = self.outcome, Ready(self.compiled.model.geometry, abi.MEASURE)
        w = o.w.copy()
        stored = self.compiled.section(w, "jacobian")
        values = np.empty((len(o.times), len(stored)))
        for k, t in enumerate(o.times):
            geometry(float(t), o.states[k], o.p, w)
            values[k] = stored
        return values


def constraint_jacobian(outcome: Motion, t: float, y: Array) -> Array:
    """Return D at one state, shape (m, nv)."""
    from symgen.run.layout.probe import Ready

    w = outcome.w.copy()
    Ready(outcome.compiled.model.geometry, abi.MEASURE)(float(t), y.copy(), outcome.p, w)
    return outcome.compiled.jacobian(w)


def _multipliers_of_minimum_norm(outcome: Motion) -> Array:
    """Return the multipliers at all outputs, shape (k, m), of minimum norm where the law leaves a choice."""
    values = outcome.multipliers.copy()
    if outcome.compiled.law.unique_multipliers:
        return values
    held = _rows_in_force(outcome)
    # looped code keeps a pivot of rows that are off, and counts it
    counted = outcome.compiled.info.m if outcome.compiled.shape == "looped" else held.sum(axis=1)
    dependent = outcome.status_columns[:, abi.RANK] < counted
    dependent |= outcome.start.rank < outcome.compiled.in_force(outcome.start.w)
    usable = np.isfinite(values).all(axis=1) & np.isfinite(outcome.states).all(axis=1)
    for k in np.flatnonzero(dependent & usable):
        columns, weights = _weighed_rows(outcome, float(outcome.times[k]), outcome.states[k])
        columns, forces = columns * held[k], values[k] / weights
        values[k] = weights * np.linalg.lstsq(columns, columns @ forces, rcond=CUTOFF)[0]
    return values


def _rows_in_force(outcome: Motion) -> Array:
    """Return 1 for rows in force and 0 for rows that are off, at all outputs, shape (k, m)."""
    info, status = outcome.compiled.info, outcome.status_columns
    held = np.ones((len(status), info.m))
    held[:, list(info.switchable)] = status[:, abi.N_STATUS + info.windings :: MODE_NUMBERS]
    return held


def _weighed_rows(outcome: Motion, t: float, y: Array) -> tuple[Array, Array]:
    """Return G^1/2 D^T R, shape (nv, m), and the diagonal of R, shape (m,): all of its entries have one unit.

    R scales angular rows by the mechanism's length, G scales angles by lengths of bodies, so norms and thresholds do
    not depend on units. Multipliers over R are forces.
    """
    compiled, w = outcome.compiled, outcome.w
    weights = np.array([w[abi.LENGTH] if row.unit == "rad" else 1.0 for row in compiled.info.rows])
    gauge = compiled.section(w, "gauge")
    return np.sqrt(gauge)[:, np.newaxis] * constraint_jacobian(outcome, t, y).T * weights, weights
