"""Kinds of joints, one file each: a table of a mechanism file in, rows on measures out.

A kind is a frozen Struct with the keys of the file and a method ``build(scope) -> Joint``. Measures run from the
first body to the second: a positive multiplier pushes the first body along the positive direction of the row. A kind
for a tree of joints has a static method ``articulate(joint) -> Articulation``: the motion of its second body.

In: a table of a file.
Out: rows, points and directions of a `Joint`.
Imports: msgspec; `describe` and rooms below.
"""

from symgen.describe.parts.kinds import JOINTS, JointKind

__all__ = ["JOINTS", "JointKind"]
