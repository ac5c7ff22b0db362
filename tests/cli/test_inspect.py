"""What is shown is exactly what is compiled."""

import json
import random
import re

import numpy as np
import pytest
import sympy as sp
from support.graph_values import node_values, state_inputs
from support.models import EVERYTHING

import symgen
from symgen.cli import main
from symgen.derive.formulate.formulate import formulate
from symgen.describe.files.validate import validate
from symgen.result.reading.boxes import name_box
from symgen.result.reading.notations import latex
from symgen.result.reading.quantity_names import input_names, table_functions
from symgen.result.reading.symbolic import exact_literal
from symgen.result.reading.typeset import text_writer


@pytest.fixture(scope="module")
def equations():
    return formulate(validate(EVERYTHING, "test"))


def all_nodes(e):
    for row in e.rows:
        yield from (n for n in (row.phi, row.nu, row.gamma) if n is not None)
        yield from (n for _, n in row.entries)
    yield from e.forces
    yield from (e.kinetic, e.potential, e.power)


def piecewise(*pairs):
    return next(value for value, condition in pairs if condition)


def worth(text, values, tables=()):
    """What Python makes of a text, SymPy's words in it among NumPy's."""
    words = {name: getattr(np, name) for name in "sin cos tan sqrt exp log tanh sign floor".split()}
    words |= {"asin": np.arcsin, "acos": np.arccos, "atan": np.arctan, "atan2": np.arctan2, "Abs": abs}
    words |= {"Min": min, "Max": max, "Piecewise": piecewise, "Eq": np.equal, "Ne": np.not_equal}
    words |= table_functions(tables)
    for i, (key, x) in enumerate(values.items()):
        text = re.sub(rf"(?<![\w.]){re.escape(key)}(?![\w.])", f"_{i}", text)
        words[f"_{i}"] = np.float64(x)
    with np.errstate(all="ignore"):  # both branches of a condition are computed
        return float(eval(text, words))


@pytest.mark.slow
def test_shown_expressions_have_the_values_of_the_graph(equations, monkeypatch):
    monkeypatch.setattr("symgen.result.reading.typeset.LONGEST", 10_000)
    rng = random.Random(3)
    q, v = ([rng.uniform(-1.0, 1.0) for _ in range(n)] for n in (equations.nq, equations.nv))
    p = [rng.uniform(0.5, 1.5) for _ in equations.parameters]
    inputs = state_inputs(0.7, q, v, p)
    values = {title: inputs[key] for key, title in input_names(equations).items() if key in inputs}
    nodes = list(all_nodes(equations))
    expected = node_values(equations.graph, nodes, inputs, equations.tables)
    shown = [worth(text, values, equations.tables) for text in map(text_writer(equations), nodes)]
    assert shown == pytest.approx(expected, rel=1e-12, abs=1e-12)


def test_long_expressions_are_counted_instead(equations, monkeypatch):
    monkeypatch.setattr("symgen.result.reading.typeset.LONGEST", 3)
    assert text_writer(equations)(equations.kinetic).endswith(" operations>")


def formulas(*components, **sections):
    """A point on which a force with these components acts."""
    raw = {
        "mechanism": {"name": "pushed"},
        "parameters": {"k": 0.3, "c": 1.7},
        "bodies": {"a": {"type": "point", "mass": 1.0}},
        "forces": {"f": {"type": "force", "body": "a", "at": "centre", "force": list(components)}},
        **sections,
    }
    e = formulate(validate(raw, "test"))
    return e, list(map(text_writer(e), e.forces))


@pytest.mark.parametrize("text", ["0.25*(-2*k*3*a.x)/(a.y*(c - a.vx))", "-7*3*k*c/(k*a.x*a.y)/3"])
def test_text_means_what_the_formula_says(text):
    """Read by Python: under a negative product a denominator of several factors keeps its brackets."""
    _, (shown, _) = formulas(text, 0.0)
    numbers = {"a.x": 0.7, "a.y": -1.3, "a.vx": 0.4, "k": 0.3, "c": 1.7}

    assert worth(shown, numbers) == pytest.approx(worth(text, numbers), rel=1e-12)


def test_interpolated_functions_have_names_that_can_be_read():
    e = formulate(symgen.load("cam-follower").mechanism)
    (row,) = (row for row in e.rows if row.name == "cam.driver")
    shown = list(map(text_writer(e), (row.phi, row.nu, row.gamma)))
    assert shown == ["follower.y - table_lift(t*speed)", "speed*slope_lift(t*speed)", "speed**2*second_lift(t*speed)"]
    _, shown = formulas("line(a.x)", 0.0, tables={"line": {"x": [0.0, 1.0], "y": [0.0, 2.0]}})
    assert shown[0] == "table_line(a.x)"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("t", "t"),
        ("crank.theta", r"\theta_{\mathrm{crank}}"),
        ("big_arm.x", r"x_{\mathrm{big\_arm}}"),
        ("crank.vx", r"v_{x,\mathrm{crank}}"),
        ("rod.wz", r"\omega_{z,\mathrm{rod}}"),
        ("rod.e0", r"e_{0,\mathrm{rod}}"),
        ("P_0.angle", r"\mathrm{angle}_{\mathrm{P\_0}}"),
        ("crank_mass", r"\mathrm{crank\_mass}"),
    ],
)
def test_latex_names(text, expected):
    assert latex(name_box(text)) == expected


