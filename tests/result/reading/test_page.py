"""Pages of derived equations: what stands in them, links that lead somewhere, text from files as text."""

import re
from html.parser import HTMLParser

import pytest

import symgen
from symgen.cli import main
from symgen.compile.native.compiler import is_interpreted
from symgen.derive.formulate.formulate import formulate
from symgen.derive.lower.model import lower_model
from symgen.describe.files.load import load_mechanism
from symgen.result.reading import page as pages
from symgen.result.reading.html import pattern_of_factor, prose_html

#: Elements without an end.
VOID = {"meta", "link"}


class Reader(HTMLParser):
    """Checks nesting, and gathers ids and links."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.open, self.ids, self.links, self.tags = [], [], [], []
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        self.tags.append((tag, given))
        if "id" in given:
            self.ids.append(given["id"])
        if tag == "a":
            self.links.append(given["href"])
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, (tag, self.getpos())


def page_of(name, tmp_path, *arguments):
    path = tmp_path / "page.html"
    assert main(["inspect", str(name), "-o", str(path), *arguments]) == 0
    text = path.read_text(encoding="utf-8")
    return text, Reader(text)


@pytest.fixture(scope="module")
def four_bar(tmp_path_factory):
    return page_of("four-bar", tmp_path_factory.mktemp("page"))


def test_a_page_is_whole_and_its_links_lead_somewhere(four_bar):
    text, found = four_bar
    assert len(set(found.ids)) == len(found.ids)
    assert {link[1:] for link in found.links} <= set(found.ids)
    assert "default-src 'none'" in text
    outside = [v for _, given in found.tags for k, v in given.items() if k in ("src", "href") and not v.startswith("#")]
    assert outside == ["data:,"]


def test_a_joint_leads_to_its_rows_its_lines_in_the_file_and_its_emitted_lines(four_bar):
    text, _ = four_bar
    part = text[text.index('id="rows-B"') : text.index('id="rows-C"')]
    file_line = int(re.search(r'href="#file-(\d+)"', part)[1])
    assert re.search(rf'<span id="file-{file_line}">\[joints\.B\]', text)
    line = re.search(r'href="#line-(\d+)">crank\.omega: <code>(w\[\d+\] = \w+)</code>', part)
    assert f'<span id="line-{line[1]}">    {line[2]}  <a href="#row-B.x"># B.x: crank.omega</a></span>' in text


def test_everything_that_was_promised_is_there(four_bar):
    text, found = four_bar
    for ident in ("sketch", "topology", "coordinates", "rows", "patterns", "motion", "law", "operations", "left-out"):
        assert ident in found.ids
    assert text.count("<svg") >= 3  # the sketch and two patterns
    assert '<mtable class="tall">' in text and "the mechanism is planar" in text
    assert "gyroscopic terms" in text


def test_the_equations_of_motion_come_first_and_are_typeset(four_bar):
    text, _ = four_bar
    assert text.index("<math>") < text.index('id="sketch"') < text.index('id="topology"')
    assert "D G D<sup>T</sup>" in text and "D G D^T in" not in text.partition('<section id="file">')[0]


def test_powers_and_backticks_of_sentences_are_typeset():
    shown = prose_html("`direct` solves M^-1 D^T and D^+ where ``a < b``, with x^2 in [m/s^2]")
    assert shown == (
        "<code>direct</code> solves M<sup>−1</sup> D<sup>T</sup> and D<sup>+</sup> where <code>a &lt; b</code>, "
        "with x<sup>2</sup> in [m/s<sup>2</sup>]"
    )


def test_a_tree_without_rows_shows_no_multipliers(tmp_path, capsys):
    """A pendulum on a pin in joint coordinates: M v' = f is all there is, on the page, as LaTeX and as text."""
    path = tmp_path / "rod.toml"
    path.write_text(
        '[mechanism]\nname = "rod"\ngravity = [0, -9.81]\n[bodies.a]\nmass = 2.0\ninertia = 1.0\n[joints.j]\n'
        'type = "revolute"\nbetween = ["ground", "a"]\nat = [[0, 0], [0.5, 0]]\n'
    )
    text, _ = page_of(path, tmp_path, "--coordinates", "joint")
    equations = text[text.index('id="motion"') : text.index('id="operations"')]
    assert "There are no constraint rows" in equations and "\u03bb" not in equations
    assert "1 coordinate, 1 velocity, 0 constraint rows" in text
    e = symgen.load(path).equations_in("joint")
    assert r"M \dot v = f" in e._repr_latex_() and "lambda" not in e._repr_latex_()
    assert "1 coordinate, 1 velocity, 0 constraint rows" in e._repr_html_()
    for options in ((), ("--format", "latex", "--document")):
        capsys.readouterr()
        assert main(["inspect", str(path), "--coordinates", "joint", *options]) == 0
        assert "lambda" not in capsys.readouterr().out


def test_joint_coordinates_have_their_tree(tmp_path):
    text, _ = page_of("four-bar", tmp_path, "--coordinates", "joint")
    assert "the tree; loops are closed by" in text
    assert "It carries a body in the tree: it has no rows." in text


def test_drivers_without_rows_are_said(tmp_path):
    text, _ = page_of("driven-four-bar", tmp_path, "--coordinates", "joint")
    assert "It prescribes A.angle = crank_start + crank_speed*t: it has no rows." in text
    assert "that of drivers without rows" in text


