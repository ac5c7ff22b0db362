"""A body on a pin in the ground starts turning fast; the other velocities follow."""

from __future__ import annotations

from symgen.study.stress.bench import Base, Level, NotApplicable, pick, shown
from symgen.study.stress.cases import Family

VALUES, QUICK = (1e1, 1e2, 1e3, 1e4), (1e2, 1e4)


def levels(base: Base, quick: bool) -> list[Level]:
    """Return one case a rate, some fifty turns long."""
    if base.mechanism.space != "planar":
        raise NotApplicable("a spin rate is set in the plane only")
    joints = base.raw.get("joints", {}).values()
    if any(joint["type"] == "driver" for joint in joints):
        raise NotApplicable("a driver prescribes its speed")
    turning = None
    for joint in joints:
        if joint["type"] == "revolute" and joint["between"][0] == "ground" and turning is None:
            turning = joint["between"][1]
    if turning is None:
        raise NotApplicable("no body is pinned to the ground as the first of a joint's bodies")
    found = []
    for rate in pick(VALUES, QUICK, quick):
        bodies = {
            body.name: {"velocity": None, "angular_velocity": rate if body.name == turning else None}
            for body in base.mechanism.bodies
        }
        mechanism = base.build({"bodies": bodies})
        until = min(base.nominal, 300.0 / rate)
        found.append(base.level("spin-rate", f"{shown(rate)} rad/s", rate, mechanism=mechanism, until=until))
    return found


KIND = Family("spin rate at the start", ("spin rate [rad/s]",), levels)
