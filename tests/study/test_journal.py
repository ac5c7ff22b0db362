"""The journal of long studies and the runner: kills, torn lines, foreign files, two processes, processes that die."""

import json
import os
import signal
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

import pytest

from symgen.base.errors import InputError, SimulationError
from symgen.study.comparison.comparison_rows import check_entry, to_entry
from symgen.study.journal import HEADER, Journal, cell_key
from symgen.study.runner import Cell, Shares, run_cells
from symgen.study.stress.checked_entries import check_motion
from tests.study import killed_study
from tests.study.report.made import row, trace

ROOT = Path(__file__).resolve().parents[2]


def start(folder, processes):
    environment = {**os.environ, "PYTHONPATH": f"{ROOT}{os.pathsep}{os.environ.get('PYTHONPATH', '')}"}
    command = [sys.executable, "-m", "tests.study.killed_study", str(folder), str(processes)]
    return subprocess.Popen(
        command,
        cwd=ROOT,
        env=environment,
        stdout=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )


def recorded(folder):
    path = folder / "journal.jsonl"
    content = path.read_bytes() if path.exists() else b""
    return [json.loads(line)["key"] for line in content[: content.rfind(b"\n") + 1].split(b"\n")[1:-1]]


def traced(folder):
    path = folder / "trace.txt"
    return [int(line) for line in path.read_text().split() if line != "dies"] if path.exists() else []


def wait_for(condition, seconds=600.0):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "what was waited for did not happen"
        time.sleep(0.01)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("processes", [1, 2])
def test_killed_in_the_middle_and_resumed(tmp_path, processes):
    process = start(tmp_path, processes)
    wait_for(lambda: len(recorded(tmp_path)) >= 5)
    process.kill()
    process.communicate()
    before = recorded(tmp_path)
    assert 5 <= len(before) < killed_study.COUNT
    time.sleep(0.5)  # workers left behind would go on leaving traces
    left = len(traced(tmp_path))
    time.sleep(0.3)
    assert len(traced(tmp_path)) == left, "a worker outlived the study"

    begun = Counter(traced(tmp_path))
    again = start(tmp_path, processes)
    out, _ = again.communicate(timeout=600)
    assert (again.returncode, out.split()) == (0, [str(killed_study.COUNT), "False"])
    after = recorded(tmp_path)
    assert after[: len(before)] == before
    assert len(after) == len(set(after)) == killed_study.COUNT
    # nothing that was recorded is computed again; what was under way or not yet written at the kill is, once
    keys = {cell.key: cell.task[1] for cell in killed_study.cells(tmp_path)}
    repeated = Counter(traced(tmp_path)) - begun
    assert set(repeated).isdisjoint({keys[key] for key in before})
    assert all(count == 1 for count in repeated.values())
    assert sum(begun.values()) < killed_study.COUNT


@pytest.mark.slow
@pytest.mark.parametrize("processes", [1, 2])
def test_interrupted_keeps_what_is_done(tmp_path, processes):
    process = start(tmp_path, processes)
    wait_for(lambda: len(recorded(tmp_path)) >= 3)
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=600)
    done = recorded(tmp_path)
    assert process.returncode == 130
    assert out.split() == [str(len(done)), "True"]
    assert 3 <= len(done) < killed_study.COUNT


@pytest.mark.slow
def test_every_place_at_which_a_line_can_be_torn(tmp_path):
    path = tmp_path / "journal.jsonl"
    with Journal(path) as journal:
        for i in range(3):
            journal.add(cell_key(i=i), {"value": 0.1 + i, "text": 'a "quoted" é\n'})
    whole = path.read_bytes()
    for cut in range(len(whole) + 1):
        path.write_bytes(whole[:cut])
        complete = max(0, whole[:cut].count(b"\n") - 1)
        with Journal(path) as journal:
            assert len(journal) == complete
            journal.add("more", {"value": 1})
        with Journal(path) as journal:
            assert list(journal) == [cell_key(i=i) for i in range(complete)] + ["more"]
            assert all(journal.get(cell_key(i=i))["value"] == 0.1 + i for i in range(complete))


