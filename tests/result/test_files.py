"""Files are read back with other libraries than ours; nothing half-written is ever left."""

import csv
import importlib.util
import json
from functools import partial

import h5py
import numpy as np
import pandas as pd
import pytest
import xarray as xr

import symgen
from symgen.base import files
from symgen.base.errors import InputError
from symgen.result.export import write_columns
from symgen.result.labelled import Labelled
from symgen.result.saved import dataset_of, read_last_state, read_recorded
from symgen.result.viewed import view_file

#: Numbers are read to the last bit: the default from pandas 3 on, which warns of the argument.
EXACT = {"float_precision": "round_trip"} if int(pd.__version__.partition(".")[0]) < 3 else {}


@pytest.fixture(scope="module")
def result():
    return symgen.simulate("driven-four-bar", until=0.5, output_step=0.05)


@pytest.fixture(scope="module")
def saved(result, tmp_path_factory):
    return xr.load_dataset(result.save(tmp_path_factory.mktemp("saved") / "run.nc"), engine="h5netcdf")


def test_csv(result, tmp_path):
    path = result.save(tmp_path / "run.csv")
    frame = pd.read_csv(path, index_col="t", **EXACT)
    assert np.array_equal(frame.index.to_numpy(), result.t)
    assert np.array_equal(frame["crank.theta"].to_numpy(), result["crank.theta"])
    assert np.array_equal(frame["multiplier.motor.driver"].to_numpy(), result.lam["motor.driver"])
    assert np.array_equal(frame["B.Fx"].to_numpy(), result.reactions["B.Fx"])


def test_csv_needs_no_extra(result, tmp_path, monkeypatch):
    """All digits of all numbers, by the standard library alone."""
    monkeypatch.setattr(files, "find_spec", lambda name: None)
    rows = rows_of(result.save(tmp_path / "run.csv", units=True))
    assert rows[0][:2] == ["t [s]", "crank.x [m]"]
    assert np.array_equal(np.array(rows[1:], dtype=float), np.column_stack([result.t, result.whole().values]))
    assert rows_of(result.save(tmp_path / "some.csv", ("crank.theta",)))[0] == ["t [s]", "crank.theta [rad]"]


def test_cells_of_numbers_that_are_none_are_empty(tmp_path):
    columns = Labelled(np.array([[np.nan, 0.1], [-np.inf, -0.0]]), ("a", "b"), ("m", "1"))
    path = write_columns(tmp_path / "some.csv", np.array([0.0, 1e-17]), columns, True, {})
    assert rows_of(path) == [["t [s]", "a [m]", "b [1]"], ["0.0", "", "0.1"], ["1e-17", "-inf", "-0.0"]]


def rows_of(path):
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.reader(file))


def test_parquet(result, tmp_path):
    frame = pd.read_parquet(result.save(tmp_path / "run.parquet"))
    assert np.array_equal(frame["coupler.alpha"].to_numpy(), result["coupler.alpha"])
    assert frame.attrs["units"]["coupler.alpha"] == "rad/s^2"
    assert frame.attrs["run"]["mechanism"] == "driven-four-bar"


@pytest.mark.slow
def test_netcdf(result, tmp_path):
    path = result.save(tmp_path / "run.nc")
    with xr.open_dataset(path, engine="h5netcdf") as data:
        column = data["q"].sel(coordinate="rocker.theta")
        assert np.array_equal(column.to_numpy(), result["rocker.theta"])
        assert str(column["coordinate_unit"].to_numpy()) == "rad"
        assert json.loads(data.attrs["run"])["status"] == "ok"
        assert np.array_equal(
            data["violations"].sel(level="violation.position").to_numpy(), result.violations["position"]
        )


