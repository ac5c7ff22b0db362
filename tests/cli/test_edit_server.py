"""The server of ``symgen edit``: what it answers, to whom, and what it writes."""

import base64
import http.client
import json
import os
import re
import shutil
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import closing
from email.message import Message
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

from symgen.api import load
from symgen.base.errors import InputError
from symgen.cli._editor.drafts import Drafts
from symgen.cli._editor.edited_file import Document
from symgen.cli._editor.server import LARGEST_REQUEST, Editor
from symgen.cli._editor.texts import Texts
from symgen.describe import catalogue
from symgen.describe.facts.digest import digest
from symgen.describe.files.load import LARGEST_FILE
from symgen.describe.files.origins import Source, origin_of

FOUR_BAR = catalogue.file_of_entry("four-bar")
assert FOUR_BAR is not None
TEXT = FOUR_BAR.read_text(encoding="utf-8")


@pytest.fixture
def editor(tmp_path: Path) -> Iterator[Editor]:
    file = tmp_path / "bar.toml"
    file.write_text(TEXT, encoding="utf-8")
    with Editor(Document(file)) as server:
        thread = threading.Thread(target=server.serve_forever, args=(0.01,), daemon=True)
        thread.start()
        yield server
        server.shutdown()
        thread.join(10)


class Answer(NamedTuple):
    status: int
    headers: Message
    body: bytes


def asked(editor: Editor, path: str, body: bytes | None = None, method: str = "", **changed: str | None) -> Answer:
    """Return the answer to a request as the page sends it, but for headers that are changed, or left out for None."""
    headers: dict[str, str | None] = {"Host": editor.origin.removeprefix("http://")}
    if body is not None:
        headers |= {"Origin": editor.origin, "Content-Type": "application/json", "Content-Length": str(len(body))}
    headers |= {name.replace("_", "-"): value for name, value in changed.items()}
    with closing(http.client.HTTPConnection("127.0.0.1", editor.server_port, timeout=20)) as connection:
        connection.putrequest(method or ("GET" if body is None else "POST"), path, skip_host=True)
        for name, value in headers.items():
            if value is not None:
                connection.putheader(name, value)
        connection.endheaders(body)
        with connection.getresponse() as response:
            return Answer(response.status, response.headers, response.read())


def done(editor: Editor, job: str, **given: Any) -> Any:
    answer = asked(editor, f"/{editor.secret}/{job}", json.dumps(given).encode())
    assert answer.status == 200
    return json.loads(answer.body)


def test_the_page_is_whole_and_runs_under_a_policy_of_its_own(editor: Editor) -> None:
    answer = asked(editor, f"/{editor.secret}/")
    text, policy = answer.body.decode(), answer.headers["Content-Security-Policy"]
    nonce = re.search(r"script-src 'nonce-([\w-]+)'", policy)
    assert answer.status == 200 and nonce is not None
    assert "default-src 'none'" in policy and "unsafe" not in policy and "connect-src 'self'" in policy
    assert "frame-ancestors 'none'" in policy and answer.headers["Referrer-Policy"] == "no-referrer"
    assert text.count(f'nonce="{nonce[1]}"') == len(
        re.findall(r"<(?:script|style)(?! type=\"application/json\")", text)
    )
    assert not re.search(r"https?://(?!www\.w3\.org)", text)
    assert not re.search(r"<(link|img|script|iframe)[^>]*(src|href)=(?!\"data:)", text)
    other = asked(editor, f"/{editor.secret}/").headers["Content-Security-Policy"]
    assert other != policy  # a word that is used twice could be known


def test_a_name_of_a_file_is_no_markup(tmp_path: Path) -> None:
    file = tmp_path / "<img src=x onerror=alert(1)>.toml"
    file.write_text(TEXT, encoding="utf-8")
    with Editor(Document(file)) as server:
        thread = threading.Thread(target=server.serve_forever, args=(0.01,), daemon=True)
        thread.start()
        text = asked(server, f"/{server.secret}/").body.decode()
        server.shutdown()
    assert "<img" not in text and "&lt;img src=x" in text


