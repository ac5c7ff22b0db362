"""Parts of the looped shape: instances, elimination, sharing, choice of the shape, starts of large mechanisms."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.checks import RANDOM

from symgen.api import load
from symgen.base.errors import InputError
from symgen.base.settings import Settings
from symgen.compile.store.paths import ENVIRONMENT_VARIABLE
from symgen.compile.store.stats import cache_stats
from symgen.derive.lower.factor import Elimination
from symgen.derive.lower.looped.forms import form_key
from symgen.derive.lower.looped.instances import instances_of_mechanism
from symgen.derive.lower.looped.looped_law import is_loopable, refuse_dense
from symgen.derive.methods import METHODS
from symgen.derive.methods._base import MultiplierMethod
from symgen.run.compiling.choices import choose_shape
from symgen.run.compiling.looped import LoopedStages
from symgen.run.compiling.method_choice import MethodChoice, choose_method
from symgen.run.compiling.pipeline import compile_model, generate_in_stages
from symgen.run.planning import automatic
from symgen.run.planning.prepare import make_plan
from symgen.run.starts import decisions

DATA = Path(__file__).parents[1] / "data"


# -- elimination -------------------------------------------------------------------------------------------------------


def pattern(rng: np.random.Generator) -> list[frozenset[int]]:
    """A random symmetric pattern: for each row the others it has an entry with."""
    entries = rng.random((n := int(rng.integers(1, 15)), n)) < rng.random() * 0.7
    return [frozenset(int(j) for j in np.flatnonzero(row) if j != i) for i, row in enumerate(entries | entries.T)]


@RANDOM
@given(st.integers(0, 10**6))
def test_panels_hold_a_factor(seed):
    """Read as their table says, the panels factorise a matrix: checked against NumPy's solution."""
    rng = np.random.default_rng(seed)
    neighbours = pattern(rng)
    n = len(neighbours)
    values = rng.uniform(-1.0, 1.0, (n, n))
    matrix = np.diag([n + 1.0] * n)
    for i, near in enumerate(neighbours):
        for j in near:
            matrix[i, j] = values[min(i, j), max(i, j)]
    elimination = Elimination.lay_out(neighbours)
    panels = np.zeros(elimination.size)
    for i in range(n):
        for j in (i, *sorted(neighbours[i])):
            panels[elimination.place_of_entry(i, j)] = matrix[i, j]
    table = elimination.lists_for_code()
    right = np.arange(1.0, n + 1.0)
    x, starts = right.copy(), table[2 + n : 2 + n + table[0]]
    nodes = []
    for at in starts:
        c, r, first = table[at : at + 3]
        rows = table[at + 3 : at + 3 + c + r]
        targets = iter(table[at + 3 + c + r :])
        block = panels[first : first + (c + r) * c].reshape(c + r, c)
        lower, pivots = np.eye(c + r)[:, :c], np.zeros(c)
        rest = block.copy()
        for k in range(c):
            pivots[k] = rest[k, k]
            lower[k:, k] = rest[k:, k] / pivots[k]
            rest[k:, k:] -= np.outer(lower[k:, k], pivots[k] * lower[k:c, k])
        for i in range(r):
            for j in range(i + 1):
                panels[next(targets)] -= lower[c + i] * pivots @ lower[c + j]
        for k in range(c):
            for i in range(k + 1, c + r):
                x[rows[i]] -= lower[i, k] * x[rows[k]]
        nodes.append((rows, c, r, lower, pivots))
    for rows, c, r, lower, pivots in reversed(nodes):
        for k in range(c - 1, -1, -1):
            x[rows[k]] = x[rows[k]] / pivots[k] - sum(lower[i, k] * x[rows[i]] for i in range(k + 1, c + r))
    np.testing.assert_allclose(x, np.linalg.solve(matrix, right), rtol=1e-9, atol=1e-12)


# -- sharing -----------------------------------------------------------------------------------------------------------


def test_kernels_do_not_know_their_mechanism():
    choices = (choose_method("lagrange", implicit=True),)
    few, many = (
        generate_in_stages(LoopedStages(load(name).mechanism, choices)).modules for name in ("four-bar", "n-four-bar:7")
    )
    common = few.keys() & many.keys() - {"mechanism"}
    assert {"machine", "model", "law_lagrange"} <= common
    for prefix in ("joint_revolute", "form_"):
        assert sum(stem.startswith(prefix) for stem in common) == (2 if prefix == "joint_revolute" else 3)
    for stem in common:
        assert few[stem] == many[stem]


def test_numbers_are_data_and_zeros_are_kinds():
    keys = {}
    for name in ("four-bar", "n-four-bar:3"):
        for instance in instances_of_mechanism(load(name).mechanism):
            keys.setdefault(instance.kind, set()).add(instance.key)
    assert len(keys["body"]) == 1
    assert len(keys["joint"]) == 2  # on the ground, and between bodies


