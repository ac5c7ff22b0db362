"""Mechanisms whose freedom is all driven: made ready to be followed, or refused in one sentence."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import msgspec
import numpy as np
from numpy.typing import NDArray

from symgen.analyses.state.algebra import coordinate_differences
from symgen.analyses.state.sticking import with_turns
from symgen.base.errors import AssemblyError, InputError, suggest
from symgen.base.vocabulary.expressions import readings_in
from symgen.base.vocabulary.measures import GROUND, Integral
from symgen.describe.bounds.bounded_modes import one_sided_rows, without_bounds
from symgen.describe.formulas.evaluate import parameter_values, scalar_values
from symgen.describe.formulas.start import described_start
from symgen.describe.mechanism import AnyBody, Mechanism, SpatialBody
from symgen.describe.parts.holding_joints import in_modes
from symgen.run.breaks.foreseen_seams import seams_of_motion
from symgen.run.layout import abi
from symgen.run.layout.probe import Ready
from symgen.run.planning.dead_centre import DRIVER, jacobian_at
from symgen.run.planning.inputs import put_inputs
from symgen.run.planning.plan import Plan, Purpose
from symgen.run.planning.prepare import find_preparation
from symgen.run.planning.starts import compiled_for, start_in_bodies

if TYPE_CHECKING:
    from collections.abc import Sequence

    from symgen.base.settings import Settings
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.starts.assembly import Start

Array = NDArray[np.float64]

#: Singular values below this part of the largest one count as zero, and parts of a direction below this one's largest.
CUTOFF = 1e-9
#: Coordinates of joints on the ground, where motors sit, are named rather than others.
ON_GROUND = 10.0
#: Places that a mechanism is closed from, and how many bring no new way before the search ends.
TRIES, ENOUGH = 200, 40
#: Positions as near as this are one, in lengths of the mechanism and radians.
SAME_WAY = 1e-6


class NotPrescribed(InputError):
    """A motion that drivers do not prescribe by positions alone: a run integrates it."""


@dataclass(frozen=True)
class PrescribedRun:
    """A mechanism that is ready to be followed.

    Attributes
    ----------
    mechanism : Mechanism
        With its inputs put in place, without outputs that are integrals.
    compiled, start : CompiledModel, Start
        Its code, and its consistent start at t = 0.
    held : tuple of (float, Array)
        Parameters of earlier seams, see `symgen.run.single.outcome.Motion`.
    p : Array
        Parameters of the last seam.
    inputs : mapping
        Inputs in words, or their numbers.
    notes : tuple of str
        Choices made on the way.
    plan : Plan
        Settings of the start, resolved.
    """

    mechanism: Mechanism
    compiled: CompiledModel
    start: Start
    held: tuple[tuple[float, Array], ...]
    p: Array
    inputs: dict[str, str | float]
    notes: tuple[str, ...]
    plan: Plan

    @property
    def numbers(self) -> dict[str, float]:
        """Values of all parameters at the start."""
        return {q.name: float(x) for q, x in zip(self.compiled.info.parameters, self.start.p, strict=False)}


def driver_names(mechanism: Mechanism) -> tuple[str, ...]:
    """Return the names of all drivers."""
    return tuple(joint.name for joint in mechanism.joints if joint.kind == DRIVER)


def drop_joints(mechanism: Mechanism, names: Sequence[str]) -> Mechanism:
    """Return a mechanism without some of its joints."""
    joints = tuple(joint for joint in mechanism.joints if joint.name not in names)
    seats = tuple((name, marker) for name, marker in mechanism.seats if name not in names)
    return msgspec.structs.replace(mechanism, joints=joints, seats=seats)


def without_history(mechanism: Mechanism) -> Mechanism:
    """Return a mechanism without what a run alone determines: integrals, events, velocities, rows with bounds."""
    mechanism = with_turns(without_bounds(mechanism), one_sided_rows(mechanism))
    outputs = tuple(
        o for o in mechanism.outputs if not any(isinstance(r.source, Integral) for r in readings_in(o.value))
    )
    bodies = list[AnyBody]()
    for body in mechanism.bodies:
        nothing = (None,) * len(body.velocity)
        angular = nothing if isinstance(body, SpatialBody) else None
        bodies.append(msgspec.structs.replace(body, velocity=nothing, angular_velocity=angular))
    speeds = {f"{body.name}.{speed}" for body in mechanism.bodies for speed in body.speeds}
    holds = tuple(hold for hold in mechanism.holds if hold.name not in speeds and not hold.name.endswith(".rate"))
    return msgspec.structs.replace(mechanism, bodies=tuple(bodies), outputs=outputs, holds=holds, events=())


def make_ready(
    mechanism: Mechanism, settings: Settings, until: float, first: float = 0.0, directed: bool = False
) -> PrescribedRun:
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
    directed : bool
        Whether the code shall have a form with directions.

    Raises
    ------
    InputError, AssemblyError
        If settings are wrong, or the mechanism cannot be closed.
    """
    mechanism = in_modes(mechanism, parameter_values(mechanism, settings.parameters))
    branch = settings.start if driver_names(mechanism) else {}
    if not isinstance(branch, Mapping):
        raise InputError("start", "values of coordinates by name, to choose a branch by", "a state of a run")
    own = {x.name: branch[x.name] for x in mechanism.states if x.name in branch}
    branch = {name: value for name, value in branch.items() if name not in own}
    end = until if until > 0.0 else 1.0
    settings = replace(settings, start=own if branch or own else settings.start, until=end, times=(end,), step=end)
    settings = replace(settings, method="lagrange", integrator=None, output_step=None, coordinates="absolute")
    if directed and settings.shape == "auto":
        settings = replace(settings, shape="straight")
    placed = put_inputs(mechanism, settings)
    driven = without_history(placed.mechanism)
    ready = find_preparation(driven, placed.settings, Purpose.STATE)
    if directed:
        choice = replace(ready.plan.choice, directed=True)
        ready = replace(ready, plan=replace(ready.plan, choice=choice), assembled=None)
    near, words = nearest_branch(ready.plan, branch) if branch else (None, ())
    run = replace(ready, near=near).run()
    compiled, start = run.compiled, run.start
    held, p, seams = list[tuple[float, Array]](), start.p, placed.seams[1:]
    numbers = {q.name: i for i, q in enumerate(compiled.info.parameters)}
    if first < 0.0 and placed.driven is not None:  # the start is at 0, others hold before
        values = parameter_values(placed.mechanism, placed.settings.parameters)
        seams = seams_of_motion(placed.driven, values, end, first)
    for seam in seams:
        if seam.t > first:
            held.append((seam.t, p))
        p = p.copy()
        for name, value in seam.values.items():
            p[numbers[name]] = value
        compiled.prepare(p)
    notes = *words, *start.notes
    return PrescribedRun(driven, compiled, start, tuple(held), p, dict(placed.words), notes, run.plan)


