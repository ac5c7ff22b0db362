"""Exudyn: planar rigid bodies in absolute coordinates, implicit integrators.

The library's build without range checks, one thread, no files, no output but
the sensors that the error is taken from. Absolute coordinates with planar
revolute joints were faster than a kinematic tree with loop joints.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

sys.exudynFast = True  # type: ignore[attr-defined]  # read by the import below

import exudyn as exu  # noqa: E402  # after the choice of the build
import numpy as np  # noqa: E402  # after the choice of the build
from exudyn import itemInterface as items  # noqa: E402  # after the choice of the build

from . import reference  # noqa: E402  # after the choice of the build
from .measure import Measured, Row, best_of, row  # noqa: E402  # after the choice of the build
from .models import GROUND, Array, Model, Point  # noqa: E402  # after the choice of the build

NAME = "exudyn"
VERSION = str(exu.__version__)
REFINEMENTS = (1.0, 2.0, 5.0, 8.0, 10.0, 13.0, 16.0, 24.0)
LIMIT = 6.0
SPARSE_FROM = 12


@dataclass(frozen=True)
class Method:
    """One choice of integrator and Newton iteration.

    Attributes
    ----------
    radius : float or None
        Spectral radius of the generalised-alpha method on index 3, or None for
        the trapezoidal rule on index 2.
    contraction : float or None
        The iteration matrix is renewed where the iteration contracts less than
        this; None renews it once in every step.
    tolerance : float
        Relative tolerance of the iteration.
    """

    radius: float | None
    contraction: float | None
    tolerance: float

    def __str__(self) -> str:
        name = "trapezoidal, index 2" if self.radius is None else f"generalised-alpha {self.radius:g}, index 3"
        renewal = "each step" if self.contraction is None else f"{self.contraction:g}"
        return f"{name}, Jacobian {renewal}, {self.tolerance:.0e}"


METHODS = (
    Method(None, None, 1e-8),
    Method(None, 0.02, 1e-8),
    Method(None, 0.02, 1e-9),
    Method(0.9, None, 1e-8),
    Method(0.9, 0.02, 1e-9),
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
        One result per setting; finer steps end once a loop takes `LIMIT` seconds
        or after two failures in a row.
    """
    warnings.simplefilter("ignore", DeprecationWarning)
    exu.SetWriteToConsole(False)
    truth = reference.angles(model)
    for method in METHODS:
        failures = 0
        for factor in REFINEMENTS:
            steps = round(model.duration / model.step / reference.INTERVALS * factor)
            step = model.duration / reference.INTERVALS / steps
            out = row(
                NAME,
                VERSION,
                f"{method}, {step:.3g} s",
                model.name,
                lambda steps=steps, method=method: _run(model, steps, method, truth),
            )
            yield out
            failures = failures + 1 if out["seconds"] is None else 0
            if (out["seconds"] or 0.0) > LIMIT or failures == 2:
                break


def build(model: Model) -> tuple[Any, Any, list[Any]]:
    """Build a mechanism.

    Parameters
    ----------
    model : Model
        The mechanism.

    Returns
    -------
    container, system
        Exudyn's container, which must be kept, and the assembled system.
    sensors : list
        One sensor of the coordinates per body.
    """
    container = exu.SystemContainer()
    system = container.AddSystem()
    ground = system.AddObject(items.ObjectGround())
    positions, velocities = model.place()
    nodes, objects = [], []
    for body, position, velocity in zip(model.bodies, positions, velocities, strict=True):
        node = system.AddNode(
            items.NodeRigidBody2D(
                referenceCoordinates=[*position, body.angle],
                initialVelocities=[*velocity, body.rate],
            )
        )
        item = system.AddObject(items.ObjectRigidBody2D(mass=body.mass, inertia=body.inertia, nodeNumber=node))
        nodes.append(node)
        objects.append(item)
        if model.gravity:
            marker = system.AddMarker(items.MarkerBodyMass(bodyNumber=item))
            load = [0.0, -model.gravity, 0.0]
            system.AddLoad(items.LoadMassProportional(markerNumber=marker, loadVector=load))

    def marker_at(body: int, point: Point) -> Any:
        number = ground if body == GROUND else objects[body]
        return system.AddMarker(items.MarkerBodyPosition(bodyNumber=number, localPosition=[*point, 0.0]))

    for joint in model.joints:
        markers = [marker_at(joint.a, joint.point_a), marker_at(joint.b, joint.point_b)]
        system.AddObject(items.ObjectJointRevolute2D(markerNumbers=markers))
    for spring in model.springs:
        markers = [marker_at(GROUND, spring.anchor), marker_at(spring.body, spring.point)]
        system.AddObject(
            items.ObjectConnectorSpringDamper(
                markerNumbers=markers, stiffness=spring.stiffness, referenceLength=spring.length
            )
        )
    for index, torque in model.torques.items():
        marker = system.AddMarker(items.MarkerBodyRigid(bodyNumber=objects[index]))
        system.AddLoad(items.LoadTorqueVector(markerNumber=marker, loadVector=[0.0, 0.0, torque]))
    sensors = [
        system.AddSensor(
            items.SensorNode(
                nodeNumber=node,
                storeInternal=True,
                outputVariableType=exu.OutputVariableType.Coordinates,
            )
        )
        for node in nodes
    ]
    system.Assemble()
    return container, system, sensors


def settings(model: Model, steps: int, method: Method) -> Any:
    """Choose the integrator.

    Parameters
    ----------
    model : Model
        The mechanism.
    steps : int
        Steps between two samples.
    method : Method
        Integrator and iteration.

    Returns
    -------
    exudyn.SimulationSettings
        The settings.
    """
    out = exu.SimulationSettings()
    out.solution.file.write = False
    out.solution.sensors.writePeriod = model.duration / reference.INTERVALS
    out.parallel.numberOfThreads = 1
    if len(model.bodies) >= SPARSE_FROM:
        out.linearSolver.solverType = exu.LinearSolverType.EigenSparse
    time = out.timeIntegration
    time.numberOfSteps = steps * reference.INTERVALS
    time.endTime = model.duration
    time.verboseMode = 0
    time.adaptiveStep = False
    time.newton.useModifiedNewton = True
    time.newton.relativeTolerance = method.tolerance
    if method.contraction is None:
        time.newton.modifiedNewtonJacUpdatePerStep = True
    else:
        time.newton.modifiedNewtonContractivity = method.contraction
    alpha = time.generalizedAlpha
    alpha.useIndex2Constraints = alpha.useNewmark = method.radius is None
    if method.radius is not None:
        alpha.spectralRadius = method.radius
    return out


def _run(model: Model, steps: int, method: Method, truth: Array) -> Measured:
    """Integrate with so many steps between two samples."""
    container, system, sensors = build(model)
    chosen = settings(model, steps, method)
    kinds = exu.DynamicSolverType
    kind = kinds.TrapezoidalIndex2 if method.radius is None else kinds.GeneralizedAlpha

    def loop() -> None:
        if not system.SolveDynamic(chosen, solverType=kind, showHints=False):
            raise RuntimeError("the solver gave up")

    loop()
    turned = [np.asarray(system.GetSensorStoredData(sensor))[:, 3] for sensor in sensors]
    values = np.array(turned).T + np.array([body.angle for body in model.bodies])
    error = reference.largest_error(values, truth)
    times = best_of(loop)
    del container
    return *times, error
