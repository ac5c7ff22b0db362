"""Joints whose rows may be off in a part of a run."""

from __future__ import annotations

import msgspec

from symgen.describe.mechanism import Mechanism


def with_switchable(mechanism: Mechanism, *joints: str) -> Mechanism:
    """Return a mechanism in which the rows of some joints may be off.

    Where the state is that of joints, these joints carry nothing.

    Parameters
    ----------
    mechanism : Mechanism
        A validated mechanism.
    *joints : str
        Names of joints.

    Raises
    ------
    InputError
        If there is no such joint.
    """
    names = {mechanism.joint_named(name).name for name in (*mechanism.switchable, *joints)}
    switchable = tuple(joint.name for joint in mechanism.joints if joint.name in names)
    cuts = tuple(dict.fromkeys((*mechanism.cuts, *switchable)))
    return msgspec.structs.replace(mechanism, switchable=switchable, cuts=cuts)
