from __future__ import annotations

import json
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from symgen.errors import SymgenError
from symgen.store import private, upkeep
from symgen.store.entries import Entries, FolderName

FOLDER = "four-bar_0123456789abcdef_1"
SOURCE = "answer = 42\n"
PROJECT = Path(__file__).parents[2]


@pytest.fixture
def entries(cache: Path) -> Entries:
    return Entries()


def start(script: str, *arguments: object) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-c", script, *map(str, arguments)],
        env={**os.environ, "PYTHONPATH": str(PROJECT)},
        stdout=subprocess.PIPE,
        text=True,
    )


class TestFolderName:
    # making strings for a pattern is slow at first, while tests run beside each other
    @settings(suppress_health_check=[HealthCheck.too_slow], deadline=None)
    @given(
        st.from_regex(r"[A-Za-z0-9][A-Za-z0-9_-]{0,63}", fullmatch=True),
        st.from_regex(r"[0-9a-f]{16}", fullmatch=True),
        st.integers(0, 999999),
    )
    def test_round_trip(self, name, digest, number):
        parts = FolderName(name, digest, number)
        assert FolderName.parse(str(parts)) == parts

    def test_a_long_digest_is_cut(self):
        assert str(FolderName("arm", "ab" * 32, 2)) == "arm_abababababababab_2"

    def test_a_name_that_looks_like_a_folder_keeps_its_parts(self):
        parts = FolderName(FOLDER, "f" * 16, 3)
        assert FolderName.parse(str(parts)) == parts

    @pytest.mark.parametrize("name", ["", "../up", "a/b", "a.b", "-x", "ä", "a" * 65, "a b"])
    def test_bad_names_are_refused(self, name):
        with pytest.raises(ValueError, match="is not a folder name"):
            str(FolderName(name, "0" * 16, 1))

    @pytest.mark.parametrize(
        "text", ["", "x", "x_123_1", f"{FOLDER}\n", "x_0123456789ABCDEF_1", "x_0123456789abcdef_01"]
    )
    def test_other_folders_are_not_ours(self, text):
        assert FolderName.parse(text) is None


class TestPairs:
    def test_round_trip(self, entries):
        assert entries.get(FOLDER, "model") is None
        metadata = {"sizes": {"q": 3}, "names": ["q1", "ä"], "law": None}
        entries.put(FOLDER, "model", SOURCE, metadata)
        assert entries.get(FOLDER, "model") == metadata
        assert entries.path(FOLDER, "model").read_text() == SOURCE
        assert entries.get(FOLDER, "lagrange") is None

    def test_the_same_content_gives_the_same_bytes(self, entries):
        path = entries.path(FOLDER, "model").with_suffix(".json")
        entries.put(FOLDER, "model", SOURCE, {"a": 1, "b": 2})
        first = path.read_bytes()
        entries.put(FOLDER, "model", SOURCE, {"b": 2, "a": 1})
        assert path.read_bytes() == first

    @pytest.mark.parametrize("suffix", [".py", ".json"])
    @pytest.mark.parametrize("damage", ["truncated", "empty", "missing", "garbage", "nul", "others may write"])
    def test_damage_is_a_miss_and_can_be_written_over(self, entries, suffix, damage):
        entries.put(FOLDER, "model", SOURCE, {})
        path = entries.path(FOLDER, "model").with_suffix(suffix)
        content = path.read_bytes()
        if damage == "missing":
            path.unlink()
        elif damage == "others may write":
            path.chmod(0o666)
        else:
            path.write_bytes({"truncated": content[:-3], "empty": b"", "garbage": b"\xff{[", "nul": b"\0"}[damage])
        assert entries.get(FOLDER, "model") is None
        entries.put(FOLDER, "model", SOURCE, {})
        assert entries.get(FOLDER, "model") == {}

    @pytest.mark.parametrize(
        "text",
        [
            "null",
            "[]",
            "{}",
            '{"format": 1}',
            '{"format": 0}',
            '{"format": 1, "sha256": "", "metadata": {}}',
            "[" * 9999,
        ],
    )
    def test_odd_descriptions_are_a_miss(self, entries, text):
        entries.put(FOLDER, "model", SOURCE, {})
        entries.path(FOLDER, "model").with_suffix(".json").write_text(text)
        assert entries.get(FOLDER, "model") is None

    def test_another_format_is_a_miss(self, entries):
        entries.put(FOLDER, "model", SOURCE, {})
        path = entries.path(FOLDER, "model").with_suffix(".json")
        path.write_text(json.dumps({**json.loads(path.read_text()), "format": 2}))
        assert entries.get(FOLDER, "model") is None

    def test_nan_is_refused_before_anything_is_written(self, entries):
        with pytest.raises(ValueError, match="JSON"):
            entries.put(FOLDER, "model", SOURCE, {"x": float("nan")})
        assert not entries.path(FOLDER, "model").exists()

    @pytest.mark.parametrize(("folder", "stem"), [("up", "model"), (FOLDER, "../x"), (FOLDER, "a b"), (FOLDER, "")])
    def test_names_that_lead_elsewhere_are_refused(self, entries, folder, stem):
        with pytest.raises(ValueError, match="is not"):
            entries.put(folder, stem, SOURCE, {})

    def test_a_folder_that_cannot_be_written_is_said(self, entries, monkeypatch):
        def full(*_: object) -> None:
            raise OSError(28, "No space left on device")

        monkeypatch.setattr(os, "replace", full)
        with pytest.raises(SymgenError) as error:
            entries.put(FOLDER, "model", SOURCE, {})
        assert str(error.value) == (
            f"The cache folder '{entries.root}' cannot be written (No space left on device); "
            "set SYMGEN_CACHE_DIR to another folder."
        )


