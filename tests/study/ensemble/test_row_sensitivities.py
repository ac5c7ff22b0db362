"""Sensitivities of the rows of sweeps, against differences of rows that compiled loops of sweeps made."""

import numpy as np
import pytest

import symgen
from symgen import InputError

SETTINGS = {"until": 0.6, "times": [0.3, 0.6], "method": "lagrange", "integrator": "rk4", "step": 2e-3}


@pytest.mark.slow_cases("joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_rows_against_differences_of_rows(coordinates):
    settings = {**SETTINGS, "coordinates": coordinates}
    mass = 2.0 + 0.02 * np.arange(-2, 3)
    vary = {"crank_mass": mass, "crank.omega": [0.0, 1.0]}
    sweep = symgen.sweep(
        "four-bar", vary, quantities=["crank.theta", "v", "energy"], coordinates=coordinates, **SETTINGS
    )
    derivatives = sweep.sensitivities(("crank_mass", "crank.omega"))
    assert "energy" not in derivatives.quantities
    assert list(derivatives.status) == ["ok"] * 10
    for name in ("crank.theta", "coupler.vx"):
        values = sweep[name]
        slopes = (8.0 * (values[3] - values[1]) - (values[4] - values[0])) / (12.0 * 0.02)
        assert derivatives[name].shape == (5, 2, 2, 2)
        np.testing.assert_allclose(derivatives[name][2, ..., 0], slopes, rtol=1e-7, atol=1e-9)
        single = symgen.simulate(
            "four-bar", start={"crank.omega": 1.0}, sensitivities="crank.omega", **settings
        ).gradient(name)["crank.omega"]
        np.testing.assert_allclose(derivatives[name][2, 1, :, 1], single, rtol=1e-11, atol=1e-13)


@pytest.mark.slow
def test_files_have_one_dimension_more(tmp_path):
    xarray = pytest.importorskip("xarray")
    sweep = symgen.sweep("four-bar", {"crank_mass": [1.0, 2.0]}, quantities=["crank.theta"], **SETTINGS)
    derivatives = sweep.sensitivities(("bodies.coupler.points.C[0]", "crank_mass"))
    with xarray.open_dataset(derivatives.save(tmp_path / "rows.nc"), engine="h5netcdf") as data:
        slopes = data["sensitivity_crank.theta"]
        assert slopes.dims == ("crank_mass", "time", "direction")
        assert slopes.attrs["units"] == "rad/m; rad/kg"
        assert data["direction"].values.tolist() == ["bodies.coupler.points.C[0]", "crank_mass"]
        np.testing.assert_array_equal(slopes.values, derivatives["crank.theta"])
        np.testing.assert_array_equal(data["crank.theta"].values, sweep["crank.theta"])


def test_a_row_that_fails_has_its_reason():
    sweep = symgen.sweep("four-bar", {"crank_mass": [2.0, -1.0]}, quantities=["crank.theta"], **SETTINGS)
    derivatives = sweep.sensitivities("rocker_mass")
    assert derivatives.status.tolist() == ["ok", "failed"]
    assert derivatives.reason[1]
    assert np.isfinite(derivatives.values[0]).all()
    assert np.isnan(derivatives.values[1]).all()


def test_what_has_no_derivatives_is_refused():
    sweep = symgen.sweep("four-bar", {"crank_mass": [2.0]}, quantities=["energy"], **SETTINGS)
    with pytest.raises(InputError, match=r"expected a sweep that keeps a quantity with derivatives, .* got energy"):
        sweep.sensitivities("crank_mass")
    with pytest.raises(InputError, match=r"got 'crank_mas'.*crank_mass"):
        sweep.sensitivities("crank_mas")
    kept = symgen.sweep("four-bar", {"crank_mass": [2.0]}, quantities=["crank.theta"], **SETTINGS)
    with pytest.raises(InputError, match=r"a quantity that was kept and has derivatives, got 'crank.x'"):
        kept.sensitivities("crank_mass")["crank.x"]
