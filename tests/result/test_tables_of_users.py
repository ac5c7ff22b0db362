"""Tables that people write, by everything that reads one: the same numbers, or a sentence with the column or the row.

A cart on a rail is pushed by a constant force: x = a t^2 / 2 with a = 2 m/s^2 for 4 kg and 8 N, by hand. The table of
this motion is written in the forms of spreadsheets and measuring programs.
"""

import codecs

import numpy as np
import pytest
from numpy.testing import assert_allclose

import symgen
from symgen.base.errors import InputError
from symgen.result.saved import read_last_state

FILE = """
[mechanism]
name = "cart"
[run]
until = 1.0
[inputs]
push = { default = 8.0, unit = "N" }
[parameters]
m = { value = 2, unit = "kg" }
[bodies.cart]
mass = "m"
inertia = 0.1
[joints.rail]
type = "translational"
between = ["ground", "cart"]
at = [[0.0, 0.0], "origin"]
axis = [1.0, 0.0]
[forces.shove]
type = "force"
body = "cart"
force = ["push", 0.0]
[outputs]
shown = { value = "1000*cart.x", unit = "mm" }
"""
T = np.linspace(0.0, 1.0, 21)
#: Column -> its unit and its numbers in it.
COLUMNS = {
    "t": ("s", T),
    "cart.x": ("m", T**2),
    "cart.y": ("m", 0.0 * T),
    "cart.theta": ("rad", 0.0 * T),
    "cart.vx": ("m/s", 2.0 * T),
    "cart.vy": ("m/s", 0.0 * T),
    "cart.omega": ("rad/s", 0.0 * T),
    "cart.ax": ("m/s^2", 2.0 + 0.0 * T),
    "cart.ay": ("m/s^2", 0.0 * T),
    "cart.alpha": ("rad/s^2", 0.0 * T),
    "energy.work": ("J", 8.0 * T**2),
    "push": ("N", 8.0 + 0.0 * T),
}
OTHER_UNITS = {"t": "ms", "cart.x": "mm", "cart.vx": "mm/s", "cart.ax": "mm/s^2", "energy.work": "kJ", "push": "kN"}
OTHER_UNITS |= {"cart.theta": "deg", "cart.omega": "rpm", "cart.alpha": "deg/s^2", "cart.y": "in", "cart.vy": "km/h"}
PER_UNIT = {"ms": 1e-3, "mm": 1e-3, "mm/s": 1e-3, "mm/s^2": 1e-3, "kJ": 1e3, "kN": 1e3}


def written(units=None, separator=",", comma=False, headings=True, order=None, change=lambda cells: None):
    """Return a table as text: `units` are those of some columns, all others are in SI units."""
    columns = {}
    for name, (unit, values) in COLUMNS.items():
        own = (units or {}).get(name, unit)
        heading = f"{name} [{own}]" if headings else name
        columns[name] = [heading, *(repr(float(x)) for x in values / PER_UNIT.get(own, 1.0))]
    rows = [list(row) for row in zip(*(columns[name] for name in order or columns), strict=True)]
    change(rows)
    text = "\n".join(
        separator.join(cell.replace(".", ",") if comma and k else cell for cell in row) for k, row in enumerate(rows)
    )
    return text + "\n"


def cell(line, column, text):
    def change(rows):
        rows[line - 1][list(COLUMNS).index(column)] = text

    return change


#: Form -> the bytes of its file, and what is said if it is no table of this motion by (reader or all).
FORMS = {
    "SI units": (written(), {}),
    "no units": (written(headings=False), {}),
    "other units": (written(OTHER_UNITS), {}),
    "semicolons, decimal commas": (written(separator=";", comma=True), {}),
    "tabulators, other units": (written(OTHER_UNITS, separator="\t", comma=True), {}),
    "sep= and a mark": (
        codecs.BOM_UTF8 + b"sep=;\r\n" + written(OTHER_UNITS, ";", True).replace("\n", "\r\n").encode(),
        {},
    ),
    "UTF-16": (written(OTHER_UNITS, ";").encode("utf-16"), {}),
    "another order": (written(OTHER_UNITS, order=[*reversed(COLUMNS)]), {}),
    "missing cell": (
        written(change=lambda rows: [f(rows) for f in (cell(21, "cart.x", ""), cell(22, "cart.x", ""))]),
        {
            "identify": None,
            "from": "expected a last state that is finite",
            "inverse": "expected finite numbers, got others in 'cart.x'",
            "input": None,
            "sweep": None,
        },
    ),
    "missing cell of the input": (
        written(change=cell(5, "push", "")),
        {
            "identify": None,
            "from": None,
            "inverse": None,
            "input": "expected a number in every row, got '' in row 5 of 'push'",
            "sweep": "expected a number in every row, got '' in row 5 of 'push'",
        },
    ),
    "unknown heading": (
        written(change=lambda rows: [f(rows) for f in (cell(1, "cart.x", "car.x [m]"), cell(1, "push", "puhs [N]"))]),
        {
            "identify": "expected measured columns, got 'cart.x'",
            "from": "got no column 'cart.x'; did you mean 'car.x'",
            "inverse": "got no column 'cart.x'; did you mean 'car",
            "input": "expected a column of the file, got 'push'; did you mean 'puhs'",
            "sweep": "expected a column of the file, got 'push'; did you mean 'puhs'",
        },
    ),
    "wrong dimension": (
        written(change=lambda rows: [f(rows) for f in (cell(1, "cart.x", "cart.x [kg]"), cell(1, "push", "push [m]"))]),
        {
            "identify": "cart.x: expected a unit such as m, .*got 'kg'",
            "from": "cart.x: expected a unit such as m, .*got 'kg'",
            "inverse": "cart.x: expected a unit such as m, .*got 'kg'",
            "input": "push: expected a unit such as N, .*got 'm'",
            "sweep": "push: expected a unit such as N, .*got 'm'",
        },
    ),
    "decimal commas between commas": (
        written(comma=True),
        dict.fromkeys(
            ("identify", "from", "inverse", "input", "sweep"), "decimal commas need semicolons between cells"
        ),
    ),
    "no headings": (
        written(change=lambda rows: rows.pop(0)),
        dict.fromkeys(
            ("identify", "from", "inverse", "input", "sweep"), "expected the names of the columns in the first row"
        ),
    ),
}


