"""Mechanisms whose freedom is all driven: made ready to be followed, or refused in one sentence."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from symgen.describe.evaluate import parameter_values, scalars
from symgen.describe.mechanism import AnyBody, Mechanism, SpatialBody
from symgen.describe.start import described_start
from symgen.errors import AssemblyError, InputError, nearest
from symgen.running.inputs import put_inputs
from symgen.running.plan import Plan, Purpose
from symgen.running.prepare import assemble, make_plan
from symgen.running.starts import compiled_for, start_of
from symgen.runtime import abi
from symgen.runtime.probe import Ready
from symgen.runtime.stops import stops_of
from symgen.vocabulary.expressions import readings
from symgen.vocabulary.measures import GROUND, Integral

if TYPE_CHECKING:
    from collections.abc import Sequence

    from symgen.runtime.assembly import Start
    from symgen.runtime.compiled import CompiledModel
    from symgen.settings import Settings

Array = NDArray[np.float64]

#: Singular values below this part of the largest one count as zero, and parts of a direction below this one's largest.
CUTOFF = 1e-9
DRIVER = "driver"
#: Coordinates of joints on the ground, where motors sit, are named rather than others.
ON_GROUND = 10.0
#: Places that a mechanism is closed from, and those behind the last new way after which no more are looked for.
TRIES, ENOUGH = 200, 40
#: Positions as near as this are one, in lengths of the mechanism and radians.
SAME_WAY = 1e-6


@dataclass(frozen=True)
class PrescribedRun:
    """A mechanism that is ready to be followed.

    Attributes
    ----------
    mechanism : Mechanism
        With its inputs put in place, without outputs that are integrals.
    compiled, start : CompiledModel, Start
        Its code, and its consistent start at t = 0.
    parameters : mapping
        Values of all parameters, as a run is given them.
    held : tuple of (float, Array)
        Parameters of earlier stops, see `symgen.runtime.outcome.Motion`.
    p : Array
        Parameters of the last stop.
    told : mapping
        Inputs in words, or their numbers.
    notes : tuple of str
        What was settled on the way.
    """

    mechanism: Mechanism
    compiled: CompiledModel
    start: Start
    parameters: dict[str, float]
    held: tuple[tuple[float, Array], ...]
    p: Array
    told: dict[str, str | float]
    notes: tuple[str, ...]


def drivers_of(mechanism: Mechanism) -> tuple[str, ...]:
    """Return the names of all drivers."""
    return tuple(joint.name for joint in mechanism.joints if joint.kind == DRIVER)


def without(mechanism: Mechanism, names: Sequence[str]) -> Mechanism:
    """Return a mechanism without some of its joints."""
    joints = tuple(joint for joint in mechanism.joints if joint.name not in names)
    seats = tuple((name, marker) for name, marker in mechanism.seats if name not in names)
    return msgspec.structs.replace(mechanism, joints=joints, seats=seats)


def instantaneous(mechanism: Mechanism) -> Mechanism:
    """Return a mechanism without what only a run can say of it: outputs that are integrals, events, and velocities."""
    kept = tuple(o for o in mechanism.outputs if not any(isinstance(r.source, Integral) for r in readings(o.value)))
    bodies = tuple(_still(body) for body in mechanism.bodies)
    return msgspec.structs.replace(mechanism, bodies=bodies, outputs=kept, events=())


def _still(body: AnyBody) -> AnyBody:
    """Return a body whose velocities follow from the drivers, whatever the file says of them."""
    if isinstance(body, SpatialBody):
        return msgspec.structs.replace(body, velocity=(None, None, None), angular_velocity=(None, None, None))
    return msgspec.structs.replace(body, velocity=(None, None), angular_velocity=None)


def make_ready(mechanism: Mechanism, settings: Settings, until: float, first: float = 0.0) -> PrescribedRun:
    """Return the code and the start of a mechanism, and what holds of its inputs when.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    settings : Settings
        Of which ``parameters``, ``inputs``, ``start``, ``shape`` and ``strict`` count. Of several
        ways to close a driven mechanism that nearest to ``start`` is taken.
    until, first : float
        Last time and first one [s]: inputs are known between them, and at the start.

    Raises
    ------
    InputError, AssemblyError
        If settings are wrong, or the mechanism cannot be closed.
    """
    asked_start = settings.start if drivers_of(mechanism) else {}
    if not isinstance(asked_start, Mapping):
        raise InputError("start", "values of coordinates by name, to choose a branch by", "a state of a run")
    settings = replace(settings, start={}) if asked_start else settings
    end = until if until > 0.0 else 1.0
    asked = replace(settings, method="lagrange", integrator=None, until=end, times=(end,), step=end)
    asked = replace(asked, output_step=None, coordinates="absolute")
    given = put_inputs(mechanism, asked)
    found = instantaneous(given.mechanism)
    plan = make_plan(found, given.settings, Purpose.STATE)
    near, notes = None, tuple[str, ...]()
    if asked_start:
        near, words = branch_near(plan, asked_start)
        notes = (words,)
    run = assemble(plan, near)
    compiled, start = run.compiled, run.start
    held, p, stops = list[tuple[float, Array]](), start.p, given.stops[1:]
    numbers = {q.name: i for i, q in enumerate(compiled.info.parameters)}
    if first < 0.0 and given.driven is not None:  # the start is at 0, others hold before
        values = parameter_values(given.mechanism, given.settings.parameters)
        stops = stops_of(given.driven, values, end, first)
    for stop in stops:
        if stop.t > first:
            held.append((stop.t, p))
        p = p.copy()
        for name, value in stop.values.items():
            p[numbers[name]] = value
        compiled.prepare(p)
    values = {q.name: float(x) for q, x in zip(compiled.info.parameters, start.p, strict=False)}
    parameters = {name: x for name, x in values.items() if name not in found.inputs}
    return PrescribedRun(found, compiled, start, parameters, tuple(held), p, dict(given.words), (*notes, *start.notes))


def make_driven(mechanism: Mechanism, settings: Settings, until: float, what: str, first: float = 0.0) -> PrescribedRun:
    """Return a mechanism whose freedom is all driven, ready to be followed; see `make_ready`.

    Parameters
    ----------
    mechanism, settings, until, first
        As for `make_ready`.
    what : str
        Who asks, for messages.

    Raises
    ------
    InputError
        If freedom is left, there are more drivers than freedom, a joint is a condition on velocities, or the start is
        a singular position.
    AssemblyError
        If the mechanism cannot be closed.
    """
    drivers = drivers_of(mechanism)
    try:
        found = make_ready(mechanism, settings, until, first)
    except AssemblyError:
        _refuse_excess(mechanism, settings, until, what, drivers)
        raise
    info, start = found.compiled.info, found.start
    for row in info.rows:
        if not row.holonomic:
            got = f"'{row.joint}', a condition on velocities, from which positions follow by integration alone"
            raise InputError(what, "conditions on positions", got, "symgen run does that")
    masked = len(start.redundant_rows)
    freedom = info.nv - (info.m - masked)
    # where the start is singular, rows may depend on others there alone
    loose = _refuse_excess(mechanism, settings, until, what, drivers) if masked else None
    if start.rank < info.m - masked or (freedom > 0 and loose == len(drivers)):
        got = "a singular position, from which several motions go on"
        raise InputError(
            what, "a start that is none of several branches", got, "describe it, and begin its drivers, elsewhere"
        )
    if freedom > 0:
        names = free_coordinates(found, freedom)
        of = "1 degree of freedom that is" if freedom == 1 else f"{freedom} degrees of freedom that are"
        hint = f"a driver drives {'it' if freedom == 1 else 'each'}, and symgen run needs none"
        raise InputError(what, "a driver for every freedom", f"{of} not driven: {', '.join(names)}", hint)
    return found


def _refuse_excess(
    mechanism: Mechanism, settings: Settings, until: float, what: str, drivers: tuple[str, ...]
) -> int | None:
    """Refuse more drivers than there are degrees of freedom without them; return how many there are, if that is known.

    Raises
    ------
    InputError
        With the drivers' names.
    """
    try:
        loose = make_ready(without(instantaneous(mechanism), drivers), replace(settings, start={}), until)
    except (InputError, AssemblyError):  # it is not what the drivers drive that is wrong
        return None
    info = loose.compiled.info
    freedom = info.nv - (info.m - len(loose.start.redundant_rows))
    if len(drivers) > freedom:
        words = "1 driver for 1 degree" if freedom == 1 else f"{freedom} drivers for {freedom} degrees"
        raise InputError(what, f"{words} of freedom", f"{len(drivers)}: {', '.join(drivers)}")
    return freedom


def jacobian_at(compiled: CompiledModel, t: float, y: Array, p: Array, w: Array) -> Array:
    """Return D at a state, of numbers: angles count as the distance that they move a body's end; shape (m, nv)."""
    w = w.copy()
    Ready(compiled.model.geometry, abi.MEASURE)(t, y.copy(), p, w)
    weights = np.array([w[abi.LENGTH] if row.unit == "rad" else 1.0 for row in compiled.info.rows])
    found: Array = weights[:, np.newaxis] * compiled.jacobian(w) * np.sqrt(compiled.section(w, "gauge"))
    return found


