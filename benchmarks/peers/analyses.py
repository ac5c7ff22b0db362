"""Frequencies about rest: what Exudyn, MuJoCo and SymPy answer, beside closed forms and minimal coordinates.

    python -m benchmarks.peers.analyses [--json FILE]

Chains are N point masses of 1 kg on massless links of 1 m: squares of frequencies are g times the zeros of Laguerre's
polynomial. The four-bar is that of rods of 1, 3 and 3 m and kg on pins 4 m apart, its value by minimal coordinates with
30 digits. The catenary is that of ten links of 2 m in all on pins 1 m apart, from a V that closes: the first angle at
rest. Errors are the largest relative ones of all squares, or of the angle. Seconds are those of the question asked of a
model that stands; SymPy's are those from its equations to the numbers, as its linear system is formulas. Every peer
gets the operating point; MuJoCo is asked in its own coordinates, hinges, where that is possible.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
import time
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from scipy import linalg
from scipy.special import roots_laguerre

GRAVITY = 9.81
FOUR_BAR = 4.358800068629289, 22.57021890188508
CHAINS = (2, 10, 40)
#: First angle of the catenary at rest, and where its links begin.
CATENARY, SLOPE = -1.321141266113, math.pi / 3


def places() -> tuple[list[list[float]], list[float]]:
    """Return centres and angles of crank, coupler and rocker at rest."""
    angle = FOUR_BAR[0]
    b = np.array([math.cos(angle), math.sin(angle)])
    far = np.array([4.0, 0.0])
    along = (far - b) / np.linalg.norm(far - b)
    half = 0.5 * float(np.linalg.norm(far - b))
    c = b + half * along + math.sqrt(9.0 - half**2) * np.array([-along[1], along[0]])
    ends = (np.zeros(2), b), (b, c), (far, c)
    return [(0.5 * (p + q)).tolist() for p, q in ends], [math.atan2(*(q - p)[::-1]) for p, q in ends]


def exudyn(problem: str, n: int) -> tuple[Any, str]:
    """Return squares of frequencies, and the way."""
    import exudyn as exu
    import exudyn.solver  # its functions are methods of systems then
    from exudyn import itemInterface as items

    exu.config.printToConsole = False
    system = exu.SystemContainer().AddSystem()
    ground = system.AddObject(items.ObjectGround())

    def marker(body: Any, point: list[float]) -> Any:
        return system.AddMarker(items.MarkerBodyPosition(bodyNumber=body, localPosition=[*point, 0.0]))

    def rod(place: list[float], angle: float, mass: float, inertia: float) -> Any:
        node = system.AddNode(items.NodeRigidBody2D(referenceCoordinates=[*place, angle]))
        body = system.AddObject(items.ObjectRigidBody2D(nodeNumber=node, mass=mass, inertia=inertia))
        load = items.LoadMassProportional(
            markerNumber=system.AddMarker(items.MarkerBodyMass(bodyNumber=body)), loadVector=[0.0, -GRAVITY, 0.0]
        )
        system.AddLoad(load)
        return body

    def pin(a: Any, b: Any) -> None:
        system.AddObject(items.ObjectJointRevolute2D(markerNumbers=[a, b]))

    if problem == "rod":
        pin(marker(ground, [0.0, 0.0]), marker(rod([0.0, -0.5], -math.pi / 2, 2.0, 2.0 / 12.0), [-0.5, 0.0]))
    elif problem == "chain":
        before = marker(ground, [0.0, 0.0])
        for i in range(n):
            body = rod([0.0, -1.0 - i], -math.pi / 2, 1.0, 1e-12)
            pin(before, marker(body, [-1.0, 0.0]))
            before = marker(body, [0.0, 0.0])
    elif problem == "catenary":
        before, place, half = marker(ground, [0.0, 0.0]), np.zeros(2), 0.1
        for i in range(n):
            angle = -SLOPE if i < n // 2 else SLOPE
            along = half * np.array([math.cos(angle), math.sin(angle)])
            body = rod((place + along).tolist(), angle, 2 * half, 2 * half * (2 * half) ** 2 / 12)
            pin(before, marker(body, [-half, 0.0]))
            before, place = marker(body, [half, 0.0]), place + 2 * along
        pin(before, marker(ground, [1.0, 0.0]))
    else:
        centres, angles = places()
        crank, coupler, rocker = (
            rod(p, a, m, m * m * m / 12.0) for p, a, m in zip(centres, angles, (1.0, 3.0, 3.0), strict=True)
        )
        pin(marker(ground, [0.0, 0.0]), marker(crank, [-0.5, 0.0]))
        pin(marker(crank, [0.5, 0.0]), marker(coupler, [-1.5, 0.0]))
        pin(marker(coupler, [1.5, 0.0]), marker(rocker, [1.5, 0.0]))
        pin(marker(ground, [4.0, 0.0]), marker(rocker, [-1.5, 0.0]))
    system.Assemble()
    start = time.perf_counter()
    if problem == "catenary":
        settings = exu.SimulationSettings()
        settings.solution.file.write = False
        settings.staticSolver.numberOfLoadSteps = 100
        settings.staticSolver.stabilizerODE2term = 1.0
        system.SolveStatic(settings, updateInitialValues=True)
        turned = system.GetNodeOutput(0, exu.OutputVariableType.Coordinates)[2]
        return (np.array([turned - SLOPE]), time.perf_counter() - start), "SolveStatic, 100 load steps"
    values = system.ComputeODE2Eigenvalues()[0]
    return (np.array(values), time.perf_counter() - start), "ComputeODE2Eigenvalues, null space of the rows"


def mujoco(problem: str, n: int) -> tuple[Any, str] | None:
    """Return squares of frequencies, and the way; it has no search for an equilibrium."""
    import mujoco as mj

    if problem == "catenary":
        return None
    option = f'<option gravity="0 0 -{GRAVITY}" timestep="1e-3"><flag contact="disable"/></option>'

    def body(inner: str, mass: float, inertia: float, place: str, centre: str, angle: float = 0.0) -> str:
        thin = max(inertia, 1e-12)
        return (
            f'<body pos="{place}" euler="0 {-math.degrees(angle)!r} 0"><joint type="hinge" axis="0 -1 0"/>'
            f'<inertial pos="{centre}" mass="{mass}" diaginertia="{thin} {thin} {thin}"/>{inner}</body>'
        )

    more = ""
    if problem == "rod":
        inside = body("", 2.0, 2.0 / 12.0, "0 0 0", "0 0 -0.5")
    elif problem == "chain":
        inside = ""
        for i in reversed(range(n)):
            inside = body(inside, 1.0, 0.0, "0 0 0" if i == 0 else "0 0 -1", "0 0 -1")
    else:
        _, (a, b, c) = places()
        coupler = body('<site name="B" pos="3 0 0"/>', 3.0, 2.25, "1 0 0", "1.5 0 0", b - a)
        inside = body(coupler, 1.0, 1.0 / 12.0, "0 0 0", "0.5 0 0", a)
        inside += body('<site name="C" pos="3 0 0"/>', 3.0, 2.25, "4 0 0", "1.5 0 0", c)
        soft = 'solref="0.002 1" solimp="0.9999 0.9999 0.001 0.5 1"'
        more = f'<equality><connect site1="B" site2="C" {soft}/></equality>'
    model = mj.MjModel.from_xml_string(f"<mujoco>{option}<worldbody>{inside}</worldbody>{more}</mujoco>")
    data = mj.MjData(model)
    mj.mj_forward(model, data)
    nv = model.nv
    start = time.perf_counter()
    if problem == "four-bar":  # the loop is a spring: eigenvalues of a step, in continuous time
        state = np.zeros((2 * nv, 2 * nv))
        mj.mjd_transitionFD(model, data, 1e-6, True, state, None, None, None)
        values = np.log(np.linalg.eigvals(state).astype(complex)) / model.opt.timestep
        slow = values[np.abs(values.imag) > 1e-3]
        slow = slow[np.argsort(np.abs(slow))][:1]
        return (slow.imag**2, time.perf_counter() - start), "mjd_transitionFD, the loop as a constraint"
    stiffness, mass = np.zeros((nv, nv)), np.zeros((nv, nv))
    data.qacc[:] = 0.0
    mj.mjd_inverseFD(model, data, 1e-6, True, stiffness, None, None, None, None, None, None)
    mj.mj_fullM(model, data, mass)
    squares = linalg.eigh(0.5 * (stiffness + stiffness.T), mass, eigvals_only=True)
    return (squares, time.perf_counter() - start), "mjd_inverseFD and mj_fullM, in hinges"


def sympy(problem: str, n: int) -> tuple[Any, str] | None:
    """Return squares of frequencies and the way, by Lagrange's method; None where that takes too long."""
    import sympy as sp
    from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols

    if problem in ("four-bar", "catenary") or n > 10:
        return None
    start = time.perf_counter()
    time_ = dynamicsymbols._t
    angles = dynamicsymbols(f"a:{n}")
    rates = [a.diff(time_) for a in angles]
    if problem == "rod":
        lagrangian = sp.Rational(1, 3) * rates[0] ** 2 + sp.Float(GRAVITY, 20) * sp.cos(angles[0])
    else:
        x = [sum(sp.sin(a) for a in angles[: k + 1]) for k in range(n)]
        y = [-sum(sp.cos(a) for a in angles[: k + 1]) for k in range(n)]
        lagrangian = sum(
            (p.diff(time_) ** 2 + q.diff(time_) ** 2) / 2 - sp.Float(GRAVITY, 20) * q for p, q in zip(x, y, strict=True)
        )
    method = LagrangesMethod(lagrangian, angles)
    method.form_lagranges_equations()
    at = {**dict.fromkeys(angles, 0), **dict.fromkeys(rates, 0)}
    a = method.linearize(q_ind=angles, qd_ind=rates, A_and_B=True, op_point=[at])[0]
    values = np.linalg.eigvals(np.array(a.subs(at).evalf(), dtype=float))
    squares = np.sort(-np.real(values**2))[::2]
    return (squares, time.perf_counter() - start), "LagrangesMethod.linearize at the point"


