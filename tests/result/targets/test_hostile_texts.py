"""Texts of a file in everything that symgen writes: each target is parsed, compiled and loaded, and is as with others.

The two mechanisms differ in their texts alone. Code of both is the same without comments, so nothing of a text runs
or is declared; pages, pictures and descriptions have the same elements.
"""

import ast
import csv
import ctypes
import json
import re
import shutil
import subprocess
import sys
import zipfile
from collections import Counter
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree

import fmpy
import pytest
import xarray as xr
from support.emitted import mechanism_of
from support.rotation import of_turn

from symgen.base.errors import InputError
from symgen.base.escapes import comment_text
from symgen.cli import main
from symgen.study.report.kinds.comparison_report import comparison_report
from symgen.study.report.write import html_report, markdown_report
from tests.study.report.made import row, study, trace

#: A way out of each kind of place.
WAYS = (
    *("*/};__attribute__((constructor))enum{/*", "*/}static id(){system(__func__);}enum{/*", "*\\};int planted;/*"),
    *("*??/", "// planted() ??/", "\\", '"""', "'''", '"', "'", "${planted()}", "{{ 7*7 }}{% for %}", "`planted()`"),
    *("]]>", "--><planted/>", "<!--DATA-->", "</script><script>planted()</script>", "</title><planted>", "&lt;"),
    *("<img src=x onerror=planted()>", '" onload="planted()', "%\\end{document}", "\\input{planted}", "$x^2$", "~^_#&"),
    *("=cmd()", "+1", "@planted", "%s%n", "[x](javascript:planted())", "[x [y] ](planted:)", "|a|b|", "m" * 40),
)
#: Line ends, control characters, those that turn text around, and what terminals act on.
LINES = (
    "a\nplanted()",
    "a\r\nplanted()",
    "a\u2028planted()\u2029",
    "a\x00b\x07",
    "\x1b]0;planted\x07\x1b[31m",
    "a\u202eb",
)
TEXTS = (*WAYS, *LINES)
#: Entries of sections, and the mechanism.
OWN_NAMES = ("rod", "pin", "height", "push", "low", "swing")
#: As titles and sources: each alone is short, and comments have at most 200 characters.
TITLES = ["", *(" ".join(TEXTS[i : i + 5]) for i in range(0, len(TEXTS), 5)), *LINES]
#: Chosen for the fast run: comments of C, pages, LaTeX.
FEW = (TITLES[1], TITLES[4], TITLES[5])
FILE = """
[mechanism]
name = "swing"
gravity = [0.0, "-g"]
title = {title}
source = {title}
[run]
until = 0.02
step = 1e-3
[parameters]
g = 9.81
{parameters}
[inputs]
{inputs}
[bodies.rod]
mass = {mass}
inertia = 0.5
points = {{ top = [-0.5, 0.0] }}
[joints.pin]
type = "revolute"
between = ["ground", "rod"]
at = [[0.0, 0.0], "top"]
[forces.push]
type = "torque"
body = "rod"
torque = {torque}
[outputs.height]
value = "p0*rod.y"
[events.low]
when = "rod.y < -0.4"
action = "stop"
"""


def described(folder: Path, title: str, notes: tuple[str, ...]) -> Path:
    """Write a file with parameters and inputs that have these notes."""
    folder.mkdir()
    quoted = [json.dumps(note) for note in notes]
    parameters = [f'p{i} = {{ value = 1.0, unit = "m", note = {note} }}' for i, note in enumerate(quoted)]
    inputs = [f'u{i} = {{ default = 0.0, unit = "m", note = {note} }}' for i, note in enumerate(quoted)]
    names = {letter: "+".join(f"{letter}{i}" for i in range(len(quoted))) for letter in "pu"}
    texts = {"mass": json.dumps(names["p"]), "torque": json.dumps(names["u"]), "title": json.dumps(title)}
    path = folder / "swing.toml"
    path.write_text(FILE.format(parameters="\n".join(parameters), inputs="\n".join(inputs), **texts), encoding="utf-8")
    return path


def hostile_file(folder: Path, title: str) -> Path:
    """Write the file with hostile texts."""
    return described(folder / "b", title, WAYS)


@pytest.fixture(scope="module")
def honest(tmp_path_factory):
    """What commands write of the file that differs in its texts alone, each once."""

    @cache
    def output(*words: str) -> Path:
        return written(described(tmp_path_factory.mktemp("honest") / "a", "A swing", ("",) * len(WAYS)), *words)

    return output


