"""Multipliers and reaction forces from D at the outputs, computed when they are asked for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from symgen.describe.evaluate import evaluate
from symgen.result.acting import Acting, Seat, reaction_names
from symgen.result.labelled import Array, Labelled
from symgen.runtime import abi
from symgen.vocabulary.measures import GROUND

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.runtime.compiled import CompiledModel
    from symgen.runtime.outcome import Motion

#: Singular values of D^T below this fraction of the largest one count as zero.
CUTOFF = 1e-6
#: A multiplier direction that changes no acceleration and has more than this in a joint makes its reaction not unique.
_SHARE = 1e-8


def seats(mechanism: Mechanism, parameters: Mapping[str, float]) -> dict[str, Seat]:
    """Return where the reactions of all joints act, by name: at the points ``at`` of their first bodies."""
    markers, nothing = dict(mechanism.seats), (0.0,) * len(mechanism.gravity)
    found = dict[str, Seat]()
    for joint in mechanism.joints:
        body, place = joint.bodies[0], nothing
        if joint.name in markers:
            place = tuple(evaluate(e, parameters, f"joints.{joint.name}.at") for e in markers[joint.name].point)
            if body != GROUND:
                centre = (evaluate(e, parameters, f"bodies.{body}") for e in mechanism.body(body).centre_of_mass)
                place = tuple(x - c for x, c in zip(place, centre, strict=True))
        found[joint.name] = Seat(body, place)
    return found


@dataclass(frozen=True, repr=False)
class Forces:
    """What multipliers and reactions are computed from.

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
        return f"<Forces of {len(self.seats)} joints at {len(self.outcome.times)} outputs>"

    @property
    def compiled(self) -> CompiledModel:
        """The model that was run."""
        return self.outcome.compiled

    @property
    def redundant(self) -> bool:
        """Whether some rows depend on others at the start."""
        return self.outcome.start.rank < self.compiled.info.m

    def columns(self, table: str) -> tuple[str, ...]:
        """Return the names of multipliers (``lam``), of reactions or of their ``magnitudes``."""
        if table == "lam":
            return tuple(row.name for row in self.compiled.info.rows)
        parts, lengths = reaction_names({joint: seat.body for joint, seat in self.seats.items()}, self.compiled.info)
        return lengths if table == "magnitudes" else parts

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
            columns, _ = _weighed(self.outcome, self.outcome.start.t, self.outcome.start.y)
            left, singular, _ = np.linalg.svd(columns.T, full_matrices=True)
            rank = int(np.sum(singular > CUTOFF * singular.max(initial=0.0)))
            share = np.linalg.norm(left[:, rank:], axis=1)
            found |= {row.joint for row, x in zip(info.rows, share, strict=True) if x > _SHARE}
        return tuple(joint for joint in self.seats if joint in found)

    # -- reactions -----------------------------------------------------------------------------------------------------

    def reactions(self, multipliers: Labelled) -> Labelled:
        """Return -D^T lambda of each joint on its first body, at all outputs; see `Acting.reactions`."""
        return self._acting.reactions(self._entries(), multipliers.values)

    def in_body_axes(self, reactions: Labelled) -> Labelled:
        """Return reactions in the axes of the bodies that they act on."""
        return self._acting.in_body_axes(reactions)

    def magnitudes(self, reactions: Labelled) -> Labelled:
        """Return the lengths of the reactions' forces, and of their moments where these have several components."""
        return self._acting.magnitudes(reactions)

    @property
    def _acting(self) -> Acting:
        return Acting(self.compiled.info, self.seats, self.outcome.states)

    def _entries(self) -> Array:
        """Return the entries of D that vary at all outputs, as ``geometry`` leaves them."""
        from symgen.runtime.probe import Ready

        o, geometry = self.outcome, Ready(self.compiled.model.geometry, abi.MEASURE)
        w = o.w.copy()
        stored = self.compiled.section(w, "jacobian")
        values = np.empty((len(o.times), len(stored)))
        for k, t in enumerate(o.times):
            geometry(float(t), o.states[k], o.p, w)
            values[k] = stored
        return values


def jacobian(outcome: Motion, t: float, y: Array) -> Array:
    """Return D at one state, shape (m, nv)."""
    from symgen.runtime.probe import Ready

    w = outcome.w.copy()
    Ready(outcome.compiled.model.geometry, abi.MEASURE)(float(t), y.copy(), outcome.p, w)
    return outcome.compiled.jacobian(w)


def _minimum_norm(outcome: Motion) -> Array:
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


def _weighed(outcome: Motion, t: float, y: Array) -> tuple[Array, Array]:
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
