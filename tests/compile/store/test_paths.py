import os
import stat
from pathlib import Path

import pytest

from symgen.compile.store import paths, private


def mode(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


def test_folder_named_by_the_environment_is_made_for_the_user_only(cache):
    location = paths.cache_location()
    assert location == paths.CacheLocation(cache, persistent=True)
    assert paths.cache_root() == cache
    assert mode(cache) == 0o700
    assert (cache / "CACHEDIR.TAG").read_text().startswith("Signature: 8a477f597d28d172789f06886806bc55")


def test_user_folder_is_the_default(tmp_path, monkeypatch):
    monkeypatch.delenv("SYMGEN_CACHE_DIR", raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "xdg"))
    monkeypatch.setattr(paths, "_locations", {})
    assert paths.cache_root() == tmp_path / "xdg" / "symgen"
    assert mode(tmp_path / "xdg") == 0o700


def test_home_that_cannot_be_written_means_a_temporary_folder(tmp_path, python):
    home = tmp_path / "home"
    home.write_text("a file in the place of the home folder")
    script = """
import json, os
from symgen.compile.store.paths import cache_location
from symgen.compile.store.entries import Entries
location = cache_location()
Entries().put("m_0123456789abcdef_1", "model", "x = 1", {})
found = Entries().get("m_0123456789abcdef_1", "model")
print(json.dumps([str(location.path), location.persistent, location.reason, found]))
"""
    path, persistent, reason, found = python(script, HOME=str(home), XDG_CACHE_HOME="", SYMGEN_CACHE_DIR="")
    assert not persistent
    assert "cannot be written" in reason and "home" in reason
    assert found == {}
    assert not Path(path).exists()  # removed when the process ended


@pytest.mark.parametrize("rights", [0o770, 0o777, 0o720])
def test_folder_that_others_can_change_is_not_used(cache, rights):
    cache.mkdir()
    cache.chmod(rights)
    location = paths.cache_location()
    assert not location.persistent
    assert location.path != cache
    assert location.reason == f"the cache folder '{cache}' belongs to, or can be changed by, somebody else"


def test_folder_of_somebody_else_is_not_used(cache, monkeypatch):
    cache.mkdir(mode=0o700)
    user = os.geteuid()
    monkeypatch.setattr(os, "geteuid", lambda: user + 1)
    assert not paths.cache_location().persistent


def test_read_only_folder_is_not_used(cache, monkeypatch):
    # The superuser may write into any folder of an ordinary file system, hence /proc.
    if os.geteuid() == 0:
        cache = Path("/proc")
        monkeypatch.setenv("SYMGEN_CACHE_DIR", str(cache))
    else:
        cache.mkdir(mode=0o500)
    location = paths.cache_location()
    assert not location.persistent
    assert location.reason.startswith(f"the cache folder '{cache}' cannot be written")


def test_file_instead_of_a_folder_is_not_used(cache):
    cache.write_text("")
    location = paths.cache_location()
    assert location.reason == f"the cache folder '{cache}' is not a folder"
    assert cache.read_text() == ""


class TestPrivateFiles:
    @pytest.fixture
    def path(self, tmp_path: Path) -> Path:
        return tmp_path / "deep" / "folder" / "file.bin"

    def test_round_trip(self, path):
        assert private.read_entry(path, "key") is None
        private.write_entry(path, "key", b"data")
        assert private.read_entry(path, "key") == b"data"
        assert mode(path) == 0o600
        assert mode(path.parent) == mode(path.parent.parent) == 0o700

    @pytest.mark.parametrize("length", [0, 5, 40, -1])
    def test_truncated_file_is_a_miss_and_removed(self, path, length):
        private.write_entry(path, "key", b"some data")
        path.write_bytes(path.read_bytes()[:length])
        assert private.read_entry(path, "key") is None
        assert not path.exists()

    def test_every_changed_byte_is_noticed(self, path):
        private.write_entry(path, "key", b"some data")
        good = path.read_bytes()
        for place in range(len(good)):
            path.write_bytes(good[:place] + bytes([good[place] ^ 1]) + good[place + 1 :])
            assert private.read_entry(path, "key") is None

    def test_file_of_another_key_is_a_miss(self, path):
        private.write_entry(path, "key", b"data")
        assert private.read_entry(path, "other key") is None

    def test_file_that_others_can_write_is_a_miss(self, path):
        private.write_entry(path, "key", b"data")
        path.chmod(0o620)
        assert private.read_entry(path, "key") is None

    def test_folder_that_others_can_enter_is_a_miss(self, path):
        private.write_entry(path, "key", b"data")
        path.parent.chmod(0o755)
        assert private.read_entry(path, "key") is None
        with pytest.raises(PermissionError):
            private.write_entry(path, "key", b"data")

    def test_file_of_somebody_else_is_a_miss(self, path):
        if os.geteuid() != 0:
            pytest.skip("only the superuser can give files away")
        private.write_entry(path, "key", b"data")
        os.chown(path, 4711, 4711)
        assert private.read_entry(path, "key") is None

    def test_links_are_not_followed(self, path, tmp_path):
        private.write_entry(path, "key", b"data")
        os.replace(path, tmp_path / "elsewhere")
        path.symlink_to(tmp_path / "elsewhere")
        assert private.read_entry(path, "key") is None

    def test_full_disk_leaves_nothing_behind(self, path, monkeypatch):
        private.write_entry(path, "key", b"data")

        def full(*_: object) -> None:
            raise OSError(28, "No space left on device")

        monkeypatch.setattr(os, "replace", full)
        with pytest.raises(OSError, match="No space"):
            private.write_entry(path, "key", b"other data")
        assert private.read_entry(path, "key") == b"data"
        assert [file.name for file in path.parent.iterdir()] == ["file.bin"]
