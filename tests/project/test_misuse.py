"""Defensive programming: every public function gets nonsense for every argument, and answers in one sentence.

Each row is a call and what its sentence must say. Nothing may be run, written or compiled by it beyond what made the
object that is asked.
"""

import copy
import inspect
import math
import pickle
import subprocess
import sys
from fractions import Fraction
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest
from support.processes import python

import symgen
from symgen.analyses.kinds import ANALYSES
from symgen.base.errors import InputError, SymgenError
from symgen.base.settings import Settings
from symgen.study.stress.study import stress

NAN, INF = math.nan, math.inf
NUMBERS = ("step", "rtol", "atol", "until", "output_step", "max_violation", "max_energy_error")
#: What is no number above 0 -> how a sentence calls it.
NO_NUMBER = {
    "0": 0,
    "-1.0": -1.0,
    "nan": NAN,
    "inf": INF,
    "True": True,
    "'1e-3'": "1e-3",
    "an array of shape (2,)": np.array([1.0, 2.0]),
    "a list of 1": [1e-3],
    "a dict of 0": {},
    "the function len": len,
    "1j": 1j,
    "False": np.bool_(False),
    "b'1'": b"1",
    "the class float": float,
}
NO_TEXT = {
    "3": 3,
    "None": None,
    "True": True,
    "a list of 1": ["lagrange"],
    "the class int": int,
    "1.5": np.float64(1.5),
}
NO_MAPPING = {"3": 3, "'a=1'": "a=1", "a list of 1": [("a", 1)], "the function len": len, "a set of 1": {"a"}}
NO_SWITCH = {"1": 1, "'yes'": "yes", "None": None, "a list of 0": [], "0.0": 0.0}


class Thing:
    """Something that no function knows."""


@pytest.fixture(scope="module")
def model():
    return symgen.load("pendulum")


@pytest.fixture(scope="module")
def result(model):
    return model.simulate(until=0.02)


@pytest.fixture(scope="module")
def sweep(model):
    return symgen.sweep(model, {"bob.vy": [0.0, 1.0]}, until=0.01)


@pytest.fixture(scope="module")
def study(model):
    return symgen.compare(model, "lagrange", "rk4", 1e-2, until=0.1, repeat=1)


def settings_rows():
    """Rows of settings: name, value, sentence."""
    for name in NUMBERS:
        for shown, value in NO_NUMBER.items():
            yield name, value, f"{name}: expected a finite number above 0, got {shown}"
    for name in ("method", "integrator"):
        for shown, value in NO_TEXT.items():
            if not (name == "integrator" and value is None):
                yield name, value, f"{name}: expected a name, got {shown}"
    for shown, value in NO_TEXT.items():
        yield "shape", value, f"shape: expected one of auto, straight, looped, got {shown}"
    yield "shape", "lopped", "did you mean 'looped'?"
    yield "method", "lagrang", "did you mean 'lagrange'?"
    yield "integrator", "rk", "expected an integrator, got 'rk'"
    for name in ("parameters", "options"):
        for shown, value in NO_MAPPING.items():
            yield name, value, f", got {shown}"
        yield name, {3: 1.0}, "named by texts, got 3"
        yield name, {"x": [1.0]}, f"{name} 'x': expected a finite number, got a list of 1"
        yield name, {"x": NAN}, f"{name} 'x': expected a finite number, got nan"
        yield name, {"x": lambda t: t}, f"{name} 'x': expected a finite number, got the function <lambda>"
        yield name, {"x": True}, f"{name} 'x': expected a finite number, got True"
    yield "parameters", {"x": "1"}, "parameters 'x': expected a finite number, got '1'"
    yield "parameters", {"x": 1.0}, "parameter 'x': expected a parameter of pendulum, got none of that name"
    for shown, value in NO_MAPPING.items():
        yield "inputs", value, f", got {shown}"
    yield "inputs", {3: 1.0}, "named by texts, got 3"
    yield "inputs", {"x": 1.0}, "input 'x': expected an input of pendulum, got none of that name; it declares none"
    yield "options", {"alpha": 1.0}, "option alpha: expected method.NAME or integrator.NAME"
    yield "options", {"method.weight": "long"}, "expected one of identity, mass, body, got 'long'"
    for name in ("strict", "verify"):
        for shown, value in NO_SWITCH.items():
            if name == "verify" and value is None:  # neither on nor off
                continue
            yield name, value, f"{name}: expected True or False, got {shown}"
    for value in (0, -1, 1.5, 1001, "3", None, True, [1], NAN):
        yield "repeat", value, "repeat: expected a whole number from 1 to 1000, got "
    wrong = ("0.01", {"a": 1}, [[0.0, 0.01]], [0.0, "x"], [0.0, None], len, [0.01, 0.0], [0.0, NAN], [-1.0, 0.0])
    for value in (*wrong, [0.0, 5.0], np.zeros((2, 2)), np.array(["a"]), np.array([{}])):
        yield "times", value, "times: expected "
    yield "step", 0.03, "step: expected at most until = 0.02, got 0.03"
    yield "nonsense", 1, "settings: expected the name of a setting, got 'nonsense'"


