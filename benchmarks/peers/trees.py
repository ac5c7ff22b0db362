"""Trees of joints beside Pinocchio's `aba` and MuJoCo's `mj_forward`: accelerations at random states, and time.

    python -m benchmarks.peers.trees [--states 100]

The trees are those of `benchmarks.trees`. The coordinates of all three programs are angles of
hinges, and position, quaternion, velocity and angular velocity in own axes of a free body, so accelerations are
compared number by number. Time is of one evaluation called through a pointer: symgen's emitted function, the same
equations by gcc, and `aba` from Pinocchio's headers by g++ with the same flags, in the faster of its two conventions,
in turns. Needs `pip install pin mujoco` and Eigen's headers; what is missing is left out and said.
"""

from __future__ import annotations

import argparse
import ctypes
import os
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import numpy as np

from benchmarks.against_gcc import FLAGS, REPEATS, _repeat_emitted, c_function
from benchmarks.trees import AXES, GRAVITY, TREES, Array, Limb, mechanism
from symgen.base.settings import Settings
from symgen.derive.formulate.formulate import formulate
from symgen.derive.lower.law import lower_law
from symgen.derive.lower.model import lower_model
from symgen.derive.methods import METHODS
from symgen.describe.mechanism import Mechanism
from symgen.run.compiling.choices import mechanism_on_tree
from symgen.run.layout import abi
from symgen.run.planning.prepare import prepare
from symgen.run.planning.tree import TreeRun


def mjcf(limbs: list[Limb]) -> str:
    """Return a tree as MuJoCo reads it."""
    inside = {name: list[Limb]() for name in ("", *(limb.name for limb in limbs))}
    for limb in limbs:
        inside[limb.parent].append(limb)

    def numbers(values: tuple[float, ...]) -> str:
        return " ".join(repr(float(x)) for x in values)

    def body(limb: Limb) -> str:
        kinds = {"free": "<freejoint/>", "ball": '<joint type="ball"/>'}
        joint = kinds.get(limb.joint) or f'<joint type="hinge" axis="{numbers(AXES[limb.joint])}"/>'
        own = f'<inertial pos="{numbers(limb.centre)}" mass="{limb.mass!r}" fullinertia="{numbers(limb.inertia)}"/>'
        rest = "".join(body(x) for x in inside[limb.name])
        return f'<body name="{limb.name}" pos="{numbers(limb.at)}">{joint}{own}{rest}</body>'

    world = "".join(body(limb) for limb in inside[""])
    flags = f'<option gravity="0 0 {-GRAVITY!r}"><flag contact="disable" constraint="disable"/></option>'
    return f"<mujoco>{flags}<worldbody>{world}</worldbody></mujoco>"


#: What Pinocchio is built with, for its list of joints.
BOOST = ("-DBOOST_MPL_LIMIT_LIST_SIZE=30", "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS")

