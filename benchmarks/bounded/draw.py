"""Random mechanisms with dry friction, stops and ropes: a mechanism file, and the same numbers for the simulation."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from benchmarks.bounded.rows import Bounded, Measure, angle, height, joint, rope
from benchmarks.bounded.tree import GROUND, Array, Closure, Link, Point, Tree
from benchmarks.plain.turning import euler_parameters, turned

#: Kinds of mechanisms, in the order in which seeds know them.
KINDS = ("chain", "loop", "spatial-chain", "spatial-loop")
_Z = np.array([0.0, 0.0, 1.0])
GRAVITY = 9.81


@dataclass(frozen=True, eq=False)
class Drawn:
    """A random mechanism.

    Attributes
    ----------
    raw : dict
        Tables of a mechanism file.
    tree, rows : Tree, tuple of Bounded
        The same for the simulation.
    u, v : Array
        Its start.
    bodies : dict of str to int
        Numbers of the links that are bodies.
    features : frozenset of str
        What it has.
    """

    raw: dict[str, Any]
    tree: Tree
    rows: tuple[Bounded, ...]
    u: Array
    v: Array
    bodies: dict[str, int]
    features: frozenset[str]


@dataclass
class _Draft:
    """A mechanism being drawn."""

    rng: np.random.Generator
    spatial: bool
    links: list[Link] = field(default_factory=list)
    joints: dict[str, dict[str, Any]] = field(default_factory=dict)
    inertias: dict[str, dict[str, Any]] = field(default_factory=dict)
    rows: list[Bounded] = field(default_factory=list)
    stops: dict[str, dict[str, Any]] = field(default_factory=dict)
    forces: dict[str, dict[str, Any]] = field(default_factory=dict)
    u: list[float] = field(default_factory=list)
    v: list[float] = field(default_factory=list)
    bodies: dict[str, int] = field(default_factory=dict)
    features: set[str] = field(default_factory=set)
    light: bool = False
    share: float = 0.5

    # -- numbers -------------------------------------------------------------------------------------------------------

    def number(self, low: float, high: float) -> float:
        """Return a number of few digits."""
        return round(float(self.rng.uniform(low, high)), 4)

    def chance(self, share: float) -> bool:
        """Return whether something happens."""
        return bool(self.rng.random() < share)

    def vector(self, size: float) -> Array:
        """Return a vector, in the plane where the mechanism is."""
        x = np.array([self.number(-size, size) for _ in range(3)])
        return x if self.spatial else x * [1.0, 1.0, 0.0]

    def plain(self, x: Array) -> list[float]:
        """Return a vector as the file has it."""
        return [float(c) for c in (x if self.spatial else x[:2])]

    # -- bodies and joints ---------------------------------------------------------------------------------------------

    def body(self, parent: int, before: Array, moving: bool, last: bool) -> int:
        """Hang a body on another one and return its number."""
        k = len(self.bodies)
        length = self.number(0.3, 1.0)
        along = self.direction()
        behind = -0.5 * length * along
        mass = self.number(0.4, 2.5)
        slide = self.chance(0.2)
        cylinder = self.spatial and not slide and self.chance(0.15)
        inertia = self._inertia(mass, length, along, slide, last)
        name = f"b{k}"
        axis = self.axis(along)
        start = 0.0 if self.spatial or slide else self.number(-1.2, 1.2)
        frame = np.eye(3)
        if self.spatial:
            frame = turned(self.vector(1.5))
        elif slide:
            frame = turned(_Z * self.number(-1.2, 1.2))
        rate = self.number(-2.0, 2.0) if moving else 0.0
        if slide or cylinder:
            along_axis = axis
            if slide and not self.spatial:
                tilt = self.number(-1.5, 1.5)
                along_axis = np.array([math.cos(tilt), math.sin(tilt), 0.0])
            elif slide:
                along_axis = self.direction()
            self._link(
                parent, True, along_axis, frame, before, np.zeros(3) if cylinder else behind, mass, inertia, slide
            )
            self.u.append(0.0)
            self.v.append(rate if not cylinder or self.chance(0.5) else 0.0)
            axis = along_axis
        if not slide:
            own = len(self.links) - 1 if cylinder else parent
            turn_frame, at = (np.eye(3), np.zeros(3)) if cylinder else (frame, before)
            self._link(own, False, axis, turn_frame, at, behind, mass, inertia, True)
            self.u.append(start)
            self.v.append(rate)
        number = len(self.links) - 1
        self.bodies[name] = number
        self.features.add("slide" if slide else "cylinder" if cylinder else "pin")
        self._described(name, parent, slide, cylinder, axis, frame, before, behind)
        if self.chance(0.25):
            self._push(name, number, mass)
        return number

    def direction(self) -> Array:
        """Return a direction, in the plane along x."""
        if not self.spatial:
            return np.array([1.0, 0.0, 0.0])
        x = self.rng.normal(size=3)
        x = np.round(x / float(np.linalg.norm(x)), 3)
        return np.asarray(x / float(np.linalg.norm(x)))

    def axis(self, along: Array) -> Array:
        """Return the axis of a pin, in space well away from a direction."""
        while self.spatial:
            axis = self.direction()
            if np.linalg.norm(np.cross(axis, along)) > 0.5:
                return axis
        return _Z

    def _inertia(self, mass: float, length: float, along: Array, slide: bool, last: bool) -> Array:
        """Return the tensor of a body; sometimes a point on a rod without inertia."""
        if self.light and self.chance(0.5):
            self.features.add("light")
            return np.zeros((3, 3))
        size = mass * length**2 / 12.0
        if not self.spatial:
            return np.diag([0.0, 0.0, round(size * self.number(0.6, 1.2), 6)])
        return np.diag(
            [round(size * x, 6) for x in (self.number(0.8, 1.0), self.number(0.8, 1.0), self.number(0.8, 1.0))]
        )

    def _link(self, *link: Any) -> None:
        """Append a link, without mass where it is half of a joint."""
        parent, slide, axis, frame, before, behind, mass, inertia, heavy = link
        self.links.append(
            Link(
                parent,
                slide,
                axis,
                frame,
                before,
                behind,
                mass if heavy else 0.0,
                inertia if heavy else np.zeros((3, 3)),
            )
        )

    def _described(
        self,
        name: str,
        parent: int,
        slide: bool,
        cylinder: bool,
        axis: Array,
        frame: Array,
        before: Array,
        behind: Array,
    ) -> None:
        """Write the joint of a body."""
        others = {number: other for other, number in self.bodies.items()}
        between = ["ground" if parent == GROUND else others[parent], name]
        kind = "translational" if slide else "cylindrical" if cylinder else "revolute"
        table: dict[str, Any] = {"type": kind, "between": between, "at": [self.plain(before), self.plain(behind)]}
        carried = frame @ axis
        if self.spatial:
            table["axis"] = [self.plain(carried), self.plain(axis)]
        elif slide:
            table["axis"] = self.plain(carried)
            table["angle"] = float(math.atan2(frame[1, 0], frame[0, 0]))
        self.joints[f"j{len(self.joints)}"] = table

    def _push(self, name: str, number: int, mass: float) -> None:
        """Let a force swing on a body."""
        force = self.vector(mass * GRAVITY * 0.6)
        frequency, phase = self.number(1.0, 8.0), self.number(-1.0, 1.0)
        link = self.links[number]
        fields = {
            key: getattr(link, key)
            for key in ("parent", "slide", "axis", "turned", "before", "behind", "mass", "inertia")
        }
        self.links[number] = Link(**fields, force=force, frequency=frequency, phase=phase)
        texts = [f"{c!r}*sin({frequency!r}*t + {phase!r})" for c in self.plain(force)]
        self.forces[f"f{len(self.forces)}"] = {"type": "force", "body": name, "force": texts}
        self.features.add("push")

    # -- what has bounds -----------------------------------------------------------------------------------------------

    def bounded(self, name: str, of: Measure, value: float, rate: float, load: float, slide: bool) -> dict[str, Any]:
        """Give a coordinate friction, stops or both, and return what the file says of it."""
        keys: dict[str, Any] = {}
        numbers: dict[str, Any] = {}
        if self.chance(self.share):
            sliding = float(f"{load * 10 ** self.rng.uniform(-1.3, 0.3):.4g}")
            static = float(f"{sliding * float(self.rng.choice([1.0, 1.0, 1.3])):.6g}")
            keys["friction"] = {"sliding": sliding, "static": static}
            numbers |= {"sliding": sliding, "static": static}
            if self.chance(0.15):
                keys["friction"]["viscous"] = numbers["viscous"] = float(f"{0.05 * load:.4g}")
        if self.chance(self.share):
            stop: dict[str, Any] = {"restitution": float(self.rng.choice([0.0, 0.0, 0.3, 0.5, 0.8, 1.0]))}
            size = 0.4 if slide else 1.0
            if self.chance(0.8):
                stop["lower"] = (
                    value if rate >= 0.0 and self.chance(0.15) else round(value - size * self.number(0.1, 1.2), 4)
                )
            if "lower" not in stop or self.chance(0.7):
                stop["upper"] = round(value + size * self.number(0.1, 1.2), 4)
            keys["stop"] = stop
            numbers |= stop
            if stop.get("lower") == value:
                self.features.add("starts at a stop")
            self.features.add(
                "e = 1" if stop["restitution"] == 1.0 else "e = 0" if stop["restitution"] == 0.0 else "0 < e < 1"
            )
        self.features |= {key for key in ("friction", "stop") if key in keys}
        if len(keys) == 2:
            self.features.add("both on one joint")
        if keys:
            self.rows.append(Bounded(name, of, **numbers))
        return keys


def drawn(kind: str, seed: int) -> Drawn:
    """Return a random mechanism; the same for the same seed."""
    rng = np.random.default_rng([KINDS.index(kind), seed])
    draft = _Draft(rng, kind.startswith("spatial"))
    loop = kind.endswith("loop")
    moving, draft.light, draft.share = draft.chance(0.75), draft.chance(0.3), 0.9 if draft.chance(0.4) else 0.5
    count = int(rng.integers(3, 5)) if loop and not draft.spatial else int(rng.integers(1, 5))
    if loop and draft.spatial:
        count = int(rng.integers(2, 5))
    if draft.spatial and not loop:
        count = int(rng.integers(1, 4))
    parent, before = GROUND, np.zeros(3)
    for k in range(count):
        parent = draft.body(parent, before, moving, k == count - 1)
        before = -draft.links[parent].behind
        if draft.links[parent].behind @ draft.links[parent].behind == 0.0:
            before = 0.5 * draft.direction()
    return _finished(draft, kind, seed, loop)


def _finished(draft: _Draft, kind: str, seed: int, loop: bool) -> Drawn:
    """Return what was drawn with loops closed, bounds and ropes, as a file and as numbers."""
    u, v = np.array(draft.u), np.array(draft.v)
    gravity = np.array([0.0, 0.0, -GRAVITY] if draft.spatial else [0.0, -GRAVITY, 0.0])
    tree = Tree(draft.links, [], gravity)
    closures, pin = _closures(draft, tree, u) if loop else ([], None)
    tree = Tree(draft.links, closures, gravity)
    state = tree.at(0.0, u, v)
    if closures:
        slopes = tree.closed(state)[1]
        v = v - np.linalg.pinv(slopes) @ (slopes @ v)
        state = tree.at(0.0, u, v)
    load = 0.4 * GRAVITY * sum(link.mass for link in draft.links) / 2.0
    _bound_joints(draft, u, v, load, loop)
    if pin is not None:
        pin |= draft.bounded("c", *_closing_angle(draft, u, v), load, False)
        draft.joints["c"] = pin
    if draft.chance(0.3) or not draft.rows:
        _rope(draft, tree, u, v)
    raw = _described(draft, tree, u, v, f"{kind} {seed}")
    return Drawn(raw, tree, tuple(draft.rows), u, v, dict(draft.bodies), frozenset(draft.features))


def _bound_joints(draft: _Draft, u: Array, v: Array, load: float, loop: bool) -> None:
    """Draw the bounds of the joints of the tree."""
    k = 0
    for name, table in draft.joints.items():
        kind = table["type"]
        labels = {"revolute": [""], "translational": [""], "cylindrical": ["displacement", "angle"]}.get(kind, [])
        for label in labels:
            slide = draft.links[k].slide
            if not draft.chance(0.15):
                full = f"{name}.{label}" if label else name
                keys = draft.bounded(full, joint(k), float(u[k]), float(v[k]), load if not slide else 3.0 * load, slide)
                for key, content in keys.items():
                    if label:
                        table.setdefault(key, {})[label] = content
                    else:
                        table[key] = content
            k += 1


def _closing_angle(draft: _Draft, u: Array, v: Array) -> tuple[Measure, float, float]:
    """Return the angle of the pin that joins the last body to the ground, its value and its rate."""
    factors = {k: 1.0 for k, link in enumerate(draft.links) if not link.slide}
    offset = sum(math.atan2(link.turned[1, 0], link.turned[0, 0]) for link in draft.links)
    measured = sum(float(u[k]) for k in factors) + offset
    return angle(factors, offset), measured, sum(float(v[k]) for k in factors)


def _closures(draft: _Draft, tree: Tree, u: Array) -> tuple[list[Closure], dict[str, Any] | None]:
    """Close a loop from the last body to the ground, as it stands."""
    name, last = list(draft.bodies.items())[-1]
    tip = Point(last, -draft.links[last].behind)
    at = tree.at(0.0, u, np.zeros(tree.n)).point(tip).value
    ends = [draft.plain(at), draft.plain(tip.at)]
    if not draft.spatial and draft.chance(0.7):
        draft.features.add("closing pin")
        return [Closure(tip, Point(GROUND, at), (0, 1))], {"type": "revolute", "between": ["ground", name], "at": ends}
    if draft.spatial and tree.n >= 4 and draft.chance(0.7):
        draft.features.add("closing ball")
        draft.joints["c"] = {"type": "spherical", "between": ["ground", name], "at": ends}
        return [Closure(tip, Point(GROUND, at))], None
    away = draft.vector(0.7)
    foot = at + away
    length = float(np.linalg.norm(foot - at))
    draft.features.add("closing rod")
    table = {
        "type": "distance",
        "between": ["ground", name],
        "at": [draft.plain(foot), draft.plain(tip.at)],
        "length": length,
    }
    draft.joints["c"] = table
    return [Closure(tip, Point(GROUND, foot), length=length)], None


def _rope(draft: _Draft, tree: Tree, u: Array, v: Array) -> None:
    """Hang a body on a rope, or lay a floor below it."""
    state = tree.at(0.0, u, v)
    name, number = list(draft.bodies.items())[int(draft.rng.integers(len(draft.bodies)))]
    centre = Point(number, np.zeros(3))
    at = state.point(centre).value
    e = float(draft.rng.choice([0.0, 0.3, 0.7, 1.0]))
    axes = ("x", "y", "z") if draft.spatial else ("x", "y")
    if draft.chance(0.5):
        hook = np.round(at + draft.vector(0.8), 4)
        length = round(float(np.linalg.norm(hook - at)) + draft.number(0.02, 0.6), 4)
        growth = -draft.number(0.1, 0.4) if draft.chance(0.2) else 0.0
        squares = " + ".join(f"({name}.{a} - {float(h)!r})**2" for a, h in zip(axes, hook, strict=False))
        moving = f" + {growth!r}*t" if growth else ""
        gap = f"{length!r}{moving} - sqrt({squares})"
        draft.rows.append(Bounded("rope", rope(Point(GROUND, hook), centre, length, growth), lower=0.0, restitution=e))
        draft.stops["rope"] = {"gap": gap, "restitution": e}
        draft.features |= {"rope", *(["winch"] if growth else [])}
        return
    up = np.eye(3)[2 if draft.spatial else 1]
    level = round(float(up @ at) - draft.number(0.05, 0.5), 4)
    rising = draft.number(0.05, 0.3) if draft.chance(0.2) else 0.0
    draft.rows.append(Bounded("floor", height(centre, up, level, rising), lower=0.0, restitution=e))
    moving = f" - {rising!r}*t" if rising else ""
    draft.stops["floor"] = {"gap": f"{name}.{axes[-1]} - {level!r}{moving}".replace("- -", "+ "), "restitution": e}
    draft.features |= {"floor", *(["rising floor"] if rising else [])}


def _described(draft: _Draft, tree: Tree, u: Array, v: Array, title: str) -> dict[str, Any]:
    """Return the mechanism file."""
    state = tree.at(0.0, u, v)
    gravity = draft.plain(tree.gravity)
    bodies = {}
    for name, k in draft.bodies.items():
        link = draft.links[k]
        table: dict[str, Any] = {"mass": link.mass, "position": draft.plain(state.places[k])}
        table["velocity"] = draft.plain(state.slopes[k] @ v)
        if draft.spatial:
            table["inertia"] = [float(x) for x in np.diag(link.inertia)]
            table["orientation"] = {"quaternion": [float(x) for x in euler_parameters(state.turns[k])]}
            table["angular_velocity"] = [float(x) for x in state.turns[k].T @ state.spins[k]]
        else:
            table["inertia"] = float(link.inertia[2, 2])
            table["angle"] = planar_angle(tree, k, u)
            table["angular_velocity"] = float(state.spins[k][2])
        bodies[name] = table
    head = {"name": title.replace(" ", "-"), "gravity": gravity}
    if draft.spatial:
        head["space"] = "spatial"
    raw: dict[str, Any] = {"mechanism": head, "bodies": bodies, "joints": draft.joints}
    if draft.forces:
        raw["forces"] = draft.forces
    if draft.stops:
        raw["stops"] = draft.stops
    return raw


def planar_angle(tree: Tree, k: int, u: Array) -> float:
    """Return the angle of a body in the plane, turns counted."""
    total = 0.0
    while k != GROUND:
        link = tree.links[k]
        total += math.atan2(link.turned[1, 0], link.turned[0, 0]) + (0.0 if link.slide else float(u[k]))
        k = link.parent
    return total
