"""Rows that are off in a part of a run: the motion is that of the mechanism without them."""

from functools import cache

import msgspec
import numpy as np
import pytest
from support.set_modes import set_modes
from support.switching import with_switchable

import symgen
from symgen.base.errors import InputError
from symgen.base.ir.program import MODE_NUMBERS
from symgen.base.settings import Settings
from symgen.describe.facts.digest import digest
from symgen.describe.facts.repeats import without_repeats
from symgen.describe.mechanism import Mechanism
from symgen.run.layout import abi
from symgen.run.planning.prepare import Prepared, prepare
from symgen.run.single.run import outcome_of
from symgen.run.single.simulation import Simulation
from symgen.run.starts.assembler import Assembly

RELEASED, TOLERANCE = 0.5, 1e-13
NOTHING = np.zeros(0)
EXPLICIT = ("rk4", "dop853", "picard")
#: Methods, integrators, and the largest difference: laws that iterate end at a tolerance.
LAWS = (
    *((method, integrator, 1e-12) for method in ("lagrange", "baumgarte") for integrator in (*EXPLICIT, "radau5")),
    *(("direct-correction", integrator, 1e-12) for integrator in (*EXPLICIT, "radau5")),
    *(("udwadia-kalaba", integrator, 1e-12) for integrator in EXPLICIT),
    *(("augmented-lagrangian", integrator, 1e-9) for integrator in EXPLICIT),
    ("ggl", "radau5", 1e-12),
    *((method, "rk4", 1e-12) for method in ("post-stabilization", "invariant-stabilization", "compliant-constraints")),
    *((method, "rk4", 1e-9) for method in ("mass-orthogonal-projection", "hamiltonian-baumgarte")),
    ("penalty", "rk4", 1e-6),  # rounding times the penalty
    ("velocity-projection", "rk4", 1e-12),
    *((method, "dop853", 1e-11) for method in ("null-space", "coordinate-partitioning", "dependent-correction")),
    ("stiffness-scaled-penalty", "rk4", 1e-12),
    ("generalized-alpha", "generalized-alpha", 1e-9),
)


#: Pairs of a kind each, tried on several loops as well.
SEVERAL = (("direct-correction", "picard"), ("lagrange", "dop853"), ("ggl", "radau5"), ("null-space", "dop853"))


@cache
def catalogued(name: str) -> tuple[Mechanism, Mechanism, str]:
    """Return a mechanism of the catalogue, the one without its last joint, and the name of that joint."""
    whole = symgen.load(name).mechanism
    *others, last = whole.joints
    return whole, msgspec.structs.replace(whole, joints=tuple(others), outputs=()), last.name


def ready(mechanism: Mechanism, until: float, method="lagrange", integrator="rk4", coordinates="absolute") -> Prepared:
    steps = {"step": 1e-3} if integrator in ("rk4", "generalized-alpha") else {"rtol": TOLERANCE, "atol": TOLERANCE}
    limits = {"max_violation": 1e-6, "max_energy_error": 1e6, "verify": False, "shape": "straight"}
    return prepare(
        mechanism,
        Settings(method=method, integrator=integrator, coordinates=coordinates, until=until, **steps, **limits),
    )


def moved(simulation: Simulation, y: np.ndarray, duration: float) -> np.ndarray:
    """Return q and v after a motion that begins at others."""
    simulation.state.y[: len(y)] = y
    assert simulation.enter(simulation.outputs(NOTHING), until=duration) == abi.DONE
    return simulation.state.y[: len(y)].copy()


def switch(simulation: Simulation, held: float) -> None:
    """Set all rows that may be off to in force (1) or off (0)."""
    info = simulation.compiled.info
    set_modes(simulation, {info.rows[i].name: (held, 0.0, 0.0, 0.0) for i in info.switchable})


def released(run: Prepared, until: float, times=NOTHING):
    """Run with the last joint off from 0.5 s on; return the simulation, its outputs, and q and v at both times."""
    simulation, n = run.simulation(), run.compiled.info.work
    outputs = simulation.outputs(np.asarray(times))
    assert simulation.enter(outputs, until=RELEASED) == abi.DONE
    before = simulation.state.y[:n].copy()
    switch(simulation, 0.0)
    assert simulation.enter(outputs, until=until) == abi.DONE
    return simulation, outputs, before, simulation.state.y[:n].copy()


