"""Motions as GIF or MP4, by matplotlib and Pillow, which are imported only here, and ffmpeg."""

from __future__ import annotations

import io
import itertools
import shutil
import subprocess
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.base.errors import InputError
from symgen.base.files import check_path, write_whole
from symgen.describe.drawing.mechanism_scene import build_scene
from symgen.describe.drawing.paper import Drawn, items_on_paper
from symgen.describe.drawing.pictures import fit_picture, paint_on_figure
from symgen.describe.drawing.viewpoint import choose_viewpoint
from symgen.result.player.recording import Recording

if TYPE_CHECKING:
    from PIL import Image

#: Endings of films with the libraries that they need.
FILMS: Mapping[str, tuple[str, ...]] = {".gif": ("matplotlib", "PIL"), ".mp4": ("matplotlib", "PIL")}
#: Largest number of pictures of a GIF and of an MP4, and pictures per second.
MOST, MOST_OF_FILM, RATE = 150, 1500, 25
#: Longest duration of a picture of a GIF [s]; equal pictures are merged.
LONGEST = 655.0
#: Pixels per inch.
DPI = 80.0


def check_film(where: str, path: Path) -> Path:
    """Refuse a film that cannot be written, as `check_path` does, or without ffmpeg for MP4; return it otherwise.

    Raises
    ------
    InputError
        With the expected value.
    """
    if path.suffix.lower() == ".mp4" and shutil.which("ffmpeg") is None:
        raise InputError(where, "the program ffmpeg, which makes films of pictures", "none", "a .gif needs none")
    return check_path(where, path, FILMS, "plot")


def write_film(path: Path, recording: Recording) -> Path:
    """Write a motion as a film at its own pace, as GIF or MP4 by the ending of its name.

    A GIF has at most 150 pictures, an MP4 1500: of longer motions there are fewer a second. A GIF of a motion of more
    than eleven minutes goes faster and lasts as long as one picture can.

    Parameters
    ----------
    path : Path
        The file.
    recording : Recording
        What moves.

    Raises
    ------
    InputError
        If ffmpeg fails.
    """
    span = float(recording.t[-1] - recording.t[0])
    film = path.suffix.lower() == ".mp4"
    count = int(min(MOST_OF_FILM if film else MOST, max(2, round(span * RATE)), len(recording.t)))
    pause = max(20.0, 1000.0 * (span if film else min(span, LONGEST)) / count)
    pictures = _frames_of_film(recording, count)
    if film:
        return write_whole(path, lambda file: file.write(_encode_mp4(pictures, 1000.0 / pause)))
    from PIL import Image

    frames = [picture.convert("P", palette=Image.Palette.ADAPTIVE, colors=64) for picture in pictures]
    # a GIF counts hundredths of a second: pictures last one more or less, so that all together last as long as they are
    ends = np.round(0.1 * pause * np.arange(count + 1))
    pauses = [10 * int(x) for x in np.diff(ends)]

    def write_gif(file: io.BytesIO) -> None:
        frames[0].save(file, format="GIF", save_all=True, append_images=frames[1:], duration=pauses, loop=0)

    return write_whole(path, write_gif)


def _frames_of_film(recording: Recording, count: int) -> Iterator[Image.Image]:
    """Yield pictures of one size, evenly spread over the motion."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg as Canvas
    from matplotlib.figure import Figure
    from PIL import Image

    scene = build_scene(recording.mechanism, recording.q, recording.values)
    view = choose_viewpoint(scene, recording.q[0])
    times = np.linspace(recording.t[0], recording.t[-1], count)
    rows = [recording.q[int(np.argmin(np.abs(recording.t - time)))] for time in times]
    pages = [items_on_paper(scene, row, view) for row in rows]
    everything: list[Drawn] = [each for drawn in pages for each in drawn]
    frame = fit_picture(everything)
    for drawn in pages:
        figure = Figure(dpi=DPI)
        canvas: Any = Canvas(figure)  # its methods have no types
        paint_on_figure(figure, frame, drawn)
        canvas.draw()
        yield Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")


def _encode_mp4(pictures: Iterator[Image.Image], rate: float) -> bytes:
    """Return pictures as MP4; sizes are even, as most players want them."""
    first = next(pictures)
    size = f"{first.width}x{first.height}"
    even = "crop=trunc(iw/2)*2:trunc(ih/2)*2"
    with tempfile.TemporaryDirectory(prefix="symgen-film-") as folder:
        path = Path(folder) / "film.mp4"
        source = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", size, "-r", f"{rate:.6g}", "-i", "-"]
        kind = ["-vf", even, "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-bitexact", str(path)]
        command = ["ffmpeg", "-hide_banner", "-loglevel", "error", "-y", *source, *kind]
        with tempfile.TemporaryFile() as messages:
            process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=messages, stderr=messages)
            assert process.stdin is not None
            with suppress(BrokenPipeError):  # ffmpeg has written its own message
                for picture in itertools.chain([first], pictures):
                    process.stdin.write(picture.tobytes())
            with suppress(BrokenPipeError):
                process.stdin.close()
            if process.wait() or not path.is_file():
                messages.seek(0)
                why = " ".join(messages.read().decode(errors="replace").split())[:200]
                raise InputError("film", "ffmpeg to make an MP4", f"its error: {why or 'none'}")
        return path.read_bytes()
