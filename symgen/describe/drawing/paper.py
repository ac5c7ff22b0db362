"""A scene in positions, seen from somewhere: lines, areas and circles on paper, from the back to the front."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from symgen.describe.drawing.scene import (
    INK,
    PAPER,
    Array,
    DrawnCircle,
    Item,
    Line,
    Look,
    Mark,
    Poses,
    Scene,
    Solid,
    Stretch,
    Tube,
)


@dataclass(frozen=True)
class View:
    """View of a scene in space: turn about the vertical, and elevation above the horizontal [rad]."""

    turn: float = 0.6
    tilt: float = 0.42


@dataclass(frozen=True)
class Path:
    """A line or an area on paper.

    Attributes
    ----------
    points : Array, shape (k, 2)
        Corners [m].
    closed : bool
        Whether it is an area.
    """

    points: Array
    look: Look
    closed: bool


@dataclass(frozen=True)
class Circle:
    """A circle on paper [m]."""

    x: float
    y: float
    radius: float
    look: Look


@dataclass(frozen=True)
class Drawn:
    """An item on paper.

    Attributes
    ----------
    item : Item
        Of the scene.
    parts : tuple of Path or Circle
        From the back to the front.
    depth : float
        Depth of its farthest point, so that a small item inside a large one is drawn after it [m].
    label : (float, float) or None
        Place of its name.
    """

    item: Item
    parts: tuple[Path | Circle, ...]
    depth: float
    label: tuple[float, float] | None


def items_on_paper(scene: Scene, q: Array, view: View | None = None, bodies: bool = False) -> list[Drawn]:
    """Return a scene's items on paper in the order in which they are drawn.

    Parameters
    ----------
    scene : Scene
        What is drawn.
    q : Array, shape (nq,)
        Where it is.
    view : View, optional
        From where it is seen, where it is spatial.
    bodies : bool
        Whether bodies alone are drawn, bars in space as lines, as for pictures behind another.
    """
    eye = view_axes(scene, view or View())
    poses = scene.poses(q)
    items = [_bars_as_lines(item) for item in scene.items if item.role == "body"] if bodies else scene.items
    drawn = [_draw_item(item, poses, eye) for item in items]
    if scene.spatial:  # faults stay in front
        drawn.sort(key=lambda d: (d.item.role == "fault", d.depth))
    return drawn


def _bars_as_lines(item: Item) -> Item:
    """Return an item with its bars as lines, and without its centre of mass."""
    marks: list[Mark] = []
    for mark in item.marks:
        if isinstance(mark, Tube):
            marks.append(Line(mark.body, (mark.a, mark.b), replace(mark.look, width=3.0)))
        elif not (isinstance(mark, DrawnCircle) and mark.mass):
            marks.append(mark)
    return replace(item, marks=tuple(marks))


def view_axes(scene: Scene, view: View) -> Array:
    """Return the directions to the right, upwards and towards the eye, shape (3, 3)."""
    if not scene.spatial:
        return np.eye(3)
    up = np.array(scene.up)
    right = np.cross(up, np.roll(up, 1))
    depth = np.cross(right, up)
    side = np.cos(view.turn) * right + np.sin(view.turn) * depth
    forward = -np.sin(view.turn) * right + np.cos(view.turn) * depth
    upward = np.cos(view.tilt) * up - np.sin(view.tilt) * forward  # forward is towards the eye: near points sink
    return np.stack([side, upward, np.cross(side, upward)])


def _draw_item(item: Item, poses: Poses, eye: Array) -> Drawn:
    parts: list[Path | Circle] = []
    depths: list[float] = []
    for mark in item.marks:
        for points, part in _parts_of_mark(mark, poses, eye):
            depths.append(float(points[:, 2].min()))
            parts.append(part)
    label = None
    if item.label is not None:
        x, y, _ = eye @ poses.to_ground(item.label[0], [item.label[1]])[0]
        label = float(x), float(y)
    return Drawn(item, tuple(parts), min(depths, default=0.0), label)


def _parts_of_mark(mark: Mark, poses: Poses, eye: Array) -> Iterator[tuple[Array, Path | Circle]]:
    """Yield the parts of a mark with its points as the eye has them."""
    if isinstance(mark, Line):
        projected = poses.to_ground(mark.body, mark.points) @ eye.T
        yield projected, Path(projected[:, :2], mark.look, mark.closed)
    elif isinstance(mark, DrawnCircle):
        projected = poses.to_ground(mark.body, [mark.at]) @ eye.T
        x, y = float(projected[0, 0]), float(projected[0, 1])
        if not mark.mass:
            yield projected, Circle(x, y, mark.radius, mark.look)
            return
        yield projected, Circle(x, y, mark.radius, replace(mark.look, fill=PAPER))
        for start in (0.0, np.pi):
            turn = start + np.linspace(0.0, 0.5 * np.pi, 6)
            rim = np.stack([np.cos(turn), np.sin(turn)], axis=1)
            quarter = np.array([x, y]) + mark.radius * np.vstack([[0.0, 0.0], rim])
            yield projected, Path(quarter, Look(INK, INK, 0.1), True)
    elif isinstance(mark, Tube):
        yield from _outline_of_tube(mark, poses, eye)
    elif isinstance(mark, Solid):
        faces = [poses.to_ground(mark.body, face) @ eye.T for face in mark.faces]
        if not mark.convex:
            faces.sort(key=lambda face: float(face[:, 2].mean()))
        for projected in faces:
            normal = np.cross(projected[1] - projected[0], projected[2] - projected[1])
            if normal[2] > 0.0:
                light = 0.75 + 0.25 * float(normal[1]) / (float(np.linalg.norm(normal)) or 1.0)
                yield projected, Path(projected[:, :2], replace(mark.look, opacity=mark.look.opacity * light), True)
    else:
        ends = np.array([poses.to_ground(mark.body, [mark.at])[0], poses.to_ground(mark.other, [mark.to])[0]]) @ eye.T
        for path in _draw_stretched_mark(mark, ends[:, :2]):
            yield ends, path


def _outline_of_tube(mark: Tube, poses: Poses, eye: Array) -> Iterator[tuple[Array, Path]]:
    """Yield the outline of a round bar, and its visible end."""
    a, b = poses.to_ground(mark.body, [mark.a, mark.b]) @ eye.T
    if a[2] > b[2]:
        a, b = b, a
    way = b - a
    length, flat = float(np.linalg.norm(way)) or 1.0, float(np.hypot(way[0], way[1]))
    along = way[:2] / flat if flat > 1e-9 * length else np.array([1.0, 0.0])
    side, squeeze = np.array([-along[1], along[0]]), abs(way[2]) / length
    turn = np.linspace(0.0, 2.0 * np.pi, 25)[:-1]
    ring = mark.radius * (np.cos(turn)[:, None] * side + squeeze * np.sin(turn)[:, None] * along)
    back = mark.radius * (
        np.cos(turn[:13])[:, None] * side - squeeze * np.sin(turn[:13])[:, None] * along
    )  # the far half of the far end, then the near end's outer half
    front = mark.radius * (np.cos(turn[:13])[::-1, None] * side + squeeze * np.sin(turn[:13])[::-1, None] * along)
    both = np.stack([a, b])
    yield both, Path(np.vstack([a[:2] + back, b[:2] + front]), mark.look, True)
    if squeeze > 0.05:
        yield both, Path(b[:2] + ring, mark.look, True)


def _draw_stretched_mark(mark: Stretch, ends: Array) -> Iterator[Path]:
    """Yield a spring as a zigzag, a damper as a pot, a rod as a line, from one end to the other."""
    way = ends[1] - ends[0]
    length = float(np.hypot(*way))
    along = way / length if length else np.array([1.0, 0.0])
    side, u = np.array([-along[1], along[0]]), mark.size

    def path_beside_line(*points: tuple[float, float], closed: bool = False, look: Look = mark.look) -> Path:
        return Path(np.array([ends[0] + s * along + n * u * side for s, n in points]), look, closed)

    if mark.kind in ("rod", "gap") or not length:
        yield path_beside_line((0.0, 0.0), (length, 0.0))
        return
    aside = 0.75 if mark.kind == "spring-damper" else 0.0
    start, end = 0.18 * length, 0.82 * length
    if "spring" in mark.kind:
        teeth = 12
        step = (end - start) / teeth
        zigzag = [(start + (k + 0.5) * step, aside + (0.55 if k % 2 else -0.55)) for k in range(teeth)]
        yield path_beside_line(
            (0.0, 0.0),
            *([(start, 0.0), (start, aside)] if aside else [(start, 0.0)]),
            *zigzag,
            *([(end, aside), (end, 0.0)] if aside else [(end, 0.0)]),
            (length, 0.0),
        )
    if "damper" in mark.kind or mark.kind == "actuator":
        n = -aside
        left, right = 0.4 * length, 0.62 * length
        yield path_beside_line(*([(start, 0.0)] if aside else [(0.0, 0.0)]), (start, n), (0.52 * length, n))
        fill = replace(mark.look, fill="#dfe4ea") if mark.kind == "actuator" else mark.look
        yield path_beside_line(
            (left, n - 0.45),
            (right, n - 0.45),
            (right, n + 0.45),
            (left, n + 0.45),
            closed=mark.kind == "actuator",
            look=fill,
        )
        if mark.kind != "actuator":
            yield path_beside_line((0.52 * length, n - 0.36), (0.52 * length, n + 0.36))
        yield path_beside_line((right, n), (end, n), *([(end, 0.0)] if aside else [(length, 0.0)]))
