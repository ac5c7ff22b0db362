"""Actuators of a mechanism: drivers, joints, forces and inputs whose efforts are inputs of a mechanism of its own.

Drivers prescribe a motion, actuators exert it: drivers are removed, those among the actuators become efforts along
their coordinates, and everything else stays.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import msgspec

from symgen.analyses.prescribed.prescribed import driver_names, drop_joints, without_history
from symgen.base.errors import InputError, quote, suggest
from symgen.base.vocabulary.expressions import ZERO, Expr, Name, Number, Reading
from symgen.base.vocabulary.measures import Effort, Exerted, Holonomic
from symgen.describe.formulas.readings import is_turning
from symgen.describe.mechanism import Force, Joint, Mechanism, Parameter
from symgen.run.planning.dead_centre import DRIVER

WHERE = "actuators"
#: Suffix of the inputs that represent efforts: not valid in names of a file.
_MARK = "~effort"


@dataclass(frozen=True)
class Actuator:
    """One effort.

    Attributes
    ----------
    name : str
        As requested and reported.
    unit : str
        Of the effort; empty for an input.
    parameter : str
        The input that represents it.
    rate : Expr or None
        Rate of the coordinate along which it works, None for an input.
    """

    name: str
    unit: str
    parameter: str
    rate: Expr | None

    @property
    def turning(self) -> bool:
        """Whether it is a torque."""
        return self.unit == "N m"


def with_actuators(mechanism: Mechanism, names: Sequence[str]) -> tuple[Mechanism, tuple[Actuator, ...]]:
    """Return a mechanism without drivers and with actuators as inputs, and these actuators.

    Parameters
    ----------
    mechanism : Mechanism
        With inputs put in place.
    names : sequence of str
        Drivers, joints (``shaft``, or ``pin.angle`` of one that reports several coordinates), forces (``drive``, all
        of its efforts, or ``load.x``) and inputs.

    Raises
    ------
    InputError
        If a name is none of these, is repeated, or means the same as another one.
    """
    whole = without_history(mechanism)
    if not names:
        hint = "drivers, joints, forces and inputs may be named"
        raise InputError(WHERE, "names of what exerts the motion", "none, and no driver", hint)
    forces = {force.name: force for force in whole.forces}
    actuators, added, along = list[Actuator](), list[Force](), dict[object, str]()
    for name in names:
        if name in forces or name.rpartition(".")[0] in forces:
            force = name if name in forces else name.rpartition(".")[0]
            forces[force], new = _actuate_force(forces[force], name)
            actuators += new
        elif name in whole.inputs:
            unit = next(p.unit for p in whole.parameters if p.name == name)
            actuators.append(Actuator(name, unit, name, None))
        else:
            effort, unit = _effort_of_joint(whole, name)
            if (other := along.setdefault(effort.measure, name)) != name:
                raise InputError(WHERE, "each actuator once", f"{quote(other)} and {quote(name)}, which are one")
            added.append(Force(f"{name}{_MARK}", "torque" if unit == "N m" else "force", (), (effort,)))
            actuators.append(Actuator(name, unit, f"{name}{_MARK}", _power_of_unit_effort(name, effort)))
    if len({a.parameter for a in actuators}) < len(actuators):
        raise InputError(WHERE, "each name once", ", ".join(names))
    inputs = tuple(
        Parameter(a.parameter, 0.0, a.unit, input=True) for a in actuators if a.parameter not in whole.inputs
    )
    changes = {"forces": (*forces.values(), *added), "parameters": (*whole.parameters, *inputs)}
    loose = drop_joints(whole, driver_names(whole))  # outputs may read what drivers exert
    return msgspec.structs.replace(loose, outputs=(), holds=(), **changes), tuple(actuators)


def _power_of_unit_effort(name: str, effort: Effort) -> Expr:
    """Return the power of an effort of 1 as a formula: the rate of the coordinate along which it works."""
    alone = msgspec.structs.replace(effort, magnitude=Number(1.0), potential=ZERO)
    return Reading(f"{name}.rate", Exerted((alone,), power=True))


def _actuate_force(force: Force, name: str) -> tuple[Force, list[Actuator]]:
    """Return a force with efforts as inputs, all of them or the one that `name` ends in, and their actuators."""
    labels = [effort.label for effort in force.efforts]
    label = name.removeprefix(f"{force.name}.") if name != force.name else ""
    if label and label not in labels:
        raise InputError(WHERE, f"an effort of {force.name}", quote(name), suggest(label, labels))
    efforts, actuators = list[Effort](), list[Actuator]()
    for effort in force.efforts:
        whole = f"{force.name}.{effort.label}"
        if label in ("", effort.label):
            own, unit = name if len(labels) == 1 else whole, "N m" if is_turning(effort.measure) else "N"
            actuators.append(Actuator(own, unit, f"{whole}{_MARK}", _power_of_unit_effort(own, effort)))
            effort = msgspec.structs.replace(effort, magnitude=Name(f"{whole}{_MARK}"), potential=ZERO)
        efforts.append(effort)
    return msgspec.structs.replace(force, efforts=tuple(efforts)), actuators


def _effort_of_joint(mechanism: Mechanism, name: str) -> tuple[Effort, str]:
    """Return the effort along the coordinate of a joint or driver, and its unit."""
    joints = {joint.name: joint for joint in mechanism.joints}
    owner = name if name in joints else name.rpartition(".")[0]
    if owner not in joints:
        names = [*joints, *(force.name for force in mechanism.forces), *mechanism.inputs]
        raise InputError(WHERE, "a driver, joint, force or input", quote(name), suggest(name, names))
    joint, magnitude = joints[owner], Name(f"{name}{_MARK}")
    row = joint.rows[0] if joint.kind == DRIVER else None
    if isinstance(row, Holonomic):
        return Effort("effort", row.measure, magnitude), "N m" if row.unit == "rad" else "N"
    measures = dict(joint.coordinates)
    label = name.removeprefix(f"{owner}.") if name != owner else ""
    if not label and len(measures) != 1:
        got = f"'{owner}', which has {len(measures)}"
        raise InputError(WHERE, "a coordinate of a joint", got, ", ".join(f"{owner}.{x}" for x in measures))
    label = label or next(iter(measures))
    if label not in measures:
        raise InputError(WHERE, f"a coordinate of {owner}", quote(name), suggest(label, measures))
    return Effort("effort", measures[label], magnitude), "N m" if Joint.unit(label) == "rad" else "N"
