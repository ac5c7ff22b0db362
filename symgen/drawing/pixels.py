"""Scenes on paper as pixels or PDF, through matplotlib, which is imported only here."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import IO, TYPE_CHECKING, Any

from symgen.drawing.paper import Circle, Drawn, Path
from symgen.drawing.scene import Array, Look
from symgen.drawing.svg import MARGIN, NAMED, THIN, fitted

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Pixels an inch that sizes are counted in, and that are written.
LAID_OUT, WRITTEN = 96.0, 192.0
#: Ink of what stands behind, in parts of the whole.
FAINT = 0.3


def write_pixels(
    stream: IO[bytes], kind: str, drawn: Sequence[Drawn], behind: Sequence[Drawn], labels: bool | None, caption: str
) -> None:
    """Write a picture.

    Parameters
    ----------
    stream : file
        Open for bytes.
    kind : {"png", "pdf"}
        What is written.
    drawn, behind : sequence of Drawn
        The scene on paper, and what stands faintly behind it.
    labels : bool, optional
        Whether bodies have their names beside them; where they are few by default.
    caption : str
        A sentence below the picture.
    """
    from matplotlib.figure import Figure

    figure = Figure()
    paint(figure, fitted([*drawn, *behind]), drawn, behind, labels, caption)
    metadata = {"png": {"Software": None}, "pdf": {"CreationDate": None}}[kind]
    figure.savefig(stream, format=kind, dpi=WRITTEN, metadata=metadata)


def paint(
    figure: Figure,
    frame: tuple[Array, float, float, float],
    drawn: Sequence[Drawn],
    behind: Sequence[Drawn] = (),
    labels: bool | None = None,
    caption: str = "",
) -> None:
    """Draw a scene on paper into an empty figure, which gets its size.

    Parameters
    ----------
    figure : Figure
        Of matplotlib.
    frame : tuple
        What `symgen.drawing.svg.fitted` says of what shall fit.
    drawn, behind, labels, caption
        As for `write_pixels`.
    """
    low, scale, width, height = frame
    lines = textwrap.wrap(caption, max(20, int(width / 7.6)))
    below = 22.0 * len(lines)
    figure.set_size_inches(width / LAID_OUT, (height + below) / LAID_OUT)
    ax = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    ax.set_axis_off()
    ax.set_xlim(-MARGIN, width - MARGIN)
    ax.set_ylim(-MARGIN - below, height - MARGIN)
    for group, strength in ((behind, FAINT), (drawn, 1.0)):
        for part in (part for each in group for part in each.parts):
            _add(ax, part, low, scale, strength)
    named = sum(d.item.role == "body" for d in drawn) <= NAMED if labels is None else labels
    for each in drawn:
        if named and each.label is not None:
            x, y = ((c - o) * scale for c, o in zip(each.label, low, strict=True))
            ax.text(x, y + 9.0, each.item.name, fontsize=9.0, color="#20262e", ha="center", parse_math=False, zorder=9)
    for k, text in enumerate(lines):
        ax.text(0.0, -MARGIN - 14.0 - 22.0 * k, text, fontsize=10.5, color="#a00000", parse_math=False)


def _add(ax: Any, part: Path | Circle, low: Any, scale: float, strength: float) -> None:
    from matplotlib import patches

    look = part.look
    if isinstance(part, Circle):
        centre = (part.x - low[0]) * scale, (part.y - low[1]) * scale
        patch: Any = patches.Circle(centre, part.radius * scale, **_paint(look, True, strength))
    elif part.closed:
        patch = patches.Polygon((part.points - low) * scale, closed=True, **_paint(look, True, strength))
    else:
        patch = patches.Polygon((part.points - low) * scale, closed=False, **_paint(look, False, strength))
    ax.add_patch(patch)


def _paint(look: Look, closed: bool, strength: float) -> dict[str, Any]:
    from matplotlib.colors import to_rgba

    filled = closed and look.fill
    return {
        "facecolor": to_rgba(look.fill, look.opacity * strength) if filled else "none",
        "edgecolor": to_rgba(look.ink, strength) if look.ink and look.width else "none",
        "linewidth": look.width * THIN * 72.0 / LAID_OUT,
        "linestyle": (0, (4.0, 2.4)) if look.dashed else "-",
        "joinstyle": "round",
        "capstyle": "round",
        "zorder": 2,
    }