def make_driven(
    mechanism: Mechanism, settings: Settings, until: float, what: str, first: float = 0.0, directed: bool = False
) -> PrescribedRun:
    """Make a mechanism whose freedom is all driven ready to be followed; see `make_ready`.

    Parameters
    ----------
    mechanism, settings, until, first, directed
        As for `make_ready`.
    what : str
        The analysis, for messages.

    Raises
    ------
    InputError
        If freedom is left, there are more drivers than freedom, a joint is a condition on velocities, or the start is
        a singular position.
    AssemblyError
        If the mechanism cannot be closed.
    """
    drivers = driver_names(mechanism)
    try:
        run = make_ready(mechanism, settings, until, first, directed)
    except AssemblyError:
        _refuse_excess(mechanism, settings, until, what, drivers)
        raise
    info, start = run.compiled.info, run.start
    for row in info.rows:
        if not row.holonomic:
            got = f"'{row.joint}', a condition on velocities, from which positions follow by integration alone"
            raise NotPrescribed(what, "conditions on positions", got, "symgen run does that")
    masked = len(start.redundant_rows)
    freedom = info.nv - (info.m - masked)
    # where the start is singular, rows may depend on others there alone
    loose = _refuse_excess(mechanism, settings, until, what, drivers) if masked else None
    if start.rank < info.m - masked or (freedom > 0 and loose == len(drivers)):
        hint = "describe it, and begin its drivers, elsewhere"
        got = "a singular position, from which several motions go on"
        raise InputError(what, "a start that is none of several branches", got, hint)
    if freedom > 0:
        got = f"none for {', '.join(free_coordinates(run, freedom))}"
        raise NotPrescribed(what, "a driver for every freedom", got, "symgen run needs no drivers")
    return run


def _refuse_excess(
    mechanism: Mechanism, settings: Settings, until: float, what: str, drivers: tuple[str, ...]
) -> int | None:
    """Refuse more drivers than degrees of freedom without them, and return the number of these; None where it is open.

    Raises
    ------
    InputError
        With the drivers' names.
    """
    try:
        loose = make_ready(drop_joints(without_history(mechanism), drivers), replace(settings, start={}), until)
    except (InputError, AssemblyError):  # the error is not in the driven coordinates
        return None
    info = loose.compiled.info
    freedom = info.nv - (info.m - len(loose.start.redundant_rows))
    if len(drivers) > freedom:
        words = "1 driver for 1 degree" if freedom == 1 else f"{freedom} drivers for {freedom} degrees"
        raise InputError(what, f"{words} of freedom", f"{len(drivers)}: {', '.join(drivers)}")
    return freedom


