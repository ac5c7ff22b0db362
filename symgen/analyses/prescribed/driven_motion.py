"""Kinematics: the motion of mechanisms whose freedom is all driven, at any times, without integrating."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, overload

import msgspec
import numpy as np
from numpy.typing import ArrayLike, NDArray

from symgen.analyses.prescribed.driven_sensitivities import DrivenSensitivities
from symgen.analyses.prescribed.kept_motion import KeptMotion
from symgen.analyses.prescribed.own_states import states_along
from symgen.analyses.prescribed.passing import Passage
from symgen.analyses.prescribed.prescribed import driver_names, make_driven
from symgen.analyses.prescribed.tracing import trace_motion
from symgen.analyses.prescribed.transmission import transmission_angles
from symgen.base import arguments
from symgen.base.errors import InputError, plural, suggest
from symgen.base.memory import require_memory
from symgen.describe.facts.lifted import lift_numbers
from symgen.result.labelled import Labelled, label_columns
from symgen.result.motion_tables import Measured, MotionTables
from symgen.result.plot import Plot, draw_or_save
from symgen.result.reactions import Forces, seats_of_reactions
from symgen.result.signals import acceleration_table, multiplier_unit
from symgen.run.layout import abi
from symgen.run.planning.outputs import multiples, output_size
from symgen.run.single.outcome import PrescribedMotion

if TYPE_CHECKING:
    from symgen.base.settings import Settings
    from symgen.describe.mechanism import Mechanism

Array = NDArray[np.float64]

#: Equidistant times where neither the caller nor the file says which.
DEFAULT_TIMES = 1001
#: Largest number of times.
MOST_TIMES = 100_000_000


@dataclass(frozen=True, repr=False)
class Kinematics(MotionTables):
    """A prescribed motion; arrays have one row a time.

    Attributes
    ----------
    mechanism : str
        Name of the mechanism.
    t : Array, shape (k,)
        Times [s]: those requested, up to the end of the motion.
    q, v, a : Labelled
        Coordinates, velocities and accelerations.
    transmission : Labelled
        Transmission angles of the requested joints, see `symgen.analyses.prescribed.transmission`.
    passages : tuple of Passage
        Singular positions on the way.
    ended : str
        Reason why the motion does not reach all times, else empty.
    parameters, inputs : mapping
        Values of parameters, and inputs.
    notes : tuple of str
        Sentences on choices made on the way.
    steps : int
        Steps taken, at requested times and between.
    drivers : tuple of str
        Names of the drivers.
    motion : PrescribedMotion
        Motion from which further tables are computed.
    sensitivities : DrivenSensitivities or None
        Derivatives of the motion, if it has some.
    """

    of_process: ClassVar[tuple[str, ...]] = ("motion", "forces", "measured", "sensitivities")
    cached: ClassVar[tuple[str, ...]] = ("non_unique_reactions", "efforts")

    mechanism: str
    t: Array
    q: Labelled
    v: Labelled
    a: Labelled
    transmission: Labelled
    passages: tuple[Passage, ...]
    ended: str
    parameters: Mapping[str, float]
    inputs: Mapping[str, str | float]
    notes: tuple[str, ...]
    steps: int
    drivers: tuple[str, ...]
    motion: PrescribedMotion
    forces: Forces
    measured: Measured = field(repr=False)
    sensitivities: DrivenSensitivities | None = field(default=None, repr=False)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the tables."""
        own = ("q", "v", "a", "joint_coordinates", "energy", "violations", "transmission", "lam")
        return (*own, "reactions", "body_reactions", "magnitudes", "points", "elements", "outputs")

    @property
    def title(self) -> str:
        """Title of a plot."""
        return f"{self.mechanism}, kinematics" + (f" ({self.ended})" if self.ended else "")

    @property
    def ok(self) -> bool:
        """Whether the motion reaches all times."""
        return not self.ended

    @property
    def status(self) -> str:
        """``ok``, or ``failed`` where the motion does not reach all times."""
        return "ok" if self.ok else "failed"

    @property
    def reason(self) -> str | None:
        """Why the status is not ok."""
        return self.ended or None

    @cached_property
    def efforts(self) -> Labelled:
        """Effort of each driver along its coordinate [N m or N]: on the second body of its joint, forward.

        Nothing, where its row repeats another one, which carries all.
        """
        rows = {row.joint: i for i, row in enumerate(self.motion.compiled.info.rows)}
        own = {joint.name: joint.rows[0].unit for joint in self.measured.mechanism.joints}
        nothing = np.zeros(len(self.t))
        values = [-self.lam.values[:, rows[name]] if name in rows else nothing for name in self.drivers]
        units = tuple(multiplier_unit(own[name]) for name in self.drivers)
        return Labelled(np.column_stack(values), self.drivers, units)

    @cached_property
    def energy(self) -> Labelled:
        """Kinetic and potential energy, and their sum [J]."""
        parts = self.motion.status_columns[:, [abi.KINETIC, abi.POTENTIAL]]
        values = np.column_stack([parts, parts.sum(axis=1)])
        return Labelled(values, ("kinetic", "potential", "total"), ("J", "J", "J"))

    @cached_property
    def violations(self) -> Labelled:
        """Norms of Phi and ``D v - nu``: ``position``, ``velocity``."""
        status = self.motion.status_columns
        return Labelled(status[:, [abi.PHI, abi.DRIFT]], ("position", "velocity"), ("m", "m/s"))

    def gradient(self, name: str) -> Labelled:
        """Return the derivatives of a quantity over time, one column for each number in `sensitivities`.

        Parameters
        ----------
        name : str
            A column such as ``rocker.theta``, ``motor.effort``, ``A.F`` or ``energy.kinetic``, an output of the file,
            or a formula as in ``[outputs]``.

        Raises
        ------
        InputError
            If the motion has no ``sensitivities``, or there is no such quantity.
        """
        if self.sensitivities is None:
            raise InputError("gradient", "kinematics with sensitivities=(...)", "one without")
        return self.sensitivities.of_quantity(arguments.text("gradient", name, "a quantity"))

    def run_facts(self) -> dict[str, Any]:
        """Return data of the motion for a page and for the start of its live part, by the names of JSON."""
        start = {"t": float(self.t[0]), "q": self.q.row(0), "v": self.v.row(0)} if len(self.t) else {}
        until = float(self.t[-1]) if len(self.t) else 0.0
        return {
            "method": "kinematics",
            "integrator": plural(len(self.t), "time"),
            "status": self.status,
            "reason": self.reason,
            "events": [{"t": passage.t, "name": passage.words} for passage in self.passages],
            **{"parameters": self.parameters, "inputs": self.inputs},
            **{"coordinates": "absolute", "step": None, "until": until, "start": start, "watched": ()},
        }

    def to_json(self) -> dict[str, Any]:
        """Return the contract of ``symgen kinematics --json``; numbers that are not finite become None."""
        from symgen.result.contract import json_series

        tables = ("q", "v", "a", "points", "joint_coordinates", "reactions", "efforts", "transmission", "outputs")
        return {
            "mechanism": self.mechanism,
            "t": self.t.tolist(),
            **{name: json_series(getattr(self, name)) for name in tables},
            "not_unique": list(self.non_unique_reactions),
            "passages": [msgspec.to_builtins(p) | {"words": p.words} for p in self.passages],
            "ended": self.ended or None,
            "parameters": dict(self.parameters),
            "inputs": dict(self.inputs),
            "notes": list(self.notes),
            "steps": self.steps,
            **self._sensitivities_at_end(),
        }

    def _sensitivities_at_end(self) -> dict[str, Any]:
        """Return derivatives of coordinates, velocities and outputs at the last time, if there are any."""
        if self.sensitivities is None:
            return {}
        columns = (*self.q.names, *self.v.names, *self.outputs.names)
        return {"sensitivities": self.sensitivities.to_json(columns)}

    def curve(self, point: str) -> Array:
        """Return the places of a named point, shape (k, 2), in space (k, 3): a coupler curve.

        Raises
        ------
        InputError
            If no body has such a point.
        """
        table, names = self.points, [f"{arguments.text('point', point)}.{axis}" for axis in "xyz"]
        columns = [table[name] for name in names if name in table]
        if not columns:
            points = sorted({name.rpartition(".")[0] for name in table.names})
            raise InputError("point", "a named point", arguments.kind_of_value(point), suggest(point, points))
        return np.column_stack(columns)

    @overload
    def plot_curves(self, path: None = None, points: Sequence[str] = ()) -> Plot: ...

    @overload
    def plot_curves(self, path: str | PathLike[str], points: Sequence[str] = ()) -> Path: ...

    def plot_curves(self, path: str | PathLike[str] | None = None, points: Sequence[str] = ()) -> Plot | Path:
        """Draw the paths of points of bodies, the first two coordinates: a figure, or a PNG, SVG or PDF file.

        Parameters
        ----------
        path : path, optional
            The file. Without one the figure comes back, which notebooks show.
        points : sequence of str, optional
            Such as ``leg.foot``; all by default.
        """
        from symgen.result.plots import figure_of_paths

        chosen = arguments.words("points", points) or dict.fromkeys(n.rpartition(".")[0] for n in self.points.names)
        return draw_or_save(path, lambda: figure_of_paths({name: self.curve(name) for name in chosen}, self.title))

    def __repr__(self) -> str:
        ended = f": {self.ended}" if self.ended else ""
        return f"<Kinematics of {self.mechanism} at {plural(len(self.t), 'time')}{ended}>"


