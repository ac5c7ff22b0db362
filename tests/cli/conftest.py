"""The command line in this process."""

import pytest

from symgen.cli import main


@pytest.fixture
def cli(capsys):
    """Run the command line; return exit code, standard output and standard error."""

    def run(*arguments):
        code = main([str(a) for a in arguments])
        captured = capsys.readouterr()
        return code, captured.out, captured.err

    return run
