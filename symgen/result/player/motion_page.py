"""From a recording to its page: one HTML file with style, script and data inside, which loads nothing else."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import astuple, dataclass
from functools import lru_cache
from html import escape
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from symgen.base.arguments import path_argument as argument_path
from symgen.base.escapes import script_json
from symgen.base.files import check_path, write_whole
from symgen.base.locales import local_signs
from symgen.compile.native.javascript_code import ADDRESSED, INDEX_TABLES
from symgen.describe.drawing.mechanism_scene import build_scene
from symgen.describe.drawing.paper import View
from symgen.describe.drawing.scene import (
    Array,
    Bent,
    DrawnCircle,
    Line,
    Look,
    Mark,
    Point,
    Scene,
    Side,
    Solid,
    Stretch,
    Tube,
)
from symgen.describe.drawing.traced import traced_points
from symgen.describe.drawing.viewpoint import choose_viewpoint
from symgen.result.player.live import Live
from symgen.result.player.recording import (
    Recording,
    drop_further,
    encode_shorts,
    fit_further,
    frames_within,
    is_coarse,
    pack_recording,
)

#: The ending of pages, which need no library.
PAGES: Mapping[str, tuple[str, ...]] = {".html": ()}
#: Characters for the data of motions in the plane and in space; a large mechanism has more, for its fewest frames.
MOST_DATA = {False: 100_000, True: 180_000}
#: Further characters for plots of optional quantities.
MOST_PLOTS = {False: 400_000, True: 600_000}
_OWN = (
    *(
        "palette.js",
        "touch.js",
        "draw.js",
        "plots.js",
        "motions.js",
        "pick.js",
        "shown.js",
        "time.js",
        "live_motion.js",
    ),
    *("sliders.js", "pull.js", "controls.js", "player.js"),
)
#: Parts of the script, in their order.
SCRIPTS = {False: _OWN, True: ("solid.js", *_OWN)}


@lru_cache(maxsize=8)
def _read_web_part(name: str) -> str:
    """Return a part of the page."""
    text = (Path(__file__).parent / "web" / name).read_text(encoding="utf-8")
    if not name.endswith(".js"):
        return text
    # comments and indentation serve readers of the sources only
    lines = (line.strip() for line in text.splitlines())
    return "".join(f"{line}\n" for line in lines if line and not line.startswith("//"))


def motion_page(
    recording: Recording, live: Live | None = None, note: str = "", second: Recording | None = None
) -> Page:
    """Return the page of a motion.

    Parameters
    ----------
    recording : Recording
        What moves.
    live : Live, optional
        Simulation of other motions in the page.
    note : str
        Reason why `live` is missing.
    second : Recording, optional
        Another motion of the same mechanism, drawn faintly behind.
    """
    spatial = recording.mechanism.space == "spatial"
    data = page_data(recording, live, note, second)
    text = _read_web_part("page.html")
    script = _page_script(live, spatial)
    parts = {
        "TITLE": escape(data["title"]),
        "STYLE": _read_web_part("style.css"),
        "DATA": script_json(data),
        "SCRIPT": script,
    }
    for name, part in parts.items():
        text = text.replace(f"<!--{name}-->", part, 1) if name != "TITLE" else text.replace("<!--TITLE-->", part)
    return Page(text, recording.mechanism.name, live is not None)


def page_data(
    recording: Recording,
    live: Live | None = None,
    note: str = "",
    second: Recording | None = None,
    open_joints: Sequence[str] = (),
    gaps: bool = True,
) -> dict[str, Any]:
    """Return what the script of a page draws, for JSON.

    Parameters
    ----------
    recording : Recording
        What moves.
    live : Live, optional
        Simulation of other motions in the page.
    note : str
        Reason why `live` is missing.
    second : Recording, optional
        Another motion of the same mechanism, drawn faintly behind.
    open_joints : sequence of str
        Joints that are marked as open.
    gaps : bool
        Whether gaps of pins are told; the page measures them from positions of 32 bits otherwise.
    """
    spatial = recording.mechanism.space == "spatial"
    scene = build_scene(recording.mechanism, recording.q, recording.values, open_joints)
    data: dict[str, Any] = {
        "title": recording.mechanism.title or recording.mechanism.name,
        "name": recording.mechanism.name,
        "scene": scene_data(scene, choose_viewpoint(scene, recording.q[0])),
        "points": _traced_points(recording),
        "names": [f"{b.name}.{c}" for b in recording.mechanism.bodies for c in b.coordinates],
        "live": None if live is None else live.spec,
        "note": note,
    }
    if (signs := local_signs()) is not None:
        data["locale"] = signs
    motions = [recording] if second is None else [recording, second]
    share = MOST_DATA[spatial] // len(motions)
    pins = scene.pins
    data["motions"] = []
    for each in motions:
        played = drop_further(each)
        coarse = is_coarse(played, share, len(pins))
        keep = frames_within(played, share, coarse, len(pins))
        shown, missing = fit_further(each, len(keep), MOST_PLOTS[spatial] // len(motions))
        if missing:
            words = f"no plots of {', '.join(dict.fromkeys(missing))}: the page would be too large"
            data["note"] = "; ".join(dict.fromkeys([*filter(None, [data["note"]]), words]))
        data["motions"].append(
            pack_recording(shown, keep, coarse) | (_gap_exponents(scene, each.q[keep]) if gaps else {})
        )
    return data


def _gap_exponents(scene: Scene, q: Array) -> dict[str, Any]:
    """Return the gaps of pins as powers of ten: positions of 32 bits would hide them."""
    if not scene.pins:
        return {}
    gaps = np.array([scene.gaps(row) for row in q])
    return {"gaps": {"names": [item.name for item in scene.pins], **encode_shorts(np.log10(np.maximum(gaps, 1e-17)))}}


#: The policy in the file of pages, which load nothing.
_POLICY = re.compile(r"<meta http-equiv=\"Content-Security-Policy\"[^>]*>\n")


def editing_page(data: str, pane: str, style: str, script: str, nonce: str) -> str:
    """Return a page of the player that shows one motion after the other, beside a pane that decides which.

    Parameters
    ----------
    data : str
        What it begins with, as JSON for scripts.
    pane, style, script : str
        The pane, and what it adds to the player's style and script, which it can call.
    nonce : str
        The word by which the policy of its server knows styles and scripts of the page.
    """
    text, own = _POLICY.sub("", _read_web_part("page.html")), "".join(_read_web_part(name) for name in SCRIPTS[True])
    nothing = "const emitted = null, makeLive = null, observed = null;"
    text = text.replace("<style>", f'<style nonce="{nonce}">').replace("<script>", f'<script nonce="{nonce}">')
    text = text.replace("<body>\n", f'<body class="editing">\n{pane}')
    parts = {
        "STYLE": _read_web_part("style.css") + style,
        "DATA": data,
        "SCRIPT": f"(() => {{\n'use strict';\n{nothing}\n{own}{script}}})();",
    }
    for name, part in parts.items():
        text = text.replace(f"<!--{name}-->", part, 1)
    return text


def live_script(live: Live) -> str:
    """Return a function's body that returns what a page works out other motions with."""
    columns = f"const observed = {live.columns};\n{_read_web_part('columns.js')}"
    return f"'use strict';\n{model_script(live)}{columns}return {{ emitted, makeLive, observed, makeColumns }};"


