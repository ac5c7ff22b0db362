"""MuJoCo: discs in a bin and boxes on each other, as models in a plane of its space."""

from __future__ import annotations

import time
from pathlib import Path

import mujoco
import numpy as np

from benchmarks.beside_siconos import BIN_MU, DROP, HALF, MU, RADIUS

VERSION = str(mujoco.__version__)
_PLANAR = (
    '<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/><joint type="hinge" axis="0 -1 0"/>'
    '<inertial pos="0 0 0" mass="1" diaginertia="1 {inertia!r} 1"/>'
)


def xml_of(scene: str, step: float, time_constant: float) -> str:
    """Return MuJoCo's model of a scene."""
    kind, count = scene.split()
    shapes, bodies = "", ""
    if kind == "discs":
        mu, inertia, shape = BIN_MU, 0.5 * RADIUS**2, f'<geom type="sphere" size="{RADIUS}"/>'
        places = [(0.12 * (i % 3) + 0.006 * (i // 3), RADIUS + 0.02 + 0.13 * (i // 3)) for i in range(int(count))]
        shapes = '<geom type="plane" size="9 9 1" pos="-0.06 0 0" zaxis="1 0 0"/>'
        shapes += '<geom type="plane" size="9 9 1" pos="0.3 0 0" zaxis="-1 0 0"/>'
    else:
        mu, inertia, shape = MU, 2.0 / 3.0 * HALF**2, f'<geom type="box" size="{HALF} {HALF} {HALF}"/>'
        places = [(0.0, HALF + (2.0 * HALF + DROP) * i + DROP) for i in range(int(count))]
    for x, z in places:
        bodies += f'<body pos="{x!r} 0 {z!r}">{_PLANAR.format(inertia=inertia)}{shape}</body>'
    return (
        f'<mujoco><option timestep="{step!r}" cone="elliptic" gravity="0 0 -9.81"/>'
        f'<default><geom friction="{mu} 0 0" solref="{time_constant!r} 1" condim="3"/></default>'
        f'<worldbody><geom type="plane" size="9 9 1"/>{shapes}{bodies}</worldbody></mujoco>'
    )


def run_of(scene: str, until: float, step: float, time_constant: float, repeats: int) -> tuple[float, float, float]:
    """Return the least processor time [s], the least distance of a contact and the largest speed at the end."""
    model = mujoco.MjModel.from_xml_string(xml_of(scene, step, time_constant))
    seconds, data = list[float](), mujoco.MjData(model)
    for _ in range(repeats):
        mujoco.mj_resetData(model, data)
        began = time.process_time()
        mujoco.mj_step(model, data, round(until / step))
        seconds.append(time.process_time() - began)
    mujoco.mj_forward(model, data)
    return min(seconds), float(np.min(data.contact.dist[: data.ncon])), float(np.abs(data.qvel).max())


def standing(path: Path, step: float, time_constant: float, until: tuple[float, float]) -> tuple[float, float, float]:
    """Return the processor time of a second [s], the least distance of a contact, and how far a foot creeps."""
    model = mujoco.MjModel.from_xml_path(str(path))
    model.opt.timestep, model.geom_solref[:, 0] = step, time_constant
    data, early, late = mujoco.MjData(model), *until
    began = time.process_time()
    mujoco.mj_step(model, data, round(1.0 / step))
    seconds = time.process_time() - began
    mujoco.mj_step(model, data, round((early - 1.0) / step))
    feet = data.geom_xpos.copy()
    mujoco.mj_step(model, data, round((late - early) / step))
    creep = np.linalg.norm((data.geom_xpos - feet)[:, :2], axis=1)
    return seconds, float(np.min(data.contact.dist[: data.ncon])), float(creep.max())
