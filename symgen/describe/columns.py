"""What columns are called where all tables stand side by side: in data frames, files and quantities that are chosen.

Bodies, joints and forces have names of their own, so that most tables need nothing else; those of joints and of the
whole mechanism say what they hold. A body called as one of these is headed is refused: two columns might have one name.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING

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


#: How columns of joints and of actuators begin, behind which a name of a body's columns may follow.
_HEADS = tuple(PREFIX[table].rstrip(".") for table in ("joint_coordinates", "lam", "efforts", "transmission", "power"))


def check_columns(mechanism: Mechanism, source: str) -> None:
    """Refuse bodies, forces and drivers with a name that columns of joints or actuators begin with.

    Parameters
    ----------
    mechanism : Mechanism
        With bodies, joints and forces.
    source : str
        Where it is from, for the message.

    Raises
    ------
    InputError
        If there is one.
    """
    drivers = [joint.name for joint in mechanism.joints if joint.kind == "driver"]
    owners = {"bodies": mechanism.bodies, "forces": mechanism.forces}
    names = {section: [x.name for x in owned] for section, owned in owners.items()} | {"joints": drivers}
    for section, owned in names.items():
        for name in (name for name in owned if name in _HEADS):
            expected = f"another name, as columns of results of joints and actuators begin with '{name}.'"
            raise InputError(f"{source}: {section}.{name}", expected, f"'{name}'", f"for example '{name}_'")