def free_coordinates(found: PrescribedRun, count: int) -> list[str]:
    """Return the names of as many coordinates as the freedom that is left, each of another part of it.

    Joints' own coordinates are named where they tell it, else coordinates of bodies.
    """
    compiled, start, info = found.compiled, found.start, found.compiled.info
    scale = np.sqrt(compiled.section(start.w, "gauge"))
    _, _, right = np.linalg.svd(jacobian_at(compiled, start.t, start.y, start.p, start.w), full_matrices=True)
    basis = (right[-count:] * scale).T  # directions of v, shape (nv, count)
    names = [q.name for q in info.joint_coordinates] + [v.name for v in info.velocities]
    rates = np.vstack([rates_of_joints(found, basis), basis])
    chosen, rest, joints = list[str](), rates.copy(), len(info.joint_coordinates)
    grounded = {joint.name for joint in found.mechanism.joints if GROUND in joint.bodies}
    liked = np.array([ON_GROUND if name.partition(".")[0] in grounded else 1.0 for name in names])
    liked[joints:] = CUTOFF  # these where no joint tells
    for _ in range(count):
        sizes = np.linalg.norm(rest, axis=1) * liked
        k = int(np.argmax(sizes))
        chosen.append(names[k])
        if not np.any(rest[k]):
            break
        direction = rest[k] / np.linalg.norm(rest[k])
        rest = rest - np.outer(rest @ direction, direction)
    return chosen


