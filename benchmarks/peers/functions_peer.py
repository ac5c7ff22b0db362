"""Dynamics as functions of Pinocchio and MuJoCo, called from Python and evaluated alone, for `benchmarks.functions`."""

from __future__ import annotations

import ctypes
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from benchmarks.closed_leg import LOOP, RELATIVE
from symgen.api import Model

#: Names of the functions, of Pinocchio's without and with rows, and of MuJoCo's.
FUNCTIONS = {
    "mass_matrix": ("crba", "crba", ""),
    "bias": ("nonLinearEffects", "nonLinearEffects", ""),
    "forward_dynamics": ("aba", "constraintDynamics", "mj_forward"),
    "inverse_dynamics": ("rnea", "", "mj_inverse"),
}
#: Calls of a batch, and states of one call of Pinocchio's.
CALLS, STATES = 100, 300
_LOOP = """typedef void (*function)(const void *, void *);
void repeat(function f, const void *m, void *d, long n) { for (long k = 0; k < n; k++) f(m, d); }
"""

Array = np.ndarray[Any, np.dtype[np.float64]]
#: What makes evaluations, and how many.
Batch = tuple[Callable[[], object], int]


class Subject(NamedTuple):
    """A robot in three programs, and how their velocities follow from those of symgen."""

    model: Model
    urdf: str
    mjcf: str
    loop: bool


class State(NamedTuple):
    """Coordinates, velocities, accelerations and efforts."""

    q: Array
    v: Array
    a: Array
    effort: Array

    def along(self, ways: Array) -> State:
        """Return the state along other velocities, which are the product of a matrix with these."""
        return State(
            ways @ self.q,
            ways @ self.v,
            ways @ self.a,
            np.asarray(np.linalg.solve(ways.T, self.effort), dtype=np.float64),
        )


def called(function: Callable[..., object], *arguments: object, count: int = CALLS) -> Callable[[], object]:
    """Return a batch of calls."""

    def batch() -> None:
        for _ in range(count):
            function(*arguments)

    return batch


Added = tuple[Callable[[State], Array], Array]


def add_pinocchio(own: Subject, names: list[str], state: State, table: dict[str, dict[str, Batch]]) -> Added:
    """Add batches of Pinocchio; return its accelerations, and the matrix of its velocities by those of symgen."""
    import pinocchio as pin

    model = pin.buildModelFromXML(own.urdf)
    if own.loop:
        model.gravity.linear = np.array([0.0, -9.81, 0.0])
    data = model.createData()
    places = {joint: model.joints[model.getJointId(joint)].idx_v for joint in names}
    ways = _ways(own, names, places)
    q, v, a, effort = state.along(ways)
    forward: Callable[..., Any] = pin.aba
    more: tuple[Any, ...] = ()
    if own.loop:
        (one, at), (other, there) = ((model.getJointId(x), pin.SE3(np.eye(3), np.array(y))) for x, y in LOOP)
        closures = [pin.RigidConstraintModel(pin.ContactType.CONTACT_3D, model, one, at, other, there, pin.LOCAL)]
        memory = [closure.createData() for closure in closures]
        pin.initConstraintDynamics(model, data, closures, memory)
        forward, more = pin.constraintDynamics, (closures, memory, pin.ProximalSettings(1e-12, 1e-8, 5))
    row, tool = table, "pinocchio"
    row["mass_matrix"][tool] = called(pin.crba, model, data, q), CALLS
    row["bias"][tool] = called(pin.nonLinearEffects, model, data, q, v), CALLS
    row["forward_dynamics"][tool] = called(forward, model, data, q, v, effort, *more), CALLS
    if not own.loop:
        row["inverse_dynamics"][tool] = called(pin.rnea, model, data, q, v, a), CALLS
        pool, alone = pin.ModelPool(model, 1), f"{tool}, alone"
        many = [np.asfortranarray(np.tile(x, (STATES, 1)).T) for x in (q, v, a, effort)]
        out = np.asfortranarray(np.zeros_like(many[0]))
        along = *many[:2], many[3], out
        row["forward_dynamics"][alone] = called(pin.abaInParallel, 1, pool, *along, count=1), STATES
        row["inverse_dynamics"][alone] = called(pin.rneaInParallel, 1, pool, *many[:3], out, count=1), STATES
    return lambda x: np.array(forward(model, data, x.q, x.v, x.effort, *more)), ways


def add_mujoco(own: Subject, names: list[str], state: State, table: dict[str, dict[str, Batch]]) -> Added:
    """Add batches of MuJoCo, as `add_pinocchio` does."""
    import mujoco

    model = mujoco.MjModel.from_xml_string(own.mjcf)
    data = mujoco.MjData(model)
    places = {joint: int(model.joint(joint).dofadr[0]) for joint in names}
    ways = _ways(own, names, places)

    def put(x: State) -> None:
        data.qpos[:], data.qvel[:], data.qacc[:], data.qfrc_applied[:] = x

    def accelerations(x: State) -> Array:
        put(x)
        mujoco.mj_forward(model, data)
        return np.array(data.qacc)

    put(state.along(ways))
    library, loop = ctypes.CDLL(str(next(Path(mujoco.__file__).parent.glob("libmujoco.so*")))), _c_loop()
    for key, row in table.items():
        if name := FUNCTIONS[key][2]:
            row["mujoco"] = called(getattr(mujoco, name), model, data), CALLS
            pointers = ctypes.cast(getattr(library, name), ctypes.c_void_p), model._address, data._address
            numbers = pointers[0], *(ctypes.c_void_p(x) for x in pointers[1:]), ctypes.c_long(CALLS)
            row["mujoco, alone"] = called(loop.repeat, *numbers, count=1), CALLS
    return accelerations, ways


def _c_loop() -> ctypes.CDLL:
    """Return a loop over calls in C."""
    with tempfile.TemporaryDirectory() as place:
        source, library = Path(place) / "loop.c", Path(place) / "loop.so"
        source.write_text(_LOOP, encoding="utf-8")
        subprocess.run(["gcc", "-O2", "-shared", "-fPIC", str(source), "-o", str(library)], check=True)
        return ctypes.CDLL(str(library))


def _ways(own: Subject, names: list[str], places: dict[str, int]) -> Array:
    """Return the matrix of another program's velocities by those of symgen, which has angles of bodies in the leg."""
    ways = np.zeros((len(names), len(names)))
    for k, name in enumerate(names):
        ways[places[name], k] = 1.0
        if own.loop and name in RELATIVE:
            ways[places[name], names.index(RELATIVE[name])] = -1.0
    return ways


def versions() -> dict[str, str]:
    """Return the versions of both."""
    import mujoco
    import pinocchio as pin

    return {"pinocchio": pin.__version__, "mujoco": mujoco.__version__}
