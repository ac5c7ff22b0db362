"""A page that a command writes, in Chromium: both are processes."""

import json

import pytest

from tests.browser.chromium import Chromium
from tests.processes.programs import command_of, shell


@pytest.mark.browser
def test_a_page_of_the_command_plays_and_computes(tmp_path):
    shell(command_of("player.md", "symgen view four-bar -o four-bar.html"), tmp_path)
    with Chromium() as browser:
        browser.open(tmp_path / "four-bar.html")
        browser.run("document.getElementById('play').click()")
        browser.frame()
        computed = browser.run("window.symgen.run({ crank_mass: 2.5 }, 1.0, 1e-3)")
        names = browser.run("window.symgen.names")
        assert browser.said == []
    out, _ = shell("symgen run four-bar --set crank_mass=2.5 --integrator rk4 --step 1e-3 --until 1 --json", tmp_path)
    final = json.loads(out)["final"]["q"]
    assert computed[: len(names)] == pytest.approx([final[name] for name in names], abs=1e-9)
