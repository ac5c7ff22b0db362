"""Actuators: drivers, joints, forces and inputs whose efforts are sought, as inputs of a mechanism of their own.

What prescribes a motion is not what has to exert it: drivers leave, those among the actuators become efforts along
their coordinates, and everything else stays. The mechanism is linear in its actuators, so that its emitted right-hand
side says what each of them does to accelerations and reactions.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import msgspec

from symgen.analyses.prescribed import DRIVER, drivers_of, instantaneous, without
from symgen.describe.mechanism import Force, Joint, Mechanism, Parameter
from symgen.describe.readings import is_turning
from symgen.errors import InputError, nearest, quoted
from symgen.vocabulary.expressions import ZERO, Expr, Name, Number, Reading
from symgen.vocabulary.measures import Effort, Exerted, Holonomic

WHERE = "actuators"
#: Ends the names of inputs that stand for efforts: no name of a file.
_MARK = "~effort"


@dataclass(frozen=True)
class Actuator:
    """One effort that is sought.

    Attributes
    ----------
    name : str
        As it is asked for and reported.
    unit : str
        Of the effort; empty for an input.
    parameter : str
        The input that stands for it.
    rate : Expr or None
        Rate of what it works along, None for an input.
    """

    name: str
    unit: str
    parameter: str
    rate: Expr | None

    @property
    def turning(self) -> bool:
        """Whether it is a torque."""
        return self.unit == "N m"


@dataclass(frozen=True)
class Actuated:
    """A mechanism in which actuators are inputs."""

    mechanism: Mechanism
    actuators: tuple[Actuator, ...]


def actuated(mechanism: Mechanism, names: Sequence[str]) -> Actuated:
    """Return a mechanism whose drivers have left and whose actuators are inputs.

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
        If a name is none of these, stands twice, or means what another one does.
    """
    whole = instantaneous(mechanism)
    drivers = drivers_of(whole)
    if not names:
        hint = "drivers, joints, forces and inputs may be named"
        raise InputError(WHERE, "names of what exerts the motion", "none, and no driver", hint)
    forces = {force.name: force for force in whole.forces}
    found, added, along = list[Actuator](), list[Force](), dict[object, str]()
    for name in names:
        if name in forces or name.rpartition(".")[0] in forces:
            force = name if name in forces else name.rpartition(".")[0]
            forces[force], new = _of_force(forces[force], name)
            found += new
        elif name in whole.inputs:
            found.append(Actuator(name, _unit(whole, name), name, None))
        else:
            effort, unit = _of_joint(whole, name)
            if (other := along.setdefault(effort.measure, name)) != name:
                raise InputError(WHERE, "each actuator once", f"{quoted(other)} and {quoted(name)}, which are one")
            added.append(Force(f"{name}{_MARK}", "torque" if unit == "N m" else "force", (), (effort,)))
            found.append(Actuator(name, unit, _parameter(name), _rate(name, effort)))
    if len({a.parameter for a in found}) < len(found):
        raise InputError(WHERE, "each name once", ", ".join(names))
    inputs = tuple(Parameter(a.parameter, 0.0, a.unit, input=True) for a in found if a.name not in whole.inputs)
    loose = msgspec.structs.replace(without(whole, drivers), outputs=())  # which may read what drivers exert
    made = msgspec.structs.replace(
        loose, forces=(*forces.values(), *added), parameters=(*whole.parameters, *inputs), holds=()
    )
    return Actuated(made, tuple(found))


def _parameter(name: str) -> str:
    return f"{name}{_MARK}"


def _rate(name: str, effort: Effort) -> Expr:
    """Return the power of an effort of 1 as a formula: the rate of what it works along."""
    alone = msgspec.structs.replace(effort, magnitude=Number(1.0), potential=ZERO)
    return Reading(f"{name}.rate", Exerted((alone,), power=True))


def _unit(mechanism: Mechanism, name: str) -> str:
    return next(p.unit for p in mechanism.parameters if p.name == name)


def _of_force(force: Force, name: str) -> tuple[Force, list[Actuator]]:
    """Return a force with efforts as inputs, all of them or the one that `name` says, and what they are."""
    labels = [effort.label for effort in force.efforts]
    asked = name.removeprefix(f"{force.name}.") if name != force.name else ""
    if asked and asked not in labels:
        raise InputError(WHERE, f"an effort of {force.name}", quoted(name), nearest(asked, labels))
    efforts, found = list[Effort](), list[Actuator]()
    for effort in force.efforts:
        whole = f"{force.name}.{effort.label}"
        if asked in ("", effort.label):
            own, unit = name if len(labels) == 1 else whole, "N m" if is_turning(effort.measure) else "N"
            found.append(Actuator(own, unit, _parameter(whole), _rate(own, effort)))
            effort = msgspec.structs.replace(effort, magnitude=Name(_parameter(whole)), potential=ZERO)
        efforts.append(effort)
    return msgspec.structs.replace(force, efforts=tuple(efforts)), found


def _of_joint(mechanism: Mechanism, name: str) -> tuple[Effort, str]:
    """Return the effort along the coordinate of a joint or driver, and its unit."""
    joints = {joint.name: joint for joint in mechanism.joints}
    owner = name if name in joints else name.rpartition(".")[0]
    if owner not in joints:
        known = [*joints, *(force.name for force in mechanism.forces), *mechanism.inputs]
        raise InputError(WHERE, "a driver, joint, force or input", quoted(name), nearest(name, known))
    joint = joints[owner]
    row = joint.rows[0] if joint.kind == DRIVER else None
    if isinstance(row, Holonomic):
        return Effort("effort", row.measure, Name(_parameter(name))), "N m" if row.unit == "rad" else "N"
    labels = {label: measure for label, measure in joint.coordinates}
    asked = name.removeprefix(f"{owner}.") if name != owner else ""
    if not asked and len(labels) != 1:
        told = f"'{owner}', which has {len(labels)}"
        raise InputError(WHERE, "a coordinate of a joint", told, ", ".join(f"{owner}.{x}" for x in labels))
    label = asked or next(iter(labels))
    if label not in labels:
        raise InputError(WHERE, f"a coordinate of {owner}", quoted(name), nearest(label, labels))
    return Effort("effort", labels[label], Name(_parameter(name))), "N m" if Joint.unit(label) == "rad" else "N"