WRITER = """
import itertools, sys
from pathlib import Path
from symgen.store import private
from symgen.store.entries import Entries
entries = Entries()
private_file = entries.root / "native" / "x" / "f.bin"
print("ready", flush=True)
for i in itertools.count():
    for stem in ("model", "lagrange"):
        source = f"i = {i}\\n" * (1 + i % 3000)
        with entries.building(sys.argv[1]):
            entries.put(sys.argv[1], stem, source, {"i": i, "length": len(source)})
    private.write(private_file, "key", bytes([i % 256]) * 100000)
"""


def test_a_kill_at_any_moment_leaves_a_valid_pair_or_a_miss(entries):
    chance = random.Random(1)
    file = entries.root / upkeep.NATIVE / "x" / "f.bin"
    valid = 0
    for _ in range(8):
        process = start(WRITER, FOLDER)
        assert process.stdout is not None
        process.stdout.readline()
        time.sleep(chance.uniform(0.001, 0.06))
        process.send_signal(signal.SIGKILL)
        process.wait()
        process.stdout.close()
        for stem in ("model", "lagrange"):
            metadata = entries.get(FOLDER, stem)
            if metadata is not None:
                valid += 1
                source = entries.path(FOLDER, stem).read_text()
                assert len(source) == metadata["length"]
                assert source.startswith(f"i = {metadata['i']}\n")
        data = private.read(file, "key")
        assert data is None or (len(data) == 100000 and len(set(data)) == 1)
    assert valid  # else nothing was tested
    with entries.building(FOLDER):  # the lock of a killed process is free
        entries.put(FOLDER, "model", SOURCE, {})
    assert entries.get(FOLDER, "model") == {}


def test_what_a_killed_process_left_is_removed_after_a_while(entries, monkeypatch):
    entries.put(FOLDER, "model", SOURCE, {})
    private.write(entries.root / upkeep.NATIVE / "x" / "f.bin", "key", b"")
    left = [entries.path(FOLDER, "model").with_name(".tmp-1"), entries.root / upkeep.NATIVE / "x" / ".tmp-2"]
    for path in left:
        path.write_text("half")
    entries.prune()
    assert all(path.exists() for path in left)  # it may still be being written
    monkeypatch.setattr(upkeep, "_ABANDONED", 0.0)
    entries.prune()
    assert not any(path.exists() for path in left)


BUILDER = """
import sys, time
from symgen.store.entries import Entries
entries = Entries()
folder, log = sys.argv[1:]
with entries.building(folder):
    if entries.get(folder, "model") is None:
        with open(log, "a") as file:
            file.write("made ")
        time.sleep(0.3)
        entries.put(folder, "model", "answer = 42\\n", {"made": True})
assert entries.get(folder, "model") == {"made": True}
"""


def test_the_second_of_two_processes_waits_and_finds_the_entry(entries, tmp_path):
    log = tmp_path / "log"
    processes = [start(BUILDER, FOLDER, log) for _ in range(3)]
    assert [process.wait() for process in processes] == [0, 0, 0]
    assert log.read_text() == "made "
    for process in processes:
        assert process.stdout is not None
        process.stdout.close()


