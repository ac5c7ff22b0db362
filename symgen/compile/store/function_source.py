"""Sources of functions: the syntax tree of each as its file had it when it was loaded."""

from __future__ import annotations

import ast
import functools
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from symgen.compile.store.identity import combined_digest, file_content, file_digest

if TYPE_CHECKING:
    pass


def syntax_tree(lines: Sequence[str], function: Any) -> ast.FunctionDef | None:
    """Return the syntax tree of a function that begins in the first column, or None.

    Parameters
    ----------
    lines : sequence of str
        Of its file.
    function : function
        The function loaded from there.
    """
    first = function.__code__.co_firstlineno - 1  # of its decorators, if any
    begin = next((i for i in range(first, len(lines)) if lines[i].startswith("def ")), len(lines))
    rest = range(begin + 1, len(lines))
    end = next((i for i in rest if lines[i][:1].strip() and not lines[i].startswith(")")), len(lines))
    try:
        statements = ast.parse("\n".join(lines[first:end])).body
    except SyntaxError:
        return None
    return statements[0] if len(statements) == 1 and isinstance(statements[0], ast.FunctionDef) else None


@functools.lru_cache(maxsize=64)
def lines_when_loaded(file: str) -> tuple[str, ...]:
    """Return the lines of a file, none of one that has been edited since it was loaded."""
    text = file_content(file)
    return tuple(text.decode().split("\n")) if combined_digest(text) == file_digest(file) else ()
