"""LaTeX documents: what they hold, and that a real engine sets them without lines over the edge."""

import re
import shutil
import subprocess

import pytest
from support.rotation import of_turn

import symgen
from symgen.cli import main
from symgen.derive.formulate.formulate import formulate
from symgen.describe import catalogue
from symgen.describe.files.load import load_mechanism, read_raw
from symgen.describe.files.validate import validate
from symgen.result.reading.latex_document import latex_document as whole_document
from symgen.result.reading.law_steps import law_as_steps
from symgen.result.reading.length_symbols import put_length_symbols


def document(capsys, *arguments):
    assert main(["inspect", *arguments, "--format", "latex", "--document"]) == 0
    return capsys.readouterr().out


def test_a_document_holds_everything(capsys):
    text = document(capsys, "four-bar")
    assert text.startswith(r"\documentclass")
    assert r"\Phi_{\mathrm{B.x}} &= x_{\mathrm{coupler}} - x_{\mathrm{crank}}" in text
    assert r"D_{B,\mathrm{crank}}" in text
    assert r"\lambda &= D {M}^{-1} f - \gamma" in text
    assert r"crank\_\allowbreak mass & kg & 2" in text
    assert text.count(r"\begin{align*}") == text.count(r"\end{align*}")
    assert "the mechanism is planar" in text


def test_sections_and_joints_are_selected(capsys):
    text = document(capsys, "four-bar", "--select", "Phi,joints.D")
    assert r"\Phi_{\mathrm{D.x}}" in text and r"\Phi_{\mathrm{A.x}}" not in text
    assert "gamma" not in text.partition("Numbers")[2]


def test_no_two_parameters_are_typeset_alike():
    raw = {
        "mechanism": {"name": "alike"},
        "parameters": {"l1": 1.0, "l_1": 2.0, "m2": 3.0},
        "bodies": {"a": {"mass": "m2", "inertia": 1.0, "points": {"P": ["l1", 0.0], "Q": ["l_1", 0.0]}}},
        "joints": {
            "A": {"type": "distance", "between": ["ground", "a"], "at": [[0.0, 0.0], "P"], "length": 1.0},
            "B": {"type": "distance", "between": ["ground", "a"], "at": [[5.0, 0.0], "Q"], "length": 3.0},
        },
    }
    mechanism = validate(raw, "test")
    values = {"l1": 1.0, "l_1": 2.0, "m2": 3.0}
    text = whole_document(mechanism, formulate(mechanism), law_as_steps("lagrange"), values)
    assert r"$\mathrm{l1}$ & \raggedright l1" in text and r"$l_{1}$ & \raggedright l\_\allowbreak 1" in text
    assert r"$m_{2}$" in text  # no other is called so
    assert text.count(r"\mathrm{l1}") > 1 and text.count("l_{1}") > 1


def test_lengths_become_symbols(capsys):
    text = document(capsys, "four-bar", "--symbols", "--select", "nomenclature,Phi")
    assert r"l_{1} \cos \theta_{\mathrm{crank}}" in text
    told = re.findall(r"\$l_\{(\d)\}\$ & \\raggedright (.*?) & m & (\S+) ", text.replace(r"\allowbreak ", ""))
    assert told == [
        ("1", r"l\_1, bodies.crank.points.A.x", "1"),
        ("2", r"l\_2, bodies.crank.points.B.x", "1"),
        ("3", r"l\_3, bodies.coupler.points.B.x", "4"),
        ("4", r"l\_4, bodies.coupler.points.C.x", "4"),
        ("5", r"l\_5, bodies.rocker.points.D.x", "2.5"),
        ("6", r"l\_6, bodies.rocker.points.C.x", "2.5"),
        ("7", r"l\_7, joints.D.at.ground.x", "10"),
    ]


def test_lengths_are_known_by_where_they_stand():
    bar = {"mass": 1.0, "inertia": 1.0, "points": {"P": [-0.3, 0], "Q": [0.3, "h"]}}
    pin = {"type": "revolute", "between": ["ground", "a"], "at": [[0.3, 0.0], "P"]}
    spring = {"type": "spring-damper", "between": ["ground", "b"], "at": [[0.3, 0.0], [0.3, 0.3]], "free_length": 0.3}
    gears = {
        "one": {"type": "gear", "between": ["a", "b"], "radii": [0.3, 0.3], "offset": 0.3},
        "two": {"type": "gear", "between": ["a", "b"], "ratio": 0.3, "offset": 0.3},
    }
    raw = {"bodies": {"a": bar, "b": bar}, "joints": {"pin": pin, **gears}, "forces": {"s": spring}}
    found = put_length_symbols(raw)
    assert found["bodies"]["a"] == {"mass": 1.0, "inertia": 1.0, "points": {"P": ["-l_1", 0], "Q": ["l_2", "h"]}}
    assert found["bodies"]["b"]["points"] == {"P": ["-l_3", 0], "Q": ["l_4", "h"]}
    assert found["joints"]["pin"]["at"] == [["l_5", 0.0], "P"]
    assert found["joints"]["one"]["radii"] == ["l_6", "l_7"] and found["joints"]["one"]["offset"] == "l_8"
    assert found["joints"]["two"] == gears["two"]  # there the offset is an angle
    # the spring hangs on the same point of the ground as the pin, with a length of its own
    assert (
        found["forces"]["s"]["at"] == [["l_5", 0.0], ["l_9", "l_10"]] and found["forces"]["s"]["free_length"] == "l_11"
    )
    assert {p["value"] for p in found["parameters"].values()} == {0.3}
    assert found["parameters"]["l_5"]["note"] == "joints.pin.at.ground.x"
    assert found["parameters"]["l_7"]["note"] == "joints.one.radii.second"


