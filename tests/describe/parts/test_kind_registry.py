"""The registry that finds kinds by their files."""

import re
import sys

import pytest

from symgen.base.errors import InputError
from symgen.base.registry import Registry
from symgen.derive.methods import METHODS
from symgen.run.integrators import INTEGRATORS


@pytest.fixture
def package(tmp_path, monkeypatch):
    """A package of three kinds, one of which cannot be imported, and a private module."""
    name = f"kinds_of_{tmp_path.name}".replace("-", "_")
    folder = tmp_path / name
    folder.mkdir()
    (folder / "__init__.py").write_text("")
    (folder / "plain.py").write_text("KIND = 'the plain one'\n")
    (folder / "two_words.py").write_text("KIND = 'the other one'\n")
    (folder / "broken.py").write_text("raise RuntimeError('imported')\n")
    (folder / "_shared.py").write_text("raise RuntimeError('imported')\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    yield name
    for module in [m for m in sys.modules if m.split(".")[0] == name]:
        del sys.modules[module]


def test_names_come_from_files_without_importing_them(package):
    registry = Registry(package, "kind")
    assert registry.names == ("broken", "plain", "two-words")
    assert list(registry) == ["broken", "plain", "two-words"]
    assert len(registry) == 3
    assert "two-words" in registry
    assert f"{package}.plain" not in sys.modules


def test_a_kind_is_imported_when_asked_for(package):
    registry = Registry(package, "kind", aliases={"double": "two-words"})
    assert registry.get("plain") == "the plain one"
    assert registry.get("double") == "the other one"
    assert registry.resolve_alias("double") == "two-words"
    assert "double" in registry
    with pytest.raises(RuntimeError, match="imported"):
        registry.get("broken")


def test_unknown_names_are_answered_with_the_nearest_and_all(package):
    registry = Registry(package, "kind", aliases={"double": "two-words"})
    with pytest.raises(InputError) as error:
        registry.get("plane", "--kind")
    assert str(error.value) == (
        "--kind: expected a kind, got 'plane'; did you mean 'plain'? (known: broken, double, plain, two-words)"
    )
    with pytest.raises(
        InputError, match=r"^kind: expected a kind, got 'zzz'; known: broken, double, plain, two-words$"
    ):
        registry.get("zzz")


def test_nothing_is_registered_twice(package):
    registry = Registry(package, "kind", aliases={"double": "two-words"})
    assert registry.register("by-hand", "mine") == "mine"
    assert registry.get("by-hand") == "mine"
    assert "by-hand" in registry.names
    for taken in ("by-hand", "plain", "double"):
        with pytest.raises(ValueError, match=f"kind '{taken}' is registered twice"):
            registry.register(taken, "again")


@pytest.mark.parametrize("name", ["Upper", "with_line", "", "-x", "x-", "1x", "a b"])
def test_names_are_kebab(package, name):
    with pytest.raises(ValueError, match="is not a lower-case name with dashes"):
        Registry(package, "kind").register(name, "mine")


def test_aliases_must_lead_somewhere_new(package):
    with pytest.raises(ValueError, match="kind alias 'double' stands for 'nothing', which does not exist"):
        _ = Registry(package, "kind", aliases={"double": "nothing"}).names
    with pytest.raises(ValueError, match="kind 'plain' is registered twice"):
        _ = Registry(package, "kind", aliases={"plain": "two-words"}).names


@pytest.mark.parametrize(
    ("registry", "name", "hint"),
    [
        (METHODS, "picard", "'picard' is an integrator"),
        (METHODS, "picrd", "did you mean the integrator 'picard'?"),
        (INTEGRATORS, "lagrange", "'lagrange' is a method"),
        (METHODS, "lagrnge", "did you mean 'lagrange'?"),
    ],
)
def test_a_name_of_the_registry_beside(registry, name, hint):
    """Neither lists its own kinds where the name is one of the other's."""
    with pytest.raises(InputError, match=f"got '{name}'; {re.escape(hint)}"):
        registry.get(name)