#: All laws with a loop, and some with three, well before 0.71 s: there the loops that are left pass a singular
#: position, which amplifies rounding.
RELEASES = [
    *((*law, "four-bar", 0.8) for law in LAWS),
    *((*law, "n-four-bar:3", 0.65) for law in LAWS if law[:2] in SEVERAL),
]


@pytest.mark.by_turns(8)
@pytest.mark.fast("compliant-constraints-rk4-1e-12-four-bar-0.8", "penalty-rk4-1e-06-four-bar-0.8")
@pytest.mark.parametrize(("method", "integrator", "most", "name", "until"), RELEASES)
def test_the_motion_is_that_without_the_joint(name, until, method, integrator, most) -> None:
    whole, less, joint = catalogued(name)
    run = ready(with_switchable(whole, joint), 1.0, method, integrator)
    simulation, _, before, after = released(run, until)
    alone = moved(ready(less, until - RELEASED, method, integrator).simulation(), before, until - RELEASED)
    np.testing.assert_allclose(after, alone, rtol=0, atol=most)
    compiled, state = run.compiled, simulation.state
    switchable = list(compiled.info.switchable)
    assert (
        compiled.off(state.w) == tuple(compiled.info.rows[i].name for i in switchable) == (f"{joint}.x", f"{joint}.y")
    )
    np.testing.assert_allclose(compiled.section(state.w, "multipliers")[switchable], 0.0, rtol=0, atol=1e-12)
    assert compiled.rank(state.w) == compiled.info.m - 2
    assert not compiled.redundant(state.w)
    assert state.control[abi.PASSAGES] == 0  # no passage


@pytest.mark.slow_cases("rk4", "picard")
@pytest.mark.parametrize("integrator", ["rk4", "picard"])
def test_a_passage_without_the_joint_is_noted_as_there(integrator: str) -> None:
    whole, less, joint = catalogued("n-four-bar:3")
    simulation, _, before, _ = released(ready(with_switchable(whole, joint), 1.0, "lagrange", integrator), 0.8)
    alone = ready(less, 0.3, "lagrange", integrator).simulation()
    moved(alone, before, 0.3)
    tables = [s.state.passages.reshape(-1, abi.N_PASSAGE)[: s.state.control[abi.PASSAGES]] for s in (simulation, alone)]
    assert len(tables[0]) == len(tables[1]) == 1
    np.testing.assert_array_equal(tables[0][:, abi.PASSAGE_RANK], tables[1][:, abi.PASSAGE_RANK])
    np.testing.assert_allclose(tables[0][0, abi.PASSAGE_IN], tables[1][0, abi.PASSAGE_IN] + RELEASED, rtol=0, atol=2e-3)


@pytest.mark.slow_cases("direct-correction-rk4", "lagrange-rk4")
@pytest.mark.parametrize("integrator", EXPLICIT)
@pytest.mark.parametrize("method", ["lagrange", "direct-correction"])
def test_joint_coordinates(method: str, integrator: str) -> None:
    whole, _, joint = catalogued("four-bar")
    mechanism = with_switchable(whole, joint)
    run = ready(mechanism, 1.0, method, integrator, "joint")
    simulation, outputs, _, _ = released(run, 0.8, [0.0, 0.8])
    bodies = run.of_bodies(outcome_of(simulation, outputs, abi.DONE))
    tight = ready(mechanism, 1.0, "lagrange", "dop853")
    _, _, _, absolute = released(tight, 0.8)
    n = tight.compiled.info.work
    np.testing.assert_allclose(bodies.states[-1, :n], absolute, rtol=0, atol=1e-8 if integrator == "rk4" else 1e-11)
    assert bodies.compiled.off(bodies.w) == (f"{joint}.x", f"{joint}.y")


@pytest.mark.parametrize("integrator", ["rk4", "dop853", "picard", "radau5"])
def test_on_again_after_closing(integrator: str) -> None:
    whole, _, joint = catalogued("four-bar")
    run = ready(with_switchable(whole, joint), 1.0, "lagrange", integrator)
    simulation, _, _, open_ = released(run, 0.8)
    state, info = simulation.state, run.compiled.info
    y = state.y[: info.ny].copy()
    Assembly(run.compiled).close(y, np.full(info.nv, np.nan), state.p.copy())
    assert np.abs(y[: info.nq] - open_[: info.nq]).max() > 0.01
    state.y[: info.work] = y[: info.work]
    switch(simulation, 1.0)
    assert simulation.enter(simulation.outputs(NOTHING), until=1.0) == abi.DONE
    alone = moved(ready(whole, 0.2, "lagrange", integrator).simulation(), y[: info.work], 0.2)
    np.testing.assert_allclose(state.y[: info.work], alone, rtol=0, atol=1e-12)
    assert run.compiled.off(state.w) == ()
    assert run.compiled.rank(state.w) == info.m
    assert state.control[abi.PASSAGES] == 0


