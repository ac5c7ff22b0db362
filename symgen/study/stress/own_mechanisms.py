"""Cases with mechanisms of their own, whatever mechanism is studied: linkages of adjustable lengths, and chains."""

from __future__ import annotations

import math
from functools import lru_cache

from symgen.describe.files.builder import MechanismBuilder
from symgen.describe.files.builder_keys import BodyKeys
from symgen.describe.files.load import load_mechanism
from symgen.describe.mechanism import Mechanism
from symgen.study.stress.bench import STANDARD_GRAVITY, Base, Level

#: Angular frequency of the undamped spring [rad/s].
OSCILLATOR_RATE = 1e3


def length_ratio(base: Base, ratio: float) -> Level:
    """Return the case of a four-bar linkage with a crank of 1 m and other links that are longer by a ratio.

    Errors count in lengths of the crank: on the other links its motion is none.
    """
    mechanism = quadrilateral(1.0, 4.0 * ratio, 2.5 * ratio, 5.0 * ratio, math.pi / 3.0)
    return Level(f"1 : {ratio:g}", (ratio,), mechanism, until=2.0, step=1e-3, length=1.0)


def scale(base: Base, powers: tuple[float, float]) -> Level:
    """Return the case of a four-bar linkage of other lengths and masses, with gravity like the lengths.

    Angles are the same at all scales: what differs is rounding, and every number that has a unit.
    """
    size, mass = (10.0**power for power in powers)
    mechanism = quadrilateral(
        size, 4.0 * size, 2.5 * size, 5.0 * size, math.pi / 3.0, 0.0, mass, STANDARD_GRAVITY * size
    )
    label = f"lengths x {size:g}, masses x {mass:g}"
    return Level(label, (size, mass), mechanism, until=2.0, step=1e-3)


def driver_rate(base: Base, rate: float) -> Level:
    """Return the case of a four-bar linkage whose crank shakes by 0.01 rad at a rate [rad/s], for ten periods."""
    mechanism = quadrilateral(1.0, 4.0, 2.5, 5.0, math.pi / 3.0, 0.01 * rate, rate=rate)
    period = 2.0 * math.pi / rate
    return Level(f"{rate:g} rad/s", (rate,), mechanism, until=10.0 * period, step=period / 100.0)


def bodies(base: Base, count: float) -> Level:
    """Return the case of a chain of four-bar linkages, Bayo's benchmark, with some number of loops."""
    mechanism = load_mechanism(f"n-four-bar:{int(count)}")
    return Level(f"{int(count)} loops", (count,), mechanism, until=1.0, step=mechanism.defaults.step)


def stiff_periods(base: Base, count: float) -> Level:
    """Return the case of an undamped spring of 1e6 N/m that moves 1 kg on a guide for some number of periods."""
    builder = MechanismBuilder("oscillator").run(until=1.0, step=1e-4)
    builder.body("slider", mass=1.0, inertia=0.1, position=(0.1, 0.0))
    builder.joint("guide", "translational", between=("ground", "slider"), at=((0.0, 0.0), "centre"), axis=(1.0, 0.0))
    builder.force("spring", "spring-damper", joint="guide", stiffness=OSCILLATOR_RATE**2)
    period, mechanism = 2.0 * math.pi / OSCILLATOR_RATE, builder.build()
    label, until = f"{count:g} periods", count * period
    return Level(label, (count,), mechanism, until=until, step=period / 50.0, outputs=97, closed="oscillator")


def near_singular(base: Base, gap: float) -> Level:
    """Return the case of two parallel cranks whose pins are a gap apart [m]: rows are almost dependent all the time."""
    mechanism = quadrilateral(1.0, gap, 1.0, gap, -math.pi / 3.0)  # they hang, and do not come to lie flat
    return Level(f"pins {gap:g} m apart", (gap,), mechanism, until=2.0, step=1e-3)


def singular_passage(base: Base, gap: float) -> Level:
    """Return the case of a parallelogram whose base is longer than the coupler by a gap [m]; 0 is singular."""
    mechanism = quadrilateral(1.0, 1.0, 1.0, 1.0 + gap, math.pi / 2.0, -1.0)
    closed = None if gap else "parallelogram"
    return Level(f"gap {gap:g} m", (gap,), mechanism, until=4.0, step=1e-3, outputs=160, closed=closed)


@lru_cache(maxsize=64)
def quadrilateral(
    crank: float,
    coupler: float,
    rocker: float,
    base: float,
    angle: float,
    spin: float = 0.0,
    mass: float = 1.0,
    gravity: float = 9.81,
    rate: float = 0.0,
) -> Mechanism:
    """Return a four-bar linkage of uniform rods of one mass, closed with the joint of coupler and rocker above.

    Parameters
    ----------
    crank, coupler, rocker, base : float
        Lengths [m]; they are parameters, so all these mechanisms have the same equations.
    angle, spin : float
        Of the crank at the start [rad, rad/s].
    mass, gravity : float
        Mass of each rod [kg], and acceleration [m/s^2].
    rate : float
        Rate at which a driver shakes the crank by 0.01 rad [rad/s]; 0 without one.
    """
    bx, by = crank * math.cos(angle), crank * math.sin(angle)
    dx, dy = base - bx, -by
    d = math.hypot(dx, dy)
    along = (d * d + coupler * coupler - rocker * rocker) / (2.0 * d)
    across = math.sqrt(max(0.0, coupler * coupler - along * along))
    cx, cy = bx + (along * dx - across * dy) / d, by + (along * dy + across * dx) / d
    # Python writes these as names, so that mechanisms of all scales have the same equations
    builder = MechanismBuilder("quadrilateral", gravity=(0.0, "-rod_gravity")).run(until=5.0, step=1e-3)
    builder.parameter("rod_mass", mass, unit="kg").parameter("rod_gravity", gravity, unit="m/s^2")
    lengths = {"crank": crank, "coupler": coupler, "rocker": rocker, "base": base}
    for name, length in lengths.items():
        builder.parameter(f"{name}_length", length, unit="m")
    ends = {
        "crank": ((0.0, 0.0), (bx, by), "A", "B"),
        "coupler": ((bx, by), (cx, cy), "B", "C"),
        "rocker": ((base, 0.0), (cx, cy), "D", "C"),
    }
    for name, (start, end, first, second) in ends.items():
        turning: BodyKeys = {"angular_velocity": spin} if name == "crank" else {}
        builder.body(
            name,
            mass="rod_mass",
            inertia=f"rod_mass*{name}_length**2/12",
            points={first: (f"-{name}_length/2", 0.0), second: (f"{name}_length/2", 0.0)},
            position=((start[0] + end[0]) / 2.0, (start[1] + end[1]) / 2.0),
            angle=math.atan2(end[1] - start[1], end[0] - start[0]),
            **turning,  # type: ignore[misc]  # it has no other keys
        )
    builder.joint("A", "revolute", between=("ground", "crank"), at=((0.0, 0.0), "A"))
    builder.joint("B", "revolute", between=("crank", "coupler"), at=("B", "B"))
    builder.joint("C", "revolute", between=("coupler", "rocker"), at=("C", "C"))
    builder.joint("D", "revolute", between=("ground", "rocker"), at=(("base_length", 0.0), "D"))
    if rate:
        builder.parameter("crank_angle", angle, unit="rad").parameter("shaking", rate, unit="rad/s")
        shaken = "crank_angle + 0.01*sin(shaking*t)"
        builder.joint("motor", "driver", joint="A", coordinate="angle", value=shaken)
    return builder.build()
