"""Kinds of joints and forces, one file each in the folders `joints` and `forces`, found by their names."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Protocol

from symgen.base.registry import Registry

if TYPE_CHECKING:
    from symgen.describe.mechanism import Force, Joint
    from symgen.describe.parts.scope import Scope


class JointKind(Protocol):
    """Interface of a joint kind."""

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
)
FORCES: Registry[type[ForceKind]] = Registry("symgen.describe.forces", "force type")