JOB = json.dumps({"text": TEXT}).encode()


@pytest.mark.parametrize(
    "changed",
    [
        {"Origin": "http://evil.example"},
        {"Origin": "null"},
        {"Origin": None},
        {"Origin": "http://127.0.0.1:1"},
        {"Host": "evil.example"},
        {"Host": "localhost"},
        {"Host": None},
    ],
)
def test_a_page_from_elsewhere_is_refused(editor: Editor, changed: dict[str, str | None]) -> None:
    assert asked(editor, f"/{editor.secret}/check", JOB, **changed).status == 403


def test_a_link_from_another_page_is_refused(editor: Editor) -> None:
    assert asked(editor, f"/{editor.secret}/", Sec_Fetch_Site="cross-site").status == 403
    assert asked(editor, f"/{editor.secret}/", Origin="http://evil.example").status == 403
    assert asked(editor, f"/{editor.secret}/", Sec_Fetch_Site="none").status == 200


@pytest.mark.parametrize("path", ["/", "//", "/guess/", "/guess/check", "", "*", "/%2e%2e/", "http://evil.example/"])
def test_without_the_secret_nothing_is_there(editor: Editor, path: str) -> None:
    assert asked(editor, path or "/x").status == 403
    assert asked(editor, path or "/x", JOB).status == 403
    assert asked(editor, f"/{editor.secret[:-1]}/check", JOB).status == 403


@pytest.mark.parametrize(
    "path", ["../bar.toml", "..", "../../etc/passwd", "%2e%2e/bar.toml", "bar.toml", "check/", "check?x", "__init__"]
)
def test_no_address_is_a_path_of_a_file(editor: Editor, path: str) -> None:
    for answer in (asked(editor, f"/{editor.secret}/{path}"), asked(editor, f"/{editor.secret}/{path}", JOB)):
        assert answer.status == 404 and answer.body == b""


def test_other_requests_are_refused(editor: Editor) -> None:
    job = f"/{editor.secret}/check"
    assert asked(editor, job, JOB, Content_Type="text/plain").status == 415  # what a form could send
    assert asked(editor, job, JOB, Content_Length=None).status == 411
    assert asked(editor, job, b"", Content_Length=str(LARGEST_REQUEST + 1)).status == 413
    assert asked(editor, job, b"{").status == 400
    for deep in (b'{"text": ' + b"[" * 100_000, b'{"unknown": ' + b"[" * 100_000):
        assert asked(editor, job, deep).status in (200, 400)  # refused by its type, or as no JSON
    assert "expected what the page of this editor sends" in json.loads(asked(editor, job, b"[1]").body)["error"]
    assert "expected what the page of this editor sends" in done(editor, "check", text=3)["error"]
    assert "expected a text" in json.loads(asked(editor, job, b"{}").body)["error"]
    assert "`$.spots[0].x`" in done(editor, "add", text=TEXT, part="body", spots=[{"x": "here"}])["error"]
    assert asked(editor, job, JOB, method="PUT").status == 501
    assert done(editor, "check", text=TEXT)["errors"] == []  # and it goes on


def test_errors_are_those_of_the_command_line_with_their_lines(editor: Editor, cli: Any, tmp_path: Path) -> None:
    wrong = TEXT.replace('"crank_mass"', '"crank_mas"', 1).replace("until", "untill", 1)
    (tmp_path / "wrong.toml").write_text(wrong, encoding="utf-8")
    said = cli("check", tmp_path / "wrong.toml")[2].splitlines()
    found = done(editor, "check", text=wrong)
    assert [f"{tmp_path / 'wrong.toml'}:{e['line']}: {e['text']}" for e in found["errors"]] == said
    assert len(said) == found["count"] == 2 and "data" not in found
    assert done(editor, "check", text="[mechanism\n")["errors"][0]["line"] == 1


