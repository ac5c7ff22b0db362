"""The moving picture of the player's page, docs/pictures/four-bar-moving.svg: a driven four-bar over one turn.

python -m benchmarks.moving_picture

Bodies move by CSS, which needs no script and stands still for readers who prefer that. A test draws the picture anew.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from benchmarks.kept_pictures import PICTURES
from symgen.api import load
from symgen.describe.drawing.scene import COLOURS

NAME = "four-bar-moving"
#: Positions over one turn, seconds a turn, pixels a metre, pixels of the ground's origin.
FRAMES, TURN, SCALE, ORIGIN = 60, 4.0, 26.0, (70.0, 176.0)
WIDTH, HEIGHT = 400, 222
#: A point of the coupler beside its line [m].
MARK = (0.0, 2.4)
#: Half lengths of the bodies [m].
LENGTHS = {"crank": 1.0, "coupler": 4.0, "rocker": 2.5}

STYLE = f"""
.body {{ stroke-width: 11; stroke-linecap: round; stroke-linejoin: round; animation: {TURN:g}s linear infinite }}
.pin {{ fill: #fff; stroke: #333; stroke-width: 2 }}
.ground {{ fill: none; stroke: #333; stroke-width: 2 }}
.path {{ fill: none; stroke: {COLOURS[3]}; stroke-width: 1.5; stroke-dasharray: 4 3 }}
@media (prefers-color-scheme: dark) {{ .pin {{ fill: #0d1117 }} .pin, .ground {{ stroke: #c9d1d9 }} }}
@media (prefers-reduced-motion: reduce) {{ .body {{ animation-play-state: paused }} }}
"""


def draw() -> str:
    """Return the picture as SVG."""
    motion = load("driven-four-bar").kinematics(np.linspace(0.0, 1.0, FRAMES + 1))
    assert motion.ok, motion.ended
    keyframes, bodies = [], []
    for (name, half), colour in zip(LENGTHS.items(), COLOURS, strict=False):
        x, y, theta = (motion[f"{name}.{coordinate}"] for coordinate in ("x", "y", "theta"))
        places = zip(ORIGIN[0] + SCALE * x, ORIGIN[1] - SCALE * y, -np.degrees(theta), strict=True)
        steps = "".join(
            f"{100 * k / FRAMES:.4g}%{{transform:translate({px:.1f}px,{py:.1f}px)rotate({turn:.1f}deg)}}"
            for k, (px, py, turn) in enumerate(places)
        )
        keyframes.append(f"@keyframes {name}{{{steps}}}")
        end, apex = SCALE * half, f"L{SCALE * MARK[0]:g} {-SCALE * MARK[1]:g}" if name == "coupler" else ""
        shape = f"M{-end:g} 0L{end:g} 0{apex}{'Z' if apex else ''}"
        fill = f'fill="{colour}" fill-opacity=".35"' if apex else 'fill="none"'
        pins = "".join(f'<circle class="pin" r="5" cx="{sign * end:g}"/>' for sign in (-1, 1))
        bodies.append(
            f'<g class="body" style="animation-name:{name}"><path d="{shape}" stroke="{colour}" {fill}/>{pins}</g>'
        )
    ground = "".join(_support(x) for x in (0.0, 10.0))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}">\n'
        f"<title>A four-bar linkage at work</title>\n<style>{STYLE}{chr(10).join(keyframes)}\n</style>\n"
        f'<path class="path" d="{_path(motion["coupler.x"], motion["coupler.y"], motion["coupler.theta"])}"/>\n'
        f"{ground}\n{chr(10).join(bodies)}\n</svg>\n"
    )


def _path(x: NDArray[np.float64], y: NDArray[np.float64], theta: NDArray[np.float64]) -> str:
    """Return the path of the mark."""
    px = x + np.cos(theta) * MARK[0] - np.sin(theta) * MARK[1]
    py = y + np.sin(theta) * MARK[0] + np.cos(theta) * MARK[1]
    points = zip(ORIGIN[0] + SCALE * px, ORIGIN[1] - SCALE * py, strict=True)
    return "M" + "L".join(f"{a:.1f} {b:.1f}" for a, b in points) + "Z"


def _support(x: float) -> str:
    """Return a fixed pivot: a triangle on hatched ground."""
    left, top = ORIGIN[0] + SCALE * x, ORIGIN[1]
    strokes = "".join(f"M{left + d:g} {top + 24:g}l-6 8" for d in (-12, -4, 4, 12, 20))
    return f'<path class="ground" d="M{left:g} {top:g}l-13 24h26zM{left - 20:g} {top + 24:g}h40{strokes}"/>'


def main() -> None:
    """Write it."""
    path = PICTURES / f"{NAME}.svg"
    path.write_text(draw(), encoding="utf-8")
    print(path)


if __name__ == "__main__":
    main()
