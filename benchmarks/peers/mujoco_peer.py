"""MuJoCo: hinge joints in a tree, loops closed by connect constraints.

The Runge-Kutta integrator with the Newton solver on dense Jacobians, islands
and every other stage that these mechanisms do not use switched off. MuJoCo's
constraints are springs by design; their time constant, in steps, and damping
ratio are part of the setting. ``refsafe`` is off so that it is used as given.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import mujoco
import numpy as np

from . import reference
from .measure import Measured, Row, best_of, row
from .models import GROUND, Array, Joint, Model, Point, rotate

NAME = "mujoco"
VERSION = str(mujoco.__version__)
REFINEMENTS = (0.5, 1.0, 1.2, 1.5, 2.0, 3.0, 4.0, 8.0)
SPRINGS = ((2.0, 1.0), (4.0, 1.0), (16.0, 0.3))
# Where constraints become dependent only the stiffest springs keep the branch well.
SPRINGS_SINGULAR = ((0.4, 1.0), (0.5, 1.0), (1.0, 1.0), (2.0, 1.0))
IMPEDANCE = "0.9999 0.9999 0.001 0.5 1"
LIMIT = 3.0
OFF = (
    "contact",
    "frictionloss",
    "limit",
    "clampctrl",
    "warmstart",
    "filterparent",
    "actuation",
    "sensor",
    "refsafe",
    "autoreset",
    "island",
)


def rows(model: Model) -> Iterator[Row]:
    """Measure every setting.

    Parameters
    ----------
    model : Model
        The mechanism.

    Yields
    ------
    Row
        One result per setting; finer steps end once a loop takes `LIMIT` seconds.
    """
    mujoco.set_mju_user_warning(lambda _: None)
    truth = reference.angles(model)
    for constant, ratio in SPRINGS_SINGULAR if "windows" in model.parameters else SPRINGS:
        for factor in REFINEMENTS:
            steps = round(model.duration / model.step / reference.INTERVALS * factor)
            step = model.duration / reference.INTERVALS / steps
            out = row(
                NAME,
                VERSION,
                f"RK4 {step:.3g} s, constraints {constant:g} steps, ratio {ratio:g}",
                model.name,
                partial(_run, model, steps, (constant, ratio), truth),
            )
            yield out
            if (out["seconds"] or 0.0) > LIMIT:
                break


def _numbers(values: Array) -> str:
    """Write numbers to all digits."""
    return " ".join(repr(float(value)) for value in values)


def write(model: Model, step: float, spring: tuple[float, float]) -> tuple[str, list[int]]:
    """Write a mechanism in MuJoCo's format.

    The reference configuration is the initial one, with all frames parallel.

    Parameters
    ----------
    model : Model
        The mechanism.
    step : float
        Time step in s.
    spring : tuple of float
        Time constant in steps and damping ratio of the constraints.

    Returns
    -------
    text : str
        The model as XML.
    order : list of int
        The body that each hinge moves, in the order of the hinges.
    """
    centres, _ = model.place()
    tree, loops = model.tree()
    hinge = {j.b: centres[j.b] + rotate(model.bodies[j.b].angle, j.point_b) for j in tree}
    sites: dict[int, list[str]] = {body: [] for body in range(GROUND, len(model.bodies))}
    order: list[int] = []

    def add_site(name: str, body: int, point: Point) -> None:
        place = np.array(point)
        if body != GROUND:
            place = centres[body] + rotate(model.bodies[body].angle, point) - hinge[body]
        sites[body].append(f'<site name="{name}" pos="{_numbers(place)} 0"/>')

    def add_body(joint: Joint) -> str:
        body, item = joint.b, model.bodies[joint.b]
        order.append(body)
        offset = hinge[body] - (hinge[joint.a] if joint.a != GROUND else np.zeros(2))
        inertia = _numbers(np.full(3, item.inertia))
        children = "".join(add_body(child) for child in tree if child.a == body)
        return (
            f'<body pos="{_numbers(offset)} 0"><joint type="hinge" axis="0 0 1"/>'
            f'<inertial pos="{_numbers(centres[body] - hinge[body])} 0" mass="{item.mass!r}" '
            f'diaginertia="{inertia}"/>{"".join(sites[body])}{children}</body>'
        )

    equalities, tendons = [], []
    reference_spring = f"{spring[0] * step!r} {spring[1]!r}"
    for i, joint in enumerate(loops):
        add_site(f"a{i}", joint.a, joint.point_a)
        add_site(f"b{i}", joint.b, joint.point_b)
        equalities.append(f'<connect site1="a{i}" site2="b{i}" solref="{reference_spring}" solimp="{IMPEDANCE}"/>')
    for i, item in enumerate(model.springs):
        add_site(f"s{i}", item.body, item.point)
        add_site(f"t{i}", GROUND, item.anchor)
        tendons.append(
            f'<spatial stiffness="{item.stiffness!r}" springlength="{item.length!r}">'
            f'<site site="s{i}"/><site site="t{i}"/></spatial>'
        )
    bodies = "".join(add_body(joint) for joint in tree if joint.a == GROUND)
    flags = " ".join(f'{flag}="disable"' for flag in OFF)
    text = (
        '<mujoco><compiler angle="radian" boundmass="0" boundinertia="0"/>'
        f'<option timestep="{step!r}" integrator="RK4" gravity="0 {-model.gravity!r} 0" solver="Newton" '
        f'iterations="100" tolerance="1e-12" jacobian="dense"><flag {flags}/></option>'
        f"<worldbody>{''.join(sites[GROUND])}{bodies}</worldbody>"
        f"<equality>{''.join(equalities)}</equality><tendon>{''.join(tendons)}</tendon></mujoco>"
    )
    return text, order


def _run(model: Model, steps: int, spring: tuple[float, float], truth: Array) -> Measured:
    """Integrate with so many steps between two samples."""
    text, order = write(model, model.duration / reference.INTERVALS / steps, spring)
    compiled = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(compiled)
    above = {joint.b: joint.a for joint in model.tree()[0]}
    # A body turns by the sum of the hinge angles between it and the ground.
    chain = np.zeros((len(order), len(order)))
    for body in range(len(order)):
        link = body
        while link != GROUND:
            chain[body, order.index(link)] = 1.0
            link = above[link]
    speeds = np.linalg.solve(chain, np.array([body.rate for body in model.bodies]))
    torques = np.zeros(len(order))
    for body, torque in model.torques.items():
        torques += torque * chain[body]
    hinges = np.zeros((reference.INTERVALS + 1, len(order)))

    def loop() -> None:
        mujoco.mj_resetData(compiled, data)
        data.qvel[:] = speeds
        data.qfrc_applied[:] = torques
        for i in range(1, len(hinges)):
            mujoco.mj_step(compiled, data, steps)
            hinges[i] = data.qpos
            if not abs(hinges[i, 0]) < 1e6:
                raise FloatingPointError("diverged")

    loop()
    values = hinges @ chain.T + np.array([body.angle for body in model.bodies])
    return *best_of(loop), reference.largest_error(values, truth)
