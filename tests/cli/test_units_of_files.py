"""Units on the command line: in files, behind typed numbers, and in all that is shown of parameters."""

from __future__ import annotations

import csv
import json
import math
import re
from fractions import Fraction

import numpy as np
import pytest

from tests.describe.files.test_units import UNITS, WRONG

ROD = """[mechanism]
name = "rod"
gravity = [0.0, "-9810 mm/s^2"]

[parameters]
length = { value = 600, unit = "mm" }
half = { value = "length/2", unit = "cm" }
lean = "30 deg"

[inputs]
push = { default = 20, unit = "N mm" }

[bodies.rod]
mass = "1500 g"
inertia = "450 kg cm^2"
points = { top = ["-half", 0.0], tip = ["30 cm", 0.0] }
position = ["half*cos(lean)", "half*sin(lean)"]
angle = "lean"

[joints.pin]
type = "revolute"
between = ["ground", "rod"]
at = [["0 mm", 0.0], "top"]
start = { rate = "30 rpm" }

[forces.drive]
type = "torque"
body = "rod"
torque = "push"

[outputs]
turn = { value = "180/pi*pin.angle", unit = "deg" }
"""
#: The double nearest to 30 degrees; `math.radians` rounds twice.
LEAN = float(Fraction("3.14159265358979323846264338327950288") / 6)
#: The same in SI units.
PLAIN = {
    '"-9810 mm/s^2"': "-9.81",
    '{ value = 600, unit = "mm" }': "0.6",
    '{ value = "length/2", unit = "cm" }': '"length/2"',
    'lean = "30 deg"': f"lean = {LEAN!r}",
    '{ default = 20, unit = "N mm" }': "0.02",
    '"1500 g"': "1.5",
    '"450 kg cm^2"': "0.045",
    '["30 cm", 0.0]': "[0.3, 0.0]",
    '["0 mm", 0.0]': "[0.0, 0.0]",
    '"30 rpm"': repr(math.pi),
}
SHORT = ("--until", "0.1", "--step", "1e-2", "--integrator", "rk4")


@pytest.fixture
def typed(cli, tmp_path, monkeypatch):
    """The command line, in a folder with the rod in other units and in SI units."""
    monkeypatch.chdir(tmp_path)
    plain = ROD
    for written, number in PLAIN.items():
        assert written in plain
        plain = plain.replace(written, number)
    (tmp_path / "rod.toml").write_text(ROD, encoding="utf-8")
    (tmp_path / "plain.toml").write_text(plain, encoding="utf-8")
    return cli


@pytest.fixture
def found(typed):
    """What a run of a file prints as JSON."""

    def run(*words, model="rod.toml"):
        code, out, err = typed("run", model, *SHORT, *words, "--json")
        assert code == 0, err
        return json.loads(out)

    return run


def refused(typed, *words):
    """The sentence of a command that is refused with code 2, without any output."""
    code, out, err = typed(*words)
    assert code == 2 and out == "" and err.count("\n") == 1 and "Traceback" not in err
    return err.removesuffix("\n")


# -- what is converted -------------------------------------------------------------------------------------------------


def test_a_file_in_other_units_runs_as_that_in_si_units(found):
    other, plain = found(), found(model="plain.toml")
    for part in ("parameters", "inputs", "start", "final"):
        assert other[part] == plain[part]
    assert other["parameters"] == {"length": 0.6, "half": 0.3, "lean": LEAN}


@pytest.mark.parametrize("spelling", ["50 cm", "500", "500 mm", "0.5 m", "5e2", "+500.0 mm", "50cm", "500000 um"])
def test_set_takes_the_unit_of_the_file_or_one_behind_the_number(found, spelling):
    at = found("--set", f"length={spelling}")
    assert at["parameters"] == {"length": 0.5, "half": 0.25, "lean": LEAN}
    assert at["final"] == found("--set", "length=0.5", model="plain.toml")["final"] != found()["final"]


@pytest.mark.parametrize(
    ("words", "name", "value"),
    [
        ("rod.theta=60 deg", "rod.theta", math.radians(60)),
        ("rod.theta=60°", "rod.theta", math.radians(60)),
        ("pin.angle=0.25 rev", "rod.theta", 0.5 * math.pi),
        ("rod.theta=1", "rod.theta", 1.0),
        ("rod.omega=60 rpm", "rod.omega", 2 * math.pi),
        ("pin.angle.rate=90 deg/s", "rod.omega", 0.5 * math.pi),
        ("pin.rate=60 rpm", "rod.omega", 2 * math.pi),
        ("rod.omega=1.5", "rod.omega", 1.5),
    ],
)
def test_starts_are_in_si_units_unless_others_are_typed(found, words, name, value):
    start = found("--start", words)["start"]
    assert (start["q"] | start["v"])[name] == pytest.approx(value, rel=1e-14)


