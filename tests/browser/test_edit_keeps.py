"""No text is lost: a reload, a crash, a closed tab, a second window, a file changed outside, a server that ended.

The editor is started by its command in a process of its own, as users start it.
"""

import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace

import pytest

from symgen.describe import catalogue
from tests.browser.chromium import Chromium
from tests.browser.editor_page import Page

pytestmark = pytest.mark.browser

FOUR_BAR = catalogue.file_of_entry("four-bar")


@contextmanager
def command(chromium: Chromium, folder: Path, *words: str) -> Iterator[tuple[Page, subprocess.Popen[str]]]:
    """Start ``symgen edit`` in a folder, with texts that are not saved in a folder of the test; open its page."""
    environment = {**os.environ, "SYMGEN_CACHE_DIR": os.environ["SYMGEN_CACHE_DIR"]}
    asked = [sys.executable, "-m", "symgen", "edit", *words, "--no-browser"]
    with subprocess.Popen(asked, cwd=folder, stdout=subprocess.PIPE, text=True, env=environment) as process:
        assert process.stdout is not None
        address = process.stdout.readline().strip()
        editor = SimpleNamespace(address=address, origin="/".join(address.split("/")[:3]))
        try:
            page = Page(chromium, editor)  # type: ignore[arg-type]  # what a page needs of it
            page.open()
            page.until("Boolean(document.getElementById('text').value)")
            yield page, process
        finally:
            process.kill()


def offered(page: Page) -> list[str]:
    """Return what is offered: the sentence, and the words of its buttons."""
    page.until("!document.getElementById('offer').hidden")
    return [
        page.text("offered"),
        *page.run("[...document.querySelectorAll('#answers button')].map((e) => e.textContent)"),
    ]


def answer(page: Page, word: str) -> None:
    page.run(f"[...document.querySelectorAll('#answers button')].find((e) => e.textContent === '{word}').click()")


def kept(page: Page) -> None:
    """Wait until the server has the text that stands there, and has forgotten what was thrown away."""
    page.until("window.symgen.editor.kept()")


def another_tab(chromium: Chromium) -> tuple[str, str]:
    """Open an empty tab and turn to it; return the tab and the conversation of before."""
    before, chromium.session = chromium.session, ""
    target = chromium.call("Target.createTarget", url="about:blank")["targetId"]
    chromium.session = chromium.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
    for domain in ("Page", "Runtime", "Log", "Network"):
        chromium.call(f"{domain}.enable")
    return target, before


LOST = "was never saved"


def test_a_text_that_was_never_saved_outlives_a_reload_and_a_closed_tab(chromium: Chromium, tmp_path: Path) -> None:
    with command(chromium, tmp_path, "--new", "crane") as (page, _):
        assert page.run("document.getElementById('dirty').hidden && document.getElementById('offer').hidden")
        page.type(0, "# mine\n")
        kept(page)
        assert page.text("dirty") == "never saved"
        text = page.text("text")
        page.click(*page.place(0.0, 0.0))  # browsers let pages ask where somebody has touched them
        asked = chromium.asked
        page.open()  # this browser says yes
        assert chromium.asked == asked + 1
        sentence, *words = offered(page)
        assert LOST in sentence and words == ["Cancel", "Go on with it", "Throw it away"]
        page.picture("offer")
        assert not page.text("text").startswith("# mine")
        answer(page, "Cancel")  # it stays kept
        assert page.run("document.getElementById('offer').hidden")

        _, before = another_tab(chromium)
        page.open()
        assert LOST in offered(page)[0]
        answer(page, "Go on with it")
        kept(page)
        assert page.text("text") == text
        tab = chromium.call("Target.getTargetInfo")["targetInfo"]["targetId"]
        chromium.session = before
        chromium.call("Target.closeTarget", targetId=tab)  # without a question, as where a browser is killed

        page.open()
        assert LOST in offered(page)[0]  # once: the other one went with the decision
        answer(page, "Throw it away")
        page.until("document.getElementById('offer').hidden")
        kept(page)
        page.open()
        page.until("window.symgen.editor.checked()")
        assert page.run("document.getElementById('offer').hidden")
        page.click(*page.place(0.0, 0.0))
        asked = chromium.asked
        page.open()  # as it was begun: nothing would be lost
        assert chromium.asked == asked
        assert list(tmp_path.iterdir()) == []  # the file is written on Save alone


