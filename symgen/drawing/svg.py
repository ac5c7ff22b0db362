"""Scenes on paper as SVG: small, and the same bytes for the same scene."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from html import escape

import numpy as np

from symgen.drawing.paper import Circle, Drawn, Path
from symgen.drawing.scene import Array, Look, Scene

#: Largest width and height of a picture [pixel], and its margin.
WIDTH, HEIGHT, MARGIN = 640.0, 480.0, 14.0
#: Width of a line of width 1 [pixel].
THIN = 1.25
#: Bodies at most that have their names in the picture.
NAMED = 14


def svg(
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
        It on paper, from `symgen.drawing.paper.on_paper`.
    behind : sequence of Drawn
        What stands faintly behind it.
    labels : bool, optional
        Whether bodies have their names beside them; where they are few by default.
    caption : str
        A sentence below the picture.
    """
    low, scale, width, height = fitted([*drawn, *behind])
    named = sum(d.item.role == "body" for d in drawn) <= NAMED if labels is None else labels

    def place(points: Array) -> Array:
        return np.stack(
            [(points[:, 0] - low[0]) * scale + MARGIN, height - MARGIN - (points[:, 1] - low[1]) * scale], 1
        )

    below = 22.0 * len(_wrapped(caption, width))
    title = escape(scene.title or scene.name)
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_short(width)} {_short(height + below)}" '
        f'width="{_short(width)}" height="{_short(height + below)}" role="img" font-family="sans-serif" '
        'stroke-linejoin="round" stroke-linecap="round">',
        f"<title>{title}</title>",
        f'<rect width="{_short(width)}" height="{_short(height + below)}" fill="#ffffff"/>',
    ]
    if behind:
        parts = (part for each in behind for part in each.parts)
        lines += ['<g class="ghost" opacity="0.3">', *(_part(part, place, scale) for part in parts), "</g>"]
    for each in drawn:
        item = each.item
        name = escape(item.name, quote=True)
        lines.append(f'<g id="{item.role}-{name}" class="{item.role}" data-name="{name}" data-kind="{item.kind}">')
        lines.append(f"<title>{escape(_words(each))}</title>")
        lines += [_part(part, place, scale) for part in each.parts]
        lines.append("</g>")
    if named:
        lines.append(
            '<g class="labels" font-size="12" fill="#20262e" stroke="#ffffff" stroke-width="3" '
            'paint-order="stroke" text-anchor="middle">'
        )
        for each in drawn:
            if each.label is not None:
                (x, y), text = place(np.array([each.label]))[0], escape(each.item.name)
                lines.append(f'<text x="{_short(x)}" y="{_short(y - 9.0)}">{text}</text>')
        lines.append("</g>")
    for k, text in enumerate(_wrapped(caption, width)):
        y = _short(height + 14.0 + 22.0 * k)
        lines.append(
            f'<text class="caption" x="{_short(MARGIN)}" y="{y}" font-size="14" fill="#a00000">{escape(text)}</text>'
        )
    return "\n".join([*lines, "</svg>", ""])


def _words(drawn: Drawn) -> str:
    item = drawn.item
    if item.role == "fault":
        return f"joint {item.name} is open"
    return f"{item.role} {item.name} ({item.kind})"


def _wrapped(text: str, width: float) -> list[str]:
    import textwrap

    return textwrap.wrap(text, max(20, int(width / 7.6)))


def fitted(drawn: Iterable[Drawn]) -> tuple[Array, float, float, float]:
    """Return the lower left corner [m], pixels a metre, width and height of a picture [pixel]."""
    corners: list[Array] = []
    for part in (part for each in drawn for part in each.parts):
        if isinstance(part, Circle):
            centre = np.array([part.x, part.y])
            corners += [centre - part.radius, centre + part.radius]
        else:
            corners += [part.points.min(axis=0), part.points.max(axis=0)]
    found = np.array(corners or [np.zeros(2), np.ones(2)])
    low, high = found.min(axis=0), found.max(axis=0)
    size = np.maximum(high - low, 1e-3 * float((high - low).max()) or 1.0)
    scale = float(min((WIDTH - 2 * MARGIN) / size[0], (HEIGHT - 2 * MARGIN) / size[1]))
    width = max(160.0, size[0] * scale + 2 * MARGIN)
    height = max(120.0, size[1] * scale + 2 * MARGIN)
    slack = np.array([width, height]) - 2 * MARGIN - (high - low) * scale
    return low - 0.5 * slack / scale, scale, width, height


def _short(number: float) -> str:
    text = f"{number:.1f}"
    text = text.removesuffix(".0")
    return "0" if text == "-0" else text


def _paint(look: Look, closed: bool) -> str:
    fill = look.fill if closed and look.fill else "none"
    words = f'fill="{fill}"' + (f' fill-opacity="{look.opacity:g}"' if fill != "none" and look.opacity < 1.0 else "")
    if look.ink and look.width:
        words += f' stroke="{look.ink}" stroke-width="{look.width * THIN:.2g}"'
    return words + (' stroke-dasharray="5 3"' if look.dashed else "")


def _part(part: Path | Circle, place: Callable[[Array], Array], scale: float) -> str:
    if isinstance(part, Circle):
        (x, y), r = place(np.array([[part.x, part.y]]))[0], part.radius * scale
        return f'<circle cx="{_short(x)}" cy="{_short(y)}" r="{_short(r)}" {_paint(part.look, True)}/>'
    points = " ".join(f"{_short(x)},{_short(y)}" for x, y in place(part.points))
    tag = "polygon" if part.closed else "polyline"
    return f'<{tag} points="{points}" {_paint(part.look, part.closed)}/>'
