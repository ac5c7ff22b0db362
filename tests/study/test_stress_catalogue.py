"""What a study over many models says: sums over models instead of sentences about each."""

from dataclasses import replace

import pytest

from study.report.made import stress_row
from symgen.study.report import stress_figures
from symgen.study.report.kinds import stress_report as report
from symgen.study.report.kinds.stress_report import FEW_MODELS
from symgen.study.stress.findings import cause_of_failure, findings_of_study
from symgen.study.stress.stress_rows import LargestSteps, Stress, outcomes_of_models, shares_of_models

MODELS = tuple(f"model-{i}" for i in range(FEW_MODELS + 1))


def row(model, method, outcome, error=1e-6, **changes):
    return stress_row(model, method, outcome, error, **changes)


def penalty(model, factor, outcome):
    return row(model, "penalty", outcome, family="penalty-factor", case=f"a = {factor:g}", values=(factor,))


def gains(model, alpha, outcome):
    plane = {"family": "alpha-beta", "values": (alpha, alpha), "watched": False}
    return row(model, "baumgarte", outcome, **plane)


ROWS = (
    row("-", "lagrange", "ok"),
    *(row(model, "lagrange", "ok") for model in MODELS),
    row(MODELS[0], "auto", "ok", integrator="auto", step=None),
    row(MODELS[1], "direct-correction", "inaccurate", 0.5, status="failed"),
    row(MODELS[1], "direct-correction", "unjudged", None, case="2", status="not run"),
    *(penalty(model, 1e8, "ok") for model in MODELS),
    *(penalty(model, 1e2, "inaccurate") for model in MODELS),
    *(gains(model, alpha, outcome) for model in MODELS[:2] for alpha, outcome in ((2e3, "ok"), (3e3, "diverged"))),
    gains(MODELS[2], 1e3, "ok"),
    gains(MODELS[2], 2e3, "diverged"),
)
LIMITS = tuple(
    LargestSteps(model, "damping", "1e4 N s/m", method, "rk4", step, step, 1.0)
    for model, first, second in (("model-0", 0.1, 0.2), ("model-1", 0.3, 0.2), ("model-2", 0.3, 0.2))
    for method, step in (("lagrange", first), ("penalty", second))
)
STUDY = Stress(MODELS, ROWS, LIMITS, (), ())


def test_outcomes_are_counted_by_model():
    found = dict(outcomes_of_models(ROWS))
    assert list(found) == ["-", *MODELS]
    assert found["-"]["ok"] == 1 and found["model-1"]["unjudged"] == 1
    assert sum(sum(n.values()) for n in found.values()) == len(ROWS)
    # planes are left out, and what could not be judged
    assert ("model-1", 2, 4) in shares_of_models(ROWS) and "-" not in [m for m, _, _ in shares_of_models(ROWS)]


def test_findings_sum_up_many_models():
    for sentence in (
        "Most accurate cells among models: model-0 (3 of 4); fewest: model-1 (2 of 4).",
        "Penalty of penalty with rk4: accurate most often with a = 1e+08, in all cells.",
        "Baumgarte's gains on 3 models: with real roots the first cell that is not accurate has |root| h = 2 to 3; "
        "rk4 is stable up to 2.785.",
        "Largest stable steps in damping, of 3 cases: lagrange with rk4 in 2 and penalty with rk4 in 1.",
    ):
        assert sentence in findings_of_study(STUDY)
    assert "hardest: 1 on model-1, 1 ok and 1 inaccurate." in " ".join(findings_of_study(STUDY))


def test_cases_without_a_reference_are_named_with_their_model():
    unusable = (("model-2", "duration", "20 s", "too long"),)
    text = " ".join(findings_of_study(replace(STUDY, unusable=unusable)))
    assert "1 case could not be judged for want of a reference: duration 20 s on model-2." in text


