"""Ensembles in files: what is written, what an interruption or a kill leaves, and what goes on from there."""

import json
import os
import random
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
import xarray as xr

import symgen
from symgen.api import Model
from symgen.base import plugins
from symgen.base.errors import InputError
from symgen.describe.files.builder import MechanismBuilder
from symgen.study.ensemble.table import DONE, FolderTable, RowTable

FEW = {
    "vary": {"crank_mass": "lin(1, 3, 6)", "crank.omega": [0.0, 2.0]},
    "until": 0.05,
    "quantities": ("q",),
    "integrator": "rk4",
}


@pytest.mark.slow
def test_a_netcdf_file_holds_everything(tmp_path):
    path = tmp_path / "few.nc"
    found = symgen.sweep("four-bar", **FEW, times=(0.0, 0.05), output=path)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["few.nc"]
    with xr.open_dataset(path, engine="h5netcdf") as data:
        data.load()
    assert dict(data.sizes) == {"crank_mass": 6, "crank.omega(0)": 2, "time": 2}
    np.testing.assert_array_equal(data["crank.omega(0)"], [0.0, 2.0])
    np.testing.assert_array_equal(data["crank.theta"], found["crank.theta"])
    assert data["crank.theta"].attrs["units"] == "rad" and data["crank_mass"].attrs["units"] == "kg"
    assert np.all(data["status"] == "ok") and np.all(data["reason"] == "")
    np.testing.assert_array_equal(data["steps"], 50)
    heavy = data.sel({"crank_mass": 3.0, "crank.omega(0)": 2.0})
    one = symgen.simulate("four-bar", integrator="rk4", until=0.05, times=(0.05,), parameters={"crank_mass": 3.0})
    rest = data.sel({"crank_mass": 3.0, "crank.omega(0)": 0.0})
    assert float(rest["crank.theta"][-1]) == pytest.approx(one["crank.theta"][-1], abs=1e-13)
    assert float(heavy["crank.theta"][-1]) > float(rest["crank.theta"][-1])
    assert data.attrs["mechanism"] == "four-bar" and json.loads(data.attrs["parameters"])["rocker_mass"] == 5.0
    assert set(json.loads(data.attrs["versions"])) == {"symgen", "python", "numpy", "numba", "llvmlite"}


@pytest.mark.slow
def test_a_finished_file_is_not_computed_again_by_mistake(tmp_path):
    path = tmp_path / "few.nc"
    symgen.sweep("four-bar", **FEW, output=path, resume=True)  # nothing was begun: it begins
    before = path.read_bytes()
    with pytest.raises(InputError, match="one that is not finished, got a finished one; leave `resume` out"):
        symgen.sweep("four-bar", **FEW, output=path, resume=True)
    assert path.read_bytes() == before
    symgen.sweep("four-bar", **FEW, output=path)


def test_failures_are_rows(tmp_path):
    found = symgen.sweep("four-bar", {"crank_mass": [2.0, -1.0]}, until=0.01, output=tmp_path / "x.nc")
    data = found.to_xarray()
    assert list(data["status"].values) == ["ok", "failed"]
    assert "mass or inertia of crank" in str(data["reason"].values[1])
    assert np.isfinite(data["crank.x"][0]) and np.isnan(data["crank.x"][1])
    assert data["end"].values[1] == 0.0


def test_runs_together_have_one_dimension():
    found = symgen.sweep("four-bar", runs={"crank_mass": [1.0, 2.0, 3.0], "crank.omega": [0.0, 1.0, 2.0]}, until=0.01)
    data = found.to_xarray()
    assert dict(data.sizes) == {"run": 3, "time": 1}
    np.testing.assert_array_equal(data["crank.omega(0)"], [0.0, 1.0, 2.0])
    np.testing.assert_array_equal(data["crank_mass"], [1.0, 2.0, 3.0])
    grid = symgen.sweep("four-bar", {"crank_mass": [1.0, 2.0, 3.0], "crank.omega": [0.0, 1.0, 2.0]}, until=0.01)
    for i in range(3):
        assert grid["crank.theta"][i, i, 0] == found["crank.theta"][i, 0]


