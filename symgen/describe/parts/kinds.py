"""Kinds of joints and forces, one file each in the folders `joints` and `forces`, found by their names."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, ClassVar, Protocol

from symgen.base.errors import InputError, quote
from symgen.base.registry import Registry
from symgen.describe.parts.fields import read_table, takes_one_point, value_in_words

if TYPE_CHECKING:
    from symgen.describe.mechanism import Force, Joint
    from symgen.describe.parts.scope import Scope


class JointKind(Protocol):
    """Interface of a joint kind.

    Some kinds have methods beside `build`: ``articulate(joint)``, the relative motion of the bodies that one of a tree
    carries, and ``give(scope)``, the force in place of rows where a joint gives way. ``TAKES`` maps keys of joints of
    any kind to the key beside which the kind reads them itself.
    """

    #: Where the kind exists: in planar mechanisms, in spatial ones, or in both.
    SPACES: ClassVar[tuple[str, ...]]

    def build(self, scope: Scope) -> Joint:
        """Resolve the file's keys to rows on measures."""
        ...


class ForceKind(Protocol):
    """Interface of a force kind."""

    #: Where the kind exists: in planar mechanisms, in spatial ones, or in both.
    SPACES: ClassVar[tuple[str, ...]]

    def build(self, scope: Scope) -> Force:
        """Resolve the file's keys to efforts along measures."""
        ...


JOINTS: Registry[type[JointKind]] = Registry(
    "symgen.describe.joints",
    "joint type",
    aliases={
        **{"prismatic": "translational", "point-on-line": "pin-in-slot"},
        **{"inline": "pin-in-slot", "in-plane": "point-on-plane"},
    },
    meant={
        **dict.fromkeys(("hinge", "pin", "pivot", "rotational", "rotary", "rotation", "continuous"), "revolute"),
        **dict.fromkeys(("slider", "slide", "linear", "translation", "sliding", "guide"), "translational"),
        **dict.fromkeys(("ball", "ball-joint", "ball-and-socket"), "spherical"),
        **dict.fromkeys(("weld", "fixed", "fix", "clamp", "welded", "bolted"), "rigid"),
        **{"motor": "driver", "motion": "driver", "actuator": "driver", "link": "distance"},
        **{"cardan": "universal", "hooke": "universal", "slot": "pin-in-slot", "belt": "gear", "helical": "screw"},
    },
)
FORCES: Registry[type[ForceKind]] = Registry(
    "symgen.describe.forces",
    "force type",
    meant={"spring": "spring-damper", "damper": "spring-damper", "moment": "torque", "load": "force"},
)


def kind_and_keys(where: str, table: object, what: str, *common: str) -> tuple[str, dict[str, Any]]:
    """Return the type of a joint or force and the keys of its kind: those but the type and `common` ones."""
    if not isinstance(table, Mapping):
        raise InputError(where, "a table", value_in_words(table))
    kind = table.get("type")
    if not isinstance(kind, str):
        got = "no such key" if kind is None else value_in_words(kind)
        raise InputError(f"{where}.type", f"a {what}", got)
    return kind, {key: value for key, value in table.items() if key not in ("type", *common)}


def check_points(kind: type[JointKind | ForceKind], name: str, where: str) -> None:
    """Refuse a kind of a plugin that has one point under `at` beside `between`.

    Renaming, beams, pins and the editor read these two keys of any table, as a body and its point in one order.
    """
    if takes_one_point(kind):
        hint = "give this key of the plugin another name, such as 'point'"
        expected = "a kind whose 'at' has a point of each body of 'between'"
        raise InputError(f"{where}.type", expected, f"{quote(name)}, whose 'at' is one point", hint)


def read_force(name: str, raw: object, scope_of_entry: Callable[[str, str, str], Scope]) -> Force:
    """Return the force that a table of ``[forces]`` describes.

    Parameters
    ----------
    name, raw : str, object
        Of the entry.
    scope_of_entry : callable
        Section, name and kind of an entry -> its scope.

    Raises
    ------
    InputError
        If its type is unknown or a key of its kind is wrong.
    """
    where = scope_of_entry("forces", name, "").where("")
    kind, table = kind_and_keys(where, raw, "force type")
    struct = FORCES.get(kind, f"{where}.type")
    check_points(struct, kind, where)
    scope = scope_of_entry("forces", name, FORCES.resolve_alias(kind))
    scope.check_space(struct.SPACES)
    return read_table(struct, table, where, ("type",)).build(scope)
