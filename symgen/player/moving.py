"""Motions as GIF, through matplotlib and Pillow, which are imported only here."""

from __future__ import annotations

import io
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from symgen.drawing.build import build_scene
from symgen.drawing.paper import Drawn, View, on_paper
from symgen.drawing.pixels import paint
from symgen.drawing.svg import fitted
from symgen.errors import InputError
from symgen.files import check_writable, write_whole
from symgen.player.recording import Recording

#: Frames at most, and how many a second.
MOST, RATE = 150, 25
#: Pixels an inch.
DPI = 80.0


def check_gif(where: str, path: Path) -> None:
    """Refuse a GIF that could not be written, before anything is computed for it.

    Raises
    ------
    InputError
        If a library is missing or the file cannot be written.
    """
    for library in ("matplotlib", "PIL"):
        if find_spec(library) is None:
            raise InputError(where, f"the library {library}", "none", "pip install 'symgen[plot]' installs it")
    check_writable(where, path)


def write_gif(path: Path, recording: Recording) -> Path:
    """Write a motion as a GIF at its own pace, with fewer pictures where it takes longer than six seconds.

    Parameters
    ----------
    path : Path
        The file.
    recording : Recording
        What moves.
    """
    from matplotlib.figure import Figure
    from PIL import Image

    scene = build_scene(recording.mechanism, recording.q, recording.values)
    span = float(recording.t[-1] - recording.t[0])
    count = int(min(MOST, max(2, round(span * RATE)), len(recording.t)))
    times = np.linspace(recording.t[0], recording.t[-1], count)
    rows = [recording.q[int(np.argmin(np.abs(recording.t - time)))] for time in times]
    pages = [on_paper(scene, row, View()) for row in rows]
    everything: list[Drawn] = [each for drawn in pages for each in drawn]
    frame = fitted(everything)
    pictures = []
    for drawn in pages:
        stream = io.BytesIO()
        figure = Figure(dpi=DPI)
        paint(figure, frame, drawn)
        figure.savefig(stream, format="png", dpi=DPI)
        stream.seek(0)
        pictures.append(Image.open(stream).convert("P", palette=Image.Palette.ADAPTIVE, colors=64))
    pause = round(max(20.0, 1000.0 * span / count))

    def write(file: io.BytesIO) -> None:
        pictures[0].save(file, format="GIF", save_all=True, append_images=pictures[1:], duration=pause, loop=0)

    return write_whole(path, write)
