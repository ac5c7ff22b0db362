"""Plugins: Python files and installed packages that register their own kinds.

A plugin is Python that is run: it is loaded because a person names it (``--plugin FILE.py``, `load_plugin`) or has
installed it, never because a mechanism file mentions it. Processes of studies load the same files.
"""

from __future__ import annotations

import hashlib
import sys
import traceback
from collections.abc import Callable, Iterable
from functools import wraps
from importlib.util import module_from_spec, spec_from_file_location
from os import PathLike
from types import ModuleType
from typing import Any, TypeVar, cast

from symgen.base import arguments
from symgen.base.errors import InputError, SymgenError

F = TypeVar("F", bound=Callable[..., Any])

#: Group of entry points of packages that are plugins.
GROUP = "symgen.plugins"

#: Loaded files -> their modules.
_files: dict[str, bytes] = {}
#: Entry points that were loaded, with their versions; None before they are looked for.
_installed: list[str] | None = None


def load_plugin(path: str | PathLike[str]) -> ModuleType:
    """Run a Python file that registers methods, integrators, joints or forces; once in a process.

    Parameters
    ----------
    path : path
        The file; `symgen.extension` has the imports for it.

    Returns
    -------
    module
        The file as a module, ``symgen_plugin_`` and its name.

    Raises
    ------
    InputError
        If it is no Python file, raises an error, or registers a name that is taken.
    """
    file = arguments.path_argument("plugin", path).absolute()
    name, where = f"symgen_plugin_{file.stem.replace('-', '_')}", f"plugin '{path}'"
    if str(file) in _files:
        return sys.modules[name]
    if file.suffix != ".py" or not file.is_file():
        raise InputError(where, "a Python file, .py", "no such file" if file.suffix == ".py" else "another ending")
    if name in sys.modules:
        raise InputError(where, "one plugin of a name", f"{sys.modules[name].__file__} as well")
    spec = spec_from_file_location(name, file)
    assert spec is not None and spec.loader is not None, "the ending is that of Python files"
    text, module = file.read_bytes(), module_from_spec(spec)
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except SymgenError:
        del sys.modules[name]
        raise
    except (Exception, SystemExit) as error:
        del sys.modules[name]
        raise InputError(where, "a file that runs", _error_in_words(error)) from error
    _files[str(file)] = text
    return module


def failure_of_plugin(error: BaseException) -> InputError | None:
    """Return the sentence for an error that passed a line of a loaded file, with that line; None for others."""
    lines = [frame for frame in traceback.extract_tb(error.__traceback__) if frame.filename in _files]
    if not lines:
        return None
    return InputError(
        f"plugin '{lines[-1].filename}', line {lines[-1].lineno}", "code that runs", _error_in_words(error)
    )


def explain_plugin_errors(function: F) -> F:
    """Return a function that raises an error inside a plugin as its sentence, with the error as the cause."""

    @wraps(function)
    def call_and_explain(*values: object, **keywords: object) -> Any:
        try:
            return function(*values, **keywords)
        except SymgenError:
            raise
        except (Exception, SystemExit) as error:
            if (failure := failure_of_plugin(error)) is None:
                raise
            raise failure from error

    return cast(F, call_and_explain)


def _error_in_words(error: BaseException) -> str:
    return f"{type(error).__name__}: {error}"


def load_plugins(paths: Iterable[str | PathLike[str]]) -> None:
    """Load several files; see `load_plugin`."""
    for path in paths:
        load_plugin(path)


def load_installed_plugins() -> bool:
    """Import the plugins of installed packages, unless that was done; return whether there are any.

    Raises
    ------
    InputError
        If one cannot be imported.
    """
    global _installed
    if _installed is None:
        from importlib.metadata import entry_points  # a slow import, seldom needed

        _installed = []
        for entry in entry_points(group=GROUP):
            try:
                entry.load()
            except Exception as error:
                got = f"{type(error).__name__}: {error}"
                raise InputError(f"plugin '{entry.name}' ({entry.value})", "a module that imports", got) from error
            _installed.append(f"{entry.value} {entry.dist.version if entry.dist else ''}")
    return bool(_installed)


def loaded_plugin_files() -> tuple[str, ...]:
    """Return the loaded files, for another process."""
    return tuple(_files)


def plugin_digests() -> tuple[str, ...]:
    """Return digests of the texts of all plugins: what journals and folders of sweeps depend on."""
    texts = [*_files.values(), *(name.encode() for name in _installed or ())]
    return tuple(sorted(hashlib.sha256(text).hexdigest() for text in texts))