def test_inputs_are_in_the_unit_of_the_file(found):
    of_one = [found("--input", f"push={text}") for text in ("1000", "1 N m", "0.001 kN m")]
    assert [run["inputs"] for run in of_one] == [{"push": 1.0}] * 3
    assert of_one[0]["final"] == of_one[1]["final"] == found("--input", "push=1", model="plain.toml")["final"]


def test_formulas_of_inputs_give_si_units(found):
    """The same formula is the same torque, whatever the unit of the input in the file."""
    own, plain = (found("--input", "push=1 + 0*t", model=f"{name}.toml") for name in ("rod", "plain"))
    assert own["final"] == plain["final"]


def test_every_unit_of_a_file_is_converted(typed, tmp_path):
    """Beside the number, behind it, and typed behind --set: 3 of each unit, in SI units by factors of the test."""
    lines, names = [], {f"p{i}": unit for i, unit in enumerate(UNITS)}
    for name, unit in names.items():
        lines += [f'{name} = {{ value = 3, unit = "{unit}" }}', f'{name}_text = "3 {unit}"']
        lines += [f'{name}_set = {{ value = 1, unit = "{UNITS[unit][0]}" }}']
    text = ROD.replace("[parameters]\n", "\n".join(["[parameters]", *lines, ""]))
    (tmp_path / "rod.toml").write_text(text, encoding="utf-8")
    words = [word for name, unit in names.items() for word in ("--set", f"{name}_set=3 {unit}")]
    code, out, _ = typed("inspect", "rod.toml", *words, "--format", "json")
    assert code == 0 and len(names) >= 40
    parameters = {entry["name"]: entry for entry in json.loads(out)["parameters"]}
    for name, unit in names.items():
        si, factor = UNITS[unit]
        for way in (name, f"{name}_text", f"{name}_set"):
            assert parameters[way]["unit"] == si
            assert parameters[way]["value"] == pytest.approx(3 * factor, rel=1e-15), (unit, way)
        if factor != 1.0:
            assert (
                parameters[name]["as_written"] == parameters[f"{name}_text"]["as_written"] == {"value": 3, "unit": unit}
            )


# -- what is refused ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("text", WRONG)
def test_what_is_no_unit_is_refused_in_a_file_and_behind_a_number(typed, tmp_path, text):
    behind = refused(typed, "run", "rod.toml", *SHORT, "--set", f"lean=3 {text}")
    assert behind.startswith("symgen: --set lean: expected a") and ", got '" in behind
    (tmp_path / "rod.toml").write_text(ROD.replace('unit = "mm"', f"unit = {json.dumps(text)}"), encoding="utf-8")
    line = ROD[: ROD.index("length =")].count("\n") + 1
    for command in ("check", "run"):
        sentence = refused(typed, command, "rod.toml")
        assert f"rod.toml:{line}: parameters.length.unit: expected a unit such as 'kg m^2'" in sentence
        assert WRONG[text] in sentence


