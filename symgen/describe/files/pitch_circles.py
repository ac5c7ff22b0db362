"""Gears by pitch radii whose axes are elsewhere than these radii say, so that their teeth cannot mesh."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from symgen.base.vocabulary.measures import Angle, Holonomic, Marker, Sum
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.joints._space import markers_of_joint
from symgen.describe.mechanism import Mechanism

#: Part of the distance of two axes by which it may be off: radii are often rounded.
_ROUNDED = 1e-3


def warnings_on_gears(mechanism: Mechanism, raw: Mapping[str, Any]) -> Iterator[str]:
    """Yield a sentence for each gear of the plane whose pins on the carrier are not as far apart as its radii say.

    The ratio of the radii holds all the same. A gear without pins on its carrier, or with a `ratio`, has no circles.

    Parameters
    ----------
    mechanism, raw : Mechanism, mapping
        A mechanism and its description.
    """
    values = {p.name: p.value for p in mechanism.parameters}
    for gear in mechanism.joints:
        row = gear.rows[0] if gear.kind == "gear" and gear.rows else None
        if not isinstance(row, Holonomic) or row.unit != "m" or not isinstance(row.measure, Sum):
            continue
        measure = row.measure
        pins = [_pin_on_carrier(mechanism, angle) for _, angle in measure.terms if isinstance(angle, Angle)]
        if len(pins) != 2 or None in pins:
            continue
        places = [
            [evaluate_formula(x, values, f"joints.{gear.name}") for x in pin.point] for pin in pins if pin is not None
        ]
        radii = abs(sum(evaluate_formula(weight, values, f"joints.{gear.name}.radii") for weight, _ in measure.terms))
        apart = math.dist(*places)
        if abs(apart - radii) > _ROUNDED * max(apart, radii):
            yield (
                f"joints.{gear.name}.radii: the axes are {apart:.6g} m apart, and the pitch circles touch at "
                f"{radii:.6g} m; write ratio where the radii are not meant as such"
            )


def _pin_on_carrier(mechanism: Mechanism, angle: Angle) -> Marker | None:
    """Return the point of the carrier on which a pin holds a wheel, None without one."""
    for joint in mechanism.joints:
        if joint.kind == "revolute" and joint.rows and {*joint.bodies} == {angle.a, angle.b}:
            return next(marker for marker in markers_of_joint(joint) if marker.body == angle.b)
    return None