@pytest.mark.parametrize("text", TEXTS)
def test_no_such_text_is_a_unit(text, tmp_path, capsys):
    path = described(tmp_path / "c", "A swing", ("",))
    path.write_text(path.read_text(encoding="utf-8").replace('"m"', json.dumps(text)), encoding="utf-8")
    assert main(["check", str(path)]) == 2
    said = capsys.readouterr().err
    assert "unit: expected" in said and said.rstrip("\n").replace("\n", "").isprintable()


def written(path: Path, *words: str) -> Path:
    """Write what a command writes beside the file of a mechanism."""
    output = path.parent / words[-1]
    assert main([words[0], str(path), *words[1:-1], "-o", str(output)]) in (0, 3)
    return output


def python_code(source: str) -> str:
    """Everything that runs, without docstrings and digests of files."""
    tree = ast.parse(source)
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.FunctionDef) and ast.get_docstring(node) is not None:
            node.body = node.body[1:] or [ast.Pass()]
    return re.sub(r"_[0-9a-f]{16}", "", ast.unparse(tree))


@cache  # of the honest one, which is compared with all others
def c_code(path: Path) -> str:
    """Everything that a compiler sees; the identity of an FMU is made of its texts."""
    done = subprocess.run(["cc", "-E", "-P", str(path)], capture_output=True, text=True, check=True)
    return re.sub(r"[0-9a-f-]{36}", "", done.stdout)


