"""One number has one name: in results, data frames, files, pages, sweeps and on the command line."""

import csv
import json
import re

import numpy as np
import pytest

import symgen
from symgen.base.errors import InputError
from symgen.cli import main
from symgen.describe import catalogue
from symgen.describe.parts.columns import column_name

#: Mechanisms of more coordinates take a while to derive.
LARGE = 20


def _parameter(entry):
    large = sum(len(body.coordinates) for body in symgen.load(entry.name).mechanism.bodies) > LARGE
    return pytest.param(entry.name, marks=pytest.mark.slow if large else ())


NAMES = [_parameter(e) for e in (*catalogue.entries(), *catalogue.entries(catalogue.MACHINES))]


def of_page(page):
    """Names of all that a page plots, and what it says it leaves out."""
    data = json.loads(re.search(r'<script[^>]*id="data"[^>]*>(.*?)</script>', page.html, re.DOTALL)[1])
    return {name for group in data["motions"][0]["groups"] for name in group["names"]}, data["note"]


@pytest.mark.by_turns(8)
@pytest.mark.fast(
    "four-bar",
    "free-rigid-body",
    "heavy-top",
    "rolling-disc",
    "slider-crank",
    "spherical-double-pendulum",
    "cart-pole",
)
@pytest.mark.parametrize("name", NAMES)
def test_every_name_of_a_mechanism_of_the_catalogue(name, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    model = symgen.load(name)
    step = model.mechanism.defaults.step
    result = model.simulate(integrator="rk4", step=step, until=3 * step)
    names = result.whole().names
    assert len(set(names)) == len(names)
    for column in names:
        assert np.array_equal(result[column], result.select([column]).values[:, 0])
    assert {column_name(t, key) for t, table in result.tables().items() for key in table.names} == set(names)
    assert tuple(result.to_dataframe().columns) == names
    words = ["run", name, "--integrator", "rk4", "--step", f"{step}", "--until", f"{3 * step}", "--save", "a.csv"]
    assert main([*words, "--quantity", ",".join(names), "--json"]) == 0
    quantities = json.loads(capsys.readouterr().out)["quantities"]
    assert tuple(quantities) == names
    assert {n: q["unit"] for n, q in quantities.items()} == dict(zip(names, result.whole().units, strict=True))
    with open("a.csv", newline="", encoding="utf-8") as file:
        assert [heading.rpartition(" [")[0] or heading for heading in next(csv.reader(file))][1:] == list(names)
    dataset = result.to_xarray()
    labels = [str(x) for n, c in dataset.coords.items() if n != "time" and not n.endswith("_unit") for x in c.values]
    assert sorted(labels) == sorted(names)
    plotted, note = of_page(result.view(live=False))
    assert plotted <= set(names)
    if "no plots" not in note:
        repeated = {f"{joint.name}.body" for joint in model.mechanism.joints if joint.bodies[0] == "ground"}
        left_out = {n for n in result.q.names if n[-2:] in ("e0", "e1", "e2", "e3")}
        left_out |= {n for n in names if n.rpartition(".")[0] in repeated}  # the axes of the ground are its body's
        largest = max(np.abs(result.reactions.values).max(), 1.0) if result.reactions.names else 1.0
        rounding = {n for n in names if np.abs(result[n]).max() <= 1e-9 * largest}
        assert left_out - plotted == left_out and set(names) - plotted <= left_out | rounding


def test_owners_give_all_that_they_have():
    result = symgen.load("driven-four-bar").simulate(until=0.01)
    assert result.select(["motor"]).names == tuple(n for n in result.whole().names if n.startswith("motor."))
    assert {"B.angle", "B.angle.rate", "B.F", "B.Fx", "B.M", "B.body.Fx"} <= set(result.select(["B"]).names)
    assert {"motor.effort", "motor.power", "motor.rate"} <= set(result.select(["motor"]).names)
    assert {"crank.x", "crank.omega", "crank.alpha"} <= set(result.select(["crank"]).names)
    assert result["B"].shape == (len(result.t), len(result.select(["B"]).names))
    assert np.array_equal(result["multiplier.B.x"], result.lam["B.x"])
    with pytest.raises(InputError, match=r"did you mean 'multiplier\.B\.x'|none of that name"):
        result["B.x"]


def test_efforts_of_analyses_are_called_as_in_runs():
    times = np.linspace(0.0, 1.0, 21)
    model = symgen.load("driven-four-bar")
    run = model.simulate(times=times, until=1.0, rtol=1e-10, integrator="dop853")
    moved, needed = model.kinematics(times), model.inverse(times=times)
    for name in ("motor.effort", "motor.power", "motor.rate", "B.F", "multiplier.motor.driver"):
        scale = np.abs(run[name]).max()
        for other in (moved, needed):
            if name in other.whole().names:
                np.testing.assert_allclose(other[name], run[name], atol=1e-6 * scale, err_msg=name)
    assert {"motor.effort", "motor.power", "motor.rate", "B.F"} <= set(needed.whole().names)
    assert np.array_equal(moved.efforts["motor"], needed.efforts["motor"])


def test_a_sweep_keeps_what_a_run_reports():
    model = symgen.load("driven-four-bar")
    names = model.simulate(until=0.01).whole().names
    found = symgen.sweep(
        model, {"crank_speed": [2.0]}, quantities=[n for n in names if n != "violation.acceleration"], until=0.01
    )
    assert [q.name for q in found.ensemble.recipe.quantities] == [n for n in names if n != "violation.acceleration"]
    kept = symgen.sweep(model, {"crank_speed": [2.0]}, quantities=["motor"], until=0.01)
    assert [q.name for q in kept.ensemble.recipe.quantities] == [n for n in names if n.startswith("motor.")]


def test_a_file_of_a_version_with_other_names_is_refused_in_a_sentence(tmp_path, capsys):
    path = symgen.load("pendulum").simulate(until=0.01).save(tmp_path / "a.csv")
    heading, rest = path.read_text().split("\n", 1)
    path.write_text(heading.replace(",energy.total", ",energy.sum") + "\n" + rest)
    assert main(["run", "pendulum", "--from", str(path), "--until", "1"]) == 2
    assert "of an older version, whose columns had other names" in capsys.readouterr().err
