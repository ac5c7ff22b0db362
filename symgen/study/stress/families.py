"""Families of stiff and extreme cases: the varied quantity, its values, and the cases of a base."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

import numpy as np

from symgen.base.vocabulary.expressions import ZERO
from symgen.derive.methods import METHODS
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.joints import JOINTS
from symgen.describe.parts.scope import CENTRE, ORIGIN
from symgen.study.stress.at_limits import contradiction, grip, pull_off, slope, wedge
from symgen.study.stress.bench import DAMPING, GRAVITY, INERTIA, MASS, STIFFNESS, Base, Level, NotApplicable
from symgen.study.stress.own_mechanisms import (
    bodies,
    driver_rate,
    length_ratio,
    near_singular,
    scale,
    singular_passage,
    stiff_periods,
)

#: Unit in the last place of numbers from 1 to 2.
EPSILON = 2.0**-52
#: Stiffness beside light bodies, and those of the families of springs and dampers [N/m, N s/m].
_SPRING = 1e4
_SPRINGS, _QUICK_SPRINGS = (1e2, 1e4, 1e6, 1e8, 1e10), (1e4, 1e6)


@dataclass(frozen=True)
class Family:
    """Family of cases.

    Attributes
    ----------
    level : callable
        (base, value) -> case, None where the base has none for this value; raises `NotApplicable` where it has none at
        all.
    values, quick : sequence
        Of all cases, and of a quick study.
    own : bool
        The family has a mechanism of its own: it is run once, whatever the base models.
    """

    level: Callable[[Base, Any], Level | None]
    values: Sequence[Any]
    quick: Sequence[Any]
    own: bool = False


def levels_of_family(family: str, base: Base, quick: bool) -> list[Level]:
    """Return the cases of a family, without repeated values.

    Raises
    ------
    NotApplicable
        If the base has none.
    """
    kind = FAMILIES[family]
    levels = [kind.level(base, value) for value in (kind.quick if quick else kind.values)]
    distinct = {level.values: level for level in levels if level is not None}
    return [replace(level, family=family) for level in distinct.values()]


# -- handles of the base -----------------------------------------------------------------------------------------------


def stiffness(base: Base, k: float) -> Level:
    """Return the case of a spring on the middle body, unloaded at the start; stiffer ones last shorter."""
    base.need_spring()
    until = base.nominal_values * min(1.0, (1e6 / k) ** 0.25)
    return base.build_level(f"{k:g} N/m", k, parameters={STIFFNESS: k}, until=until, spring_end=base.spring_end)


def damping(base: Base, c: float) -> Level:
    """Return the case of a damper between the ground and the middle body."""
    base.need_spring()
    return base.build_level(f"{c:g} N s/m", c, parameters={DAMPING: c})


def mass_ratio(base: Base, factor: float) -> Level:
    """Return the case of a factor on mass and inertia of the middle body."""
    if len(base.mechanism.bodies) < 2:
        raise NotApplicable("it has one body, so no ratio of masses")
    return base.build_level(f"mass x {factor:g}", factor, parameters={MASS: factor})


def inertia_ratio(base: Base, factor: float) -> Level:
    """Return the case of a factor on the moments of inertia of the middle body alone."""
    inertia = base.raw.get("bodies", {}).get(base.middle, {}).get("inertia", 0.0)
    if inertia == 0.0 or len(base.mechanism.bodies) < 2:
        raise NotApplicable("its middle body has no inertia to change beside another body")
    return base.build_level(f"inertia x {factor:g}", factor, parameters={INERTIA: factor})


def light_and_stiff(base: Base, factor: float) -> Level:
    """Return the case of a light middle body on a spring of 1e4 N/m: the motion is as fast as both make it."""
    if len(base.mechanism.bodies) < 2:
        raise NotApplicable("it has one body, so no ratio of masses")
    spring = stiffness(base, _SPRING)
    label, parameters = f"mass x {factor:g}, {_SPRING:g} N/m", {**spring.parameters, MASS: factor}
    return replace(spring, label=label, values=(factor,), parameters=parameters)


def rounded_start(base: Base, bits: float) -> Level:
    """Return the case of a start whose middle body is described some units in the last place of the size away."""
    away = inconsistent_start(base, bits * EPSILON)
    return replace(away, label=f"{bits:g} units in the last place", values=(bits,))


def gravity(base: Base, g: float) -> Level:
    """Return the case of an acceleration; the stronger, the shorter, as the motion is faster."""
    until = base.nominal_values / math.sqrt(max(1.0, g / 10.0))
    return base.build_level(f"{g:g} m/s^2", g, parameters={GRAVITY: g / base.gravity}, until=until)


def duration(base: Base, steps: float) -> Level:
    """Return the case of a length in steps of the mechanism, none longer than the motion can be predicted.

    The longest runs have steps twice as long, so that methods with constant steps stay within the budget of
    evaluations.
    """
    until = min(steps * base.step, base.mechanism.defaults.predictable_until or math.inf)
    step = base.step * (2.0 if until >= 1e6 * base.step else 1.0)
    return base.build_level(f"{until:g} s", until, until=until, step=step, outputs=100, closed=base.closed)


def step(base: Base, factor: float) -> Level:
    """Return the case of a constant step, as a multiple of the mechanism's own."""
    h = factor * base.step
    return base.build_level(f"{h:g} s", h, step=h, constant_steps=True, closed=base.closed)


