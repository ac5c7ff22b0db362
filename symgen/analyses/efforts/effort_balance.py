"""Efforts of actuators along a recorded motion: the balance of what they do with what the motion requires.

The emitted right-hand side is evaluated without efforts and with an effort of 1 of each actuator. Accelerations and
multipliers are linear in efforts, so that a small least-squares problem at every time yields the efforts of the motion.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.efforts.actuators import WHERE, Actuator
from symgen.analyses.efforts.forces_at_bounds import Contacts
from symgen.analyses.efforts.least_efforts import efforts_within_limits
from symgen.base import arguments
from symgen.base.errors import InputError, quote, suggest
from symgen.derive.lower.windings import winding_order
from symgen.describe.facts.lengths import origin_of_sizes
from symgen.describe.formulas.evaluate import parameter_values, scalar_values
from symgen.describe.mechanism import Mechanism
from symgen.result.saved import Recorded
from symgen.result.signals import acceleration_name
from symgen.run.compiling.side import compile_side
from symgen.run.layout import abi
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import make_plan
from symgen.run.planning.starts import close_with_light_bodies, compiled_for
from symgen.run.single.outcome import PrescribedMotion
from symgen.run.starts.assembly import assemble

if TYPE_CHECKING:
    from symgen.base.settings import Settings
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.starts.assembly import Start


Array = NDArray[np.float64]

#: Singular values of what efforts do to accelerations, each by its own size, below this part of the largest one
#: count as zero; so does what an effort does below this part of the largest that one does, or of what is without any.
CUTOFF, SILENT = 1e-9, 1e-13
#: Accelerations that no effort produces are reported from this part of the largest one on.
MISSING = 1e-6
#: Two evaluations with efforts of 1 and 2 show whether accelerations are linear in an input.
LINEAR = 1e-9


@dataclass(frozen=True)
class Balanced:
    """A motion with the efforts of its actuators; arrays have one row a time.

    Attributes
    ----------
    motion : PrescribedMotion
        With the multipliers that belong to the efforts.
    efforts : Array, shape (k, n)
        Of the actuators.
    rates : Array, shape (k, r)
        Of the actuators that have one.
    missing : Array, shape (k,)
        Largest acceleration that no effort produces [m/s^2], angles by the bodies' lengths.
    notes : list of str
        Sentences on efforts that are not unique and accelerations that no effort produces.
    lowest, highest : Array, shape (k, n)
        Of each effort alone, where friction at rest and closed stops leave a range.
    """

    motion: PrescribedMotion
    efforts: Array
    rates: Array
    missing: Array
    notes: list[str]
    lowest: Array
    highest: Array


def balance_efforts(
    mechanism: Mechanism,
    actuators: tuple[Actuator, ...],
    settings: Settings,
    record: Recorded,
    weights: Mapping[str, float] | None,
    contacts: Contacts,
) -> Balanced:
    """Return the efforts of actuators in a recorded motion.

    Parameters
    ----------
    mechanism, actuators
        From `actuated`.
    settings : Settings
        Of the mechanism, inputs put in place.
    record : Recorded
        The motion.
    weights : mapping of str to float, optional
        Of efforts that are not unique, by actuators.
    contacts : Contacts
        Rows with bounds whose forces are inputs of the mechanism.

    Raises
    ------
    InputError
        If the motion is not one of the mechanism, an input is not one that efforts are proportional to, or a weight is
        wrong.
    """
    weights, names = (
        arguments.mapping("weights", weights, "numbers by the names of actuators"),
        [a.name for a in actuators],
    )
    for name, value in weights.items():
        if name not in names:
            raise InputError("weights", "the name of an actuator", quote(name), suggest(name, names))
        arguments.number(f"weights '{name}'", value, positive=True)
    still, *others = _motions_with_unit_efforts(mechanism, actuators, contacts.parameters, settings, record)
    length, count = float(still.start.w[abi.LENGTH]), len(actuators)
    weighed = np.array([float(weights.get(a.name, 1.0 / length if a.turning else 1.0)) for a in actuators])
    found = _solve_with_contacts(mechanism, still, others, weighed, contacts)
    efforts, missing, ranks = found.efforts, found.missing, found.ranks
    motion = replace(still, prescribed_multipliers=found.multipliers)
    formulas = [(f"{a.name}.rate", a.rate) for a in actuators if a.rate is not None]
    rates = np.zeros((len(motion.times), 0))
    if formulas:
        side = compile_side(mechanism, motion.compiled, "rates", "rates of what actuators work along", formulas)
        rates = motion.observe_motion(side.function, len(formulas))
    notes, rank = found.sentences, int(ranks.max(initial=0))
    if rank < count:
        how = "weighted as asked" if weights else "torques over the mechanism's length"
        several = "1 actuator moves" if count == 1 else f"{count} actuators move"
        degrees = "1 degree" if rank == 1 else f"{rank} degrees"
        notes.append(f"{several} {degrees} of freedom: efforts are those of minimum norm, {how}")
    if np.any(ranks < rank):
        t = motion.times[int(np.argmax(ranks < rank))]
        notes.append(f"at t = {t:.6g} s actuators move less than elsewhere: efforts are those of minimum norm")
    scale = 1.0 / np.sqrt(motion.compiled.section(motion.w, "gauge"))
    largest = float(np.abs(motion.accelerations * scale).max(initial=0.0))
    if missing.max(initial=0.0) > MISSING * max(largest, 1e-300):
        k = int(np.argmax(missing))
        what = f"at t = {motion.times[k]:.6g} s an acceleration of {missing[k]:.3g} m/s^2 is left"
        notes.append(f"these actuators alone do not give the motion: {what}")
    return Balanced(motion, efforts, rates, missing, notes, found.lowest, found.highest)


@dataclass(frozen=True)
class _Found:
    """Efforts, accelerations left, degrees of freedom moved, multipliers, the range of efforts, and sentences."""

    efforts: Array
    missing: Array
    ranks: NDArray[np.int64]
    multipliers: Array
    lowest: Array
    highest: Array
    sentences: list[str]


def _solve_with_contacts(
    mechanism: Mechanism,
    still: PrescribedMotion,
    others: list[PrescribedMotion],
    weighed: Array,
    contacts: Contacts,
) -> _Found:
    """Return the efforts beside the forces of `contacts`."""
    count, first = len(weighed), len(weighed) + len(contacts.sliding)
    base = still.responses
    ways = [other.responses.multipliers - base.multipliers for other in others]

    def multipliers_of_columns(efforts: Array, columns: Sequence[int]) -> Array:
        found: Array = base.multipliers + sum(ways[j] * efforts[:, [i]] for i, j in enumerate(columns))
        return found

    efforts, missing, ranks = _solve_efforts(still, others[:count], weighed)
    if not contacts.rows:
        return _Found(efforts, missing, ranks, multipliers_of_columns(efforts, range(count)), efforts, efforts, [])
    along = contacts.contacts_along_motion(mechanism, still, float(still.start.w[abi.LENGTH]) or 1.0)
    pushes = [other.responses.accelerations - base.accelerations for other in others[count:first]]
    loads = others[first:]
    scale = 1.0 / np.sqrt(still.compiled.section(still.start.w, "gauge"))
    effects, by_forces = (
        np.stack([x.responses.accelerations - base.accelerations for x in some], axis=-1) * scale[:, np.newaxis]
        if some
        else np.zeros((*base.accelerations.shape, 0))
        for some in (others[:count], loads)
    )
    lowest = highest = efforts

    def solve(forces: Array, ranged: bool = False) -> Array:
        nonlocal efforts, missing, lowest, highest
        pushed = sum((a * forces[:, [i]] for i, a in enumerate(pushes)), np.zeros_like(base.accelerations))
        efforts, missing, _ = _solve_efforts(still, others[:count], weighed, pushed)
        lowest, highest, held = efforts.copy(), efforts.copy(), np.zeros((len(still.times), len(loads)))
        goals = (still.prescribed_accelerations - base.accelerations - pushed) * scale
        for k in np.flatnonzero(along.limited):
            x = efforts_within_limits(effects[k], by_forces[k], goals[k], weighed, along.limits_at(int(k)), ranged)
            efforts[k], held[k], lowest[k], highest[k], missing[k] = x.efforts, x.forces, x.lowest, x.highest, x.missing
        return multipliers_of_columns(np.column_stack([efforts, forces, held]), range(len(others)))

    forces, sentences = along.solve_forces(solve)
    lam = solve(forces, ranged=True)
    return _Found(efforts, missing, ranks, lam, lowest, highest, sentences)


def _motions_with_unit_efforts(
    mechanism: Mechanism,
    actuators: tuple[Actuator, ...],
    loads: tuple[str, ...],
    settings: Settings,
    record: Recorded,
) -> list[PrescribedMotion]:
    """Return the motion without efforts, then with an effort of 1 of each actuator, then with each load of 1."""
    plan = make_plan(mechanism, settings, Purpose.STATE)
    values, code = parameter_values(mechanism, settings.parameters), compiled_for(mechanism, plan.choice)
    info = code.info
    q, v = (record.table((c.name, c.unit) for c in of) for of in (info.coordinates, info.velocities))
    a = record.table((acceleration_name(c.name), f"{c.unit}^2") for c in info.velocities)
    instant, datum = (float(record.t[0]), ()), origin_of_sizes(mechanism, scalar_values(values))

    def close_start(compiled: CompiledModel, ask_light: bool) -> Start:
        p = compiled.parameter_array(values, plan.method_parameters)
        return assemble(compiled, q[0].copy(), list(v[0]), p, False, None, ask_light, None, instant, datum)

    compiled, start = close_with_light_bodies(plan, code, close_start)
    states = np.zeros((len(record.t), info.ny))
    states[:, : info.nq], states[:, info.nq : info.work] = q, v
    states[:, info.own_states] = record.table((x.name, x.unit) for x in info.states)
    # angles that count turns are those that joints have reported
    status = np.full((len(record.t), abi.N_STATUS + info.windings), np.nan)
    names = {m: f"{joint.name}.{label}" for joint in mechanism.joints for label, m in joint.coordinates}
    for i, measure in enumerate(winding_order(mechanism, compiled.shape)):
        turned = names.get(measure, "")
        status[:, abi.N_STATUS + i] = record.column(turned, "rad") if turned in record.columns else np.nan
    still = PrescribedMotion(
        times=np.array(record.t),  # of files it is read-only
        states=states,
        status_columns=status,
        compiled=compiled,
        start=start,
        p=start.p,
        w=start.w,
        prescribed_accelerations=a,
    )
    still = replace(still, status_columns=still.measure_motion())
    places = {parameter.name: i for i, parameter in enumerate(info.parameters)}

    def parameters_with_effort(parameter: str, value: float) -> PrescribedMotion:
        other = start.p.copy()
        other[places[parameter]] = value
        compiled.prepare(other)
        return replace(still, p=other)

    for actuator in actuators:
        still.p[places[actuator.parameter]] = 0.0
    compiled.prepare(still.p)  # numbers hoisted from an input whose default is not 0
    ones = [parameters_with_effort(actuator.parameter, 1.0) for actuator in actuators]
    none = still.responses.accelerations
    for actuator, one in zip(actuators, ones, strict=True):
        if actuator.rate is None:
            once = one.responses.accelerations - none
            twice = parameters_with_effort(actuator.parameter, 2.0).responses.accelerations - none
            if not np.abs(twice - 2.0 * once).max() <= LINEAR * np.abs(once).max(initial=1e-300):
                raise InputError(WHERE, "inputs that efforts are proportional to", quote(actuator.name))
    return [still, *ones, *(parameters_with_effort(name, 1.0) for name in loads)]


def _solve_efforts(
    still: PrescribedMotion,
    others: list[PrescribedMotion],
    weighed: Array,
    pushed: Array | float = 0.0,
) -> tuple[Array, Array, NDArray[np.int64]]:
    """Return efforts, shape (k, n), the accelerations left, shape (k,), and degrees of freedom moved.

    `pushed` are accelerations by other forces.
    """
    scale = 1.0 / np.sqrt(still.compiled.section(still.start.w, "gauge"))
    base = still.responses.accelerations
    effects = np.stack([other.responses.accelerations - base for other in others], axis=-1)
    effects = effects * scale[:, np.newaxis]
    goals = (still.prescribed_accelerations - base - pushed) * scale
    # a motor of a crane and one of a watch: whether efforts are told apart does not depend on what they move
    sizes = np.linalg.norm(effects, axis=1)
    silent = sizes <= SILENT * np.maximum(sizes.max(axis=1), np.linalg.norm(base * scale, axis=1))[:, np.newaxis]
    effects, sizes = np.where(silent[:, np.newaxis], 0.0, effects), np.where(silent, 1.0, sizes)
    left, singular, right = np.linalg.svd(effects / sizes[:, np.newaxis], full_matrices=False)
    regular = singular > CUTOFF * singular.max(axis=1, initial=0.0)[:, np.newaxis]
    inverses = np.where(regular, 1.0 / np.where(regular, singular, 1.0), 0.0)
    parts = np.einsum("kij,ki->kj", left, goals) * inverses
    efforts = np.einsum("kji,kj->ki", right, parts) / sizes
    ranks = regular.sum(axis=1)
    for k in np.flatnonzero(ranks < len(weighed)):
        efforts[k] -= _efforts_without_effect(right[k][regular[k]], sizes[k], weighed, efforts[k])
    rest = goals - np.einsum("kij,kj->ki", effects, efforts)
    return efforts, np.abs(rest).max(axis=1), ranks


def _efforts_without_effect(felt: Array, sizes: Array, weighed: Array, efforts: Array) -> Array:
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
