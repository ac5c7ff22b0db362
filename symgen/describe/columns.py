"""What columns are called where all tables stand side by side: in data frames, files and quantities that are chosen.

Bodies, joints and forces have names of their own, so that most tables need nothing else; those of joints and of the
whole mechanism say what they hold. A body may be called as one of these is headed, and only then may two columns have
one name: such a description is refused, since nothing could tell them apart where they are read again.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING

from symgen.describe.mechanism import ACCELERATIONS
from symgen.describe.outputs import elements, points
from symgen.errors import InputError

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism

    _Names = Callable[[Mechanism], Iterator[str]]
    _Labels = Callable[[Mechanism, str], Iterator[str]]

#: Table -> what its columns are prefixed with. Bodies and joints may share names, so all but the tables of bodies say
#: whose they are.
PREFIX: Mapping[str, str] = MappingProxyType(
    {
        "q": "",
        "v": "",
        "a": "",
        "joint_coordinates": "joint.",
        "lam": "lam.",
        "reactions": "reaction.",
        "body_reactions": "reaction.body.",
        "magnitudes": "reaction.",
        "points": "",
        "elements": "",
        "outputs": "",
        "energy": "energy.",
        "violations": "violation.",
        # of analyses along a motion
        "efforts": "effort.",
        "power": "power.",
        "rates": "rate.",
        "transmission": "transmission.",
    }
)


def check_columns(mechanism: Mechanism, source: str) -> None:
    """Refuse a body or force two of whose columns could not be told apart from others.

    Parameters
    ----------
    mechanism : Mechanism
        With bodies, joints and forces.
    source : str
        Where it is from, for the message.

    Raises
    ------
    InputError
        With the column, what else has its name, and what to call differently.
    """
    owners = {body.name: "bodies" for body in mechanism.bodies} | {force.name: "forces" for force in mechanism.forces}
    owners |= {joint.name: "joints" for joint in mechanism.joints}
    for table, what, headed, besides in _HEADED:
        owner = PREFIX[table].rstrip(".")
        if owner in owners:  # hardly ever: a file may have thousands of points
            own = {f"{owner}.{label}" for label in besides(mechanism, owner)}
            for name in headed(mechanism):
                if PREFIX[table] + name in own:
                    where, got = f"{source}: {owners[owner]}.{owner}", f"'{PREFIX[table]}{name}'"
                    hint = f"that is what the {what} of '{name}' is called: give one of them another name"
                    raise InputError(where, "columns of results that nothing else is called", got, hint)


def _coordinates(mechanism: Mechanism, owner: str) -> Iterator[str]:
    """Yield what the coordinates of a body are called behind its name."""
    yield from (label for body in mechanism.bodies if body.name == owner for label in body.coordinates)


def _own(mechanism: Mechanism, owner: str) -> Iterator[str]:
    """Yield what all columns of a body, driver or force are called behind its name."""
    yield from _coordinates(mechanism, owner)
    for speed in (speed for body in mechanism.bodies if body.name == owner for speed in body.speeds):
        yield from (speed, ACCELERATIONS[speed])
    for column in (*points(mechanism), *elements(mechanism)):
        if column.name.startswith(f"{owner}."):
            yield column.name.partition(".")[2]


def _multipliers(mechanism: Mechanism) -> Iterator[str]:
    yield from (f"{joint.name}.{row.label}" for joint in mechanism.joints for row in joint.rows)


def _of_joints(mechanism: Mechanism) -> Iterator[str]:
    for joint in mechanism.joints:
        for label, _ in joint.coordinates:
            yield from (f"{joint.name}.{label}", f"{joint.name}.{label}.rate")


def _joints(mechanism: Mechanism) -> Iterator[str]:
    yield from (joint.name for joint in mechanism.joints)


def _drivers(mechanism: Mechanism) -> Iterator[str]:
    yield from (joint.name for joint in mechanism.joints if joint.kind == "driver")


def _along_rates(mechanism: Mechanism) -> Iterator[str]:
    """Yield what may be an actuator along something: joints, their coordinates, forces and their components."""
    for joint in mechanism.joints:
        yield from (joint.name, *(f"{joint.name}.{label}" for label, _ in joint.coordinates))
    for force in mechanism.forces:
        yield from (force.name, *(f"{force.name}.{effort.label}" for effort in force.efforts))


def _actuators(mechanism: Mechanism) -> Iterator[str]:
    yield from (*_along_rates(mechanism), *mechanism.inputs)


#: Tables whose columns may be called as those of a body, driver or force, what they hold, their names in any result,
#: and what stands beside them there. What reactions, energies and violations are called is nothing of a body's.
_HEADED: tuple[tuple[str, str, _Names, _Labels], ...] = (
    ("joint_coordinates", "coordinate", _of_joints, _own),
    ("lam", "multiplier", _multipliers, _own),
    ("efforts", "effort", _drivers, _own),
    ("transmission", "transmission angle", _joints, _own),
    # of inverse dynamics
    ("efforts", "effort", _actuators, _coordinates),
    ("power", "power", _along_rates, _coordinates),
)
