"""A picture of a mechanism: shown by notebooks, saved as SVG, PDF or PNG."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from symgen.base.arguments import path_argument as argument_path
from symgen.base.files import check_path, write_whole
from symgen.describe.drawing.mechanism_scene import build_scene
from symgen.describe.drawing.paper import Drawn, View, items_on_paper, view_axes
from symgen.describe.drawing.paper import Path as Stroke
from symgen.describe.drawing.pictures import svg_text, write_pixel_file
from symgen.describe.drawing.scene import COLOURS, Array, Item, Look, Point, Scene
from symgen.describe.drawing.traced import traced_points
from symgen.describe.drawing.viewpoint import USUAL, choose_viewpoint
from symgen.describe.formulas.evaluate import parameter_values, scalar_values
from symgen.describe.formulas.start import described_start

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism

#: Endings of pictures with the libraries that they need.
PICTURES: Mapping[str, tuple[str, ...]] = {".svg": (), ".png": ("matplotlib",), ".pdf": ("matplotlib",)}
#: Number of positions in a picture of a motion, and of points of a path.
POSES, PATH = 4, 300


@dataclass(frozen=True, repr=False)
class Drawing:
    """A mechanism on paper.

    Attributes
    ----------
    scene : Scene
        What is drawn.
    q : tuple of float
        Coordinates of all bodies.
    view : View
        From where it is seen, where it is spatial.
    ghosts : tuple of tuple of float
        Further positions drawn faintly behind, the first one faintest; none by default.
    paths : tuple of tuple of Point
        Lines of the ground frame behind everything, such as the paths of points.
    labels : bool or None
        Whether bodies have their names beside them; where they are few by default.
    caption : str
        A sentence below the picture.
    """

    scene: Scene
    q: tuple[float, ...]
    view: View = USUAL
    ghosts: tuple[tuple[float, ...], ...] = ()
    paths: tuple[tuple[Point, ...], ...] = ()
    labels: bool | None = None
    caption: str = ""

    @classmethod
    def of_mechanism(
        cls,
        mechanism: Mechanism,
        q: Sequence[float] | Array | None = None,
        values: Mapping[str, float] | None = None,
        *,
        open_joints: Sequence[str] = (),
        view: View | None = None,
        ghosts: Sequence[Sequence[float]] = (),
        labels: bool | None = None,
        caption: str = "",
    ) -> Drawing:
        """Return the picture of a mechanism; arguments as for `symgen.describe.drawing.sketch`."""
        if q is None:
            q = described_start(mechanism, scalar_values(parameter_values(mechanism, values)))[0]
        scene = build_scene(mechanism, q, values, open_joints)
        where = tuple(float(x) for x in np.asarray(q, dtype=np.float64).ravel())
        behind = tuple(tuple(map(float, ghost)) for ghost in ghosts)
        return cls(scene, where, view or choose_viewpoint(scene, np.array(where)), behind, (), labels, caption)

    @classmethod
    def of_motion(
        cls, mechanism: Mechanism, q: Array, values: Mapping[str, float] | None = None, view: View | None = None
    ) -> Drawing:
        """Return the picture of a mechanism in motion: its start, a few later positions, and paths.

        Paths are drawn of points that no joint ties, or else of the centres of mass.

        Parameters
        ----------
        mechanism : Mechanism
            Any.
        q : Array, shape (k, nq)
            Coordinates of all bodies over time.
        values : mapping of str to float, optional
            Parameters that differ from the described ones.
        view : View, optional
            From where a spatial mechanism is seen.
        """
        scene = build_scene(mechanism, q, values)
        later = np.unique(np.linspace(0, len(q) - 1, POSES).round().astype(int))[1:]
        ghosts = tuple(tuple(q[k].tolist()) for k in reversed(later))
        points = traced_points(mechanism, parameter_values(mechanism, values))
        shown = [p for p in points if p.free] or [p for p in points if not any(p.at)]
        poses = [scene.poses(row) for row in q[:: max(1, len(q) // PATH)]]
        ways = [np.concatenate([at.to_ground(p.body, [p.at]) for at in poses]) for p in shown]
        paths = tuple(tuple((float(x), float(y), float(z)) for x, y, z in way) for way in ways)
        return cls(scene, tuple(q[0].tolist()), view or choose_viewpoint(scene, q[0]), ghosts, paths, labels=False)

    @cached_property
    def svg(self) -> str:
        """The picture as SVG text, the same for the same scene."""
        return svg_text(self.scene, self._scene_on_paper(), self._ghosts_and_paths(), self.labels, self.caption)

    def _scene_on_paper(self) -> list[Drawn]:
        return items_on_paper(self.scene, np.array(self.q), self.view)

    def _ghosts_and_paths(self) -> list[Drawn]:
        drawn: list[Drawn] = []
        eye = view_axes(self.scene, self.view)
        for i, path in enumerate(self.paths):
            points = np.array(path) @ eye.T
            look = Look(COLOURS[i % len(COLOURS)], "", 1.6)
            way = Item("path", "", "", ())
            drawn.append(Drawn(way, (Stroke(points[:, :2], look, False),), 0.0, None))
        for ghost in self.ghosts:
            drawn += items_on_paper(self.scene, np.array(ghost), self.view, bodies=True)
        return drawn

    def save(self, path: str | PathLike[str]) -> Path:
        """Write the picture to ``.svg``, or with matplotlib to ``.png`` or ``.pdf``; whole or not at all.

        Raises
        ------
        InputError
            If the ending is not known, matplotlib is missing for pixels, or the file cannot be written.
        """
        file = check_path("draw", argument_path("path", path), PICTURES, "plot")
        if file.suffix.lower() == ".svg":
            return write_whole(file, self.svg)
        kind = file.suffix.lower().removeprefix(".")
        drawn, behind = self._scene_on_paper(), self._ghosts_and_paths()
        return write_whole(
            file, lambda stream: write_pixel_file(stream, kind, drawn, behind, self.labels, self.caption)
        )

    def png(self) -> bytes:
        """Return the picture as pixels."""
        stream = io.BytesIO()
        write_pixel_file(stream, "png", self._scene_on_paper(), self._ghosts_and_paths(), self.labels, self.caption)
        return stream.getvalue()

    def _repr_svg_(self) -> str:
        return self.svg

    def __repr__(self) -> str:
        items = ", ".join(f"{sum(i.role == role for i in self.scene.items)} {word}" for role, word in _COUNTED)
        return f"<Drawing of {self.scene.name}: {items}>"


_COUNTED = (("body", "bodies"), ("joint", "joints"), ("force", "forces"))


def sketch(
    mechanism: Mechanism,
    q: Sequence[float] | Array | None = None,
    values: Mapping[str, float] | None = None,
    *,
    open_joints: Sequence[str] = (),
    view: View | None = None,
    labels: bool | None = None,
    caption: str = "",
) -> str:
    """Return a picture of a mechanism as SVG text.

    Bodies are drawn from their points or as their ``shape`` says, joints and forces by their symbols. Each is a group
    ``<g id="joint-NAME" class="joint" data-name="NAME">``, with ``body``, ``force`` and ``fault`` likewise.

    Parameters
    ----------
    mechanism : Mechanism
        Any.
    q : array, shape (nq,), optional
        Coordinates of all bodies; the described start by default, which may be open.
    values : mapping of str to float, optional
        Parameters that differ from the described ones.
    open_joints : sequence of str
        Joints that are marked as open.
    view : View, optional
        From where a spatial mechanism is seen.
    labels : bool, optional
        Whether bodies have their names beside them; where they are few by default.
    caption : str
        A sentence below the picture.

    Raises
    ------
    InputError
        If `q` has not as many numbers as the mechanism has coordinates.
    """
    return Drawing.of_mechanism(
        mechanism, q, values, open_joints=open_joints, view=view, labels=labels, caption=caption
    ).svg
