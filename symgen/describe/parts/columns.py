"""Names of columns where all tables are joined: in frames, files, plots, pages and commands.

Bodies, joints and forces have names of their own, so that most columns need no more than these. Multipliers, energies
and violations say which they are. A body, force or driver with the name of one of these heads is refused where two
columns could have one name.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING

from symgen.base.errors import InputError

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism

#: Table -> how the name of a column is formed from its key there: `key`, or the parts of it before and after its last
#: dot. Columns of other tables are called as in the table.
FORMS: Mapping[str, str] = MappingProxyType(
    {
        "lam": "multiplier.{key}",
        "body_reactions": "{owner}.body.{label}",
        "energy": "energy.{key}",
        "violations": "violation.{key}",
        # of analyses along a motion
        "efforts": "{key}.effort",
        "lowest": "{key}.lowest",
        "highest": "{key}.highest",
        "power": "{key}.power",
        "rates": "{key}.rate",
        "transmission": "transmission.{key}",
    }
)
#: Heads of columns, after which the rest may be a column of a body.
_HEADS = ("multiplier", "transmission")


def column_name(table: str, key: str) -> str:
    """Return the name of a column of a table: ``multiplier.A.x`` of ``A.x`` among the multipliers."""
    owner, _, label = key.rpartition(".")
    return FORMS.get(table, "{key}").format(key=key, owner=owner, label=label)


def check_columns(mechanism: Mechanism, source: str) -> None:
    """Refuse bodies, forces and drivers with a name that columns of joints begin with.

    Parameters
    ----------
    mechanism : Mechanism
        With bodies, joints and forces.
    source : str
        Its origin, for the message.

    Raises
    ------
    InputError
        If one has such a name.
    """
    drivers = [joint.name for joint in mechanism.joints if joint.kind == "driver"]
    owners = {"bodies": mechanism.bodies, "forces": mechanism.forces}
    names = {section: [x.name for x in owned] for section, owned in owners.items()} | {"joints": drivers}
    for section, owned in names.items():
        for name in (name for name in owned if name in _HEADS):
            expected = f"another name, as columns of results of joints begin with '{name}.'"
            raise InputError(f"{source}: {section}.{name}", expected, f"'{name}'", f"for example '{name}_'")
