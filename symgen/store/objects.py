"""Object files that are made of text in LLVM's language: kept in the cache, and made where it does not have them."""

from __future__ import annotations

from symgen.native.machine import compiled, processor
from symgen.store import private
from symgen.store.identity import digest
from symgen.store.machine_code import environment, plain_name
from symgen.store.paths import cache_location
from symgen.store.upkeep import NATIVE


def made(text: str, symbol: str) -> bytes:
    """Return the object file of a module in LLVM's language.

    Parameters
    ----------
    text : str
        The module; everything of it that matters on this processor.
    symbol : str
        Its function.
    """
    key = "\n".join((text, processor(), environment()))
    place = cache_location()
    path = place.path / NATIVE / plain_name(symbol.rpartition(".")[0], 100) / f"{digest(key)[:32]}{private.SUFFIX}"
    known = private.read(path, key)
    if known is None:
        known = compiled(text, symbol)
        if place.persistent:
            private.write(path, key, known)
    return known
