"""Machine class and library versions of measured run times, and no further details of the machine."""

from __future__ import annotations

import platform
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from symgen.base.memory import processor_count

#: Libraries whose versions matter for run times and last digits.
LIBRARIES = ("numpy", "llvmlite", "numba", "sympy", "scipy")


def processor_model() -> str:
    """Return the model of the processor, or its architecture where the model is unavailable."""
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace").splitlines():
            label, _, value = line.partition(":")
            if label.strip() == "model name" and value.strip():
                return value.strip()
    except OSError:
        pass
    return platform.processor() or platform.machine() or "unknown"


def machine_class() -> str:
    """Return processor, architecture, cores and system in words."""
    n = processor_count()
    core = "1 core" if n == 1 else f"{n} cores"
    return f"{processor_model()} ({platform.machine()}), {core}, {platform.system()}"


def library_versions() -> dict[str, str]:
    """Return the versions of symgen, Python and the libraries by name."""
    from symgen.base.version import __version__

    versions = {"symgen": __version__, "Python": platform.python_version()}
    for name in LIBRARIES:
        try:
            versions[name] = version(name)
        except PackageNotFoundError:
            versions[name] = "not installed"
    return versions


def version_list() -> str:
    """Return the versions in one line: ``symgen 0.1.0, Python 3.13.0, ...``."""
    return ", ".join(f"{name} {text}" for name, text in library_versions().items())