def test_there_are_enough_that_are_none():
    assert len(WRONG) >= 40


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("run", "--set", "length=5 deg"), "--set length: expected a unit such as m, mm, cm, km, in, got 'deg'"),
        (("run", "--set", "lean=5 cm"), "--set lean: expected a unit such as rad, deg, rev, got 'cm'"),
        (("run", "--start", "rod.theta=5 mm"), "--start rod.theta: expected a unit such as rad, deg, rev, got 'mm'"),
        (("run", "--start", "pin.rate=5 deg"), "--start pin.rate: expected a unit such as rad/s, deg/s, rpm, rev/s"),
        (("check", "--start", "rod.x=5 kg"), "--start rod.x: expected a unit such as m, mm, cm, km, in, got 'kg'"),
        (("run", "--input", "push=5 mm"), "input 'push': expected a unit such as N m, N mm, kN m, got 'mm'"),
        (("compare", "--set", "length=5 kg"), "--set length: expected a unit such as m, mm, cm, km, in, got 'kg'"),
        (("modes", "--over", "length=lin(1 kg,2,3)"), "--over length: expected a unit such as m, mm, cm, km, in"),
        (("modes", "--at", "rod.theta=5 kg"), "--at rod.theta: expected a unit such as rad, deg, rev, got 'kg'"),
        (
            ("equilibrium", "--scan", "rod.theta=lin(0 m,1,3)"),
            "--scan rod.theta: expected a unit such as rad, deg, rev",
        ),
        (("sweep", "--vary", "length=lin(10 cm, 50 deg, 5)"), "length: expected a unit such as m, mm, cm, km, in"),
        (
            ("sweep", "--vary", "length=lin(10 cm, 50 cm, 5 cm)"),
            "expected finite numbers between the brackets, got '5 cm'",
        ),
        (("sweep", "--vary", "length=lin(10 banana, 5, 5)"), "--vary length: expected a unit such as 'kg m^2', got"),
    ],
    ids=lambda x: " ".join(x) if isinstance(x, tuple) else "",
)
def test_units_of_other_quantities_are_refused_where_they_are_typed(typed, words, sentence):
    command, *options = words
    assert sentence in refused(typed, command, "rod.toml", *options)


# -- what is shown -----------------------------------------------------------------------------------------------------


def table(path):
    with path.open(newline="", encoding="utf-8") as file:
        heading, *rows = csv.reader(file)
    return heading, rows


@pytest.mark.by_turns(2)
@pytest.mark.slow_cases("lin(10 cm, 50 cm, 5)", "lin(100,500,5)")
@pytest.mark.parametrize("values", ["lin(10 cm, 50 cm, 5)", "lin(100,500,5)", "values(100, 20 cm, 0.3 m, 400, 500)"])
def test_a_sweep_varies_and_writes_in_the_unit_of_the_file(typed, found, tmp_path, values):
    words = ("--vary", f"length={values}", "--vary", "rod.omega=values(30 rpm, 1)", "--quantity", "turn,rod.theta")
    code, out, _ = typed("sweep", "rod.toml", *SHORT, *words, "-o", "s.csv")
    assert code == 0
    assert re.search(r"length: 5 values from 100 to 500 mm\s", out)
    assert re.search(r"rod\.omega: 2 values from 1 to 3\.14159 rad/s\s", out)
    heading, rows = table(tmp_path / "s.csv")
    assert heading[1:6] == ["length [mm]", "rod.omega(0) [rad/s]", "t [s]", "turn [deg]", "rod.theta [rad]"]
    assert [float(row[1]) for row in rows] == pytest.approx(np.repeat([100, 200, 300, 400, 500], 2), rel=1e-15)
    assert [float(row[2]) for row in rows] == pytest.approx([math.pi, 1.0] * 5, rel=1e-15)
    single = found("--set", "length=20 cm", "--start", "rod.omega=30 rpm")["final"]
    assert float(rows[2][5]) == pytest.approx(single["q"]["rod.theta"], rel=1e-14)
    assert float(rows[2][4]) == pytest.approx(math.degrees(float(rows[2][5])), rel=1e-14)


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases("log(10 cm, 1 m, 3)-numbers0", "uniform(100, 20 cm, 2, 1)-None", "values(5)-numbers2")
@pytest.mark.parametrize(
    ("values", "numbers"),
    [("log(10 cm, 1 m, 3)", (0.1, math.sqrt(0.1), 1.0)), ("uniform(100, 20 cm, 2, 1)", None), ("values(5)", (0.005,))],
)
def test_every_kind_of_values_takes_units(typed, tmp_path, values, numbers):
    assert typed("sweep", "rod.toml", *SHORT, "--vary", f"length={values}", "-o", "s.nc")[0] == 0
    import xarray

    with xarray.open_dataset(tmp_path / "s.nc", engine="h5netcdf") as data:
        expected = np.random.default_rng(1).uniform(0.1, 0.2, 2) if numbers is None else numbers
        np.testing.assert_allclose(data["length"].values, expected, rtol=1e-15)  # data sets are in SI units
        assert data["length"].attrs["units"] == "m"


def labels(path):
    """Texts of a picture, which stand in it as comments beside their outlines."""
    return re.findall(r"<!-- (.*?) -->", path.read_text(encoding="utf-8"))