def by_word(rows):
    """Rows in lists by the first word of the first entry: a test for each, since a test for each row costs more."""
    found = {}
    for row in rows:
        found.setdefault(row[0].partition(" ")[0], []).append(row)
    return found


SETTINGS = by_word(settings_rows())


@pytest.mark.parametrize("name", SETTINGS)
def test_settings(model, name):
    for _, value, sentence in SETTINGS[name]:
        for call in (model.simulate, lambda **k: symgen.simulate(model, **k)):
            with pytest.raises(InputError) as error:
                call(**{"until": 0.02, name: value})
                pytest.fail(f"{value!r} is taken")
            assert sentence in str(error.value) and "\n" not in str(error.value)
            assert len(str(error.value)) < 500


def each(label, values, call, sentence):
    """Rows of one call with several values; ``{}`` in the sentence is how it calls each of them."""
    named = values.items() if isinstance(values, dict) else [(f"{value!r:.20}", value) for value in values]
    for shown, value in named:
        yield f"{label} {shown}", lambda x, v=value: call(x, v), sentence.replace("{}", shown)


def comparing(name):
    """Comparisons with one argument."""
    return lambda x, v: symgen.compare(x.model, **{name: v})


def sweeping(name):
    """Sweeps with one argument."""
    return lambda x, v: symgen.sweep(x.model, **{name: v})


def building(part, further):
    """Parts of a mechanism with a name and further arguments."""
    return lambda x, v: getattr(symgen.MechanismBuilder("a"), part)(v, *further)


def built(name="a", **keys):
    """A mechanism of one body with these keys."""
    return symgen.MechanismBuilder(name).body("b", **{"mass": 1, "inertia": 1, **keys})


def reducing(argument):
    """Reductions of a bar of two nodes with one argument."""
    nodes, k = np.array([[0.0, 0.0], [1.0, 0.0]]), np.kron([[1.0, -1.0], [-1.0, 1.0]], np.diag([1.0, 0.0]))
    good = {"nodes": nodes, "M": np.eye(4), "K": k, "inner": 1}
    return lambda x, v: symgen.reduced(**(good | {argument: v}))


def designs():
    """Rows of designs: label, call on the fixtures, sentence."""
    free = {"bob_mass": (0.5, 2.0)}
    numbers = (0, -1, "x", 1.5, 10_001, None)
    no_bounds = ((1.0,), 3, "0.5:2", None, [1, 2, 3])
    for label, values, call, sentence in (
        ("vary", NO_MAPPING, lambda x, v: x.model.design(v, "max(bob.x)"), "vary: expected bounds by the names"),
        (
            "bounds",
            no_bounds,
            lambda x, v: x.model.design({"bob_mass": v}, "max(bob.x)"),
            "vary 'bob_mass': expected a lower and an upper bound",
        ),
        ("aim", (3, None, [1.0]), lambda x, v: x.model.design(free, v), "aim: expected a text such as peak("),
        ("keep", (3, {}), lambda x, v: x.model.design(free, "max(bob.x)", v), "keep: expected a list of names, got "),
        (
            "starts",
            numbers,
            lambda x, v: x.model.design(free, "max(bob.x)", starts=v),
            "starts: expected a whole number",
        ),
        ("seed", (-1, "x", None), lambda x, v: x.model.design(free, "max(bob.x)", seed=v), "seed: expected a whole"),
        ("search", ("yes", []), lambda x, v: x.model.design(free, "max(bob.x)", progress=v), "expected a function"),
        ("save", (3, None), lambda x, v: symgen.Design.save(x.result, v), "save: expected a path, got "),
        ("report", (3, None), lambda x, v: symgen.Design.report(x.result, v), "report: expected a path, got "),
    ):
        yield from each(f"design {label}", values, call, sentence)