def _page_script(live: Live | None, spatial: bool) -> str:
    own = "".join(_read_web_part(name) for name in SCRIPTS[spatial])
    if live is None:
        return f"(() => {{\n'use strict';\nconst emitted = null, makeLive = null, observed = null;\n{own}}})();"
    observed = f"const observed = {live.columns};\n{_read_web_part('columns.js')}"
    return f"(() => {{\n'use strict';\n{model_script(live)}{observed}{own}}})();"


#: What emitted code of a page defines beside functions; code of columns reads the last two.
_CONSTANTS = "newMemory", INDEX_TABLES, ADDRESSED


def _emitted_object(live: Live, functions: str, *further: str) -> str:
    """Return emitted code as an object of the functions that it has, and what evaluates them.

    The code is a function's body, so that none of its names is one of the page's.
    """
    names = [n for n in functions.split() if f"function {n}(" in live.code]
    names += [n for n in _CONSTANTS if f"const {n} =" in live.code]
    given = f"return {{ {', '.join([*names, *further])} }};"
    return f"const emitted = (() => {{\n{live.code}{given}\n}})();\n{_read_web_part('rates.js')}"


def model_script(live: Live) -> str:
    """Return a script that defines ``emitted``, the functions of a mechanism, and ``makeLive``, which runs them."""
    functions = "rhs accept geometry masses prepareModel prepareLaw derive describe confirm move bodies"
    functions += " begin_row close_row take_steps start_run foresee_run advance_run find_lock"
    return f"{_emitted_object(live, functions)}{_read_web_part('live.js')}"


def rates_script(live: Live) -> str:
    """Return a script that is a function: the rates of a state, given time, state and parameters."""
    code = _emitted_object(live, "confirm rhs masses prepareModel prepareLaw", "derive: () => {}")
    return f"(() => {{\n'use strict';\n{code}return makeRates({script_json(live.spec)}, emitted).rates;\n}})()"