CPP = r"""
#include <chrono>
#include <fstream>
#include <pinocchio/fwd.hpp>
#include <pinocchio/multibody.hpp>
#include <pinocchio/algorithm/aba.hpp>
namespace pin = pinocchio;
static pin::Model model;
static pin::Data *data;
static Eigen::VectorXd q, v, tau;
template <class T> static void same(T &) {}
extern "C" int describe(const char *path, double gravity)
{
    std::ifstream in(path);
    model = pin::Model();
    model.gravity.linear() << 0.0, 0.0, -gravity;
    int count; in >> count;
    for (int k = 0; k < count; k++) {
        int parent; std::string kind; double x[3], m, c[3], i[6];
        in >> parent >> kind >> x[0] >> x[1] >> x[2] >> m >> c[0] >> c[1] >> c[2];
        for (double &e : i) in >> e;
        const pin::SE3 at(Eigen::Matrix3d::Identity(), Eigen::Vector3d(x[0], x[1], x[2]));
        const std::string name = "j" + std::to_string(k);
        int index = 0;
        if (kind == "x") index = model.addJoint(parent, pin::JointModelRX(), at, name);
        if (kind == "y") index = model.addJoint(parent, pin::JointModelRY(), at, name);
        if (kind == "z") index = model.addJoint(parent, pin::JointModelRZ(), at, name);
        if (kind == "ball") index = model.addJoint(parent, pin::JointModelSpherical(), at, name);
        if (kind == "free") index = model.addJoint(parent, pin::JointModelFreeFlyer(), at, name);
        Eigen::Matrix3d inertia;
        inertia << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
        const pin::Inertia own(m, Eigen::Vector3d(c[0], c[1], c[2]), inertia);
        model.appendBodyToJoint(index, own, pin::SE3::Identity());
    }
    data = new pin::Data(model);
    q = Eigen::VectorXd::Zero(model.nq); v = Eigen::VectorXd::Zero(model.nv); tau = Eigen::VectorXd::Zero(model.nv);
    return model.nv;
}
extern "C" void accelerations(const double *q_, const double *v_, double *out)
{
    for (int i = 0; i < model.nq; i++) q[i] = q_[i];
    for (int i = 0; i < model.nv; i++) v[i] = v_[i];
    const auto &a = pin::aba(model, *data, q, v, tau, pin::Convention::LOCAL);
    for (int i = 0; i < model.nv; i++) out[i] = a[i];
}
extern "C" double repeat(int world, long n)
{
    const auto began = std::chrono::steady_clock::now();
    for (long k = 0; k < n; k++) {
        if (world) pin::aba(model, *data, q, v, tau, pin::Convention::WORLD);
        else pin::aba(model, *data, q, v, tau, pin::Convention::LOCAL);
        v[0] += 1e-300 * data->ddq[0];
    }
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count() / n;
}
"""


def pinocchio(limbs: list[Limb], folder: Path) -> ctypes.CDLL | None:
    """Return the library with `aba` and a tree in it, None where it cannot be built."""
    folders = [Path(x) / "cmeel.prefix" for x in sys.path if (Path(x) / "cmeel.prefix/include/pinocchio").is_dir()]
    if not folders:
        print("no Pinocchio here: left out")
        return None
    root = folders[0]
    index = {"": 0} | {limb.name: k + 1 for k, limb in enumerate(limbs)}
    lines = [str(len(limbs))]
    for limb in limbs:
        row = (*limb.at, limb.mass, *limb.centre, *limb.inertia)
        lines.append(f"{index[limb.parent]} {limb.joint} " + " ".join(repr(float(x)) for x in row))
    (folder / "tree.txt").write_text("\n".join(lines), encoding="utf-8")
    (folder / "aba.cpp").write_text(CPP, encoding="utf-8")
    library = folder / "libaba.so"
    eigen = os.environ.get("EIGEN", "/usr/include/eigen3")
    command = [
        "g++",
        "-std=c++17",
        "-DNDEBUG",
        *BOOST,
        *FLAGS,
        "-w",
        f"-I{root}/include",
        f"-I{eigen}",
        f"-L{root}/lib",
    ]
    links = ["-lpinocchio_default", f"-Wl,-rpath,{root}/lib"]
    subprocess.run([*command, str(folder / "aba.cpp"), "-o", str(library), *links], check=True)
    built = ctypes.CDLL(str(library))
    built.repeat.restype = ctypes.c_double
    built.describe(str(folder / "tree.txt").encode(), ctypes.c_double(GRAVITY))
    return built


# -- states ------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class State:
    """A random state: for each limb its coordinates and velocities, as MuJoCo orders them."""

    q: dict[str, Array]
    v: dict[str, Array]