def test_symbols_change_names_only():
    raw, source = read_raw("slider-crank")
    plain, named = (formulate(validate(r, source)) for r in (raw, put_length_symbols(raw)))
    lengths = [p.name for p in named.parameters if p.name.startswith("l_")]
    assert lengths and len(named.parameters) == len(plain.parameters) + len(lengths)
    assert [r.name for r in named.rows] == [r.name for r in plain.rows]
    assert "l_1" not in str(read_raw("slider-crank")[0])  # the description itself is left as it is


def test_a_name_that_is_taken_is_left_to_its_owner():
    raw, _ = read_raw("pendulum")
    found = put_length_symbols({**raw, "parameters": {**raw.get("parameters", {}), "l_1": 3.0}})
    assert found["parameters"]["l_1"] == 3.0
    assert "l_2" in found["parameters"]
    found = put_length_symbols({**raw, "parameters": {**raw.get("parameters", {}), "l1": 3.0}})
    assert "l_2" in found["parameters"] and "l_1" not in found["parameters"]  # which is typeset as l1 is


def test_drivers_without_rows_are_said_and_numbers_stay_apart(capsys):
    text = document(capsys, "driven-four-bar", "--coordinates", "joint", "--select", "nomenclature,energies,law")
    assert "motor has no row: it prescribes A." in text and r"b \dot {v} + c" in text
    assert not re.search(r"[0-9.]+ [0-9.]+ \\", text.partition("Energies")[2])
    assert r"2.5 \cdot 9.81 \sin" in text


def test_a_power_of_a_sine_is_none_of_its_angle():
    """Braces are not seen on paper: sin of a name and an exponent behind that would be the sine of the power."""
    force = {"type": "force", "body": "a", "at": "centre", "force": ["3*sin(a.theta)**2", "tan(2*a.theta)**2"]}
    raw = {"mechanism": {"name": "m"}, "bodies": {"a": {"mass": 1.0, "inertia": 1.0}}, "forces": {"f": force}}
    mechanism = validate(raw, "test")
    text = whole_document(mechanism, formulate(mechanism), law_as_steps("lagrange"), {}, ["f"])
    assert r"3 {\left( \sin \theta_{\mathrm{a}} \right)}^{2}" in text
    assert r"{\tan\left( 2 \theta_{\mathrm{a}} \right)}^{2}" in text


def test_nonholonomic_rows_are_said(capsys):
    assert re.search(r"Nonholonomic.*contact", document(capsys, "rolling-disc", "--select", "nu"))
    assert "Nonholonomic" not in document(capsys, "four-bar", "--select", "nu")


def test_inputs_are_no_parameters(capsys):
    text = document(capsys, "cart-pole", "--select", "nomenclature")
    assert r"\subsection*{Inputs}" in text
    parameters, _, inputs = text.partition(r"\subsection*{Inputs}")
    assert "force, beside" not in parameters and "force, beside" in inputs


def test_a_title_with_markup_is_text(tmp_path, capsys):
    path = tmp_path / "evil.toml"
    path.write_text(
        '[mechanism]\nname = "evil"\ntitle = "50% \\\\input{x} & $y_1$ #{}~^ ∑"\ngravity = [0, -9.81]\n'
        '[bodies.a]\nmass = 1.0\ninertia = 1.0\n[joints.j]\ntype = "revolute"\nbetween = ["ground", "a"]\n'
        "at = [[0, 0], [0.5, 0]]\n"
    )
    text = document(capsys, str(path))
    assert r"50\% \textbackslash{}input\{x\} \& \$y\_1\$ \#\{\}\textasciitilde{}\textasciicircum{} [U+2211]" in text


# -- a real engine ----------------------------------------------------------------------------------------------------


def set_by_an_engine(text, folder):
    """Return what pdflatex says of a document that it sets without an error."""
    engine = shutil.which("pdflatex")
    assert engine is not None, "these tests need pdflatex; .ci/run installs it"
    (folder / "x.tex").write_text(text)
    done = subprocess.run(
        [engine, "-interaction=nonstopmode", "-halt-on-error", "x.tex"],
        cwd=folder,
        capture_output=True,
        text=True,
        errors="replace",
        timeout=300,
        check=False,
    )
    assert done.returncode == 0, done.stdout[-1500:]
    return (folder / "x.log").read_text(errors="replace")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["cam-follower", "driven-four-bar", "spherical-double-pendulum"])
def test_parts_of_another_document_need_amsmath_alone(name, tmp_path, capsys):
    assert main(["inspect", name, "--format", "latex"]) == 0
    equations = symgen.load(name).equations
    written = f"\\begin{{gather*}}\n{equations.latex()} \\\\\n{equations.shared().latex()}\n\\end{{gather*}}"
    head = r"\documentclass{article}\usepackage{amsmath}\begin{document}"
    set_by_an_engine("\n".join([head, capsys.readouterr().out, written, r"\end{document}"]), tmp_path)


#: Every mechanism once, in coordinates that take turns: `test_equations` compares numbers in both.
TURNS = [(name, ("absolute", "joint")[i % 2]) for i, name in enumerate(sorted(catalogue.all_names()))]
TURNS = [(name, "absolute" if load_mechanism(name).has_modal_bodies else kind) for name, kind in TURNS]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "coordinates"), of_turn(TURNS, 9))
def test_documents_of_the_catalogue_compile_without_overfull_boxes(name, coordinates, tmp_path, capsys):
    symbols = ["--symbols"] if coordinates == "joint" else []
    log = set_by_an_engine(document(capsys, name, "--coordinates", coordinates, *symbols), tmp_path)
    overfull = [float(points) for points in re.findall(r"Overfull \\hbox \(([\d.]+)pt too wide\)", log)]
    assert max(overfull, default=0.0) <= 10.0, overfull
    assert "undefined" not in log