@pytest.mark.slow
def test_an_interrupted_start_can_be_saved(result, tmp_path):
    empty = symgen.simulate("pendulum", until=1.0, times=[])
    assert len(empty.t) == 0
    assert empty.to_json()["final"] == {"t": None, "q": {}, "v": {}, "lam": {}}
    for ending in (".csv", ".nc", ".parquet"):
        assert empty.save(tmp_path / f"empty{ending}").exists()


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("ending", [".png", ".svg", ".pdf"])
def test_plots(result, tmp_path, ending):
    path = result.plot(tmp_path / f"run{ending}", ("q", "v", "energy", "violations", "reactions"))
    head = path.read_bytes()[:200]
    assert {".png": b"\x89PNG", ".svg": b"<?xml", ".pdf": b"%PDF"}[ending] in head
    assert b"/Type3" not in path.read_bytes()  # printers refuse such fonts


@pytest.mark.slow
def test_an_svg_says_units_and_is_the_same_every_time(result, tmp_path):
    first = result.plot(tmp_path / "a.svg").read_text()
    assert "dc:date" not in first
    assert result.plot(tmp_path / "b.png").stat().st_size > 10_000


@pytest.mark.slow
def test_a_plot_without_a_path_shows_itself(result, tmp_path):
    plot = result.plot()
    assert plot._repr_png_().startswith(b"\x89PNG") and len(plot.figure.axes) >= 3
    again = result.plot().save(tmp_path / "again.svg").read_text()
    assert again == result.plot(tmp_path / "file.svg").read_text()
    with pytest.raises(InputError, match=r"plot: expected a file ending in \.png, \.svg, \.pdf"):
        plot.save(tmp_path / "a.txt")


@pytest.mark.slow
def test_a_figure_fits_into_a_column_of_a_page(result, tmp_path):
    """84 mm at 150 dots an inch are 496 pixels; each legend beside a panel would need 40 of the 84 mm."""
    plot = result.plot(None, ["q", "energy"])
    beside = [ax.texts for ax in plot.figure.axes if ax.texts]
    named = sum(map(len, beside))
    data = plot.save(tmp_path / "column.png", width=84).read_bytes()
    assert int.from_bytes(data[16:20], "big") == 496
    (legend,) = plot.figure.legends
    assert len(beside) > 1 and len(legend.get_texts()) == named
    assert not any(ax.texts for ax in plot.figure.axes) and plot.figure.get_suptitle() == ""
    drawn = plot.figure.get_tightbbox()
    assert drawn.width <= 84 / 25.4 and drawn.height <= plot.figure.get_size_inches()[1]
    with pytest.raises(InputError, match="width: expected 30 to 1000 mm, got 12"):
        plot.save(tmp_path / "narrow.png", width=12)


def latex(folder, monkeypatch, script):
    """Put a program named pdflatex in the only folder of programs."""
    program = folder / "pdflatex"
    program.write_text(f"#!/bin/sh\n{script}\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(folder))


@pytest.mark.slow
def test_latex_reads_a_figure_or_says_why_it_cannot_be_measured(result, tmp_path, monkeypatch):
    """With a LaTeX the file has PGF; with one that fails, and with none, one sentence, and no file."""
    path = tmp_path / "column.pgf"
    try:
        text = result.plot(None, ["q"]).save(path, width=84).read_text()
        assert r"\begin{pgfpicture}" in text and "t [s]" in text
    except InputError as error:
        assert "lualatex" in str(error) or "pdflatex" in str(error) or "xelatex" in str(error)
    monkeypatch.setenv("PATH", str(tmp_path))
    other = tmp_path / "other.pgf"
    with pytest.raises(InputError, match="lualatex or pdflatex or xelatex, which measure the texts of a"):
        result.plot(other)
    latex(tmp_path, monkeypatch, "echo no format file; exit 1")
    with pytest.raises(InputError, match="plot: expected a pdflatex that measures texts, with the packages of matplot"):
        result.plot(other)
    assert not other.exists()


def test_violations_are_drawn_on_a_logarithmic_axis(result):
    from symgen.result.plots import figure_over_column

    figure = figure_over_column(result.along("t"), result.select(["q", "violations"]), "")
    labels = {ax.get_ylabel(): ax.get_yscale() for ax in figure.axes}
    assert labels == {"position [m]": "linear", "angle [rad]": "linear", "violation [m, m/s, m/s$^2$]": "log"}
    assert figure.axes[-1].get_xlabel() == "t [s]"


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("run.xlsx", "save: expected a file ending in .nc, .parquet, .csv, got"),
        ("run.parq", "run.parquet'?"),
        ("run", "save: expected a file ending in .nc, .parquet, .csv, got"),
        ("nowhere/run.csv", "save: expected a file in a folder that exists, got"),
    ],
)
def test_a_wrong_file_gets_a_sentence(result, tmp_path, name, sentence):
    with pytest.raises(InputError) as caught:
        result.save(tmp_path / name)
    assert sentence in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def test_a_missing_library_says_how_to_get_it(result, tmp_path, monkeypatch):
    real = importlib.util.find_spec
    monkeypatch.setattr(files, "find_spec", lambda name: None if name == "h5netcdf" else real(name))
    with pytest.raises(InputError, match=r"the library h5netcdf, got none; pip install 'symgen\[data\]' installs it"):
        result.save(tmp_path / "run.nc")