def draw(limbs: list[Limb], rng: np.random.Generator) -> State:
    """Return a random state."""
    q, v = dict[str, Array](), dict[str, Array]()
    for limb in limbs:
        if limb.joint in AXES:
            q[limb.name], v[limb.name] = rng.uniform(-np.pi, np.pi, 1), rng.standard_normal(1)
            continue
        turn = rng.standard_normal(4)
        turn /= np.linalg.norm(turn)
        free = limb.joint == "free"
        q[limb.name] = np.concatenate([rng.standard_normal(3), turn]) if free else turn
        v[limb.name] = rng.standard_normal(6 if free else 3)
    return State(q, v)


def turned(e: Array) -> Array:
    """Return the rotation matrix of a unit quaternion, scalar first."""
    w, u = e[0], e[1:]
    cross = np.array([[0.0, -u[2], u[1]], [u[2], 0.0, -u[0]], [-u[1], u[0], 0.0]])
    return np.asarray((w * w - u @ u) * np.eye(3) + 2.0 * np.outer(u, u) + 2.0 * w * cross)


def of_symgen(run: TreeRun, limbs: list[Limb], state: State) -> dict[str, Array]:
    """Return accelerations by limb from the emitted function.

    A ball turns its body against the ground here, and against what carries it elsewhere: with R the rotation of the
    body against its carrier, whose angular velocity in its own axes is w0, and w that against it, the velocity of the
    state is w + R^T w0.
    """
    info = run.compiled.info
    places = {x.name: i for i, x in enumerate(info.coordinates)}
    speeds = {x.name: i for i, x in enumerate(info.velocities)}
    y = run.start.y.copy()
    pose, spin = {"": np.eye(3)}, {"": np.zeros(3)}
    for limb in limbs:
        q, v = state.q[limb.name], state.v[limb.name]
        if limb.joint in AXES:
            axis, angle = np.array(AXES[limb.joint]), float(q[0])
            own = turned(np.concatenate([[np.cos(angle / 2)], np.sin(angle / 2) * axis]))
            y[places[f"j_{limb.name}.angle"]] = angle
            y[info.nq + speeds[f"j_{limb.name}.angle.rate"]] = v[0]
            relative = axis * v[0]
        else:
            own, relative = turned(q[-4:]), v[-3:]
            if limb.joint == "free":
                for k, x in enumerate("xyz"):
                    y[places[f"{limb.name}.{x}"]] = q[k]
                    y[info.nq + speeds[f"{limb.name}.v{x}"]] = v[k]
        pose[limb.name] = pose[limb.parent] @ own
        spin[limb.name] = relative + own.T @ spin[limb.parent]
        if limb.joint not in AXES:
            for k, e in enumerate(quaternion(pose[limb.name])):
                y[places[f"{limb.name}.e{k}"]] = e
            for k, x in enumerate("xyz"):
                y[info.nq + speeds[f"{limb.name}.w{x}"]] = spin[limb.name][k]
    ydot, p, w = np.zeros(info.ny), run.start.p.copy(), run.start.w.copy()
    run.compiled.law_module.rhs(0.0, y, p, w, np.zeros(abi.N_COUNTERS, dtype=np.int64), ydot)
    vdot = ydot[info.nq :]
    rates, turning = dict[str, Array](), {"": np.zeros(3)}
    for limb in limbs:
        own = pose[limb.parent].T @ pose[limb.name]
        carried = own.T @ spin[limb.parent]
        if limb.joint in AXES:
            rates[limb.name] = np.array([vdot[speeds[f"j_{limb.name}.angle.rate"]]])
            relative = np.array(AXES[limb.joint]) * state.v[limb.name][0]
            gained = np.array(AXES[limb.joint]) * rates[limb.name][0]
            turning[limb.name] = gained + own.T @ turning[limb.parent] - np.cross(relative, carried)
        else:
            turning[limb.name] = np.array([vdot[speeds[f"{limb.name}.w{x}"]] for x in "xyz"])
            relative = spin[limb.name] - carried
            against = turning[limb.name] - own.T @ turning[limb.parent] + np.cross(relative, carried)
            moved = [vdot[speeds[f"{limb.name}.v{x}"]] for x in "xyz"] if limb.joint == "free" else []
            rates[limb.name] = np.array([*moved, *against])
    return rates


