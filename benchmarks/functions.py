"""Dynamics as functions beside Pinocchio and MuJoCo: a call from Python, and an evaluation alone, in turns in one run.

    ROBOTS=FOLDER python -m benchmarks.functions

measures the record anew and prints its table; ``ROBOTS`` is ``robots`` of `example-robot-data`, which is found where
`pip install example-robot-data` has put it. Evaluations alone are those of one call with many states, for Pinocchio
`abaInParallel` and `rneaInParallel` with one thread, and for MuJoCo of a loop in C. A round takes all tools one after
the other; ratios are those of rounds, as quartiles. MuJoCo and Pinocchio are their wheels.
"""

from __future__ import annotations

import ctypes
import os
import random
import re
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from benchmarks.closed_leg import LOOP, MJCF, RELATIVE, URDF, leg
from benchmarks.page_tables import KEPT, PageTable
from benchmarks.records import Line, Pair, Record, measure
from symgen.api import Model, load

#: Files of robots by their names here, from the folder of `example-robot-data`.
ROBOTS = {
    "UR5": "ur_description/urdf/ur5_robot.urdf",
    "Panda": "panda_description/urdf/panda.urdf",
    "Talos": "talos_data/robots/talos_reduced.urdf",
}
LEG = "four-bar leg"
#: Names of the functions, of Pinocchio's without and with rows, and of MuJoCo's.
FUNCTIONS = {
    "mass_matrix": ("crba", "crba", ""),
    "bias": ("nonLinearEffects", "nonLinearEffects", ""),
    "forward_dynamics": ("aba", "constraintDynamics", "mj_forward"),
    "inverse_dynamics": ("rnea", "", "mj_inverse"),
}
#: Calls of a batch, coordinates of all states of one call of symgen's, states of one of Pinocchio's, rounds, and the
#: processor time of a robot [s].
CALLS, COORDINATES, STATES, ROUNDS, PATIENCE = 100, 24_000, 300, 300, 900.0
HEADINGS = (
    *("model", "velocities", "function", "symgen: called, alone [us]", "Pinocchio", "over symgen's: called, alone"),
    *("MuJoCo", "over symgen's: called, alone"),
)
#: What Pinocchio and MuJoCo do not read: meshes, and joints that follow others.
_PARTS = re.compile(r"<(visual|collision|mimic)\b(?:[^>]*/>|.*?</\1>)", re.DOTALL)
_COMPILER = '<mujoco><compiler fusestatic="true" boundmass="0"/>{}</mujoco></robot>'
_FLAGS = '<option><flag contact="disable" constraint="disable"/></option>'
_LOOP = """typedef void (*function)(const void *, void *);
void repeat(function f, const void *m, void *d, long n) { for (long k = 0; k < n; k++) f(m, d); }
"""

Array = np.ndarray[Any, np.dtype[np.float64]]
#: What makes evaluations, and how many.
Batch = tuple[Callable[[], object], int]


class Job(NamedTuple):
    """What is measured."""

    model: str


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


def folder() -> Path:
    """Return the folder of robots."""
    own = os.environ.get("ROBOTS")
    below = "cmeel.prefix/share/example-robot-data/robots"
    found = next((Path(x) / below for x in sys.path if (Path(x) / below).is_dir()), None)
    if own is None and found is None:
        raise SystemExit("functions: expected files of robots, got none; pip install example-robot-data, or set ROBOTS")
    return Path(own) if own is not None else found or Path()


def subject(name: str) -> Subject:
    """Return a robot."""
    if name == LEG:
        return Subject(leg(), URDF, MJCF, True)
    text = _PARTS.sub("", (folder() / ROBOTS[name]).read_text(encoding="utf-8"))
    with tempfile.TemporaryDirectory() as place:
        (path := Path(place) / "robot.urdf").write_text(text, encoding="utf-8")
        model = load(path)
    return Subject(model, text, text.replace("</robot>", _COMPILER.format(_FLAGS)), False)


