"""Parts of laws as modules of their own: named by what they hold, shared by methods, found again, never half there."""

import itertools
import re

import pytest

from symgen.api import load
from symgen.compile.store.entries import Entries
from symgen.compile.store.paths import ENVIRONMENT_VARIABLE
from symgen.run.compiling.method_choice import choose_method
from symgen.run.compiling.pipeline import compile_model, generate

#: Stems of modules that hold parts of laws.
PART = re.compile(r"[a-z]\w*_[0-9a-f]{16}(_cuda)?", re.ASCII)
METHODS = ("lagrange", "baumgarte", "direct-correction", "augmented-lagrangian", "coordinate-partitioning")
LOOPED = METHODS[:4]


def emitted(methods, shape="straight", target="cpu"):
    choices = tuple(choose_method(method) for method in methods)
    return dict(generate(load("four-bar").mechanism, choices, shape, target).modules)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(("shape", "target"), [("straight", "cpu"), ("straight", "cuda"), ("looped", "cpu")])
def test_a_module_does_not_depend_on_what_else_is_asked_for(shape, target):
    methods = METHODS if shape == "straight" else LOOPED
    everything = emitted(methods, shape, target)
    everything.pop("mechanism", None)  # tables of all laws that were asked for
    seen = set()
    for chosen in [*((m,) for m in methods), *itertools.combinations(methods, 2), tuple(reversed(methods))]:
        found = emitted(chosen, shape, target)
        found.pop("mechanism", None)
        assert all(everything[stem] == module for stem, module in found.items()), chosen
        seen |= set(found)
    assert seen == set(everything)


def test_methods_with_one_right_hand_side_share_it():
    modules = emitted(("lagrange", "direct-correction", "coordinate-partitioning"))
    parts = [stem for stem in modules if PART.fullmatch(stem)]
    assert sum(stem.startswith("rhs_direct") for stem in parts) == 1
    assert sum(stem.startswith("prepare") for stem in parts) == 1
    assert sum(stem.startswith("accept") for stem in parts) == 3
    assert sum("def rhs(" in source for source, _ in modules.values()) == 2  # one closes dependent coordinates first


@pytest.mark.parametrize("shape", ["straight", "looped"])
@pytest.mark.parametrize("damage", ["missing", "description", "content"])
def test_a_law_without_one_of_its_parts_is_made_again(tmp_path, monkeypatch, shape, damage):
    monkeypatch.setenv(ENVIRONMENT_VARIABLE, str(tmp_path / "cache"))
    entries, mechanism = Entries(), load("pendulum").mechanism
    choice = choose_method("direct-correction")
    choice = type(choice)(choice.method, choice.options, choice.implicit, shape)
    compile_model(mechanism, choice)
    paths = [path for path in sorted((tmp_path / "cache").rglob("*.py")) if PART.fullmatch(path.stem)]
    parts = [path for path in paths if path.stem.split("_")[0] in ("rhs", "accept", "confirm", "prepare")]
    assert len(parts) >= 3
    for path in parts:
        before = path.read_bytes()
        if damage == "missing":
            path.unlink()
        elif damage == "content":
            path.write_bytes(before[:-9] + b"1" + before[-8:])
        else:
            path.with_suffix(".json").write_text("{}")
        compile_model(mechanism, choice)
        assert path.read_bytes() == before
        assert entries.get(path.parent.name, path.stem) is not None
