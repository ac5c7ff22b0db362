"""Matplotlib figures as pictures in a page: their common style, and files small enough to embed."""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any, cast

from symgen.base.files import need_library
from symgen.base.locales import localise_figure
from symgen.study.report.document import Picture, Section

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Okabe and Ito's colours that stand out on white, told apart with every kind of colour vision.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000")
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", ">", "p", "*", "h", "d", "8", "H", "1", "2", "3", "4")
DASHES = ("-", (0, (5, 1.5)), (0, (1.2, 1.2)), (0, (6, 1.5, 1.2, 1.5)))
GREY = "#5b6470"

#: Width of a picture [inch]: at the width of a phone its letters can still be read, and two fit beside each other on a
#: desk.
WIDTH = 5.0
#: A vector file above this becomes pixels [bytes].
LARGEST_SVG = 200_000
#: Sketches at the head of a report at most, and bodies of a mechanism that is drawn.
MOST_SKETCHES, MOST_BODIES = 12, 200
#: Pixels per inch of those.
DPI = 200

#: Any, as matplotlib's types list every key.
_LOOK: Any = {
    "font.family": "DejaVu Sans",  # comes with matplotlib, so a report looks the same everywhere
    "font.size": 9.0,
    "axes.labelsize": 9.0,
    "axes.titlesize": 10.0,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.edgecolor": GREY,
    "axes.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#d9dde3",
    "grid.linewidth": 0.6,
    "xtick.color": GREY,
    "ytick.color": GREY,
    "xtick.labelcolor": "#222222",
    "ytick.labelcolor": "#222222",
    "legend.frameon": False,
    "legend.fontsize": 8.2,
    "legend.handlelength": 2.6,
    "lines.linewidth": 1.3,
    "lines.markersize": 5.0,
    "svg.fonttype": "path",
    "svg.hashsalt": "symgen",
    "figure.facecolor": "white",
    "path.simplify": True,
}


def line_style(index: int) -> dict[str, Any]:
    """Return colour, dashes and marker of the line with a number: no two of the first hundred are alike."""
    n = len(COLOURS)
    return {
        "color": COLOURS[index % n],
        "linestyle": DASHES[index // n % len(DASHES)],
        "marker": MARKERS[index % len(MARKERS)],
    }


def shade_of_colour(color: str, level: int) -> str:
    """Return a colour, or a lighter shade of it for a level above 0."""
    if level == 0:
        return color
    share = 1.0 - 0.75**level
    parts = (int(color[i : i + 2], 16) for i in (1, 3, 5))
    return "#" + "".join(f"{round(x + share * (215 - x)):02x}" for x in parts)


def draw_picture(
    name: str, caption: str, alternative: str, draw: Callable[[Figure], None], height: float = 4.0, wide: bool = False
) -> Picture:
    """Draw a picture.

    Parameters
    ----------
    name, caption, alternative, wide
        As of `Picture`.
    draw : callable
        Fills an empty figure.
    height : float
        Of the figure [inch].
    """
    need_library("report", "matplotlib", extra="plot")
    import matplotlib as mpl
    from matplotlib.figure import Figure

    with mpl.rc_context(_LOOK):
        figure = Figure(figsize=(WIDTH * (1.9 if wide else 1.0), height), layout="constrained")
        draw(figure)
        localise_figure(figure)
        data, kind = _svg_file(figure)
    return Picture(name, caption, alternative, data, kind, wide, partial(_png_pixels, figure))


def picture_of_figure(name: str, caption: str, alternative: str, make: Callable[[], Figure]) -> Picture:
    """Return a picture across the page, of a figure that a function makes in the style of reports."""
    need_library("report", "matplotlib", extra="plot")
    import matplotlib as mpl

    with mpl.rc_context(_LOOK):
        figure = make()
        localise_figure(figure)
        data, kind = _svg_file(figure)
    return Picture(name, caption, alternative, data, kind, True, partial(_png_pixels, figure))


def _svg_file(figure: Figure) -> tuple[bytes, str]:
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    stream, canvas = io.BytesIO(), cast("Any", FigureCanvasSVG(figure))
    # `savefig` would first draw everything once more, for files cropped to the drawing
    canvas.print_svg(stream, metadata={"Date": None, "Creator": None})
    text = stream.getvalue().decode()
    # a hundredth of a point is invisible
    text = re.sub(r' d="[^"]*"', lambda m: re.sub(r"(\.\d\d)\d+", r"\1", m.group()), text)
    data = text[text.index("<svg") :].encode()
    if len(data) <= LARGEST_SVG:
        return data, "svg"
    return _png_pixels(figure), "png"


def _png_pixels(figure: Figure) -> bytes:
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=DPI, metadata={"Software": None})
    return stream.getvalue()


def legend_below(figure: Figure, entries: int, columns: int = 2, handles: object = None) -> None:
    """Put the legend below the axes, and make the figure taller by its height."""
    if entries < 1:
        return
    rows = -(-entries // columns)
    width, height = figure.get_size_inches()
    figure.set_size_inches(width, height + 0.17 * rows)
    arguments = {} if handles is None else {"handles": handles}
    figure.legend(loc="outside lower center", ncols=columns, columnspacing=1.4, **arguments)


def sketches_section(sketches: Mapping[str, str]) -> list[Section]:
    """Return the section of sketches at the head of a report, empty without sketches.

    Parameters
    ----------
    sketches : mapping of str to str
        SVG by the names of mechanisms; further ones than `MOST_SKETCHES` are left out.
    """
    pictures = [
        Picture(f"sketch-{name}", f"{name} at its start", f"A sketch of {name}.", text.encode(), "svg")
        for name, text in list(sketches.items())[:MOST_SKETCHES]
    ]
    if not pictures:
        return []
    one = len(pictures) == 1
    return [Section("Mechanism" if one else "Mechanisms", pictures=tuple(pictures), strip=not one)]