GENERATOR = """
import sys
from symgen.store.entries import Entries
entries = Entries()
print("ready", flush=True)
for i in range(60):
    with entries.building(sys.argv[1]):
        entries.put(sys.argv[1], "model", f"i = {i}", {"i": i})
        assert entries.get(sys.argv[1], "model") == {"i": i}, i
"""


def test_clearing_while_another_process_generates(entries):
    process = start(GENERATOR, FOLDER)
    assert process.stdout is not None
    process.stdout.readline()
    rounds = 0
    while process.poll() is None:
        entries.clear()
        rounds += 1
    process.stdout.close()
    assert process.returncode == 0
    assert rounds > 3
    assert entries.clear() == upkeep.CacheInfo(0, 0, 0)


class TestUpkeep:
    def fill(self, entries: Entries) -> None:
        entries.put(FOLDER, "model", SOURCE, {})
        entries.put(FOLDER, "lagrange", SOURCE * 2, {})
        private.write(entries.root / upkeep.NATIVE / "package.module" / "f-1.bin", "key", b"x" * 1000)
        private.write(entries.root / upkeep.BYTECODE / "model-1.bin", "key", b"x" * 100)

    def test_info(self, entries):
        assert entries.info() == upkeep.CacheInfo(0, 0, 0)
        self.fill(entries)
        files = [path for path in entries.root.rglob("*") if path.is_file() and path.suffix in (".py", ".json", ".bin")]
        assert entries.info() == upkeep.CacheInfo(2, 1, sum(path.stat().st_size for path in files))

    def test_clear_removes_everything_of_ours_and_nothing_else(self, entries):
        self.fill(entries)
        with entries.building(FOLDER):
            pass
        foreign = [
            entries.root / "thesis.tex",
            entries.root / "models" / "notes.py",
            entries.root / "models" / FOLDER / "notes.txt",
            entries.root / "native" / "mine.o",
        ]
        for path in foreign:
            path.write_text("precious")
        assert entries.clear() == upkeep.CacheInfo(0, 0, 0)
        left = sorted(path for path in entries.root.rglob("*") if path.is_file())
        lock = entries.root / "locks" / f"{FOLDER}.lock"
        assert left == sorted([*foreign, entries.root / "CACHEDIR.TAG", lock])

    def test_clear_leaves_nothing_but_the_tag_and_the_locks(self, entries):
        self.fill(entries)
        with entries.building(FOLDER):
            pass
        entries.clear()
        assert sorted(path.name for path in entries.root.iterdir()) == ["CACHEDIR.TAG", "locks"]

    def test_prune_removes_what_was_not_used_for_longest(self, entries):
        self.fill(entries)
        for age, path in enumerate(
            [
                entries.root / upkeep.NATIVE / "package.module" / "f-1.bin",
                entries.path(FOLDER, "lagrange").with_suffix(".json"),
                entries.path(FOLDER, "model").with_suffix(".json"),
                entries.root / upkeep.BYTECODE / "model-1.bin",
            ]
        ):
            os.utime(path, (1e9 - age * 1000, 1e9 - age * 1000))
        total = entries.info().bytes
        assert entries.prune(total) == entries.info() == upkeep.CacheInfo(2, 1, total)
        assert entries.prune(total - 1).bytes < total  # the byte code went
        assert entries.info().entries == 2
        entries.get(FOLDER, "model")  # now lagrange is the older one
        entries.prune(entries.info().bytes - 1)
        assert entries.get(FOLDER, "model") == {}
        assert entries.get(FOLDER, "lagrange") is None
        assert not entries.path(FOLDER, "lagrange").exists()
        assert entries.prune(0) == upkeep.CacheInfo(0, 0, 0)

    def test_the_limit_is_looked_at_once_a_day(self, entries, monkeypatch):
        pruned = []
        monkeypatch.setattr(upkeep, "prune", lambda root: pruned.append(root))
        entries.put(FOLDER, "model", SOURCE, {})
        entries.put(FOLDER, "model", SOURCE, {})
        assert pruned == [entries.root]
        os.utime(entries.root / "pruned", (0, 0))
        entries.put(FOLDER, "model", SOURCE, {})
        assert len(pruned) == 2
