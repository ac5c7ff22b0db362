"""Figures that a notebook shows and a file takes."""

from __future__ import annotations

import io
import shutil
from collections.abc import Callable
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

from symgen.base.arguments import number
from symgen.base.arguments import path_argument as argument_path
from symgen.base.errors import InputError
from symgen.base.files import MEASURED, check_path, need_library, write_whole
from symgen.base.locales import localise_figure
from symgen.result.export import PLOTTED

#: Dots per inch of a figure in a file and in a notebook.
IN_FILE, SHOWN = 150, 90
#: Widths of figures in print [mm].
NARROWEST, WIDEST = 30.0, 1000.0


@dataclass(frozen=True, repr=False)
class Plot:
    """A figure: shown by notebooks, saved as PNG, SVG, PDF or PGF, which LaTeX reads.

    Attributes
    ----------
    figure : matplotlib.figure.Figure
        To change before it is shown or saved.
    """

    figure: Any

    def save(self, path: str | PathLike[str], width: float | None = None) -> Path:
        """Write the figure to a file, without a date: the same result gives the same bytes.

        Parameters
        ----------
        path : path
            A ``.png``, ``.svg``, ``.pdf`` or ``.pgf`` file. LaTeX sets the texts of the last one in its own letters,
            and one of its programs has to be there.
        width : float, optional
            Width of a column of a printed page [mm], which the figure is fitted into: letters of 8 points, the legend
            below, and no title, as a caption replaces it.

        Raises
        ------
        InputError
            If the ending or the width is wrong, no LaTeX measures texts, or the file cannot be written.
        """
        where = check_path("plot", argument_path("plot", path), PLOTTED, "plot")
        if width is not None:
            from symgen.result.plots import fit_into

            fit_into(self.figure, check_width("width", width))
        localise_figure(self.figure)
        kind = where.suffix.lower().removeprefix(".")
        metadata = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}.get(kind, {})
        import matplotlib as mpl

        if kind == "pgf":
            return write_whole(where, _pgf_text(self.figure))
        # names of clip paths would be drawn anew for each file
        with mpl.rc_context({"svg.hashsalt": "symgen", "pdf.fonttype": 42}):  # printers refuse fonts of type 3
            return write_whole(
                where, lambda file: self.figure.savefig(file, format=kind, dpi=IN_FILE, metadata=metadata)
            )

    def _repr_png_(self) -> bytes:
        stream = io.BytesIO()
        self.figure.savefig(stream, format="png", dpi=SHOWN, metadata={"Software": None})
        return stream.getvalue()

    def __repr__(self) -> str:
        return f"<Plot of {len(self.figure.axes)} panels; .save('plot.pdf') writes it>"


def check_width(where: str, width: float) -> float:
    """Return the width of a figure [mm]; one that no page has is refused.

    Raises
    ------
    InputError
        If it is not from 30 to 1000.
    """
    if not NARROWEST <= number(where, width) <= WIDEST:
        raise InputError(where, f"{NARROWEST:g} to {WIDEST:g} mm", f"{width:g}")
    return width


def _pgf_text(figure: Any) -> bytes:
    """Return the text of a figure in PGF, in the letters of the document that reads it."""
    import matplotlib as mpl
    from matplotlib.backends.backend_pgf import LatexError

    program, text = next(name for name in MEASURED[".pgf"] if shutil.which(name)), io.StringIO()
    try:
        with mpl.rc_context({"pgf.texsystem": program, "pgf.rcfonts": False}):
            figure.savefig(text, format="pgf")
    except (LatexError, RuntimeError, ValueError, OSError) as error:
        expected, said = f"a {program} that measures texts", " ".join(str(error).split())[:200]
        raise InputError("plot", f"{expected}, with the packages of matplotlib's PGF backend", said or "none") from None
    return text.getvalue().encode()


def draw_or_save(path: str | PathLike[str] | None, draw: Callable[[], Any], width: float | None = None) -> Plot | Path:
    """Draw a figure, and write it where there is a path.

    Parameters
    ----------
    path : path, optional
        The file; it is checked before anything is drawn.
    draw : callable
        Makes the matplotlib figure.
    width : float, optional
        Of the file [mm], as in `Plot.save`.

    Returns
    -------
    Plot or Path
        The figure, or the file.

    Raises
    ------
    InputError
        If matplotlib is missing, the ending is not known, or the file cannot be written.
    """
    if path is None:
        need_library("plot", *PLOTTED[".png"], extra="plot")
        return Plot(draw())
    check_path("plot", argument_path("plot", path), PLOTTED, "plot")
    return Plot(draw()).save(path, width)
