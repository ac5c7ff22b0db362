"""Names of folders of emitted code in the cache, from the digest of everything that shapes this code."""

from __future__ import annotations

from functools import lru_cache
from importlib.util import find_spec
from pathlib import Path

from symgen.base.ir.program import FORMAT
from symgen.compile.store.entries import folder_name
from symgen.compile.store.identity import combined_digest
from symgen.compile.store.sources import CODE, reached_digest
from symgen.describe.facts.digest import digest as mechanism_digest
from symgen.describe.mechanism import Mechanism


def folder_of(mechanism: Mechanism) -> str:
    """Return the name of the folder that holds all straight code of `mechanism`; needs no SymPy."""
    text = f"{mechanism_digest(mechanism)} {generator_digest()}"
    return folder_name(mechanism.name, combined_digest(text), FORMAT)


def shared_folder() -> str:
    """Return the name of the folder of looped code, which all mechanisms share."""
    return folder_name("looped", generator_digest(), FORMAT)


@lru_cache(maxsize=1)
def generator_digest() -> str:
    """Return the digest of everything that shapes emitted code: sources, templates and SymPy's version."""
    return combined_digest(_sympy_version(), reached_digest(*CODE))


def _sympy_version() -> str:
    """Return SymPy's version without the import of SymPy, which costs more than a whole warm run."""
    spec = find_spec("sympy")
    if spec is None or spec.origin is None:
        return "absent"
    return (Path(spec.origin).parent / "release.py").read_text(encoding="utf-8").split('"')[1]