def test_a_text_outlives_a_page_that_crashes(chromium: Chromium, tmp_path: Path) -> None:
    with command(chromium, tmp_path, "--new", "crane") as (page, _):
        tab, before = another_tab(chromium)
        page.open()
        page.until("window.symgen.editor.checked()")
        page.type(0, "# mine\n")
        kept(page)
        text, crashing = page.text("text"), chromium.session
        chromium.session = crashing
        chromium.send("Page.crash")
        chromium.session = before
        chromium.call("Target.closeTarget", targetId=tab)
        page.open()
        assert LOST in offered(page)[0]
        answer(page, "Go on with it")
        assert page.text("text") == text


def test_a_text_outlives_its_server_and_is_offered_by_the_next_one(chromium: Chromium, tmp_path: Path) -> None:
    file = Path(shutil.copy(str(FOUR_BAR), tmp_path / "bar.toml"))
    before = file.read_text()
    with command(chromium, tmp_path, "bar.toml") as (page, process):
        page.type(0, "# ours\n")
        kept(page)
        os.kill(process.pid, signal.SIGKILL)
        process.wait(20)
        page.type(0, "# later\n")
        sentence, *words = offered(page)
        assert "does not answer" in sentence and words == ["Cancel", "Download it"]
        assert page.text("text") == f"# later\n# ours\n{before}"  # the page still has it
    with command(chromium, tmp_path, "bar.toml") as (page, _):
        assert LOST in offered(page)[0] and page.text("text") == before
        answer(page, "Go on with it")
        page.until("document.getElementById('text').value.startsWith('# ours')")
        assert page.text("dirty") == "changed" and file.read_text() == before
        page.key("s", 2)
        page.until("document.getElementById('status').textContent.startsWith('saved')")
        assert file.read_text() == f"# ours\n{before}"
        kept(page)
        page.open()
        page.until("window.symgen.editor.checked()")
        assert page.run("document.getElementById('offer').hidden")  # what was saved is offered no more


def test_two_windows_know_of_each_other(chromium: Chromium, tmp_path: Path) -> None:
    file = Path(shutil.copy(str(FOUR_BAR), tmp_path / "bar.toml"))
    with command(chromium, tmp_path, "bar.toml") as (page, _):
        page.type(0, "# first\n")
        kept(page)
        tab, before = another_tab(chromium)
        page.open()
        assert LOST in offered(page)[0]
        answer(page, "Cancel")
        page.type(0, "# second\n")
        page.key("s", 2)
        page.until("document.getElementById('status').textContent.startsWith('saved')")
        second, chromium.session = chromium.session, before
        chromium.call("Page.bringToFront")
        page.run("window.dispatchEvent(new Event('focus'))")
        sentence, *words = offered(page)
        assert "bar.toml has changed on the disk" in sentence and "Undo brings it back" in sentence
        assert words == ["Cancel", "Load the file", "Save over it"]
        assert page.text("text").startswith("# first\n")
        answer(page, "Load the file")
        page.until("document.getElementById('text').value.startsWith('# second')")
        page.key("z", 2)
        assert page.text("text").startswith("# first\n") and file.read_text().startswith("# second\n")
        chromium.session = second
        chromium.call("Target.closeTarget", targetId=tab)
        chromium.session = before


