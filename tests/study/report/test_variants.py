"""One report of several variants: numbers, limits and verdicts are those of each run alone."""

import pytest
from analyses.rods import of_raw

from study.report.test_curves import labels, lift
from symgen.study.report.variants_report import variants_report
from symgen.study.report.write import html_report

MASSES = (100.0, 250.0, 400.0)


@pytest.mark.slow
def test_variants_stand_side_by_side() -> None:
    """A lift takes its load times 9.81 + 0.2 m/s2; 3 kN are allowed."""
    model = of_raw(lift(largest=3000.0))
    results = [model.simulate(output_step=0.05, parameters={"load": mass}) for mass in MASSES]
    document = variants_report(model, results, "load", "symgen report lift.toml --vary load=100,250,400")
    sections = {section.title: section for section in document.sections}
    (numbers,) = sections["Numbers side by side"].tables
    assert numbers.headings == ("largest", "load = 100 kg", "load = 250 kg", "load = 400 kg")
    rows = {row[0]: row[1:] for row in numbers.rows}
    assert rows["ram, force"] == ("1 kN", "2.5 kN", "4 kN")
    (limits,) = sections["Limits"].tables
    assert [(cell.text, cell.mood) for cell in limits.rows[0][2:]] == [
        *(("1 kN", "good"), ("2.5 kN", "good"), ("4 kN, exceeded", "bad"))
    ]
    (verdicts,) = sections["Verdicts"].tables
    assert [row[1].mood for row in verdicts.rows] == ["good", "good", "bad"]
    assert document.verdict is not None and document.verdict.mood == "bad"
    assert document.verdict.text == "2 of 3 variants do what was asked; load = 400 kg is not as asked."
    curves = {picture.caption: labels(picture) for picture in sections["Curves"].pictures}
    assert {*curves} == {"pull over t", "rail.displacement over t"}  # what the ram exerts is the pull
    assert "pull [kN]" in curves["pull over t"] and {"100 kg", "250 kg", "400 kg"} <= {*curves["pull over t"]}
    assert "--vary load=100,250,400" in html_report(document)


@pytest.mark.slow
def test_the_command_varies_in_the_unit_of_the_file(cli, tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    code, out, _ = cli("report", "pendulum", "--until", "0.2", "--vary", "bob_mass=1,2 kg", "-o", "a.md")
    text = (tmp_path / "a.md").read_text()
    assert code == 0 and "written: a.md" in out
    assert "bob_mass = 1 kg" in text and "bob_mass = 2 kg" in text and "2 variants do what was asked" in text


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ("mass", "--vary: expected NAME=VALUE,VALUE, got 'mass'"),
        ("mass=1", "--vary: expected two to 8 different values with commas between them, got '1'"),
        ("mass=1,1", "--vary: expected two to 8 different values with commas between them, got '1,1'"),
        ("mass=1,x", "--vary mass: expected a finite number, got 'x'"),
        ("bob_mass=1,2 s", "kg"),
        ("bob_mas=1,2", "did you mean 'bob_mass'?"),
    ],
)
def test_what_cannot_vary_is_said_in_one_sentence(cli, tmp_path, monkeypatch, words: str, sentence: str) -> None:
    monkeypatch.chdir(tmp_path)
    code, _, err = cli("report", "pendulum", "--vary", words, "-o", "a.md")
    assert code == 2 and sentence in err and len(err.strip().splitlines()) == 1
    assert not [*tmp_path.iterdir()]
