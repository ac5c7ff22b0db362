"""Short runs of looped code to the last bit; run apart, by the compiler that the environment names.

python -m native.looped pendulum lagrange rk4 four-bar ggl radau5

A first word ``-NAME,NAME`` names emitted functions that are left to Numba.
"""

from __future__ import annotations

import sys
from types import ModuleType

from support.emitted import mechanism_of
from support.models import EVERYTHING, ROUGH

from symgen.api import Model
from symgen.api import load as load_named
from symgen.native.library import Library
from symgen.native.read import Foreign
from symgen.store.emitted import EmittedFunction

from .loops import digest_of

OWN = {"everything": EVERYTHING, "rough": ROUGH}


def load(model: str) -> Model:
    """Return a model of the tests or of the catalogue."""
    return load_named(mechanism_of(OWN[model])) if model in OWN else load_named(model)


def leave(names: set[str]) -> None:
    """Have functions compiled by Numba."""
    read = EmittedFunction.read

    def refuse(function, kinds):
        if function.__name__ in names:
            raise Foreign("left to Numba")
        return read(function, kinds)

    EmittedFunction.read = refuse  # what calls them reads them too, and calls what Numba has compiled


def by_numba() -> set[str]:
    """Return the names of emitted functions of looped code that were compiled, or loaded, as Numba's."""
    emitted = [
        m for name, m in sys.modules.items() if isinstance(m, ModuleType) and name.startswith("symgen_generated")
    ]
    return {
        name
        for module in emitted
        for name, function in vars(module).items()
        for made in getattr(function, "overloads", {}).values()
        if not isinstance(made.library, Library)
    }


if __name__ == "__main__":
    words = sys.argv[1:]
    if words[0].startswith("-"):
        leave(set(words.pop(0)[1:].split(",")))
    for i in range(0, len(words), 3):
        print(*words[i : i + 3], digest_of(load(words[i]), *words[i + 1 : i + 3], shape="looped"))
    print(",".join(sorted(by_numba())) or "all from the source", file=sys.stderr)