# -- starts and joints -------------------------------------------------------------------------------------------------


def inconsistent_start(base: Base, share: float) -> Level:
    """Return the case of a middle body described away from where it can be, with velocities that it cannot have.

    The displacement is a fraction of the mechanism's size, the velocity the same fraction of its size a second.
    """
    away, signs = share * base.size, ("+", "-", "+")[: len(base.anchor)]
    if base.middle not in base.raw.get("bodies", {}):
        raise NotApplicable("the middle body is a node of a beam, which follows from its ends")
    at = base.raw["bodies"][base.middle].get("position", [0.0] * len(signs))
    position = [f"({x}){sign}{away!r}" for x, sign in zip(at, signs, strict=True)]
    moved = {"position": position, "velocity": [away] * len(signs), "hold": None}  # it could not be closed
    return base.build_level(f"{away:g} m away", away, mechanism=base.build({"bodies": {base.middle: moved}}))


def spin_rate(base: Base, rate: float) -> Level:
    """Return the case of a body on a pin in the ground that starts turning, some fifty turns long."""
    if base.mechanism.space != "planar":
        raise NotApplicable("a spin rate is set in the plane only")
    joints = base.raw.get("joints", {}).values()
    if any(joint["type"] == "driver" for joint in joints):
        raise NotApplicable("a driver prescribes its speed")
    pins = (joint["between"] for joint in joints if joint["type"] == "revolute")
    turning = next((second for first, second in pins if first == "ground"), None)
    if turning is None:
        raise NotApplicable("no body is pinned to the ground as the first of a joint's bodies")
    bodies = {
        body.name: {"velocity": None, "angular_velocity": rate if body.name == turning else None}
        for body in base.mechanism.bodies
    }
    mechanism, until = base.build({"bodies": bodies}), min(base.nominal_values, 300.0 / rate)
    return base.build_level(f"{rate:g} rad/s", rate, mechanism=mechanism, until=until)


def redundancy(base: Base, count: float) -> Level | None:
    """Return the case of one or two bars more, each beside a body that is pinned at either end.

    They repeat other constraints on the constraint manifold only, so that no derivation can drop them.
    """
    if base.mechanism.space not in JOINTS.get("distance").SPACES:
        raise NotApplicable(f"there is no distance joint in {base.mechanism.space} mechanisms")
    bars = _bar_tables(base)[: int(count)]
    if not bars:
        raise NotApplicable("no body is pinned to the ground and to another body")
    if len(bars) < count:
        return None
    joints = {f"stress_bar{i}": bar for i, bar in enumerate(bars)}
    mechanism = base.build({"joints": joints}, f"redundant-{int(count)}")
    label = f"{int(count)} bar{'s' if count > 1 else ''} more"
    return base.build_level(label, count, mechanism=mechanism, plain=base.stressed, closed=base.closed)


