"""What columns are called where all tables stand side by side: in data frames, files and quantities that are chosen.

Bodies, joints and forces have names of their own, so that most tables need nothing else; those of joints and of the
whole mechanism say what they hold. A body may be called as one of these is headed, and only then may two columns have
one name: such a description is refused, since nothing could tell them apart where they are read again.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING

from symgen.describe.mechanism import ACCELERATIONS
from symgen.describe.readings import elements, points
from symgen.errors import InputError

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism

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
    heads = {PREFIX[table].rstrip("."): table for table in _SHARED}
    for owner in [name for name in heads if name in owners]:  # hardly ever: a file may have thousands of points
        coordinates = {label for body in mechanism.bodies if body.name == owner for label in body.coordinates}
        own = coordinates | {*_further(mechanism, owner)}
        for table, what, name, beside_all in _headed(mechanism):
            if table == heads[owner] and name in (own if beside_all else coordinates):
                where, got = f"{source}: {owners[owner]}.{owner}", f"'{PREFIX[table]}{name}'"
                hint = f"that is what the {what} of '{name}' is called: give one of them another name"
                raise InputError(where, "columns of results that nothing else is called", got, hint)


def _further(mechanism: Mechanism, owner: str) -> Iterator[str]:
    """Yield what columns of a body, driver or force are called behind its name, beside its coordinates."""
    for speed in (speed for body in mechanism.bodies if body.name == owner for speed in body.speeds):
        yield from (speed, ACCELERATIONS[speed])
    for column in (*points(mechanism), *elements(mechanism)):
        if column.name.startswith(f"{owner}."):
            yield column.name.partition(".")[2]


#: Tables whose columns may be called as those of a body, driver or force. What reactions, energies and violations are
#: called is nothing of a body's.
_SHARED = ("joint_coordinates", "lam", "efforts", "transmission", "power")


def _headed(mechanism: Mechanism) -> Iterator[tuple[str, str, str, bool]]:
    """Yield columns of these tables: table, word for what they hold, name, and whether more than coordinates is beside.

    Results of inverse dynamics, which have efforts of any actuator and powers, hold coordinates of bodies alone.
    """
    actuators = list[str]()
    for joint in mechanism.joints:
        labels = [f"{joint.name}.{label}" for label, _ in joint.coordinates]
        for label in labels:
            yield from (("joint_coordinates", "coordinate", name, True) for name in (label, f"{label}.rate"))
        yield from (("lam", "multiplier", f"{joint.name}.{row.label}", True) for row in joint.rows)
        yield "transmission", "transmission angle", joint.name, True
        if joint.kind == "driver":
            yield "efforts", "effort", joint.name, True
        actuators += (joint.name, *labels)
    for force in mechanism.forces:
        actuators += (force.name, *(f"{force.name}.{effort.label}" for effort in force.efforts))
    yield from (("efforts", "effort", name, False) for name in (*actuators, *mechanism.inputs))
    yield from (("power", "power", name, False) for name in actuators)
