"""Dynamics in C: compiled without a warning, without allocation, with the numbers of the compiled functions."""

import ctypes
import re

import numpy as np
import pytest
from verification.test_differentiable_targets import MECHANISMS, apart, arguments, functions_of, model_of, state_of

from symgen.api import load
from symgen.result.targets import TARGETS, Request
from tests.result.targets.compilers import compiled


class Library:
    """The functions of a folder by name, as Python functions."""

    def __init__(self, folder, prefix) -> None:
        self._library = ctypes.CDLL(str(compiled(folder, "-shared", "-fPIC", output="library.so")))
        self._prefix = prefix

    def call(self, name, shape, given):
        result = np.full(shape, np.nan)
        kept = [np.ascontiguousarray(x, dtype=float) for x in given]
        pointers = [x.ctypes.data_as(ctypes.c_void_p) for x in kept]
        code = getattr(self._library, f"{self._prefix}_{name}")(*pointers, result.ctypes.data_as(ctypes.c_void_p))
        return result, code


def compare(name, coordinates, folder):
    model = model_of(name, folder)
    package = TARGETS.get("c-functions").write(Request(model.mechanism, folder / "c", coordinates=coordinates))
    prefix = next(p.stem.removesuffix("_functions") for p in package.files if p.suffix == ".h")
    text = (folder / "c" / f"{prefix}_functions.c").read_text(encoding="utf-8")
    assert not re.search(r"\b(malloc|calloc|free)\b", text)
    f = model.functions(coordinates)
    library, state = Library(folder / "c", prefix), state_of(f)
    for quantity in functions_of(f):
        function = getattr(f, quantity)
        given = arguments(function, state)
        exact = np.asarray(function(*given))
        value, code = library.call(quantity, exact.shape, given)
        assert code == 0 and apart(value, exact, quantity) < 1e-13, quantity
    body = f.mechanism.bodies[0]
    place = f"{body.name}_{body.points[0][0]}" if body.points else body.name
    frame = f.frame(place.replace("_", ".", 1) if body.points else body.name)
    for what in ("pose", "velocity", "jacobian"):
        given = arguments(getattr(frame, what), state)
        exact = getattr(frame, what)(*given)
        assert apart(library.call(f"{what}_{place}", exact.shape, given)[0], exact) < 1e-13
    return library


def test_c_functions_of_a_loop(tmp_path):
    library = compare("four-bar", "joint", tmp_path)
    flat = np.zeros(3)
    assert library.call("forward_dynamics", (3,), [flat, flat, flat, np.zeros(4)])[1] == 1  # without masses


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize(("name", "coordinates"), MECHANISMS)
def test_c_functions_are_the_compiled_ones(name, coordinates, tmp_path):
    compare(name, coordinates, tmp_path)


@pytest.mark.slow
def test_single_precision_compiles_without_a_warning(tmp_path):
    TARGETS.get("c-functions").write(Request(load("four-bar").mechanism, tmp_path, coordinates="joint"))
    compiled(tmp_path, "-shared", "-fPIC", "-DFOUR_BAR_SINGLE", output="library.so")
