"""Linkages for three positions of a body, or a path, that a hand has drawn."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from symgen.base.errors import InputError, quote
from symgen.describe.edits.snippet_tables import Spot
from symgen.study.synthesis.linkages import Linkage
from symgen.study.synthesis.synthesizing import synthesize

#: What a hand draws.
POSITIONS, PATH = "positions", "path"


class DrawnTasks:
    """Linkages that were found last, for each page."""

    def __init__(self) -> None:
        self._found: dict[str, tuple[Linkage, ...]] = {}

    def find(self, kind: str, spots: Sequence[Spot], tab: str, starts: int) -> dict[str, Any]:
        """Return the linkages for a task, the best first, or why there is none.

        Parameters
        ----------
        kind : str
            `POSITIONS`, each a point of the body and another one in the direction of its x axis, or `PATH`.
        spots : sequence of Spot
            The points.
        tab, starts : str, int
            Who asks, and for how many searches.

        Raises
        ------
        InputError
            If the points are no task.
        """
        columns = _columns(kind, np.array([(spot.x, spot.y) for spot in spots]).reshape(-1, 2))
        found = synthesize(columns, starts)
        self._found = {tab: found.linkages}
        return {"reason": found.reason or "", "linkages": [_offer(each) for each in found.linkages]}

    def add(self, text: str, place: int, tab: str) -> dict[str, Any]:
        """Return a text with one of the linkages that were found.

        Raises
        ------
        InputError
            If there is no such linkage any more.
        """
        found = self._found.get(tab, ())
        if not 0 <= place < len(found):
            raise InputError("linkage", "one that was offered", "another one", "draw its task once more")
        return {"text": found[place].add_to_text(text)}


def _columns(kind: str, points: np.ndarray[Any, np.dtype[np.float64]]) -> dict[str, list[float]]:
    """Return the columns of a task."""
    if kind == PATH:
        return {"x": points[:, 0].tolist(), "y": points[:, 1].tolist()}
    if kind != POSITIONS:
        raise InputError("task", f"{POSITIONS} or {PATH}", quote(kind))
    if len(points) != 6:
        raise InputError(POSITIONS, "three points with a direction each", f"{len(points)} points")
    ahead = points[1::2] - points[::2]
    if not np.abs(ahead).max(axis=1).min() > 0.0:
        raise InputError(POSITIONS, "a direction from each point to another place", "a point without one")
    angles = np.unwrap(np.arctan2(ahead[:, 1], ahead[:, 0]))
    return {"x": points[::2, 0].tolist(), "y": points[::2, 1].tolist(), "angle": angles.tolist()}


def _offer(linkage: Linkage) -> dict[str, Any]:
    """Return what a page says of a linkage, and draws."""
    return {
        "kind": linkage.kind,
        "transmission": math.degrees(linkage.transmission),
        "turn": math.degrees(linkage.turn),
        "deviation": linkage.deviation,
        "pins": linkage.pins._asdict(),
    }
