"""Joint kinds, one file each: a table of a mechanism file in, rows on measures out.

A kind is a frozen Struct with the file's keys as fields and a method ``build(scope) -> Joint``. Convention shared by
all kinds: measures run from the first body to the second, so that a positive multiplier pushes the first body along
the row's positive direction (the force on the first body is -D^T lambda). A kind that can stand in a tree of joints
also has a static method ``articulate(joint) -> Articulation``, which says how its second body moves against the first.
"""

from __future__ import annotations

from typing import ClassVar, Protocol

from symgen.describe.mechanism import Joint
from symgen.describe.scope import Scope
from symgen.registry import Registry


class JointKind(Protocol):
    """What every joint kind offers."""

    #: Where the kind exists: in planar mechanisms, in spatial ones, or in both.
    SPACES: ClassVar[tuple[str, ...]]

    def build(self, scope: Scope) -> Joint:
        """Resolve the file's keys to rows on measures."""
        ...


JOINTS: Registry[type[JointKind]] = Registry(
    __name__, "joint type", aliases={"prismatic": "translational", "point-on-line": "pin-in-slot"}
)
