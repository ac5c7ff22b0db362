"""Inverse dynamics: the efforts that a prescribed motion needs, of drivers, joints, forces or inputs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.efforts.actuators import WHERE, with_actuators
from symgen.analyses.efforts.effort_balance import balance_efforts
from symgen.analyses.efforts.forces_at_bounds import Contacts
from symgen.analyses.prescribed.driven_motion import Kinematics, driven_motion
from symgen.analyses.prescribed.prescribed import driver_names
from symgen.analyses.state.sticking import with_turns
from symgen.base import arguments
from symgen.base.digits import clean
from symgen.base.errors import InputError, plural
from symgen.describe.bounds.checks import refuse_driven_surfaces
from symgen.describe.bounds.contact_rows_in_space import refuse_rows_in_pairs
from symgen.describe.bounds.smooth import sliding_rows_as_forces
from symgen.describe.formulas.evaluate import parameter_values
from symgen.describe.parts.holding_joints import refuse_holding
from symgen.describe.parts.input_data import are_words_of_data
from symgen.result.labelled import Labelled, label_columns
from symgen.result.motion_tables import Tables
from symgen.result.over_time import time_rms
from symgen.result.part_limits import doubt_on_outputs
from symgen.result.reactions import Forces, seats_of_reactions
from symgen.result.saved import Recorded, read_recorded, recorded_motion
from symgen.run.breaks.foreseen_seams import seams_of_motion
from symgen.run.planning.inputs import put_inputs

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from symgen.base.settings import Settings
    from symgen.describe.mechanism import Mechanism

Array = NDArray[np.float64]
#: What every second time may change of an integral before it is said; an error about three times smaller is left.
COARSE = 0.03


@dataclass(frozen=True, repr=False)
class Inverse(Tables):
    """The efforts of a motion; arrays have one row a time.

    Attributes
    ----------
    mechanism : str
        Name of the mechanism.
    t : Array, shape (k,)
        Times [s].
    efforts : Labelled
        By the names of actuators; along their coordinates, on the second body of a joint, forward.
    lowest, highest : Labelled
        The range of each effort alone where friction at rest and closed stops leave one, else the effort.
    rates, power : Labelled
        Rate of what each works along, and their product [W]; inputs have none.
    missing : Array, shape (k,)
        Largest acceleration that no effort produces [m/s^2], angles by the bodies' lengths.
    forces : Forces
        Forces from which reactions are computed.
    q : Labelled
        Coordinates.
    parameters : mapping
        Values of parameters.
    ended : str
        Reason why the motion ends before all times, else empty.
    notes : tuple of str
        Sentences on choices made and values that are not unique.
    """

    mechanism: str
    t: Array
    efforts: Labelled
    lowest: Labelled
    highest: Labelled
    rates: Labelled
    power: Labelled
    missing: Array
    forces: Forces
    q: Labelled
    parameters: Mapping[str, float]
    ended: str = ""
    notes: tuple[str, ...] = field(default=())

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the tables."""
        return (
            "efforts",
            "power",
            "rates",
            "lowest",
            "highest",
            "q",
            "lam",
            "reactions",
            "body_reactions",
            "magnitudes",
        )

    @property
    def drawn(self) -> tuple[str, ...]:
        """Tables of a plot by default."""
        return ("efforts", "power")

    @property
    def title(self) -> str:
        """Title of a plot."""
        return f"{self.mechanism}, inverse dynamics"

    @property
    def ok(self) -> bool:
        """Whether the motion reaches all times."""
        return not self.ended

    def summary(self) -> dict[str, dict[str, Any]]:
        """Return the sizing values of each effort: unit, largest size and its time, root mean square, power, energy.

        Root mean square and energy are integrals over the times by the trapezoidal rule; `too_few` says where these are
        too few for that.
        """
        entries, t = dict[str, dict[str, Any]](), self.t
        for i, (name, unit) in enumerate(zip(self.efforts.names, self.efforts.units, strict=True)):
            values = self.efforts.values[:, i]
            if not len(t):
                continue
            at = int(np.argmax(np.abs(values)))
            entries[name] = {"unit": unit, "max": float(abs(values[at])), "at": float(t[at])}
            entries[name]["rms"] = float(time_rms(t, values))
            if name in self.power:
                power = self.power[name]
                # a turn gives back what it takes: what is left of that is rounding
                energy = float(clean(np.trapezoid(power, t), float(np.trapezoid(np.abs(power), t))))
                entries[name] |= {"peak_power": float(np.abs(power).max()), "energy": energy}
        return entries

    def too_few(self) -> str:
        """Return in a sentence that every second time would make other integrals of `summary`, or an empty text."""
        t = self.t
        fewer = np.append(np.arange(0, len(t) - 1, 2), len(t) - 1)
        worst, which = 0.0, ""
        for i, name in enumerate(self.efforts.names if len(t) > 1 else ()):
            kinds = {"mean square": self.efforts.values[:, i] ** 2}
            kinds |= {"energy": self.power[name]} if name in self.power else {}
            for kind, values in kinds.items():
                whole, size = np.trapezoid(values, t), np.trapezoid(np.abs(values), t)
                apart = abs(np.trapezoid(values[fewer], t[fewer]) - whole) / size if size > 0.0 else 0.0
                if apart > worst:
                    worst, which = float(apart), f"the {kind} of '{name}'"
        if worst <= COARSE:
            return ""
        change = f"every second of these alone changes {which} by {worst:.0%}"
        return f"integrals are over {len(t)} times, and {change}: ask for more"

    def to_json(self) -> dict[str, Any]:
        """Return the contract of ``symgen inverse --json``; numbers that are not finite become None."""
        from symgen.result.contract import json_value

        return {
            "mechanism": self.mechanism,
            "t": self.t.tolist(),
            "efforts": self.series("efforts"),
            "units": dict(zip(self.efforts.names, self.efforts.units, strict=True)),
            "lowest": json_value(self.series("lowest")),
            "highest": json_value(self.series("highest")),
            "power": self.series("power"),
            "reactions": self.series("reactions"),
            "summary": json_value(self.summary()),
            "missing": json_value(self.missing.tolist()),
            "not_unique": list(self.non_unique_reactions),
            "ended": self.ended or None,
            "parameters": dict(self.parameters),
            "notes": list(self.notes),
        }

    def __repr__(self) -> str:
        return (
            f"<Inverse dynamics of {self.mechanism} at {plural(len(self.t), 'time')}: {', '.join(self.efforts.names)}>"
        )