def test_a_mechanism_that_does_not_close_is_drawn_with_its_sentence(editor: Editor) -> None:
    found = done(editor, "check", text=TEXT.replace("[10.0, 0.0]", "[30.0, 0.0]"))
    (error,) = found["errors"]
    assert "cannot be assembled" in error["text"]
    assert TEXT.split("\n")[error["line"] - 1].startswith("[joints.")
    assert any(item["role"] == "fault" for item in found["data"]["scene"]["items"])
    assert len(found["data"]["motions"]) == 2  # the described start stands behind


@pytest.mark.slow
def test_the_drawing_has_the_start_and_the_motion_what_a_page_has(editor: Editor) -> None:
    text = TEXT.replace("until = 10.0", "until = 0.2")
    found = done(editor, "check", text=text)
    assert found["errors"] == [] and found["data"]["motions"][0]["count"] == 1
    assert {handle["name"] for handle in found["handles"]} == {f"joints.{name}" for name in "ABCD"}
    assert {text[slice(*span)] for span in found["numbers"].values()} == {"2.0", "8.0", "5.0"}
    moved = done(editor, "motion", text=text, tab="a", asked=1)
    assert moved["status"] == "ok" and moved["data"]["motions"][0]["count"] > 10 and moved["data"]["live"] is None
    live = done(editor, "live", text=text, tab="a", asked=1)
    assert live["data"]["live"]["method"] == "direct-correction" and "makeLive" in live["script"]
    assert done(editor, "live", text=TEXT, tab="a", asked=1) == {"superseded": True}
    assert done(editor, "live", text=text, tab="a", asked=0) == {"superseded": True}  # a newer text is asked for


STOPPED = """
[mechanism]
name = "stopped"
gravity = [0.0, -9.81]
[run]
until = 0.5
[bodies.rod]
mass = 1.2
inertia = 0.1
points = { A = [-0.5, 0.0] }
position = [0.5, 0.0]
[joints.pin]
type = "revolute"
between = ["ground", "rod"]
at = [[0.0, 0.0], "A"]
stop = { lower = -0.8 }
"""


def test_a_moved_number_needs_no_new_code() -> None:
    digests = set[str]()
    for length in (-0.5, -0.45):
        texts = Texts(Source("stopped.toml"))  # each reads the whole text
        digests.add(digest(texts.for_runs(texts.read(STOPPED.replace("[-0.5, 0.0]", f"[{length}, 0.0]")))))
    assert len(digests) == 1


@pytest.mark.parametrize(
    ("old", "new", "at_hand"),
    [("-0.5,", "-0.45,", True), ("-0.5,", "0.0,", False), ("-0.8", "-0.7", False), ("1.2\n", "1.2\n\n", False)],
)
def test_a_mechanism_with_other_numbers_is_that_of_its_whole_text(old: str, new: str, at_hand: bool) -> None:
    texts, alone = Texts(Source("stopped.toml")), Texts(Source("stopped.toml"))
    first = texts.for_runs(texts.read(STOPPED))
    text = STOPPED.replace(old, new, 1)
    kept, expected = texts.for_runs(texts.read(text)), alone.for_runs(alone.read(text))
    origins = origin_of(kept), origin_of(expected)
    assert kept == expected and origins[0] == origins[1] and origins[0] is not None
    assert (kept.joints is first.joints) == at_hand  # a zero, a limit of a stop and any other text are read whole
    assert texts.for_starts(texts.read(text)) is kept


def test_drawing_and_motion_after_another_number_are_those_of_the_whole_text(tmp_path: Path) -> None:
    kept, alone = Drafts(tmp_path / "bar.toml"), Drafts(tmp_path / "bar.toml")
    before = TEXT.replace("until = 10.0", "until = 0.1")
    text = before.replace("[10.0, 0.0]", "[9.75, 0.0]")
    assert text != before
    kept.check_text(before)
    kept.run_motion(before, "a", 1)
    assert len(kept._codes) == 2  # of the start, and of the run with numbers as parameters, which has no forces either
    for _ in range(2):
        drawn, expected = kept.check_text(text), alone.check_text(text)
        assert {**drawn, "data": None} == {**expected, "data": None}
        assert drawn["data"]["scene"] == expected["data"]["scene"]
    moved, expected = kept.run_motion(text, "a", 2), alone.run_motion(text, "a", 2)
    assert moved == expected and len(kept._codes) == 2