def rows():
    """Rows of everything else: label, call on the fixtures, sentence."""
    vy = {"bob.vy": [1.0]}
    paths = {"3": 3, "None": None, "a list of 1": ["a"], "b'a'": b"a", "a Thing": Thing()}
    for name, call in {
        "load": lambda x, v: symgen.load(v),
        "simulate": lambda x, v: symgen.simulate(v),
        "compare": lambda x, v: symgen.compare(v),
        "sweep": lambda x, v: symgen.sweep(v, {"a": [1.0]}),
        "design": lambda x, v: symgen.design(v, {"a": (0.0, 1.0)}, "max(bob.x)"),
    }.items():
        yield from each(name, paths, call, "model: expected a path, got {}")
    yield from each("Model", paths, lambda x, v: symgen.Model(v), "mechanism: expected a Mechanism; symgen.load takes")
    yield "load empty", lambda x: symgen.load(""), "got ''"
    yield "load null", lambda x: symgen.load("a\0b"), "got 'a\\x00b'"
    records, wrong = ("lagrange", 3, {}, Settings), "settings: expected Settings, got "
    yield from each("settings", records, lambda x, v: x.model.simulate(v), wrong)
    yield from each("sweep settings", records, lambda x, v: symgen.sweep(x.model, vy, settings=v), wrong)
    for name, call in {
        "simulate": lambda x, v: x.model.simulate(progress=v),
        "sweep": lambda x, v: symgen.sweep(x.model, vy, progress=v),
        "compare": lambda x, v: symgen.compare(x.model, progress=v),
    }.items():
        yield from each(f"progress of {name}", (3, "yes", []), call, "progress: expected a function")
    yield from designs()
    for argument, sentence in (
        ("nodes", "nodes: expected places of two nodes or more"),
        ("M", "M: expected a"),
        ("K", "K: expected a"),
        ("interfaces", "interfaces: expected a dictionary of names and lists of nodes"),
        ("inner", "inner: expected a whole number"),
        ("rows", "rows: expected a dictionary of names and rows"),
        ("outline", "outline: expected a list of lines"),
    ):
        yield from each(f"reduced {argument}", (3.5, "a", Thing()), reducing(argument), sentence)
    # analyses: the pendulum is not driven, but what is wrong with an argument is said first
    times = ["x", True, {"a": 1}, Thing(), 1j]
    yield from each("kinematics", times, lambda x, v: x.model.kinematics(v), "kinematics: times: expected a")
    yield from each("inverse times", times, lambda x, v: x.model.inverse(times=v), "inverse: times: expected a")
    arrays = (np.zeros((2, 2)), np.array(["a"]), np.array([1j]), np.array([NAN]), np.zeros(0), [1.0, 0.0])
    yield from each("kinematics", arrays, lambda x, v: x.model.kinematics(v), "kinematics: times: expected")
    names = (3, [3], {})
    for label, call, sentence in (
        ("pins", lambda x, v: x.model.kinematics([0.0], transmission=v), "a list of names, got"),
        ("actuators", lambda x, v: x.model.inverse(x.result, actuators=v), "a list of names"),
        ("motion", lambda x, v: x.model.inverse(v), "a result of a run, or a motion of kinematics"),
    ):
        yield from each(label, names, call, sentence)
    yield "inverse file", lambda x: x.model.inverse("nothing.nc"), "expected a file of a result, got 'nothing.nc'"
    yield "inverse of nothing", lambda x: x.model.inverse(x.result), "names of what exerts the motion, got none"
    ranges = (3, "x", [1.0])
    yield from each(
        "scan", ranges, lambda x, v: x.model.equilibria(v), "scan: expected a pair of a name and its values"
    )
    yield from each("locus", ranges, lambda x, v: x.model.locus(v), "over: expected a pair of a name and its values")
    yield "scan text", lambda x: x.model.equilibria(("bob.x", "x")), "scan bob.x: expected"
    yield "scan of nothing", lambda x: x.model.equilibria(("nope", [0.0])), "a coordinate of pendulum, got none"
    moments = ("never", None, [1.0], NAN, -1.0)
    yield from each("modes at", moments, lambda x, v: x.model.modes(at=v), "at: expected")
    yield from each("linearise at", moments, lambda x, v: x.model.linearise(at=v), "at: expected")
    yield from each("states", (4, {"x": 1}), lambda x, v: x.model.modes(states=v), "states: expected a list of names")
    yield from each("cyclic", (4, {"x": 1}), lambda x, v: x.model.steady(cyclic=v), "cyclic: expected a list of names")
    wrong = "state 'nope': expected a coordinate, velocity"
    yield "states by name", lambda x: x.model.linearise(states=("nope",)), wrong
    counts = (0, -1, "x", 1.5, True)
    yield from each("count", counts, lambda x, v: x.model.modes(count=v), "count: expected a whole number")
    numbers = (0, -1, 1.5, "1", None, True)
    yield from each("mode", numbers, lambda x, v: x.model.view_mode(v), "number: expected a whole number")
    yield "mode 99", lambda x: x.model.view_mode(99), "mode: expected a number from 1 to"
    yield "mode at", lambda x: x.model.view_mode(1, at="nowhere"), "at: expected"
    yield "instantaneous", lambda x: x.model.linearise(instantaneous="x"), "instantaneous: expected True or False"
    # models
    for label, call in {
        "parameters": lambda x, v: x.model.parameters(v),
        "compile options": lambda x, v: x.model.compile("lagrange", v),
        "assemble": lambda x, v: x.model.assemble(x.compiled, v),
        "assemble method": lambda x, v: x.model.assemble(x.compiled, {}, v),
    }.items():
        yield from each(label, NO_MAPPING, call, "got {}")
    yield "parameter text", lambda x: x.model.parameters({"x": "1"}), "expected a parameter of pendulum"
    yield from each("compile", NO_TEXT, lambda x, v: x.model.compile(v), "expected a method, got {}")
    wrong = "shape: expected one of straight"
    yield from each("shape", NO_TEXT, lambda x, v: x.model.compile("lagrange", shape=v), wrong)
    yield "compile auto", lambda x: x.model.compile("lagrange", shape="auto"), "one of straight, looped, got 'auto'"
    wrong = "option 'weight': expected a text, got 1"
    yield "compile option", lambda x: x.model.compile("lagrange", {"weight": 1}), wrong
    for changes, sentence in (
        ({"path": 3}, "path: expected a path, got 3"),
        ({"methods": 3}, "methods: expected a list of names, got 3"),
        ({"methods": "lagrang"}, "method: expected a method, got 'lagrang'; did you mean"),
        ({"options": 3}, "options: expected texts by the names of options, got 3"),
        ({"options": {"weight": "mass"}}, "option weight: expected METHOD.NAME with one of direct-correction"),
        ({"coordinates": "polar"}, "coordinates: expected one of absolute, joint, auto, got 'polar'"),
        ({"shape": "auto"}, "shape: expected one of straight, looped, got 'auto'"),
        (
            {"target": "cc"},
            "target: expected a target, got 'cc'; did you mean 'c'? (known: c, c-functions, casadi, cpu, cuda, fmu, ",
        ),
        ({"target": "fmu", "fmi": 4}, "fmi: expected 2 or 3, got 4"),
    ):
        yield f"generate {changes}", lambda x, c=changes: x.model.generate(**c), sentence
    yield "assemble what", lambda x: x.model.assemble(3), "compiled: expected what Model.compile returned, got 3"
    wrong = "compiled code of four-bar, got that"
    yield "assemble other", lambda x: symgen.load("four-bar").assemble(x.compiled), wrong
    yield "assemble strict", lambda x: x.model.assemble(x.compiled, strict="no"), "strict: expected True or False"
    yield "assemble alpha", lambda x: x.model.assemble(x.compiled, {}, {"alpha": 1.0}), "a parameter of lagrange, got"
    yield "body", lambda x: x.model.mechanism.body("bo"), "body: expected a body of pendulum, got 'bo'; did you mean"
    wrong = "joint: expected a joint of pendulum, got 'hinge'"
    yield "joint", lambda x: x.model.mechanism.joint_named("hinge"), wrong
    yield "body 3", lambda x: x.model.mechanism.body(3), "body: expected a body of pendulum, got 3"
    # results
    keys = {"-1": -1, "None": None, "a tuple of 2": (0, 1), "1.5": 1.5, "a slice": slice(3)}
    for label, call, sentence in (
        ("q", lambda x, v: x.result.q[v], "got {}; outputs are rows: table.values[-1]"),
        ("column", lambda x, v: x.result[v], "got {}; outputs are rows: result.q.values[-1]"),
        ("unit", lambda x, v: x.result.q.unit(v), "got {}"),
        ("reaction", lambda x, v: x.result.reaction(v), "joint: expected the name of a joint, got {}"),
    ):
        yield from each(label, keys, call, sentence)
    yield "gradient", lambda x: x.result.gradient("bob.x"), "gradient: expected a run with sensitivities=(...), got one"
    yield "column", lambda x: x.result["bob.z"], "quantity 'bob.z': expected a quantity of pendulum, got none of"
    yield "column long", lambda x: x.result["x" * 9999], "quantity 'xxxxxxxxxxxx"
    yield "reaction", lambda x: x.result.reaction("lin"), "joint: expected the name of a joint, got 'lin'"
    indices = (99, -99, "last", None, 1.5, [0])
    yield from each("row", indices, lambda x, v: x.result.q.row(v), "row: expected a whole number from -")
    for label, call, where in (
        ("save", lambda x, v: x.result.save(v), "save"),
        ("plot", lambda x, v: x.result.plot(v), "plot"),
        ("study", lambda x, v: x.study.save(v), "save"),
        ("sweep save", lambda x, v: x.sweep.save(v), "save"),
        ("study plot", lambda x, v: x.study.plot(v), "plot"),
        ("sweep plot", lambda x, v: x.sweep.plot(v), "plot"),
    ):
        names = {"3": 3, "None": None, "b'a.csv'": b"a.csv", "a list of 1": ["a.csv"]}
        if where == "plot":  # without a path a plot comes back
            del names["None"]
        yield from each(label, names, call, f"{where}: expected a path, got {{}}")
    yield from each("report", NO_TEXT, lambda x, v: symgen.write_report(x.study, v), "report: expected a path, got ")
    yield (
        "report of 3",
        lambda x: symgen.write_report(3, "a.html"),
        "report: expected a comparison or a stress",
    )
    yield "report ending", lambda x: x.study.save("a.htm"), "save: expected a file ending in .csv, .html, .md, .pdf"
    yield "save ending", lambda x: x.result.save("a.xls"), "save: expected a file ending in .nc"
    yield "save folder", lambda x: x.result.save("no/where/a.csv"), "save: expected a file in a folder that exists"
    yield "save null", lambda x: x.result.save("a\0.csv"), "save: expected a name that a file can have"
    yield (
        "columns",
        lambda x: x.result.columns("pints"),
        "table: got 'pints'; did you mean 'points'?",
    )
    yield (
        "series of columns",
        lambda x: x.result.series("pints"),
        "table: got 'pints'; did you mean 'points'?",
    )
    yield "select", lambda x: x.result.select(3), "quantities: expected a list of names, got 3"
    yield "select name", lambda x: x.result.select(["bob.z"]), "quantity 'bob.z': expected a quantity of"
    yield "plot what", lambda x: x.result.plot("a.png", 3), "plot: expected a list of names, got 3"
    yield "plot over", lambda x: x.result.plot("a.png", "q", over=3), "over: expected a text, got 3"
    yield "plot over two", lambda x: x.result.plot("a.png", "q", over="bob"), "over: expected one column, got 'bob'"
    yield (
        "study plot what",
        lambda x: x.study.plot("a.png", "eror"),
        "plot: got 'eror'; did you mean 'error'?",
    )
    yield "sweep plot what", lambda x: x.sweep.plot("a.png", "bob.z"), "quantity 'bob.z': expected a quantity of"
    yield "sweep plot over", lambda x: x.sweep.plot("a.png", over="bob.z"), "over: expected t, what varies, or"
    yield "plot panel", lambda x: x.result.plot("a.png", "energi"), "quantity 'energi': expected a quantity of"
    # studies
    lists = {"3": 3, "a dict of 0": {}, "the function len": len}
    for name in ("methods", "integrators"):
        call = comparing(name)
        yield from each(f"compare {name}", lists, call, f"{name}: expected a list of names, got {{}}")
        yield from each(f"compare {name}", [["x", 3]], call, f"{name}: expected a list")
    for name in ("steps", "rtols"):
        values = ("1e-3", [0.0], [-1.0], [NAN], ["x"], [None], [True], {"a": 1}, np.zeros((2, 2)), len)
        call = comparing(name)
        yield from each(f"compare {name}", values, call, f"{name[:-1]}: expected a ")
    for name in ("until", "output_step", "max_violation", "max_energy_error"):
        call = comparing(name)
        wrong = f"{name}: expected a finite number above 0, got "
        yield from each(f"compare {name}", (0, -1.0, NAN, "1", True, [1.0]), call, wrong)
    yield "view beside", lambda x: x.result.view("a.nc"), "beside: expected a result of a run"
    yield "view live", lambda x: x.result.view(live="no"), "live: expected "
    yield "draw at", lambda x: x.model.draw(at="end"), "at: expected one of"
    yield "draw parameters", lambda x: x.model.draw({"nothing": 1.0}), "parameter 'nothing': expected a parameter"
    yield "draw start", lambda x: x.model.draw(start={"nothing": 1.0}), "start 'nothing'"
    yield from each("draw q", ("q", [1.0], np.zeros((2, 2)), [None], 3), lambda x, v: x.model.draw(q=v), "q: expected")
    yield "draw view", lambda x: x.model.draw(view=(1, 2)), "view: expected a symgen.describe.drawing.View, got"
    counts = (0, 1.5, "3", None)
    yield from each(
        "compare repeat", counts, lambda x, v: symgen.compare(x.model, repeat=v), "repeat: expected a whole"
    )
    yield from each(
        "compare jobs", counts, lambda x, v: symgen.compare(x.model, jobs=v), "jobs: expected a whole number"
    )
    for changes, sentence in (
        ({"journal": "file"}, "journal: expected a symgen.study.journal"),
        ({"reference_by": 3}, "reference_by: expected one of auto"),
        ({"shape": "round"}, "shape: expected one of auto"),
        ({"options": 3}, "options: expected values by the names"),
        ({"parameters": {"g": "x"}}, "expected a finite number"),
    ):
        yield f"compare {changes}", lambda x, c=changes: symgen.compare(x.model, **c), sentence
    for changes, sentence in (
        ({"cases": 3}, "cases: expected a list of names"),
        ({"methods": len}, "methods: expected a list of names"),
        ({"models": [3]}, "model: expected a path, got 3"),
        ({"jobs": 0}, "jobs: expected a whole number"),
        ({"quick": "no"}, "quick: expected True or False"),
        ({"compilation": "long"}, "compilation: expected"),
    ):
        yield f"stress {changes}", lambda x, c=changes: stress(**c), sentence
    # sweeps
    for name in ("vary", "runs"):
        call = sweeping(name)
        yield from each(name, NO_MAPPING, call, f"{name}: expected values")
        yield from each(name, [{3: [1.0]}], call, "named by texts, got 3")
        of_axis = (3.0, None, [], [[1.0]], ["x"], [NAN], [None], len, {"a": 1}, "lin(0,1)", "cube(1,2,3)", [1j])
        yield from each(f"{name} bob.vy", [{"bob.vy": v} for v in of_axis], call, "bob.vy: expected ")
    yield "vary nothing", lambda x: symgen.sweep(x.model, {}), "sweep: expected something that varies, got nothing"
    yield "vary name", lambda x: symgen.sweep(x.model, {"bob.vz": [1.0]}), "did you mean 'bob.v"
    for changes, sentence in (
        *(({"jobs": v}, "jobs: expected") for v in (0, 5000, 1.5, "3", True)),
        ({"quantities": 3}, "quantities: expected a list of names"),
        ({"quantities": ["bob.z"]}, "quantity 'bob.z': expected a quantity of pendulum"),
        ({"quantities": [3]}, "quantities: expected a list of names, got 3"),
        ({"output": 3}, "output: expected a path, got 3"),
        ({"output": "a.xls"}, "output: expected a file ending in .nc"),
        ({"resume": "yes"}, "resume: expected True or False"),
        ({"resume": True}, "resume: expected an output that was begun"),
        ({"scheduler": 3}, "scheduler: expected the address of a Dask scheduler, or a client, got 3"),
        ({"target": 3}, "target: expected one of cpu"),
        ({"target": "gpu"}, "target: expected one of cpu, lanes, cuda, got 'gpu'"),
        ({"verify": True}, "verify: expected single runs"),
        ({"repeat": 2}, "repeat: expected single runs"),
        ({"method": 3}, "method: expected a name, got 3"),
    ):
        yield f"sweep {changes}", lambda x, c=changes: symgen.sweep(x.model, vy, **c), sentence
    wrong = "sweep: expected a quantity that was kept, or a number"
    yield from each("sweep column", (3, None, "bob.z"), lambda x, v: x.sweep[v], wrong)
    wrong = "sweep: expected a quantity that was kept, or a number"
    yield from each("sweep contributions", (3, "bob.z"), lambda x, v: x.sweep.contributions(v), wrong)
    wrong = "sensitivities: expected a list of names, got 3"
    yield from each("sweep sensitivities", {"3": 3, "a list of 3": [3]}, lambda x, v: x.sweep.sensitivities(v), wrong)
    yield "sweep reasons", lambda x: x.sweep.reasons("all"), "most: expected a whole number"
    # builders
    names = {"3": 3, "None": None, "a list of 0": []}
    yield from each(
        "builder", names, lambda x, v: symgen.MechanismBuilder(v).body("a", mass=1).build(), "mechanism.name"
    )
    further = {
        **dict.fromkeys(("body", "beam", "event", "stop"), ()),
        **{"parameter": (1.0,), "input": (1.0,), "table": ([0, 1], [0, 1]), "output": ("t",)},
        **{"joint": ("rigid",), "force": ("torque",), "state": (1.0,)},
    }
    for part, more in further.items():
        yield from each(part, names, building(part, more), "expected a text, got {}")
    for key, value in (
        *(("mass", v) for v in (None, "", [], NAN, INF, -1.0, True, Thing(), len, 1j, 10**400, {"a": 1})),
        *(("inertia", v) for v in (np.eye(3), object, float("-inf"))),
        *(("position", v) for v in (1.0, [1.0], [1.0, 2.0, 3.0], ["x", "y"], np.zeros((2, 2)), [NAN, 0.0], len)),
        ("points", [1.0]),
        ("points", {"a": 1.0}),
        ("points", {3: [0.0, 0.0]}),
        ("nonsense", 1.0),
    ):
        yield f"body {key} {value!r:.15}", lambda x, k=key, v=value: built(**{k: v}).build(), "builder 'a': bodies.b"
    yield "table", lambda x: built().table("f", 3, 4).build(), "tables.f.x: expected a list of numbers, got 3"
    yield "joint type", lambda x: built().joint("j", 3).build(), "joints.j.type: expected a joint type, got 3"
    yield "run", lambda x: built().run(until="long").build(), "run.until"
    yield "start output", lambda x: x.model.start(output_step=0.1), "start: output_step: expected settings of a run"
    yield "start name", lambda x: x.model.start(stepp=0.1), "did you mean 'step'?"
    above = "expected a finite number above 0, got {}"
    yield from each("step", NO_NUMBER, lambda x, v: x.sim.step(v), f"dt: {above}")
    yield from each("every", NO_NUMBER, lambda x, v: x.sim.every(v, print), f"interval: {above}")
    yield from each("run", NO_NUMBER, lambda x, v: x.sim.run(v), "until: expected ")
    numbers = "set: expected numbers by the names of parameters, got {}"
    yield from each("set", NO_MAPPING, lambda x, v: x.sim.set(v), numbers)
    yield from each("step u", NO_MAPPING, lambda x, v: x.sim.step(0.01, v), "parameters, got {}")
    yield from each("restore", NO_MAPPING, lambda x, v: x.sim.restore(v), "expected what `save` returned, got {}")
    yield "meter", lambda x: x.sim.meter(3), "meter: expected "
    yield "horizon", lambda x: x.sim.horizon("a", 0.01), "horizon: expected numbers, got 'a'"
    yield "horizon dt", lambda x: x.sim.horizon([[]], 0.0), "dt: expected a finite number above 0, got 0"
    yield "meter name", lambda x: x.sim.meter(["bob.xx"]), "meter"
    starts = {"3": 3, "[1.0]": [1.0]}
    yield from each("reset", starts, lambda x, v: x.sim.reset(v), "start: expected values by the names of coordinates")
    yield "reset name", lambda x: x.sim.reset({"bob.vxx": 1.0}), "did you mean 'bob.vx'?"
    yield "column", lambda x: x.sim["crank.thet"], "quantity 'crank.thet': expected a quantity of pendulum"
    yield "inspect method", lambda x: x.model.inspect("lagrang"), "method: expected a method, got 'lagrang'"
    yield "inspect options", lambda x: x.model.inspect("lagrange", 3), "options: expected texts by name, got 3"
    yield "inspect coordinates", lambda x: x.model.inspect(coordinates="joints"), "did you mean 'joint'?"
    yield "view live", lambda x: x.model.view(live=3, until=0.01), "live: expected True or False, got 3"
    yield "view until", lambda x: x.model.view(until=-1), "until: expected a finite number above 0, got -1"
    yield "model sweep", lambda x: x.model.sweep({"bob_mas": [1.0]}), "did you mean 'bob_mass'?"
    yield "model compare", lambda x: x.model.compare(["lagrang"]), "methods: expected a method, got 'lagrang'"
    yield "variant", lambda x: x.model.compare(["baumgarte:alpha"]), "methods: expected NAME, or NAME:OPTION=VALUE"
    yield "plugin", lambda x: symgen.load_plugin(3), "plugin: expected a path, got 3"
    functions = {"3": 3, "None": None, "'f'": "f"}
    yield from each(
        "controller", functions, lambda x, v: x.sim.every(0.1, v), "controller: expected a function, got {}"
    )
    wrong = "coordinates: expected one of absolute, joint, got {}"
    yield from each("equations_in", {"'joints'": "joints", "3": 3}, lambda x, v: x.model.equations_in(v), wrong)
    wrong = "coordinates: expected one of absolute, joint, auto, got {}"
    yield from each("functions", {"'joints'": "joints", "3": 3}, lambda x, v: x.model.functions(v), wrong)
    numbers = "values: expected numbers by name, got {}"
    yield from each("functions numbers", NO_MAPPING, lambda x, v: x.model.functions("absolute", v), numbers)
    yield "functions name", lambda x: x.model.functions(parameters={"bob_mas": 1.0}), "did you mean 'bob_mass'?"
    yield from each("frame", {"3": 3, "None": None}, lambda x, v: x.model.frame(v), "frame: expected ")
    yield "frame name", lambda x: x.model.frame("bobb"), "expected a body or a point of pendulum"
    yield "equations 3", lambda x: x.model.equations.quantity(3), "quantity: expected one of Phi, D, nu"
    yield "toml", lambda x: symgen.MechanismBuilder("a").body("b", mass=Thing()).to_toml(), "a Thing"