@pytest.mark.slow
def test_names_of_a_mechanism_give_way_to_those_that_every_data_set_has(tmp_path):
    """x = t + w t^3/6; a parameter and an output are called as numbers of every run are, a parameter as a dimension."""
    times = np.array([0.1, 0.3])
    for name, label in (("steps", "parameter.steps"), ("run", "parameter.run"), ("time", "parameter.time")):
        built = symgen.MechanismBuilder("pushed").parameter(name, 3.0).output("end", "2*block.x")
        built = built.body("block", type="point", mass=1.0, velocity=(1.0, 0.0))
        model = symgen.Model(built.force("push", "force", body="block", force=(f"{name}*t", 0.0)).build())
        asked = {"quantities": ("smallest_pivot", "end"), "times": times, "until": 0.3, "step": 0.1}
        varied = {"vary" if name == "steps" else "runs": {name: [1.0, 2.0]}}
        found = symgen.sweep(model, **varied, **asked, method="lagrange", integrator="rk4")
        data = found.to_xarray()
        twice = 2.0 * (times + np.outer([1.0, 2.0], times**3 / 6.0))
        np.testing.assert_allclose(data["output.end"], twice, rtol=1e-12)
        np.testing.assert_array_equal(data[label], [1.0, 2.0])
        np.testing.assert_array_equal(data["time"], times)
        np.testing.assert_array_equal(data["end"], 0.3)
        np.testing.assert_array_equal(data["steps"], 3)
        assert data["smallest_pivot"].shape == (2, 2) and data["smallest_pivot_min"].shape == (2,)
        lines = found.save(tmp_path / "few.csv").read_text(encoding="utf-8").splitlines()
        heading = f"run,{label},t [s],smallest_pivot [1],output.end,end [s],status,reason,warnings"
        assert lines[0] == heading
        np.testing.assert_allclose([float(line.split(",")[4]) for line in lines[1:]], twice.ravel(), rtol=1e-12)
        assert [line.split(",")[5] for line in lines[1:]] == ["0.3"] * 4


@pytest.mark.slow
def test_an_output_called_as_a_parameter_that_varies_has_a_label_of_its_own(tmp_path):
    """x = t + k t^2/2 is the coordinate, the output and what is asked for by the parameter's name; a body gives way."""
    built = symgen.MechanismBuilder("pushed").parameter("x", 3.0).output("x", "2*block.x").output("t0", "output.x")
    built = built.body("block", type="point", mass=1.0, velocity=(1.0, 0.0)).body("output", type="point", mass=1.0)
    model = symgen.Model(built.force("push", "force", body="block", force=("x", 0.0)).build())
    asked = {"quantities": ("x", "output.x", "t0"), "times": [0.5], "until": 0.5, "step": 0.1}
    found = symgen.sweep(model, {"x": [1.0, 2.0]}, **asked, method="lagrange", integrator="rk4")
    twice = 2.0 * (0.5 + np.array([1.0, 2.0]) * 0.125)
    path = found.save(tmp_path / "few.nc")
    with xr.open_dataset(path, engine="h5netcdf") as data:
        np.testing.assert_array_equal(data["x"], [1.0, 2.0])
        np.testing.assert_array_equal(data["output.x"], np.zeros((2, 1)))
        np.testing.assert_allclose(data["output.output.x"][:, 0], twice, rtol=1e-12)
    lines = found.save(tmp_path / "few.csv").read_text(encoding="utf-8").splitlines()
    assert lines[0] == "run,x,t [s],output.output.x,output.x [m],t0,end [s],status,reason,warnings"
    frame = found.to_dataframe()
    assert [*frame.columns] == "run x t output.output.x output.x t0 end status reason warnings".split()
    assert frame.attrs["units"] == {"t": "s", "output.x": "m", "end": "s"}
    np.testing.assert_allclose(frame["output.output.x"], twice, rtol=1e-12)
    assert found.plot(what=["t0"])._repr_png_()


def test_any_number_of_threads_gives_the_same_bits():
    one, three = (symgen.sweep("four-bar", **FEW, jobs=jobs) for jobs in (1, 3))
    np.testing.assert_array_equal(one.values, three.values)
    np.testing.assert_array_equal(one.summary, three.summary)


# -- folders -----------------------------------------------------------------------------------------------------------