@pytest.mark.slow
def test_another_number_needs_no_other_live_part_whose_sliders_are_those_of_the_file(tmp_path: Path) -> None:
    drafts, parts = Drafts(tmp_path / "bar.toml"), list[tuple[str, list[str], list[float]]]()
    for asked, place in enumerate(("[10.0, 0.0]", "[9.7, 0.0]")):
        text = TEXT.replace("until = 10.0", "until = 0.1").replace("[10.0, 0.0]", place)
        assert drafts.run_motion(text, "a", asked)["status"] == "ok"
        part = drafts.live_page_data(text, "a", asked)
        given = part["data"]["live"]["parameters"]
        sliders = [entry["name"] for entry in given if not entry.get("still")]
        parts.append((part["script"], sliders, part["data"]["live"]["p0"]))
    (first, sliders, before), (second, _, after) = parts
    assert first == second and before != after
    assert sliders[:3] == ["crank_mass", "coupler_mass", "rocker_mass"] and not any("joints" in x for x in sliders)


def chain_of_bars(count: int) -> str:
    """Return a chain of bars that hangs from the ground, whose damping is a parameter."""
    parts = ['[mechanism]\nname = "chain"\ngravity = [0.0, -9.81]\n\n[run]\nuntil = 0.05\n\n[parameters]\nm = 1.0\n']
    for k in range(count):
        ends = "points = { A = [0.0, 0.0], B = [0.3, 0.0] }\ncentre_of_mass = [0.15, 0.0]"
        parts.append(f'[bodies.b{k}]\nmass = "m"\ninertia = 0.01\n{ends}\nposition = [{0.3 * k!r}, 0.0]\n')
        other = f'["b{k - 1}", "b{k}"]\nat = ["B", "A"]' if k else '["ground", "b0"]\nat = [[0.0, 0.0], "A"]'
        parts.append(f'[joints.p{k}]\ntype = "revolute"\nbetween = {other}\n')
    return "\n".join(parts)


@pytest.mark.slow
def test_many_bodies_have_looped_code_in_the_page_and_another_number_compiles_nothing(tmp_path: Path) -> None:
    drafts, text = Drafts(tmp_path / "chain.toml"), chain_of_bars(24)
    assert drafts.run_motion(text, "a", 1)["status"] == "ok"
    made = drafts.live_page_data(text, "a", 1)
    assert "const indexTables = " in made["script"] and len(made["script"]) < 250_000
    other = text.replace("0.15", "0.16", 1)
    assert drafts.run_motion(other, "a", 2)["status"] == "ok"
    assert drafts.live_page_data(other, "a", 2)["script"] == made["script"]


def test_a_motion_waits_for_no_live_part(tmp_path: Path) -> None:
    drafts, text = Drafts(tmp_path / "bar.toml"), TEXT.replace("until = 10.0", "until = 0.1")
    assert drafts.run_motion(text, "a", 1)["status"] == "ok"
    with drafts._enlivening:  # as while a live part is made
        assert drafts.run_motion(text, "a", 2)["status"] == "ok"


@pytest.mark.slow
def test_a_motion_with_a_stop_is_that_of_a_run(tmp_path: Path) -> None:
    file = tmp_path / "stopped.toml"
    file.write_text(STOPPED, encoding="utf-8")
    moved, run = Drafts(file).run_motion(STOPPED, "a", 1), load(file).simulate()
    part = moved["data"]["motions"][0]
    q = np.frombuffer(base64.b64decode(part["q"]), "<f4").reshape(-1, part["count"])
    assert q[:, -1] == pytest.approx(run.q.values[-1], abs=1e-6)
    assert run.events and moved["status"] == run.status


