"""Bodies that are too light for a law's solver are found without the code of bodies, which trees do not need."""

import copy

import numpy as np
import pytest
from support.emitted import mechanism_of

from symgen import Settings, load
from symgen.compile.store.jit import MachineFunction
from symgen.describe.catalogue import raw
from symgen.run.planning.prepare import prepare
from symgen.run.planning.starts import DescribedStart
from symgen.run.starts import assembler
from symgen.run.starts.assembler import Assembly


@pytest.mark.parametrize(("mass", "expected"), [(8.0, False), (1e-9, True)])
def test_plain_python_finds_what_machine_code_finds(
    mass: float, expected: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    model = load("four-bar")
    compiled = model.compile("coordinate-partitioning")
    described = DescribedStart(model.mechanism, compiled, {"coupler_mass": mass}, ask_light=True)
    state, light = described.state(())  # machine code, which repeated starts use
    start = described.start(())
    assert start.light == light == expected
    np.testing.assert_array_equal(start.y[: compiled.info.nq], state.y[: compiled.info.nq])
    np.testing.assert_array_equal(start.w, state.w)
    monkeypatch.setattr(assembler, "plain_function_with_callees", lambda f: lambda *_: 1 // 0)
    assert described.start(()).light == expected  # an error in plain Python is no answer


@pytest.mark.slow
def test_trees_do_not_compile_the_right_hand_side_of_bodies() -> None:
    description = copy.deepcopy(raw("spatial-slider-crank"))
    description["mechanism"]["name"] = "tree-whose-bodies-are-not-compiled"
    run = prepare(mechanism_of(description), Settings(coordinates="joint", until=0.05))
    run.integrate()
    rhs = {name: f for name, f in vars(run.tree.bodies.law_module).items() if isinstance(f, MachineFunction)}
    assert "rhs" in rhs and not rhs["rhs"]._codes
    assert run.compiled.law_module.rhs._codes
    assert Assembly(run.tree.bodies, ask_light=True).layout.ask_light == 1, "or nothing is tested"