def inverse_dynamics(
    mechanism: Mechanism,
    settings: Settings,
    motion: Any = None,
    times: ArrayLike | None = None,
    actuators: Sequence[str] = (),
    weights: Mapping[str, float] | None = None,
) -> Inverse:
    """Return the efforts that a motion needs; see `symgen.api.Model.inverse`, which has these arguments and errors."""
    refuse_holding("inverse dynamics", mechanism)
    refuse_rows_in_pairs("inverse dynamics", mechanism)
    refuse_driven_surfaces("inverse dynamics", mechanism)
    contacts = Contacts.of_mechanism(mechanism)
    mechanism = sliding_rows_as_forces(WHERE, mechanism, contacts.apart)
    names = arguments.words(WHERE, actuators)
    if len(set(names)) < len(names):
        raise InputError(WHERE, "each name once", ", ".join(names))
    drivers = driver_names(mechanism)
    names, moved = names or drivers, None
    if motion is None:
        moved = driven_motion(mechanism, settings, times, where="inverse")
        if set(names) == set(drivers) and not weights and not contacts.rows:
            return _efforts_of_drivers(moved, names)
    elif times is not None:
        raise InputError("inverse: times", "the times of the motion that is given", "others")
    is_file = isinstance(motion, str | Path)
    record = read_recorded("inverse: motion", Path(motion)) if is_file else recorded_motion(moved or motion)
    own = _take_recorded_values(settings, mechanism, record, names)
    efforts = _efforts_of_record(mechanism, own, record, names, weights, contacts)
    if moved is None:
        return efforts
    return replace(efforts, ended=moved.ended, notes=tuple(dict.fromkeys((*moved.notes, *efforts.notes))))


def _take_recorded_values(settings: Settings, mechanism: Mechanism, record: Recorded, names: Sequence[str]) -> Settings:
    """Return settings with the parameters and inputs of a recording, unless others are set."""
    for name, words in record.inputs.items():
        own = (*settings.inputs, *settings.parameters, *names)
        if name in mechanism.inputs and name not in own and are_words_of_data(words):
            expected = "the data of the recorded motion once more, of which it keeps no more than their number or file"
            raise InputError(f"inverse: input '{name}'", expected, str(words))
    constants = {p.name for p in mechanism.parameters if not p.input}
    parameters = {name: x for name, x in record.parameters.items() if name in constants}
    free = set(mechanism.inputs).difference(settings.parameters)
    inputs = {name: x for name, x in record.inputs.items() if name in free}
    return replace(settings, parameters={**parameters, **settings.parameters}, inputs={**inputs, **settings.inputs})


