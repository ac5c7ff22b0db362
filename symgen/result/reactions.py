"""Multipliers and reaction forces from D at the outputs, computed when they are asked for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from symgen.model import CompiledModel
from symgen.result.labelled import Array, Labelled
from symgen.vocabulary.measures import GROUND

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
    compiled : CompiledModel
        Gives D through its ``geometry``.
    joints : mapping
        Joint name -> name of its first body.
    times, states, raw : Array, shapes (k,), (k, ny), (k, m)
        Outputs, and the multipliers as the method computed them.
    ranks : Array, shape (k,)
        Rows kept at each output.
    p, w : Array
        Prepared parameters and scratch.
    start : Array, shape (ny,)
        Where the run began.
    rank : int
        Rank of D there.
    """

    compiled: CompiledModel
    joints: Mapping[str, str]
    times: Array
    states: Array
    raw: Array
    ranks: Array
    p: Array
    w: Array
    start: Array
    rank: int

    @property
    def redundant(self) -> bool:
        """Whether some rows depend on others at the start."""
        return self.rank < self.compiled.info.m

    # -- multipliers ---------------------------------------------------------------------------------------------------

    def multipliers(self) -> Labelled:
        """Return lambda at all outputs, of minimum norm where the rows of D are dependent."""
        values = self.raw.copy()
        for k in np.flatnonzero(self._dependent()):
            values[k] = self._minimum_norm(int(k))
        info = self.compiled.info
        units = tuple(_multiplier_unit(row.unit) for row in info.rows)
        return Labelled(values, tuple(row.name for row in info.rows), units)

    def final(self) -> dict[str, float]:
        """Return the multipliers at the last output by name; empty where there is no output."""
        if not len(self.times):
            return {}
        last = len(self.times) - 1
        values = self._minimum_norm(last) if self._dependent()[last] else self.raw[last]
        return {row.name: float(x) for row, x in zip(self.compiled.info.rows, values, strict=True)}

    def _dependent(self) -> Array:
        mask = np.full(len(self.times), self.redundant) | (self.ranks < self.compiled.info.m)
        return np.asarray(mask & np.isfinite(self.raw).all(axis=1) & np.isfinite(self.states).all(axis=1))

    def _minimum_norm(self, k: int) -> Array:
        transposed = self.jacobian(self.times[k], self.states[k]).T
        return np.asarray(np.linalg.lstsq(transposed, transposed @ self.raw[k], rcond=CUTOFF)[0])

    @property
    def non_unique(self) -> tuple[str, ...]:
        """Joints whose reactions are not determined, in the order of the file."""
        info = self.compiled.info
        found = {name.partition(".")[0] for pair in info.dropped_rows for name in pair.split(" = ")}
        if self.redundant:
            d = self.jacobian(0.0, self.start)
            left, singular, _ = np.linalg.svd(d, full_matrices=True)
            rank = int(np.sum(singular > CUTOFF * singular.max(initial=0.0)))
            share = np.linalg.norm(left[:, rank:], axis=1)
            found |= {row.joint for row, x in zip(info.rows, share, strict=True) if x > _SHARE}
        return tuple(joint for joint in self.joints if joint in found)

    # -- reactions -----------------------------------------------------------------------------------------------------

    def reactions(self, multipliers: Labelled) -> Labelled:
        """Return -D^T lambda of each joint on its first body, at all outputs."""
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
            generalised = {}
            for row, column, value in by_joint[joint]:
                part = -value * multipliers.values[:, row]
                generalised[column] = generalised[column] + part if column in generalised else part
            if body == GROUND:
                found = self._on_ground(generalised, columns)
            else:
                nothing = np.zeros(len(self.times))
                found = {_FORCE[c][0]: generalised.get(i, nothing) for i, c in columns[body]}
            labels = {label: unit for label, unit in _FORCE.values()}
            for label, value in found.items():
                names.append(f"{joint}.{label}")
                units.append(labels[label])
                values.append(value)
        stacked = np.column_stack(values) if values else np.zeros((len(self.times), 0))
        return Labelled(stacked, tuple(names), tuple(units))

    def _on_ground(self, generalised: Mapping[int, Array], columns: Mapping[str, list[tuple[int, str]]]) -> dict[str, Array]:
        """Return the reaction on the ground: what balances the joint's forces on all bodies, about the origin."""
        nothing = np.zeros(len(self.times))
        total = {"Fx": nothing, "Fy": nothing, "M": nothing}
        for indices in columns.values():
            part = {_FORCE[c][0]: generalised.get(i, nothing) for i, c in indices}
            if not any(i in generalised for i, _ in indices):
                continue
            x, y = self.states[:, indices[0][0]], self.states[:, indices[1][0]]  # planar: q and v have the same order
            moment = part.get("M", nothing) + x * part["Fy"] - y * part["Fx"]
            total = {
                "Fx": total["Fx"] - part["Fx"],
                "Fy": total["Fy"] - part["Fy"],
                "M": total["M"] - moment,
            }
        return total

    # -- the Jacobian --------------------------------------------------------------------------------------------------

    def jacobian(self, t: float, y: Array) -> Array:
        """Return D at one state, shape (m, nv)."""
        from symgen.runtime.probe import call_measure

        w = self.w.copy()
        call_measure(self.compiled.model.geometry, float(t), y.copy(), self.p, w)
        return self.compiled.jacobian(w)

    def _entries(self) -> list[tuple[int, int, Array]]:
        """Return (row, column, values at all outputs) of D's structural entries."""
        from symgen.runtime.probe import call_measure

        w = self.w.copy()
        stored = self.compiled.section(w, "jacobian")
        values = np.empty((len(self.times), len(stored)))
        for k, t in enumerate(self.times):
            call_measure(self.compiled.model.geometry, float(t), self.states[k], self.p, w)
            values[k] = stored
        constant = np.ones(len(self.times))
        return [
            (row, column, constant * (number or 0.0) if slot is None else values[:, slot])
            for row, column, number, slot in self.compiled.info.jacobian
        ]


def _multiplier_unit(row_unit: str) -> str:
    """Return the unit of a multiplier whose row is measured in `row_unit`: lambda times the row is work or power."""
    return {"m": "N", "m/s": "N", "rad": "N m", "rad/s": "N m"}.get(row_unit, f"J/({row_unit})")
