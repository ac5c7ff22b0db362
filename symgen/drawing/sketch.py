"""The one call: a mechanism in some positions as a picture."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from symgen.describe.evaluate import parameter_values, scalars
from symgen.describe.mechanism import Mechanism
from symgen.describe.start import described_start
from symgen.drawing.build import build_scene
from symgen.drawing.paper import View, on_paper
from symgen.drawing.scene import Array
from symgen.drawing.svg import svg


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
        Coordinates of all bodies; the described start unless given, which may be open.
    values : mapping of str to float, optional
        Parameters that differ from the described ones.
    open_joints : sequence of str
        Joints that are marked as open.
    view : View, optional
        From where a spatial mechanism is seen.
    labels : bool, optional
        Whether bodies have their names beside them; where they are few unless given.
    caption : str
        A sentence below the picture.

    Raises
    ------
    InputError
        If `q` has not as many numbers as the mechanism has coordinates.
    """
    if q is None:
        q = described_start(mechanism, scalars(parameter_values(mechanism, values)))[0]
    scene = build_scene(mechanism, q, values, open_joints)
    return svg(scene, on_paper(scene, np.asarray(q, dtype=np.float64), view), labels, caption)