def test_a_later_question_takes_the_place_of_an_earlier_one(tmp_path: Path) -> None:
    drafts, text = Drafts(tmp_path / "a.toml"), TEXT.replace("until = 10.0", "until = 0.1")
    assert drafts.run_motion(text, "a", 2)["status"] == "ok"
    assert drafts.run_motion(text, "a", 1) == {"superseded": True}
    assert drafts.run_motion(text, "b", 1)["status"] == "ok"


def test_characters_are_counted_as_pages_count_them(editor: Editor) -> None:
    text = "# \U0001f600\n" + TEXT
    span = done(editor, "check", text=text)["numbers"]["crank_mass"]
    assert text.encode("utf-16-le")[2 * span[0] : 2 * span[1]].decode("utf-16-le") == "2.0"


# -- the file ----------------------------------------------------------------------------------------------------------


def test_saving_changes_what_was_changed_and_nothing_else(editor: Editor) -> None:
    file = editor.document.path
    file.write_bytes(b"\xef\xbb\xbf" + TEXT.replace("\n", "\r\n").encode())
    before, loaded = file.read_bytes(), done(editor, "load")
    assert "\r" not in loaded["text"] and file.read_bytes() == before
    answer = done(editor, "save", text=loaded["text"].replace("[10.0, 0.0]", "[9.5, 0.0]"), digest=loaded["digest"])
    assert answer["saved"] and file.read_bytes() == before.replace(b"[10.0, 0.0]", b"[9.5, 0.0]")


def test_lines_with_two_kinds_of_ends_keep_theirs(tmp_path: Path) -> None:
    file = tmp_path / "mixed.toml"
    file.write_bytes(b"# a\r\n# b\nx = 1\r\n# c\n")
    document = Document(file)
    loaded = document.read()
    document.save(loaded["text"].replace("x = 1\n", "x = 2\ny = 3\n"), loaded["digest"], False)
    assert file.read_bytes() == b"# a\r\n# b\nx = 2\r\ny = 3\r\n# c\n"


def test_two_editors_of_one_file_ask_before_they_write_over_each_other(editor: Editor) -> None:
    other = Document(editor.document.path)
    first, second = done(editor, "load"), other.read()
    assert other.save(second["text"] + "# theirs\n", second["digest"], False)["saved"]
    assert done(editor, "save", text=first["text"] + "# ours\n", digest=first["digest"]) == {"changed": True}
    assert editor.document.path.read_text().endswith("# theirs\n")
    answer = done(editor, "save", text=first["text"] + "# ours\n", digest=first["digest"], force=True)
    assert answer["saved"] and editor.document.path.read_text().endswith("# ours\n")
    assert done(editor, "save", text=TEXT, digest=answer["digest"])["saved"]  # its own writing is no change of others


def test_a_file_that_went_away_is_a_change(editor: Editor) -> None:
    loaded = done(editor, "load")
    editor.document.path.unlink()
    assert done(editor, "save", text=TEXT, digest=loaded["digest"]) == {"changed": True}