@pytest.mark.parametrize(
    "content", [b"name,value\n1,2\n", b"\x89PNG\r\n", b"no newline", HEADER.replace(b"1", b"999"), b"\n" + HEADER]
)
def test_a_foreign_file_is_refused_and_left_as_it_is(tmp_path, content):
    path = tmp_path / "other.txt"
    path.write_bytes(content)
    with pytest.raises(InputError, match="a journal of symgen, got something else in line 1"):
        Journal(path)
    assert path.read_bytes() == content


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("every", [3, pytest.param(1, marks=pytest.mark.slow)])
def test_of_bits_of_a_journal_none_changes_what_is_read(every, tmp_path):
    """Of every third one all eight of a byte come by as well."""
    path = tmp_path / "journal"
    cells = {f"cell{i}": {"value": 0.1 * i, "text": "é", "flag": None} for i in range(2)}
    with Journal(path) as journal:
        for key, outcome in cells.items():
            journal.add(key, outcome)
    whole = path.read_bytes()
    for i in range(8 * len(HEADER), 8 * len(whole), every):
        changed = bytearray(whole)
        changed[i // 8] ^= 1 << i % 8
        path.write_bytes(changed)
        with Journal(path) as journal:
            assert len(journal) < 3 and all(journal.get(key) == cells[key] for key in journal), i
            for key, outcome in cells.items():
                if key not in journal:
                    journal.add(key, outcome)
        with Journal(path) as journal:
            assert {key: journal.get(key) for key in journal} == cells


def test_lines_that_are_no_cells_are_left_out(tmp_path):
    path = tmp_path / "journal"
    path.write_bytes(HEADER + b'{"key": "a", "outcome": {"x": 1}}\n{"key": "b"}\n[1]\nnot json\n')
    with Journal(path) as journal:
        assert not list(journal)


def test_a_folder_a_pipe_and_a_missing_folder_are_refused(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for path in (tmp_path, tmp_path / "pipe"):
        with pytest.raises(InputError, match="a file, got a folder, a pipe or a device"):
            Journal(path)
    with pytest.raises(InputError, match="a file in a folder that exists"):
        Journal(tmp_path / "missing" / "journal.jsonl")
    assert [p.name for p in tmp_path.iterdir()] == ["pipe"]


def test_two_processes_do_not_share_a_journal(tmp_path):
    process = start(tmp_path, 1)
    wait_for(lambda: len(recorded(tmp_path)) >= 1)
    with pytest.raises(InputError, match="one that no other process uses"):
        Journal(tmp_path / "journal.jsonl")
    assert process.communicate(timeout=600)[0].split() == [str(killed_study.COUNT), "False"]
    with Journal(tmp_path / "journal.jsonl") as journal:
        assert len(journal) == killed_study.COUNT


def test_a_cell_is_kept_once_and_only_as_json(tmp_path):
    with Journal(tmp_path / "j") as journal:
        assert journal.add("a", {"pair": (1, 2.5)}) == {"pair": [1, 2.5]}
        with pytest.raises(ValueError, match="already"):
            journal.add("a", {})
        with pytest.raises(ValueError):
            journal.add("b", {"x": float("nan")})
        assert "b" not in journal
    with Journal(tmp_path / "j") as journal:
        assert list(journal) == ["a"]


def test_keys_tell_apart_whatever_differs():
    parts = [
        *({}, {"step": None}, {"step": 1e-3}, {"step": 1e-3 * (1 + 2**-52)}, {"step": "0.001"}, {"step": 1}),
        *({"step": 1.0}, {"rtol": 1e-3}, {"step": True}, {"step": [1e-3]}, {"step": [1, 2]}, {"step": [2, 1]}),
        *({"p": {"a": 1.0}}, {"p": {"a": 2.0}}, {"step": float("inf")}, {"step": float("nan")}),
    ]
    keys = [cell_key(**p) for p in parts]
    assert len(set(keys)) == len(keys)
    assert cell_key(a=1.0, b={"x": 1, "y": 2}) == cell_key(b={"y": 2, "x": 1}, a=1.0)
    with pytest.raises(TypeError):
        cell_key(model=object())


@pytest.mark.slow
def test_a_process_that_dies_ends_the_study_and_keeps_what_is_done(tmp_path):
    cells = [*killed_study.cells(tmp_path, 4), Cell("last", "group 9", (str(tmp_path), "dies"))]
    with Journal(tmp_path / "j") as journal:
        with pytest.raises(SimulationError, match="a process of the study died; a journal holds what was done before"):
            run_cells(cells, killed_study.compute, journal, processes=2)
        outcomes, interrupted = run_cells(cells[:4], killed_study.compute, journal)
    assert not interrupted and sorted(o["square"] for o in outcomes.values()) == [0, 1, 4, 9]
    assert Counter(traced(tmp_path)).most_common(1)[0][1] <= 2


def test_a_process_keeps_to_a_group_and_then_helps_with_the_longest():
    a, b, c = ([Cell(f"{name}{i}", name, None) for i in range(count)] for name, count in (("a", 2), ("b", 5), ("c", 1)))
    shares = Shares([*a, *b, *c])
    taken = [shares.next_cell(process).key for process in (0, 1, 0, 1, 0, 0, 0)]
    assert taken == ["a0", "b0", "a1", "b1", "c0", "b4", "b3"]
    assert shares.next_cell(1).key == "b2" and shares.next_cell(0) is None is shares.next_cell(1)


@pytest.mark.parametrize("processes", [1, 2])
def test_an_error_of_a_cell_ends_the_study_and_keeps_what_is_done(tmp_path, processes):
    with Journal(tmp_path / "j") as journal, pytest.raises(TypeError, match="can't multiply"):
        run_cells([Cell("a", "a", (str(tmp_path), "word"))], killed_study.compute, journal, processes)
    with Journal(tmp_path / "j") as journal:
        assert len(journal) == 0


def test_progress_counts_what_was_found_and_estimates_the_rest(tmp_path):
    journal, seen = Journal(), []
    cells = killed_study.cells(tmp_path, 6)
    run_cells(cells[:2], killed_study.compute, journal)
    run_cells(cells, killed_study.compute, journal, progress=seen.append)
    assert [s.done for s in seen] == [2, 3, 4, 5, 6]
    assert seen[0].seconds_left is None and seen[-1].seconds_left == 0.0
    # three cells of at least 0.05 s each are left after the first of four
    assert seen[1].seconds_left > 0.14
    assert sorted(traced(tmp_path)) == [0, 1, 2, 3, 4, 5]


@pytest.mark.parametrize("kind", ["link", "hard link", "content"])
def test_a_lock_that_is_a_file_of_somebody_else_is_refused(kind, tmp_path):
    """A lock is opened for writing: through a link `rows.lock` it emptied the file at its end."""
    precious, lock = tmp_path / "precious.txt", tmp_path / "rows.lock"
    precious.write_text("precious")
    {"link": lock.symlink_to, "hard link": lock.hardlink_to, "content": lambda _: lock.write_text("mine")}[kind](
        precious
    )
    before = lock.read_text()
    with pytest.raises(InputError, match=r"got 'rows\.lock', which is no lock of symgen"):
        Journal(tmp_path / "rows")
    assert (lock.read_text(), precious.read_text()) == (before, "precious") and not (tmp_path / "rows").exists()


def test_an_entry_of_somebody_else_is_shown_printable_or_computed_again(tmp_path):
    """Texts may hold what terminals act on; an entry of another form was a KeyError of the report."""
    path = tmp_path / "rows"
    with Journal(path) as journal:
        journal.add("a", {"status": "no such", "reason": "\x1b]0;owned\x07\u202e", "more": [{"note": "\x9b31m"}]})
    with Journal(path) as journal:
        entry = journal.get("a")
        assert entry["reason"] == "\\x1b]0;owned\\x07\\u202e" and entry["more"] == [{"note": "\\x9b31m"}]

        def check(outcome):
            if outcome["status"] != "ok":
                raise ValueError

        for _ in range(2):
            outcomes, _ = run_cells([Cell("a", "", 3, check=check)], lambda task: {"status": "ok", "n": task}, journal)
            assert outcomes == {"a": {"status": "ok", "n": 3}}
    with Journal(path) as journal:
        assert journal.get("a") == {"status": "ok", "n": 3}


@pytest.mark.parametrize("change", [{"status": "no such"}, {"status": 3}, {"run_seconds": "much"}, {"unknown": 1}])
def test_a_row_of_a_comparison_that_is_none_is_refused(change):
    entry = to_entry(row("lagrange", 1e-3, float("nan"), 0.1), trace())
    check_entry(json.loads(json.dumps(entry)))
    with pytest.raises(ValueError):
        check_entry({**entry, "row": {**entry["row"], **change}})


NOT_OF_A_REFERENCE = (
    *({"how": 3}, {"q": [[0.0], [0.0, 1.0]]}, {"q": "much"}),
    *({"length": "large"}, {"unusable": 3}, {"decay": None}),
)


@pytest.mark.parametrize("change", NOT_OF_A_REFERENCE)
def test_a_reference_of_a_stress_study_that_is_none_is_refused(change):
    motion = {"unusable": None, "how": "closed form", "estimated_error": 0.0, "q": [[0.0, 1.0], [1.0, 2.0]]}
    motion |= {"decay": 0.0, "sines": [1.0, 1.0], "length": 1.0, "parameters": {"k": 2}}
    check_motion(json.loads(json.dumps(motion)))
    check_motion({"unusable": "a singular position"})
    with pytest.raises(ValueError):
        check_motion({**motion, **change})
