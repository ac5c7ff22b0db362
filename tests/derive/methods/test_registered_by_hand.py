"""Methods from outside the package: the cache must not take one version of them for another."""

import importlib.util
import sys
from pathlib import Path

import pytest

from symgen.derive.methods import METHODS
from symgen.derive.methods._base import MultiplierMethod
from symgen.run.compiling.method_choice import MethodChoice


class Mild(MultiplierMethod):
    """A rate of 1."""

    name = "own"

    def target(self, system):
        """Return what D v' shall be."""
        return system.gamma - 1.0 * (system.D @ system.v - system.nu)


class Strong(MultiplierMethod):
    """The same with a rate of 2."""

    name = "own"

    def target(self, system):
        """Return what D v' shall be."""
        return system.gamma - 2.0 * (system.D @ system.v - system.nu)


def stem(method: MultiplierMethod) -> str:
    return MethodChoice(method, method.complete_options({})).stem


def test_versions_of_one_name_have_modules_of_their_own() -> None:
    stems = {stem(Mild()), stem(Strong())}
    assert len(stems) == 2
    assert all(s.startswith("own_") and s.isidentifier() for s in stems)
    assert stem(Mild()) == stem(Mild())


@pytest.mark.parametrize("name", METHODS.names)
def test_methods_of_the_package_keep_their_names(name: str) -> None:
    method = METHODS.get(name)
    assert MethodChoice(method, method.complete_options({})).stem == name.replace("-", "_")


def test_a_change_of_the_file_is_another_version(tmp_path: Path) -> None:
    """Also where the class is the same and what it calls is not."""
    text = (
        "from symgen.derive.methods._base import MultiplierMethod\n"
        "RATE = {}\n"
        "class Own(MultiplierMethod):\n"
        "    name = 'own'\n"
        "    def target(self, system):\n"
        "        return system.gamma - RATE * (system.D @ system.v - system.nu)\n"
    )
    stems = set()
    for rate in (1.0, 2.0):
        path = tmp_path / f"own_{rate:g}" / "own_in_a_file.py"
        path.parent.mkdir()
        path.write_text(text.format(rate), encoding="utf-8")
        spec = importlib.util.spec_from_file_location("own_in_a_file", path)
        assert spec is not None and spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        with pytest.MonkeyPatch.context() as patch:
            patch.setitem(sys.modules, "own_in_a_file", module)
            spec.loader.exec_module(module)
            stems.add(stem(module.Own()))
    assert len(stems) == 2


def test_names_of_modules_have_an_end():
    """Twelve free velocities of a loop in space made a name that the cache refuses."""
    method = METHODS.get("direct-correction", "method")
    choices = [
        MethodChoice(method, method.complete_options({}), free=tuple(range(first, first + 12))) for first in (0, 12)
    ]
    stems = [choice.stem for choice in choices]
    assert len({*stems}) == 2
    assert all(stem.isidentifier() and len(stem) < 64 for stem in stems)
    assert MethodChoice(method, method.complete_options({}), free=(3, 4)).stem.endswith("_f3_f4")