SIZES = {
    "a table of one dimension": ("q", lambda q: ("time", q[:, 0]), "'q' is no table of numbers over time and coordi"),
    "three dimensions": ("q", lambda q: (("time", "coordinate", "z"), q[:, :, None]), "'q' is no table of numbers"),
    "other times": ("energy", lambda x: (("other", "kind_of_energy"), x[:-1]), "'energy' is no table of numbers ove"),
    "columns without labels": ("v", lambda v: (("time", "w"), v[:, :2]), "'v' is no table of numbers over time and v"),
    "texts": ("q", lambda q: (("time", "coordinate"), q.astype(str).astype(object)), "'q' is no table of numbers o"),
}


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize("name", SIZES)
def test_tables_of_other_sizes_are_refused(saved, tmp_path, name):
    table, changed, sentence = SIZES[name]
    path = tmp_path / "run.nc"
    saved.drop_vars(table).assign({table: changed(saved[table].values)}).to_netcdf(path, engine="h5netcdf")
    for read in (
        read_last_state,
        read_recorded,
        partial(view_file, mechanism=symgen.load("driven-four-bar").mechanism),
    ):
        with pytest.raises(InputError, match=sentence):
            read("--from", path)


@pytest.mark.slow
def test_a_result_with_columns_of_another_model_is_not_viewed(saved, tmp_path):
    path = tmp_path / "run.nc"
    saved.isel(velocity=slice(0, 2)).to_netcdf(path, engine="h5netcdf")
    with pytest.raises(InputError, match=r"a result of driven-four-bar, got .* and has others as velocity"):
        view_file("view", path, symgen.load("driven-four-bar").mechanism)


@pytest.mark.slow
def test_a_table_that_its_file_cannot_hold_is_not_read(result, tmp_path):
    """A table that nothing was written to takes no space in a file, and all of the memory."""
    path = result.save(tmp_path / "run.nc")
    with h5py.File(path, "a") as file:
        del file["q"]
        file.create_dataset("q", (10**8, 9), dtype="f8", chunks=True)
    with pytest.raises(InputError, match=r"'q' has 7.2e\+09 bytes, more than such a file can hold"):
        read_recorded("motion", path)


@pytest.mark.slow
def test_variables_that_are_not_of_a_result_are_not_read(tmp_path):
    """A file of 150 kB may hold a variable of 8 GB."""
    path = tmp_path / "run.nc"
    symgen.simulate("pendulum", until=0.01, step=1e-3, integrator="rk4").save(path)
    xr.Dataset({"huge": ("n", np.zeros(10**4))}).to_netcdf(path, mode="a", engine="h5netcdf")
    assert "huge" not in dataset_of(path) and {"q", "energy"} <= set(dataset_of(path).data_vars)
    assert read_last_state("--from", path).t == pytest.approx(0.01)