ROWS = by_word(rows())
ANALYSIS_METHODS = [method for _, analysis in ANALYSES.items() for method in analysis.methods]


@pytest.fixture(scope="module")
def things(model, result, sweep, study):
    sim = model.start(integrator="rk4", step=1e-3)
    sim.step(0.02)
    return SimpleNamespace(
        model=model, result=result, sweep=sweep, study=study, compiled=model.compile("lagrange"), sim=sim
    )


@pytest.mark.parametrize("word", ROWS)
def test_everything_else(things, tmp_path, monkeypatch, word):
    monkeypatch.chdir(tmp_path)
    for label, call, sentence in ROWS[word]:
        with pytest.raises(SymgenError) as error:
            call(things)
            pytest.fail(f"{label}: it is taken")
        assert isinstance(error.value, InputError), label
        assert sentence in str(error.value) and str(error.value).isprintable(), label
        assert list(tmp_path.iterdir()) == [], label


@pytest.mark.parametrize("method", ANALYSIS_METHODS, ids=lambda method: method.__name__)
def test_every_analysis_takes_settings_and_refuses_others(model, method):
    needed = [
        None
        for p in inspect.signature(method).parameters.values()
        if p.default is p.empty and p.kind < p.VAR_POSITIONAL
    ]
    named = {
        p.name: ("x",)
        for p in inspect.signature(method).parameters.values()
        if p.kind is p.KEYWORD_ONLY and p.default is p.empty
    }
    call = partial(getattr(model, method.__name__), *needed[1:], **named)
    for changes, sentence in (
        ({"settings": 3}, "settings: expected Settings, got 3"),
        ({"nope": 1}, "settings: expected the name of a setting, got 'nope'"),
        ({"verify": True}, f"{method.__name__}: verify: expected one of "),
    ):
        with pytest.raises(InputError) as error:
            call(**changes)
        assert sentence in str(error.value)


