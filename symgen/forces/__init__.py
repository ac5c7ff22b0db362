"""Force kinds, one file each: a table of a mechanism file in, efforts along measures out.

A kind is a frozen Struct with the file's keys as fields and a method ``build(scope) -> Force``.
"""

from symgen.describe.kinds import FORCES, ForceKind

__all__ = ["FORCES", "ForceKind"]
