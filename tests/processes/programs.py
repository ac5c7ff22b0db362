"""Programs of this environment, and the commands that pages of the documentation have for them."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

from symgen.study.ensemble.table import DONE

ROOT = Path(__file__).resolve().parents[2]
#: Where an installation puts `symgen`, `dask` and `python`.
PROGRAMS = Path(sys.executable).parent
#: A process that takes longer hangs [s].
PATIENCE = 600


def environment(**more):
    """Return the environment of a shell in which this environment is active."""
    found = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    return found | {"PATH": f"{PROGRAMS}{os.pathsep}{os.environ['PATH']}", **more}


def shell(command, folder, code=0, **more):
    """Run a line of a shell in a folder; return its standard output and standard error."""
    words = ["bash", "-c", f"set -o pipefail; {command}"]
    done = subprocess.run(
        words, cwd=folder, env=environment(**more), capture_output=True, text=True, timeout=PATIENCE, check=False
    )
    assert done.returncode == code, f"{command}\n{done.stdout}{done.stderr}"
    return done.stdout, done.stderr


def command_of(page, beginning, part=""):
    """Return the line of a page that begins so and has a part, behind the prompt or the indentation of commands."""
    text = (ROOT / "docs" / page).read_text(encoding="utf-8")
    lines = [line.removeprefix("$ ").strip() for line in text.splitlines() if line.startswith(("$ ", "    "))]
    found = [line.partition("  #")[0].strip() for line in lines if line.startswith(beginning) and part in line]
    assert found, f"{page} has no command '{beginning} ... {part}'"
    return found[0]


def block_of(page, beginning):
    """Return the Python block of a page that has a line which begins so."""
    text = (ROOT / "docs" / page).read_text(encoding="utf-8")
    blocks = [part.partition("\n```")[0] for part in text.split("```python\n")[1:]]
    found = [block for block in blocks if any(line.startswith(beginning) for line in block.splitlines())]
    assert found, f"{page} has no block with '{beginning}'"
    return found[0]


def files_of(page, folder, *names):
    """Write files to a folder, each a block of a page behind the line that calls it so."""
    text = (ROOT / "docs" / page).read_text(encoding="utf-8")
    for name in names:
        _, found, behind = text.partition(f"s `{name}`:\n\n```")
        assert found, f"{page} has no file {name}"
        (folder / name).write_text(behind.partition("\n")[2].partition("```")[0])


def chunks(folder):
    """Return the numbers of the chunks that a folder of a sweep has, in the order in which they came."""
    log = folder / DONE
    return [int(line.split()[0]) for line in log.read_text().splitlines()] if log.exists() else []


class Program:
    """A program in the background, with all processes that it starts; its output goes to a file.

    Parameters
    ----------
    words : sequence
        The program and its arguments.
    log : Path
        The file.
    """

    def __init__(self, words, log, **more):
        self.log = log
        with log.open("wb") as file:
            self.process = subprocess.Popen(
                [*map(str, words)],
                cwd=log.parent,
                env=environment(**more),
                stdin=subprocess.DEVNULL,
                stdout=file,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.kill()

    def said(self):
        """Return what it has said so far."""
        return self.log.read_text(encoding="utf-8", errors="replace")

    def wait_for(self, condition):
        """Wait until a condition holds, while the program runs."""
        end = time.monotonic() + PATIENCE
        while not condition():
            assert self.process.poll() is None and time.monotonic() < end, self.said()
            time.sleep(0.02)

    def end(self):
        """Wait for its end; return the exit code."""
        return self.process.wait(PATIENCE)

    def kill(self):
        """Kill it and all that it started, as a machine that fails does."""
        try:
            os.killpg(self.process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        self.process.wait(PATIENCE)