def test_no_function_with_arguments_is_left_out():
    """Every public name that can be called, and every method of a public class that takes something, has rows."""
    tested = {
        *"load simulate compare sweep design Model Settings MechanismBuilder".split(),
        *"Mechanism.body Mechanism.joint_named".split(),
        *"list_methods list_integrators load_plugin write_report reduced".split(),
        *(
            f"Model.{n}"
            for n in "parameters compile equations_in generate draw assemble simulate start functions frame".split()
        ),
        *(f"Model.{n}" for n in "inspect view sweep compare design".split()),
        *"Design.save Design.report".split(),
        *(f"Result.{n}" for n in "gradient save plot reaction columns select series view".split()),
        *"Labelled.row Labelled.unit Study.save Study.plot".split(),
        *(f"Sweep.{n}" for n in "save plot reasons sensitivities contributions".split()),
        *(f"SteppedRun.{n}" for n in "step run every set meter horizon restore reset".split()),
        *(
            f"MechanismBuilder.{n}"
            for n in "run parameter input table body beam joint force state stop output event".split()
        ),
    }
    tested |= {f"Model.{method.__name__}" for method in ANALYSIS_METHODS}
    # what only the package makes or calls
    inner = {
        *"Labelled Study Sweep Design SteppedRun Mechanism Model.compiled Model.ready Model.initial_state".split(),
        "Result",
        "Result.along",
        "Result.whole",
    }
    found = set()
    for name in symgen.__all__:
        thing = getattr(symgen, name)
        if not callable(thing) or (isinstance(thing, type) and issubclass(thing, SymgenError)):
            continue
        found.add(name)
        if isinstance(thing, type):
            for method, function in inspect.getmembers(thing, inspect.isfunction):
                if not method.startswith("_") and len(inspect.signature(function).parameters) > 1:
                    found.add(f"{name}.{method}")
    assert found - inner == tested
    assert sum(map(len, (*SETTINGS.values(), *ROWS.values()))) > 240


