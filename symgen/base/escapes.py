"""Text of files, methods and options in whatever symgen writes: one function for each kind of place.

HTML, SVG and XML have `html.escape` and its twin in Jinja2.
"""

from __future__ import annotations

import json
import re

#: Maximum length of a text in a comment.
LONGEST = 200
_IN_COMMENTS = str.maketrans('"\\', "'/")
#: What begins or ends a comment in C and JavaScript.
_ENDS = re.compile(r"(?<=\*)(?=/)|(?<=/)(?=\*)")

#: What Markdown takes for more than text: emphasis, code, tags, entities, links, the columns of a table, and marks at
#: the beginning of a line. Underscores inside words, brackets that no address follows, and numbers that no space
#: follows, are text.
_MARKED = re.compile(
    r"[\\`*<|~$]|&(?=\w+;|#)|(?<![^\W_])_|_(?![^\W_])|\[(?=[^\]]*\]\s*[(\[:])|\](?=\s*[(\[:])"
    r"|^(?:#{1,6}(?=\s|$)|>|\+(?=\s|$)|-(?=[\s-]|$)|\d+(?=[.)](?:\s|$)))",
    re.MULTILINE,
)

_IN_LATEX = {
    **{"\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}"},
    **{c: "\\" + c for c in "_&%$#"},
}


def printable(text: str) -> str:
    """Return a text for terminals: on one line, with escapes for characters that they would act on or not show."""
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


def comment_text(text: object) -> str:
    """Return a text for comments and docstrings of emitted code: it cannot end them, nor be read as an escape.

    Line ends and unprintable characters become spaces, double quotes single ones, backslashes slashes, and a space
    separates the two characters that begin or end a comment.

    Parameters
    ----------
    text : object
        Text from a file, a method or an option.
    """
    words = str(text)[: LONGEST + 1].translate(_IN_COMMENTS)
    if not words.isprintable():
        words = "".join(c if c.isprintable() else " " for c in words)
    if "*/" in words or "/*" in words:
        words = _ENDS.sub(" ", words)
    return words if len(words) <= LONGEST else words[: LONGEST - 3] + "..."


def markdown_text(text: str) -> str:
    """Return a text for a line of Markdown."""
    line = printable(" ".join(text.split()))
    return _MARKED.sub(lambda mark: f"\\{mark[0]}" if not mark[0].isdigit() else f"{mark[0]}\\", line)


def latex_text(text: str) -> str:
    """Return a text for LaTeX."""
    return "".join(_IN_LATEX.get(c, c if c.isprintable() and ord(c) < 128 else f"[U+{ord(c):04X}]") for c in text)


def script_json(data: object) -> str:
    """Return data as JSON for scripts: it cannot end the element that holds it."""
    text = json.dumps(data, separators=(",", ":"), allow_nan=False, ensure_ascii=False)
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")