def driven_motion(
    mechanism: Mechanism,
    settings: Settings,
    times: ArrayLike | None = None,
    transmission: Sequence[str] = (),
    where: str = "kinematics",
    sensitivities: Sequence[str] = (),
) -> Kinematics:
    """Return the motion of a mechanism whose freedom is all driven.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    settings : Settings
        Of which ``parameters``, ``inputs``, ``start``, ``shape`` and ``strict`` count: a start is near the branch that
        is wanted.
    times : array, optional
        Increasing, of any sign [s]; the outputs of a run of the file by default.
    transmission : sequence of str
        Joints with requested transmission angles.
    where : str
        Name of the caller, for messages.
    sensitivities : sequence of str
        Numbers that the motion is differentiated by.

    Raises
    ------
    InputError
        If freedom is not driven, or driven twice, or an argument is wrong.
    AssemblyError
        If the mechanism cannot be closed.
    """
    instants = default_times(mechanism) if times is None else checked_times(f"{where}: times", times)
    pins = arguments.words("transmission", transmission)
    ends, by = (float(instants[-1]), min(0.0, float(instants[0]))), arguments.words("sensitivities", sensitivities)
    kept: KeptMotion | None = None
    if by:
        lifted = lift_numbers(f"{where}: sensitivities", mechanism, by)
        kept = KeptMotion(f"{where}: sensitivities", lifted.mechanism, settings, [*lifted.keys.values()], ends[0])
    run = make_driven(mechanism, settings, ends[0], where, ends[1]) if kept is None else kept.run
    require_memory(f"{where}: times", f"{len(instants)} times", 16.0 * len(instants) * (run.compiled.info.ny + 16))
    traced, info, start, numbers = trace_motion(run, instants), run.compiled.info, run.start, run.numbers
    states, off = traced.states, ""
    if run.mechanism.states:
        states = states.copy()
        states[:, info.own_states], off = states_along(run, traced.times)
    motion = PrescribedMotion(
        times=traced.times,
        states=states,
        status_columns=traced.status,
        compiled=run.compiled,
        start=start,
        p=run.p,
        w=start.w,
        held=run.held,
        prescribed_accelerations=traced.accelerations,
    )
    if run.mechanism.states:
        motion = replace(motion, status_columns=motion.measure_motion())
    forces = Forces(motion, seats_of_reactions(run.mechanism, numbers))
    parameters = {name: x for name, x in numbers.items() if name not in run.mechanism.inputs}
    q, v = info.parts(traced.states)
    velocities = label_columns(v, info.velocities)
    words = [*filter(None, [off]), *(p.words for p in traced.passages if p.kind == "passed")]
    if (start.redundant_rows or info.dropped_rows) and forces.non_unique:
        words.append("reactions are not unique at " + ", ".join(forces.non_unique))
    return Kinematics(
        mechanism=run.mechanism.name,
        t=traced.times,
        q=label_columns(q, info.coordinates),
        v=velocities,
        a=acceleration_table(traced.accelerations, velocities),
        transmission=transmission_angles(run.mechanism, label_columns(q, info.coordinates), parameters, pins),
        passages=traced.passages,
        ended=traced.ended,
        parameters=parameters,
        inputs=run.inputs,
        notes=(*run.notes, *words),
        steps=traced.steps,
        drivers=driver_names(run.mechanism),
        motion=motion,
        forces=forces,
        measured=Measured(run.mechanism, motion, lambda: forces.multipliers().values),
        sensitivities=None if kept is None else DrivenSensitivities.of_motion(by, kept, traced),
    )


def default_times(mechanism: Mechanism) -> Array:
    """Return the times of the outputs of a run as the file has them."""
    until, step = mechanism.defaults.until, mechanism.defaults.output_step
    if step is None:
        return np.linspace(0.0, until, DEFAULT_TIMES)
    return multiples(step, until, output_size(mechanism))


def checked_times(where: str, value: object) -> Array:
    """Return increasing finite times.

    Raises
    ------
    InputError
        If they are anything else.
    """
    kind = getattr(getattr(value, "dtype", None), "kind", "")
    if kind and kind not in "iuf":
        raise InputError(where, "a list of finite times", arguments.kind_of_value(value))
    times = np.atleast_1d(np.asarray(value if kind else arguments.numbers(where, value), dtype=np.float64))
    if times.ndim != 1 or not 1 <= len(times) <= MOST_TIMES or not np.all(np.isfinite(times)):
        raise InputError(where, "a list of finite times", arguments.kind_of_value(value))
    if not np.all(np.diff(times) > 0.0):
        k = int(np.argmin(np.diff(times) > 0.0))
        raise InputError(where, "times that increase", f"{times[k + 1]:g} after {times[k]:g}")
    return np.ascontiguousarray(times)
