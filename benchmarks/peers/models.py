"""One neutral description of every benchmark mechanism.

All mechanisms are planar. A body is a mass, a central moment of inertia, an
initial angle and an initial rate; its local frame has its origin at the centre
of mass. Initial positions and velocities of the centres of mass follow from the
joints, so no peer can start from numbers that differ from another peer's.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

GROUND = -1
Point = tuple[float, float]
Array = NDArray[np.float64]


@dataclass(frozen=True)
class Body:
    """A planar rigid body.

    Attributes
    ----------
    name : str
        Name of the body.
    mass, inertia : float
        Mass in kg and moment of inertia about the centre of mass in kg m^2.
    angle, rate : float
        Initial angle in rad from the x axis, and initial rate in rad/s.
    """

    name: str
    mass: float
    inertia: float
    angle: float
    rate: float = 0.0


@dataclass(frozen=True)
class Joint:
    """A revolute joint between a point of body ``a`` and one of body ``b``.

    Attributes
    ----------
    a, b : int
        Body indices; ``a`` may be `GROUND`, whose local frame is the world's.
    point_a, point_b : tuple of float
        Local coordinates of the pin in m.
    """

    a: int
    point_a: Point
    b: int
    point_b: Point


@dataclass(frozen=True)
class Spring:
    """A linear spring from a point of a body to a point of the ground.

    Attributes
    ----------
    body : int
        Index of the body.
    point, anchor : tuple of float
        Local point on the body and fixed point, in m.
    stiffness, length : float
        Stiffness in N/m and unloaded length in m.
    """

    body: int
    point: Point
    anchor: Point
    stiffness: float
    length: float


@dataclass(frozen=True)
class Model:
    """A mechanism with its initial state and time span.

    Attributes
    ----------
    name : str
        Name of the mechanism.
    bodies : tuple of Body
        Moving bodies.
    joints : tuple of Joint
        Revolute joints; a joint whose body ``b`` is not placed yet belongs to
        the spanning tree, any other closes a loop.
    duration : float
        End time in s.
    step : float
        Unit of time steps in s: what 1e-3 s is for ten seconds of motion.
    springs : tuple of Spring
        Springs to the ground.
    torques : mapping of int to float
        Constant torque in N m on a body, by index.
    gravity : float
        Acceleration along -y in m/s^2.
    parameters : mapping of str to float
        Named dimensions that the reduced references read.
    """

    name: str
    bodies: tuple[Body, ...]
    joints: tuple[Joint, ...]
    duration: float
    step: float
    springs: tuple[Spring, ...] = ()
    torques: Mapping[int, float] = field(default_factory=dict)
    gravity: float = 9.81
    parameters: Mapping[str, float] = field(default_factory=dict)

    def tree(self) -> tuple[list[Joint], list[Joint]]:
        """Split the joints into those of a spanning tree and those that close loops.

        Returns
        -------
        tree, loops : list of Joint
            The tree joints in placing order, and the others.
        """
        placed = {GROUND}
        tree: list[Joint] = []
        loops: list[Joint] = []
        for joint in self.joints:
            if joint.a not in placed:
                raise ValueError("joints must be listed outwards from the ground")
            if joint.b in placed:
                loops.append(joint)
            else:
                tree.append(joint)
                placed.add(joint.b)
        return tree, loops

    def place(self) -> tuple[Array, Array]:
        """Give initial positions and velocities of the centres of mass.

        Returns
        -------
        position, velocity : ndarray, shape (bodies, 2)
            World coordinates in m and m/s.
        """
        position = np.zeros((len(self.bodies), 2))
        velocity = np.zeros((len(self.bodies), 2))
        for joint in self.tree()[0]:
            pin, speed = np.array(joint.point_a), np.zeros(2)
            if joint.a != GROUND:
                arm = rotate(self.bodies[joint.a].angle, joint.point_a)
                pin = position[joint.a] + arm
                speed = velocity[joint.a] + self.bodies[joint.a].rate * turn(arm)
            arm = rotate(self.bodies[joint.b].angle, joint.point_b)
            position[joint.b] = pin - arm
            velocity[joint.b] = speed - self.bodies[joint.b].rate * turn(arm)
        return position, velocity

    def gap(self) -> float:
        """Largest distance in m by which a loop is open at the start.

        Returns
        -------
        float
            Zero up to rounding for a well assembled mechanism.
        """
        position, _ = self.place()
        widest = 0.0
        for joint in self.tree()[1]:
            end_b = position[joint.b] + rotate(self.bodies[joint.b].angle, joint.point_b)
            end_a = position[joint.a] + rotate(self.bodies[joint.a].angle, joint.point_a)
            widest = max(widest, float(np.hypot(*(end_a - end_b))))
        return widest


def rotate(angle: float, point: Point) -> Array:
    """Rotate a local point into the world frame.

    Parameters
    ----------
    angle : float
        Angle in rad.
    point : tuple of float
        Local coordinates.

    Returns
    -------
    ndarray, shape (2,)
        World components.
    """
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * point[0] - s * point[1], s * point[0] + c * point[1]])


def turn(arm: Array) -> Array:
    """Turn a vector by a right angle, counter-clockwise.

    Parameters
    ----------
    arm : ndarray, shape (2,)
        Any vector.

    Returns
    -------
    ndarray, shape (2,)
        The turned vector.
    """
    return np.array([-arm[1], arm[0]])


def rod(name: str, mass: float, length: float, angle: float, rate: float = 0.0) -> Body:
    """Build a uniform slender rod along its local x axis.

    Parameters
    ----------
    name : str
        Name of the body.
    mass, length : float
        Mass in kg and length in m.
    angle, rate : float
        Initial angle in rad and rate in rad/s.

    Returns
    -------
    Body
        The rod.
    """
    return Body(name, mass, mass * length**2 / 12, angle, rate)


def four_bar(name: str, ground: float, lengths: tuple[float, float, float], masses: tuple[float, ...]) -> Model:
    """Build a four-bar linkage of uniform rods with the crank at 60 degrees.

    Parameters
    ----------
    name : str
        Name of the mechanism.
    ground : float
        Distance of the ground pivots in m.
    lengths : tuple of float
        Crank, coupler and rocker in m.
    masses : tuple of float
        Their masses in kg.

    Returns
    -------
    Model
        The mechanism, at rest, with the upper one of the two assemblies.
    """
    crank, coupler, rocker = lengths
    start = math.pi / 3
    x, y = crank * math.cos(start), crank * math.sin(start)
    span = math.hypot(ground - x, y)
    along = (span**2 + coupler**2 - rocker**2) / (2 * span)
    up = math.sqrt(coupler**2 - along**2)
    ux, uy = (ground - x) / span, -y / span
    pin = (x + along * ux - up * uy, y + along * uy + up * ux)
    bodies = (
        rod("crank", masses[0], crank, start),
        rod("coupler", masses[1], coupler, math.atan2(pin[1] - y, pin[0] - x)),
        rod("rocker", masses[2], rocker, math.atan2(pin[1], pin[0] - ground)),
    )
    joints = (
        Joint(GROUND, (0.0, 0.0), 0, (-crank / 2, 0.0)),
        Joint(0, (crank / 2, 0.0), 1, (-coupler / 2, 0.0)),
        Joint(GROUND, (ground, 0.0), 2, (-rocker / 2, 0.0)),
        Joint(1, (coupler / 2, 0.0), 2, (rocker / 2, 0.0)),
    )
    keys = ("ground", "crank", "coupler", "rocker", "m1", "m2", "m3")
    parameters = dict(zip(keys, (ground, *lengths, *masses), strict=True))
    return Model(name, bodies, joints, 10.0, 1e-3, parameters=parameters)


def n_four_bar(windows: int) -> Model:
    """Build the N-four-bar mechanism (A02 of the IFToMM benchmark library).

    Parameters
    ----------
    windows : int
        Number of parallelogram windows.

    Returns
    -------
    Model
        Rods of 1 m and 1 kg, upright, with the tops moving at 1 m/s along x.
    """
    bodies: list[Body] = []
    joints: list[Joint] = []
    for i in range(windows + 1):
        bodies.append(rod(f"link{i}", 1.0, 1.0, math.pi / 2, -1.0))
        joints.append(Joint(GROUND, (float(i), 0.0), i, (-0.5, 0.0)))
    for i in range(windows):
        bodies.append(rod(f"coupler{i}", 1.0, 1.0, 0.0))
        joints.append(Joint(i, (0.5, 0.0), windows + 1 + i, (-0.5, 0.0)))
        joints.append(Joint(i + 1, (0.5, 0.0), windows + 1 + i, (0.5, 0.0)))
    parameters = {"windows": float(windows)}
    return Model(f"n-four-bar:{windows}", tuple(bodies), tuple(joints), 10.0, 1e-3, parameters=parameters)


def andrews() -> Model:
    """Build the seven-body squeezing mechanism of the Test Set for IVP Solvers.

    The numbers are those of the test set (Bari/CWI, release 2; read from the
    files of the R package deTestSet). The local axes are those that its angles
    beta, beta + theta, gamma, phi + delta, delta, omega + epsilon and epsilon
    turn.

    Returns
    -------
    Model
        The mechanism, at rest, driven by a constant torque on the crank.
    """
    beta, gamma = -0.0617138900142764496358948458001, 0.455279819163070380255912382449
    phi, delta = 0.222668390165885884674473185609, 0.487364979543842550225598953530
    epsilon = 1.23054744454982119249735015568
    bodies = (
        Body("K1", 0.04325, 2.194e-06, beta),
        Body("K2", 0.00365, 4.41e-07, beta),
        Body("K3", 0.02373, 5.255e-06, gamma),
        Body("K4", 0.00706, 5.667e-07, phi + delta),
        Body("K5", 0.0705, 1.169e-05, delta),
        Body("K6", 0.00706, 5.667e-07, epsilon - phi),
        Body("K7", 0.05498, 1.912e-05, epsilon),
    )
    rr, ra, d, da, e, ea = 0.007, 0.00092, 0.028, 0.0115, 0.02, 0.01421
    ss, sa, sb, sc, sd = 0.035, 0.01874, 0.01043, 0.018, 0.02
    ta, tb, u, ua, ub = 0.02308, 0.00916, 0.04, 0.01228, 0.00449
    zf, zt, fa = 0.02, 0.04, 0.01421
    a_point, b_point, c_point = (-0.06934, -0.00227), (-0.03635, 0.03273), (0.014, 0.072)
    joints = (
        Joint(GROUND, (0.0, 0.0), 0, (-ra, 0.0)),
        Joint(0, (rr - ra, 0.0), 1, (da, 0.0)),
        Joint(GROUND, b_point, 2, (-sb, sa)),
        Joint(GROUND, a_point, 4, (-ta, -tb)),
        Joint(4, (zt - ta, -tb), 3, (0.0, e - ea)),
        Joint(GROUND, a_point, 6, (-ua, ub)),
        Joint(6, (-ua, ub - u), 5, (fa - zf, 0.0)),
        Joint(1, (da - d, 0.0), 2, (-sb, sa - ss)),
        Joint(1, (da - d, 0.0), 3, (0.0, -ea)),
        Joint(1, (da - d, 0.0), 5, (fa, 0.0)),
    )
    spring = Spring(2, (sd - sb, sa - sc), c_point, 4530.0, 0.07785)
    return Model("andrews", bodies, joints, 0.03, 1e-5, (spring,), {0: 0.033}, 0.0)


_BUILDERS: dict[str, Callable[[], Model]] = {
    "four-bar-peers": lambda: four_bar("four-bar-peers", 4.0, (1.0, 3.0, 3.0), (1.0, 3.0, 3.0)),
    "four-bar": lambda: four_bar("four-bar", 10.0, (2.0, 8.0, 5.0), (2.0, 8.0, 5.0)),
    "andrews": andrews,
    "n-four-bar:10": lambda: n_four_bar(10),
    "a02": lambda: replace(n_four_bar(40), name="a02", duration=20.0),
}
NAMES: tuple[str, ...] = tuple(_BUILDERS)


def load(name: str) -> Model:
    """Build a mechanism by name.

    Parameters
    ----------
    name : str
        One of `NAMES`, or ``n-four-bar:N`` for any positive N.

    Returns
    -------
    Model
        The mechanism.
    """
    if name in _BUILDERS:
        return _BUILDERS[name]()
    kind, _, count = name.partition(":")
    if kind == "n-four-bar" and count.isdigit() and int(count) > 0:
        return n_four_bar(int(count))
    raise KeyError(f"unknown mechanism {name!r}; known: {', '.join(NAMES)}")
