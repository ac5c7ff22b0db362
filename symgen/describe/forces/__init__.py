"""Kinds of forces, one file each: a table of a mechanism file in, efforts along measures out.

A kind is a frozen Struct with the keys of the file and a method ``build(scope) -> Force``.

In: a table of a file.
Out: efforts and potentials of a `Force`.
Imports: msgspec; `describe` and rooms below.
"""

from symgen.describe.parts.kinds import FORCES, ForceKind

__all__ = ["FORCES", "ForceKind"]
