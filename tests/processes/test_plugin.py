"""A plugin, whose file and command `docs/howto/own-integrator.md` has."""

from tests.processes.programs import block_of, command_of, shell

PAGE = "howto/own-integrator.md"


def test_an_integrator_of_a_plugin_runs(tmp_path):
    (tmp_path / "ab2.py").write_text(block_of(PAGE, "class AdamsBashforth"))
    command = command_of(PAGE, "symgen run four-bar --plugin ab2.py")
    out, _ = shell(command, tmp_path)
    assert "ab2" in out and "ok" in out
    _, said = shell(command.replace("--plugin ab2.py ", ""), tmp_path, code=2)
    assert said.count("\n") == 1 and "'ab2'" in said