def _bar_tables(base: Base) -> list[dict[str, Any]]:
    """Return distance joints between a pin in the ground and the next pin, on the body beyond it."""
    pins = [joint for joint in base.raw.get("joints", {}).values() if joint["type"] == "revolute"]
    bars = list[dict[str, Any]]()
    for first in pins:
        if first["between"][0] != "ground":
            continue
        body = first["between"][1]
        for second in pins:
            if body not in second["between"] or "ground" in second["between"]:
                continue
            here = second["between"].index(body)
            length = math.dist(_point_table(base, body, first["at"][1]), _point_table(base, body, second["at"][here]))
            if length < 1e-9:
                continue
            between, at = ["ground", second["between"][1 - here]], [first["at"][0], second["at"][1 - here]]
            bars.append({"type": "distance", "between": between, "at": at, "length": length})
            break
    return bars


def _point_table(base: Base, body: str, at: Any) -> tuple[float, ...]:
    described = base.mechanism.body(body)
    if isinstance(at, str):
        origin = {ORIGIN: (ZERO,) * len(described.centre_of_mass)}
        point = {**origin, **dict(described.points), CENTRE: described.centre_of_mass}[at]
        return tuple(evaluate_formula(x, base.values, body) for x in point)
    return tuple(float(x) for x in at)


# -- options of methods ------------------------------------------------------------------------------------------------


def penalty_factor(base: Base, a: float) -> Level:
    """Return the case of a penalty, of the methods that have one."""
    methods = tuple(name for name, method in METHODS.items() if any(p.name == "penalty" for p in method.parameters))
    return base.build_level(f"a = {a:g}", a, options={"method.penalty": a}, methods=methods, closed=base.closed)


def baumgarte_gain(base: Base, x: float) -> Level:
    """Return the case of gains alpha = beta = x / h, h being the mechanism's step; both roots are -alpha."""
    gains = {"method.alpha": x / base.step, "method.beta": x / base.step}
    return base.build_level(
        f"alpha h = {x:g}", x / base.step, options=gains, methods=("baumgarte",), closed=base.closed
    )


def motion_gain(base: Base, x: float) -> Level:
    """Return the case of gains alpha = beta = x r with `rk4`, r being the rate rms(v') / rms(v) of the first second."""
    if base.rate is None:
        raise NotApplicable(f"nothing moves in the first second of {base.name}")
    return base.build_level(
        f"alpha = {x:.3g} r",
        x,
        options={"method.alpha": x * base.rate, "method.beta": x * base.rate},
        pairs=(("baumgarte", "rk4"),),
        watched=False,
        closed=base.closed,
    )


def alpha_beta(base: Base, gains: tuple[float, float]) -> Level:
    """Return the case of both gains times the mechanism's step, with `rk4` at that step."""
    alpha, beta = (x / base.step for x in gains)
    return base.build_level(
        "alpha h = {:g}, beta h = {:g}".format(*(round(x, 3) for x in gains)),
        *(alpha, beta),
        options={"method.alpha": alpha, "method.beta": beta},
        pairs=(("baumgarte", "rk4"),),
        watched=False,
        closed=base.closed,
    )


def step_stiffness(base: Base, point: tuple[float, float]) -> Level:
    """Return the case of a stiffness and a step, for an explicit and three implicit schemes."""
    spring, h = stiffness(base, point[0]), point[1] * base.step
    pairs = (
        *(("direct-correction", "rk4"), ("penalty", "rk4")),
        *(("generalized-alpha", "generalized-alpha"), ("index3-augmented-lagrangian", "trapezoidal")),
    )
    label, values = f"{spring.label}, {h:g} s", (*spring.values, h)
    return replace(spring, label=label, values=values, step=h, pairs=pairs, watched=False)


# -- all of them -------------------------------------------------------------------------------------------------------

