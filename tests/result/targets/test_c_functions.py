"""Dynamics in C: compiled without a warning, without allocation, with the numbers of the compiled functions."""

import ctypes
import re

import numpy as np
import pytest
from verification.test_differentiable_targets import MECHANISMS, apart, arguments, functions_of, model_of, state_of

from symgen.analyses.functions.model_functions import _VECTORS, BY
from symgen.api import load
from symgen.base.errors import InputError
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


@pytest.mark.slow
def test_c_functions_of_a_loop(tmp_path):
    library = compare("four-bar", "joint", tmp_path)
    flat = np.zeros(3)
    assert library.call("forward_dynamics", (3,), [flat, flat, flat, np.zeros(4)])[1] == 1  # without masses


@pytest.mark.by_turns(8)
@pytest.mark.slow
@pytest.mark.parametrize(("name", "coordinates"), MECHANISMS)
def test_c_functions_are_the_compiled_ones(name, coordinates, tmp_path):
    compare(name, coordinates, tmp_path)


@pytest.mark.slow
def test_single_precision_compiles_without_a_warning(tmp_path):
    TARGETS.get("c-functions").write(Request(load("four-bar").mechanism, tmp_path, coordinates="joint"))
    compiled(tmp_path, "-shared", "-fPIC", "-DFOUR_BAR_SINGLE", output="library.so")


# -- derivatives -------------------------------------------------------------------------------------------------------


def with_derivatives(name, coordinates, folder):
    """A mechanism, the functions of its C code, and a state of it."""
    model = model_of(name, folder)
    request = Request(model.mechanism, folder / "c", coordinates=coordinates, derivatives=True)
    package = TARGETS.get("c-functions").write(request)
    prefix = next(p.stem.removesuffix("_functions") for p in package.files if p.name.endswith("_functions.h"))
    text = (folder / "c" / f"{prefix}_derivatives.c").read_text(encoding="utf-8")
    assert not re.search(r"\b(malloc|calloc|free)\b", text)
    f = model.functions(coordinates)
    return f, Library(folder / "c", prefix), state_of(f)


def compare_derivatives(name, coordinates, folder):
    f, library, state = with_derivatives(name, coordinates, folder)
    for quantity in functions_of(f):
        for by, space in BY.items():
            if space not in (*_VECTORS[quantity], "p"):
                continue
            function = f.derivative(quantity, by)
            given = arguments(function, state)
            exact = np.asarray(function(*given))
            value, code = library.call(f"{quantity}_by_{by}", exact.shape, given)
            assert code == 0
            np.testing.assert_allclose(value, exact, rtol=1e-12, atol=1e-13 * max(1.0, np.abs(exact).max()))
    return library, state


def step_of(library, q, v, effort, p, h):
    """A step of the classical scheme, from two functions of the library."""
    y, n, total, slope = np.concatenate([q, v]), len(q), 0.0, 0.0
    for at, weight in ((0.0, 1 / 6), (0.5, 1 / 3), (0.5, 1 / 3), (1.0, 1 / 6)):
        stage, numbers = y + at * h * slope, np.array(p)
        numbers[-1] += at * h
        place = stage[:n], stage[n:]
        rates, _ = library.call("rates", (n,), [*place, numbers])
        slope = np.concatenate([rates, library.call("forward_dynamics", (len(v),), [*place, effort, numbers])[0]])
        total = total + weight * slope
    return y + h * total


def compare_step(library, state):
    """A step beside one in Python, its derivatives beside differences of that."""
    q, v, _, effort, p = state
    h, ny, nv, width = 1e-4, len(q) + len(v), len(v), len(q) + 2 * len(v) + len(p)
    call = getattr(library._library, f"{library._prefix}_step")
    call.argtypes = [ctypes.c_void_p] * 4 + [ctypes.c_double] + [ctypes.c_void_p] * 2
    kept = [np.ascontiguousarray(x, dtype=float) for x in (q, v, effort, p)]
    pointers = [x.ctypes.data for x in kept]
    alone, following, slopes = np.full(ny, np.nan), np.full(ny, np.nan), np.full((ny, width), np.nan)
    assert call(*pointers, h, alone.ctypes.data, None) == 0
    assert call(*pointers, h, following.ctypes.data, slopes.ctypes.data) == 0
    np.testing.assert_array_equal(alone, following)
    expected = step_of(library, q, v, effort, p, h)
    np.testing.assert_allclose(following, expected, rtol=1e-13, atol=1e-13 * np.abs(expected).max())
    whole = np.concatenate(kept)
    for j in range(width):
        change = 1e-5 * max(1.0, abs(whole[j]))
        ends = []
        for sign in (1.0, -1.0):
            x = whole.copy()
            x[j] += sign * change
            ends.append(step_of(library, x[: len(q)], x[len(q) : ny], x[ny : ny + nv], x[ny + nv :], h))
        difference = (ends[0] - ends[1]) / (2.0 * change)
        np.testing.assert_allclose(slopes[:, j], difference, atol=2e-7 * max(1.0, np.abs(difference).max()))


@pytest.mark.slow
def test_derivatives_and_a_step_of_a_loop(tmp_path):
    compare_step(*compare_derivatives("four-bar", "joint", tmp_path))


@pytest.mark.by_turns(16)
@pytest.mark.slow
@pytest.mark.parametrize(("name", "coordinates"), MECHANISMS)
def test_derivatives_are_the_compiled_ones(name, coordinates, tmp_path):
    compare_step(*compare_derivatives(name, coordinates, tmp_path))


@pytest.mark.slow
def test_derivatives_in_single_precision_compile_without_a_warning(tmp_path):
    request = Request(load("four-bar").mechanism, tmp_path, coordinates="joint", derivatives=True)
    TARGETS.get("c-functions").write(request)
    compiled(tmp_path, "-shared", "-fPIC", "-DFOUR_BAR_SINGLE", output="library.so")


def test_other_targets_have_no_derivatives(tmp_path):
    with pytest.raises(
        InputError, match=r"derivatives: expected target 'c-functions' or 'fmu', which write them, got target 'c'"
    ):
        load("four-bar").generate(tmp_path, target="c", derivatives=True)
