"""Runs that are left after some steps, saved, restored and gone on with: bit for bit the runs that were not."""

from support.remembering import PAIRS

from symgen.base.settings import Settings
from symgen.derive.methods import METHODS
from symgen.run.integrators import INTEGRATORS
from symgen.run.planning.prepare import prepare

STEP, STEPS = 2e-3, 12


def prepared(model, method, integrator, **more):
    """Return what makes simulations of a run, which does not start at rest."""
    settings = Settings(method=method, integrator=integrator, max_violation=1.0, max_energy_error=1e9, **more)
    return prepare(model.mechanism, settings).simulation


def test_every_integrator_is_among_them():
    assert {integrator for _, integrator in PAIRS} == set(INTEGRATORS.names)
    assert {method for method, _ in PAIRS} >= {name for name in METHODS.names if METHODS.get(name).integrates != "all"}
