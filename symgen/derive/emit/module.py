"""Modules of emitted code: printed functions with their needs, and the imports and constants that follow."""

from __future__ import annotations

import hashlib
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from functools import lru_cache
from textwrap import fill
from typing import Any, NamedTuple

import jinja2

from symgen.base.escapes import comment_text, markdown_text
from symgen.base.files import templates_folder


class Platform(NamedTuple):
    """The parts of every module that depend on the target.

    Attributes
    ----------
    decorator : str
        Line before every emitted function. On CUDA, Numba's defaults are the options used elsewhere: divisions by 0
        give infinity, multiply-add may be contracted, nothing else is fast or inexact.
    numba : str
        Import from Numba.
    words : str
        Its description in docstrings.
    """

    decorator: str
    numba: str
    words: str


#: By the target; code for lanes is code for processors.
PLATFORMS = {
    "cpu": Platform('@njit(error_model="numpy", fastmath={"contract"})', "njit", ""),
    "cuda": Platform("@cuda.jit(device=True)", "cuda", ", for CUDA"),
}

LIBRARIES = frozenset(("math", "numpy"))


@dataclass(frozen=True)
class ModulePiece:
    """A piece of a module: a function, or a table with its functions.

    Parameters
    ----------
    name, text : str
        Its name and source.
    calls : frozenset of str
        Emitted functions and constants in it.
    sections : frozenset of str
        Sections of ``w`` whose offsets it uses.
    libraries : frozenset of str
        ``math`` and ``numpy`` where it uses them.
    also : tuple of str
        Further names that it defines.
    """

    name: str
    text: str
    calls: frozenset[str] = frozenset()
    sections: frozenset[str] = frozenset()
    libraries: frozenset[str] = frozenset()
    also: tuple[str, ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        """All names that it defines."""
        return self.name, *self.also


@lru_cache(maxsize=1)
def _jinja_environment() -> jinja2.Environment:
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(templates_folder()),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
        finalize=lambda value: python_number(value) if isinstance(value, float) else value,
    )
    environment.filters |= {"comment": comment_text, "markdown": markdown_text}
    return environment


def python_number(value: float) -> str:
    """Return a number as Python text, with short exponents such as 1e4."""
    _, digits, exponent = Decimal(repr(value)).normalize().as_tuple()
    short = f"{digits[0]}e{exponent}" if len(digits) == 1 and value > 0.0 else repr(value)
    return min(repr(value), short, key=len)


def render_template(template: str, values: Mapping[str, Any]) -> str:
    """Render a template.

    Raises
    ------
    jinja2.UndefinedError
        If a value of the template is missing.
    """
    return _jinja_environment().get_template(template).render(values)


@lru_cache(maxsize=1)
def templates_digest() -> str:
    """Return the digest of the templates of code for one mechanism, for the emitted header.

    The templates of curves, which few mechanisms have, are left out.
    """
    digest = hashlib.sha256()
    for path in sorted((templates_folder() / "parts").glob("*.j2")):
        digest.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:16]


def function_source(
    name: str,
    arguments: str,
    purpose: str,
    body: Iterable[str],
    decorator: str = PLATFORMS["cpu"].decorator,
    *,
    calls: Iterable[str] = (),
    sections: Iterable[str] = (),
) -> ModulePiece:
    """Return a function; its purpose may come from anywhere, and `calls` may name libraries and their functions."""
    first, *more = [comment_text(line) for line in capitalise(purpose).split("\n")]
    document = [f'"""{first}', *more, '"""'] if more else [f'"""{first}"""']
    lines = [f"    {line}" if line else "" for line in (*document, *body)]
    text = "\n".join([decorator, f"def {name}({arguments}):", *lines])
    libraries = frozenset(call.partition(".")[0] for call in calls) & LIBRARIES
    emitted = frozenset(call for call in calls if call.partition(".")[0] not in LIBRARIES)
    return ModulePiece(name, text, emitted, frozenset(sections), libraries)


def capitalise(text: str) -> str:
    """Return a text with a capital first letter, unless it begins with a symbol such as v'."""
    return text[0].upper() + text[1:] if text[:2].isalpha() else text


def _import_list(names: Sequence[str]) -> str:
    """Return names for an import, in brackets where they take more than a line."""
    text = ", ".join(names)
    return text if len(text) < 100 else f"(\n{fill(text, 110, initial_indent='    ', subsequent_indent='    ')},\n)"


#: Source of each name that a module does not define itself: the stem of a sibling, and the name there.
Origins = Mapping[str, tuple[str, str]]


def module_source(
    title: str,
    header: Sequence[str],
    codes: Sequence[ModulePiece],
    origins: Origins,
    offsets: Mapping[str, tuple[int, str]],
    numba: str = "njit",
    exports: Collection[str] = (),
) -> str:
    """Return the source of a module.

    Parameters
    ----------
    title : str
        First line of its docstring.
    header : sequence of str
        Further lines.
    codes : sequence of ModulePiece
        Its definitions, in this order.
    origins : mapping of str to (str, str)
        Names that other modules of the folder define; those that are called are imported.
    offsets : mapping of str to (int, str)
        Number and meaning of constants in the pieces: usually where sections of ``w`` begin.
    numba : {"njit", "cuda"}
        What is imported from Numba.
    exports : collection of str
        Names that are imported for others.
    """
    own = {name for code in codes for name in code.names}
    called = frozenset[str]().union(exports, *(code.calls for code in codes)) - own
    imports: dict[str, list[str]] = {}
    for name in sorted(called):
        stem, there = origins[name]
        imports.setdefault(stem, []).append(name if there == name else f"{there} as {name}")
    sections = frozenset[str]().union(*(code.sections for code in codes))
    libraries = frozenset[str]().union(*(code.libraries for code in codes))
    values = {
        "title": comment_text(title),
        "header": [comment_text(line) for line in header],
        "libraries": libraries,
        "numba": numba if codes else "",
        "imports": {stem: _import_list(names) for stem, names in sorted(imports.items())},
        "constants": [(name.upper(), *offset) for name, offset in offsets.items() if name in sections],
        "codes": codes,
        "exports": sorted(exports),
    }
    return render_template("parts/module.j2", values)
