"""Force kinds, one file each: a table of a mechanism file in, efforts along measures out.

A kind is a frozen Struct with the file's keys as fields and a method ``build(scope) -> Force``.
"""

from __future__ import annotations

from typing import ClassVar, Protocol

from symgen.describe.mechanism import Force
from symgen.describe.scope import Scope
from symgen.registry import Registry


class ForceKind(Protocol):
    """What every force kind offers."""

    #: Where the kind exists: in planar mechanisms, in spatial ones, or in both.
    SPACES: ClassVar[tuple[str, ...]]

    def build(self, scope: Scope) -> Force:
        """Resolve the file's keys to efforts along measures."""
        ...


FORCES: Registry[type[ForceKind]] = Registry(__name__, "force type")
