"""Multipliers and reaction forces from D at the outputs, computed when they are asked for."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from symgen.result.labelled import Array, Labelled
from symgen.runtime import abi
from symgen.vocabulary.measures import GROUND

if TYPE_CHECKING:
    from symgen.runtime.compiled import CompiledModel
    from symgen.runtime.run import Outcome

#: Singular values of D^T below this fraction of the largest one count as zero.
CUTOFF = 1e-6
#: A multiplier direction that changes no acceleration and has more than this in a joint makes its reaction not unique.
_SHARE = 1e-8

#: Velocity component -> label and unit of the generalised force that works on it.
_FORCE = {
    "vx": ("Fx", "N"),
    "vy": ("Fy", "N"),
    "vz": ("Fz", "N"),
    "omega": ("M", "N m"),
    "wx": ("Mx", "N m"),
    "wy": ("My", "N m"),
    "wz": ("Mz", "N m"),
}


@dataclass(frozen=True)
class Forces:
    """What multipliers and reactions are computed from.

    Attributes
    ----------
    outcome : Outcome
        States and raw multipliers at the outputs; its model gives D.
    joints : mapping
        Joint name -> name of its first body.
    """

    outcome: Outcome
    joints: Mapping[str, str]

    @property
    def compiled(self) -> CompiledModel:
        """The model that was run."""
        return self.outcome.compiled

    @property
    def redundant(self) -> bool:
        """Whether some rows depend on others at the start."""
        return self.outcome.start.rank < self.compiled.info.m

    # -- multipliers ---------------------------------------------------------------------------------------------------

    def multipliers(self) -> Labelled:
        """Return lambda at all outputs, of minimum norm where the rows of D are dependent."""
        values = _minimum_norm(self.outcome)
        rows = self.compiled.info.rows
        return Labelled(values, tuple(r.name for r in rows), tuple(multiplier_unit(r.unit) for r in rows))

    def final(self) -> dict[str, float]:
        """Return the multipliers at the last output by name; empty where there is no output."""
        o = self.outcome
        if not len(o.times):
            return {}
        # evaluated there alone: a run of which nothing else is asked need not evaluate every output again
        last = replace(o, times=o.times[-1:], states=o.states[-1:], status_columns=o.status_columns[-1:])
        values = _minimum_norm(last)[0]
        return {row.name: float(x) for row, x in zip(self.compiled.info.rows, values, strict=True)}

    @property
    def non_unique(self) -> tuple[str, ...]:
        """Joints whose reactions are not determined, in the order of the file."""
        info = self.compiled.info
        found = {name.partition(".")[0] for pair in info.dropped_rows for name in pair.split(" = ")}
        if self.redundant:
            columns, _ = _weighed(self.outcome, 0.0, self.outcome.start.y)
            left, singular, _ = np.linalg.svd(columns.T, full_matrices=True)
            rank = int(np.sum(singular > CUTOFF * singular.max(initial=0.0)))
            share = np.linalg.norm(left[:, rank:], axis=1)
            found |= {row.joint for row, x in zip(info.rows, share, strict=True) if x > _SHARE}
        return tuple(joint for joint in self.joints if joint in found)

    # -- reactions -----------------------------------------------------------------------------------------------------

    def reactions(self, multipliers: Labelled) -> Labelled:
        """Return -D^T lambda of each joint on its first body, at all outputs, as forces and moments in ground axes.

        Moments are about the body's centre of mass, on the ground about the origin.
        """
        info = self.compiled.info
        columns: dict[str, list[tuple[int, str]]] = {}
        for i, velocity in enumerate(info.velocities):
            body, _, component = velocity.name.rpartition(".")
            columns.setdefault(body, []).append((i, component))
        entries = self._entries()
        by_joint: dict[str, list[tuple[int, int, Array]]] = {joint: [] for joint in self.joints}
        for row, column, value in entries:
            by_joint[info.rows[row].joint].append((row, column, value))
        names, units, values = list[str](), list[str](), list[Array]()
        for joint, body in self.joints.items():
            generalised: dict[int, Array] = {}
            for row, column, value in by_joint[joint]:
                part = -value * multipliers.values[:, row]
                generalised[column] = generalised[column] + part if column in generalised else part
            if body == GROUND:
                found = self._on_ground(generalised, columns)
            else:
                found = self._on_body(body, generalised, columns[body])
            labels = {label: unit for label, unit in _FORCE.values()}
            for label, value in found.items():
                names.append(f"{joint}.{label}")
                units.append(labels[label])
                values.append(value)
        stacked = np.column_stack(values) if values else np.zeros((len(self.outcome.times), 0))
        return Labelled(stacked, tuple(names), tuple(units))

    def _on_ground(
        self, generalised: Mapping[int, Array], columns: Mapping[str, list[tuple[int, str]]]
    ) -> dict[str, Array]:
        """Return the reaction on the ground: what balances the joint's forces on all bodies, about the origin."""
        nothing = np.zeros(len(self.outcome.times))
        spatial = any(name == "vz" for indices in columns.values() for _, name in indices)
        total = dict.fromkeys(("Fx", "Fy", "Fz", "Mx", "My", "Mz") if spatial else ("Fx", "Fy", "M"), nothing)
        for body, indices in columns.items():
            if not any(i in generalised for i, _ in indices):
                continue
            part = self._on_body(body, generalised, indices)
            x, y, *rest = self._coordinates(body, "xyz" if spatial else "xy")
            part["M" + "z" * spatial] = part.get("M" + "z" * spatial, nothing) + x * part["Fy"] - y * part["Fx"]
            if spatial:
                part["Mx"] = part.get("Mx", nothing) + y * part["Fz"] - rest[0] * part["Fy"]
                part["My"] = part.get("My", nothing) + rest[0] * part["Fx"] - x * part["Fz"]
            for label in total:
                total[label] = total[label] - part[label]
        return total

    def _on_body(self, body: str, generalised: Mapping[int, Array], indices: list[tuple[int, str]]) -> dict[str, Array]:
        """Return force, and moment about the centre of mass, both in ground axes."""
        nothing = np.zeros(len(self.outcome.times))
        found = {_FORCE[c][0]: generalised.get(i, nothing) for i, c in indices}
        if "Mx" in found:  # works on angular velocities in body axes
            real, *vector = self._coordinates(body, ("e0", "e1", "e2", "e3"))
            e, moment = np.stack(vector, axis=1), np.stack([found[f"M{c}"] for c in "xyz"], axis=1)
            real = real[:, np.newaxis]
            square = real**2 + np.sum(e * e, axis=1, keepdims=True)
            once = np.cross(e, moment)
            turned = moment + 2.0 * (real * once + np.cross(e, once)) / square
            found |= dict(zip(("Mx", "My", "Mz"), turned.T, strict=True))
        return found

    def _coordinates(self, body: str, names: Iterable[str]) -> list[Array]:
        """Return coordinates of a body at the outputs."""
        known = {quantity.name: i for i, quantity in enumerate(self.compiled.info.coordinates)}
        return [self.outcome.states[:, known[f"{body}.{name}"]] for name in names]

    def _entries(self) -> list[tuple[int, int, Array]]:
        """Return (row, column, values at all outputs) of D's structural entries."""
        from symgen.runtime.probe import Ready

        o, geometry = self.outcome, Ready(self.compiled.model.geometry, abi.MEASURE)
        w = o.w.copy()
        stored = self.compiled.section(w, "jacobian")
        values = np.empty((len(o.times), len(stored)))
        for k, t in enumerate(o.times):
            geometry(float(t), o.states[k], o.p, w)
            values[k] = stored
        constant = np.ones(len(o.times))
        return [
            (row, column, constant * (number or 0.0) if slot is None else values[:, slot])
            for row, column, number, slot in self.compiled.info.jacobian
        ]


