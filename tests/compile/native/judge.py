"""Whether emitted functions compiled here are those that Numba compiles; run apart, on a processor that is named.

python -m compile.native.judge four-bar direct-correction
python -m compile.native.judge four-bar direct-correction --lanes
"""

import sys
import tempfile
from pathlib import Path

from support.emitted import mechanism_of
from support.models import EVERYTHING, ROUGH

from symgen.api import load
from symgen.base.ir.program import LANES
from symgen.derive.methods import METHODS
from symgen.derive.methods._base import EXPLICIT_FORMS
from symgen.describe.mechanism import Mechanism
from symgen.run.compiling.method_choice import MethodChoice, choose_method
from symgen.run.compiling.pipeline import generate

from .twofold import ARRAY, NUMBER, arguments_of, differences, load_twice, own_functions

OWN = {"everything": EVERYTHING, "rough": ROUGH}


def mechanism(model: str) -> Mechanism:
    """Return a mechanism of the tests or of the catalogue."""
    return mechanism_of(OWN[model]) if model in OWN else load(model).mechanism


def choices(methods: tuple[str, ...]) -> tuple[MethodChoice, ...]:
    """Return methods with every value of their options and in both forms."""
    found: dict[str, MethodChoice] = {}
    for name in methods:
        method = METHODS.get(name)
        variants = [{option.name: value} for option in method.options for value in option.values]
        explicit = EXPLICIT_FORMS & set(method.forms)
        for choice in [choose_method(name, options) for options in ({}, *variants)] if explicit else []:
            found[choice.stem] = choice
        if set(method.forms) - EXPLICIT_FORMS:
            choice = choose_method(name, None, implicit=True)
            found[choice.stem] = choice
    return tuple(found.values())


def judged(folder: Path, model: str, methods: tuple[str, ...], lanes: bool = False) -> list[str]:
    """Emit modules and return what differs in any of their functions, each distinct one tried once."""
    chosen = tuple(map(choose_method, methods)) if lanes else choices(methods)
    generated = generate(mechanism(model), chosen, target="lanes" if lanes else "cpu")
    folder = folder / generated.folder
    folder.mkdir()
    for stem, (source, _) in generated.modules.items():
        (folder / f"{stem}.py").write_text(source, encoding="utf-8")
    laws = [metadata for stem, (_, metadata) in generated.modules.items() if "nw" in metadata]
    if lanes:
        return judged_in_lanes(folder, list(generated.modules))
    size = 100 + max(max(m["nw"], m["parameter_offset"] + m["hoisted"], len(m["tangent"])) for m in laws)
    found, seen = [], set[str]()
    for stem in generated.modules:
        direct, plain = load_twice(folder / f"{stem}.py")
        for name in own_functions(direct):
            function = getattr(direct, name)
            code = function.py_func.__code__
            key = f"{name} {code.co_code.hex()} {code.co_consts} {code.co_names}"
            if key not in seen:
                seen.add(key)
                by_numba = getattr(plain, name)
                found += [f"{stem}: {d}" for d in differences(function, by_numba, arguments_of(function), size)]
    assert len(seen) > 9, "nothing was judged"
    return found


def judged_in_lanes(folder: Path, stems: list[str]) -> list[str]:
    """Return what differs in the functions that loops over lanes call; all others stand in them."""
    found, names = [], set[str]()
    for stem in stems:
        direct, plain = load_twice(folder / f"{stem}.py")
        for name in {"rhs", "accept"} & set(own_functions(direct)):
            names.add(name)
            size = LANES * direct.NUMBERS
            found += [
                f"{stem}: {d}" for d in differences(getattr(direct, name), getattr(plain, name), (NUMBER, ARRAY), size)
            ]
    assert len(names) == 2, "nothing was judged"
    return found


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as made:
        lanes = "--lanes" in sys.argv
        methods = tuple(word for word in sys.argv[2:] if word != "--lanes")
        print(*judged(Path(made), sys.argv[1], methods, lanes), sep="\n")