@pytest.mark.slow
def test_pictures_of_sweeps_have_the_unit_of_the_file(typed, tmp_path):
    words = ("--vary", "length=lin(20 cm, 60 cm, 3)", "--vary", "lean=values(0, 45)", "--quantity", "turn")
    assert typed("sweep", "rod.toml", *SHORT, *words, "--plot", "s.svg")[0] == 0
    assert {"length [mm]", "turn [deg]", "200", "600", "lean = 0 deg", "lean = 45 deg"} <= {*labels(tmp_path / "s.svg")}


@pytest.mark.slow
def test_a_root_locus_is_over_the_unit_of_the_file(typed, tmp_path):
    text = ROD.replace('torque = "push"', 'torque = "(1 - 5*length)*rod.omega"')  # grows in short rods
    (tmp_path / "rod.toml").write_text(text, encoding="utf-8")
    words = ("modes", "rod.toml", "--set", "lean=-80", "--over", "length=lin(10 cm, 50 cm, 5)")
    code, out, _ = typed(*words, "--plot", "locus.svg")
    assert code == 0
    lines = out.splitlines()
    assert lines[0].split()[:2] == ["length", "[mm]"]
    assert [line.split()[0] for line in lines[1:6]] == ["100", "200", "300", "400", "500"]
    (crossing,) = re.findall(r"from length = (\S+) mm on .* decays", out)
    assert float(crossing) == pytest.approx(200, rel=1e-6)
    assert {"length [mm]", "100", "500"} <= {*labels(tmp_path / "locus.svg")}
    assert json.loads(typed(*words, "--json")[1])["values"] == pytest.approx([0.1, 0.2, 0.3, 0.4, 0.5])


def test_csv_files_of_runs_name_the_unit_of_each_output(typed, tmp_path):
    assert typed("run", "rod.toml", *SHORT, "--save", "a.csv", "--units")[0] == 0
    heading, rows = table(tmp_path / "a.csv")
    at = {name: i for i, name in enumerate(heading)}
    first = rows[0]
    assert float(first[at["turn [deg]"]]) == pytest.approx(30.0) == math.degrees(float(first[at["rod.theta [rad]"]]))


@pytest.mark.slow
def test_equations_and_reports_show_values_as_the_file_has_them(typed, tmp_path):
    code, out, _ = typed("inspect", "rod.toml", "--set", "length=50 cm")
    assert code == 0
    assert [line for line in out.splitlines() if re.match(r"(length|half|lean|push) = ", line)] == [
        *("length = 500 [mm]", "half = 25 [cm]", "lean = 30 [deg]", "push = 20 [N mm]")
    ]
    assert typed("report", "rod.toml", *SHORT, "--set", "length=50 cm", "-o", "r.md")[0] == 0
    report = (tmp_path / "r.md").read_text(encoding="utf-8")
    for words in ("length | 500 mm", "half | 25 cm", "lean | 30 deg"):
        assert f"| parameter {words} |" in report
    latex = typed("inspect", "rod.toml", "--format", "latex", "--document")[1]
    assert "length & mm & 600 " in latex and "lean & deg & 30 " in latex and "push & N mm & 20 " in latex
    assert typed("inspect", "rod.toml", "-o", "r.html")[0] == 0
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert "<td>length</td><td>mm</td><td>600</td>" in page and "<td>push</td><td>N mm</td><td>20</td>" in page


@pytest.mark.slow
def test_sliders_of_pages_have_the_unit_of_the_file(typed, tmp_path):
    assert typed("view", "rod.toml", *SHORT, "-o", "v.html")[0] == 0
    page = (tmp_path / "v.html").read_text(encoding="utf-8")
    entry = re.search(r'\{"name": ?"length"[^{}]*"shown": ?(\{[^{}]*\})', page)
    assert entry and json.loads(entry[1]) == {"unit": "mm", "factor": 0.001}


@pytest.mark.slow
def test_fits_are_shown_in_the_unit_of_the_file(typed, tmp_path):
    words = ("--until", "0.5", "--output-step", "0.02")
    assert typed("run", "rod.toml", *words, "--set", "length=50 cm", "--save", "data.csv")[0] == 0
    words = ("--data", "data.csv", "--free", "length", "--quantity", "rod.theta", "--least", "length=40 cm")
    code, out, err = typed("identify", "rod.toml", *words)
    assert code == 0, err
    (line,) = [line for line in out.splitlines() if line.startswith("length")]
    assert float(line.split()[1]) == pytest.approx(500, rel=1e-4) and line.split()[-1] == "mm"
