"""The one call: a mechanism in some positions as a picture."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from symgen.describe.mechanism import Mechanism
from symgen.drawing.drawing import Drawing
from symgen.drawing.paper import View
from symgen.drawing.scene import Array


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
    return Drawing.of(mechanism, q, values, open_joints=open_joints, view=view, labels=labels, caption=caption).svg
