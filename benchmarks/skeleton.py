"""The picture of a mechanism in motion: its bodies as lines through their joints, at a few times, and where they go."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from symgen.describe.evaluate import evaluate
from symgen.describe.mechanism import Mechanism, SpatialBody
from symgen.report.picture import COLOURS, GREY, drawn
from symgen.vocabulary.measures import GROUND, Distance, LinkStretch, Marker, RimHeight

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from symgen.report.document import Picture
    from symgen.result.result import Result

Array = NDArray[np.float64]

#: From where a spatial mechanism is seen: turned about the vertical, then tilted [rad].
TURN, TILT = 0.6, 0.42
#: How many times are drawn, the first one darkest.
POSES = 4
#: Points of a body's path that are drawn.
PATH = 400


def picture(mechanism: Mechanism, result: Result, name: str, window: float) -> Picture:
    """Draw a mechanism.

    Parameters
    ----------
    mechanism : Mechanism
        What moves.
    result : Result
        A run of it.
    name : str
        Of the picture.
    window : float
        Time from the first pose to the last [s]; paths are drawn as long.
    """
    scene = _Scene(mechanism, result)
    last = int(np.searchsorted(result.t, window * (1.0 + 1e-9))) - 1
    poses = np.unique(np.linspace(0, last, POSES).round().astype(int))
    times = ", ".join(f"{result.t[k]:.3g}" for k in poses)

    def draw(figure: Figure) -> None:
        ax = figure.subplots()
        for k, colour in zip(range(len(scene.bodies)), _colours(), strict=False):
            path = scene.flat(scene.centres(k)[: last + 1][:: max(1, last // PATH)])
            ax.plot(*path.T, color=colour, linewidth=0.7, alpha=0.7)
        for shade, k in enumerate(reversed(poses)):
            _pose(ax, scene, int(k), 0.25 + 0.75 * (shade / max(1, len(poses) - 1)) ** 2)
        ax.set_aspect("equal", adjustable="datalim")
        ax.axis("off")
        ax.margins(0.06)

    caption = (
        f"`{mechanism.name}` at {times} s, the start darkest; thin lines: paths of the centres of mass until then."
    )
    return drawn(name, caption, f"{mechanism.title}, drawn at {len(poses)} times.", draw, height=3.2)


def _colours() -> Iterator[str]:
    while True:
        yield from COLOURS


def _pose(ax: Any, scene: _Scene, k: int, alpha: float) -> None:
    for (body, markers), colour in zip(scene.bodies.items(), _colours(), strict=False):
        at = scene.flat(np.array([scene.place(body, m, k) for m in markers]))
        closed = len(at) > 3
        if len(at) > 2:
            at = at[_around(at)]
            ax.fill(*at.T, color=colour, alpha=0.12 * alpha, linewidth=0.0)
        line = np.vstack([at, at[:1]]) if closed or len(at) == 3 else at
        ax.plot(*line.T, "-o", color=colour, alpha=alpha, linewidth=2.0, markersize=3.5)
    for a, b in scene.links:
        ends = scene.flat(np.array([scene.anywhere(a, k), scene.anywhere(b, k)]))
        ax.plot(*ends.T, "--", color=GREY, alpha=alpha, linewidth=1.0)
    for body, centre, ring in scene.rims:
        at = scene.flat(np.array([scene.place(body, tuple(centre + r), k) for r in ring]))
        ax.plot(*at.T, color=COLOURS[0], alpha=alpha, linewidth=1.2)
    if scene.ground:
        ax.plot(*scene.flat(np.array(scene.ground)).T, "^", color="black", markersize=6.0, linestyle="none")


def _around(points: Array) -> NDArray[np.intp]:
    """Return the order of points around their middle, so that their outline does not cross itself."""
    away = points - points.mean(axis=0)
    return np.argsort(np.arctan2(away[:, 1], away[:, 0]))


class _Scene:
    """What is drawn of a mechanism, and where it is at the outputs of a run."""

    def __init__(self, mechanism: Mechanism, result: Result) -> None:
        self.values = result.parameters
        self.spatial = mechanism.space == "spatial"
        self.result = result
        self.up = _upwards([evaluate(g, self.values) for g in mechanism.gravity])
        self.centre = {b.name: self._numbers(b.centre_of_mass) for b in mechanism.bodies}
        self.point = {b.name: b.is_point for b in mechanism.bodies}
        dimension = 3 if self.spatial else 2
        found: dict[str, list[tuple[float, ...]]] = {b.name: [] for b in mechanism.bodies}
        grounded: dict[tuple[float, ...], None] = {}
        self.links: list[tuple[Marker, Marker]] = []
        self.rims: list[tuple[str, Array, Array]] = []
        for joint in mechanism.joints:
            for part in _parts(joint.rows):
                if isinstance(part, LinkStretch | Distance):
                    self.links.append((part.a, part.b))
                if isinstance(part, RimHeight):
                    axis = np.array(self._numbers(part.axis.vector))
                    ring = evaluate(part.radius, self.values) * _circle(axis)
                    self.rims.append((part.axis.body, np.array(self._numbers(part.centre.point)), ring))
                if isinstance(part, Marker) and part.body != GROUND:
                    found[part.body].append(tuple(self._numbers(part.point)))
                elif isinstance(part, Marker):
                    grounded[tuple(self._numbers(part.point))] = None
        self.ground = [point[:dimension] for point in grounded]
        self.bodies: dict[str, list[tuple[float, ...]]] = {}
        for body in mechanism.bodies:
            points = [*found[body.name], *(tuple(self._numbers(p)) for _, p in body.points)]
            own = list(dict.fromkeys(tuple(round(x, 12) for x in p) for p in points))
            few = len(own) < 2  # a line needs two ends
            self.bodies[body.name] = [*own, *([tuple(self.centre[body.name])] if few else [])]
            if isinstance(body, SpatialBody) and body.is_point:
                self.bodies[body.name] = [(0.0, 0.0, 0.0)]

    def _numbers(self, point: Sequence[Any]) -> list[float]:
        return [evaluate(e, self.values) for e in point]

    def centres(self, index: int) -> Array:
        """Return the path of a body's centre of mass, shape (k, 2) or (k, 3)."""
        name = list(self.bodies)[index]
        axes = "xyz" if self.spatial else "xy"
        return np.stack([self.result.q[f"{name}.{axis}"] for axis in axes], axis=1)

    def anywhere(self, marker: Marker, k: int) -> Array:
        """Return where a marker is at output k."""
        point = tuple(self._numbers(marker.point))
        return np.array(point) if marker.body == GROUND else self.place(marker.body, point, k)

    def place(self, body: str, point: tuple[float, ...], k: int) -> Array:
        """Return where a point of a body, in its frame, is at output k."""
        q = {name: self.result.q[f"{body}.{name}"][k] for name in ("xyz" if self.spatial else "xy")}
        centre: Array = np.array(list(q.values()), dtype=np.float64)
        if self.point[body]:
            return centre
        away = np.array(point) - np.array(self.centre[body])
        if not self.spatial:
            c, s = np.cos(self.result.q[f"{body}.theta"][k]), np.sin(self.result.q[f"{body}.theta"][k])
            return np.asarray(centre + np.array([c * away[0] - s * away[1], s * away[0] + c * away[1]]))
        e0, *rest = (self.result.q[f"{body}.e{i}"][k] for i in range(4))
        e = np.array(rest)
        turned = away + 2.0 * np.cross(e, np.cross(e, away) + e0 * away)
        return np.asarray(centre + turned)

    def flat(self, points: Array) -> Array:
        """Return points as they are seen on paper, shape (k, 2)."""
        if not self.spatial:
            return points
        right = np.cross(self.up, np.roll(self.up, 1))
        depth = np.cross(right, self.up)
        side = np.cos(TURN) * right + np.sin(TURN) * depth
        forward = -np.sin(TURN) * right + np.cos(TURN) * depth
        return np.asarray(points @ np.stack([side, np.cos(TILT) * self.up + np.sin(TILT) * forward], axis=1))


def _circle(axis: Array) -> Array:
    """Return points of the circle of radius 1 about an axis, shape (49, 3)."""
    across = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
    across /= np.linalg.norm(across)
    turn = np.linspace(0.0, 2.0 * np.pi, 49)[:, None]
    return np.asarray(np.cos(turn) * across + np.sin(turn) * np.cross(axis / np.linalg.norm(axis), across))


def _upwards(gravity: Sequence[float]) -> Array:
    """Return the axis that points against gravity, z where there is none."""
    if len(gravity) < 3 or not any(gravity):
        return np.array([0.0, 0.0, 1.0])
    up = np.zeros(3)
    k = int(np.argmax(np.abs(gravity)))
    up[k] = -np.sign(gravity[k])
    return up


def _parts(value: Any) -> Iterator[Any]:
    """Yield a value and everything inside it."""
    yield value
    if isinstance(value, msgspec.Struct):
        for field in msgspec.structs.fields(value):
            yield from _parts(getattr(value, field.name))
    elif isinstance(value, tuple):
        for item in value:
            yield from _parts(item)
