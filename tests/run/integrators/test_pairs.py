"""Which pairs of method and integrator fit, and the page that says so."""

from pathlib import Path

import pytest

from benchmarks import pairs
from symgen.api import load
from symgen.base.errors import InputError
from symgen.base.settings import Settings
from symgen.derive.methods import METHODS
from symgen.derive.methods._base import EXPLICIT_FORMS
from symgen.run.integrators import INTEGRATORS
from symgen.run.planning.prepare import make_plan

ALL = [(m, i) for m in METHODS.names for i in INTEGRATORS.names]


def test_the_page_is_up_to_date():
    page = Path(__file__).parents[3] / "docs" / "tables" / "pairs.md"
    assert page.read_text(encoding="utf-8") == pairs.page(), "run python -m benchmarks.pairs > docs/tables/pairs.md"


def test_a_plan_is_made_for_exactly_the_pairs_of_the_table():
    model, made = load("pendulum"), []
    for method, integrator in ALL:
        try:
            plan = make_plan(model.mechanism, Settings(method=method, integrator=integrator))
        except InputError as refusal:
            assert "these do: " in str(refusal)
            continue
        made.append((method, integrator))
        assert plan.choice.implicit == (not EXPLICIT_FORMS & set(INTEGRATORS.get(integrator).forms))
    assert sorted(made) == sorted(pairs.allowed_pairs())


@pytest.mark.parametrize("method", METHODS.names)
def test_every_method_fits_its_default(method):
    assert pairs.forms_in_common(method, METHODS.get(method).default_integrator)


def test_every_integrator_fits_a_method():
    assert {i for _, i in pairs.allowed_pairs()} == set(INTEGRATORS.names)


def test_nothing_undamped_solves_index_3_without_projections():
    assert [i for m, i in pairs.allowed_pairs() if "index-3" in METHODS.get(m).forms] == ["generalized-alpha", "hht"]
