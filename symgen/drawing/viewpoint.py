"""From where a scene in space is seen unless a view is set: from where no body hides another one."""

from __future__ import annotations

from itertools import product

import numpy as np

from symgen.drawing.paper import View, axes
from symgen.drawing.scene import Array, Disc, Line, Mark, Poses, Scene, Solid, Tube

#: The usual view, and how much each body has to be seen beside all others, as a part of what there is of it.
USUAL, ENOUGH = View(), 0.4
#: Further turns and tilts in the order in which they are tried [rad].
TURNS = (0.6, 0.9, 0.3, 1.2, 0.0, -0.3, -0.6, -0.9, -1.2, 1.57)
TILTS = (0.42, 0.62, 0.22)
#: How far bodies are apart in a picture where none hides the other, in units; points along a bar, and of all bodies.
APART, ALONG, MOST = 2.0, 24, 300


def viewpoint(scene: Scene, q: Array) -> View:
    """Return the first view in which every body is seen for the most part, or else that in which most of each is.

    Parameters
    ----------
    scene : Scene
        What is drawn; in the plane there is one view.
    q : Array, shape (nq,)
        Where it is.
    """
    if not scene.spatial:
        return USUAL
    poses, clouds = scene.poses(q), list[Array]()
    for item in scene.items:
        points = [p for mark in item.marks for p in _points(mark, poses)] if item.role == "body" else []
        if points:
            clouds.append(np.concatenate(points))
    every = max(1, sum(map(len, clouds)) // MOST)
    clouds = [cloud[::every] for cloud in clouds]
    best, view = -1.0, USUAL
    for tilt, turn in product(TILTS, TURNS):
        candidate = View(turn, tilt)
        least = _least_seen(clouds, axes(scene, candidate), APART * scene.unit)
        if least > best + 1e-9:
            best, view = least, candidate
        if best >= ENOUGH:
            break
    return view


def _points(mark: Mark, poses: Poses) -> list[Array]:
    """Return points all over a mark in the ground frame; those of a bar are along its axis."""
    if isinstance(mark, Tube):
        share = np.linspace(0.0, 1.0, ALONG)[:, None]
        return [poses.out(mark.body, (1.0 - share) * np.array(mark.a) + share * np.array(mark.b))]
    if isinstance(mark, Line):
        return [poses.out(mark.body, mark.points)]
    if isinstance(mark, Solid):
        return [poses.out(mark.body, face) for face in mark.faces]
    return [poses.out(mark.body, [mark.at])] if isinstance(mark, Disc) and not mark.mass else []


def _least_seen(clouds: list[Array], eye: Array, apart: float) -> float:
    """Return the part of the body that is seen least: how much of it is clear of all others, and how long it looks."""
    flat = [cloud @ eye[:2].T for cloud in clouds]
    owner = np.concatenate([np.full(len(cloud), k) for k, cloud in enumerate(clouds)] or [np.zeros(0)])
    everyone = np.concatenate(flat or [np.zeros((0, 2))])
    parts = [1.0]
    for k, own in enumerate(flat):
        others = everyone[owner != k]
        away = np.hypot(*(own[:, None] - others[None]).transpose(2, 0, 1)).min(axis=1, initial=np.inf)
        whole, seen = (float(np.linalg.norm(np.ptp(points, axis=0))) for points in (clouds[k], own))
        parts.append(float(np.mean(away > apart)) * (seen / whole if whole else 1.0))
    return min(parts)
