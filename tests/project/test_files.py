"""The one way in which files are written."""

import io
import os
import stat
import sys
from pathlib import Path

import pytest

from symgen.base import files
from symgen.base.errors import InputError


def full(file):
    file.write(b"half")
    raise OSError(28, "No space left on device")


def test_files_that_belong_together_appear_together_or_not_at_all(tmp_path):
    (tmp_path / "a").write_text("old")
    with pytest.raises(InputError, match=r"b: expected a file that can be written, got No space left on device"):
        files.write_all({tmp_path / "a": "new", tmp_path / "b": full})
    assert [p.name for p in tmp_path.iterdir()] == ["a"] and (tmp_path / "a").read_text() == "old"
    files.write_all({tmp_path / "a": "new", tmp_path / "b": lambda file: file.write(b"\xff")})
    assert (tmp_path / "a").read_text() == "new" and (tmp_path / "b").read_bytes() == b"\xff"


@pytest.mark.parametrize("error", [KeyboardInterrupt, ValueError, MemoryError])
def test_nothing_is_left_whatever_goes_wrong(tmp_path, error):
    def broken(file):
        file.write(b"half")
        raise error

    with pytest.raises(error):
        files.write_whole(tmp_path / "a", broken)
    assert list(tmp_path.iterdir()) == []


def test_a_file_that_exists_is_kept_where_that_is_asked(tmp_path):
    files.write_whole(tmp_path / "a", "first", replace=False)
    with pytest.raises(InputError, match="does not exist yet"):
        files.write_whole(tmp_path / "a", "second", replace=False)
    assert (tmp_path / "a").read_text() == "first"


def test_an_error_that_is_kept_holds_no_view_of_what_was_to_be_written(tmp_path, monkeypatch):
    """The collector may close the stream before the view goes, which Python 3.13 reports."""
    monkeypatch.setattr(files.os, "replace", lambda *names: full(io.BytesIO()))
    with pytest.raises((OSError, InputError)) as caught:
        files.write_whole(tmp_path / "a", lambda file: file.write(b"text"))
    held = [value for entry in caught.traceback for value in entry.frame.f_locals.values()]
    assert b"text" in held and not any(isinstance(value, memoryview) for value in held)


def test_a_link_stays_a_link(tmp_path):
    (tmp_path / "real").write_text("old")
    (tmp_path / "link").symlink_to("real")
    files.write_whole(tmp_path / "link", "new")
    assert (tmp_path / "link").is_symlink() and (tmp_path / "real").read_text() == "new"


def test_a_folder_that_goes_away_meanwhile(tmp_path):
    folder = tmp_path / "folder"
    folder.mkdir()
    files.check_writable("--save", folder / "a")
    folder.rmdir()
    with pytest.raises(InputError, match="a file that can be written, got no such file or folder"):
        files.write_whole(folder / "a", "text")


@pytest.mark.parametrize("name", ["", "x/y", "a\0b", "n" * 300])
def test_names_that_cannot_be_written(tmp_path, name):
    with pytest.raises(InputError, match=r"^--save: expected "):
        files.check_writable("--save", tmp_path / name)
    with pytest.raises(InputError):
        files.write_whole(tmp_path / name, "text")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(sys.platform == "win32", reason="needs devices and pipes")
def test_devices_and_pipes_are_left_alone(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for path in (Path("/dev/null"), tmp_path / "pipe"):
        with pytest.raises(InputError, match="which is a device or a pipe"):
            files.check_writable("--csv", path)
    assert stat.S_ISCHR(os.stat("/dev/null").st_mode)


def test_a_table(tmp_path):
    files.write_csv(tmp_path / "a.csv", ["x", "y"], [[1, None], ['a"b', "c,d"]])
    assert (tmp_path / "a.csv").read_bytes() == b'x,y\r\n1,\r\n"a""b","c,d"\r\n'
