"""Constraints that repeat what others say, on the constraint manifold only, so that no derivation can drop them."""

from __future__ import annotations

import math
from typing import Any

from symgen.describe.evaluate import evaluate
from symgen.joints import JOINTS
from symgen.study.stress.bench import Base, Level, NotApplicable, pick
from symgen.study.stress.cases import Family

VALUES, QUICK = (1.0, 2.0), (1.0,)


def levels(base: Base, quick: bool) -> list[Level]:
    """Return cases with one and two bars more, each beside a body that is pinned at either end."""
    if base.mechanism.space not in JOINTS.get("distance").SPACES:
        raise NotApplicable(f"there is no distance joint in {base.mechanism.space} mechanisms")
    bars = _bars(base)
    if not bars:
        raise NotApplicable("no body is pinned to the ground and to another body")
    found = []
    for count in pick(VALUES, QUICK, quick):
        chosen = dict(list(bars.items())[: int(count)])
        if len(chosen) < count:
            continue
        mechanism = base.build({"joints": chosen}, f"redundant-{int(count)}")
        label = f"{int(count)} bar{'s' if count > 1 else ''} more"
        found.append(base.level("redundancy", label, count, mechanism=mechanism))
    return found


def _bars(base: Base) -> dict[str, dict[str, Any]]:
    """Return distance joints between a pin in the ground and the next pin, on the body beyond it."""
    joints = base.raw.get("joints", {})
    pins = [j for j in joints.values() if j["type"] == "revolute"]
    bars: dict[str, dict[str, Any]] = {}
    for first in pins:
        if first["between"][0] != "ground":
            continue
        body = first["between"][1]
        for second in pins:
            if body not in second["between"] or "ground" in second["between"]:
                continue
            here = second["between"].index(body)
            length = math.dist(_point(base, body, first["at"][1]), _point(base, body, second["at"][here]))
            if length < 1e-9:
                continue
            beyond, at = second["between"][1 - here], second["at"][1 - here]
            bars[f"stress_bar{len(bars)}"] = {
                "type": "distance",
                "between": ["ground", beyond],
                "at": [first["at"][0], at],
                "length": length,
            }
            break
    return bars


def _point(base: Base, body: str, at: Any) -> tuple[float, ...]:
    described = base.mechanism.body(body)
    if isinstance(at, str):
        point = described.centre_of_mass if at == "centre" else dict(described.points)[at]
        return tuple(evaluate(x, base.values, body) for x in point)
    return tuple(float(x) for x in at)


KIND = Family("redundant constraints", ("further constraints",), levels)
