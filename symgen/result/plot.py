"""Figures that a notebook shows and a file takes."""

from __future__ import annotations

import io
from collections.abc import Callable
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

from symgen.base.arguments import path as argument_path
from symgen.base.files import check_path, need, write_whole
from symgen.result.export import PLOTTED

#: Dots per inch of a figure in a file and in a notebook.
IN_FILE, SHOWN = 150, 90


@dataclass(frozen=True, repr=False)
class Plot:
    """A figure: shown by notebooks, saved as PNG, SVG or PDF.

    Attributes
    ----------
    figure : matplotlib.figure.Figure
        To change before it is shown or saved.
    """

    figure: Any

    def save(self, path: str | PathLike[str]) -> Path:
        """Write the figure to a file, without a date: the same result gives the same bytes.

        Raises
        ------
        InputError
            If the ending is not ``.png``, ``.svg`` or ``.pdf``, or the file cannot be written.
        """
        where = check_path("plot", argument_path("plot", path), PLOTTED, "plot")
        kind = where.suffix.lower().removeprefix(".")
        metadata = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}.get(kind, {})
        import matplotlib as mpl

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


def plotted(path: str | PathLike[str] | None, draw: Callable[[], Any]) -> Plot | Path:
    """Draw a figure, and write it where there is a path.

    Parameters
    ----------
    path : path, optional
        The file; it is checked before anything is drawn.
    draw : callable
        Makes the matplotlib figure.

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
        need("plot", *PLOTTED[".png"], extra="plot")
        return Plot(draw())
    check_path("plot", argument_path("plot", path), PLOTTED, "plot")
    return Plot(draw()).save(path)
