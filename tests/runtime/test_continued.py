"""Runs that are left after some steps, saved, restored and gone on with: bit for bit the runs that were not."""

import pickle

import numpy as np
import pytest
from support.emitted import mechanism_of
from support.models import parallelogram
from support.remembering import CONSTANT, PAIRS

from symgen.api import load
from symgen.integrators import INTEGRATORS
from symgen.methods import METHODS
from symgen.running.prepare import prepare
from symgen.runtime import abi
from symgen.settings import Settings

STEP, STEPS = 2e-3, 12


def prepared(model, method, integrator, **more):
    """Return what makes simulations of a run, which does not start at rest."""
    settings = Settings(method=method, integrator=integrator, max_violation=1.0, max_energy_error=1e9, **more)
    return prepare(model.mechanism, settings).simulation


def arrays(simulation):
    """What a run keeps, without the flag and numbers of steps that are the caller's."""
    return simulation.save()


def assert_same(found, expected):
    for name, array in expected.items():
        np.testing.assert_array_equal(found[name], array, err_msg=name)


def test_every_integrator_is_among_them():
    assert {integrator for _, integrator in PAIRS} == set(INTEGRATORS.names)
    assert {method for method, _ in PAIRS} >= {name for name in METHODS.names if METHODS.get(name).integrates != "all"}


@pytest.mark.parametrize(("method", "integrator"), PAIRS)
def test_pieces_of_a_grid_are_one_run(method, integrator):
    """Constant steps, an output between two of them, a piece that begins where another ended."""
    more = CONSTANT if INTEGRATORS.get(integrator).adaptive else {}
    times = [STEP * x for x in (0.0, 1.0, 2.5, 3.0, 6.3, 11.0)]
    make = prepared(
        load("four-bar"), method, integrator, step=STEP, until=STEP * STEPS, times=times, shape="straight", **more
    )
    whole = make()
    outputs = whole.outputs(whole.spec.times)
    assert whole.enter(outputs) == abi.DONE
    assert whole.state.control[abi.STEPS] == STEPS
    part, kept = make(), make().outputs(whole.spec.times)
    for steps in (1, 2, 5, 6, STEPS):
        assert part.enter(kept, until=STEP * steps) == abi.DONE
        assert part.state.control[abi.STEPS] == steps
        saved, part = pickle.dumps(part.save()), make()
        part.restore(pickle.loads(saved))
    assert_same(arrays(part), arrays(whole))
    for found, expected in zip(kept, outputs, strict=True):
        np.testing.assert_array_equal(found, expected)


@pytest.mark.parametrize(("method", "integrator"), [p for p in PAIRS if INTEGRATORS.get(p[1]).adaptive])
def test_adaptive_runs_go_on_after_any_step(method, integrator):
    make = prepared(load("four-bar"), method, integrator, until=1.2, output_step=0.017, shape="straight")
    whole = make()
    outputs = whole.outputs(whole.spec.times)
    assert whole.enter(outputs) == abi.DONE
    part, kept, code = make(), make().outputs(whole.spec.times), abi.PAUSED
    while code == abi.PAUSED:
        code = part.enter(kept, pause=part.state.control[abi.STEPS] + 3)
        saved, part = part.save(), make()
        part.restore(saved)
    assert code == abi.DONE and whole.state.control[abi.STEPS] > 3
    assert_same(arrays(part), arrays(whole))
    for found, expected in zip(kept, outputs, strict=True):
        np.testing.assert_array_equal(found, expected)


@pytest.mark.parametrize("shape", ["straight", "looped"])
def test_in_space_with_redundant_rows_and_through_a_passage(shape):
    """What `watch` remembers of a passage, of turns and of partitions goes with the run."""
    for model, method, until in (
        (load("bricard"), "direct-correction", 0.02),
        (load(mechanism_of(parallelogram())), "coordinate-partitioning", 1.0),
        (load("n-four-bar:1"), "null-space", 1.0),
    ):
        if shape == "looped" and METHODS.get(method).dense:
            continue
        make = prepared(model, method, "rk4", step=1e-3, until=until, times=[until], shape=shape)
        whole, part = make(), make()
        assert whole.enter(whole.outputs(whole.spec.times)) == abi.DONE
        for steps in (3, 0.43 * until / 1e-3, 0.44 * until / 1e-3, until / 1e-3):
            assert part.enter(part.outputs(np.zeros(0)), until=1e-3 * round(steps)) == abi.DONE
            saved, part = part.save(), make()
            part.restore(saved)
        saved = arrays(whole)
        saved["control"][abi.OUTPUTS] = 0  # the pieces were asked for none
        assert_same(arrays(part), saved)


def test_a_stopped_run_goes_on():
    """The flag that an interrupt raises: nothing is lost by it."""
    make = prepared(load("four-bar"), "lagrange", "dopri5", until=0.3, times=[0.3], shape="straight")
    whole, part = make(), make()
    outputs, kept = whole.outputs(whole.spec.times), part.outputs(whole.spec.times)
    whole.enter(outputs)
    assert part.enter(kept, pause=4) == abi.PAUSED
    part.state.control[abi.STOP] = 1
    assert part.enter(kept) == abi.STOPPED
    part.state.control[abi.STOP] = 0
    assert part.enter(kept) == abi.DONE
    assert_same(arrays(part), arrays(whole))


def test_an_end_between_two_steps_begins_a_new_grid():
    make = prepared(load("four-bar"), "lagrange", "rk4", step=0.01, until=0.1, times=[0.1], shape="straight")
    part = make()
    outputs = part.outputs(np.zeros(0))
    assert part.enter(outputs, until=0.035) == abi.DONE
    assert part.state.clock[abi.TIME] == 0.035 and part.state.control[abi.STEPS] == 4
    assert part.enter(outputs, until=0.075) == abi.DONE
    assert part.state.control[abi.STEPS] == 8 and part.state.clock[abi.STEP] == 0.01
    assert abs(part.state.clock[abi.TIME] - 0.075) < 1e-15


@pytest.mark.parametrize(
    ("method", "integrator"),
    [
        pytest.param("lagrange", "radau5", marks=pytest.mark.slow),
        pytest.param("ggl", "radau5", marks=pytest.mark.slow),
        pytest.param("lagrange", "sdirk", marks=pytest.mark.slow),
    ],
)
def test_room_for_factors_is_made_while_a_run_goes_on(method, integrator):
    """A matrix that does not fit ends the loop; it is entered again with more room, and nothing else is different."""
    make = prepared(load("bricard"), method, integrator, until=0.01, times=[0.01], shape="looped")
    whole, tight = make(), make()
    from symgen.runtime import sparse

    for plan in ("plan", "filter_plan"):
        getattr(tight.scheme, plan)[sparse.ROOM] = 3
    assert whole.enter(whole.outputs(whole.spec.times)) == abi.DONE
    assert tight.enter(tight.outputs(whole.spec.times)) == abi.DONE
    np.testing.assert_array_equal(tight.state.y, whole.state.y)
    assert tight.state.control[abi.STEPS] == whole.state.control[abi.STEPS]
    assert len(tight.scheme.numbers) > len(whole.scheme.numbers)