def quaternion(matrix: Array) -> Array:
    """Return the unit quaternion of a rotation matrix, scalar first: the eigenvector of Bar-Itzhack's matrix."""
    r = matrix
    k = np.array(
        [
            [r[0, 0] + r[1, 1] + r[2, 2], r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]],
            [r[2, 1] - r[1, 2], r[0, 0] - r[1, 1] - r[2, 2], r[0, 1] + r[1, 0], r[0, 2] + r[2, 0]],
            [r[0, 2] - r[2, 0], r[0, 1] + r[1, 0], r[1, 1] - r[0, 0] - r[2, 2], r[1, 2] + r[2, 1]],
            [r[1, 0] - r[0, 1], r[0, 2] + r[2, 0], r[1, 2] + r[2, 1], r[2, 2] - r[0, 0] - r[1, 1]],
        ]
    )
    return np.asarray(np.linalg.eigh(k)[1][:, -1])


def of_mujoco(limbs: list[Limb], states: list[State]) -> list[dict[str, Array]] | None:
    """Return accelerations by limb from MuJoCo."""
    try:
        import mujoco
    except ImportError:
        print("no MuJoCo here: left out")
        return None
    model = mujoco.MjModel.from_xml_string(mjcf(limbs))
    data, rates = mujoco.MjData(model), []
    for state in states:
        first = 0
        for limb in limbs:  # bodies in the file's order of depth, which is MuJoCo's
            joint = model.body(limb.name).jntadr[0]
            at, speed = model.jnt_qposadr[joint], model.jnt_dofadr[joint]
            data.qpos[at : at + len(state.q[limb.name])] = state.q[limb.name]
            data.qvel[speed : speed + len(state.v[limb.name])] = state.v[limb.name]
            first += 1
        mujoco.mj_forward(model, data)
        result = {}
        for limb in limbs:
            speed = model.jnt_dofadr[model.body(limb.name).jntadr[0]]
            result[limb.name] = data.qacc[speed : speed + len(state.v[limb.name])].copy()
        rates.append(result)
    return rates


def of_pinocchio(built: ctypes.CDLL, limbs: list[Limb], state: State) -> dict[str, Array]:
    """Return accelerations by limb from `aba`; joints of trees that are described depth first stand in their order."""
    q, v, turns = list[float](), list[float](), dict[str, Array]()
    for limb in limbs:
        own_q, own_v = state.q[limb.name], state.v[limb.name]
        if limb.joint not in AXES:  # quaternions have their scalar last, a free body's velocity is in its own axes
            turns[limb.name] = turned(own_q[-4:])
            own_q = np.concatenate([own_q[:-4], own_q[-3:], own_q[-4:-3]])
        if limb.joint == "free":
            own_v = np.concatenate([turns[limb.name].T @ own_v[:3], own_v[3:]])
        q += own_q.tolist()
        v += own_v.tolist()
    q_, v_, out = np.array(q), np.array(v), np.zeros(len(v))
    built.accelerations(*(ctypes.c_void_p(x.ctypes.data) for x in (q_, v_, out)))
    rates, first = dict[str, Array](), 0
    for limb in limbs:
        size = len(state.v[limb.name])
        own = out[first : first + size].copy()
        if limb.joint == "free":
            own[:3] = turns[limb.name] @ (own[:3] + np.cross(v_[first + 3 : first + 6], v_[first : first + 3]))
        rates[limb.name] = own
        first += size
    return rates


def worst(a: dict[str, Array], b: dict[str, Array]) -> float:
    """Return the largest difference of two accelerations over the largest entry."""
    size = max(float(np.abs(x).max()) for x in b.values())
    return max(float(np.abs(a[name] - b[name]).max()) for name in b) / size


# -- time --------------------------------------------------------------------------------------------------------------


