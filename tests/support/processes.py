"""Processes that begin with everything imported: what a command does is seen from outside, how it starts is not.

A process of its own takes about a second before it does anything: the interpreter, NumPy, Numba, SymPy. Here one
process of the session imports them once, and every other is a fork of it: it has its own memory, folder, environment,
standard streams, signals and exit code, and nothing of what another one did. What shows only where an interpreter
starts, such as which modules are imported or how much memory is taken, wants `subprocess`.
"""

import atexit
import functools
import importlib
import json
import os
import pkgutil
import selectors
import socket
import subprocess
import sys
import threading
import time
import traceback
import types
import warnings
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from typing import Any, NoReturn

#: Runs the command line, as the program that an installation puts beside Python does.
COMMAND = "import sys; from symgen.cli import main; sys.exit(main())"
#: A process that does not end within this hangs [s]. The longest of the slow tests take ten minutes on a busy machine.
PATIENCE = 3600
#: The most that one request may hold [bytes].
_ROOM = 1 << 18
#: Beginnings of variables that an interpreter or a library reads where it is started or imported.
_AT_START = ("PYTHON", "NUMBA_", "LD_", "LANG", "LC_", "OPENBLAS_", "OMP_", "MKL_", "MPL", "XDG_", "HOME")
#: What commands import when they are used.
_LIBRARIES = (
    *("llvmlite.binding", "matplotlib.backends.backend_agg", "matplotlib.backends.backend_svg", "matplotlib.pyplot"),
    *("distributed", "filelock", "h5netcdf", "msgspec", "numba", "numpy", "pandas", "PIL.GifImagePlugin"),
    *("pyarrow.parquet", "rich.progress", "rich.table", "sympy", "sympy.tensor.tensor", "tomllib", "xarray"),
)


def symgen(words: Sequence[object], **keys: Any) -> subprocess.CompletedProcess[str]:
    """Run ``symgen`` with words; keys are those of `python`."""
    return python(COMMAND, *words, **keys)


def python(
    script: str,
    *words: object,
    cwd: str | os.PathLike[str] | None = None,
    env: Mapping[str, str] | None = None,
    path: Sequence[object] = (),
    strict: bool = False,
) -> subprocess.CompletedProcess[str]:
    """Run a script as ``python -c`` does; return exit code and both outputs.

    Parameters
    ----------
    script : str
        Python.
    *words : object
        What it finds in ``sys.argv`` behind ``-c``, as text.
    cwd : path, optional
        Folder to run it in, by default this process's.
    env : mapping of str to str, optional
        The environment, by default this process's.
    path : sequence, optional
        Folders that come first where modules are looked for.
    strict : bool, default False
        Whether warnings are errors.

    Where the environment differs in variables that are read when an interpreter or a library starts, one is started.
    """
    given = dict(os.environ if env is None else env)
    apart = [name for name in {*given, *os.environ} if given.get(name) != os.environ.get(name)]
    if any(name.startswith(_AT_START) for name in apart):
        given["PYTHONPATH"] = os.pathsep.join(p for p in (*map(str, path), given.get("PYTHONPATH")) if p)
        command = [sys.executable, *(("-W", "error") if strict else ()), "-c", script, *map(str, words)]
        return subprocess.run(
            command, cwd=cwd, env=given, capture_output=True, text=True, timeout=PATIENCE, check=False
        )
    ask = {
        "script": script,
        "words": [*map(str, words)],
        "folder": os.fspath(cwd) if cwd is not None else os.getcwd(),
        "environment": given,
        "path": [*map(str, path)],
        "strict": strict,
    }
    message = json.dumps(ask).encode()
    assert len(message) < _ROOM, len(message)
    process, connection = _server(os.getpid())
    (out, to_out), (err, to_err) = os.pipe(), os.pipe()
    socket.send_fds(connection, [message], [to_out, to_err])
    os.close(to_out)
    os.close(to_err)
    try:
        texts = _read(out, err)
        code = int(connection.recv(64))
    except TimeoutError:
        process.kill()
        _server.cache_clear()
        raise
    return subprocess.CompletedProcess([sys.executable, "-c", script, *map(str, words)], code, *texts)