def test_text_of_a_file_is_text(tmp_path):
    path = tmp_path / "evil.toml"
    path.write_text(
        '[mechanism]\nname = "evil"\ntitle = "</title><script>alert(1)</script>"\ngravity = [0, -9.81]\n'
        '# </pre><img src=x onerror="alert(2)">\n'
        '[parameters]\nm = { value = 1.0, note = "<b>kg</b>" }\n'
        '[bodies.a]\nmass = "m"\ninertia = 1.0\n[joints.j]\ntype = "revolute"\nbetween = ["ground", "a"]\n'
        "at = [[0, 0], [0.5, 0]]\n"
    )
    text, found = page_of(path, tmp_path)
    assert "<script>alert" not in text and "<img" not in text and "<b>kg" not in text
    assert [tag for tag, _ in found.tags].count("script") == 2


def test_text_that_turns_around_is_seen(tmp_path):
    """In the listing as in headings: what follows U+202E would be shown from right to left."""
    path = tmp_path / "turned.toml"
    path.write_text(
        '# note \u202e here\n[mechanism]\nname = "turned"\ntitle = "a\u202eb"\ngravity = [0, -9.81]\n'
        '[parameters]\nm = { value = 1.0, note = "c\u202ed" }\n'
        '[bodies.a]\nmass = "m"\ninertia = 1.0\n[joints.j]\ntype = "revolute"\nbetween = ["ground", "a"]\n'
        "at = [[0, 0], [0.5, 0]]\n",
        encoding="utf-8",
    )
    text, _ = page_of(path, tmp_path)
    assert "\u202e" not in text and text.count("\\u202e") >= 4


def test_dots_stand_clear_of_their_letters(four_bar):
    """An accent is laid on the letter by fonts without data for mathematics."""
    text, _ = four_bar
    assert "<mover>" in text and "accent" not in text


def test_a_page_that_would_be_too_large_leaves_out_the_code(tmp_path, monkeypatch):
    monkeypatch.setattr(pages, "LARGEST", 50_000)
    text, found = page_of("four-bar", tmp_path)
    assert "is left out, as the page would be larger than 50000 bytes" in text
    assert {link[1:] for link in found.links} <= set(found.ids)


def test_the_listing_makes_room_for_the_right_hand_side(four_bar, tmp_path, monkeypatch):
    text, _ = four_bar
    if is_interpreted():  # there is no machine code to list, and the page says so
        assert "Python, by NUMBA_DISABLE_JIT." in text and "const rates = null;" in text
        return
    script = re.search(r"const rates = (\(\(\) => \{.*?\}\)\(\));", text, re.DOTALL)[1]
    assert "function rhs(" in script and "function confirm(" in script and "module model, " in text
    monkeypatch.setattr(pages, "LARGEST", len(text.encode()) - 1)
    smaller, found = page_of("four-bar", tmp_path)
    assert (
        "function rhs(" in smaller and "module model, " in smaller and "Modules of the method are left out" in smaller
    )
    assert {link[1:] for link in found.links} <= set(found.ids)


def test_a_page_without_a_right_hand_side_says_why(tmp_path):
    text, _ = page_of("pendulum", tmp_path, "--shape", "looped")
    assert "const rates = null;" in text
    assert "offers no right-hand side to scripts: the code of a run is looped." in text


def test_a_page_that_is_too_large_without_its_code_is_refused(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(pages, "LARGEST", 5_000)
    assert main(["inspect", "four-bar", "-o", str(tmp_path / "page.html")]) == 2
    assert "at most 5000 bytes" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_a_mechanism_that_nobody_could_read_is_refused_before_it_is_derived(tmp_path, capsys):
    path = tmp_path / "page.html"
    assert main(["inspect", "n-four-bar:400", "-o", str(path)]) == 2
    assert "at most 1500 constraint rows and velocities for a page" in capsys.readouterr().err
    assert not path.exists()


def test_a_mechanism_that_does_not_close_is_drawn_as_described(tmp_path):
    path = tmp_path / "open.toml"
    path.write_text(
        '[mechanism]\nname = "open"\ngravity = [0, -9.81]\n'
        "[bodies.a]\nmass = 1.0\ninertia = 1.0\npoints = { P = [0.5, 0.0], Q = [-0.5, 0.0] }\n"
        '[joints.j]\ntype = "revolute"\nbetween = ["ground", "a"]\nat = [[0, 0], "P"]\n'
        '[joints.k]\ntype = "revolute"\nbetween = ["ground", "a"]\nat = [[9, 0], "Q"]\n'
    )
    text, _ = page_of(path, tmp_path)
    assert "It does not close, and is drawn as described" in text


@pytest.mark.slow_cases("chain:10")
@pytest.mark.parametrize("name", ["four-bar", "andrews", "n-four-bar:3", "bricard", "chain:10"])
def test_the_factor_that_is_drawn_is_the_one_that_is_compiled(name):
    equations = formulate(load_mechanism(name))
    program = lower_model(equations, "")
    entries = pattern_of_factor(equations, program.order)
    assert sum(kind == "f" for kind in entries.values()) == program.fill
    if program.plan.schur:  # others keep no factor
        assert len(entries) - equations.m == program.layout.sections["lower"][1]
    else:
        assert set(program.order[: len(program.plan.rows)]) == program.plan.rows
    assert program.plan.schur == (name == "chain:10")
