"""The simulation of friction and stops shares no code with symgen."""

import subprocess
import sys

import pytest


@pytest.mark.slow
def test_the_simulation_imports_nothing_of_symgen() -> None:
    program = (
        "import sys\n"
        "import benchmarks.bounded.chains, benchmarks.bounded.draw, benchmarks.bounded.motion\n"
        "print([name for name in sys.modules if name.partition('.')[0] == 'symgen'])\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
