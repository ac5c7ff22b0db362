"""Rows of sweeps whose drivers lock say so as runs by themselves."""

import copy
from typing import Any

import pytest
from support.locks import SLIDER

import symgen
from symgen.describe.files.validate import validate


@pytest.mark.parametrize("settings", [{}, {"integrator": "rk4", "step": 1e-3}], ids=["default", "rk4"])
@pytest.mark.fast("rk4")
def test_rows_name_dead_centres(settings: dict[str, Any]) -> None:
    description = copy.deepcopy(SLIDER)
    description["parameters"] = {"speed": 1.0}
    description["joints"]["motor"]["value"] = "speed*t"
    model = symgen.Model(validate(description, "lock"))
    rows = model.sweep({"speed": [0.2, 1.0, 2.0]}, until=2.0, **settings)
    assert list(rows.status) == ["ok", "failed", "failed"] and rows.reason[0] == ""
    for speed, reason in zip((1.0, 2.0), rows.reason[1:], strict=True):
        alone = model.simulate(parameters={"speed": speed}, until=2.0, verify=False, **settings)
        assert alone.reason.startswith("dead centre at t = ") and reason == alone.reason
