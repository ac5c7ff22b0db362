"""Joints that a file puts at a centre of mass beside the origin of its body's frame, which is seldom meant."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from symgen.base.vocabulary.measures import GROUND
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.mechanism import Mechanism
from symgen.describe.parts.scope import CENTRE


def warnings_on_centres(mechanism: Mechanism, raw: Mapping[str, Any]) -> Iterator[str]:
    """Yield a sentence for each point of a joint that is ``"centre"`` where the frame has its origin elsewhere.

    A point given by a name of its own or by coordinates is taken as meant, also where it is the centre of mass.

    Parameters
    ----------
    mechanism, raw : Mechanism, mapping
        A mechanism and its description.
    """
    joints = raw.get("joints", {})
    values = {p.name: p.value for p in mechanism.parameters}
    bodies = {body.name: body for body in mechanism.bodies}
    for name, joint in joints.items():
        for body, point in _ends_of_joint(joint):
            if point != CENTRE or body not in bodies:
                continue
            place = [evaluate_formula(x, values, f"bodies.{body}.centre_of_mass") for x in bodies[body].centre_of_mass]
            if any(place):
                where = ", ".join(f"{x:.6g}" for x in place)
                yield (
                    f'joints.{name}.at: "{CENTRE}" is the centre of mass of {body}, [{where}] m in its frame; '
                    'write "origin" for the origin of the frame, or name the point if the centre of mass is meant'
                )


def _ends_of_joint(joint: Mapping[str, object]) -> Iterator[tuple[object, object]]:
    """Yield body and point of each end of a joint that has its points under ``at``."""
    between, at = joint.get("between"), joint.get("at")
    if isinstance(between, list | tuple) and isinstance(at, list | tuple):
        yield from ((body, point) for body, point in zip(between, at, strict=False) if body != GROUND)
