"""The default view of a scene in space, in which every body can be recognised."""

from __future__ import annotations

from dataclasses import replace
from itertools import product, starmap

import numpy as np

from symgen.describe.drawing.paper import Circle, Path, View, items_on_paper, view_axes
from symgen.describe.drawing.scene import Array, DrawnCircle, Line, Mark, Poses, Scene, Solid, Tube

#: The usual view, and the smallest share of a body in it (see `_least_visible_share`).
USUAL, ENOUGH = View(), 0.95
#: Turns and tilts of the views to choose from [rad].
TURNS = (0.6, 0.9, 0.3, 1.2, 0.0, -0.3, -0.6, -0.9, -1.2, 1.57)
TILTS = (0.42, 0.62, 0.22)
#: Points along a bar, and of all bodies.
ALONG, MOST = 24, 300


def choose_viewpoint(scene: Scene, q: Array) -> View:
    """Return the usual view where it shows enough of every body, or else the one with the largest least share.

    Parameters
    ----------
    scene : Scene
        What is drawn; in the plane there is one view.
    q : Array, shape (nq,)
        Coordinates of all bodies.
    """
    if not scene.spatial:
        return USUAL
    scene = replace(scene, items=tuple(replace(x, marks=tuple(map(_box_around_mesh, x.marks))) for x in scene.items))
    poses, clouds = scene.poses(q), dict[str, Array]()
    for item in scene.items:
        points = [p for mark in item.marks for p in _points_on_mark(mark, poses)] if item.role == "body" else []
        if points:
            clouds[item.name] = np.concatenate(points)
    every = max(1, sum(map(len, clouds.values())) // MOST)
    clouds = {name: cloud[::every] for name, cloud in clouds.items()}
    bodies = replace(scene, items=tuple(x for x in scene.items if x.role == "body" and x.name in clouds))

    def rounded_least_share(view: View) -> float:
        return round(_least_visible_share(bodies, q, clouds, view), 9)  # views that differ by rounding are alike

    return (
        USUAL
        if rounded_least_share(USUAL) >= ENOUGH
        else max(starmap(View, product(TURNS, TILTS)), key=rounded_least_share)
    )


def _box_around_mesh(mark: Mark) -> Mark:
    """Return a mesh as the box around it, which is seen from the same sides; another mark as it is."""
    if not isinstance(mark, Solid) or mark.convex:
        return mark
    points = np.array(mark.faces).reshape(-1, 3)
    low, high = points.min(axis=0), points.max(axis=0)
    faces = []
    for k in range(3):
        for end in (low, high):
            turn = ((0, 0), (1, 0), (1, 1), (0, 1))[:: 1 if end is high else -1]
            face = np.tile(end, (4, 1))
            for axis, way in zip(((k + 1) % 3, (k + 2) % 3), zip(*turn, strict=True), strict=True):
                face[:, axis] = np.where(way, high[axis], low[axis])
            faces.append(tuple((float(x), float(y), float(z)) for x, y, z in face))
    return Solid(mark.body, tuple(faces), mark.look)


def _points_on_mark(mark: Mark, poses: Poses) -> list[Array]:
    """Return points all over a mark in the ground frame; for a bar, points along its axis."""
    if isinstance(mark, Tube):
        share = np.linspace(0.0, 1.0, ALONG)[:, None]
        return [poses.to_ground(mark.body, (1.0 - share) * np.array(mark.a) + share * np.array(mark.b))]
    if isinstance(mark, Line):
        return [poses.to_ground(mark.body, mark.points)]
    if isinstance(mark, Solid):
        return [poses.to_ground(mark.body, face) for face in mark.faces]
    return [poses.to_ground(mark.body, [mark.at])] if isinstance(mark, DrawnCircle) and not mark.mass else []


def _least_visible_share(bodies: Scene, q: Array, clouds: dict[str, Array], view: View) -> float:
    """Return the visible share of the body that is shown least.

    That is the visible share of its points, areas in front of a point counting with their opacity, or twice the ratio
    of its length on paper to its length in space where that is less.
    """
    eye, drawn = view_axes(bodies, view)[:2], items_on_paper(bodies, q, view)
    own = [clouds[each.item.name] for each in drawn]
    ends = np.cumsum([0, *map(len, own)])
    points = np.concatenate([np.zeros((0, 2)), *(cloud @ eye.T for cloud in own)])
    clear = np.ones(len(points))
    for end, each in zip(ends, drawn, strict=False):
        for part in each.parts:
            clear[:end][_points_in_area(part, points[:end])] *= 1.0 - part.look.opacity
    least = 1.0
    for cloud, start, end in zip(own, ends[:-1], ends[1:], strict=True):
        whole, beside = (float(np.linalg.norm(np.ptp(x, axis=0))) for x in (cloud, points[start:end]))
        least = min(least, float(clear[start:end].mean()), 2.0 * beside / whole if whole else 1.0)
    return least


def _points_in_area(part: Path | Circle, points: Array) -> Array:
    """Return which points the area of a part covers, shape (k,)."""
    if isinstance(part, Circle):
        return np.asarray(np.hypot(points[:, 0] - part.x, points[:, 1] - part.y) < part.radius)
    if not (part.closed and part.look.fill):
        return np.zeros(len(points), dtype=bool)
    inside = np.all((points > part.points.min(axis=0)) & (points < part.points.max(axis=0)), axis=1)
    (x, y), (ax, ay), (bx, by) = points[inside].T[:, :, None], part.points.T, np.roll(part.points, -1, axis=0).T
    passed = (ay > y) != (by > y)  # edges that a ray from the point to the right may cross
    beyond = ((bx - ax) * (y - ay) - (x - ax) * (by - ay)) * np.sign(by - ay) > 0.0
    inside[inside] = np.sum(passed & beyond, axis=1) % 2 == 1
    return np.asarray(inside)