def jacobian(outcome: Outcome, t: float, y: Array) -> Array:
    """Return D at one state, shape (m, nv)."""
    from symgen.runtime.probe import Ready

    w = outcome.w.copy()
    Ready(outcome.compiled.model.geometry, abi.MEASURE)(float(t), y.copy(), outcome.p, w)
    return outcome.compiled.jacobian(w)


def _minimum_norm(outcome: Outcome) -> Array:
    """Return the multipliers at all outputs, shape (k, m), of minimum norm where the rows of D are dependent."""
    m = outcome.compiled.info.m
    dependent = (outcome.status_columns[:, abi.RANK] < m) | (outcome.start.rank < m)
    values = outcome.multipliers.copy()
    usable = np.isfinite(values).all(axis=1) & np.isfinite(outcome.states).all(axis=1)
    for k in np.flatnonzero(dependent & usable):
        columns, weights = _weighed(outcome, float(outcome.times[k]), outcome.states[k])
        forces = values[k] / weights
        values[k] = weights * np.linalg.lstsq(columns, columns @ forces, rcond=CUTOFF)[0]
    return values


def _weighed(outcome: Outcome, t: float, y: Array) -> tuple[Array, Array]:
    """Return G^1/2 D^T R, shape (nv, m), and the diagonal of R, shape (m,): all of its entries have one unit.

    R makes lengths of rows that are angles, by the mechanism's length; G makes lengths of angles, by those of bodies:
    what has a norm, or is small, is so in all units. Multipliers over R are forces.
    """
    compiled, w = outcome.compiled, outcome.w
    weights = np.array([w[abi.LENGTH] if row.unit == "rad" else 1.0 for row in compiled.info.rows])
    gauge = compiled.section(w, "gauge")
    return np.sqrt(gauge)[:, np.newaxis] * jacobian(outcome, t, y).T * weights, weights


def multiplier_unit(row_unit: str) -> str:
    """Return the unit of a multiplier whose row is measured in `row_unit`: lambda times the row is work or power."""
    return {"m": "N", "m/s": "N", "rad": "N m", "rad/s": "N m"}.get(row_unit, f"J/({row_unit})")
