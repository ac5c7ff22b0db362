"""Plots of chosen quantities over others: what is drawn, read back from the figure."""

import numpy as np
import pytest

import symgen
from symgen.cli import main
from symgen.describe import catalogue
from symgen.result.plots import figure_of_paths, figure_over_column
from symgen.study.ensemble.sweep_plot import sweep_figure

SVG = {".png": b"\x89PNG", ".svg": b"<?xml", ".pdf": b"%PDF"}


@pytest.fixture(scope="module")
def wiper():
    return symgen.load("wiper").simulate(until=0.5, step=5e-3, integrator="rk4")


def test_torque_over_angle(wiper):
    shown = wiper.select(["motor.torque", "motor.power", "shaft.F", "pivot.F"])
    figure = figure_over_column(wiper.along("crank.theta"), shown, wiper.title)
    assert [ax.get_ylabel() for ax in figure.axes] == ["motor.torque [N m]", "motor.power [W]", "force [N]"]
    assert figure.axes[-1].get_xlabel() == "crank.theta [rad]"
    x, y = figure.axes[0].lines[0].get_data()
    assert np.array_equal(x, wiper["crank.theta"]) and np.array_equal(y, wiper["motor.torque"])
    assert [t.get_text() for t in figure.axes[2].texts] == ["shaft.F", "pivot.F"]


def test_curves_that_coincide_are_one_line_with_both_names():
    circle = np.exp(1j * np.linspace(0.0, 6.0, 50))
    curve = np.column_stack([circle.real, circle.imag])
    axes = figure_of_paths({"a.P": curve, "b.Q": curve + 1e-9, "c.R": 2.0 * curve}, "").axes[0]
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["a.P, b.Q", "c.R"]
    assert len(axes.lines) == 2


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("ending", SVG)
def test_commands_draw_what_is_named(ending, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    file, step = f"x{ending}", ("--until", "0.1", "--step", "5e-3")
    short = ("--methods", "lagrange", "--integrators", "rk4", "--steps", "0.02,0.01", "--repeat", "1")
    for words in (
        ("run", "wiper", *step, "--quantity", "motor.torque,shaft.F", "--over", "crank.theta"),
        ("sweep", "pendulum", *step, "--vary", "bob.vy=lin(0,1,3)", "--quantity", "bob.x", "--over", "bob.vy"),
        ("sweep", "pendulum", *step, "--vary", "bob.vy=lin(0,1,3)", "--output-step", "0.02", "--over", "link.F"),
        (
            "kinematics",
            "driven-four-bar",
            "--times",
            "lin(0,1,9)",
            "--quantity",
            "motor.effort",
            "--over",
            "crank.theta",
        ),
        ("inverse", "driven-four-bar", "--times", "lin(0,1,9)", "--over", "motor.rate"),
        ("compare", "pendulum", *short, "--until", "0.2", "--quantity", "error,evaluations", "--over", "step"),
    ):
        assert main([*words, "--plot", file]) == 0, (words, capsys.readouterr().err)
        content = (tmp_path / file).read_bytes()
        assert SVG[ending] in content[:200]
        (tmp_path / file).unlink()


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("run", "wiper", "--over", "crank.theta"), "--over: expected --plot FILE, which draws over it, got no --plot"),
        (("run", "wiper", "--plot", "x.pdf", "--over", "crank.teta"), "did you mean 'crank.theta'?"),
        (("run", "wiper", "--plot", "x.pdf", "--over", "crank"), "over: expected one column, got 'crank', which is"),
        (("run", "wiper", "--quantity", "motor.effort"), "quantity 'motor.effort': expected a quantity of wiper, got"),
        (("compare", "pendulum", "--plot", "x.pdf", "--quantity", "eror"), "did you mean 'error'?"),
        (("compare", "pendulum", "--quantity", "error"), "--quantity: expected --plot FILE, which draws it"),
        (("kinematics", "driven-four-bar", "--over", "t"), "--over: expected --plot FILE"),
    ],
)
def test_a_wrong_name_is_one_sentence_and_nothing_is_written(words, sentence, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(list(words)) == 2
    error = capsys.readouterr().err
    assert sentence in error and error.count("\n") == 1
    assert not [*tmp_path.iterdir()]


def test_ends_of_a_sweep_are_drawn_over_what_varies():
    found = symgen.sweep(
        "pendulum", {"bob.vy": [1.0, 0.0, 2.0], "bob_mass": [1.0, 3.0]}, until=0.1, quantities=["bob.x"]
    )
    axes = sweep_figure(found, (), "").axes[0]
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("bob.vy [m/s]", "bob.x [m]")
    for i, line in enumerate(axes.lines):  # for each mass
        assert np.array_equal(line.get_xdata(), [0.0, 1.0, 2.0])
        assert np.array_equal(line.get_ydata(), found["bob.x"][[1, 0, 2], i, -1])
    assert [t.get_text() for t in axes.get_legend().get_texts()] == ["bob_mass = 1 kg", "bob_mass = 3 kg"]


@pytest.mark.slow
def test_a_motion_of_kinematics_has_a_page():
    moved = symgen.load("driven-four-bar").kinematics(np.linspace(0.0, 1.0, 61))
    page = moved.view()
    assert page.live and "motor.effort" in page.html
    assert not symgen.load("driven-four-bar").kinematics([0.0, 0.1]).view(moved, live=False).live


@pytest.mark.slow
@pytest.mark.parametrize(("outputs", "more"), [(5, ""), (6, "... 2 more; --quantity chooses")])
def test_a_table_shows_its_last_row_in_place_of_one_more(outputs, more, tmp_path, capsys):
    """A four-bar has eight quantities of its own; the table shows twelve."""
    text = catalogue.file_of_entry("four-bar").read_text(encoding="utf-8")
    own = "".join(f'[outputs.o{i}]\nvalue = "{i + 1}*crank.x"\nunit = "m"\n' for i in range(outputs))
    (tmp_path / "model.toml").write_text(text + "\n" + own, encoding="utf-8")
    assert main(["run", str(tmp_path / "model.toml"), "--until", "0.002"]) == 0
    shown = capsys.readouterr().out
    assert more in shown and ("more" in shown) is bool(more)
    assert sum(line.startswith("o") and line[1].isdigit() for line in shown.splitlines()) == (5 if not more else 6)


def test_a_plot_leaves_out_errors_that_are_rounding() -> None:
    """Asked for by name they are drawn; errors that count are drawn anyway."""
    model = symgen.load("slider-crank")
    fine = model.simulate(until=0.5)
    assert not {"energy.error", "violation.position", "violation.velocity"} & {*fine.overview().names}
    assert {"crank.theta", "slider.x", "energy.total"} <= {*fine.overview().names}
    assert "violation.position" in fine.select(["violations"]).names
    coarse = model.simulate(
        until=0.5, method="lagrange", integrator="euler", step=1e-3, max_violation=1.0, max_energy_error=1.0
    )
    assert {*coarse.overview().names} == {*coarse.whole(coarse.drawn).names}
