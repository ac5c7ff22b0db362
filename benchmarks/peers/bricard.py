"""Bricard's six-bar in Pinocchio, MuJoCo and Exudyn: ``python -m benchmarks.peers.bricard --reference FILE``.

A closed chain of six links (one is the ground) on the edges of a cube, whose thirty constraints have rank 29. All
peers get the numbers below. The error is the largest distance [m] of the joints P1 to P4 from a reference, which comes
as a file: ``{"times": [...], "points": [[[x, y, z] of P1 to P4] at each time]}``, equidistant from 0.
"""

from __future__ import annotations

import argparse
import json
import sys
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from .measure import Measured, Row, best_of, row, table

NAME = "bricard"
GRAVITY = (0.0, -9.81, 0.0)
MASS, SECTION = 1.0, 0.1
#: Joints; rod i leads from the one to the next.
POINTS = np.array([[0, 0, 0], [1, 0, 0], [1, -1, 0], [1, -1, 1], [0, -1, 1], [0, 0, 1]], dtype=float)
AXES = np.array([[0, 1, 0], [0, 0, 1], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 0]], dtype=float)
#: Loops that take longer [s of the processor] end a series of finer steps.
LIMIT = 3.0

Array = np.ndarray
#: Integrate with the setting that is bound to it and return the points, shape (times, 4, 3), and the loop to be timed.
Run = Callable[[], tuple[Array, Callable[[], object]]]


def inertia(rod: int) -> Array:
    """Give the tensor of a rod about its middle, along the ground's axes at the start.

    Parameters
    ----------
    rod : int
        From 0.

    Returns
    -------
    ndarray, shape (3, 3)
        Entries in kg m^2.
    """
    along = np.abs(POINTS[rod + 1] - POINTS[rod])
    return np.diag(MASS / 12 * np.where(along > 0.5, 2 * SECTION**2, 1 + SECTION**2))


def measured(run: Run, truth: Array) -> Measured:
    """Run once for the error and several times for the clock."""
    points, loop = run()
    error = float(np.linalg.norm(points - truth, axis=2).max())
    return *best_of(loop), error


# -- Pinocchio ---------------------------------------------------------------------------------------------------------


def pinocchio_rows(times: Array, truth: Array) -> Iterator[Row]:
    """Measure Runge-Kutta of fourth order in Python, and SciPy's DOP853, on Pinocchio's constraint dynamics.

    The loop is cut at P5 and closed by two points on its axis; their six rows have rank four, which the proximal solver
    stands.
    """
    import pinocchio as pin
    from scipy.integrate import DOP853

    model = pin.Model()
    model.gravity.linear = np.array(GRAVITY)
    parent, at = 0, np.zeros(3)
    for i in range(5):
        offset = pin.SE3(np.eye(3), POINTS[i] - at)
        parent = model.addJoint(parent, pin.JointModelRevoluteUnaligned(AXES[i]), offset, f"P{i}")
        middle = (POINTS[i + 1] - POINTS[i]) / 2
        model.appendBodyToJoint(parent, pin.Inertia(MASS, middle, inertia(i)), pin.SE3.Identity())
        at = POINTS[i]
    data = model.createData()
    ends = [POINTS[5], POINTS[5] + 0.5 * AXES[5]]
    closures = [
        pin.RigidConstraintModel(
            *(pin.ContactType.CONTACT_3D, model, parent, pin.SE3(np.eye(3), end - POINTS[4])),
            *(0, pin.SE3(np.eye(3), end), pin.ReferenceFrame.LOCAL),
        )
        for end in ends
    ]
    memory = [closure.createData() for closure in closures]
    pin.initConstraintDynamics(model, data, closures, memory)
    torque = np.zeros(5)

    def points_of(motion: Array) -> Array:
        points = np.zeros((len(motion), 4, 3))
        for k, q in enumerate(motion):
            pin.forwardKinematics(model, data, q)
            points[k] = [data.oMi[i].translation for i in range(2, 6)]
        return points

    def fixed(substeps: int, proximal: Any) -> Run:
        step = times[1] / substeps
        motion = np.zeros((len(times), 5))

        def loop() -> None:
            dynamics = pin.constraintDynamics
            q, v = np.zeros(5), np.zeros(5)
            for k in range(1, len(times)):
                for _ in range(substeps):
                    a1 = dynamics(model, data, q, v, torque, closures, memory, proximal).copy()
                    v2 = v + 0.5 * step * a1
                    a2 = dynamics(model, data, q + 0.5 * step * v, v2, torque, closures, memory, proximal).copy()
                    v3 = v + 0.5 * step * a2
                    a3 = dynamics(model, data, q + 0.5 * step * v2, v3, torque, closures, memory, proximal).copy()
                    v4 = v + step * a3
                    a4 = dynamics(model, data, q + step * v3, v4, torque, closures, memory, proximal)
                    q = q + step / 6 * (v + 2 * (v2 + v3) + v4)
                    v = v + step / 6 * (a1 + 2 * (a2 + a3) + a4)
                motion[k] = q

        def run() -> tuple[Array, Callable[[], object]]:
            loop()
            return points_of(motion), loop

        return run

    def adaptive(tolerance: float, proximal: Any) -> Run:
        motion = np.zeros((len(times), 5))

        def rate(_: float, y: Array) -> Array:
            a = pin.constraintDynamics(model, data, y[:5], y[5:], torque, closures, memory, proximal)
            return np.concatenate((y[5:], a))

        def loop() -> None:
            solver = DOP853(rate, 0.0, np.zeros(10), times[-1], rtol=tolerance, atol=tolerance)
            k = 1
            while k < len(times):
                solver.step()
                between = solver.dense_output() if times[k] <= solver.t else None
                while k < len(times) and times[k] <= solver.t:
                    motion[k] = between(times[k])[:5]
                    k += 1

        def run() -> tuple[Array, Callable[[], object]]:
            loop()
            return points_of(motion), loop

        return run

    for mu, iterations in ((1e-6, 10), (1e-8, 5)):
        proximal = pin.ProximalSettings(1e-12, mu, iterations)
        runs = [(f"RK4 {times[1] / n:.3g} s", fixed(n, proximal)) for n in (5, 10, 20, 40, 100)]
        runs += [(f"DOP853 (SciPy) {tol:.0e}", adaptive(tol, proximal)) for tol in 10.0 ** (-np.arange(10, 25) / 2)]
        for setting, run in runs:
            label = f"{setting}, mu {mu:.0e}"
            yield row("pinocchio", pin.__version__, label, NAME, lambda run=run: measured(run, truth))


