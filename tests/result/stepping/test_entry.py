"""Loops entered by one block of arguments: the same bits as by calls of compiled functions, which judge them."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from support.checks import assert_same_arrays
from support.remembering import CONSTANT, PAIRS

import symgen
from symgen.compile.native import calls, types
from symgen.compile.store.jit import jit, object_file
from symgen.derive.methods import METHODS
from symgen.run.integrators import INTEGRATORS
from symgen.run.layout import abi
from symgen.run.loops import sparse
from symgen.run.single.simulation import Simulation

DEFECTS = Path(__file__).resolve().parents[2] / "data" / "defects"
LOOSE = {"max_violation": 1.0, "max_energy_error": 1e9}


def assert_same(sim, other):
    assert_same_arrays(sim.save().arrays, other.save().arrays)


def both(name, **settings):
    """Two runs, of which the second one enters its loop as every compiled function is called."""
    model = symgen.load(name)
    sim, plain = (model.start(**settings, **LOOSE) for _ in range(2))
    plain._loop.direct = False
    assert sim._loop._entry is not None
    return sim, plain


@pytest.mark.by_turns(6)
@pytest.mark.slow_cases(
    "False-null-space-rk4",
    "True-direct-correction-bdf",
    "True-half-explicit-phem56",
    "False-null-space-abm4",
    "True-ggl-bdf",
    "False-direct-correction-bdf",
    "False-index3-augmented-lagrangian-trapezoidal",
    "False-ggl-bdf",
    "False-half-explicit-phem56",
)
@pytest.mark.parametrize(("method", "integrator"), PAIRS)
@pytest.mark.parametrize("adaptive", [False, True])
def test_both_ways_give_the_same_bits(method, integrator, adaptive):
    if adaptive and not INTEGRATORS.get(integrator).adaptive:
        return
    more = {} if adaptive else {"step": 2e-3, **(CONSTANT if INTEGRATORS.get(integrator).adaptive else {})}
    sim, plain = both("four-bar", method=method, integrator=integrator, shape="straight", until=1.0, **more)
    for run in (sim, plain):
        for dt in (0.002, 0.02, 0.013):
            run.step(dt)
        run.set(crank_mass=2.5)
        run.step(0.01)
    assert_same(sim, plain)


@pytest.mark.fast("n-four-bar:1-null-space-dopri5-looped")
@pytest.mark.parametrize("shape", ["straight", "looped"])
@pytest.mark.parametrize(
    ("name", "method", "integrator"),
    [("bricard", "direct-correction", "rk4"), ("n-four-bar:1", "null-space", "dopri5")],
)
def test_in_both_shapes_and_through_passages(name, method, integrator, shape):
    if shape == "looped" and METHODS.get(method).dense:
        return
    sim, plain = both(name, method=method, integrator=integrator, shape=shape, until=2.0)
    for run in (sim, plain):
        for k in range(1, 6):
            run.run(0.4 * k)
    assert_same(sim, plain)


@pytest.mark.parametrize("integrator", ["rk4", "radau5"])
def test_rows_are_chosen_anew_on_the_way(integrator, monkeypatch):
    chosen, ended = [], Simulation._note_end
    monkeypatch.setattr(Simulation, "_note_end", lambda self, code, t: chosen.append(code) or ended(self, code, t))
    sim, plain = both(
        DEFECTS / "two_pins_tilted.toml", method="lagrange", integrator=integrator, until=1.0, shape="straight"
    )
    for run in (sim, plain):
        chosen.clear()
        for k in range(1, 11):
            run.step(0.1) if integrator == "radau5" else run.run(0.1 * k)
        assert abi.CHOOSE in chosen
    assert_same(sim, plain)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("integrator", ["radau5", "sdirk"])
def test_room_for_factors_is_made_on_the_way(integrator):
    """A matrix that does not fit ends the loop; it is entered again with more room, and nothing else is different."""
    sim, plain = both("bricard", method="lagrange", integrator=integrator, shape="looped", until=0.01)
    for plan in ("plan", "filter_plan"):
        getattr(sim._loop.scheme, plan)[sparse.ROOM] = 3
    for run in (sim, plain):
        for _ in range(5):
            run.step(2e-3)
    np.testing.assert_array_equal(sim.state, plain.state)
    assert sim.steps == plain.steps and len(sim._loop.scheme.numbers) > len(plain._loop.scheme.numbers)
    saved = sim.save()
    sim.step(2e-3)
    state = sim.state.copy()
    sim.restore(saved)
    sim.step(2e-3)
    np.testing.assert_array_equal(sim.state, state)


@pytest.mark.slow
def test_without_compilation_steps_are_plain_python(tmp_path):
    code = (
        "import symgen\n"
        "sim = symgen.load('pendulum').start(integrator='rk4', step=1e-2, shape='straight')\n"
        "assert sim._loop._entry is None\n"
        "sim.step(0.05)\n"
        "saved = sim.save()\n"
        "sim.set(bob_mass=2.0)\n"
        "sim.restore(saved)\n"
        "print(*sim.state.tolist())"
    )
    environment = {**os.environ, "NUMBA_DISABLE_JIT": "1"}
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, env=environment)
    sim = symgen.load("pendulum").start(integrator="rk4", step=1e-2, shape="straight")
    sim.step(0.05)
    np.testing.assert_allclose([float(x) for x in done.stdout.split()], sim.state, rtol=1e-13)


# -- the trampoline ----------------------------------------------------------------------------------------------------


N, F = types.int64, types.float64


@jit(F(F, N, F[::1], types.RecordType((N[::1], N[::1])), F[:, ::1]))
def mixed(x, n, a, pair, m):
    total = x + n + m.shape[0] * m[1, 2] + pair[0][1] - pair[1].shape[0]
    for i in range(a.shape[0]):
        total += (i + 1) * a[i]
        a[i] = -a[i]
    return total


def test_all_kinds_of_arguments_arrive():
    """A function that uses all parts of its arguments, called with a block that is laid out by hand."""
    call = calls.trampoline(mixed.signature, object_file)
    a, b, c, m = np.arange(1.0, 4.0), np.array([5, 6]), np.arange(7), np.arange(12.0).reshape(3, 4)
    flat = [0, 11]
    for array in (a, b, c, m):
        flat += [array.ctypes.data, *array.shape]
    source, target = np.array([1.5, 2.5]), np.zeros(2)
    block = np.zeros(calls.FIRST + len(flat), dtype=np.int64)
    block[calls.FIRST :] = flat
    block.view(np.float64)[calls.FIRST] = 0.25
    block[calls.FUNCTION] = mixed.address(mixed.signature)
    block[[calls.COPY, calls.SOURCE, calls.BYTES]] = target.ctypes.data, source.ctypes.data, 16
    call(block.ctypes.data)
    expected = mixed(0.25, 11, np.arange(1.0, 4.0), (b, c), m)
    assert block.view(np.float64)[calls.RESULT] == expected == 0.25 + 11 + 3 * 6.0 + 6 - 7 + 1.0 + 4.0 + 9.0
    np.testing.assert_array_equal(a, [-1.0, -2.0, -3.0])
    np.testing.assert_array_equal(target, source)


@pytest.mark.parametrize(
    ("position", "argument"),
    [(2, np.zeros(6)[::2]), (2, np.zeros(3, int)), (2, [1.0]), (3, (np.arange(2),)), (4, np.zeros(3)), (0, "x")],
)
def test_arguments_of_other_types_are_refused(position, argument):
    arguments = [0.25, 11, np.zeros(3), (np.arange(2), np.arange(2)), np.zeros((2, 3))]
    arguments[position] = argument
    with pytest.raises((TypeError, ValueError, AttributeError)):
        mixed(*arguments)
    with pytest.raises(TypeError, match="expected 5 arguments, got 1"):
        mixed(0.25)
