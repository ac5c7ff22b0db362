"""A mechanism being drawn: bodies stand somewhere, and joints are put where these poses satisfy them."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from benchmarks.plain.moving import Array
from benchmarks.plain.start import choose_turns
from benchmarks.plain.system import read
from benchmarks.plain.turning import euler_parameters, turned

GROUND = "ground"
#: Names that emitted code or other programs use for things of their own.
AWKWARD = (
    "f F g g_slope G q v p w D M S phi nu gamma x0 out ydot rhs accept numba math np njit status iw value table_f "
    "e0 e1 vx angle_ N E s0 s1 p0 p16 i j k n h dt Q P T L I O l o table work energy model self index"
).split()
#: Sections whose names must differ from each other's, besides bodies, joints and forces.
VALUES = ("parameters", "tables")


@dataclass
class Pose:
    """Where a body stands: origin of its frame and rotation matrix, 2 or 3 dimensions."""

    origin: Array
    matrix: Array
    rigid: bool
    centre: Array

    @property
    def centre_at(self) -> Array:
        """The centre of mass in the ground frame."""
        place: Array = self.origin + self.matrix @ self.centre
        return place


class Draft:
    """A mechanism being drawn.

    Parameters
    ----------
    rng : random.Random
        Where choices come from.
    spatial : bool
        In space or in the plane.

    Attributes
    ----------
    raw : dict
        The tables so far.
    features : set of str
        Words for what was drawn, by which results are counted.
    """

    def __init__(self, rng: random.Random, spatial: bool) -> None:
        self.rng, self.spatial, self.dimension = rng, spatial, 3 if spatial else 2
        gravity = [0.0, 0.0, -9.81] if spatial else [0.0, -9.81]
        if rng.random() < 0.15:
            gravity = [self.number(-10, 10) for _ in gravity]
        self.raw: dict[str, Any] = {
            "mechanism": {"name": "drawn", "space": "spatial" if spatial else "planar", "gravity": gravity},
            "run": {"until": 1.0},
            "parameters": {},
            "tables": {},
            "bodies": {},
            "joints": {},
            "forces": {},
        }
        self.poses: dict[str, Pose] = {}
        self.features: set[str] = set()
        self.awkward = rng.random() < 0.25

    # -- choices -------------------------------------------------------------------------------------------------------

    def number(self, low: float, high: float, digits: int = 4) -> float:
        """Return a number of few digits."""
        return round(self.rng.uniform(low, high), digits)

    def positive(self, low: float, high: float) -> float:
        """Return a number above 0 whose logarithm is even between two bounds."""
        return float(f"{math.exp(self.rng.uniform(math.log(low), math.log(high))):.4g}")

    def chance(self, share: float) -> bool:
        """Return whether something happens."""
        return self.rng.random() < share

    def vector(self, size: float = 1.0) -> list[float]:
        """Return a vector of numbers of few digits."""
        return [self.number(-size, size) for _ in range(self.dimension)]

    def direction(self) -> Array:
        """Return a direction, sometimes along an axis."""
        if self.chance(0.25):
            axis: Array = np.eye(self.dimension)[self.rng.randrange(self.dimension)]
            return axis * self.rng.choice([1.0, -1.0])
        while True:
            x = np.array([self.rng.gauss(0.0, 1.0) for _ in range(self.dimension)])
            if np.linalg.norm(x) > 0.1:
                return np.asarray(x / float(np.linalg.norm(x)))

    def across(self, axis: Array) -> Array:
        """Return a direction well away from an axis, not necessarily perpendicular."""
        while True:
            x = self.direction()
            if np.linalg.norm(np.cross(x, axis)) > 0.4:
                return x

    def name(self, stem: str, group: tuple[str, ...] = ("bodies", "joints", "forces")) -> str:
        """Return a name that is not used yet in sections that share their names."""
        used = {n for section in group for n in self.raw[section]}
        free = [n for n in AWKWARD if n not in used] if self.awkward else []
        return self.rng.choice(free) if free else f"{stem}{len(used)}"

    def scalar(self, value: float) -> float | str:
        """Return a number, or a formula of a new parameter that is the same."""
        if not self.chance(0.12) or value == 0.0:
            return value
        name = self.name("k", VALUES)
        number = float(value)
        self.raw["parameters"][name] = {"value": number, "unit": "1"} if self.chance(0.5) else number
        return self.rng.choice([name, f"{name}*1.0", f"2*{name}/2", f"({name})"])

    # -- bodies --------------------------------------------------------------------------------------------------------

    def body(self, rigid: bool | None = None, mass: float | None = None) -> str:
        """Add a body somewhere and return its name."""
        name = self.name("b")
        rigid = self.chance(0.85) if rigid is None else rigid
        origin = np.array(self.vector(1.5))
        mass = self.positive(0.2, 5.0) if mass is None else mass
        table: dict[str, Any] = {"mass": self.scalar(mass)}
        if not rigid:
            table = {"type": "point", **table, "position": origin.tolist()}
            self.raw["bodies"][name] = table
            self.poses[name] = Pose(origin, np.eye(self.dimension), False, np.zeros(self.dimension))
            return name
        centre = np.array(self.vector(0.3)) if self.chance(0.4) else np.zeros(self.dimension)
        table["position"] = origin.tolist()
        if np.any(centre):
            table["centre_of_mass"] = centre.tolist()
        matrix = self._turned_in_space(table, mass, centre) if self.spatial else self._turned_in_plane(table, mass)
        if self.chance(0.5):
            table["points"] = {label: self.vector(0.6) for label in self.rng.sample(["P", "Q", "tip", "a1"], 2)}
        self.raw["bodies"][name] = table
        self.poses[name] = Pose(origin, matrix, True, centre)
        return name

    def _turned_in_plane(self, table: dict[str, Any], mass: float) -> Array:
        angle = self.number(-math.pi, math.pi)
        if self.chance(0.1):
            angle, self.features = round(angle + 2 * math.pi * self.rng.randint(-7, 7), 6), self.features | {"turns"}
        table["angle"], table["inertia"] = angle, self.scalar(float(f"{mass * self.positive(0.02, 0.4):.4g}"))
        return np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])

    def _turned_in_space(self, table: dict[str, Any], mass: float, centre: Array) -> Array:
        vector = np.array(self.vector(2.0))
        matrix = turned(vector)
        way = self.rng.randrange(6)
        if way == 0:
            table["orientation"] = {"rotation_vector": vector.tolist()}
        elif way == 1:
            table["orientation"] = {"quaternion": (euler_parameters(matrix) * self.rng.choice([1.0, -2.5])).tolist()}
        elif way == 2:
            convention = self.rng.choice(["zxz", "zyx", "xyz", "yxy"])
            angles = self.vector(3.0)
            matrix = np.eye(3)
            for axis, angle in zip(convention, angles, strict=True):
                matrix = matrix @ turned(angle * np.eye(3)["xyz".index(axis)])
            table["orientation"] = {"euler_angles": angles, "convention": convention}
        elif way == 3:
            table["orientation"] = {
                "x_axis": (2 * matrix[:, 0]).tolist(),
                "y_axis": (matrix[:, 1] + matrix[:, 0]).tolist(),
            }
        elif way == 4:
            start = np.array(self.vector())
            end = (start + 1.5 * matrix[:, 0]).tolist()
            table["orientation"] = {"start": start.tolist(), "end": end, "y_axis": matrix[:, 1].tolist()}
        else:
            matrix = np.eye(3)
        self._tensor(table, mass, centre)
        return matrix

    def _tensor(self, table: dict[str, Any], mass: float, centre: Array) -> None:
        """Write a possible inertia tensor in one of the ways there are."""
        squares = np.array([self.positive(0.02, 0.3) for _ in range(3)])  # of mass along three axes
        moments = [float(f"{mass * (squares.sum() - x):.4g}") for x in squares]
        way = self.rng.randrange(5)
        if way < 2:
            table["inertia"] = moments
        elif way == 2:
            turn = turned(np.array(self.vector()))
            m = turn @ np.diag(moments) @ turn.T
            m = 0.5 * (m + m.T)
            six = [m[0, 0], m[1, 1], m[2, 2], m[0, 1], m[0, 2], m[1, 2]]
            table["inertia"] = m.tolist() if self.chance(0.5) else [float(x) for x in six]
        elif way == 3:
            table["inertia"], table["inertia_axes"] = moments, {"rotation_vector": self.vector()}
        else:
            d = np.array(self.vector(0.4))
            shifted = np.diag(moments) + mass * ((d @ d) * np.eye(3) - np.outer(d, d))
            table["inertia"], table["inertia_at"] = shifted.tolist(), (centre + d).tolist()

    # -- places --------------------------------------------------------------------------------------------------------

    def local(self, body: str, point: Array) -> list[float] | str:
        """Return a point of the ground frame as a point of a body."""
        if body == GROUND:
            return [float(x) for x in point]
        pose = self.poses[body]
        if not pose.rigid:
            return "centre"
        return [float(x) for x in pose.matrix.T @ (point - pose.origin)]

    def inward(self, body: str, vector: Array) -> list[float]:
        """Return a direction of the ground frame in a body's frame."""
        matrix = np.eye(self.dimension) if body == GROUND else self.poses[body].matrix
        return [float(x) for x in matrix.T @ vector]

    def where(self, body: str, point: Any) -> Array:
        """Return where a point of a body is."""
        if body == GROUND:
            return np.array(point, dtype=float)
        pose = self.poses[body]
        if point == "centre":
            return pose.centre_at
        at = self.raw["bodies"][body]["points"][point] if isinstance(point, str) else point
        place: Array = pose.origin + pose.matrix @ np.array(at, dtype=float)
        return place

    def some_point(self, body: str) -> Any:
        """Return a point of a body as a file may write it."""
        if body == GROUND:
            return self.vector(1.5)
        if not self.poses[body].rigid or self.chance(0.15):
            return "centre"
        named = list(self.raw["bodies"][body].get("points", {}))
        return self.rng.choice(named) if named and self.chance(0.5) else self.vector(0.6)

    def near(self, *bodies: str) -> Array:
        """Return a place near bodies; a point mass has but one."""
        for body in bodies:
            if body != GROUND and not self.poses[body].rigid:
                return self.poses[body].origin.copy()
        places = [self.poses[b].centre_at for b in bodies if b != GROUND]
        middle = np.mean(places, axis=0) if places else np.zeros(self.dimension)
        place: Array = middle + np.array(self.vector(0.8))
        return place

    def pick(self, *, rigid: bool = False, ground: bool = True, other: Sequence[str] = ()) -> str | None:
        """Return a body, None where there is none."""
        bodies = [b for b, pose in self.poses.items() if (pose.rigid or not rigid) and b not in other]
        if ground and GROUND not in other:
            bodies.append(GROUND)
        return self.rng.choice(bodies) if bodies else None

    def joint(self, kind: str, **keys: Any) -> str:
        """Add a joint and return its name."""
        name = self.name("j")
        self.raw["joints"][name] = {"type": kind, **keys}
        self.features.add(kind)
        return name

    def place(self, a: str, b: str) -> bool:
        """Report where a point of the second body is."""
        self.joint("place", between=[a, b], at=[self.some_point(a), self.some_point(b)])
        return True

    def rows(self, a: str, b: str) -> bool:
        """Hold a formula of the bodies' coordinates at the value that it has."""
        bodies = [body for body in (a, b) if body != GROUND]
        one, other = bodies[0], bodies[-1]
        k, c = self.number(0.3, 1.5), self.number(-0.8, 0.8)
        (x, y), z = self.poses[one].centre_at[:2], self.poses[other].centre_at[-1]
        last = "xyz"[self.dimension - 1]
        value = float(k * x + y + c * x * z)
        self.joint("rows", rows=[{"position": f"{k!r}*{one}.x + {one}.y + {c!r}*{one}.x*{other}.{last} - {value!r}"}])
        return True

    def coupling(self, a: str, b: str) -> bool:
        """Tie coordinates of joints together as they stand."""
        joints = {n: t for n, t in self.raw["joints"].items() if t["type"] not in ("driver", "place")}
        system = read({**self.raw, "joints": joints, "forces": {}})
        q = np.concatenate([body.start for body in system.bodies.values()])
        choose_turns(system, 0.0, q)
        state = system.at(0.0, q, np.zeros(system.nv))
        known = {f"{j.name}.{n}": float(m(state).value) for j in system.joints for n, m in j.coordinates.items()}
        if len(known) < 2:
            return False
        chosen = self.rng.sample(list(known), 2)
        terms = {name: self.positive(0.3, 1.5) * self.rng.choice([1.0, -1.0]) for name in chosen}
        value, more = sum(factor * known[name] for name, factor in terms.items()), dict[str, Any]()
        slides = [name for name in known if "displacement" in name and name not in chosen]
        if slides:
            of, powers = self.rng.choice(slides), [0.0, self.number(-0.5, 0.5), self.number(-0.5, 0.5)]
            more = {"of": of, "polynomial": powers}
            value -= float(np.polynomial.Polynomial(powers)(known[of]))
        self.joint("coupling", terms=terms, value=value, **more)
        return True

    def force(self, kind: str, **keys: Any) -> str:
        """Add a force and return its name."""
        name = self.name("f")
        self.raw["forces"][name] = {"type": kind, **keys}
        self.features.add(kind)
        return name
