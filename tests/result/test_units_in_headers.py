"""Headings of CSV files with and without units, and what reads both."""

import csv
import json

import numpy as np
import pytest

import symgen
from symgen.base.errors import InputError
from symgen.cli import main

SETTINGS = {"until": 0.02, "step": 1e-3, "method": "lagrange"}
COMMAND = ("--until", "0.02", "--step", "1e-3", "--method", "lagrange")


def table(path):
    with path.open(newline="", encoding="utf-8") as file:
        heading, *rows = csv.reader(file)
    return heading, rows


def test_all_tables_of_a_run_with_units_hold_the_same_numbers(tmp_path):
    result = symgen.load("pendulum").simulate(**SETTINGS)
    plain, rows = table(result.save(tmp_path / "plain.csv"))
    told, same = table(result.save(tmp_path / "told.csv", units=True))
    assert same == rows and [name.partition(" [")[0] for name in told] == plain
    units = dict(name[:-1].split(" [") for name in told if name.endswith("]"))
    assert units["t"] == "s" and units["bob.vx"] == "m/s" and units["bob.ay"] == "m/s^2"
    assert [unit for name, unit in units.items() if name.startswith("multiplier.")] == ["N"]
    assert units["energy.kinetic"] == "J" and "bob.x" in plain and " [" not in "".join(plain)
    with pytest.raises(InputError, match=r"save: units: expected a file ending in \.csv"):
        result.save(tmp_path / "told.parquet", units=True)


def test_runs_go_on_from_files_with_and_without_units(tmp_path, capsys):
    found = []
    for words in ((), ("--units",)):
        file = tmp_path / f"{len(words)}.csv"
        assert main(["run", "pendulum", *COMMAND, "--save", str(file), *words]) == 0
        capsys.readouterr()
        further = ("--until", "0.04", "--step", "1e-3", "--method", "lagrange", "--json")
        assert main(["run", "pendulum", "--from", str(file), *further]) == 0
        found.append(json.loads(capsys.readouterr().out)["final"])
    assert found[0] == found[1]


def test_rows_of_comparisons_keep_their_names_unless_units_are_asked_for(tmp_path):
    words = ["compare", "pendulum", "--methods", "lagrange", "--until", "0.02", "--repeat", "1", "--json"]
    assert main([*words, "--csv", str(tmp_path / "a.csv")]) == 0
    assert main([*words, "--csv", str(tmp_path / "b.csv"), "--units"]) == 0
    plain, told = table(tmp_path / "a.csv")[0], table(tmp_path / "b.csv")[0]
    assert [name.partition(" [")[0] for name in told] == plain and "error" in plain
    assert {"error [m]", "step [s]", "energy_drift_max [J]", "velocity_violation_rms [m/s]", "evaluations"} < {*told}


@pytest.mark.parametrize("words", [("run", "pendulum"), ("compare", "pendulum"), ("stress",)])
def test_units_without_a_file_that_carries_them_are_refused(words, capsys):
    assert main([*words, "--units"]) == 2
    assert "--units: expected" in capsys.readouterr().err


def test_a_sweep_as_lines_has_units_and_every_number(tmp_path):
    found = symgen.sweep(
        "pendulum",
        {"bob_mass": [1.0, -1.0], "bob.vx": [0.1, 0.2, 0.3]},
        quantities=("bob.x", "energy.total"),
        output=tmp_path / "runs.csv",
        times=(0.01, 0.02),
        **SETTINGS,
    )
    heading, rows = table(tmp_path / "runs.csv")
    names = ["run", "bob_mass [kg]", "bob.vx(0) [m/s]", "t [s]", "bob.x [m]", "energy.total [J]", "end [s]"]
    assert heading == [*names, "status", "reason", "warnings"] and len(rows) == 12
    assert [float(row[3]) for row in rows[:2]] == [0.01, 0.02] and rows[2][:3] == ["1", "1.0", "0.2"]
    values = np.array([float(row[4]) for row in rows[:6]]).reshape(3, 2)
    np.testing.assert_array_equal(values, found["bob.x"][0])
    assert rows[-1][4] == "" and rows[-1][-3] == "failed" and "above 0" in rows[-1][-2]
    assert not (tmp_path / "runs.csv.parts").exists()