# -- what has a sensible meaning ---------------------------------------------------------------------------------------


def test_nothing_given_is_nothing(model):
    plain = model.simulate(until=0.02)
    given = model.simulate(
        None, None, until=0.02, options=None, parameters=None, integrator=None, step=None, times=None
    )
    assert given.to_json()["final"] == plain.to_json()["final"]
    assert symgen.load(model) is model
    assert model.parameters(None) == model.parameters({})


@pytest.mark.parametrize("kind", [float, np.float64, np.float32, np.array, Fraction])
def test_numbers_of_every_kind(model, kind):
    found = model.simulate(until=kind(0.25), step=kind(0.125))
    assert (found.until, found.step) == (0.25, 0.125) and type(found.until) is float


def test_whole_numbers_of_every_kind(model):
    for value in (2, 2.0, np.int64(2), np.float64(2.0)):
        assert model.simulate(until=0.01, repeat=value).ok
    assert model.simulate(until=1, step=np.int32(1)).until == 1.0
    assert model.simulate(until=0.01, strict=np.True_).ok


def test_single_words_and_numbers_are_lists_of_one(model, study):
    assert [row.method for row in study.rows] == ["lagrange"] and study.rows[0].step == 1e-2
    assert model.simulate(until=0.02, times=0.01).t.tolist() == [0.01]
    assert symgen.sweep(model, {"bob.vy": [0.0]}, until=0.01, quantities="q").ensemble.recipe.quantities


