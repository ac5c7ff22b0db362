"""What the pages say: every command fenced as ``console`` runs, every Python snippet runs, links lead somewhere,
every page can be reached, and every kind with every key stands in the tables."""

import ast
import os
import re
import shlex
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import msgspec
import pytest
from support.processes import COMMAND, python

import symgen
from benchmarks import gallery, kept_pictures
from symgen.api import load
from symgen.derive.methods import METHODS
from symgen.describe.beams.beam_sections import BeamSection
from symgen.describe.facts.digest import digest
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate
from symgen.describe.forces import FORCES
from symgen.describe.formulas.identifiers import CALLABLE
from symgen.describe.joints import JOINTS
from symgen.describe.modal.modal_bodies import ModalSection, SpatialModalSection
from symgen.describe.parts.event_sections import EventSection
from symgen.describe.parts.sections import (
    BodySection,
    InputSection,
    MechanismSection,
    OrientationSection,
    ParameterSection,
    RunSection,
    SpatialBodySection,
    StateSection,
    TableSection,
)
from symgen.run.integrators import INTEGRATORS

ROOT = Path(__file__).resolve().parents[2]
PAGES = (
    ROOT / "README.md",
    ROOT / "CONTRIBUTING.md",
    ROOT / "CHANGELOG.md",
    *sorted((ROOT / "benchmarks").rglob("*.md")),
    ROOT / "examples" / "README.md",
    *sorted((ROOT / "docs").rglob("*.md")),
)
_FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_LINK = re.compile(r"(?<!!)\[[^\]]+\]\(([^)\s]+)\)")
_PICTURE = re.compile(r"!\[[^\]]*\]\(([^)\s]+)\)")
#: What may stand before a command: a variable of its environment.
_SETTING = re.compile(r"([A-Z_]+)=(\S*)")
#: A block that a page calls a file: "... as `press.toml`:" right above it.
_FILE = re.compile(
    r"`([\w-]+\.(?:toml|py|urdf|csv))`:\n\n```(?:toml|python|xml|none)\n(.*?)^```$", re.MULTILINE | re.DOTALL
)


@dataclass(frozen=True)
class Fenced:
    """A fenced block: its language, text and first line."""

    language: str
    text: str
    line: int


def fenced(page: Path, language: str) -> list[Fenced]:
    """Return the blocks of one language, in order."""
    text = page.read_text(encoding="utf-8")
    return [
        Fenced(m.group(1), m.group(2), text.count("\n", 0, m.start()) + 2)
        for m in _FENCE.finditer(text)
        if m.group(1) == language
    ]


def files(page: Path) -> dict[str, str]:
    """Return the files that a page shows, by name."""
    return {m.group(1): m.group(2) for m in _FILE.finditer(page.read_text(encoding="utf-8"))}


def name(page: Path) -> str:
    """Return how a page is called in the names of tests."""
    return page.relative_to(ROOT).as_posix()


def with_language(language: str) -> list[object]:
    """Return the pages that have blocks of a language."""
    found = [page for page in PAGES if fenced(page, language)]
    return [pytest.param(page, id=name(page)) for page in found]


@pytest.mark.slow
@pytest.mark.parametrize("page", with_language("console"))
def test_every_command_runs(page: Path, tmp_path: Path) -> None:
    commands = [
        (block.line + i, line[2:])
        for block in fenced(page, "console")
        for i, line in enumerate(block.text.splitlines())
        if line.startswith("$ ")
    ]
    assert commands
    shown = files(page)
    for file, text in shown.items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    for line, command in commands:
        words, settings = shlex.split(command), dict[str, str]()
        while (setting := _SETTING.fullmatch(words[0])) is not None:  # as a shell reads them
            settings[setting.group(1)] = setting.group(2)
            words = words[1:]
        own = words[0] == "symgen" or (words[0] == "python" and words[1] in shown and len(words) == 2)
        assert own, f"{name(page)}:{line}: only symgen's own commands and scripts of the page are run: {command}"
        file = f"import runpy\nrunpy.run_path({words[1]!r}, run_name='__main__')"
        script, rest = (COMMAND, words[1:]) if words[0] == "symgen" else (file, [])
        done = python(script, *rest, cwd=tmp_path, env={**os.environ, **settings})
        assert done.returncode == 0, f"{name(page)}:{line}: {command}\n{done.stderr}"


