"""Completion by a key press in an interactive shell whose start-up file has the line that the script names."""

import os
import pty
import select
import shlex
import subprocess
import time

import pytest

from tests.processes.programs import PATIENCE, command_of, environment, shell


class Terminal:
    """An interactive shell in a terminal of its own."""

    def __init__(self, home):
        self.leader, follower = pty.openpty()
        more = {"HOME": str(home), "TERM": "dumb", "PS1": "> ", "INPUTRC": "/dev/null"}
        self.process = subprocess.Popen(
            ["bash", "-i"], cwd=home, env=environment(**more), stdin=follower, stdout=follower, stderr=follower,
            start_new_session=True,
        )  # fmt: skip
        os.close(follower)

    def shows(self, typed, text):
        """Type something; return what the terminal shows until a text is there."""
        os.write(self.leader, typed.encode())
        shown, end = b"", time.monotonic() + PATIENCE / 10
        while text.encode() not in shown:
            ready, _, _ = select.select([self.leader], [], [], max(0.0, end - time.monotonic()))
            assert ready, f"'{text}' is not in {shown!r}"
            shown += os.read(self.leader, 65536)
        return shown.decode()

    def close(self):
        self.process.kill()
        self.process.wait(PATIENCE)
        os.close(self.leader)


@pytest.fixture
def terminal(tmp_path):
    script, _ = shell(command_of("command-line.md", "symgen completion bash"), tmp_path)
    where, _, line = script.splitlines()[0].partition(":  ")
    assert where == "# put into ~/.bashrc"
    (tmp_path / ".bashrc").write_text(f"{line}\nbind 'set enable-bracketed-paste off'\nPS1='ready> '\n")
    found = Terminal(tmp_path)
    yield found
    found.close()


def test_a_key_press_completes_models_options_and_files(terminal, tmp_path):
    (tmp_path / "own.toml").write_text("")
    terminal.shows("", "ready> ")
    terminal.shows("symgen sw\t", "symgen sweep ")
    terminal.shows("four\t", "four-bar ")
    terminal.shows("--schedu\t", "--scheduler ")
    terminal.shows("\x15symgen check ow\t", "own.toml ")
    terminal.shows(f"\x15echo {shlex.quote('do' + 'ne')} $((6*7))\n", "done 42")
