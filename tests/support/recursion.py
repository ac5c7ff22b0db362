"""Robots as trees of limbs, and their dynamics by recursions in numbers, written for the tests alone.

Motions and forces are vectors of space, angular parts first (Featherstone, Rigid Body Dynamics Algorithms, 2008).
"""

from dataclasses import dataclass

import numpy as np

GRAVITY = 9.81


@dataclass(frozen=True)
class Limb:
    name: str
    parent: int  # -1: the base
    kind: str  # revolute or prismatic
    at: np.ndarray
    rpy: np.ndarray
    axis: np.ndarray
    mass: float
    centre: np.ndarray
    inertia: np.ndarray  # about the centre
    damping: float = 0.0


def turned(axis, angle):
    x = skew(axis)
    return np.eye(3) + np.sin(angle) * x + (1 - np.cos(angle)) * x @ x


def of_rpy(rpy):
    x, y, z = np.eye(3)
    return turned(z, rpy[2]) @ turned(y, rpy[1]) @ turned(x, rpy[0])


def skew(p):
    return np.array([[0, -p[2], p[1]], [p[2], 0, -p[0]], [-p[1], p[0], 0]])


def random_robot(seed: int, parents: list[int], kinds: str) -> list[Limb]:
    """A robot with such parents; `kinds` has r or p for each limb."""
    rng, limbs = np.random.default_rng(seed), []
    for k, (parent, kind) in enumerate(zip(parents, kinds, strict=True)):
        frame = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        a, b, c = rng.uniform(0.02, 0.05, 3)
        axis = rng.normal(size=3)
        limbs.append(
            Limb(
                f"limb{k}",
                parent,
                {"r": "revolute", "p": "prismatic"}[kind],
                rng.uniform(-0.5, 0.5, 3),
                rng.uniform(-1.5, 1.5, 3),
                axis / np.linalg.norm(axis),
                rng.uniform(0.5, 3.0),
                rng.uniform(-0.2, 0.2, 3),
                frame @ np.diag([b + c, a + c, a + b]) @ frame.T,
                rng.uniform(0.0, 0.3),
            )
        )
    return limbs


def urdf(limbs: list[Limb]) -> str:
    """The robot's file."""

    def numbers(values):
        return " ".join(repr(float(x)) for x in values)

    lines = ['<robot name="robot"><link name="base"/>']
    for limb in limbs:
        i = limb.inertia
        tensor = f'ixx="{i[0, 0]}" iyy="{i[1, 1]}" izz="{i[2, 2]}" ixy="{i[0, 1]}" ixz="{i[0, 2]}" iyz="{i[1, 2]}"'
        parent = "base" if limb.parent < 0 else limbs[limb.parent].name
        limit = '<limit lower="-9" upper="9" effort="1" velocity="1"/>'
        lines.append(
            f'<link name="{limb.name}"><inertial><origin xyz="{numbers(limb.centre)}"/><mass value="{limb.mass}"/>'
            f'<inertia {tensor}/></inertial></link><joint name="j_{limb.name}" type="{limb.kind}">'
            f'<parent link="{parent}"/><child link="{limb.name}"/>'
            f'<origin xyz="{numbers(limb.at)}" rpy="{numbers(limb.rpy)}"/><axis xyz="{numbers(limb.axis)}"/>'
            f'{limit}<dynamics damping="{limb.damping}"/></joint>'
        )
    last = limbs[-1].name
    lines.append('<link name="tool"/><joint name="weld" type="fixed">')
    lines.append(f'<parent link="{last}"/><child link="tool"/><origin xyz="0.1 -0.2 0.3"/></joint></robot>')
    return "\n".join(lines)


#: Of the tool in the last limb.
TOOL = np.array([0.1, -0.2, 0.3])


class Recursion:
    """The recursions of a robot."""

    def __init__(self, limbs: list[Limb]) -> None:
        self.limbs = limbs

    def poses(self, q):
        """Turn and place of each limb."""
        poses = []
        for limb, x in zip(self.limbs, q, strict=True):
            turn, at = (np.eye(3), np.zeros(3)) if limb.parent < 0 else poses[limb.parent]
            own = of_rpy(limb.rpy)
            if limb.kind == "revolute":
                poses.append((turn @ own @ turned(limb.axis, x), at + turn @ limb.at))
            else:
                poses.append((turn @ own, at + turn @ (limb.at + own @ limb.axis * x)))
        return poses

    def efforts(self, q, v, a, gravity=GRAVITY):
        """Efforts by recursive Newton-Euler, everything in the axes of the base, about its origin."""
        poses, motions, rates, axes = self.poses(q), [], [], []
        for limb, (turn, at), speed, growth in zip(self.limbs, poses, v, a, strict=True):
            axis = turn @ limb.axis
            s = np.r_[axis, np.cross(at, axis)] if limb.kind == "revolute" else np.r_[np.zeros(3), axis]
            up, rise = (np.zeros(6), np.r_[0, 0, 0, 0, 0, gravity])
            if limb.parent >= 0:
                up, rise = motions[limb.parent], rates[limb.parent]
            motions.append(up + s * speed)
            rates.append(rise + s * growth + cross(up) @ s * speed)
            axes.append(s)
        forces = []
        for limb, (turn, at), motion, rate in zip(self.limbs, poses, motions, rates, strict=True):
            c, tensor = skew(at + turn @ limb.centre), turn @ limb.inertia @ turn.T
            inertia = np.block([[tensor - limb.mass * c @ c, limb.mass * c], [-limb.mass * c, limb.mass * np.eye(3)]])
            forces.append(inertia @ rate - cross(motion).T @ (inertia @ motion))
        result = np.zeros(len(q))
        for k in range(len(q) - 1, -1, -1):
            result[k] = axes[k] @ forces[k]
            if self.limbs[k].parent >= 0:
                forces[self.limbs[k].parent] = forces[self.limbs[k].parent] + forces[k]
        return result + np.array([limb.damping for limb in self.limbs]) * v * (gravity != 0)

    def mass(self, q):
        n = len(q)
        return np.array([self.efforts(q, np.zeros(n), e, gravity=0) for e in np.eye(n)]).T

    def tool(self, q):
        """Turn and place of the tool, and its Jacobian, linear part first."""
        poses = self.poses(q)
        turn, at = poses[-1]
        place, jacobian, k = at + turn @ TOOL, np.zeros((6, len(q))), len(q) - 1
        while k >= 0:
            axis = poses[k][0] @ self.limbs[k].axis
            jacobian[:, k] = np.r_[axis, np.zeros(3)]
            if self.limbs[k].kind == "revolute":
                jacobian[:, k] = np.r_[np.cross(axis, place - poses[k][1]), axis]
            k = self.limbs[k].parent
        return turn, place, jacobian


def cross(m):
    """The matrix of the product of motions."""
    return np.block([[skew(m[:3]), np.zeros((3, 3))], [skew(m[3:]), skew(m[:3])]])