def _efforts_of_drivers(moved: Kinematics, names: Sequence[str]) -> Inverse:
    """Return the efforts of drivers that prescribe all freedom: minus the multipliers of their rows."""
    order = [moved.drivers.index(name) for name in names]
    values, units = moved.efforts.values[:, order], tuple(moved.efforts.units[i] for i in order)
    efforts = Labelled(values, tuple(names), units)
    elements = [next(x for x in moved.elements.names if x.startswith(f"{n}.") and x.endswith("rate")) for n in names]
    rates = np.column_stack([moved.elements[name] for name in elements])
    speeds = tuple("rad/s" if unit == "N m" else "m/s" for unit in units)
    return Inverse(
        mechanism=moved.mechanism,
        t=moved.t,
        efforts=efforts,
        lowest=efforts,
        highest=efforts,
        rates=Labelled(rates, efforts.names, speeds),
        power=Labelled(values * rates, efforts.names, ("W",) * len(names)),
        missing=np.zeros(len(moved.t)),
        forces=moved.forces,
        q=moved.q,
        parameters=moved.parameters,
        ended=moved.ended,
        notes=moved.notes,
    )


def _efforts_of_record(
    mechanism: Mechanism,
    settings: Settings,
    record: Recorded,
    names: Sequence[str],
    weights: Mapping[str, float] | None,
    contacts: Contacts,
) -> Inverse:
    """Return the efforts of actuators in a recorded motion."""
    if not len(record.t):
        raise InputError(record.whence, "a motion", "no outputs")
    others = {name: x for name, x in settings.inputs.items() if name not in names}
    end = float(record.t[-1]) if record.t[-1] > 0.0 else 1.0
    whole = replace(settings, method="lagrange", integrator=None, until=end, times=(end,), step=end, output_step=None)
    placed = put_inputs(mechanism, replace(whole, start={}, coordinates="absolute", inputs=others))
    settings = placed.settings
    if placed.driven is not None:  # inputs that jump elsewhere are what they are during the motion
        numbers = parameter_values(placed.mechanism, settings.parameters)
        seams = seams_of_motion(placed.driven, numbers, end, float(record.t[0]))
        if any(seam.values for seam in seams[1:] if seam.t < record.t[-1]):  # at a kink no number becomes another
            raise InputError("inverse: inputs", "inputs without jumps", ", ".join(placed.words))
        now = seams[0].values if seams else {}
        settings = replace(settings, parameters={**settings.parameters, **now})
    loose, actuators = with_actuators(placed.mechanism, names)
    loose = with_turns(contacts.as_inputs(loose), contacts.along)
    balanced = balance_efforts(loose, actuators, settings, record, weights, contacts)
    motion, info = balanced.motion, balanced.motion.compiled.info
    values = {q.name: float(x) for q, x in zip(info.parameters, motion.p, strict=False)}
    forces = Forces(motion, seats_of_reactions(loose, values))
    works = [(i, a) for i, a in enumerate(actuators) if a.rate is not None]
    columns, working = [i for i, _ in works], tuple(a.name for _, a in works)
    power = balanced.efforts[:, columns] * balanced.rates
    if (motion.start.redundant_rows or info.dropped_rows) and forces.non_unique:
        balanced.notes.append("reactions are not unique at " + ", ".join(forces.non_unique))
    if (doubt := doubt_on_outputs(loose, values, motion)) is not None:
        balanced.notes.append(f"beyond the limits of its parts: {doubt}")
    labels = tuple(a.name for a in actuators), tuple(a.unit for a in actuators)
    return Inverse(
        mechanism=mechanism.name,
        t=motion.times,
        efforts=Labelled(balanced.efforts, *labels),
        lowest=Labelled(balanced.lowest, *labels),
        highest=Labelled(balanced.highest, *labels),
        rates=Labelled(balanced.rates, working, tuple("rad/s" if a.turning else "m/s" for _, a in works)),
        power=Labelled(power, working, ("W",) * len(works)),
        missing=balanced.missing,
        forces=forces,
        q=label_columns(motion.states[:, : info.nq], info.coordinates),
        parameters={q.name: values[q.name] for q in info.parameters if q.name not in loose.inputs},
        notes=(*loose.remarks, *motion.start.notes, *balanced.notes),
    )
