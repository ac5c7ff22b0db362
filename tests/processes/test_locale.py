"""What commands write for readers in a locale, and that data files are the same bytes in each."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

EXPECTED = {"de": r"\d\d\.\d\d\.\d{4}", "fr": r"\d\d/\d\d/\d{4}"}


def symgen(folder: Path, *words: str, code: int = 0) -> str:
    """Return standard output of a command, or standard error where it fails."""
    command = [sys.executable, "-m", "symgen", *words]
    ran = subprocess.run(command, cwd=folder, capture_output=True, text=True, encoding="utf-8", timeout=300)
    assert ran.returncode == code, ran.stderr
    return ran.stdout if code == 0 else ran.stderr


@pytest.mark.slow
@pytest.mark.parametrize("locale", ["de", "fr"])
def test_reports_tables_plots_and_pages_follow_a_locale_and_data_does_not(locale: str, tmp_path: Path) -> None:
    run = ("run", "slider-crank", "--until", "1")
    written = ("--save", "{}.csv", "--plot", "{}.svg")
    plain = symgen(tmp_path, *run, *(word.format("plain") for word in written))
    own = symgen(tmp_path, *run, "--locale", locale, *(word.format("own") for word in written))
    assert re.search(r"O\.angle +0\.785398", plain) and re.search(r"O\.angle +0,785398", own)
    assert not re.search(r"\b\d+\.\d", re.sub(r"\w+\.csv|\w+\.svg", "", own)), own
    assert (tmp_path / "own.csv").read_bytes() == (tmp_path / "plain.csv").read_bytes()
    assert (tmp_path / "own.svg").read_bytes() != (tmp_path / "plain.svg").read_bytes()
    as_json = [json.loads(symgen(tmp_path, *run, "--json", *more)) for more in ((), ("--locale", locale))]
    for each in as_json:
        del each["seconds"]
    assert as_json[0] == as_json[1]

    page = ("--locale", locale, "-o", "report.html", "--page", "page.html")
    symgen(tmp_path, "report", "slider-crank", "--until", "1", *page)
    report = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert re.search(EXPECTED[locale], report) and f"--locale {locale}" in report
    cells = re.findall(r"<td[^>]*>([^<]*)</td>", report)
    assert any(re.fullmatch(r"0,89|at 0,89 s", cell) for cell in cells), cells
    assert not any(re.fullmatch(r"[-−]?\d+\.\d+", cell) for cell in cells)
    assert '"locale":{"decimal":","' in (tmp_path / "page.html").read_text(encoding="utf-8").replace(" ", "")


def test_a_locale_that_is_none_is_bad_input(tmp_path: Path) -> None:
    said = symgen(tmp_path, "run", "four-bar", "--locale", "klingon", code=2)
    assert said == "symgen: --locale: expected a locale, such as de, fr or de_CH, got 'klingon'\n"
