"""Emitted modules as Python modules: found by path, named by their folder, their functions compiled through the cache.

The name is the same in every process: ``symgen_generated.<folder>.<stem>``. The package exists in memory only; an
emitted module may import its siblings (``from .model import geometry``), and these are loaded from the same folder
first. Only content counts: a file's time is ignored, and no byte code is written next to the modules.
"""

from __future__ import annotations

import builtins
import dis
import hashlib
import importlib.util
import marshal
import sys
import threading
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.machinery import ModuleSpec
from pathlib import Path
from types import CodeType, FunctionType, ModuleType
from typing import Any

from symgen.base.errors import InputError
from symgen.compile.store.entries import get_or_make_data
from symgen.compile.store.upkeep import BYTECODE

PACKAGE = "symgen_generated"


_STAMP = "__symgen_stamp__"
_lock = threading.RLock()


@dataclass(frozen=True)
class _Source:
    """An emitted file that was read: its place, content and digest, its code, the siblings it imports."""

    path: Path
    content: bytes
    digest: str
    code: CodeType
    siblings: tuple[str, ...]


#: Files read in this process, by place and content: a model is loaded again for every run.
_sources: dict[tuple[Path, str], _Source] = {}


def load_module(path: str | Path, qualified_name: str | None = None) -> ModuleType:
    """Load an emitted module, from the cache or from any folder; its functions use the cache.

    Loading the same content again gives the same module. If other content is already loaded under the name, the new
    module goes into its own package, with a digest in the name.

    Parameters
    ----------
    path : str or Path
        The emitted file.
    qualified_name : str, optional
        Dotted name with at least one package; by default ``symgen_generated.<folder>.<stem>``.

    Returns
    -------
    ModuleType
        The executed module, registered in ``sys.modules``.

    Raises
    ------
    InputError
        If the file, or a sibling that it imports, is missing or is not Python.
    """
    path = Path(path).absolute()
    default = f"{PACKAGE}.{path.parent.name.replace('.', '_')}.{path.stem}"
    package, _, stem = (qualified_name or default).rpartition(".")
    if not package:
        raise InputError("qualified_name", "a dotted name such as 'package.module'", f"'{qualified_name}'")
    with _lock:
        sources = {source.path.stem: source for source in _files_needed(path)}
        stamps = {name: _digest_with_imports(name, sources) for name in sources}
        names = {name: stem if name == path.stem else name for name in sources}
        if any(_is_name_taken(f"{package}.{names[name]}", stamps[name]) for name in sources):
            package += f"_{stamps[path.stem][:16]}"
        _register_package(package)
        for name, source in sources.items():  # siblings come before those who import them
            module = _execute_module(f"{package}.{names[name]}", source, stamps[name])
    return module


def _files_needed(path: Path) -> Iterator[_Source]:
    """Return the file and all siblings it needs, each after those it needs."""
    visited: set[Path] = set()

    def visit_file(file: Path) -> Iterator[_Source]:
        visited.add(file)
        source = _read_source(file)
        for name in source.siblings:
            sibling = file.with_name(f"{name}.py")
            if sibling not in visited:
                yield from visit_file(sibling)
        yield source

    return visit_file(path)


def _read_source(path: Path) -> _Source:
    try:
        content = path.read_bytes()
    except OSError as error:
        raise InputError(str(path), "a generated module", error.strerror or "an unreadable file") from error
    digest = hashlib.sha256(content).hexdigest()
    source = _sources.get((path, digest))
    if source is None:
        code = _byte_code(path, content, digest)
        source = _sources[path, digest] = _Source(path, content, digest, code, tuple(_sibling_names(code)))
    return source


def _byte_code(path: Path, content: bytes, digest: str) -> CodeType:
    """Translate to byte code, which for a long module takes longer than the rest of loading."""

    def compile_text() -> bytes:
        try:
            return marshal.dumps(compile(content, str(path), "exec", dont_inherit=True))
        except (SyntaxError, ValueError) as error:
            raise InputError(str(path), "a generated module", f"text that is not Python ({error})") from error

    key = f"{importlib.util.MAGIC_NUMBER.hex()} {sys.version} {path} {digest}"
    code: CodeType = marshal.loads(get_or_make_data(BYTECODE, path.stem, key, compile_text))
    return code


def _sibling_names(code: CodeType) -> Iterator[str]:
    """Yield the names in ``from .name import ...`` and ``from . import name`` at the top of a module."""
    constants: list[object] = []
    for instruction in dis.get_instructions(code):
        if instruction.opname == "LOAD_CONST":
            constants.append(instruction.argval)
        elif instruction.opname == "IMPORT_NAME":
            level, names = constants[-2:]  # pushed just before, in this order
            if level == 1 and instruction.argval:
                yield instruction.argval
            elif level == 1 and isinstance(names, tuple):
                yield from names


def _digest_with_imports(name: str, sources: dict[str, _Source]) -> str:
    """Return the digest of a module and everything it imports, since machine code contains its callees."""
    reached: set[str] = set()
    waiting = [name]
    while waiting:
        if (current := waiting.pop()) not in reached:
            reached.add(current)
            waiting.extend(sources[current].siblings)
    text = "".join(f"{each} {sources[each].digest}\n" for each in sorted(reached))
    return hashlib.sha256(f"{name}\n{text}".encode()).hexdigest()


def _is_name_taken(name: str, stamp: str) -> bool:
    return name in sys.modules and getattr(sys.modules[name], _STAMP, None) != stamp


def _register_package(name: str) -> None:
    """Make a package, and those around it, in memory: with an empty path only modules read here can be imported."""
    parent, _, last = name.rpartition(".")
    if name in sys.modules:
        return
    if parent:
        _register_package(parent)
    package = ModuleType(name, "Package of emitted modules; exists in memory only.")
    package.__path__ = []
    package.__package__ = name
    package.__spec__ = ModuleSpec(name, None, is_package=True)
    sys.modules[name] = package
    if parent:
        setattr(sys.modules[parent], last, package)


def _execute_module(name: str, source: _Source, stamp: str) -> ModuleType:
    if name in sys.modules:
        return sys.modules[name]
    from symgen.compile.store.emitted import CodeOrigin, EmittedFunction, import_library  # with NumPy and llvmlite

    package, _, last = name.rpartition(".")
    module = ModuleType(name)
    module.__file__ = str(source.path)
    module.__package__ = package
    module.__spec__ = ModuleSpec(name, None, origin=str(source.path))
    setattr(module, _STAMP, stamp)
    sys.modules[name] = module
    module.__dict__["__builtins__"] = {**vars(builtins), "__import__": import_library}
    try:
        exec(source.code, module.__dict__)
    except BaseException:
        del sys.modules[name]
        raise
    setattr(sys.modules[package], last, module)
    for value in vars(module).values():
        if isinstance(value, EmittedFunction) and value.py_func.__module__ == name:
            value.origin = CodeOrigin(stamp, source.content)
    return module


def plain_function(function: object) -> Any:
    """Return the plain Python form of an emitted function: one call a run is not worth compilation."""
    return getattr(function, "py_func", function)


def plain_function_with_callees(function: object) -> Any:
    """Return the plain Python form of an emitted function, with those that it calls."""
    plain = plain_function(function)
    scope = plain.__globals__
    called = {name: scope[name] for name in plain.__code__.co_names if hasattr(scope.get(name), "py_func")}
    if not called:
        return plain
    return FunctionType(plain.__code__, scope | {name: plain_function_with_callees(f) for name, f in called.items()})
