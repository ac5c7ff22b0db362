"""Scenes on paper as SVG, small and the same bytes for the same scene, or through matplotlib as pixels or PDF."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Iterable, Sequence
from html import escape
from typing import IO, TYPE_CHECKING, Any

import numpy as np

from symgen.describe.drawing.paper import Circle, Drawn, Path
from symgen.describe.drawing.scene import Array, Look, Scene

if TYPE_CHECKING:
    from matplotlib.figure import Figure


#: Largest width and height of a picture [pixel], and its margin.
WIDTH, HEIGHT, MARGIN = 640.0, 480.0, 14.0
#: Width of a line of width 1 [pixel].
THIN = 1.25
#: Largest number of bodies with names in the picture.
NAMED = 14


def svg_text(
    scene: Scene, drawn: Sequence[Drawn], behind: Sequence[Drawn] = (), labels: bool | None = None, caption: str = ""
) -> str:
    """Return a picture as the text of an SVG file.

    Every body, joint, force and fault is a group ``<g id="joint-NAME" class="joint" data-name="NAME">`` whose title
    says what it is.

    Parameters
    ----------
    scene : Scene
        What is drawn.
    drawn : sequence of Drawn
        Its items on paper, from `symgen.describe.drawing.paper.items_on_paper`.
    behind : sequence of Drawn
        Items drawn faintly behind it.
    labels : bool, optional
        Whether bodies have their names beside them; where they are few by default.
    caption : str
        A sentence below the picture.
    """
    low, scale, width, height = fit_picture([*drawn, *behind])

    def pixels_of_points(points: Array) -> Array:
        return np.stack(
            [(points[:, 0] - low[0]) * scale + MARGIN, height - MARGIN - (points[:, 1] - low[1]) * scale], 1
        )

    wrapped, named = _wrap_caption(caption, width), _labels_with_places(drawn, labels)
    below = 22.0 * len(wrapped)
    title = escape(scene.title or scene.name)
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_short_number(width)} {_short_number(height + below)}" '
        f'width="{_short_number(width)}" height="{_short_number(height + below)}" role="img" font-family="sans-serif" '
        'stroke-linejoin="round" stroke-linecap="round">',
        f"<title>{title}</title>",
        f'<rect width="{_short_number(width)}" height="{_short_number(height + below)}" fill="#ffffff"/>',
    ]
    if behind:
        parts = (part for each in behind for part in each.parts)
        lines += [
            '<g class="ghost" opacity="0.3">',
            *(_svg_part(part, pixels_of_points, scale) for part in parts),
            "</g>",
        ]
    for each in drawn:
        item = each.item
        name = escape(item.name, quote=True)
        lines.append(f'<g id="{item.role}-{name}" class="{item.role}" data-name="{name}" data-kind="{item.kind}">')
        words = f"joint {item.name} is open" if item.role == "fault" else f"{item.role} {item.name} ({item.kind})"
        lines.append(f"<title>{escape(words)}</title>")
        lines += [_svg_part(part, pixels_of_points, scale) for part in each.parts]
        lines.append("</g>")
    if named:
        lines.append(
            '<g class="labels" font-size="12" fill="#20262e" stroke="#ffffff" stroke-width="3" '
            'paint-order="stroke" text-anchor="middle">'
        )
        for name, label in named:
            x, y = pixels_of_points(np.array([label]))[0]
            lines.append(f'<text x="{_short_number(x)}" y="{_short_number(y - 9.0)}">{escape(name)}</text>')
        lines.append("</g>")
    for k, text in enumerate(wrapped):
        y = _short_number(height + 14.0 + 22.0 * k)
        lines.append(
            f'<text class="caption" x="{_short_number(MARGIN)}" y="{y}" font-size="14" fill="#a00000">'
            f"{escape(text)}</text>"
        )
    return "\n".join([*lines, "</svg>", ""])


def _wrap_caption(text: str, width: float) -> list[str]:
    return textwrap.wrap(text, max(20, int(width / 7.6)))


def _labels_with_places(drawn: Sequence[Drawn], labels: bool | None) -> list[tuple[str, tuple[float, float]]]:
    """Return the names in a picture with their places: by default only where bodies are few."""
    few = sum(d.item.role == "body" for d in drawn) <= NAMED
    return [(d.item.name, d.label) for d in drawn if d.label is not None and (few if labels is None else labels)]


def fit_picture(drawn: Iterable[Drawn]) -> tuple[Array, float, float, float]:
    """Return the lower left corner [m], pixels a metre, width and height of a picture [pixel]."""
    corners: list[Array] = []
    for part in (part for each in drawn for part in each.parts):
        if isinstance(part, Circle):
            centre = np.array([part.x, part.y])
            corners += [centre - part.radius, centre + part.radius]
        else:
            corners += [part.points.min(axis=0), part.points.max(axis=0)]
    bounds = np.array(corners or [np.zeros(2), np.ones(2)])
    low, high = bounds.min(axis=0), bounds.max(axis=0)
    size = np.maximum(high - low, 1e-3 * float((high - low).max()) or 1.0)
    scale = float(min((WIDTH - 2 * MARGIN) / size[0], (HEIGHT - 2 * MARGIN) / size[1]))
    width = max(160.0, size[0] * scale + 2 * MARGIN)
    height = max(120.0, size[1] * scale + 2 * MARGIN)
    slack = np.array([width, height]) - 2 * MARGIN - (high - low) * scale
    return low - 0.5 * slack / scale, scale, width, height


def _short_number(number: float) -> str:
    text = f"{number:.1f}"
    text = text.removesuffix(".0")
    return "0" if text == "-0" else text


def _svg_style(look: Look, closed: bool) -> str:
    fill = look.fill if closed and look.fill else "none"
    words = f'fill="{fill}"' + (f' fill-opacity="{look.opacity:g}"' if fill != "none" and look.opacity < 1.0 else "")
    if look.ink and look.width:
        words += f' stroke="{look.ink}" stroke-width="{look.width * THIN:.2g}"'
    return words + (' stroke-dasharray="5 3"' if look.dashed else "")


def _svg_part(part: Path | Circle, place: Callable[[Array], Array], scale: float) -> str:
    if isinstance(part, Circle):
        (x, y), r = place(np.array([[part.x, part.y]]))[0], part.radius * scale
        return (
            f'<circle cx="{_short_number(x)}" cy="{_short_number(y)}" r="{_short_number(r)}" '
            f"{_svg_style(part.look, True)}/>"
        )
    points = " ".join(f"{_short_number(x)},{_short_number(y)}" for x, y in place(part.points))
    tag = "polygon" if part.closed else "polyline"
    return f'<{tag} points="{points}" {_svg_style(part.look, part.closed)}/>'


#: Pixels per inch of sizes, and of written files.
LAID_OUT, WRITTEN = 96.0, 192.0
#: Opacity of items behind.
FAINT = 0.3


def write_pixel_file(
    stream: IO[bytes], kind: str, drawn: Sequence[Drawn], behind: Sequence[Drawn], labels: bool | None, caption: str
) -> None:
    """Write a picture.

    Parameters
    ----------
    stream : file
        Open for bytes.
    kind : {"png", "pdf"}
        Format of the picture.
    drawn, behind : sequence of Drawn
        The scene on paper, and items drawn faintly behind it.
    labels : bool, optional
        Whether bodies have their names beside them; where they are few by default.
    caption : str
        A sentence below the picture.
    """
    from matplotlib.figure import Figure

    figure = Figure()
    paint_on_figure(figure, fit_picture([*drawn, *behind]), drawn, behind, labels, caption)
    metadata = {"png": {"Software": None}, "pdf": {"CreationDate": None}}[kind]
    figure.savefig(stream, format=kind, dpi=WRITTEN, metadata=metadata)


def paint_on_figure(
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
        The value of `symgen.describe.drawing.pictures.fit_picture` for all items.
    drawn, behind, labels, caption
        As for `write_pixel_file`.
    """
    low, scale, width, height = frame
    lines = _wrap_caption(caption, width)
    below = 22.0 * len(lines)
    figure.set_size_inches(width / LAID_OUT, (height + below) / LAID_OUT)
    ax = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    ax.set_axis_off()
    ax.set_xlim(-MARGIN, width - MARGIN)
    ax.set_ylim(-MARGIN - below, height - MARGIN)
    for group, strength in ((behind, FAINT), (drawn, 1.0)):
        for part in (part for each in group for part in each.parts):
            _add_to_axes(ax, part, low, scale, strength)
    for name, label in _labels_with_places(drawn, labels):
        x, y = ((c - o) * scale for c, o in zip(label, low, strict=True))
        ax.text(x, y + 9.0, name, fontsize=9.0, color="#20262e", ha="center", parse_math=False, zorder=9)
    for k, text in enumerate(lines):
        ax.text(0.0, -MARGIN - 14.0 - 22.0 * k, text, fontsize=10.5, color="#a00000", parse_math=False)


def _add_to_axes(ax: Any, part: Path | Circle, low: Any, scale: float, strength: float) -> None:
    from matplotlib import patches
    from matplotlib.colors import to_rgba

    look, closed = part.look, isinstance(part, Circle) or part.closed
    paint: dict[str, Any] = {
        "facecolor": to_rgba(look.fill, look.opacity * strength) if closed and look.fill else "none",
        "edgecolor": to_rgba(look.ink, strength) if look.ink and look.width else "none",
        "linewidth": look.width * THIN * 72.0 / LAID_OUT,
        "linestyle": (0, (4.0, 2.4)) if look.dashed else "-",
        **{"joinstyle": "round", "capstyle": "round", "zorder": 2},
    }
    if isinstance(part, Circle):
        centre = (part.x - low[0]) * scale, (part.y - low[1]) * scale
        ax.add_patch(patches.Circle(centre, part.radius * scale, **paint))
    else:
        ax.add_patch(patches.Polygon((part.points - low) * scale, closed=closed, **paint))
