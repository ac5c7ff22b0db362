import os
import random
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import pytest

from symgen.base.errors import SymgenError
from symgen.compile.store import private, upkeep
from symgen.compile.store.entries import Entries, folder_name, get_or_make_data
from symgen.compile.store.paths import cache_location

FOLDER = "four-bar_0123456789abcdef_1"
SOURCE = "answer = 42\n"
EMPTY = upkeep.CacheInfo(0, 0, 0)
PROJECT = Path(__file__).parents[3]


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
    def test_a_long_digest_is_cut(self):
        assert folder_name("arm", "ab" * 32, 2) == "arm_abababababababab_2"
        assert folder_name(FOLDER, "f" * 16, 3) == f"{FOLDER}_{'f' * 16}_3"

    @pytest.mark.parametrize("name", ["", "../up", "a/b", "a.b", "-x", "ä", "a" * 65, "a b"])
    def test_bad_names_are_refused(self, name):
        with pytest.raises(ValueError, match="is not a folder name"):
            folder_name(name, "0" * 16, 1)

    @pytest.mark.parametrize(
        "text", ["", "x", "x_123_1", f"{FOLDER}\n", "x_0123456789ABCDEF_1", "x_0123456789abcdef_01"]
    )
    def test_other_folders_are_not_ours(self, text, entries):
        with pytest.raises(ValueError, match="is not a folder name"):
            entries.path(text, "model")


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

    def test_nan_is_refused_before_anything_is_written(self, entries):
        with pytest.raises(ValueError, match="JSON"):
            entries.put(FOLDER, "model", SOURCE, {"x": float("nan")})
        assert not entries.path(FOLDER, "model").exists()

    @pytest.mark.parametrize(("folder", "stem"), [("up", "model"), (FOLDER, "../x"), (FOLDER, "a b"), (FOLDER, "")])
    def test_names_that_lead_elsewhere_are_refused(self, entries, folder, stem):
        with pytest.raises(ValueError, match="is not"):
            entries.put(folder, stem, SOURCE, {})


WRITER = """
import itertools, sys
from pathlib import Path
from symgen.compile.store import private
from symgen.compile.store.entries import Entries
entries = Entries()
private_file = entries.root / "native" / "x" / "f.bin"
for i in itertools.count():
    if i == int(sys.argv[2]):
        print("ready", flush=True)
    for stem in ("model", "lagrange"):
        source = f"i = {i}\\n" * (1 + i % 3000)
        with entries.lock_folder(sys.argv[1]):
            entries.put(sys.argv[1], stem, source, {"i": i, "length": len(source)})
    private.write(private_file, "key", bytes([i % 256]) * 100000)
"""


@pytest.mark.slow
def test_a_kill_at_any_moment_leaves_a_valid_pair_or_a_miss(entries):
    chance = random.Random(1)
    file = entries.root / upkeep.NATIVE / "x" / "f.bin"
    valid = 0
    for kill in range(8):
        process = start(WRITER, FOLDER, kill % 2)  # some are killed at the first writing, others behind it
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
        data = private.read_entry(file, "key")
        assert data is None or (len(data) == 100000 and len(set(data)) == 1)
    assert valid  # else nothing was tested
    with entries.lock_folder(FOLDER):  # the lock of a killed process is free
        entries.put(FOLDER, "model", SOURCE, {})
    assert entries.get(FOLDER, "model") == {}


def test_what_a_killed_process_left_is_removed_after_a_while(entries, monkeypatch):
    entries.put(FOLDER, "model", SOURCE, {})
    private.write_entry(entries.root / upkeep.NATIVE / "x" / "f.bin", "key", b"")
    left = [entries.path(FOLDER, "model").with_name(".tmp-1"), entries.root / upkeep.NATIVE / "x" / ".tmp-2"]
    for path in left:
        path.write_text("half")
    upkeep.prune_cache(entries.root, upkeep.LIMIT)
    assert all(path.exists() for path in left)  # it may still be being written
    monkeypatch.setattr(upkeep, "_ABANDONED", 0.0)
    upkeep.prune_cache(entries.root, upkeep.LIMIT)
    assert not any(path.exists() for path in left)


BUILDER = """
import sys, time
from symgen.compile.store.entries import Entries
entries = Entries()
folder, log = sys.argv[1:]
with entries.lock_folder(folder):
    if entries.get(folder, "model") is None:
        with open(log, "a") as file:
            file.write("made ")
        time.sleep(0.3)
        entries.put(folder, "model", "answer = 42\\n", {"made": True})
assert entries.get(folder, "model") == {"made": True}
"""


@pytest.mark.slow
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
from symgen.compile.store.entries import Entries
entries = Entries()
print("ready", flush=True)
for i in range(60):
    with entries.lock_folder(sys.argv[1]):
        entries.put(sys.argv[1], "model", f"i = {i}", {"i": i})
        assert entries.get(sys.argv[1], "model") == {"i": i}, i