def test_a_file_that_another_program_changes_is_offered_and_cancel_is_first(chromium: Chromium, tmp_path: Path) -> None:
    file = Path(shutil.copy(str(FOUR_BAR), tmp_path / "bar.toml"))
    with command(chromium, tmp_path, "bar.toml") as (page, _):
        page.until("window.symgen.editor.checked()")
        file.write_text(file.read_text() + "# theirs\n")
        sentence, *words = offered(page)  # without any act
        assert sentence == "bar.toml has changed on the disk." and words == ["Cancel", "Load the file"]
        answer(page, "Load the file")
        page.until("document.getElementById('text').value.endsWith('# theirs\\n')")
        assert page.text("status") == "loaded bar.toml"
        file.unlink()
        page.run("window.dispatchEvent(new Event('focus'))")
        assert offered(page)[0] == "bar.toml has gone from the disk."
        answer(page, "Save it again")
        page.until("document.getElementById('status').textContent.startsWith('saved')")
        assert file.read_text().endswith("# theirs\n")


def test_words_of_acts_stay_and_the_harmless_answer_has_the_focus(chromium: Chromium, tmp_path: Path) -> None:
    file = Path(shutil.copy(str(FOUR_BAR), tmp_path / "bar.toml"))
    with command(chromium, tmp_path, "bar.toml") as (page, _):
        page.rested()
        page.type(0, "# ours\n")
        page.key("s", 2)
        page.until("document.getElementById('status').textContent === 'saved bar.toml'")
        page.rested()  # neither the motion nor its live part has anything to say there
        page.until("window.symgen.editor.times().lived === window.symgen.editor.version()")
        assert page.text("status") == "saved bar.toml"
        page.run("document.getElementById('text').setSelectionRange(0, 0)")
        page.press("#remove")
        page.until("document.getElementById('status').textContent.startsWith('put the cursor')")
        page.run("window.symgen.editor.check()")
        page.until("window.symgen.editor.checked()")
        assert page.text("status").startswith("put the cursor")
        page.type(0, "# ")
        assert page.text("status") == ""

        file.write_text("# theirs\n")
        page.key("s", 2)
        page.until("document.getElementById('ask').open")
        assert page.run("document.activeElement.id") == "back"
        assert page.run("[...document.querySelectorAll('#ask button')].map((e) => e.textContent)")[0] == "Cancel"


def test_errors_stand_where_they_are(chromium: Chromium, tmp_path: Path) -> None:
    file = tmp_path / "bar.toml"
    head = '[mechanism]\nname = "bar"\n\n'
    file.write_text(head)
    with command(chromium, tmp_path, "bar.toml") as (page, _):

        def errors(text: str) -> list[str]:
            page.type(0, text, erased=len(page.text("text")))
            page.until("window.symgen.editor.checked()")
            page.until("!document.getElementById('errors').hidden")
            return list(page.run("[...document.querySelectorAll('#errors button')].map((e) => e.textContent)"))

        page.type(0, f"{head}# nothing yet\n", erased=len(page.text("text")))
        page.until("window.symgen.editor.checked()")  # a sheet without bodies has no error
        assert page.run("document.getElementById('errors').hidden") and "no body yet" in page.text("told")
        (found,) = errors(f"{head}[bodies.rod]\nmass = 1.0\npoints = {{ A = [0.0, 1.0]")
        assert found.startswith("6: ")
        wrong = (
            '[bodies.rod]\nmas = 1.0\ninertia = true\npositoin = [0.0, 0.0]\n[bodies.b]\nmass = "x"\ninertia = "y"\n'
        )
        assert [each.split(":")[0] for each in errors(head + wrong)] == ["5", "6", "7", "9", "10"]
        assert page.run("[...document.querySelectorAll('.cm-lineNumbers .bad')].map((e) => +e.textContent)") == [
            5,
            6,
            7,
            9,
            10,
        ]
        undefined = (
            "[parameters]\na = 0.0\n[bodies.rod]\nmass = 1.0\ninertia = 1.0\nposition = [0.0, 0.0]\n"
            '[joints.own]\ntype = "rows"\nbetween = ["rod"]\nrows = [{ position = "rod.x - sqrt(a - 1)" }]\n'
        )
        (found,) = errors(head + undefined)
        assert not found[0].isdigit()  # of no line
        assert page.run("document.querySelectorAll('.cm-lineNumbers .bad').length") == 0