# -- copies and other processes ----------------------------------------------------------------------------------------


@pytest.mark.fast("four-bar-straight")
@pytest.mark.parametrize(
    ("name", "shape"),
    [
        *(("four-bar", "straight"), ("bricard", "straight"), ("four-bar", "looped")),
        pytest.param("bricard", "looped", marks=pytest.mark.slow),
    ],
)
def test_a_result_travels_with_its_tables(name, shape, tmp_path):
    made = symgen.load(name).simulate(until=0.02, shape=shape)
    (tmp_path / "result").write_bytes(pickle.dumps(made))
    for found in (pickle.loads(pickle.dumps(made)), copy.deepcopy(made), copy.copy(made)):
        assert found.to_json() == made.to_json() and found.shape == shape
        for label, table in made.tables().items():
            assert np.array_equal(found.tables()[label].values, table.values), label
            assert found.tables()[label].names == table.names
        assert found.non_unique_reactions == made.non_unique_reactions
        assert found.save(tmp_path / "a.csv").read_bytes() == made.save(tmp_path / "b.csv").read_bytes()
        with pytest.raises(InputError, match=r"result.outcome: expected a result of this process, got one that was"):
            _ = found.outcome
        assert not hasattr(found, "nonsense")
    copied = copy.deepcopy(made)
    copied.q.values[:] = 0.0
    assert made.q.values.any()
    script = (  # neither the model nor Numba are needed to read it
        "import pickle, sys; found = pickle.load(open(sys.argv[1], 'rb'))\n"
        "print(found.status, found.lam.values.shape, 'numba' in sys.modules)"
    )
    read = subprocess.run(
        [sys.executable, "-c", script, tmp_path / "result"], capture_output=True, text=True, check=True, timeout=600
    )
    assert read.stdout.split() == [*f"{made.status} {made.lam.values.shape} False".split()]


