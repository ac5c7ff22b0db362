"""Pictures of mechanisms for guides, in docs/pictures: small SVG files, the same at each run.

python -m benchmarks.pictures

A test draws them anew and compares.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from benchmarks.kept_pictures import DOCS, PICTURES, put
from symgen.analyses.linear.animation import mode_recording
from symgen.api import Model, load
from symgen.describe.drawing import Drawing
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate
from symgen.study.report.document import Picture


def _leg() -> str:
    return load("jansen-leg").draw().svg


def _path() -> str:
    """Return a driven four-bar with the paths of two points of its coupler over one turn."""
    linkage = load("driven-four-bar")
    motion = linkage.kinematics(np.linspace(0.0, 1.0, 121))
    drawing = Drawing.of_motion(linkage.mechanism, motion.q.values, linkage.parameters())
    centre, flat = np.column_stack([motion["coupler.x"], motion["coupler.y"]]), np.zeros(121)
    paths = [np.column_stack([path, flat]).tolist() for path in (centre, motion.curve("coupler.C"))]
    return replace(drawing, ghosts=(), paths=tuple(tuple((x, y, z) for x, y, z in path) for path in paths)).svg


def _mode() -> str:
    """Return the first mode of a four-bar about its equilibrium: how far it swings to either side."""
    model = load("four-bar")
    modes = model.modes()
    q = mode_recording(model.mechanism, modes, 1).q
    drawing = Drawing.of_mechanism(model.mechanism, [modes.about[name] for name in _coordinates(model)])
    return replace(drawing, ghosts=tuple(tuple(q[k].tolist()) for k in (0, len(q) // 2)), labels=False).svg


def _coordinates(model: Model) -> list[str]:
    return [f"{body.name}.{c}" for body in model.mechanism.bodies for c in body.coordinates]


def _described(page: str, name: str) -> str:
    """Return a mechanism as a page of docs describes it."""
    text = (DOCS / page).read_text(encoding="utf-8")
    match = re.search(rf"```toml\n(\[mechanism\]\nname = \"{name}\".*?)```", text, re.DOTALL)
    assert match is not None, f"{page} describes '{name}'"
    return Model(validate(parse_toml(match[1], page), page)).draw().svg


#: Name of the file -> what draws it.
DRAWN: Mapping[str, Callable[[], str]] = {
    "leg": _leg,
    "coupler-paths": _path,
    "mode": _mode,
    "press": lambda: _described("tutorial.md", "press"),
    "carousel": lambda: _described("tutorial-space.md", "carousel"),
    "groove": lambda: _described("tutorials/own-constraint.md", "groove"),
    "motor": lambda: _described("tutorials/motor-current.md", "motor-and-linkage"),
    "whip": lambda: _described("tutorials/flexible-link.md", "whip"),
    "crane": lambda: _described("tutorials/modes.md", "crane"),
    "swing": lambda: _described("file-format/README.md", "swing"),
    "barrier": lambda: _described("file-format/bodies.md", "barrier"),
    "pump": lambda: _described("file-format/joints.md", "pump"),
    "wheel-on-a-strut": lambda: _described("file-format/forces.md", "wheel-on-a-strut"),
    "cam-and-follower": lambda: _described("file-format/formulas.md", "cam-and-follower"),
    "double-swing": lambda: _described("file-format/runs.md", "double-swing"),
}


def main() -> None:
    """Write all of them."""
    for name, draw in DRAWN.items():
        print(put(Picture(name, "", "", draw().encode(), "svg"), PICTURES))


if __name__ == "__main__":
    main()
