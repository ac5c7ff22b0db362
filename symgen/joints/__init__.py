"""Joint kinds, one file each: a table of a mechanism file in, rows on measures out.

A kind is a frozen Struct with the file's keys as fields and a method ``build(scope) -> Joint``. Convention shared by
all kinds: measures run from the first body to the second, so that a positive multiplier pushes the first body along
the row's positive direction (the force on the first body is -D^T lambda). A kind that can stand in a tree of joints
also has a static method ``articulate(joint) -> Articulation``: the motion of its second body against the first.
"""

from symgen.describe.kinds import JOINTS, JointKind

__all__ = ["JOINTS", "JointKind"]
