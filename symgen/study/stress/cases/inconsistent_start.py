"""The middle body is described away from where it can be, with velocities that it cannot have."""

from __future__ import annotations

from symgen.study.stress.bench import Base, Level, pick, shown
from symgen.study.stress.cases import Family

#: Fractions of the mechanism's size, and of its size a second.
VALUES, QUICK = (1e-6, 1e-3, 1e-2, 1e-1), (1e-2,)


def levels(base: Base, quick: bool) -> list[Level]:
    """Return one case a displacement."""
    found = []
    body = base.raw["bodies"][base.middle]
    for share in pick(VALUES, QUICK, quick):
        away = share * base.size
        signs = ("+", "-", "+")[: len(base.anchor)]
        at = body.get("position", [0.0] * len(signs))
        position = [f"({x}){sign}{away!r}" for x, sign in zip(at, signs, strict=True)]
        moved = {"position": position, "velocity": [away] * len(signs)}
        mechanism = base.build({"bodies": {base.middle: moved}})
        found.append(base.level("inconsistent-start", f"{shown(away)} m away", away, mechanism=mechanism))
    return found


KIND = Family("inconsistent start", ("displacement [m]",), levels)