def test_of_ties_the_first_is_one_of_several():
    """Counted by hand: two models go best, two cases are hardest, two pairs share the largest step."""
    rows = (
        *(row(model, "lagrange", "ok", case=case) for model in MODELS[:2] for case in ("1", "2")),
        *(row(model, "lagrange", "diverged", case=case) for model in MODELS[2:] for case in ("1", "2")),
        *(penalty(model, a, "ok" if i else "diverged") for i, model in enumerate(MODELS[:2]) for a in (1e2, 1e4)),
    )
    limits = tuple(
        LargestSteps("model-0", "damping", "1e4 N s/m", method, "rk4", step, step, 1.0)
        for method, step in (("lagrange", 0.1), ("ggl", 0.3), ("penalty", 0.3), ("null-space", 0.1), ("x", None))
    )
    text = " ".join(findings_of_study(replace(STUDY, rows=rows, limits=limits)))
    assert "among models: model-1 (4 of 4); fewest: model-2 and 1 other (0 of 2)." in text
    assert "hardest: 1 on model-2 and 3 others, 1 diverged." in text
    assert "the factor makes no difference from 100 to 10000, in 1 of 2 cells." in text
    assert "Largest stable steps in damping, of 1 case: ggl with rk4 in 1 and penalty with rk4 in 1." in text
    same = tuple(row(model, "lagrange", "ok") for model in MODELS)
    assert "among models: model-0 and 3 others (1 of 1)." in " ".join(findings_of_study(replace(STUDY, rows=same)))


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"family": "length-ratio", "values": (1e4,), "error": 8e-3, "step": None}, "little on links of 10000 m"),
        ({"family": "length-ratio", "values": (1e2,), "error": 8e-3}, "constant step"),
        ({"family": "length-ratio", "values": (1e2,), "error": None, "step": None}, "add up"),
        ({"family": "singular-passage", "step": None}, "near a singular position"),
        ({"family": "duration", "step": None}, "add up"),
        ({"family": "duration", "position_violation_max": 2e-3}, "angles of many turns"),
    ],
)
def test_causes_are_told_from_the_rows(changes, words):
    assert words in cause_of_failure(replace(row("-", "null-space", "inaccurate"), **changes))


@pytest.mark.slow
def test_the_report_shows_all_models_at_once(monkeypatch):
    monkeypatch.setattr(report, "region_pictures", lambda study: ())
    document = report.stress_report(STUDY)
    section = next(s for s in document.sections if s.title == "Map of methods and cases")
    assert section.pictures[0].name == "overview" and section.pictures[0].data.startswith(b"<svg")
    first = section.tables[0]
    assert [r[0] for r in first.rows] == ["mechanisms of families", *MODELS]
    assert sum(int(str(r[1])) for r in first.rows) == len(ROWS)


def test_a_map_has_no_columns_for_a_single_pair():
    """They would be empty but for one field; a study of that pair alone has them."""
    shared = [row("model-0", name, "ok", family="gravity") for name in ("lagrange", "penalty")]
    single = [row("model-0", "baumgarte", "ok", family="gain", values=(x,), case=f"{x}") for x in (0.1, 1.0)]
    assert stress_figures._rows_of_many_pairs([*shared, *single]) == shared
    assert stress_figures._rows_of_many_pairs(single) == single


def test_too_many_cells_are_not_listed(monkeypatch):
    monkeypatch.setattr(report, "region_pictures", lambda study: ())
    monkeypatch.setattr(report, "outcome_maps", lambda study: ())
    monkeypatch.setattr(report, "MOST_CELLS", len(ROWS) - 1)
    section = report.stress_report(STUDY).sections[-1]
    assert section.title == "All cells" and not section.parts and "--csv" in section.text[0]


def test_pairs_left_out_are_in_the_report(monkeypatch):
    monkeypatch.setattr(report, "region_pictures", lambda study: ())
    monkeypatch.setattr(report, "outcome_maps", lambda study: ())
    out = (("model-0", "ggl", "radau5", "too long"),)
    document = report.stress_report(replace(STUDY, left_out=out))
    section = next(s for s in document.sections if s.title == "What is not judged")
    assert section.tables[0].rows == out