def _read(*pipes: int) -> list[str]:
    """Read pipes to their ends, whichever is written to, and close them; return what came as text."""
    deadline, found = time.monotonic() + PATIENCE, {pipe: bytearray() for pipe in pipes}
    try:
        with selectors.DefaultSelector() as waiting:
            for pipe in pipes:
                waiting.register(pipe, selectors.EVENT_READ)
            while waiting.get_map():
                if time.monotonic() > deadline:
                    raise TimeoutError
                for key, _ in waiting.select(1.0):
                    part = os.read(key.fd, 1 << 16)
                    found[key.fd] += part
                    if not part:
                        waiting.unregister(key.fd)
    finally:
        for pipe in pipes:
            os.close(pipe)
    return [text.decode().replace("\r\n", "\n") for text in found.values()]


@functools.cache
def _server(_: int) -> tuple[subprocess.Popen[bytes], socket.socket]:
    """Start the process that all others are forks of, once in each process that asks."""
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    for end in (ours, theirs):
        end.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 2 * _ROOM)
    ours.settimeout(PATIENCE)
    with theirs:
        script = f"from support.processes import serve; serve({theirs.fileno()})"
        environment = os.environ | {"PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
        process = subprocess.Popen([sys.executable, "-c", script], pass_fds=[theirs.fileno()], env=environment)
    atexit.register(_stop, process, ours)
    return process, ours


def _stop(process: subprocess.Popen[bytes], connection: socket.socket) -> None:
    connection.close()
    process.wait(PATIENCE)


# -- in the process that serves ----------------------------------------------------------------------------------------


def serve(number: int) -> None:
    """Import everything; then run what comes through a socket, each in a fork, until the other end is closed."""
    import gc

    connection = socket.socket(fileno=number)
    _import_all()
    gc.collect()
    gc.freeze()
    while True:
        message, files, _, _ = socket.recv_fds(connection, _ROOM, 2)
        if not message:
            return
        child = os.fork()
        if child == 0:
            connection.close()
            _run(json.loads(message), files)
        for file in files:
            os.close(file)
        with suppress(OSError):  # nobody is there any more to be told
            connection.send(str(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])).encode())


def _import_all() -> None:
    import symgen

    for name in _LIBRARIES:
        with suppress(ImportError):
            importlib.import_module(name)
    for module in pkgutil.walk_packages(symgen.__path__, "symgen."):
        if not any(word in module.name for word in ("cuda", "device", ".gym.")):  # of extras that may be missing
            importlib.import_module(module.name)


def _run(ask: Mapping[str, Any], files: Sequence[int]) -> NoReturn:
    """Do in this process what was asked, and end it as an interpreter ends, but for the taking apart of modules."""
    atexit._clear()  # what libraries remove at their end, such as folders of Matplotlib, is of the process that serves
    nothing = os.open(os.devnull, os.O_RDONLY)
    for number, file in enumerate((nothing, *files)):
        os.dup2(file, number)
        os.close(file)
    os.chdir(ask["folder"])
    os.environ.clear()
    os.environ.update(ask["environment"])
    if path := ask["path"]:  # also for processes that this one starts
        sys.path[:0] = path
        os.environ["PYTHONPATH"] = os.pathsep.join(p for p in (*path, os.environ.get("PYTHONPATH")) if p)
    sys.argv[:] = ["-c", *ask["words"]]
    if ask["strict"]:
        warnings.simplefilter("error")
    main = sys.modules["__main__"] = types.ModuleType("__main__")
    code = _code_of(lambda: exec(compile(ask["script"], "<string>", "exec"), vars(main)))
    with suppress(BaseException):
        threading._shutdown()
    atexit._run_exitfuncs()
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except (OSError, ValueError):
            code = code or 120
    os._exit(code)


def _code_of(work: Callable[[], object]) -> int:
    """Return the exit code of a script that has been run to its end."""
    try:
        work()
    except SystemExit as end:
        if end.code is None or isinstance(end.code, int):
            return (end.code or 0) & 0xFF
        print(end.code, file=sys.stderr)
        return 1
    except BaseException:
        traceback.print_exc()
        return 1
    return 0
