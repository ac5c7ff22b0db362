"""Object files of text in LLVM's language are made once and read again."""

from __future__ import annotations

import ctypes

import pytest

from symgen.native.machine import load
from symgen.store import objects, upkeep

TEXT = 'define i64 @"{name}"(i64 %x) {{\n  %y = add i64 %x, {more}\n  ret i64 %y\n}}\n'


def test_an_object_file_is_made_once(tmp_path, monkeypatch):
    monkeypatch.setenv("SYMGEN_CACHE_DIR", str(tmp_path))
    name = "symgen.test_objects.first"
    code = objects.made(TEXT.format(name=name, more=3), name)
    monkeypatch.setattr(objects, "compiled", lambda text, symbol: pytest.fail("made twice"))
    assert objects.made(TEXT.format(name=name, more=3), name) == code
    call = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_int64)(load(code, [name])[name])
    assert call(39) == 42
    assert len(list((tmp_path / upkeep.NATIVE).rglob("*.bin"))) == 1


def test_another_text_of_the_same_name_and_a_spoilt_file_are_made_anew(tmp_path, monkeypatch):
    monkeypatch.setenv("SYMGEN_CACHE_DIR", str(tmp_path))
    name = "symgen.test_objects.second"
    code = objects.made(TEXT.format(name=name, more=1), name)
    assert objects.made(TEXT.format(name=name, more=2), name) != code
    for path in (tmp_path / upkeep.NATIVE).rglob("*.bin"):
        content = bytearray(path.read_bytes())
        content[-1] ^= 1
        path.write_bytes(content)
    assert objects.made(TEXT.format(name=name, more=1), name) == code
