"""One step from Python in MuJoCo and Pinocchio: ``python -m benchmarks.peers.step --model four-bar``.

What is timed is a call that a loop in Python makes for every step, and, where the tool has such a thing, one step of
many in one call. Both tools use Runge-Kutta of order four with the same step. Each is left out where it is not
installed. Rows are ``{"peer", "version", "setting", "step", "inside"}``: least seconds of batches of steps, ``null``
where there is no such call.
"""

from __future__ import annotations

import argparse
import importlib
import json
import math
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TypedDict

import numpy as np

from . import models
from .models import GROUND, Model, rotate

#: Steps of a batch, and batches.
COUNT, BATCHES = 500, 200


class StepRow(TypedDict):
    """Seconds of a step: called from Python, and as one of many in one call."""

    peer: str
    version: str
    setting: str
    step: float | None
    inside: float | None


def least(batch: Callable[[], object], count: int = COUNT, batches: int = BATCHES) -> float:
    """Return the least time of a batch over its steps [s].

    Parameters
    ----------
    batch : callable
        Makes `count` steps.
    count, batches : int
        Steps of a batch, and how many batches are timed; one comes before to warm up.
    """
    batch()
    best = math.inf
    for _ in range(batches):
        began = time.perf_counter()
        batch()
        best = min(best, time.perf_counter() - began)
    return best / count


def mujoco_row(model: Model, step: float) -> StepRow:
    """Time ``mj_step``, alone and with many steps in a call."""
    import mujoco

    from .mujoco_peer import SPRINGS, write

    compiled = mujoco.MjModel.from_xml_string(write(model, step, SPRINGS[0])[0])
    data = mujoco.MjData(compiled)

    def single() -> None:
        call = mujoco.mj_step
        for _ in range(COUNT):
            call(compiled, data)

    def many() -> None:
        mujoco.mj_step(compiled, data, nstep=COUNT)

    setting = f"mj_step, RK4 {step:g} s, Newton, dense"
    return StepRow(peer="mujoco", version=mujoco.__version__, setting=setting, step=least(single), inside=least(many))


def pinocchio_row(model: Model, step: float) -> StepRow:
    """Time RK4 written in Python around ``constraintDynamics``; loops are closed by points."""
    import pinocchio as pin

    robot, (centres, _), (tree, loops) = pin.Model(), model.place(), model.tree()
    robot.gravity.linear = np.array([0.0, -model.gravity, 0.0])
    joints, pins = {GROUND: 0}, {GROUND: np.zeros(2)}
    for joint in tree:  # all frames parallel at the start
        body = model.bodies[joint.b]
        pins[joint.b] = centres[joint.b] + rotate(body.angle, joint.point_b)
        offset = np.append(pins[joint.b] - pins[joint.a], 0.0)
        place = pin.SE3(np.eye(3), offset)
        joints[joint.b] = robot.addJoint(joints[joint.a], pin.JointModelRZ(), place, body.name)
        middle = np.append(centres[joint.b] - pins[joint.b], 0.0)
        inertia = pin.Inertia(body.mass, middle, np.diag(np.full(3, body.inertia)))
        robot.appendBodyToJoint(joints[joint.b], inertia, pin.SE3.Identity())

    def at(body: int, point: tuple[float, float]) -> np.ndarray:
        if body == GROUND:
            return np.append(point, 0.0)
        return np.append(centres[body] + rotate(model.bodies[body].angle, point) - pins[body], 0.0)

    closures = [
        pin.RigidConstraintModel(
            *(pin.ContactType.CONTACT_3D, robot),
            *(joints[loop.a], pin.SE3(np.eye(3), at(loop.a, loop.point_a))),
            *(joints[loop.b], pin.SE3(np.eye(3), at(loop.b, loop.point_b)), pin.ReferenceFrame.LOCAL),
        )
        for loop in loops
    ]
    data, memory = robot.createData(), [closure.createData() for closure in closures]
    pin.initConstraintDynamics(robot, data, closures, memory)
    torque, proximal = np.zeros(robot.nv), pin.ProximalSettings(1e-12, 1e-8, 5)
    state = [pin.neutral(robot), np.zeros(robot.nv)]

    def rates(q: np.ndarray, v: np.ndarray) -> np.ndarray:
        a: np.ndarray = pin.constraintDynamics(robot, data, q, v, torque, closures, memory, proximal).copy()
        return a

    def advance() -> None:
        q, v = state
        a1 = rates(q, v)
        v2 = v + 0.5 * step * a1
        a2 = rates(q + 0.5 * step * v, v2)
        v3 = v + 0.5 * step * a2
        a3 = rates(q + 0.5 * step * v2, v3)
        v4 = v + step * a3
        a4 = rates(q + step * v3, v4)
        state[:] = q + step / 6 * (v + 2 * (v2 + v3) + v4), v + step / 6 * (a1 + 2 * (a2 + a3) + a4)

    def single() -> None:
        for _ in range(COUNT):
            advance()

    setting = f"constraintDynamics, RK4 {step:g} s in Python, mu 1e-8"
    return StepRow(peer="pinocchio", version=pin.__version__, setting=setting, step=least(single), inside=None)


ROWS: dict[str, Callable[[Model, float], StepRow]] = {"mujoco": mujoco_row, "pinocchio": pinocchio_row}


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the rows of the tools that are installed, as JSON."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.peers.step", description=__doc__)
    parser.add_argument("--model", default="four-bar", help=f"one of {', '.join(models.NAMES)}")
    parser.add_argument("--step", type=float, default=1e-3, help="step [s]")
    parser.add_argument("--json", type=Path, help="file for the rows")
    options = parser.parse_args(arguments)
    model, rows = models.load(options.model), list[StepRow]()
    for name, row in ROWS.items():
        try:
            importlib.import_module(name)
        except ImportError:
            continue
        rows.append(row(model, options.step))
    text = json.dumps(rows, indent=1)
    if options.json is not None:
        options.json.write_text(text + "\n", encoding="utf-8")
    print(text)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