def batches(name: str) -> tuple[int, dict[str, dict[str, Batch]], dict[str, float]]:
    """Return the number of velocities, batches by function and tool, and how far accelerations are apart."""
    own = subject(name)
    f = own.model.functions("joint")
    n, rng = len(f.velocities), np.random.default_rng(0)
    q, v, a, effort = rng.uniform(-1.0, 1.0, (4, n))
    if own.loop:
        q = f.start[0]
        v = f.reduction(q, ["thigh.omega", "lever.omega"])[1] @ v[:2]
    state = State(q, v, a, effort)
    arguments = {"mass_matrix": (q,), "bias": (q, v), "forward_dynamics": (q, v, effort), "inverse_dynamics": (q, v, a)}
    table = {key: dict[str, Batch]() for key in FUNCTIONS if not own.loop or FUNCTIONS[key][1]}
    for key, row in table.items():
        function, given = getattr(f, key), arguments[key]
        states = COORDINATES // n
        many = [np.tile(x, (states, 1)) for x in given]
        row["symgen"] = _called(function, *given), CALLS
        row["symgen, alone"] = _called(function, *many, count=1), states
    names = [x.name.partition(".")[0] for x in f.velocities]
    apart = dict[str, float]()
    still = state._replace(v=0.0 * v)  # files have dampers, which Pinocchio does not read
    wanted = f.forward_dynamics(still.q, still.v, still.effort)
    for tool, add in (("pinocchio", _pinocchio), ("mujoco", _mujoco)):
        accelerations, ways = add(own, names, state, table)
        other = accelerations(still.along(ways))
        apart[tool] = float(np.abs(other - ways @ wanted).max() / np.abs(wanted).max())
    return n, table, apart


def _called(function: Callable[..., object], *arguments: object, count: int = CALLS) -> Callable[[], object]:
    """Return a batch of calls."""

    def batch() -> None:
        for _ in range(count):
            function(*arguments)

    return batch


Added = tuple[Callable[[State], Array], Array]


def _pinocchio(own: Subject, names: list[str], state: State, table: dict[str, dict[str, Batch]]) -> Added:
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
    row["mass_matrix"][tool] = _called(pin.crba, model, data, q), CALLS
    row["bias"][tool] = _called(pin.nonLinearEffects, model, data, q, v), CALLS
    row["forward_dynamics"][tool] = _called(forward, model, data, q, v, effort, *more), CALLS
    if not own.loop:
        row["inverse_dynamics"][tool] = _called(pin.rnea, model, data, q, v, a), CALLS
        pool, alone = pin.ModelPool(model, 1), f"{tool}, alone"
        many = [np.asfortranarray(np.tile(x, (STATES, 1)).T) for x in (q, v, a, effort)]
        out = np.asfortranarray(np.zeros_like(many[0]))
        along = *many[:2], many[3], out
        row["forward_dynamics"][alone] = _called(pin.abaInParallel, 1, pool, *along, count=1), STATES
        row["inverse_dynamics"][alone] = _called(pin.rneaInParallel, 1, pool, *many[:3], out, count=1), STATES
    return lambda x: np.array(forward(model, data, x.q, x.v, x.effort, *more)), ways


def _mujoco(own: Subject, names: list[str], state: State, table: dict[str, dict[str, Batch]]) -> Added:
    """Add batches of MuJoCo, as `_pinocchio` does."""
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
            row["mujoco"] = _called(getattr(mujoco, name), model, data), CALLS
            pointers = ctypes.cast(getattr(library, name), ctypes.c_void_p), model._address, data._address
            numbers = pointers[0], *(ctypes.c_void_p(x) for x in pointers[1:]), ctypes.c_long(CALLS)
            row["mujoco, alone"] = _called(loop.repeat, *numbers, count=1), CALLS
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


def examine(job: Job) -> dict[str, Any]:
    """Return times [us] and quartiles of ratios by function and tool."""
    import mujoco
    import pinocchio as pin

    n, table, apart = batches(job.model)
    versions = {"pinocchio": pin.__version__, "mujoco": mujoco.__version__}
    return {"velocities": n, "versions": versions, "apart": apart, "functions": {k: timed(x) for k, x in table.items()}}