class Elements(HTMLParser):
    """Elements of a page with the names of their attributes, and its scripts."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.elements, self.scripts, self.kind = Counter[tuple[str, ...]](), list[tuple[str, str]](), ""
        self.feed(page)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.elements[(tag, *(name for name, _ in attrs))] += 1
        self.kind = (dict(attrs).get("type") or "code") if tag == "script" else ""

    def handle_endtag(self, tag):
        self.kind = ""

    def handle_data(self, data):
        if self.kind:
            self.scripts.append((self.kind, data))


def same_elements(one: Path, other: Path) -> None:
    """Compare two pages; scripts are the same but for data, which are JSON."""
    honest, hostile = (Elements(path.read_text(encoding="utf-8")) for path in (one, other))
    assert hostile.elements == honest.elements
    assert [kind for kind, _ in hostile.scripts] == [kind for kind, _ in honest.scripts]
    for (kind, text), (_, mine) in zip(honest.scripts, hostile.scripts, strict=True):
        if kind == "application/json":
            assert json.loads(mine).keys() == json.loads(text).keys()
        else:
            assert re.sub(r'"unit":"(?:[^"\\]|\\.)*"', "", mine) == re.sub(r'"unit":"(?:[^"\\]|\\.)*"', "", text)


def same_xml(one: str, other: str) -> ElementTree.Element:
    """Compare the elements of two documents with the names of their attributes; return the hostile one."""
    honest, hostile = ElementTree.fromstring(one), ElementTree.fromstring(other)

    def elements(root):
        return [(e.tag, *sorted(e.attrib)) for e in root.iter() if e.tag not in ("Unit", "BaseUnit")]

    assert elements(hostile) == elements(honest)
    return hostile


def titles(*few: str):
    """Parameters of a test: some titles, and in the slow run the others, a ninth of them in a turn."""
    others = of_turn((title for title in TITLES if title not in few), 9)
    return [
        *(pytest.param(title, id=f"title{TITLES.index(title)}") for title in few),
        *(pytest.param(title, id=f"title{TITLES.index(title)}", marks=pytest.mark.slow) for title in others),
    ]


@pytest.mark.slow
@pytest.mark.parametrize("title", titles(FEW[0]))
def test_packages(title, honest, tmp_path):
    assert_same_packages((), title, honest, tmp_path)


@pytest.mark.parametrize("options", [("--target", "cuda"), ("--target", "lanes"), ("--shape", "looped")])
def test_packages_of_other_code_have_the_same_comments(options, honest, tmp_path):
    assert_same_packages(options, FEW[0], honest, tmp_path)


def assert_same_packages(options, title, honest, tmp_path):
    words = ("generate", *options, "code")
    folders = [honest(*words), written(hostile_file(tmp_path, title), *words)]
    usual, hostile = (
        {p.name: p.read_text(encoding="utf-8") for p in folder.iterdir() if p.is_file()} for folder in folders
    )
    assert hostile.keys() == usual.keys()
    for name, text in hostile.items():
        if name.endswith(".py"):
            assert python_code(text) == python_code(usual[name])
        elif name.endswith(".json"):
            assert json.loads(text).keys() == json.loads(usual[name]).keys()
        else:
            assert not re.search(r"(?<!\\)<|(?<!\\)\](?=[(\[:])", text) and text.count("\n") == usual[name].count("\n")
    if not options:
        assert printed_by_package(folders[0]) == printed_by_package(folders[1]) != ""


@cache
def printed_by_package(folder: Path) -> str:
    """Run a package as it was written."""
    words = [sys.executable, "-B", "simulate.py", "direct_correction", "0.002"]
    environment = {"NUMBA_DISABLE_JIT": "1", "PATH": ""}
    done = subprocess.run(words, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.slow
@pytest.mark.parametrize("title", titles(*FEW))
def test_c(title, honest, tmp_path):
    words = ("generate", "--target", "c", "code")
    folders = [honest(*words), written(hostile_file(tmp_path, title), *words)]
    assert printed_by_c(folders[0]) == printed_by_c(folders[1]) != b""
    for name in ("swing.c", "main.c", "swing.h"):
        assert c_code(folders[0] / name) == c_code(folders[1] / name)
    page = (folders[1] / "README.md").read_text(encoding="utf-8")
    assert not re.search(r"(?<!\\)<|(?<!\\)\](?=[(\[:])", page)


@cache
def printed_by_c(folder: Path) -> bytes:
    """Compile and run a program."""
    texts = [str(path) for path in sorted(folder.glob("*.c"))]
    options = ["-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror", "-trigraphs"]
    subprocess.run(["cc", *options, *texts, "-lm", "-o", str(folder / "sim")], check=True)
    return subprocess.run([str(folder / "sim")], capture_output=True, check=True).stdout


@pytest.mark.slow
@pytest.mark.parametrize(("title", "fmi"), of_turn([(title, str(2 + i % 2)) for i, title in enumerate(TITLES)], 9))
def test_fmu(title, fmi, honest, tmp_path):
    words = ("generate", "--target", "fmu", "--fmi", fmi, "swing.fmu")
    files = [honest(*words), written(hostile_file(tmp_path, title), *words)]
    folders = list(map(unpacked, files))
    root = same_xml(*((f / "modelDescription.xml").read_text(encoding="utf-8") for f in folders))
    assert sorted(unit.get("name") for unit in root.iter("Unit")) == ["m", "m/s", "rad", "rad/s"]
    for name in ("swing.c", "fmu.c", "swing.h"):
        assert c_code(folders[0] / "sources" / name) == c_code(folders[1] / "sources" / name)
    library = next((folders[1] / "binaries").rglob("*.so"))
    assert not hasattr(ctypes.CDLL(str(library)), "planted")
    assert fmpy.read_model_description(str(files[1]), validate=True).modelName == "swing"
    assert len(fmpy.simulate_fmu(str(files[1]), stop_time=0.01)) > 1


@cache
def unpacked(file: Path) -> Path:
    """Unpack an FMU beside it."""
    folder = file.with_name("unpacked")
    with zipfile.ZipFile(file) as archive:
        archive.extractall(folder)
    return folder


@pytest.mark.slow
@pytest.mark.parametrize("title", titles(FEW[1]))
def test_javascript(title, honest, tmp_path):
    words = ("generate", "--target", "javascript", "code")
    folders = [honest(*words), written(hostile_file(tmp_path, title), *words)]
    node = shutil.which("node")
    lines = [(folder / "swing.mjs").read_text(encoding="utf-8").splitlines() for folder in folders]
    changed = [mine for text, mine in zip(*lines, strict=True) if mine != text]
    assert all(line.startswith("export const model = makeLive({") for line in changed)
    if node is None:
        return
    script = "import {model} from './swing.mjs'; const y = model.start(); console.log(JSON.stringify([...y])); "
    script += "console.log(Object.keys(globalThis).length, typeof planted)"
    said = [
        subprocess.run([node, "--input-type=module", "-e", script], cwd=f, capture_output=True, text=True, check=True)
        for f in folders
    ]
    assert said[0].stdout == said[1].stdout and said[1].stdout.endswith("undefined\n")


@pytest.mark.slow
@pytest.mark.parametrize("title", titles(FEW[1]))
def test_pages_and_pictures(title, honest, tmp_path):
    path = hostile_file(tmp_path, title)
    same_elements(honest("view", "page.html"), written(path, "view", "page.html"))
    same_elements(honest("inspect", "equations.html"), written(path, "inspect", "equations.html"))
    drawings = honest("draw", "drawing.svg"), written(path, "draw", "drawing.svg")
    root = same_xml(*(drawing.read_text(encoding="utf-8") for drawing in drawings))
    assert root.tag.endswith("svg")


@pytest.mark.parametrize("title", titles(FEW[2]))
def test_latex(title, tmp_path, capsys):
    documents = []
    for path in (described(tmp_path / "a", "A swing", ("",) * len(WAYS)), hostile_file(tmp_path, title)):
        capsys.readouterr()
        assert main(["inspect", str(path), "--format", "latex", "--document"]) == 0
        documents.append(capsys.readouterr().out)
    honest, hostile = (Counter(re.findall(r"\\[A-Za-z]+", text)) for text in documents)
    own = {r"\textbackslash", r"\textasciitilde", r"\textasciicircum", r"\allowbreak"}
    assert not {name for name in hostile - honest if name not in own}
    bare = [re.sub(r"\\[%$&#_{}\\]", "", text) for text in documents]
    for sign in "%$#":
        assert bare[1].count(sign) == bare[0].count(sign)
    assert bare[1].count("{") == bare[1].count("}") and bare[1].isascii()


@pytest.mark.slow
@pytest.mark.parametrize("title", titles(FEW[2]))
def test_saved_runs_and_terminals(title, tmp_path, capsys):
    path = hostile_file(tmp_path, title)
    for words in (["check"], ["inspect"], ["run", "--save", "run.nc"], ["run", "--save", "run.csv"], ["run", "--json"]):
        saved = [str(tmp_path / word) if word.startswith("run.") else word for word in words[1:]]
        assert main([words[0], str(path), *saved]) in (0, 3)
        said = "".join(capsys.readouterr())
        assert all(c.isprintable() or c == "\n" for c in said), words
    with (tmp_path / "run.csv").open(encoding="utf-8", newline="") as file:
        heading, *rows = csv.reader(file)
    assert {len(row) for row in rows} == {len(heading)}
    assert all(re.match(r"[A-Za-z]", cell) for cell in heading)
    assert all(float(cell or "nan") is not None for row in rows for cell in row)
    with xr.open_dataset(tmp_path / "run.nc", engine="h5netcdf") as data:
        assert data.attrs["mechanism"] == "swing" and json.loads(data.attrs["run"])["status"]


@pytest.mark.slow
def test_reports():
    """Titles, reasons and notes: a journal may be of somebody else."""
    texts = [" ".join(TEXTS), *of_turn(TITLES, 5)]
    made = [
        comparison_report(
            [
                study(
                    [row("lagrange", 1e-3, None, 0.1, status="failed", reason=text or "plain")],
                    traces=(trace(),),
                    title=text,
                )
            ]
        )
        for text in ("plain", *texts)
    ]
    honest, *hostile = (Elements(html_report(document)) for document in made)
    for page in hostile:
        assert set(page.elements) == set(honest.elements) and not page.scripts
    for document in made:
        lines = markdown_report(document, "files")
        assert not re.search(r"(?<!\\)<(?!!--)|(?<![\\!])\[[^\]\n]*[^\\\]]\]\(javascript", lines)
        assert all(c.isprintable() or c == "\n" for c in lines)


@pytest.mark.parametrize("text", [text for text in TEXTS if not text.isidentifier()])
def test_names_are_refused(text):
    for old in OWN_NAMES:
        names = {name: name for name in OWN_NAMES} | {old: text}
        description = {
            "mechanism": {"name": names["swing"]},
            "bodies": {names["rod"]: {"mass": 1.0, "inertia": 1.0}},
            "joints": {names["pin"]: {"type": "revolute", "between": ["ground", names["rod"]], "at": [[0, 0], [0, 0]]}},
            "forces": {names["push"]: {"type": "torque", "body": names["rod"], "torque": 1.0}},
            "outputs": {names["height"]: {"value": 1.0}},
            "events": {names["low"]: {"when": f"{names['rod']}.y < 0"}},
        }
        with pytest.raises(InputError, match="name"):
            mechanism_of(description)


def test_texts_of_comments():
    for text in TEXTS:
        words = comment_text(text)
        assert words.isprintable() and not re.search(r'\*/|/\*|"|\\', words)
    assert comment_text("N m/rad, kg*m^2") == "N m/rad, kg*m^2"