def measured(answer: Callable[[str, int], tuple[Any, str] | None], problem: str, n: int) -> dict[str, Any]:
    """Return one row: the largest relative error of the squares, and seconds; the best of three."""
    truth = {"rod": np.array([1.5 * GRAVITY]), "four-bar": np.array([FOUR_BAR[1]])}.get(problem)
    truth = np.array([CATENARY]) if problem == "catenary" else truth
    truth = GRAVITY * roots_laguerre(n)[0] if truth is None else truth
    best: dict[str, Any] = {"problem": problem if problem != "chain" else f"chain of {n}", "seconds": None}
    for _ in range(1 if answer is sympy else 3):
        try:
            result = answer(problem, n)
        except Exception as failure:  # whatever a tool raises is its answer
            return best | {"way": f"failed: {str(failure).splitlines()[0][:60]}", "error": None}
        if result is None:
            return best | {"way": "not asked", "error": None}
        (squares, seconds), way = result
        squares = np.sort(squares)
        error = float(np.abs(squares / truth - 1.0).max()) if len(squares) == len(truth) else math.nan
        if best["seconds"] is None or seconds < best["seconds"]:
            best |= {"way": way, "error": error, "seconds": seconds, "lowest": float(squares[0]), "count": len(squares)}
    return best


def main() -> None:
    """Ask all that are installed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    rows = []
    for peer in (exudyn, mujoco, sympy):
        try:
            version = str(__import__(peer.__name__).__version__)
        except ImportError:
            sys.stderr.write(f"{peer.__name__}: not installed\n")
            continue
        for problem, n in (("rod", 1), *(("chain", n) for n in CHAINS), ("four-bar", 3), ("catenary", 10)):
            rows.append({"peer": peer.__name__, "version": version, **measured(peer, problem, n)})
            sys.stdout.write(json.dumps(rows[-1]) + "\n")
    if options.json is not None:
        options.json.write_text(json.dumps(rows))


if __name__ == "__main__":
    main()