def test_a_writing_that_is_cut_off_leaves_the_file(editor: Editor, monkeypatch: pytest.MonkeyPatch) -> None:
    loaded = done(editor, "load")

    def cut_off(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", cut_off)
    assert "No space left" in done(editor, "save", text="# new\n", digest=loaded["digest"])["error"]
    assert [path.name for path in editor.document.path.parent.iterdir()] == ["bar.toml"]
    assert editor.document.path.read_text() == TEXT


def test_ten_megabytes_are_one_sentence(editor: Editor, tmp_path: Path) -> None:
    large = "# " + "x" * 10_000_000
    (tmp_path / "large.toml").write_text(large)
    with pytest.raises(InputError, match="a file of at most 1000000 bytes"):
        Document(tmp_path / "large.toml")
    assert asked(editor, f"/{editor.secret}/check", b"", Content_Length=str(len(large))).status == 413
    within = "#" * (LARGEST_FILE + 1)
    for job in ("check", "save", "motion", "add"):
        assert "1000000 bytes" in done(editor, job, text=within)["error"]
    assert editor.document.path.read_text() == TEXT


# -- texts that are not saved ------------------------------------------------------------------------------------------


@pytest.fixture
def own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("SYMGEN_CACHE_DIR", str(tmp_path / "own"))
    return tmp_path / "own" / "unsaved"


def test_a_text_that_is_not_saved_is_offered_until_it_is(own_folder: Path, editor: Editor) -> None:
    ours = TEXT + "# ours\n"
    assert done(editor, "load")["unsaved"] == []
    assert done(editor, "keep", text=ours, tab="../../a") == {"kept": True}
    assert done(editor, "keep", text=ours + "# more\n", tab="b") == {"kept": True}
    (newest, other) = done(editor, "load")["unsaved"]
    assert (newest["page"], newest["text"]) == ("b", ours + "# more\n")
    assert (other["page"], other["text"]) == ("../../a", ours)
    inside = [path for path in own_folder.rglob("*") if path.is_file()]
    assert len(inside) == 2 and all(path.parent.parent == own_folder for path in inside)
    if os.name == "posix":
        assert {path.parent.stat().st_mode & 0o077 for path in inside} == {0}
    done(editor, "keep", text=TEXT, tab="b")  # as the file has it again
    done(editor, "save", text=ours, digest=done(editor, "load")["digest"])
    assert done(editor, "load")["unsaved"] == []
    done(editor, "forget", tab="../../a")
    assert not any(path.is_file() for path in own_folder.rglob("*"))


def test_texts_that_are_kept_are_bounded_and_remains_are_passed_over(own_folder: Path, editor: Editor) -> None:
    for k in range(25):
        done(editor, "keep", text=f"# {k}\n", tab=str(k))
    assert {entry["text"] for entry in done(editor, "load")["unsaved"]} >= {"# 24\n", "# 20\n"}
    files = sorted(own_folder.rglob("*.json"))
    assert len(files) == 20
    files[0].write_text("{")
    files[1].write_text('{"page": 1}')
    assert len(done(editor, "load")["unsaved"]) == 18
    assert done(editor, "keep", text="#" * (LARGEST_FILE + 1), tab="x") == {"kept": False}


def test_where_nothing_can_be_kept_the_page_is_told(own_folder: Path, editor: Editor) -> None:
    own_folder.parent.mkdir()
    own_folder.write_text("no folder")
    assert done(editor, "keep", text="# ours\n", tab="a") == {"kept": False}
    assert done(editor, "load")["unsaved"] == []


@pytest.mark.slow
def test_a_server_that_is_killed_loses_no_text(own_folder: Path, tmp_path: Path) -> None:
    command = [sys.executable, "-m", "symgen", "edit", "--new", "crane", "--no-browser"]
    for expected in ([], ["# mine\n"]):
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=tmp_path) as process:
            assert process.stdout is not None
            _, _, host, secret, _ = process.stdout.readline().strip().split("/")

            def ask(job: str, host: str = host, secret: str = secret, **given: object) -> Any:
                headers = {"Content-Type": "application/json", "Origin": f"http://{host}"}
                with closing(http.client.HTTPConnection(host, timeout=20)) as connection:
                    connection.request("POST", f"/{secret}/{job}", json.dumps(given), headers)
                    return json.loads(connection.getresponse().read())

            assert [entry["text"] for entry in ask("load")["unsaved"]] == expected
            assert ask("keep", text="# mine\n", tab="a") == {"kept": True}
            process.kill()
    assert not (tmp_path / "crane.toml").exists()


# -- the command -------------------------------------------------------------------------------------------------------