def rates_of_joints(found: PrescribedRun, basis: Array) -> Array:
    """Return the rates of all joint coordinates along directions of the velocities, shape (n, directions)."""
    compiled, start, info = found.compiled, found.start, found.compiled.info
    observe = Ready(compiled.model.observe, abi.OBSERVE)

    def rates(v: Array) -> Any:
        y, out = start.y.copy(), np.zeros(info.observed)
        y[info.nq : info.nq + info.nv] = v
        observe(start.t, y, start.p, start.w.copy(), np.zeros(info.ny), out)
        return out[info.m + 1 :: 2]

    still = rates(np.zeros(info.nv))
    return np.column_stack([rates(v) - still for v in basis.T]).reshape(len(info.joint_coordinates), basis.shape[1])


def branch_near(plan: Plan, asked: Mapping[str, float]) -> tuple[Array, str]:
    """Return the coordinates of the way to close a mechanism at t = 0 that is nearest to a start.

    Parameters
    ----------
    plan : Plan
        Of a mechanism with drivers for all its freedom; nothing is held.
    asked : mapping of str to float
        Coordinates of bodies or joints.

    Returns
    -------
    near : Array, shape (nq,)
        Coordinates.
    words : str
        Which way it is, in a sentence.

    Raises
    ------
    InputError
        If a name is no coordinate: velocities follow from drivers.
    AssemblyError
        If it cannot be closed at all.
    """
    mechanism, parameters, compiled = plan.mechanism, plan.parameters, compiled_for(plan.mechanism, plan.choice)
    info = compiled.info
    known = {q.name: q.unit for q in (*info.coordinates, *info.joint_coordinates)}
    for name in asked:
        if name not in known:
            expected = "a coordinate of a body or joint: velocities follow from the drivers"
            raise InputError(f"start '{name}'", expected, "none of that name", nearest(name, known))
    q = np.array(described_start(mechanism, scalars(parameter_values(mechanism, parameters)))[0], dtype=np.float64)
    ways, refused, last = list[tuple[Array, dict[str, float]]](), AssemblyError("no place closes it"), 0
    for k, guess in enumerate(_places(compiled, q)):
        if ways and k > last + ENOUGH:
            break
        try:
            start = start_of(mechanism, compiled, parameters, plan.method_parameters, near=guess)
        except AssemblyError as error:
            refused = error if k == 0 else refused
            continue
        found = start.y[: info.nq].copy()
        if not any(_apart(compiled, found, other) < SAME_WAY for other, _ in ways):
            ways.append((found, _values(compiled, start)))
            last = k
    if not ways:
        raise refused
    far = [sum(_gap(known[name], values[name], x) ** 2 for name, x in asked.items()) for _, values in ways]
    chosen = int(np.argmin(far))
    told = ", ".join(f"{name} = {ways[chosen][1][name]:.6g}" for name in asked)
    several = "1 way to close it is" if len(ways) == 1 else f"{len(ways)} ways to close it are"
    return ways[chosen][0], f"{several} known; that with {told} is nearest to the start"


