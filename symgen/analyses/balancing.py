"""The balance of forces along a recorded motion: what its actuators exert, from what each does to accelerations.

The emitted right-hand side is evaluated without efforts and with an effort of 1 of each actuator; accelerations and
multipliers are linear in efforts, so that a small problem of least squares at every time says what gives the motion.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen import arguments
from symgen.analyses.actuators import WHERE, Actuated, Actuator
from symgen.compiling.side import compile_side
from symgen.describe.columns import PREFIX
from symgen.describe.evaluate import parameter_values
from symgen.errors import InputError, nearest, quoted
from symgen.lower.windings import winding_order
from symgen.result.result import accelerations_of
from symgen.result.saved import Recorded
from symgen.running.plan import Purpose
from symgen.running.prepare import make_plan
from symgen.running.starts import closed_by, compiled_for
from symgen.runtime import abi
from symgen.runtime.assembly import assemble
from symgen.runtime.outcome import PrescribedMotion

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.runtime.assembly import Start
    from symgen.runtime.compiled import CompiledModel
    from symgen.settings import Settings

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

#: Singular values of what efforts do to accelerations, each by its own size, below this part of the largest one
#: count as zero; so does what an effort does below this part of the largest that one does, or of what is without any.
CUTOFF, SILENT = 1e-9, 1e-13
#: Accelerations that no effort gives are said from this part of the largest one on.
MISSING = 1e-6
#: Two evaluations with efforts of 1 and 2 show whether accelerations are linear in an input.
LINEAR = 1e-9


@dataclass(frozen=True)
class Balanced:
    """A motion with what its actuators exert; arrays have one row a time.

    Attributes
    ----------
    motion : PrescribedMotion
        With the multipliers that belong to the efforts.
    efforts : Array, shape (k, n)
        Of the actuators.
    rates : Array, shape (k, r)
        Of what those work along that have a rate.
    missing : Array, shape (k,)
        Largest acceleration that no effort gives [m/s^2], angles by the bodies' lengths.
    ranks : Array of int, shape (k,)
        Degrees of freedom that the actuators move.
    """

    motion: PrescribedMotion
    efforts: Array
    rates: Array
    missing: Array
    ranks: Integers

    def said(self, weighted: bool) -> list[str]:
        """Return what is not unique, and what no effort gives, in sentences."""
        notes, count, rank = list[str](), self.efforts.shape[1], int(self.ranks.max(initial=0))
        if rank < count:
            how = "weighted as asked" if weighted else "torques over the mechanism's length"
            several = "1 actuator moves" if count == 1 else f"{count} actuators move"
            degrees = "1 degree" if rank == 1 else f"{rank} degrees"
            notes.append(f"{several} {degrees} of freedom: efforts are those of minimum norm, {how}")
        if np.any(self.ranks < rank):
            t = self.motion.times[int(np.argmax(self.ranks < rank))]
            notes.append(f"at t = {t:.6g} s actuators move less than elsewhere: efforts are those of minimum norm")
        scale = 1.0 / np.sqrt(self.motion.compiled.section(self.motion.w, "gauge"))
        largest = float(np.abs(self.motion.accelerations * scale).max(initial=0.0))
        if self.missing.max(initial=0.0) > MISSING * max(largest, 1e-300):
            k = int(np.argmax(self.missing))
            at, left = self.motion.times[k], self.missing[k]
            what = f"at t = {at:.6g} s an acceleration of {left:.3g} m/s^2 is left"
            notes.append(f"these actuators alone do not give the motion: {what}")
        return notes


def balance(made: Actuated, settings: Settings, found: Recorded, weights: Mapping[str, float]) -> Balanced:
    """Return what actuators exert in a recorded motion.

    Parameters
    ----------
    made : Actuated
        The mechanism with its actuators.
    settings : Settings
        Of the mechanism, inputs put in place.
    found : Recorded
        The motion.
    weights : mapping of str to float
        From `checked_weights`.

    Raises
    ------
    InputError
        If the motion is not one of the mechanism, or an input is not one that efforts are proportional to.
    """
    still, *others = _motions(made, settings, found)
    efforts, missing, ranks = _solved(made, still, others, weights)
    base = still.responses.multipliers
    lam = base + sum((o.responses.multipliers - base) * efforts[:, [j]] for j, o in enumerate(others))
    motion = replace(still, found=lam)
    return Balanced(motion, efforts, _rates(made, motion), missing, ranks)


def checked_weights(made: Actuated, weights: Mapping[str, float] | None) -> dict[str, float]:
    """Return the weights of actuators that are given.

    Raises
    ------
    InputError
        If a name is no actuator, or a weight not above 0.
    """
    given = arguments.mapping("weights", weights, "numbers by the names of actuators")
    known = [a.name for a in made.actuators]
    for name, value in given.items():
        if name not in known:
            raise InputError("weights", "the name of an actuator", quoted(name), nearest(name, known))
        arguments.number(f"weights '{name}'", value, positive=True)
    return {name: float(value) for name, value in given.items()}


def _motions(made: Actuated, settings: Settings, found: Recorded) -> list[PrescribedMotion]:
    """Return the motion without efforts, with an effort of 1 of each, and of 2 of each input."""
    mechanism = made.mechanism
    plan = make_plan(mechanism, settings, Purpose.STATE)
    values, code = parameter_values(mechanism, settings.parameters), compiled_for(mechanism, plan.choice)
    info = code.info
    velocities = [v.name for v in info.velocities]
    q, v = found.table([c.name for c in info.coordinates]), found.table(velocities)
    a = found.table(accelerations_of(velocities))
    instant = (float(found.t[0]), ())

    def close(compiled: CompiledModel, ask_light: bool) -> Start:
        p = compiled.parameter_array(values, plan.method_parameters)
        return assemble(compiled, q[0].copy(), list(v[0]), p, False, None, ask_light, None, instant)

    compiled, start = closed_by(plan, code, close)
    states = np.zeros((len(found.t), info.ny))
    states[:, : info.nq], states[:, info.nq : info.work] = q, v
    still = PrescribedMotion(
        times=np.array(found.t),  # of files it is read-only
        states=states,
        status_columns=_turned(mechanism, compiled, found),
        compiled=compiled,
        start=start,
        p=start.p,
        w=start.w,
        given=a,
    )
    still = replace(still, status_columns=still.measured())
    places = {parameter.name: i for i, parameter in enumerate(info.parameters)}

    def with_effort(actuator: Actuator, value: float) -> PrescribedMotion:
        other = start.p.copy()
        other[places[actuator.parameter]] = value
        compiled.prepare(other)
        return replace(still, p=other)

    for actuator in made.actuators:
        still.p[places[actuator.parameter]] = 0.0
    motions = [still, *(with_effort(actuator, 1.0) for actuator in made.actuators)]
    for actuator, one in zip(made.actuators, motions[1:], strict=True):
        if actuator.rate is None:
            none, once = still.responses.accelerations, one.responses.accelerations - still.responses.accelerations
            twice = with_effort(actuator, 2.0).responses.accelerations - none
            if not np.abs(twice - 2.0 * once).max() <= LINEAR * np.abs(once).max(initial=1e-300):
                raise InputError(WHERE, "inputs that efforts are proportional to", quoted(actuator.name))
    return motions


def _turned(mechanism: Mechanism, compiled: CompiledModel, found: Recorded) -> Array:
    """Return room for the status of a motion, with those angles that count turns that joints have reported."""
    status = np.full((len(found.t), abi.N_STATUS + compiled.info.windings), np.nan)
    prefix = PREFIX["joint_coordinates"]
    names = {m: f"{prefix}{joint.name}.{label}" for joint in mechanism.joints for label, m in joint.coordinates}
    for i, measure in enumerate(winding_order(mechanism, compiled.shape)):
        known = found.columns.get(names.get(measure, ""))
        if known is not None:
            status[:, abi.N_STATUS + i] = known
    return status


def _solved(
    made: Actuated, still: PrescribedMotion, others: list[PrescribedMotion], weights: Mapping[str, float]
) -> tuple[Array, Array, Integers]:
    """Return efforts, shape (k, n), the largest acceleration that is left, and how many efforts are told apart."""
    w, compiled = still.start.w, still.compiled
    scale = 1.0 / np.sqrt(compiled.section(w, "gauge"))
    length = float(w[abi.LENGTH])
    weighed = np.array([weights.get(a.name, 1.0 / length if a.turning else 1.0) for a in made.actuators])
    base = still.responses.accelerations
    effects = np.stack([other.responses.accelerations - base for other in others], axis=-1)
    effects = effects * scale[:, np.newaxis]
    wanted = (still.given - base) * scale
    # a motor of a crane and one of a watch: whether efforts are told apart does not depend on what they move
    sizes = np.linalg.norm(effects, axis=1)
    silent = sizes <= SILENT * np.maximum(sizes.max(axis=1), np.linalg.norm(base * scale, axis=1))[:, np.newaxis]
    effects, sizes = np.where(silent[:, np.newaxis], 0.0, effects), np.where(silent, 1.0, sizes)
    left, singular, right = np.linalg.svd(effects / sizes[:, np.newaxis], full_matrices=False)
    kept = singular > CUTOFF * singular.max(axis=1, initial=0.0)[:, np.newaxis]
    inverses = np.where(kept, 1.0 / np.where(kept, singular, 1.0), 0.0)
    parts = np.einsum("kij,ki->kj", left, wanted) * inverses
    efforts = np.einsum("kji,kj->ki", right, parts) / sizes
    ranks = kept.sum(axis=1)
    for k in np.flatnonzero(ranks < len(weighed)):
        efforts[k] -= _unfelt(right[k][kept[k]], sizes[k], weighed, efforts[k])
    rest = wanted - np.einsum("kij,kj->ki", effects, efforts)
    return efforts, np.abs(rest).max(axis=1), ranks


def _unfelt(felt: Array, sizes: Array, weighed: Array, efforts: Array) -> Array:
    """Return the part of efforts that does nothing and whose absence leaves the least sum of weighted squares.

    Parameters
    ----------
    felt : Array, shape (r, n)
        Orthonormal efforts, each by the size of what it does, that are told apart.
    sizes, weighed, efforts : Array, shape (n,)
        These sizes, the weights, and the efforts.
    """
    n = len(sizes)
    silent = np.linalg.svd(felt, full_matrices=True)[2][len(felt) :] if len(felt) else np.eye(n)
    basis = np.linalg.qr((silent / sizes * weighed).T)[0]
    return np.asarray(basis @ (basis.T @ (weighed * efforts)) / weighed)


def _rates(made: Actuated, motion: PrescribedMotion) -> Array:
    """Return the rates of what actuators work along, shape (k, n)."""
    formulas = [(f"{a.name}.rate", a.rate) for a in made.actuators if a.rate is not None]
    if not formulas:
        return np.zeros((len(motion.times), 0))
    side = compile_side(made.mechanism, motion.compiled, "rates", "rates of what actuators work along", formulas)
    return motion.observed(side.function, len(formulas))