# what holds over what pulls, just below and just above the limit
_RATIOS, _QUICK_RATIOS = (0.98, 0.999, 1.001, 1.02), (0.999, 1.001)
# five gains tell the limit of stability to a factor of 4
_GRID, _QUICK_GRID = (np.geomspace(0.05, 12.8, points).tolist() for points in (15, 5))

FAMILIES: Mapping[str, Family] = {
    "alpha-beta": Family(alpha_beta, tuple(product(_GRID, _GRID)), tuple(product(_QUICK_GRID, _QUICK_GRID))),
    "baumgarte-gain": Family(baumgarte_gain, (1e-3, 1e-2, 1e-1, 1.0, 2.5, 3.0, 1e1), (1e-2, 3.0)),
    "bodies": Family(bodies, (1.0, 4.0, 16.0), (4.0,), own=True),
    "contradiction": Family(contradiction, (1e-12, 1e-6, 1e-3, 1e-1), (1e-12, 1e-3), own=True),
    "damping": Family(damping, _SPRINGS, _QUICK_SPRINGS),
    "driver-rate": Family(driver_rate, (1e1, 1e3, 1e5, 1e7), (1e1, 1e5), own=True),
    "duration": Family(duration, (1e4, 1e5, 2e6), (1e4,)),
    "gain": Family(motion_gain, np.geomspace(0.01, 31.6, 15).tolist(), np.geomspace(0.01, 31.6, 8).tolist()),
    "gravity": Family(gravity, (0.0, 1e1, 1e2, 1e3, 1e4), (0.0, 1e3)),
    "grip": Family(grip, _RATIOS, _QUICK_RATIOS, own=True),
    "inconsistent-start": Family(inconsistent_start, (1e-6, 1e-3, 1e-2, 1e-1), (1e-2,)),
    "inertia-ratio": Family(inertia_ratio, (1e-9, 1e-3, 1e3, 1e9), (1e-9,)),
    "length-ratio": Family(length_ratio, (1.0, 1e1, 1e2, 1e4, 1e6), (1.0, 1e2), own=True),
    "light-stiff": Family(light_and_stiff, (1e-6, 1e-3, 1e-1), (1e-3,)),
    "mass-ratio": Family(mass_ratio, (1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9), (1e-9, 1e3)),
    "near-singular": Family(near_singular, (1e-1, 1e-2, 1e-3, 1e-4), (1e-3,), own=True),
    "penalty-factor": Family(penalty_factor, (1e2, 1e4, 1e6, 1e8, 1e10, 1e12), (1e4, 1e8, 1e12)),
    "pull-off": Family(pull_off, _RATIOS, _QUICK_RATIOS, own=True),
    "redundancy": Family(redundancy, (1.0, 2.0), (1.0,)),
    "rounded-start": Family(rounded_start, (1.0, 1e3), (1.0,)),
    "scale": Family(scale, tuple(product((-9.0, -3.0, 0.0, 9.0), (-12.0, -9.0, 0.0, 9.0))), ((-3.0, -6.0),), own=True),
    "singular-passage": Family(singular_passage, (0.0, 1e-4, 1e-3, 1e-2, 1e-1), (0.0, 1e-1), own=True),
    "slope": Family(slope, _RATIOS, _QUICK_RATIOS, own=True),
    "spin-rate": Family(spin_rate, (1e1, 1e2, 1e3, 1e4), (1e2, 1e4)),
    "step": Family(step, (1e-2, 1e-1, 1.0, 1e1, 1e2), (1.0, 1e1)),
    "step-stiffness": Family(
        step_stiffness,
        tuple(product(_SPRINGS, (0.03, 0.1, 0.3, 1.0, 3.0, 10.0))),
        tuple(product(_QUICK_SPRINGS, (0.1, 1.0, 10.0))),
    ),
    "stiff-periods": Family(stiff_periods, (1e2, 1e3, 1e4), (1e2,), own=True),
    "stiffness": Family(stiffness, _SPRINGS, _QUICK_SPRINGS),
    "wedge": Family(wedge, _RATIOS, _QUICK_RATIOS, own=True),
}
