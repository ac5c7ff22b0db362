"""The page of the editor: the player's, with a pane for the text, and nothing from elsewhere."""

from __future__ import annotations

from functools import lru_cache
from html import escape
from importlib.resources import files
from typing import Any

from symgen.base.escapes import script_json
from symgen.describe.edits.section_words import words_of_sections
from symgen.result.player.motion_page import editing_page

SCRIPTS = (
    *("codemirror/codemirror.js", "text.js", "completion.js", "grid.js", "handles.js", "photo.js", "inside.js"),
    *("steering.js", "rates.js", "dimensions.js", "layout.js", "synthesis.js", "file.js", "edit.js"),
)
#: What the player draws before the first text is read: nothing.
EMPTY: dict[str, Any] = {
    **{"title": "", "name": "", "points": [], "names": [], "live": None, "note": ""},
    "scene": {
        **{"spatial": False, "view": [0.0, 0.0], "up": [0.0, 1.0, 0.0], "unit": 1.0},
        **{"frames": [], "looks": [], "lists": [], "items": []},
    },
    "motions": [{"t": "", "q": "", "count": 0, "facts": [], "status": "ok", "groups": [], "moments": []}],
}


def editor_page(name: str, nonce: str) -> tuple[str, str]:
    """Return the page of a file, and the policy under which it runs.

    Parameters
    ----------
    name : str
        Of the file.
    nonce : str
        A word that only scripts and styles of this page have.
    """
    policy = (
        f"default-src 'none'; script-src 'nonce-{nonce}'; style-src 'nonce-{nonce}'; img-src data: blob:; "
        "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    )
    data = {**EMPTY, "editor": {"file": name, "words": words_of_sections()}}
    parts = {
        "PANE": _read_web_part("pane.html").replace("<!--FILE-->", escape(name)),
        "STYLE": _read_web_part("edit.css"),
    }
    script = "".join(_read_web_part(part) for part in SCRIPTS)
    text = editing_page(script_json(data), parts["PANE"], parts["STYLE"], script, nonce)
    return text.replace("<!--TITLE-->", escape(f"{name} - symgen edit")), policy


@lru_cache(maxsize=8)
def _read_web_part(name: str) -> str:
    return files(__package__).joinpath("web", name).read_text(encoding="utf-8")
