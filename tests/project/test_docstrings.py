"""Docstrings say what a thing is: few pronouns for nouns, none in the first line."""

import ast
import re
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[2] / "symgen"
_PRONOUN = re.compile(r"\b(?:that|those) of\b", re.IGNORECASE)
_DOCUMENTED = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)


def pronouns(source: str) -> list[str]:
    """Return the docstrings with "that of" or "those of" in their first line, or more than once."""
    texts = (ast.get_docstring(node) for node in ast.walk(ast.parse(source)) if isinstance(node, _DOCUMENTED))
    return [x for x in texts if x and (_PRONOUN.search(x.split("\n", 1)[0]) or len(_PRONOUN.findall(x)) > 1)]


@pytest.mark.parametrize("room", sorted(path.name for path in PACKAGE.iterdir() if (path / "__init__.py").exists()))
def test_docstrings_name_their_nouns(room: str) -> None:
    sources = {path: path.read_text(encoding="utf-8") for path in (PACKAGE / room).rglob("*.py")}
    unclear = {path.relative_to(PACKAGE).as_posix(): texts for path, x in sources.items() if (texts := pronouns(x))}
    assert not unclear


def test_pronouns_are_noticed() -> None:
    first, twice, once = "Return that of a row.", "A row.\n\nThose of it and that of it.", "A row.\n\nThat of it."
    assert pronouns(f'def f():\n    """{first}"""\n\ndef g():\n    """{twice}"""\n\ndef h():\n    """{once}"""\n') == [
        first,
        twice,
    ]