def scene_data(scene: Scene, view: View) -> dict[str, Any]:
    """Return a scene and its view for JSON: marks by letters, looks by number, points to 1/200 of a symbol."""
    looks: dict[Look, int] = {}
    size = 3 if scene.spatial else 2
    grid = 10.0 ** math.floor(math.log10(scene.unit / 200.0))

    def rounded_point(p: Sequence[float]) -> list[float]:
        near = [float(f"{round(x / grid) * grid:.9g}") for x in p[:size]]
        return [int(x) if x == int(x) else x for x in near]

    shared: dict[tuple[float, ...], int] = {}

    def number_of_points(points: Sequence[Point]) -> int:
        """Return the number of a list of points; bodies that look alike share theirs."""
        return shared.setdefault(tuple(x for p in points for x in rounded_point(p)), len(shared))

    def mark_data(m: Mark) -> list[Any]:
        look = looks.setdefault(m.look, len(looks))
        if isinstance(m, Line):
            kind = [int(m.guide), 1] if m.in_pieces else [1] if m.guide else []
            return ["L", look, m.body, int(m.closed), number_of_points(m.points), *kind]
        if isinstance(m, DrawnCircle):
            return ["D", look, m.body, rounded_point(m.at), float(f"{m.radius:.6g}"), int(m.mass)]
        if isinstance(m, Tube):
            return ["T", look, m.body, rounded_point(m.a), rounded_point(m.b), float(f"{m.radius:.6g}")]
        if isinstance(m, Solid):
            return ["S", look, m.body, [number_of_points(face) for face in m.faces]]
        assert isinstance(m, Stretch), "all kinds of marks are known"
        return ["X", look, m.kind, m.body, rounded_point(m.at), m.other, rounded_point(m.to)]

    def side_data(s: Side) -> list[Any]:
        return [s.body, number_of_points(s.points), float(f"{s.radius:.6g}"), int(s.whole)]

    items = [
        {
            "role": item.role,
            "name": item.name,
            "kind": item.kind,
            "marks": [mark_data(m) for m in item.marks],
            "ends": [[body, rounded_point(at)] for body, at in item.ends],
            **({} if item.label is None else {"label": [item.label[0], rounded_point(item.label[1])]}),
            **({"sides": [list(map(side_data, side)) for side in item.sides]} if item.sides else {}),
        }
        for item in scene.items
    ]
    return {
        "spatial": scene.spatial,
        "view": [round(view.turn, 3), round(view.tilt, 3)],
        "up": list(scene.up),
        "unit": scene.unit,
        "frames": [
            [frame.name, frame.first, frame.size, *([] if frame.bent is None else [_bent_data(frame.bent)])]
            for frame in scene.frames
        ],
        **({"carried": [[c.body, rounded_point(c.at), c.turned] for c in scene.carried]} if scene.carried else {}),
        "looks": [list(astuple(look)) for look in looks],
        "lists": [list(points) for points in shared],
        "items": items,
    }


def _bent_data(bent: Bent) -> list[Any]:
    """Return what a page needs of a frame that modes move: host, first mode, place, shape and turn of each mode."""
    motions = [[[float(f"{x:.5g}") for x in part] for part in parts] for parts in (bent.shape, bent.turn)]
    return [bent.host, bent.first, [float(f"{x:.6g}") for x in bent.place], *motions]


def _traced_points(recording: Recording) -> list[list[Any]]:
    """Return the points whose traces a page can draw."""
    size = 3 if recording.mechanism.space == "spatial" else 2
    return [
        [p.name, p.body, [float(f"{x:.6g}") for x in p.at[:size]], *([1] if p.free else [])]
        for p in traced_points(recording.mechanism, recording.values)
    ]


@dataclass(frozen=True, repr=False)
class Page:
    """A page: shown by notebooks in a frame of its own, saved as one file.

    Attributes
    ----------
    html : str
        The whole file.
    name : str
        Of the mechanism.
    live : bool
        Whether it simulates other motions itself.
    """

    html: str
    name: str
    live: bool

    def save(self, path: str | PathLike[str]) -> Path:
        """Write the page to a ``.html`` file, whole or not at all.

        Raises
        ------
        InputError
            If the ending is another one or the file cannot be written.
        """
        return write_whole(check_path("view", argument_path("path", path), PAGES, "plot"), self.html)

    def _repr_html_(self) -> str:
        return f'<iframe srcdoc="{escape(self.html, quote=True)}" style="width:100%;height:640px;border:0"></iframe>'

    def __repr__(self) -> str:
        part = "with" if self.live else "without"
        return f"<Page of {self.name}: {len(self.html)} characters, {part} live part>"