def by_identify(model, path):
    """The mass that the measured motion tells: 4 kg."""
    fit = model.identify([str(path)], free=["m"], quantities=["cart.x"])
    assert_allclose(fit.parameters["m"], 4.0, rtol=1e-9)
    assert_allclose(fit.deviations["cart.x"], 0.0, atol=1e-9)


def by_from(model, path):
    """Goes on from 1 m and 2 m/s at 1 s: after another 0.5 s at 4 m/s^2 it is at 2.5 m."""
    result = model.simulate(start=read_last_state("--from", path), until=1.5, integrator="dop853")
    assert result.status == "ok"
    assert_allclose([result["cart.x"][0], result["cart.x"][-1]], [1.0, 2.5], rtol=1e-9)


def by_inverse(model, path):
    """What drives 2 kg at 2 m/s^2: 4 N."""
    efforts = model.inverse(path, actuators=["push"]).efforts["push"]
    assert_allclose(efforts, 4.0, rtol=1e-9)


def by_input(model, path):
    """8 N on 2 kg: 2 m after a second."""
    result = model.simulate(inputs={"push": f"{path}:push:linear"}, integrator="dop853")
    assert_allclose(result["cart.x"][-1], 2.0, rtol=1e-9)


def by_sweep(model, path):
    """The same for rows of 2 and 4 kg."""
    rows = symgen.sweep(
        model,
        vary={"m": "values(2, 4)"},
        inputs={"push": f"{path}:push"},
        quantities=["cart.x"],
        integrator="dop853",
        jobs=1,
    )
    assert_allclose(rows.values[:, 0, -1], [2.0, 1.0], rtol=1e-9)


READERS = {"identify": by_identify, "from": by_from, "inverse": by_inverse, "input": by_input, "sweep": by_sweep}


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    path = tmp_path_factory.mktemp("cart") / "cart.toml"
    path.write_text(FILE)
    return symgen.load(path)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("reader", READERS)
def test_tables_mean_what_their_headings_say_to_everything_that_reads_them(model, tmp_path, reader, form):
    """`identify` found 0.004 kg for 4 kg by a table in millimetres, with a residual of 3.5e-12."""
    content, told = FORMS[form]
    path = tmp_path / "data.csv"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    sentence = told.get(reader)
    if sentence is None:
        READERS[reader](model, path)
        return
    with pytest.raises(InputError, match=sentence):
        READERS[reader](model, path)


def test_an_output_of_the_file_is_read_in_its_own_unit(model):
    """The output is 1000*cart.x in mm: data in metres are a thousand times larger numbers there."""
    for heading, values in (("shown [mm]", 1e3 * T**2), ("shown [m]", T**2), ("shown", 1e3 * T**2)):
        fit = model.identify({"t [s]": T, heading: values}, free=["m"])
        assert_allclose(fit.parameters["m"], 4.0, rtol=1e-9)


def test_what_was_left_out_of_the_data_is_said(model):
    """A gap, and a heading that the model has not."""
    x = T**2
    x[3] = np.nan
    fit = model.identify({"t": T, "cart.x": x, "cart.yy [mm]": T}, free=["m"])
    assert_allclose(fit.parameters["m"], 4.0, rtol=1e-9)
    assert "1 cell of 'cart.x' without a number left out" in fit.notes
    assert any(note.startswith("column 'cart.yy' of the data is left out") for note in fit.notes)


def test_a_force_may_share_its_name_with_an_input_when_a_motion_is_read(model, tmp_path):
    """`KeyError: 'push.x~effort'`."""
    path, data = tmp_path / "cart.toml", tmp_path / "data.csv"
    path.write_text(FILE.replace("[forces.shove]", "[forces.push]"))
    data.write_text(written(OTHER_UNITS))
    efforts = symgen.load(path).inverse(data, actuators=["push"]).efforts
    assert_allclose(efforts["push"], 4.0, rtol=1e-9)
