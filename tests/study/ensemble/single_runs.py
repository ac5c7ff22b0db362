"""Rows of sweeps against single runs of the same models."""

import numpy as np
from support.checks import assert_same_motion


def column_of(one, name):
    """Values of a quantity of sweeps in a single run."""
    if name == "smallest_pivot":
        return one.smallest_pivot
    return one[name]


def assert_row(sweep, i, one):
    """A row has the quantities, the numbers and the judgement of a single run."""
    outputs = len(one.t)
    for j, q in enumerate(sweep.ensemble.recipe.quantities):
        assert_same_motion(sweep.values[i, j, :outputs], column_of(one, q.name), q.name)
        assert np.all(np.isnan(sweep.values[i, j, outputs:]))
    assert (sweep.status[i], sweep.reason[i]) == (one.status, one.reason or "")
    for name in ("steps", "rejected", "evaluations", "rank_event_count"):
        assert sweep[name].ravel()[i] == getattr(one, name), name
    for name in ("position_violation_max", "velocity_violation_max", "energy_drift_max"):
        assert_same_motion(sweep[name].ravel()[i], getattr(one, name), name)


def assert_rows(sweep, model, how="parameters", **settings):
    """Every row is its single run, what varies being parameters or the start."""
    for i in range(len(sweep)):
        values = sweep.ensemble.grid.values(i, i + 1)
        assert_row(sweep, i, model.simulate(**{how: {name: float(v[0]) for name, v in values.items()}}, **settings))