def test_a_new_mechanism_of_known_kinds_compiles_nothing():
    load("n-four-bar:4").simulate(method="lagrange", until=0.01, shape="looped")
    before = cache_stats()["misses"]
    result = load("n-four-bar:5").simulate(method="lagrange", until=0.01, shape="looped")
    assert result.status == "ok"
    assert cache_stats()["misses"] == before


def test_implicit_runs_of_known_kinds_compile_nothing():
    keys = {"method": "lagrange", "integrator": "sdirk", "until": 0.01, "shape": "looped"}
    load("n-four-bar:2").simulate(**keys)
    before = cache_stats()["misses"]
    assert load("n-four-bar:5").simulate(**keys).status == "ok"
    assert cache_stats()["misses"] == before


def test_equal_constraints_share_kernels():
    def key(name):
        return form_key(METHODS.get(name), METHODS.get(name).complete_options({}))

    assert key("lagrange") == key("direct-correction") == key("velocity-projection")
    names = ("lagrange", "baumgarte", "penalty", "ggl", "generalized-alpha", "index3-augmented-lagrangian")
    assert len({key(name) for name in names}) == len(names)


class Weighed(MultiplierMethod):
    """Constraints that ask for the masses of all bodies."""

    name = "weighed"
    summary = reference = "a method of a test"

    def target(self, system):
        return system.gamma - system.D @ system.minv(system.D.transposed(system.phi))


def test_constraints_that_ask_for_more_than_their_joint_have_straight_code():
    method = Weighed()
    options = method.complete_options({})
    assert not is_loopable(method, options, True)
    with pytest.raises(InputError, match=r"'weighed', whose constraints ask for '(transposed|minv)'"):
        refuse_dense(method, options, True)
    choice = MethodChoice(method, options, True)
    assert choose_shape(load("four-bar").mechanism, choice, "auto", 1e4).name == "straight"


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("method", "integrator"),
    [("direct-correction", "radau5"), ("ggl", "radau5"), ("generalized-alpha", "generalized-alpha")],
)
def test_large_mechanisms_have_implicit_runs(method, integrator):
    options = {"integrator.adaptive": "false"} if integrator == "radau5" else {}
    keys = {"method": method, "integrator": integrator, "options": options, "shape": "looped"}
    run = load("n-four-bar:100").simulate(step=1e-3, until=5e-3, **keys)
    assert (run.status, run.steps) == ("ok", 5)
    assert run.position_violation_max < 1e-10 and run.energy_drift_max < 1e-3


# -- which shape -------------------------------------------------------------------------------------------------------


@pytest.fixture
def empty_cache(tmp_path, monkeypatch):
    monkeypatch.setenv(ENVIRONMENT_VARIABLE, str(tmp_path))


def test_long_runs_of_small_mechanisms_are_straight_and_large_mechanisms_looped(empty_cache):
    choice = choose_method("direct-correction")
    small, large_one = load("four-bar").mechanism, load("n-four-bar:150").mechanism
    assert choose_shape(small, choice, "auto", 1e9).name == "straight"
    assert choose_shape(large_one, choice, "auto", 1.0).name == "looped"
    chosen = choose_shape(load("n-four-bar:60").mechanism, choice, "auto", 1e4)
    assert chosen.name == "looped"
    assert "363 coordinates" in chosen.reason


@pytest.mark.parametrize("weight", ["identity", "body"])
def test_the_metric_of_bodies_is_the_identity_in_their_own_coordinates(weight, empty_cache):
    """What is asked for as the one is judged, found and run as the other."""
    mechanism = load("pendulum").mechanism
    asked, identity = (choose_method("direct-correction", {"weight": name}) for name in (weight, "identity"))
    assert choose_shape(mechanism, asked, "looped", 1e4).name == "looped"
    assert choose_shape(mechanism, asked, "auto", 1.0) == choose_shape(mechanism, identity, "auto", 1.0)
    assert compile_model(mechanism, asked).law == compile_model(mechanism, identity).law


@pytest.mark.slow_cases("chain:10-10000.0-looped")
@pytest.mark.parametrize(
    ("model", "evaluations", "shape"), [("four-bar", 1e4, "straight"), ("chain:10", 1e4, "looped")]
)
def test_the_shape_is_the_same_whatever_the_cache_holds(model, evaluations, shape, empty_cache):
    """Shapes differ by rounding: a run has the same digits on another day."""
    mechanism, choice = load(model).mechanism, choose_method("lagrange")
    before = choose_shape(mechanism, choice, "auto", evaluations)
    assert before.name == shape
    for other in ("looped", "straight"):
        compile_model(mechanism, replace(choice, shape=other))
        assert choose_shape(mechanism, choice, "auto", evaluations) == before
    assert choose_shape(mechanism, choice, "auto", 1e12).name == "straight"


@pytest.mark.parametrize("method", ["null-space", "coordinate-partitioning", "augmented-hamiltonian"])
def test_dense_methods_have_no_loops_and_a_largest_size(method, empty_cache):
    choice, small = choose_method(method), load("four-bar").mechanism
    assert choose_shape(small, choice, "auto", 1e4).name == "straight"
    with pytest.raises(InputError, match=f"'{method}', .*; the straight shape is for it"):
        choose_shape(small, choice, "looped", 1e4)
    with pytest.raises(InputError, match="at most 400 coordinates"):
        choose_shape(load("n-four-bar:80").mechanism, choice, "auto", 1e4)


