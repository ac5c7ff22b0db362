"""Pages as a browser, or a reader of Markdown, meets them: whole, with all their pictures, and asking for nothing."""

import base64
import re
import subprocess
import sys
from dataclasses import replace
from html.parser import HTMLParser
from xml.etree import ElementTree

import pytest
from markdown_it import MarkdownIt

from study.report.made import row, study, trace
from symgen.base.errors import InputError
from symgen.base.escapes import markdown_text
from symgen.study.report import picture
from symgen.study.report.figures import pictures_of_study
from symgen.study.report.kinds import comparison_report as sections
from symgen.study.report.kinds.comparison_report import comparison_report
from symgen.study.report.write import check_report, html_report, markdown_report, write

VOID = {"meta", "img", "br", "hr", "link", "input"}


class Page(HTMLParser):
    """Collects elements and refuses tags that are not closed in their order."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.open, self.elements, self.text = [], [], []
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text.append(data)

    def all(self, tag):
        """Return the attributes of all elements of a kind."""
        return [attributes for name, attributes in self.elements if name == tag]


STUDIES = [study(), study(mechanism="pendulum")]


@pytest.fixture(scope="module", autouse=True)
def pictures_drawn_once():
    """Pictures take seconds: each is drawn once for studies that differ in their titles alone, which none shows."""
    known = []

    def drawn(study):
        untitled = replace(study, title="")
        found = next((made for other, made in known if other == untitled), None)
        if found is None:
            known.append((untitled, found := pictures_of_study(untitled)))
        return found

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sections, "pictures_of_study", drawn)
        yield


@pytest.fixture(scope="module")
def document():
    """What both kinds of files are written from."""
    return comparison_report(STUDIES, "symgen compare four-bar 'a & b' -o report.html", [("Steps", "1 < 2")])


@pytest.fixture(scope="module")
def text(document):
    return html_report(document)


@pytest.fixture(scope="module")
def page(text):
    return Page(text)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_the_page_asks_for_nothing(text, page):
    assert text.startswith("<!DOCTYPE html>")
    assert not {tag for tag, _ in page.elements} & {
        "script",
        "link",
        "iframe",
        "object",
        "embed",
        "video",
        "base",
        "form",
    }
    for _, attributes in page.elements:
        for name, value in attributes.items():
            assert not name.startswith("on")
            if name in ("src", "href", "srcset", "data", "action", "poster"):
                assert value.startswith(("data:image/svg+xml;base64,", "data:image/png;base64,", "#")), value[:80]
    style = text[text.index("<style>") : text.index("</style>")]
    assert "url(" not in style and "@import" not in style and "&" not in style.replace("&#", "")


@pytest.mark.slow
def test_every_picture_is_whole(page):
    images = page.all("img")
    assert len(images) > 10
    for attributes in images:
        assert len(attributes["alt"]) > 20
        kind, _, data = attributes["src"].partition(",")
        content = base64.b64decode(data, validate=True)
        if "png" in kind:
            assert content.startswith(b"\x89PNG") and content.endswith(b"IEND\xaeB`\x82")
            continue
        root = ElementTree.fromstring(content)
        assert root.tag == "{http://www.w3.org/2000/svg}svg" and "viewBox" in root.attrib
        for element in root.iter():
            for name, value in element.attrib.items():
                if name.endswith("href"):
                    assert value.startswith("#")
        assert b"<script" not in content and b"@import" not in content


@pytest.mark.slow
def test_links_lead_to_parts_of_the_page(page):
    places = [a["id"] for _, a in page.elements if "id" in a]
    assert len(places) == len(set(places))
    targets = [a["href"].removeprefix("#") for a in page.all("a")]
    assert targets == [
        *("side-by-side", "four-bar", "pendulum"),
        *("how-it-is-measured", "compared-with-the-source", "made-with"),
    ]
    assert set(targets) <= set(places)


@pytest.mark.slow
def test_the_page_says_what_it_was_made_with_and_words_are_escaped(text, page):
    whole = " ".join(page.text)
    for words in (
        *('A linkage <with> odd & "quoted" words', "symgen compare four-bar 'a & b' -o report.html", "1 < 2"),
        *("symgen 0.", "Python 3.", "numpy", "numba", "sympy", "core", "0123456789abcdef", "at least 3 rounds"),
        "* below the error of the reference itself",
    ):
        assert words in whole
    assert "<with>" not in text and any(t.strip() == "10⁻¹³ * ^" for t in page.text)


@pytest.mark.slow
def test_every_row_stands_in_the_tables(page):
    whole = "\n".join(page.text)
    for title in ("All rows of four-bar", "All rows of pendulum"):
        part = whole.split(title)[1].split("All rows of")[0]
        assert part.count("step 0.001 s") >= 8 and "failed: the state is no longer finite" in part
    tables = page.all("table")
    assert len(tables) == 3 + 2 * 4 + 2
    assert len([a for a in page.all("div") if a.get("class") == "scroll"]) == len(tables)


@pytest.mark.slow
def test_the_source_stands_beside_ours(page):
    whole = " ".join(page.text)
    assert "second hand: Carvalho 2022" in whole
    rows = [row for row in page.text if row in ("planar four-bar", "Bricard", "slider-crank", "front suspension")]
    assert rows and set(rows) == {"planar four-bar"}  # what was compared, and nothing else
    assert "1.62" in whole and "1.21" in whole
    assert "1.30 ± 0.13" in whole  # direct-correction at 1 ms
    alone = html_report(comparison_report([study(mechanism="pendulum")]))
    assert "Carvalho" not in alone


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_the_same_studies_give_the_same_page(text):
    code = (
        "import sys; sys.path.insert(0, 'tests')\n"
        "from study.report.test_pages import STUDIES, comparison_report, html_report\n"
        "import hashlib\n"
        "made = comparison_report(STUDIES, \"symgen compare four-bar 'a & b' -o report.html\", [('Steps', '1 < 2')])\n"
        "page = html_report(made)\n"
        "print(hashlib.sha256(page.encode()).hexdigest())"
    )
    import hashlib
    from pathlib import Path

    root = Path(__file__).parents[3]
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=root)
    assert done.stdout.strip() == hashlib.sha256(text.encode()).hexdigest()


def test_large_pictures_become_pixels(monkeypatch):
    monkeypatch.setattr(picture, "LARGEST_SVG", 10)
    made = picture.draw_picture("x", "caption", "words", lambda figure: figure.subplots().plot([1, 2]))
    assert made.kind == "png" and made.data.startswith(b"\x89PNG")


def test_lines_of_methods_can_be_told_apart():
    from symgen.derive.methods import METHODS
    from symgen.study.report.comparison_findings import line_number

    looks = [tuple(map(str, picture.line_style(line_number(m)).values())) for m in METHODS.names]
    assert len(set(looks)) == len(looks)
    assert len({(picture.line_style(i)["color"], str(picture.line_style(i)["linestyle"])) for i in range(28)}) == 28


def test_a_variant_has_a_shade_of_its_methods_colour_and_an_integrator_its_marker():
    from symgen.study.report.figures import integrator_markers, looks_of_labels

    rows = [
        row("baumgarte", 1e-3, 1e-6, 0.1),
        row("baumgarte", 1e-3, 1e-6, 0.1, variant="alpha=20"),
        row("baumgarte", 1e-3, 1e-6, 0.1, variant="alpha=50", integrator="heun"),
        row("lagrange", 1e-3, 1e-6, 0.1),
    ]
    made = study(rows)
    found = looks_of_labels(made)
    colours = [found[label]["color"] for label in ("baumgarte", "baumgarte, alpha=20", "baumgarte, alpha=50")]
    assert colours[0] == picture.line_style(1)["color"] and len({*colours, found["lagrange"]["color"]}) == 4
    assert [sum(int(c[i : i + 2], 16) for i in (1, 3, 5)) for c in colours] == sorted(
        sum(int(c[i : i + 2], 16) for i in (1, 3, 5)) for c in colours
    )
    assert len(set(integrator_markers(made).values())) == 2


@pytest.mark.slow
def test_studies_with_nothing_to_draw_still_make_a_page():
    failed = [row("lagrange", 1e-3, None, 0.0, status="failed", reason="no", position_violation_max=float("nan"))]
    for made in (study(failed, traces=(trace(),)), study([], traces=(), interrupted=True)):
        found = Page(html_report(comparison_report([made])))
        assert found.all("h2")
    assert "interrupted" in " ".join(found.text)


# -- Markdown ----------------------------------------------------------------------------------------------------------


def test_markdown_escapes_what_would_be_more_than_text():
    for plain in ("7.3×10⁻¹²", "-0.5 of it", "3.1 and 4)", "a_b", "#x", "2.", "+5"):
        assert markdown_text(plain) == plain.replace("2.", "2\\.")
    for text, expected in (("- a", "\\- a"), ("1. a", "1\\. a"), ("# a", "\\# a"), ("a*b", "a\\*b"), ("---", "\\---")):
        assert markdown_text(text) == expected


def test_markdown_says_the_same_with_pictures_beside_it(document, tmp_path):
    write(document, tmp_path / "report.md")
    content = (tmp_path / "report.md").read_text(encoding="utf-8")
    tokens = MarkdownIt("commonmark").enable("table").parse(content)
    images = [child for token in tokens if token.children for child in token.children if child.type == "image"]
    assert len(images) == len(document.pictures())
    files = {i.attrs["src"] for i in images}
    assert len(files) == len(images)
    for name in files:
        assert (tmp_path / name).stat().st_size > 1000
    assert len(list((tmp_path / "report-files").iterdir())) == len(files)
    assert sum(token.type == "table_open" for token in tokens) == len(Page(html_report(document)).all("table")) + 1
    cells = re.findall(r"^\|.*\|$", content, re.MULTILINE)
    assert cells and all(line.count("|") - line.count("\\|") >= 3 for line in cells)
    assert "\\|Φ\\|" in content  # bars within a cell


@pytest.mark.slow_cases("- no list")
@pytest.mark.parametrize(
    "title",
    [
        "<script>alert(1)</script> and <b>bold</b>",
        "[a link](https://example.org) and ![a picture](x.png), [another][x]",
        "`code`, *stress*, _stress_, __strong__, a_name_ and 2*3*4 &amp; &#33;",
        "# no heading",
        "- no list",
        "1. no list",
        "> no quotation, a | b, \\ and ~~gone~~",
    ],
)
def test_a_title_is_text_in_every_page(title):
    document = comparison_report([study(title=title)])
    shown = title.rstrip(".") + "."
    tokens = MarkdownIt("commonmark").enable(["table", "strikethrough"]).parse(markdown_report(document, "x"))
    inline = [token for token in tokens if token.type == "inline"]
    assert [t.children for t in inline if "".join(c.content for c in t.children) == shown] != []
    plain = next(t for t in inline if "".join(c.content for c in t.children) == shown)
    assert {child.type for child in plain.children} == {"text"}
    assert not [token for token in tokens if token.type in ("html_block", "blockquote_open", "ordered_list_open")]
    found = Page(html_report(document))
    assert shown in "".join(found.text) and not found.all("script")


def test_a_command_stays_in_its_fence():
    text = markdown_report(comparison_report([study()], "symgen compare '```\n# x'"), "x")
    tokens = MarkdownIt("commonmark").parse(text)
    assert [t.content for t in tokens if t.type == "fence"] == ["symgen compare '```\n# x'\n"]


# -- what is wrong -----------------------------------------------------------------------------------------------------


def test_files_that_cannot_be_written_are_refused(tmp_path):
    for name, sentence in (
        ("report.doc", "a file ending in .html, .md, .pdf"),
        ("report", "a file ending in .html, .md"),
        ("nowhere/report.html", "a file in a folder that exists"),
    ):
        with pytest.raises(InputError) as caught:
            check_report("--output", tmp_path / name)
        assert sentence in str(caught.value)
    (tmp_path / "report-files").write_text("in the way")
    with pytest.raises(InputError, match="to be a folder"):
        check_report("--output", tmp_path / "report.md")


def test_without_matplotlib_the_sentence_says_what_to_install(tmp_path, monkeypatch):
    from symgen.base import files

    monkeypatch.setattr(files, "find_spec", lambda name: None)
    with pytest.raises(InputError, match=r"pip install 'symgen\[plot\]'"):
        check_report("--output", tmp_path / "report.html")
