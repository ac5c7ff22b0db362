"""Emitted modules whose text is held: which mechanisms, methods, shapes and targets, and what is shown of them."""

import re
from collections.abc import Callable, Mapping
from functools import cache, partial
from pathlib import Path

from symgen.api import load
from symgen.derive.lower.looped.looped_law import is_loopable
from symgen.derive.methods import METHODS
from symgen.derive.methods._base import EXPLICIT_FORMS
from symgen.describe.files.load import load_mechanism
from symgen.describe.mechanism import Mechanism
from symgen.run.compiling.choices import mechanism_on_tree
from symgen.run.compiling.free_by_loops import choice_at_start
from symgen.run.compiling.looped import LoopedStages
from symgen.run.compiling.method_choice import MethodChoice, choose_method
from symgen.run.compiling.pipeline import generate, generate_in_stages

MODELS = (
    *("pendulum", "four-bar", "slider-crank", "n-four-bar:2", "andrews", "driven-four-bar", "bricard"),
    *("four-bar joint", "bricard joint"),  # with the joints of a tree for coordinates
)
THOROUGH = ("pendulum", "four-bar")
#: Also emitted for CUDA and in lanes, by the methods of `CORE`.
OTHER_TARGETS = ("four-bar",)
CORE = ("lagrange", "baumgarte", "direct-correction")
#: Also emitted in the looped shape, the first with every method.
LOOPED = ("four-bar", "bricard")
#: Stands in headers of looped modules in place of the digest of all sources, which changes with every edit.
GENERATOR = "of-golden-trees"


def folder(model: str) -> str:
    """Return the name of a mechanism's folder."""
    return model.replace("-", "_").replace(":", "_").replace(" ", "_")


def described(model: str) -> Mechanism:
    """Return a mechanism, on its tree where its name says so."""
    name, _, coordinates = model.partition(" ")
    return mechanism_on_tree(load_mechanism(name)) if coordinates == "joint" else load_mechanism(name)


def choices(model: str) -> tuple[MethodChoice, ...]:
    """Return what is emitted for a model.

    For small ones every method in all its forms, with all values of its options; for the others the three methods that
    share most of their code with the rest.
    """
    found: dict[str, MethodChoice] = {}
    for name, method in METHODS.items():
        if model not in THOROUGH and name not in CORE:
            continue
        explicit = bool(EXPLICIT_FORMS & set(method.forms))
        variants = [{option.name: value} for option in method.options for value in option.values]
        for options in [{}, *variants] if explicit else [{}]:
            if model in THOROUGH or options.get("solver") in (None, "elimination"):
                choice = choose_method(name, options, implicit=not explicit)
                found[choice.stem] = choice
        if model in THOROUGH and set(method.forms) - EXPLICIT_FORMS:
            choice = choose_method(name, None, implicit=True)
            found[choice.stem] = choice
    return tuple(found[stem] for stem in sorted(found))


def looped_choices(model: str) -> list[MethodChoice]:
    """Return what is emitted in the looped shape: every method, option and descriptor form for the first model."""
    chosen = CORE if model != LOOPED[0] else tuple(METHODS.names)
    found = []
    for name in chosen:
        method = METHODS.get(name)
        variants = [{}, *({o.name: value} for o in method.options for value in o.values[1:])]
        forms = [(given, False) for given in variants] if EXPLICIT_FORMS & set(method.forms) else []
        if set(method.forms) - EXPLICIT_FORMS and (model == LOOPED[0] or name == CORE[0]):
            forms.append(({}, True))
        for given, implicit in forms:
            choice = choose_method(name, given, implicit)
            if is_loopable(method, choice.options, implicit):
                found.append(choice)
    return found


@cache
def emitted(model: str, whole: bool = True) -> dict[str, str]:
    """Return stem -> source of straight code for all targets."""
    mechanism = described(model)
    made = dict(
        generate(mechanism, tuple(choice_at_start(mechanism, each) for each in choices(model)), whole=whole).modules
    )
    if model in OTHER_TARGETS:
        core = tuple(choose_method(name) for name in CORE)
        for target in ("cuda", "lanes"):
            mechanism = load_mechanism(model)
            closed = tuple(choice_at_start(mechanism, choice) for choice in core)
            made |= generate(mechanism, closed, target=target, whole=whole).modules
    # the free velocities of closed loops are named in the cache alone
    return {re.sub(r"(_f\d+)+(?=_lanes|_cuda|$)", "", stem): source for stem, (source, _) in made.items()}


@cache
def emitted_looped(model: str, whole: bool = True) -> dict[str, str]:
    """Return stem -> source of looped modules."""
    return _looped(model, tuple(looped_choices(model)), whole)


def _looped(model: str, choices: tuple[MethodChoice, ...], whole: bool) -> dict[str, str]:
    made = generate_in_stages(LoopedStages(load_mechanism(model), choices, whole, GENERATOR)).modules
    return {stem: source for stem, (source, _) in made.items() if source}


def written(modules: Mapping[str, str], where: Path) -> Path:
    """Write modules into a folder of their own and return it."""
    for stem, source in modules.items():
        (where / f"{stem}.py").write_text(source, encoding="utf-8")
    return where


def everything() -> dict[str, Callable[[], dict[str, str]]]:
    """Return by the name of each folder what gives its modules, as people read them."""
    straight = {folder(model): partial(emitted, model) for model in MODELS}
    return straight | {f"looped_{folder(model)}": partial(emitted_looped, model) for model in LOOPED}


#: Packages that are checked in: mechanisms of the paper that symgen comes from, and methods, one with its own scheme.
SHOWN = {
    "four-bar": ("direct-correction", "lagrange", "null-space", "rattle"),
    "spatial-slider-crank": ("direct-correction", "lagrange"),
    "bricard": ("direct-correction",),
    "front-suspension": ("direct-correction",),
}


def shown(where: Path) -> dict[Path, str]:
    """Return the files of the packages that are checked in, written into a folder."""
    found = {}
    for name, methods in SHOWN.items():
        package = load(name).generate(where / folder(name), methods)
        found |= {path.relative_to(where): path.read_text(encoding="utf-8") for path in package.files}
    return found
