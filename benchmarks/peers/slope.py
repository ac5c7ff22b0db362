"""A block at rest on a slope inside its cone, in symgen and in MuJoCo: ``python -m benchmarks.peers.slope``.

The block stands on two feet, gravity is (2, -9.5) m/s^2, the coefficient 0.5, and half of it would hold. Printed are
the places along the slope at two times and the speed between them; processor time is that of all steps.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

import mujoco
import numpy as np

import symgen

GRAVITY, FRICTION, TIMES = (2.0, -9.5), 0.5, (10.0, 100.0)
#: Names and attributes of what MuJoCo is run with: its defaults, and the stiffest springs that its step allows.
SPRINGS = {"defaults": "", "stiff": ' solref="0.004 1" solimp="0.99 0.999 0.001"'}
_STEP = 0.002


def in_symgen() -> tuple[float, float]:
    """Return the places of the block at both times [m]."""
    text = f'[mechanism]\nname = "slope"\ngravity = {list(GRAVITY)!r}\n'
    text += "[bodies.block]\nmass = 1.0\ninertia = 0.02\nposition = [0.0, 0.1]\n"
    for name, x in (("left", -0.2), ("right", 0.2)):
        text += f'[contacts.{name}]\nbetween = [{{ body = "block", at = [{x}, -0.1] }}, {{ line = "ground" }}]\n'
        text += f"friction = {FRICTION}\n"
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "slope.toml"
        path.write_text(text, encoding="utf-8")
        run = symgen.load(path).simulate(until=TIMES[-1], times=[0.0, *TIMES])
    return float(run["block.x"][1]), float(run["block.x"][2])


def in_mujoco(cone: str, springs: str) -> tuple[float, float]:
    """Return the places of a box of the same size [m], by a kind of cone and springs of contacts."""
    surface = f'friction="{FRICTION} 0 0"{springs}'
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><option gravity="{GRAVITY[0]} 0 {GRAVITY[1]}" timestep="{_STEP}" cone="{cone}"/><worldbody>'
        f'<geom type="plane" size="100 100 1" {surface}/><body pos="0 0 0.1"><joint type="slide" axis="1 0 0"/>'
        f'<joint type="slide" axis="0 0 1"/><joint type="hinge" axis="0 1 0"/>'
        f'<geom type="box" size="0.2 0.1 0.1" mass="1" {surface}/></body></worldbody></mujoco>'
    )
    data, places = mujoco.MjData(model), []
    for until in TIMES:
        mujoco.mj_step(model, data, round((until - data.time) / _STEP))
        places.append(float(data.qpos[0]))
    return places[0], places[1]


def main() -> None:
    """Print a line for each way."""
    ways: dict[str, Callable[[], tuple[float, float]]] = {"symgen": in_symgen}
    for cone in ("elliptic", "pyramidal"):
        for name, springs in SPRINGS.items():
            ways[f"MuJoCo {mujoco.__version__}, {cone}, {name}"] = partial(in_mujoco, cone, springs)
    for name, way in ways.items():
        began = time.process_time()
        first, last = way()
        speed = (last - first) / float(np.diff(TIMES)[0])
        print(f"{name:36} x {first:9.2e} m, {last:9.2e} m, {speed:9.2e} m/s, {time.process_time() - began:.2f} s")


if __name__ == "__main__":
    main()