def timed(row: dict[str, Batch], rounds: int = ROUNDS) -> dict[str, dict[str, Any]]:
    """Return least times [us] of batches in turns, and quartiles of times over those of symgen."""
    times: dict[str, list[float]] = {tool: [] for tool in row}
    for batch, _ in row.values():
        batch()
    for _ in range(rounds):
        for tool, (batch, count) in row.items():
            began = time.perf_counter()
            batch()
            times[tool].append(1e6 * (time.perf_counter() - began) / count)
    result = {tool: dict[str, Any](us=min(own)) for tool, own in times.items()}
    for tool, own in times.items():
        base = times["symgen, alone" if tool.endswith("alone") else "symgen"]
        result[tool]["over"] = statistics.quantiles([a / b for a, b in zip(own, base, strict=True)], n=4)
    return result


def again(stored: Line, dice: random.Random) -> Iterator[Pair]:
    """Yield what needs no other program: the number of velocities of the leg."""
    if stored["model"] == LEG:
        yield Pair(LEG, stored["velocities"], len(leg().functions("joint").velocities))


RECORD = Record("functions", lambda: map(Job, (*ROBOTS, LEG)), examine, again, PATIENCE, share=1.0)


# -- the table ---------------------------------------------------------------------------------------------------------


def cells(model: str, function: str) -> list[str]:
    """Return the cells of a line of the table."""
    line = next((line for line in RECORD.lines() if line["model"] == model and "functions" in line), None)
    if line is None:
        return [KEPT] * 5
    row, loop = line["functions"][function], model == LEG
    theirs = {"pinocchio": FUNCTIONS[function][1 if loop else 0], "mujoco": FUNCTIONS[function][2]}
    own = [f"{row['symgen']['us']:.2g}, {row['symgen, alone']['us']:.2g}"]
    for tool, name in theirs.items():
        found = [row[key] for key in (tool, f"{tool}, alone") if key in row]
        numbers = ", ".join(f"{x['us']:.2g}" for x in found)
        own.append(f"`{name}`: {numbers}" if found else "")
        own.append(", ".join(_ratio(*x["over"]) for x in found))
    return own


def _ratio(low: float, middle: float, high: float) -> str:
    """Return a ratio with its quartiles."""
    return f"{middle:.2g} ({low:.2g} to {high:.2g})"


def tables() -> tuple[PageTable, ...]:
    """Return the table of the page of robots."""
    velocities = {line["model"]: str(line.get("velocities", KEPT)) for line in RECORD.lines()}
    rows = []
    for model in (*ROBOTS, LEG):
        for function in FUNCTIONS:
            if model != LEG or FUNCTIONS[function][1]:
                names = model, velocities.get(model, KEPT), f"`{function}`"
                rows.append((names, lambda model=model, function=function: cells(model, function)))
    return (PageTable("functions", "docs/measured/robots.md", HEADINGS, tuple(rows), stored=True, claims=claims),)


def claims() -> Iterator[str]:
    """Yield the sentence of the page on how far accelerations are apart, and on the versions."""
    lines = [line for line in RECORD.lines() if "functions" in line]
    if len(lines) == len(ROBOTS) + 1:
        trees = [line["apart"] for line in lines if line["model"] != LEG]
        (loop,) = (line["apart"] for line in lines if line["model"] == LEG)
        most = {tool: max(x[tool] for x in trees) for tool in loop}
        versions = lines[0]["versions"]
        yield (
            f"Accelerations of trees are {most['pinocchio']:.0e} of the largest from those of Pinocchio"
            f" {versions['pinocchio']} and {most['mujoco']:.0e} from those of MuJoCo {versions['mujoco']}, those of the"
            f" leg {loop['pinocchio']:.0e} and {loop['mujoco']:.0e}."
        )


def main() -> None:
    """Measure the record anew and print its table."""
    RECORD.path.unlink(missing_ok=True)
    measure(examine, RECORD.jobs(), RECORD.path, PATIENCE)
    for table in tables():
        for row in table.measured():
            print(" | ".join(row))
    print(*claims(), sep="\n")


if __name__ == "__main__":
    main()