def test_numbers_are_shown_with_all_digits():
    assert str(exact_literal(3.0)) == "3"
    assert sp.sstr(exact_literal(0.1), full_prec=False) == "0.1"
    assert sp.sstr(exact_literal(1 / 6), full_prec=False) == repr(1 / 6)


def test_text(capsys):
    assert main(["inspect", "four-bar", "--method", "lagrange"]) == 0
    text = capsys.readouterr().out
    for part in (
        "9 coordinates, 9 velocities, 8 constraint rows of rank 8, 1 degree of freedom",
        "A.x [m]: crank.x - cos(crank.theta)",
        "A.x  1.x......",
        "D[B.x, coupler.omega] = 4*sin(coupler.theta)",
        "gamma[A.x] = -cos(crank.theta)*crank.omega**2",
        "M[crank.vx] = crank_mass",
        "f[rocker.vy] = -9.81*rocker_mass",
        "rows redundant at the start: none",
        "gyroscopic terms: they vanish in the plane",
        "Functions emitted for lagrange",
    ):
        assert part in text, part


def test_json(capsys):
    assert main(["inspect", "driven-four-bar", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["degrees_of_freedom"] == 0 and found["rank"] == 9
    assert len(found["pattern"]) == 9 and all(len(line) == 9 for line in found["pattern"])
    motor = found["rows"][-1]
    assert motor["name"] == "motor.driver" and motor["nu"] == "crank_speed"
    assert motor["jacobian"] == {"crank.omega": "1"}
    for counts in found["operations"].values():
        assert counts["after"] <= counts["before"]
    assert found["operations"]["together"]["after"] < found["operations"]["together"]["before"]
    assert found["left_out"]


def test_latex(capsys):
    assert main(["inspect", "pendulum", "--format", "latex"]) == 0
    text = capsys.readouterr().out
    assert text.count(r"\begin{align*}") == text.count(r"\end{align*}") == 6
    assert all(rf"\paragraph{{{title}" in text for title in ("Constraints", "Jacobian", "Mass matrix", "Forces"))
    assert r"\Phi_{\mathrm{link.stretch}}" in text or r"\Phi_{\mathrm{link.distance}}" in text
    assert text.count("{") == text.count("}")
    assert main(["inspect", "pendulum", "--format", "latex", "--select", "gamma"]) == 0
    assert capsys.readouterr().out.count(r"\paragraph") == 1


def test_redundant_rows_are_shown(tmp_path, capsys):
    joint = '[joints.{}]\ntype = "revolute"\nbetween = ["ground", "rod"]\nat = [[0.0, 0.0], [-0.5, 0.0]]\n'
    body = "[bodies.rod]\nmass = 1.0\ninertia = 0.1\nposition = [0.5, 0.0]\n"
    path = tmp_path / "twice.toml"
    path.write_text('[mechanism]\nname = "twice"\n' + body + joint.format("a") + joint.format("b"))
    assert main(["inspect", str(path)]) == 0
    text = capsys.readouterr().out
    assert "rows repeated: b.x = a.x, b.y = a.y" in text
    assert "row b.x: it repeats row a.x for all q" in text


def test_the_python_interface_is_lazy():
    assert set(symgen.__all__) <= set(dir(symgen))
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        symgen.nothing  # noqa: B018  # looking it up is the test


@pytest.mark.slow
def test_long_lines_are_written_by_terms_that_mean_the_same(capsys):
    """Forces of the governor by lengths and rates of its springs, against an interpreter of the graph."""
    assert main(["inspect", "flyball-governor"]) == 0
    lines = capsys.readouterr().out.splitlines()
    terms = lines[lines.index("Shared terms of gamma and f") + 2 : lines.index("Energies") - 1]
    assert {"spring1.length", "spring1.rate", "shaft.a00"} <= {line.partition(" = ")[0] for line in terms}
    assert max(len(line) for line in lines if line.startswith(("gamma[", "f["))) < 600  # it was 2421
    e = formulate(symgen.load("flyball-governor").mechanism)
    rng = random.Random(5)
    q, v = ([rng.uniform(-1.0, 1.0) for _ in range(n)] for n in (e.nq, e.nv))
    inputs = state_inputs(0.7, q, v, [rng.uniform(0.5, 1.5) for _ in e.parameters])
    values = {title: inputs[key] for key, title in input_names(e).items() if key in inputs}
    for line in terms:
        title, _, text = line.partition(" = ")
        values[title] = worth(text, values)
    titles = [f"gamma[{row.name}] = " for row in e.rows] + [f"f[{velocity.name}] = " for velocity in e.velocities]
    nodes = [*(row.gamma for row in e.rows), *e.forces]
    for title, expected in zip(titles, node_values(e.graph, nodes, inputs), strict=True):
        (line,) = (line for line in lines if line.startswith(title))
        assert worth(line.removeprefix(title), values) == pytest.approx(expected, rel=1e-9, abs=1e-9), title
