"""A chain of rods hung between two walls, built in Python, checked, and written as a mechanism file."""

from __future__ import annotations

import math
import sys

from symgen.describe import MechanismBuilder


def chain(links: int, span: float = 1.5, length: float = 0.25) -> MechanismBuilder:
    """Return a chain of `links` equal rods whose ends hang on pins `span` apart.

    The rods start on a polygon inscribed in a circular arc, so every pin is closed.
    """
    if not links * length > span:
        raise ValueError("the chain is shorter than the span")
    chord = _half_chord(links, span / length)
    radius = length / (2 * math.sin(chord))
    builder = (
        MechanismBuilder("hanging-chain", title=f"Chain of {links} rods between two pins", gravity=(0.0, -9.81))
        .parameter("rod_mass", 0.2, unit="kg")
        .parameter("friction", 1e-3, unit="N m s/rad", note="in every pin")
        .run(until=5.0, step=1e-3)
    )
    for i in range(links):
        # Where the middle of rod i is, seen from the arc's centre: the whole arc spans 2*links half chords.
        turn = (2 * i + 1 - links) * chord
        height = radius * math.cos(chord)
        builder.body(
            f"rod{i}",
            mass="rod_mass",
            inertia=f"rod_mass*{length}**2/12",
            points={"left": (-length / 2, 0.0), "right": (length / 2, 0.0)},
            position=(span / 2 + height * math.sin(turn), radius * math.cos(links * chord) - height * math.cos(turn)),
            angle=turn,
        )
    builder.joint("pin0", "revolute", between=("ground", "rod0"), at=((0.0, 0.0), "left"))
    for i in range(1, links):
        builder.joint(f"pin{i}", "revolute", between=(f"rod{i - 1}", f"rod{i}"), at=("right", "left"))
        builder.force(f"friction{i}", "torsional-spring-damper", between=(f"rod{i - 1}", f"rod{i}"), damping="friction")
    return builder.joint(f"pin{links}", "revolute", between=("ground", f"rod{links - 1}"), at=((span, 0.0), "right"))


def _half_chord(links: int, ratio: float) -> float:
    """Return half the angle c of one rod on the arc, sin(links c) / sin(c) = ratio, by bisection."""
    low, high = 1e-9, math.pi / links
    while high - low > 1e-15:
        middle = (low + high) / 2
        if math.sin(links * middle) / math.sin(middle) > ratio:
            low = middle
        else:
            high = middle
    return low


if __name__ == "__main__":
    model = chain(int(sys.argv[1]) if len(sys.argv) > 1 else 8)
    mechanism = model.build()
    rows = sum(len(joint.rows) for joint in mechanism.joints)
    print(f"# {len(mechanism.bodies)} bodies, {rows} constraint rows")
    print(model.to_toml(), end="")
