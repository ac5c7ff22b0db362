import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from symgen.base.errors import InputError
from symgen.compile.store.emitted import EmittedFunction
from symgen.compile.store.loaded_modules import load_module

from .conftest import FOLDER, LAW, MODEL


@pytest.fixture(autouse=True)
def _own_cache(cache):
    """A cache of its own for each test."""


def rate(module, angle=1.0):
    ydot = np.zeros(2)
    module.rhs(0.0, np.array([angle, 0.0]), np.array([9.81]), np.zeros(4), np.zeros(2, np.int64), ydot)
    return ydot[1]


def test_the_name_comes_from_folder_and_file(generated):
    law = load_module(generated / "lagrange.py")
    assert law.__name__ == f"symgen_generated.{FOLDER}.lagrange"
    assert sys.modules[law.__name__] is law
    assert law.__file__ == str(generated / "lagrange.py")
    assert law.geometry is sys.modules[f"symgen_generated.{FOLDER}.model"].geometry
    assert rate(law) == pytest.approx(-9.81 * np.sin(1.0))
    assert isinstance(law.rhs, EmittedFunction) and isinstance(law.geometry, EmittedFunction)
    assert sorted(path.name for path in generated.iterdir()) == ["lagrange.py", "model.py"]  # nothing written there


def test_the_name_can_be_given(generated):
    assert load_module(generated / "model.py", "some.package.m").__name__ == "some.package.m"
    for name in ("some.package.m", "some.package", "some"):
        del sys.modules[name]
    with pytest.raises(InputError, match=r"qualified_name: expected a dotted name .*, got 'alone'"):
        load_module(generated / "model.py", "alone")


def test_the_same_content_is_the_same_module(generated, monkeypatch):
    law = load_module(generated / "lagrange.py")
    assert load_module(generated / "lagrange.py") is law
    monkeypatch.chdir(generated)
    assert load_module("lagrange.py") is law


def test_two_laws_share_the_model(generated):
    (generated / "baumgarte.py").write_text(LAW + "\nother = 1\n")
    assert load_module(generated / "lagrange.py").geometry is load_module(generated / "baumgarte.py").geometry


@pytest.mark.parametrize("edited", ["lagrange.py", "model.py"])
def test_edited_content_is_another_module(generated, edited):
    law = load_module(generated / "lagrange.py")
    path = generated / edited
    path.write_text(path.read_text().replace("-p[0]", "-2.0 * p[0]").replace("math.sin(", "2.0 * math.sin("))
    other = load_module(generated / "lagrange.py")
    assert other is not law and other.__name__ != law.__name__
    assert rate(other) == pytest.approx(2 * rate(law))
    assert load_module(generated / "lagrange.py") is other


def test_folders_of_the_same_name_do_not_mix(generated, tmp_path):
    other = tmp_path / "other" / FOLDER
    other.mkdir(parents=True)
    (other / "model.py").write_text(MODEL.replace("sin", "cos"))
    (other / "lagrange.py").write_text(LAW)
    assert rate(load_module(generated / "lagrange.py")) == pytest.approx(-9.81 * np.sin(1.0))
    assert rate(load_module(other / "lagrange.py")) == pytest.approx(-9.81 * np.cos(1.0))


def test_a_folder_with_a_dot(generated, tmp_path):
    folder = tmp_path / "v1.2"
    folder.mkdir()
    (folder / "model.py").write_text(MODEL)
    assert load_module(folder / "model.py").__name__ == "symgen_generated.v1_2.model"


def test_siblings_are_found_however_they_are_imported(generated):
    text = '"""from .nowhere import x"""\nfrom . import model, third\nfrom .model import (\n    geometry,\n)\n'
    (generated / "other.py").write_text(text)
    (generated / "third.py").write_text("from .model import geometry as again")
    other = load_module(generated / "other.py")
    assert other.geometry is other.model.geometry is other.third.again


def test_a_missing_file_is_named(generated):
    path = generated / "none.py"
    with pytest.raises(InputError) as error:
        load_module(path)
    assert str(error.value) == f"{path}: expected a generated module, got No such file or directory"
    (generated / "model.py").unlink()
    with pytest.raises(InputError, match=r"model\.py: expected a generated module"):
        load_module(generated / "lagrange.py")


@pytest.mark.parametrize("content", [b"def f(:", b"x = 1\0", b"\xff\xfe"])
def test_a_file_that_is_not_python_is_named(generated, content):
    (generated / "model.py").write_bytes(content)
    with pytest.raises(InputError, match=r"model\.py: expected a generated module, got text that is not Python"):
        load_module(generated / "lagrange.py")


def test_a_module_that_fails_is_not_kept(generated):
    (generated / "model.py").write_text("raise RuntimeError('no')")
    before = set(sys.modules)
    with pytest.raises(RuntimeError, match="no"):
        load_module(generated / "lagrange.py")
    new = set(sys.modules) - before
    assert not [name for name in new if name.startswith("symgen_generated") and name.endswith((".model", ".lagrange"))]
    (generated / "model.py").write_text(MODEL)
    assert rate(load_module(generated / "lagrange.py")) < 0


def test_importing_the_store_is_cheap():
    script = """
import sys
import symgen.compile.store.entries, symgen.compile.store.stats, symgen.compile.store.paths
known = {"numba", "llvmlite", "numpy", "platformdirs", "filelock", "sympy"}
assert not known & {*sys.modules}, known & {*sys.modules}
import symgen.compile.store.loaded_modules
print(sorted(known & {*sys.modules} - {"llvmlite", "numpy"}))
"""
    project = str(Path(__file__).parents[3])
    output = subprocess.run([sys.executable, "-c", script], cwd=project, capture_output=True, text=True, check=True)
    assert output.stdout == "[]\n"
