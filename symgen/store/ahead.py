"""Loops compiled by a second process, while the first one still derives, emits and compiles a model.

    python -m symgen.store.ahead symgen.runtime.schemes.explicit constant

The two share nothing but the cache: the second process leaves its machine code there, where the first one finds it when
it enters the loop. Numba compiles one function at a time in a process, so threads would not do. Whatever goes wrong
with the second process, the first one compiles the loop itself.
"""

from __future__ import annotations

import importlib
import os
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

from symgen.memory import processors
from symgen.store.paths import ENVIRONMENT_VARIABLE, cache_location

#: Processes that were started, by the name of what they compile.
_running: dict[str, subprocess.Popen[bytes]] = {}
#: Seconds between two looks at the cache.
_PAUSE = 0.01


def start(function: Any) -> bool:
    """Begin to compile a function of the runtime in a second process, where that can save time.

    Parameters
    ----------
    function : Dispatcher
        A function with given signatures (`symgen.store.jit.jit`); anything else is left alone.

    Returns
    -------
    bool
        False where there is nothing to do or to gain: compiled or cached already or quickly compiled, no cache, or a
        single processor.
    """
    wanting = getattr(function, "wanting", None)
    if wanting is None or not wanting() or not cache_location().persistent or processors() < 2 or not _is_python():
        return False
    if function.is_quick():
        return False
    name = _name(function)
    if name not in _running:
        command = [sys.executable, "-m", "symgen.store.ahead", *name.split(":")]
        environment = os.environ | {ENVIRONMENT_VARIABLE: str(cache_location().path)}
        nothing = subprocess.DEVNULL
        try:
            process = subprocess.Popen(command, stdin=nothing, stdout=nothing, stderr=nothing, env=environment)
        except OSError:
            return False
        _running[name] = process
        # nobody else asks how it ended, and a process that nobody asks about stays in the system's table
        threading.Thread(target=process.wait, name="symgen-ahead", daemon=True).start()
    return True


def finish(function: Any) -> float:
    """Wait until the process that compiles a function, if there is one, has left its code or has ended.

    Parameters
    ----------
    function : Dispatcher
        What `start` was given.

    Returns
    -------
    float
        Seconds waited.
    """
    process = _running.get(_name(function))
    began = time.perf_counter()
    while process is not None and process.poll() is None and function.wanting():
        time.sleep(_PAUSE)
    return 0.0 if process is None else time.perf_counter() - began


def _name(function: Any) -> str:
    return f"{function.py_func.__module__}:{function.py_func.__qualname__}"


def _is_python() -> bool:
    """Whether this process is an interpreter that can be started anew, not a program with Python inside."""
    return "python" in Path(sys.executable or "").name.lower()


def main(module: str, name: str) -> None:
    """Compile a function and leave its code in the cache."""
    getattr(importlib.import_module(module), name).open()


if __name__ == "__main__":
    main(*sys.argv[1:])