def test_outputs_keep_the_modes() -> None:
    whole, _, joint = catalogued("four-bar")
    run = ready(with_switchable(whole, joint), 1.0)
    _, outputs, _, _ = released(run, 0.8, [0.1, 0.4, 0.6, 0.8])
    held = outputs.status[:, abi.N_STATUS + run.compiled.info.windings :: MODE_NUMBERS]
    np.testing.assert_array_equal(held, [[1.0, 1.0], [1.0, 1.0], [0.0, 0.0], [0.0, 0.0]])


def test_off_and_redundant_are_two_words() -> None:
    """A pin given twice: the second one repeats the first; where the first is off, the second one holds."""
    whole, _, joint = catalogued("four-bar")
    twin = msgspec.structs.replace(whole.joints[-1], name="twin")
    doubled = msgspec.structs.replace(whole, joints=(*whole.joints, twin))
    mechanism = with_switchable(doubled, joint)
    assert without_repeats(doubled)[1]
    assert not without_repeats(mechanism)[1]
    run = ready(mechanism, 1.0)
    simulation = run.simulation()
    compiled, w = run.compiled, simulation.state.w
    assert len(compiled.redundant(w)) == 2
    _, _, _, after = released(run, 0.8)
    alone = ready(whole, 0.8).simulation()
    assert alone.enter(alone.outputs(NOTHING), until=0.8) == abi.DONE
    np.testing.assert_allclose(after, alone.state.y[: len(after)], rtol=0, atol=1e-10)
    switch(simulation, 0.0)
    assert compiled.redundant(w) == ()
    assert compiled.off(w) == (f"{joint}.x", f"{joint}.y")
    switch(simulation, 1.0)
    assert len(compiled.redundant(w)) == 2
    assert compiled.off(w) == ()


def test_a_row_is_held_at_its_constant() -> None:
    whole, _, joint = catalogued("four-bar")
    simulation = ready(with_switchable(whole, joint), 1.0).simulation()
    compiled, w = simulation.compiled, simulation.state.w
    set_modes(simulation, {f"{joint}.x": (1.0, 0.1, 0.0, 0.0), f"{joint}.y": (0.0, 0.3, 1.0, 2.0)})
    np.testing.assert_allclose(compiled.section(w, "residual")[-2:], [-0.1, 0.0], rtol=0, atol=1e-14)
    np.testing.assert_array_equal(compiled.modes(w), [[1.0, 0.1, 0.0, 0.0, 0.0], [0.0, 0.3, 1.0, 2.0, 0.0]])


@pytest.mark.parametrize(
    ("method", "integrator"),
    [("half-explicit", "half-explicit"), ("rattle", "rattle")],
)
def test_methods_that_read_all_rows_are_refused(method: str, integrator: str) -> None:
    whole, _, joint = catalogued("four-bar")
    with pytest.raises(InputError, match="where rows may be off"):
        prepare(with_switchable(whole, joint), Settings(method=method, integrator=integrator, step=1e-3, until=1.0))


def test_wrong_modes_and_shapes_are_refused() -> None:
    whole, _, joint = catalogued("four-bar")
    mechanism = with_switchable(whole, joint)
    with pytest.raises(InputError, match="straight code where a file has rows that may be off"):
        prepare(mechanism, Settings(shape="looped", until=1.0))
    with pytest.raises(InputError, match="a joint of four-bar"):
        with_switchable(whole, "hinge")
    simulation = ready(mechanism, 1.0).simulation()
    with pytest.raises(InputError, match="a row that may be off"):
        set_modes(simulation, {f"{joint}.z": (0.0, 0.0, 0.0, 0.0)})
    with pytest.raises(InputError, match="1 or 0, a finite value, a sign of"):
        set_modes(simulation, {f"{joint}.x": (0.5, 0.0, 0.0, 0.0)})


def test_without_switchable_rows_nothing_changes() -> None:
    whole, _, joint = catalogued("four-bar")
    assert with_switchable(whole) == whole
    assert digest(with_switchable(whole, joint)) != digest(whole)
    assert "modes" not in ready(whole, 1.0).compiled.info.sections