def test_a_folder_can_be_continued_and_is_complete_then(tmp_path):
    whole = symgen.sweep("four-bar", **FEW)
    folder = tmp_path / "results"
    symgen.sweep("four-bar", **FEW, output=folder)
    done = (folder / DONE).read_text().splitlines()
    assert len(done) == len(set(done)) == -(-12 // whole.ensemble.chunk)
    # as a kill leaves it: some chunks not listed, one line torn, and rows of an unlisted chunk half written
    (folder / DONE).write_text("".join(f"{line}\n" for line in done[:4]) + "7")
    values = np.load(folder / "values.npy", mmap_mode="r+")
    values[int(done[5].split()[0])] = 1e99
    values.flush()
    again = symgen.sweep("four-bar", **FEW, output=folder, resume=True)
    np.testing.assert_array_equal(again.values, whole.values)
    np.testing.assert_array_equal(again.summary, whole.summary)
    assert sorted((folder / DONE).read_text().splitlines()) == sorted(done)
    before = (folder / DONE).read_bytes()
    symgen.sweep("four-bar", **FEW, output=folder, resume=True)  # nothing is left to do
    assert (folder / DONE).read_bytes() == before


@pytest.mark.slow
def test_bits_that_changed_in_a_folder_are_computed_again_or_refused(tmp_path):
    whole = symgen.sweep("pendulum", {"bob.vy": "lin(0, 1, 9)"}, until=0.02)
    folder = tmp_path / "results"
    symgen.sweep("pendulum", {"bob.vy": "lin(0, 1, 9)"}, until=0.02, output=folder)
    kept = {path.name: path.read_bytes() for path in folder.iterdir()}
    chance, refused = random.Random(3), 0
    for name in [*("values.npy", "summary.npy", DONE) * 12, *["sweep.json"] * 6]:
        for each, content in kept.items():
            (folder / each).write_bytes(content)
        changed = bytearray(kept[name])
        bit = chance.randrange(8 * len(changed))
        changed[bit // 8] ^= 1 << bit % 8
        (folder / name).write_bytes(changed)
        try:
            again = symgen.sweep("pendulum", {"bob.vy": "lin(0, 1, 9)"}, until=0.02, output=folder, resume=True)
        except InputError:
            assert name == "sweep.json" and (folder / name).read_bytes() == changed
            refused += 1
            continue
        np.testing.assert_array_equal(again.values, whole.values)
        np.testing.assert_array_equal(again.summary, whole.summary)
        assert {line.split()[0] for line in (folder / DONE).read_text().splitlines()} == set(map(str, range(9)))
    assert refused


@pytest.mark.parametrize("name", ["values.npy", "summary.npy", DONE])
@pytest.mark.parametrize("damage", ["missing", "truncated", "head", "another shape", "empty"])
def test_damaged_files_of_a_folder_are_made_again(tmp_path, name, damage):
    folder = tmp_path / "results"
    whole = symgen.sweep("pendulum", {"bob.vy": "lin(0, 1, 9)"}, until=0.02)
    symgen.sweep("pendulum", {"bob.vy": "lin(0, 1, 9)"}, until=0.02, output=folder)
    content, log = (folder / name).read_bytes(), sorted((folder / DONE).read_text().splitlines())
    if damage == "missing":
        (folder / name).unlink()
    elif damage == "another shape":
        np.save(folder / name if name.endswith(".npy") else folder / "x.npy", np.zeros(3))
        (folder / "x.npy").unlink(missing_ok=True)
    else:
        changed = {"truncated": content[:-9], "head": b"\x93NUMPX" + content[6:], "empty": b""}[damage]
        (folder / name).write_bytes(changed)
    again = symgen.sweep("pendulum", {"bob.vy": "lin(0, 1, 9)"}, until=0.02, output=folder, resume=True)
    np.testing.assert_array_equal(again.values, whole.values)
    np.testing.assert_array_equal(again.summary, whole.summary)
    assert sorted((folder / DONE).read_text().splitlines()) == log


def test_a_pipe_among_the_files_of_a_folder_is_refused(tmp_path):
    os.mkfifo(tmp_path / DONE)
    with pytest.raises(InputError, match=f"got one with '{DONE}' in it"):
        symgen.sweep("pendulum", {"bob.vy": [0.0]}, until=0.02, output=tmp_path)


def test_a_folder_with_other_things_in_it_is_refused(tmp_path):
    (tmp_path / "thesis.txt").write_text("chapter 1")
    for resume in (False, True):
        with pytest.raises(
            InputError, match=r"expected an empty one or one of a sweep, got one with 'thesis.txt' in it"
        ):
            symgen.sweep("four-bar", **FEW, output=tmp_path, resume=resume)
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.txt"]


@pytest.mark.parametrize("name", ["x.xls", "missing/x.nc", "missing/x"])
def test_outputs_that_cannot_be_written_are_refused_before_anything_runs(tmp_path, name):
    with pytest.raises(InputError, match=r"output|folder"):
        symgen.sweep("no-such-model", {"a": [1.0]}, output=tmp_path / name)
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_two_processes_cannot_write_to_one_folder(tmp_path, monkeypatch):
    monkeypatch.setattr(plugins, "_files", {})  # of tests before: the other process loads none
    folder = tmp_path / "results"
    symgen.sweep("four-bar", **FEW, output=folder)
    ensemble = symgen.sweep("four-bar", **FEW).ensemble
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    with FolderTable(folder, ensemble.description, ensemble.sizes, True):
        words = ("four-bar", "--vary", "crank_mass=lin(1,3,6)", "--vary", "crank.omega=values(0,2)", "--until", "0.05")
        words = (*words, "--integrator", "rk4")
        process = start(*words, "--quantity", "q", "-o", folder, "--resume")
        _, err = process.communicate(timeout=600)
        assert process.returncode == 2 and "expected one that no other process uses, got one in use" in err
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before
    process = start(*words, "--quantity", "q", "-o", folder, "--resume")  # and the words are those of this sweep
    process.communicate(timeout=600)
    assert process.returncode == 0


def test_a_chunk_is_not_taken_twice():
    table = RowTable(4, 1, 1, 2)
    ensemble = symgen.sweep("four-bar", {"crank_mass": [1.0, 2.0]}, until=0.01, quantities=("energy.kinetic",))
    from symgen.study.ensemble.kernel import Chunk

    chunk = Chunk(ensemble.values, ensemble.summary)
    table.keep_chunk(1, chunk)
    assert (
        table.missing_chunks() == [0]
        and table.runs_done == 2
        and list(table.runs_done_mask()) == [False, False, True, True]
    )
    with pytest.raises(ValueError, match="chunk 1 is done already"):
        table.keep_chunk(1, chunk)


# -- other runs, other versions ---------------------------------------------------------------------------------------

PENDULUM = {"vary": {"bob.vy": "lin(0, 1, 9)"}, "until": 0.02}


def content(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.name != "lock"}


def refused(folder, got, model="pendulum", **asked):
    before = content(folder)
    with pytest.raises(
        InputError, match=f"expected the sweep that was begun there, got one {got}; name another output"
    ):
        symgen.sweep(model, output=folder, resume=True, **asked)
    assert content(folder) == before


def test_a_folder_of_an_older_version_is_refused_and_left_as_it_is(tmp_path):
    folder = tmp_path / "runs"
    symgen.sweep("pendulum", output=folder, **PENDULUM)
    now = json.loads((folder / "sweep.json").read_text())
    for older in ({**now, "code": "0" * 64}, {key: x for key, x in now.items() if key != "code"}):
        (folder / "sweep.json").write_text(json.dumps(older))
        refused(folder, "by another version of symgen", **PENDULUM)
    (folder / "sweep.json").write_text(json.dumps({**now, "symgen-sweep": 1}))
    with pytest.raises(InputError, match="expected a sweep of form 2, got one of form 1"):
        symgen.sweep("pendulum", output=folder, resume=True, **PENDULUM)


def test_other_runs_of_the_same_version_are_refused(tmp_path):
    folder = tmp_path / "runs"
    symgen.sweep("pendulum", output=folder, **PENDULUM)
    with pytest.raises(InputError, match="no sweep was begun, got one with a sweep; `resume` continues it"):
        symgen.sweep("pendulum", output=folder, **PENDULUM)
    refused(folder, "with another (varied|runs)", vary={"bob.vy": "lin(0, 2, 9)"}, until=0.02)
    for asked in ({"stop_when": "bob.y > 0"}, {"coordinates": "joint"}, {"quantities": ("bob.x",)}, {"step": 4e-4}):
        refused(folder, "with another recipe", **PENDULUM, **asked)
    refused(folder, "with another (start|recipe)", start={"bob.vx": 0.1}, **PENDULUM)
    refused(folder, "with another mechanism", model="spherical-double-pendulum", vary={"upper.vx": "lin(0, 1, 9)"})


@pytest.fixture(scope="module")
def cart():
    return Model(
        MechanismBuilder("cart")
        .run(until=0.7, step=0.05)
        .parameter("late", 0.2)
        .input("push", 0.5, unit="N")
        .body("block", type="point", mass=1.0, velocity=(0.0, 0.0))
        .force("all", "force", body="block", force=("push", 0.0))
        .build()
    )


@pytest.mark.slow
def test_runs_with_events_and_jumps_go_on_and_are_told_apart(cart, tmp_path):
    folder, vary = tmp_path / "runs", {"late": "lin(0.1, 0.4, 7)"}
    asked = {
        "inputs": {"push": "2 if t > late else 0"},
        "stop_when": "block.x > 0.02",
        "method": "lagrange",
        "integrator": "rk4",
    }
    whole = symgen.sweep(cart, vary, **asked)
    symgen.sweep(cart, vary, output=folder, **asked)
    (folder / DONE).write_text("".join(f"{line}\n" for line in (folder / DONE).read_text().splitlines()[:3]))
    again = symgen.sweep(cart, vary, output=folder, resume=True, **asked)
    np.testing.assert_array_equal(again.values, whole.values)
    np.testing.assert_array_equal(again.summary, whole.summary)
    # 2 N from `late` on reach 0.02 m after the root of 0.02 s^2
    np.testing.assert_allclose(again["end"], np.linspace(0.1, 0.4, 7) + np.sqrt(0.02), atol=1e-12)
    changed = {**asked, "inputs": {"push": "2 if t > 2*late else 0"}}
    refused(folder, "with another inputs", model=cart, vary=vary, **changed)
    samples = {**asked, "inputs": {"push": {"t": [0.0, 0.1], "u": [0.0, 2.0], "interpolation": "hold"}}}
    symgen.sweep(cart, vary, output=tmp_path / "samples", **samples)
    samples["inputs"] = {"push": {"t": [0.0, 0.2], "u": [0.0, 2.0], "interpolation": "hold"}}
    refused(tmp_path / "samples", "with another inputs", model=cart, vary=vary, **samples)


# -- interruptions -----------------------------------------------------------------------------------------------------

LONG = tuple(
    "four-bar --vary crank_mass=lin(1,3,200) --integrator rk4 --until 5 --step 1e-3 --quantity crank.theta".split()
)


def start(*arguments):
    return subprocess.Popen(
        [sys.executable, "-c", "from symgen.cli import main; raise SystemExit(main())", "sweep", *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )


def wait_for_chunks(log, count, process):
    deadline = time.monotonic() + 600
    while time.monotonic() < deadline and process.poll() is None:
        if log.exists() and len(log.read_bytes().splitlines()) >= count:
            return
        time.sleep(0.01)
    raise AssertionError(f"no {count} chunks: {process.communicate()}")


@pytest.mark.by_turns(4)
@pytest.mark.skipif(os.name != "posix", reason="signals")
@pytest.mark.slow
@pytest.mark.parametrize("kill", [signal.SIGKILL, signal.SIGINT])
def test_nothing_is_lost_or_doubled_by_a_kill_or_an_interruption(tmp_path, kill):
    path = tmp_path / "long.nc"
    log = tmp_path / "long.nc.parts" / DONE
    process = start(*LONG, "-o", path)
    try:
        wait_for_chunks(log, 3, process)
        process.send_signal(kill)
        out, err = process.communicate(timeout=600)
    finally:
        process.kill()
    before = log.read_text().splitlines()
    assert 3 <= len(before) and len(set(before)) == len(before) and not path.exists()
    if kill == signal.SIGINT:
        assert process.returncode == 130
        assert "interrupted; " in err and "--resume goes on from there" in err.splitlines()[-1]
    process = start(*LONG, "-o", path, "--resume", "--json")
    out, err = process.communicate(timeout=600)
    assert process.returncode == 0, err
    assert json.loads(out)["status"]["ok"] == 200
    assert [p.name for p in tmp_path.iterdir()] == ["long.nc"]
    with xr.open_dataset(path, engine="h5netcdf") as data:
        whole = symgen.sweep(
            "four-bar",
            {"crank_mass": "lin(1,3,200)"},
            integrator="rk4",
            until=5.0,
            step=1e-3,
            quantities=("crank.theta",),
        )
        assert len(before) < -(-200 // whole.ensemble.chunk)
        np.testing.assert_array_equal(data["crank.theta"].values, whole["crank.theta"])
        np.testing.assert_array_equal(data["evaluations"].values, whole["evaluations"])