@pytest.mark.parametrize("shape", ["straight", "looped"])
def test_a_compiled_model_travels_as_what_made_it(model, shape, tmp_path):
    made = model.compile("direct-correction", {"weight": "mass"}, shape=shape)
    assert copy.deepcopy(made) is made
    found = pickle.loads(pickle.dumps(made))
    assert (found.shape, found.info, found.law) == (made.shape, made.info, made.law)
    (tmp_path / "compiled").write_bytes(pickle.dumps((model, made)))
    script = (
        "import pickle, sys; model, compiled = pickle.load(open(sys.argv[1], 'rb'))\n"
        "print(compiled.shape, sorted(compiled.law.options), model.assemble(compiled).rank)"
    )
    read = python(script, tmp_path / "compiled")
    assert read.returncode == 0, read.stderr
    assert read.stdout == f"{shape} {sorted(made.law.options)} {model.assemble(made).rank}\n"


def test_models_studies_settings_and_errors_travel(model, study):
    for thing in (model, model.mechanism, Settings(step=1e-3, options={"method.alpha": 1.0})):
        assert pickle.loads(pickle.dumps(thing)) == thing and copy.deepcopy(thing) == thing
    again = pickle.loads(pickle.dumps(study))
    assert again.to_json() == study.to_json()
    error = pickle.loads(pickle.dumps(InputError("a", "b", "c", "d")))
    assert str(error) == "a: expected b, got c; d" and (error.where, error.hint) == ("a", "d")
