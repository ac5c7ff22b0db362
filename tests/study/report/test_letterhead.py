"""Paper of a workshop: its size, a mark, a number, and the page that is signed, in every format."""

import base64
import re
from itertools import pairwise

import pytest

import symgen
from symgen.study.report.document import Letterhead, Picture, ReportDocument, Section, TableCell
from symgen.study.report.plain_pdf import plain_pdf
from symgen.study.report.write import html_report, markdown_report, write

#: One black pixel.
PIXEL = base64.b64decode("iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNgAAAAAgABSK+kcQAAAABJRU5ErkJggg==")
DRAWN = b'<?xml version="1.0"?><svg xmlns="http://www.w3.org/2000/svg" width="8" height="8"></svg>'
WHO = ("Supplier", "Customer")


def document(**keys):
    verdict, origin = TableCell("It holds.", "good"), (("report", 'R-104 "}<b>'), ("date", "2026-01-01"))
    head = Letterhead("R-104", **keys)
    return ReportDocument("Press", (), (), "", (Section("One"),), "", verdict, origin, head)


@pytest.mark.parametrize(("paper", "points"), [("a4", "595.4\\d* 841.6\\d*"), ("letter", "612 792")])
def test_paper_has_its_size(paper, points):
    page = html_report(document(paper=paper))
    assert f"size: {paper};" in page
    assert re.search(rb"/MediaBox \[ 0 0 " + points.encode() + rb" \]", plain_pdf(document(paper=paper)))


def test_the_foot_of_a_page_cannot_end_its_style():
    """Every sign of a name stands as its number, so that none ends the text or the sheet."""
    style = html_report(document())
    foot = re.search(r'@bottom-left \{ content: "([^"]*)"', style).group(1)
    assert "R\\00002d104 \\000022\\00007d\\00003cb\\00003e" in foot


@pytest.mark.parametrize(("kind", "data"), [("png", PIXEL), ("svg", DRAWN)])
def test_a_logo_is_inside_of_the_page(kind, data, tmp_path):
    logo = Picture("logo", "", "", data, kind)
    assert base64.b64encode(data).decode() in html_report(document(logo=logo))
    write(document(logo=logo), tmp_path / "a.md")
    assert (tmp_path / f"a-files/logo.{kind}").read_bytes() == data
    assert f"![logo](a-files/logo.{kind})" in (tmp_path / "a.md").read_text()
    images = len(re.findall(rb"/Subtype /Image\b", plain_pdf(document(logo=logo))))
    assert (images > 0) == (kind == "png")


def test_the_page_that_is_signed_is_last_and_says_what_is_accepted():
    page = html_report(document(signatures=WHO))
    signed = page[page.index('<section id="acceptance" class="sheet">') :]
    assert page.index('id="made-with"') < page.index('id="acceptance"')
    assert "It holds." in signed and all(f'scope="row">{who}</th>' in signed for who in WHO)
    assert "| Customer |  |  |  |" in markdown_report(document(signatures=WHO), "files")
    pages = [len(re.findall(rb"/Type /Page\b", plain_pdf(document(signatures=x)))) for x in ((), WHO)]
    assert pages == [1, 2]
    assert "acceptance" not in html_report(document())


@pytest.mark.slow
def test_the_command_takes_them(cli, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "logo.png").write_bytes(PIXEL)
    options = ("--paper", "Letter", "--number", "R-104", "--logo", "logo.png", "--sign", "Customer")
    code, out, _ = cli("report", "pendulum", "--until", "0.1", "-o", "a.html", *options)
    assert code == 0 and out.strip() == "written: a.html"
    page = (tmp_path / "a.html").read_text(encoding="utf-8")
    assert "size: letter;" in page and "report R-104" in page and 'id="acceptance"' in page


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("command", "option"),
    [
        ("compare pendulum --methods lagrange --integrators rk4 --steps 1e-2 --until 0.1", "-o"),
        ("stress pendulum --cases gravity --methods lagrange --quick --jobs 1", "-o"),
        ("design pendulum --vary bob_mass=0.5:2 --aim max(bob.y) --until 0.1", "--report"),
    ],
)
def test_reports_of_studies_have_a_size_of_paper(command, option, cli, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, _, err = cli(*command.split(), "--paper", "Letter", option, "a.html")
    assert code == 0, err
    page = (tmp_path / "a.html").read_text(encoding="utf-8")
    assert "size: letter;" in page and "--paper Letter" in page  # in the command that makes it again
    for words, complaint in {
        ("--paper", "a5", option, "b.html"): "--paper: expected one of a4, letter, got 'a5'; known: a4, letter",
        ("--paper", "letter"): f"--paper: expected {OPTIONS[option]} FILE, the report that is printed, "
        f"got no {OPTIONS[option]}",
    }.items():
        code, out, err = cli(*command.split(), *words)
        assert code == 2 and out == "" and err.strip() == f"symgen: {complaint}"
    assert not (tmp_path / "b.html").exists()


OPTIONS = {"-o": "--output", "--report": "--report"}
REFUSED = {
    "--paper a5": "--paper: expected one of a4, letter, got 'a5'; known: a4, letter",
    "--logo none.png": "--logo: expected a picture that is PNG or SVG, got 'none.png' (no such file or folder)",
    "--logo text.png": "--logo: expected a picture that is PNG or SVG, got 'text.png', which is neither",
    "--logo large.png": "--logo: expected a file of at most 500 kB, got 600 kB",
}


@pytest.mark.parametrize("options", REFUSED)
def test_what_is_no_paper_or_logo_is_refused_before_the_run(options, cli, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "text.png").write_text("text")
    (tmp_path / "large.png").write_bytes(PIXEL + bytes(600_000))
    code, out, err = cli("report", "pendulum", "-o", "a.html", *options.split())
    assert code == 2 and out == "" and err.strip() == f"symgen: {REFUSED[options]}"
    assert not (tmp_path / "a.html").exists()


def test_grey_paper_tells_lines_apart():
    """No two of the first forty lines of a panel share colour and dashes; each has its name at its end."""
    from symgen.result.plots import figure_over_column, line_style_of

    looks = [(look["color"], str(look["linestyle"])) for look in map(line_style_of, range(40))]
    assert len({*looks}) == 40 and len({dash for _, dash in looks[:5]}) == 5
    result = symgen.load("driven-four-bar").simulate(until=0.2, output_step=0.01)
    table = result.select(["A.F", "B.F", "C.F"])
    (axes,) = figure_over_column(result.along("t"), table, "").axes
    heights = {text.get_text(): text.get_position()[1] for text in axes.texts}
    ends = {name: result[name][-1] for name in table.names}
    assert axes.get_legend() is None
    assert sorted(heights, key=heights.get) == sorted(ends, key=ends.get)
    samples = [line for line in axes.get_lines() if line.get_clip_on() is False]
    assert len(samples) == 2 * len(ends)  # a connection and a sample for each
    dashes = {str(line._unscaled_dash_pattern) for line in axes.get_lines() if line not in samples}
    assert {str(line._unscaled_dash_pattern) for line in samples[1::2]} == dashes and len(dashes) == len(ends)
    steps = sorted(heights.values())
    assert all(high - low >= 0.074 for low, high in pairwise(steps))
