"""What is shown is exactly what is compiled."""

import json
import random

import pytest
import sympy as sp
from support.graph_values import node_values, state_inputs
from support.models import EVERYTHING

import symgen
from symgen.cli import main
from symgen.describe.validate import validate
from symgen.formulate.display import Display, latex_name, number
from symgen.formulate.formulate import formulate


@pytest.fixture(scope="module")
def equations():
    return formulate(validate(EVERYTHING, "test"))


def all_nodes(e):
    for row in e.rows:
        yield from (n for n in (row.phi, row.nu, row.gamma) if n is not None)
        yield from (n for _, n in row.entries)
    yield from e.forces
    yield from (e.kinetic, e.potential, e.power)


def test_shown_expressions_have_the_values_of_the_graph(equations):
    rng = random.Random(3)
    display = Display(equations)
    q, v = ([rng.uniform(-1.0, 1.0) for _ in range(n)] for n in (equations.nq, equations.nv))
    p = [rng.uniform(0.5, 1.5) for _ in equations.parameters]
    inputs = state_inputs(0.7, q, v, p)
    values = {display.symbols[key]: x for key, x in inputs.items() if key in display.symbols}
    nodes = list(all_nodes(equations))
    expected = node_values(equations.graph, nodes, inputs, equations.tables)
    # SymPy's own evaluation of what is shown, not of what was derived
    shown = sp.lambdify(list(values), [display.expression(node) for node in nodes], ["math"])(*values.values())
    assert shown == pytest.approx(expected, rel=1e-12, abs=1e-12)


def test_long_expressions_are_counted_instead(equations, monkeypatch):
    monkeypatch.setattr("symgen.formulate.display.LONGEST", 3)
    display = Display(equations)
    assert display.text(equations.kinetic).endswith(" operations>")
    assert r"\mathrm{operations}" in display.latex(equations.kinetic)


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
    return e, [Display(e).text(node) for node in e.forces]


@pytest.mark.parametrize("text", ["0.25*(-2*k*3*a.x)/(a.y*(c - a.vx))", "-7*3*k*c/(k*a.x*a.y)/3"])
def test_text_means_what_the_formula_says(text):
    """Read by Python: under a negative product a denominator of several factors keeps its brackets."""
    _, (shown, _) = formulas(text, 0.0)
    numbers = {"a.x": 0.7, "a.y": -1.3, "a.vx": 0.4, "k": 0.3, "c": 1.7}

    def worth(formula):
        for name, x in numbers.items():
            formula = formula.replace(name, f"({x!r})") if "." in name else formula
        return eval(formula, {"k": 0.3, "c": 1.7})

    assert worth(shown) == pytest.approx(worth(text), rel=1e-12)


def test_interpolated_functions_have_names_that_can_be_read():
    e = formulate(symgen.load("cam-follower").mechanism)
    (row,) = (row for row in e.rows if row.name == "cam.driver")
    shown = [Display(e).text(node) for node in (row.phi, row.nu, row.gamma)]
    assert shown == ["follower.y - table_lift(t*speed)", "speed*slope_lift(t*speed)", "speed**2*second_lift(t*speed)"]
    _, shown = formulas("line(a.x)", 0.0, tables={"line": {"x": [0.0, 1.0], "y": [0.0, 2.0]}})
    assert shown[0] == "table_line(a.x)"


@pytest.mark.parametrize(
    ("name", "latex"),
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
def test_latex_names(name, latex):
    assert latex_name(name) == latex


def test_numbers_are_shown_with_all_digits():
    assert str(number(3.0)) == "3"
    assert sp.sstr(number(0.1), full_prec=False) == "0.1"
    assert sp.sstr(number(1 / 6), full_prec=False) == repr(1 / 6)


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
    assert text.count(r"\begin{align*}") == text.count(r"\end{align*}") == 7
    assert r"\Phi_{\mathrm{link.stretch}}" in text or r"\Phi_{\mathrm{link.distance}}" in text
    assert text.count("{") == text.count("}")


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