def test_documents_by_the_words_of_the_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    copy = Document.of_arguments("four-bar", None)
    assert copy.path == Path("four-bar.toml") and copy.read() == {"text": TEXT, "digest": ""}
    assert list(tmp_path.iterdir()) == []  # nothing is written before it is saved
    assert copy.save(TEXT, "", False)["saved"] and Path("four-bar.toml").read_text() == TEXT
    new = Document.of_arguments(None, "crane")
    assert 'name = "crane"' in new.read()["text"] and not Path("crane.toml").exists()
    assert Document.of_arguments("four-bar.toml", None).read()["digest"]


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ((), "--new NAME, got neither"),
        (("four-bar", "--new", "x"), "got both"),
        (("nowhere.toml",), "symgen edit --new nowhere begins one"),
        (("n-four-bar:3",), "a catalogue name without a size"),
        (("--new", "A b"), "name: expected"),
        (("taken", "--new", "taken"), "got both"),
        (("--new", "taken"), "symgen edit taken.toml"),
    ],
)
def test_refusals(
    cli: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: tuple[str, ...], sentence: str
) -> None:
    monkeypatch.chdir(tmp_path)
    shutil.copy(str(FOUR_BAR), "taken.toml")
    code, out, err = cli("edit", *words)
    assert code == 2 and out == "" and sentence in err


def test_a_port_that_is_taken_is_one_sentence(editor: Editor, cli: Any) -> None:
    code, _, err = cli("edit", editor.document.path, "--no-browser", "--port", editor.server_port)
    assert code == 2 and err.startswith("symgen: --port: expected a port that is free")


def test_an_error_of_the_editor_itself_is_said_and_shown_in_its_terminal(
    editor: Editor, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(_: object) -> dict[str, object]:
        raise KeyError("lost")

    monkeypatch.setitem(editor.jobs, "check", broken)
    assert "an error of its own, which its terminal shows" in done(editor, "check", text=TEXT)["error"]
    assert "KeyError: 'lost'" in capfd.readouterr().err


def test_a_pin_of_centres_of_mass_is_drawn(editor: Editor) -> None:
    two = TEXT + (
        "\n[bodies.other]\nmass = 1.0\ninertia = 0.1\n\n"
        '[joints.middle]\ntype = "revolute"\nbetween = ["crank", "other"]\nat = ["centre", "centre"]\n'
    )
    answer = done(editor, "check", text=two)
    assert answer["errors"] == [] and "joints.middle" not in [handle["name"] for handle in answer["handles"]]


@pytest.mark.slow
def test_killed_while_saving_leaves_one_text_or_the_other(tmp_path: Path) -> None:
    file = tmp_path / "bar.toml"
    texts = [TEXT + f"# {letter}\n" + f"# {letter}\n" * 20_000 for letter in "ab"]
    file.write_text(texts[0])
    for delay in (0.002, 0.01, 0.03):
        command = [sys.executable, "-m", "symgen", "edit", str(file), "--no-browser"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
            assert process.stdout is not None
            address = process.stdout.readline().strip()
            threading.Timer(delay, process.kill).start()
            host = address.split("/")[2]
            for k in range(1000):
                body = json.dumps({"text": texts[k % 2], "force": True})
                headers = {"Content-Type": "application/json", "Origin": f"http://{host}"}
                try:
                    with closing(http.client.HTTPConnection(host, timeout=10)) as connection:
                        connection.request("POST", f"/{address.split('/')[3]}/save", body, headers)
                        connection.getresponse().read()
                except (OSError, http.client.HTTPException):
                    break
            else:
                raise AssertionError("it was not killed")
        assert file.read_text() in texts


def test_drawn_tasks_that_are_none_are_refused(editor: Editor) -> None:
    def refused(job: str, **given: Any) -> str:
        return str(done(editor, job, tab="1", **given)["error"])

    spots = [{"x": float(k), "y": 0.0} for k in range(6)]
    assert "positions or path, got 'circle'" in refused("synthesize", part="circle", spots=spots)
    assert "three points with a direction each, got 4 points" in refused(
        "synthesize", part="positions", spots=spots[:4]
    )
    assert "a direction from each point" in refused("synthesize", part="positions", spots=[*spots[:5], spots[4]])
    assert "3 to 20 points, got 2" in refused("synthesize", part="path", spots=spots[:2])
    assert "draw its task once more" in refused("linkage", text=TEXT, asked=0)