def test_the_errors_of_the_wrong_file_that_a_page_shows(
    cli: Callable[..., tuple[int, str, str]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file, errors = (block.text for block in fenced(ROOT / "docs" / "command-line.md", "text"))
    (tmp_path / "slips.toml").write_text(file, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    assert cli("check", "slips.toml") == (2, "", errors)


@pytest.mark.fast(
    "README.md",
    "docs/development/architecture.md",
    "docs/drawing.md",
    "docs/howto/controllers.md",
    "docs/howto/gymnasium.md",
    "docs/howto/own-integrator.md",
    "docs/howto/own-joint.md",
    "docs/howto/own-mechanism.md",
    "docs/howto/own-method.md",
    "docs/howto/stiff-mechanisms.md",
    "docs/howto/stops.md",
    "docs/development/internals.md",
    "docs/inverse.md",
    "docs/joint-coordinates.md",
    "docs/linearise.md",
    "docs/modes.md",
    "docs/player.md",
    "docs/tutorial-space.md",
    "docs/tutorials/modes.md",
    "docs/tutorials/scissor-lift.md",
    "docs/tutorials/wiper.md",
)
@pytest.mark.parametrize("page", with_language("python"))
def test_every_snippet_runs(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The snippets of a page share their names, as a reader would type them one after the other."""
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {"__name__": "__main__"}
    for file, text in files(page).items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    shown = page.read_text(encoding="utf-8")
    scripts = {x for file, x in files(page).items() if f"\n$ python {file}\n" in shown or f"--plugin {file}" in shown}
    blocks = [block for block in fenced(page, "python") if block.text not in scripts]  # others are run as commands
    if any("\nimport jax\n" in block.text for block in blocks):  # its threads stay, and others of this process fork
        (tmp_path / "page.py").write_text("\n".join(block.text for block in blocks), encoding="utf-8")
        done = subprocess.run([sys.executable, "page.py"], capture_output=True, text=True, timeout=900, check=False)
        assert done.returncode == 0, done.stderr
        return
    for block in blocks:
        code = compile("\n" * (block.line - 1) + block.text, str(page), "exec")
        exec(code, names)


@pytest.mark.parametrize("page", with_language("toml"))
def test_every_file_shown_is_valid(page: Path) -> None:
    for block in fenced(page, "toml"):
        validate(parse_toml(block.text, name(page)), name(page))


def each_target(pattern: re.Pattern[str]) -> Iterator[tuple[Path, str]]:
    """Yield every page with every target that a pattern finds in it."""
    for page in PAGES:
        yield from ((page, target) for target in pattern.findall(page.read_text(encoding="utf-8")))


def test_every_block_is_closed() -> None:
    """A block without its end would hide the commands after it from these tests."""
    fences = {page: page.read_text(encoding="utf-8").count("\n```") for page in PAGES}
    assert not [name(page) for page, count in fences.items() if count % 2]


def test_links_lead_somewhere() -> None:
    for page, target in each_target(_LINK):
        if target.startswith(("https://", "http://")):
            continue
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        assert file.exists(), f"{name(page)} links to {target}, which does not exist"
        assert file.is_relative_to(ROOT)
        if anchor:
            assert anchor in anchors(file), f"{name(page)} links to {target}, which has no such heading"


def test_pictures_are_there() -> None:
    for page, target in each_target(_PICTURE):
        file = (page.parent / target).resolve()
        assert file.is_file() and file.is_relative_to(ROOT), f"{name(page)} shows {target}, which does not exist"
        largest = kept_pictures.LARGEST_OF_README if file.parent == kept_pictures.PICTURES else kept_pictures.LARGEST
        largest = kept_pictures.LARGEST_FILM if file.suffix == ".gif" else largest
        assert file.stat().st_size <= largest, f"{target} is larger than {largest} bytes"


def test_every_page_is_reachable_from_the_first_one() -> None:
    """By links in the text, as somebody reads who has no sidebar."""
    first = ROOT / "docs" / "README.md"
    seen, open_pages = {first}, [first]
    while open_pages:
        here = open_pages.pop()
        for target in _LINK.findall(here.read_text(encoding="utf-8")):
            path = (here.parent / target.partition("#")[0]).resolve()
            if path.suffix == ".md" and path.is_file() and path not in seen:
                seen.add(path)
                open_pages.append(path)
    docs = {page for page in PAGES if (ROOT / "docs") in page.parents}
    assert not {name(page) for page in docs - seen}


def anchors(page: Path) -> set[str]:
    """Return the anchors of a page's headings, as they are made from the text; comments of code are no headings."""
    headings = re.findall(r"^#+ (.*)$", _FENCE.sub("", page.read_text(encoding="utf-8")), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-") for heading in headings}


def test_a_comment_of_code_is_no_heading() -> None:
    page = ROOT / "docs" / "tables" / "README.md"
    assert anchors(page) == {"tables"}
    own = anchors(ROOT / "docs" / "howto" / "finite-elements.md")
    assert "in-a-mechanism" in own and not any("strip-of-steel" in anchor for anchor in own)


# -- every kind with every key -----------------------------------------------------------------------------------------


def page(stem: str) -> str:
    """Return the text of a page under docs/."""
    return (ROOT / "docs" / f"{stem}.md").read_text(encoding="utf-8")


def rows(text: str) -> list[str]:
    """Return the first cells of all table rows."""
    return [line.split("|")[1].strip() for line in text.splitlines() if line.startswith("|")]


def section(text: str, heading: str) -> str:
    """Return what stands under a heading, up to the next one."""
    found = re.search(rf"^#+ {re.escape(heading)}\n(.*?)(?=^#|\Z)", text, re.MULTILINE | re.DOTALL)
    assert found, f"no heading '{heading}'"
    return found.group(1)


KINDS = [*((k, JOINTS) for k in JOINTS.names), *((k, FORCES) for k in FORCES.names)]


@pytest.mark.parametrize(("kind", "registry"), KINDS, ids=lambda x: x if isinstance(x, str) else "")
def test_a_kind_stands_in_the_reference_with_all_its_keys(kind: str, registry: object) -> None:
    text = page("file-format/joints" if registry is JOINTS else "file-format/forces")
    assert any(cell.startswith(f"`{kind}`") for cell in rows(text)), f"{kind} is in no table"
    keys = {field.name for field in msgspec.structs.fields(registry.get(kind))}  # type: ignore[attr-defined]  # a registry of structs
    table = " ".join(rows(section(text, f"`{kind}`")))
    assert set(re.findall(r"`(\w+)`", table)) == keys


@pytest.mark.parametrize(
    ("stem", "heading", "structs"),
    [
        ("README", "`[mechanism]`", [MechanismSection]),
        ("README", "`[parameters]`", [ParameterSection]),
        ("runs", "`[run]`", [RunSection]),
        ("runs", "`[events.NAME]`", [EventSection]),
        ("formulas", "`[inputs]`", [InputSection]),
        ("formulas", "`[states.NAME]`", [StateSection]),
        ("formulas", "`[tables.NAME]`", [TableSection]),
        ("bodies", "`[bodies.NAME]`", [BodySection]),
        ("bodies", "`[bodies.NAME]` in space", [SpatialBodySection, OrientationSection]),
        ("bodies", "`[beams.NAME]`", [BeamSection]),
        ("bodies", "Modal bodies", [ModalSection, SpatialModalSection]),
    ],
)
def test_a_section_stands_in_the_reference_with_all_its_keys(
    stem: str, heading: str, structs: list[type[msgspec.Struct]]
) -> None:
    table = " ".join(rows(section(page(f"file-format/{stem}"), heading)))
    assert set(re.findall(r"`(\w+)`", table)) == {f.name for s in structs for f in msgspec.structs.fields(s)}


def test_every_function_of_an_expression_is_named() -> None:
    text = section(page("file-format/formulas"), "Expressions")
    missing = [function for function in CALLABLE if not re.search(rf"\b{function}\b", text)]
    assert not missing


@pytest.mark.parametrize("method", METHODS.names)
def test_a_method_stands_in_its_page_with_parameters_and_defaults(method: str) -> None:
    text = page("methods")
    line = next(line for line in text.splitlines() if line.startswith(f"| `{method}` |"))
    cells = [cell.strip() for cell in line.split("|")]
    assert cells[4] == ", ".join(METHODS.get(method).forms)
    assert cells[5] == f"`{METHODS.get(method).default_integrator}`"
    own = section(text, f"`{method}`")
    for parameter in METHODS.get(method).parameters:
        line = next(line for line in own.splitlines() if line.startswith(f"| `{parameter.name}`"))
        cells = [cell.strip() for cell in line.split("|")]
        assert float(cells[2]) == parameter.default and cells[3] == parameter.unit
    for option in METHODS.get(method).options:
        where = section(text, "What the methods share") if option.name == "solver" else own
        assert f"`{option.name}`" in own
        assert all(f"`{value}`" in where for value in option.values)


@pytest.mark.parametrize("integrator", INTEGRATORS.names)
def test_an_integrator_stands_in_its_page_with_its_order(integrator: str) -> None:
    text = page("integrators")
    line = next(line for line in text.splitlines() if line.startswith(f"| `{integrator}`"))
    kind, cells = INTEGRATORS.get(integrator), [cell.strip() for cell in line.split("|")]
    assert cells[3] == str(kind.order)
    assert cells[4] == ", ".join(kind.forms)
    assert (cells[5] == "adaptive") == kind.adaptive
    for parameter in kind.parameters:
        row = next(line for line in text.splitlines() if line.startswith(f"| `{integrator}` | `{parameter.name}`"))
        assert float(row.split("|")[3]) == parameter.default


def test_every_command_has_an_example() -> None:
    from symgen.cli import COMMANDS

    reference = page("command-line")
    assert not [command for command in COMMANDS if f"$ symgen {command}" not in reference]


def test_the_readme_takes_a_screen_and_a_half() -> None:
    """What is read: words without addresses and marks."""
    text = re.sub(r"\]\([^)]*\)", "]", (ROOT / "README.md").read_text(encoding="utf-8"))
    assert len(re.sub(r"[^\w\s.,'-]|(?<!\w)[.-]+(?!\w)", " ", text).split()) <= 550


def test_the_gallery_says_what_was_measured() -> None:
    """Pages are written from the catalogue and the data, so neither can change without them."""
    written = {path.name: path.read_text(encoding="utf-8") for path in gallery.FOLDER.glob("*.md")}
    assert written == gallery.pages(), "run python -m benchmarks.gallery --pages"


@pytest.mark.parametrize("path", sorted(gallery.DATA.glob("*.json")), ids=lambda path: path.stem)
def test_rows_of_the_gallery_belong_to_the_mechanism_as_it_is(path: Path) -> None:
    known = {entry.name: entry for entry in gallery.every()}
    measured = gallery.data(path.stem)
    assert measured is not None and measured["model"] == gallery.model_name(known[path.stem])
    assert measured.get("command", gallery.command(known[path.stem])) == gallery.command(known[path.stem])
    again = f"run python -m benchmarks.gallery {path.stem}"
    assert measured["digest"] == digest(load(measured["model"]).mechanism), again


def test_every_public_name_stands_in_the_api() -> None:
    text = page("api")
    assert not [
        public for public in symgen.__all__ if not public.startswith("_") and f":: symgen.{public}\n" not in text
    ]


def test_the_navigation_of_the_site_names_pages_that_exist() -> None:
    """What it does not name stands in it all the same; ``make docs`` holds that."""
    text = (ROOT / "docs" / "conf.py").read_text(encoding="utf-8")
    tree = next(
        node
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.Assign) and "NAVIGATION" in ast.unparse(node.targets[0])
    )
    pages = [page for pages in ast.literal_eval(tree.value).values() for page in pages]
    assert len(pages) == len(set(pages))
    assert not [page for page in pages if not (ROOT / f"{page}.md").is_file()]


@pytest.mark.parametrize("stem", ["README", "bodies", "joints", "forces", "formulas", "runs"])
def test_a_page_of_the_file_begins_with_a_picture_and_an_example(stem: str) -> None:
    text = page(f"file-format/{stem}")
    assert text.index("![") < text.index("```toml\n[mechanism]") < text.index("\n| ")


def test_links_to_decisions_have_names() -> None:
    """A number says nothing to a reader; the index of decisions has both."""
    bare = re.compile(r"\[(?:decisions? )?\d{4}\]\(")
    assert not [name(page) for page in PAGES if page.name != "CHANGELOG.md" and bare.search(page.read_text("utf-8"))]


def test_every_decision_is_listed() -> None:
    folder = ROOT / "docs" / "decisions"
    index = (folder / "README.md").read_text(encoding="utf-8")
    for path in sorted(folder.glob("[0-9]*.md")):
        title = path.read_text(encoding="utf-8").splitlines()[0].removeprefix("# ")
        assert f"[{title}]({path.name})" in index