# -- MuJoCo ------------------------------------------------------------------------------------------------------------


def mujoco_rows(times: Array, truth: Array) -> Iterator[Row]:
    """Measure MuJoCo's Runge-Kutta; the loop is closed by two connect constraints on the axis of P5."""
    import mujoco

    from .mujoco_peer import IMPEDANCE, OFF, SPRINGS

    mujoco.set_mju_user_warning(lambda _: None)

    def numbers(values: Array) -> str:
        return " ".join(repr(float(value)) for value in values)

    def model_of(step: float, spring: tuple[float, float]) -> Any:
        nested, at = "", np.zeros(3)
        for i in range(5):
            middle = numbers((POINTS[i + 1] - POINTS[i]) / 2)
            nested += (
                f'<body name="rod{i}" pos="{numbers(POINTS[i] - at)}"><joint type="hinge" axis="{numbers(AXES[i])}"/>'
                f'<inertial pos="{middle}" mass="{MASS}" diaginertia="{numbers(np.diag(inertia(i)))}"/>'
            )
            at = POINTS[i]
        closures = "".join(
            f'<connect body1="rod4" anchor="{numbers(end - POINTS[4])}" solimp="{IMPEDANCE}" '
            f'solref="{spring[0] * step!r} {spring[1]!r}"/>'
            for end in (POINTS[5], POINTS[5] + 0.5 * AXES[5])
        )
        flags = " ".join(f'{flag}="disable"' for flag in OFF)
        return mujoco.MjModel.from_xml_string(
            '<mujoco><compiler angle="radian" boundmass="0" boundinertia="0"/>'
            f'<option timestep="{step!r}" integrator="RK4" gravity="{numbers(np.array(GRAVITY))}" solver="Newton" '
            f'iterations="100" tolerance="1e-12" jacobian="dense"><flag {flags}/></option>'
            f"<worldbody>{nested}{'</body>' * 5}</worldbody><equality>{closures}</equality></mujoco>"
        )

    def run_of(substeps: int, spring: tuple[float, float]) -> Run:
        def run() -> tuple[Array, Callable[[], object]]:
            model = model_of(float(times[1] / substeps), spring)
            data = mujoco.MjData(model)
            motion = np.zeros((len(times), 5))

            def loop() -> None:
                mujoco.mj_resetData(model, data)
                for k in range(1, len(times)):
                    mujoco.mj_step(model, data, substeps)
                    motion[k] = data.qpos

            loop()
            points = np.zeros((len(times), 4, 3))
            for k, q in enumerate(motion):
                data.qpos[:] = q
                mujoco.mj_kinematics(model, data)
                points[k] = data.xpos[2:6]
            return points, loop

        return run

    for spring in (*SPRINGS, (1.0, 1.0)):
        for substeps in (20, 30, 50, 100, 200, 400, 1000):
            setting = f"RK4 {times[1] / substeps:.3g} s, constraints {spring[0]:g} steps, ratio {spring[1]:g}"
            run = run_of(substeps, spring)
            line = row("mujoco", str(mujoco.__version__), setting, NAME, lambda run=run: measured(run, truth))
            yield line
            if line.get("cpu", 0.0) > LIMIT:
                break


