"""Tables for a paper, and one statistic over several mechanisms."""

import shutil
import subprocess

import pytest

from study.report import made
from symgen.study.comparison.across import across_mechanisms
from symgen.study.comparison.comparison_study import plot_rows
from symgen.study.report.kinds.comparison_report import comparison_report
from symgen.study.report.latex import latex_tables, latex_with_powers

STUDIES = [made.study(), made.study(mechanism="slider_crank & more")]


@pytest.mark.parametrize(
    ("text", "latex"),
    [
        ("3.1×10⁻⁷", r"$3.1\cdot10^{-7}$"),
        ("10⁻⁸", "$10^{-8}$"),
        ("−2×10³ N", r"$-2\cdot10^{3}$ N"),
        ("max |Φ|", r"max $|$$\Phi$$|$"),
        ("a_b & 5 %", r"a\_b \& 5 \%"),
        ("1.08 ± 0.02", r"1.08 $\pm$ 0.02"),
    ],
)
def test_signs_and_powers_are_latex(text, latex):
    assert latex_with_powers(text) == latex


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_tables_of_numbers_come_with_rules_of_booktabs():
    text = latex_tables(comparison_report(STUDIES, "symgen compare four-bar -o t.tex"))
    assert text.startswith("% needs \\usepackage{booktabs}\n% symgen compare four-bar -o t.tex\n")
    assert text.count(r"\begin{table}") == text.count(r"\bottomrule") == 3 + 2 + 1  # side by side, two, the source's
    assert r"slider\_crank \& more" in text and "direct-correction" in text
    assert all(ord(character) < 128 for character in text)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_latex_takes_the_tables(tmp_path):
    assert shutil.which("pdflatex")
    (tmp_path / "t.tex").write_text(latex_tables(comparison_report(STUDIES)), encoding="utf-8")
    head = "\\documentclass{article}\\usepackage{booktabs}\\begin{document}\\input{t}\\end{document}\n"
    (tmp_path / "m.tex").write_text(head, encoding="utf-8")
    words = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "m.tex"]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-800:]


def test_one_statistic_over_mechanisms_counts_each_mechanism_once():
    """Five mechanisms, one with three steps: gains 2, 2, 8 there, whose median counts like those of the others."""

    def study(gains, ratio, name):
        rows = [made.row("lagrange", h, 1e-5, 1.0) for h in (4e-3, 2e-3, 1e-3)[: len(gains)]]
        rows += [made.row("direct-correction", r.step, 1e-5 / g, ratio) for g, r in zip(gains, rows, strict=True)]
        return made.study(rows, mechanism=name)

    studies = [study(g, c, str(i)) for i, (g, c) in enumerate([((2, 2, 8), 1.5), ((1,), 1.2), ((4,), 1.3)])]
    (line,) = across_mechanisms(studies)
    assert (line.method, line.integrator, line.mechanisms, line.settings) == ("direct-correction", "rk4", 3, 5)
    assert line.error == pytest.approx(2.0) and (line.error_low, line.error_high) == pytest.approx((1.0, 4.0))
    assert line.error_mean == pytest.approx(2.0) and line.time == pytest.approx(1.3)
    assert across_mechanisms(studies[:1]) == ()


def test_adaptive_runs_have_no_error_at_an_equal_tolerance():
    rows = [made.row(m, None, 1e-6, 1.0, rtol=1e-6, integrator="dop853") for m in ("lagrange", "baumgarte")]
    (line,) = across_mechanisms([made.study(rows), made.study(rows, mechanism="other")])
    assert line.error is None and line.time == pytest.approx(1.0)


def test_a_plot_has_one_colour_a_method_and_one_mark_an_integrator():
    rows = [
        made.row(m, h, 1e-15 if h < 1e-3 else 1e-6, 1.0 + h, integrator=i)
        for m in ("lagrange", "baumgarte")
        for i in ("rk4", "heun")
        for h in (1e-3, 5e-4)
    ]
    plot = plot_rows([made.study(rows)], None, ["error"], "run_seconds")
    (ax,) = plot.figure.axes
    drawn = [line for line in ax.get_lines() if len(line.get_xdata())]
    assert len(drawn) == 4 and len({line.get_color() for line in drawn}) == 2
    assert {line.get_marker() for line in drawn} == {"o", "s"}
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert labels == ["lagrange", "baumgarte", "rk4", "heun"]
    assert min(y for line in drawn for y in line.get_ydata()) == pytest.approx(1e-13)  # a tenth of the reference's