def times(
    carried: Mechanism, run: TreeRun, built: ctypes.CDLL | None, folder: Path
) -> tuple[int, dict[str, list[float]]]:
    """Return operations, and seconds of one evaluation by name, in turns."""
    method = METHODS.get("lagrange", "")
    equations = formulate(carried)
    law = lower_law(equations, lower_model(equations, ""), method, method.complete_options({}))
    block = next(b for b in law.blocks if b.name == "rhs")
    (folder / "rhs.c").write_text(c_function(block, law.layout), encoding="utf-8")
    subprocess.run(["gcc", *FLAGS, str(folder / "rhs.c"), "-o", str(folder / "rhs.so"), "-lm"], check=True)
    c = ctypes.CDLL(str(folder / "rhs.so"))
    c.repeat.restype = ctypes.c_double
    y, p, w = run.start.y.copy(), run.start.p.copy(), run.start.w.copy()
    iw, ydot = np.zeros(abi.N_COUNTERS, dtype=np.int64), np.zeros_like(y)
    entry, pointers = (
        ctypes.cast(c.evaluate, ctypes.c_void_p),
        [ctypes.c_void_p(a.ctypes.data) for a in (y, p, w, iw, ydot)],
    )
    count = max(500, int(1e7 / block.operations))
    timings: dict[str, list[float]] = {"symgen": [], "gcc": [], "aba local": [], "aba world": []}
    _repeat_emitted(run.compiled.law_module.rhs, y, p, w, iw, ydot, 10)
    for _ in range(REPEATS):
        began = time.perf_counter()
        _repeat_emitted(run.compiled.law_module.rhs, y, p, w, iw, ydot, count)
        middle = time.perf_counter()
        c.repeat(entry, *pointers, ctypes.c_long(count))
        timings["gcc"].append((time.perf_counter() - middle) / count)
        timings["symgen"].append((middle - began) / count)
        if built is not None:
            timings["aba local"].append(float(built.repeat(0, ctypes.c_long(count // 4))))
            timings["aba world"].append(float(built.repeat(1, ctypes.c_long(count // 4))))
    return block.operations, timings


def main() -> None:
    """Print agreement and times of every tree."""
    parser = argparse.ArgumentParser(prog="benchmarks.peers.trees")
    parser.add_argument("--states", type=int, default=100)
    count = parser.parse_args().states
    for name, limbs in TREES.items():
        described = mechanism(name.replace(" ", "-"), limbs)
        run = prepare(described, Settings(method="lagrange", coordinates="joint")).tree
        assert run is not None, "the state is that of joints"
        rng = np.random.default_rng(7)
        states = [draw(limbs, rng) for _ in range(count)]
        ours = [of_symgen(run, limbs, state) for state in states]
        theirs = of_mujoco(limbs, states)
        with tempfile.TemporaryDirectory() as folder:
            built = pinocchio(limbs, Path(folder))
            line = f"{name}: {run.compiled.info.nv} velocities"
            if theirs is not None:
                line += f", MuJoCo {max(worst(a, b) for a, b in zip(ours, theirs, strict=True)):.1e}"
            if built is not None:
                others = [of_pinocchio(built, limbs, state) for state in states]
                line += f", Pinocchio {max(worst(a, b) for a, b in zip(ours, others, strict=True)):.1e}"
            operations, timings = times(mechanism_on_tree(described), run, built, Path(folder))
        print(f"{line} (relative, {count} states); {operations} operations")
        print("   " + ", ".join(f"{key} {min(x) * 1e9:.0f} ns" for key, x in timings.items() if x))
        if built is not None:
            fastest = min(("aba local", "aba world"), key=lambda key: median(timings[key]))
            ratios = [a / b for a, b in zip(timings[fastest], timings["symgen"], strict=True)]
            print(f"   {fastest} / symgen: median {median(ratios):.2f} ({min(ratios):.2f} to {max(ratios):.2f})")


if __name__ == "__main__":
    main()