"""


@pytest.mark.slow
def test_clearing_while_another_process_generates(entries):
    process = start(GENERATOR, FOLDER)
    assert process.stdout is not None
    process.stdout.readline()
    rounds = 0
    while process.poll() is None:
        upkeep.clear_cache(entries.root)
        rounds += 1
    process.stdout.close()
    assert process.returncode == 0
    assert rounds > 3
    upkeep.clear_cache(entries.root)
    assert upkeep.cache_info(entries.root) == EMPTY


class TestUpkeep:
    def fill(self, entries: Entries) -> None:
        entries.put(FOLDER, "model", SOURCE, {})
        entries.put(FOLDER, "lagrange", SOURCE * 2, {})
        private.write_entry(entries.root / upkeep.NATIVE / "package.module" / "f-1.bin", "key", b"x" * 1000)
        private.write_entry(entries.root / upkeep.BYTECODE / "model-1.bin", "key", b"x" * 100)

    def test_info(self, entries):
        assert upkeep.cache_info(entries.root) == EMPTY
        self.fill(entries)
        files = [path for path in entries.root.rglob("*") if path.is_file() and path.suffix in (".py", ".json", ".bin")]
        assert upkeep.cache_info(entries.root) == upkeep.CacheInfo(2, 1, sum(path.stat().st_size for path in files))

    def test_clear_removes_everything_of_ours_and_nothing_else(self, entries):
        self.fill(entries)
        with entries.lock_folder(FOLDER):
            pass
        foreign = [
            entries.root / "thesis.tex",
            entries.root / "models" / "notes.py",
            entries.root / "models" / FOLDER / "notes.txt",
            entries.root / "native" / "mine.o",
        ]
        for path in foreign:
            path.write_text("precious")
        upkeep.clear_cache(entries.root)
        assert upkeep.cache_info(entries.root) == EMPTY
        left = sorted(path for path in entries.root.rglob("*") if path.is_file())
        lock = entries.root / "locks" / f"{FOLDER}.lock"
        assert left == sorted([*foreign, entries.root / "CACHEDIR.TAG", lock])

    def test_clear_leaves_nothing_but_the_tag_and_the_locks(self, entries):
        self.fill(entries)
        with entries.lock_folder(FOLDER):
            pass
        upkeep.clear_cache(entries.root)
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
        total = upkeep.cache_info(entries.root).bytes
        upkeep.prune_cache(entries.root, total)
        assert upkeep.cache_info(entries.root) == upkeep.CacheInfo(2, 1, total)
        upkeep.prune_cache(entries.root, total - 1)
        left = upkeep.cache_info(entries.root)
        assert left.bytes < total and left.entries == 2  # the byte code went
        entries.get(FOLDER, "model")  # now lagrange is the older one
        upkeep.prune_cache(entries.root, left.bytes - 1)
        assert entries.get(FOLDER, "model") == {}
        assert entries.get(FOLDER, "lagrange") is None
        assert not entries.path(FOLDER, "lagrange").exists()
        upkeep.prune_cache(entries.root, 0)
        assert upkeep.cache_info(entries.root) == EMPTY

    def test_a_process_that_writes_much_prunes_now_and_then(self, entries, monkeypatch):
        monkeypatch.setattr(upkeep, "LIMIT", 20_000)
        rounds, prune = [], upkeep.prune_cache
        monkeypatch.setattr(upkeep, "prune_cache", lambda *a: rounds.append(a) or prune(*a))
        for i in range(120):
            if i % 2 == 0:
                entries.put(FOLDER, f"law{i}", "#" * 400, {})
            else:
                get_or_make_data(f"{upkeep.NATIVE}/package", "f", f"{i}", lambda: b"x" * 600)
            assert upkeep.cache_info(entries.root).bytes <= 22_000 + 600
        assert entries.get(FOLDER, "law118") == {}  # the newest stays
        assert upkeep.cache_info(entries.root).bytes > 10_000
        assert 10 < len(rounds) < 60  # not at every entry

    def test_the_cache_is_pruned_once_a_day(self, entries, monkeypatch):
        rounds = []
        monkeypatch.setattr(upkeep, "prune_cache", lambda *a: rounds.append(a))
        pruned = entries.root / upkeep.LOCKS / "pruned"
        for age in (None, None, 90_000, -90_000):
            if age is not None:
                os.utime(pruned, (time.time() - age,) * 2)
            entries.put(FOLDER, "model", SOURCE, {})
        assert len(rounds) == 3
        pruned.unlink()
        pruned.mkdir()
        entries.put(FOLDER, "lagrange", SOURCE, {})
        assert entries.get(FOLDER, "lagrange") == {}


class TestWhatIsNoCacheFolder:
    """The cache cannot be written in some way: a temporary folder takes its place, with what there was."""

    def test_a_full_disk(self, entries, monkeypatch):
        entries.put(FOLDER, "model", SOURCE, {"a": 1})
        old, real = entries.root, os.replace

        def full(source, target):
            if str(target).startswith(str(old)):
                raise OSError(28, "No space left on device")
            real(source, target)

        monkeypatch.setattr(os, "replace", full)
        entries.put(FOLDER, "lagrange", SOURCE, {"b": 2})
        assert entries.root != old and cache_location().path == entries.root and not cache_location().persistent
        assert cache_location().reason == (f"the cache folder '{old}' cannot be written (No space left on device)")
        # a law imports its model: both are in the new folder
        assert entries.get(FOLDER, "model") == {"a": 1} and entries.get(FOLDER, "lagrange") == {"b": 2}
        assert Entries().get(FOLDER, "lagrange") == {"b": 2}
        assert not list(old.rglob(".tmp-*"))

    def test_no_temporary_folder_either(self, entries, monkeypatch):
        def full(*_: object, **__: object) -> None:
            raise OSError(28, "No space left on device")

        monkeypatch.setattr(os, "replace", full)
        with pytest.raises(SymgenError, match=r"the cache folder '.*symgen-.*' cannot be written \(No space left on"):
            entries.put(FOLDER, "model", SOURCE, {})
        monkeypatch.setattr(tempfile, "mkdtemp", full)
        with pytest.raises(SymgenError, match=r"and no temporary folder can be made \(No space left on device\)"):
            entries.put(FOLDER, "model", SOURCE, {})

    @pytest.mark.parametrize("place", ["models", f"models/{FOLDER}", f"models/{FOLDER}/model.py", "model.json"])
    @pytest.mark.parametrize("kind", ["pipe", "folder", "socket", "loop", "foreign"])
    def test_something_else_in_a_place_of_the_cache(self, entries, place, kind, monkeypatch):
        path = entries.root / (f"models/{FOLDER}/model.json" if place == "model.json" else place)
        path.parent.mkdir(parents=True, mode=0o700, exist_ok=True)
        (entries.root / "models").chmod(0o700) if (entries.root / "models").exists() else None
        if kind == "pipe":
            os.mkfifo(path)
        elif kind == "folder":
            (path / "precious").mkdir(parents=True)
        elif kind == "socket":
            server = socket.socket(socket.AF_UNIX)
            monkeypatch.chdir(path.parent)  # names of sockets are short
            server.bind(path.name)
            server.close()
        elif kind == "loop":
            path.symlink_to(path.name)
        else:
            path.mkdir() if path.suffix == "" else path.write_text("{}")
            path.chmod(0o777)
        assert entries.get(FOLDER, "model") is None
        entries.put(FOLDER, "model", SOURCE, {"x": 1})
        assert entries.get(FOLDER, "model") == {"x": 1}
        assert entries.path(FOLDER, "model").read_text() == SOURCE
        with entries.lock_folder(FOLDER):
            pass
        if kind == "folder":
            assert (path / "precious").is_dir()


def test_a_flipped_bit_of_a_pair_changes_nothing_that_is_read(entries):
    """Every third bit, which are all eight of a byte in turn."""
    metadata = {"sizes": [3, 4.5, None], "names": ["q1", "ä"], "flag": True}
    entries.put(FOLDER, "model", SOURCE, metadata)
    files = [entries.path(FOLDER, "model").with_suffix(suffix) for suffix in (".py", ".json")]
    contents = [path.read_bytes() for path in files]
    for path, content in zip(files, contents, strict=True):
        for i in range(0, 8 * len(content), 3):
            changed = bytearray(content)
            changed[i // 8] ^= 1 << i % 8
            path.write_bytes(changed)
            found = entries.get(FOLDER, "model")
            assert found is None or found == metadata, i
            for each, whole in zip(files, contents, strict=True):
                each.write_bytes(whole)
                each.chmod(0o600)
    assert entries.get(FOLDER, "model") == metadata


def test_a_pair_in_the_place_of_another_is_a_miss(entries):
    other = FOLDER.replace("0", "1")
    entries.put(FOLDER, "model", SOURCE, {"a": 1})
    entries.put(FOLDER, "lagrange", SOURCE, {"b": 1})
    entries.put(other, "model", SOURCE, {"c": 1})
    source = entries.path(FOLDER, "model").with_suffix(".json").read_bytes()
    for folder, stem in ((FOLDER, "lagrange"), (other, "model")):
        entries.path(folder, stem).with_suffix(".json").write_bytes(source)
        assert entries.get(folder, stem) is None