def test_implicit_integrators_have_both_shapes_at_any_size():
    assert make_plan(load("four-bar").mechanism, Settings(integrator="radau5", shape="looped")).choice.shape == "looped"
    assert make_plan(load("n-four-bar:250").mechanism, Settings(integrator="radau5")).choice.shape == "looped"


def test_unknown_shapes_are_refused():
    with pytest.raises(InputError, match="one of auto, straight, looped, got 'lopped'"):
        make_plan(load("four-bar").mechanism, Settings(shape="lopped"))


class Smooth(MultiplierMethod):
    """Drift fed back: nothing but products and sums of whole vectors."""

    name = "smooth"
    summary = reference = "a method of a test"

    def target(self, system):
        drift = system.D @ system.v - system.nu
        return system.gamma - drift - drift


class Picky(Smooth):
    """Asks for gamma at other velocities than the state's."""

    name = "picky"

    def target(self, system):
        return system.at_velocity(system.gamma, system.zeros("nv"))


def test_a_method_from_outside_has_both_shapes_if_its_formula_is_one_on_vectors():
    smooth, picky = Smooth(), Picky()
    assert is_loopable(smooth, smooth.complete_options({}), True)
    assert not is_loopable(picky, picky.complete_options({}), False)
    with pytest.raises(InputError, match="'picky', whose formula asks for 'at_velocity'; the straight shape is for it"):
        refuse_dense(picky, picky.complete_options({}), False)


def test_auto_takes_large_mechanisms_without_their_eigenvalues(monkeypatch):
    def refused(*_):
        raise AssertionError("eigenvalues of a large mechanism were asked for")

    monkeypatch.setattr(automatic, "linearise_start", refused)
    plan = make_plan(load("n-four-bar:60").mechanism, Settings(method="auto", integrator="auto"))
    assert (plan.settings.method, plan.settings.integrator) == ("direct-correction", "dop853")
    assert "with 1088 unknowns a stage, stiffness was not tested" in plan.notes[-1]


# -- large mechanisms --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("given_velocities", ["all", "some", "contradicting"])
def test_sparse_starts_are_the_dense_ones(monkeypatch, given_velocities):
    model = load("n-four-bar:4")
    mechanism = model.mechanism
    if given_velocities != "all":
        bodies = list(mechanism.bodies)
        nothing = (None, None)
        for i in range(1, len(bodies)):
            bodies[i] = structs_replace(bodies[i], velocity=nothing, angular_velocity=None)
        if given_velocities == "contradicting":
            bodies[3] = structs_replace(bodies[3], velocity=mechanism.bodies[1].velocity)
            bodies[3] = structs_replace(bodies[3], angular_velocity=mechanism.bodies[0].angular_velocity)
        model = replace(model, mechanism=structs_replace(mechanism, bodies=tuple(bodies)))
    compiled = model.compile("lagrange", shape="looped")
    dense = model.assemble(compiled)
    monkeypatch.setattr(decisions, "LARGEST_DENSE", 0)
    sparse = model.assemble(compiled)
    np.testing.assert_allclose(sparse.y, dense.y, atol=1e-10)
    assert (sparse.rank, sparse.redundant_rows) == (dense.rank, dense.redundant_rows)


def structs_replace(struct, **changes):
    import msgspec

    return msgspec.structs.replace(struct, **changes)


def test_sparse_starts_find_lasting_redundancy(monkeypatch):
    from support.emitted import mechanism_of
    from support.models import parallelogram

    model = load(mechanism_of(parallelogram()))
    compiled = model.compile("direct-correction", shape="looped")
    dense = model.assemble(compiled)
    monkeypatch.setattr(decisions, "LARGEST_DENSE", 0)
    sparse = model.assemble(compiled)
    assert len(dense.redundant_rows) == 1
    assert sparse.redundant_rows == dense.redundant_rows
    assert sparse.rank == dense.rank == 11
    np.testing.assert_allclose(sparse.y, dense.y, atol=1e-9)


def test_forty_windows_stay_on_the_official_solution():
    """IFToMM benchmark A02: 20 s through twenty singular positions; the file has six digits, its bound is 1e-3."""
    official = np.loadtxt(DATA / "a02_official_n40.csv", delimiter=",")
    result = load("n-four-bar:40").simulate(
        **{"integrator": "dop853", "rtol": 1e-9, "atol": 1e-9, "until": 20.0, "times": official[:, 0]},
        **{"shape": "looped", "options": {"method.weight": "mass"}},
    )
    assert result.status == "ok"
    theta = result["vertical0.theta"]
    x, y = result["vertical0.x"] + 0.5 * np.cos(theta), result["vertical0.y"] + 0.5 * np.sin(theta)
    assert np.hypot(x - official[:, 1], y - official[:, 2]).max() < 2e-5
