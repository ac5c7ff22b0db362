"""What has to be green before a change: other machines day by day, and the wheel where it is due."""

import os
import runpy
import subprocess
import sys
from pathlib import Path

import pytest

CI = Path(__file__).resolve().parents[2] / ".ci"
MACHINE = runpy.run_path(str(CI / "machine"))
ALL_FLAGS = set().union(*MACHINE["NEEDS"].values())
#: One of seven machines is this one as it is.
DAYS = range(len(MACHINE["MACHINES"]))


def values_of(name: str, flags: set[str]) -> set[str]:
    """Return the values that a setting takes within a week."""
    return {MACHINE["settings_of"](day, flags).get(name, "") for day in DAYS}


def test_every_kernel_instruction_set_and_number_of_threads_has_its_day() -> None:
    kernels, instructions = values_of("OPENBLAS_CORETYPE", ALL_FLAGS), values_of("NUMBA_CPU_NAME", ALL_FLAGS)
    assert kernels | instructions == {"", *MACHINE["NEEDS"]}
    assert values_of("OPENBLAS_NUM_THREADS", ALL_FLAGS) == {"1", "2", "8"}
    for name in ("LANG", "TZ", "UMASK"):
        assert len(values_of(name, ALL_FLAGS)) > 1


@pytest.mark.parametrize(
    ("flags", "kernels"),
    [(set(), set()), ({"sse4_2", "sse2"}, {"Nehalem"}), ({"avx2", "fma", "avx"}, {"Haswell", "Zen", "Sandybridge"})],
    ids=["unknown", "oldest", "without AVX-512"],
)
def test_no_processor_is_asked_for_what_it_does_not_know(flags: set[str], kernels: set[str]) -> None:
    assert values_of("OPENBLAS_CORETYPE", flags) - {""} == kernels
    assert {MACHINE["FEATURES"][name] for name in values_of("NUMBA_CPU_NAME", flags) - {""}} <= {""}


def test_a_day_s_settings_are_lines_for_env() -> None:
    done = subprocess.run([sys.executable, CI / "machine", "4"], capture_output=True, text=True, check=True)
    lines = done.stdout.splitlines()
    assert "UMASK=077" in lines and "OMP_NUM_THREADS=2" in lines
    assert all(name.isidentifier() and "\n" not in value for name, _, value in (line.partition("=") for line in lines))


GIT = """#!/bin/sh
case "$1 $*" in
    for-each-ref*) echo "{taken}" ;;
    log*HEAD) echo {now} ;;
    log*) echo {before} ;;
    diff*) exit {differs} ;;
esac
"""
NOON = 20_000 * 86400 + 43200


@pytest.mark.parametrize(
    ("facts", "due"),
    [
        ({}, False),
        ({"differs": 1}, True),
        ({"differs": 128}, True),
        ({"before": NOON - 86400}, True),
        ({"before": NOON - 43201}, True),
        ({"taken": ""}, True),
    ],
    ids=["taken today", "its parts changed", "git fails", "the day before", "the second before midnight", "no history"],
)
def test_the_wheel_is_due_once_a_day_and_where_it_changed(facts: dict[str, object], due: bool, tmp_path: Path) -> None:
    """Of a history as `git` would tell it."""
    git = tmp_path / "git"
    git.write_text(GIT.format(**{"taken": "abc", "now": NOON, "before": NOON - 3600, "differs": 0} | facts))
    git.chmod(0o755)
    environment = os.environ | {"PATH": f"{tmp_path}{os.pathsep}{os.environ['PATH']}"}
    assert (subprocess.run([CI / "due"], env=environment, check=False).returncode == 0) == due
