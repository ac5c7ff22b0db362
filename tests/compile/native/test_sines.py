"""Sines of several angles together: against mpmath, against those of the C library, and where they are taken."""

import ctypes
import math
import re

import mpmath
import numpy as np
import pytest

from symgen.api import load
from symgen.compile.native import machine, sines
from symgen.compile.native.machine import compile_module, load_machine_code
from symgen.compile.store.loaded_modules import load_module

from .twofold import arguments_of, by, for_avx512, written

WIDTHS = (4, 8)


def caller_of(n: int) -> str:
    """Return a module with a function that takes sines and cosines of `n` angles from memory to memory."""
    return f"""
define void @try_sines{n}(ptr %x, ptr %s, ptr %c) {{
  %v = load <{n} x double>, ptr %x, align 8
  %r = call {sines.result_type(n)} {sines.sine_name(n)}(<{n} x double> %v)
  %a = extractvalue {sines.result_type(n)} %r, 0
  %b = extractvalue {sines.result_type(n)} %r, 1
  store <{n} x double> %a, ptr %s, align 8
  store <{n} x double> %b, ptr %c, align 8
  ret void
}}
declare double @llvm.sin.f64(double)
declare double @llvm.cos.f64(double)
{sines.function_definition(n)}
"""


@pytest.fixture(scope="module", params=WIDTHS)
def both(request):
    """The function for vectors of one length: takes angles, returns their sines and cosines."""
    n = request.param
    symbol = f"try_sines{n}"
    address = load_machine_code(compile_module(caller_of(n), symbol), symbol)
    function = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 3)(address)

    def call(angles):
        given = np.resize(np.asarray(angles, float), n)
        found = np.empty(n), np.empty(n)
        function(given.ctypes.data, found[0].ctypes.data, found[1].ctypes.data)
        return given, *found

    return call


def test_registers_of_512_bits_are_not_for_code_of_one_run():
    """It uses a few vectors now and then, for which they take longer."""
    with for_avx512() as target:
        text = target.emit_assembly(machine.optimise_module(caller_of(8)))
    assert set(re.findall("[yz]mm", text)) == {"ymm"}


def units(found: float, exact: mpmath.mpf) -> float:
    """Return an error in units of the last place."""
    return float(abs(mpmath.mpf(found) - exact)) / float(np.spacing(abs(float(exact))))


def worst(angles, sine, cosine) -> float:
    with mpmath.workdps(60):
        pairs = [(s, mpmath.sin(x)) for x, s in zip(map(mpmath.mpf, angles), sine, strict=True)]
        pairs += [(c, mpmath.cos(x)) for x, c in zip(map(mpmath.mpf, angles), cosine, strict=True)]
        return max(units(*pair) for pair in pairs)


@pytest.mark.parametrize("size", [1e-300, 1e-8, 0.1, 1.0, 10.0, 1e3, 0.99 * sines.FAR])
def test_within_one_unit_of_the_last_place(both, size):
    """fdlibm's bound; the polynomials and the rest of the reduction are theirs."""
    rng = np.random.default_rng(5)
    assert max(worst(*both(rng.uniform(-size, size, 8))) for _ in range(50)) < 1.0


def test_next_to_multiples_of_a_quarter(both):
    """Where the reduction cancels most."""
    for k in (1, 2, 3, 4, 11, 1000, 100_001, 254_647):
        middle = k * math.pi / 2
        assert worst(*both([middle, np.nextafter(middle, 9e9), -middle, np.nextafter(middle, 0.0)])) < 1.0


def test_zeros_keep_their_sign(both):
    _, sine, cosine = both([0.0, -0.0])
    assert np.array_equal(np.signbit(sine[:2]), [False, True])
    assert np.all(cosine == 1.0)


@pytest.mark.parametrize("far", [sines.FAR, -1e9, 1e300, math.inf, -math.inf, math.nan])
def test_far_angles_are_left_to_the_library(both, far):
    """All of a call: what the C library says, nan where there is no sine."""
    angles, sine, cosine = both([0.5, far, -2.0, 3.0])
    for x, s, c in zip(angles, sine, cosine, strict=True):
        expected = (math.sin(x), math.cos(x)) if math.isfinite(x) else (math.nan, math.nan)
        np.testing.assert_array_equal([s, c], expected)


MANY = """
def f(y, out):
    a = y[0]
    b = y[1]
    c = y[2]
    d = y[3]
    e = y[4]
    u = a - b
    out[0] = math.sin(a) + 2.0*math.cos(a)
    out[1] = math.sin(b)*math.cos(c)
    out[2] = math.cos(d) - math.cos(u)
    out[3] = math.sin(u)
    v = out[0] + e
    out[4] = math.sin(v) if a > b else math.cos(e)
    out[5] = math.sin(e)
    return 0
"""
FEW = """
def f(y, out):
    a = y[0]
    b = y[1]
    out[0] = math.sin(a) + math.cos(b)
    out[1] = math.sin(b)
    return 0
"""


def groups_of(tmp_path, name: str, *texts: str) -> list[tuple[object, ...]]:
    function = load_module(written(tmp_path / name, *texts)).f
    return [call for calls in sines.groups_of_angles(function.read(arguments_of(function))).values() for call in calls]


CALLED = """
def g(x):
    return 2.0*x
"""
CALLING = """
def f(y, out):
    out[0] = math.sin(g(y[0])) + math.cos(g(y[1])) + math.sin(y[2]/y[3]) + math.cos(math.sqrt(y[4])) + math.sin(y[5])
    return 0
"""


def test_which_angles_are_taken_together(tmp_path):
    """Those known when the first is wanted, of three or more; not what is behind a choice, nor what is called for."""
    assert [len(call) for call in groups_of(tmp_path, "many", MANY)] == [6]
    assert groups_of(tmp_path, "few", FEW) == []
    assert groups_of(tmp_path, "calling", CALLED, CALLING) == []


def test_functions_with_and_without(tmp_path):
    """Sums of two numbers up to 3, each within one unit of its own last place."""
    together, alone = (load_module(written(tmp_path / name, MANY)).f for name in ("with", "without"))
    one = together.caller(arguments_of(together))
    with by("libm"):
        plain = alone.caller(arguments_of(alone))
    rng = np.random.default_rng(3)
    differ = 0
    for _ in range(200):
        y = rng.uniform(-30.0, 30.0, 8)
        a, b = np.zeros(8), np.zeros(8)
        assert one(y, a) == plain(y, b) == 0
        assert np.abs(a - b).max() <= 4 * 3.0 * 2.0**-52
        differ += not np.array_equal(a, b)
    assert differ > 0, "the same sines, so nothing was taken together"


@pytest.mark.slow
def test_right_hand_side_of_andrews():
    """Seven angles: rates with both kinds of sines agree to rounding times the condition of the rows."""
    model = load("andrews")
    compiled_model = model.compile("lagrange")
    start = model.assemble(compiled_model)
    found = []
    for name in ("source", "libm"):
        with by(name):
            law = load_module(compiled_model.law_module.__file__, f"sines_{name}.andrews")
            ydot = np.zeros_like(start.y)
            law.rhs(0.0, start.y.copy(), start.p.copy(), start.w.copy(), np.zeros(16, dtype=np.int64), ydot)
            found.append(ydot)
    assert np.abs(found[0] - found[1]).max() <= 1e-11 * np.abs(found[1]).max()