# -- Exudyn ------------------------------------------------------------------------------------------------------------


def exudyn_rows(times: Array, truth: Array) -> Iterator[Row]:
    """Measure Exudyn's implicit integrators on rigid bodies with revolute joints, redundant equations allowed."""
    sys.exudynFast = True  # type: ignore[attr-defined]  # Exudyn reads it when it is imported
    import exudyn as exu
    from exudyn.utilities import RigidBodyInertia

    from .exudyn_peer import METHODS, Method

    warnings.simplefilter("ignore", DeprecationWarning)
    exu.SetWriteToConsole(False)

    def system_of() -> tuple[Any, Any, list[Any]]:
        container = exu.SystemContainer()
        system = container.AddSystem()
        bodies = [system.CreateGround()]
        for i in range(5):
            body = RigidBodyInertia(mass=MASS, inertiaTensor=inertia(i))
            middle = (POINTS[i] + POINTS[i + 1]) / 2
            bodies.append(system.CreateRigidBody(inertia=body, referencePosition=list(middle), gravity=list(GRAVITY)))
        for i in range(6):
            pair = [bodies[i], bodies[(i + 1) % 6]]
            system.CreateRevoluteJoint(
                bodyNumbers=pair, position=list(POINTS[i]), axis=list(AXES[i]), useGlobalFrame=True
            )
        sensors = []
        for i in range(4):
            end = list((POINTS[i + 1] - POINTS[i]) / 2)
            kind = exu.OutputVariableType.Position
            item = exu.itemInterface.SensorBody(
                bodyNumber=bodies[i + 1], localPosition=end, storeInternal=True, outputVariableType=kind
            )
            sensors.append(system.AddSensor(item))
        system.Assemble()
        return container, system, sensors

    def settings_of(substeps: int, method: Method) -> Any:
        out = exu.SimulationSettings()
        out.solution.file.write = False
        out.solution.sensors.writePeriod = times[1]
        out.parallel.numberOfThreads = 1
        out.linearSolver.solverType = exu.LinearSolverType.EigenDense
        out.linearSolver.ignoreSingularJacobian = True
        out.timeIntegration.numberOfSteps = substeps * (len(times) - 1)
        out.timeIntegration.endTime = float(times[-1])
        out.timeIntegration.verboseMode = 0
        out.timeIntegration.adaptiveStep = False
        newton = out.timeIntegration.newton
        newton.useModifiedNewton, newton.relativeTolerance = True, method.tolerance
        if method.contraction is None:
            newton.modifiedNewtonJacUpdatePerStep = True
        else:
            newton.modifiedNewtonContractivity = method.contraction
        alpha = out.timeIntegration.generalizedAlpha
        alpha.useIndex2Constraints = alpha.useNewmark = method.radius is None
        if method.radius is not None:
            alpha.spectralRadius = method.radius
        return out

    def run_of(substeps: int, method: Method) -> Run:
        def run() -> tuple[Array, Callable[[], object]]:
            container, system, sensors = system_of()
            chosen = settings_of(substeps, method)
            kinds = exu.DynamicSolverType
            kind = kinds.TrapezoidalIndex2 if method.radius is None else kinds.GeneralizedAlpha

            def loop(container: Any = container) -> None:  # the container must be kept
                if not system.SolveDynamic(chosen, solverType=kind, showHints=False):
                    raise RuntimeError("the solver gave up")

            loop()
            stored = [np.asarray(system.GetSensorStoredData(sensor))[:, 1:4] for sensor in sensors]
            return np.stack(stored, axis=1), loop

        return run

    for method in METHODS:
        for substeps in (20, 50, 100, 200, 500):
            setting = f"{method}, {times[1] / substeps:.3g} s"
            run = run_of(substeps, method)
            line = row("exudyn", str(exu.__version__), setting, NAME, lambda run=run: measured(run, truth))
            yield line
            if line.get("cpu", 0.0) > LIMIT:
                break


PEERS = {"pinocchio": pinocchio_rows, "mujoco": mujoco_rows, "exudyn": exudyn_rows}


def main() -> None:
    """Run from the command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.peers.bricard", description=__doc__)
    parser.add_argument("--reference", type=Path, required=True)
    parser.add_argument("--peers", default=",".join(PEERS), help="comma-separated")
    parser.add_argument("--json", type=Path, help="file for the rows")
    options = parser.parse_args()
    content = json.loads(options.reference.read_text(encoding="utf-8"))
    times, truth = np.array(content["times"]), np.array(content["points"])
    results: list[Row] = []
    for name in options.peers.split(","):
        try:
            lines = list(PEERS[name](times, truth))
        except ImportError as problem:
            print(f"{name}: {problem}", file=sys.stderr)
            continue
        results += lines
        print("\n".join(table(lines)), flush=True)
        if options.json is not None:
            options.json.write_text(json.dumps(results, indent=1, allow_nan=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