def _places(compiled: CompiledModel, q: Array) -> list[Array]:
    """Return the described coordinates, then others all over the place."""
    rng, info = np.random.default_rng(0), compiled.info
    lengths = np.array([c.unit == "m" for c in info.coordinates])
    size = float(np.ptp(q[lengths])) or 1.0 if lengths.any() else 1.0
    found = [q]
    for _ in range(TRIES - 1):
        change = np.where(lengths, 0.5 * size, np.pi) * rng.uniform(-1.0, 1.0, len(q))
        place = q + change
        for first, _ in info.spins:
            turned = rng.standard_normal(4)
            place[first : first + 4] = turned / np.linalg.norm(turned)
        found.append(place)
    return found


def _values(compiled: CompiledModel, start: Start) -> dict[str, float]:
    info = compiled.info
    out = np.zeros(info.observed)
    observe = Ready(compiled.model.observe, abi.OBSERVE)
    observe(start.t, start.y.copy(), start.p, start.w.copy(), np.zeros(info.ny), out)
    values = {c.name: float(x) for c, x in zip(info.coordinates, start.y, strict=False)}
    return values | {c.name: float(x) for c, x in zip(info.joint_coordinates, out[info.m :: 2], strict=True)}


def _gap(unit: str, value: float, asked: float) -> float:
    """Return how far a value is from another one, whole turns left out."""
    gap = value - asked
    return gap - 2.0 * np.pi * round(gap / (2.0 * np.pi)) if unit == "rad" else gap


def _apart(compiled: CompiledModel, a: Array, b: Array) -> float:
    info = compiled.info
    gaps = np.array([_gap(c.unit, x, y) for c, x, y in zip(info.coordinates, a, b, strict=True)])
    for first, _ in info.spins:
        one, other = a[first : first + 4], b[first : first + 4]
        gaps[first : first + 4] = min(np.linalg.norm(one - other), np.linalg.norm(one + other))
    return float(np.abs(gaps).max(initial=0.0))