def free_coordinates(run: PrescribedRun, count: int) -> list[str]:
    """Return the names of as many coordinates as the freedom that is left, each of another part of it.

    Joints' own coordinates are named where they move with it, else coordinates of bodies.
    """
    from scipy import linalg

    compiled, start, info = run.compiled, run.start, run.compiled.info
    scale = np.sqrt(compiled.section(start.w, "gauge"))
    _, _, right = np.linalg.svd(jacobian_at(compiled, start.t, start.y, start.p, start.w), full_matrices=True)
    basis = (right[-count:] * scale).T  # directions of v, shape (nv, count)

    def rates_of_joints(v: Array) -> Array:
        y = start.y.copy()
        y[info.nq : info.nq + info.nv] = v
        return _observed_numbers(compiled, start, y)[info.m + 1 :: 2]

    still = rates_of_joints(np.zeros(info.nv))
    rates = np.vstack([np.column_stack([rates_of_joints(v) - still for v in basis.T]), basis])
    names = [q.name for q in info.joint_coordinates] + [v.name for v in info.velocities]
    grounded = {joint.name for joint in run.mechanism.joints if GROUND in joint.bodies}
    weights = np.array([ON_GROUND if name.rpartition(".")[0] in grounded else 1.0 for name in names])
    weights[len(info.joint_coordinates) :] = CUTOFF  # these where no joint moves
    order = linalg.qr((rates * weights[:, np.newaxis]).T, mode="r", pivoting=True)[1]
    return [names[k] for k in order[:count]]


def _observed_numbers(compiled: CompiledModel, start: Start, y: Array) -> Array:
    """Return the numbers that the model reports at a state: rows, then value and rate of each joint coordinate."""
    out = np.zeros(compiled.info.observed)
    observe = Ready(compiled.model.observe, abi.OBSERVE)
    observe(start.t, y.copy(), start.p, start.w.copy(), np.zeros(compiled.info.ny), out)
    return out


def nearest_branch(plan: Plan, branch: Mapping[str, float]) -> tuple[Array, tuple[str, ...]]:
    """Close a mechanism at t = 0 from many places, and choose the way that is nearest to a start.

    Parameters
    ----------
    plan : Plan
        Of a mechanism with drivers for all its freedom; nothing is held.
    branch : mapping of str to float
        Coordinates of bodies or joints.

    Returns
    -------
    near : Array, shape (nq,)
        Coordinates.
    words : tuple of str
        Description of the way, in a sentence.

    Raises
    ------
    InputError
        If a name is no coordinate: velocities follow from drivers.
    AssemblyError
        If the mechanism cannot be closed.
    """
    mechanism, parameters, compiled = plan.mechanism, plan.parameters, compiled_for(plan.mechanism, plan.choice)
    info, rng = compiled.info, np.random.default_rng(0)
    names, units = zip(*((q.name, q.unit) for q in (*info.coordinates, *info.joint_coordinates)), strict=True)
    for name in branch:
        if name not in names:
            expected = "a coordinate of a body or joint: velocities follow from the drivers"
            raise InputError(f"start '{name}'", expected, "none of that name", suggest(name, names))
    places = [names.index(name) for name in branch]
    turning = np.array([units[i] == "rad" for i in places])
    described = np.array(
        described_start(mechanism, scalar_values(parameter_values(mechanism, parameters)))[0], dtype=np.float64
    )
    lengths = np.array([c.unit == "m" for c in info.coordinates])
    size = float(np.ptp(described[lengths])) or 1.0 if lengths.any() else 1.0
    ways, refusal, last = list[tuple[Array, Array]](), AssemblyError("no place closes it"), 0
    for k in range(TRIES):
        if ways and k > last + ENOUGH:
            break
        guess = described.copy()
        if k:  # all over the place
            guess += np.where(lengths, 0.5 * size, np.pi) * rng.uniform(-1.0, 1.0, len(guess))
            for first, _ in info.spins:
                turned = rng.standard_normal(4)
                guess[first : first + 4] = turned / np.linalg.norm(turned)
        try:
            start = start_in_bodies(mechanism, compiled, parameters, plan.method_parameters, near=guess)
        except AssemblyError as error:
            refusal = error if k == 0 else refusal
            continue
        q = start.y[: info.nq].copy()
        if not any(np.abs(coordinate_differences(info, q, other)).max(initial=0.0) < SAME_WAY for other, _ in ways):
            ways.append((q, np.concatenate([q, _observed_numbers(compiled, start, start.y)[info.m :: 2]])[places]))
            last = k
    if not ways:
        raise refusal
    gaps = np.array([values for _, values in ways]) - np.array(list(branch.values()))
    gaps[:, turning] -= 2.0 * np.pi * np.round(gaps[:, turning] / (2.0 * np.pi))
    near, values = ways[int(np.argmin(np.sum(gaps**2, axis=1)))]
    which = ", ".join(f"{name} = {value:.6g}" for name, value in zip(branch, values, strict=True))
    several = "1 way to close it is" if len(ways) == 1 else f"{len(ways)} ways to close it are"
    return near, (f"{several} known; that with {which} is nearest to the start",)
